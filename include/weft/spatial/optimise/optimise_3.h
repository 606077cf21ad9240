// SPDX-License-Identifier: GPL-3.0-or-later
//
// All stages that follow refinement (Tournois 2009, Alg. 5) on a mesh that satisfies its criteria: coarsening,
// smoothing by a smoother of one's choice, coarsening again, perturbation of slivers.

#ifndef WEFT_SPATIAL_OPTIMISE_OPTIMISE_3_H
#define WEFT_SPATIAL_OPTIMISE_OPTIMISE_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/coarsen_3.h>
#include <weft/spatial/optimise/Coarsen_options_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/optimise/smoothers_3.h>

namespace weft {

/// Options of `optimise_3()`. Each stage has the time limit of its own options.
struct Optimise_options_3
{
  bool coarsen = true, smooth = true, perturb = true; ///< which stages run
  Coarsen_options_3 coarsening;                       ///< before and after smoothing
  Smooth_options_3 smoothing;                         ///< metric, number of sweeps
  Perturb_options_3 perturbation;                     ///< smallest dihedral angle to reach
};

/// What `optimise_3()` did; of stages that didn't run, nothing.
struct Optimise_report_3
{
  Coarsen_report_3 coarsening, coarsening_smoothed; ///< before and after smoothing
  Smooth_report_3 smoothing;
  Perturb_report_3 perturbation;
};

/// Optimises a mesh under one guard, which keeps each stage from undoing what refinement or an earlier one has
/// achieved.
/// \tparam Restricted a Restricted_delaunay_3.
/// \tparam Smoother a smoother, see smoothers_3.h; or Energy_smoother_3, which minimises an energy.
/// \throws Option_error for options or criteria out of range.
template <class Restricted, class Smoother = Natural_odt_3>
Optimise_report_3 optimise_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                             const Optimise_options_3& options = Optimise_options_3(),
                             const Smoother& smoother = Smoother())
{
  criteria.check();
  options.coarsening.check();
  options.smoothing.check();
  options.perturbation.check();
  internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
  Optimise_report_3 report;
  if (options.coarsen) report.coarsening = coarsen_3(mesh, guard, options.coarsening);
  if (options.smooth) report.smoothing = smooth_3(mesh, guard, options.smoothing, smoother);
  if (options.coarsen && options.smooth) report.coarsening_smoothed = coarsen_3(mesh, guard, options.coarsening);
  if (options.perturb) report.perturbation = perturb_slivers_3(mesh, guard, options.perturbation);
  return report;
}

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_OPTIMISE_3_H
