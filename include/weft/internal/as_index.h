// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL counts vertices, edges and corners of a face or cell in int, and so do the numbers that weft gives them, where
// -1 means none; containers count in std::size_t. This is the one place where the former become the latter.

#ifndef WEFT_INTERNAL_AS_INDEX_H
#define WEFT_INTERNAL_AS_INDEX_H

#include <cstddef>

namespace weft::internal {

/// \param i at least 0.
constexpr std::size_t as_index(int i)
{
  return static_cast<std::size_t>(i);
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_AS_INDEX_H
