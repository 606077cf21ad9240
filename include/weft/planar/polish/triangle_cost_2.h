// SPDX-License-Identifier: GPL-3.0-or-later
//
// What polishing lowers: the cost of a triangle grows as its smallest angle falls and its largest rises, and jumps when
// an edge is too long for the sizing field.

#ifndef WEFT_PLANAR_POLISH_TRIANGLE_COST_2_H
#define WEFT_PLANAR_POLISH_TRIANGLE_COST_2_H

#include <CGAL/number_utils.h>
#include <CGAL/Triangulation_utils_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace weft::internal {

/// What an edge that is too long costs at least.
inline constexpr double oversize_cost_2 = 1e30;

/// What an edge costs for its length alone.
/// \param squared_ratio square of its length over the size.
inline double oversize_2(double squared_ratio)
{
  return squared_ratio > 1 ? oversize_cost_2 * squared_ratio : 0;
}

/// Which angles of the face, from corner i on, lie between constraints.
template <class Face_handle>
std::array<bool, 3> given_angles_2(Face_handle f, int i)
{
  const bool e0 = f->is_constrained(i), e1 = f->is_constrained(CGAL::Triangulation_cw_ccw_2::ccw(i)),
             e2 = f->is_constrained(CGAL::Triangulation_cw_ccw_2::cw(i));
  return {e1 && e2, e2 && e0, e0 && e1};
}

/// 0 while the angles lie within [50, 80] degrees, 1 at 37 or 94 degrees, without bound towards 0 and 180; far more
/// with an edge that is too long.
///
/// \param doubled four times the area.
/// \param opposite squared lengths of the edges opposite the corners.
/// \param given small angles that don't count, from `given_angles_2()`.
/// \param squared_size of the sizing field at the centroid.
inline double triangle_cost_2(double doubled, const std::array<double, 3>& opposite, const std::array<bool, 3>& given,
                              double squared_size)
{
  // Cotangents of 50 and 37 degrees, where a small angle begins to cost and where it costs 1; of 80 and 94 degrees.
  constexpr double cot_small = 0.839, cot_small_limit = 1.327, cot_large = 0.176, cot_large_limit = -0.070;
  if (!(doubled > 0)) return std::numeric_limits<double>::infinity();
  const auto [p2, q2, r2] = opposite;
  // Cotangents times `doubled`, since divisions are slow. Compilers make other forms of this loop into branches that
  // are mispredicted.
  const std::array<double, 3> scaled{q2 + r2 - p2, p2 + r2 - q2, p2 + q2 - r2};
  double highest = cot_small * doubled, lowest = cot_large * doubled; // of the smallest and the largest angle
  for (std::size_t i = 0; i < 3; ++i) {
    if (!given[i]) highest = (std::max)(highest, scaled[i]);
    lowest = (std::min)(lowest, scaled[i]);
  }
  const double small = (highest - cot_small * doubled) * (1 / (cot_small_limit - cot_small)),
               large = (cot_large * doubled - lowest) * (1 / (cot_large - cot_large_limit));
  const double worse = (std::max)(small, large) / doubled, w2 = worse * worse, w4 = w2 * w2, cost = w4 * w4;
  const double longest = (std::max)((std::max)(p2, q2), r2);
  return longest > squared_size ? cost + oversize_2(longest / squared_size) : cost;
}

/// The same of corners and the size at the centroid.
template <class Point>
double triangle_cost_2(const Point& p, const Point& q, const Point& r, const std::array<bool, 3>& given, double size)
{
  const double px = CGAL::to_double(p.x()), py = CGAL::to_double(p.y());
  const double ax = CGAL::to_double(q.x()) - px, ay = CGAL::to_double(q.y()) - py;
  const double bx = CGAL::to_double(r.x()) - px, by = CGAL::to_double(r.y()) - py;
  // squared lengths opposite p, q, r
  return triangle_cost_2(2 * (ax * by - ay * bx),
                         {(bx - ax) * (bx - ax) + (by - ay) * (by - ay), bx * bx + by * by, ax * ax + ay * ay}, given,
                         size * size);
}

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_TRIANGLE_COST_2_H
