// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh in Gmsh's format 4.1, ASCII (Gmsh reference manual, "MSH file format"). Every region of the
// domain is an elementary surface, every input segment an elementary curve, every input vertex an elementary point;
// marks of regions and segments are the physical groups.

#ifndef WEFT_IO_WRITE_GMSH_2_H
#define WEFT_IO_WRITE_GMSH_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Gmsh_writer.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/write_gmsh_3.h> // the overload for spatial meshes

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

inline std::array<double, 3> gmsh_point(const Indexed_mesh_2& mesh, std::size_t v)
{
  return {mesh.points[v][0], mesh.points[v][1], 0};
}

/// Distributes the mesh over entities; what bounds them isn't stated. A node belongs to the entity of lowest dimension
/// that has it.
WEFT_COLD inline Gmsh_entities gmsh_entities(const Indexed_mesh_2& mesh)
{
  Gmsh_entities entities;
  std::vector<std::pair<int, int>> owner(mesh.points.size(), {3, 0}); // dimension and tag
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& triangle = mesh.triangles[i];
    Gmsh_entity& surface = entities[2][triangle.component + 1];
    surface.physical = mesh.has_region_markers ? triangle.marker : 1;
    surface.elements.push_back(i);
    for (const std::size_t v : triangle.vertices)
      owner[v] = {2, triangle.component + 1}, surface.include(gmsh_point(mesh, v));
  }
  // Edges of unknown origin share the curve after the last input segment.
  int last = 0;
  for (const auto& edge : mesh.edges) last = std::max(last, edge.segment + 1);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const auto& edge = mesh.edges[i];
    const int tag = edge.segment < 0 ? last + 1 : edge.segment + 1;
    Gmsh_entity& curve = entities[1][tag];
    curve.physical = edge.marker;
    curve.elements.push_back(i);
    for (const std::size_t v : edge.vertices) owner[v] = {1, tag}, curve.include(gmsh_point(mesh, v));
  }
  for (std::size_t i = 0; i < mesh.fixed.size(); ++i) owner[mesh.fixed[i]] = {0, static_cast<int>(i) + 1};
  for (std::size_t v = 0; v < owner.size(); ++v) {
    Gmsh_entity& entity = entities[as_index(owner[v].first)][owner[v].second];
    entity.nodes.push_back(v);
    if (owner[v].first == 0) entity.include(gmsh_point(mesh, v));
  }
  return entities;
}

} // namespace internal

namespace IO {

/// Writes the faces in the domain and the constrained edges as a .msh file. Curve k + 1 holds the edges of input
/// segment k, with the segment's mark as physical group (k + 1 if the input has no marks); surface c + 1 is the c-th
/// region of the domain, with the region's mark as physical group (1 if the input names no regions). A mark of 0 means
/// no group; Gmsh drops such elements when it saves a file that has groups.
/// \param tags as returned by `insert_pslg()`.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_gmsh(const std::string& filename, const Cdt& cdt,
                          const Mesh_tags_2<typename Cdt::Geom_traits>& tags = {})
{
  const internal::Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, tags);
  const internal::Gmsh_entities entities = internal::gmsh_entities(mesh);
  internal::Gmsh_writer out(filename, entities);
  out.write_nodes([&](std::size_t v) { return internal::gmsh_point(mesh, v); });
  out.begin_elements();
  out.write_elements(1, [&](std::size_t i) { return mesh.edges[i].vertices; });
  out.write_elements(2, [&](std::size_t i) { return mesh.triangles[i].vertices; });
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_GMSH_2_H
