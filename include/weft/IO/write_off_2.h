// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a planar mesh as an OFF file: points with z = 0 and counterclockwise triangles. OFF has no room for tags.

#ifndef WEFT_IO_WRITE_OFF_2_H
#define WEFT_IO_WRITE_OFF_2_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Indexed_mesh_2.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/write_off_3.h> // the overload for spatial meshes

#include <string>

namespace weft {
namespace IO {

/// Writes the faces in the domain as an OFF file.
/// \throws File_error if the file can't be written.
template <class Cdt>
WEFT_COLD void write_off(const std::string& filename, const Cdt& cdt)
{
  const internal::Indexed_mesh_2 mesh = internal::indexed_mesh(cdt, {});
  internal::Text_writer out(filename);
  out << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const auto& p : mesh.points) out << p[0] << ' ' << p[1] << " 0\n";
  for (const auto& triangle : mesh.triangles) {
    out << '3';
    for (const std::size_t v : triangle.vertices) out << ' ' << v;
    out << '\n';
  }
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_OFF_2_H
