// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the facets that have to stay allow: no mesh with them has larger smallest dihedral angles.

#ifndef WEFT_SPATIAL_LOCAL_FIXED_FACETS_BOUND_3_H
#define WEFT_SPATIAL_LOCAL_FIXED_FACETS_BOUND_3_H

#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/star_optimiser_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// The largest smallest dihedral angle that a cell on a facet can have, as a quality: the best of local optima that
/// apexes all around lead to.
template <class K>
double best_quality_on_facet(const std::array<typename K::Point_3, 3>& f)
{
  using Optimiser = Star_optimiser_3<K>;
  const std::vector<typename Optimiser::Facet> star = {f};
  const auto normal = CGAL::normal(f[0], f[1], f[2]);
  const double area = std::sqrt(CGAL::to_double(normal.squared_length()));
  if (!(area > 0)) return 0;
  std::vector<std::pair<double, typename K::Point_3>> starts;
  for (int i = -2; i <= 6; ++i)
    for (int j = -2; i + j <= 6; ++j)
      for (const double height : {0.15, 0.4, 0.8, 1.6, 4.0}) {
        const auto apex = f[0] + i / 4. * (f[1] - f[0]) + j / 4. * (f[2] - f[0]) - height / std::sqrt(area) * normal;
        starts.emplace_back(-Optimiser::quality(apex, star), apex);
      }
  std::sort(starts.begin(), starts.end());
  double best = 0;
  Optimiser optimiser;
  for (std::size_t k = 0; k < 6; ++k) {
    auto apex = starts[k].second;
    for (int round = 0; round < 4; ++round) best = (std::max)(best, optimiser.optimise(apex, star));
  }
  return best;
}

/// The angle that the cells from facet i of a cell on, around its edge ab, fill up to the next facet that has to stay.
template <class K>
double angle_to_next_fixed_facet(const Editable_mesh_3<K>& mesh, int c, int i, int a, int b)
{
  const auto f = mesh.facet(c, i);
  int u = f[0] + f[1] + f[2] - a - b, w = mesh.cell(c).vertices[static_cast<std::size_t>(i)];
  double sum = 0;
  while (sum < 360) {
    sum += std::abs(
        CGAL::to_double(CGAL::approximate_dihedral_angle(mesh.point(a), mesh.point(b), mesh.point(u), mesh.point(w))));
    const int next = mesh.neighbour(c, mesh.index(c, u));
    if (next == Editable_mesh_3<K>::none) break;
    u = w;
    w = mesh.other_vertex(next, a, b, u);
    c = next;
  }
  return sum;
}

/// What facets that have to stay allow, in degrees: the least angle between two of them, and of the largest smallest
/// dihedral angles that cells on them can have. No mesh with these facets is better, up to how well those optima are
/// found; it may be that none is as good. Cells are looked for on the facets with the smallest angles only.
template <class K>
double fixed_facets_bound_3(const Editable_mesh_3<K>& mesh)
{
  using Mesh = Editable_mesh_3<K>;
  using Facet = std::array<typename K::Point_3, 3>;
  std::vector<std::pair<double, Facet>> facets;
  double bound = 180;
  for (int c = 0; c < mesh.number_of_cells(); ++c)
    for (int i = 0; i < 4 && mesh.cell(c).is_alive; ++i) {
      if (mesh.neighbour(c, i) != Mesh::none) continue;
      const auto v = mesh.facet(c, i);
      const Facet f = {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])};
      double smallest = 180;
      for (std::size_t k = 0; k < 3; ++k) {
        smallest = (std::min)(smallest, CGAL::approximate_angle(f[(k + 1) % 3], f[k], f[(k + 2) % 3]));
        bound = (std::min)(bound, angle_to_next_fixed_facet(mesh, c, i, v[k], v[(k + 1) % 3]));
      }
      facets.emplace_back(smallest, f);
    }
  constexpr std::size_t most = 100;
  const std::size_t n = (std::min)(most, facets.size());
  std::partial_sort(facets.begin(), facets.begin() + static_cast<std::ptrdiff_t>(n), facets.end());
  for (std::size_t k = 0; k < n; ++k)
    bound = (std::min)(bound, angle_of_quality_3(best_quality_on_facet<K>(facets[k].second)));
  return bound;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_FIXED_FACETS_BOUND_3_H
