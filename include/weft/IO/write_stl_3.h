// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the boundary of a spatial mesh as a binary STL file (3D Systems, "Stereolithography interface specification",
// 1989). STL holds single precision only and repeats the vertices for each triangle: a reader that joins equal points
// gets the same surface back unless the mesh lies far from the origin compared with its edges. It has no room for tags.

#ifndef WEFT_IO_WRITE_STL_3_H
#define WEFT_IO_WRITE_STL_3_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Boundary_3.h>
#include <weft/IO/internal/little_endian.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace weft {
namespace internal {

/// Unit normal by the right-hand rule; zero for a degenerate triangle, as the format allows.
inline Xyz_3 unit_normal(const Xyz_3& a, const Xyz_3& b, const Xyz_3& c)
{
  Xyz_3 normal = cross_product(minus(b, a), minus(c, a));
  const double size = std::hypot(normal[0], normal[1], normal[2]);
  for (double& x : normal) x = size > 0 ? x / size : 0;
  return normal;
}

} // namespace internal

namespace IO {

/// Writes the boundary facets as a binary STL file, counterclockwise seen from outside.
/// \throws File_error if the file can't be written.
template <class K>
WEFT_COLD void write_stl(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh)
{
  const internal::Boundary_3 boundary = internal::boundary_of(mesh);
  if (boundary.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw File_error(filename, 0, "STL can't hold so many facets");
  std::string head = "weft: boundary of a tetrahedral mesh"; // must not begin with "solid", as the text form does
  head.resize(80, ' ');
  internal::append_little_endian(head, static_cast<std::uint32_t>(boundary.triangles.size()));
  internal::Text_writer out(filename);
  out << head;
  std::string record;
  for (const auto& t : boundary.triangles) {
    const auto &a = boundary.points[t[0]], &b = boundary.points[t[1]], &c = boundary.points[t[2]];
    record.clear();
    for (const auto& triple : {internal::unit_normal(a, b, c), a, b, c})
      for (const double x : triple) internal::append_little_endian(record, static_cast<float>(x));
    internal::append_little_endian(record, std::uint16_t(0)); // attributes
    out << record;
  }
  out.close();
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_STL_3_H
