// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many approximation bounds anything may be away from where it should be. The bound itself is about Steiner points:
// the points where Voronoi edges of facets meet the surface.

#ifndef WEFT_SPATIAL_CRITERIA_APPROXIMATION_MULTIPLES_H
#define WEFT_SPATIAL_CRITERIA_APPROXIMATION_MULTIPLES_H

namespace weft::internal {

/// All of them; what was measured for each is in doc/measured_3d.md.
struct Approximation_multiples
{
  /// Tips of the surface may stick out of a facet that far: less costs vertices, more distance.
  static constexpr double tip = 1.5;

  /// Points of ridges, between tips, and of sharp edges that aren't creases, may be that far from a facet. Less for
  /// ridges costs few vertices, less for sharp edges more.
  static constexpr double ridge = 2.2, sharp_edge = 2.5;

  /// Centers of facets and the middles of their sides may be that far from the surface.
  static constexpr double facet = 1.6;

  /// A vertex that far from every triangle of its neighbours isn't tried by coarsening: the facets that would fill its
  /// place are some of those triangles.
  static constexpr double needed_vertex = 1.3;

  /// Nothing is inserted that near to a vertex, unless a floor is given: so small that a facet which cuts off a sharp
  /// edge gets near enough to the surface by getting small.
  static constexpr double size_floor = 0.1;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_APPROXIMATION_MULTIPLES_H
