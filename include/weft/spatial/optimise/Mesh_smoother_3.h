// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smoother's driver behind smooth_3.h: sweeps in which all vertices move at once.

#ifndef WEFT_SPATIAL_OPTIMISE_MESH_SMOOTHER_3_H
#define WEFT_SPATIAL_OPTIMISE_MESH_SMOOTHER_3_H

#include <weft/internal/parallel_for.h>
#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Dynamic_sizing_3.h>
#include <weft/spatial/optimise/Move_shortener_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/optimise/smoothers_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>
#include <weft/spatial/restricted/Relocator_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace weft::internal {

/// The smoother's driver; `smooth_3()` runs it.
template <class Restricted, class Smoother>
class Mesh_smoother_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Sizing = Dynamic_sizing_3<Restricted>;

  /// \param guard of the criteria to keep; null where none are.
  Mesh_smoother_3(Restricted& mesh, const Criteria_guard_3<Restricted>* guard, const Smooth_options_3& options,
                  const Smoother& smoother)
      : mesh_(mesh),
        guard_(guard),
        options_(options),
        smoother_(smoother),
        sizing_(options.lipschitz),
        steps_(mesh.vertices().size(), 1)
  {}

  Smooth_report_3 run()
  {
    update_sizes();
    if (options_.uniform) report_.energy_before = report_.energy_after = energy();
    for (int sweep = 0; sweep < options_.max_sweeps && goes_on(); ++sweep) {
      if (sweep > 0) update_sizes();
      if (!run_sweep()) break;
    }
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  bool goes_on() { return timer_.seconds() < options_.time_limit && (!options_.go_on || options_.go_on()); }

  void update_sizes()
  {
    Lap_timer lap;
    if (options_.uniform)
      sizing_.update_uniformly(mesh_);
    else
      sizing_.update(mesh_);
    report_.sizing_seconds += lap.seconds();
  }

  /// One sweep; whether another one is worth it.
  bool run_sweep()
  {
    choose_moves();
    if (ids_.empty()) return false;
    std::vector<Point> old;
    for (const int id : ids_) old.push_back(vertex(id)->point());
    stayed_.clear();
    report_.relocations += relocate(mesh_, ids_, targets_, &stayed_);
    parts_.assign(ids_.size(), 1);
    for (const std::size_t i : stayed_) parts_[i] = 0;
    if (guard_) Move_shortener_3<Restricted>(mesh_, *guard_, report_).take_back(ids_, old, targets_, parts_);
    kept_ = ids_.size();
    learn_steps();
    if (options_.uniform && undo_if_worse(old)) return damping_ > least_damping;
    report_.moves += kept_;
    ++report_.sweeps;
    return kept_ > 0;
  }

  /// Undoes a sweep that has raised the energy; later ones go a shorter way. Whether it was so.
  bool undo_if_worse(const std::vector<Point>& old)
  {
    const double before = report_.energy_after;
    report_.energy_after = energy();
    if (!Smoother::minimises_odt || report_.energy_after <= before) return false;
    report_.relocations.add_times(relocate(mesh_, ids_, old));
    report_.energy_after = before;
    ++report_.undone_sweeps;
    damping_ /= 2;
    return true;
  }

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  // ---- where to

  void choose_moves()
  {
    Lap_timer lap;
    list_stars();
    const std::vector<char> is_free = free_vertices();
    Smoothing_context_3<Restricted, Sizing> context(mesh_, sizing_);
    context.measure(cells_, options_.threads);
    std::vector<std::optional<Point>> wanted(is_free.size());
    // In the order of ids, which is that of refinement, this takes longer.
    const std::vector<std::size_t>& order = mesh_.spatial_order();
    parallel_for(order.size(), options_.threads, [&](std::size_t k) {
      const std::size_t i = order[k];
      if (is_free[i] && steps_[i] > least_step) wanted[i] = target(context, mesh_.vertices()[i]);
    });
    ids_.clear();
    targets_.clear();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!wanted[i]) continue;
      ids_.push_back(static_cast<int>(i));
      targets_.push_back(*wanted[i]);
    }
    report_.position_seconds += lap.seconds();
  }

  /// The cells around every vertex, by one pass over all cells, which is faster than walking around every vertex.
  void list_stars()
  {
    cells_.clear();
    first_.assign(mesh_.vertices().size() + 1, 0);
    const auto at = [](Cell_handle c, int i) { return static_cast<std::size_t>(c->vertex(i)->id()); };
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      c->set_id(static_cast<int>(cells_.size()));
      cells_.push_back(c);
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->id() >= 0) ++first_[at(c, i) + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    stars_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Cell_handle c : cells_)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i)->id() >= 0) stars_[next[at(c, i)]++] = c;
  }

  /// By id: vertices that aren't feature vertices, have cells in the domain and not only excellent ones.
  std::vector<char> free_vertices()
  {
    std::vector<char> is_free(mesh_.vertices().size(), false), is_excellent(cells_.size());
    const double smallest = cosine_of_degrees(options_.locked_smallest),
                 largest = cosine_of_degrees(options_.locked_largest);
    parallel_for(cells_.size(), options_.threads, [&](std::size_t k) {
      const Cell_handle c = cells_[k];
      is_excellent[k] = c->subdomain() != 0 && has_dihedrals_between(c, smallest, largest);
    });
    for (const Cell_handle c : cells_)
      if (c->subdomain() != 0 && !is_excellent[static_cast<std::size_t>(c->id())])
        for (int i = 0; i < 4; ++i) is_free[static_cast<std::size_t>(c->vertex(i)->id())] = true;
    for (const Vertex_handle v : mesh_.vertices()) {
      char& f = is_free[static_cast<std::size_t>(v->id())];
      const int dimension = v->location().dimension;
      report_.locked += !f && dimension > 0;
      if (mesh_.is_fixed(v) || (dimension < 3 && !Smoother::moves_boundary)) f = false;
    }
    return is_free;
  }

  /// Where a vertex goes: as far as its step allows towards where the smoother wants it, but not farther than half its
  /// shortest edge, which keeps neighbours apart.
  template <class Context>
  std::optional<Point> target(const Context& context, Vertex_handle v) const
  {
    const auto id = static_cast<std::size_t>(v->id());
    thread_local std::vector<Cell_handle> star;
    star.assign(stars_.begin() + static_cast<std::ptrdiff_t>(first_[id]),
                stars_.begin() + static_cast<std::ptrdiff_t>(first_[id + 1]));
    const std::optional<Point> wanted = smoother_(context, v, star);
    if (!wanted) return std::nullopt;
    const auto move = *wanted - v->point();
    const double length = std::sqrt(CGAL::to_double(move.squared_length()));
    const double step = damping_ * steps_[id], least = options_.move_ratio * sizing_(v);
    if (!(step * length > least)) return std::nullopt;
    const double reach = 0.5 * shortest_edge(v, star);
    const std::optional<Point> p =
        project_on_location(mesh_.oracle(), v->point() + (std::min)(step, reach / length) * move, v->location());
    if (!p || !(CGAL::to_double(CGAL::squared_distance(*p, v->point())) > least * least)) return std::nullopt;
    if (v->location().dimension == 3 && leaves_subdomain(v, *p)) return std::nullopt;
    return p;
  }

  /// Short segments are cheaper to ask for than where a point lies, if the oracle doesn't begin with the latter.
  bool leaves_subdomain(Vertex_handle v, const Point& p) const
  {
    if constexpr (Restricted::Oracle::labels_first) return mesh_.oracle().subdomain(p) != v->location().index;
    thread_local std::vector<typename Restricted::Surface_hit> hits;
    hits.clear();
    return mesh_.oracle().intersect(v->point(), p, hits) != 0;
  }

  static double shortest_edge(Vertex_handle v, const std::vector<Cell_handle>& star)
  {
    double shortest = HUGE_VAL;
    for (const Cell_handle c : star)
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(c->vertex(i)->point(), v->point())));
    return std::sqrt(shortest);
  }

  /// Moves that had to be shortened begin shorter in the next sweep. So do, a little, those of vertices that have
  /// stayed since they would have turned cells over.
  void learn_steps()
  {
    auto stayed = stayed_.begin();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      double& step = steps_[static_cast<std::size_t>(ids_[i])];
      if (stayed != stayed_.end() && *stayed == i) {
        step *= after_staying;
        ++stayed;
      } else {
        step = parts_[i] == 1 ? (std::min)(1., 1.5 * step)
                              : step * (std::max)(parts_[i], Move_shortener_3<Restricted>::least_part);
      }
      kept_ -= parts_[i] == 0;
      report_.rejected += parts_[i] < 1;
    }
  }

  /// Sum over cells of volume times the squared lengths of edges, in the metric: twenty times the ODT energy.
  double energy() const
  {
    const Smoothing_context_3<Restricted, Sizing> context(mesh_, sizing_);
    double sum = 0;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles()) {
      if (c->subdomain() == 0) continue;
      double edges = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = i + 1; j < 4; ++j) edges += context.squared_length(c->vertex(i), c->vertex(j));
      sum += edges * context.mass(c);
    }
    return sum / 20;
  }

  static constexpr double least_damping = 0.1, least_step = 0.05, after_staying = 0.85;

  Restricted& mesh_;
  const Criteria_guard_3<Restricted>* guard_; ///< null where criteria aren't kept
  const Smooth_options_3& options_;
  const Smoother& smoother_;
  Sizing sizing_;
  double damping_ = 1;                     ///< part of the way that all vertices go
  std::vector<double> steps_;              ///< by id: the same for each of them
  std::vector<Cell_handle> cells_, stars_; ///< all finite cells; those around each vertex, by id
  std::vector<std::size_t> first_;         ///< of each vertex in `stars_`
  std::vector<int> ids_;                   ///< of the vertices that a sweep moves
  std::vector<Point> targets_;
  std::vector<std::size_t> stayed_; ///< of these, by place, in order: what would have turned cells over
  std::vector<double> parts_;       ///< of these moves, the parts that are made
  std::size_t kept_ = 0;            ///< moves of a sweep that weren't taken back
  Timer timer_;
  Smooth_report_3 report_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_MESH_SMOOTHER_3_H
