// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths, angles and ratios of one triangle, none of which over- or underflows before its result does.

#ifndef WEFT_PLANAR_MESH_SCALED_TRIANGLE_2_H
#define WEFT_PLANAR_MESH_SCALED_TRIANGLE_2_H

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft::internal {

inline double degrees(double radians)
{
  return radians * (180 / 3.14159265358979323846);
}

using Xy_2 = std::array<double, 2>;

template <class Point>
Xy_2 xy(const Point& p)
{
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y())};
}

/// Length of a vector, without over- or underflow, and otherwise the same bits as from the plain formula.
inline double edge_length(double dx, double dy)
{
  int exponent = 0;
  std::frexp((std::max)(std::abs(dx), std::abs(dy)), &exponent);
  dx = std::ldexp(dx, -exponent);
  dy = std::ldexp(dy, -exponent);
  return std::ldexp(std::sqrt(dx * dx + dy * dy), exponent);
}

template <class Point>
Point edge_middle(const Xy_2& a, const Xy_2& b)
{
  return Point((a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
}

/// A triangle in units of a power of two of about its size, so that scaling is exact and products stay in range.
struct Scaled_triangle_2
{
  std::array<Xy_2, 3> corner;   ///< unscaled
  std::array<double, 3> dx, dy; ///< edge i is opposite to corner i and goes counterclockwise
  std::array<double, 3> length;
  double twice_area; ///< signed
  int exponent = 0;  ///< lengths are to be multiplied by 2^exponent

  template <class Face_handle>
  explicit Scaled_triangle_2(Face_handle face)
      : Scaled_triangle_2(std::array<Xy_2, 3>{xy(face->vertex(0)->point()), xy(face->vertex(1)->point()),
                                              xy(face->vertex(2)->point())})
  {}

  explicit Scaled_triangle_2(const std::array<Xy_2, 3>& corners) : corner(corners)
  {
    double extent = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &from = corner[(i + 1) % 3], &to = corner[(i + 2) % 3];
      dx[i] = to[0] - from[0];
      dy[i] = to[1] - from[1];
      extent = (std::max)({extent, std::abs(dx[i]), std::abs(dy[i])});
    }
    std::frexp(extent, &exponent);
    for (std::size_t i = 0; i < 3; ++i) {
      dx[i] = std::ldexp(dx[i], -exponent);
      dy[i] = std::ldexp(dy[i], -exponent);
      length[i] = std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]);
    }
    twice_area = dy[2] * dx[1] - dx[2] * dy[1];
  }

  double unscaled(double scaled_length) const { return std::ldexp(scaled_length, exponent); }
  double longest() const { return *std::max_element(length.begin(), length.end()); }
  double shortest() const { return *std::min_element(length.begin(), length.end()); }
  double area() const { return std::ldexp(twice_area, 2 * exponent - 1); }
  double angle(std::size_t i) const
  {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    return degrees(std::atan2(std::abs(twice_area), -(dx[j] * dx[k] + dy[j] * dy[k])));
  }
  double aspect_ratio() const { return length[0] * length[1] * length[2] / (2 * std::abs(twice_area) * shortest()); }
  double radius_ratio() const
  {
    const double perimeter = length[0] + length[1] + length[2];
    return 4 * twice_area * twice_area / (perimeter * length[0] * length[1] * length[2]);
  }
};

} // namespace weft::internal

#endif // WEFT_PLANAR_MESH_SCALED_TRIANGLE_2_H
