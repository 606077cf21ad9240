// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of surfaces as they were given, before they were mended, is found on a mesh: distances of points that are
// uniform by area. What lies within the mesh, as where parts overlap, isn't missed; fins and sheets that were left out
// are counted apart.

#ifndef WEFT_SPATIAL_SURFACE_COMPARE_WITH_GIVEN_3_H
#define WEFT_SPATIAL_SURFACE_COMPARE_WITH_GIVEN_3_H

#include <weft/Domain_comparison_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {
namespace internal {

/// Collects triangles for a hierarchy.
template <class K>
class Triangle_collector_3
{
public:
  void add(const std::vector<typename K::Point_3>& points, const std::array<std::size_t, 3>& corners)
  {
    add(points[corners[0]], points[corners[1]], points[corners[2]]);
    for (std::size_t i = 0; i < 3; ++i)
      triangles_.back().vertices[i] = static_cast<std::uint32_t>(corners[i]); // so that rays count common edges once
  }
  void add(const typename K::Point_3& a, const typename K::Point_3& b, const typename K::Point_3& c)
  {
    Surface_triangle_3<K> triangle;
    triangle.points = {a, b, c};
    triangle.index = static_cast<std::uint32_t>(triangles_.size());
    triangle.vertices = {3 * triangle.index, 3 * triangle.index + 1, 3 * triangle.index + 2};
    triangle.patch = 0;
    triangles_.push_back(triangle);
  }
  Triangle_hierarchy_3<K> hierarchy() const { return Triangle_hierarchy_3<K>(triangles_); }

private:
  std::vector<Surface_triangle_3<K>> triangles_;
};

} // namespace internal

/// Compares a mesh with the surfaces that its domain was made from.
/// \param given what `mended_complex_3()` got.
/// \param complex what it made of that.
/// \param tolerance distance from the mesh, in the input's units, up to which a place isn't missed.
/// \param samples about so many points, and at least one on each polygon.
/// O((samples + facets) log facets).
template <class K>
Given_comparison_3 compare_with_given_3(const std::vector<Polygon_soup_3<K>>& given,
                                        const Piecewise_smooth_complex_3<K>& complex, const Tetrahedral_mesh_3<K>& mesh,
                                        double tolerance, std::size_t samples = 20000)
{
  using Point = typename K::Point_3;
  using internal::Xyz_3;
  internal::Triangle_collector_3<K> facets, outer, left_out;
  for (const auto& facet : mesh.facets) facets.add(mesh.points, facet);
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    if (!complex.sides.empty()) {
      const auto [behind, before] = complex.sides[static_cast<std::size_t>(complex.patches[t])];
      if (behind != 0 && before != 0) continue;
    }
    outer.add(complex.points, complex.triangles[t]);
  }
  for (const auto& [a, b, c] : complex.left_out) left_out.add(a, b, c);
  const auto boundary = facets.hierarchy(), domain = outer.hierarchy(), fins = left_out.hierarchy();
  const double squared_tolerance = tolerance * tolerance;

  struct Corners
  {
    Xyz_3 a, ab, ac;
    double area;
  };
  std::vector<Corners> fans;
  Given_comparison_3 result;
  result.is_known = true;
  result.tolerance = tolerance;
  for (const auto& soup : given)
    for (const auto& polygon : soup.polygons)
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Xyz_3 a = internal::xyz(soup.points[polygon[0]]), b = internal::xyz(soup.points[polygon[i]]),
                    c = internal::xyz(soup.points[polygon[i + 1]]);
        const Xyz_3 ab = internal::minus(b, a), ac = internal::minus(c, a);
        fans.push_back({a, ab, ac, internal::norm(internal::cross_product(ab, ac)) / 2});
        result.area += fans.back().area;
      }
  for (const Corners& t : fans) {
    if (!(t.area > 0)) continue;
    const auto n =
        static_cast<std::size_t>(std::ceil((std::min)(1., t.area / result.area) * static_cast<double>(samples)));
    for (std::size_t i = 0; i < n; ++i) {
      // Evenly spread: multiples of 1 / g and 1 / g^2, where g^3 = g + 1.
      double u = 0.41 + 0.7548776662466927 * static_cast<double>(i),
             v = 0.33 + 0.5698402909980532 * static_cast<double>(i);
      u -= std::floor(u), v -= std::floor(v);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      std::array<double, 3> x{};
      for (std::size_t k = 0; k < 3; ++k) x[k] = t.a[k] + u * t.ab[k] + v * t.ac[k];
      const Point p(x[0], x[1], x[2]);
      if (boundary.is_within(p, squared_tolerance)) continue;
      const double area = t.area / static_cast<double>(n);
      if (fins.is_within(p, 1e-6 * squared_tolerance)) {
        result.area_left_out += area;
      } else if (domain.subdomain(p) == 0 || domain.is_within(p, 1e-6 * squared_tolerance)) {
        // Within the domain and not at its boundary there is nothing to find.
        result.missed_area += area;
        result.largest_distance =
            (std::max)(result.largest_distance,
                       internal::norm(internal::minus(internal::xyz(boundary.nearest(p).point), internal::xyz(p))));
      }
    }
  }
  return result;
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_COMPARE_WITH_GIVEN_3_H
