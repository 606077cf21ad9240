// SPDX-License-Identifier: GPL-3.0-or-later
//
// Segments in a bounding volume hierarchy: the nearest point on a chain, and the chains that a convex polygon meets.

#ifndef WEFT_INTERNAL_BOXES_SEGMENT_HIERARCHY_3_H
#define WEFT_INTERNAL_BOXES_SEGMENT_HIERARCHY_3_H

#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/nearest_point_3.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

/// A segment of a crease.
template <class K>
struct Crease_segment_3
{
  typename K::Point_3 source, target;
  int crease;
};

template <class K>
class Segment_hierarchy_3
{
public:
  using Point = typename K::Point_3;
  using Segment = Crease_segment_3<K>;

  Segment_hierarchy_3() = default;

  explicit Segment_hierarchy_3(const std::vector<Segment>& segments)
  {
    std::vector<Box_3> boxes(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (const Point* p : {&segments[i].source, &segments[i].target}) boxes[i].add(p->x(), p->y(), p->z());
    boxes_ = Box_hierarchy_3(boxes);
    segments_ = segments;
  }

  /// Nearest point of the segments, rounded; equally near ones: that of the first segment.
  Point nearest(const Point& p) const
  {
    int crease = 0;
    return nearest(p, crease);
  }

  /// The same, and the crease of its segment, which is left as it is if there are none.
  Point nearest(const Point& p, int& crease) const
  {
    Point best = p;
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t best_item = Box_hierarchy_3::nothing;
    const auto framed = boxes_.frame()(p.x(), p.y(), p.z());
    const std::array<float, 3> from{
        {static_cast<float>(framed[0]), static_cast<float>(framed[1]), static_cast<float>(framed[2])}};
    const double error = (1 + std::max({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])})) * 1e-6;
    boxes_.visit_nearest(from, std::numeric_limits<float>::infinity(), [&](std::uint32_t block, float limit) {
      for (std::uint32_t i = 4 * block; i < 4 * block + 4; ++i) {
        const std::uint32_t item = boxes_.items()[i];
        if (item == Box_hierarchy_3::nothing) break;
        const Point x = nearest_point_on_segment(p, segments_[item].source, segments_[item].target);
        const double d = squared_length(x, p);
        if (d > squared || (d == squared && item > best_item)) continue;
        best = x, squared = d, best_item = item;
      }
      const double padded = std::sqrt(squared) * boxes_.frame().scale * (1 + 1e-6) + error;
      return std::min(limit, static_cast<float>(padded * padded * (1 + 1e-6)));
    });
    if (best_item != Box_hierarchy_3::nothing) crease = segments_[best_item].crease;
    return best;
  }

  /// Calls `add(point, segment)` where a segment crosses the convex polygon in the plane that bisects a and b. Which
  /// side an end lies on is exact, an end on the plane counting as nearer to a; the point and whether it is within the
  /// polygon, its sides included, are rounded as the polygon is.
  template <class Add>
  void cross_polygon(const Point& a, const Point& b, const std::vector<Point>& polygon, const Add& add) const
  {
    if (boxes_.empty() || polygon.size() < 3) return;
    const std::array<double, 3> normal{{b.x() - a.x(), b.y() - a.y(), b.z() - a.z()}};
    const double length = std::sqrt(squared_length(a, b));
    if (!(length > 0)) return;
    const Query query(*this, a, b, polygon, normal, length);
    boxes_.visit_slab(query.low, query.high, query.normal, query.offset, query.width, [&](std::uint32_t block) {
      for (std::uint32_t i = 4 * block; i < 4 * block + 4; ++i) {
        const std::uint32_t item = boxes_.items()[i];
        if (item == Box_hierarchy_3::nothing) break;
        const Segment& segment = segments_[item];
        if (is_beyond(segment.source, a, b) == is_beyond(segment.target, a, b)) continue;
        const Point x = on_bisector(segment, a, b, normal);
        if (is_within(polygon, normal, x)) add(x, segment);
      }
      return false;
    });
  }

private:
  // The polygon's box and the bisecting plane in the frame of the boxes.
  struct Query
  {
    std::array<float, 3> low, high, normal;
    float offset, width;

    Query(const Segment_hierarchy_3& tree, const Point& a, const Point& b, const std::vector<Point>& polygon,
          const std::array<double, 3>& n, double length)
    {
      const Frame_3& frame = tree.boxes_.frame();
      Box_3 box;
      for (const Point& p : polygon) {
        const auto x = frame(p.x(), p.y(), p.z());
        box.add(x[0], x[1], x[2]);
      }
      const auto fa = frame(a.x(), a.y(), a.z()), fb = frame(b.x(), b.y(), b.z());
      double plane = 0, size = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        // Twice 2^-24 and more of the larger coordinate: the polygon's own rounding counts too.
        const double slack = 1e-6 * (1 + std::max(std::abs(box.low[k]), std::abs(box.high[k])));
        low[k] = static_cast<float>(box.low[k] - slack), high[k] = static_cast<float>(box.high[k] + slack);
        normal[k] = static_cast<float>(n[k] / length);
        plane += n[k] / length * (fa[k] + fb[k]) / 2;
        size += std::abs(fa[k]) + std::abs(fb[k]);
      }
      offset = static_cast<float>(plane), width = static_cast<float>(1e-6 * size);
    }
  };

  static double squared_length(const Point& a, const Point& b)
  {
    const double x = b.x() - a.x(), y = b.y() - a.y(), z = b.z() - a.z();
    return x * x + y * y + z * z;
  }

  static Point between(const Segment& s, double t)
  {
    const Point &a = s.source, &b = s.target;
    if (t <= 0) return a;
    if (t >= 1) return b;
    return Point(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()), a.z() + t * (b.z() - a.z()));
  }

  // Exact: nearer to b than to a.
  static bool is_beyond(const Point& x, const Point& a, const Point& b)
  {
    return typename K::Compare_distance_3()(x, b, a) == CGAL::SMALLER;
  }

  static Point on_bisector(const Segment& s, const Point& a, const Point& b, const std::array<double, 3>& normal)
  {
    const auto height = [&](const Point& x) { // above the plane, times |b - a|
      return normal[0] * ((x.x() - a.x()) - (b.x() - x.x())) + normal[1] * ((x.y() - a.y()) - (b.y() - x.y())) +
             normal[2] * ((x.z() - a.z()) - (b.z() - x.z()));
    };
    const double from = height(s.source), to = height(s.target);
    return from == to ? s.source : between(s, from / (from - to));
  }

  static bool is_within(const std::vector<Point>& polygon, const std::array<double, 3>& normal, const Point& x)
  {
    bool left = false, right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
      const double ex = b.x() - a.x(), ey = b.y() - a.y(), ez = b.z() - a.z();
      const double dx = x.x() - a.x(), dy = x.y() - a.y(), dz = x.z() - a.z();
      const double side =
          normal[0] * (ey * dz - ez * dy) + normal[1] * (ez * dx - ex * dz) + normal[2] * (ex * dy - ey * dx);
      left = left || side > 0, right = right || side < 0;
    }
    return !(left && right);
  }

  Box_hierarchy_3 boxes_;
  std::vector<Segment> segments_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_SEGMENT_HIERARCHY_3_H
