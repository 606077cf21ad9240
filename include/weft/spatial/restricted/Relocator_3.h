// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves many vertices of a spatial Delaunay triangulation at once and restores it by flips: the idea of filtering
// relocations (Tournois 2009, sec. 3.3.2), with all vertices moved first. Vertices that would turn a cell over are put
// back; facets that ceased to be Delaunay are flipped (2-3, 3-2, 4-4). Exact predicates decide every orientation and
// flip, cospherical points by symbolic perturbation. Unlike in the plane flips may get stuck: there a few cells are
// built anew. If that doesn't help the triangulation is a valid one but not Delaunay, which the counts tell.

#ifndef WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H
#define WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H

#include <weft/spatial/restricted/Region_rebuilder_3.h>

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace weft::internal {

/// What became of a set of moves in space.
struct Relocation_counts_3
{
  std::size_t in_place = 0;   ///< vertices that moved with the cells around them, whether or not those were flipped
  std::size_t one_by_one = 0; ///< vertices that were taken away and put back
  std::size_t rebuilt = 0;    ///< vertices that moved when the triangulation was built anew
  std::size_t put_back = 0;   ///< vertices that stayed where they were
  std::size_t flips = 0;
  std::size_t regions = 0; ///< places where flips were stuck and a few cells were built anew
  std::size_t stuck = 0;   ///< facets that weren't Delaunay after that
  std::size_t rebuilds = 0;
  // Wall time:
  double moving_seconds = 0;      ///< moving vertices and putting those back that would turn cells over
  double flipping_seconds = 0;    ///< finding what isn't Delaunay, and flips
  double rebuilding_seconds = 0;  ///< moving vertices one by one, or building anew
  double classifying_seconds = 0; ///< finding out what the new cells and facets are

  Relocation_counts_3& operator+=(const Relocation_counts_3& o)
  {
    in_place += o.in_place;
    one_by_one += o.one_by_one;
    rebuilt += o.rebuilt;
    put_back += o.put_back;
    flips += o.flips;
    regions += o.regions;
    stuck += o.stuck;
    rebuilds += o.rebuilds;
    add_times(o);
    return *this;
  }

  void add_times(const Relocation_counts_3& o)
  {
    moving_seconds += o.moving_seconds;
    flipping_seconds += o.flipping_seconds;
    rebuilding_seconds += o.rebuilding_seconds;
    classifying_seconds += o.classifying_seconds;
  }
};

/// \tparam Triangulation a CGAL Delaunay_triangulation_3 whose vertices have `id()`.
template <class Triangulation>
class Relocator_3
{
public:
  using Point = typename Triangulation::Point;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  explicit Relocator_3(Triangulation& tr) : tr_(tr) {}

  /// Puts `vertices[i]` to `targets[i]`, without changing any cell but for the places of its vertices. Linear in the
  /// number of cells around the vertices.
  /// \param changing is called with every cell before its vertices change or move.
  /// \param deferred gets the indices of the vertices that had to be put back.
  /// \pre the vertices are distinct and none of them lies on the convex hull; the triangulation is Delaunay.
  template <class Changing>
  void place(const std::vector<Vertex_handle>& vertices, const std::vector<Point>& targets, const Changing& changing,
             std::vector<std::size_t>& deferred)
  {
    old_.clear();
    for (const Vertex_handle v : vertices) old_.push_back(v->point());
    list_cells(vertices);
    for (const Cell_handle c : cells_) changing(c);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i]->set_point(targets[i]);
    put_back_inverted(vertices, deferred);
  }

  /// Where the vertices last placed were before.
  const std::vector<Point>& old_points() const { return old_; }

  /// Flips what `place()` has left that isn't Delaunay.
  template <class Changing>
  void restore_delaunay(const Changing& changing, Relocation_counts_3& counts)
  {
    queue_.clear();
    stuck_.clear();
    for (const Cell_handle c : cells_)
      for (int i = 0; i < 4; ++i)
        if (is_first(c, i) && is_bad(c, i)) enqueue(c, i);
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

  void list_cells(const std::vector<Vertex_handle>& vertices)
  {
    index_.clear();
    cells_.clear();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto id = static_cast<std::size_t>(vertices[i]->id());
      if (id >= index_.size()) index_.resize(id + 1, none);
      index_[id] = i;
    }
    if (8 * vertices.size() > tr_.number_of_vertices()) {
      for (const Cell_handle c : tr_.finite_cell_handles())
        if (has_moved(c)) cells_.push_back(c);
      return;
    }
    for (const Vertex_handle v : vertices) {
      star_.clear();
      tr_.incident_cells(v, std::back_inserter(star_));
      for (const Cell_handle c : star_)
        if (owner(c) == v) cells_.push_back(c);
    }
  }

  std::size_t index(Vertex_handle v) const
  {
    const int id = v->id();
    return id < 0 || static_cast<std::size_t>(id) >= index_.size() ? none : index_[static_cast<std::size_t>(id)];
  }

  bool has_moved(Cell_handle c) const { return owner(c) != Vertex_handle(); }

  /// The first moved vertex of a cell.
  Vertex_handle owner(Cell_handle c) const
  {
    for (int i = 0; i < 4; ++i)
      if (index(c->vertex(i)) != none) return c->vertex(i);
    return Vertex_handle();
  }

  bool is_inverted(Cell_handle c) const
  {
    return !tr_.is_infinite(c) && CGAL::orientation(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                                    c->vertex(3)->point()) != CGAL::POSITIVE;
  }

  /// Of each inverted cell one vertex goes back, if that of any is enough, else all that moved; which may turn over
  /// cells around it. Putting all of them back at once leaves more to be moved one by one.
  void put_back_inverted(const std::vector<Vertex_handle>& vertices, std::vector<std::size_t>& deferred)
  {
    deferred.clear();
    inverted_.clear();
    for (const Cell_handle c : cells_)
      if (is_inverted(c)) inverted_.push_back(c);
    const auto put_back = [&](std::size_t i) {
      index_[static_cast<std::size_t>(vertices[i]->id())] = none;
      vertices[i]->set_point(old_[i]);
      deferred.push_back(i);
      star_.clear();
      tr_.incident_cells(vertices[i], std::back_inserter(star_));
      for (const Cell_handle c : star_)
        if (is_inverted(c)) inverted_.push_back(c);
    };
    for (std::size_t k = 0; k < inverted_.size(); ++k) {
      const Cell_handle c = inverted_[k];
      if (!is_inverted(c)) continue;
      const std::size_t enough = vertex_that_turns_back(c, vertices);
      for (int i = 0; i < 4; ++i) {
        const std::size_t m = index(c->vertex(i));
        if (m != none && (enough == none || m == enough)) put_back(m);
      }
    }
    std::sort(deferred.begin(), deferred.end());
  }

  /// The first moved vertex of a cell that would be enough to put back, for it to have its orientation.
  std::size_t vertex_that_turns_back(Cell_handle c, const std::vector<Vertex_handle>& vertices) const
  {
    for (int i = 0; i < 4; ++i) {
      const std::size_t m = index(c->vertex(i));
      if (m == none) continue;
      const Point target = vertices[m]->point();
      vertices[m]->set_point(old_[m]);
      const bool is_enough = !is_inverted(c);
      vertices[m]->set_point(target);
      if (is_enough) return m;
    }
    return none;
  }

  // ---- flips

  /// Each facet once: from the one of its two moved cells that is the elder.
  bool is_first(Cell_handle c, int i) const
  {
    const Cell_handle n = c->neighbor(i);
    return !has_moved(n) || c->time_stamp() < n->time_stamp();
  }

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

  static constexpr std::size_t none = static_cast<std::size_t>(-1), most_regions = 200, most_flipped = 3;

  Triangulation& tr_;
  std::vector<Point> old_;
  std::vector<std::size_t> index_; ///< by id, place in the list of moved vertices
  std::vector<Cell_handle> cells_, star_, inverted_;
  std::vector<Queued> queue_, stuck_;
  std::optional<Region_rebuilder_3<Triangulation>> rebuilder_; ///< made when needed first
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H
