// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves of several vertices of a restricted Delaunay triangulation that don't touch each other: what all of them change
// is classified at once, and some of them may be taken back then. Of what each has made, several threads can judge.

#ifndef WEFT_SPATIAL_RESTRICTED_MOVES_TOGETHER_3_H
#define WEFT_SPATIAL_RESTRICTED_MOVES_TOGETHER_3_H

#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Moves_together_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  /// \param mesh has to live as long as this object.
  explicit Moves_together_3(Restricted& mesh) : mesh_(mesh) {}

  void begin()
  {
    moves_.clear();
    others_.clear();
    first_batch_ = mesh_.batches_ + 1;
  }

  /// Moves a vertex, by its id, unless that would change what another move has made; whether it did. Nothing is
  /// classified.
  /// \pre it is neither a feature vertex nor fixed.
  bool move(int id, const Point& target)
  {
    const Vertex_handle v = vertex(id);
    star_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(star_));
    if (std::any_of(star_.begin(), star_.end(), [this](Cell_handle c) { return is_made(c); })) return false;
    moves_.push_back({id, v->point(), v->location(), 0, {}, false, {}});
    Move& m = moves_.back();
    m.cells = mesh_.take_away(v);
    const Cell_handle near = m.cells.front();
    const bool fits =
        find_conflict_zone(mesh_.triangulation(), target, near, zone_) == Zone_result::found &&
        std::none_of(zone_.cells.begin(), zone_.cells.end(), [this](Cell_handle c) { return is_made(c); });
    if (!fits) find_conflict_zone(mesh_.triangulation(), m.origin, near, zone_);
    insert(m);
    if (fits) return true;
    others_.insert(others_.end(), m.cells.begin(), m.cells.end());
    moves_.pop_back();
    return false;
  }

  /// How many moves were made since `begin()`.
  std::size_t size() const { return moves_.size(); }
  Vertex_handle vertex_of(std::size_t k) const { return vertex(moves_[k].id); }
  const Point& origin(std::size_t k) const { return moves_[k].origin; }

  /// The cells that move k has made, once they are classified.
  const std::vector<Cell_handle>& cells(std::size_t k) const { return moves_[k].cells; }

  /// The records of their restricted facets.
  std::vector<int> facets(std::size_t k) const
  {
    std::vector<int> records;
    for (const Cell_handle c : moves_[k].cells)
      for (int i = 0; i < 4; ++i)
        if (c->facet_record(i) >= 0) records.push_back(c->facet_record(i));
    std::sort(records.begin(), records.end());
    records.erase(std::unique(records.begin(), records.end()), records.end());
    return records;
  }

  /// Classifies what the moves, or those taken back, have made.
  void classify()
  {
    mesh_.new_cells_ = others_;
    others_.clear();
    for (Move& m : moves_) {
      if (!m.is_new) continue;
      mesh_.new_cells_.insert(mesh_.new_cells_.end(), m.cells.begin(), m.cells.end());
      m.is_new = false;
    }
    mesh_.update();
  }

  /// Takes move k back. Nothing is classified.
  /// \returns the moves whose cells that has changed, and which therefore have to be taken back, too.
  std::vector<std::size_t> take_back(std::size_t k)
  {
    Move& m = moves_[k];
    star_.clear();
    mesh_.triangulation().incident_cells(vertex(m.id), std::back_inserter(star_));
    std::vector<std::size_t> changed;
    note_others(star_, k, changed);
    forget(star_, m);
    std::vector<Cell_handle> filling = mesh_.take_away(vertex(m.id));
    for (const Cell_handle c : m.rest) {
      if (c->is_classified()) mesh_.declassify(c);
      mesh_.touch_vertices_of(c);
      filling.push_back(c);
    }
    find_conflict_zone(mesh_.triangulation(), m.origin, filling.front(), zone_);
    note_others(zone_.cells, k, changed);
    forget(zone_.cells, m);
    m.cells = filling;
    insert(m);
    others_.insert(others_.end(), m.cells.begin(), m.cells.end());
    m.cells.clear();
    m.is_new = false;
    return changed;
  }

private:
  struct Move
  {
    int id;
    Point origin;
    Vertex_location_3 location;
    int batch;                      ///< that claims its cells
    std::vector<Cell_handle> cells; ///< made
    bool is_new;                    ///< whether these aren't classified
    std::vector<Cell_handle> rest;  ///< of these, those that aren't at the vertex
  };

  Vertex_handle vertex(int id) const { return mesh_.vertices_[static_cast<std::size_t>(id)]; }

  bool is_made(Cell_handle c) const { return c->batch() >= first_batch_; }

  /// Adds the moves but one that have made some of these cells.
  void note_others(const std::vector<Cell_handle>& cells, std::size_t but, std::vector<std::size_t>& others) const
  {
    for (const Cell_handle c : cells) {
      if (c->batch() == moves_[but].batch || !is_made(c)) continue;
      for (std::size_t j = 0; j < moves_.size(); ++j)
        if (moves_[j].batch == c->batch() && std::find(others.begin(), others.end(), j) == others.end())
          others.push_back(j);
    }
  }

  /// Marks cells that are about to go.
  int mark(const std::vector<Cell_handle>& cells)
  {
    const int batch = ++mesh_.batches_;
    for (const Cell_handle c : cells) c->set_batch(batch);
    return batch;
  }

  /// Drops cells that are about to go from all lists, if another move than m has made some of them.
  void forget(const std::vector<Cell_handle>& going, const Move& m)
  {
    const bool is_alone =
        std::all_of(going.begin(), going.end(), [&](Cell_handle c) { return c->batch() == m.batch || !is_made(c); });
    if (is_alone) return;
    const int batch = mark(going);
    drop(others_, batch);
    for (Move& other : moves_) {
      drop(other.cells, batch);
      drop(other.rest, batch);
    }
  }

  static void drop(std::vector<Cell_handle>& cells, int batch)
  {
    cells.erase(std::remove_if(cells.begin(), cells.end(), [batch](Cell_handle c) { return c->batch() == batch; }),
                cells.end());
  }

  /// Inserts the vertex at the point of the zone; `cells` are those that fill its former place.
  void insert(Move& m)
  {
    drop(m.cells, mark(zone_.cells));
    m.rest = m.cells;
    mesh_.insert(zone_, m.location, m.id);
    mesh_.new_cells_.clear();
    for (const auto& f : zone_.hull) m.cells.push_back(f.first->neighbor(f.second));
    m.batch = ++mesh_.batches_;
    for (const Cell_handle c : m.cells) c->set_batch(m.batch);
    m.is_new = true;
  }

  Restricted& mesh_;
  std::vector<Move> moves_;
  std::vector<Cell_handle> others_; ///< made by moves that were taken back, not classified
  int first_batch_ = 0;
  std::vector<Cell_handle> star_;
  Zone zone_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_MOVES_TOGETHER_3_H
