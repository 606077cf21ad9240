// SPDX-License-Identifier: GPL-3.0-or-later
//
// Alg. 7 of Tournois 2009 (sec. 3.2.2.2) as it is printed, to compare with. `perturb_slivers_3()` reaches larger
// angles.

#ifndef WEFT_SPATIAL_OPTIMISE_PERTURB_AS_PUBLISHED_3_H
#define WEFT_SPATIAL_OPTIMISE_PERTURB_AS_PUBLISHED_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Published_perturb_options_3.h>
#include <weft/spatial/optimise/Published_perturber_3.h>

namespace weft {
namespace internal {

/// What Alg. 7 asks of a relocation beside angles: criteria that any mesh meets, so that a guard watches over disks,
/// patches and creases alone.
template <class K>
Criteria_3<K> criteria_of_topology()
{
  Criteria_3<K> loose;
  loose.size = loose.deviation = 1e100; // its square is a number
  loose.facet_shape = loose.cell_shape = 0;
  return loose;
}

} // namespace internal

/// Perturbs the vertices of cells with a dihedral angle below `options.target`. The triangulation stays Delaunay,
/// vertices stay on their patches and creases, and no smallest dihedral angle of what a move changes falls.
/// \param criteria those that hold are kept if `options.keep_criteria` says so; otherwise they aren't looked at.
/// \tparam Restricted a Restricted_delaunay_3.
/// \throws Option_error for options or criteria out of range.
template <class Restricted>
Perturb_report_3 perturb_as_published_3(Restricted& mesh, const Criteria_3<typename Restricted::Kernel>& criteria,
                                        const Published_perturb_options_3& options = Published_perturb_options_3())
{
  criteria.check();
  options.check();
  const auto kept = options.keep_criteria ? criteria : internal::criteria_of_topology<typename Restricted::Kernel>();
  internal::Criteria_guard_3<Restricted> guard(mesh, kept);
  return internal::Published_perturber_3<Restricted>(mesh, guard, options).run();
}

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_PERTURB_AS_PUBLISHED_3_H
