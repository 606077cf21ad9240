// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh to a file; the extension says in which format.

#ifndef WEFT_IO_WRITE_MESH_2_H
#define WEFT_IO_WRITE_MESH_2_H

#include <weft/IO/internal/extension.h>
#include <weft/IO/write_gmsh_2.h>
#include <weft/IO/write_medit_2.h>
#include <weft/IO/write_off_2.h>
#include <weft/IO/write_svg_2.h>
#include <weft/IO/write_vtu_2.h>

#include <string>

namespace weft {
namespace IO {

/// Whether `write_mesh_2()` knows the extension of the file: .off, .vtu, .mesh, .msh or .svg.
inline bool is_mesh_filename(const std::string& filename)
{
  const std::string e = internal::extension(filename);
  return e == "off" || e == "vtu" || e == "mesh" || e == "msh" || e == "svg";
}

/// Writes the faces in the domain as .off, .vtu, .mesh (Medit), .msh (Gmsh 4.1) or .svg (coloured by smallest angle).
/// \param tags as returned by `insert_pslg()`; written where the format has room for them.
/// \throws File_error if the extension is unknown or the file can't be written.
template <class Cdt>
void write_mesh_2(const std::string& filename, const Cdt& cdt, const Mesh_tags_2<typename Cdt::Geom_traits>& tags = {})
{
  const std::string extension = internal::extension(filename);
  if (extension == "off") return write_off(filename, cdt);
  if (extension == "vtu") return write_vtu(filename, cdt, tags);
  if (extension == "mesh") return write_medit(filename, cdt, tags);
  if (extension == "msh") return write_gmsh(filename, cdt, tags);
  if (extension == "svg") return write_svg(filename, cdt);
  throw File_error(filename, 0, "unknown extension; known are .off, .vtu, .mesh, .msh and .svg");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_MESH_2_H
