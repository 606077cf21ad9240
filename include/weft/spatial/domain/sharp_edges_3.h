// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sharp edges that nobody marked: meshes may cut them off, so near them facets look elsewhere than the surface.

#ifndef WEFT_SPATIAL_DOMAIN_SHARP_EDGES_3_H
#define WEFT_SPATIAL_DOMAIN_SHARP_EDGES_3_H

#include <weft/internal/boxes/nearest_point_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>

namespace weft::internal {

/// Whether a ball around a point of a patch holds an edge of the patch that is sharp but no crease, or mixes up the
/// sides of an acute edge.
template <class Oracle>
bool is_at_sharp_edge(const Oracle& oracle, const typename Oracle::Kernel::Point_3& center, double squared_radius,
                      int patch)
{
  bool found = oracle.is_at_acute_edge(center, std::sqrt(squared_radius));
  oracle.visit_ridges(center, squared_radius, patch, [&](const auto& source, const auto& target, bool attracts) {
    if (found || attracts) return;
    const auto nearest = nearest_point_on_segment(center, source, target); // some ridges are outside of the ball
    found = CGAL::to_double(CGAL::squared_distance(center, nearest)) <= squared_radius;
  });
  return found;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_SHARP_EDGES_3_H
