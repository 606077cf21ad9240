// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exceptions of weft. Every exception carries the offending elements as indices into the caller's own arrays, so
// that a program can show them; `what()` is one line for a person. "Stopped early" is not an error: that is a value in
// the report.

#ifndef WEFT_ERRORS_H
#define WEFT_ERRORS_H

#include <weft/internal/cold.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Base of all of weft's exceptions.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A file that can't be opened or read; `line()` is the 1-based line number, 0 when there is none.
class File_error : public Error
{
public:
  WEFT_COLD File_error(const std::string& file, std::size_t line, const std::string& what)
      : Error(file + (line ? ":" + std::to_string(line) : std::string()) + ": " + what), line_(line)
  {}
  std::size_t line() const { return line_; }

private:
  std::size_t line_;
};

/// An option or argument outside its range.
class Option_error : public Error
{
public:
  using Error::Error;
};

/// A run was ended by the caller before there was anything to return.
class Stopped_error : public Error
{
public:
  using Error::Error;
};

/// An input domain that doesn't qualify; lists the vertices, segments or facets that are to blame.
class Domain_error : public Error
{
public:
  Domain_error(const std::string& what, std::vector<std::size_t> vertices, std::vector<std::size_t> elements)
      : Error(what), vertices_(std::move(vertices)), elements_(std::move(elements))
  {}
  /// Indices of the offending input vertices.
  const std::vector<std::size_t>& vertices() const { return vertices_; }
  /// Indices of the offending input segments (2D) or facets (3D).
  const std::vector<std::size_t>& elements() const { return elements_; }

private:
  std::vector<std::size_t> vertices_, elements_;
};

} // namespace weft

#endif // WEFT_ERRORS_H
