// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh in Gmsh's format 4.1, ASCII (Gmsh reference manual, "MSH file format"). Every region of the
// domain is an elementary surface, every input segment an elementary curve, every input vertex an elementary point;
// marks of regions and segments are the physical groups.

#ifndef WEFT_IO_WRITE_GMSH_2_H
#define WEFT_IO_WRITE_GMSH_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/write_gmsh_3.h> // the overload for spatial meshes

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// A point, curve or surface of the file with what belongs to it.
struct Gmsh_entity
{
  int physical = 0; ///< 0: none
  double lower[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double upper[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  std::vector<std::size_t> nodes, elements; ///< indices into the mesh's arrays

  void include(const std::array<double, 2>& p)
  {
    for (std::size_t i = 0; i < 2; ++i) lower[i] = std::min(lower[i], p[i]), upper[i] = std::max(upper[i], p[i]);
  }
};

/// Entities by dimension and tag.
using Gmsh_entities = std::array<std::map<int, Gmsh_entity>, 3>;

/// Distributes the mesh over entities. A node belongs to the entity of lowest dimension that has it.
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
      owner[v] = {2, triangle.component + 1}, surface.include(mesh.points[v]);
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
    for (const std::size_t v : edge.vertices) owner[v] = {1, tag}, curve.include(mesh.points[v]);
  }
  for (std::size_t i = 0; i < mesh.fixed.size(); ++i) owner[mesh.fixed[i]] = {0, static_cast<int>(i) + 1};
  for (std::size_t v = 0; v < owner.size(); ++v) {
    Gmsh_entity& entity = entities[as_index(owner[v].first)][owner[v].second];
    entity.nodes.push_back(v);
    if (owner[v].first == 0) entity.include(mesh.points[v]);
  }
  return entities;
}

WEFT_COLD inline void write_gmsh_entities(Text_writer& out, const Gmsh_entities& entities)
{
  out << "$Entities\n" << entities[0].size() << ' ' << entities[1].size() << ' ' << entities[2].size() << " 0\n";
  for (const auto& [tag, point] : entities[0]) out << tag << ' ' << point.lower[0] << ' ' << point.lower[1] << " 0 0\n";
  for (int dimension = 1; dimension <= 2; ++dimension)
    for (const auto& [tag, entity] : entities[as_index(dimension)]) {
      out << tag << ' ' << entity.lower[0] << ' ' << entity.lower[1] << " 0 " << entity.upper[0] << ' '
          << entity.upper[1] << " 0 ";
      if (entity.physical != 0)
        out << "1 " << entity.physical;
      else
        out << '0';
      out << " 0\n"; // the boundary of the entity isn't stated
    }
  out << "$EndEntities\n";
}

WEFT_COLD inline void write_gmsh_nodes(Text_writer& out, const Indexed_mesh_2& mesh, const Gmsh_entities& entities)
{
  std::size_t blocks = 0;
  for (const auto& of_dimension : entities)
    for (const auto& [tag, entity] : of_dimension) blocks += !entity.nodes.empty();
  out << "$Nodes\n" << blocks << ' ' << mesh.points.size() << " 1 " << mesh.points.size() << '\n';
  for (int dimension = 0; dimension <= 2; ++dimension)
    for (const auto& [tag, entity] : entities[as_index(dimension)]) {
      if (entity.nodes.empty()) continue;
      out << dimension << ' ' << tag << " 0 " << entity.nodes.size() << '\n';
      for (const std::size_t v : entity.nodes) out << v + 1 << '\n';
      for (const std::size_t v : entity.nodes) out << mesh.points[v][0] << ' ' << mesh.points[v][1] << " 0\n";
    }
  out << "$EndNodes\n";
}

WEFT_COLD inline void write_gmsh_elements(Text_writer& out, const Indexed_mesh_2& mesh, const Gmsh_entities& entities)
{
  const std::size_t n = mesh.edges.size() + mesh.triangles.size();
  std::size_t number = 0;
  out << "$Elements\n" << entities[1].size() + entities[2].size() << ' ' << n << " 1 " << n << '\n';
  for (const auto& [tag, curve] : entities[1]) {
    out << "1 " << tag << " 1 " << curve.elements.size() << '\n'; // type 1: line
    for (const std::size_t e : curve.elements)
      out << ++number << ' ' << mesh.edges[e].vertices[0] + 1 << ' ' << mesh.edges[e].vertices[1] + 1 << '\n';
  }
  for (const auto& [tag, surface] : entities[2]) {
    out << "2 " << tag << " 2 " << surface.elements.size() << '\n'; // type 2: triangle
    for (const std::size_t t : surface.elements) {
      out << ++number;
      for (const std::size_t v : mesh.triangles[t].vertices) out << ' ' << v + 1;
      out << '\n';
    }
  }
  out << "$EndElements\n";
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
  internal::Text_writer out(filename);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  internal::write_gmsh_entities(out, entities);
  internal::write_gmsh_nodes(out, mesh, entities);
  internal::write_gmsh_elements(out, mesh, entities);
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_GMSH_2_H
