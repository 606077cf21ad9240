// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all of weft's text readers share: a file taken line by line, comments and empty lines skipped, with numbers read
// independently of the locale and every complaint naming the file and the line.

#ifndef WEFT_IO_INTERNAL_LINE_READER_H
#define WEFT_IO_INTERNAL_LINE_READER_H

#include <weft/errors.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace weft::internal {

/// Walks through the lines of a text file; `#` starts a comment.
class Line_reader
{
public:
  /// Takes the whole file into memory.
  /// \throws File_error if it can't be read.
  explicit Line_reader(const std::string& filename) : filename_(filename)
  {
    std::ifstream in(filename, std::ios::binary);
    if (!in) throw File_error(filename, 0, "can't be opened");
    std::string chunk(std::size_t(1) << 16, '\0');
    do {
      in.read(&chunk[0], static_cast<std::streamsize>(chunk.size()));
      text_.append(chunk, 0, static_cast<std::size_t>(in.gcount()));
    } while (in);
    // A directory opens like a file; only reading from it fails.
    if (in.bad()) throw File_error(filename, 0, "can't be read");
  }

  /// Makes one line of those that end with a backslash and the next.
  /// \pre No line has been read.
  void join_lines()
  {
    for (std::size_t at = 0; (at = text_.find('\\', at)) != std::string::npos; ++at) {
      const std::size_t end = text_.find_first_not_of(" \t\r", at + 1);
      if (end == std::string::npos || text_[end] != '\n') continue;
      text_[at] = ' ';
      text_[end] = joint;
    }
  }

  /// Goes to the next line that holds more than blanks and a comment; false at the end of the file.
  bool next_line()
  {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      rest_ = std::string_view(text_).substr(position_, end - position_);
      position_ = end + 1;
      line_ += 1 + static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), joint));
      rest_ = rest_.substr(0, rest_.find('#'));
      skip_blanks();
      if (!rest_.empty()) return true;
    }
    rest_ = {};
    return false;
  }

  /// Like `next_line()`, where the file must not end.
  void require_line(const std::string& what)
  {
    if (!next_line()) fail("the file ends where " + what + " should follow");
  }

  bool at_end_of_line() const { return rest_.empty(); }

  /// Number of the line, from 1.
  std::size_t line() const { return line_; }

  /// Goes on to the next line where this one is used up: for formats whose lines don't matter.
  void require_word(const std::string& what)
  {
    if (rest_.empty()) require_line(what);
  }

  /// First character of the next word; only where `at_end_of_line()` is false.
  char front() const { return rest_.front(); }

  /// Next word of the line.
  std::string_view word(const std::string& what)
  {
    if (rest_.empty()) fail(what + " is missing");
    const std::string_view result = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(result.size());
    skip_blanks();
    return result;
  }

  /// Passes over so many characters of the next word.
  void skip(std::size_t n) { rest_.remove_prefix(n); }

  /// What is left of the line as a name: without blanks around it, characters that control, and quotes.
  std::string rest_of_line()
  {
    std::string result(rest_.substr(0, rest_.find_last_not_of(blanks) + 1));
    rest_ = {};
    const auto is_bad = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127 || c == '"'; };
    result.erase(std::remove_if(result.begin(), result.end(), is_bad), result.end());
    return result;
  }

  /// Next word as a finite number.
  double number(const std::string& what)
  {
    const std::string_view text = word(what);
    const double value = parse<double>(text, what);
    if (!std::isfinite(value)) fail(what + " is not finite: '" + printable(text) + "'");
    return value;
  }

  /// Next word as an integer.
  long long integer(const std::string& what) { return parse<long long>(word(what), what); }

  /// Next word as a mark, which must fit an int.
  int marker(const std::string& what)
  {
    const long long value = integer(what);
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
      fail(what + " is out of range: " + std::to_string(value));
    return static_cast<int>(value);
  }

  /// Next word as a number of things that follow, each of at least `bytes_each` bytes: a count that the rest of the
  /// file can't hold is refused before anybody allocates for it.
  std::size_t count(const std::string& what, std::size_t bytes_each)
  {
    const long long value = bounded_count(what);
    const std::size_t left = text_.size() - std::min(position_, text_.size());
    if (static_cast<unsigned long long>(value) > (left + 1) / bytes_each) // + 1: the last line may lack its end
      fail("the file is too short for " + what + " " + std::to_string(value));
    return static_cast<std::size_t>(value);
  }

  /// Next word as a non-negative number.
  long long bounded_count(const std::string& what)
  {
    const long long value = integer(what);
    if (value < 0) fail(what + " is negative: " + std::to_string(value));
    return value;
  }

  void require_end_of_line()
  {
    if (!rest_.empty()) fail("unexpected '" + printable(rest_) + "' at the end of the line");
  }

  void require_end_of_file()
  {
    if (next_line()) fail("unexpected '" + printable(rest_) + "' after the end of the data");
  }

  /// Reads a number out of a word; the whole word must be used up.
  template <class Number>
  Number parse(std::string_view text, const std::string& what) const
  {
    const std::string_view digits = text.substr(!text.empty() && text[0] == '+' ? 1 : 0); // from_chars knows no plus
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range) fail(what + " is out of range: '" + printable(text) + "'");
    if (error != std::errc() || end != digits.data() + digits.size())
      fail(what + " should be a number, not '" + printable(text) + "'");
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { throw File_error(filename_, line_, what); }

  /// At most 40 characters of the text, without anything that would upset a terminal.
  static std::string printable(std::string_view text)
  {
    std::string result(text.substr(0, 40));
    for (char& c : result)
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
    return result;
  }

private:
  static constexpr char joint = '\v'; ///< where a line was joined to the next
  static constexpr const char* blanks = " \t\r\f\v";

  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }

  std::string filename_;
  std::string text_;
  std::string_view rest_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_LINE_READER_H
