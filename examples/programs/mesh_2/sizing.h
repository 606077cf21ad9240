// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizing fields with all that depends on their types, compiled apart from the rest.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_2_SIZING_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_2_SIZING_H

#include <weft/options.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/report.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace mesh_2_program {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;

class Sizing
{
public:
  virtual ~Sizing() = default;

  /// `weft::make_mesh_2()`, `weft::measure_sizing_2()` and `refine_by_cgal()` with this field.
  virtual weft::Mesh_report_2 make_mesh(Cdt& cdt, const weft::Mesh_options_2& options) const = 0;
  virtual weft::Sizing_quality_2 measure(const Cdt& cdt) const = 0;
  virtual bool refine_by_cgal(Cdt& cdt, const std::function<bool(std::size_t)>& go_on) const = 0;
};

std::unique_ptr<Sizing> uniform_sizing(double size);
/// \throws weft::Domain_error where features of the graph meet without sharing a point.
std::unique_ptr<Sizing> lfs_sizing(const Pslg& graph, double k, double min_size);
/// \throws weft::Option_error for a mark that no region has.
std::unique_ptr<Sizing> region_sizing(const Cdt& cdt, const weft::Mesh_tags_2<K>& tags, double size,
                                      const std::map<int, double>& size_of_mark);

/// Sizes at the vertices of a mesh file, limited to that growth per unit of distance, and at most `size`.
/// \throws weft::File_error if it can't be read.
std::unique_ptr<Sizing> field_sizing(const std::string& filename, double gradation, double size);

} // namespace mesh_2_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_2_SIZING_H
