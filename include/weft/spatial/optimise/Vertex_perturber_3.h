// SPDX-License-Identifier: GPL-3.0-or-later
//
// One step of sliver removal (Tournois 2009, sec. 3.2.2): a vertex is moved, inserted or removed, and the change kept
// if the worst of the cells made is better than the worst of those unmade and the boundary and all criteria hold.
//
// Other than in Alg. 7, the vertex is taken away once, and places are judged by their conflict zones before anything is
// inserted. Inserting and removing vertices is what sec. 4.1 calls pliant.

#ifndef WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H
#define WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H

#include <weft/spatial/optimise/Move_block_3.h>
#include <weft/spatial/optimise/Move_search_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/optimise/Place_search_3.h>
#include <weft/spatial/optimise/Success_rates.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Vertex_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Judge = Perturbation_judge_3<Restricted>;
  using Search = Place_search_3<Restricted>;
  using Place = typename Search::Place;
  using Moves = Move_search_3<Restricted>;
  using Task = typename Moves::Task;
  using Found = typename Moves::Found;
  using Transaction = Vertex_transaction_3<Restricted>;

  using Purpose = Move_purpose_3;

  Vertex_perturber_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options,
                     Perturb_report_3& report)
      : mesh_(mesh),
        guard_(guard),
        options_(options),
        report_(report),
        judge_(mesh, guard, options.target),
        search_(mesh, judge_, options),
        moves_(mesh, guard, options),
        block_(mesh, guard, options, judge_),
        next_seed_(options.seed)
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
    const Task task = task_for(id, purpose, trials, std::nullopt);
    moves_.find(task, false, found_);
    return carry_out(task, found_);
  }

  /// Moves vertices for `Purpose::mend` until `is_late()`; how many were moved. They are worked on in blocks, see
  /// Move_block_3.h. What others were in the way of has another try.
  template <class Is_late>
  std::size_t move_all(std::vector<int> ids, int trials, const Is_late& is_late)
  {
    std::size_t moved = 0;
    std::vector<int> later, again;
    std::vector<char> tries(mesh_.vertices().size(), 0);
    while (!ids.empty() && !is_late()) {
      later.clear();
      again.clear();
      block_.choose(ids, later, [&](int id) { return task_for(id, Purpose::mend, trials, ++next_seed_); });
      block_.carry_out(report_);
      for (std::size_t k = 0; k < block_.size(); ++k) {
        const Found& found = block_.found(k);
        if (!found.is_wanted) continue;
        const int id = block_.task(k).id;
        if (found.is_crowded) {
          moves_.find(block_.task(k), false, found_);
          moved += carry_out(block_.task(k), found_);
          continue;
        }
        ++report_.tried_vertices;
        add_costs(found.costs);
        if (found.places.empty()) continue;
        const auto& outcome = block_.outcome(k);
        for (std::size_t p = 0; p < outcome.tried; ++p) rates_.spend(found.places[p].kind, cost_of_putting_back);
        if (outcome.has_moved) {
          note_move(found.places[outcome.tried - 1], id, outcome.origin);
          ++moved;
        } else if (outcome.tried == 0 && ++tries[static_cast<std::size_t>(id)] < most_tries) {
          again.push_back(id);
        }
      }
      ids.swap(again);
      ids.insert(ids.end(), later.begin(), later.end());
    }
    return moved;
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
      const std::vector<Place>& places = search_.places_for_insertion(target_, center, share);
      add_costs(search_.costs());
      for (const Place& place : places) {
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
    const double worst = worst_around(v);
    Transaction change(mesh_, v);
    take_filling(change);
    const bool fills_well = judge_.judge_filling((std::max)(worst, most)) != Judge::no_good;
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

  double worst_around(Vertex_handle v) const
  {
    std::vector<Cell_handle> star;
    mesh_.triangulation().incident_cells(v, std::back_inserter(star));
    double worst = -1;
    for (const Cell_handle c : star)
      if (c->subdomain() != 0) worst = (std::max)(worst, judge_.measure(c));
    return worst;
  }

  // ---- moves

  /// Only those steps along gradients are tried that have mended more for their cost than chance has: late in a run
  /// gradients rarely help.
  Task task_for(int id, Purpose purpose, int trials, std::optional<unsigned> seed)
  {
    Task task{id, purpose, trials, bound_, kick_bound_, judge_.floor(), {}, seed};
    if (Moves::is_guided(vertex(id), purpose, options_)) task.steps = rates_.better_than(Search::by_chance);
    return task;
  }

  void note_move(const Place& place, int id, const Point& origin)
  {
    rates_.succeed(place.kind);
    ++(place.kind == Search::by_chance          ? report_.by_chance
       : Search::steps[place.kind].along_radius ? report_.by_radius
                                                : report_.by_volume);
    log_.push_back({Change::move, id, origin, vertex(id)->location()});
  }

  /// Moves a vertex to the first of the places found that is possible.
  bool carry_out(const Task& task, Found& found)
  {
    if (!found.is_wanted) return false;
    ++report_.tried_vertices;
    add_costs(found.costs);
    if (found.places.empty() && !found.is_crowded) return false;
    const Vertex_handle v = vertex(task.id);
    target_.location = v->location();
    if (found.is_crowded) moves_.find(task, false, found);
    Transaction change(mesh_, v);
    if (found.is_crowded) {
      moves_.find_in(task, change.origin(), change.filling(), found);
      add_costs(found.costs);
    }
    take_filling(change);
    for (const Place& place : found.places) {
      if (!judge_.find_zone(place.point, target_.near)) continue;
      change.place(judge_.zone());
      rates_.spend(place.kind, cost_of_putting_back);
      if (judge_.is_acceptable(report_)) {
        note_move(place, task.id, change.origin());
        change.commit();
        return true;
      }
      change.take_out_again();
      take_filling(change);
    }
    change.roll_back();
    return false;
  }

  void add_costs(const typename Search::Costs& costs)
  {
    report_.trials += costs.trials;
    report_.refused_cells += costs.refused_cells;
    for (std::size_t kind = 0; kind < Search::kinds; ++kind)
      if (costs.places[kind] > 0) rates_.spend(kind, static_cast<double>(costs.places[kind]));
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

  static constexpr char most_tries = 3;              ///< of a vertex in a pass
  static constexpr double cost_of_putting_back = 20; ///< in trials, with the guard's questions

  Restricted& mesh_;
  Criteria_guard_3<Restricted>& guard_;
  const Perturb_options_3& options_;
  Perturb_report_3& report_;
  Judge judge_;
  Search search_; ///< for insertions
  Moves moves_;
  Move_block_3<Restricted> block_;
  Success_rates rates_{Search::kinds};
  unsigned next_seed_;
  double bound_ = 1, kick_bound_ = 1;
  std::vector<Change> log_;

  typename Search::Target target_; ///< what the vertex that is inserted is to attain
  Found found_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H
