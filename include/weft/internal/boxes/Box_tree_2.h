// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bounding volume hierarchy over planar boxes that carry a lower bound of a value, searched by branch and bound.
// It answers "which item has the smallest value" for any value that can be bounded from below on a box: distances,
// and distances plus sizes.

#ifndef WEFT_INTERNAL_BOXES_BOX_TREE_2_H
#define WEFT_INTERNAL_BOXES_BOX_TREE_2_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

/// A segment, or a point, whose values are nowhere below `low`.
struct Tree_item_2
{
  double ax, ay, bx, by;
  double low;
};

/// Rectangle along any direction around items whose values are nowhere below `low`. Along a finely sampled smooth curve
/// boxes that follow the curve are what keeps the search logarithmic.
struct Box_2
{
  double x, y;          // centre
  double dx, dy;        // unit direction of the longer side
  double along, across; // half lengths of the sides
  double low;

  double squared_distance(double qx, double qy) const
  {
    const double px = qx - x, py = qy - y;
    const double u = std::max(0., std::abs(px * dx + py * dy) - along);
    const double v = std::max(0., std::abs(px * dy - py * dx) - across);
    return u * u + v * v;
  }
};

/// Factor by a power of two, so without rounding, that brings coordinates up to `largest` into [-1, 1]: squared lengths
/// then neither overflow nor vanish, and a field of a scaled input is the scaled field.
inline double unit_scale(double largest)
{
  if (!(largest > 0)) return 1;
  return std::ldexp(1., -std::clamp(std::ilogb(largest) + 1, -1000, 1000));
}

/// Binary tree of boxes, split at the median along the longer side. Items are renumbered: see `order()`.
class Box_tree_2
{
public:
  Box_tree_2() = default;

  /// O(n log n). Equal centres are ordered by index.
  explicit Box_tree_2(const std::vector<Tree_item_2>& items) : order_(items.size())
  {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
    if (items.empty()) return;
    nodes_.reserve(2 * items.size() / leaf_size + 8);
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(items.size()), items);
  }

  /// The items in the tree's order: `order()[i]` is the constructor's index of what `minimise()` calls i.
  const std::vector<std::uint32_t>& order() const { return order_; }
  bool empty() const { return nodes_.empty(); }

  /// Smallest of `best` and the values of all items, by branch and bound.
  /// \param best only items below it are of interest.
  /// \param bound `double(const Box_2&)`: nothing in the box has a smaller value.
  /// \param visit `double(std::uint32_t item, double best)`: the best value with this item counted.
  template <class Bound, class Visit>
  double minimise(double best, const Bound& bound, const Visit& visit) const
  {
    if (nodes_.empty()) return best;
    std::array<Entry, 64> stack; // halving 2^32 items leaves less than 64 pending siblings
    std::size_t pending = 0;
    Entry at{bound(nodes_[0].box), 0};
    for (;;) {
      if (at.bound < best) {
        const Node& node = nodes_[at.node];
        if (node.count == 0) {
          Entry near{bound(nodes_[node.first].box), node.first};
          Entry far{bound(nodes_[node.first + 1].box), node.first + 1};
          if (far.bound < near.bound) std::swap(near, far);
          if (far.bound < best) stack[pending++] = far;
          at = near;
          continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) best = visit(i, best);
      }
      if (pending == 0) return best;
      at = stack[--pending];
    }
  }

private:
  // Smaller leaves are a little faster on few segments and slower on many.
  static constexpr std::uint32_t leaf_size = 8;

  struct Node
  {
    Box_2 box;
    std::uint32_t first = 0; // first item of a leaf; first of two adjacent children otherwise
    std::uint32_t count = 0; // items of a leaf; 0: inner node
  };
  struct Entry
  {
    double bound;
    std::uint32_t node;
  };

  void build(std::uint32_t at, std::uint32_t first, std::uint32_t last, const std::vector<Tree_item_2>& items)
  {
    const Box_2 box = bounding_box(first, last, items);
    nodes_[at].box = box;
    if (last - first <= leaf_size) {
      nodes_[at].first = first, nodes_[at].count = last - first;
      return;
    }
    const auto position = [&](std::uint32_t i) {
      return (items[i].ax + items[i].bx) * box.dx + (items[i].ay + items[i].by) * box.dy;
    };
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t i, std::uint32_t j) {
                       const double pi = position(i), pj = position(j);
                       return pi != pj ? pi < pj : i < j; // ties by index
                     });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].first = children;
    nodes_.resize(nodes_.size() + 2);
    build(children, first, middle, items);
    build(children + 1, middle, last, items);
  }

  // Calls f(x, y) for all ends of items.
  template <class F>
  void for_each_end(std::uint32_t first, std::uint32_t last, const std::vector<Tree_item_2>& items, F f) const
  {
    for (std::uint32_t i = first; i < last; ++i) {
      const Tree_item_2& item = items[order_[i]];
      f(item.ax, item.ay), f(item.bx, item.by);
    }
  }

  // Along the principal axis of the ends where that is much smaller than the axis-parallel box, which is the better one
  // for round clouds: what covers them in the next level overlaps less.
  Box_2 bounding_box(std::uint32_t first, std::uint32_t last, const std::vector<Tree_item_2>& items) const
  {
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for_each_end(first, last, items, [&](double px, double py) { x += px, y += py; });
    x /= 2. * (last - first), y /= 2. * (last - first);
    for_each_end(first, last, items, [&](double px, double py) {
      xx += (px - x) * (px - x), xy += (px - x) * (py - y), yy += (py - y) * (py - y);
    });
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    const Box_2 parallel = bounding_box(first, last, items, 1, 0);
    const Box_2 oriented = bounding_box(first, last, items, std::cos(angle), std::sin(angle));
    Box_2 box = oriented.along * oriented.across < 0.7 * parallel.along * parallel.across ? oriented : parallel;
    if (box.across > box.along) {
      std::swap(box.along, box.across), std::swap(box.dx, box.dy);
      box.dx = -box.dx;
    }
    for (std::uint32_t i = first; i < last; ++i) box.low = std::min(box.low, items[order_[i]].low);
    return box;
  }

  Box_2 bounding_box(std::uint32_t first, std::uint32_t last, const std::vector<Tree_item_2>& items, double dx,
                     double dy) const
  {
    const double inf = std::numeric_limits<double>::infinity();
    double amin = inf, amax = -inf, cmin = inf, cmax = -inf; // along and across the direction
    for_each_end(first, last, items, [&](double px, double py) {
      const double a = px * dx + py * dy, c = py * dx - px * dy;
      amin = std::min(amin, a), amax = std::max(amax, a), cmin = std::min(cmin, c), cmax = std::max(cmax, c);
    });
    const double a = (amin + amax) / 2, c = (cmin + cmax) / 2, rounding = 1e-15; // coordinates are in [-1, 1]
    return {a * dx - c * dy, a * dy + c * dx, dx, dy, (amax - amin) / 2 + rounding, (cmax - cmin) / 2 + rounding, inf};
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_BOX_TREE_2_H
