// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a domain have what lies behind an odd number of the facets that it was made from? Such places are within at
// least one of the parts, however these are turned. Asked beside samples of the facets, by rays.

#ifndef WEFT_SPATIAL_SURFACE_HAS_ODD_PARTS_3_H
#define WEFT_SPATIAL_SURFACE_HAS_ODD_PARTS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/surface/check_surface_volume_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Whether, on both sides of up to 2000 of the given triangles, places of odd parity are in the domain, but for folds,
/// which are small: beside triangles of up to 0.1 % of the area. True if parities don't exist, since an edge has an odd
/// number of triangles. \param domain triangles that have `sides` as their subdomains behind and before them.
template <class K>
bool has_odd_parts(const Triangle_surface_3<K>& given, const Triangle_surface_3<K>& domain,
                   const std::vector<std::pair<int, int>>& sides)
{
  bool is_closed = true;
  for_each_edge(sorted_sides(given.triangles),
                [&](auto first, auto last) { is_closed = is_closed && (last - first) % 2 == 0; });
  if (!is_closed) return true;
  std::vector<Surface_triangle_3<K>> all, boundary;
  for (std::size_t t = 0; t < given.triangles.size(); ++t) all.push_back(hierarchy_triangle(given, t));
  for (std::size_t t = 0; t < sides.size(); ++t)
    if (sides[t].second == 0) boundary.push_back(hierarchy_triangle(domain, t));
  const Triangle_hierarchy_3<K> parity(all), inside(boundary);
  constexpr double most_of_folds = 1e-3;
  double area = 0, area_of_folds = 0;
  const std::size_t step = (given.triangles.size() + 1999) / 2000;
  for (std::size_t t = 0; t < given.triangles.size(); t += step) {
    const auto& [a, b, c] = given.triangles[t];
    const Xyz_3 p = xyz(given.points[a]), q = xyz(given.points[b]), r = xyz(given.points[c]);
    const Xyz_3 normal = cross_product(minus(q, p), minus(r, p));
    const double twice_area = norm(normal);
    if (!(twice_area > 0)) continue;
    area += twice_area;
    bool is_in = true;
    for (const double side : {-1., 1.}) {
      Xyz_3 x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = 0.41 * p[k] + 0.33 * q[k] + 0.26 * r[k] + side * 1e-3 * normal[k] / std::sqrt(twice_area);
      const typename K::Point_3 place(x[0], x[1], x[2]);
      is_in = is_in && (parity.subdomain(place) == 0 || inside.subdomain(place) != 0);
    }
    if (!is_in) area_of_folds += twice_area;
  }
  return area_of_folds <= most_of_folds * area;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_HAS_ODD_PARTS_3_H
