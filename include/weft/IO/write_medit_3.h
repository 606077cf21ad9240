// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh in Medit's .mesh format (Frey, "Medit: an interactive mesh visualization software", INRIA
// 2001), dimension 3: cells with their subdomains, boundary facets with their patches, crease edges as ridges, feature
// vertices as corners and required vertices. Medit counts from 1 and takes the reference 0 for "none", so patches,
// creases and features are written with 1 added.

#ifndef WEFT_IO_WRITE_MEDIT_3_H
#define WEFT_IO_WRITE_MEDIT_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// A section of elements, each a list of vertices and its reference.
template <std::size_t N>
WEFT_COLD void write_medit_section(Text_writer& out, const char* name,
                                   const std::vector<std::array<std::size_t, N>>& elements,
                                   const std::vector<int>& tags, int first)
{
  out << '\n' << name << '\n' << elements.size() << '\n';
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (const std::size_t v : elements[i]) out << v + 1 << ' ';
    out << tags[i] + first << '\n';
  }
}

/// A section that is a list of numbers counted from 1; left out when there are none.
WEFT_COLD inline void write_medit_list(Text_writer& out, const char* name, const std::vector<std::size_t>& numbers)
{
  if (numbers.empty()) return;
  out << '\n' << name << '\n' << numbers.size() << '\n';
  for (const std::size_t i : numbers) out << i + 1 << '\n';
}

} // namespace internal

namespace IO {

/// Writes a mesh as a .mesh file. The reference of a cell is its subdomain, that of a facet its patch + 1, that of an
/// edge its crease + 1, that of a vertex the subdomain, patch + 1, crease + 1 or feature + 1 that it lies on. Facets
/// are counterclockwise seen from outside, cells positively oriented. All coordinates can be read back exactly.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_medit(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh)
{
  internal::Text_writer out(filename);
  out << "MeshVersionFormatted 2\nDimension 3\n\nVertices\n" << mesh.points.size() << '\n';
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (const double x : internal::xyz(mesh.points[v])) out << x << ' ';
    out << mesh.locations[v].index + (mesh.locations[v].dimension < 3 ? 1 : 0) << '\n';
  }
  internal::write_medit_list(out, "Corners", mesh.corners);
  internal::write_medit_list(out, "RequiredVertices", mesh.corners);
  internal::write_medit_section(out, "Edges", mesh.edges, mesh.creases, 1);
  std::vector<std::size_t> ridges(mesh.edges.size());
  for (std::size_t i = 0; i < ridges.size(); ++i) ridges[i] = i;
  internal::write_medit_list(out, "Ridges", ridges);
  internal::write_medit_section(out, "Triangles", mesh.facets, mesh.patches, 1);
  internal::write_medit_section(out, "Tetrahedra", mesh.cells, mesh.subdomains, 0);
  out << "\nEnd\n";
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_MEDIT_3_H
