// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizing function that a spatial mesh itself has at present, for smoothing (Tournois 2009, sec. 3.2.1.5 "Variable
// sizing"; Antani, Delage, Alliez, "Mesh sizing with additively weighted Voronoi diagrams", 2007): at every vertex the
// mean length of its edges, made K-Lipschitz by min over all vertices y of size(y) + K |x - y|. Smoothing in its metric
// keeps what refinement has graded.

#ifndef WEFT_SPATIAL_DYNAMIC_SIZING_3_H
#define WEFT_SPATIAL_DYNAMIC_SIZING_3_H

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace weft {

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

  /// Measures the edges of cells and facets of the domain and of creases, and grades. Distances between vertices are
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
  struct Edge
  {
    std::size_t other;
    double length;
  };

  void load_edges(const Restricted& mesh)
  {
    ends_.clear();
    for (const auto& e : mesh.triangulation().finite_edges())
      if (is_in_domain(mesh, e)) ends_.emplace_back(e.first->vertex(e.second), e.first->vertex(e.third));
    first_.assign(mesh.vertices().size() + 1, 0);
    for (const auto& [a, b] : ends_) {
      ++first_[static_cast<std::size_t>(a->id()) + 1];
      ++first_[static_cast<std::size_t>(b->id()) + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    edges_.resize(2 * ends_.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [a, b] : ends_) {
      const double length = std::sqrt(CGAL::to_double(CGAL::squared_distance(a->point(), b->point())));
      edges_[next[static_cast<std::size_t>(a->id())]++] = {static_cast<std::size_t>(b->id()), length};
      edges_[next[static_cast<std::size_t>(b->id())]++] = {static_cast<std::size_t>(a->id()), length};
    }
  }

  /// Whether a cell around an edge belongs to the domain.
  template <class Triangulation_edge>
  static bool is_in_domain(const Restricted& mesh, const Triangulation_edge& e)
  {
    if (e.first->vertex(e.second)->id() < 0 || e.first->vertex(e.third)->id() < 0) return false;
    auto c = mesh.triangulation().incident_cells(e);
    const auto begin = c;
    do
      if (c->subdomain() != 0) return true;
    while (++c != begin);
    return false;
  }

  /// Dijkstra's algorithm from all vertices at once.
  void grade()
  {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (std::size_t v = 0; v < sizes_.size(); ++v) queue.emplace(sizes_[v], v);
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (size > sizes_[v]) continue;
      for (std::size_t e = first_[v]; e < first_[v + 1]; ++e) {
        const double reached = size + lipschitz_ * edges_[e].length;
        if (reached >= sizes_[edges_[e].other]) continue;
        sizes_[edges_[e].other] = reached;
        queue.emplace(reached, edges_[e].other);
      }
    }
  }

  double lipschitz_, uniform_ = 0;
  std::vector<std::pair<Vertex_handle, Vertex_handle>> ends_;
  std::vector<std::size_t> first_; ///< of the edges of each vertex
  std::vector<Edge> edges_;
  std::vector<double> sizes_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DYNAMIC_SIZING_3_H
