// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of two or three doubles, for what is the same in both dimensions.

#ifndef WEFT_ENERGY_COORDINATES_H
#define WEFT_ENERGY_COORDINATES_H

#include <array>
#include <cstddef>

namespace weft::internal {

template <std::size_t d>
using Coordinates = std::array<double, d>;

template <std::size_t d>
Coordinates<d> difference(const Coordinates<d>& a, const Coordinates<d>& b)
{
  Coordinates<d> c;
  for (std::size_t k = 0; k < d; ++k) c[k] = a[k] - b[k];
  return c;
}

/// a + f b.
template <std::size_t d>
Coordinates<d> moved(const Coordinates<d>& a, double f, const Coordinates<d>& b)
{
  Coordinates<d> c;
  for (std::size_t k = 0; k < d; ++k) c[k] = a[k] + f * b[k];
  return c;
}

template <std::size_t d>
void add_to(Coordinates<d>& a, double f, const Coordinates<d>& b)
{
  for (std::size_t k = 0; k < d; ++k) a[k] += f * b[k];
}

template <std::size_t d>
double dot(const Coordinates<d>& a, const Coordinates<d>& b)
{
  double sum = 0;
  for (std::size_t k = 0; k < d; ++k) sum += a[k] * b[k];
  return sum;
}

/// Twice the area of the triangle between the origin, a and b, with sign.
inline double cross(const Coordinates<2>& a, const Coordinates<2>& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

inline Coordinates<3> cross(const Coordinates<3>& a, const Coordinates<3>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace weft::internal

#endif // WEFT_ENERGY_COORDINATES_H
