// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE in 3D. `make_mesh_3()` fills the domain behind an oracle with tetrahedra that satisfy size, approximation,
// shape and topology criteria, by batches of Delaunay refinement (Tournois 2009, sec. 3.2).
//
//   const auto surface = weft::IO::read_surface<K>("elephant.off");
//   const weft::Polyhedral_oracle_3<K> domain(surface, weft::Feature_options{60});
//   weft::Criteria_3<K> criteria;
//   criteria.size = 0.1;
//   const auto [mesh, report] = weft::make_mesh_3(domain, criteria);

#ifndef WEFT_MAKE_MESH_3_H
#define WEFT_MAKE_MESH_3_H

#include <weft/internal/timer.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/Criteria_3.h>
#include <weft/spatial/extract_mesh_3.h>
#include <weft/spatial/give_up_creases_3.h>
#include <weft/spatial/Polyhedral_oracle_3.h>
#include <weft/spatial/Restricted_delaunay_3.h>
#include <weft/spatial/Spatial_mesher_3.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace weft {

/// Result of `make_mesh_3()`.
template <class Oracle>
struct Make_mesh_result_3
{
  Restricted_delaunay_3<Oracle> mesh; ///< `tetrahedral_mesh(mesh)` gives arrays, `to_c3t3(mesh)` CGAL's complex
  Mesh_report_3 report;
};

/// Meshes the domain behind `oracle`.
///
/// Feature vertices become vertices, creases chains of edges, patches triangulated surfaces whose vertices lie on them.
/// Ends when all criteria hold or when nothing more can be done about those that don't, which the report counts; on
/// early stops (budgets, time, visitor) the mesh is the Delaunay mesh as it was then.
/// \param oracle a domain oracle, see Polyhedral_oracle_3.h; has to outlive the result.
/// \throws Option_error for criteria or options out of range, or if a field of the criteria isn't positive.
template <class Oracle>
Make_mesh_result_3<Oracle> make_mesh_3(const Oracle& oracle, const Criteria_3<typename Oracle::Kernel>& criteria,
                                       const Mesh_options_3& options = Mesh_options_3())
{
  criteria.check();
  options.check();
  Spatial_mesher_3<Oracle> mesher(oracle, criteria, options);
  Mesh_report_3 report = mesher.run();
  return {mesher.take_mesh(), std::move(report)};
}

/// Result of `make_mesh_3()` for a surface.
template <class K>
struct Make_surface_mesh_result_3
{
  std::shared_ptr<const Polyhedral_oracle_3<K>> domain; ///< what the mesh asks; its complex has the creases kept
  Restricted_delaunay_3<Polyhedral_oracle_3<K>> mesh;
  Mesh_report_3 report;
};

/// Meshes the domain that a surface bounds, and gives creases up that were found by angle where only they keep the
/// criteria from holding: first those beside bad elements, in the end all. Creases that were given stay. Where giving
/// up doesn't help, the mesh is the one with all creases. The report says how many were given up.
/// 	hrows as above.
template <class K>
Make_surface_mesh_result_3<K> make_mesh_3(Piecewise_smooth_complex_3<K> complex, const Criteria_3<K>& criteria,
                                          const Mesh_options_3& options = Mesh_options_3())
{
  using Result = Make_surface_mesh_result_3<K>;
  const internal::Timer timer;
  const auto run = [&](Mesh_options_3 how) {
    how.time_limit = (std::max)(0.0, options.time_limit - timer.seconds());
    auto domain = std::make_shared<const Polyhedral_oracle_3<K>>(complex);
    auto made = make_mesh_3(*domain, criteria, how);
    return std::make_unique<Result>(Result{std::move(domain), std::move(made.mesh), std::move(made.report)});
  };
  std::unique_ptr<Result> first = run(options), trial;
  if (!options.give_up_creases || first->report.stop_reason != Stop_reason::exhausted) return std::move(*first);
  Mesh_options_3 refinement = options; // which tells whether the creases left can be followed
  refinement.coarsen = false;
  refinement.smoothing_sweeps = 0;
  refinement.min_dihedral_angle = 0;
  std::size_t given_up = 0;
  constexpr int rounds = 4;
  for (int round = 1; round <= rounds; ++round) {
    const Result& last = trial ? *trial : *first;
    auto which = creases_beside_bad_elements(last.mesh, criteria, complex);
    if (round == rounds) std::fill(which.begin(), which.end(), true);
    const std::size_t dropped = drop_creases(which, complex);
    if (dropped == 0) break;
    given_up += dropped;
    trial = run(refinement);
    if (trial->report.stop_reason != Stop_reason::criteria_met && trial->report.stop_reason != Stop_reason::exhausted)
      break; // out of time, or cancelled
    if (!trial->report.ok()) continue;
    trial = run(options);
    trial->report.creases_given_up = given_up;
    return std::move(trial->report.stop_reason == Stop_reason::cancelled ? *first : *trial);
  }
  return std::move(*first);
}

} // namespace weft

#endif // WEFT_MAKE_MESH_3_H
