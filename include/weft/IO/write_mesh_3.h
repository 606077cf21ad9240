// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh to a file; the extension says in which format.

#ifndef WEFT_IO_WRITE_MESH_3_H
#define WEFT_IO_WRITE_MESH_3_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/write_abaqus_3.h>
#include <weft/IO/write_gmsh_3.h>
#include <weft/IO/write_medit_3.h>
#include <weft/IO/write_off_3.h>
#include <weft/IO/write_stl_3.h>
#include <weft/IO/write_vtu_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <string>

namespace weft {
namespace IO {

/// Whether `write_mesh_3()` knows the extension of the file: .mesh, .vtu, .msh, .inp, .off or .stl.
inline bool is_mesh_3_filename(const std::string& filename)
{
  const std::string e = internal::extension(filename);
  return e == "mesh" || e == "vtu" || e == "msh" || e == "inp" || e == "off" || e == "stl";
}

/// Writes a mesh as .mesh (Medit), .vtu (VTK) or .msh (Gmsh 4.1) with all tags, as .inp (Abaqus, CalculiX) with its
/// subdomains and patches, or its boundary as .off or .stl.
/// \param names of subdomains and patches, for .vtu, .msh and .inp.
/// \throws File_error if the extension is unknown or the file can't be written.
template <class K>
void write_mesh_3(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh,
                  const Mesh_names_3& names = Mesh_names_3())
{
  const std::string extension = internal::extension(filename);
  if (extension == "mesh") return write_medit(filename, mesh);
  if (extension == "vtu") return write_vtu(filename, mesh, names);
  if (extension == "msh") return write_gmsh(filename, mesh, names);
  if (extension == "inp") return write_abaqus(filename, mesh, names);
  if (extension == "off") return write_off(filename, mesh);
  if (extension == "stl") return write_stl(filename, mesh);
  throw File_error(filename, 0, "unknown extension; known are .mesh, .vtu, .msh, .inp, .off and .stl");
}

/// Whether `write_mesh_3()` can write meshes of second order to a file: .vtu, .msh or .inp.
inline bool is_quadratic_mesh_3_filename(const std::string& filename)
{
  const std::string e = internal::extension(filename);
  return e == "vtu" || e == "msh" || e == "inp";
}

/// Writes a mesh of second order as .vtu, .msh or .inp.
/// \throws File_error if the extension is unknown or the file can't be written.
template <class K>
void write_mesh_3(const std::string& filename, const Quadratic_mesh_3<K>& mesh,
                  const Mesh_names_3& names = Mesh_names_3())
{
  const std::string extension = internal::extension(filename);
  if (extension == "vtu") return write_vtu(filename, mesh, names);
  if (extension == "msh") return write_gmsh(filename, mesh, names);
  if (extension == "inp") return write_abaqus(filename, mesh, names);
  throw File_error(filename, 0, "unknown extension; known for meshes of second order are .vtu, .msh and .inp");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_MESH_3_H
