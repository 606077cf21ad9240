// SPDX-License-Identifier: GPL-3.0-or-later
//
// The planar mesher as a sequence of stages over a Working_mesh_2 (Tournois 2009, Alg. 2): sample the constraints, grow
// crystals, relax, then refine and relax in turn until every sizing ratio is at most 1, and polish. `make_mesh_2()` is
// the way to call it.

#ifndef WEFT_PLANAR_RUN_PLANAR_MESHER_2_H
#define WEFT_PLANAR_RUN_PLANAR_MESHER_2_H

#include <weft/internal/cold.h>
#include <weft/internal/run/Run.h>
#include <weft/options.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/refine/Batch_refiner_2.h>
#include <weft/planar/refine/Crystal_seeder_2.h>
#include <weft/planar/refine/grade_input_2.h>
#include <weft/planar/refine/least_vertices_2.h>
#include <weft/planar/refine/Misfit_remover_2.h>
#include <weft/planar/refine/sample_constraints_2.h>
#include <weft/planar/relax/Relaxation_guard_2.h>
#include <weft/planar/run/Angle_goal_2.h>
#include <weft/planar/run/Mesh_optimiser_2.h>
#include <weft/planar/working/Frozen_vertices_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// The planar mesher's driver; `make_mesh_2()`, `adapt_2()` and `relax_2()` run it.
template <class Cdt, class Sizing>
class Planar_mesher_2
{
public:
  using Mesh = Working_mesh_2<Cdt, Sizing>;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param given `input` to mesh, `meshed` to adapt, `relaxable` to relax.
  Planar_mesher_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options, typename Mesh::Given given)
      : mesh_(cdt, sizing, given),
        sizing_(sizing),
        options_(options),
        run_(options.visitor, options.time_limit),
        goal_(options),
        refiner_(mesh_, options.min_angle),
        optimiser_(mesh_, options.size_feedback, options.threads, options.seed, report_)
  {
    report_.input_vertices = mesh_.input_vertices();
  }

  Mesh_report_2 mesh()
  {
    if (options_.seeding == Seeding::crystal) {
      timed(Stage::constraints, [this] { check_budget(); });
      if (options_.grade_input) timed(Stage::constraints, [this] { grade_input(); });
      timed(Stage::constraints, [this] { sample_constraints(); });
      timed(Stage::seeding, [this] { seed(); });
      timed(Stage::relaxation, [this] { relax_all(options_.move_ratio, options_.quadrature); });
    }
    interleave();
    return finish();
  }

  /// Empties what doesn't fit, fills it again, and goes on as for a new mesh with what is near.
  Mesh_report_2 adapt()
  {
    Misfit_remover_2<Mesh> remover(mesh_, constraint_spacing);
    if (options_.grade_input) timed(Stage::constraints, [this] { grade_meshed(); });
    timed(Stage::constraints, [&] { empty(remover); });
    if (options_.seeding == Seeding::crystal) timed(Stage::seeding, [&] { seed_holes(remover); });
    timed(Stage::relaxation, [this] { relax_all(options_.move_ratio, options_.quadrature); });
    interleave();
    return finish();
  }

  Mesh_report_2 relax()
  {
    if (options_.grade_input) timed(Stage::constraints, [this] { set_grading_2(mesh_, mesh_); });
    Relaxation_guard_2<Mesh> guard(mesh_);
    timed(Stage::relaxation, [this] { relax_all(options_.final_move_ratio, options_.final_quadrature); });
    if (options_.polish) timed(Stage::polishing, [this] { polish_angles(); });
    guard.mend();
    if (guard.is_worse()) {
      guard.restore();
      if (options_.polish) timed(Stage::polishing, [this] { polish_angles(); }); // by itself it does little harm
      if (guard.is_worse()) guard.restore();
    }
    refiner_.find_bad();
    return finish();
  }

private:
  // Lattice spacing and metric length of constrained edges to aim at, in parts of the target. A wider lattice ends with
  // fewer triangles, but the layer along the constraints takes longer.
  static constexpr double lattice_spacing = 0.9, constraint_spacing = 0.9;

  static constexpr int most_rounds = 8, most_fruitless_batches = 60, most_local_sweeps = 4;

  template <class Function>
  void timed(Stage stage, const Function& function)
  {
    run_.timed(stage, function);
  }

  bool go_on(std::size_t vertices) { return run_.go_on(vertices, bad_); }
  bool go_on() { return go_on(mesh_.vertices().size()); }
  // For algorithms that ask whether to go on. From one place each, so that what they are compiled for is one type.
  auto asked_with_count()
  {
    return [this](std::size_t n) { return go_on(n); };
  }
  auto asked()
  {
    return [this] { return go_on(); };
  }
  void stop(Stop_reason reason) { run_.stop(reason); }
  bool is_stopped() const { return run_.is_stopped(); }

  /// Stops a run that can't end within its budget.
  void check_budget()
  {
    if constexpr (Mesh::uniform)
      if (least_vertices(mesh_, CGAL::to_double(sizing_.size())) >
          static_cast<double>((std::max)(options_.max_vertices, mesh_.vertices().size())))
        stop(Stop_reason::vertex_budget);
  }

  WEFT_COLD void grade_input()
  {
    if (!grade_input_2(mesh_, sizing_, options_.max_vertices, asked_with_count())) stop(Stop_reason::vertex_budget);
  }

  WEFT_COLD void grade_meshed()
  {
    if (!grade_meshed_2(mesh_, sizing_, options_.max_vertices, asked_with_count())) stop(Stop_reason::vertex_budget);
  }

  WEFT_COLD void empty(Misfit_remover_2<Mesh>& remover)
  {
    refiner_.set_min_angle(options_.min_angle);
    const auto is_sharp = [this](Face_handle f) { return options_.min_angle > 0 && refiner_.is_too_sharp(f); };
    if (!remover.run(options_.max_vertices, is_sharp, asked())) stop(Stop_reason::vertex_budget);
  }

  WEFT_COLD void seed_holes(const Misfit_remover_2<Mesh>& remover)
  {
    Crystal_seeder_2<Mesh> seeder(mesh_, lattice_spacing);
    const auto is_open = [&](Face_handle f) { return remover.is_open(f); };
    if (!seeder.run_in_holes(is_open, options_.max_vertices, asked_with_count())) stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  void sample_constraints()
  {
    if (!sample_constraints_2(mesh_, constraint_spacing, options_.max_vertices, asked_with_count()))
      stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  void seed()
  {
    Crystal_seeder_2<Mesh> seeder(mesh_, lattice_spacing);
    if (!seeder.run(options_.max_vertices, asked_with_count())) stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  void relax_all(double move_ratio, int quadrature)
  {
    relax(movable_vertices_2(mesh_), {move_ratio, quadrature, options_.max_sweeps});
  }

  void relax(std::vector<Vertex_handle> active, const typename Mesh_optimiser_2<Mesh>::Effort& effort)
  {
    optimiser_.relax(std::move(active), effort, asked());
  }

  /// Alg. 2: refinement and relaxation in turn, then the last relaxation and polishing; all over again if a criterion
  /// that held before doesn't hold afterwards. When all hold, angles are mended, too, as far as that is cheap.
  WEFT_COLD void interleave()
  {
    optimiser_.allow_insertions(optimiser_.least_insertions + movable_vertices_2(mesh_).size() / 50);
    for (int round = 0; round < most_rounds; ++round) {
      refine_and_polish(round == 0);
      if (is_stopped()) break;
      bad_ = refiner_.find_bad_everywhere();
      if (bad_ > 0 || begin_mending()) continue;
      if (options_.polish) timed(Stage::polishing, [this] { hop(); });
      goal_.judge_as_asked();
      find_bad();
      if (goal_.has_given_up()) break;
      if (bad_ == 0) return; // a ratio of 1 is judged by its square there: rounding may tell them apart
    }
    stop_mending();
    if (bad_ > 0) stop(Stop_reason::iteration_limit);
  }

  void refine_and_polish(bool first)
  {
    refine_until_good();
    // Polishing does what the last relaxation is for, and better: both together take longer, and angles on steep
    // gradients end smaller.
    if (first && !options_.polish) {
      timed(Stage::relaxation, [this] { relax_all(options_.final_move_ratio, options_.final_quadrature); });
      refine_until_good();
    }
    if (options_.polish) timed(Stage::polishing, [this] { polish(); });
  }

  /// Looks for what is bad by the angle that counts now.
  void find_bad()
  {
    refiner_.set_min_angle(goal_.degrees());
    bad_ = refiner_.find_bad_everywhere();
  }

  /// Has refinement look for angles that nobody asked for, once. Returns whether there is something to do.
  bool begin_mending()
  {
    if (!goal_.begin_mending(mesh_.vertices().size())) return false;
    find_bad();
    return bad_ > 0;
  }

  void stop_mending()
  {
    goal_.stop_mending();
    find_bad();
  }

  /// Batches of refinement until no element is bad; stops the run where that takes too long.
  WEFT_COLD void refine_until_good()
  {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    int fruitless = 0; // batches since there have been so few
    bool polished = false;
    while (!is_stopped()) {
      bad_ = refiner_.find_bad();
      if (sizes_hold()) goal_.note_sizes_hold(mesh_.vertices().size());
      if (bad_ == 0 || !go_on()) return;
      if (options_.polish && refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal) {
        timed(Stage::polishing, [this] { polish_sizes(); });
        bad_ = refiner_.find_bad();
      }
      if (bad_ > 0 && sizes_hold() && options_.polish && !polished) { // a better angle costs no vertex
        polished = true;
        timed(Stage::polishing, [this] { polish(); });
        continue;
      }
      if (bad_ == 0 || is_stopped()) return;
      fruitless = bad_ < fewest ? 0 : fruitless + 1;
      fewest = (std::min)(fewest, bad_);
      if (is_stuck(fruitless)) {
        if (goal_.is_mending()) {
          stop_mending();
        } else if (goal_.can_give_up(sizes_hold())) {
          goal_.give_up();
          find_bad();
        } else {
          return stop(Stop_reason::iteration_limit);
        }
        fewest = std::numeric_limits<std::size_t>::max();
        polished = false;
        continue;
      }
      timed(Stage::refinement, [this] { refine(); });
    }
  }

  /// Batches that lower sizes may well find more bad elements than before; those for angles alone have no such excuse.
  bool is_stuck(int fruitless) const
  {
    return goal_.is_too_dear(mesh_.vertices().size(), sizes_hold()) ||
           report_.batches >= static_cast<std::size_t>(options_.max_batches) ||
           (sizes_hold() && fruitless >= most_fruitless_batches);
  }

  bool sizes_hold() const { return refiner_.oversized() == 0; }

  void refine()
  {
    const std::size_t n = mesh_.vertices().size();
    if (n >= options_.max_vertices) return stop(Stop_reason::vertex_budget);
    const bool near = refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal;
    const std::size_t most = (std::min)(near ? (std::max)(n / 20, std::size_t(1)) : n, options_.max_vertices - n);
    const std::vector<Vertex_handle> fresh = refiner_.refine((std::max)(most, std::size_t(1)));
    ++report_.batches;
    mesh_.renumber();
    if (fresh.empty()) return goal_.is_mending() ? stop_mending() : stop(Stop_reason::resolution);
    // Relaxation knows sizes only; it would undo what is refined for angles. Polishing follows.
    if (sizes_hold()) return;
    if (!near) return relax_all(options_.move_ratio, options_.quadrature);
    // Where many edges are just short enough, relaxing far around undoes what polishing achieved.
    relax(optimiser_.with_neighbors(fresh),
          {options_.move_ratio, options_.quadrature, (std::min)(most_local_sweeps, options_.max_sweeps)});
  }

  // What the optimiser does, as long as the run may go on.
  void polish_sizes() { optimiser_.polish_sizes(asked()); }
  void polish_angles() { optimiser_.polish_angles(asked()); }
  void polish() { optimiser_.polish(asked()); }
  void hop()
  {
    const std::size_t n = mesh_.vertices().size();
    optimiser_.hop(options_.max_vertices - (std::min)(n, options_.max_vertices), asked());
  }

  WEFT_COLD Mesh_report_2 finish()
  {
    for (const Vertex_handle v : mesh_.vertices())
      if (v->constraint() >= 0) ++report_.constraint_steiner;
    run_.report(report_);
    report_.vertices = mesh_.vertices().size();
    report_.interior_steiner = report_.vertices - report_.input_vertices - report_.constraint_steiner;
    report_.triangles = mesh_.faces().size();
    report_.largest_ratio = refiner_.largest_ratio();
    report_.oversized = refiner_.oversized();
    const auto sharp = refiner_.count_sharp();
    report_.below_min_angle = sharp.mendable;
    report_.at_input_angle = sharp.given;
    mesh_.finish();
    const Quality_2 quality = measure_quality_2(mesh_.triangulation());
    report_.smallest_angle = quality.smallest_angle.degrees;
    report_.largest_angle = quality.largest_angle.degrees;
    return report_;
  }

  Mesh mesh_;
  const Sizing& sizing_;
  const Mesh_options_2& options_;
  Run run_;
  Angle_goal_2 goal_;
  Mesh_report_2 report_;
  Batch_refiner_2<Mesh> refiner_;
  Mesh_optimiser_2<Mesh> optimiser_;
  std::size_t bad_ = 0;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_PLANAR_MESHER_2_H
