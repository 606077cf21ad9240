// SPDX-License-Identifier: GPL-3.0-or-later
//
// A growing set of points, each with a length of its own, that answers "is there a point within this distance?" where
// lengths may differ by orders of magnitude. A point is kept in the quadtree cell whose side is about its length, so
// a query meets few points and few cells at every place.

#ifndef WEFT_INTERNAL_BOXES_POINT_QUADTREE_2_H
#define WEFT_INTERNAL_BOXES_POINT_QUADTREE_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

class Point_quadtree_2
{
public:
  /// \param x,y,side the square that all points lie in.
  Point_quadtree_2(double x, double y, double side) : x_(x), y_(y), side_(side), nodes_(1) {}

  /// Adds a point whose spacing to others is about `length`.
  void insert(double px, double py, double length)
  {
    Index node = 0;
    double x = x_, y = y_, side = side_;
    for (int depth = 0; side > length && depth < max_depth; ++depth) {
      side *= 0.5;
      const unsigned k = (px >= x + side ? 1u : 0u) + (py >= y + side ? 2u : 0u);
      if (k & 1) x += side;
      if (k & 2) y += side;
      if (nodes_[node].child[k] == none) {
        nodes_[node].child[k] = static_cast<Index>(nodes_.size());
        nodes_.emplace_back();
      }
      node = nodes_[node].child[k];
    }
    points_.push_back({px, py, nodes_[node].head});
    nodes_[node].head = static_cast<Index>(points_.size() - 1);
  }

  /// Whether a point lies closer than `distance` to (px, py).
  bool any_within(double px, double py, double distance) const
  {
    return any_within(0, x_, y_, side_, px, py, distance);
  }

private:
  using Index = std::uint32_t;
  static constexpr Index none = ~Index(0);

  struct Node
  {
    std::array<Index, 4> child{none, none, none, none};
    Index head = none;
  };
  struct Item
  {
    double x, y;
    Index next;
  };
  static constexpr int max_depth = 60; // beyond it, cells are finer than coordinates

  bool any_within(Index index, double x, double y, double side, double px, double py, double d) const
  {
    const Node& node = nodes_[index];
    for (Index i = node.head; i != none; i = points_[i].next) {
      const double dx = points_[i].x - px, dy = points_[i].y - py;
      if (dx * dx + dy * dy < d * d) return true;
    }
    const double half = 0.5 * side, cx = x + half, cy = y + half;
    const bool left = px - d < cx, right = px + d >= cx, below = py - d < cy, above = py + d >= cy;
    const auto inside = [&](std::size_t k, bool meets, double x0, double y0) {
      return meets && node.child[k] != none && any_within(node.child[k], x0, y0, half, px, py, d);
    };
    return inside(0, left && below, x, y) || inside(1, right && below, cx, y) || inside(2, left && above, x, cy) ||
           inside(3, right && above, cx, cy);
  }

  double x_, y_, side_;
  std::vector<Node> nodes_;
  std::vector<Item> points_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_POINT_QUADTREE_2_H
