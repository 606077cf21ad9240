// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing of a spatial Delaunay mesh (Tournois 2009, sec. 3.2.1.5, 3.3.2, 3.3.3): in every sweep each vertex moves to
// where a smoother wants it, projected onto its own patch or crease, but for vertices locked by excellent cells. All
// move at once. What the thesis leaves to the next refinement is prevented here: the vertices of elements that a sweep
// makes violate a criterion go back, and take shorter steps from then on; a sweep that raises the ODT energy is undone.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTH_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTH_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Mesh_smoother_3.h>
#include <weft/spatial/optimise/Smooth_options_3.h>
#include <weft/spatial/optimise/smoothers_3.h>

#include <optional>
#include <type_traits>

namespace weft {
namespace internal {

/// Whether a smoother moves the vertices by itself, as Energy_smoother_3, instead of saying where each should be.
template <class Smoother, class = void>
inline constexpr bool is_whole_smoother_v = false;
template <class Smoother>
inline constexpr bool is_whole_smoother_v<Smoother, std::void_t<typename Smoother::Moves_all>> = true;

template <class Restricted, class Smoother>
Smooth_report_3 run_smoother(Restricted& mesh, const Criteria_guard_3<Restricted>* guard,
                             const Smooth_options_3& options, const Smoother& smoother)
{
  if constexpr (is_whole_smoother_v<Smoother>)
    return smoother.run(mesh, guard, options);
  else
    return Mesh_smoother_3<Restricted, Smoother>(mesh, guard, options, smoother).run();
}

} // namespace internal

/// Smooths a mesh: its vertices move, those on patches and creases along them, and the triangulation stays Delaunay.
///
/// With `keep_criteria`, elements that violate a criterion, vertices without a topological disk and crease edges that
/// strayed are no more at the end than at the start.
/// \tparam Restricted a Restricted_delaunay_3.
/// \tparam Smoother a smoother, see smoothers_3.h; or Energy_smoother_3, which minimises an energy.
/// \throws Option_error for options or criteria out of range.
template <class Restricted, class Smoother = Natural_odt_3>
Smooth_report_3 smooth_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                         const Smooth_options_3& options = Smooth_options_3(), const Smoother& smoother = Smoother())
{
  criteria.check();
  options.check();
  std::optional<internal::Criteria_guard_3<Restricted>> guard; // measuring the whole mesh takes as long as a sweep
  internal::Lap_timer lap;
  if (options.keep_criteria) guard.emplace(mesh, criteria);
  const double seconds = lap.seconds();
  auto report = internal::run_smoother(mesh, guard ? &*guard : nullptr, options, smoother);
  report.guard_seconds += seconds;
  return report;
}

/// The same with a guard that has watched other stages, too. Without `keep_criteria` it isn't asked.
template <class Restricted, class Smoother = Natural_odt_3>
Smooth_report_3 smooth_3(Restricted& mesh, internal::Criteria_guard_3<Restricted>& guard,
                         const Smooth_options_3& options = Smooth_options_3(), const Smoother& smoother = Smoother())
{
  options.check();
  if (options.keep_criteria) guard.tolerate_all(); // else what no move can mend would take them all back
  return internal::run_smoother(mesh, options.keep_criteria ? &guard : nullptr, options, smoother);
}

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTH_3_H
