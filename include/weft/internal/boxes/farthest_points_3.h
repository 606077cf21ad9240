// SPDX-License-Identifier: GPL-3.0-or-later
//
// Well-spread points on part of a triangle surface, by farthest-point sampling (Gonzalez 1985; Eldar et al. 1997): each
// next point is the candidate farthest from those chosen before.

#ifndef WEFT_INTERNAL_BOXES_FARTHEST_POINTS_3_H
#define WEFT_INTERNAL_BOXES_FARTHEST_POINTS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace weft::internal {

/// A point and the triangle that it was taken from.
template <class Point>
using Candidate = std::pair<Point, std::size_t>;

/// Up to n of the candidates, the first one farthest from their mean; ties: the first candidate. Fewer if there are
/// fewer different points. O(n candidates).
template <class Point>
std::vector<Candidate<Point>> farthest_points(const std::vector<Candidate<Point>>& candidates, std::size_t n)
{
  std::vector<Candidate<Point>> chosen;
  if (candidates.empty()) return chosen;
  const auto squared_distance = [](const Point& p, double x, double y, double z) {
    return (p.x() - x) * (p.x() - x) + (p.y() - y) * (p.y() - y) + (p.z() - z) * (p.z() - z);
  };
  double x = 0, y = 0, z = 0;
  for (const auto& candidate : candidates) {
    const double weight = 1. / static_cast<double>(candidates.size());
    x += weight * candidate.first.x(), y += weight * candidate.first.y(), z += weight * candidate.first.z();
  }
  std::vector<double> distance(candidates.size(), std::numeric_limits<double>::infinity());
  std::size_t farthest = 0;
  double largest = -1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double d = squared_distance(candidates[i].first, x, y, z);
    if (d > largest) largest = d, farthest = i;
  }
  for (largest = 1; chosen.size() < n && largest > 0;) {
    chosen.push_back(candidates[farthest]);
    const Point p = candidates[farthest].first;
    largest = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(candidates[i].first, p.x(), p.y(), p.z()));
      if (distance[i] > largest) largest = distance[i], farthest = i;
    }
  }
  return chosen;
}

/// Centroids of the (k + 1)^2 parts into which lines parallel to its sides cut a triangle.
template <class Point, class Add>
void for_each_centroid(const Point& a, const Point& b, const Point& c, int k, const Add& add)
{
  const auto at = [&](double s, double t) {
    return Point(a.x() + s * (b.x() - a.x()) + t * (c.x() - a.x()), a.y() + s * (b.y() - a.y()) + t * (c.y() - a.y()),
                 a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
  };
  const int parts = k + 1;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      add(at((i + 1. / 3) / parts, (j + 1. / 3) / parts));
      if (i + j + 1 < parts) add(at((i + 2. / 3) / parts, (j + 2. / 3) / parts));
    }
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_FARTHEST_POINTS_3_H
