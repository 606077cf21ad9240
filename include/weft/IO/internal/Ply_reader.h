// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header of a PLY file, text or binary of either byte order, and its values one by one.

#ifndef WEFT_IO_INTERNAL_PLY_READER_H
#define WEFT_IO_INTERNAL_PLY_READER_H

#include <weft/errors.h>
#include <weft/IO/internal/Line_reader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace weft::internal {

enum class Ply_type
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64
};

/// The type of that name; false if there is none.
inline bool find_ply_type(const std::string& name, Ply_type& type)
{
  static constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                            {"uchar", "uint8"},
                                                                            {"short", "int16"},
                                                                            {"ushort", "uint16"},
                                                                            {"int", "int32"},
                                                                            {"uint", "uint32"},
                                                                            {"float", "float32"},
                                                                            {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i][0] || name == names[i][1]) {
      type = static_cast<Ply_type>(i);
      return true;
    }
  return false;
}

struct Ply_property
{
  std::string name;
  bool is_list = false;
  Ply_type count_type = Ply_type::uint8, type = Ply_type::float32;
};

struct Ply_element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Ply_property> properties;
};

/// A PLY file in memory: its header first, then its values one by one, all as doubles.
class Ply_reader
{
public:
  /// Takes the whole file into memory and reads its header.
  /// \throws File_error.
  explicit Ply_reader(const std::string& filename) : filename_(filename)
  {
    std::ifstream in(filename, std::ios::binary);
    if (!in) throw File_error(filename, 0, "can't be opened");
    bytes_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (bytes_.empty()) fail("the file is empty");
    read_header();
  }

  const std::vector<Ply_element>& elements() const { return elements_; }

  /// The next value.
  double value(Ply_type type)
  {
    if (is_text_) return text_value();
    switch (type) {
    case Ply_type::int8:
      return binary_value<std::int8_t>();
    case Ply_type::uint8:
      return binary_value<std::uint8_t>();
    case Ply_type::int16:
      return binary_value<std::int16_t>();
    case Ply_type::uint16:
      return binary_value<std::uint16_t>();
    case Ply_type::int32:
      return binary_value<std::int32_t>();
    case Ply_type::uint32:
      return binary_value<std::uint32_t>();
    case Ply_type::float32:
      return static_cast<double>(binary_value<float>());
    default:
      return binary_value<double>();
    }
  }

  /// The next value as a number of values that follow.
  std::size_t count(Ply_type type) { return checked_count(value(type)); }

  /// Goes on behind an element of a text file, to the next line if each has one of its own: some have more values there
  /// than their header tells.
  void end_element()
  {
    if (has_lines_) position_ = (std::min)(bytes_.find('\n', position_), bytes_.size());
  }

  /// In text files a line too many would be lost without a word; binary files may be padded.
  void require_end() const
  {
    if (is_text_ && bytes_.find_first_not_of(blanks, position_) != std::string::npos)
      fail("unexpected data after the last element");
  }

  [[noreturn]] void fail(const std::string& what) const { throw File_error(filename_, line_, what); }

private:
  static constexpr const char* blanks = " \t\r\n";

  std::string next_header_line()
  {
    const std::size_t end = bytes_.find('\n', position_);
    if (end == std::string::npos) fail("the file ends in its header");
    const std::string text = bytes_.substr(position_, end - position_);
    position_ = end + 1;
    ++line_;
    return text;
  }

  void read_header()
  {
    std::string word;
    std::istringstream(next_header_line()) >> word;
    if (word != "ply") fail("a PLY file begins with 'ply'");
    bool has_format = false;
    for (;;) {
      std::istringstream words(next_header_line());
      word.clear();
      words >> word;
      if (word == "end_header") break;
      if (word == "format") {
        has_format = true;
        words >> word;
        is_text_ = word == "ascii";
        is_big_endian_ = word == "binary_big_endian";
        if (!is_text_ && !is_big_endian_ && word != "binary_little_endian")
          fail("unknown format '" + Line_reader::printable(word) + "'");
      } else if (word == "element") {
        read_element(words);
      } else if (word == "property") {
        read_property(words);
      }
    }
    if (!has_format) fail("the header lacks its format");
    line_ = 0; // of no use behind the header
    has_lines_ = is_text_ && count_lines() == count_elements();
  }

  std::size_t count_elements() const
  {
    std::size_t sum = 0;
    for (const Ply_element& element : elements_) sum += element.count;
    return sum;
  }
  /// Lines with anything in them, from here on.
  std::size_t count_lines() const
  {
    std::size_t lines = 0;
    for (std::size_t at = position_; (at = bytes_.find_first_not_of(blanks, at)) != std::string::npos; ++lines)
      at = (std::min)(bytes_.find('\n', at), bytes_.size());
    return lines;
  }

  void read_element(std::istringstream& words)
  {
    Ply_element element;
    double count = -1;
    if (!(words >> element.name >> count)) fail("an element needs a name and a number");
    element.count = checked_count(count);
    elements_.push_back(std::move(element));
  }

  void read_property(std::istringstream& words)
  {
    Ply_property property;
    std::string count_type, type;
    words >> type;
    property.is_list = type == "list";
    if (property.is_list) words >> count_type >> type;
    words >> property.name;
    const bool is_known =
        find_ply_type(type, property.type) && (!property.is_list || find_ply_type(count_type, property.count_type));
    if (!words || !is_known || elements_.empty()) fail("a property needs an element, a known type and a name");
    elements_.back().properties.push_back(std::move(property));
  }

  /// A count that the rest of the file can't hold is refused before anybody allocates for it.
  std::size_t checked_count(double count) const
  {
    if (!(count >= 0) || count != std::floor(count)) fail("a number of values is negative or no integer");
    if (count > static_cast<double>(bytes_.size() - position_)) fail("the file is too short for what it announces");
    return static_cast<std::size_t>(count);
  }

  double text_value()
  {
    const std::size_t start = bytes_.find_first_not_of(blanks, position_);
    if (start == std::string::npos) fail("the file ends where a number should follow");
    const std::size_t end = std::min(bytes_.find_first_of(blanks, start), bytes_.size());
    position_ = end;
    double value = 0;
    const auto [stop, error] = std::from_chars(bytes_.data() + start, bytes_.data() + end, value);
    if (error != std::errc() || stop != bytes_.data() + end)
      fail("expected a number, not '" + Line_reader::printable(std::string_view(bytes_).substr(start, end - start)) +
           "'");
    return value;
  }

  template <class Number>
  Number binary_value()
  {
    if (bytes_.size() - position_ < sizeof(Number)) fail("the file ends where a number should follow");
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(Number));
    position_ += sizeof(Number);
    const std::uint16_t one = 1;
    char first_byte;
    std::memcpy(&first_byte, &one, 1);
    const bool is_host_big_endian = first_byte == 0;
    if (is_host_big_endian != is_big_endian_) std::reverse(raw.begin(), raw.end());
    Number number;
    std::memcpy(&number, raw.data(), sizeof(Number));
    return number;
  }

  std::string filename_, bytes_;
  std::vector<Ply_element> elements_;
  std::size_t position_ = 0, line_ = 0;
  bool is_text_ = true, is_big_endian_ = false, has_lines_ = false;
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_PLY_READER_H
