// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh as a VTK unstructured grid, XML: triangles and, as lines, the constrained edges. Cell
// data: `domain`, the mark of a triangle's region (0 on lines); `segment`, the input segment of a line (-1 on
// triangles and where unknown); `marker`, the mark of that segment (0 on triangles). CGAL's own writer has no cell data
// for constraints, and writes vertices and constraints outside the domain as well.

#ifndef WEFT_IO_WRITE_VTU_2_H
#define WEFT_IO_WRITE_VTU_2_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/internal/Vtu_array_writer.h>
#include <weft/IO/Vtu_encoding.h>
#include <weft/IO/write_vtu_3.h> // the overload for spatial meshes

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace weft {
namespace internal {

WEFT_COLD inline void write_vtu_cells(Vtu_array_writer& arrays, const Indexed_mesh_2& mesh)
{
  arrays.out() << "      <Cells>\n";
  arrays.begin<std::int64_t>("connectivity");
  for (const auto& t : mesh.triangles) arrays.row<std::int64_t>(t.vertices);
  for (const auto& e : mesh.edges) arrays.row<std::int64_t>(e.vertices);
  arrays.end();
  arrays.begin<std::int64_t>("offsets");
  std::int64_t offset = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) arrays.row_of_one(offset += 3);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) arrays.row_of_one(offset += 2);
  arrays.end();
  arrays.begin<std::uint8_t>("types");
  const std::array<int, 1> triangle{5}, line{3}; // VTK_TRIANGLE, VTK_LINE
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) arrays.row<std::uint8_t>(triangle);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) arrays.row<std::uint8_t>(line);
  arrays.end();
  arrays.out() << "      </Cells>\n";
}

/// One number per cell: triangles first, then lines.
template <class Of_triangle, class Of_edge>
WEFT_COLD void write_vtu_cell_data(Vtu_array_writer& arrays, const Indexed_mesh_2& mesh, const std::string& name,
                                   const Of_triangle& of_triangle, const Of_edge& of_edge)
{
  arrays.begin<std::int32_t>(name);
  for (const auto& triangle : mesh.triangles) arrays.row_of_one(std::int32_t(of_triangle(triangle)));
  for (const auto& edge : mesh.edges) arrays.row_of_one(std::int32_t(of_edge(edge)));
  arrays.end();
}

} // namespace internal

namespace IO {

/// Writes the faces in the domain and the constrained edges as a .vtu file.
/// \param tags as returned by `insert_pslg()`.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_vtu(const std::string& filename, const Cdt& cdt,
                         const Mesh_tags_2<typename Cdt::Geom_traits>& tags = {},
                         Vtu_encoding encoding = Vtu_encoding::compressed)
{
  using internal::Indexed_mesh_2;
  const Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, tags);
  internal::Text_writer out(filename);
  internal::Vtu_array_writer arrays(out, encoding == Vtu_encoding::ascii, encoding == Vtu_encoding::compressed);
  arrays.write_head();
  out << "    <Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\""
      << mesh.triangles.size() + mesh.edges.size() << "\">\n      <Points>\n";
  arrays.begin<double>("Points", 3);
  for (const auto& p : mesh.points) arrays.row<double>(std::array<double, 3>{p[0], p[1], 0});
  arrays.end();
  out << "      </Points>\n";
  internal::write_vtu_cells(arrays, mesh);
  out << "      <CellData Scalars=\"domain\">\n";
  const auto zero = [](const auto&) { return 0; };
  const auto none = [](const auto&) { return -1; };
  internal::write_vtu_cell_data(
      arrays, mesh, "domain", [](const Indexed_mesh_2::Triangle& t) { return t.marker; }, zero);
  internal::write_vtu_cell_data(arrays, mesh, "segment", none, [](const Indexed_mesh_2::Edge& e) { return e.segment; });
  internal::write_vtu_cell_data(arrays, mesh, "marker", zero, [](const Indexed_mesh_2::Edge& e) { return e.marker; });
  out << "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_VTU_2_H
