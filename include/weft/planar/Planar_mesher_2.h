// SPDX-License-Identifier: GPL-3.0-or-later
//
// The planar mesher as a sequence of stages over a Working_mesh_2 (Tournois 2009, Alg. 2): sample the constraints, grow
// crystals, relax, then refine and relax in turn until every sizing ratio is at most 1, and polish. `make_mesh_2()` is
// the way to call it.

#ifndef WEFT_PLANAR_PLANAR_MESHER_2_H
#define WEFT_PLANAR_PLANAR_MESHER_2_H

#include <weft/options.h>
#include <weft/planar/basin_hopping_2.h>
#include <weft/planar/input_grading_2.h>
#include <weft/planar/least_vertices_2.h>
#include <weft/planar/Mesh_run_2.h>
#include <weft/planar/pliant_2.h>
#include <weft/planar/polish_2.h>
#include <weft/planar/quality_2.h>
#include <weft/planar/refine_2.h>
#include <weft/planar/relax_2.h>
#include <weft/planar/relaxation_guard_2.h>
#include <weft/planar/sample_constraints_2.h>
#include <weft/planar/seed_crystals_2.h>
#include <weft/planar/Working_mesh_2.h>
#include <weft/report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// The planar mesher's driver; `make_mesh_2()` and `relax_2()` run it.
template <class Cdt, class Sizing>
class Planar_mesher_2
{
public:
  using Mesh = Working_mesh_2<Cdt, Sizing>;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param keep_vertices whether vertices without constraints are to be moved rather than kept as input.
  Planar_mesher_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options, bool keep_vertices)
      : mesh_(cdt, sizing, keep_vertices ? Mesh::Given::relaxable : Mesh::Given::input),
        sizing_(sizing),
        options_(options),
        run_(options),
        refiner_(mesh_, options.min_angle),
        relaxer_(mesh_, options.size_feedback, options.threads),
        polisher_(mesh_),
        pliant_(mesh_, polisher_),
        hopper_(mesh_, polisher_, options.seed)
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
  // fewer triangles, but the layer along the constraints takes longer: for spacings of 0.86 / 0.88 / 0.90 / 0.92 / 0.94
  // the square at 10k triangles has 1.34 / 1.29 / 1.24 / 1.19 / 1.16 times the ideal number of triangles after
  // 18 / 18 / 20 / 28 / 38 ms, a comb 1.34 / 1.32 / 1.31 / 1.30 / 1.29 times after 66 / 80 / 99 / 141 / 182 ms.
  static constexpr double lattice_spacing = 0.9, constraint_spacing = 0.9;

  // Costs from which triangles are polished (38 degrees) and mended by inserting or removing a vertex (37 degrees).
  static constexpr double polish_cost = 0.5, pliant_cost = 1;
  static constexpr std::size_t least_insertions = 20;

  // Angles below this are refined even if nobody asks for it. On details of the input finer than the size the pliant
  // step's budget leaves angles of 18 to 23 degrees; 25 cost 0 to 4 % more vertices there, 28 up to 40 %.
  static constexpr double mended_angle = 25;
  static constexpr std::size_t angle_growth = 4;
  static constexpr int most_pliant_passes = 6, most_rounds = 8, most_fruitless_batches = 60, most_local_sweeps = 4,
                       most_polishing_passes = 30;

  template <class Function>
  void timed(Stage stage, const Function& function)
  {
    run_.timed(stage, report_, function);
  }

  bool go_on(std::size_t vertices) { return run_.go_on(vertices, bad_, report_); }
  bool go_on() { return go_on(mesh_.vertices().size()); }
  void stop(Stop_reason reason) { run_.stop(reason, report_); }
  bool is_stopped() const { return run_.is_stopped(); }

  /// Stops a run that can't end within its budget.
  void check_budget()
  {
    if constexpr (Mesh::uniform)
      if (internal::least_vertices(mesh_, CGAL::to_double(sizing_.size())) >
          static_cast<double>((std::max)(options_.max_vertices, mesh_.vertices().size())))
        stop(Stop_reason::vertex_budget);
  }

  void grade_input()
  {
    if (!grade_input_2(mesh_, sizing_, options_.max_vertices, [this](std::size_t n) { return go_on(n); }))
      stop(Stop_reason::vertex_budget);
  }

  void sample_constraints()
  {
    if (!sample_constraints_2(mesh_, constraint_spacing, options_.max_vertices,
                              [this](std::size_t n) { return go_on(n); }))
      stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  void seed()
  {
    Crystal_seeder_2<Mesh> seeder(mesh_, lattice_spacing);
    if (!seeder.run(options_.max_vertices, [this](std::size_t n) { return go_on(n); }))
      stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  void relax_all(double move_ratio, int quadrature)
  {
    relax(mesh_.vertices(), {move_ratio, quadrature, options_.max_sweeps});
  }

  void relax(std::vector<Vertex_handle> active, const typename Relaxer_2<Mesh>::Effort& effort)
  {
    const auto outcome = relaxer_.run(std::move(active), effort, [this] { return go_on(); });
    report_.sweeps += outcome.sweeps;
    report_.moves += outcome.moves.moved;
    report_.put_back += outcome.moves.put_back;
    report_.flips += outcome.moves.flips;
  }

  /// Alg. 2: refinement and relaxation in turn, then the last relaxation and polishing; all over again if a criterion
  /// that held before doesn't hold afterwards. When all hold, angles are mended, too, as far as that is cheap.
  void interleave()
  {
    const std::size_t n = mesh_.vertices().size();
    // With half as many trials as vertices a fractal shore takes an eighth longer, for 8 % fewer angles below 35
    // degrees.
    pliant_.set_budget(least_insertions + n / 50, 20 * least_insertions + n / 5);
    for (int round = 0; round < most_rounds; ++round) {
      refine_and_polish(round == 0);
      if (is_stopped()) break;
      bad_ = refiner_.find_bad();
      if (bad_ > 0 || begin_mending()) continue;
      if (options_.polish) timed(Stage::polishing, [this] { hop(); });
      refiner_.set_min_angle(options_.min_angle);
      bad_ = refiner_.find_bad();
      if (has_given_up_) break;
      if (bad_ == 0) return; // a ratio of 1 is judged by its square there: rounding may tell them apart
    }
    stop_mending();
    if (bad_ > 0) stop(Stop_reason::iteration_limit);
  }

  void refine_and_polish(bool first)
  {
    refine_until_good();
    // Polishing does what the last relaxation is for, and better: with both, the square at 10k triangles takes 2.6
    // times as long for the same mesh, and lakes graded towards their shores end with a smallest angle of 6 degrees,
    // not 12.
    if (first && !options_.polish) {
      timed(Stage::relaxation, [this] { relax_all(options_.final_move_ratio, options_.final_quadrature); });
      refine_until_good();
    }
    if (options_.polish) timed(Stage::polishing, [this] { polish(); });
  }

  /// Has refinement look for angles that nobody asked for, once. Returns whether there is something to do.
  bool begin_mending()
  {
    if (most_mended_vertices_ > 0 || !options_.grade_input || !options_.polish || options_.min_angle >= mended_angle)
      return false;
    const std::size_t n = mesh_.vertices().size();
    most_mended_vertices_ = n + least_insertions + n / 4;
    is_mending_ = true;
    refiner_.set_min_angle(mended_angle);
    bad_ = refiner_.find_bad();
    return bad_ > 0;
  }

  /// Only what was asked for counts again.
  void stop_mending()
  {
    is_mending_ = false;
    refiner_.set_min_angle(options_.min_angle);
    bad_ = refiner_.find_bad();
  }

  /// Batches of refinement until no element is bad; stops the run where that takes too long.
  void refine_until_good()
  {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    int fruitless = 0; // batches since there have been so few
    bool polished = false;
    while (!is_stopped()) {
      bad_ = refiner_.find_bad();
      if (sized_vertices_ == 0 && refiner_.oversized() == 0) sized_vertices_ = mesh_.vertices().size();
      if (bad_ == 0 || !go_on()) return;
      if (options_.polish && refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal) {
        timed(Stage::polishing, [this] { polish_sizes(); });
        bad_ = refiner_.find_bad();
      }
      if (bad_ > 0 && refiner_.oversized() == 0 && options_.polish && !polished) { // a better angle costs no vertex
        polished = true;
        timed(Stage::polishing, [this] { polish(); });
        continue;
      }
      if (bad_ == 0 || is_stopped()) return;
      fruitless = bad_ < fewest ? 0 : fruitless + 1;
      fewest = (std::min)(fewest, bad_);
      if (is_stuck(fruitless)) {
        if (is_mending_)
          stop_mending();
        else if (can_give_up())
          give_up_angle();
        else
          return stop(Stop_reason::iteration_limit);
        fewest = std::numeric_limits<std::size_t>::max();
        polished = false;
        continue;
      }
      timed(Stage::refinement, [this] { refine(); });
    }
  }

  /// Whether only an angle is missing that is more than refinement can be sure of.
  bool can_give_up() const
  {
    return !has_given_up_ && refiner_.oversized() == 0 && options_.polish && options_.min_angle > mended_angle;
  }

  /// Goes on for an angle that can be had: where refinement is stuck it leaves angles far below the one asked for. A
  /// plate with details finer than the size, asked for 35 degrees, ended with 23030 triangles and 9.8 degrees.
  void give_up_angle()
  {
    has_given_up_ = true;
    refiner_.set_min_angle(mended_angle);
    bad_ = refiner_.find_bad();
  }

  /// Batches that lower sizes may well find more bad elements than before; those for angles alone have no such excuse.
  bool is_stuck(int fruitless) const
  {
    if (is_mending_ && mesh_.vertices().size() >= (std::min)(most_mended_vertices_, options_.max_vertices)) return true;
    if (refiner_.oversized() == 0 && options_.min_angle > mended_angle && !has_given_up_ &&
        mesh_.vertices().size() >= most_angle_vertices())
      return true;
    return report_.batches >= static_cast<std::size_t>(options_.max_batches) ||
           (refiner_.oversized() == 0 && fruitless >= most_fruitless_batches);
  }

  /// What refinement for angles may take: several times as many vertices as sizes need say that it doesn't end.
  std::size_t most_angle_vertices() const { return least_insertions + angle_growth * sized_vertices_; }

  void refine()
  {
    const std::size_t n = mesh_.vertices().size();
    if (n >= options_.max_vertices) return stop(Stop_reason::vertex_budget);
    const bool near = refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal;
    const std::size_t most = (std::min)(near ? (std::max)(n / 20, std::size_t(1)) : n, options_.max_vertices - n);
    const std::vector<Vertex_handle> fresh = refiner_.refine((std::max)(most, std::size_t(1)));
    ++report_.batches;
    mesh_.renumber();
    if (fresh.empty()) return is_mending_ ? stop_mending() : stop(Stop_reason::resolution);
    // Relaxation knows sizes only; it would undo what is refined for angles. Polishing follows.
    if (refiner_.oversized() == 0) return;
    if (!near) return relax_all(options_.move_ratio, options_.quadrature);
    // Where many edges are just short enough, relaxing far around undoes what polishing achieved: with four rings and 8
    // sweeps a fractal shore takes 24 batches and 5844 Steiner points, with one ring and 4 sweeps 14 batches and 5430.
    relax(relaxer_.with_neighbors(fresh),
          {options_.move_ratio, options_.quadrature, (std::min)(most_local_sweeps, options_.max_sweeps)});
  }

  /// Pulls the last edges that are a little too long below the limit.
  void polish_sizes()
  {
    report_.polished += polisher_.run(Polisher_2<Mesh>::oversize_cost, 3, [this] { return go_on(); });
  }

  void polish_angles()
  {
    report_.polished += polisher_.run(polish_cost, most_polishing_passes, [this] { return go_on(); });
  }

  /// Moves, then insertions and removals, for the worst triangles.
  void polish()
  {
    polish_angles();
    for (int pass = 0; pass < most_pliant_passes; ++pass) {
      if (pliant_.pass(pliant_cost, [this] { return go_on(); }) == 0) break;
      polish_angles();
    }
  }

  /// Random changes near the very worst triangles.
  void hop()
  {
    const std::size_t n = mesh_.vertices().size();
    hopper_.run(pliant_cost, options_.max_vertices - (std::min)(n, options_.max_vertices), [this] { return go_on(); });
  }

  Mesh_report_2 finish()
  {
    for (const Vertex_handle v : mesh_.vertices())
      if (v->constraint() >= 0) ++report_.constraint_steiner;
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
  internal::Mesh_run_2 run_;
  Batch_refiner_2<Mesh> refiner_;
  Relaxer_2<Mesh> relaxer_;
  Polisher_2<Mesh> polisher_;
  Pliant_improver_2<Mesh> pliant_;
  Basin_hopper_2<Mesh> hopper_;
  Mesh_report_2 report_;
  std::size_t bad_ = 0;
  std::size_t most_mended_vertices_ = 0;
  bool is_mending_ = false;
  bool has_given_up_ = false;      ///< the angle asked for
  std::size_t sized_vertices_ = 0; ///< when all sizes held for the first time
};

} // namespace weft

#endif // WEFT_PLANAR_PLANAR_MESHER_2_H
