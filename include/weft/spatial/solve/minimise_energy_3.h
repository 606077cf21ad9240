// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimises the ODT or the CVT energy of a tetrahedral mesh by a solver of one's choice (Tournois 2009, sec. 4.2.2).
// Needs Eigen 3.

#ifndef WEFT_SPATIAL_SOLVE_MINIMISE_ENERGY_3_H
#define WEFT_SPATIAL_SOLVE_MINIMISE_ENERGY_3_H

#include <weft/errors.h>
#include <weft/solve/Energy_descent.h>
#include <weft/solve/Solver_options.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/solve/Spatial_model_3.h>

#include <cstddef>
#include <optional>

namespace weft {
namespace internal {

template <class Restricted>
Solver_report minimise_energy(Restricted& mesh, const Criteria_guard_3<Restricted>* guard,
                              const Solver_options& options, const Smooth_options_3& smoothing, Smooth_report_3& report)
{
  options.check();
  if (options.energy == Energy::cvt && !smoothing.uniform)
    throw Option_error("in space the CVT energy is that of one size: uniform has to be set");
  Spatial_model_3<Restricted> model(mesh, guard, smoothing, options, report);
  Solver_report result = Energy_descent<Spatial_model_3<Restricted>, 3>(model, options).run();
  report.sweeps = result.energies.size() - 1;
  report.undone_sweeps = result.undone_sweeps;
  report.energy_before = result.energies.front();
  report.energy_after = result.energies.back();
  report.seconds = result.seconds;
  return result;
}

} // namespace internal

/// Moves the vertices of a mesh to where an energy is small: those on patches and creases along them, feature vertices
/// not at all. The triangulation stays Delaunay; the energy after each sweep that is kept is less than before.
///
/// The energy is that of the cells in the domain. On the boundary its gradient is projected to the patch or crease;
/// where these are flat or straight, that is Natural ODT.
/// \tparam Restricted a Restricted_delaunay_3.
/// \param smoothing its `uniform`, `lipschitz` and `keep_criteria` count: the metric, and whether moves that violate a
///   criterion are shortened. Budgets are those of `options`.
/// \throws Option_error for options or criteria out of range.
template <class Restricted>
Solver_report minimise_energy_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                                const Solver_options& options = Solver_options(),
                                const Smooth_options_3& smoothing = Smooth_options_3())
{
  criteria.check();
  smoothing.check();
  std::optional<internal::Criteria_guard_3<Restricted>> guard;
  if (smoothing.keep_criteria) guard.emplace(mesh, criteria);
  Smooth_report_3 report;
  return internal::minimise_energy(mesh, guard ? &*guard : nullptr, options, smoothing, report);
}

/// The same as a smoother: for `smooth_3()` and whatever takes one. Number of sweeps, time and `go_on` are those of the
/// smoothing options; locks and `move_ratio` don't count.
struct Energy_smoother_3
{
  using Moves_all = void; ///< tells it from smoothers that say where a vertex should be

  Solver_options options; ///< energy, solver, tolerance, whether the boundary moves

  /// Called by `smooth_3()`.
  template <class Restricted>
  Smooth_report_3 run(Restricted& mesh, const internal::Criteria_guard_3<Restricted>* guard,
                      const Smooth_options_3& smoothing) const
  {
    Solver_options own = options;
    own.max_sweeps = smoothing.max_sweeps;
    own.time_limit = smoothing.time_limit;
    own.go_on = smoothing.go_on;
    Smooth_report_3 report;
    internal::minimise_energy(mesh, guard, own, smoothing, report);
    return report;
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_SOLVE_MINIMISE_ENERGY_3_H
