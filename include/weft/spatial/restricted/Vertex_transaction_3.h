// SPDX-License-Identifier: GPL-3.0-or-later
//
// Trying changes of one vertex of a restricted Delaunay triangulation: the vertex is taken out, and what its place was
// filled with is looked at; it is put elsewhere or left out, and all that depends on it is looked at; then the change
// is committed or rolled back. A Delaunay triangulation is determined by its points, so that rolling back restores
// every cell, facet and crease edge, though not the handles.

#ifndef WEFT_SPATIAL_RESTRICTED_VERTEX_TRANSACTION_3_H
#define WEFT_SPATIAL_RESTRICTED_VERTEX_TRANSACTION_3_H

#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <utility>
#include <vector>

namespace weft::internal {

/// The numbers of vertices that are gone for good, while many are taken out: as long as it lives, `vertices()` may have
/// null handles. `close()` gives the others new numbers; what doesn't get there, since something was thrown, is closed
/// at the end of its life.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Vacant_numbers_3
{
public:
  using Vertex_handle = typename Restricted::Vertex_handle;

  explicit Vacant_numbers_3(Restricted& mesh) : mesh_(mesh) {}
  ~Vacant_numbers_3() noexcept(false)
  {
    if (vacant_ == 0) return;
    if (std::uncaught_exceptions() == exceptions_) {
      close();
      return;
    }
    try {
      close();
    } catch (...) { // the mesh is lost with what was thrown first
    }
  }
  Vacant_numbers_3(const Vacant_numbers_3&) = delete;
  Vacant_numbers_3& operator=(const Vacant_numbers_3&) = delete;

  /// Numbers the vertices anew, in the order of their old numbers. Nothing happens if none is vacant. Linear.
  /// \returns the new numbers by the old ones, -1 for vertices that are gone.
  std::vector<int> close()
  {
    std::vector<Vertex_handle>& vertices = mesh_.vertices_;
    std::vector<int> numbers;
    int next = 0;
    for (const Vertex_handle v : vertices) numbers.push_back(v == Vertex_handle() ? -1 : next++);
    if (vacant_ == 0) return numbers;
    vacant_ = 0;
    std::vector<char>& fixed = mesh_.fixed_;
    std::size_t n = 0;
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (vertices[i] != Vertex_handle()) fixed[n++] = fixed[i];
    fixed.resize(n);
    vertices.erase(std::remove(vertices.begin(), vertices.end(), Vertex_handle()), vertices.end());
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i]->set_id(static_cast<int>(i));
    mesh_.touched_.assign(vertices.size(), mesh_.update_number_);
    mesh_.creases_are_stale_ = true;
    mesh_.update();
    return numbers;
  }

  /// To be called by the transaction that leaves a number vacant.
  void add() { ++vacant_; }

private:
  Restricted& mesh_;
  std::size_t vacant_ = 0;
  int exceptions_ = std::uncaught_exceptions(); ///< under way when it began
};

/// A change of one vertex that is under way. It is rolled back unless it is committed, also when something is thrown;
/// nothing else may change the mesh in between. Where the oracle throws while a change is rolled back, the vertices are
/// as they were, and the mesh's `update()` classifies what is left.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Vertex_transaction_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  /// Takes a vertex out. The cells that fill its place aren't classified.
  /// \pre it is neither a feature vertex nor fixed.
  Vertex_transaction_3(Restricted& mesh, Vertex_handle v)
      : mesh_(mesh), id_(v->id()), origin_(v->point()), location_(v->location())
  {
    filling_ = mesh_.take_away(v);
    state_ = State::out;
  }

  /// Inserts a new vertex at the point of a zone and classifies what that changes.
  Vertex_transaction_3(Restricted& mesh, const Zone& zone, const Vertex_location_3& location)
      : Vertex_transaction_3(mesh, zone, location, static_cast<int>(mesh.vertices().size()))
  {}

  /// The same under a number that there is: the vertex that has it gets the next free one. This restores what
  /// `leave_out()` has changed.
  Vertex_transaction_3(Restricted& mesh, const Zone& zone, const Vertex_location_3& location, int id)
      : Vertex_transaction_3(mesh, id, zone.point, location)
  {
    insert(zone, State::inserted); // this object exists already: what is thrown here has it rolled back
  }

  ~Vertex_transaction_3() noexcept(false)
  {
    if (state_ == State::none || state_ == State::closed) return;
    if (std::uncaught_exceptions() == exceptions_) {
      roll_back();
      return;
    }
    try {
      roll_back();
    } catch (...) { // the oracle throws again: the mesh is lost with what was thrown first
    }
  }
  Vertex_transaction_3(const Vertex_transaction_3&) = delete;
  Vertex_transaction_3& operator=(const Vertex_transaction_3&) = delete;

  int id() const { return id_; }
  /// Where the vertex was before.
  const Point& origin() const { return origin_; }
  const Vertex_location_3& location() const { return location_; }

  /// The cells that fill the place of the vertex while it is out; once it is placed, those of them that are left.
  const std::vector<Cell_handle>& filling() const { return filling_; }

  /// Puts the vertex that is out at the point of a zone and classifies what changed.
  void place(const Zone& zone)
  {
    CGAL_precondition(state_ == State::out || state_ == State::vacant);
    for (const Cell_handle c : filling_)
      if (c->is_classified()) mesh_.declassify(c);
    drop_cells(zone, filling_);
    mesh_.new_cells_ = filling_;
    mesh_.insert(zone, location_, id_);
    state_ = State::placed;
    mesh_.update();
  }

  /// Takes the vertex out once more that was placed.
  void take_out_again()
  {
    CGAL_precondition(state_ == State::placed);
    std::vector<Cell_handle> filling = mesh_.take_away(vertex());
    for (const Cell_handle c : filling_) {
      mesh_.declassify(c);
      mesh_.touch_vertices_of(c);
      filling.push_back(c);
    }
    filling_.swap(filling);
    state_ = State::out;
  }

  /// Leaves the vertex out and classifies what fills its place. The last vertex takes its number.
  void leave_out()
  {
    CGAL_precondition(state_ == State::out);
    give_number_away();
    state_ = State::left_out;
    classify_filling();
  }

  /// The same, but its number stays vacant until all those are closed.
  void leave_out(Vacant_numbers_3<Restricted>& numbers)
  {
    CGAL_precondition(state_ == State::out);
    state_ = State::vacant;
    numbers_ = &numbers;
    classify_filling();
  }

  /// Makes the change final.
  /// \pre the vertex isn't out.
  void commit()
  {
    CGAL_precondition(state_ != State::none && state_ != State::out && state_ != State::closed);
    if (state_ == State::vacant) numbers_->add();
    state_ = State::closed;
  }

  /// Undoes the change: the vertex is where it was, under the number that it had, or gone if it was inserted.
  void roll_back()
  {
    CGAL_precondition(state_ != State::none && state_ != State::closed);
    if (state_ == State::inserted) {
      filling_ = mesh_.take_away(vertex());
      give_number_away();
      state_ = State::closed;
      classify_filling();
      return;
    }
    if (state_ == State::placed) take_out_again();
    Zone zone; // always found: the point was there before
    if (state_ == State::left_out) {
      const bool is_classified = mesh_.new_cells_.empty(); // or the oracle threw
      find_conflict_zone(mesh_.triangulation(), origin_, is_classified ? mesh_.new_cells().front() : filling_.front(),
                         zone);
      if (!is_classified) drop_cells(zone, mesh_.new_cells_);
      insert(zone, State::closed);
    } else {
      find_conflict_zone(mesh_.triangulation(), origin_, filling_.front(), zone);
      place(zone);
    }
    state_ = State::closed;
  }

private:
  enum class State
  {
    none,     ///< nothing has been changed yet
    out,      ///< what fills its place isn't classified
    vacant,   ///< left out, its number is nobody's
    left_out, ///< and the number is that of another vertex
    placed,   ///< elsewhere
    inserted, ///< where there was no vertex
    closed    ///< committed or rolled back
  };

  Vertex_transaction_3(Restricted& mesh, int id, const Point& origin, const Vertex_location_3& location)
      : mesh_(mesh), id_(id), origin_(origin), location_(location)
  {}

  Vertex_handle vertex() const { return mesh_.vertices_[static_cast<std::size_t>(id_)]; }

  void insert(const Zone& zone, State after)
  {
    mesh_.insert(zone, location_);
    const int last = static_cast<int>(mesh_.vertices_.size()) - 1;
    state_ = after;
    try {
      mesh_.update();
    } catch (...) { // what the oracle throws
      exchange_numbers(id_, last);
      throw;
    }
    exchange_numbers(id_, last);
  }

  /// Drops those cells that a vertex at the point of a zone will replace.
  void drop_cells(const Zone& zone, std::vector<Cell_handle>& cells)
  {
    ++mesh_.batches_;
    for (const Cell_handle c : zone.cells) c->set_batch(mesh_.batches_);
    const auto is_in_zone = [this](Cell_handle c) { return c->batch() == mesh_.batches_; };
    cells.erase(std::remove_if(cells.begin(), cells.end(), is_in_zone), cells.end());
  }

  void classify_filling()
  {
    mesh_.new_cells_ = filling_;
    mesh_.update();
  }

  /// The last vertex takes the number of one that was taken away.
  void give_number_away()
  {
    auto& vertices = mesh_.vertices_;
    auto& touched = mesh_.touched_;
    auto& fixed = mesh_.fixed_;
    const auto k = static_cast<std::size_t>(id_);
    if (k + 1 < vertices.size()) {
      vertices[k] = vertices.back();
      vertices[k]->set_id(id_);
      touched[k] = touched.back();
      if (k < fixed.size()) fixed[k] = vertices.size() <= fixed.size() ? fixed[vertices.size() - 1] : char(0);
      mesh_.tracer_.renumber();
    }
    vertices.pop_back();
    touched.pop_back();
    if (fixed.size() > vertices.size()) fixed.pop_back();
  }

  /// The creases hear of it at once.
  void exchange_numbers(int i, int j)
  {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if (a == b) return;
    auto& vertices = mesh_.vertices_;
    auto& fixed = mesh_.fixed_;
    std::swap(vertices[a], vertices[b]);
    std::swap(mesh_.touched_[a], mesh_.touched_[b]);
    if (!fixed.empty()) {
      fixed.resize(vertices.size(), false);
      std::swap(fixed[a], fixed[b]);
    }
    vertices[a]->set_id(i);
    vertices[b]->set_id(j);
    mesh_.tracer_.renumber();
    mesh_.tracer_.update([](Vertex_handle) { return false; });
  }

  Restricted& mesh_;
  int id_;
  Point origin_;
  Vertex_location_3 location_;
  State state_ = State::none;
  std::vector<Cell_handle> filling_;
  Vacant_numbers_3<Restricted>* numbers_ = nullptr; ///< if its number is vacant
  int exceptions_ = std::uncaught_exceptions();     ///< under way when it began
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_VERTEX_TRANSACTION_3_H
