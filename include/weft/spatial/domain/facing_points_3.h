// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a point of a surface sees along its normals: where the boundary is met again, inside the domain or across a gap.

#ifndef WEFT_SPATIAL_DOMAIN_FACING_POINTS_3_H
#define WEFT_SPATIAL_DOMAIN_FACING_POINTS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/domain/Patched_surface_3.h>
#include <weft/spatial/domain/surface_samples_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace weft::internal {

/// Unit normal of a triangle that points out of a subdomain; zero if that doesn't lie beside it, or the triangle has no
/// area.
template <class K>
Xyz_3 triangle_normal(const Piecewise_smooth_complex_3<K>& complex, int triangle, int subdomain)
{
  const auto t = static_cast<std::size_t>(triangle);
  const auto [behind, before] = sides_of_triangle(complex, t);
  if (behind == before || (behind != subdomain && before != subdomain)) return {};
  Xyz_3 n = cross_product_of_triangle(complex, t);
  const double length = norm(n);
  if (!(length > 0)) return {};
  for (double& x : n) x /= behind == subdomain ? length : -length;
  return n;
}

/// Unit normal of a triangle between the domain and the outside that points outside; zero for others.
template <class K>
Xyz_3 outward_normal(const Piecewise_smooth_complex_3<K>& complex, int triangle)
{
  const auto [behind, before] = sides_of_triangle(complex, static_cast<std::size_t>(triangle));
  return behind != 0 && before != 0 ? Xyz_3() : triangle_normal(complex, triangle, behind + before);
}

/// Wider gaps aren't narrow: they take few vertices without twins, too.
inline double widest_gap(const CGAL::Bbox_3& b)
{
  return 0.005 * std::max({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
}

/// Distance within which coordinates can't be told apart.
inline double rounding_in(const CGAL::Bbox_3& b)
{
  double largest = 0;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(b.min(k)), std::abs(b.max(k))});
  return 16 * std::numeric_limits<double>::epsilon() * largest;
}

template <class Point>
Point point_along(const Point& p, const Xyz_3& direction, double d)
{
  return Point(p.x() + d * direction[0], p.y() + d * direction[1], p.z() + d * direction[2]);
}

/// Distance from a point of a surface to where the surface is met again along a normal, on either side; at most
/// `reach`, which it is for a zero normal.
template <class K>
double thickness_along(const Patched_surface_3<K>& surface, const typename K::Point_3& p, const Xyz_3& normal,
                       double reach)
{
  if (normal == Xyz_3()) return reach;
  // The point itself is on the boundary, up to rounding.
  const double least = rounding_in(surface.bbox());
  double nearest = reach;
  std::vector<Surface_hit_3<K>> hits;
  for (const double side : {-1., 1.}) {
    hits.clear();
    surface.intersect(point_along(p, normal, side * least), point_along(p, normal, side * nearest), hits);
    for (const auto& hit : hits) nearest = (std::min)(nearest, norm(minus(xyz(hit.point), xyz(p))));
  }
  return nearest;
}

/// The point nearest to a point of a triangle along its outward normal where the boundary is met again, if it faces
/// back there and is as near as `reach`.
template <class K>
std::optional<typename K::Point_3> facing_point(const Piecewise_smooth_complex_3<K>& complex,
                                                const Patched_surface_3<K>& surface, const typename K::Point_3& p,
                                                int triangle, double reach)
{
  const Xyz_3 out = outward_normal(complex, triangle);
  const double least = rounding_in(surface.bbox());
  if (out == Xyz_3() || !(reach > least)) return {};
  std::vector<Surface_hit_3<K>> hits;
  surface.intersect(point_along(p, out, least), point_along(p, out, reach), hits);
  if (hits.empty()) return {};
  const Xyz_3 back = outward_normal(complex, hits.front().triangle);
  constexpr double nearly_opposite = -0.99;
  if (out[0] * back[0] + out[1] * back[1] + out[2] * back[2] > nearly_opposite) return {};
  return hits.front().point;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_FACING_POINTS_3_H
