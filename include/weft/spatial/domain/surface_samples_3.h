// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of the triangles of a piecewise smooth complex: seeds that are far from each other, samples no farther apart
// than asked, and points that stand for equal areas.

#ifndef WEFT_SPATIAL_DOMAIN_SURFACE_SAMPLES_3_H
#define WEFT_SPATIAL_DOMAIN_SURFACE_SAMPLES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/farthest_points_3.h>
#include <weft/internal/boxes/grid_points_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace weft::internal {

/// The subdomains behind and before a triangle: 1 and 0 where there is but one.
template <class K>
std::pair<int, int> sides_of_triangle(const Piecewise_smooth_complex_3<K>& complex, std::size_t t)
{
  return complex.sides.empty() ? std::make_pair(1, 0) : complex.sides[static_cast<std::size_t>(complex.patches[t])];
}

template <class K>
std::array<Xyz_3, 3> corners_of_triangle(const Piecewise_smooth_complex_3<K>& complex, std::size_t t)
{
  const auto& v = complex.triangles[t];
  return {{xyz(complex.points[v[0]]), xyz(complex.points[v[1]]), xyz(complex.points[v[2]])}};
}

/// Normal of a triangle, twice as long as its area.
template <class K>
Xyz_3 cross_product_of_triangle(const Piecewise_smooth_complex_3<K>& complex, std::size_t t)
{
  const auto corners = corners_of_triangle(complex, t);
  return cross_product(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
}

/// At most n vertices and inner points of the triangles that belong, off creases and feature vertices and as far from
/// each other as can be: the same ones each time. O(n triangles).
template <class K, class Belongs>
std::vector<Surface_hit_3<K>> spread_seeds(const Piecewise_smooth_complex_3<K>& complex, std::size_t n,
                                           const Belongs& belongs)
{
  using Point = typename K::Point_3;
  std::vector<bool> excluded(complex.points.size(), false);
  for (const auto& crease : complex.creases)
    for (const std::size_t v : crease.vertices) excluded[v] = true;
  for (const auto& feature : complex.features) excluded[feature.vertex] = true;
  std::vector<Candidate<Point>> candidates, chosen;
  constexpr int finest = 64; // parts of a side: 4096 points in each triangle
  for (int parts = 1; parts <= finest && chosen.size() < n; parts *= 2) {
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
      if (!belongs(t)) continue;
      const auto& v = complex.triangles[t];
      for (const std::size_t vertex : v) {
        if (excluded[vertex]) continue;
        excluded[vertex] = true; // taken
        candidates.push_back({complex.points[vertex], t});
      }
      for_each_centroid(complex.points[v[0]], complex.points[v[1]], complex.points[v[2]], parts - 1,
                        [&](const Point& x) {
                          candidates.push_back({x, t});
                        });
    }
    if (candidates.size() >= n || 2 * parts > finest) chosen = farthest_points(candidates, n);
  }
  std::vector<Surface_hit_3<K>> result;
  for (const auto& candidate : chosen) result.push_back({candidate.first, complex.patches[candidate.second]});
  return result;
}

/// Calls `visit(point, patch, unit normal)` as Polyhedral_oracle_3::visit_samples() says.
template <class K, class Visit>
void visit_boundary_grid(const Piecewise_smooth_complex_3<K>& complex, double spacing, const Visit& visit)
{
  using Point = typename K::Point_3;
  std::vector<char> is_visited(complex.points.size(), false);
  std::set<std::array<std::int64_t, 5>> seen;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    const int patch = complex.patches[t];
    const std::array<Xyz_3, 3> corners = corners_of_triangle(complex, t);
    Xyz_3 normal = cross_product_of_triangle(complex, t);
    const double length = norm(normal);
    if (!(length > 0)) continue;
    const auto [behind, before] = sides_of_triangle(complex, t);
    const double outwards = behind != 0 && (before == 0 || behind < before) ? 1 : -1;
    for (double& n : normal) n *= outwards / length;
    bool is_small = true;
    for (std::size_t i = 0; i < 3; ++i)
      is_small = is_small && norm(minus(corners[(i + 1) % 3], corners[i])) < spacing / 2;
    if (is_small) {
      Xyz_3 p{};
      std::array<std::int64_t, 5> cube{{0, 0, 0, patch, 0}};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
        cube[k] = static_cast<std::int64_t>(std::floor(2 * p[k] / spacing));
        cube[4] = 2 * cube[4] + (normal[k] < 0);
      }
      if (seen.insert(cube).second) visit(Point(p[0], p[1], p[2]), patch, normal);
      continue;
    }
    for (const std::size_t vertex : complex.triangles[t]) {
      if (is_visited[vertex]) continue;
      is_visited[vertex] = true;
      visit(complex.points[vertex], patch, Xyz_3()); // edges and tips have no normal
    }
    for_each_grid_point(corners, spacing, [&](const Xyz_3& p) { visit(Point(p[0], p[1], p[2]), patch, normal); });
  }
}

/// Calls `visit(point, unit normal, area)` for n points of the triangles, each of which stands for the same area.
template <class K, class Visit>
void visit_equal_areas(const Piecewise_smooth_complex_3<K>& complex, std::size_t n, const Visit& visit)
{
  using Point = typename K::Point_3;
  double total = 0, passed = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) total += norm(cross_product_of_triangle(complex, t)) / 2;
  std::size_t k = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    Xyz_3 normal = cross_product_of_triangle(complex, t);
    const double length = norm(normal);
    if (!(length > 0)) continue;
    for (double& x : normal) x /= length;
    const double n_as_double = static_cast<double>(n);
    const auto [a, b, c] = corners_of_triangle(complex, t);
    const Xyz_3 ab = minus(b, a), ac = minus(c, a);
    for (passed += length / 2; k < n && (static_cast<double>(k) + 0.5) / n_as_double * total < passed; ++k) {
      double u = radical_inverse(k + 1, 2), v = radical_inverse(k + 1, 3);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      visit(Point(a[0] + u * ab[0] + v * ac[0], a[1] + u * ab[1] + v * ac[1], a[2] + u * ab[2] + v * ac[2]), normal,
            total / n_as_double);
    }
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_SURFACE_SAMPLES_3_H
