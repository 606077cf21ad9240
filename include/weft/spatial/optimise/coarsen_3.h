// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes vertices that no criterion needs, as pliant meshers do (Bossen, Heckbert 1996); proposed in Tournois 2009,
// sec. 4.1. Refinement never removes what it has inserted. When the criteria hold, every vertex is tried, the most
// crowded first; it stays if the cells and facets that would fill its place violate a criterion.

#ifndef WEFT_SPATIAL_OPTIMISE_COARSEN_3_H
#define WEFT_SPATIAL_OPTIMISE_COARSEN_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Coarsen_options_3.h>
#include <weft/spatial/optimise/Mesh_coarsener_3.h>

namespace weft {

/// The same as below, with a guard that has watched other stages, too: what was bad before those is tolerated.
template <class Restricted>
Coarsen_report_3 coarsen_3(Restricted& mesh, internal::Criteria_guard_3<Restricted>& guard,
                           const Coarsen_options_3& options = Coarsen_options_3())
{
  options.check();
  return internal::Mesh_coarsener_3<Restricted>(mesh, guard, options).run();
}

/// Takes away vertices inside, on patches and on creases as long as elements that satisfy `criteria` are replaced by
/// elements that do and facets don't come to lie farther from the surface than the farthest did before.
///
/// The triangulation stays Delaunay; ids of vertices are given anew. About 0.1 ms a vertex and pass.
/// \tparam Restricted a Restricted_delaunay_3.
/// \throws Option_error for options or criteria out of range.
template <class Restricted>
Coarsen_report_3 coarsen_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                           const Coarsen_options_3& options = Coarsen_options_3())
{
  criteria.check();
  options.check();
  internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
  return coarsen_3(mesh, guard, options);
}

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_COARSEN_3_H
