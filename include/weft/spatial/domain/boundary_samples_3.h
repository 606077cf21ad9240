// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of the boundary of a domain that a mesh of it must have facets near to, and how near.

#ifndef WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H
#define WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H

#include <weft/internal/Answers.h>
#include <weft/spatial/domain/sharp_edges_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace weft::internal {

/// Whether an oracle has samples of its boundary, with normals.
template <class Oracle, class = void>
struct Has_boundary_samples_3 : std::false_type
{};
template <class Oracle>
struct Has_boundary_samples_3<Oracle, std::void_t<decltype(std::declval<const Oracle&>().visit_samples(1., Ignore()))>>
    : std::true_type
{};

/// Whether an oracle knows how far it is along a normal to where the boundary is met again.
template <class Oracle, class = void>
struct Has_thickness_3 : std::false_type
{};
template <class Oracle>
struct Has_thickness_3<Oracle, std::void_t<decltype(std::declval<const Oracle&>().thickness(
                                   std::declval<const typename Oracle::Point&>(), std::array<double, 3>(), 1.))>>
    : std::true_type
{};

/// Distance that facets and crease edges may have from points of the boundary: two and a half times the approximation
/// bound, as far as refinement lets points of sharp edges that aren't creases be from facets. Infinite where nothing is
/// asked for.
inline double boundary_tolerance(double approximation)
{
  return approximation > 0 ? 2.5 * approximation : std::numeric_limits<double>::infinity();
}

/// Calls `visit(point, patch, normal)` for points of the boundary of a domain that have no facet of their patch within
/// their tolerance that looks the same way, nor any within a tenth of it: surfaces may have folds as small as that.
/// At a sharp edge that the mesh may cut off, a facet that looks elsewhere is enough.
/// Points are the oracle's own samples, no farther apart than `spacing`, where it has them, else seeds of its patches.
/// Those may lie on sharp edges that nobody gave as creases, which meshes round off: four times the spacing is near
/// enough for them.
/// \param distance a Boundary_distance_3 of facets.
/// \param approximation called with a point and its patch, returns the approximation bound there, 0 if there is none.
/// \returns how many points were looked at.
template <class Oracle, class Distance, class Approximation, class Visit>
std::size_t visit_missed_samples(const Oracle& oracle, const Distance& distance, double spacing,
                                 const Approximation& approximation, const Visit& visit)
{
  using Point = typename Oracle::Point;
  constexpr std::array<double, 3> none{};
  std::size_t samples = 0;
  constexpr bool has_own = Has_boundary_samples_3<Oracle>::value;
  const auto look = [&](const Point& p, int patch, const std::array<double, 3>& normal) {
    ++samples;
    double tolerance = boundary_tolerance(approximation(p, patch));
    if (!has_own) tolerance = (std::max)(tolerance, 4 * spacing);
    const bool is_met = !std::isfinite(tolerance) ? distance.has_facets(patch)
                                                  : distance.has_facet_within(p, patch, 0.1 * tolerance) ||
                                                        distance.has_facet_within(p, patch, tolerance, normal) ||
                                                        (distance.has_facet_within(p, patch, tolerance) &&
                                                         is_at_sharp_edge(oracle, p, tolerance * tolerance, patch));
    if (!is_met) visit(p, patch, normal);
  };
  if constexpr (has_own) {
    static_cast<void>(none);
    oracle.visit_samples(spacing, look);
  } else {
    constexpr std::size_t seeds = 64;
    for (int p = 0; p < oracle.number_of_patches(); ++p)
      if (oracle.is_expected(p))
        for (const auto& seed : oracle.patch_seeds(p, seeds)) look(seed.point, p, none);
  }
  return samples;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H
