// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a tetrahedral mesh from a file; the extension says in which format.

#ifndef WEFT_IO_READ_TETRAHEDRAL_MESH_H
#define WEFT_IO_READ_TETRAHEDRAL_MESH_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/read_gmsh_3.h>
#include <weft/IO/read_medit_3.h>
#include <weft/IO/read_tetgen.h>
#include <weft/IO/read_vtu_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <string>

namespace weft {
namespace IO {

/// Reads a mesh from a .mesh (Medit), .msh (Gmsh 2 or 4.1, ASCII), .vtu (VTK) or .ele (TetGen, with its .node and .face
/// files) file. `notes` says what was left out.
/// \tparam K a CGAL kernel.
/// \throws File_error if the extension is unknown, or as the reader of that format does.
template <class K>
Imported_mesh_3<K> read_tetrahedral_mesh(const std::string& filename)
{
  const std::string type = weft::internal::extension(filename);
  if (type == "mesh") return read_medit_3<K>(filename);
  if (type == "msh") return read_gmsh_3<K>(filename);
  if (type == "vtu") return read_vtu_3<K>(filename);
  if (type == "ele" || type == "node") return read_tetgen<K>(filename);
  throw File_error(filename, 0, "unknown extension; known are .mesh, .msh, .vtu, .ele and .node");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_TETRAHEDRAL_MESH_H
