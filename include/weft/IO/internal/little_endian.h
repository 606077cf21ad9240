// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as binary files have them.

#ifndef WEFT_IO_INTERNAL_LITTLE_ENDIAN_H
#define WEFT_IO_INTERNAL_LITTLE_ENDIAN_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace weft::internal {

/// Appends the bytes of a number, lowest first on every machine.
/// \tparam Number of 1, 2, 4 or 8 bytes; a float or double is one of IEEE 754.
template <class Number>
void append_little_endian(std::string& bytes, Number number)
{
  constexpr std::size_t size = sizeof(Number);
  static_assert(std::is_integral_v<Number> || std::numeric_limits<Number>::is_iec559);
  std::conditional_t<
      size == 8, std::uint64_t,
      std::conditional_t<size == 4, std::uint32_t, std::conditional_t<size == 2, std::uint16_t, std::uint8_t>>>
      bits;
  static_assert(sizeof bits == size);
  std::memcpy(&bits, &number, size);
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_LITTLE_ENDIAN_H
