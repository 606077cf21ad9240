// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads labelled images: through CGAL's ImageIO INRIMAGE (.inr, .inr.gz if CGAL_USE_ZLIB is defined and zlib linked)
// and Analyze (.hdr and .img); through the NIfTI project's niftiio NIfTI-1 (.nii, .nii.gz, if WEFT_LINKED_WITH_NIFTI is
// defined and niftiio linked, Debian's package libnifti-dev). What isn't linked is refused when such a file comes.

#ifndef WEFT_IO_READ_LABEL_IMAGE_H
#define WEFT_IO_READ_LABEL_IMAGE_H

#include <weft/errors.h>
#include <weft/IO/internal/extension.h>
#include <weft/IO/internal/label_values.h>
#include <weft/IO/internal/read_image_voxels.h>
#include <weft/spatial/domain/Label_image_3.h>

#include <string>

namespace weft {
namespace IO {

/// Whether a file's extension says that it is an image.
inline bool is_label_image_filename(const std::string& filename)
{
  const std::string type = weft::internal::extension(filename);
  if (type == "gz") return is_label_image_filename(filename.substr(0, filename.size() - 3));
  return type == "inr" || type == "hdr" || type == "nii";
}

/// Reads an image whose voxels are integers, of whatever type, one component each. NIfTI images are placed where their
/// header says, as far as their axes are those of the scanner or reversed; others keep their own axes, from 0 on: there
/// lengths are right, places and directions aren't.
/// \throws File_error if the file is missing or malformed, its voxels aren't integers, or the library for it isn't
///   linked.
/// \throws Domain_error if it has no labels or too many.
inline Label_image_3 read_label_image(const std::string& filename)
{
  const auto voxels = weft::internal::read_image_voxels<int>(
      filename, [&](double value) { return weft::internal::label_value(filename, value); });
  return Label_image_3(voxels.size, voxels.spacing, voxels.origin, voxels.values);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_LABEL_IMAGE_H
