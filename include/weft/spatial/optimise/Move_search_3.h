// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a vertex of slivers should go (Tournois 2009, sec. 3.2.2, Alg. 7), found while it stays where it is: what its
// place would be filled with and the conflict zones of places are looked at beside the mesh. So nothing has to be put
// back where no place is found, and several threads look for places of several vertices of one mesh.

#ifndef WEFT_SPATIAL_OPTIMISE_MOVE_SEARCH_3_H
#define WEFT_SPATIAL_OPTIMISE_MOVE_SEARCH_3_H

#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/optimise/Place_search_3.h>
#include <weft/spatial/optimise/sliver_gradients_3.h>
#include <weft/spatial/restricted/Mesh_without_vertex_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace weft::internal {

/// When a vertex is to be moved.
enum class Move_purpose_3
{
  mend,   ///< a cell at it is below the bound
  better, ///< always, if that betters its star
  shake,  ///< always, if nothing it makes is below the bound: makes room for others
  kick    ///< always, if nothing it makes is below the bound for kicks
};

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Move_search_3
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

  /// A vertex to find places for.
  struct Task
  {
    int id;
    Move_purpose_3 purpose;
    int trials;                     ///< random places
    double bound, kick_bound;       ///< cells that measure more are slivers; the same for kicks
    double floor;                   ///< see `Perturbation_judge_3::set_floor()`
    std::vector<std::size_t> steps; ///< kinds of steps along gradients to try
    std::optional<unsigned> seed;   ///< of its random numbers; else those go on
  };

  struct Found
  {
    bool is_wanted = false;  ///< else there is nothing to do
    bool is_crowded = false; ///< the vertex has too many neighbours to find places while it stays
    std::vector<Place> places;
    typename Search::Costs costs;
    std::vector<int> seen; ///< see Mesh_without_vertex_3
  };

  /// Everything has to live as long as this object.
  Move_search_3(const Restricted& mesh, Criteria_guard_3<Restricted>& guard, const Perturb_options_3& options)
      : mesh_(mesh),
        options_(options),
        judge_(mesh, guard, options.target),
        search_(mesh, judge_, options),
        without_(mesh)
  {}

  /// Whether directions play a part when a vertex moves. On creases there are but two ways to go: directions there only
  /// take time.
  static bool is_guided(Vertex_handle v, Move_purpose_3 purpose, const Perturb_options_3& options)
  {
    return (purpose == Move_purpose_3::mend || purpose == Move_purpose_3::better) && v->location().dimension > 1 &&
           options.directions == Perturb_directions_3::combined;
  }

  /// Looks for places. The mesh stays as it is.
  /// \param keep_seen whether `found` is to tell what that hangs on.
  void find(const Task& task, bool keep_seen, Found& found)
  {
    found.is_wanted = found.is_crowded = false;
    found.places.clear();
    found.seen.clear();
    found.costs = typename Search::Costs();
    const Vertex_handle v = mesh_.vertices()[static_cast<std::size_t>(task.id)];
    if (mesh_.is_fixed(v)) return;
    without_.look_at(v, keep_seen);
    load_star(v, task.bound);
    found.seen = without_.seen();
    if (task.purpose == Move_purpose_3::mend && target_.limit <= task.bound) return; // mended meanwhile
    found.is_wanted = true;
    set_limits(task);
    target_.is_guided = is_guided(v, task.purpose, options_);
    if (task.seed) search_.seed(*task.seed);
    judge_.set_floor(task.floor);
    judge_.set_location(v->location());
    found.is_crowded = !without_.leave_out();
    if (found.is_crowded) return;
    judge_.set_filling(without_);
    search(task, v->point(), found);
    found.seen = without_.seen();
  }

  /// The same, after it was found to be crowded, when the vertex has been taken out.
  void find_in(const Task& task, const Point& origin, const std::vector<Cell_handle>& filling, Found& found)
  {
    judge_.set_filling(filling);
    target_.near = filling.front();
    search(task, origin, found);
  }

private:
  void search(const Task& task, const Point& origin, Found& found)
  {
    found.places = search_.places_for_move(target_, origin, task.trials, task.steps);
    found.costs = search_.costs();
  }

  void set_limits(const Task& task)
  {
    switch (task.purpose) {
    case Move_purpose_3::mend:
    case Move_purpose_3::better:
      target_.limit -= Judge::least_gain;
      break;
    case Move_purpose_3::shake:
      target_.limit = (std::max)(target_.limit, task.bound);
      break;
    case Move_purpose_3::kick:
      target_.limit = (std::max)(target_.limit, task.kick_bound);
    }
    target_.enough = task.purpose == Move_purpose_3::kick ? task.kick_bound : task.bound;
    target_.most = Judge::no_good;
  }

  /// What the star of a vertex is like: its worst cell, the directions that its slivers suggest.
  void load_star(Vertex_handle v, double bound)
  {
    target_.location = v->location();
    target_.limit = -1;
    target_.by_radius = target_.by_volume = Vector(0, 0, 0);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Cell_handle c : without_.star()) {
      if (c->subdomain() == 0) continue;
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), c->vertex(i)->point())));
      const double x = judge_.measure(c);
      target_.limit = (std::max)(target_.limit, x);
      if (x > bound) add_gradients(c, c->index(v));
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

  const Restricted& mesh_;
  const Perturb_options_3& options_;
  Judge judge_;
  Search search_;
  Mesh_without_vertex_3<Restricted> without_;
  typename Search::Target target_; ///< what the vertex is to attain
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MOVE_SEARCH_3_H
