// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a spatial mesher does after refinement, as its options and the time that is left allow. Smoothing and coarsening
// (Tournois 2009, Alg. 5) leave slivers as they are, and perturbation (sec. 3.2.2) has to mend them afterwards: where
// there is no time for that, the refined mesh is perturbed at once.

#ifndef WEFT_SPATIAL_RUN_OPTIMISATION_PLAN_3_H
#define WEFT_SPATIAL_RUN_OPTIMISATION_PLAN_3_H

#include <weft/options.h>
#include <weft/spatial/optimise/Perturb_options_3.h>

#include <algorithm>
#include <cmath>

namespace weft::internal {

/// See the top of the file.
class Optimisation_plan_3
{
public:
  /// Without a time limit: work that `options.effort` or the options beside it ask for, the same on all machines.
  /// \param climbs whether to go to a large target in steps.
  Optimisation_plan_3(const Mesh_options_3& options, bool climbs)
      : coarsen_(options.coarsen), sweeps_(options.smoothing_sweeps), target_(options.min_dihedral_angle)
  {
    if (options.effort)
      set_effort(*options.effort);
    else if (climbs && target_ > angle_reached_soon && target_ < Perturb_options_3::as_far_as_it_goes)
      climb_to(target_);
  }

  /// Gives up what leaves no time for perturbation.
  /// \param refined in seconds: what refinement has taken.
  /// \param left seconds.
  void fit(double refined, double left)
  {
    refined_ = refined;
    if (target_ == 0 || !(left < HUGE_VAL)) return;
    if (left < time_to_coarsen * refined) coarsen_ = false;
    if (left < (steps() > 0 || target_ > angle_reached_soon ? time_to_smooth_first : time_for_all) * refined)
      sweeps_ = 0;
  }

  bool coarsens() const { return coarsen_; }
  int sweeps() const { return sweeps_; }
  /// Smallest dihedral angle in degrees to perturb for, see `Mesh_options_3`.
  double target() const { return target_; }
  /// Further targets, one after the other, as long as those before were reached; but the one without an end in any
  /// case. So more effort does what less effort does, and goes on.
  int steps() const { return steps_ + goes_to_the_end_; }
  double target_of_step(int step) const
  {
    return step == steps_ ? 90 : (std::min)(usual().min_dihedral_angle + (step + 1) * height_of_step, last_target_);
  }

  /// Of the time that is left, what coarsening and smoothing may take: perturbation needs some.
  double time_before_perturbation(double left) const
  {
    return target_ > 0 ? (std::max)(0., left - time_to_perturb * refined_) : left;
  }

private:
  static Mesh_options_3 usual() { return Mesh_options_3(); }

  void set_effort(double effort)
  {
    coarsen_ = effort >= least_effort_to_coarsen;
    sweeps_ = effort >= usual_effort ? usual().smoothing_sweeps : 0;
    target_ = usual().min_dihedral_angle * (std::min)(effort / usual_effort, 1.);
    if (effort <= usual_effort) return;
    steps_ = static_cast<int>(std::floor(most_steps * (effort - usual_effort) / (1 - usual_effort) + rounding));
    goes_to_the_end_ = effort >= 1;
  }

  void climb_to(double target)
  {
    last_target_ = target;
    target_ = usual().min_dihedral_angle;
    steps_ = static_cast<int>(std::ceil((target - target_) / height_of_step));
  }

  static constexpr double usual_effort = 0.5, least_effort_to_coarsen = 0.25;
  static constexpr double height_of_step = 1; ///< degrees
  static constexpr int most_steps = 15;
  static constexpr double rounding = 1e-9;
  static constexpr double angle_reached_soon = 22; ///< degrees
  // In parts of the time of refinement. Meshes that were smoothed have fewer vertices, but it takes long until their
  // angles are as good.
  static constexpr double time_to_coarsen = 4, time_to_perturb = 2, time_for_all = 12, time_to_smooth_first = 48;

  bool coarsen_, goes_to_the_end_ = false;
  int sweeps_, steps_ = 0;
  double target_, last_target_ = 90, refined_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_OPTIMISATION_PLAN_3_H
