// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Delaunay triangulation restricted to a domain (Tournois 2009, sec. 1.1 and 3.2.1.4): cells whose circumcenter
// lies inside, facets whose Voronoi edge meets the boundary, edges whose Voronoi facet meets a crease, all kept up to
// date while points are inserted. What refinement asks for again and again is kept with them: circumcenters, and for
// every facet and edge the farthest point where its dual meets the boundary, which is its Steiner point and the center
// of its surface Delaunay ball.

#ifndef WEFT_SPATIAL_RESTRICTED_RESTRICTED_DELAUNAY_3_H
#define WEFT_SPATIAL_RESTRICTED_RESTRICTED_DELAUNAY_3_H

#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/restricted/Cell_classifier_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Crease_tracer_3.h>
#include <weft/spatial/restricted/Facet_records_3.h>
#include <weft/spatial/restricted/insert_in_streams_3.h>
#include <weft/spatial/restricted/Mesh_triangulation_3.h>
#include <weft/spatial/restricted/spatial_order_3.h>
#include <weft/spatial/restricted/Star_filling_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

// What changes a mesh other than by inserting into it; each in a header of its own.
template <class Restricted>
class Vertex_transaction_3;
template <class Restricted>
class Vacant_numbers_3;
template <class Restricted>
class Moves_together_3;
template <class Restricted>
class Mesh_relocation_3;

} // namespace internal

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
  using Zone = internal::Conflict_zone_3<Triangulation>;
  using Restricted_facet = internal::Restricted_facet_3<Triangulation>;
  using Crease_edge = internal::Crease_edge_3<Triangulation>;

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
  const internal::Crease_tracer_3<Triangulation>& creases() const { return tracer_; }
  /// How many threads may ask the oracle at once.
  int threads() const { return classifier_.threads(); }
  const internal::Oracle_counts_3& counts() const { return classifier_.counts(); }
  /// Adds questions that were asked to prepare changes.
  void add_counts(const internal::Oracle_counts_3& counts) { classifier_.add_counts(counts); }

  /// All vertices but those of the box, by id; null for those that `coarsen_3()` has taken away so far while it runs.
  const std::vector<Vertex_handle>& vertices() const { return vertices_; }

  /// The ids in an order in which vertices near each other mostly follow each other, for whoever asks the oracle about
  /// all of them: O(n log n) when the number of vertices has changed, else that of before, though they have moved.
  const std::vector<std::size_t>& spatial_order()
  {
    if (spatial_order_.size() != vertices_.size()) {
      std::vector<Point> points;
      for (const Vertex_handle v : vertices_) points.push_back(v->point());
      spatial_order_ = internal::order_along_curve_3<Kernel>(points);
    }
    return spatial_order_;
  }

  /// Makes a vertex stay where it is: neither smoothing nor perturbation nor coarsening touch it from now on.
  void fix(Vertex_handle v) { set_fixed(v, fixed_for_good); }
  /// Takes `fix()` back.
  void release(Vertex_handle v)
  {
    if (is_fixed(v) && !is_fixed_with_twin(v)) set_fixed(v, false);
  }
  /// The same because of a twin beside a small angle of the boundary; it may move within rounding.
  void fix_with_twin(Vertex_handle v)
  {
    if (!is_fixed(v)) set_fixed(v, fixed_with_twin);
  }
  bool is_fixed_with_twin(Vertex_handle v) const
  {
    const auto id = static_cast<std::size_t>(v->id());
    return v->id() >= 0 && id < fixed_.size() && fixed_[id] == fixed_with_twin;
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
  /// Calls `visit(facet)` for each restricted facet at a vertex; `visit` mustn't change the mesh. Linear in their
  /// number.
  template <class Visit>
  void visit_facets_at(Vertex_handle v, const Visit& visit) const
  {
    facets_.visit_star(v, visit);
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
    const internal::Zone_result result = internal::find_conflict_zone(*tr_, p, near, zone);
    if (result == internal::Zone_result::no_conflict) return tr_->nearest_vertex(p, near);
    if (result != internal::Zone_result::found) return Vertex_handle();
    const Vertex_handle v = insert(zone, location);
    creases_are_stale_ = true;
    classify();
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

  /// Inserts points inside and classifies only what is there at the end. Points are numbered in the order given, after
  /// the vertices that there are.
  /// \param points in an order in which to insert them, see `insertion_order_3()`.
  /// \param subdomains of the points.
  void insert(const std::vector<Point>& points, const std::vector<int>& subdomains)
  {
    const std::size_t before = vertices_.size();
    vertices_.resize(before + points.size());
    touched_.resize(vertices_.size(), update_number_);
    creases_are_stale_ = true;
    internal::insert_in_streams_3(*tr_, points, before == 0 ? Cell_handle() : vertices_[before - 1]->cell(), threads(),
                                  batches_, [&](const Zone& zone, std::size_t i) {
                                    new_cells_.clear(); // some of them don't live to see the end
                                    return insert(zone, {3, subdomains[i]}, static_cast<int>(before + i));
                                  });
    vertices_.erase(
        std::remove(vertices_.begin() + static_cast<std::ptrdiff_t>(before), vertices_.end(), Vertex_handle()),
        vertices_.end()); // of points where there was a vertex already
    for (std::size_t i = before; i < vertices_.size(); ++i) vertices_[i]->set_id(static_cast<int>(i));
    touched_.resize(vertices_.size());
    new_cells_.clear();
    for (const Cell_handle c : tr_->finite_cell_handles())
      if (!c->is_classified()) new_cells_.push_back(c);
    classify();
  }

  /// Inserts distinct points, each with its location, and classifies what is there at the end. Points are numbered in
  /// the order given, after the vertices that there are.
  /// \pre they lie inside the box.
  void insert(const std::vector<Point>& points, const std::vector<Vertex_location_3>& locations)
  {
    const std::size_t before = vertices_.size();
    vertices_.resize(before + points.size());
    touched_.resize(vertices_.size(), update_number_);
    Zone zone;
    creases_are_stale_ = true;
    Cell_handle hint;
    for (const std::size_t i : internal::insertion_order_3<Kernel>(points)) {
      if (internal::find_conflict_zone(*tr_, points[i], hint, zone) != internal::Zone_result::found) continue;
      hint = insert(zone, locations[i], static_cast<int>(before + i))->cell();
      new_cells_.clear(); // some of them don't live to see the end
    }
    for (const Cell_handle c : tr_->finite_cell_handles())
      if (!c->is_classified()) new_cells_.push_back(c);
    update();
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
  friend class internal::Vertex_transaction_3<Restricted_delaunay_3>;
  friend class internal::Vacant_numbers_3<Restricted_delaunay_3>;
  friend class internal::Moves_together_3<Restricted_delaunay_3>;
  friend class internal::Mesh_relocation_3<Restricted_delaunay_3>;

  static constexpr char fixed_for_good = 1, fixed_with_twin = 2;

  void set_fixed(Vertex_handle v, char how)
  {
    if (fixed_.size() < vertices_.size()) fixed_.resize(vertices_.size(), false);
    fixed_[static_cast<std::size_t>(v->id())] = how;
  }

  void insert_box()
  {
    const CGAL::Bbox_3 b = oracle_->bbox();
    const double x = 0.5 * (b.xmin() + b.xmax()), y = 0.5 * (b.ymin() + b.ymax()), z = 0.5 * (b.zmin() + b.zmax());
    // A point of the domain is at most one diagonal away from any vertex in it, and at least 1.5 from these corners.
    const double r = 2 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    for (int i = 0; i < 8; ++i) tr_->insert(Point(i & 1 ? x + r : x - r, i & 2 ? y + r : y - r, i & 4 ? z + r : z - r));
  }

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

  /// Takes a vertex out and leaves its number vacant.
  /// \returns the cells that fill its place, not classified.
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
    if (filling_.find(*tr_, v, star))
      filling_.replace(*tr_, v, star, filling);
    else
      tr_->remove_and_give_new_cells(v, std::back_inserter(filling));
    return filling;
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
  internal::Cell_classifier_3<Triangulation, Oracle> classifier_;
  std::unique_ptr<Triangulation> tr_; ///< at a fixed place, so that handles survive moves of this object
  internal::Crease_tracer_3<Triangulation> tracer_;
  internal::Facet_records_3<Triangulation> facets_;
  internal::Star_filling_3<Triangulation> filling_; ///< of the vertex that is taken away
  std::vector<Vertex_handle> vertices_;
  std::vector<std::size_t> spatial_order_; ///< of the vertices at some time
  std::vector<char> fixed_;                ///< by vertex, those at the end may be missing: see `is_fixed()`
  std::vector<int> touched_;               ///< by vertex: number of the update before which its star changed last
  int update_number_ = 0;
  int batches_ = 0;
  bool creases_are_stale_ = true;      ///< single insertions don't follow them at once
  std::vector<Cell_handle> new_cells_; ///< not classified yet
};

} // namespace weft

#endif // WEFT_SPATIAL_RESTRICTED_RESTRICTED_DELAUNAY_3_H
