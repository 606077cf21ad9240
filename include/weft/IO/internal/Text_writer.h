// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all of weft's text writers share. Numbers don't depend on the locale and are written with as many digits as it
// takes (17 at most) to read the same double back.

#ifndef WEFT_IO_INTERNAL_TEXT_WRITER_H
#define WEFT_IO_INTERNAL_TEXT_WRITER_H

#include <weft/errors.h>
#include <weft/internal/cold.h>

#include <charconv>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <type_traits>

namespace weft::internal {

/// Writes text to a file; `close()` tells whether all of it arrived.
class Text_writer
{
public:
  /// \throws File_error if the file can't be opened for writing.
  WEFT_COLD explicit Text_writer(const std::string& filename) : filename_(filename), out_(filename, std::ios::binary)
  {
    if (!out_) throw File_error(filename, 0, "can't be opened for writing");
  }

  WEFT_NOINLINE Text_writer& operator<<(std::string_view text)
  {
    buffer_ += text;
    if (buffer_.size() > flush_size) flush();
    return *this;
  }

  WEFT_NOINLINE Text_writer& operator<<(char c) { return *this << std::string_view(&c, 1); }

  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
  WEFT_NOINLINE Text_writer& operator<<(Number value)
  {
    char digits[40];
    const auto result = std::to_chars(digits, digits + sizeof digits, value);
    return *this << std::string_view(digits, static_cast<std::size_t>(result.ptr - digits));
  }

  /// A number for pictures: `decimals` digits after the point.
  WEFT_NOINLINE Text_writer& fixed(double value, int decimals)
  {
    char digits[400]; // the largest double has 309 digits before the point
    const auto result = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals);
    return *this << std::string_view(digits, static_cast<std::size_t>(result.ptr - digits));
  }

  /// Call at the end.
  /// \throws File_error if anything could not be written, for instance because the disk is full.
  WEFT_COLD void close()
  {
    flush();
    out_.close();
    if (!out_) throw File_error(filename_, 0, "writing failed; is the disk full?");
  }

private:
  static constexpr std::size_t flush_size = std::size_t(1) << 20;

  void flush()
  {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::string filename_;
  std::ofstream out_;
  std::string buffer_;
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_TEXT_WRITER_H
