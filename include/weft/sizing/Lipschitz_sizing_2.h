// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest k-Lipschitz field below sizes that are given at sources:
//   mu(x) = min(max_size, max(min_size, inf_s [k d(s, x) + h(s)])),
// Alliez, Cohen-Steiner, Yvinec and Desbrun, "Variational tetrahedral meshing" (2005); Tournois 2009, sec. 2.4. Sources
// are points, or segments along which the size h is linear. On a segment the infimum has a closed form, so a long
// segment costs as much as a point. The sources lie in a box tree that is searched by branch and bound.

#ifndef WEFT_SIZING_LIPSCHITZ_SIZING_2_H
#define WEFT_SIZING_LIPSCHITZ_SIZING_2_H

#include <weft/errors.h>
#include <weft/internal/boxes/Box_tree_2.h>
#include <weft/internal/cold.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft {

/// Sizing field that grows by at most k per unit of distance from its sources. Safe to read from many threads.
/// \tparam K a CGAL kernel whose numbers convert to double; the field computes with doubles.
template <class K>
class Lipschitz_sizing_2
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_2;

  /// A segment along which the size goes linearly from one end to the other; a point when the ends coincide.
  struct Source
  {
    Point source, target;
    double source_size, target_size;
  };

  /// Point sources.
  /// \param sizes one edge length per point, in the units of the points.
  /// \param k growth of the size per unit of distance, >= 0. With 0 the field is the smallest size everywhere.
  /// \param min_size,max_size the field's range; 0 and infinity for none.
  /// \throws Option_error for a NaN or a negative number, min_size > max_size, a field that would be 0 or infinite
  /// somewhere, or when points and sizes differ in number.
  Lipschitz_sizing_2(const std::vector<Point>& points, const std::vector<double>& sizes, double k, double min_size = 0,
                     double max_size = std::numeric_limits<double>::infinity())
      : Lipschitz_sizing_2(point_sources(points, sizes), k, min_size, max_size)
  {}

  /// Point and segment sources; parameters as above. O(n log n).
  Lipschitz_sizing_2(const std::vector<Source>& sources, double k, double min_size = 0,
                     double max_size = std::numeric_limits<double>::infinity())
      : k_(k), min_size_(min_size), max_size_(max_size)
  {
    check_range(k, min_size, max_size);
    for (const Source& s : sources) check_source(s);
    double largest = 0;
    for (const Source& s : sources)
      for (const Point& p : {s.source, s.target})
        largest = std::max({largest, std::abs(CGAL::to_double(p.x())), std::abs(CGAL::to_double(p.y()))});
    scale_ = internal::unit_scale(largest);

    std::vector<Piece> pieces;
    pieces.reserve(sources.size());
    for (const Source& s : sources) {
      const Piece p = piece(s);
      if (p.low() < scale_ * max_size_) pieces.push_back(p);
    }
    if (pieces.empty() && !std::isfinite(max_size_))
      throw Option_error("Lipschitz_sizing_2: without sources the largest size must be finite");
    plant(std::move(pieces));
    drop_dominated();
  }

  /// Target edge length at `x`: exact up to rounding. O(log n) for sources that don't lie all equally near.
  FT operator()(const Point& x) const
  {
    return FT(value(x, [](const internal::Box_2&) {}));
  }

  /// The smaller of the field at `x` and `limit`, up to rounding. Far faster where the limit is the smaller one: then
  /// hardly any source is looked at.
  FT below(const Point& x, const FT& limit) const
  {
    const double l = CGAL::to_double(limit);
    const double size = value(
        x, [](const internal::Box_2&) {}, l);
    return size < l ? FT(size) : limit;
  }

  double k() const { return k_; }
  double min_size() const { return min_size_; }
  double max_size() const { return max_size_; }
  /// Sources that can be the nearest one somewhere; the rest isn't kept.
  std::size_t number_of_sources() const { return pieces_.size(); }
  /// Boxes that an evaluation at `x` looks at: what the cost grows with.
  std::size_t visited_nodes(const Point& x) const
  {
    std::size_t n = 0;
    value(x, [&](const internal::Box_2&) { ++n; });
    return n;
  }

  /// \throws Option_error unless 0 <= k < infinity and 0 <= min_size <= max_size, 0 < max_size, min_size finite.
  static void check_range(double k, double min_size, double max_size)
  {
    if (!(k >= 0) || !std::isfinite(k)) throw Option_error("the growth k of a sizing field must be finite and >= 0");
    if (!(min_size >= 0) || !std::isfinite(min_size)) throw Option_error("the smallest size must be finite and >= 0");
    if (!(max_size > 0)) throw Option_error("the largest size must be positive");
    if (min_size > max_size) throw Option_error("the smallest size is above the largest size");
  }

private:
  // A source in scaled coordinates. It fills one cache line.
  struct Piece
  {
    double x, y, dx, dy; // start and unit direction
    double length, size; // size at the start
    double slope;        // of the size; |slope| < k, or the piece is a point
    double lean;         // how far the best s lies from the foot of x, per unit of distance from the line

    double low() const { return std::min(size, size + slope * length); }
    double value(double qx, double qy, double k) const
    {
      const double foot = (qx - x) * dx + (qy - y) * dy, height = std::abs((qx - x) * dy - (qy - y) * dx);
      const double t = std::clamp(foot - lean * height, 0., length); // the value is convex in t
      return size + slope * t + k * std::sqrt(height * height + (foot - t) * (foot - t));
    }
  };

  WEFT_COLD static std::vector<Source> point_sources(const std::vector<Point>& points, const std::vector<double>& sizes)
  {
    if (points.size() != sizes.size()) throw Option_error("Lipschitz_sizing_2: one size per point is needed");
    std::vector<Source> sources;
    sources.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) sources.push_back({points[i], points[i], sizes[i], sizes[i]});
    return sources;
  }

  WEFT_COLD void check_source(const Source& s) const
  {
    for (const double size : {s.source_size, s.target_size})
      if (!std::isfinite(size) || !(size > 0 || min_size_ > 0))
        throw Option_error("Lipschitz_sizing_2: sizes at sources must be finite and positive");
    for (const Point& p : {s.source, s.target})
      if (!std::isfinite(CGAL::to_double(p.x())) || !std::isfinite(CGAL::to_double(p.y())))
        throw Option_error("Lipschitz_sizing_2: coordinates of sources must be finite");
  }

  Piece piece(const Source& s) const
  {
    const double px = scale_ * CGAL::to_double(s.source.x()), py = scale_ * CGAL::to_double(s.source.y());
    const double qx = scale_ * CGAL::to_double(s.target.x()), qy = scale_ * CGAL::to_double(s.target.y());
    const double p_size = scale_ * s.source_size, q_size = scale_ * s.target_size;
    const double length = std::sqrt((qx - px) * (qx - px) + (qy - py) * (qy - py));
    const double slope = length > 0 ? (q_size - p_size) / length : 0;
    const double room = k_ * k_ - slope * slope;
    if (length > 0 && room > 0)
      return {px, py, (qx - px) / length, (qy - py) / length, length, p_size, slope, slope / std::sqrt(room)};
    // A size that grows as fast as the field or faster: the end of smaller size covers the rest.
    const bool at_source = p_size <= q_size;
    return {at_source ? px : qx, at_source ? py : qy, 1, 0, 0, at_source ? p_size : q_size, 0, 0};
  }

  WEFT_NOINLINE void plant(std::vector<Piece> pieces)
  {
    std::vector<internal::Tree_item_2> items;
    items.reserve(pieces.size());
    for (const Piece& p : pieces) items.push_back({p.x, p.y, p.x + p.length * p.dx, p.y + p.length * p.dy, p.low()});
    tree_ = internal::Box_tree_2(items);
    pieces_.clear();
    for (const std::uint32_t i : tree_.order()) pieces_.push_back(pieces[i]);
  }

  // A piece is useless if the field near it stays below the piece's smallest size. What makes it useless has a strictly
  // smaller size, so all useless pieces can go at once: no two drop each other.
  WEFT_NOINLINE void drop_dominated()
  {
    std::vector<Piece> kept;
    for (const Piece& p : pieces_) {
      const double half = p.length / 2, x = p.x + half * p.dx, y = p.y + half * p.dy;
      if (!(infimum(x, y, p.low(), [](const internal::Box_2&) {}) + k_ * half < p.low())) kept.push_back(p);
    }
    if (kept.size() < pieces_.size()) plant(std::move(kept));
  }

  // Smallest of `best` and inf_s [k d(s, x) + h(s)], in scaled units.
  template <class Count>
  double infimum(double x, double y, double best, const Count& count) const
  {
    return tree_.minimise(
        best,
        [&](const internal::Box_2& box) {
          count(box);
          return box.low + k_ * std::sqrt(box.squared_distance(x, y));
        },
        [&](std::uint32_t i, double so_far) { return std::min(so_far, pieces_[i].value(x, y, k_)); });
  }

  template <class Count>
  double value(const Point& q, const Count& count, double limit = std::numeric_limits<double>::infinity()) const
  {
    const double x = scale_ * CGAL::to_double(q.x()), y = scale_ * CGAL::to_double(q.y());
    return std::max(min_size_, infimum(x, y, scale_ * std::min(max_size_, limit), count) / scale_);
  }

  double k_, min_size_, max_size_;
  double scale_ = 1;
  internal::Box_tree_2 tree_;
  std::vector<Piece> pieces_; // in the tree's order
};

} // namespace weft

#endif // WEFT_SIZING_LIPSCHITZ_SIZING_2_H
