// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar mesh as plain arrays with all its tags: what the writers write. It holds the faces in the domain, their
// vertices, and the constrained edges in or around the domain; everything is in the order of the triangulation.

#ifndef WEFT_IO_INTERNAL_INDEXED_MESH_2_H
#define WEFT_IO_INTERNAL_INDEXED_MESH_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

template <class Vertex, class = void>
struct Knows_constraint : std::false_type
{};
template <class Vertex>
struct Knows_constraint<Vertex, std::void_t<decltype(std::declval<const Vertex&>().constraint())>> : std::true_type
{};

struct Indexed_mesh_2
{
  struct Triangle
  {
    std::array<std::size_t, 3> vertices; ///< counterclockwise
    int component;                       ///< from 0; components are separated by constraints
    int marker;                          ///< of the region: 1 if the input names no regions, 0 where none is named
  };
  struct Edge
  {
    std::array<std::size_t, 2> vertices;
    int segment; ///< input segment, -1 if unknown
    int marker;  ///< of the input segment; its number from 1 if the input has no marks; 0 if unknown
  };

  std::vector<std::array<double, 2>> points;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<std::size_t> fixed; ///< input vertices, where the vertex type knows them
  int number_of_components = 0;
  bool has_region_markers = false;
};

/// Numbers of the components that lie in the domain, counted from 0, and -1 for the others.
template <class Cdt>
std::vector<int> domain_components(const Cdt& cdt, const Face_components<Cdt>& components, int& count)
{
  std::vector<int> number(as_index(components.count), -1);
  for (const auto face : cdt.finite_face_handles()) {
    int& n = number[as_index(components.number[face])];
    if (face->is_in_domain() && n == -1) n = count++;
  }
  return number;
}

template <class Cdt>
WEFT_COLD void take_triangles(const Cdt& cdt, const Mesh_tags_2<typename Cdt::Geom_traits>& tags,
                              CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t>& index,
                              Indexed_mesh_2& mesh)
{
  const auto components = face_components(cdt);
  const std::vector<int> number = domain_components(cdt, components, mesh.number_of_components);
  std::vector<int> marker(as_index(components.count), tags.regions.empty() ? 1 : 0);
  for (const auto& region : tags.regions) marker[as_index(components.number[cdt.locate(region.point)])] = region.marker;
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const int c = components.number[face];
    mesh.triangles.push_back({{index[face->vertex(0)], index[face->vertex(1)], index[face->vertex(2)]},
                              number[as_index(c)],
                              marker[as_index(c)]});
  }
}

template <class Cdt>
WEFT_COLD void take_vertices(const Cdt& cdt, CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t>& index,
                             Indexed_mesh_2& mesh)
{
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, bool> used(false);
  for (const auto face : cdt.finite_face_handles())
    for (int i = 0; i < 3 && face->is_in_domain(); ++i) used[face->vertex(i)] = true;
  for (const auto vertex : cdt.finite_vertex_handles()) {
    if (!used[vertex]) continue;
    index[vertex] = mesh.points.size();
    if constexpr (Knows_constraint<typename Cdt::Vertex>::value)
      if (vertex->constraint() == fixed_vertex) mesh.fixed.push_back(mesh.points.size());
    mesh.points.push_back({CGAL::to_double(vertex->point().x()), CGAL::to_double(vertex->point().y())});
  }
}

/// The mesh of the faces in the domain. Linear time, with a logarithm in the number of input segments for the edges.
template <class Cdt>
WEFT_COLD Indexed_mesh_2 indexed_mesh(const Cdt& cdt, const Mesh_tags_2<typename Cdt::Geom_traits>& tags)
{
  Indexed_mesh_2 mesh;
  mesh.has_region_markers = !tags.regions.empty();
  if (cdt.dimension() < 2) return mesh;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t> index;
  take_vertices(cdt, index, mesh);
  take_triangles(cdt, tags, index, mesh);
  for (const auto& [edge, segment] : tags.constraints.constrained_edges(cdt)) {
    const auto [face, i] = edge;
    if (!face->is_in_domain() && !face->neighbor(i)->is_in_domain()) continue;
    mesh.edges.push_back(
        {{index[face->vertex(cdt.ccw(i))], index[face->vertex(cdt.cw(i))]}, segment, tags.constraints.marker(segment)});
  }
  return mesh;
}

/// The position of a tag among all tags of its kind, in increasing order.
inline std::size_t rank_of_tag(const std::vector<int>& distinct, int tag)
{
  return static_cast<std::size_t>(std::lower_bound(distinct.begin(), distinct.end(), tag) - distinct.begin());
}

inline std::vector<int> distinct_tags(std::vector<int> tags)
{
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

/// A mesh in arrays, which knows its tags by itself. Edges of one tag are one segment, triangles of one tag one
/// component.
template <class K>
WEFT_COLD Indexed_mesh_2 indexed_mesh(const Triangle_mesh_2<K>& mesh, const Mesh_tags_2<K>&)
{
  Indexed_mesh_2 result;
  const std::vector<int> regions = distinct_tags(mesh.regions), tags = distinct_tags(mesh.edge_tags);
  result.number_of_components = static_cast<int>(regions.size());
  result.has_region_markers = regions.size() > 1 || (!regions.empty() && regions[0] != 0);
  for (const auto& p : mesh.points) result.points.push_back(xy(p));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    result.triangles.push_back(
        {mesh.triangles[t], static_cast<int>(rank_of_tag(regions, mesh.regions[t])), mesh.regions[t]});
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    result.edges.push_back({mesh.edges[e], static_cast<int>(rank_of_tag(tags, mesh.edge_tags[e])), mesh.edge_tags[e]});
  result.fixed = mesh.corners;
  return result;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_INDEXED_MESH_2_H
