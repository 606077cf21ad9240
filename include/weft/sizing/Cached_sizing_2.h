// SPDX-License-Identifier: GPL-3.0-or-later
//
// An expensive sizing field, tabulated on a quadtree. Sizing fields are evaluated far more often than they change.
//
// Squares are split until bilinear interpolation between their corners is near enough at nine test points each: the
// centre, the midpoints of the sides and the centres of the four quarters. All of them are corners and centres of the
// next level, so nothing is evaluated in vain. Frey and Marechal, "Fast adaptive quadtree mesh generation" (1998),
// control a mesh by such a tree.

#ifndef WEFT_SIZING_CACHED_SIZING_2_H
#define WEFT_SIZING_CACHED_SIZING_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace weft {

/// How a field is tabulated.
struct Cache_options
{
  double relative_error = 0.02; ///< largest relative error at test points, in (0, 1)
  int first_cells = 32;         ///< cells along the longer side of the box before any is split, >= 1: features of the
                                ///< field that are smaller than a cell can escape the test points
  int max_depth = 16;           ///< how often a cell may be split, 0 to 24
  std::size_t max_leaves = 1000000; ///< leaves of 32 bytes; beyond that a leaf errs on the small side
};

/// Table of a sizing field over a box; outside of the box the field itself answers. Safe to read from many threads once
/// built, if the field is.
///
/// At all test points of every leaf the value is never above the field's (up to rounding) and, unless the leaf is one
/// of `coarse_leaves()`, at least (1 - relative_error) times it. Between test points that holds for fields without
/// features smaller than the leaf. The value can jump by the error from one leaf to the next.
/// \tparam K a CGAL kernel.
/// \tparam Sizing the field; a copy is kept.
template <class K, class Sizing>
class Cached_sizing_2
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_2;

  /// Calls `field` from one thread, about nine times per leaf.
  /// \param box where values are tabulated, in the input's units.
  /// \throws Option_error for options out of range, an empty box, or when the field returns a value that isn't positive
  /// and finite.
  Cached_sizing_2(Sizing field, const CGAL::Bbox_2& box, const Cache_options& options = Cache_options())
      : field_(std::move(field)), options_(options)
  {
    check(box);
    const double width = box.xmax() - box.xmin(), height = box.ymax() - box.ymin(), longer = std::max(width, height);
    left_ = box.xmin(), bottom_ = box.ymin();
    cell_ = longer / options.first_cells * (1 + 1e-12);
    per_unit_ = 1 / cell_;
    columns_ = static_cast<std::uint32_t>(width * per_unit_) + 1;
    rows_ = static_cast<std::uint32_t>(height * per_unit_) + 1;
    Builder(*this).build();
  }

  /// Target edge length at `x`: two table look-ups and one more for each level of the tree.
  FT operator()(const Point& x) const
  {
    double u = (CGAL::to_double(x.x()) - left_) * per_unit_, v = (CGAL::to_double(x.y()) - bottom_) * per_unit_;
    if (!(u >= 0 && v >= 0 && u < columns_ && v < rows_)) return FT(field_(x));
    const auto column = static_cast<std::uint32_t>(u), row = static_cast<std::uint32_t>(v);
    u -= column, v -= row;
    std::int32_t node = nodes_[std::size_t(row) * columns_ + column];
    while (node >= 0) {
      u *= 2, v *= 2;
      const int right = u >= 1, upper = v >= 1;
      u -= right, v -= upper;
      node = nodes_[static_cast<std::size_t>(node) + internal::as_index(right + 2 * upper)];
    }
    const Leaf& leaf = leaves_[static_cast<std::size_t>(~node)];
    return FT(leaf.at(u, v));
  }

  std::size_t number_of_leaves() const { return leaves_.size(); }
  /// Leaves that miss the error because of `max_depth` or `max_leaves`: too small a size, never too large.
  std::size_t coarse_leaves() const { return coarse_; }
  /// How often the field was called.
  std::size_t evaluations() const { return evaluations_; }
  /// Largest relative error that was seen at a test point.
  double worst_error() const { return worst_; }
  const Sizing& field() const { return field_; }

private:
  // Bilinear on the unit square.
  struct Leaf
  {
    double constant, by_u, by_v, by_uv;
    double at(double u, double v) const { return constant + by_u * u + (by_v + by_uv * u) * v; }
  };
  class Builder;

  void check(const CGAL::Bbox_2& box) const
  {
    const auto& o = options_;
    if (!(o.relative_error > 0 && o.relative_error < 1))
      throw Option_error("Cached_sizing_2: the relative error must be in (0, 1)");
    if (o.first_cells < 1 || o.first_cells > 4096 || o.max_depth < 0 || o.max_depth > 24)
      throw Option_error("Cached_sizing_2: first_cells must be in [1, 4096], max_depth in [0, 24]");
    const double width = box.xmax() - box.xmin(), height = box.ymax() - box.ymin();
    if (!(width >= 0 && height >= 0 && std::max(width, height) > 0) || !std::isfinite(width) || !std::isfinite(height))
      throw Option_error("Cached_sizing_2: the box must be finite and not empty");
  }

  Sizing field_;
  Cache_options options_;
  double left_ = 0, bottom_ = 0, cell_ = 1, per_unit_ = 1;
  std::uint32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> nodes_; // index of the first of four children, or ~index of a leaf; the cells come first
  std::vector<Leaf> leaves_;
  std::size_t coarse_ = 0, evaluations_ = 0;
  double worst_ = 0;
};

/// Splits breadth first, so that a budget that runs out leaves an evenly coarse table. Points are known by their
/// integer coordinates on the finest lattice, half a leaf of the last level.
template <class K, class Sizing>
class Cached_sizing_2<K, Sizing>::Builder
{
public:
  explicit Builder(Cached_sizing_2& cache) : cache_(cache), unit_(std::uint64_t(1) << (cache.options_.max_depth + 2)) {}

  void build()
  {
    cache_.nodes_.resize(std::size_t(cache_.columns_) * cache_.rows_);
    std::deque<Square> queue;
    for (std::uint32_t row = 0; row < cache_.rows_; ++row)
      for (std::uint32_t column = 0; column < cache_.columns_; ++column)
        queue.push_back({std::size_t(row) * cache_.columns_ + column, column * unit_, row * unit_, unit_});
    for (; !queue.empty(); queue.pop_front()) {
      const Square s = queue.front();
      const Fit fit = fitted(s);
      const bool may_split = s.side > 4 && cache_.leaves_.size() + queue.size() + 3 <= cache_.options_.max_leaves;
      if (fit.error <= cache_.options_.relative_error || !may_split)
        add_leaf(s, fit);
      else
        split(s, queue);
    }
    cache_.evaluations_ = values_.size();
  }

private:
  struct Square
  {
    std::size_t node;
    std::uint64_t x, y, side;
  };
  struct Fit
  {
    Leaf leaf;
    double error;
  };

  double value(std::uint64_t x, std::uint64_t y)
  {
    const auto [it, is_new] = values_.emplace(x << 32 | y, 0.);
    if (is_new) {
      const double step = cache_.cell_ / static_cast<double>(unit_);
      it->second = CGAL::to_double(cache_.field_(
          Point(cache_.left_ + static_cast<double>(x) * step, cache_.bottom_ + static_cast<double>(y) * step)));
      if (!(it->second > 0) || !std::isfinite(it->second))
        throw Option_error("Cached_sizing_2: the field must be positive and finite");
    }
    return it->second;
  }

  // Through the corners, lowered as a whole (by a factor) until it exceeds the field at no test point.
  Fit fitted(const Square& s)
  {
    const double h00 = value(s.x, s.y), h10 = value(s.x + s.side, s.y), h01 = value(s.x, s.y + s.side),
                 h11 = value(s.x + s.side, s.y + s.side);
    Leaf leaf{h00, h10 - h00, h01 - h00, h11 - h10 - h01 + h00};
    static constexpr std::array<std::array<unsigned, 2>, 13> tests{
        {{0, 0}, {4, 0}, {0, 4}, {4, 4}, {2, 2}, {2, 0}, {0, 2}, {4, 2}, {2, 4}, {1, 1}, {3, 1}, {1, 3}, {3, 3}}};
    double lowest = std::numeric_limits<double>::infinity(), highest = 0; // field / interpolation
    for (const auto& t : tests) {
      const double ratio = value(s.x + s.side / 4 * t[0], s.y + s.side / 4 * t[1]) / leaf.at(t[0] / 4., t[1] / 4.);
      lowest = std::min(lowest, ratio), highest = std::max(highest, ratio);
    }
    for (double* c : {&leaf.constant, &leaf.by_u, &leaf.by_v, &leaf.by_uv}) *c *= lowest;
    return {leaf, 1 - lowest / highest};
  }

  void add_leaf(const Square& s, const Fit& fit)
  {
    cache_.nodes_[s.node] = ~static_cast<std::int32_t>(cache_.leaves_.size());
    cache_.leaves_.push_back(fit.leaf);
    cache_.worst_ = std::max(cache_.worst_, fit.error);
    if (fit.error > cache_.options_.relative_error) ++cache_.coarse_;
  }

  void split(const Square& s, std::deque<Square>& queue)
  {
    const std::size_t first = cache_.nodes_.size();
    cache_.nodes_[s.node] = static_cast<std::int32_t>(first);
    cache_.nodes_.resize(first + 4);
    const std::uint64_t half = s.side / 2;
    for (std::size_t i = 0; i < 4; ++i) queue.push_back({first + i, s.x + half * (i & 1), s.y + half * (i >> 1), half});
  }

  Cached_sizing_2& cache_;
  std::uint64_t unit_; // lattice steps along a cell
  std::unordered_map<std::uint64_t, double> values_;
};

} // namespace weft

#endif // WEFT_SIZING_CACHED_SIZING_2_H
