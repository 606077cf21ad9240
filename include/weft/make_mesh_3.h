// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE in 3D: `make_mesh_3()` fills the domain behind an oracle with tetrahedra that satisfy size, approximation,
// shape and topology criteria, by batches of Delaunay refinement (Tournois 2009, sec. 3.2).
//
//   #include <weft/IO/read_surface.h>
//
//   const auto surface = weft::IO::read_surface<K>("elephant.off");
//   const weft::Polyhedral_oracle_3<K> domain(surface, weft::Feature_options{60});
//   weft::Criteria_3<K> criteria;
//   criteria.size = 0.1;
//   const auto [mesh, report] = weft::make_mesh_3(domain, criteria);

#ifndef WEFT_MAKE_MESH_3_H
#define WEFT_MAKE_MESH_3_H

#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/require_oracle_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>

#include <cstdlib>
#include <type_traits>
#include <utility>

namespace weft {

/// Result of `make_mesh_3()`.
template <class Oracle>
struct Make_mesh_result_3
{
  /// The mesh inside the Delaunay triangulation that it is restricted from: `tetrahedral_mesh(restricted)` gives
  /// arrays, `to_c3t3(restricted)` CGAL's complex. Asks the oracle, which has to outlive it.
  Restricted_delaunay_3<Oracle> restricted;
  Mesh_report_3 report;
};

/// Meshes the domain behind `oracle`.
///
/// Feature vertices become vertices, creases chains of edges, patches triangulated surfaces whose vertices lie on them.
/// Ends when all criteria hold or when nothing more can be done about those that don't, which the report counts; on
/// early stops (budgets, time, visitor) the mesh is the Delaunay mesh as it was then.
/// \param oracle a domain oracle, see doc/concepts/DomainOracle_3.h; has to outlive the result, so a temporary is
///        refused.
/// \throws Option_error for criteria or options out of range, or if a field of the criteria isn't positive.
template <class Oracle>
Make_mesh_result_3<Oracle> make_mesh_3(const Oracle& oracle, const Criteria_3<typename Oracle::Kernel>& criteria,
                                       const Mesh_options_3& options = Mesh_options_3())
{
  if constexpr (internal::Oracle_requirements_3<Oracle>::holds) {
    criteria.check();
    options.check();
    internal::Spatial_mesher_3<Oracle> mesher(oracle, criteria, options);
    Mesh_report_3 report = mesher.run();
    return {mesher.take_mesh(), std::move(report)};
  } else {
    internal::Oracle_requirements_3<Oracle>::complain();
    std::abort();
  }
}

/// \cond
// Overloads that only say what is wrong.
template <class Oracle>
Make_mesh_result_3<Oracle> make_mesh_3(const Oracle&&, const Criteria_3<typename Oracle::Kernel>&,
                                       const Mesh_options_3& = Mesh_options_3())
{
  internal::complain_about_temporary_3<Oracle>();
  std::abort();
}

template <class Oracle, class Criteria, std::enable_if_t<!internal::Takes_3<Oracle, Criteria>::value, int> = 0>
internal::No_mesh_3 make_mesh_3(const Oracle&, const Criteria&, const Mesh_options_3& = Mesh_options_3())
{
  internal::complain_about_arguments_3<Oracle, Criteria>();
  return {};
}
/// \endcond

} // namespace weft

#endif // WEFT_MAKE_MESH_3_H
