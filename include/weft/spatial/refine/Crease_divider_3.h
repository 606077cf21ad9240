// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices a crease needs by itself, and where to start. Tournois 2009, sec. 3.2.1.3 starts from the feature
// vertices; refinement then halves what is too long, which takes up to twice as many. Here a crease is cut into equal
// parts at once where that takes fewer of them than halving would.

#ifndef WEFT_SPATIAL_REFINE_CREASE_DIVIDER_3_H
#define WEFT_SPATIAL_REFINE_CREASE_DIVIDER_3_H

#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/spatial/criteria/Criteria_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// A crease by arc length.
/// \tparam K a CGAL kernel.
template <class K>
class Crease_divider_3
{
public:
  using Point = typename K::Point_3;

  /// All have to live as long as this object.
  /// \param points of the polyline; that of a cycle repeats the first at its end.
  /// \param patches that meet there, and may have bounds of their own.
  Crease_divider_3(const std::vector<Point>& points, const Criteria_3<K>& criteria, const std::vector<int>& patches)
      : points_(points), criteria_(criteria), patches_(patches), lengths_(1, 0)
  {
    for (std::size_t i = 1; i < points.size(); ++i)
      lengths_.push_back(lengths_.back() + length(points[i - 1], points[i]));
  }

  /// The point at a fraction of the length.
  Point at(double fraction) const
  {
    if (fraction > 1) fraction -= 1; // of a cycle
    const double target = fraction * lengths_.back();
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, target);
    const std::size_t i = static_cast<std::size_t>(next - lengths_.begin());
    const double piece = lengths_[i] - lengths_[i - 1];
    return points_[i - 1] + (piece > 0 ? (target - lengths_[i - 1]) / piece : 0) * (points_[i] - points_[i - 1]);
  }

  /// The number of equal parts to begin with: as few as meet size and approximation, at least `least`; and `least` if
  /// halving those meets them with fewer, where the crease bends in some places only.
  std::size_t parts(std::size_t least) const { return parts(0, 1, least); }

  double length() const { return lengths_.back(); }
  bool is_loop() const { return points_.front() == points_.back(); }

  /// Where to begin if there are vertices on the crease: fractions of its length, none of them an end but 0 for a
  /// cycle.
  /// \param least number of parts of the whole.
  /// \param is_closed whether it is a cycle without a feature vertex.
  std::vector<double> fractions(std::size_t least, bool is_closed, const std::vector<Point>& vertices) const
  {
    std::vector<double> result;
    std::vector<double> ends;
    for (const Point& p : vertices) ends.push_back(fraction_of(p));
    std::sort(ends.begin(), ends.end());
    if (ends.empty() || !is_closed) {
      ends.insert(ends.begin(), 0);
      ends.push_back(1);
      if (is_closed) result.push_back(0);
    } else {
      ends.push_back(ends.front() + 1);
    }
    const std::size_t in_each = (least + ends.size() - 2) / (ends.size() - 1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const std::size_t n = parts(ends[i], ends[i + 1], in_each);
      for (std::size_t k = 1; k < n; ++k) {
        const double f = ends[i] + fraction(k, n) * (ends[i + 1] - ends[i]);
        result.push_back(f < 1 ? f : f - 1);
      }
    }
    return result;
  }

private:
  /// Of the nearest point.
  double fraction_of(const Point& p) const
  {
    double nearest = HUGE_VAL, found = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Point x = nearest_point_on_segment(p, points_[i - 1], points_[i]);
      const double d = length(p, x);
      if (d >= nearest) continue;
      nearest = d;
      found = lengths_[i - 1] + length(points_[i - 1], x);
    }
    return found / lengths_.back();
  }

  static double length(const Point& p, const Point& q)
  {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q)));
  }

  static double fraction(std::size_t k, std::size_t n) { return static_cast<double>(k) / static_cast<double>(n); }

  /// Whether the edge between two fractions meets the criteria.
  bool fits(double from, double to) const
  {
    const Point a = at(from), b = at(to), middle = CGAL::midpoint(a, b), on_crease = at(0.5 * (from + to));
    double size = criteria_.size.is_constant() ? criteria_.size.constant() : criteria_.size(middle);
    if (criteria_.crease_size) size = (std::min)(size, criteria_.crease_size(middle));
    if (length(a, b) > size) return false;
    const double everywhere = criteria_.approximation ? criteria_.approximation(on_crease) : 0,
                 bound = criteria_.least_own_approximation(patches_, on_crease, everywhere);
    return bound == 0 || length(middle, on_crease) <= bound;
  }

  /// The same for the part between two fractions.
  std::size_t parts(double from, double to, std::size_t least) const
  {
    const auto part = [&](std::size_t k, std::size_t n) { return k == n ? to : from + fraction(k, n) * (to - from); };
    const auto fits_evenly = [&](std::size_t n) {
      for (std::size_t k = 0; k < n; ++k)
        if (!fits(part(k, n), part(k + 1, n))) return false;
      return true;
    };
    std::size_t halved = 0;
    for (std::size_t k = 0; k < least; ++k) halved += halvings(part(k, least), part(k + 1, least), 0);
    for (std::size_t n = least; n < halved; n += 1 + n / 32)
      if (fits_evenly(n)) return n;
    return least;
  }

  /// Number of parts that meet the criteria, by halving.
  std::size_t halvings(double from, double to, int depth) const
  {
    if (depth == deepest || fits(from, to)) return 1;
    const double middle = 0.5 * (from + to);
    return halvings(from, middle, depth + 1) + halvings(middle, to, depth + 1);
  }

  static constexpr int deepest = 12; // 4096 parts: more needn't be told apart

  const std::vector<Point>& points_;
  const Criteria_3<K>& criteria_;
  const std::vector<int>& patches_;
  std::vector<double> lengths_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_CREASE_DIVIDER_3_H
