// SPDX-License-Identifier: GPL-3.0-or-later

#include "gallery_domains.h"
#include "gallery_meshes.h"

#include <weft/spatial/domain/Labelled_oracle_3.h>

#include <CGAL/Labeled_mesh_domain_3.h>

#include <functional>

namespace benchmark {

void mesh_labels(const Gallery_arguments& a, const Labels& labels)
{
  using Domain = CGAL::Labeled_mesh_domain_3<Spatial_kernel>;
  using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
  using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
  const Bounds bounds = bounds_of(a, labels.longest);
  Gallery gallery(a, bounds);
  const weft::Labelled_oracle_3<Spatial_kernel, std::function<int(const Point_3&)>> oracle(
      labels.labelling, labels.box, labels.number, labels.seed_grid);
  add_weft(oracle, criteria_of(bounds), labels.detail, a, gallery);
  const Domain domain(labels.labelling, labels.box);
  add_cgal<C3t3>(domain, cgal_criteria<Triangulation>(bounds, bounds.size), a, gallery);
  gallery.write_figures(labels.number - 1);
}

} // namespace benchmark
