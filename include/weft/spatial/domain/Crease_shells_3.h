// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases that meet at a small angle are divided at equal distances from where they meet (Ruppert's concentric shells,
// see Tournois 2009, sec. 4.2.1.1, on spheres; "acutely adjacent segments" of Rand and Walkington, 2009).

#ifndef WEFT_SPATIAL_DOMAIN_CREASE_SHELLS_3_H
#define WEFT_SPATIAL_DOMAIN_CREASE_SHELLS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// The creases that meet other creases at small angles.
/// \tparam K a CGAL kernel.
template <class K>
class Crease_shells_3
{
public:
  using Point = typename K::Point_3;

  Crease_shells_3() = default;

  /// O(n log n) for n crease vertices, and quadratic in the number of creases at a feature vertex.
  /// \param largest_angle between creases, in radians; `largest_at(vertex)` has another for a feature vertex.
  template <class Largest>
  Crease_shells_3(const Piecewise_smooth_complex_3<K>& complex, const Largest& largest_at)
  {
    struct End
    {
      std::size_t vertex, crease;
      bool is_last;
      Xyz_3 away;
    };
    std::vector<End> ends;
    for (std::size_t c = 0; c < complex.creases.size(); ++c) {
      const auto& v = complex.creases[c].vertices;
      if (complex.creases[c].closed || v.size() < 2) continue;
      const auto direction = [&](std::size_t a, std::size_t b) {
        return minus(xyz(complex.points[b]), xyz(complex.points[a]));
      };
      ends.push_back({v.front(), c, false, direction(v[0], v[1])});
      ends.push_back({v.back(), c, true, direction(v[v.size() - 1], v[v.size() - 2])});
    }
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.vertex < b.vertex; });
    for (std::size_t first = 0; first < ends.size();) {
      std::size_t last = first;
      while (last < ends.size() && ends[last].vertex == ends[first].vertex) ++last;
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t j = first; j < last; ++j) {
          if (i == j) continue;
          const double angle =
              std::atan2(norm(cross_product(ends[i].away, ends[j].away)), dot_product(ends[i].away, ends[j].away));
          if (!(angle < largest_at(ends[i].vertex))) continue;
          pairs_.resize(complex.creases.size());
          pairs_[ends[i].crease].push_back(
              {static_cast<int>(ends[j].crease), ends[j].is_last, complex.points[ends[i].vertex], angle});
        }
      first = last;
    }
  }

  bool empty() const { return pairs_.empty(); }

  /// Calls `visit(image, crease)` for the points of other creases that are as far from a feature vertex as a point of a
  /// crease that meets them there, and nearer to it than `spacing`. Where two creases meet at both ends, the nearer end
  /// counts.
  /// \param points_of `points_of(crease)` has the points of a crease in order.
  template <class Points_of, class Visit>
  void visit_images(const Point& p, int crease, double spacing, const Points_of& points_of, const Visit& visit) const
  {
    if (pairs_.empty()) return;
    const auto& pairs = pairs_[static_cast<std::size_t>(crease)];
    for (const Pair& pair : pairs) {
      const double radius = distance(p, pair.apex);
      if (std::any_of(pairs.begin(), pairs.end(), [&](const Pair& other) {
            return other.crease == pair.crease && distance(p, other.apex) < radius;
          }))
        continue;
      Point image = p;
      if (!find_on(points_of(pair.crease), pair.from_last, pair.apex, radius, image)) continue;
      const double apart = distance(p, image);
      if (apart < spacing && apart < radius) visit(image, pair.crease);
    }
  }

  /// Calls `visit(other crease, angle in radians)` for the creases that meet one at a small angle.
  template <class Visit>
  void visit_neighbours(int crease, const Visit& visit) const
  {
    if (pairs_.empty()) return;
    for (const Pair& pair : pairs_[static_cast<std::size_t>(crease)]) visit(pair.crease, pair.angle);
  }

private:
  struct Pair
  {
    int crease;
    bool from_last; ///< whether the other crease leaves the apex at its last point
    Point apex;
    double angle; ///< radians
  };

  static double distance(const Point& p, const Point& q) { return norm(minus(xyz(p), xyz(q))); }

  /// The first point of a polyline at a distance from its beginning.
  static bool find_on(const std::vector<Point>& points, bool from_last, const Point& apex, double radius, Point& found)
  {
    const std::size_t n = points.size();
    const auto at = [&](std::size_t i) -> const Point& { return from_last ? points[n - 1 - i] : points[i]; };
    for (std::size_t i = 0; i + 1 < n; ++i) {
      if (distance(at(i + 1), apex) < radius) continue;
      const Xyz_3 from = minus(xyz(at(i)), xyz(apex)), step = minus(xyz(at(i + 1)), xyz(at(i)));
      // |from + t step| = radius
      const double a = dot_product(step, step), b = dot_product(from, step),
                   c = dot_product(from, from) - radius * radius;
      const double root = std::sqrt((std::max)(0.0, b * b - a * c));
      const double t = b > 0 ? -c / (b + root) : (root - b) / a;
      if (!(t > 0 && t < 1)) return false;
      const Point& p = at(i);
      found = Point(p.x() + t * step[0], p.y() + t * step[1], p.z() + t * step[2]);
      return true;
    }
    return false;
  }

  std::vector<std::vector<Pair>> pairs_; ///< by crease; empty if there are none
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_CREASE_SHELLS_3_H
