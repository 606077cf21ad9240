// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a sizing field in the plane: sizes at the vertices of a triangle mesh, .vtu (a point array), .msh ($NodeData)
// or .mesh with a .sol beside it.

#ifndef WEFT_IO_READ_SIZING_2_H
#define WEFT_IO_READ_SIZING_2_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/read_solution.h>
#include <weft/IO/read_triangle_mesh.h>
#include <weft/planar/mesh/from_triangulation_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/sizing/Background_sizing_2.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace weft {
namespace IO {

/// Reads a sizing field. Between vertices it is linear on their constrained Delaunay triangulation with the mesh's
/// boundary, and outside that of the nearest point of the hull.
/// \param array name of the point data; empty for that called `size`, or the only one.
/// \throws File_error if a file is missing, malformed, not planar, or doesn't have such an array; Option_error for
/// sizes
///   that aren't positive.
template <class K>
Background_sizing_2<K> read_sizing_2(const std::string& filename, const std::string& array = std::string())
{
  const bool is_solution = weft::internal::extension(filename) == "sol";
  const std::string mesh_name = is_solution ? filename.substr(0, filename.size() - 3) + "mesh" : filename;
  const auto background = read_triangle_mesh<K>(mesh_name);
  const std::vector<double> values = read_solution(filename, array);
  std::map<typename K::Point_2, double> sizes;
  for (std::size_t v = 0; v < background.mesh.points.size(); ++v) {
    const std::size_t origin = background.point_origin[v];
    if (origin >= values.size())
      throw File_error(filename, 0, "has sizes at " + std::to_string(values.size()) + " points, but more points");
    sizes.emplace(background.mesh.points[v], values[origin]);
  }
  Mesh_triangulation_2<K> cdt;
  fill_triangulation_2(cdt, background.mesh, [](auto, int) {});
  return Background_sizing_2<K>(cdt, [&](auto vertex) { return sizes.at(vertex->point()); });
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_SIZING_2_H
