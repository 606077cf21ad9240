// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a planar straight line graph from a file; the extension says in which format.

#ifndef WEFT_IO_READ_PSLG_H
#define WEFT_IO_READ_PSLG_H

#include <weft/IO/internal/extension.h>
#include <weft/IO/read_edg.h>
#include <weft/IO/read_obj_graph.h>
#include <weft/IO/read_poly.h>

#include <string>

namespace weft {
namespace IO {

/// Reads Triangle's .poly or .node, CGAL's .edg, or the lines of a .obj.
/// \tparam K a CGAL kernel.
/// \throws File_error if the extension is unknown or the file is missing, cut or malformed.
template <class K>
Pslg_2<K> read_pslg(const std::string& filename)
{
  const std::string extension = internal::extension(filename);
  if (extension == "poly") return read_poly<K>(filename);
  if (extension == "node") return read_node<K>(filename);
  if (extension == "edg") return read_edg<K>(filename);
  if (extension == "obj") return read_obj_graph<K>(filename);
  throw File_error(filename, 0, "unknown extension; known are .poly, .node, .edg and .obj");
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_PSLG_H
