// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images in the format NIfTI-1 (.nii, .nii.gz), read by the NIfTI project's own library niftiio. Programs that
// link it say so by WEFT_LINKED_WITH_NIFTI; without it such files are refused.

#ifndef WEFT_IO_INTERNAL_NIFTI_IMAGE_H
#define WEFT_IO_INTERNAL_NIFTI_IMAGE_H

#include <weft/errors.h>
#include <weft/IO/internal/Image_voxels.h>

#ifdef WEFT_LINKED_WITH_NIFTI
#include <nifti1_io.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace weft::internal {

#ifdef WEFT_LINKED_WITH_NIFTI

struct Free_nifti_image
{
  void operator()(nifti_image* image) const { nifti_image_free(image); }
};

struct Nifti_file
{
  std::unique_ptr<nifti_image, Free_nifti_image> image; ///< the header
  std::vector<char> bytes;                              ///< of the voxels
};

/// Header and voxels. Not by `nifti_image_load()`, which takes what a cut file lacks, and numbers that aren't, for 0.
inline Nifti_file read_nifti_file(const std::string& filename)
{
  nifti_set_debug_level(0); // else the library prints
  Nifti_file file;
  file.image.reset(nifti_image_read(filename.c_str(), 0));
  const nifti_image* const image = file.image.get();
  if (image == nullptr || image->nvox == 0 || image->nbyper <= 0 || image->iname_offset < 0)
    throw File_error(filename, 0, "isn't a NIfTI image that can be read");
  znzFile in = znzopen(image->iname, "rb", nifti_is_gzfile(image->iname));
  if (in == nullptr) throw File_error(filename, 0, std::string("needs ") + image->iname + ", which can't be opened");
  znzseek(in, static_cast<long>(image->iname_offset), SEEK_SET);
  // In parts, so that a header that promises too much costs no memory.
  constexpr std::size_t most_at_once = std::size_t(1) << 20;
  std::size_t left = image->nvox * static_cast<std::size_t>(image->nbyper), got = 1;
  for (; left > 0 && got > 0; left -= got) {
    const std::size_t before = file.bytes.size(), part = (std::min)(left, most_at_once);
    file.bytes.resize(before + part);
    got = znzread(file.bytes.data() + before, 1, part, in);
    if (got > part) got = 0; // an error of zlib
    file.bytes.resize(before + got);
  }
  znzclose(in);
  if (left > 0) throw File_error(filename, 0, "ends before all voxels");
  if (image->swapsize > 1 && image->byteorder != nifti_short_order())
    nifti_swap_Nbytes(file.bytes.size() / static_cast<std::size_t>(image->swapsize), image->swapsize,
                      file.bytes.data());
  return file;
}

template <class Number>
std::vector<double> nifti_values_of(const Nifti_file& file)
{
  std::vector<double> result(file.image->nvox);
  const char* at = file.bytes.data();
  for (double& value : result) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    value = static_cast<double>(number);
    at += sizeof number;
  }
  return result;
}

inline std::vector<double> nifti_values(const std::string& filename, const Nifti_file& file)
{
  switch (file.image->datatype) {
  case DT_UINT8:
    return nifti_values_of<std::uint8_t>(file);
  case DT_INT8:
    return nifti_values_of<std::int8_t>(file);
  case DT_UINT16:
    return nifti_values_of<std::uint16_t>(file);
  case DT_INT16:
    return nifti_values_of<std::int16_t>(file);
  case DT_UINT32:
    return nifti_values_of<std::uint32_t>(file);
  case DT_INT32:
    return nifti_values_of<std::int32_t>(file);
  case DT_UINT64:
    return nifti_values_of<std::uint64_t>(file);
  case DT_INT64:
    return nifti_values_of<std::int64_t>(file);
  case DT_FLOAT32:
    return nifti_values_of<float>(file);
  case DT_FLOAT64:
    return nifti_values_of<double>(file);
  default:
    throw File_error(filename, 0,
                     std::string("has voxels of the type ") + nifti_datatype_string(file.image->datatype) +
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
template <class Number, class Convert>
Image_voxels<Number> read_nifti(const std::string& filename, const Convert& convert)
{
  const Nifti_file file = read_nifti_file(filename);
  const nifti_image* const image = file.image.get();
  const std::array<std::size_t, 3> size{
      {static_cast<std::size_t>(image->nx), static_cast<std::size_t>(image->ny), static_cast<std::size_t>(image->nz)}};
  if (image->nvox != size[0] * size[1] * size[2]) throw File_error(filename, 0, "has several values per voxel");
  std::vector<double> values = nifti_values(filename, file);
  if (image->scl_slope != 0)
    for (double& v : values) v = image->scl_slope * v + image->scl_inter;
  const std::array<double, 3> spacing{{std::abs(image->dx), std::abs(image->dy), std::abs(image->dz)}};
  Nifti_frame frame = nifti_frame(*image);
  for (std::size_t k = 0; k < 3; ++k)
    if (frame.falls[k]) frame.origin[k] -= static_cast<double>(size[k] - 1) * spacing[k];
  Image_voxels<Number> voxels{size, spacing, frame.origin, {}};
  voxels.values.reserve(values.size());
  const auto place = [&](std::size_t i, std::size_t k) { return frame.falls[k] ? size[k] - 1 - i : i; };
  for (std::size_t z = 0; z < size[2]; ++z)
    for (std::size_t y = 0; y < size[1]; ++y)
      for (std::size_t x = 0; x < size[0]; ++x)
        voxels.values.push_back(convert(values[(place(z, 2) * size[1] + place(y, 1)) * size[0] + place(x, 0)]));
  return voxels;
}

#else

template <class Number, class Convert>
Image_voxels<Number> read_nifti(const std::string& filename, const Convert&)
{
  throw File_error(filename, 0, "NIfTI images can't be read: this program was built without the library niftiio");
}

#endif

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_NIFTI_IMAGE_H
