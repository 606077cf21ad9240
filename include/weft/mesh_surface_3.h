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

#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/Oracle_requirements_3.h>
#include <weft/spatial/run/Surface_mesher_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <memory>
#include <type_traits>
#include <utility>

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
  criteria.check();
  options.check();
  auto [attempt, given_up] = internal::Surface_mesher_3<K>(std::move(complex), criteria, options).run();
  attempt->mesher.compare_with_domain(attempt->report);
  attempt->report.creases_given_up = given_up;
  return {attempt->domain, attempt->mesher.take_mesh(), std::move(attempt->report)};
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
