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
    all_ = graph_of(mesh.cells);
    surface_ = graph_of(mesh.facets);
    reached_.assign(points_.size(), 0);
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
    for (const auto& entry : order) {
      const std::size_t v = entry.second;
      if (!stays[v]) continue;
      visit_near(v, all_, [&](std::size_t w) {
        if (may_go[w] && mesh_.locations[w].dimension == 3) stays[w] = false;
      });
      if (mesh_.locations[v].dimension == 3) continue;
      visit_near(v, surface_, [&](std::size_t w) { // along the surface: a sheet on the other side stays
        if (may_go[w] && mesh_.locations[w].dimension >= mesh_.locations[v].dimension) stays[w] = false;
      });
    }
    return stays;
  }

  /// Adds to a set of vertices those that share a cell with one that doesn't stay.
  void mark_around(const std::vector<char>& stays, std::vector<char>& marked) const
  {
    for (std::size_t v = 0; v < stays.size(); ++v)
      for (std::size_t e = all_.first[v]; !stays[v] && e < all_.first[v + 1]; ++e) marked[all_.ends[e]] = true;
  }

private:
  /// In parts of the size: mean edges of meshes that fit are about 0.8, single ones rarely below 0.4.
  static constexpr double too_short_on_average = 0.55, too_short = 0.25;
  static constexpr double apart = 0.62; ///< the same of distances between those that stay

  /// Neighbours of each vertex, in order.
  struct Graph
  {
    std::vector<std::size_t> first, ends;

    Graph() = default;
    Graph(std::size_t n, std::vector<std::array<std::size_t, 2>> pairs) : first(n + 1, 0)
    {
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      for (const auto& e : pairs) ++first[e[0] + 1], ends.push_back(e[1]);
      for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    }
  };

  template <class Elements>
  Graph graph_of(const Elements& elements) const
  {
    std::vector<std::array<std::size_t, 2>> pairs;
    for (const auto& element : elements)
      for (const std::size_t v : element)
        for (const std::size_t w : element)
          if (v != w) pairs.push_back({v, w});
    return Graph(points_.size(), std::move(pairs));
  }

  /// Calls `visit(w)` for the vertices that edges of a graph lead to without leaving the ball that v keeps free.
  template <class Visit>
  void visit_near(std::size_t v, const Graph& graph, const Visit& visit)
  {
    const double radius = apart * sizes_[v];
    queue_.assign(1, v);
    ++round_;
    reached_[v] = round_;
    for (std::size_t i = 0; i < queue_.size(); ++i)
      for (std::size_t e = graph.first[queue_[i]]; e < graph.first[queue_[i] + 1]; ++e) {
        const std::size_t w = graph.ends[e];
        if (reached_[w] == round_ || norm(minus(points_[w], points_[v])) > radius) continue;
        reached_[w] = round_;
        queue_.push_back(w);
        visit(w);
      }
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
      // Of the boundary, edges along it: those across a thin part say nothing.
      const Graph& graph = mesh_.locations[v].dimension == 3 ? all_ : surface_;
      double sum = 0, shortest = HUGE_VAL;
      for (std::size_t e = graph.first[v]; e < graph.first[v + 1]; ++e) {
        const std::size_t w = graph.ends[e];
        const double part = norm(minus(points_[v], points_[w])) / (std::min)(sizes_[v], sizes_[w]);
        sum += part, shortest = (std::min)(shortest, part);
      }
      const auto n = static_cast<double>(graph.first[v + 1] - graph.first[v]);
      result[v] = sum < too_short_on_average * n || shortest < too_short;
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
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.facet < b.facet; });
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
  Graph all_, surface_;
  std::vector<std::size_t> reached_, queue_;
  std::size_t round_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_VERTEX_THINNER_3_H
