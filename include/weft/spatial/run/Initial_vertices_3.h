// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshing that begins with the vertices of a mesh that there is already: those of the boundary first, so that the
// surface can be refined, then those inside.

#ifndef WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H
#define WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/refine/interior_lattice_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>
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
  /// By vertex, how far it is from its neighbours: interior ones that are well inside by that measure stay. Empty:
  /// those that could end up on the boundary don't.
  std::vector<double> spacings{};
};

/// Mean length of the edges at each vertex of a mesh, each counted as often as cells have it. Linear.
template <class K>
std::vector<double> mean_edges_of_vertices(const Tetrahedral_mesh_3<K>& mesh)
{
  std::vector<double> sum(mesh.points.size(), 0), count(mesh.points.size(), 0);
  for (const auto& c : mesh.cells)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double d = std::sqrt(CGAL::to_double(CGAL::squared_distance(mesh.points[c[i]], mesh.points[c[j]])));
        for (const std::size_t v : {c[i], c[j]}) sum[v] += d, ++count[v];
      }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0) sum[v] /= count[v];
  return sum;
}

/// Vertices inside a domain that are inserted when its boundary is there.
template <class Point>
struct Interior_vertices_3
{
  std::vector<Point> points;
  std::vector<double> spacings; ///< as above, or empty
};

/// Inserts the vertices of the boundary and those that have to stay.
/// \returns the others, for `insert_interior()`.
template <class Restricted>
Interior_vertices_3<typename Restricted::Point>
insert_boundary(const Initial_vertices_3<typename Restricted::Kernel>& initial, Restricted& mesh)
{
  std::vector<char> is_first(initial.points.size(), false);
  std::vector<typename Restricted::Point> points;
  Interior_vertices_3<typename Restricted::Point> interior;
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
    if (!is_first[i]) {
      interior.points.push_back(initial.points[i]);
      if (!initial.spacings.empty()) interior.spacings.push_back(initial.spacings[i]);
    }
  return interior;
}

/// Distance of a point from the plane of a restricted facet.
template <class Facet, class Point>
double height_over(const Facet& f, const Point& p)
{
  const auto at = [&f](int i) { return xyz(f.cell->vertex((f.index + i) & 3)->point()); };
  const Xyz_3 a = at(1), n = cross_product(minus(at(2), a), minus(at(3), a));
  const double length = norm(n);
  return length > 0 ? std::abs(dot_product(n, minus(xyz(p), a))) / length : 0;
}

/// Inserts those interior vertices that lie in the domain, as few don't where cells are inverted, and don't end up on
/// the boundary. Otherwise refinement has to surround them with vertices on the surface, as it does where they are well
/// inside by their own spacing.
/// \returns how many were left out.
template <class Restricted>
std::size_t insert_interior(const Interior_vertices_3<typename Restricted::Point>& interior,
                            const Criteria_3<typename Restricted::Kernel>& criteria, Restricted& mesh)
{
  if (interior.points.empty()) return 0; // looking for those that encroach takes long where sizes vary
  constexpr double well_inside = 0.6;
  const double grid = 0.1 * criteria.size(interior.points.front());
  std::vector<char> encroaches(interior.points.size(), false);
  visit_encroaching(mesh, grid, 0, interior.points, [&](std::size_t i, const auto& facet) {
    const double least = interior.spacings.empty() ? HUGE_VAL : well_inside * interior.spacings[i];
    encroaches[i] = encroaches[i] || !(height_over(facet, interior.points[i]) > least);
  });
  std::vector<typename Restricted::Point> inside;
  std::vector<Vertex_location_3> locations;
  for (std::size_t i = 0; i < encroaches.size(); ++i) {
    if (encroaches[i]) continue;
    const int subdomain = mesh.oracle().subdomain(interior.points[i]);
    if (subdomain == 0) continue;
    inside.push_back(interior.points[i]);
    locations.push_back({3, subdomain});
  }
  mesh.insert(inside, locations);
  return interior.points.size() - inside.size();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_INITIAL_VERTICES_3_H
