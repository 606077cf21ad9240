// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a closed, oriented, manifold surface bound a volume? Its shells must not be flat, and its facets may meet in
// shared vertices and edges only. Shells are then turned so that the volume lies behind the facets, by the parity of
// their nesting. Self-intersections and nesting are left to CGAL's Polygon_mesh_processing.

#ifndef WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H
#define WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H

#include <weft/spatial/surface/check_surface_topology_3.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Shells whose vertices are all coplanar: they'd bound nothing.
template <class K>
void check_flat_shells(const Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  const auto number_of_shells = static_cast<std::size_t>(topology.number_of_shells);
  std::vector<std::size_t> base(number_of_shells, surface.triangles.size()), bad;
  std::vector<bool> has_volume(number_of_shells, false);
  const auto coplanar = K().coplanar_3_object();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto shell = static_cast<std::size_t>(topology.shells[t]);
    if (base[shell] == surface.triangles.size()) base[shell] = t;
    const auto [a, b, c] = surface.triangles[base[shell]];
    for (const std::size_t v : surface.triangles[t])
      if (!has_volume[shell] && !coplanar(surface.points[a], surface.points[b], surface.points[c], surface.points[v]))
        has_volume[shell] = true;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!has_volume[static_cast<std::size_t>(topology.shells[t])]) bad.push_back(t);
  if (!bad.empty()) refuse_facets(surface, "bounds no volume", "form shells of zero volume", bad);
}

/// The surface as CGAL's mesh: facets in the same order, vertices only those that facets use, because CGAL's functions
/// don't expect others. `position[v]` receives the vertex of point v. \pre Closed, manifold, oriented.
template <class K>
CGAL::Surface_mesh<typename K::Point_3>
surface_mesh(const Triangle_surface_3<K>& surface,
             std::vector<typename CGAL::Surface_mesh<typename K::Point_3>::Vertex_index>& position)
{
  using Mesh = CGAL::Surface_mesh<typename K::Point_3>;
  using Index = typename Mesh::size_type;
  Mesh mesh;
  const std::size_t vertices = surface.points.size(), facets = surface.triangles.size();
  mesh.reserve(static_cast<Index>(vertices), static_cast<Index>(3 * facets / 2), static_cast<Index>(facets));
  position.assign(vertices, Mesh::null_vertex());
  for (const auto& triangle : surface.triangles) {
    for (const std::size_t v : triangle)
      if (position[v] == Mesh::null_vertex()) position[v] = mesh.add_vertex(surface.points[v]);
    mesh.add_face(position[triangle[0]], position[triangle[1]], position[triangle[2]]);
  }
  return mesh;
}

template <class K, class Mesh>
void check_self_intersections(const Triangle_surface_3<K>& surface, const Mesh& mesh)
{
  using Face = typename Mesh::Face_index;
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  if (found.empty()) return;
  std::vector<std::array<std::size_t, 2>> pairs;
  std::vector<std::size_t> triangles;
  for (const auto& [f, g] : found) {
    const auto a = static_cast<std::size_t>(f), b = static_cast<std::size_t>(g);
    triangles.insert(triangles.end(), {a, b});
    pairs.push_back({std::min(surface.origin(a), surface.origin(b)), std::max(surface.origin(a), surface.origin(b))});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const std::string what = counted(pairs.size(), "pair of facets intersects", "pairs of facets intersect or touch");
  refuse(surface, what + ": " + first_few(pairs), corners_of(surface, triangles), triangles);
}

/// Turns whole shells over so that the volume lies behind all facets: outermost shells bound it from outside, shells in
/// them are cavities, and so on. Returns the shells that were turned. \pre No self-intersections.
template <class K, class Mesh>
std::vector<std::size_t> orient_shells(Triangle_surface_3<K>& surface, const Surface_topology_3& topology, Mesh& mesh,
                                       const std::vector<typename Mesh::Vertex_index>& position)
{
  CGAL::Polygon_mesh_processing::orient_to_bound_a_volume(mesh);
  std::vector<std::size_t> turned;
  for (const auto face : faces(mesh)) {
    auto& triangle = surface.triangles[static_cast<std::size_t>(face)];
    auto h = halfedge(face, mesh);
    while (source(h, mesh) != position[triangle[0]]) h = next(h, mesh);
    if (target(h, mesh) == position[triangle[1]]) continue;
    std::swap(triangle[1], triangle[2]);
    turned.push_back(static_cast<std::size_t>(topology.shells[static_cast<std::size_t>(face)]));
  }
  sort_unique(turned);
  return turned;
}

/// All the checks above; turns shells where needed and returns one line that says so, or none.
/// \throws Domain_error.
template <class K>
std::vector<std::string> check_surface_volume(Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  check_flat_shells(surface, topology);
  std::vector<typename CGAL::Surface_mesh<typename K::Point_3>::Vertex_index> position;
  auto mesh = surface_mesh(surface, position);
  check_self_intersections(surface, mesh);
  const std::vector<std::size_t> turned = orient_shells(surface, topology, mesh, position);
  if (turned.empty()) return {};
  return {counted(turned.size(), "shell was", "shells were") + " inside out and turned over: " + first_few(turned)};
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H
