// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices a crease needs by itself, and where to start. Tournois 2009, sec. 3.2.1.3 starts from the feature
// vertices; refinement then halves what is too long, which takes up to twice as many. Here a crease is cut into equal
// parts at once where that takes fewer of them than halving would.

#ifndef WEFT_SPATIAL_REFINE_CREASE_DIVIDER_3_H
#define WEFT_SPATIAL_REFINE_CREASE_DIVIDER_3_H

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
    const double target = fraction * lengths_.back();
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, target);
    const std::size_t i = static_cast<std::size_t>(next - lengths_.begin());
    const double piece = lengths_[i] - lengths_[i - 1];
    return points_[i - 1] + (piece > 0 ? (target - lengths_[i - 1]) / piece : 0) * (points_[i] - points_[i - 1]);
  }

  /// The number of equal parts to begin with: as few as meet size and approximation, at least `least`; and `least` if
  /// halving those meets them with fewer, where the crease bends in some places only.
  std::size_t parts(std::size_t least) const
  {
    std::size_t halved = 0;
    for (std::size_t k = 0; k < least; ++k) halved += halvings(fraction(k, least), fraction(k + 1, least), 0);
    for (std::size_t n = least; n < halved; n += 1 + n / 32)
      if (fits_evenly(n)) return n;
    return least;
  }

private:
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

  bool fits_evenly(std::size_t n) const
  {
    for (std::size_t k = 0; k < n; ++k)
      if (!fits(fraction(k, n), fraction(k + 1, n))) return false;
    return true;
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
