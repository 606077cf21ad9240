// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a planar triangle mesh from a file; the extension says in which format.

#ifndef WEFT_IO_READ_TRIANGLE_MESH_H
#define WEFT_IO_READ_TRIANGLE_MESH_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/read_planar_elements.h>
#include <weft/IO/internal/surface_text_formats.h>
#include <weft/IO/read_gmsh_3.h>
#include <weft/IO/read_medit_3.h>
#include <weft/IO/read_triangle.h>
#include <weft/IO/read_vtu_3.h>
#include <weft/planar/mesh/Element_soup_2.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace weft {
namespace internal {

/// The triangles of an OFF file.
template <class K>
Element_soup_2<K> read_planar_off(const std::string& filename)
{
  const Polygon_soup_3<K> polygons = read_off_surface<K>(filename);
  Element_soup_2<K> soup;
  soup.points = flattened<K>(filename, 0, polygons.points);
  for (std::size_t f = 0; f < polygons.polygons.size(); ++f) {
    const auto& p = polygons.polygons[f];
    if (p.size() != 3)
      throw File_error(filename, 0,
                       "facet " + std::to_string(f) + " has " + std::to_string(p.size()) + " corners, not 3");
    soup.triangles.push_back({p[0], p[1], p[2]});
  }
  return soup;
}

} // namespace internal

namespace IO {

/// Reads a planar mesh from a .msh (Gmsh 2 or 4.1, ASCII), .mesh (Medit), .vtu (VTK), .off or .ele (Triangle, with its
/// .node file and its .poly or .edge file) file. Tags of triangles become those of regions; lines and points, those of
/// edges and corners that stay. `notes` says what was left out. z must be the same everywhere.
/// \tparam K a CGAL kernel.
/// \throws File_error if the extension is unknown, or with the line if the file is missing, cut, malformed, not planar,
///   has other elements than triangles, lines and points, or if these don't make a mesh; see `assemble_mesh_2()`.
template <class K>
Imported_mesh_2<K> read_triangle_mesh(const std::string& filename)
{
  using namespace weft::internal;
  const std::string type = extension(filename);
  if (type == "ele" || type == "node") return read_triangle<K>(filename);
  if (type == "off") return assemble_from_file(filename, read_planar_off<K>(filename));
  const auto flat = [&](Element_soup_3<K> soup) {
    return assemble_from_file(filename, flattened<K>(filename, std::move(soup)));
  };
  if (type == "msh") return flat(Gmsh_reader_3<K>(filename).run());
  if (type == "mesh") return flat(Medit_reader_3<K>(filename, true).run());
  if (type == "vtu") return flat(Vtu_reader_3<K>(filename).run());
  throw File_error(filename, 0, "unknown extension; known are .msh, .mesh, .vtu, .off, .ele and .node");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_TRIANGLE_MESH_H
