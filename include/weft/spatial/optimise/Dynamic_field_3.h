// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing function that a spatial mesh has at present, at any point (Tournois 2009, sec. 3.2.1.5 "Variable sizing"):
// min over all vertices y of size(y) + K |x - y|. Refinement that holds to it keeps the mesh graded.

#ifndef WEFT_SPATIAL_OPTIMISE_DYNAMIC_FIELD_3_H
#define WEFT_SPATIAL_OPTIMISE_DYNAMIC_FIELD_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/optimise/Dynamic_sizing_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace weft::internal {

/// A balanced tree of the vertices, searched by bounds on the sum of size and distance.
class Dynamic_field_3
{
public:
  /// Measures the edges of a mesh, of which it is independent afterwards. O(n log n).
  /// \param lipschitz the K of the field, > 0.
  template <class Restricted>
  Dynamic_field_3(const Restricted& mesh, double lipschitz) : lipschitz_(lipschitz)
  {
    Dynamic_sizing_3<Restricted> sizing(lipschitz);
    sizing.update(mesh);
    for (const auto v : mesh.vertices())
      if (std::isfinite(sizing(v))) vertices_.push_back({xyz(v->point()), sizing(v)});
    if (!vertices_.empty()) build(0, vertices_.size());
  }

  /// The same as below, but that what was asked lately is remembered: cells share their edges. By one thread.
  double at(const Xyz_3& x)
  {
    Answer& answer = answers_[hash(x) % answers_.size()];
    if (!(answer.x == x)) answer = {x, (*this)(x)};
    return answer.value;
  }

  /// Infinite without vertices. O(log n), expected.
  double operator()(const Xyz_3& x) const
  {
    double best = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) search(0, x, best);
    return best;
  }

private:
  struct Vertex
  {
    Xyz_3 point;
    double size;
  };
  struct Node
  {
    Xyz_3 low, high;
    double least;                   ///< size
    std::size_t begin, end, second; ///< the first child follows; 0 for leaves
  };

  struct Answer
  {
    Xyz_3 x{{std::numeric_limits<double>::quiet_NaN(), 0, 0}}; ///< equal to none
    double value = 0;
  };

  static std::size_t hash(const Xyz_3& x)
  {
    const std::hash<double> of;
    return (of(x[0]) * 31 + of(x[1])) * 31 + of(x[2]);
  }

  std::size_t build(std::size_t begin, std::size_t end)
  {
    const std::size_t index = nodes_.size();
    Node node{vertices_[begin].point, vertices_[begin].point, vertices_[begin].size, begin, end, 0};
    for (std::size_t i = begin; i < end; ++i) {
      node.least = (std::min)(node.least, vertices_[i].size);
      for (std::size_t k = 0; k < 3; ++k) {
        node.low[k] = (std::min)(node.low[k], vertices_[i].point[k]);
        node.high[k] = (std::max)(node.high[k], vertices_[i].point[k]);
      }
    }
    nodes_.push_back(node);
    if (end - begin <= leaf) return index;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (node.high[k] - node.low[k] > node.high[axis] - node.low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) { return vertices_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Vertex& a, const Vertex& b) { return a.point[axis] < b.point[axis]; });
    build(begin, middle);
    const std::size_t second = build(middle, end);
    nodes_[index].second = second;
    return index;
  }

  /// The least value that the field could have at x because of a node.
  double bound(const Node& node, const Xyz_3& x) const
  {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = (std::max)({0., node.low[k] - x[k], x[k] - node.high[k]});
      squared += d * d;
    }
    return node.least + lipschitz_ * std::sqrt(squared);
  }

  void search(std::size_t index, const Xyz_3& x, double& best) const
  {
    const Node& node = nodes_[index];
    if (node.second == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        best = (std::min)(best, vertices_[i].size + lipschitz_ * norm(minus(vertices_[i].point, x)));
      return;
    }
    const double first = bound(nodes_[index + 1], x), second = bound(nodes_[node.second], x);
    const bool in_order = first <= second;
    if ((std::min)(first, second) < best) search(in_order ? index + 1 : node.second, x, best);
    if ((std::max)(first, second) < best) search(in_order ? node.second : index + 1, x, best);
  }

  static constexpr std::size_t leaf = 8;

  double lipschitz_;
  std::vector<Vertex> vertices_;
  std::vector<Node> nodes_;
  std::vector<Answer> answers_ = std::vector<Answer>(65521);
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_DYNAMIC_FIELD_3_H
