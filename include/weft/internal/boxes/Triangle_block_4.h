// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four triangles in floats, one operation for all four: which of them a segment or a ray may meet, and how far they are
// at least from a point. Errors of floats are bounded, so what is ruled out here needs no exact test; nearly everything
// is. Coordinates are those of a hierarchy's frame.

#ifndef WEFT_INTERNAL_BOXES_TRIANGLE_BLOCK_4_H
#define WEFT_INTERNAL_BOXES_TRIANGLE_BLOCK_4_H

#include <weft/internal/boxes/Float_4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft::internal {

/// Three values for each of four lanes.
struct Vector_4
{
  Float_4 x, y, z;
};
inline Vector_4 operator-(const Vector_4& a, const Vector_4& b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector_4 operator*(Float_4 t, const Vector_4& a)
{
  return {t * a.x, t * a.y, t * a.z};
}
inline Float_4 dot(const Vector_4& a, const Vector_4& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector_4 cross(const Vector_4& a, const Vector_4& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector_4 same_in_all_lanes(const std::array<float, 3>& v)
{
  return {v[0], v[1], v[2]};
}

/// Four triangles. Lanes that were never set hold NaN, which nothing meets and which is infinitely far away.
struct alignas(16) Triangle_block_4
{
  float corner[3][4], first_edge[3][4], second_edge[3][4]; // A, B - A, C - A
  float reach[4];                                          // largest coordinate of the edges
  float normal[3][4];                                      // of unit length
  float inverse_lengths[3][4];                             // 1 / length^2 of B - A, C - A and C - B
  float doubled_area[4];
  float inradius[4]; // rounded up

  Triangle_block_4()
  {
    std::fill_n(&corner[0][0], sizeof(Triangle_block_4) / sizeof(float), std::numeric_limits<float>::quiet_NaN());
  }

  /// \param a,b,c corners in the frame, rounded from input coordinates by one subtraction.
  void set(std::size_t lane, const std::array<double, 3>& a, const std::array<double, 3>& b,
           const std::array<double, 3>& c)
  {
    std::array<double, 3> u, v, w;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = c[k] - b[k];
      largest = std::max({largest, std::abs(u[k]), std::abs(v[k])});
      corner[k][lane] = static_cast<float>(a[k]);
      first_edge[k][lane] = static_cast<float>(u[k]), second_edge[k][lane] = static_cast<float>(v[k]);
    }
    reach[lane] = static_cast<float>(largest);
    std::array<double, 3> n{{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}};
    const double area = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    doubled_area[lane] = static_cast<float>(area);
    const auto length = [](const std::array<double, 3>& e) {
      return std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    };
    const double perimeter = length(u) + length(v) + length(w);
    inradius[lane] = perimeter > 0 ? static_cast<float>(area / perimeter * (1 + 1e-6)) : 0.f;
    const auto inverse = [](const std::array<double, 3>& e) {
      const double squared = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
      return squared > 1e-30 ? static_cast<float>(1 / squared) : 0.f; // shorter than floats can tell: a point
    };
    inverse_lengths[0][lane] = inverse(u), inverse_lengths[1][lane] = inverse(v), inverse_lengths[2][lane] = inverse(w);
    for (std::size_t k = 0; k < 3; ++k) normal[k][lane] = area > 0 ? static_cast<float>(n[k] / area) : 0.f;
  }

  /// Bit i is set if the segment may meet triangle i. With u = 2^-24 and coordinates of the origin relative to a corner
  /// of at most 2: a determinant is wrong by 48u of the product of its vectors' largest entries, twice that for a
  /// difference of up to 2, and by 12u for the rounding of the origin.
  unsigned segment_candidates(const std::array<float, 3>& origin, const std::array<float, 3>& direction) const
  {
    constexpr float unit = 1.f / (1 << 24), bound = 128 * unit;
    const float longest = std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
    const Vector_4 d = same_in_all_lanes(direction), s = same_in_all_lanes(origin) - load(corner);
    const Vector_4 ab = load(first_edge), ac = load(second_edge);
    const Float_4 reach_4 = Float_4::load(reach);
    const Vector_4 across = cross(d, ac), turned = cross(s, ab);
    const Float_4 whole = dot(ab, across);
    const Float_4 v = dot(s, across), w = dot(d, turned), u = whole - v - w;
    const Float_4 edge_error = Float_4(3 * bound * longest) * reach_4; // u is a difference of three
    const Float_4 smallest = min(u, min(v, w)), largest = max(u, max(v, w));
    const Float_4 at_origin = dot(ac, turned), at_end = at_origin - whole;
    const Float_4 end_error = Float_4(bound * (1 + longest)) * reach_4 * reach_4;
    const Float_4 zero = 0.f;
    const Mask_4 line = (zero - edge_error <= smallest) | (largest <= edge_error);
    const Mask_4 ends = (min(at_origin, at_end) <= end_error) & (zero - end_error <= max(at_origin, at_end));
    return (line & ends).bits();
  }

  /// The same for the line through p along axis k.
  unsigned line_candidates(const std::array<float, 3>& p, std::size_t k) const
  {
    constexpr float unit = 1.f / (1 << 24), bound = 96 * unit;
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Float_4 x = Float_4(p[i]) - Float_4::load(corner[i]), y = Float_4(p[j]) - Float_4::load(corner[j]);
    const Float_4 abx = Float_4::load(first_edge[i]), aby = Float_4::load(first_edge[j]);
    const Float_4 acx = Float_4::load(second_edge[i]), acy = Float_4::load(second_edge[j]);
    const Float_4 v = x * acy - y * acx, w = abx * y - aby * x, u = abx * acy - aby * acx - v - w;
    const Float_4 error = Float_4(bound) * Float_4::load(reach), zero = 0.f;
    return ((zero - error <= min(u, min(v, w))) | (max(u, max(v, w)) <= error)).bits();
  }

  /// Bounds of the squared distances from p, each wrong by about 8u (1 + |p|) before it was squared; NaN in lanes
  /// without a triangle.
  struct Bounds
  {
    Float_4 lower, upper;
  };
  Bounds squared_distances(const std::array<float, 3>& p) const
  {
    const Vector_4 ap = same_in_all_lanes(p) - load(corner), ab = load(first_edge), ac = load(second_edge);
    const Vector_4 bp = ap - ab, bc = ac - ab;
    const Float_4 zero = 0.f, one = 1.f;
    const auto from_edge = [&](const Vector_4& from, const Vector_4& edge, int i) {
      const Float_4 t = min(max(dot(from, edge) * Float_4::load(inverse_lengths[i]), zero), one);
      const Vector_4 rest = from - t * edge;
      return dot(rest, rest);
    };
    const Float_4 edges = min(from_edge(ap, ab, 0), min(from_edge(ap, ac, 1), from_edge(bp, bc, 2)));
    // Over the triangle the plane is nearest. A point beside it by less than the error may count as over it in the
    // lower bound; a needle thinner than the error is hardly told from its plane's strip, but is near its edges.
    const Vector_4 n = load(normal), turned = cross(ap, n);
    const Float_4 w = dot(ab, turned), v = zero - dot(ac, turned), u = Float_4::load(doubled_area) - v - w;
    const Float_4 weight = min(u, min(v, w)), height = dot(n, ap), above = height * height;
    constexpr float unit = 1.f / (1 << 24);
    const float size = 1 + std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    const Float_4 error = Float_4(32 * unit * size) * Float_4::load(reach);
    const Float_4 inner = max(square_root(edges) - Float_4::load(inradius), zero);
    return {select(zero - error <= weight, max(above, inner * inner), edges), select(error <= weight, above, edges)};
  }

private:
  static Vector_4 load(const float (&values)[3][4])
  {
    return {Float_4::load(values[0]), Float_4::load(values[1]), Float_4::load(values[2])};
  }
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_TRIANGLE_BLOCK_4_H
