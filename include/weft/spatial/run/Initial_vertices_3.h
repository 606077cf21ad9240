// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshing that begins with the vertices of a mesh that there is already: those of the boundary first, so that the
// surface can be refined, then those inside.

#ifndef WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H
#define WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/refine/interior_lattice_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// The vertices of a mesh that there is already, and what is different from meshing without them.
template <class K>
struct Initial_vertices_3
{
  std::vector<typename K::Point_3> points;  ///< distinct
  std::vector<Vertex_location_3> locations; ///< in the oracle's numbers; all its corners are among them
  std::vector<std::size_t> fixed;           ///< those that have to stay where they are
  /// Whether to go no further where the refined boundary isn't a closed 2-manifold.
  bool only_manifold = false;
  /// Shapes asked for once the vertices are smoothed, as `Criteria_3` has them; 0: only those that the criteria ask
  /// for.
  double facet_shape_in_the_end = 0, cell_shape_in_the_end = 0;
  double smoothing_share = 1; ///< most of the time left that smoothing may take
  /// Whether they are those of a mesh of the same domain, so that all can be inserted at once, and what refinement
  /// leaves alone stays as it is.
  bool is_adaptation = false;
  std::vector<char> changed{}; ///< then, by vertex, whether it is to be smoothed all the same
};

/// Inserts the vertices of the boundary and those that have to stay.
/// \returns the others, for `insert_interior()`.
template <class Restricted>
std::vector<typename Restricted::Point> insert_boundary(const Initial_vertices_3<typename Restricted::Kernel>& initial,
                                                        Restricted& mesh)
{
  std::vector<char> is_first(initial.points.size(), false);
  std::vector<typename Restricted::Point> points, interior;
  std::vector<Vertex_location_3> locations;
  for (const std::size_t i : initial.fixed) is_first[i] = true;
  for (std::size_t i = 0; i < is_first.size(); ++i) {
    if (initial.locations[i].dimension < 3) is_first[i] = true;
    if (!is_first[i]) continue;
    points.push_back(initial.points[i]);
    locations.push_back(initial.locations[i]);
  }
  mesh.insert(points, locations);
  std::vector<std::size_t> number(is_first.size(), 0);
  for (std::size_t i = 1; i < number.size(); ++i) number[i] = number[i - 1] + (is_first[i - 1] != 0);
  for (const std::size_t i : initial.fixed) mesh.fix(mesh.vertices()[number[i]]);
  for (std::size_t i = 0; i < is_first.size(); ++i)
    if (!is_first[i]) interior.push_back(initial.points[i]);
  return interior;
}

/// Inserts those interior vertices that lie in the domain, as few don't where cells are inverted, and don't end up on
/// the boundary. Otherwise refinement has to surround them with vertices on the surface.
/// \returns how many were left out.
template <class Restricted>
std::size_t insert_interior(std::vector<typename Restricted::Point> points,
                            const Criteria_3<typename Restricted::Kernel>& criteria, Restricted& mesh)
{
  using Point = typename Restricted::Point;
  const std::size_t before = points.size();
  if (points.empty()) return 0; // looking for those that encroach takes long where sizes vary
  const double spacing = 0.1 * criteria.size(Point(0, 0, 0));
  drop_encroaching(mesh, spacing, 0, points);
  std::vector<Point> inside;
  std::vector<Vertex_location_3> locations;
  for (const Point& p : points) {
    const int subdomain = mesh.oracle().subdomain(p);
    if (subdomain == 0) continue;
    inside.push_back(p);
    locations.push_back({3, subdomain});
  }
  mesh.insert(inside, locations);
  return before - inside.size();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H
