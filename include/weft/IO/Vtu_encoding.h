// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the numbers of .vtu files are written.

#ifndef WEFT_IO_VTU_ENCODING_H
#define WEFT_IO_VTU_ENCODING_H

namespace weft {

/// How the numbers of a .vtu file are written. All of them are read back exactly.
enum class Vtu_encoding
{
  ascii,
  binary,    ///< base64
  compressed ///< by zlib, then base64; as `binary` where weft isn't compiled with WEFT_LINKED_WITH_ZLIB
};

} // namespace weft

#endif // WEFT_IO_VTU_ENCODING_H
