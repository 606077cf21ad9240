// SPDX-License-Identifier: GPL-3.0-or-later
//
// The data arrays of a VTK unstructured grid (VTK file formats, "XML formats"): ASCII, base64 and appended, raw or in
// base64, plain or compressed by zlib. XML is taken apart as far as these files use it: elements and attributes, no
// entities.

#ifndef WEFT_IO_INTERNAL_VTU_ARRAYS_H
#define WEFT_IO_INTERNAL_VTU_ARRAYS_H

#include <weft/errors.h>
#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/zlib_blocks.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::internal {

/// Reads a file and gives out its arrays by section ("Points", "Cells", "PointData", "CellData") and name.
class Vtu_arrays
{
public:
  /// \throws File_error if the file is missing, cut or malformed.
  explicit Vtu_arrays(const std::string& filename) : filename_(filename)
  {
    std::ifstream in(filename, std::ios::binary);
    if (!in) throw File_error(filename, 0, "can't be opened");
    text_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (in.bad()) throw File_error(filename, 0, "can't be read");
    scan();
  }

  std::size_t number_of_points() const { return points_; }
  std::size_t number_of_cells() const { return cells_; }

  bool has(const std::string& section, const std::string& name) const { return arrays_.count({section, name}) > 0; }

  /// The names of the arrays of a section, in alphabetical order.
  std::vector<std::string> names(const std::string& section) const
  {
    std::vector<std::string> result;
    for (const auto& [key, array] : arrays_)
      if (key.first == section) result.push_back(key.second);
    return result;
  }

  /// All numbers of an array.
  std::vector<double> numbers(const std::string& section, const std::string& name) const
  {
    const auto found = arrays_.find({section, name});
    if (found == arrays_.end())
      throw File_error(filename_, 0, "there is no array '" + name + "' in the section " + section);
    const Array& array = found->second;
    if (array.format == "ascii") return ascii(array);
    if (array.format == "binary") return decoded(array, base64(array, array.text));
    if (array.format == "appended") return decoded(array, appended(array));
    fail(array.position, "unknown format '" + Line_reader::printable(array.format) + "' of an array");
  }

  /// The coordinates of points, whatever their array is called.
  std::vector<double> coordinates() const
  {
    for (const auto& [key, array] : arrays_)
      if (key.first == "Points") return numbers(key.first, key.second);
    throw File_error(filename_, 0, "there is no array of points");
  }

private:
  using Attributes = std::map<std::string, std::string>;

  struct Array
  {
    std::string type, format;
    std::size_t offset = 0, position = 0;
    std::string_view text;
  };

  [[noreturn]] void fail(std::size_t position, const std::string& what) const
  {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>((std::min)(position, text_.size()));
    throw File_error(filename_, 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n')), what);
  }

  // ---- XML

  void scan()
  {
    std::string section;
    std::size_t at = 0, pieces = 0;
    bool is_grid = false;
    while ((at = text_.find('<', at)) != std::string::npos) {
      if (text_.compare(at, 4, "<!--") == 0) {
        at = text_.find("-->", at);
        continue;
      }
      const std::size_t begin = at++, end = text_.find('>', at);
      if (end == std::string::npos) fail(begin, "the file ends within a tag");
      const std::string tag = text_.substr(at, end - at);
      const std::string name = tag.substr(0, tag.find_first_of(" \t\r\n/", 1));
      const Attributes attributes = attributes_of(tag);
      at = end + 1;
      if (name == "VTKFile") {
        is_grid = value(attributes, "type") == "UnstructuredGrid";
        byte_order_ = value(attributes, "byte_order");
        long_headers_ = value(attributes, "header_type") == "UInt64";
        compressor_ = value(attributes, "compressor");
        is_compressed_ = !compressor_.empty();
      } else if (name == "Piece") {
        if (++pieces > 1) fail(begin, "the grid is in several pieces; only one can be read");
        points_ = size(attributes, "NumberOfPoints", begin);
        cells_ = size(attributes, "NumberOfCells", begin);
      } else if (name == "Points" || name == "Cells" || name == "PointData" || name == "CellData") {
        section = name;
      } else if (name == "DataArray") {
        at = take_array(section, attributes, tag.back() == '/', begin, at);
      } else if (name == "AppendedData") {
        appended_is_base64_ = value(attributes, "encoding") == "base64";
        appended_ = text_.find('_', at);
        if (appended_ == std::string::npos) fail(begin, "appended data should begin with '_'");
        ++appended_;
        break; // raw data may look like anything
      }
    }
    if (!is_grid || pieces == 0) fail(0, "this is no VTK file with an unstructured grid");
  }

  std::size_t take_array(const std::string& section, const Attributes& attributes, bool is_empty, std::size_t begin,
                         std::size_t at)
  {
    Array array{value(attributes, "type"), value(attributes, "format"), 0, begin, {}};
    if (array.format == "appended") array.offset = size(attributes, "offset", begin);
    std::size_t end = at;
    if (!is_empty && array.format != "appended") {
      end = text_.find('<', at);
      if (end == std::string::npos) fail(begin, "the file ends within an array");
      array.text = std::string_view(text_).substr(at, end - at);
    }
    if (!section.empty()) arrays_[{section, value(attributes, "Name")}] = array;
    return end;
  }

  static Attributes attributes_of(const std::string& tag)
  {
    Attributes result;
    for (std::size_t at = 0; (at = tag.find('=', at)) != std::string::npos;) {
      const std::size_t name_end = tag.find_last_not_of(" \t\r\n", at - 1) + 1;
      const std::size_t name_begin = tag.find_last_of(" \t\r\n", name_end - 1) + 1;
      const std::size_t quote = tag.find_first_of("\"'", at);
      const std::size_t close = quote == std::string::npos ? quote : tag.find(tag[quote], quote + 1);
      if (close == std::string::npos) break;
      result[tag.substr(name_begin, name_end - name_begin)] = tag.substr(quote + 1, close - quote - 1);
      at = close;
    }
    return result;
  }

  static std::string value(const Attributes& attributes, const std::string& name)
  {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string() : found->second;
  }

  std::size_t size(const Attributes& attributes, const std::string& name, std::size_t position) const
  {
    const std::string text = value(attributes, name);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
      fail(position, name + " should be a number, not '" + Line_reader::printable(text) + "'");
    return number;
  }

  // ---- numbers

  std::vector<double> ascii(const Array& array) const
  {
    std::vector<double> result;
    const char* at = array.text.data();
    const char* const end = at + array.text.size();
    for (;;) {
      while (at != end && (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r')) ++at;
      if (at == end) return result;
      double number = 0;
      const auto [next, error] = std::from_chars(at + (*at == '+'), end, number);
      if (error == std::errc::invalid_argument || next == at)
        fail(static_cast<std::size_t>(at - text_.data()),
             "a number should follow, not '" +
                 Line_reader::printable(std::string_view(at, static_cast<std::size_t>(end - at)).substr(0, 12)) + "'");
      result.push_back(number);
      at = next;
    }
  }

  void require_readable(const Array& array) const
  {
#ifndef WEFT_LINKED_WITH_ZLIB
    if (is_compressed_)
      fail(array.position, "arrays are compressed, and weft was compiled without zlib (WEFT_LINKED_WITH_ZLIB)");
#endif
    if (is_compressed_ && compressor_ != "vtkZLibDataCompressor")
      fail(array.position, "arrays are compressed by " + Line_reader::printable(compressor_) +
                               "; only vtkZLibDataCompressor can be read");
    if (!byte_order_.empty() && byte_order_ != "LittleEndian")
      fail(array.position, "the byte order is " + byte_order_ + "; only LittleEndian can be read");
    const std::uint16_t one = 1;
    unsigned char first = 0;
    std::memcpy(&first, &one, 1);
    if (first != 1) fail(array.position, "binary arrays can be read on little-endian machines only");
  }

  /// The bytes of an array behind the count that precedes them.
  std::string appended(const Array& array) const
  {
    require_readable(array);
    if (appended_ == std::string::npos || appended_ > text_.size() || array.offset > text_.size() - appended_)
      fail(array.position, "the appended data of an array are missing");
    const std::string_view rest = std::string_view(text_).substr(appended_ + array.offset);
    return appended_is_base64_ ? base64(array, rest) : counted_bytes(array, rest);
  }

  std::size_t header_size() const
  {
    return long_headers_ ? 8 : 4;
  }

  /// Number i of a header.
  std::size_t header(const Array& array, std::string_view bytes, std::size_t i) const
  {
    const std::size_t size = header_size();
    if (bytes.size() / size <= i) fail(array.position, "the data of an array are cut");
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data() + i * size, size);
    return static_cast<std::size_t>(number);
  }

  std::string counted_bytes(const Array& array, std::string_view bytes) const
  {
    if (is_compressed_)
      return decompressed(array, bytes, bytes.substr((std::min)(compressed_header(array, bytes), bytes.size())));
    const std::size_t count = header(array, bytes, 0);
    if (count > bytes.size() - header_size()) fail(array.position, "the data of an array are cut");
    return std::string(bytes.substr(header_size(), count));
  }

  /// The length of the header of compressed data.
  std::size_t compressed_header(const Array& array, std::string_view bytes) const
  {
    const std::size_t blocks = header(array, bytes, 0);
    if (blocks > bytes.size()) fail(array.position, "the data of an array are cut");
    return (3 + blocks) * header_size();
  }

  std::string decompressed(const Array& array, [[maybe_unused]] std::string_view head,
                           [[maybe_unused]] std::string_view blocks) const
  {
#ifdef WEFT_LINKED_WITH_ZLIB
    const std::size_t n = header(array, head, 0);
    std::string result;
    for (std::size_t b = 0; b < n; ++b) {
      const std::size_t last = header(array, head, 2), length = header(array, head, 3 + b),
                        size = b + 1 == n && last > 0 ? last : header(array, head, 1);
      // zlib makes nothing shorter than by a factor of 1032.
      if (length > blocks.size() || size / 1040 > length) fail(array.position, "the data of an array are cut");
      const auto block = decompressed_block(blocks.substr(0, length), size);
      if (!block) fail(array.position, "the compressed data of an array are damaged");
      result += *block;
      blocks.remove_prefix(length);
    }
    return result;
#else
    fail(array.position, "arrays are compressed");
#endif
  }

  /// Of compressed data the header is a run of base64 of its own.
  std::string base64(const Array& array, std::string_view text) const
  {
    require_readable(array);
    if (!is_compressed_) return counted_bytes(array, bytes_of(text, std::string_view::npos));
    const auto begin = text.find_first_not_of(" \t\r\n");
    text.remove_prefix((std::min)(begin, text.size()));
    const std::size_t size = compressed_header(array, bytes_of(text, (header_size() + 2) / 3 * 4));
    const std::size_t digits = (size + 2) / 3 * 4;
    if (digits > text.size()) fail(array.position, "the data of an array are cut");
    return decompressed(array, bytes_of(text, digits), bytes_of(text.substr(digits), std::string_view::npos));
  }

  /// What so many characters of base64 stand for, or those up to the first that is neither that nor a blank.
  static std::string bytes_of(std::string_view text, std::size_t characters)
  {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value;
    value.fill(-1);
    for (std::size_t i = 0; i < digits.size(); ++i) value[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    std::string bytes;
    unsigned bits = 0;
    int held = 0;
    for (const char c : text.substr(0, characters)) {
      const int digit = value[static_cast<unsigned char>(c)];
      if (c == '=' || c == '<') break;
      if (digit < 0) continue;
      bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xfffffu;
      held += 6;
      if (held < 8) continue;
      held -= 8;
      bytes += static_cast<char>(bits >> held & 0xffu);
    }
    return bytes;
  }

  std::vector<double> decoded(const Array& array, const std::string& bytes) const
  {
    const std::string& t = array.type;
    if (t == "Float64") return decoded<double>(bytes);
    if (t == "Float32") return decoded<float>(bytes);
    if (t == "Int64") return decoded<std::int64_t>(bytes);
    if (t == "UInt64") return decoded<std::uint64_t>(bytes);
    if (t == "Int32") return decoded<std::int32_t>(bytes);
    if (t == "UInt32") return decoded<std::uint32_t>(bytes);
    if (t == "Int16") return decoded<std::int16_t>(bytes);
    if (t == "UInt16") return decoded<std::uint16_t>(bytes);
    if (t == "Int8") return decoded<std::int8_t>(bytes);
    if (t == "UInt8") return decoded<std::uint8_t>(bytes);
    fail(array.position, "unknown type '" + Line_reader::printable(t) + "' of an array");
  }

  template <class Number>
  static std::vector<double> decoded(const std::string& bytes)
  {
    std::vector<double> result;
    for (std::size_t i = 0; i + sizeof(Number) <= bytes.size(); i += sizeof(Number)) {
      Number number;
      std::memcpy(&number, bytes.data() + i, sizeof number);
      result.push_back(static_cast<double>(number));
    }
    return result;
  }

  std::string filename_, text_, byte_order_, compressor_;
  bool long_headers_ = false, is_compressed_ = false, appended_is_base64_ = false;
  std::size_t points_ = 0, cells_ = 0, appended_ = std::string::npos;
  std::map<std::pair<std::string, std::string>, Array> arrays_; ///< by section and name
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_VTU_ARRAYS_H
