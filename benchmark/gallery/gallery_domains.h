// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two kinds of domains of the gallery. Each is meshed in a translation unit of its own: CGAL's mesher and weft's
// take gigabytes to compile for one.

#ifndef WEFT_BENCHMARK_GALLERY_GALLERY_DOMAINS_H
#define WEFT_BENCHMARK_GALLERY_GALLERY_DOMAINS_H

#include "../spatial/spatial_inputs.h"
#include "gallery_program.h"

#include <CGAL/Bbox_3.h>

#include <functional>

namespace benchmark {

/// A domain given by labels.
struct Labels
{
  std::function<int(const Spatial_kernel::Point_3&)> labelling;
  CGAL::Bbox_3 box;
  int number;     ///< including 0, the outside
  int seed_grid;  ///< see weft::Labelled_oracle_3
  double longest; ///< side of the domain
  double detail;  ///< size of the smallest details that count
};

void mesh_labels(const Gallery_arguments& a, const Labels& labels);

void mesh_surface(const Gallery_arguments& a, const Spatial_input& input);

} // namespace benchmark

#endif // WEFT_BENCHMARK_GALLERY_GALLERY_DOMAINS_H
