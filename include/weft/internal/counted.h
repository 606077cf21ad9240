// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers of things in sentences.

#ifndef WEFT_INTERNAL_COUNTED_H
#define WEFT_INTERNAL_COUNTED_H

#include <weft/internal/cold.h>

#include <cstddef>
#include <string>

namespace weft::internal {

/// "1 triangle", "2 triangles".
WEFT_COLD inline std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_COUNTED_H
