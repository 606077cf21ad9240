// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of second order: a node in the middle of each edge, on the crease or patch of the domain that the edge lies
// on. Where that would invert a cell the edge is bent less; the mesh with straight edges is valid, so that ends.

#ifndef WEFT_SPATIAL_DOMAIN_RAISE_ORDER_3_H
#define WEFT_SPATIAL_DOMAIN_RAISE_ORDER_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/require_structure_3.h>
#include <weft/spatial/mesh/scaled_jacobian_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace weft {

/// A mesh of second order, and how it came out.
template <class K>
struct Raised_mesh_3
{
  Quadratic_mesh_3<K> mesh;
  std::size_t curved_edges = 0;        ///< whose middle node isn't in the middle of the straight edge
  std::size_t straightened_edges = 0;  ///< bent less than the boundary, or not at all, since a cell would be bad
  double smallest_scaled_jacobian = 1; ///< over all cells, see `scaled_jacobian_3()`
};

namespace internal {

/// Makes one mesh; `raise_order_3()` runs it.
template <class K>
class Order_raiser_3
{
public:
  using Point = typename K::Point_3;

  explicit Order_raiser_3(const Tetrahedral_mesh_3<K>& mesh) : mesh_(result_.mesh)
  {
    mesh_.vertices = mesh;
    number_edges();
    straight_ = mesh_.middles;
  }

  /// Brings middle nodes of boundary edges onto the boundary.
  template <class Oracle>
  void curve(const Oracle& oracle)
  {
    is_curved_.assign(straight_.size(), false);
    for (std::size_t m = 0; m < straight_.size(); ++m) {
      const Vertex_location_3 at = mesh_.middle_locations[m];
      if ((at.dimension != 1 && at.dimension != 2) || std::binary_search(stays_.begin(), stays_.end(), m)) continue;
      const std::optional<Point> p = project_on_location(oracle, straight_[m], at);
      constexpr double flat = 1e-10; // in parts of the edge: on flat patches projection rounds
      if (!p || CGAL::squared_distance(*p, straight_[m]) <= flat * flat * squared_lengths_[m]) continue;
      mesh_.middles[m] = *p;
      is_curved_[m] = true;
    }
  }

  /// Bends edges less until no cell has a scaled Jacobian below the bound. Each round takes a part of the mesh's cells
  /// and halves the bend of their edges; after a few the edge is straight.
  Raised_mesh_3<K> straightened(double least_jacobian)
  {
    std::vector<int> halvings(mesh_.middles.size());
    std::vector<std::vector<std::size_t>> cells_at(mesh_.middles.size());
    for (std::size_t c = 0; c < mesh_.cell_middles.size(); ++c)
      for (const std::size_t node : mesh_.cell_middles[c])
        if (is_curved(middle(node))) cells_at[middle(node)].push_back(c);
    std::vector<std::size_t> cells(mesh_.cell_middles.size());
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = c;
    std::vector<double> jacobians(cells.size(), 1);
    while (!cells.empty()) {
      std::vector<std::size_t> edges;
      for (const std::size_t c : cells) {
        jacobians[c] = scaled_jacobian_3(mesh_, c);
        if (jacobians[c] >= least_jacobian) continue;
        for (const std::size_t node : mesh_.cell_middles[c])
          if (is_curved(middle(node))) edges.push_back(middle(node));
      }
      make_unique(edges);
      cells.clear();
      for (const std::size_t m : edges) {
        ++halvings[m];
        is_curved_[m] = halvings[m] < most_halvings;
        mesh_.middles[m] = is_curved_[m] ? CGAL::midpoint(mesh_.middles[m], straight_[m]) : straight_[m];
        cells.insert(cells.end(), cells_at[m].begin(), cells_at[m].end());
      }
      make_unique(cells);
    }
    for (std::size_t m = 0; m < halvings.size(); ++m) {
      result_.curved_edges += is_curved(m);
      result_.straightened_edges += halvings[m] > 0;
    }
    for (const double j : jacobians) result_.smallest_scaled_jacobian = (std::min)(result_.smallest_scaled_jacobian, j);
    return std::move(result_);
  }

private:
  static void make_unique(std::vector<std::size_t>& numbers)
  {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  std::size_t middle(std::size_t node) const { return node - mesh_.vertices.points.size(); }
  bool is_curved(std::size_t m) const { return !is_curved_.empty() && is_curved_[m]; }

  /// The node between two vertices, in the middle of them unless it was made before.
  std::size_t node_between(std::size_t v, std::size_t w, const Vertex_location_3& location)
  {
    const std::size_t n = mesh_.vertices.points.size();
    const auto [found, is_new] =
        node_of_.try_emplace((std::min)(v, w) * n + (std::max)(v, w), n + mesh_.middles.size());
    if (is_new) {
      mesh_.middles.push_back(CGAL::midpoint(mesh_.vertices.points[v], mesh_.vertices.points[w]));
      mesh_.middle_locations.push_back(location);
      squared_lengths_.push_back(
          CGAL::to_double(CGAL::squared_distance(mesh_.vertices.points[v], mesh_.vertices.points[w])));
    }
    return found->second;
  }

  /// Edges of creases first, then those of facets: the first place that an edge is found at is where it lies. An edge
  /// between two patches that isn't on a crease lies on neither.
  void number_edges()
  {
    const Tetrahedral_mesh_3<K>& mesh = mesh_.vertices;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      mesh_.edge_middles.push_back(node_between(mesh.edges[e][0], mesh.edges[e][1], {1, mesh.creases[e]}));
    const std::size_t on_creases = mesh_.middles.size();
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      mesh_.facet_middles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Vertex_location_3 here{2, mesh.patches[f]};
        const std::size_t node = node_between(mesh.facets[f][i], mesh.facets[f][(i + 1) % 3], here);
        mesh_.facet_middles.back()[i] = node;
        Vertex_location_3& at = mesh_.middle_locations[middle(node)];
        if (middle(node) >= on_creases && at != here) at = {2, between_patches};
      }
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      mesh_.cell_middles.emplace_back();
      for (std::size_t i = 0; i < 6; ++i) {
        const auto [a, b] = edges_of_cell[i];
        mesh_.cell_middles.back()[i] = node_between(mesh.cells[c][a], mesh.cells[c][b], {3, mesh.subdomains[c]});
      }
    }
    settle_between_patches();
    node_of_.clear();
  }

  /// Such an edge stays straight, on the patch of its first facet.
  void settle_between_patches()
  {
    for (std::size_t f = 0; f < mesh_.facet_middles.size(); ++f)
      for (const std::size_t node : mesh_.facet_middles[f])
        if (Vertex_location_3& at = mesh_.middle_locations[middle(node)]; at == Vertex_location_3{2, between_patches}) {
          at.index = mesh_.vertices.patches[f];
          stays_.push_back(middle(node));
        }
    make_unique(stays_);
  }

  static constexpr int between_patches = -1;
  static constexpr int most_halvings = 5;

  Raised_mesh_3<K> result_;
  Quadratic_mesh_3<K>& mesh_;                            ///< in the result
  std::unordered_map<std::size_t, std::size_t> node_of_; ///< by both ends
  std::vector<Point> straight_;                          ///< the middles of the straight edges
  std::vector<double> squared_lengths_;                  ///< of the straight edges
  std::vector<char> is_curved_;
  std::vector<std::size_t> stays_; ///< middle nodes between two patches, sorted
};

} // namespace internal

/// A mesh of second order with straight edges: each middle node is in the middle of its edge. Linear.
/// \throws Domain_error if the arrays aren't those of a mesh.
template <class K>
Raised_mesh_3<K> raise_order_3(const Tetrahedral_mesh_3<K>& mesh)
{
  internal::require_structure(mesh);
  return internal::Order_raiser_3<K>(mesh).straightened(0);
}

/// A mesh of second order whose middle nodes lie on the domain's creases and patches where edges do.
/// \param mesh of the same oracle, as `tetrahedral_mesh()` returns it: patches and creases are the oracle's.
/// \param least_jacobian the smallest scaled Jacobian (`scaled_jacobian_3()`) that a cell may have, from 0 to 1. Curved
///   edges of worse cells are bent half as much, again and again, and after five times not at all.
/// \throws Option_error if `least_jacobian` is out of range; Domain_error if the arrays aren't those of a mesh.
/// One projection for each edge of the boundary; else linear.
template <class Oracle>
Raised_mesh_3<typename Oracle::Kernel> raise_order_3(const Tetrahedral_mesh_3<typename Oracle::Kernel>& mesh,
                                                     const Oracle& oracle, double least_jacobian = 0.3)
{
  if (!(least_jacobian >= 0 && least_jacobian <= 1)) throw Option_error("least_jacobian has to be from 0 to 1");
  internal::require_structure(mesh);
  internal::Order_raiser_3<typename Oracle::Kernel> raiser(mesh);
  raiser.curve(oracle);
  return raiser.straightened(least_jacobian);
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_RAISE_ORDER_3_H
