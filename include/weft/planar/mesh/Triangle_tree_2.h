// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of bounding boxes over the triangles of a planar mesh: which of them a box may meet, and which lies nearest to
// a point.

#ifndef WEFT_PLANAR_MESH_TRIANGLE_TREE_2_H
#define WEFT_PLANAR_MESH_TRIANGLE_TREE_2_H

#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

using Corners_2 = std::array<Xy_2, 3>;

/// Twice the area.
inline double doubled_area(const Xy_2& a, const Xy_2& b, const Xy_2& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Barycentric coordinates of p; of a triangle without area, a third each.
inline std::array<double, 3> barycentric_2(const Corners_2& t, const Xy_2& p)
{
  const double all = doubled_area(t[0], t[1], t[2]);
  if (all == 0) return {1. / 3, 1. / 3, 1. / 3};
  return {doubled_area(p, t[1], t[2]) / all, doubled_area(t[0], p, t[2]) / all, doubled_area(t[0], t[1], p) / all};
}

/// Barycentric coordinates, none below 0, of the point of a triangle nearest to p.
/// \param squared_distance gets that, 0 inside.
inline std::array<double, 3> nearest_in_triangle_2(const Corners_2& t, const Xy_2& p, double& squared_distance)
{
  auto weights = barycentric_2(t, p);
  squared_distance = 0;
  if (*std::min_element(weights.begin(), weights.end()) >= 0 && doubled_area(t[0], t[1], t[2]) != 0) return weights;
  squared_distance = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    const Xy_2 &a = t[i], &b = t[(i + 1) % 3];
    const double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
    const double s = l2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / l2, 0., 1.) : 0;
    const double x = p[0] - a[0] - s * dx, y = p[1] - a[1] - s * dy, d = x * x + y * y;
    if (!(d < squared_distance)) continue;
    squared_distance = d;
    weights = {0, 0, 0};
    weights[i] = 1 - s;
    weights[(i + 1) % 3] = s;
  }
  return weights;
}

/// Reading writes nothing.
class Triangle_tree_2
{
public:
  /// O(n log n).
  template <class K>
  explicit Triangle_tree_2(const Triangle_mesh_2<K>& mesh)
  {
    for (const auto& t : mesh.triangles)
      triangles_.push_back({xy(mesh.points[t[0]]), xy(mesh.points[t[1]]), xy(mesh.points[t[2]])});
    order_.resize(triangles_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
    if (!order_.empty()) build(0, order_.size());
  }

  const Corners_2& triangle(std::size_t i) const { return triangles_[i]; }

  /// A triangle, and the barycentric coordinates of its point nearest to p. Of several the first one.
  std::pair<std::size_t, std::array<double, 3>> nearest(const Xy_2& p) const
  {
    std::size_t best = triangles_.size();
    double least = HUGE_VAL;
    std::array<double, 3> weights{};
    visit(
        [&](const Box& box) {
          const double x = (std::max)({0., box.low[0] - p[0], p[0] - box.high[0]}),
                       y = (std::max)({0., box.low[1] - p[1], p[1] - box.high[1]});
          return x * x + y * y <= least;
        },
        [&](std::size_t i) {
          double d;
          const auto w = nearest_in_triangle_2(triangles_[i], p, d);
          if (d > least || (d == least && i > best)) return;
          least = d;
          best = i;
          weights = w;
        });
    return {best, weights};
  }

  /// The triangles whose boxes meet that of another one, in increasing order.
  std::vector<std::size_t> near(const Corners_2& t) const
  {
    Box of;
    for (const Xy_2& p : t) of.add(p);
    std::vector<std::size_t> result;
    visit([&](const Box& box) { return box.meets(of); }, [&](std::size_t i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
  }

private:
  struct Box
  {
    Xy_2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

    void add(const Xy_2& p)
    {
      for (std::size_t k = 0; k < 2; ++k) low[k] = (std::min)(low[k], p[k]), high[k] = (std::max)(high[k], p[k]);
    }
    bool meets(const Box& o) const
    {
      return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] && o.low[1] <= high[1];
    }
  };
  struct Node
  {
    Box box;
    std::size_t first, last; // of `order_`
    std::size_t right = 0;   // child; the left one is the next node; 0: a leaf
  };
  static constexpr std::size_t leaf_size = 4;

  std::size_t build(std::size_t first, std::size_t last)
  {
    const std::size_t at = nodes_.size();
    Box box;
    for (std::size_t i = first; i < last; ++i)
      for (const Xy_2& p : triangles_[order_[i]]) box.add(p);
    nodes_.push_back({box, first, last});
    if (last - first <= leaf_size) return at;
    const std::size_t k = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1, middle = (first + last) / 2;
    const auto center = [&](std::size_t t) { return triangles_[t][0][k] + triangles_[t][1][k] + triangles_[t][2][k]; };
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first),
                     order_.begin() + static_cast<std::ptrdiff_t>(middle),
                     order_.begin() + static_cast<std::ptrdiff_t>(last),
                     [&](std::size_t a, std::size_t b) { return std::pair(center(a), a) < std::pair(center(b), b); });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[at].right = right;
    return at;
  }

  template <class Test, class Visit>
  void visit(const Test& test, const Visit& visit_triangle) const
  {
    if (nodes_.empty()) return;
    std::vector<std::size_t> stack(1, 0);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      const Node& node = nodes_[at];
      if (!test(node.box)) continue;
      if (node.right == 0) {
        for (std::size_t i = node.first; i < node.last; ++i) visit_triangle(order_[i]);
        continue;
      }
      stack.push_back(node.right);
      stack.push_back(at + 1);
    }
  }

  std::vector<Corners_2> triangles_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_MESH_TRIANGLE_TREE_2_H
