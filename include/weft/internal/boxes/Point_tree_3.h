// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points near a segment: a balanced tree of points, split at medians, in which the segment is clipped on the way
// down. Long segments that are oblique to the axes then meet few leaves.

#ifndef WEFT_INTERNAL_BOXES_POINT_TREE_3_H
#define WEFT_INTERNAL_BOXES_POINT_TREE_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

class Point_tree_3
{
public:
  /// \param points outlive the tree.
  /// \param items indices of those in it.
  Point_tree_3(const std::vector<Xyz_3>& points, std::vector<std::size_t> items)
      : points_(points), items_(std::move(items)), splits_(items_.size())
  {
    build(0, items_.size());
  }

  /// Calls `visit(index)` for the points that are within a distance of the segment pq, in each coordinate of a part of
  /// it, and for some that are farther; in no order.
  template <class Visit>
  void visit_near_segment(const Xyz_3& p, const Xyz_3& q, double distance, const Visit& visit) const
  {
    visit_near_segment(0, items_.size(), p, q, distance, visit);
  }

private:
  static constexpr std::size_t leaf = 8;

  void build(std::size_t begin, std::size_t end)
  {
    if (end - begin <= leaf) return;
    Xyz_3 low = points_[items_[begin]], high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = (std::min)(low[k], points_[items_[i]][k]);
        high[k] = (std::max)(high[k], points_[items_[i]][k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + static_cast<std::ptrdiff_t>(begin),
                     items_.begin() + static_cast<std::ptrdiff_t>(middle),
                     items_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    splits_[middle] = {axis, points_[items_[middle]][axis]};
    build(begin, middle);
    build(middle, end);
  }

  template <class Visit>
  void visit_near_segment(std::size_t begin, std::size_t end, const Xyz_3& p, const Xyz_3& q, double distance,
                          const Visit& visit) const
  {
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i) visit(items_[i]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto& [axis, split] = splits_[middle];
    Xyz_3 a = p, b = q;
    if (clip(a, b, axis, split + distance, 1)) visit_near_segment(begin, middle, a, b, distance, visit);
    a = p, b = q;
    if (clip(a, b, axis, split - distance, -1)) visit_near_segment(middle, end, a, b, distance, visit);
  }

  /// Cuts off what is above a bound, or below for sign -1, but for rounding and some more; whether anything is left.
  static bool clip(Xyz_3& a, Xyz_3& b, std::size_t axis, double bound, int sign)
  {
    const double at_a = sign * (a[axis] - bound), at_b = sign * (b[axis] - bound);
    if (at_a <= 0 && at_b <= 0) return true;
    if (at_a > 0 && at_b > 0) return false;
    Xyz_3& outer = at_a > 0 ? a : b;
    const Xyz_3& inner = at_a > 0 ? b : a;
    const double t = (std::min)(1., -(std::min)(at_a, at_b) / ((std::max)(at_a, at_b) - (std::min)(at_a, at_b)) + 1e-9);
    for (std::size_t k = 0; k < 3; ++k) outer[k] = inner[k] + t * (outer[k] - inner[k]);
    return true;
  }

  const std::vector<Xyz_3>& points_;
  std::vector<std::size_t> items_;
  std::vector<std::pair<std::size_t, double>> splits_; ///< axis and coordinate of each range, at its middle
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_POINT_TREE_3_H
