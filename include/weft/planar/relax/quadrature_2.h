// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mass and first moments of a density over triangles and segments (Tournois 2009, sec. 2.2.2, "Quadratures"): a
// triangle is bisected at its longest edge until it has been cut into the wanted number of parts, on each of which the
// midpoint rule is applied; a segment is integrated by the trapezium rule. The density that belongs to a sizing
// field mu is mu^-4 in the plane and mu^-3 along a constraint, for which spacing is proportional to mu.

#ifndef WEFT_PLANAR_RELAX_QUADRATURE_2_H
#define WEFT_PLANAR_RELAX_QUADRATURE_2_H

#include <array>
#include <cmath>

namespace weft::internal {

/// Integral of a density and of the density times position.
struct Moments_2
{
  double mass = 0, x = 0, y = 0;

  void add(double m, double px, double py)
  {
    mass += m;
    x += m * px;
    y += m * py;
  }
  Moments_2& operator+=(const Moments_2& o)
  {
    mass += o.mass;
    x += o.x;
    y += o.y;
    return *this;
  }
};

using Xy = std::array<double, 2>;

inline Xy middle(const Xy& a, const Xy& b)
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

inline double squared_distance(const Xy& a, const Xy& b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

/// Twice the signed area.
inline double cross(const Xy& a, const Xy& b, const Xy& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Density that makes centroidal Voronoi cells in the plane as large as `size`: size^-4.
inline double planar_density(double size)
{
  return 1 / (size * size * size * size);
}

/// Density along a constraint: size^-3.
inline double linear_density(double size)
{
  return 1 / (size * size * size);
}

/// Moments of a density over a triangle.
/// \param density callable, (x, y) -> density.
/// \param parts number of quadrature triangles. Negatively oriented triangles count negative.
template <class Density>
Moments_2 integrate_triangle(const std::array<double, 2>& a, const std::array<double, 2>& b,
                             const std::array<double, 2>& c, int parts, const Density& density)
{
  Moments_2 result;
  const Xy ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  if (parts <= 1) {
    const double third = cross(a, b, c) / 6;
    for (const Xy& m : {ab, bc, ca}) result.add(third * density(m[0], m[1]), m[0], m[1]);
    return result;
  }
  const double lab = squared_distance(a, b), lbc = squared_distance(b, c), lca = squared_distance(c, a);
  const int first = parts / 2, second = parts - first;
  const auto halves = [&](const Xy& p, const Xy& q, const Xy& r, const Xy& m) { // m is the middle of pq
    result += integrate_triangle(p, m, r, first, density);
    result += integrate_triangle(m, q, r, second, density);
  };
  if (lab >= lbc && lab >= lca)
    halves(a, b, c, ab);
  else if (lbc >= lca)
    halves(b, c, a, bc);
  else
    halves(c, a, b, ca);
  return result;
}

/// Moments of a density over a segment, by the trapezium rule on `parts` pieces.
template <class Density>
Moments_2 integrate_segment(const std::array<double, 2>& a, const std::array<double, 2>& b, int parts,
                            const Density& density)
{
  Moments_2 result;
  const double piece = std::sqrt(squared_distance(a, b)) / parts;
  for (int k = 0; k <= parts; ++k) {
    const double t = static_cast<double>(k) / parts, x = a[0] + t * (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
    result.add((k == 0 || k == parts ? 0.5 : 1.0) * piece * density(x, y), x, y);
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RELAX_QUADRATURE_2_H
