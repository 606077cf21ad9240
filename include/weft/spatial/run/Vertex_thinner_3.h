// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which vertices of a mesh are too many for a sizing field: those at edges far shorter than the field are thinned until
// they are about as far apart as vertices of a new mesh. Cheaper than taking them out of a triangulation one by one
// (coarsen_3.h), and only where sizes have grown.

#ifndef WEFT_SPATIAL_RUN_VERTEX_THINNER_3_H
#define WEFT_SPATIAL_RUN_VERTEX_THINNER_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Thins the vertices of a mesh.
template <class K>
class Vertex_thinner_3
{
public:
  Vertex_thinner_3(const Tetrahedral_mesh_3<K>& mesh, const Criteria_3<K>& criteria, const std::vector<char>& fixed)
      : mesh_(mesh), criteria_(criteria), is_fixed_(fixed)
  {
    for (const auto& p : mesh.points) points_.push_back(xyz(p));
    list_neighbours();
    for (std::size_t v = 0; v < points_.size(); ++v) sizes_.push_back(criteria.size(mesh.points[v]));
  }

  /// \returns by vertex, whether it stays.
  std::vector<char> run()
  {
    std::vector<char> stays(points_.size(), true);
    const std::vector<char> may_go = candidates();
    std::vector<std::pair<int, std::size_t>> order; // what lies on more has precedence; ties by index
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (may_go[v]) order.emplace_back(mesh_.locations[v].dimension, v);
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> reached(points_.size(), points_.size()), queue;
    for (const auto& entry : order) {
      const std::size_t v = entry.second;
      if (!stays[v]) continue;
      const double radius = apart * sizes_[v];
      queue.assign(1, v);
      reached[v] = v;
      for (std::size_t i = 0; i < queue.size(); ++i)
        for (std::size_t e = first_[queue[i]]; e < first_[queue[i] + 1]; ++e) {
          const std::size_t w = neighbours_[e];
          if (reached[w] == v || norm(minus(points_[w], points_[v])) > radius) continue;
          reached[w] = v;
          queue.push_back(w);
          if (may_go[w] && mesh_.locations[w].dimension >= mesh_.locations[v].dimension) stays[w] = false;
        }
    }
    return stays;
  }

  /// Adds to a set of vertices those that share a cell with one that doesn't stay.
  void mark_around(const std::vector<char>& stays, std::vector<char>& marked) const
  {
    for (std::size_t v = 0; v < stays.size(); ++v)
      for (std::size_t e = first_[v]; !stays[v] && e < first_[v + 1]; ++e) marked[neighbours_[e]] = true;
  }

private:
  static constexpr double too_short = 0.42; ///< in parts of the size: edges of meshes that fit rarely are
  static constexpr double apart = 0.62;     ///< the same of distances between those that stay

  void list_neighbours()
  {
    std::vector<std::pair<std::size_t, std::size_t>> ends;
    ends.reserve(12 * mesh_.cells.size());
    for (const auto& c : mesh_.cells)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          if (i != j) ends.emplace_back(c[i], c[j]);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    first_.assign(points_.size() + 1, 0);
    for (const auto& e : ends) ++first_[e.first + 1], neighbours_.push_back(e.second);
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }

  /// Vertices at edges that are too short, unless the surface bends so much there that it needs them.
  std::vector<char> candidates() const
  {
    std::vector<char> result(points_.size(), false);
    const std::vector<double> bend = curvatures();
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (mesh_.locations[v].dimension < 1 || is_fixed_[v]) continue;
      const double approximation = criteria_.approximation ? criteria_.approximation(mesh_.points[v]) : 0;
      if (approximation > 0 && bend[v] * sizes_[v] * sizes_[v] / 8 > approximation) continue;
      for (std::size_t e = first_[v]; e < first_[v + 1] && !result[v]; ++e) {
        const std::size_t w = neighbours_[e];
        result[v] = norm(minus(points_[v], points_[w])) < too_short * (std::min)(sizes_[v], sizes_[w]);
      }
    }
    return result;
  }

  /// The largest turn of the boundary by distance beside each of its vertices: between facets of a patch, and along
  /// creases.
  std::vector<double> curvatures() const
  {
    std::vector<double> result(points_.size(), 0);
    struct Side
    {
      std::array<std::size_t, 2> edge;
      std::size_t facet;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < mesh_.facets.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i)
        sides.push_back({sorted<2>({mesh_.facets[f][i], mesh_.facets[f][(i + 1) % 3]}), f});
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.facet < b.facet;
    });
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const std::size_t f = sides[i - 1].facet, g = sides[i].facet;
      if (sides[i - 1].edge != sides[i].edge || mesh_.patches[f] != mesh_.patches[g]) continue;
      const Xyz_3 m = normal(f), n = normal(g), between = minus(center(f), center(g));
      const double angle = std::atan2(norm(cross_product(m, n)), dot_product(m, n)), length = norm(between);
      for (const std::size_t v : sides[i].edge)
        if (length > 0) result[v] = (std::max)(result[v], angle / length);
    }
    std::vector<std::array<std::size_t, 2>> ends(points_.size(), {none, none});
    for (const auto& e : mesh_.edges)
      for (std::size_t i = 0; i < 2; ++i) ends[e[i]][ends[e[i]][0] == none ? 0 : 1] = e[1 - i];
    for (std::size_t v = 0; v < ends.size(); ++v) {
      if (ends[v][1] == none || mesh_.locations[v].dimension != 1) continue;
      const Xyz_3 a = minus(points_[v], points_[ends[v][0]]), b = minus(points_[ends[v][1]], points_[v]);
      const double angle = std::atan2(norm(cross_product(a, b)), dot_product(a, b)), length = norm(a) + norm(b);
      if (length > 0) result[v] = (std::max)(result[v], 2 * angle / length);
    }
    return result;
  }

  Xyz_3 normal(std::size_t f) const
  {
    const auto& v = mesh_.facets[f];
    return cross_product(minus(points_[v[1]], points_[v[0]]), minus(points_[v[2]], points_[v[0]]));
  }
  Xyz_3 center(std::size_t f) const
  {
    Xyz_3 sum{};
    for (const std::size_t v : mesh_.facets[f])
      for (std::size_t k = 0; k < 3; ++k) sum[k] += points_[v][k] / 3;
    return sum;
  }

  static constexpr std::size_t none = ~std::size_t(0);

  const Tetrahedral_mesh_3<K>& mesh_;
  const Criteria_3<K>& criteria_;
  const std::vector<char>& is_fixed_;
  std::vector<Xyz_3> points_;
  std::vector<double> sizes_;
  std::vector<std::size_t> first_, neighbours_; ///< of each vertex
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_VERTEX_THINNER_3_H
