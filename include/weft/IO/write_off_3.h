// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the boundary of a spatial mesh as an OFF file. OFF has no room for tags.

#ifndef WEFT_IO_WRITE_OFF_3_H
#define WEFT_IO_WRITE_OFF_3_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Boundary_3.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <string>

namespace weft {
namespace IO {

/// Writes the boundary facets, counterclockwise seen from outside, and their vertices as an OFF file.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_off(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh)
{
  const internal::Boundary_3 boundary = internal::boundary_of(mesh);
  internal::Text_writer out(filename);
  out << "OFF\n" << boundary.points.size() << ' ' << boundary.triangles.size() << " 0\n";
  for (const auto& p : boundary.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& t : boundary.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_OFF_3_H
