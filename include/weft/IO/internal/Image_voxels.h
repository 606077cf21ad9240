// SPDX-License-Identifier: GPL-3.0-or-later
//
// The voxels of an image as a file has them: what readers of labels and of grey values share.

#ifndef WEFT_IO_INTERNAL_IMAGE_VOXELS_H
#define WEFT_IO_INTERNAL_IMAGE_VOXELS_H

#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// \tparam Number of a voxel.
template <class Number>
struct Image_voxels
{
  std::array<std::size_t, 3> size{{0, 0, 0}};
  std::array<double, 3> spacing{{1, 1, 1}}; ///< of the centers of voxels
  std::array<double, 3> origin{{0, 0, 0}};  ///< center of the first voxel
  std::vector<Number> values;               ///< x running fastest
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_IMAGE_VOXELS_H
