// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh by cells and their neighbours that can be changed piece by piece: what `improve_fixed_3()` works
// on. Nothing is assumed about its geometry: it need not be Delaunay, and cells may be inverted. Every change replaces
// some cells by others with the same outer facets, or moves a vertex, and can be undone.

#ifndef WEFT_SPATIAL_LOCAL_EDITABLE_MESH_3_H
#define WEFT_SPATIAL_LOCAL_EDITABLE_MESH_3_H

#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam K a CGAL kernel.
template <class K>
class Editable_mesh_3
{
public:
  using Kernel = K;
  using Point = typename K::Point_3;
  using Cell_vertices = std::array<int, 4>;  ///< positively oriented as a rule
  using Facet_vertices = std::array<int, 3>; ///< counterclockwise seen from outside of the cell or cavity

  static constexpr int none = -1;

  /// A cell and its neighbours.
  struct Cell
  {
    Cell_vertices vertices;
    std::array<int, 4> neighbours; ///< opposite to the vertices; none beyond the boundary
    int subdomain;
    bool is_alive;
  };

  /// \param fixed vertices that have to stay besides those of the boundary and of interfaces.
  /// O(n log n).
  Editable_mesh_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<std::size_t>& fixed)
      : points_(mesh.points), is_free_(mesh.points.size(), true), cell_of_(mesh.points.size(), none)
  {
    for (const auto& facet : mesh.facets)
      for (const std::size_t v : facet) is_free_[v] = false;
    for (const std::size_t v : fixed) is_free_[v] = false;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      Cell cell{{}, {none, none, none, none}, mesh.subdomains[c], true};
      for (std::size_t i = 0; i < 4; ++i) {
        cell.vertices[i] = static_cast<int>(mesh.cells[c][i]);
        cell_of_[mesh.cells[c][i]] = static_cast<int>(c);
      }
      cells_.push_back(cell);
    }
    const auto facets = cell_facets(mesh.cells);
    for_each_facet(facets, [this](auto first, auto last) {
      if (last - first != 2) return;
      cells_[first->cell].neighbours[static_cast<std::size_t>(first->opposite)] = static_cast<int>((first + 1)->cell);
      cells_[(first + 1)->cell].neighbours[static_cast<std::size_t>((first + 1)->opposite)] =
          static_cast<int>(first->cell);
    });
  }

  int number_of_cells() const { return static_cast<int>(cells_.size()); } ///< dead ones included
  const Cell& cell(int c) const { return cells_[static_cast<std::size_t>(c)]; }
  const Point& point(int v) const { return points_[static_cast<std::size_t>(v)]; }
  /// Whether a vertex may be moved and removed.
  bool is_free(int v) const { return is_free_[static_cast<std::size_t>(v)] != 0; }

  /// The facet opposite to vertex i of a cell.
  Facet_vertices facet(int c, int i) const
  {
    const auto& corners = outward_facet[static_cast<std::size_t>(i)];
    const Cell_vertices& v = cell(c).vertices;
    return {v[static_cast<std::size_t>(corners[0])], v[static_cast<std::size_t>(corners[1])],
            v[static_cast<std::size_t>(corners[2])]};
  }

  /// The cell beyond a facet if it is of the same subdomain; else none: that facet has to stay.
  int neighbour(int c, int i) const
  {
    const int n = cell(c).neighbours[static_cast<std::size_t>(i)];
    return n != none && cell(n).subdomain == cell(c).subdomain ? n : none;
  }

  static int index(const Cell& cell, int v)
  {
    for (int i = 0; i < 4; ++i)
      if (cell.vertices[static_cast<std::size_t>(i)] == v) return i;
    return none;
  }
  int index(int c, int v) const { return index(cell(c), v); }

  /// The cells around a free vertex.
  const std::vector<int>& star(int v)
  {
    star_.assign(1, cell_of_[static_cast<std::size_t>(v)]);
    const unsigned mark = next_mark();
    marks_[static_cast<std::size_t>(star_[0])] = mark;
    for (std::size_t k = 0; k < star_.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const int n = cell(star_[k]).neighbours[static_cast<std::size_t>(i)];
        if (n == none || cell(star_[k]).vertices[static_cast<std::size_t>(i)] == v ||
            marks_[static_cast<std::size_t>(n)] == mark)
          continue;
        marks_[static_cast<std::size_t>(n)] = mark;
        star_.push_back(n);
      }
    return star_;
  }

  /// The cells around edge ab, from one of them on, and the vertices between them: cell k has ring[k] and ring[k + 1],
  /// and (a, b, ring[k], ring[k + 1]) has its orientation. False if the edge is on the boundary or an interface, or
  /// more than `most` cells are around it.
  bool ring(int c, int a, int b, std::size_t most, std::vector<int>& cells, std::vector<int>& vertices) const
  {
    cells.clear();
    vertices.clear();
    auto [u, w] = other_two(c, a, b);
    for (int at = c;;) {
      cells.push_back(at);
      vertices.push_back(u);
      if (cells.size() > most) return false;
      const int next = neighbour(at, index(at, u));
      if (next == none) return false;
      if (next == c) return true;
      u = w;
      w = other_vertex(next, a, b, u);
      at = next;
    }
  }

  /// The same for an edge on the boundary or an interface: the cells around it between two facets that stay. There is
  /// one vertex more than cells.
  bool fan(int c, int a, int b, std::size_t most, std::vector<int>& cells, std::vector<int>& vertices) const
  {
    auto [u, w] = other_two(c, a, b);
    for (std::size_t k = 0;; ++k) { // backwards to where it begins
      const int previous = neighbour(c, index(c, w));
      if (previous == none) break;
      if (k > most) return false;
      w = u;
      u = other_vertex(previous, a, b, w);
      c = previous;
    }
    cells.clear();
    vertices.assign(1, u);
    for (;;) {
      cells.push_back(c);
      vertices.push_back(w);
      if (vertices.size() > most) return false;
      const int next = neighbour(c, index(c, u));
      if (next == none) return true;
      u = w;
      w = other_vertex(next, a, b, u);
      c = next;
    }
  }

  /// The vertices of a cell besides a and b, so that (a, b, first, second) has its orientation.
  std::pair<int, int> other_two(int c, int a, int b) const
  {
    static constexpr int others[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                            {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                            {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                            {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};
    const auto& pair = others[index(c, a)][index(c, b)];
    const Cell_vertices& v = cell(c).vertices;
    return {v[static_cast<std::size_t>(pair[0])], v[static_cast<std::size_t>(pair[1])]};
  }

  int other_vertex(int c, int p, int q, int r) const
  {
    for (const int v : cell(c).vertices)
      if (v != p && v != q && v != r) return v;
    return none;
  }

  // ---- changes

  /// Changes from here on can be undone.
  void begin() { log_.clear(); }

  std::size_t number_of_changes() const { return log_.size(); }

  /// Undoes the changes since `begin()`, but for the first few.
  void undo(std::size_t keep = 0)
  {
    for (; log_.size() > keep; log_.pop_back()) {
      const Change& change = log_.back();
      if (change.vertex != none) {
        points_[static_cast<std::size_t>(change.vertex)] = change.old;
        continue;
      }
      for (const int c : change.made) cells_[static_cast<std::size_t>(c)].is_alive = false;
      cells_.resize(cells_.size() - change.made.size());
      for (const int c : change.unmade) cells_[static_cast<std::size_t>(c)].is_alive = true;
      for (const int c : change.unmade) {
        for (std::size_t i = 0; i < 4; ++i) {
          cell_of_[static_cast<std::size_t>(cell(c).vertices[i])] = c;
          const int n = cell(c).neighbours[i];
          if (n != none) cells_[static_cast<std::size_t>(n)].neighbours[facing(n, facet(c, static_cast<int>(i)))] = c;
        }
      }
    }
  }

  void move(int v, const Point& p)
  {
    log_.push_back({v, point(v), {}, {}});
    points_[static_cast<std::size_t>(v)] = p;
  }

  /// A new vertex without cells.
  int add_vertex(const Point& p)
  {
    points_.push_back(p);
    is_free_.push_back(true);
    cell_of_.push_back(none);
    return static_cast<int>(points_.size()) - 1;
  }

  /// Replaces cells by others that fill the same cavity. The new ones have the last numbers. False, and nothing is
  /// changed, if a facet would have three cells: that can be where cells are inverted.
  bool replace(const std::vector<int>& old, const std::vector<Cell_vertices>& made)
  {
    Change change{none, Point(), old, {}};
    sides_.clear();
    const int subdomain = cell(old.front()).subdomain;
    for (const int c : old) cells_[static_cast<std::size_t>(c)].is_alive = false;
    for (const int c : old)
      for (int i = 0; i < 4; ++i) {
        const int n = cell(c).neighbours[static_cast<std::size_t>(i)];
        if (n != none && cell(n).is_alive)
          sides_.push_back({sorted(facet(c, i)), n, static_cast<int>(facing(n, facet(c, i)))});
      }
    for (const Cell_vertices& vertices : made) {
      const int c = number_of_cells();
      cells_.push_back({vertices, {none, none, none, none}, subdomain, true});
      change.made.push_back(c);
      for (int i = 0; i < 4; ++i) {
        cell_of_[static_cast<std::size_t>(vertices[static_cast<std::size_t>(i)])] = c;
        sides_.push_back({sorted(facet(c, i)), c, i});
      }
    }
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& a, const Side& b) { return std::tie(a.vertices, a.cell) < std::tie(b.vertices, b.cell); });
    log_.push_back(std::move(change));
    for (std::size_t k = 2; k < sides_.size(); ++k)
      if (sides_[k - 2].vertices == sides_[k].vertices) {
        undo(log_.size() - 1);
        return false;
      }
    for (std::size_t k = 1; k < sides_.size(); ++k) {
      const Side &a = sides_[k - 1], &b = sides_[k];
      if (a.vertices != b.vertices) continue;
      cells_[static_cast<std::size_t>(a.cell)].neighbours[static_cast<std::size_t>(a.index)] = b.cell;
      cells_[static_cast<std::size_t>(b.cell)].neighbours[static_cast<std::size_t>(b.index)] = a.cell;
    }
    return true;
  }

  /// The cells that changes since `begin()` have made or that have a vertex that they moved, in increasing order.
  std::vector<int> touched_cells()
  {
    std::vector<int> touched;
    for (const Change& change : log_) {
      touched.insert(touched.end(), change.made.begin(), change.made.end());
      if (change.vertex == none || !has_cells(change.vertex)) continue;
      const auto& around = star(change.vertex);
      touched.insert(touched.end(), around.begin(), around.end());
    }
    touched.erase(std::remove_if(touched.begin(), touched.end(), [this](int c) { return !cell(c).is_alive; }),
                  touched.end());
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    return touched;
  }

  /// Whether a vertex is still there.
  bool has_cells(int v) const
  {
    const int c = cell_of_[static_cast<std::size_t>(v)];
    return c != none && c < number_of_cells() && cell(c).is_alive && index(c, v) != none;
  }

  /// Drops dead cells; numbers of cells change, their order stays. Nothing can be undone any more.
  void compact()
  {
    log_.clear();
    std::vector<int> number(cells_.size(), none);
    std::size_t n = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].is_alive) number[c] = static_cast<int>(n++);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (number[c] == none) continue;
      Cell cell = cells_[c];
      for (int& neighbour : cell.neighbours)
        if (neighbour != none) neighbour = number[static_cast<std::size_t>(neighbour)];
      for (const int v : cell.vertices) cell_of_[static_cast<std::size_t>(v)] = number[c];
      cells_[static_cast<std::size_t>(number[c])] = cell;
    }
    cells_.resize(n);
    marks_.assign(n, 0);
    mark_ = 0;
  }

  /// The mesh as it is now. Facets, edges and corners are those of the input, vertices keep their order.
  Tetrahedral_mesh_3<K> mesh(const Tetrahedral_mesh_3<K>& input) const
  {
    Tetrahedral_mesh_3<K> result;
    std::vector<std::size_t> number(points_.size(), unused);
    std::vector<int> subdomain(points_.size(), 0);
    for (const Cell& c : cells_)
      for (std::size_t i = 0; i < 4 && c.is_alive; ++i) {
        number[static_cast<std::size_t>(c.vertices[i])] = 0;
        subdomain[static_cast<std::size_t>(c.vertices[i])] = c.subdomain;
      }
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (number[v] == unused) continue;
      number[v] = result.points.size();
      result.points.push_back(points_[v]);
      result.locations.push_back(v < input.locations.size() ? input.locations[v] : Vertex_location_3{3, subdomain[v]});
    }
    for (const Cell& c : cells_) {
      if (!c.is_alive) continue;
      result.cells.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) result.cells.back()[i] = number[static_cast<std::size_t>(c.vertices[i])];
      result.subdomains.push_back(c.subdomain);
    }
    result.facets = input.facets;
    result.edges = input.edges;
    result.corners = input.corners;
    result.patches = input.patches;
    result.creases = input.creases;
    for (auto& facet : result.facets)
      for (std::size_t& v : facet) v = number[v];
    for (auto& edge : result.edges)
      for (std::size_t& v : edge) v = number[v];
    for (std::size_t& v : result.corners) v = number[v];
    return result;
  }

private:
  static constexpr std::size_t unused = static_cast<std::size_t>(-1);

  struct Side
  {
    Facet_vertices vertices; ///< in increasing order
    int cell, index;
  };

  struct Change
  {
    int vertex; ///< that was moved, or none
    Point old;
    std::vector<int> unmade, made;
  };

  static Facet_vertices sorted(Facet_vertices f)
  {
    std::sort(f.begin(), f.end());
    return f;
  }

  /// Index of the vertex of a cell that isn't of a facet.
  std::size_t facing(int c, const Facet_vertices& f) const
  {
    for (std::size_t i = 0; i < 4; ++i)
      if (std::find(f.begin(), f.end(), cell(c).vertices[i]) == f.end()) return i;
    return 0;
  }

  unsigned next_mark()
  {
    marks_.resize(cells_.size(), 0);
    return ++mark_;
  }

  std::vector<Point> points_;
  std::vector<char> is_free_;
  std::vector<int> cell_of_; ///< one of the cells of each vertex
  std::vector<Cell> cells_;
  std::vector<Change> log_;
  std::vector<unsigned> marks_; ///< by cell
  unsigned mark_ = 0;
  std::vector<int> star_;
  std::vector<Side> sides_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_EDITABLE_MESH_3_H
