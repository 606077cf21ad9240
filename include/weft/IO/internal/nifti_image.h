// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labelled images in the format NIfTI-1 (.nii, .nii.gz), read by the NIfTI project's own library niftiio. Programs that
// link it say so by WEFT_LINKED_WITH_NIFTI; without it such files are refused.

#ifndef WEFT_IO_INTERNAL_NIFTI_IMAGE_H
#define WEFT_IO_INTERNAL_NIFTI_IMAGE_H

#include <weft/errors.h>
#include <weft/IO/internal/label_values.h>
#include <weft/spatial/Label_image_3.h>

#ifdef WEFT_LINKED_WITH_NIFTI
#include <nifti1_io.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace weft {
namespace internal {

#ifdef WEFT_LINKED_WITH_NIFTI

struct Free_nifti_image
{
  void operator()(nifti_image* image) const { nifti_image_free(image); }
};

template <class Number>
std::vector<double> nifti_values_of(const nifti_image& image)
{
  std::vector<double> result(image.nvox);
  const char* at = static_cast<const char*>(image.data);
  for (double& value : result) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    value = static_cast<double>(number);
    at += sizeof number;
  }
  return result;
}

inline std::vector<double> nifti_values(const std::string& filename, const nifti_image& image)
{
  switch (image.datatype) {
  case DT_UINT8:
    return nifti_values_of<std::uint8_t>(image);
  case DT_INT8:
    return nifti_values_of<std::int8_t>(image);
  case DT_UINT16:
    return nifti_values_of<std::uint16_t>(image);
  case DT_INT16:
    return nifti_values_of<std::int16_t>(image);
  case DT_UINT32:
    return nifti_values_of<std::uint32_t>(image);
  case DT_INT32:
    return nifti_values_of<std::int32_t>(image);
  case DT_UINT64:
    return nifti_values_of<std::uint64_t>(image);
  case DT_INT64:
    return nifti_values_of<std::int64_t>(image);
  case DT_FLOAT32:
    return nifti_values_of<float>(image);
  case DT_FLOAT64:
    return nifti_values_of<double>(image);
  default:
    throw File_error(filename, 0,
                     std::string("has voxels of the type ") + nifti_datatype_string(image.datatype) +
                         ", not single numbers");
  }
}

/// The first voxel's centre, and along which axes coordinates fall; nothing but zeros where axes are turned.
struct Nifti_frame
{
  std::array<double, 3> origin{{0, 0, 0}};
  std::array<bool, 3> falls{{false, false, false}};
};

inline Nifti_frame nifti_frame(const nifti_image& image)
{
  if (image.sform_code <= 0 && image.qform_code <= 0) return {};
  const mat44& m = image.sform_code > 0 ? image.sto_xyz : image.qto_xyz;
  Nifti_frame frame;
  for (int k = 0; k < 3; ++k) {
    const double along = static_cast<double>(m.m[k][k]);
    for (int j = 0; j < 3; ++j)
      if (j != k && std::abs(m.m[k][j]) > 1e-4 * std::abs(along)) return {};
    frame.falls[static_cast<std::size_t>(k)] = along < 0;
    frame.origin[static_cast<std::size_t>(k)] = m.m[k][3];
  }
  return frame;
}

/// The image in scanner coordinates where its axes are theirs, perhaps reversed; else in its own, from 0.
inline Label_image_3 read_nifti(const std::string& filename)
{
  nifti_set_debug_level(0); // else the library prints
  const std::unique_ptr<nifti_image, Free_nifti_image> image(nifti_image_read(filename.c_str(), 1));
  if (!image || image->data == nullptr) throw File_error(filename, 0, "isn't a NIfTI image that can be read");
  const std::array<std::size_t, 3> size{
      {static_cast<std::size_t>(image->nx), static_cast<std::size_t>(image->ny), static_cast<std::size_t>(image->nz)}};
  if (image->nvox != size[0] * size[1] * size[2]) throw File_error(filename, 0, "has several values per voxel");
  std::vector<double> values = nifti_values(filename, *image);
  if (image->scl_slope != 0)
    for (double& v : values) v = image->scl_slope * v + image->scl_inter;
  const std::array<double, 3> spacing{{std::abs(image->dx), std::abs(image->dy), std::abs(image->dz)}};
  Nifti_frame frame = nifti_frame(*image);
  for (std::size_t k = 0; k < 3; ++k)
    if (frame.falls[k]) frame.origin[k] -= static_cast<double>(size[k] - 1) * spacing[k];
  std::vector<int> labels;
  labels.reserve(values.size());
  const auto place = [&](std::size_t i, std::size_t k) { return frame.falls[k] ? size[k] - 1 - i : i; };
  for (std::size_t z = 0; z < size[2]; ++z)
    for (std::size_t y = 0; y < size[1]; ++y)
      for (std::size_t x = 0; x < size[0]; ++x)
        labels.push_back(label_value(filename, values[(place(z, 2) * size[1] + place(y, 1)) * size[0] + place(x, 0)]));
  return Label_image_3(size, spacing, frame.origin, labels);
}

#else

inline Label_image_3 read_nifti(const std::string& filename)
{
  throw File_error(filename, 0, "NIfTI images can't be read: this program was built without the library niftiio");
}

#endif

} // namespace internal
} // namespace weft

#endif // WEFT_IO_INTERNAL_NIFTI_IMAGE_H
