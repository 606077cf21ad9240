// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh of first or second order in Gmsh's format 4.1, ASCII (Gmsh reference manual, "MSH file
// format"). Every feature vertex is an elementary point, every crease an elementary curve, every patch an elementary
// surface, every subdomain an elementary volume; each is also a physical group with the same tag, so that Gmsh keeps
// all of them when it saves.

#ifndef WEFT_IO_WRITE_GMSH_3_H
#define WEFT_IO_WRITE_GMSH_3_H

#include <weft/internal/as_index.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Gmsh_writer.h>
#include <weft/IO/internal/Mesh_nodes_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Adds elements of one dimension to their entities; `first` is the tag that stands for index 0.
template <class K, class Elements>
void add_gmsh_elements(Gmsh_entities& entities, const Tetrahedral_mesh_3<K>& mesh, int dimension,
                       const Elements& elements, const std::vector<int>& tags, int first)
{
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Gmsh_entity& entity = entities[as_index(dimension)][tags[i] + first];
    entity.elements.push_back(i);
    for (const std::size_t v : elements[i]) entity.include(xyz(mesh.points[v]));
  }
}

/// Says which creases bound which patches, and which feature vertices which creases.
template <class K>
WEFT_COLD void bound_gmsh_entities(Gmsh_entities& entities, const Tetrahedral_mesh_3<K>& mesh)
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
WEFT_COLD Gmsh_entities gmsh_entities(const Mesh_nodes_3<K>& nodes, const Mesh_names_3& names)
{
  const Tetrahedral_mesh_3<K>& mesh = nodes.mesh();
  Gmsh_entities entities;
  add_gmsh_elements(entities, mesh, 1, mesh.edges, mesh.creases, 1);
  add_gmsh_elements(entities, mesh, 2, mesh.facets, mesh.patches, 1);
  add_gmsh_elements(entities, mesh, 3, mesh.cells, mesh.subdomains, 0);
  for (const std::size_t v : mesh.corners) entities[0][mesh.locations[v].index + 1].elements.push_back(v);
  for (std::size_t v = 0; v < nodes.number_of_nodes(); ++v) {
    const auto& location = nodes.location(v);
    Gmsh_entity& entity = entities[as_index(location.dimension)][location.index + (location.dimension < 3 ? 1 : 0)];
    entity.nodes.push_back(v);
    entity.include(nodes.node(v));
  }
  bound_gmsh_entities(entities, mesh);
  for (auto& of_dimension : entities)
    for (auto& [tag, entity] : of_dimension) entity.physical = tag;
  for (auto& [tag, entity] : entities[2])
    if (const auto name = names.patches.find(tag - 1); name != names.patches.end()) entity.name = name->second;
  for (auto& [tag, entity] : entities[3])
    if (const auto name = names.subdomains.find(tag); name != names.subdomains.end()) entity.name = name->second;
  return entities;
}

template <class K>
WEFT_COLD void write_gmsh(const std::string& filename, Mesh_nodes_3<K> nodes, const Mesh_names_3& names)
{
  const Gmsh_entities entities = gmsh_entities(nodes, names);
  const int order = nodes.is_quadratic() ? 2 : 1;
  Gmsh_writer out(filename, entities);
  out.write_nodes([&](std::size_t v) { return nodes.node(v); });
  out.begin_elements();
  out.write_elements(0, [](std::size_t v) { return std::array<std::size_t, 1>{v}; });
  out.write_elements(
      1, [&](std::size_t i) { return nodes.edge(i); }, order);
  out.write_elements(
      2, [&](std::size_t i) { return nodes.facet(i); }, order);
  out.write_elements(
      3,
      [&](std::size_t i) {
        std::vector<std::size_t> cell = nodes.cell(i);
        if (cell.size() == 10) std::swap(cell[8], cell[9]); // Gmsh has the node between 2 and 3 first
        return cell;
      },
      order);
  out.close();
}

} // namespace internal

namespace IO {

/// Writes a mesh as a .msh file. Tags: feature + 1 of points, crease + 1 of curves, patch + 1 of surfaces, subdomain of
/// volumes. Facets are counterclockwise seen from outside, cells positively oriented.
/// \param names become those of physical groups.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_gmsh(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh,
                          const Mesh_names_3& names = Mesh_names_3())
{
  internal::write_gmsh(filename, internal::Mesh_nodes_3<K>(mesh), names);
}

/// The same of second order.
template <class K>
WEFT_COLD void write_gmsh(const std::string& filename, const Quadratic_mesh_3<K>& mesh,
                          const Mesh_names_3& names = Mesh_names_3())
{
  internal::write_gmsh(filename, internal::Mesh_nodes_3<K>(mesh), names);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_GMSH_3_H
