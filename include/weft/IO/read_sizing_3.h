// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a sizing field in space: sizes at the vertices of a tetrahedral mesh, .vtu (a point array), .msh ($NodeData) or
// .mesh with a .sol beside it, or an image of sizes, .inr, .hdr or .nii, compressed or not.

#ifndef WEFT_IO_READ_SIZING_3_H
#define WEFT_IO_READ_SIZING_3_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/read_image_voxels.h>
#include <weft/IO/read_solution.h>
#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/sizing/Grid_sizing.h>
#include <weft/spatial/sizing/Background_sizing_3.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace IO {

/// Reads a sizing field; all such are of one type.
/// \param array name of the point data; empty for that called `size`, or the only one.
/// \returns a field that owns its data and is safe to read from many threads: Background_sizing_3 or Grid_sizing_3.
/// \throws File_error if a file is missing, malformed or doesn't have such an array; Option_error for sizes that aren't
///   positive.
template <class K>
std::function<double(const typename K::Point_3&)> read_sizing_3(const std::string& filename,
                                                                const std::string& array = std::string())
{
  const std::string type = weft::internal::extension(filename);
  if (type == "inr" || type == "hdr" || type == "nii" || type == "gz") {
    auto voxels = weft::internal::read_image_voxels<double>(filename, [](double value) { return value; });
    return Grid_sizing_3(voxels.size, voxels.spacing, voxels.origin, std::move(voxels.values));
  }
  const bool is_solution = type == "sol";
  const std::string mesh_name = is_solution ? filename.substr(0, filename.size() - 3) + "mesh" : filename;
  const auto background = read_tetrahedral_mesh<K>(mesh_name);
  const std::vector<double> values = read_solution(filename, array);
  std::vector<double> sizes;
  for (const std::size_t v : background.point_origin) {
    if (v >= values.size())
      throw File_error(filename, 0, "has sizes at " + std::to_string(values.size()) + " points, but more points");
    sizes.push_back(values[v]);
  }
  return Background_sizing_3<K>(background.mesh, std::move(sizes));
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_SIZING_3_H
