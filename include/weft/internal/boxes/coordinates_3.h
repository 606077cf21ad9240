// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates of points of space as doubles, for measures and writers, which don't need more.

#ifndef WEFT_INTERNAL_BOXES_COORDINATES_3_H
#define WEFT_INTERNAL_BOXES_COORDINATES_3_H

#include <CGAL/number_utils.h>

#include <array>
#include <cmath>

namespace weft::internal {

/// A point or vector. A type of its own, so that what follows is meant for nothing else.
struct Xyz_3 : std::array<double, 3>
{};

template <class Point>
Xyz_3 xyz(const Point& p)
{
  return {{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}};
}

inline Xyz_3 minus(const Xyz_3& a, const Xyz_3& b)
{
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}

inline double dot_product(const Xyz_3& a, const Xyz_3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Xyz_3 cross_product(const Xyz_3& a, const Xyz_3& b)
{
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

inline double norm(const Xyz_3& a)
{
  return std::sqrt(dot_product(a, a));
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_COORDINATES_3_H
