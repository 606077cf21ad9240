// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of a tetrahedral mesh in one place, each made only if the worst of the cells made is better than the worst of
// those unmade (Freitag, Ollivier-Gooch 1997; Klingner, Shewchuk, "Aggressive tetrahedral mesh improvement", 2007):
// smoothing a vertex, removing an edge, removing one or several facets between two vertices, inserting a vertex,
// contracting an edge. The flips 2-3, 3-2 and 4-4 are the simplest of these.

#ifndef WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H
#define WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H

#include <weft/spatial/local/Cavity_3.h>
#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/Ring_triangulation_3.h>
#include <weft/spatial/local/Star_optimiser_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// How often each change was made.
struct Local_counts_3
{
  std::size_t moves = 0, edge_removals = 0, facet_removals = 0, insertions = 0, contractions = 0;

  std::size_t sum() const { return moves + edge_removals + facet_removals + insertions + contractions; }
};

/// \tparam K a CGAL kernel with exact predicates whose coordinates are doubles.
template <class K>
class Local_operations_3
{
public:
  using Mesh = Editable_mesh_3<K>;
  using Point = typename K::Point_3;
  using Cell_vertices = typename Mesh::Cell_vertices;
  using Facet_vertices = typename Mesh::Facet_vertices;

  explicit Local_operations_3(Mesh& mesh) : mesh_(mesh), ring_triangulation_(mesh), cavity_(mesh) {}

  const Local_counts_3& counts() const { return counts_; }
  void set_counts(const Local_counts_3& counts) { counts_ = counts; }

  double quality(int c) const { return quality(mesh_.cell(c).vertices); }
  double quality(const Cell_vertices& v) const { return cell_quality_3(mesh_, v); }

  /// Moves a free vertex; whether that made the worst cell of its star better by more than rounding.
  bool smooth(int v, double enough = HUGE_VAL)
  {
    if (!mesh_.is_free(v)) return false;
    load_star(v);
    Point p = mesh_.point(v);
    const double before = Star_optimiser_3<K>::quality(p, star_);
    if (before >= enough) return false;
    const double after = optimiser_.optimise(p, star_, enough);
    if (!(after > before + least_gain)) return false;
    mesh_.move(v, p);
    ++counts_.moves;
    return true;
  }

  /// Removes the edge between two vertices of a cell, triangulating the ring of vertices around it as well as possible.
  /// O(n^3) for n cells around it.
  bool remove_edge(int c, int a, int b)
  {
    if (!mesh_.ring(c, a, b, most_around, cells_, ring_)) return thin_fan(c, a, b);
    if (ring_.size() < 3) return false;
    const double before = worst_of(cells_);
    ring_triangulation_.triangulate(ring_, a, b, before);
    if (!(ring_triangulation_.worst() > before + least_gain)) return false;
    made_.clear();
    ring_triangulation_.append_cells(made_);
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.edge_removals;
    return true;
  }

  /// An edge that stays, on the boundary or an interface, gets fewer cells around it: in parts of the fan one each,
  /// with the rest of that part cut off and triangulated as above. Many cells in a narrow wedge can't all be good.
  bool thin_fan(int c, int a, int b)
  {
    if (!mesh_.fan(c, a, b, most_around, cells_, ring_)) return false;
    if (ring_.size() < 3) return false;
    const double before = worst_of(cells_);
    ring_triangulation_.triangulate(ring_, a, b, before);
    if (!(ring_triangulation_.thin_out() > before + least_gain)) return false;
    made_.clear();
    ring_triangulation_.append_thinned(made_);
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.edge_removals;
    return true;
  }

  /// Removes the facet opposite to vertex i of a cell, with facets beside it that have the same two vertices above and
  /// below, and connects those two.
  bool remove_facets(int c, int i)
  {
    const int n = mesh_.neighbour(c, i);
    if (n == Mesh::none) return false;
    const int below = mesh_.cell(c).vertices[static_cast<std::size_t>(i)];
    const Facet_vertices f = mesh_.facet(c, i); // seen from the other cell counterclockwise
    const int above = mesh_.other_vertex(n, f[0], f[1], f[2]);
    if (above == below) return false;
    cells_ = {c, n};
    made_.clear();
    double after = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k)
      after = (std::min)(after, cross(c, n, below, above, f[k], f[(k + 1) % 3], f[(k + 2) % 3], 0));
    if (!(after > worst_of(cells_) + least_gain)) return false;
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.facet_removals;
    return true;
  }

  /// Contracts an edge at a free vertex of its star into another vertex; the best of them.
  bool remove_vertex(int v)
  {
    if (!mesh_.is_free(v)) return false;
    cavity_.assign(mesh_.star(v));
    const std::vector<Facet_vertices>& outer = cavity_.outer_facets();
    double best = worst_of(cavity_.cells()) + least_gain;
    int target = Mesh::none;
    for (const int w : cavity_.outer_vertices()) {
      double q = HUGE_VAL;
      for (std::size_t k = 0; k < outer.size() && q > best; ++k)
        if (!cavity_.contains(outer[k], w)) q = (std::min)(q, quality({w, outer[k][0], outer[k][1], outer[k][2]}));
      if (q > best) best = q, target = w;
    }
    if (target == Mesh::none) return false;
    if (!fill_cavity(target)) return false;
    ++counts_.contractions;
    return true;
  }

  /// Puts a new vertex into a cell, into a cavity that grows as long as that helps, and moves it to its best place.
  /// \param most_loss how much worse than the worst cell unmade the worst one made may be: for whoever undoes it if
  ///   what follows doesn't make up for it.
  bool insert_vertex(int c, const Point& start, double most_loss = 0)
  {
    Point p = start;
    cavity_.assign({c});
    std::vector<int> best_cells;
    Point best_place = p;
    double best_gain = -most_loss + least_gain;
    for (std::size_t size = 1; size <= most_in_cavity; ++size) {
      load_star_of_cavity();
      Point place = p;
      const double after =
          size % 3 == 1 || size < 6 ? optimiser_.optimise(place, star_) : Star_optimiser_3<K>::quality(place, star_);
      if (after > 0) p = place;
      const double gain = after - worst_of(cavity_.cells());
      if (after > 0 && gain > best_gain) {
        best_gain = gain;
        best_cells = cavity_.cells();
        best_place = place;
      }
      if (!cavity_.grow(p)) break;
    }
    if (best_cells.empty()) return false;
    cavity_.assign(best_cells);
    if (!fill_cavity(mesh_.add_vertex(best_place))) return false;
    ++counts_.insertions;
    return true;
  }

private:
  static constexpr double least_gain = 1e-9;
  static constexpr std::size_t most_around = Ring_triangulation_3<K>::most_around, most_in_cavity = 24;
  static constexpr int deepest = 5;

  double worst_of(const std::vector<int>& cells) const
  {
    double worst = HUGE_VAL;
    for (const int c : cells) worst = (std::min)(worst, quality(c));
    return worst;
  }

  void load_star(int v)
  {
    star_.clear();
    for (const int c : mesh_.star(v)) add_to_star(mesh_.facet(c, mesh_.index(c, v)));
  }

  void add_to_star(const Facet_vertices& f)
  {
    star_.push_back({mesh_.point(f[0]), mesh_.point(f[1]), mesh_.point(f[2])});
  }

  void load_star_of_cavity()
  {
    star_.clear();
    for (const Facet_vertices& f : cavity_.outer_facets()) add_to_star(f);
  }

  /// Replaces the cells of the cavity by those of a vertex.
  bool fill_cavity(int v)
  {
    made_.clear();
    cavity_.append_cells(v, made_);
    return mesh_.replace(cavity_.cells(), made_);
  }

  /// What becomes of the side uv of a facet uvw to be removed: a cell with the new edge, or the facet beyond it is
  /// removed as well, if that is better. Returns the worst cell made.
  double cross(int lower, int upper, int below, int above, int u, int v, int w, int depth)
  {
    const double here = quality({below, above, u, v});
    const std::size_t cells = cells_.size(), made = made_.size();
    if (depth < deepest) {
      const int next_lower = mesh_.neighbour(lower, mesh_.index(lower, w));
      const int next_upper = mesh_.neighbour(upper, mesh_.index(upper, w));
      if (next_lower != Mesh::none && next_upper != Mesh::none && next_lower != next_upper) {
        const int x = mesh_.other_vertex(next_lower, below, u, v);
        if (x == mesh_.other_vertex(next_upper, above, u, v) && mesh_.index(next_lower, below) != Mesh::none &&
            mesh_.index(next_upper, above) != Mesh::none &&
            mesh_.neighbour(next_lower, mesh_.index(next_lower, below)) == next_upper &&
            std::find(cells_.begin(), cells_.end(), next_lower) == cells_.end() &&
            std::find(cells_.begin(), cells_.end(), next_upper) == cells_.end()) {
          cells_.push_back(next_lower);
          cells_.push_back(next_upper);
          double beyond = cross(next_lower, next_upper, below, above, u, x, v, depth + 1);
          if (beyond > here)
            beyond = (std::min)(beyond, cross(next_lower, next_upper, below, above, x, v, u, depth + 1));
          if (beyond > here) return beyond;
          cells_.resize(cells);
          made_.resize(made);
        }
      }
    }
    made_.push_back({below, above, u, v});
    return here;
  }

  Mesh& mesh_;
  Local_counts_3 counts_;
  Star_optimiser_3<K> optimiser_;
  Ring_triangulation_3<K> ring_triangulation_;
  Cavity_3<K> cavity_;
  std::vector<int> cells_, ring_;
  std::vector<Cell_vertices> made_;
  std::vector<typename Star_optimiser_3<K>::Facet> star_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H
