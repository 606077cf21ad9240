// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves many vertices of a spatial Delaunay triangulation at once and restores it by flips: the idea of filtering
// relocations (Tournois 2009, sec. 3.3.2), with all vertices moved first. Vertices that would turn a cell over are put
// back, as exact predicates decide; `Delaunay_flipper_3` then flips facets that ceased to be Delaunay.

#ifndef WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H
#define WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H

#include <weft/spatial/restricted/Delaunay_flipper_3.h>
#include <weft/spatial/restricted/Relocation_counts_3.h>

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace weft::internal {

/// \tparam Triangulation a CGAL Delaunay_triangulation_3 whose vertices have `id()`.
template <class Triangulation>
class Relocator_3
{
public:
  using Point = typename Triangulation::Point;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  explicit Relocator_3(Triangulation& tr) : tr_(tr), flipper_(tr) {}

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
    flipper_.clear();
    for (const Cell_handle c : cells_)
      for (int i = 0; i < 4; ++i)
        if (is_first(c, i)) flipper_.add(c, i);
    flipper_.flip_all(changing, counts);
  }

private:
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

  /// Each facet once: from the one of its two moved cells that is the elder.
  bool is_first(Cell_handle c, int i) const
  {
    const Cell_handle n = c->neighbor(i);
    return !has_moved(n) || c->time_stamp() < n->time_stamp();
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Triangulation& tr_;
  std::vector<Point> old_;
  std::vector<std::size_t> index_; ///< by id, place in the list of moved vertices
  std::vector<Cell_handle> cells_, star_, inverted_;
  Delaunay_flipper_3<Triangulation> flipper_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_RELOCATOR_3_H
