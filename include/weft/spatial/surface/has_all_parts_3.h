// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a domain have the parts that it was made from? Parts that meet are one group, and united; where an odd number of
// groups lies, the domain has to be, however they are turned. Asked beside samples of the facets, by rays.

#ifndef WEFT_SPATIAL_SURFACE_HAS_ALL_PARTS_3_H
#define WEFT_SPATIAL_SURFACE_HAS_ALL_PARTS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/surface/check_surface_volume_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// Closed surfaces that overlap, as triangles.
template <class K>
struct Surface_parts_3
{
  Triangle_surface_3<K> surface;
  std::vector<std::size_t> part;  ///< of each triangle: what hangs together across edges
  std::vector<std::size_t> group; ///< of each triangle: parts that meet
};

/// Whether, on both sides of some 2000 points of the given triangles, places within an odd number of groups are in the
/// domain, but for folds, which are small: beside triangles of up to 0.1 % of the area. True if parts have no inside,
/// since an edge has an odd number of triangles.
/// \param domain triangles that have `sides` as their subdomains behind and before them.
template <class K>
bool has_all_parts(const Surface_parts_3<K>& parts, const Triangle_surface_3<K>& domain,
                   const std::vector<std::pair<int, int>>& sides)
{
  const Triangle_surface_3<K>& given = parts.surface;
  bool is_closed = true;
  for_each_edge(sorted_sides(given.triangles),
                [&](auto first, auto last) { is_closed = is_closed && (last - first) % 2 == 0; });
  if (!is_closed || given.triangles.empty()) return true;
  // A hierarchy for each group, in which each part flips a bit of its own; parts are told apart up to the 30th.
  std::map<std::size_t, std::vector<Surface_triangle_3<K>>> of_group;
  std::map<std::size_t, std::map<std::size_t, int>> bit_of_part;
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    auto& bits = bit_of_part[parts.group[t]];
    const int bit = bits.try_emplace(parts.part[t], static_cast<int>(bits.size() % 30)).first->second;
    of_group[parts.group[t]].push_back(hierarchy_triangle(given, t));
    of_group[parts.group[t]].back().change = 1 << bit;
  }
  std::vector<Triangle_hierarchy_3<K>> groups;
  for (const auto& [group, triangles] : of_group) groups.emplace_back(triangles);
  std::vector<Surface_triangle_3<K>> boundary;
  for (std::size_t t = 0; t < sides.size(); ++t)
    if (sides[t].second == 0) boundary.push_back(hierarchy_triangle(domain, t));
  const Triangle_hierarchy_3<K> inside(boundary);
  const auto is_in_odd_number = [&](const typename K::Point_3& p) {
    return std::count_if(groups.begin(), groups.end(), [&](const auto& g) { return g.subdomain(p) != 0; }) % 2 == 1;
  };
  constexpr double most_of_folds = 1e-3;
  double area = 0, area_of_folds = 0;
  constexpr std::size_t samples = 2000;
  const std::size_t n = given.triangles.size(), step = (n + samples - 1) / samples, each = (samples + n - 1) / n;
  for (std::size_t t = 0; t < n; t += step) {
    const auto& [a, b, c] = given.triangles[t];
    const Xyz_3 p = xyz(given.points[a]), q = xyz(given.points[b]), r = xyz(given.points[c]);
    const Xyz_3 normal = cross_product(minus(q, p), minus(r, p));
    const double twice_area = norm(normal);
    if (!(twice_area > 0)) continue;
    for (std::size_t i = 0; i < each; ++i) {
      // Evenly spread over the triangle: multiples of 1 / g and 1 / g^2, where g^3 = g + 1.
      double u = 0.41 + 0.7548776662466927 * static_cast<double>(i),
             v = 0.33 + 0.5698402909980532 * static_cast<double>(i);
      u -= std::floor(u), v -= std::floor(v);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      bool is_in = true;
      for (const double side : {-1., 1.}) {
        Xyz_3 x;
        for (std::size_t k = 0; k < 3; ++k)
          x[k] = u * p[k] + v * q[k] + (1 - u - v) * r[k] + side * 1e-3 * normal[k] / std::sqrt(twice_area);
        const typename K::Point_3 place(x[0], x[1], x[2]);
        is_in = is_in && (!is_in_odd_number(place) || inside.subdomain(place) != 0);
      }
      area += twice_area;
      if (!is_in) area_of_folds += twice_area;
    }
  }
  return area_of_folds <= most_of_folds * area;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_HAS_ALL_PARTS_3_H
