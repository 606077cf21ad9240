// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing function that a spatial mesh itself has at present, for smoothing (Tournois 2009, sec. 3.2.1.5 "Variable
// sizing"; Antani, Delage, Alliez, "Mesh sizing with additively weighted Voronoi diagrams", 2007): at every vertex the
// mean length of its edges, made K-Lipschitz by min over all vertices y of size(y) + K |x - y|. Smoothing in its metric
// keeps what refinement has graded.

#ifndef WEFT_SPATIAL_OPTIMISE_DYNAMIC_SIZING_3_H
#define WEFT_SPATIAL_OPTIMISE_DYNAMIC_SIZING_3_H

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace weft::internal {

/// Sizes at the vertices of a restricted Delaunay triangulation.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Dynamic_sizing_3
{
public:
  using Vertex_handle = typename Restricted::Vertex_handle;

  /// \param lipschitz the K of the field, by how much sizes grow per distance; 0 makes the field constant: the
  ///   smallest size everywhere.
  explicit Dynamic_sizing_3(double lipschitz = 1) : lipschitz_(lipschitz) {}

  /// Measures the edges of the domain's cells, and grades. Distances between vertices are
  /// along edges, which in a Delaunay triangulation are at most twice as long. O(n log n).
  void update(const Restricted& mesh)
  {
    load_edges(mesh);
    const std::size_t n = mesh.vertices().size();
    sizes_.assign(n, std::numeric_limits<double>::infinity());
    for (std::size_t v = 0; v < n; ++v) {
      double sum = 0;
      for (std::size_t e = first_[v]; e < first_[v + 1]; ++e) sum += edges_[e].length;
      if (first_[v + 1] > first_[v]) sizes_[v] = sum / static_cast<double>(first_[v + 1] - first_[v]);
    }
    grade();
  }

  /// The same size everywhere: the mean length of the edges when this is called first.
  void update_uniformly(const Restricted& mesh)
  {
    if (uniform_ == 0) {
      load_edges(mesh);
      for (const Edge& e : edges_) uniform_ += e.length / static_cast<double>(edges_.size());
    }
    sizes_.assign(mesh.vertices().size(), uniform_);
  }

  /// Size at a vertex, in the units of the mesh; infinite for one without edges in the domain.
  double operator()(Vertex_handle v) const { return sizes_[static_cast<std::size_t>(v->id())]; }

private:
  using Id = std::uint32_t; ///< of a vertex

  struct Edge
  {
    Id other;
    double length;
  };

  /// Collects the edges of the domain's cells, each once: cells list their edges at the vertex with the smaller number,
  /// where a mark by vertex sorts out those seen before. Circulating around every edge to see whether a cell there
  /// belongs to the domain is slower.
  void load_edges(const Restricted& mesh)
  {
    list_cell_edges(mesh);
    const std::size_t n = mesh.vertices().size();
    ends_.clear();
    first_.assign(n + 1, 0);
    std::vector<Id> seen_from(n, static_cast<Id>(n));
    for (std::size_t v = 0; v < n; ++v)
      for (std::size_t k = first_upper_[v]; k < first_upper_[v + 1]; ++k) {
        const Id w = upper_[k];
        if (seen_from[w] == v) continue;
        seen_from[w] = static_cast<Id>(v);
        ends_.emplace_back(static_cast<Id>(v), w);
        ++first_[v + 1];
        ++first_[w + 1];
      }
    for (std::size_t v = 1; v <= n; ++v) first_[v] += first_[v - 1];
    edges_.resize(2 * ends_.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [a, b] : ends_) {
      const double length =
          std::sqrt(CGAL::to_double(CGAL::squared_distance(mesh.vertices()[a]->point(), mesh.vertices()[b]->point())));
      edges_[next[a]++] = {b, length};
      edges_[next[b]++] = {a, length};
    }
  }

  /// The greater ends of the edges of cells by their smaller ends, as often as there are cells around.
  void list_cell_edges(const Restricted& mesh)
  {
    corners_.clear();
    first_upper_.assign(mesh.vertices().size() + 1, 0);
    for (const auto c : mesh.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      std::array<Id, 4> ids;
      for (int i = 0; i < 4; ++i) ids[static_cast<std::size_t>(i)] = static_cast<Id>(c->vertex(i)->id());
      std::sort(ids.begin(), ids.end());
      for (std::size_t i = 0; i < 3; ++i) first_upper_[ids[i] + 1] += 3 - i;
      corners_.push_back(ids);
    }
    for (std::size_t v = 1; v < first_upper_.size(); ++v) first_upper_[v] += first_upper_[v - 1];
    upper_.resize(first_upper_.back());
    std::vector<std::size_t> next(first_upper_.begin(), first_upper_.end() - 1);
    for (const auto& ids : corners_)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) upper_[next[ids[i]]++] = ids[j];
  }

  /// Dijkstra's algorithm from all vertices at once that make another one smaller: few do, since an edge rarely is
  /// longer than the mean at its end by as much as it is long itself.
  void grade()
  {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const auto spread = [&](double size, std::size_t v, const auto& reached) {
      for (std::size_t e = first_[v]; e < first_[v + 1]; ++e) {
        const double at_other = size + lipschitz_ * edges_[e].length;
        if (at_other < sizes_[edges_[e].other]) reached(std::size_t(edges_[e].other), at_other);
      }
    };
    for (std::size_t v = 0; v < sizes_.size(); ++v) {
      bool spreads = false;
      spread(sizes_[v], v, [&](std::size_t, double) { spreads = true; });
      if (spreads) queue.emplace(sizes_[v], v);
    }
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (size > sizes_[v]) continue;
      spread(size, v, [&](std::size_t w, double reached) {
        sizes_[w] = reached;
        queue.emplace(reached, w);
      });
    }
  }

  double lipschitz_, uniform_ = 0;
  std::vector<std::array<Id, 4>> corners_; ///< sorted, of the domain's cells
  std::vector<std::size_t> first_upper_;
  std::vector<Id> upper_;
  std::vector<std::pair<Id, Id>> ends_;
  std::vector<std::size_t> first_; ///< of the edges of each vertex
  std::vector<Edge> edges_;
  std::vector<double> sizes_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_DYNAMIC_SIZING_3_H
