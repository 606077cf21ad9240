// SPDX-License-Identifier: GPL-3.0-or-later
//
// All elements of a restricted Delaunay triangulation that violate its criteria: what reports count, what creases are
// blamed for, and where refinement starts again.

#ifndef WEFT_SPATIAL_CRITERIA_VISIT_BAD_ELEMENTS_3_H
#define WEFT_SPATIAL_CRITERIA_VISIT_BAD_ELEMENTS_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/restricted/topological_disk_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// A ball in space.
template <class K>
struct Ball_3
{
  typename K::Point_3 center;
  double squared_radius;
};

/// Calls `on_edge(crease edge, badness, ball)`, `on_facet(facet, badness, ball)` and `on_cell(cell, badness, ball)` for
/// each bad element with its Delaunay ball, that of the surface or crease for the former two, and `on_vertex(vertex)`
/// for each boundary vertex without a topological disk. Linear.
/// \param sees_ridges see Badness_measure_3.
template <class Restricted, class On_edge, class On_facet, class On_cell, class On_vertex>
void visit_bad_elements(const Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                        const On_edge& on_edge, const On_facet& on_facet, const On_cell& on_cell,
                        const On_vertex& on_vertex, bool sees_ridges = true)
{
  using Ball = Ball_3<typename Restricted::Kernel>;
  const Badness_measure_3<Restricted> measure(mesh, criteria, 1, sees_ridges);
  for (const auto& e : mesh.creases().edges()) {
    const Badness_3 badness = measure.crease_edge(e);
    if (badness.is_bad()) on_edge(e, badness, Ball{e.steiner, e.squared_radius});
  }
  const int threads = criteria.has_functions() ? 1 : mesh.threads();
  std::vector<Badness_3> badness;
  const auto& facets = mesh.facets();
  badness.assign(facets.size(), Badness_3());
  const auto exists = [&](std::size_t k) { return facets[k].cell != typename Restricted::Cell_handle(); };
  parallel_for(
      facets.size(), threads,
      [&](std::size_t k) {
        if (exists(k)) badness[k] = measure.facet(facets[k]);
      },
      64);
  for (std::size_t k = 0; k < facets.size(); ++k)
    if (exists(k) && badness[k].is_bad())
      on_facet(facets[k], badness[k], Ball{facets[k].steiner, facets[k].squared_radius});
  std::vector<typename Restricted::Cell_handle> cells;
  for (const auto c : mesh.triangulation().finite_cell_handles())
    if (c->subdomain() != 0) cells.push_back(c);
  badness.assign(cells.size(), Badness_3());
  parallel_for(cells.size(), threads, [&](std::size_t k) { badness[k] = measure.cell(cells[k]); });
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (!badness[k].is_bad()) continue;
    const auto& center = cells[k]->circumcenter();
    on_cell(cells[k], badness[k],
            Ball{center, CGAL::to_double(CGAL::squared_distance(center, cells[k]->vertex(0)->point()))});
  }
  for (const auto v : mesh.vertices())
    if (v->location().dimension <= 2 && !has_topological_disk(mesh, v)) on_vertex(v);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_VISIT_BAD_ELEMENTS_3_H
