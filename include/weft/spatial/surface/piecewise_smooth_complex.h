// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a surface to a checked piecewise smooth complex (Tournois 2009, sec. 3.2.1.1): sharp edges are given or found
// by angle; corners, darts, tips and cusps follow; sharp edges are chained to creases, facets collected to patches and
// shells. A surface that isn't closed, manifold and consistently oriented, or that meets itself, is refused with the
// offending elements listed; `mended_complex_3()` takes such surfaces, too. Start here for domains with a polyhedral
// boundary.

#ifndef WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_H
#define WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_H

#include <weft/spatial/surface/check_surface_topology_3.h>
#include <weft/spatial/surface/check_surface_volume_3.h>
#include <weft/spatial/surface/crease_chains_3.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/Feature_options.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/triangulate_polygons_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/Kernel_traits.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Marks given edges as sharp, sides of triangles.
/// \throws Domain_error listing the vertices of what is no edge.
inline void mark_given_edges(const std::vector<Surface_side_3>& sides,
                             const std::vector<std::array<std::size_t, 2>>& given,
                             std::vector<std::array<bool, 3>>& is_sharp)
{
  std::vector<std::array<std::size_t, 2>> missing;
  std::vector<std::size_t> vertices;
  for (const auto& edge : given) {
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    auto side =
        std::lower_bound(sides.begin(), sides.end(), std::make_pair(low, high),
                         [](const Surface_side_3& s, const auto& key) { return std::make_pair(s.low, s.high) < key; });
    if (side == sides.end() || side->low != low || side->high != high) {
      missing.push_back(edge);
      vertices.insert(vertices.end(), edge.begin(), edge.end());
    }
    for (; side != sides.end() && side->low == low && side->high == high; ++side)
      is_sharp[side->triangle][static_cast<std::size_t>(side->side)] = true;
  }
  if (missing.empty()) return;
  sort_unique(vertices);
  const char* what = missing.size() == 1 ? "given sharp edge is no edge" : "given sharp edges are no edges";
  throw Domain_error(counted(missing.size(), what, what) + " of the surface: " + first_few(missing), vertices, {});
}

/// The edges that are sharp.
/// \pre Every edge has two sides.
template <class K>
Sharp_edges_3 sharp_edges(const Triangle_surface_3<K>& surface, const Surface_topology_3& topology,
                          const Feature_options& options)
{
  std::vector<std::array<bool, 3>> is_given(surface.triangles.size(), {false, false, false});
  mark_given_edges(topology.sides, options.sharp_edges, is_given);
  const bool by_angle = options.sharp_angle > 0 && options.sharp_angle < 180;
  std::vector<Xyz_3> normals;
  if (by_angle)
    for (const auto& [a, b, c] : surface.triangles)
      normals.push_back(unit_facet_normal(surface.points[a], surface.points[b], surface.points[c]));
  Sharp_edges_3 edges;
  for_each_edge(topology.sides, [&](auto side, auto) {
    const std::array<std::size_t, 2> edge = {side->low, side->high};
    const bool is_listed = is_given[side->triangle][static_cast<std::size_t>(side->side)];
    if (is_listed) edges.given.push_back(edge);
    if (is_listed || (by_angle && angle_between(normals[side->triangle], normals[(side + 1)->triangle]) >=
                                      options.sharp_angle - angle_tolerance))
      edges.all.push_back(edge);
  });
  return edges;
}

/// Below this length creases that are open and not given aren't creases.
template <class Point>
double least_open_crease(const std::vector<Point>& points, const Feature_options& options)
{
  if (options.least_open_crease == 0 || points.empty()) return 0;
  CGAL::Bbox_3 box;
  for (const Point& p : points) box += p.bbox();
  return options.least_open_crease *
         std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

/// Which points are given as tips or cusps.
/// \throws Domain_error for points that no facet uses.
template <class K>
std::vector<bool> given_features(const Triangle_surface_3<K>& surface, const std::vector<std::size_t>& given)
{
  std::vector<bool> is_used(surface.points.size(), false), is_given(surface.points.size(), false);
  for (const auto& triangle : surface.triangles)
    for (const std::size_t v : triangle) is_used[v] = true;
  std::vector<std::size_t> missing;
  for (const std::size_t v : given)
    if (v < is_used.size() && is_used[v])
      is_given[v] = true;
    else
      missing.push_back(v);
  if (missing.empty()) return is_given;
  sort_unique(missing);
  const char* what = missing.size() == 1 ? "given tip or cusp is no vertex" : "given tips or cusps are no vertices";
  throw Domain_error(counted(missing.size(), what, what) + " of the surface: " + first_few(missing), missing, {});
}

/// Takes points that no triangle uses out of the complex; the others keep their order.
template <class K>
void drop_unused_points(Piecewise_smooth_complex_3<K>& complex)
{
  std::vector<std::size_t> position(complex.points.size(), 0);
  for (const auto& triangle : complex.triangles)
    for (const std::size_t v : triangle) position[v] = 1;
  std::size_t count = 0;
  for (std::size_t v = 0; v < position.size(); ++v) {
    if (position[v] == 0) continue;
    complex.points[count] = complex.points[v];
    position[v] = count++;
  }
  complex.points.resize(count);
  for (auto& triangle : complex.triangles)
    for (std::size_t& v : triangle) v = position[v];
  for (auto& crease : complex.creases)
    for (std::size_t& v : crease.vertices) v = position[v];
  for (auto& feature : complex.features) feature.vertex = position[feature.vertex];
}

/// Checks a surface and derives everything from it.
template <class K>
Piecewise_smooth_complex_3<K> derive_complex(Triangle_surface_3<K> surface, const Feature_options& options)
{
  const Surface_topology_3 topology = check_surface_topology(surface);
  Sharp_edges_3 sharp = sharp_edges(surface, topology, options); // before shells are turned: sides would change places
  const auto is_given = given_features(surface, options.tips_and_cusps);
  Piecewise_smooth_complex_3<K> complex;
  complex.changes = check_surface_volume(surface, topology);
  complex.points = std::move(surface.points);
  complex.triangles = std::move(surface.triangles);
  drop_short_open_creases<K>(complex.points, least_open_crease(complex.points, options), sharp);
  derive_features(sharp, topology.sides, is_given, options.cusp_angle, complex);
  complex.shells = topology.shells;
  complex.number_of_shells = topology.number_of_shells;
  drop_unused_points(complex);
  return complex;
}

/// Notes how many given edges and vertices aren't among those that are left.
inline void note_lost_features(const Feature_options& given, const Feature_options& left, std::vector<std::string>& log)
{
  const auto note_loss = [&](std::size_t n, const char* singular, const char* plural) {
    if (n > 0) log.push_back(counted(n, singular, plural));
  };
  note_loss(given.sharp_edges.size() - left.sharp_edges.size(), "given sharp edge lost", "given sharp edges lost");
  note_loss(given.tips_and_cusps.size() - left.tips_and_cusps.size(), "given tip or cusp lost",
            "given tips or cusps lost");
}

} // namespace internal

/// The piecewise smooth complex that a polygon soup describes. Polygons with more than three corners are cut into
/// triangles. A shell that is inside out as a whole is turned over, and so is a cavity that is oriented like what
/// contains it; `changes` says so. Same input, same numbers.
/// \tparam K a CGAL kernel with exact predicates, usually Exact_predicates_inexact_constructions_kernel.
/// \throws Domain_error if the surface is not closed, manifold, oriented alike, free of degenerate or repeated facets
///         and of self-intersections; with the offending vertices and facets of the soup.
/// \throws Option_error if an option is out of range.
/// Takes O(n log n) for n facets.
template <class K>
Piecewise_smooth_complex_3<K> piecewise_smooth_complex(const Polygon_soup_3<K>& soup,
                                                       const Feature_options& options = {})
{
  options.check();
  return internal::derive_complex(internal::triangulate_polygons(soup), options);
}

/// The same for triangles in arrays.
template <class Point, class K = typename CGAL::Kernel_traits<Point>::Kernel>
Piecewise_smooth_complex_3<K> piecewise_smooth_complex(const std::vector<Point>& points,
                                                       const std::vector<std::array<std::size_t, 3>>& triangles,
                                                       const Feature_options& options = {})
{
  options.check();
  return internal::derive_complex(internal::Triangle_surface_3<K>{points, triangles, {}}, options);
}

/// The polygon soup of a mesh, its vertices and faces numbered in the order in which the mesh lists them.
/// \tparam Graph models CGAL's FaceListGraph.
/// \tparam Vertex_points a readable property map from vertices to points of a CGAL kernel.
template <class Graph, class Vertex_points>
auto polygon_soup(const Graph& graph, const Vertex_points& vertex_points)
{
  using Point = typename boost::property_traits<Vertex_points>::value_type;
  Polygon_soup_3<typename CGAL::Kernel_traits<Point>::Kernel> soup;
  const auto number = get(CGAL::dynamic_vertex_property_t<std::size_t>(), graph);
  for (const auto v : vertices(graph)) {
    put(number, v, soup.points.size());
    soup.points.push_back(get(vertex_points, v));
  }
  for (const auto f : faces(graph)) {
    soup.polygons.emplace_back();
    for (const auto v : CGAL::vertices_around_face(halfedge(f, graph), graph))
      soup.polygons.back().push_back(get(number, v));
  }
  return soup;
}

/// The same with the mesh's own points.
template <class Graph>
auto polygon_soup(const Graph& graph)
{
  return polygon_soup(graph, get(CGAL::vertex_point, graph));
}

/// The piecewise smooth complex that a mesh describes. Indices in options and errors count its vertices and faces in
/// the order in which it lists them. For a mesh that may need mending, or whose points are elsewhere, pass its
/// `polygon_soup()`.
/// \tparam Graph models CGAL's FaceListGraph, e.g. Surface_mesh or Polyhedron_3.
template <class Graph>
auto piecewise_smooth_complex(const Graph& graph, const Feature_options& options = {})
{
  return piecewise_smooth_complex(polygon_soup(graph), options);
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_H
