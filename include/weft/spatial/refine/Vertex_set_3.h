// SPDX-License-Identifier: GPL-3.0-or-later
//
// What it takes to refine a part of a mesh once more from fewer vertices. Beside acute edges that nobody marked,
// whether refinement comes to an end is luck. What went wrong there stays, since refinement takes nothing back.

#ifndef WEFT_SPATIAL_REFINE_VERTEX_SET_3_H
#define WEFT_SPATIAL_REFINE_VERTEX_SET_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// The vertices of a mesh: all that it takes to build it again.
template <class K>
struct Vertex_set_3
{
  std::vector<typename K::Point_3> points;
  std::vector<Vertex_location_3> locations;
};

/// The vertices in the order of their ids. Linear.
template <class Restricted>
Vertex_set_3<typename Restricted::Kernel> vertices_of(const Restricted& mesh)
{
  Vertex_set_3<typename Restricted::Kernel> vertices;
  for (const auto v : mesh.vertices()) {
    vertices.points.push_back(v->point());
    vertices.locations.push_back(v->location());
  }
  return vertices;
}

/// The Delaunay balls of all bad elements, surface Delaunay balls of facets and crease edges. Linear.
/// \param least_radius of the balls around vertices without a topological disk.
template <class Restricted>
std::vector<Ball_3<typename Restricted::Kernel>>
bad_balls(const Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria, double least_radius)
{
  std::vector<Ball_3<typename Restricted::Kernel>> balls;
  const auto take = [&](const auto&, const Badness_3&, const auto& ball) { balls.push_back(ball); };
  visit_bad_elements(mesh, criteria, take, take, take, [&](auto v) {
    balls.push_back({v->point(), least_radius * least_radius});
  });
  return balls;
}

/// Takes the vertices in balls that are blown up by a factor out of a mesh, but for feature vertices and those that
/// were fixed. The others get new ids. O(vertices * balls).
/// \returns how many were; none at all where it would be more than half of them.
template <class Restricted>
std::size_t drop_vertices(const std::vector<Ball_3<typename Restricted::Kernel>>& balls, double factor,
                          Restricted& mesh)
{
  std::vector<typename Restricted::Vertex_handle> dropped;
  for (const auto v : mesh.vertices())
    if (!mesh.is_fixed(v) && std::any_of(balls.begin(), balls.end(), [&](const auto& b) {
          return CGAL::to_double(CGAL::squared_distance(b.center, v->point())) < factor * factor * b.squared_radius;
        }))
      dropped.push_back(v);
  if (2 * dropped.size() > mesh.vertices().size()) return 0;
  for (const auto v : dropped) {
    Vertex_transaction_3<Restricted> change(mesh, v);
    change.leave_out();
    change.commit();
  }
  return dropped.size();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_VERTEX_SET_3_H
