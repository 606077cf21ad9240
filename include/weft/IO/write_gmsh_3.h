// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh in Gmsh's format 4.1, ASCII (Gmsh reference manual, "MSH file format"). Every feature vertex is
// an elementary point, every crease an elementary curve, every patch an elementary surface, every subdomain an
// elementary volume; each is also a physical group with the same tag, so that Gmsh keeps all of them when it saves.

#ifndef WEFT_IO_WRITE_GMSH_3_H
#define WEFT_IO_WRITE_GMSH_3_H

#include <weft/internal/as_index.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// A point, curve, surface or volume of the file with what belongs to it.
struct Gmsh_entity_3
{
  std::array<double, 3> lower, upper;
  std::vector<std::size_t> nodes, elements; ///< indices into the mesh's arrays
  std::set<int> boundary;                   ///< tags of the entities of one dimension less around it

  Gmsh_entity_3()
  {
    lower.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
  }
  void include(const std::array<double, 3>& p)
  {
    for (std::size_t i = 0; i < 3; ++i) lower[i] = (std::min)(lower[i], p[i]), upper[i] = (std::max)(upper[i], p[i]);
  }
};

/// Entities by dimension and tag.
using Gmsh_entities_3 = std::array<std::map<int, Gmsh_entity_3>, 4>;

/// Adds elements of one dimension to their entities; `first` is the tag that stands for index 0.
template <class K, class Elements>
void add_gmsh_elements(Gmsh_entities_3& entities, const Tetrahedral_mesh_3<K>& mesh, int dimension,
                       const Elements& elements, const std::vector<int>& tags, int first)
{
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Gmsh_entity_3& entity = entities[as_index(dimension)][tags[i] + first];
    entity.elements.push_back(i);
    for (const std::size_t v : elements[i]) entity.include(xyz(mesh.points[v]));
  }
}

/// Says which creases bound which patches, and which feature vertices which creases.
template <class K>
WEFT_COLD void bound_gmsh_entities(Gmsh_entities_3& entities, const Tetrahedral_mesh_3<K>& mesh)
{
  std::map<std::array<std::size_t, 2>, int> crease_of;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    crease_of[sorted(mesh.edges[e])] = mesh.creases[e] + 1;
    for (const std::size_t v : mesh.edges[e])
      if (mesh.locations[v].dimension == 0)
        entities[1][mesh.creases[e] + 1].boundary.insert(mesh.locations[v].index + 1);
  }
  std::map<std::array<std::size_t, 3>, int> patch_of;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    patch_of[sorted(mesh.facets[f])] = mesh.patches[f] + 1;
    for (std::size_t i = 0; i < 3 && !crease_of.empty(); ++i) {
      const auto crease = crease_of.find(sorted<2>({mesh.facets[f][i], mesh.facets[f][(i + 1) % 3]}));
      if (crease != crease_of.end()) entities[2][mesh.patches[f] + 1].boundary.insert(crease->second);
    }
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& cell = mesh.cells[c];
      const auto patch = patch_of.find(sorted<3>({cell[(i + 1) % 4], cell[(i + 2) % 4], cell[(i + 3) % 4]}));
      if (patch != patch_of.end()) entities[3][mesh.subdomains[c]].boundary.insert(patch->second);
    }
}

/// Distributes the mesh over entities. A vertex is a node of the entity it lies on.
template <class K>
WEFT_COLD Gmsh_entities_3 gmsh_entities(const Tetrahedral_mesh_3<K>& mesh)
{
  Gmsh_entities_3 entities;
  add_gmsh_elements(entities, mesh, 1, mesh.edges, mesh.creases, 1);
  add_gmsh_elements(entities, mesh, 2, mesh.facets, mesh.patches, 1);
  add_gmsh_elements(entities, mesh, 3, mesh.cells, mesh.subdomains, 0);
  for (const std::size_t v : mesh.corners) entities[0][mesh.locations[v].index + 1].elements.push_back(v);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto& location = mesh.locations[v];
    Gmsh_entity_3& entity = entities[as_index(location.dimension)][location.index + (location.dimension < 3 ? 1 : 0)];
    entity.nodes.push_back(v);
    entity.include(xyz(mesh.points[v]));
  }
  bound_gmsh_entities(entities, mesh);
  return entities;
}

WEFT_COLD inline void write_gmsh_entities(Text_writer& out, const Gmsh_entities_3& entities)
{
  out << "$Entities\n"
      << entities[0].size() << ' ' << entities[1].size() << ' ' << entities[2].size() << ' ' << entities[3].size()
      << '\n';
  for (int dimension = 0; dimension <= 3; ++dimension)
    for (const auto& [tag, entity] : entities[as_index(dimension)]) {
      out << tag << ' ';
      for (const double x : entity.lower) out << x << ' ';
      if (dimension > 0)
        for (const double x : entity.upper) out << x << ' ';
      out << "1 " << tag; // its physical group
      if (dimension > 0) {
        out << ' ' << entity.boundary.size();
        for (const int part : entity.boundary) out << ' ' << part;
      }
      out << '\n';
    }
  out << "$EndEntities\n";
}

template <class K>
WEFT_COLD void write_gmsh_nodes(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh, const Gmsh_entities_3& entities)
{
  std::size_t blocks = 0;
  for (const auto& of_dimension : entities)
    for (const auto& tag_and_entity : of_dimension) blocks += !tag_and_entity.second.nodes.empty();
  out << "$Nodes\n" << blocks << ' ' << mesh.points.size() << " 1 " << mesh.points.size() << '\n';
  for (int dimension = 0; dimension <= 3; ++dimension)
    for (const auto& [tag, entity] : entities[as_index(dimension)]) {
      if (entity.nodes.empty()) continue;
      out << dimension << ' ' << tag << " 0 " << entity.nodes.size() << '\n';
      for (const std::size_t v : entity.nodes) out << v + 1 << '\n';
      for (const std::size_t v : entity.nodes) {
        const auto p = xyz(mesh.points[v]);
        out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      }
    }
  out << "$EndNodes\n";
}

/// Writes the blocks of elements of one dimension. `vertices(i)` are those of element i.
template <class Vertices>
WEFT_COLD void write_gmsh_blocks(Text_writer& out, const Gmsh_entities_3& entities, int dimension, int type,
                                 std::size_t& number, const Vertices& vertices)
{
  for (const auto& [tag, entity] : entities[as_index(dimension)]) {
    if (entity.elements.empty()) continue;
    out << dimension << ' ' << tag << ' ' << type << ' ' << entity.elements.size() << '\n';
    for (const std::size_t i : entity.elements) {
      out << ++number;
      for (const std::size_t v : vertices(i)) out << ' ' << v + 1;
      out << '\n';
    }
  }
}

template <class K>
WEFT_COLD void write_gmsh_elements(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh, const Gmsh_entities_3& entities)
{
  const std::size_t n = mesh.corners.size() + mesh.edges.size() + mesh.facets.size() + mesh.cells.size();
  std::size_t blocks = 0, number = 0;
  for (const auto& of_dimension : entities)
    for (const auto& tag_and_entity : of_dimension) blocks += !tag_and_entity.second.elements.empty();
  out << "$Elements\n" << blocks << ' ' << n << " 1 " << n << '\n';
  using One = std::array<std::size_t, 1>;
  write_gmsh_blocks(out, entities, 0, 15, number, [](std::size_t v) { return One{v}; });
  write_gmsh_blocks(out, entities, 1, 1, number, [&](std::size_t i) { return mesh.edges[i]; });
  write_gmsh_blocks(out, entities, 2, 2, number, [&](std::size_t i) { return mesh.facets[i]; });
  write_gmsh_blocks(out, entities, 3, 4, number, [&](std::size_t i) { return mesh.cells[i]; });
  out << "$EndElements\n";
}

} // namespace internal

namespace IO {

/// Writes a mesh as a .msh file. Tags: feature + 1 of points, crease + 1 of curves, patch + 1 of surfaces, subdomain of
/// volumes. Facets are counterclockwise seen from outside, cells positively oriented.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_gmsh(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh)
{
  const internal::Gmsh_entities_3 entities = internal::gmsh_entities(mesh);
  internal::Text_writer out(filename);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  internal::write_gmsh_entities(out, entities);
  internal::write_gmsh_nodes(out, mesh, entities);
  internal::write_gmsh_elements(out, mesh, entities);
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_GMSH_3_H
