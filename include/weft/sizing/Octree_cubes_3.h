// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cubes of the octree of a sizing field: where they are, which one holds a place, and the balance between them.

#ifndef WEFT_SIZING_OCTREE_CUBES_3_H
#define WEFT_SIZING_OCTREE_CUBES_3_H

#include <weft/errors.h>
#include <weft/sizing/Size_octree_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace weft::internal {

/// Cubes by whole numbers of steps, the edge of the smallest cube that there can be.
class Octree_cubes_3
{
protected:
  using Place = std::array<std::uint32_t, 3>; ///< in steps

  struct Cube
  {
    Place low;
    std::uint32_t side; ///< in steps
    std::size_t node;
  };

  static std::uint64_t key(const Place& p) { return (std::uint64_t(p[2]) << 21 | p[1]) << 21 | p[0]; }
  static Place corner(const Cube& c, std::size_t i)
  {
    return {c.low[0] + (i & 1 ? c.side : 0), c.low[1] + (i & 2 ? c.side : 0), c.low[2] + (i & 4 ? c.side : 0)};
  }

  /// At most 16 roots along an axis.
  Octree_cubes_3(const CGAL::Bbox_3& b, int depth)
  {
    const std::array<double, 3> extent{b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()};
    const double longest = *std::max_element(extent.begin(), extent.end());
    if (!(longest > 0) || !std::isfinite(longest)) throw Option_error("the box of a sizing field is empty");
    constexpr double most = 16;
    tree_.cube = longest / most;
    tree_.low = {b.xmin(), b.ymin(), b.zmin()};
    std::size_t roots = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      tree_.size[k] = static_cast<std::uint32_t>(std::clamp(std::ceil(extent[k] / tree_.cube - 1e-9), 1., most));
      tree_.low[k] -= 0.5 * (tree_.size[k] * tree_.cube - extent[k]);
      roots *= tree_.size[k];
    }
    unit_ = std::uint32_t(1) << depth;
    step_ = tree_.cube / unit_;
    tree_.nodes.assign(roots, leaf_mark);
  }

  std::array<double, 3> point(const Place& p) const
  {
    return {tree_.low[0] + step_ * p[0], tree_.low[1] + step_ * p[1], tree_.low[2] + step_ * p[2]};
  }

  /// The step that a point lies in, or the nearest one.
  Place place(const std::array<double, 3>& x) const
  {
    Place p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double most = static_cast<double>(tree_.size[k]) * unit_ - 1;
      p[k] = static_cast<std::uint32_t>(std::clamp(std::floor((x[k] - tree_.low[k]) / step_), 0., most));
    }
    return p;
  }

  std::size_t split(const Cube& c)
  {
    const std::size_t first = tree_.nodes.size();
    tree_.nodes[c.node] = static_cast<std::int32_t>(first);
    tree_.nodes.resize(first + 8, leaf_mark);
    return first;
  }

  static Cube child(const Cube& c, std::size_t first, std::size_t i)
  {
    const std::uint32_t half = c.side / 2;
    return {
        {c.low[0] + (i & 1 ? half : 0), c.low[1] + (i & 2 ? half : 0), c.low[2] + (i & 4 ? half : 0)}, half, first + i};
  }

  /// The leaf that holds a step.
  Cube cube_at(const Place& p) const
  {
    const std::size_t root = (std::size_t(p[2] / unit_) * tree_.size[1] + p[1] / unit_) * tree_.size[0] + p[0] / unit_;
    Cube c{{p[0] / unit_ * unit_, p[1] / unit_ * unit_, p[2] / unit_ * unit_}, unit_, root};
    while (tree_.nodes[c.node] >= 0) {
      const std::uint32_t half = c.side / 2;
      c = child(c, static_cast<std::size_t>(tree_.nodes[c.node]),
                std::size_t(p[0] >= c.low[0] + half) | std::size_t(p[1] >= c.low[1] + half) << 1 |
                    std::size_t(p[2] >= c.low[2] + half) << 2);
    }
    return c;
  }

  /// Calls `visit(leaf)` for the leaves around a cube, some more than once.
  template <class Visit>
  void visit_neighbours(const Cube& c, const Visit& visit) const
  {
    for (int i = 0; i < 27; ++i) {
      if (i == 13) continue;
      const std::array<int, 3> d{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
      Place p;
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t x = std::int64_t(c.low[k]) + d[k] * std::int64_t(c.side);
        inside = inside && x >= 0 && x < std::int64_t(tree_.size[k]) * unit_;
        p[k] = static_cast<std::uint32_t>(x);
      }
      if (inside) visit(cube_at(p));
    }
  }

  void balance()
  {
    std::deque<Cube> queue;
    for_each_leaf([&](const Cube& c) { queue.push_back(c); });
    for (; !queue.empty(); queue.pop_front()) {
      const Cube c = queue.front();
      if (tree_.nodes[c.node] >= 0) continue;
      std::vector<Cube> large;
      visit_neighbours(c, [&](const Cube& n) {
        if (n.side > 2 * c.side) large.push_back(n);
      });
      for (const Cube& n : large) {
        if (tree_.nodes[n.node] >= 0) continue;
        const std::size_t first = split(n);
        for (std::size_t i = 0; i < 8; ++i) queue.push_back(child(n, first, i));
      }
      if (!large.empty()) queue.push_back(c); // the halves may be too large still
    }
  }

  template <class Visit>
  void for_each_leaf(const Visit& visit) const
  {
    std::vector<Cube> stack;
    std::size_t n = 0;
    for (std::uint32_t z = 0; z < tree_.size[2]; ++z)
      for (std::uint32_t y = 0; y < tree_.size[1]; ++y)
        for (std::uint32_t x = 0; x < tree_.size[0]; ++x) {
          stack.push_back({{x * unit_, y * unit_, z * unit_}, unit_, n++});
          while (!stack.empty()) {
            const Cube c = stack.back();
            stack.pop_back();
            if (tree_.nodes[c.node] < 0) {
              visit(c);
              continue;
            }
            for (std::size_t i = 8; i-- > 0;)
              stack.push_back(child(c, static_cast<std::size_t>(tree_.nodes[c.node]), i));
          }
        }
  }

  static constexpr std::int32_t leaf_mark = -1;

  Size_octree_3 tree_; ///< without values
  std::uint32_t unit_ = 1;
  double step_ = 1;
};

} // namespace weft::internal

#endif // WEFT_SIZING_OCTREE_CUBES_3_H
