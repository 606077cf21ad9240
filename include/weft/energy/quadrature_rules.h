// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadrature rules that are exact for polynomials of the fifth degree: Radon's seven points of a triangle (1948), and
// Walkington's fourteen of a tetrahedron ("Quadrature on simplices of arbitrary dimension", 2000).

#ifndef WEFT_ENERGY_QUADRATURE_RULES_H
#define WEFT_ENERGY_QUADRATURE_RULES_H

#include <weft/energy/coordinates.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace weft::internal {

/// Calls visit(barycentric coordinates, weight) at the points of a triangle; weights add up to 1.
template <class Visit>
void visit_triangle_points(const Visit& visit)
{
  static const double root = std::sqrt(15.0), near = (6 - root) / 21, far = (6 + root) / 21;
  visit(std::array<double, 3>{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 40);
  for (const auto& [a, w] : {std::array<double, 2>{near, (155 - root) / 1200}, {far, (155 + root) / 1200}})
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<double, 3> b{a, a, a};
      b[i] = 1 - 2 * a;
      visit(b, w);
    }
}

/// The same of a tetrahedron.
template <class Visit>
void visit_tetrahedron_points(const Visit& visit)
{
  constexpr std::array<std::array<double, 2>, 2> corners{
      {{0.31088591926330060980, 0.11268792571801585080}, {0.092735250310891226402, 0.073493043116361949544}}};
  constexpr double edge = 0.045503704125649649492, edge_weight = 0.042546020777081466438;
  for (const auto& [a, w] : corners)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> b{a, a, a, a};
      b[i] = 1 - 3 * a;
      visit(b, w);
    }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      std::array<double, 4> b{edge, edge, edge, edge};
      b[i] = b[j] = 0.5 - edge;
      visit(b, edge_weight);
    }
}

/// The point with such barycentric coordinates.
template <std::size_t d, std::size_t n>
Coordinates<d> combine(const std::array<Coordinates<d>, n>& corners, const std::array<double, n>& coordinates)
{
  Coordinates<d> x{};
  for (std::size_t i = 0; i < n; ++i) add_to(x, coordinates[i], corners[i]);
  return x;
}

/// The density 1, whose integrals have closed forms.
struct Constant_density
{
  template <std::size_t d>
  double operator()(const Coordinates<d>&) const
  {
    return 1;
  }
};

/// Mass, first moment and second moment of a density about the origin.
template <std::size_t d>
struct Moments
{
  double mass = 0, second = 0;
  Coordinates<d> first{};

  void add(double m, const Coordinates<d>& x)
  {
    mass += m;
    add_to(first, m, x);
    second += m * dot(x, x);
  }
};

/// Adds those of a simplex with a given measure, which may be negative.
/// \param origin of the coordinates of the corners, for the density.
template <std::size_t d, class Density>
void add_moments(const std::array<Coordinates<d>, d + 1>& corners, double measure, const Density& density,
                 const Coordinates<d>& origin, Moments<d>& moments)
{
  const auto add = [&](const auto& coordinates, double weight) {
    const auto x = combine<d>(corners, coordinates);
    moments.add(measure * weight * density(moved(origin, 1, x)), x);
  };
  if constexpr (d == 2)
    visit_triangle_points(add);
  else
    visit_tetrahedron_points(add);
}

template <std::size_t d>
void add_moments(const std::array<Coordinates<d>, d + 1>& corners, double measure, const Constant_density&,
                 const Coordinates<d>&, Moments<d>& moments)
{
  Coordinates<d> sum{};
  double squares = 0;
  for (const auto& c : corners) {
    add_to(sum, 1, c);
    squares += dot(c, c);
  }
  moments.mass += measure;
  add_to(moments.first, measure / (d + 1), sum);
  moments.second += measure / ((d + 1.0) * (d + 2)) * (squares + dot(sum, sum));
}

} // namespace weft::internal

#endif // WEFT_ENERGY_QUADRATURE_RULES_H
