// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extension of a file's name, by which readers and writers are chosen.

#ifndef WEFT_IO_INTERNAL_EXTENSION_H
#define WEFT_IO_INTERNAL_EXTENSION_H

#include <string>

namespace weft::internal {

/// Extension in lower case without its dot; empty if there is none.
inline std::string extension(const std::string& filename)
{
  const std::size_t dot = filename.find_last_of("./\\");
  if (dot == std::string::npos || filename[dot] != '.') return {};
  std::string result = filename.substr(dot + 1);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_EXTENSION_H
