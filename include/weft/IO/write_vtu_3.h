// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh as a VTK unstructured grid, XML in ASCII: tetrahedra, boundary facets as triangles, crease
// edges as lines, feature vertices as vertices. Cell data: `subdomain` of tetrahedra (0 elsewhere), `patch` of
// triangles, `crease` of lines and `feature` of vertices (-1 elsewhere). Point data: `dimension` and `index` of the
// part of the domain that a point lies on.

#ifndef WEFT_IO_WRITE_VTU_3_H
#define WEFT_IO_WRITE_VTU_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/internal/vtu_array.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Mesh_solution_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace weft {
namespace internal {

template <class K>
WEFT_COLD void write_vtu_points(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh, const Mesh_solution_3& solution)
{
  out << "      <Points>\n        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
         "format=\"ascii\">\n";
  for (const auto& point : mesh.points) {
    const auto p = xyz(point);
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  end_vtu_array(out);
  out << "      </Points>\n      <PointData>\n";
  begin_vtu_array(out, "Int32", "dimension");
  for (const auto& location : mesh.locations) out << location.dimension << '\n';
  end_vtu_array(out);
  begin_vtu_array(out, "Int32", "index");
  for (const auto& location : mesh.locations) out << location.index << '\n';
  end_vtu_array(out);
  for (const auto& [name, values] : solution.at_vertices) {
    begin_vtu_array(out, "Float64", name);
    for (const double value : values) out << value << '\n';
    end_vtu_array(out);
  }
  out << "      </PointData>\n";
}

/// Calls `write(number of vertices of each, VTK's type, number of elements)` for every kind of element in order.
template <class K, class Write>
void for_each_vtu_kind(const Tetrahedral_mesh_3<K>& mesh, const Write& write)
{
  write(4, 10, mesh.cells.size());  // VTK_TETRA
  write(3, 5, mesh.facets.size());  // VTK_TRIANGLE
  write(2, 3, mesh.edges.size());   // VTK_LINE
  write(1, 1, mesh.corners.size()); // VTK_VERTEX
}

template <class Elements>
WEFT_COLD void write_vtu_connectivity(Text_writer& out, const Elements& elements)
{
  for (const auto& element : elements) {
    const char* separator = "";
    for (const std::size_t v : element) {
      out << separator << v;
      separator = " ";
    }
    out << '\n';
  }
}

template <class K>
WEFT_COLD void write_vtu_cells(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh)
{
  out << "      <Cells>\n";
  begin_vtu_array(out, "Int64", "connectivity");
  write_vtu_connectivity(out, mesh.cells);
  write_vtu_connectivity(out, mesh.facets);
  write_vtu_connectivity(out, mesh.edges);
  for (const std::size_t v : mesh.corners) out << v << '\n';
  end_vtu_array(out);
  begin_vtu_array(out, "Int64", "offsets");
  std::size_t offset = 0;
  for_each_vtu_kind(mesh, [&](std::size_t vertices, int, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out << (offset += vertices) << '\n';
  });
  end_vtu_array(out);
  begin_vtu_array(out, "UInt8", "types");
  for_each_vtu_kind(mesh, [&](std::size_t, int type, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out << type << '\n';
  });
  end_vtu_array(out);
  out << "      </Cells>\n";
}

/// Numbers in cells; 0 on all other elements.
template <class K>
WEFT_COLD void write_vtu_cell_data(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh, const Mesh_solution_3& solution)
{
  for (const auto& [name, values] : solution.in_cells) {
    begin_vtu_array(out, "Float64", name);
    for (const double value : values) out << value << '\n';
    for (std::size_t i = mesh.facets.size() + mesh.edges.size() + mesh.corners.size(); i > 0; --i) out << "0\n";
    end_vtu_array(out);
  }
}

/// One number per element: `tags` for the elements of one kind, which have so many vertices, `other` for the rest.
template <class K, class Tags>
WEFT_COLD void write_vtu_tags(Text_writer& out, const Tetrahedral_mesh_3<K>& mesh, const std::string& name,
                              std::size_t tagged_vertices, const Tags& tags, int other)
{
  begin_vtu_array(out, "Int32", name);
  for_each_vtu_kind(mesh, [&](std::size_t vertices, int, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out << (vertices == tagged_vertices ? tags[i] : other) << '\n';
  });
  end_vtu_array(out);
}

/// Field data: numbers that have names, and the names, which VTK wants as characters that end with 0.
WEFT_COLD inline void write_vtu_names(Text_writer& out, const std::string& what,
                                      const std::map<int, std::string>& names)
{
  if (names.empty()) return;
  const std::string tuples = "\" NumberOfTuples=\"" + std::to_string(names.size()) + "\" format=\"ascii\">\n";
  out << "      <DataArray type=\"Int32\" Name=\"named_" << what << 's' << tuples;
  for (const auto& [number, name] : names) out << number << '\n';
  end_vtu_array(out);
  out << "      <DataArray type=\"String\" Name=\"" << what << "_names" << tuples;
  for (const auto& [number, name] : names) {
    for (const char c : name) out << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    out << "0\n";
  }
  end_vtu_array(out);
}

} // namespace internal

namespace IO {

/// Writes a mesh as a .vtu file. Facets are counterclockwise seen from outside.
/// \param names become field data: `named_subdomains` with the numbers, `subdomain_names`, and the same of patches.
/// \param solution becomes point data and cell data of the tetrahedra.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_vtu(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh,
                         const Mesh_names_3& names = Mesh_names_3(),
                         const Mesh_solution_3& solution = Mesh_solution_3())
{
  internal::Text_writer out(filename);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      << "  <UnstructuredGrid>\n";
  if (!names.subdomains.empty() || !names.patches.empty()) {
    out << "    <FieldData>\n";
    internal::write_vtu_names(out, "subdomain", names.subdomains);
    internal::write_vtu_names(out, "patch", names.patches);
    out << "    </FieldData>\n";
  }
  out << "    <Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\""
      << mesh.cells.size() + mesh.facets.size() + mesh.edges.size() + mesh.corners.size() << "\">\n";
  internal::write_vtu_points(out, mesh, solution);
  internal::write_vtu_cells(out, mesh);
  std::vector<int> features;
  for (const std::size_t v : mesh.corners) features.push_back(mesh.locations[v].index);
  out << "      <CellData Scalars=\"subdomain\">\n";
  internal::write_vtu_tags(out, mesh, "subdomain", 4, mesh.subdomains, 0);
  internal::write_vtu_tags(out, mesh, "patch", 3, mesh.patches, -1);
  internal::write_vtu_tags(out, mesh, "crease", 2, mesh.creases, -1);
  internal::write_vtu_tags(out, mesh, "feature", 1, features, -1);
  internal::write_vtu_cell_data(out, mesh, solution);
  out << "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_VTU_3_H
