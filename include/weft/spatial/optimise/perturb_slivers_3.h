// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sliver removal by perturbing vertices (Tournois 2009, sec. 3.2.2, Alg. 7; Tournois, Srinivasan, Alliez, "Perturbing
// slivers in 3D Delaunay meshes", 2009): a vertex of a sliver moves along the gradient of the squared circumradius, or
// down that of the volume, or somewhere at random, so that the Delaunay triangulation flips the sliver away. A move is
// kept if the worst new cell is better than the worst cell that it replaces, the boundary stays a surface and no
// criterion is violated that held: the smallest dihedral angle of the mesh never falls.
//
// Bounds rise over the whole mesh first, which is fast. Then only the worst few cells are worked on, since they
// determine the smallest angle of the mesh.

#ifndef WEFT_SPATIAL_OPTIMISE_PERTURB_SLIVERS_3_H
#define WEFT_SPATIAL_OPTIMISE_PERTURB_SLIVERS_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Sliver_perturber_3.h>

namespace weft {

/// Raises the smallest dihedral angle of a mesh as far as `options.target` by moving, inserting and removing vertices
/// inside, on patches and on creases.
///
/// The triangulation stays Delaunay, vertices stay on their patches and creases, the boundary stays a surface, and
/// elements that satisfied `criteria` are replaced by elements that do. The smallest dihedral angle never falls.
/// \param guard has watched other stages, too: what was bad before those is tolerated.
/// \tparam Restricted a Restricted_delaunay_3.
/// \throws Option_error for options out of range.
template <class Restricted>
Perturb_report_3 perturb_slivers_3(Restricted& mesh, internal::Criteria_guard_3<Restricted>& guard,
                                   const Perturb_options_3& options = Perturb_options_3())
{
  options.check();
  return internal::Sliver_perturber_3<Restricted>(mesh, guard, options).run();
}

/// The same on its own: what is bad now is tolerated.
/// \throws Option_error for options or criteria out of range.
template <class Restricted>
Perturb_report_3 perturb_slivers_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                                   const Perturb_options_3& options = Perturb_options_3())
{
  criteria.check();
  options.check();
  internal::Criteria_guard_3<Restricted> guard(mesh, criteria);
  return perturb_slivers_3(mesh, guard, options);
}

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_PERTURB_SLIVERS_3_H
