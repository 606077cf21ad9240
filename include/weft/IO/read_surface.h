// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a surface from a file; the extension says in which format.
//
// Readers of weft's own, not `CGAL::IO::read_polygon_soup()`: that one (5.5) takes an .obj file that ends in the middle
// of a facet and facets of points that don't exist, refuses .off files without a header line, and can't say which line
// is wrong or why.

#ifndef WEFT_IO_READ_SURFACE_H
#define WEFT_IO_READ_SURFACE_H

#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/read_ply_surface.h>
#include <weft/IO/internal/read_stl_surface.h>
#include <weft/IO/internal/surface_text_formats.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#ifdef WEFT_LINKED_WITH_LIB3MF
#include <weft/IO/internal/read_3mf_surface.h>
#endif

#include <CGAL/number_utils.h>

#include <cstddef>
#include <string>

namespace weft {
namespace internal {

template <class K>
Polygon_soup_3<K> read_any_surface(const std::string& filename)
{
  const std::string type = extension(filename);
  if (type == "off") return read_off_surface<K>(filename);
  if (type == "obj") return read_obj_surface<K>(filename);
  if (type == "stl") return read_stl_surface<K>(filename);
  if (type == "ply") return read_ply_surface<K>(filename);
  if (type == "3mf") {
#ifdef WEFT_LINKED_WITH_LIB3MF
    return read_3mf_surface<K>(filename);
#else
    throw File_error(filename, 0, "3MF files are read only by programs that were built where lib3mf is installed");
#endif
  }
  throw File_error(filename, 0, "unknown extension; known are .off, .obj, .stl and .ply");
}

} // namespace internal

namespace IO {

/// Reads a surface from a .off or .obj file (text), a .stl or .ply file (text or binary), or a .3mf file, if
/// WEFT_LINKED_WITH_LIB3MF is defined and lib3MF linked. Points and facets are numbered as in the file; only in .stl
/// files, where every facet has its own corners, equal points become one. Solids of .stl and .3mf files, objects,
/// groups or materials of .obj files, and colours of facets in .off and .ply files are the surface's groups.
/// Whether the facets form a surface is checked by `piecewise_smooth_complex()`, not here.
/// \tparam K a CGAL kernel.
/// \throws File_error if the extension is unknown or the file is missing, cut or malformed, has no facets, or has
///         coordinates that aren't finite; with the line where that is known.
template <class K>
Polygon_soup_3<K> read_surface(const std::string& filename)
{
  Polygon_soup_3<K> soup = weft::internal::read_any_surface<K>(filename);
  if (soup.polygons.empty()) throw File_error(filename, 0, "there are no facets in the file");
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const auto& p = soup.points[v];
    if (!CGAL::is_finite(p.x()) || !CGAL::is_finite(p.y()) || !CGAL::is_finite(p.z()))
      throw File_error(filename, 0, "point " + std::to_string(v) + " has coordinates that aren't finite");
  }
  return soup;
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_SURFACE_H
