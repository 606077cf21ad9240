// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradient limiting in space: lowers the sizes at the corners of an octree until the gradient on every leaf is at most
// k. First along edges and diagonals of leaves, a shortest path problem; then where the gradient at a corner of a leaf
// is still too steep, in order of size. As limiter: Persson, "Mesh size functions for implicit geometries and PDE-based
// gradient limiting" (2006).

#ifndef WEFT_SIZING_LIMIT_GRADIENT_3_H
#define WEFT_SIZING_LIMIT_GRADIENT_3_H

#include <weft/sizing/Size_octree_builder_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace weft::internal {

class Gradient_limiter_3
{
public:
  Gradient_limiter_3(Size_octree_builder_3& octree, double k) : octree_(octree), k_(k) {}

  void run()
  {
    march();
    lower_masters();
    constexpr int most_sweeps = 60;
    for (int sweep = 0; sweep < most_sweeps && run_sweep(); ++sweep) {
    }
    contract();
  }

private:
  using Index = Size_octree_builder_3::Index;

  /// Dijkstra's algorithm between the corners of each leaf. What travels is the corner that a size comes from, so that
  /// distances are straight.
  void march()
  {
    auto& sizes = octree_.values;
    std::vector<std::vector<Index>> around(sizes.size());
    for (std::size_t i = 0; i < octree_.corners.size(); ++i)
      for (const Index v : octree_.corners[i]) around[v].push_back(static_cast<Index>(i));
    std::vector<std::array<double, 3>> points(sizes.size());
    std::vector<Index> from(sizes.size());
    const std::vector<double> given = sizes;
    using Entry = std::pair<double, Index>; // ties by index
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (Index v = 0; v < sizes.size(); ++v) {
      points[v] = octree_.point(v);
      from[v] = v;
      if (std::isfinite(sizes[v])) queue.emplace(sizes[v], v);
    }
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (size > sizes[v]) continue;
      const Index source = from[v];
      for (const Index leaf : around[v])
        for (const Index w : octree_.corners[leaf]) {
          const auto &p = points[source], &q = points[w];
          const double limit =
              given[source] + k_ * std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                                             (p[2] - q[2]) * (p[2] - q[2]));
          if (!(limit < sizes[w])) continue;
          sizes[w] = limit;
          from[w] = source;
          queue.emplace(limit, w);
        }
    }
  }

  /// Where a corner that hangs has a smaller size than the mean of its masters.
  void lower_masters()
  {
    constexpr int most_steps = 60; // in each the excess falls by a quarter at least
    constexpr double slack = 1 + 1e-12;
    for (const auto& h : octree_.hanging) {
      const double bound = octree_.values[h.corner];
      for (int step = 0; step < most_steps && octree_.value(h.corner) > slack * bound; ++step)
        octree_.lower(h.corner, bound);
    }
  }

  /// Looks at all leaves, those with the smallest sizes first.
  /// \returns whether something was changed.
  bool run_sweep()
  {
    std::vector<std::pair<double, Index>> order;
    for (std::size_t i = 0; i < octree_.corners.size(); ++i) {
      const auto u = values(i);
      if (is_steep(u, octree_.side(i)))
        order.emplace_back(*std::min_element(u.begin(), u.end()), static_cast<Index>(i));
    }
    std::sort(order.begin(), order.end());
    for (const auto& entry : order)
      for (std::size_t c = 0; c < 8; ++c) flatten(entry.second, c);
    return !order.empty();
  }

  Size_octree_3::Leaf values(std::size_t leaf) const
  {
    Size_octree_3::Leaf u;
    for (std::size_t c = 0; c < 8; ++c) u[c] = octree_.value(octree_.corners[leaf][c]);
    return u;
  }

  bool is_steep(const Size_octree_3::Leaf& u, double side) const
  {
    const double most = tolerance * k_ * side;
    for (std::size_t c = 0; c < 8; ++c)
      if (Size_octree_3::squared_rise(u, c) > most * most) return true;
    return false;
  }

  /// Lowers those of a corner and its three neighbours whose lowering flattens the gradient there, each by as much as
  /// it helps, which changes the sizes least.
  void flatten(Index leaf, std::size_t c)
  {
    const auto& corners = octree_.corners[leaf];
    const std::array<Index, 4> v{corners[c], corners[c ^ 1], corners[c ^ 2], corners[c ^ 4]};
    std::array<double, 4> u, share;
    for (std::size_t i = 0; i < 4; ++i) u[i] = octree_.value(v[i]);
    const std::array<double, 3> g{u[1] - u[0], u[2] - u[0], u[3] - u[0]};
    const double squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2], most = k_ * octree_.side(leaf);
    if (squared <= tolerance * tolerance * most * most) return;
    share[0] = std::max(0., -(g[0] + g[1] + g[2]));
    double cc = 0, gc = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      share[i + 1] = std::max(0., g[i]);
      const double change = share[i + 1] - share[0];
      cc += change * change, gc += g[i] * change;
    }
    const double lowest = *std::min_element(u.begin(), u.end());
    const double excess = squared - most * most, root = std::sqrt(std::max(0., gc * gc - cc * excess));
    const double t = std::min(excess / (gc + root), gc / cc);
    for (std::size_t i = 0; i < 4; ++i)
      if (share[i] > 0) octree_.lower(v[i], std::max(lowest, u[i] - t * share[i]));
  }

  /// What is left: pulls all sizes towards the smallest, which scales all gradients.
  void contract()
  {
    auto& sizes = octree_.values;
    double steepest = 0;
    for (std::size_t i = 0; i < octree_.corners.size(); ++i) {
      const auto u = values(i);
      for (std::size_t c = 0; c < 8; ++c)
        steepest = std::max(steepest, std::sqrt(Size_octree_3::squared_rise(u, c)) / octree_.side(i));
    }
    if (steepest <= k_) return;
    const double lowest = *std::min_element(sizes.begin(), sizes.end()), factor = k_ / steepest * (1 - 1e-9);
    for (double& s : sizes) s = lowest + factor * (s - lowest);
  }

  static constexpr double tolerance = 1 + 1e-4; ///< the last steps are many and small

  Size_octree_builder_3& octree_;
  double k_;
};

} // namespace weft::internal

#endif // WEFT_SIZING_LIMIT_GRADIENT_3_H
