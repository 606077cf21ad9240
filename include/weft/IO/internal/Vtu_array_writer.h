// SPDX-License-Identifier: GPL-3.0-or-later
//
// The data arrays of .vtu files, shared by the planar and the spatial writer: as text or in base64, plain or
// compressed.

#ifndef WEFT_IO_INTERNAL_VTU_ARRAY_WRITER_H
#define WEFT_IO_INTERNAL_VTU_ARRAY_WRITER_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/little_endian.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/IO/internal/zlib_blocks.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace weft::internal {

/// Writes arrays one after the other: `begin()`, the numbers, `end()`. Numbers are written lowest byte first on every
/// machine.
class Vtu_array_writer
{
public:
  /// \param is_text or in base64.
  /// \param is_compressed where weft is compiled with zlib.
  Vtu_array_writer(Text_writer& out, bool is_text, bool is_compressed)
      : out_(out), is_text_(is_text), is_compressed_(is_compressed && has_zlib)
  {}

  Text_writer& out() { return out_; }

  /// The file's first lines, up to and with the tag of the grid.
  WEFT_COLD void write_head()
  {
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\""
         << " header_type=\"UInt64\"" << (is_compressed_ ? " compressor=\"vtkZLibDataCompressor\"" : "")
         << ">\n  <UnstructuredGrid>\n";
  }

  /// \tparam Number in which the numbers are stored.
  /// \param components of each tuple, a line of text; 1 isn't written down.
  template <class Number>
  WEFT_COLD void begin(const std::string& name, std::size_t components = 1)
  {
    const char* type = std::is_same_v<Number, double>         ? "Float64"
                       : std::is_same_v<Number, std::int32_t> ? "Int32"
                       : std::is_same_v<Number, std::int64_t> ? "Int64"
                                                              : "UInt8";
    out_ << "        <DataArray type=\"" << type << "\" Name=\"" << name << '"';
    if (components > 1) out_ << " NumberOfComponents=\"" << components << '"';
    out_ << " format=\"" << (is_text_ ? "ascii" : "binary") << "\">\n";
  }

  /// Numbers of one type, a line of text.
  template <class Number, class Range>
  WEFT_NOINLINE void row(const Range& numbers)
  {
    const char* separator = "";
    for (const auto& x : numbers) {
      if (is_text_) {
        out_ << separator << x;
        separator = " ";
      } else {
        append_little_endian(bytes_, static_cast<Number>(x));
      }
    }
    if (is_text_) out_ << '\n';
  }
  template <class Number>
  void row_of_one(Number number)
  {
    row<Number>(std::array<Number, 1>{number});
  }

  WEFT_COLD void end()
  {
    if (!is_text_) flush();
    out_ << "        </DataArray>\n";
  }

private:
  /// Of plain arrays the header and the numbers are one run of base64, of compressed ones two.
  void flush()
  {
    std::string numbers;
    numbers.swap(bytes_);
#ifdef WEFT_LINKED_WITH_ZLIB
    if (is_compressed_) {
      std::vector<std::uint64_t> header;
      const std::string blocks = compressed_blocks(numbers, header);
      for (const std::uint64_t x : header) append_little_endian(bytes_, x);
      write_base64(bytes_);
      write_base64(blocks);
      out_ << '\n';
      bytes_.clear();
      return;
    }
#endif
    append_little_endian(bytes_, static_cast<std::uint64_t>(numbers.size()));
    bytes_ += numbers;
    write_base64(bytes_);
    out_ << '\n';
    bytes_.clear();
  }

  WEFT_COLD void write_base64(std::string_view bytes)
  {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [bytes](std::size_t i) {
      return i < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) : 0u;
    };
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
      text += digits[bits >> 18];
      text += digits[bits >> 12 & 63];
      text += i + 1 < bytes.size() ? digits[bits >> 6 & 63] : '=';
      text += i + 2 < bytes.size() ? digits[bits & 63] : '=';
    }
    out_ << text;
  }

  Text_writer& out_;
  bool is_text_, is_compressed_;
  std::string bytes_;
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_VTU_ARRAY_WRITER_H
