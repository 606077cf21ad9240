// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells of a tetrahedral mesh that are to give way to others with the same outer facets: those around a vertex that is
// removed, or those around a new one, which grow cell by cell.

#ifndef WEFT_SPATIAL_LOCAL_CAVITY_3_H
#define WEFT_SPATIAL_LOCAL_CAVITY_3_H

#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/Star_optimiser_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam K a CGAL kernel with exact predicates whose coordinates are doubles.
template <class K>
class Cavity_3
{
public:
  using Mesh = Editable_mesh_3<K>;
  using Point = typename K::Point_3;
  using Cell_vertices = typename Mesh::Cell_vertices;
  using Facet_vertices = typename Mesh::Facet_vertices;

  explicit Cavity_3(const Mesh& mesh) : mesh_(mesh) {}

  /// Begins anew with these cells.
  void assign(const std::vector<int>& cells)
  {
    cells_ = cells;
    list_outer_facets();
  }

  const std::vector<int>& cells() const { return cells_; }

  /// Counterclockwise seen from outside.
  const std::vector<Facet_vertices>& outer_facets() const { return outer_; }

  static bool contains(const Facet_vertices& f, int v) { return f[0] == v || f[1] == v || f[2] == v; }

  /// Vertices of the outer facets, in ascending order.
  const std::vector<int>& outer_vertices()
  {
    vertices_.clear();
    for (const Facet_vertices& f : outer_) vertices_.insert(vertices_.end(), f.begin(), f.end());
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    return vertices_;
  }

  /// Appends the cells of a vertex and the outer facets that it isn't on.
  void append_cells(int v, std::vector<Cell_vertices>& made) const
  {
    for (const Facet_vertices& f : outer_)
      if (!contains(f, v)) made.push_back({v, f[0], f[1], f[2]});
  }

  /// Takes the cell beyond the facet into the cavity with which p makes the worst cell, unless that would swallow a
  /// vertex; false if there is none.
  bool grow(const Point& p)
  {
    order_.clear();
    for (std::size_t k = 0; k < outer_.size(); ++k)
      if (beyond_[k] != Mesh::none) order_.emplace_back(quality(p, outer_[k]), k);
    std::sort(order_.begin(), order_.end());
    for (std::size_t i = 0; i < (std::min)(order_.size(), std::size_t(3)); ++i)
      if (may_take(beyond_[order_[i].second])) {
        cells_.push_back(beyond_[order_[i].second]);
        list_outer_facets();
        return true;
      }
    return false;
  }

private:
  bool has(int c) const { return std::find(cells_.begin(), cells_.end(), c) != cells_.end(); }

  void list_outer_facets()
  {
    outer_.clear();
    beyond_.clear();
    for (const int c : cells_)
      for (int i = 0; i < 4; ++i) {
        const int n = mesh_.cell(c).neighbours[static_cast<std::size_t>(i)];
        if (n != Mesh::none && has(n)) continue;
        outer_.push_back(mesh_.facet(c, i));
        beyond_.push_back(mesh_.neighbour(c, i));
      }
  }

  double quality(const Point& p, const Facet_vertices& f) const
  {
    return cell_quality_3(p, mesh_.point(f[0]), mesh_.point(f[1]), mesh_.point(f[2]));
  }

  /// The surface of the cavity has to stay a sphere with all its vertices: the new cell has one facet in common with it
  /// and its fourth vertex isn't there yet, or two facets, and the edge opposite to their common one isn't there yet.
  bool may_take(int c) const
  {
    int common = 0;
    std::array<bool, 4> is_common{};
    for (std::size_t i = 0; i < 4; ++i) {
      const int n = mesh_.cell(c).neighbours[i];
      is_common[i] = n != Mesh::none && has(n);
      common += is_common[i];
    }
    const auto& v = mesh_.cell(c).vertices;
    const auto is_on_surface = [this](int w) {
      return std::any_of(outer_.begin(), outer_.end(), [w](const Facet_vertices& f) { return contains(f, w); });
    };
    if (common == 1) {
      for (std::size_t i = 0; i < 4; ++i)
        if (is_common[i]) return !is_on_surface(v[i]);
    }
    if (common == 2) { // the edge that becomes an inner one; the opposite one must be new
      int a = Mesh::none, b = Mesh::none;
      for (std::size_t i = 0; i < 4; ++i)
        if (is_common[i]) (a == Mesh::none ? a : b) = v[i];
      return std::none_of(outer_.begin(), outer_.end(),
                          [a, b](const Facet_vertices& f) { return contains(f, a) && contains(f, b); });
    }
    return false;
  }

  const Mesh& mesh_;
  std::vector<int> cells_, vertices_;
  std::vector<Facet_vertices> outer_;
  std::vector<int> beyond_; ///< cells beyond them, or none
  std::vector<std::pair<double, std::size_t>> order_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_CAVITY_3_H
