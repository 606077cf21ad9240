// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curves of CGAL's MeshDomainWithFeatures_3, which are known by arc length only, as polylines.

#ifndef WEFT_SPATIAL_CGAL_DISCRETISE_CURVE_3_H
#define WEFT_SPATIAL_CGAL_DISCRETISE_CURVE_3_H

#include <weft/spatial/domain/Crease_network_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// A curve as a polyline whose chords lie within 1e-5 of its length from it: corners of a polyline that the domain has
/// are found to 1e-6 of its length. Calls the domain some 1000 times a curve.
/// \param source,target the ends of the curve; equal for a loop.
template <class K, class Domain>
Crease_polyline_3<K> discretise_curve_3(const Domain& domain, const typename Domain::Curve_index& curve,
                                        const typename K::Point_3& source, const typename K::Point_3& target)
{
  using Point = typename K::Point_3;
  constexpr double tolerance = 1e-5, shortest = 1e-6;
  constexpr int first_parts = 200;
  const double length = CGAL::to_double(domain.curve_length(curve));
  const auto at = [&](double fraction) { return domain.construct_point_on_curve(source, curve, fraction * length); };
  Crease_polyline_3<K> polyline;
  polyline.closed = domain.is_loop(curve);
  polyline.points.push_back(source);
  // Fractions still to come, the nearest last.
  std::vector<std::pair<double, Point>> ahead = {{1, target}};
  for (int k = first_parts - 1; k > 0; --k) {
    const double fraction = static_cast<double>(k) / first_parts;
    ahead.emplace_back(fraction, at(fraction));
  }
  double from = 0;
  while (!ahead.empty()) {
    const auto [to, next] = ahead.back();
    const double middle = 0.5 * (from + to);
    const Point on_curve = at(middle);
    const double gap =
        std::sqrt(CGAL::to_double(CGAL::squared_distance(on_curve, CGAL::midpoint(polyline.points.back(), next))));
    if (gap > tolerance * length && to - from > shortest) {
      ahead.emplace_back(middle, on_curve);
      continue;
    }
    polyline.points.push_back(next);
    from = to;
    ahead.pop_back();
  }
  if (polyline.closed) polyline.points.pop_back();
  return polyline;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CGAL_DISCRETISE_CURVE_3_H
