// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads labelled images through CGAL's ImageIO: INRIMAGE (.inr, .inr.gz if CGAL_USE_ZLIB is defined and zlib linked)
// and Analyze or NIfTI-like pairs (.hdr and .img).

#ifndef WEFT_IO_READ_LABEL_IMAGE_H
#define WEFT_IO_READ_LABEL_IMAGE_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/spatial/Label_image_3.h>

#include <CGAL/Image_3.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace weft {
namespace IO {

/// Whether a file's extension says that it is an image.
inline bool is_label_image_filename(const std::string& filename)
{
  const std::string type = weft::internal::extension(filename);
  if (type == "gz") return is_label_image_filename(filename.substr(0, filename.size() - 3));
  return type == "inr" || type == "hdr";
}

/// Reads an image whose voxels are integers, one component each.
/// \throws File_error if the file is missing or malformed, or its voxels aren't integers.
/// \throws Domain_error if it has no labels or too many.
inline Label_image_3 read_label_image(const std::string& filename)
{
  if (!std::ifstream(filename)) throw File_error(filename, 0, "can't be opened"); // CGAL would print
  CGAL::Image_3 image;
  if (!image.read(filename)) throw File_error(filename, 0, "isn't an image that can be read");
  const std::size_t nx = image.xdim(), ny = image.ydim(), nz = image.zdim();
  const auto* data = image.image();
  if (data->vdim != 1) throw File_error(filename, 0, "has several values per voxel");
  std::vector<int> values;
  values.reserve(nx * ny * nz);
  for (std::size_t z = 0; z < nz; ++z)
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t x = 0; x < nx; ++x) {
        const double value = image.value(x, y, z);
        if (!(std::abs(value) < 2e9) || value != std::floor(value))
          throw File_error(filename, 0, "has voxels that aren't integers");
        values.push_back(static_cast<int>(value));
      }
  return Label_image_3({{nx, ny, nz}}, {{image.vx(), image.vy(), image.vz()}}, {{image.tx(), image.ty(), image.tz()}},
                       values);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_LABEL_IMAGE_H
