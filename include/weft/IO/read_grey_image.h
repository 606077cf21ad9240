// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads images of grey values or signed distances, from the files that read_label_image.h names.

#ifndef WEFT_IO_READ_GREY_IMAGE_H
#define WEFT_IO_READ_GREY_IMAGE_H

#include <weft/errors.h>
#include <weft/IO/internal/read_image_voxels.h>
#include <weft/spatial/domain/Grey_image_3.h>

#include <string>
#include <utility>

namespace weft {
namespace IO {

/// Reads an image whose voxels are numbers of whatever type, one component each.
/// \param iso the value on the boundary of the domain.
/// \throws File_error if the file is missing or malformed, or the library for it isn't linked.
/// \throws Domain_error if values aren't numbers, or no voxel lies in the domain.
inline Grey_image_3 read_grey_image(const std::string& filename, double iso, Iso_side side = Iso_side::away_from_border)
{
  auto voxels =
      weft::internal::read_image_voxels<float>(filename, [](double value) { return static_cast<float>(value); });
  return Grey_image_3(voxels.size, voxels.spacing, voxels.origin, std::move(voxels.values), iso, side);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_GREY_IMAGE_H
