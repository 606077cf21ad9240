// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of a tetrahedral mesh in one place, each made only if the worst of the cells made is better than the worst of
// those unmade (Freitag, Ollivier-Gooch 1997; Klingner, Shewchuk, "Aggressive tetrahedral mesh improvement", 2007):
// smoothing a vertex, removing an edge, removing one or several facets between two vertices, inserting a vertex,
// contracting an edge. The flips 2-3, 3-2 and 4-4 are the simplest of these.

#ifndef WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H
#define WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H

#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/Star_optimiser_3.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
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

  explicit Local_operations_3(Mesh& mesh) : mesh_(mesh) {}

  const Local_counts_3& counts() const { return counts_; }
  void set_counts(const Local_counts_3& counts) { counts_ = counts; }

  double quality(int c) const { return quality(mesh_.cell(c).vertices); }
  double quality(const Cell_vertices& v) const
  {
    return cell_quality_3(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  }

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

  /// Removes the edge between two vertices of a cell, triangulating the ring of vertices around it as well as possible
  /// (Klincsek's algorithm). O(n^3) for n cells around it.
  bool remove_edge(int c, int a, int b)
  {
    if (!mesh_.ring(c, a, b, most_around, cells_, ring_)) return thin_fan(c, a, b);
    const std::size_t n = ring_.size();
    if (n < 3) return false;
    const double before = worst_of(cells_);
    triangulate_ring(before, a, b);
    if (!(best_[0][n - 1] > before + least_gain)) return false;
    made_.clear();
    add_triangulation(0, n - 1, a, b);
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.edge_removals;
    return true;
  }

  /// An edge that stays, on the boundary or an interface, gets fewer cells around it: in parts of the fan one each,
  /// with the rest of that part cut off and triangulated as above. Many cells in a narrow wedge can't all be good.
  bool thin_fan(int c, int a, int b)
  {
    if (!mesh_.fan(c, a, b, most_around, cells_, ring_)) return false;
    const std::size_t n = ring_.size();
    if (n < 3) return false;
    const double before = worst_of(cells_);
    triangulate_ring(before, a, b);
    std::array<double, most_around> best; // of the parts so far
    std::array<std::size_t, most_around> from{};
    best[0] = HUGE_VAL;
    for (std::size_t j = 1; j < n; ++j) {
      best[j] = -HUGE_VAL;
      for (std::size_t i = 0; i < j; ++i) {
        double q = (std::min)(best[i], best_[i][j]);
        if (q > best[j]) q = (std::min)(q, quality({a, b, ring_[i], ring_[j]}));
        if (q > best[j]) best[j] = q, from[j] = i;
      }
    }
    if (!(best[n - 1] > before + least_gain)) return false;
    made_.clear();
    for (std::size_t j = n - 1; j > 0; j = from[j]) {
      made_.push_back({a, b, ring_[from[j]], ring_[j]});
      add_triangulation(from[j], j, a, b);
    }
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
    cells_ = mesh_.star(v);
    load_cavity();
    double best = worst_of(cells_) + least_gain;
    int target = Mesh::none;
    for (const int w : link_vertices()) {
      double q = HUGE_VAL;
      for (std::size_t k = 0; k < outer_.size() && q > best; ++k)
        if (!contains(outer_[k], w)) q = (std::min)(q, quality({w, outer_[k][0], outer_[k][1], outer_[k][2]}));
      if (q > best) best = q, target = w;
    }
    if (target == Mesh::none) return false;
    made_.clear();
    for (const Facet_vertices& f : outer_)
      if (!contains(f, target)) made_.push_back({target, f[0], f[1], f[2]});
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.contractions;
    return true;
  }

  /// Puts a new vertex into a cell, into a cavity that grows as long as that helps, and moves it to its best place.
  /// \param most_loss how much worse than the worst cell unmade the worst one made may be: for whoever undoes it if
  /// what
  ///   follows doesn't make up for it.
  bool insert_vertex(int c, const Point& start, double most_loss = 0)
  {
    Point p = start;
    cells_ = {c};
    std::vector<int> best_cells;
    Point best_place = p;
    double best_gain = -most_loss + least_gain;
    for (std::size_t size = 1; size <= most_in_cavity; ++size) {
      load_cavity();
      load_star_of_cavity();
      Point place = p;
      const double after =
          size % 3 == 1 || size < 6 ? optimiser_.optimise(place, star_) : Star_optimiser_3<K>::quality(place, star_);
      if (after > 0) p = place;
      const double gain = after - worst_of(cells_);
      if (after > 0 && gain > best_gain) {
        best_gain = gain;
        best_cells = cells_;
        best_place = place;
      }
      if (!grow_cavity(p)) break;
    }
    if (best_cells.empty()) return false;
    cells_ = best_cells;
    load_cavity();
    const int v = mesh_.add_vertex(best_place);
    made_.clear();
    for (const Facet_vertices& f : outer_) made_.push_back({v, f[0], f[1], f[2]});
    if (!mesh_.replace(cells_, made_)) return false;
    ++counts_.insertions;
    last_inserted_ = v;
    return true;
  }

  int last_inserted() const { return last_inserted_; }

private:
  static constexpr double least_gain = 1e-9;
  static constexpr std::size_t most_around = 11, most_in_cavity = 24;
  static constexpr int deepest = 5;

  double worst_of(const std::vector<int>& cells) const
  {
    double worst = HUGE_VAL;
    for (const int c : cells) worst = (std::min)(worst, quality(c));
    return worst;
  }

  static bool contains(const Facet_vertices& f, int v) { return f[0] == v || f[1] == v || f[2] == v; }

  void load_star(int v)
  {
    star_.clear();
    for (const int c : mesh_.star(v)) add_to_star(mesh_.facet(c, mesh_.index(c, v)));
  }

  void add_to_star(const Facet_vertices& f)
  {
    star_.push_back({mesh_.point(f[0]), mesh_.point(f[1]), mesh_.point(f[2])});
  }

  // ---- edges

  /// The worst cells of the best triangulations of all parts of the ring, as far as they are better than a bound, and
  /// where the triangle at their ends has its tip.
  void triangulate_ring(double bound, int a, int b)
  {
    const std::size_t n = ring_.size();
    for (std::size_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = HUGE_VAL;
    for (std::size_t length = 2; length < n; ++length)
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        best_[i][j] = -HUGE_VAL;
        for (std::size_t k = i + 1; k < j; ++k) {
          double q = (std::min)(best_[i][k], best_[k][j]);
          if (q > (std::max)(best_[i][j], bound)) q = (std::min)(q, quality({ring_[i], ring_[k], ring_[j], b}));
          if (q > (std::max)(best_[i][j], bound)) q = (std::min)(q, quality({ring_[i], ring_[j], ring_[k], a}));
          if (q > best_[i][j]) best_[i][j] = q, tip_[i][j] = k;
        }
      }
  }

  void add_triangulation(std::size_t i, std::size_t j, int a, int b)
  {
    if (j < i + 2) return;
    const std::size_t k = tip_[i][j];
    made_.push_back({ring_[i], ring_[k], ring_[j], b});
    made_.push_back({ring_[i], ring_[j], ring_[k], a});
    add_triangulation(i, k, a, b);
    add_triangulation(k, j, a, b);
  }

  // ---- facets

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

  // ---- cavities

  bool is_in_cavity(int c) const { return std::find(cells_.begin(), cells_.end(), c) != cells_.end(); }

  /// The outer facets of `cells_`, and what is beyond them.
  void load_cavity()
  {
    outer_.clear();
    beyond_.clear();
    for (const int c : cells_)
      for (int i = 0; i < 4; ++i) {
        const int n = mesh_.cell(c).neighbours[static_cast<std::size_t>(i)];
        if (n != Mesh::none && is_in_cavity(n)) continue;
        outer_.push_back(mesh_.facet(c, i));
        beyond_.push_back(mesh_.neighbour(c, i));
      }
  }

  void load_star_of_cavity()
  {
    star_.clear();
    for (const Facet_vertices& f : outer_) add_to_star(f);
  }

  const std::vector<int>& link_vertices()
  {
    link_.clear();
    for (const Facet_vertices& f : outer_) link_.insert(link_.end(), f.begin(), f.end());
    std::sort(link_.begin(), link_.end());
    link_.erase(std::unique(link_.begin(), link_.end()), link_.end());
    return link_;
  }

  /// Takes the cell beyond the facet into the cavity with which p makes the worst cell, unless that would swallow a
  /// vertex; false if there is none.
  bool grow_cavity(const Point& p)
  {
    order_.clear();
    for (std::size_t k = 0; k < outer_.size(); ++k)
      if (beyond_[k] != Mesh::none) order_.emplace_back(Star_optimiser_3<K>::quality(p, star_[k]), k);
    std::sort(order_.begin(), order_.end());
    for (std::size_t i = 0; i < (std::min)(order_.size(), std::size_t(3)); ++i)
      if (may_take(beyond_[order_[i].second])) {
        cells_.push_back(beyond_[order_[i].second]);
        return true;
      }
    return false;
  }

  /// The surface of the cavity has to stay a sphere with all its vertices: the new cell has one facet in common with it
  /// and its fourth vertex isn't there yet, or two facets, and the edge opposite to their common one isn't there yet.
  bool may_take(int c) const
  {
    int common = 0;
    std::array<bool, 4> is_common{};
    for (std::size_t i = 0; i < 4; ++i) {
      const int n = mesh_.cell(c).neighbours[i];
      is_common[i] = n != Mesh::none && is_in_cavity(n);
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

  Mesh& mesh_;
  Local_counts_3 counts_;
  Star_optimiser_3<K> optimiser_;
  int last_inserted_ = Mesh::none;
  std::vector<int> cells_, ring_, link_;
  std::array<std::array<double, most_around>, most_around> best_{};
  std::array<std::array<std::size_t, most_around>, most_around> tip_{};
  std::vector<Cell_vertices> made_;
  std::vector<Facet_vertices> outer_; ///< of the cavity
  std::vector<int> beyond_;           ///< cells beyond them, or none
  std::vector<typename Star_optimiser_3<K>::Facet> star_;
  std::vector<std::pair<double, std::size_t>> order_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_LOCAL_OPERATIONS_3_H
