// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE in 3D with a surface whose sharp edges nobody has listed. `mesh_surface_3()` is `make_mesh_3()` for the
// domain that a surface bounds, but doesn't insist on creases that were found by angle: scanned surfaces have folds
// that look sharp here and there, and that no mesh of the asked size and shape can follow.
//
//   const auto surface = weft::IO::read_surface<K>("armadillo.off");
//   weft::Criteria_3<K> criteria;
//   criteria.size = 5;
//   const auto result = weft::mesh_surface_3(weft::piecewise_smooth_complex(surface), criteria);
//   weft::IO::write_mesh_3("armadillo.vtu", weft::tetrahedral_mesh(result.mesh));

#ifndef WEFT_MESH_SURFACE_3_H
#define WEFT_MESH_SURFACE_3_H

#include <weft/internal/timer.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/give_up_creases_3.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace weft {

/// Result of `mesh_surface_3()`.
template <class K>
struct Mesh_surface_result_3
{
  std::shared_ptr<const Polyhedral_oracle_3<K>> domain; ///< what the mesh asks; its complex has the creases kept
  Restricted_delaunay_3<Polyhedral_oracle_3<K>> mesh;
  Mesh_report_3 report;
};

/// Meshes the domain that a surface bounds, and gives creases up that were found by angle where only they keep the
/// criteria from holding: first those beside bad elements, in the end all. Creases that were given stay. Where giving
/// up doesn't help, the mesh is the one with all creases. The report says how many were given up.
/// \param complex what `piecewise_smooth_complex()` makes of a surface, or of several.
/// \throws Option_error for criteria or options out of range, or if a field of the criteria isn't positive.
template <class K>
Mesh_surface_result_3<K> mesh_surface_3(Piecewise_smooth_complex_3<K> complex, const Criteria_3<K>& criteria,
                                        const Mesh_options_3& options = Mesh_options_3())
{
  using Result = Mesh_surface_result_3<K>;
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
    if (!trial->report.ok()) break;
    trial->report.creases_given_up = given_up;
    return std::move(*trial);
  }
  return std::move(*first);
}

} // namespace weft

#endif // WEFT_MESH_SURFACE_3_H
