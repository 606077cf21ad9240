// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the readers of labelled images share.

#ifndef WEFT_IO_INTERNAL_LABEL_VALUES_H
#define WEFT_IO_INTERNAL_LABEL_VALUES_H

#include <weft/errors.h>

#include <cmath>
#include <string>

namespace weft::internal {

/// A voxel's value as a label.
/// \throws File_error unless it is an integer that fits.
inline int label_value(const std::string& filename, double value)
{
  if (!(std::abs(value) < 2e9) || value != std::floor(value))
    throw File_error(filename, 0, "has voxels that aren't integers");
  return static_cast<int>(value);
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_LABEL_VALUES_H
