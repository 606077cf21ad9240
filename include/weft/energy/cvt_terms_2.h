// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CVT energy in the plane (Tournois 2009, sec. 2.2.2): the sum over bounded Voronoi cells of the integral of a
// density times the squared distance to the vertex. It is twice continuously differentiable inside (Liu, Wang, Levy,
// Sun, Yan, Lu, Yang 2009), and its gradient is twice the mass of the cell times the way from its centroid to the
// vertex.

#ifndef WEFT_ENERGY_CVT_TERMS_2_H
#define WEFT_ENERGY_CVT_TERMS_2_H

#include <weft/energy/Bounded_cells_2.h>
#include <weft/energy/coordinates.h>
#include <weft/energy/quadrature_rules.h>
#include <weft/energy/Simplices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// The CVT energy and its gradient, for moves that leave the domain as it is: of vertices inside in all directions, of
/// those on straight constraints along them. Linear.
/// \param density callable, `Coordinates<2>` -> positive number.
template <class Density>
Energy_terms<2> cvt_terms(const Simplices<2>& mesh, const Density& density, bool with_weights = false)
{
  Energy_terms<2> result;
  const Bounded_cells_2 cells(mesh);
  std::vector<Moments<2>> moments(mesh.points.size());
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = mesh.simplices[t][i];
      cells.visit_pieces(t, i, [&](const std::array<Coordinates<2>, 3>& p) {
        add_moments<2>(p, cross(difference(p[1], p[0]), difference(p[2], p[0])) / 2, density, mesh.points[v],
                       moments[v]);
      });
      if (!with_weights) continue;
      // Cones over half walls make up the cell: with these weights the diagonal of the Laplacian is that of Lloyd.
      const auto w = mesh.simplices[t][(i + 1) % 3];
      const auto wall = cells.half_wall(t, i);
      const auto way = difference(wall.to, wall.from);
      const double weight = 2 * wall.sense * std::sqrt(dot(way, way) * dot(wall.from, wall.from)) / 2 *
                            density(moved(mesh.points[v], 1, wall.from));
      result.weights.push_back({v, w, weight});
    }
  result.gradient.reserve(moments.size());
  for (const auto& m : moments) {
    result.value += m.second;
    result.gradient.push_back({-2 * m.first[0], -2 * m.first[1]});
    result.diagonal.push_back(2 * m.mass);
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_ENERGY_CVT_TERMS_2_H
