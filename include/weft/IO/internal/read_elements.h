// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the readers of tetrahedral meshes share: points and vertex numbers out of a line reader, and the last step from
// elements to a mesh, whose complaints get the line of the element to blame.

#ifndef WEFT_IO_INTERNAL_READ_ELEMENTS_H
#define WEFT_IO_INTERNAL_READ_ELEMENTS_H

#include <weft/errors.h>
#include <weft/IO/internal/Line_reader.h>
#include <weft/spatial/mesh/assemble_mesh_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace weft::internal {

/// Three coordinates, wherever lines end.
template <class Point>
Point read_point_3(Line_reader& in)
{
  std::array<double, 3> x;
  const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    in.require_word(names[i]);
    x[i] = in.number(names[i]);
  }
  return Point(x[0], x[1], x[2]);
}

/// The vertices of an element, wherever lines end.
/// \param first the number of the first point.
/// \param n of points.
template <std::size_t N>
std::array<std::size_t, N> read_vertices(Line_reader& in, std::size_t first, std::size_t n)
{
  std::array<std::size_t, N> vertices;
  for (std::size_t& v : vertices) {
    in.require_word("a vertex");
    const long long number = in.integer("a vertex");
    if (number < static_cast<long long>(first) || static_cast<std::size_t>(number) - first >= n)
      in.fail("there is no vertex " + std::to_string(number));
    v = static_cast<std::size_t>(number) - first;
  }
  return vertices;
}

/// `assemble_mesh_3()` for what came from a file.
template <class K>
Imported_mesh_3<K> assemble_from_file(const std::string& filename, Element_soup_3<K> soup)
{
  const auto lines = soup.cell_lines;
  try {
    return assemble_mesh_3(std::move(soup));
  } catch (const Domain_error& error) {
    const auto& elements = error.elements();
    throw File_error(filename, !elements.empty() && elements[0] < lines.size() ? lines[elements[0]] : 0, error.what());
  }
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_READ_ELEMENTS_H
