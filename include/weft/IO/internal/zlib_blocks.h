// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes compressed by zlib as .vtu files have them: in blocks, after a header that says how many there are, how long
// they are when they aren't compressed, how long the last is then, and how long each is now.

#ifndef WEFT_IO_INTERNAL_ZLIB_BLOCKS_H
#define WEFT_IO_INTERNAL_ZLIB_BLOCKS_H

namespace weft::internal {

#ifdef WEFT_LINKED_WITH_ZLIB
inline constexpr bool has_zlib = true;
#else
inline constexpr bool has_zlib = false;
#endif

} // namespace weft::internal

#ifdef WEFT_LINKED_WITH_ZLIB

#include <weft/internal/cold.h>

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::internal {

/// \param header gets the header's numbers.
/// \returns the compressed blocks, one after the other.
WEFT_COLD inline std::string compressed_blocks(const std::string& bytes, std::vector<std::uint64_t>& header)
{
  constexpr std::size_t block_size = std::size_t(1) << 20;
  const std::size_t blocks = (bytes.size() + block_size - 1) / block_size;
  header = {blocks, block_size, bytes.size() % block_size};
  std::string result, block;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * block_size, size = (std::min)(block_size, bytes.size() - begin);
    uLongf length = compressBound(static_cast<uLong>(size));
    block.resize(length);
    // With that much room it fails for want of memory only.
    if (compress2(reinterpret_cast<Bytef*>(block.data()), &length, reinterpret_cast<const Bytef*>(bytes.data() + begin),
                  static_cast<uLong>(size), Z_BEST_SPEED) != Z_OK)
      throw std::bad_alloc();
    header.push_back(length);
    result.append(block, 0, length);
  }
  return result;
}

/// One block as it was. Nothing if it isn't `size` bytes compressed by zlib.
WEFT_COLD inline std::optional<std::string> decompressed_block(std::string_view block, std::size_t size)
{
  std::string result(size, '\0');
  uLongf length = static_cast<uLongf>(size);
  if (uncompress(reinterpret_cast<Bytef*>(result.data()), &length, reinterpret_cast<const Bytef*>(block.data()),
                 static_cast<uLong>(block.size())) != Z_OK ||
      length != size)
    return std::nullopt;
  return result;
}

} // namespace weft::internal

#endif // WEFT_LINKED_WITH_ZLIB

#endif // WEFT_IO_INTERNAL_ZLIB_BLOCKS_H
