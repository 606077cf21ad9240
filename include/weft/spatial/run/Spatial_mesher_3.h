// SPDX-License-Identifier: GPL-3.0-or-later
//
// The driver of spatial meshing (Tournois 2009, sec. 3.2.1, Alg. 5): refinement, what optimises the mesh then, and the
// report.

#ifndef WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H
#define WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H

#include <weft/internal/run/Run.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/coarsen_3.h>
#include <weft/spatial/optimise/insert_twins_3.h>
#include <weft/spatial/optimise/move_twins_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/optimise/turn_diagonals_3.h>
#include <weft/spatial/refine/fix_twins_3.h>
#include <weft/spatial/refine/interior_lattice_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/fill_report_3.h>
#include <weft/spatial/run/Initial_vertices_3.h>
#include <weft/spatial/run/Optimisation_plan_3.h>
#include <weft/spatial/run/Refinement_3.h>
#include <weft/spatial/run/require_thickness_3.h>
#include <weft/spatial/run/restart_where_bad_3.h>
#include <weft/spatial/run/Still_vertices_3.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace weft::internal {

/// Meshes the domain behind an oracle; see `make_mesh_3()`.
template <class Oracle>
class Spatial_mesher_3
{
public:
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Restricted = Restricted_delaunay_3<Oracle>;

  Spatial_mesher_3(const Oracle& oracle, const Criteria_3<Kernel>& criteria, const Mesh_options_3& options)
      : oracle_(oracle),
        criteria_(criteria),
        options_(options),
        plan_(options, true),
        mesh_(oracle, options.threads),
        run_(options.visitor, options.time_limit),
        refinement_(mesh_, criteria_, options, run_, report_)
  {}

  /// The same beginning with vertices that there are: these instead of seeds, and refinement only as far as the
  /// criteria ask for it.
  Spatial_mesher_3(const Oracle& oracle, const Criteria_3<Kernel>& criteria, const Mesh_options_3& options,
                   const Initial_vertices_3<Kernel>& initial)
      : Spatial_mesher_3(oracle, criteria, options)
  {
    initial_ = &initial;
    plan_ = Optimisation_plan_3(options, false);
  }

  Spatial_mesher_3(const Spatial_mesher_3&) = delete; // its parts know each other
  Spatial_mesher_3& operator=(const Spatial_mesher_3&) = delete;

  /// Runs; afterwards `take_mesh()` has the mesh.
  Mesh_report_3 run()
  {
    meet_criteria();
    start_again_where_bad();
    optimise();
    Mesh_report_3 result = report();
    compare_with_domain(result);
    return result;
  }

  /// To be called before anything else, see Refinement_3.
  void leave_knife_edges() { refinement_.leave_knife_edges(); }

  /// The first half of `run()`: refines until the criteria hold or nothing more can be done.
  void meet_criteria()
  {
    run_.begin_stage("initialisation", Stage::seeding);
    if (!initial_) require_thickness(oracle_, criteria_, refinement_.size_floor(), options_.max_vertices);
    if (initial_ && initial_->is_adaptation)
      mesh_.insert(initial_->points, initial_->locations);
    else if (initial_)
      interior_ = insert_boundary(*initial_, mesh_);
    inserted_at_ = mesh_.version();
    goes_on_ = initial_ ? visit(0) : refinement_.mesh_first_surface();
    run_.begin_stage("surface", Stage::refinement);
    goes_on_ = goes_on_ && refinement_.refine_surface();
    run_.begin_stage("lattice", Stage::seeding);
    if (goes_on_ && initial_) report_.coarsened += insert_interior(interior_, criteria_, mesh_);
    if (goes_on_ && !initial_ && options_.lattice && criteria_.size.is_constant())
      insert_lattice(mesh_, criteria_.size.constant(), options_.max_vertices);
    run_.begin_stage("interior", Stage::refinement);
    goes_on_ = goes_on_ && refinement_.refine(1, true);
    if (goes_on_ && initial_ && initial_->only_manifold) goes_on_ = check_manifold_3(tetrahedral_mesh(mesh_)).ok();
  }

  /// To be called in between: starts again where elements are bad still, see `restart_where_bad_3()`.
  void start_again_where_bad()
  {
    if (!goes_on_ || initial_ || refinement_.bad_left() == 0) return;
    run_.begin_stage("starting again", Stage::refinement);
    goes_on_ = restart_where_bad_3(refinement_);
  }

  /// The second half; does nothing if the first was stopped.
  void optimise()
  {
    if (!initial_) plan_.fit(run_.seconds(), run_.time_left());
    if (goes_on_) fix_twins(mesh_);
    const std::optional<Still_vertices_3<Restricted>> still =
        goes_on_ && initial_ && initial_->is_adaptation
            ? std::make_optional<Still_vertices_3<Restricted>>(mesh_, inserted_at_, initial_->changed)
            : std::nullopt;
    goes_on_ = goes_on_ && coarsen_and_smooth();
    run_.begin_stage("perturbation", Stage::polishing);
    if (goes_on_ && plan_.target() > 0) perturb();
  }

  /// The report so far, but for the comparison with the domain.
  Mesh_report_3 report()
  {
    run_.end_stage();
    Mesh_report_3 result = report_;
    run_.report(result);
    fill_report(mesh_, criteria_, refinement_.size_floor(), plan_.target() > 0, result);
    refinement_.add_earlier_queries(result);
    return result;
  }

  /// Adds the comparison with the domain to a report of the mesh as it is.
  void compare_with_domain(Mesh_report_3& report) const
  {
    report.domain = internal::compare_with_domain(tetrahedral_mesh(mesh_), oracle_, criteria_);
    set_exhausted_if_bad(report);
  }

  /// The mesh as it is, also while a visitor is called.
  const Restricted& mesh() const { return mesh_; }

  Restricted take_mesh() { return std::move(mesh_); }

private:
  /// Interleaves what Alg. 5 does, in another order: smoothing the coarse mesh and refining it then, as there, takes
  /// more vertices, since it moves vertices away from the folds that attracted them. Criteria come first, then vertices
  /// are taken away as long as they hold, and smoothing, which keeps them too, makes room for more of that. What
  /// couldn't be refined before stays as it is: another refinement mends nothing there, and may make more bad elements.
  bool coarsen_and_smooth()
  {
    if (!plan_.coarsens() && plan_.sweeps() == 0) return true;
    run_.begin_stage("sorting in memory", Stage::polishing);
    sort_in_memory(mesh_);
    report_.refined_smallest_dihedral = smallest_dihedral();
    if (initial_ && initial_->is_adaptation) return smooth() && coarsen(); // what was too much is gone already
    if (refinement_.bad_left() > 0 && is_bad_all_over()) return coarsen();
    if (!(coarsen() && smooth() && (plan_.sweeps() == 0 || coarsen()))) return false;
    return !initial_ || refine_to_final_shapes();
  }

  /// Initial vertices are held to better shapes once they are smoothed.
  bool refine_to_final_shapes()
  {
    run_.begin_stage("refinement after smoothing", Stage::refinement);
    criteria_.facet_shape = tighter(criteria_.facet_shape, initial_->facet_shape_in_the_end);
    criteria_.cell_shape = tighter(criteria_.cell_shape, initial_->cell_shape_in_the_end);
    if (is_good()) return true; // refinement also prevents: it would mirror vertices at acute edges
    guard_.reset();
    return refinement_.refine(1, true);
  }

  /// Watches all that comes after refinement: one for each stage would take too long.
  Criteria_guard_3<Restricted>& guard()
  {
    if (!guard_) guard_.emplace(mesh_, criteria_, options_.threads, initial_ && initial_->is_adaptation);
    return *guard_;
  }

  bool coarsen()
  {
    run_.begin_stage("coarsening", Stage::polishing);
    if (!plan_.coarsens()) return true;
    Coarsen_options_3 options;
    if (initial_ && initial_->is_adaptation) options.most_passes = 1;
    options.time_limit = plan_.time_before_perturbation(run_.time_left());
    options.go_on = [this] { return visit(0); };
    report_.coarsened += coarsen_3(mesh_, guard(), options).removed;
    return run_.may_go_on();
  }

  bool smooth()
  {
    run_.begin_stage("smoothing", Stage::relaxation);
    const double share = initial_ ? initial_->smoothing_share : 1;
    // A sweep isn't broken off: it takes about twice the time of all that came before it.
    const bool fits = share == 1 || 2 * run_.seconds() < share * run_.time_left();
    if (plan_.sweeps() == 0 || !fits) return true;
    sort_in_memory(mesh_); // coarsening has left gaps
    Smooth_options_3 options;
    options.max_sweeps = plan_.sweeps();
    options.threads = options_.threads;
    options.time_limit = plan_.time_before_perturbation(share * run_.time_left());
    options.go_on = [this] { return visit(0); };
    const Smooth_report_3 result = smooth_3(mesh_, guard(), options);
    report_.smoothing_sweeps += result.sweeps;
    report_.smoothing_moves += result.moves;
    report_.smoothing_locked += result.locked;
    report_.smoothing_rejected += result.rejected;
    report_.moved_in_place += result.relocations.in_place;
    report_.moved_one_by_one += result.relocations.one_by_one;
    report_.moved_by_rebuilding += result.relocations.rebuilt;
    return run_.may_go_on();
  }

  bool visit(std::size_t bad) { return run_.visit(mesh_.vertices().size(), bad); }

  std::size_t bad_elements() const
  {
    Mesh_report_3 now;
    count_bad_elements(mesh_, criteria_, refinement_.size_floor(), now);
    return now.bad();
  }
  bool is_good() const { return bad_elements() == 0; }
  /// As a checkerboard is, whose surfaces touch along all edges. No effort mends that.
  bool is_bad_all_over() const { return !initial_ && 10 * bad_elements() > mesh_.vertices().size(); }

  double smallest_dihedral() const
  {
    double worst = -1;
    for (const auto c : mesh_.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) worst = (std::max)(worst, cosines_of_cell(c).smallest);
    return degrees_of_cosine(worst);
  }

  void perturb()
  {
    turn_diagonals(mesh_, guard(), options_.seed + 3);
    const std::function<bool()> goes_on = [this] { return visit(0) && run_.has_time(); };
    move_twins(mesh_, guard(), options_.seed + 4, 1, goes_on);
    Perturb_options_3 options;
    options.target = plan_.target();
    // Where something is bad, the input has angles so small that the worst cells stay, whatever is done about them.
    // Given vertices may be beyond what criteria can mend; their slivers are wanted gone all the same.
    options.mend_worst = initial_ || is_good();
    if (!options.mend_worst && is_bad_all_over()) {
      options.step = 8;
      options.most_passes = 1;
      options.insertions = 0;
    }
    options.seed = options_.seed + 2;
    options.time_limit = run_.time_left();
    options.go_on = [this](double) { return visit(0); };
    // The worst cells are much work: first it is seen what more twins can do about them.
    const bool mends_worst = options.mend_worst, has_twins = has_fixed_twins(mesh_);
    const std::size_t most = mesh_.vertices().size() + mesh_.vertices().size() / 8;
    double reached = 0;
    for (unsigned round = 0;; ++round) {
      options.mend_worst = mends_worst && (round > 0 || !has_twins);
      const Perturb_report_3 result = perturb_slivers_3(mesh_, guard(), options);
      move_twins(mesh_, guard(), options_.seed + 5 + round, round == 0 ? 1 : share_of_trials, goes_on);
      if (round == 0) report_.smoothed_smallest_dihedral = result.before;
      reached = result.after;
      report_.perturbed += result.by_radius + result.by_volume + result.by_chance;
      report_.perturb_insertions += result.insertions;
      if (!has_twins || !goes_on()) break;
      const std::size_t twins = round < rounds_of_twins ? insert_twins(mesh_, guard(), most, goes_on) : 0;
      report_.perturb_insertions += twins;
      if (twins > 0) turn_diagonals(mesh_, guard(), options_.seed + 8 + round);
      if (twins == 0 && round > 0) break;
    }
    if (has_twins) mend_flat_cells(goes_on);
    if (mends_worst) climb(reached, goes_on);
    const double last = plan_.steps() > 0 ? plan_.target_of_step(plan_.steps() - 1) : plan_.target();
    if (last < Perturb_options_3::as_far_as_it_goes) run_.may_go_on();
  }

  /// Perturbs for further targets, one after the other. All of them share the vertices that may be inserted.
  /// \param reached degrees.
  void climb(double reached, const std::function<bool()>& goes_on)
  {
    const double most = most_inserted * static_cast<double>(mesh_.vertices().size());
    double inserted = 0, wanted = plan_.target();
    Perturb_options_3 options;
    options.go_on = [this](double) { return visit(0); };
    for (int step = 0; step < plan_.steps() && goes_on(); ++step) {
      options.target = plan_.target_of_step(step);
      const bool is_last = options.target >= Perturb_options_3::as_far_as_it_goes;
      if (!is_last && reached < wanted) continue;
      if (!is_last) options.first_bound = wanted = options.target;
      options.insertions = (std::max)(0., most - inserted) / static_cast<double>(mesh_.vertices().size());
      options.seed = options_.seed + first_seed_of_steps + static_cast<unsigned>(step);
      options.time_limit = run_.time_left();
      const Perturb_report_3 result = perturb_slivers_3(mesh_, guard(), options);
      reached = result.after;
      report_.perturbed += result.by_radius + result.by_volume + result.by_chance;
      report_.perturb_insertions += result.insertions;
      inserted += static_cast<double>(result.insertions) - static_cast<double>(result.removals);
    }
  }

  /// A few flat cells between twins that are left are bad luck, and other random moves mend most of them.
  void mend_flat_cells(const std::function<bool()>& goes_on)
  {
    for (unsigned k = 0; k < most_chances && goes_on(); ++k) {
      Mesh_report_3 now;
      count_forced_elements(mesh_, criteria_, true, now);
      if (now.bad_cells.elements == 0 || now.bad_cells.elements > few_cells) return;
      turn_diagonals(mesh_, guard(), options_.seed + 20 + 2 * k);
      move_twins(mesh_, guard(), options_.seed + 21 + 2 * k, 1, goes_on);
    }
  }

  static constexpr unsigned rounds_of_twins = 5;   ///< insertions
  static constexpr double share_of_trials = 0.125; ///< that later rounds have to move twins
  static constexpr unsigned most_chances = 8;      ///< that flat cells get to be mended
  static constexpr std::size_t few_cells = 10;     ///< flat ones; more are none by chance
  static constexpr double most_inserted = 0.15;    ///< vertices, in parts of those there are, by further targets
  static constexpr unsigned first_seed_of_steps = 100;

  const Oracle& oracle_;
  Criteria_3<Kernel> criteria_;
  const Mesh_options_3& options_;
  Optimisation_plan_3 plan_;
  const Initial_vertices_3<Kernel>* initial_ = nullptr;
  Interior_vertices_3<Point> interior_; ///< of the initial vertices, those to be inserted later
  int inserted_at_ = 0;         ///< version of the mesh when the initial vertices were in
  Restricted mesh_;
  std::optional<Criteria_guard_3<Restricted>> guard_; ///< from when refinement has ended
  Mesh_report_3 report_;
  bool goes_on_ = false; ///< neither done nor stopped
  Run run_;
  Refinement_3<Restricted> refinement_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H
