// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CVT energy in space (Du, Faber, Gunzburger 1999; Tournois 2009, sec. 2.2.2 and 4.2.2). Voronoi cells are taken as
// signed pieces of the tetrahedra: those between a vertex, the midpoint of an edge, and the circumcenters of a facet
// and of the cell. They add up to the domain of the mesh even where a circumcenter lies beyond its boundary, which
// makes the gradient exact everywhere; with all circumcenters inside, the pieces are those of the Voronoi cells in the
// domain.

#ifndef WEFT_ENERGY_CVT_TERMS_3_H
#define WEFT_ENERGY_CVT_TERMS_3_H

#include <weft/energy/coordinates.h>
#include <weft/energy/quadrature_rules.h>
#include <weft/energy/Simplices.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Centers of a tetrahedron and its facets, relative to its first vertex.
struct Tetrahedron_centers_3
{
  using Vector = Coordinates<3>;

  std::array<Vector, 4> corners;
  Vector cell;
  std::array<Vector, 4> facets; ///< opposite to each vertex

  explicit Tetrahedron_centers_3(const std::array<Vector, 4>& p)
  {
    for (std::size_t i = 0; i < 4; ++i) corners[i] = difference(p[i], p[0]);
    const Vector &u = corners[1], &v = corners[2], &w = corners[3];
    const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
    const double f = 0.5 / dot(u, vw);
    for (std::size_t k = 0; k < 3; ++k) cell[k] = f * (dot(u, u) * vw[k] + dot(v, v) * wu[k] + dot(w, w) * uv[k]);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector &a = corners[(i + 1) % 4], &b = corners[(i + 2) % 4], &c = corners[(i + 3) % 4];
      const Vector normal = cross(difference(b, a), difference(c, a));
      const double offset = dot(difference(cell, a), normal) / dot(normal, normal);
      facets[i] = moved(cell, -offset, normal); // the center's projection on the plane
    }
  }

  Vector middle(std::size_t i, std::size_t j) const
  {
    Vector m = corners[i];
    for (std::size_t k = 0; k < 3; ++k) m[k] = (m[k] + corners[j][k]) / 2;
    return m;
  }
};

/// What a facet on the boundary adds to the gradient of its vertices, with which it moves: the integral over it of
/// density times squared distance to the nearest of them, times the normal speed.
/// \param facet counterclockwise seen from outside.
/// \param center its circumcenter.
template <class Density>
void add_boundary_speed(const std::array<Coordinates<3>, 3>& facet, const Coordinates<3>& center,
                        const Density& density, const Coordinates<3>& origin,
                        const std::array<Coordinates<3>*, 3>& gradient)
{
  const auto doubled = cross(difference(facet[1], facet[0]), difference(facet[2], facet[0]));
  const double length2 = dot(doubled, doubled);
  for (std::size_t v = 0; v < 3; ++v)
    for (const std::size_t w : {(v + 1) % 3, (v + 2) % 3}) {
      std::array<Coordinates<3>, 3> piece{facet[v], {}, center};
      for (std::size_t k = 0; k < 3; ++k) piece[1][k] = (facet[v][k] + facet[w][k]) / 2;
      const auto turn = cross(difference(piece[1], piece[0]), difference(piece[2], piece[0]));
      const double share = (w == (v + 1) % 3 ? 1 : -1) * dot(turn, doubled) / length2; // of the facet, with sign
      visit_triangle_points([&](const std::array<double, 3>& b, double weight) {
        const auto x = combine<3>(piece, b);
        const auto way = difference(x, facet[v]);
        const double speed = share * weight * density(moved(origin, 1, x)) * dot(way, way) / 2;
        for (std::size_t i = 0; i < 3; ++i) { // times the barycentric coordinate of vertex i
          const auto part = cross(difference(facet[(i + 1) % 3], x), difference(facet[(i + 2) % 3], x));
          add_to(*gradient[i], speed * dot(part, doubled) / length2, doubled);
        }
      });
    }
}

/// The CVT energy and its gradient, that of boundary vertices included: the domain of the mesh changes with them.
/// Linear.
/// \param density callable, `Coordinates<3>` -> positive number.
/// \pre `neighbors` are set.
template <class Density>
Energy_terms<3> cvt_terms(const Simplices<3>& mesh, const Density& density, bool with_weights = false)
{
  using Vector = Coordinates<3>;
  Energy_terms<3> result;
  std::vector<Moments<3>> moments(mesh.points.size());
  result.gradient.assign(mesh.points.size(), Vector{});
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
    const auto& s = mesh.simplices[t];
    const Vector origin = mesh.points[s[0]];
    const Tetrahedron_centers_3 at({origin, mesh.points[s[1]], mesh.points[s[2]], mesh.points[s[3]]});
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Vector m = at.middle(i, j);
        double volume = 0;
        for (std::size_t f = 0; f < 4; ++f) {
          if (f == i || f == j) continue;
          // Even permutations (i, j, k, f) are positive.
          const std::size_t k = 6 - i - j - f;
          const bool even = ((i > j) + (i > k) + (i > f) + (j > k) + (j > f) + (k > f)) % 2 == 0;
          for (const std::size_t v : {i, j}) {
            const std::array<Vector, 4> piece{Vector{0, 0, 0}, difference(m, at.corners[v]),
                                              difference(at.facets[f], at.corners[v]),
                                              difference(at.cell, at.corners[v])};
            const double signed_volume = (even == (v == i) ? 1 : -1) * dot(piece[1], cross(piece[2], piece[3])) / 6;
            add_moments<3>(piece, signed_volume, density, mesh.points[s[v]], moments[s[v]]);
            volume += signed_volume / 2;
          }
        }
        if (with_weights) result.weights.push_back({s[i], s[j], 2 * volume * density(moved(origin, 1, m))});
      }
    for (std::size_t f = 0; f < 4; ++f) {
      if (mesh.neighbors[t][f] != Simplices<3>::none) continue;
      // Opposite to f, counterclockwise seen from outside.
      std::array<std::size_t, 3> v{(f + 1) % 4, (f + 2) % 4, (f + 3) % 4};
      if (f % 2 == 1) std::swap(v[1], v[2]);
      add_boundary_speed({at.corners[v[0]], at.corners[v[1]], at.corners[v[2]]}, at.facets[f], density, origin,
                         {&result.gradient[s[v[0]]], &result.gradient[s[v[1]]], &result.gradient[s[v[2]]]});
    }
  }
  for (std::size_t v = 0; v < moments.size(); ++v) {
    result.value += moments[v].second;
    add_to(result.gradient[v], -2, moments[v].first);
    result.diagonal.push_back(2 * moments[v].mass);
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_ENERGY_CVT_TERMS_3_H
