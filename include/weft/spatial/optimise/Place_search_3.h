// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a vertex of slivers could go (Tournois 2009, sec. 3.2.2, Alg. 7): along the gradients of its slivers, or at
// random, judged before anything is inserted.

#ifndef WEFT_SPATIAL_OPTIMISE_PLACE_SEARCH_3_H
#define WEFT_SPATIAL_OPTIMISE_PLACE_SEARCH_3_H

#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Place_search_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vector = typename Kernel::Vector_3;
  using Cell_handle = typename Restricted::Cell_handle;
  using Judge = Perturbation_judge_3<Restricted>;

  struct Place
  {
    Point point;
    double measure;   ///< of the worst cell made
    std::size_t kind; ///< of place, steps along gradients, or by chance
  };

  /// What is looked for.
  struct Target
  {
    Vertex_location_3 location;   ///< of the vertex that is moved or inserted
    double limit = -1, reach = 0; ///< what it has to better; the shortest edge around
    double enough = 0;            ///< what ends the search
    double most = 0;              ///< what it must not make, whatever it unmakes
    Vector by_radius, by_volume;  ///< gradients, summed over slivers
    bool is_guided = false;       ///< whether those play a part
    Cell_handle near;             ///< a cell near it
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
  static constexpr std::size_t by_chance = steps.size(), kinds = by_chance + 1;

  /// What a search took.
  struct Costs
  {
    std::array<std::size_t, kinds> places{}; ///< judged for a move, by kind
    std::size_t trials = 0, refused_cells = 0;
  };

  /// Everything has to live as long as this object.
  Place_search_3(const Restricted& mesh, Judge& judge, const Perturb_options_3& options)
      : mesh_(mesh), judge_(judge), options_(options), random_(options.seed)
  {}

  /// Begins the random numbers anew.
  void seed(unsigned number) { random_.seed(number); }

  /// Of the last search.
  const Costs& costs() const { return costs_; }

  /// The best places for a vertex that is out, the best first. As in Alg. 7 the gradients have their turn before
  /// chance.
  /// \param steps kinds of steps along gradients to try, if it is guided.
  const std::vector<Place>& places_for_move(const Target& target, const Point& origin, int trials,
                                            const std::vector<std::size_t>& steps)
  {
    begin(target);
    is_move_ = true;
    bool done = false;
    if (target_.is_guided) {
      target_.by_radius = possible_direction(origin, target_.by_radius);
      target_.by_volume = possible_direction(origin, target_.by_volume);
      for (const std::size_t kind : steps) {
        done = try_along(origin, kind);
        if (done) break;
      }
    }
    if (!done) search(origin, options_.random_reach, trials);
    keep_best_places();
    return places_;
  }

  /// Places for a new vertex, at random around a center; gradients have no part in that.
  const std::vector<Place>& places_for_insertion(const Target& target, const Point& center, int trials)
  {
    begin(target);
    target_.is_guided = is_move_ = false;
    search(center, 1, trials);
    keep_best_places();
    return places_;
  }

  /// A random number below n.
  std::size_t draw(std::size_t n) { return random_() % n; }

private:
  void begin(const Target& target)
  {
    target_ = target;
    places_.clear();
    costs_ = Costs();
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
    if (target_.location.dimension == 3 || direction == CGAL::NULL_VECTOR) return direction;
    const double step = 0.1 * target_.reach;
    const std::optional<Point> q = project_on_location(mesh_.oracle(), p + step * direction, target_.location);
    if (!q || CGAL::to_double(CGAL::squared_distance(p, *q)) < 1e-4 * step * step) return Vector(0, 0, 0);
    return unit(*q - p);
  }

  bool try_along(const Point& origin, std::size_t kind)
  {
    const Vector& direction = steps[kind].along_radius ? target_.by_radius : target_.by_volume;
    if (direction == CGAL::NULL_VECTOR) return false;
    return try_at(origin + steps[kind].length * target_.reach * direction, kind) <= target_.enough;
  }

  /// Random places around a center, every other one closer and closer around the best so far, until one is good. The
  /// first for a vertex of slivers lie where their volumes shrink, since a sliver that is flattened further flips away:
  /// places where they grow better a star more often, but by less.
  /// \param reach in parts of the shortest edge.
  void search(const Point& center, double reach, int trials)
  {
    double best = target_.limit, radius = reach;
    Point at = center;
    for (const Place& p : places_)
      if (p.measure < best) {
        best = p.measure;
        at = p.point;
        radius = 0.3 * reach;
      }
    for (int k = 0; k < trials; ++k) {
      const bool near_best = k % 2 == 1 && best < target_.limit;
      const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
      Vector v(x, y, z);
      if (target_.is_guided && k < guided_trials && !near_best && v * target_.by_volume < 0) v = -v;
      const double length = std::sqrt(CGAL::to_double(v.squared_length()));
      if (!(length > 0)) continue;
      const double step = (near_best ? radius : reach) * (0.5 + 0.5 * random()) * target_.reach / length;
      const double measure = try_at((near_best ? at : center) + step * v, by_chance);
      if (near_best) radius *= measure < best ? 1.5 : 0.85;
      if (measure >= best) continue;
      if (!near_best) radius = 0.3 * reach;
      best = measure;
      at = places_.back().point;
      if (best <= target_.enough) break;
    }
  }

  /// In [-1, 1].
  double random() { return 2 * (static_cast<double>(random_()) / 4294967295.0) - 1; }

  /// Judges a place, projected to where the vertex may lie; remembers it if it is good enough.
  double try_at(Point p, std::size_t kind)
  {
    ++costs_.trials;
    if (is_move_) ++costs_.places[kind];
    const std::optional<Point> projected = project_on_location(mesh_.oracle(), p, target_.location);
    if (!projected) return Judge::no_good;
    p = *projected;
    if (target_.location.dimension == 3 && mesh_.oracle().subdomain(p) != target_.location.index) return Judge::no_good;
    if (!judge_.find_zone(p, target_.near)) return Judge::no_good;
    const double measure = judge_.judge(target_.limit);
    if (measure > target_.most || measure >= Judge::no_good) return Judge::no_good;
    if (!judge_.would_fit()) return ++costs_.refused_cells, Judge::no_good;
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
  static constexpr std::size_t most_places = 3; ///< of the best, how many are tried for good

  const Restricted& mesh_;
  Judge& judge_;
  const Perturb_options_3& options_;
  std::mt19937 random_;
  Target target_;       ///< its directions, once guided, are unit vectors or zero
  bool is_move_ = true; ///< or an insertion
  std::vector<Place> places_;
  Costs costs_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_PLACE_SEARCH_3_H
