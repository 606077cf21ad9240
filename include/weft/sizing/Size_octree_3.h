// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes on an octree, trilinear on each of its leaves and continuous across them: what sizing fields in space are
// tabulated on, since meshers ask for sizes some thousand times a vertex.

#ifndef WEFT_SIZING_SIZE_OCTREE_3_H
#define WEFT_SIZING_SIZE_OCTREE_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// A box cut into cubes, each the root of an octree. Nothing is written while reading.
class Size_octree_3
{
public:
  /// Values at the corners of a leaf, x running fastest.
  using Leaf = std::array<double, 8>;

  std::array<double, 3> low{};         ///< corner of the box
  double cube = 1;                     ///< edge of the roots
  std::array<std::uint32_t, 3> size{}; ///< how many roots there are along each axis
  std::vector<std::int32_t> nodes; ///< index of the first of eight children, or ~index of a leaf; the roots come first
  std::vector<Leaf> leaves;
  std::vector<double> sides; ///< of the leaves

  /// The value at a point; outside of the box, that at the nearest point of the box. O(depth).
  double operator()(double x, double y, double z) const
  {
    std::array<double, 3> t{(x - low[0]) / cube, (y - low[1]) / cube, (z - low[2]) / cube};
    std::size_t root = 0;
    for (std::size_t k = 3; k-- > 0;) {
      const double most = size[k];
      t[k] = t[k] > 0 ? std::min(t[k], most) : 0; // 0 for what isn't a number, too
      const double whole = std::min(std::floor(t[k]), most - 1);
      t[k] -= whole;
      root = root * size[k] + static_cast<std::size_t>(whole);
    }
    std::int32_t node = nodes[root];
    while (node >= 0) {
      std::size_t child = 0;
      for (std::size_t k = 0; k < 3; ++k) { // doubling and taking off 1 is exact: neighbours agree on their border
        t[k] *= 2;
        if (t[k] >= 1) t[k] -= 1, child |= std::size_t(1) << k;
      }
      node = nodes[static_cast<std::size_t>(node) + child];
    }
    return value(leaves[static_cast<std::size_t>(~node)], t);
  }

  /// Length of the steepest gradient. That of a trilinear function is steepest at a corner of its cube, where it is
  /// made of the differences along three edges.
  double max_gradient() const
  {
    double steepest = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      for (std::size_t c = 0; c < 8; ++c)
        steepest = std::max(steepest, std::sqrt(squared_rise(leaves[i], c)) / sides[i]);
    return steepest;
  }

  /// Sum of the squared differences between a corner and its three neighbours.
  static double squared_rise(const Leaf& u, std::size_t c)
  {
    const double a = u[c ^ 1] - u[c], b = u[c ^ 2] - u[c], d = u[c ^ 4] - u[c];
    return a * a + b * b + d * d;
  }

private:
  static double value(const Leaf& u, const std::array<double, 3>& t)
  {
    const auto along_x = [&](std::size_t c) { return u[c] + t[0] * (u[c + 1] - u[c]); };
    const double a = along_x(0), b = along_x(2), c = along_x(4), d = along_x(6);
    const double e = a + t[1] * (b - a), f = c + t[1] * (d - c);
    return e + t[2] * (f - e);
  }
};

} // namespace weft::internal

#endif // WEFT_SIZING_SIZE_OCTREE_3_H
