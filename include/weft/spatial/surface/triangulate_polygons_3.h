// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts the polygons of a soup into triangles that remember their polygon.

#ifndef WEFT_SPATIAL_SURFACE_TRIANGULATE_POLYGONS_3_H
#define WEFT_SPATIAL_SURFACE_TRIANGULATE_POLYGONS_3_H

#include <weft/spatial/surface/check_surface_topology_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/surface_complaints_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft::internal {

/// Sum of the normals of a fan of the polygon, weighted by area.
template <class Point>
auto polygon_normal(const std::vector<Point>& points, const std::vector<std::size_t>& polygon)
{
  const Point& apex = points[polygon[0]];
  auto normal = CGAL::cross_product(points[polygon[1]] - apex, points[polygon[2]] - apex);
  for (std::size_t i = 2; i + 1 < polygon.size(); ++i)
    normal = normal + CGAL::cross_product(points[polygon[i]] - apex, points[polygon[i + 1]] - apex);
  return normal;
}

/// The faces of a triangulation that lie inside its constraints: an odd number of them away from infinity.
template <class Triangulation>
std::vector<std::array<std::size_t, 3>> faces_inside(Triangulation& triangulation)
{
  constexpr int unknown = -1;
  for (const auto face : triangulation.all_face_handles()) face->info() = unknown;
  std::vector<typename Triangulation::Face_handle> pending = {triangulation.infinite_face()};
  pending.front()->info() = 0;
  while (!pending.empty()) {
    const auto face = pending.back();
    pending.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() != unknown) continue;
      next->info() = triangulation.is_constrained({face, i}) ? 1 - face->info() : face->info();
      pending.push_back(next);
    }
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() == 1)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

/// Positions in a polygon with at least four different corners, in threes: its constrained Delaunay triangulation,
/// seen along its normal. A polygon that crosses or touches itself there becomes a fan, which the checks of the surface
/// judge.
template <class K>
std::vector<std::array<std::size_t, 3>> cut_polygon(const std::vector<typename K::Point_3>& points,
                                                    const std::vector<std::size_t>& polygon)
{
  using Traits = CGAL::Projection_traits_3<K>;
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Traits>;
  using Face_base =
      CGAL::Constrained_triangulation_face_base_2<Traits, CGAL::Triangulation_face_base_with_info_2<int, Traits>>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>;
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<Traits, Structure, CGAL::No_constraint_intersection_tag>;

  const std::size_t n = polygon.size();
  const auto normal = polygon_normal(points, polygon);
  if (normal != CGAL::NULL_VECTOR) {
    Triangulation triangulation{Traits(normal)};
    std::vector<typename Triangulation::Vertex_handle> corners;
    for (std::size_t i = 0; i < n; ++i) {
      corners.push_back(triangulation.insert(points[polygon[i]]));
      corners.back()->info() = i;
    }
    bool is_simple = triangulation.number_of_vertices() == n && triangulation.dimension() == 2;
    try {
      for (std::size_t i = 0; is_simple && i < n; ++i)
        triangulation.insert_constraint(corners[i], corners[(i + 1) % n]);
    } catch (const typename Triangulation::Intersection_of_constraints_exception&) {
      is_simple = false;
    }
    const auto triangles = is_simple ? faces_inside(triangulation) : std::vector<std::array<std::size_t, 3>>();
    if (triangles.size() == n - 2) return triangles;
  }
  std::vector<std::array<std::size_t, 3>> fan;
  for (std::size_t i = 1; i + 1 < n; ++i) fan.push_back({0, i, i + 1});
  return fan;
}

/// Refuses polygons that refer to points which don't exist, have less than three corners, or repeat one.
template <class K>
void check_polygons(const Polygon_soup_3<K>& soup)
{
  std::vector<std::size_t> stray, degenerate, vertices, corners;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    corners = soup.polygons[f];
    sort_unique(corners);
    if (!corners.empty() && corners.back() >= soup.points.size()) {
      stray.push_back(f);
    } else if (corners.size() < 3 || corners.size() < soup.polygons[f].size()) {
      degenerate.push_back(f);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
  }
  const auto refuse_if_any = [&](const std::vector<std::size_t>& bad, const char* singular, const char* plural) {
    if (bad.empty()) return;
    sort_unique(vertices);
    throw Domain_error(counted(bad.size(), singular, plural) + ": " + first_few(bad), vertices, bad);
  };
  if (!stray.empty()) vertices.clear();
  refuse_if_any(stray, "facet refers to points that don't exist", "facets refer to points that don't exist");
  refuse_if_any(degenerate, "facet is degenerate", "facets are degenerate");
}

/// The soup as triangles.
/// \throws Domain_error as `check_polygons()`.
template <class K>
Triangle_surface_3<K> triangulate_polygons(const Polygon_soup_3<K>& soup)
{
  check_polygons(soup);
  Triangle_surface_3<K> surface;
  surface.points = soup.points;
  check_coordinates(soup.points, soup.polygons); // before anybody computes with them
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto& polygon = soup.polygons[f];
    if (polygon.size() == 3)
      surface.triangles.push_back({polygon[0], polygon[1], polygon[2]});
    else
      for (const auto& [i, j, k] : cut_polygon<K>(soup.points, polygon))
        surface.triangles.push_back({polygon[i], polygon[j], polygon[k]});
    surface.origins.resize(surface.triangles.size(), f);
  }
  return surface;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_TRIANGULATE_POLYGONS_3_H
