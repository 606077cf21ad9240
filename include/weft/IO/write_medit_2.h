// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh in Medit's .mesh format (Frey, "Medit: an interactive mesh visualization software", INRIA 2001),
// dimension 2: constrained edges with the marks of their input segments, triangles with the marks of their regions,
// input vertices as required vertices.

#ifndef WEFT_IO_WRITE_MEDIT_2_H
#define WEFT_IO_WRITE_MEDIT_2_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/write_medit_3.h> // the overload for spatial meshes

#include <string>

namespace weft {
namespace IO {

/// Writes the faces in the domain and the constrained edges as a .mesh file.
/// \param tags as returned by `insert_pslg()`. The reference of an edge is the mark of its input segment (its number
///   counted from 1 where the input has no marks, 0 if unknown), that of a triangle the mark of its region.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_medit(const std::string& filename, const Cdt& cdt,
                           const Mesh_tags_2<typename Cdt::Geom_traits>& tags = {})
{
  const internal::Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, tags);
  internal::Text_writer out(filename);
  out << "MeshVersionFormatted 2\nDimension 2\n\nVertices\n" << mesh.points.size() << '\n';
  for (const auto& p : mesh.points) out << p[0] << ' ' << p[1] << " 0\n";
  out << "\nEdges\n" << mesh.edges.size() << '\n';
  for (const auto& edge : mesh.edges)
    out << edge.vertices[0] + 1 << ' ' << edge.vertices[1] + 1 << ' ' << edge.marker << '\n';
  out << "\nTriangles\n" << mesh.triangles.size() << '\n';
  for (const auto& triangle : mesh.triangles) {
    for (const std::size_t v : triangle.vertices) out << v + 1 << ' ';
    out << triangle.marker << '\n';
  }
  if (!mesh.fixed.empty()) {
    out << "\nRequiredVertices\n" << mesh.fixed.size() << '\n';
    for (const std::size_t v : mesh.fixed) out << v + 1 << '\n';
  }
  out << "\nEnd\n";
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_MEDIT_2_H
