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
#include <weft/spatial/optimise/sliver_gradients_3.h>
#include <weft/spatial/optimise/Success_rates.h>
#include <weft/spatial/restricted/project_on_location_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <random>
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
      : mesh_(mesh), options_(options), report_(report), judge_(mesh, guard), random_(options.seed)
  {}

  Judge& judge() { return judge_; }

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
        judge_.find_zone(change.point, near_);
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
    location_ = v->location();
    if (mesh_.is_fixed(v)) return false;
    load_star(v);
    if (purpose == Purpose::mend && limit_ <= bound_) return false; // mended meanwhile
    if (purpose == Purpose::mend || purpose == Purpose::better) limit_ -= Judge::least_gain;
    if (purpose == Purpose::shake) limit_ = (std::max)(limit_, bound_);
    if (purpose == Purpose::kick) limit_ = (std::max)(limit_, kick_bound_);
    enough_ = purpose == Purpose::kick ? kick_bound_ : bound_;
    most_ = Judge::no_good;
    ++report_.tried_vertices;
    is_move_ = true;
    Transaction change(mesh_, v);
    take_filling(change);
    find_places(change.origin(), trials, purpose == Purpose::shake || purpose == Purpose::kick);
    for (const Place& place : places_) {
      if (!judge_.find_zone(place.point, near_)) continue;
      change.place(judge_.zone());
      rates_.spend(place.kind, cost_of_putting_back);
      if (judge_.is_acceptable(report_)) {
        rates_.succeed(place.kind);
        ++(report_.*counter(place.kind));
        log_.push_back({Change::move, id, change.origin(), location_});
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
    is_move_ = is_guided_ = false;
    judge_.set_filling({});
    near_ = c;
    most_ = enough_ = most;
    limit_ = (std::max)(Judge::measure(c) - Judge::least_gain, most);
    reach_ = std::sqrt(shortest_squared_edge(c));
    std::vector<Vertex_location_3> locations = locations_around(c);
    if (!anywhere) locations = {locations[random_() % locations.size()]};
    for (const Vertex_location_3& location : locations) {
      location_ = location;
      places_.clear();
      search(center, 1, trials / static_cast<int>(locations.size()));
      keep_best_places();
      for (const Place& place : places_) {
        if (!judge_.find_zone(place.point, near_)) continue;
        Transaction change(mesh_, judge_.zone(), location_);
        if (judge_.is_acceptable(report_)) {
          ++report_.insertions;
          log_.push_back({Change::insertion, 0, place.point, location_});
          change.commit();
          return true;
        }
        change.roll_back();
        near_ = mesh_.new_cells().front(); // c died with the insertion
      }
    }
    return false;
  }

  /// Removes a vertex; whether it did. Feature vertices stay. The last vertex takes its number.
  /// \param most how bad the cells may be that this makes, if they aren't better than those unmade.
  bool remove(int id, double most)
  {
    const Vertex_handle v = vertex(id);
    location_ = v->location();
    if (mesh_.is_fixed(v)) return false;
    load_star(v);
    Transaction change(mesh_, v);
    take_filling(change);
    const bool fills_well = judge_.judge_filling((std::max)(limit_, most)) != Judge::no_good;
    if (fills_well) change.leave_out();
    if (fills_well && judge_.is_acceptable(report_)) {
      judge_.forget(id); // the number of another vertex now
      judge_.forget(static_cast<int>(mesh_.vertices().size()));
      ++report_.removals;
      log_.push_back({Change::removal, id, change.origin(), location_});
      change.commit();
      return true;
    }
    change.roll_back();
    return false;
  }

private:
  struct Place
  {
    Point point;
    double measure;   ///< of the worst cell made
    std::size_t kind; ///< of place, see `Step`
  };

  /// Kinds of places for a vertex: steps along the gradients of its slivers, in parts of its shortest edge, and random
  /// ones.
  struct Step
  {
    bool along_radius;
    double length;
  };
  static constexpr std::array<Step, 6> steps{
      {{true, 0.05}, {true, 0.1}, {true, 0.2}, {false, 0.1}, {false, 0.2}, {true, 0.3}}};
  static constexpr std::size_t by_chance = steps.size();

  static std::size_t Perturb_report_3::*counter(std::size_t kind)
  {
    return kind == by_chance          ? &Perturb_report_3::by_chance
           : steps[kind].along_radius ? &Perturb_report_3::by_radius
                                      : &Perturb_report_3::by_volume;
  }

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
    near_ = change.filling().front();
  }

  /// What the star of a vertex is like: its worst cell, the directions that its slivers suggest.
  void load_star(Vertex_handle v)
  {
    cells_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(cells_));
    limit_ = -1;
    by_radius_ = by_volume_ = Vector(0, 0, 0);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Cell_handle c : cells_) {
      if (c->subdomain() == 0) continue;
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), c->vertex(i)->point())));
      const double x = Judge::measure(c);
      limit_ = (std::max)(limit_, x);
      if (x > bound_) add_gradients(c, c->index(v));
    }
    reach_ = std::sqrt(shortest);
  }

  /// The unit vector of a direction, or of what a patch or crease leaves of it; zero if that is nothing. Most of a step
  /// would be lost if only its end were projected.
  Vector possible_direction(const Point& p, Vector direction) const
  {
    const auto unit = [](const Vector& v) {
      const double length = std::sqrt(CGAL::to_double(v.squared_length()));
      return length > 0 && std::isfinite(length) ? v / length : Vector(0, 0, 0);
    };
    direction = unit(direction);
    if (location_.dimension == 3 || direction == CGAL::NULL_VECTOR) return direction;
    const double step = 0.1 * reach_;
    const std::optional<Point> q = project_on_location(mesh_.oracle(), p + step * direction, location_);
    if (!q || CGAL::to_double(CGAL::squared_distance(p, *q)) < 1e-4 * step * step) return Vector(0, 0, 0);
    return unit(*q - p);
  }

  void add_gradients(Cell_handle c, int i)
  {
    const Point &v = c->vertex(i)->point(), &a = c->vertex((i + 1) % 4)->point(), &b = c->vertex((i + 2) % 4)->point(),
                &d = c->vertex((i + 3) % 4)->point();
    by_radius_ = by_radius_ + gradient_of_squared_radius(v, a, b, d, c->circumcenter());
    by_volume_ = by_volume_ - gradient_of_volume(v, a, b, d);
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

  // ---- places

  /// As in Alg. 7 the gradients have their turn before chance, but only those steps that have mended more for their
  /// cost than chance has, the best first: late in a run gradients rarely help. On creases there are but two ways to
  /// go: directions there only take time.
  void find_places(const Point& origin, int trials, bool at_random)
  {
    places_.clear();
    bool done = false;
    is_guided_ = !at_random && location_.dimension > 1 && options_.directions == Perturb_directions_3::combined;
    if (is_guided_) {
      by_radius_ = possible_direction(origin, by_radius_);
      by_volume_ = possible_direction(origin, by_volume_);
      for (const std::size_t kind : rates_.better_than(by_chance)) {
        done = try_along(origin, kind);
        if (done) break;
      }
    }
    if (!done) search(origin, options_.random_reach, trials);
    keep_best_places();
  }

  bool try_along(const Point& origin, std::size_t kind)
  {
    const Vector& direction = steps[kind].along_radius ? by_radius_ : by_volume_;
    if (direction == CGAL::NULL_VECTOR) return false;
    return try_at(origin + steps[kind].length * reach_ * direction, kind) <= enough_;
  }

  /// Random places around a center, every other one closer and closer around the best so far, until one is good. The
  /// first for a vertex of slivers lie where their volumes shrink, since a sliver that is flattened further flips away:
  /// places where they grow better a star more often, but by less.
  /// \param reach in parts of the shortest edge.
  void search(const Point& center, double reach, int trials)
  {
    double best = limit_, radius = reach;
    Point at = center;
    for (const Place& p : places_)
      if (p.measure < best) {
        best = p.measure;
        at = p.point;
        radius = 0.3 * reach;
      }
    for (int k = 0; k < trials; ++k) {
      const bool near_best = k % 2 == 1 && best < limit_;
      const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
      Vector v(x, y, z);
      if (is_guided_ && k < guided_trials && !near_best && v * by_volume_ < 0) v = -v;
      const double length = std::sqrt(CGAL::to_double(v.squared_length()));
      if (!(length > 0)) continue;
      const double step = (near_best ? radius : reach) * (0.5 + 0.5 * random()) * reach_ / length;
      const double measure = try_at((near_best ? at : center) + step * v, by_chance);
      if (near_best) radius *= measure < best ? 1.5 : 0.85;
      if (measure >= best) continue;
      if (!near_best) radius = 0.3 * reach;
      best = measure;
      at = places_.back().point;
      if (best <= enough_) break;
    }
  }

  /// In [-1, 1].
  double random() { return 2 * (static_cast<double>(random_()) / 4294967295.0) - 1; }

  /// Judges a place, projected to where the vertex may lie; remembers it if it is good enough.
  double try_at(Point p, std::size_t kind)
  {
    ++report_.trials;
    if (is_move_) rates_.spend(kind, 1);
    const std::optional<Point> projected = project_on_location(mesh_.oracle(), p, location_);
    if (!projected) return Judge::no_good;
    p = *projected;
    if (location_.dimension == 3 && mesh_.oracle().subdomain(p) != location_.index) return Judge::no_good;
    if (!judge_.find_zone(p, near_)) return Judge::no_good;
    const double measure = judge_.judge(limit_);
    if (measure > most_ || measure >= Judge::no_good) return Judge::no_good;
    if (!judge_.would_fit()) return ++report_.refused_cells, Judge::no_good;
    places_.push_back({p, measure, kind});
    return measure;
  }

  void keep_best_places()
  {
    std::stable_sort(places_.begin(), places_.end(),
                     [](const Place& a, const Place& b) { return a.measure < b.measure; });
    if (places_.size() > most_places) places_.resize(most_places);
  }

  /// Random trials that directions play a part in; more are worse.
  static constexpr int guided_trials = 6;
  static constexpr std::size_t most_places = 3;      ///< of the best, how many are tried for good
  static constexpr double cost_of_putting_back = 20; ///< in trials, with the guard's questions

  Restricted& mesh_;
  const Perturb_options_3& options_;
  Perturb_report_3& report_;
  Judge judge_;
  std::mt19937 random_;
  Success_rates rates_{by_chance + 1};
  double bound_ = 1, kick_bound_ = 1;
  std::vector<Change> log_;

  Vertex_location_3 location_;     ///< of the vertex that is moved or inserted
  double limit_ = -1, reach_ = 0;  ///< what it has to better; the shortest edge around
  double enough_ = 0;              ///< what ends the search
  double most_ = 0;                ///< what it must not make, whatever it unmakes
  bool is_move_ = true;            ///< or an insertion, which gradients have no part in
  bool is_guided_ = false;         ///< whether directions play a part in a move
  Vector by_radius_, by_volume_;   ///< sums over slivers; once guided, unit vectors or zero
  Cell_handle near_;               ///< a cell near it
  std::vector<Cell_handle> cells_; ///< its star
  std::vector<Place> places_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_VERTEX_PERTURBER_3_H
