// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh of first or second order as a VTK unstructured grid: tetrahedra, boundary facets as triangles,
// crease edges as lines, feature vertices as vertices. Cell data: `subdomain` of tetrahedra (0 elsewhere), `patch` of
// triangles, `crease` of lines and `feature` of vertices (-1 elsewhere). Point data: `dimension` and `index` of the
// part of the domain that a point lies on.

#ifndef WEFT_IO_WRITE_VTU_3_H
#define WEFT_IO_WRITE_VTU_3_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Mesh_nodes_3.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/internal/Vtu_array_writer.h>
#include <weft/IO/Vtu_encoding.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Mesh_solution_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// Writes one mesh; `IO::write_vtu()` runs it.
template <class K>
class Vtu_writer_3
{
public:
  Vtu_writer_3(Vtu_array_writer& arrays, Mesh_nodes_3<K> nodes, const Mesh_solution_3& solution)
      : arrays_(arrays), out_(arrays.out()), nodes_(nodes), mesh_(nodes_.mesh()), solution_(solution)
  {}

  WEFT_COLD void run()
  {
    std::size_t elements = 0;
    for (const Kind& kind : kinds()) elements += kind.elements;
    out_ << "    <Piece NumberOfPoints=\"" << nodes_.number_of_nodes() << "\" NumberOfCells=\"" << elements << "\">\n";
    write_points();
    write_cells();
    std::vector<int> features;
    for (const std::size_t v : mesh_.corners) features.push_back(mesh_.locations[v].index);
    out_ << "      <CellData Scalars=\"subdomain\">\n";
    write_tags("subdomain", 0, mesh_.subdomains, 0);
    write_tags("patch", 1, mesh_.patches, -1);
    write_tags("crease", 2, mesh_.creases, -1);
    write_tags("feature", 3, features, -1);
    write_cell_data();
    out_ << "      </CellData>\n    </Piece>\n";
  }

private:
  /// Elements of one kind.
  struct Kind
  {
    std::size_t nodes; ///< of each
    int type;          ///< VTK's
    std::size_t elements;
  };

  /// In the order of the file.
  std::array<Kind, 4> kinds() const
  {
    if (nodes_.is_quadratic()) // VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE, VTK_QUADRATIC_EDGE, VTK_VERTEX
      return {{{10, 24, mesh_.cells.size()}, {6, 22, mesh_.facets.size()}, {3, 21, mesh_.edges.size()}, corners()}};
    return {{{4, 10, mesh_.cells.size()}, // VTK_TETRA
             {3, 5, mesh_.facets.size()}, // VTK_TRIANGLE
             {2, 3, mesh_.edges.size()},  // VTK_LINE
             corners()}};
  }
  Kind corners() const { return {1, 1, mesh_.corners.size()}; } // VTK_VERTEX

  WEFT_COLD void write_points()
  {
    const std::size_t n = nodes_.number_of_nodes();
    out_ << "      <Points>\n";
    arrays_.begin<double>("Points", 3);
    for (std::size_t i = 0; i < n; ++i) arrays_.row<double>(nodes_.node(i));
    arrays_.end();
    out_ << "      </Points>\n      <PointData>\n";
    arrays_.begin<std::int32_t>("dimension");
    for (std::size_t i = 0; i < n; ++i) arrays_.row_of_one(std::int32_t(nodes_.location(i).dimension));
    arrays_.end();
    arrays_.begin<std::int32_t>("index");
    for (std::size_t i = 0; i < n; ++i) arrays_.row_of_one(std::int32_t(nodes_.location(i).index));
    arrays_.end();
    for (const auto& [name, values] : solution_.at_vertices) write_doubles(name, values, 0);
    out_ << "      </PointData>\n";
  }

  WEFT_COLD void write_cells()
  {
    out_ << "      <Cells>\n";
    arrays_.begin<std::int64_t>("connectivity");
    for (std::size_t i = 0; i < mesh_.cells.size(); ++i) arrays_.row<std::int64_t>(nodes_.cell(i));
    for (std::size_t i = 0; i < mesh_.facets.size(); ++i) arrays_.row<std::int64_t>(nodes_.facet(i));
    for (std::size_t i = 0; i < mesh_.edges.size(); ++i) arrays_.row<std::int64_t>(nodes_.edge(i));
    for (const std::size_t v : mesh_.corners) arrays_.row_of_one(static_cast<std::int64_t>(v));
    arrays_.end();
    arrays_.begin<std::int64_t>("offsets");
    std::size_t offset = 0;
    for (const Kind& kind : kinds())
      for (std::size_t i = 0; i < kind.elements; ++i)
        arrays_.row_of_one(static_cast<std::int64_t>(offset += kind.nodes));
    arrays_.end();
    arrays_.begin<std::uint8_t>("types");
    for (const Kind& kind : kinds())
      for (std::size_t i = 0; i < kind.elements; ++i) write_type(kind.type);
    arrays_.end();
    out_ << "      </Cells>\n";
  }

  void write_type(int type) { arrays_.row<std::uint8_t>(std::array<int, 1>{type}); } // an int: a char isn't a number

  /// One number per element: `tags` for the elements of one kind, `other` for the rest.
  WEFT_COLD void write_tags(const std::string& name, std::size_t tagged, const std::vector<int>& tags, int other)
  {
    arrays_.begin<std::int32_t>(name);
    const auto all = kinds();
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t i = 0; i < all[k].elements; ++i) arrays_.row_of_one(std::int32_t(k == tagged ? tags[i] : other));
    arrays_.end();
  }

  /// Numbers in cells; 0 on all other elements.
  WEFT_COLD void write_cell_data()
  {
    for (const auto& [name, values] : solution_.in_cells)
      write_doubles(name, values, mesh_.facets.size() + mesh_.edges.size() + mesh_.corners.size());
  }

  WEFT_COLD void write_doubles(const std::string& name, const std::vector<double>& values, std::size_t zeros)
  {
    arrays_.begin<double>(name);
    for (const double value : values) arrays_.row_of_one(value);
    for (; zeros > 0; --zeros) arrays_.row_of_one(0.);
    arrays_.end();
  }

  Vtu_array_writer& arrays_;
  Text_writer& out_;
  Mesh_nodes_3<K> nodes_;
  const Tetrahedral_mesh_3<K>& mesh_;
  const Mesh_solution_3& solution_;
};

/// Field data: numbers that have names, and the names, which VTK wants as characters that end with 0.
WEFT_COLD inline void write_vtu_names(Text_writer& out, const std::string& what,
                                      const std::map<int, std::string>& names)
{
  if (names.empty()) return;
  const std::string tuples = "\" NumberOfTuples=\"" + std::to_string(names.size()) + "\" format=\"ascii\">\n";
  out << "      <DataArray type=\"Int32\" Name=\"named_" << what << 's' << tuples;
  for (const auto& [number, name] : names) out << number << '\n';
  out << "      </DataArray>\n";
  out << "      <DataArray type=\"String\" Name=\"" << what << "_names" << tuples;
  for (const auto& [number, name] : names) {
    for (const char c : name) out << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    out << "0\n";
  }
  out << "      </DataArray>\n";
}

template <class K>
WEFT_COLD void write_vtu(const std::string& filename, const Mesh_nodes_3<K>& nodes, const Mesh_names_3& names,
                         const Mesh_solution_3& solution, Vtu_encoding encoding)
{
  Text_writer out(filename);
  Vtu_array_writer arrays(out, encoding == Vtu_encoding::ascii, encoding == Vtu_encoding::compressed);
  arrays.write_head();
  if (!names.subdomains.empty() || !names.patches.empty()) {
    out << "    <FieldData>\n";
    write_vtu_names(out, "subdomain", names.subdomains);
    write_vtu_names(out, "patch", names.patches);
    out << "    </FieldData>\n";
  }
  Vtu_writer_3<K>(arrays, nodes, solution).run();
  out << "  </UnstructuredGrid>\n</VTKFile>\n";
  out.close();
}

} // namespace internal

namespace IO {

/// Writes a mesh as a .vtu file. Facets are counterclockwise seen from outside.
/// \param names become field data: `named_subdomains` with the numbers, `subdomain_names`, and the same of patches.
/// \param solution becomes point data and cell data of the tetrahedra.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void
write_vtu(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh, const Mesh_names_3& names = Mesh_names_3(),
          const Mesh_solution_3& solution = Mesh_solution_3(), Vtu_encoding encoding = Vtu_encoding::compressed)
{
  internal::write_vtu(filename, internal::Mesh_nodes_3<K>(mesh), names, solution, encoding);
}

/// The same of second order: quadratic tetrahedra, triangles and lines.
/// \param solution has values at all nodes.
template <class K>
WEFT_COLD void
write_vtu(const std::string& filename, const Quadratic_mesh_3<K>& mesh, const Mesh_names_3& names = Mesh_names_3(),
          const Mesh_solution_3& solution = Mesh_solution_3(), Vtu_encoding encoding = Vtu_encoding::compressed)
{
  internal::write_vtu(filename, internal::Mesh_nodes_3<K>(mesh), names, solution, encoding);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_VTU_3_H
