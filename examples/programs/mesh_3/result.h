// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H

#include "domain.h"

#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <memory>

namespace mesh_3_program {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Result
{
  weft::Tetrahedral_mesh_3<K> mesh;
  weft::Mesh_report_3 report;
  weft::Quality_3 quality;
};

/// Measures the quality.
std::shared_ptr<const Result> make_result(weft::Tetrahedral_mesh_3<K> mesh, const weft::Mesh_report_3& report);

inline weft::Criteria_3<K> criteria(const Bounds& bounds)
{
  weft::Criteria_3<K> criteria;
  criteria.size = bounds.size;
  criteria.approximation = bounds.approximation;
  criteria.facet_shape = bounds.facet_shape;
  criteria.cell_shape = bounds.cell_shape;
  criteria.topology = bounds.topology;
  return criteria;
}

inline double diagonal(const CGAL::Bbox_3& box)
{
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace mesh_3_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_3_RESULT_H
