// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Delaunay triangulation restricted to a domain (Tournois 2009, sec. 1.1 and 3.2.1.4): cells whose circumcenter
// lies inside, facets whose Voronoi edge meets the boundary, edges whose Voronoi facet meets a crease, all kept up to
// date while points are inserted. What refinement asks for again and again is kept with them: circumcenters, and for
// every facet and edge the farthest point where its dual meets the boundary, which is its Steiner point and the center
// of its surface Delaunay ball.

#ifndef WEFT_SPATIAL_RESTRICTED_DELAUNAY_3_H
#define WEFT_SPATIAL_RESTRICTED_DELAUNAY_3_H

#include <weft/internal/timer.h>
#include <weft/relocate/Relocator_3.h>
#include <weft/spatial/Cell_classifier_3.h>
#include <weft/spatial/Conflict_zone_3.h>
#include <weft/spatial/Crease_tracer_3.h>
#include <weft/spatial/Facet_records_3.h>
#include <weft/spatial/Feature_incidence_3.h>
#include <weft/spatial/oracle_hits_3.h>
#include <weft/spatial/spatial_order_3.h>
#include <weft/spatial/Triangulation_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace weft {

/// The restricted Delaunay triangulation of a growing set of points.
///
/// The triangulation also holds the eight corners of a box so large that their Voronoi cells don't reach the domain;
/// they have dimension -1. Other vertices have running ids, in the order of insertion.
/// \tparam Oracle a domain oracle, see Polyhedral_oracle_3.h.
template <class Oracle_>
class Restricted_delaunay_3
{
public:
  using Oracle = Oracle_;
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Surface_hit = Surface_hit_3<Kernel>;
  using Triangulation = Mesh_triangulation_3<Kernel>;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;
  using Facet = typename Triangulation::Facet;
  using Zone = Conflict_zone_3<Triangulation>;
  using Restricted_facet = Restricted_facet_3<Triangulation>;
  using Crease_edge = Crease_edge_3<Triangulation>;

  /// \param oracle has to live as long as this object.
  explicit Restricted_delaunay_3(const Oracle& oracle, int threads = 1)
      : oracle_(&oracle),
        incidence_(oracle.incidence()),
        classifier_(oracle, Oracle::is_thread_safe ? threads : 1),
        tr_(std::make_unique<Triangulation>()),
        tracer_(*tr_),
        facets_(static_cast<std::size_t>(oracle.number_of_patches()))
  {
    insert_box();
    for (std::size_t c = 0; c < oracle.number_of_creases(); ++c) {
      auto points = oracle.crease_points(static_cast<int>(c));
      if (oracle.crease_is_closed(static_cast<int>(c))) points.push_back(points.front());
      tracer_.add_crease(std::move(points));
    }
  }

  explicit Restricted_delaunay_3(const Oracle&& temporary, int threads = 1) = delete;

  const Oracle& oracle() const { return *oracle_; }
  const Feature_incidence_3& incidence() const { return incidence_; }
  const Triangulation& triangulation() const { return *tr_; }
  const Crease_tracer_3<Triangulation>& creases() const { return tracer_; }
  const Oracle_counts_3& counts() const { return classifier_.counts(); }

  /// All vertices but those of the box, by id; null for those that `coarsen_3()` has taken away so far while it runs.
  const std::vector<Vertex_handle>& vertices() const { return vertices_; }

  /// The ids in an order in which vertices near each other mostly follow each other, for whoever asks the oracle about
  /// all of them: O(n log n) when the number of vertices has changed, else that of before, though they have moved.
  const std::vector<std::size_t>& spatial_order()
  {
    if (spatial_order_.size() != vertices_.size()) {
      std::vector<Point> points;
      for (const Vertex_handle v : vertices_) points.push_back(v->point());
      spatial_order_ = order_along_curve_3<Kernel>(points);
    }
    return spatial_order_;
  }

  /// Copies the triangulation to where vertices and cells lie in memory in the spatial order, after refinement has
  /// strewn them. Handles don't survive, ids do. Takes 0.10 to 0.18 of the time of building it; a first sweep of
  /// smoothing then takes a fifth less.
  void sort_in_memory()
  {
    Ordered_copy_3<Triangulation> copy = copy_in_order(*tr_, vertices_, spatial_order());
    facets_.set_cells(copy.cells);
    vertices_.swap(copy.vertices);
    tr_.swap(copy.triangulation);
    tracer_.set_triangulation(*tr_);
    creases_are_stale_ = true;
    update();
  }

  /// Makes a vertex stay where it is: neither smoothing nor perturbation nor coarsening touch it from now on.
  void fix(Vertex_handle v)
  {
    if (fixed_.size() < vertices_.size()) fixed_.resize(vertices_.size(), false);
    fixed_[static_cast<std::size_t>(v->id())] = true;
  }
  /// Whether a vertex must stay: a feature vertex, or one that was fixed.
  bool is_fixed(Vertex_handle v) const
  {
    const auto id = static_cast<std::size_t>(v->id());
    return v->location().dimension < 1 || (id < fixed_.size() && fixed_[id]);
  }

  /// Records of restricted facets; those with a null cell are unused.
  const std::vector<Restricted_facet>& facets() const { return facets_.all(); }
  /// The restricted facet opposite to vertex i of c, or null.
  const Restricted_facet* facet(Cell_handle c, int i) const { return facets_.find(c, i); }
  /// How many restricted facets have their Steiner point on a patch.
  int number_of_facets(int patch) const { return facets_.number_on(patch); }
  /// Lists the restricted facets at every vertex, so that `for_each_facet_at()` is fast until something changes. It
  /// pays where many vertices are looked at. Not while other threads read this mesh. Linear.
  void list_facets_at_vertices() const { facets_.list_stars(vertices_.size()); }
  /// Whether that has been done since the last change.
  bool has_facets_at_vertices() const { return facets_.has_stars(); }
  /// Then calls `visit(facet)` for each of them.
  template <class Visit>
  void visit_facets_at(Vertex_handle v, const Visit& visit) const
  {
    if (v->id() >= 0) facets_.visit_star(v->id(), visit);
  }
  /// Whether a restricted facet separates the domain from the outside.
  bool is_boundary(const Restricted_facet& f) const
  {
    return f.cell->subdomain() != f.cell->neighbor(f.index)->subdomain();
  }

  /// Inserts a point by itself and classifies what that changes, creases at the next `update()`. Returns the vertex
  /// there, the one that was there before if there was one; null if the point lies outside the box.
  Vertex_handle insert(const Point& p, const Vertex_location_3& location)
  {
    Zone zone;
    const Cell_handle near = vertices_.empty() ? Cell_handle() : vertices_.back()->cell();
    const Zone_result result = find_conflict_zone(*tr_, p, near, zone);
    if (result == Zone_result::no_conflict) return tr_->nearest_vertex(p, near);
    if (result != Zone_result::found) return Vertex_handle();
    const Vertex_handle v = insert(zone, location);
    creases_are_stale_ = true;
    classify();
    return v;
  }

  /// Takes a vertex away, to be put back elsewhere with `put_back()` or left out with `leave_out()` before anything
  /// else is done. Until then the cells that fill its place aren't classified. Not for feature vertices. \returns those
  /// cells.
  std::vector<Cell_handle> take_away(Vertex_handle v)
  {
    std::vector<Cell_handle> star;
    tr_->incident_cells(v, std::back_inserter(star));
    for (const Cell_handle c : star) {
      facets_.remove(c);
      touch_vertices_of(c);
    }
    vertices_[static_cast<std::size_t>(v->id())] = Vertex_handle();
    if (!creases_are_stale_) tracer_.forget(v);
    std::vector<Cell_handle> filling;
    tr_->remove_and_give_new_cells(v, std::back_inserter(filling));
    return filling;
  }

  /// Classifies what fills the place of a vertex that was taken away; it may still be put back.
  /// \param filling as returned by `take_away()`.
  void settle(const std::vector<Cell_handle>& filling)
  {
    new_cells_ = filling;
    update();
  }

  /// Leaves a vertex out that was taken away and classifies what fills its place. The last vertex takes its number.
  /// \param filling as returned by `take_away()`.
  void leave_out(int id, const std::vector<Cell_handle>& filling)
  {
    const auto k = static_cast<std::size_t>(id);
    if (k + 1 < vertices_.size()) {
      vertices_[k] = vertices_.back();
      vertices_[k]->set_id(id);
      touched_[k] = touched_.back();
      if (k < fixed_.size()) fixed_[k] = vertices_.size() <= fixed_.size() && fixed_[vertices_.size() - 1];
      tracer_.renumber();
    }
    vertices_.pop_back();
    touched_.pop_back();
    if (fixed_.size() > vertices_.size()) fixed_.pop_back();
    new_cells_ = filling;
    update();
  }

  /// Gives the vertices new ids, in the order of the old ones, after some of them were taken away for good. \returns
  /// the new ones by the old ones, -1 for vertices that are gone.
  std::vector<int> close_gaps()
  {
    std::vector<int> numbers;
    int next = 0;
    for (const Vertex_handle v : vertices_) numbers.push_back(v == Vertex_handle() ? -1 : next++);
    std::size_t n = 0;
    for (std::size_t i = 0; i < fixed_.size(); ++i)
      if (vertices_[i] != Vertex_handle()) fixed_[n++] = fixed_[i];
    fixed_.resize(n);
    vertices_.erase(std::remove(vertices_.begin(), vertices_.end(), Vertex_handle()), vertices_.end());
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i]->set_id(static_cast<int>(i));
    touched_.assign(vertices_.size(), update_number_);
    creases_are_stale_ = true;
    update();
    return numbers;
  }

  /// Exchanges the numbers of two vertices; the creases hear of it at the next `update()`, which is done at once.
  void exchange_numbers(int i, int j)
  {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if (a == b) return;
    std::swap(vertices_[a], vertices_[b]);
    std::swap(touched_[a], touched_[b]);
    if (!fixed_.empty()) {
      fixed_.resize(vertices_.size(), false);
      std::swap(fixed_[a], fixed_[b]);
    }
    vertices_[a]->set_id(i);
    vertices_[b]->set_id(j);
    tracer_.renumber();
    tracer_.update([](Vertex_handle) { return false; });
  }

  /// Removes the vertex that was inserted last and classifies what fills its place.
  void remove_last()
  {
    const std::vector<Cell_handle> filling = take_away(vertices_.back());
    leave_out(static_cast<int>(vertices_.size()) - 1, filling);
  }

  /// Takes a vertex away that was just put back: what its place was filled with before is part of the filling again.
  std::vector<Cell_handle> take_away_again(Vertex_handle v)
  {
    std::vector<Cell_handle> filling = take_away(v);
    for (const Cell_handle c : filling_left_) {
      declassify(c);
      touch_vertices_of(c);
      filling.push_back(c);
    }
    return filling;
  }

  /// Puts a vertex back that was taken away: at the point of a zone, under its number, and classifies what changed.
  /// \param filling as returned by `take_away()`.
  Vertex_handle put_back(const Zone& zone, const Vertex_location_3& location, int id,
                         const std::vector<Cell_handle>& filling)
  {
    ++batches_;
    for (const Cell_handle c : zone.cells) c->set_batch(batches_);
    for (const Cell_handle c : filling)
      if (c->is_classified()) declassify(c);
    new_cells_.clear();
    for (const Cell_handle c : filling)
      if (c->batch() != batches_) new_cells_.push_back(c);
    filling_left_ = new_cells_;
    const Vertex_handle v = insert(zone, location, id);
    update();
    return v;
  }

  /// Inserts a point whose conflict zone is known. Zones inserted between two calls of `update()` have to be
  /// independent, see `find_conflict_zone()`.
  Vertex_handle insert(const Zone& zone, const Vertex_location_3& location)
  {
    vertices_.emplace_back();
    touched_.push_back(update_number_);
    return insert(zone, location, static_cast<int>(vertices_.size()) - 1);
  }

private:
  Vertex_handle insert(const Zone& zone, const Vertex_location_3& location, int id)
  {
    for (const Cell_handle c : zone.cells) facets_.remove(c);
    const Facet outer = zone.hull.front();
    const Cell_handle inner = outer.first->neighbor(outer.second);
    const Vertex_handle v =
        tr_->insert_in_hole(zone.point, zone.cells.begin(), zone.cells.end(), inner, inner->index(outer.first));
    v->set_location(location);
    v->set_id(id);
    vertices_[static_cast<std::size_t>(id)] = v;
    for (const Facet& f : zone.hull) {
      const Cell_handle c = f.first->neighbor(f.second);
      touch_vertices_of(c);
      new_cells_.push_back(c);
    }
    return v;
  }

public:
  /// Inserts points inside one after the other, each near the one before, and classifies only what is there at the end.
  /// \param subdomains of the points.
  void insert(const std::vector<Point>& points, const std::vector<int>& subdomains)
  {
    Zone zone;
    creases_are_stale_ = true;
    Cell_handle hint = vertices_.empty() ? Cell_handle() : vertices_.back()->cell();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (find_conflict_zone(*tr_, points[i], hint, zone) != Zone_result::found) continue;
      hint = insert(zone, {3, subdomains[i]})->cell();
      new_cells_.clear(); // some of them don't live to see the end
    }
    for (const Cell_handle c : tr_->finite_cell_handles())
      if (!c->is_classified()) new_cells_.push_back(c);
    classify();
  }

  /// Inserts distinct points, each with its location, and classifies what is there at the end. Points are numbered in
  /// the order given, after the vertices that there are. \pre they lie inside the box.
  void insert(const std::vector<Point>& points, const std::vector<Vertex_location_3>& locations)
  {
    const std::size_t before = vertices_.size();
    vertices_.resize(before + points.size());
    touched_.resize(vertices_.size(), update_number_);
    Zone zone;
    creases_are_stale_ = true;
    Cell_handle hint;
    for (const std::size_t i : insertion_order_3<Kernel>(points)) {
      if (find_conflict_zone(*tr_, points[i], hint, zone) != Zone_result::found) continue;
      hint = insert(zone, locations[i], static_cast<int>(before + i))->cell();
      new_cells_.clear(); // some of them don't live to see the end
    }
    for (const Cell_handle c : tr_->finite_cell_handles())
      if (!c->is_classified()) new_cells_.push_back(c);
    update();
  }

  /// Moves vertices, by their ids, to new places and classifies what that changes. They move all at once and flips
  /// restore the triangulation; where those get stuck, or too many vertices would have to be moved one by one, it is
  /// built anew. Vertex handles don't survive, ids do. If a target coincides with another vertex, its vertex may stay
  /// where it was.
  /// \param stayed if given, the vertices that would have to be moved one by one stay, and this gets their places in
  ///   `ids`, in order.
  /// \pre targets lie inside the box; those of vertices on patches and creases lie on them.
  Relocation_counts_3 relocate(const std::vector<int>& ids, const std::vector<Point>& targets,
                               std::vector<std::size_t>* stayed = nullptr)
  {
    std::vector<Vertex_handle> moving;
    for (const int id : ids) moving.push_back(vertices_[static_cast<std::size_t>(id)]);
    Relocation_counts_3 counts;
    internal::Lap_timer lap;
    std::vector<std::size_t> deferred;
    Relocator_3<Triangulation> relocator(*tr_);
    const auto changing = [this](Cell_handle c) { declassify(c); };
    relocator.place(moving, targets, changing, deferred);
    counts.moving_seconds = lap.seconds();
    const double most = stayed ? most_staying : most_alone;
    const bool in_place = static_cast<double>(deferred.size()) < most * static_cast<double>(vertices_.size());
    if (in_place) relocator.restore_delaunay(changing, counts);
    counts.flipping_seconds = lap.seconds();
    if (in_place && counts.stuck == 0) {
      counts.in_place = ids.size() - deferred.size();
      if (stayed) {
        counts.put_back = deferred.size();
        stayed->swap(deferred);
        deferred.clear();
      }
      for (const std::size_t i : deferred) ++(move_alone(ids[i], targets[i]) ? counts.one_by_one : counts.put_back);
    } else {
      ++counts.rebuilds;
      const bool done = rebuild(ids, targets, relocator.old_points());
      (done ? counts.rebuilt : counts.put_back) = ids.size();
    }
    counts.rebuilding_seconds = lap.seconds();
    new_cells_.clear();
    for (const Cell_handle c : tr_->finite_cell_handles()) {
      if (c->is_classified()) continue;
      new_cells_.push_back(c);
      touch_vertices_of(c);
    }
    update();
    counts.classifying_seconds = lap.seconds();
    return counts;
  }

  /// Classifies what insertions have changed: cells, facets and crease edges.
  void update()
  {
    if (creases_are_stale_) {
      tracer_.trace_all();
      creases_are_stale_ = false;
    } else {
      tracer_.update([this](Vertex_handle v) {
        return v->id() < 0 || touched_[static_cast<std::size_t>(v->id())] == update_number_;
      });
    }
    classify();
  }

  /// Number of batches so far; whoever claims zones counts it up, since cells remember it.
  int& batches() { return batches_; }
  int batches() const { return batches_; }

  /// A number that grows whenever what is classified has changed.
  int version() const { return update_number_; }
  /// The version of the mesh before the cells around a vertex changed last.
  int changed_at(Vertex_handle v) const { return touched_[static_cast<std::size_t>(v->id())]; }
  /// Makes a vertex count as changed in this version.
  void set_changed(Vertex_handle v) { touch(v); }
  /// The same for a facet, by its record.
  void set_changed(int record) { facets_.set_version(record, update_number_); }

  /// Cells created before the last call of `update()` and after the one before.
  const std::vector<Cell_handle>& new_cells() const { return classifier_.cells(); }
  /// Numbers of the facet records made by the last call of `update()`.
  const std::vector<int>& new_facets() const { return facets_.newest(); }

  /// Whether a cell has a vertex of the box: its circumcenter lies outside of the domain.
  static bool is_at_box(Cell_handle c)
  {
    for (int i = 0; i < 4; ++i)
      if (c->vertex(i)->location().dimension < 0) return true;
    return false;
  }

private:
  /// Part of the vertices to move one by one rather than to build anew. A vertex takes 40 us by itself and 3 us in a
  /// new triangulation, which flips needn't then have mended.
  static constexpr double most_alone = 0.05;
  /// The same where those vertices may as well stay. A first sweep of smoothing leaves 12 to 23 per cent of them; its
  /// flips, 1.3 a vertex, take half as long as building anew.
  static constexpr double most_staying = 0.5;

  void insert_box()
  {
    const CGAL::Bbox_3 b = oracle_->bbox();
    const double x = 0.5 * (b.xmin() + b.xmax()), y = 0.5 * (b.ymin() + b.ymax()), z = 0.5 * (b.zmin() + b.zmax());
    // A point of the domain is at most one diagonal away from any vertex in it, and at least 1.5 from these corners.
    const double r = 2 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    for (int i = 0; i < 8; ++i) tr_->insert(Point(i & 1 ? x + r : x - r, i & 2 ? y + r : y - r, i & 4 ? z + r : z - r));
  }

  void classify()
  {
    classifier_.classify(new_cells_);
    facets_.add(classifier_.facets(), update_number_);
    ++update_number_;
    new_cells_.clear();
  }

  void declassify(Cell_handle c)
  {
    facets_.remove(c);
    c->set_classified(false);
  }

  /// Takes a vertex away and inserts it at its target, or where it was; whether it got there.
  bool move_alone(int id, const Point& target)
  {
    const Vertex_handle v = vertices_[static_cast<std::size_t>(id)];
    const Point old = v->point();
    const Vertex_location_3 location = v->location();
    const Cell_handle near = take_away(v).front();
    Zone zone;
    const bool found = find_conflict_zone(*tr_, target, near, zone) == Zone_result::found;
    if (!found) find_conflict_zone(*tr_, old, near, zone);
    insert(zone, location, id);
    new_cells_.clear();
    return found;
  }

  /// Builds the triangulation anew with some vertices elsewhere; with the old ones where two would coincide, and
  /// false.
  bool rebuild(const std::vector<int>& ids, const std::vector<Point>& targets, const std::vector<Point>& old)
  {
    std::vector<Point> points;
    std::vector<Vertex_location_3> locations;
    for (const Vertex_handle v : vertices_) {
      points.push_back(v->point());
      locations.push_back(v->location());
    }
    const auto set = [&](const std::vector<Point>& values) {
      for (std::size_t i = 0; i < ids.size(); ++i) points[static_cast<std::size_t>(ids[i])] = values[i];
    };
    set(targets);
    if (build(points, locations)) return true;
    set(old);
    build(points, locations);
    return false;
  }

  /// Whether all points are distinct.
  bool build(const std::vector<Point>& points, const std::vector<Vertex_location_3>& locations)
  {
    tr_->clear();
    insert_box();
    creases_are_stale_ = true;
    facets_.clear();
    Cell_handle hint;
    for (const std::size_t i : insertion_order_3<Kernel>(points)) {
      const Vertex_handle v = tr_->insert(points[i], hint);
      v->set_location(locations[i]);
      v->set_id(static_cast<int>(i));
      vertices_[i] = v;
      hint = v->cell();
    }
    return tr_->number_of_vertices() == points.size() + 8;
  }

  void touch(Vertex_handle v)
  {
    if (v->id() >= 0) touched_[static_cast<std::size_t>(v->id())] = update_number_;
  }

  void touch_vertices_of(Cell_handle c)
  {
    for (int i = 0; i < 4; ++i) touch(c->vertex(i));
  }

  const Oracle* oracle_;
  Feature_incidence_3 incidence_;
  Cell_classifier_3<Triangulation, Oracle> classifier_;
  std::unique_ptr<Triangulation> tr_; ///< at a fixed place, so that handles survive moves of this object
  Crease_tracer_3<Triangulation> tracer_;
  mutable Facet_records_3<Triangulation> facets_; ///< as for what it says of vertices
  std::vector<Vertex_handle> vertices_;
  std::vector<std::size_t> spatial_order_; ///< of the vertices at some time
  std::vector<char> fixed_;                ///< by vertex, those at the end may be missing: see `is_fixed()`
  std::vector<int> touched_;               ///< by vertex: number of the update before which its star changed last
  int update_number_ = 0;
  int batches_ = 0;
  bool creases_are_stale_ = true;      ///< single insertions don't follow them at once
  std::vector<Cell_handle> new_cells_; ///< not classified yet
  /// Cells that filled the place of the vertex put back last and are there still.
  std::vector<Cell_handle> filling_left_;
};

/// Calls `visit(facet)` for each restricted facet at a vertex, once; `visit` mustn't come back here. Linear in the
/// cells around it, or in those facets if they are listed.
template <class Restricted, class Visit>
void for_each_facet_at(const Restricted& mesh, typename Restricted::Vertex_handle v, const Visit& visit)
{
  if (mesh.has_facets_at_vertices()) return mesh.visit_facets_at(v, visit);
  thread_local std::vector<typename Restricted::Cell_handle> cells;
  cells.clear();
  mesh.triangulation().incident_cells(v, std::back_inserter(cells));
  for (const auto c : cells)
    for (int i = 0; i < 4; ++i)
      if (c->vertex(i) != v)
        if (const auto* f = mesh.facet(c, i); f && f->cell == c) visit(*f);
}

} // namespace weft

#endif // WEFT_SPATIAL_RESTRICTED_DELAUNAY_3_H
