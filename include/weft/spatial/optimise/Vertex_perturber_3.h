// SPDX-License-Identifier: GPL-3.0-or-later
//
// One step of sliver removal (Tournois 2009, sec. 3.2.2): a vertex is moved, inserted or removed, and the change kept
// if the worst of the cells made is better than the worst of those unmade and the boundary and all criteria hold.
//
// Other than in Alg. 7, the vertex is taken away once, and places are judged by their conflict zones before anything is
// inserted. Inserting and removing vertices is what sec. 4.1 calls pliant.

#ifndef WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H
#define WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H

#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/optimise/Place_search_3.h>
#include <weft/spatial/optimise/sliver_gradients_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Vertex_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vector = typename Kernel::Vector_3;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Judge = Perturbation_judge_3<Restricted>;
  using Search = Place_search_3<Restricted>;
  using Place = typename Search::Place;
  using Transaction = Vertex_transaction_3<Restricted>;

  /// When a vertex is to be moved.
  enum class Purpose
  {
    mend,   ///< a cell at it is below the bound
    better, ///< always, if that betters its star
    shake,  ///< always, if nothing it makes is below the bound: makes room for others
    kick    ///< always, if nothing it makes is below the bound for kicks
  };

  Vertex_perturber_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options,
                     Perturb_report_3& report)
      : mesh_(mesh), report_(report), judge_(mesh, guard), search_(mesh, judge_, options, report)
  {}

  Judge& judge() { return judge_; }
  const Judge& judge() const { return judge_; }

  /// Cells that measure more are slivers.
  void set_bound(double bound) { bound_ = bound; }
  void set_kick_bound(double bound) { kick_bound_ = bound; }

  /// Changes from here on may be undone.
  void begin() { log_.clear(); }

  /// Undoes all changes since `begin()`: a Delaunay triangulation is determined by its points.
  void undo()
  {
    for (; !log_.empty(); log_.pop_back()) {
      const Change& change = log_.back();
      if (change.kind == Change::insertion) {
        Transaction removal(mesh_, mesh_.vertices().back());
        removal.leave_out();
        removal.commit();
      } else if (change.kind == Change::move) {
        Transaction move(mesh_, vertex(change.id));
        take_filling(move);
        judge_.find_zone(change.point, target_.near);
        move.place(judge_.zone());
        move.commit();
      } else {
        judge_.find_zone(change.point, mesh_.vertices().front()->cell());
        Transaction(mesh_, judge_.zone(), change.location, change.id).commit();
      }
    }
  }

  /// Moves a vertex; whether it was moved. Feature vertices stay.
  bool move(int id, Purpose purpose, int trials)
  {
    const Vertex_handle v = vertex(id);
    target_.location = v->location();
    if (mesh_.is_fixed(v)) return false;
    load_star(v);
    if (purpose == Purpose::mend && target_.limit <= bound_) return false; // mended meanwhile
    if (purpose == Purpose::mend || purpose == Purpose::better) target_.limit -= Judge::least_gain;
    if (purpose == Purpose::shake) target_.limit = (std::max)(target_.limit, bound_);
    if (purpose == Purpose::kick) target_.limit = (std::max)(target_.limit, kick_bound_);
    target_.enough = purpose == Purpose::kick ? kick_bound_ : bound_;
    target_.most = Judge::no_good;
    ++report_.tried_vertices;
    Transaction change(mesh_, v);
    judge_.set_location(target_.location);
    take_filling(change);
    const bool at_random = purpose == Purpose::shake || purpose == Purpose::kick;
    for (const Place& place : search_.places_for_move(target_, change.origin(), trials, at_random)) {
      if (!judge_.find_zone(place.point, target_.near)) continue;
      change.place(judge_.zone());
      search_.note_tried(place);
      if (judge_.is_acceptable(report_)) {
        search_.note_success(place);
        log_.push_back({Change::move, id, change.origin(), target_.location});
        change.commit();
        return true;
      }
      change.take_out_again();
      take_filling(change);
    }
    change.roll_back();
    return false;
  }

  /// Inserts a vertex near a cell, inside, on a patch or on a crease; whether it did.
  /// \param most how bad the cells may be that it makes.
  /// \param anywhere whether it may lie inside, on every patch and on every crease of the cell; else one is drawn.
  bool insert_near(Cell_handle c, int trials, double most, bool anywhere = true)
  {
    const Point center =
        CGAL::centroid(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
    judge_.set_filling({});
    target_.near = c;
    target_.most = target_.enough = most;
    target_.limit = (std::max)(judge_.measure(c) - Judge::least_gain, most);
    target_.reach = std::sqrt(shortest_squared_edge(c));
    std::vector<Vertex_location_3> locations = locations_around(c);
    if (!anywhere) locations = {locations[search_.draw(locations.size())]};
    for (const Vertex_location_3& location : locations) {
      target_.location = location;
      judge_.set_location(location);
      const int share = trials / static_cast<int>(locations.size());
      for (const Place& place : search_.places_for_insertion(target_, center, share)) {
        if (!judge_.find_zone(place.point, target_.near)) continue;
        Transaction change(mesh_, judge_.zone(), target_.location);
        if (judge_.is_acceptable(report_)) {
          ++report_.insertions;
          log_.push_back({Change::insertion, 0, place.point, target_.location});
          change.commit();
          return true;
        }
        change.roll_back();
        target_.near = mesh_.new_cells().front(); // c died with the insertion
      }
    }
    return false;
  }

  /// Removes a vertex; whether it did. Feature vertices stay. The last vertex takes its number.
  /// \param most how bad the cells may be that this makes, if they aren't better than those unmade.
  bool remove(int id, double most)
  {
    const Vertex_handle v = vertex(id);
    target_.location = v->location();
    if (mesh_.is_fixed(v)) return false;
    load_star(v);
    Transaction change(mesh_, v);
    take_filling(change);
    const bool fills_well = judge_.judge_filling((std::max)(target_.limit, most)) != Judge::no_good;
    if (fills_well) change.leave_out();
    if (fills_well && judge_.is_acceptable(report_)) {
      judge_.forget(id); // the number of another vertex now
      judge_.forget(static_cast<int>(mesh_.vertices().size()));
      ++report_.removals;
      log_.push_back({Change::removal, id, change.origin(), target_.location});
      change.commit();
      return true;
    }
    change.roll_back();
    return false;
  }

private:
  struct Change
  {
    enum Kind
    {
      move,
      insertion,
      removal
    } kind;
    int id; ///< of the vertex, unless inserted
    Point point;
    Vertex_location_3 location;
  };

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  void take_filling(const Transaction& change)
  {
    judge_.set_filling(change.filling());
    target_.near = change.filling().front();
  }

  /// What the star of a vertex is like: its worst cell, the directions that its slivers suggest.
  void load_star(Vertex_handle v)
  {
    cells_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(cells_));
    target_.limit = -1;
    target_.by_radius = target_.by_volume = Vector(0, 0, 0);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Cell_handle c : cells_) {
      if (c->subdomain() == 0) continue;
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), c->vertex(i)->point())));
      const double x = judge_.measure(c);
      target_.limit = (std::max)(target_.limit, x);
      if (x > bound_) add_gradients(c, c->index(v));
    }
    target_.reach = std::sqrt(shortest);
  }

  void add_gradients(Cell_handle c, int i)
  {
    const Point &v = c->vertex(i)->point(), &a = c->vertex((i + 1) % 4)->point(), &b = c->vertex((i + 2) % 4)->point(),
                &d = c->vertex((i + 3) % 4)->point();
    target_.by_radius = target_.by_radius + gradient_of_squared_radius(v, a, b, d, c->circumcenter());
    target_.by_volume = target_.by_volume - gradient_of_volume(v, a, b, d);
  }

  static double shortest_squared_edge(Cell_handle c)
  {
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j)
        shortest =
            (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(c->vertex(i)->point(), c->vertex(j)->point())));
    return shortest;
  }

  /// Where a vertex near a cell may lie: inside, on the patches and on the creases of its vertices and facets. A facet
  /// between two creases may have no vertex on its patch.
  std::vector<Vertex_location_3> locations_around(Cell_handle c) const
  {
    std::vector<Vertex_location_3> all = {{3, c->subdomain()}};
    const auto add = [&all](const Vertex_location_3& at) {
      if (std::find(all.begin(), all.end(), at) == all.end()) all.push_back(at);
    };
    for (int i = 0; i < 4; ++i) {
      const Vertex_location_3& at = c->vertex(i)->location();
      if (at.dimension == 1 || at.dimension == 2) add(at);
    }
    for (int i = 0; i < 4; ++i)
      if (const auto* f = mesh_.facet(c, i)) add({2, f->patch});
    return all;
  }

  Restricted& mesh_;
  Perturb_report_3& report_;
  Judge judge_;
  Search search_;
  double bound_ = 1, kick_bound_ = 1;
  std::vector<Change> log_;

  typename Search::Target target_; ///< what the vertex that is moved or inserted is to attain
  std::vector<Cell_handle> cells_; ///< its star
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H
