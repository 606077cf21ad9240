// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh with a solution on it: .vtu with point and cell data, .msh with $NodeData, or .mesh with the
// values at vertices in a .sol beside it, as MMG takes sizes.

#ifndef WEFT_IO_WRITE_SOLUTION_3_H
#define WEFT_IO_WRITE_SOLUTION_3_H

#include <weft/errors.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/write_gmsh_3.h>
#include <weft/IO/write_medit_3.h>
#include <weft/IO/write_vtu_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Mesh_solution_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <cstddef>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// \param size of each array.
inline void require_sizes(const std::map<std::string, std::vector<double>>& arrays, std::size_t size, const char* of)
{
  for (const auto& [name, values] : arrays)
    if (values.size() != size)
      throw Option_error("the solution '" + name + "' has " + std::to_string(values.size()) +
                         " values, not one for each " + of);
}

/// The solutions at n vertices as a .sol file.
WEFT_COLD inline void write_sol(const std::string& filename, const Mesh_solution_3& solution, std::size_t n)
{
  Text_writer out(filename);
  out << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" << n << '\n' << solution.at_vertices.size();
  for (std::size_t i = 0; i < solution.at_vertices.size(); ++i) out << " 1";
  out << '\n';
  for (std::size_t v = 0; v < n; ++v) {
    const char* separator = "";
    for (const auto& [name, values] : solution.at_vertices) {
      out << separator << values[v];
      separator = " ";
    }
    out << '\n';
  }
  out << "End\n";
  out.close();
}

/// Appends the solutions at vertices to a .msh file.
WEFT_COLD inline void append_node_data(const std::string& filename, const Mesh_solution_3& solution)
{
  std::ofstream out(filename, std::ios::app);
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const auto& [name, values] : solution.at_vertices) {
    out << "$NodeData\n1\n\"" << name << "\"\n1\n0\n3\n0\n1\n" << values.size() << '\n';
    for (std::size_t v = 0; v < values.size(); ++v) out << v + 1 << ' ' << values[v] << '\n';
    out << "$EndNodeData\n";
  }
  out.close();
  if (!out) throw File_error(filename, 0, "can't be written");
}

} // namespace internal

namespace IO {

/// Writes a mesh with a solution as .vtu; with what is known at vertices as .msh, or as .mesh and a .sol of the same
/// name. `read_solution()` reads both of that again.
/// \throws File_error if the extension is another one or a file can't be written; Option_error for arrays of wrong
///   sizes.
template <class K>
WEFT_COLD void write_solution_3(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh,
                                const Mesh_solution_3& solution, const Mesh_names_3& names = Mesh_names_3())
{
  internal::require_sizes(solution.at_vertices, mesh.points.size(), "vertex");
  internal::require_sizes(solution.in_cells, mesh.cells.size(), "cell");
  const std::string extension = internal::extension(filename);
  if (extension == "vtu") return write_vtu(filename, mesh, names, solution);
  if (extension == "msh") {
    write_gmsh(filename, mesh, names);
    return internal::append_node_data(filename, solution);
  }
  if (extension != "mesh") throw File_error(filename, 0, "unknown extension; known are .vtu, .msh and .mesh");
  write_medit(filename, mesh);
  internal::write_sol(filename.substr(0, filename.size() - 4) + "sol", solution, mesh.points.size());
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_SOLUTION_3_H
