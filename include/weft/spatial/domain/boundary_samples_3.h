// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of the boundary of a domain that a mesh of it must have facets near to, and how near.

#ifndef WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H
#define WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace weft::internal {

/// Whether an oracle has samples of its boundary, with normals, and knows how thick it is there.
template <class Oracle, class = void>
struct Has_boundary_samples_3 : std::false_type
{};
template <class Oracle>
struct Has_boundary_samples_3<Oracle, std::void_t<decltype(std::declval<const Oracle&>().thickness(
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

/// Calls `visit(point, patch, tolerance)` for points of the boundary of a domain that have no facet of their patch
/// within their tolerance. Points are the oracle's own samples, no farther apart than `spacing`, where it has them,
/// else seeds of its patches. Where the boundary turns back within reach of the tolerance (a rod, a rib, a slot), most
/// of that distance is the tolerance, so that one side can't stand for the other; but not less than a quarter of the
/// approximation bound.
/// \param distance a Boundary_distance_3 of facets.
/// \param approximation called with a point and its patch, returns the approximation bound there, 0 if there is none.
/// \returns how many points were looked at.
template <class Oracle, class Distance, class Approximation, class Visit>
std::size_t visit_missed_samples(const Oracle& oracle, const Distance& distance, double spacing,
                                 const Approximation& approximation, const Visit& visit)
{
  using Point = typename Oracle::Point;
  constexpr double part_of_thickness = 0.8; // less than one: one side can't stand for the other
  std::size_t samples = 0;
  if constexpr (Has_boundary_samples_3<Oracle>::value) {
    oracle.visit_samples(spacing, [&](const Point& p, int patch, const std::array<double, 3>& normal) {
      ++samples;
      const double bound = approximation(p, patch), most = boundary_tolerance(bound), least = 0.25 * bound;
      if (!std::isfinite(most)) {
        if (!distance.has_facets(patch)) visit(p, patch, most);
        return;
      }
      if (distance.has_facet_within(p, patch, least)) return;
      const double tolerance =
          (std::max)(least, (std::min)(most, part_of_thickness * oracle.thickness(p, normal, 2 * most)));
      if (!distance.has_facet_within(p, patch, tolerance)) visit(p, patch, tolerance);
    });
  } else {
    constexpr std::size_t seeds = 64;
    for (int p = 0; p < oracle.number_of_patches(); ++p) {
      if (!oracle.is_expected(p)) continue;
      for (const auto& seed : oracle.patch_seeds(p, seeds)) {
        ++samples;
        const double most = boundary_tolerance(approximation(seed.point, p));
        const bool is_near =
            std::isfinite(most) ? distance.has_facet_within(seed.point, p, most) : distance.has_facets(p);
        if (!is_near) visit(seed.point, p, most);
      }
    }
  }
  return samples;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_BOUNDARY_SAMPLES_3_H
