// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads tetrahedral meshes as TetGen writes them (Si, "TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator",
// 2015, sec. 5.2): points in a .node file, cells in the .ele file beside it, and facets with their markers where there
// is a .face file. Numbering starts at 0 or 1, whichever the first point has. An .edge file isn't looked at: it has all
// sides of the facets of TetGen's input, be they sharp or not.

#ifndef WEFT_IO_READ_TETGEN_H
#define WEFT_IO_READ_TETGEN_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/read_elements.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

template <class K>
void read_tetgen_points(const std::string& filename, Element_soup_3<K>& soup)
{
  Line_reader in(filename);
  in.require_line("the number of points");
  const std::size_t n = in.count("the number of points", 8);
  const long long dimension = in.at_end_of_line() ? 3 : in.integer("the dimension");
  if (dimension != 3) in.fail("the dimension should be 3, not " + std::to_string(dimension));
  const long long attributes = in.at_end_of_line() ? 0 : in.bounded_count("the number of attributes");
  const long long markers = in.at_end_of_line() ? 0 : in.integer("the number of markers");
  if (n == 0) in.fail("there are no points");
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("point " + std::to_string(i + 1) + " of " + std::to_string(n));
    const long long number = in.integer("the number of the point");
    if (i == 0 && number != 0 && number != 1) in.fail("points should be numbered from 0 or 1");
    if (i == 0) soup.first_number = static_cast<std::size_t>(number);
    if (number != static_cast<long long>(soup.first_number + i))
      in.fail("the points aren't numbered one after the other");
    const double x = in.number("x"), y = in.number("y"), z = in.number("z");
    soup.points.emplace_back(x, y, z);
    for (long long a = 0; a < attributes; ++a) in.number("an attribute");
    if (markers > 0) in.marker("the marker"); // that of a facet or an edge nearby: it says nothing about the point
  }
}

/// Reads an .ele file.
/// \tparam N number of vertices of an element.
/// \param name of an element.
/// \param n number of points, the first of which has the number `first`.
/// \param tags gets the first attribute of each element, if there are any.
template <std::size_t N>
void read_ele_file(const std::string& filename, const std::string& name, std::size_t first, std::size_t n,
                   std::vector<std::array<std::size_t, N>>& elements, std::vector<int>& tags,
                   std::vector<std::size_t>& lines)
{
  Line_reader in(filename);
  in.require_line("the number of elements");
  const std::size_t count = in.count("the number of elements", 2 * N);
  const long long corners = in.at_end_of_line() ? N : in.integer("the number of vertices of each");
  if (corners != static_cast<long long>(N))
    in.fail("elements should have " + std::to_string(N) + " vertices, not " + std::to_string(corners));
  const long long attributes = in.at_end_of_line() ? 0 : in.bounded_count("the number of attributes");
  for (std::size_t i = 0; i < count; ++i) {
    in.require_line(name + " " + std::to_string(i + 1) + " of " + std::to_string(count));
    in.integer("the number of the " + name);
    lines.push_back(in.line());
    elements.push_back(read_vertices<N>(in, first, n));
    for (long long a = 0; a < attributes; ++a) {
      const double tag = in.number("an attribute");
      if (a > 0) continue;
      if (tag != std::floor(tag) || std::abs(tag) > std::numeric_limits<int>::max())
        in.fail("the attribute of a " + name + " should be an integer");
      tags.push_back(static_cast<int>(tag));
    }
    in.require_end_of_line();
  }
  in.require_end_of_file();
}

/// Those with the marker 0 lie inside.
template <class K>
void read_tetgen_facets(const std::string& filename, Element_soup_3<K>& soup)
{
  Line_reader in(filename);
  in.require_line("the number of facets");
  const std::size_t n = in.count("the number of facets", 8);
  const long long markers = in.at_end_of_line() ? 0 : in.bounded_count("the number of markers");
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("facet " + std::to_string(i + 1) + " of " + std::to_string(n));
    in.integer("the number of the facet");
    const auto vertices = read_vertices<3>(in, soup.first_number, soup.points.size());
    const int tag = markers > 0 ? in.marker("the marker") : 1;
    if (tag == 0) continue;
    soup.facets.push_back(vertices);
    soup.facet_tags.push_back(tag);
  }
}

inline bool is_readable(const std::string& filename)
{
  return std::ifstream(filename).good();
}

} // namespace internal

namespace IO {

/// Reads TetGen's files. The first attribute of tetrahedra is their tag; facets marked 0 in the .face file lie inside.
/// \param filename of the .ele or the .node file.
/// \throws File_error with the line if a file is missing, cut, malformed, has cells of second order, or if the elements
///   don't make a mesh; see `assemble_mesh_3()`.
template <class K>
Imported_mesh_3<K> read_tetgen(const std::string& filename)
{
  const std::string base = filename.substr(0, filename.rfind('.'));
  Element_soup_3<K> soup;
  weft::internal::read_tetgen_points(base + ".node", soup);
  weft::internal::read_ele_file<4>(base + ".ele", "tetrahedron", soup.first_number, soup.points.size(), soup.cells,
                                   soup.cell_tags, soup.cell_lines);
  if (weft::internal::is_readable(base + ".face")) weft::internal::read_tetgen_facets(base + ".face", soup);
  return weft::internal::assemble_from_file(base + ".ele", std::move(soup));
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_TETGEN_H
