// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE in 3D with a surface whose sharp edges aren't listed: `mesh_surface_3()` is `make_mesh_3()` for the domain
// inside a surface, and gives up creases found by angle that keep the criteria from holding. Scanned surfaces have
// folds that look sharp, but that no mesh of the asked size and shape can follow.
//
//   #include <weft/IO/read_surface.h>
//   #include <weft/IO/write_mesh_3.h>
//
//   const auto surface = weft::IO::read_surface<K>("armadillo.off");
//   weft::Criteria_3<K> criteria;
//   criteria.size = 5;
//   const auto result = weft::mesh_surface_3(weft::piecewise_smooth_complex(surface), criteria);
//   weft::IO::write_mesh_3("armadillo.vtu", weft::tetrahedral_mesh(result.restricted));

#ifndef WEFT_MESH_SURFACE_3_H
#define WEFT_MESH_SURFACE_3_H

#include <weft/internal/Timer.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/drop_creases_3.h>
#include <weft/spatial/run/Oracle_requirements_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// Result of `mesh_surface_3()`.
template <class K>
struct Mesh_surface_result_3
{
  std::shared_ptr<const Polyhedral_oracle_3<K>> domain;     ///< what the mesh asks; its complex has the creases kept
  Restricted_delaunay_3<Polyhedral_oracle_3<K>> restricted; ///< the mesh, as in Make_mesh_result_3
  Mesh_report_3 report;
};

namespace internal {

template <class Surface>
struct Is_complex_3 : std::false_type
{};
template <class K>
struct Is_complex_3<Piecewise_smooth_complex_3<K>> : std::true_type
{};

template <class Surface, class Criteria>
struct Takes_surface_3 : std::false_type
{};
template <class K>
struct Takes_surface_3<Piecewise_smooth_complex_3<K>, Criteria_3<K>> : std::true_type
{};

/// What becomes of creases at small angles.
enum class Small_angles_3
{
  blamed,   ///< what is bad there tells that creases are at fault; small elements beside knife edges are left, which
            ///< tells sooner
  respected ///< they excuse the shapes of cells, and everything is refined: that ends where twins can be everywhere
};

/// One domain for a surface, and its mesher.
template <class K>
struct Surface_attempt_3
{
  using Oracle = Polyhedral_oracle_3<K>;

  Surface_attempt_3(const Piecewise_smooth_complex_3<K>& complex, const Criteria_3<K>& criteria,
                    const Mesh_options_3& all_options, double time_left, Small_angles_3 small_angles)
      : domain(std::make_shared<const Oracle>(complex, small_angles == Small_angles_3::respected)),
        options(with_time_limit(all_options, time_left)),
        mesher(*domain, criteria, options)
  {
    if (small_angles == Small_angles_3::blamed) mesher.leave_knife_edges();
    mesher.meet_criteria();
    report = mesher.report();
  }

  void optimise()
  {
    mesher.start_again_where_bad();
    mesher.optimise();
    report = mesher.report();
  }

  /// Whether refinement ended by itself, with something bad or without.
  bool has_ended() const
  {
    return report.stop_reason == Stop_reason::criteria_met || report.stop_reason == Stop_reason::exhausted;
  }

  static Mesh_options_3 with_time_limit(Mesh_options_3 options, double time)
  {
    options.time_limit = (std::max)(0.0, time);
    return options;
  }

  std::shared_ptr<const Oracle> domain;
  Mesh_options_3 options;
  Spatial_mesher_3<Oracle> mesher;
  Mesh_report_3 report;
};

} // namespace internal

/// Meshes the domain that a surface bounds, and gives creases up that were found by angle where only they keep the
/// criteria from holding: first those beside bad elements, in the end all. Creases that were given stay. Where giving
/// up doesn't help much, the mesh is the one with all creases; so it is where creases longer than twice the size would
/// go, and all criteria hold with them but for cells that small angles between creases force. The report says how many
/// were given up.
/// \param complex what `piecewise_smooth_complex()` makes of a surface, or of several.
/// \throws Option_error for criteria or options out of range, or if a field of the criteria isn't positive.
template <class K>
Mesh_surface_result_3<K> mesh_surface_3(Piecewise_smooth_complex_3<K> complex, const Criteria_3<K>& criteria,
                                        const Mesh_options_3& options = Mesh_options_3())
{
  using Attempt = internal::Surface_attempt_3<K>;
  criteria.check();
  options.check();
  const internal::Timer timer;
  const auto time_left = [&] { return options.time_limit - timer.seconds(); };
  const auto result = [](Attempt& attempt, std::size_t given_up) {
    attempt.mesher.compare_with_domain(attempt.report);
    attempt.report.creases_given_up = given_up;
    return Mesh_surface_result_3<K>{attempt.domain, attempt.mesher.take_mesh(), std::move(attempt.report)};
  };
  using internal::Small_angles_3;
  auto first = std::make_unique<Attempt>(complex, criteria, options, time_left(),
                                         options.give_up_creases ? Small_angles_3::blamed : Small_angles_3::respected);
  if (!options.give_up_creases || first->report.stop_reason != Stop_reason::exhausted) {
    first->optimise();
    return result(*first, 0);
  }
  auto which = internal::creases_beside_bad_elements(first->mesher.mesh(), criteria, complex);
  // Optimisation may mend a facet or cell, so that creases can stay. A crease edge it doesn't: that is known sooner.
  const bool is_hopeless = first->report.bad_edges.elements > 0;
  if (!is_hopeless) first->optimise();
  if (first->report.stop_reason != Stop_reason::exhausted) return result(*first, 0);

  std::unique_ptr<Attempt> best;
  std::size_t given_up = 0, given_up_for_best = 0;
  constexpr int rounds = 4;
  constexpr std::size_t much_less = 4;
  // Short creases are folds of a scan, and not missed.
  const double size = criteria.size.smallest();
  const double long_crease = size > 0 ? 2 * size : std::numeric_limits<double>::infinity();
  double longest = 0;
  std::unique_ptr<Piecewise_smooth_complex_3<K>> whole;
  if (first->domain->has_mirror_images()) whole = std::make_unique<Piecewise_smooth_complex_3<K>>(complex);
  for (int round = 1; round <= rounds; ++round) {
    const std::vector<char> all(which.size(), true);
    const std::vector<char>& blamed = round == rounds ? all : which;
    const double longest_blamed = internal::longest_found_crease(complex, blamed);
    std::size_t dropped = internal::drop_creases(blamed, complex);
    longest = (std::max)(longest, dropped > 0 ? longest_blamed : internal::longest_found_crease(complex, all));
    if (dropped == 0) dropped = internal::drop_creases(all, complex); // none of those left is at fault on its own
    if (dropped == 0) break;
    given_up += dropped;
    auto trial = std::make_unique<Attempt>(complex, criteria, options, time_left(), Small_angles_3::blamed);
    if (!trial->has_ended()) break; // out of time, or cancelled
    which = internal::creases_beside_bad_elements(trial->mesher.mesh(), criteria, complex);
    const bool is_good = trial->report.ok();
    if (is_good || much_less * trial->report.bad() < (best ? best : first)->report.bad()) {
      best = std::move(trial);
      given_up_for_best = given_up;
    }
    if (is_good) break;
  }
  if (whole && !(best && best->report.ok() && longest < long_crease)) {
    auto trial = std::make_unique<Attempt>(*whole, criteria, options, time_left(), Small_angles_3::respected);
    if (trial->report.ok() ||
        (trial->has_ended() && much_less * trial->report.bad() < (best ? best : first)->report.bad())) {
      best = std::move(trial);
      given_up_for_best = 0;
    }
  }
  if (best) {
    best->optimise();
    return result(*best, given_up_for_best);
  }
  if (is_hopeless) first->optimise();
  return result(*first, 0);
}

/// \cond
// An overload that only says what is wrong.
template <class Surface, class Criteria,
          std::enable_if_t<!internal::Takes_surface_3<Surface, Criteria>::value, int> = 0>
internal::No_mesh_3 mesh_surface_3(const Surface&, const Criteria&, const Mesh_options_3& = Mesh_options_3())
{
  constexpr bool is_complex = internal::Is_complex_3<Surface>::value;
  static_assert(is_complex, "weft: mesh_surface_3() takes what piecewise_smooth_complex(surface) returns");
  static_assert(!is_complex, "weft: the criteria aren't a weft::Criteria_3 with the surface's kernel");
  return {};
}
/// \endcond

} // namespace weft

#endif // WEFT_MESH_SURFACE_3_H
