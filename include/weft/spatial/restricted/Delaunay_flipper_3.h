// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a spatial triangulation Delaunay by flips (2-3, 3-2, 4-4). Exact predicates decide every orientation and flip,
// cospherical points by symbolic perturbation. Unlike in the plane flips may get stuck: there a few cells are built
// anew. If that doesn't help the triangulation is a valid one but not Delaunay, which the counts tell.

#ifndef WEFT_SPATIAL_RESTRICTED_DELAUNAY_FLIPPER_3_H
#define WEFT_SPATIAL_RESTRICTED_DELAUNAY_FLIPPER_3_H

#include <weft/spatial/restricted/Region_rebuilder_3.h>
#include <weft/spatial/restricted/Relocation_counts_3.h>

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace weft::internal {

/// \tparam Triangulation a CGAL Delaunay_triangulation_3 whose vertices have `id()`, and they and cells `time_stamp()`.
template <class Triangulation>
class Delaunay_flipper_3
{
public:
  using Point = typename Triangulation::Point;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  explicit Delaunay_flipper_3(Triangulation& tr) : tr_(tr) {}

  /// Forgets the facets that were added.
  void clear()
  {
    queue_.clear();
    stuck_.clear();
  }

  /// The facet opposite to vertex i of a cell is to be flipped if it isn't Delaunay.
  void add(Cell_handle c, int i)
  {
    if (is_bad(c, i)) enqueue(c, i);
  }

  /// Flips what was added, and what isn't Delaunay any more after that.
  /// \param changing is called with every cell before it goes, and with every cell made.
  template <class Changing>
  void flip_all(const Changing& changing, Relocation_counts_3& counts)
  {
    while (true) {
      empty_queue(changing, counts);
      if (stuck_.empty() || !rebuild_regions(changing, counts)) break;
    }
    for (const Queued& f : stuck_) {
      Cell_handle c;
      int i;
      counts.stuck += find(f, c, i) && is_bad(c, i);
    }
  }

private:
  struct Queued
  {
    std::array<Vertex_handle, 3> facet; ///< named by its vertices: cells come and go
    Vertex_handle apex;
    Cell_handle cell;
  };

  bool is_bad(Cell_handle c, int i) const
  {
    const Cell_handle n = c->neighbor(i);
    if (tr_.is_infinite(c) || tr_.is_infinite(n)) return false;
    return tr_.side_of_sphere(c, n->vertex(n->index(c))->point(), true) == CGAL::ON_BOUNDED_SIDE;
  }

  void enqueue(Cell_handle c, int i)
  {
    queue_.push_back({{c->vertex((i + 1) & 3), c->vertex((i + 2) & 3), c->vertex((i + 3) & 3)}, c->vertex(i), c});
  }

  /// The cell that a queued facet belonged to, if it is still the same.
  bool find(const Queued& f, Cell_handle& c, int& i) const
  {
    c = f.cell;
    if (!tr_.tds().cells().is_used(c)) return false;
    if (!c->has_vertex(f.apex, i)) return false;
    for (const Vertex_handle v : f.facet)
      if (!c->has_vertex(v)) return false;
    return true;
  }

  /// Flips until nothing is left that can be; the rest is stuck.
  template <class Changing>
  void empty_queue(const Changing& changing, Relocation_counts_3& counts)
  {
    std::size_t flips_before = counts.flips;
    while (true) {
      while (!queue_.empty()) {
        const Queued f = queue_.back();
        queue_.pop_back();
        Cell_handle c;
        int i;
        if (find(f, c, i) && is_bad(c, i) && !flip(c, i, changing, counts)) stuck_.push_back(f);
      }
      // Flips elsewhere may have freed what was stuck: as long as there were some, try again.
      if (stuck_.empty() || counts.flips == flips_before) return;
      flips_before = counts.flips;
      queue_.swap(stuck_);
    }
  }

  /// Builds cells anew around what is stuck. Whether there was something to do it to, so that flips may go on.
  template <class Changing>
  bool rebuild_regions(const Changing& changing, Relocation_counts_3& counts)
  {
    if (!rebuilder_) rebuilder_.emplace(tr_);
    bool done = false;
    for (const Queued& f : stuck_) {
      Cell_handle c;
      int i;
      if (counts.regions >= most_regions || !find(f, c, i) || !is_bad(c, i)) continue;
      const std::vector<Cell_handle> made = rebuilder_->rebuild(c, i, changing);
      settle(made, changing);
      counts.regions += !made.empty();
      done = done || !made.empty();
    }
    if (done) queue_.insert(queue_.end(), stuck_.begin(), stuck_.end());
    if (done) stuck_.clear();
    return done;
  }

  template <class Changing>
  bool flip(Cell_handle c, int i, const Changing& changing, Relocation_counts_3& counts)
  {
    static constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}}; // even permutations with i first
    const Cell_handle n = c->neighbor(i);
    const Point &p = c->vertex(i)->point(), &q = n->vertex(n->index(c))->point();
    int reflex = -1, flat = -1;
    for (int k = 0; k < 3; ++k) {
      const Point &a = c->vertex(others[i][k])->point(), &b = c->vertex(others[i][(k + 1) % 3])->point();
      const CGAL::Orientation side = CGAL::orientation(p, q, a, b);
      if (side == CGAL::POSITIVE) continue;
      if (reflex >= 0 || flat >= 0) return false;
      (side == CGAL::NEGATIVE ? reflex : flat) = k;
    }
    if (reflex < 0 && flat < 0) {
      flip_facet(c, i, changing);
    } else {
      const int k = reflex >= 0 ? reflex : flat, a = others[i][k], b = others[i][(k + 1) % 3];
      if (degree(c, a, b) != (reflex >= 0 ? 3 : 4)) return false;
      if (reflex >= 0)
        flip_edge(c, a, b, changing);
      else
        flip_flat(c, i, a, b, changing);
    }
    ++counts.flips;
    return true;
  }

  int degree(Cell_handle c, int a, int b) const
  {
    int n = 0;
    auto circulator = tr_.incident_cells(c, a, b);
    const auto begin = circulator;
    do {
      if (tr_.is_infinite(circulator)) return 0;
      ++n;
    } while (++circulator != begin && n < 5);
    return n;
  }

  /// 2-3: the facet opposite to i gives way to the edge between its two apexes.
  template <class Changing>
  void flip_facet(Cell_handle c, int i, const Changing& changing)
  {
    const Cell_handle n = c->neighbor(i);
    changing(c);
    changing(n);
    const Vertex_handle p = c->vertex(i), q = n->vertex(n->index(c));
    const Cell_handle outer = c->neighbor((i + 1) & 3);
    const int k = outer->index(c);
    tr_.tds().flip_flippable(c, i);
    const Cell_handle first = outer->neighbor(k);
    std::array<Cell_handle, 3> made{first, Cell_handle(), Cell_handle()};
    std::size_t m = 1;
    for (int j = 0; j < 4; ++j)
      if (first->vertex(j) != p && first->vertex(j) != q) made[m++] = first->neighbor(j);
    settle(made, changing);
  }

  /// 3-2: the edge ab of c gives way to the facet around it.
  template <class Changing>
  void flip_edge(Cell_handle c, int a, int b, const Changing& changing)
  {
    auto circulator = tr_.incident_cells(c, a, b);
    const auto begin = circulator;
    do changing(Cell_handle(circulator));
    while (++circulator != begin);
    const Vertex_handle u = c->vertex(a);
    const Cell_handle outer = c->neighbor(b); // shares the facet of u and two of the three vertices around
    const int k = outer->index(c);
    tr_.tds().flip_flippable(c, a, b);
    const Cell_handle first = outer->neighbor(k), second = first->neighbor(first->index(u));
    settle(std::array<Cell_handle, 2>{first, second}, changing);
  }

  /// 4-4: by a 2-3 that makes a flat cell and a 3-2 that unmakes it.
  template <class Changing>
  void flip_flat(Cell_handle c, int i, int a, int b, const Changing& changing)
  {
    const Vertex_handle p = c->vertex(i), q = c->neighbor(i)->vertex(c->neighbor(i)->index(c)), u = c->vertex(a),
                        v = c->vertex(b);
    flip_facet(c, i, changing);
    Cell_handle flat;
    int ip, iq, iu, iv;
    if (!tr_.is_cell(p, q, u, v, flat, ip, iq, iu, iv)) return;
    const Cell_handle beside = flat->neighbor(iu); // of p, q, v and the facet's third vertex; stays
    flip_edge(flat, iu, iv, changing);
    enqueue(beside, beside->index(v));
  }

  /// Cells that are Delaunay among themselves, as a flip that was called for makes them: facets between them needn't be
  /// looked at.
  template <class Cells, class Changing>
  void settle(const Cells& made, const Changing& changing)
  {
    for (const Cell_handle c : made) changing(c);
    for (const Cell_handle c : made)
      for (int i = 0; i < 4; ++i)
        if (made.size() > most_flipped || std::find(made.begin(), made.end(), c->neighbor(i)) == made.end())
          enqueue(c, i);
  }

  static constexpr std::size_t most_regions = 200, most_flipped = 3;

  Triangulation& tr_;
  std::vector<Queued> queue_, stuck_;
  std::optional<Region_rebuilder_3<Triangulation>> rebuilder_; ///< made when needed first
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_DELAUNAY_FLIPPER_3_H
