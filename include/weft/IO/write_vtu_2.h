// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh as a VTK unstructured grid, XML in ASCII: triangles and, as lines, the constrained edges. Cell
// data: `domain`, the mark of a triangle's region (0 on lines); `segment`, the input segment of a line (-1 on
// triangles and where unknown); `marker`, the mark of that segment (0 on triangles). CGAL's own writer has no cell data
// for constraints, and writes vertices and constraints outside the domain as well.

#ifndef WEFT_IO_WRITE_VTU_2_H
#define WEFT_IO_WRITE_VTU_2_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/internal/vtu_array.h>
#include <weft/IO/write_vtu_3.h> // the overload for spatial meshes

#include <cstddef>
#include <string>

namespace weft {
namespace internal {

WEFT_COLD inline void write_vtu_cells(Text_writer& out, const Indexed_mesh_2& mesh)
{
  out << "      <Cells>\n";
  begin_vtu_array(out, "Int64", "connectivity");
  for (const auto& t : mesh.triangles) out << t.vertices[0] << ' ' << t.vertices[1] << ' ' << t.vertices[2] << '\n';
  for (const auto& e : mesh.edges) out << e.vertices[0] << ' ' << e.vertices[1] << '\n';
  end_vtu_array(out);
  begin_vtu_array(out, "Int64", "offsets");
  std::size_t offset = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) out << (offset += 3) << '\n';
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) out << (offset += 2) << '\n';
  end_vtu_array(out);
  begin_vtu_array(out, "UInt8", "types");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) out << "5\n"; // VTK_TRIANGLE
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) out << "3\n";     // VTK_LINE
  end_vtu_array(out);
  out << "      </Cells>\n";
}

/// One number per cell: triangles first, then lines.
template <class Of_triangle, class Of_edge>
WEFT_COLD void write_vtu_cell_data(Text_writer& out, const Indexed_mesh_2& mesh, const std::string& name,
                                   const Of_triangle& of_triangle, const Of_edge& of_edge)
{
  begin_vtu_array(out, "Int32", name);
  for (const auto& triangle : mesh.triangles) out << of_triangle(triangle) << '\n';
  for (const auto& edge : mesh.edges) out << of_edge(edge) << '\n';
  end_vtu_array(out);
}

} // namespace internal

namespace IO {

/// Writes the faces in the domain and the constrained edges as a .vtu file.
/// \param tags as returned by `insert_pslg()`.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_vtu(const std::string& filename, const Cdt& cdt,
                         const Mesh_tags_2<typename Cdt::Geom_traits>& tags = {})
{
  using internal::Indexed_mesh_2;
  const Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, tags);
  internal::Text_writer out(filename);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      << "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\""
      << mesh.triangles.size() + mesh.edges.size() << "\">\n      <Points>\n"
      << "        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& p : mesh.points) out << p[0] << ' ' << p[1] << " 0\n";
  internal::end_vtu_array(out);
  out << "      </Points>\n";
  internal::write_vtu_cells(out, mesh);
  out << "      <CellData Scalars=\"domain\">\n";
  const auto zero = [](const auto&) { return 0; };
  const auto none = [](const auto&) { return -1; };
  internal::write_vtu_cell_data(
      out, mesh, "domain", [](const Indexed_mesh_2::Triangle& t) { return t.marker; }, zero);
  internal::write_vtu_cell_data(out, mesh, "segment", none, [](const Indexed_mesh_2::Edge& e) { return e.segment; });
  internal::write_vtu_cell_data(out, mesh, "marker", zero, [](const Indexed_mesh_2::Edge& e) { return e.marker; });
  out << "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_VTU_2_H
