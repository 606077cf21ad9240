// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads images through CGAL's ImageIO and the NIfTI project's niftiio; see read_label_image.h for the formats.

#ifndef WEFT_IO_INTERNAL_READ_IMAGE_VOXELS_H
#define WEFT_IO_INTERNAL_READ_IMAGE_VOXELS_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/Image_voxels.h>
#include <weft/IO/internal/nifti_image.h>

#include <CGAL/Image_3.h>

#include <cstddef>
#include <fstream>
#include <string>

namespace weft::internal {

/// \param convert makes a Number of a voxel's value, a double.
/// \throws File_error if the file is missing or malformed or the library for it isn't linked.
template <class Number, class Convert>
Image_voxels<Number> read_image_voxels(const std::string& filename, const Convert& convert)
{
  if (!std::ifstream(filename)) throw File_error(filename, 0, "can't be opened"); // CGAL would print
  const std::string type = extension(filename);
  if ((type == "gz" ? extension(filename.substr(0, filename.size() - 3)) : type) == "nii")
    return read_nifti<Number>(filename, convert);
  CGAL::Image_3 image;
  if (!image.read(filename)) throw File_error(filename, 0, "isn't an image that can be read");
  if (image.image()->vdim != 1) throw File_error(filename, 0, "has several values per voxel");
  Image_voxels<Number> voxels;
  voxels.size = {{image.xdim(), image.ydim(), image.zdim()}};
  voxels.spacing = {{image.vx(), image.vy(), image.vz()}};
  voxels.origin = {{image.tx(), image.ty(), image.tz()}};
  voxels.values.reserve(voxels.size[0] * voxels.size[1] * voxels.size[2]);
  for (std::size_t z = 0; z < voxels.size[2]; ++z)
    for (std::size_t y = 0; y < voxels.size[1]; ++y)
      for (std::size_t x = 0; x < voxels.size[0]; ++x)
        voxels.values.push_back(convert(static_cast<double>(image.value(x, y, z))));
  return voxels;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_READ_IMAGE_VOXELS_H
