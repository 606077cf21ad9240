// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is nearly in contact in a planar straight line graph: points closer to each other than a tolerance, which a
// hashed grid finds, and points within it of a segment, among candidates from CGAL's intersection of boxes. Distances
// are computed in floating point, as a tolerance allows.

#ifndef WEFT_PLANAR_GRAPH_PSLG_NEAR_CONTACTS_H
#define WEFT_PLANAR_GRAPH_PSLG_NEAR_CONTACTS_H

#include <weft/planar/graph/segment_contacts.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <unordered_map>
#include <vector>

namespace weft::internal {

/// Points that keep a distance from each other, in a hashed grid whose cells are that wide. Adding one takes constant
/// time, since only a few of them fit into a cell.
template <class K>
class Spaced_points_2
{
public:
  using Point = typename K::Point_2;

  explicit Spaced_points_2(double distance) : distance_(distance) {}

  /// Adds a point with the index `fresh`, unless the nearest of those there is no farther than the distance.
  /// \returns the index of the point that stands for it.
  std::size_t add(const Point& point, std::size_t fresh)
  {
    const Entry entry{CGAL::to_double(point.x()), CGAL::to_double(point.y()), fresh};
    const Cell cell{std::floor(entry.x / distance_), std::floor(entry.y / distance_)};
    const Entry* nearest = nullptr;
    double least = distance_;
    for (const double dx : {-1., 0., 1.})
      for (const double dy : {-1., 0., 1.}) {
        const auto found = cells_.find({cell[0] + dx, cell[1] + dy});
        if (found == cells_.end()) continue;
        for (const Entry& other : found->second) {
          const double d = std::hypot(other.x - entry.x, other.y - entry.y);
          if (d > least || (nearest != nullptr && d == least && other.index > nearest->index)) continue;
          least = d;
          nearest = &other;
        }
      }
    if (nearest != nullptr) return nearest->index;
    cells_[cell].push_back(entry);
    return fresh;
  }

private:
  struct Entry
  {
    double x, y;
    std::size_t index;
  };
  using Cell = std::array<double, 2>; // whole numbers, which may be too large for integers
  struct Hash
  {
    std::size_t operator()(const Cell& cell) const
    {
      const std::hash<double> hash;
      return hash(cell[0]) * 31 + hash(cell[1]);
    }
  };

  std::unordered_map<Cell, std::vector<Entry>, Hash> cells_;
  double distance_;
};

/// Distance of p from the segment ab where splitting ab at p makes two shorter pieces; otherwise infinite.
template <class Point>
double distance_if_between(const Point& a, const Point& b, const Point& p)
{
  const auto x = [](const Point& q) { return CGAL::to_double(q.x()); };
  const auto y = [](const Point& q) { return CGAL::to_double(q.y()); };
  const double dx = x(b) - x(a), dy = y(b) - y(a), length = std::hypot(dx, dy), ux = dx / length, uy = dy / length,
               px = x(p) - x(a), py = y(p) - y(a), along = px * ux + py * uy;
  const bool between =
      0 < along && along < length && std::hypot(px, py) < length && std::hypot(x(p) - x(b), y(p) - y(b)) < length;
  return between ? std::abs(px * uy - py * ux) : std::numeric_limits<double>::infinity();
}

/// Pairs (segment, point) with the point between the ends of the segment and within the tolerance of it, or exactly on
/// it; sorted. O(n log² n) time and the number of pairs whose boxes meet.
template <class K>
std::vector<Index_pair> points_near_segments(const std::vector<typename K::Point_2>& points,
                                             const std::vector<Index_pair>& segments, double tolerance)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  std::vector<Box> point_boxes, segment_boxes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CGAL::Bbox_2 b = points[i].bbox();
    point_boxes.emplace_back(
        CGAL::Bbox_2(b.xmin() - tolerance, b.ymin() - tolerance, b.xmax() + tolerance, b.ymax() + tolerance), i);
  }
  for (std::size_t i = 0; i < segments.size(); ++i)
    segment_boxes.emplace_back(points[segments[i][0]].bbox() + points[segments[i][1]].bbox(), i);

  const Segment_predicates<K> predicates(points, segments);
  std::vector<Index_pair> pairs;
  CGAL::box_intersection_d(segment_boxes.begin(), segment_boxes.end(), point_boxes.begin(), point_boxes.end(),
                           [&](const Box& a, const Box& b) {
                             const std::size_t s = a.info(), p = b.info();
                             const auto [from, to] = segments[s];
                             if (p == from || p == to) return;
                             if (distance_if_between(points[from], points[to], points[p]) <= tolerance ||
                                 predicates.in_interior(s, p))
                               pairs.push_back({s, p});
                           });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Smallest distance of a vertex from the line through the opposite edge of a finite face. Where the triangulation has
/// all segments as edges, no point is nearer to another or to a segment: the way there leaves the first face that it
/// passes through the opposite edge. Linear time.
template <class Cdt>
double smallest_altitude(const Cdt& cdt)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto face : cdt.finite_face_handles()) {
    std::array<double, 3> x{}, y{};
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = CGAL::to_double(face->vertex(static_cast<int>(i))->point().x());
      y[i] = CGAL::to_double(face->vertex(static_cast<int>(i))->point().y());
    }
    const double ux = x[1] - x[0], uy = y[1] - y[0], vx = x[2] - x[0], vy = y[2] - y[0];
    const double longest =
        std::sqrt((std::max)({ux * ux + uy * uy, vx * vx + vy * vy, (vx - ux) * (vx - ux) + (vy - uy) * (vy - uy)}));
    smallest = (std::min)(smallest, std::abs((ux / longest) * vy - (uy / longest) * vx));
  }
  return smallest;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_GRAPH_PSLG_NEAR_CONTACTS_H
