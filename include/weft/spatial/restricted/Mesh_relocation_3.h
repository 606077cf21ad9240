// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves many vertices of a restricted Delaunay triangulation at once (Tournois 2009, sec. 3.3.2): by flips, one by one,
// or by building it anew, whatever is fastest; and moves all of it to where neighbours lie side by side in memory.

#ifndef WEFT_SPATIAL_RESTRICTED_MESH_RELOCATION_3_H
#define WEFT_SPATIAL_RESTRICTED_MESH_RELOCATION_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Relocation_counts_3.h>
#include <weft/spatial/restricted/Relocator_3.h>
#include <weft/spatial/restricted/spatial_order_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// See `relocate()` and `sort_in_memory()`.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Mesh_relocation_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Triangulation = typename Restricted::Triangulation;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;

  explicit Mesh_relocation_3(Restricted& mesh) : mesh_(mesh) {}

  Relocation_counts_3 relocate(const std::vector<int>& ids, const std::vector<Point>& targets,
                               std::vector<std::size_t>* stayed)
  {
    std::vector<Vertex_handle> moving;
    for (const int id : ids) moving.push_back(mesh_.vertices_[static_cast<std::size_t>(id)]);
    Relocation_counts_3 counts;
    Lap_timer lap;
    std::vector<std::size_t> deferred;
    Relocator_3<Triangulation> relocator(*mesh_.tr_);
    const auto changing = [this](Cell_handle c) { mesh_.declassify(c); };
    relocator.place(moving, targets, changing, deferred);
    counts.moving_seconds = lap.seconds();
    const double most = stayed ? most_staying : most_alone;
    const bool in_place = static_cast<double>(deferred.size()) < most * static_cast<double>(mesh_.vertices_.size());
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
    mesh_.new_cells_.clear();
    for (const Cell_handle c : mesh_.tr_->finite_cell_handles()) {
      if (c->is_classified()) continue;
      mesh_.new_cells_.push_back(c);
      mesh_.touch_vertices_of(c);
    }
    mesh_.update();
    counts.classifying_seconds = lap.seconds();
    return counts;
  }

  void sort_in_memory()
  {
    Ordered_copy_3<Triangulation> copy = copy_in_order(*mesh_.tr_, mesh_.vertices_, mesh_.spatial_order());
    mesh_.facets_.set_cells(copy.cells);
    mesh_.vertices_.swap(copy.vertices);
    mesh_.tr_.swap(copy.triangulation);
    mesh_.tracer_.set_triangulation(*mesh_.tr_);
    mesh_.creases_are_stale_ = true;
    mesh_.update();
  }

private:
  /// Takes a vertex away and inserts it at its target, or where it was; whether it got there.
  bool move_alone(int id, const Point& target)
  {
    const Vertex_handle v = mesh_.vertices_[static_cast<std::size_t>(id)];
    const Point old = v->point();
    const Vertex_location_3 location = v->location();
    const Cell_handle near = mesh_.take_away(v).front();
    Zone zone;
    const bool found = find_conflict_zone(*mesh_.tr_, target, near, zone) == Zone_result::found;
    if (!found) find_conflict_zone(*mesh_.tr_, old, near, zone);
    mesh_.insert(zone, location, id);
    mesh_.new_cells_.clear();
    return found;
  }

  /// Builds the triangulation anew with some vertices elsewhere; with the old ones where two would coincide, and
  /// false.
  bool rebuild(const std::vector<int>& ids, const std::vector<Point>& targets, const std::vector<Point>& old)
  {
    std::vector<Point> points;
    std::vector<Vertex_location_3> locations;
    for (const Vertex_handle v : mesh_.vertices_) {
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
    mesh_.tr_->clear();
    mesh_.insert_box();
    mesh_.creases_are_stale_ = true;
    mesh_.facets_.clear();
    Cell_handle hint;
    for (const std::size_t i : insertion_order_3<Kernel>(points)) {
      const Vertex_handle v = mesh_.tr_->insert(points[i], hint);
      v->set_location(locations[i]);
      v->set_id(static_cast<int>(i));
      mesh_.vertices_[i] = v;
      hint = v->cell();
    }
    return mesh_.tr_->number_of_vertices() == points.size() + 8;
  }

  /// Part of the vertices to move one by one rather than to build anew: a vertex by itself takes much longer than in a
  /// new triangulation.
  static constexpr double most_alone = 0.05;
  /// The same where those vertices may as well stay: flips then take less time than building anew.
  static constexpr double most_staying = 0.5;

  Restricted& mesh_;
};

/// Moves vertices, by their ids, to new places and classifies what that changes. They move all at once and flips
/// restore the triangulation; where those get stuck, or too many vertices would have to be moved one by one, it is
/// built anew. Vertex handles don't survive, ids do. If a target coincides with another vertex, its vertex may stay
/// where it was.
/// \param stayed if given, the vertices that would have to be moved one by one stay, and this gets their places in
///   `ids`, in order.
/// \pre targets lie inside the box; those of vertices on patches and creases lie on them.
template <class Restricted>
Relocation_counts_3 relocate(Restricted& mesh, const std::vector<int>& ids,
                             const std::vector<typename Restricted::Point>& targets,
                             std::vector<std::size_t>* stayed = nullptr)
{
  return Mesh_relocation_3<Restricted>(mesh).relocate(ids, targets, stayed);
}

/// Copies the triangulation to where vertices and cells lie in memory in the spatial order, after refinement has strewn
/// them. Handles don't survive, ids do. It pays before the first sweep of smoothing.
template <class Restricted>
void sort_in_memory(Restricted& mesh)
{
  Mesh_relocation_3<Restricted>(mesh).sort_in_memory();
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_MESH_RELOCATION_3_H
