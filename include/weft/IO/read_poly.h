// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the .poly and .node files of Shewchuk's mesh generator Triangle ("Triangle: Engineering a 2D Quality Mesh
// Generator and Delaunay Triangulator", 1996): points, segments, holes and regions, with their markers. Numbering
// starts at 0 or 1, whichever the first point has. A .poly file with no points takes them from the .node file of the
// same name. Attributes of points are checked and dropped.

#ifndef WEFT_IO_READ_POLY_H
#define WEFT_IO_READ_POLY_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/planar/graph/Pslg_2.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace weft {
namespace internal {

/// Reads the point section; returns the number that the first point has.
template <class K>
long long read_node_section(Line_reader& in, Pslg_2<K>& pslg, bool may_be_empty)
{
  in.require_line("the number of points");
  const std::size_t n = in.count("the number of points", 6);
  const long long dimension = in.at_end_of_line() ? 2 : in.integer("the dimension");
  if (dimension != 2) in.fail("the dimension should be 2, not " + std::to_string(dimension));
  const long long attributes = in.at_end_of_line() ? 0 : in.bounded_count("the number of attributes");
  const long long markers = in.at_end_of_line() ? 0 : in.integer("the number of markers");
  if (markers != 0 && markers != 1) in.fail("the number of markers should be 0 or 1, not " + std::to_string(markers));
  in.require_end_of_line();
  if (n == 0 && !may_be_empty) in.fail("there are no points");

  long long first = 0;
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("point " + std::to_string(i + 1) + " of " + std::to_string(n));
    const long long number = in.integer("the number of the point");
    if (i == 0 && number != 0 && number != 1) in.fail("points should be numbered from 0 or 1");
    if (i == 0) first = number;
    if (i == 0) pslg.first_number = static_cast<std::size_t>(number);
    if (number != first + static_cast<long long>(i)) in.fail("the points aren't numbered one after the other");
    const double x = in.number("x"), y = in.number("y");
    pslg.points.emplace_back(x, y);
    for (long long a = 0; a < attributes; ++a) in.number("an attribute");
    if (markers) pslg.point_markers.push_back(in.marker("the marker"));
    in.require_end_of_line();
  }
  return first;
}

template <class K>
void read_segment_section(Line_reader& in, Pslg_2<K>& pslg, long long first)
{
  in.require_line("the number of segments");
  const std::size_t n = in.count("the number of segments", 6);
  const long long markers = in.at_end_of_line() ? 0 : in.integer("the number of markers");
  if (markers != 0 && markers != 1) in.fail("the number of markers should be 0 or 1, not " + std::to_string(markers));
  in.require_end_of_line();
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("segment " + std::to_string(i + 1) + " of " + std::to_string(n));
    in.integer("the number of the segment");
    std::array<std::size_t, 2> segment{};
    for (std::size_t& end : segment) {
      const long long number = in.integer("an end of the segment");
      if (number < first || number - first >= static_cast<long long>(pslg.points.size()))
        in.fail("there is no point " + std::to_string(number));
      end = static_cast<std::size_t>(number - first);
    }
    pslg.segments.push_back(segment);
    if (markers) pslg.segment_markers.push_back(in.marker("the marker"));
    in.require_end_of_line();
  }
}

template <class K>
void read_hole_section(Line_reader& in, Pslg_2<K>& pslg)
{
  in.require_line("the number of holes");
  const std::size_t n = in.count("the number of holes", 6);
  in.require_end_of_line();
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("hole " + std::to_string(i + 1) + " of " + std::to_string(n));
    in.integer("the number of the hole");
    const double x = in.number("x"), y = in.number("y");
    pslg.holes.emplace_back(x, y);
    in.require_end_of_line();
  }
}

/// Regions are optional: the file may end before their number.
template <class K>
void read_region_section(Line_reader& in, Pslg_2<K>& pslg)
{
  if (!in.next_line()) return;
  const std::size_t n = in.count("the number of regions", 8);
  in.require_end_of_line();
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("region " + std::to_string(i + 1) + " of " + std::to_string(n));
    in.integer("the number of the region");
    const double x = in.number("x"), y = in.number("y"), attribute = in.number("the attribute of the region");
    if (attribute != std::floor(attribute) || std::abs(attribute) > std::numeric_limits<int>::max())
      in.fail("the attribute of a region should be an integer");
    const double area = in.at_end_of_line() ? 0 : in.number("the area bound");
    in.require_end_of_line();
    pslg.regions.push_back({typename K::Point_2(x, y), static_cast<int>(attribute), area > 0 ? area : 0.});
  }
}

} // namespace internal

namespace IO {

/// Reads a Triangle .node file: points only.
/// \throws File_error with the line if the file is missing, cut or malformed.
template <class K>
Pslg_2<K> read_node(const std::string& filename)
{
  internal::Line_reader in(filename);
  Pslg_2<K> pslg;
  internal::read_node_section(in, pslg, false);
  in.require_end_of_file();
  return pslg;
}

/// Reads a Triangle .poly file, and the .node file beside it where the .poly has no points of its own.
/// \throws File_error with the line if a file is missing, cut or malformed.
template <class K>
Pslg_2<K> read_poly(const std::string& filename)
{
  internal::Line_reader in(filename);
  Pslg_2<K> pslg;
  long long first = internal::read_node_section(in, pslg, true);
  if (pslg.points.empty()) {
    internal::Line_reader nodes(filename.substr(0, filename.rfind('.')) + ".node");
    first = internal::read_node_section(nodes, pslg, false);
    nodes.require_end_of_file();
  }
  internal::read_segment_section(in, pslg, first);
  internal::read_hole_section(in, pslg);
  internal::read_region_section(in, pslg);
  in.require_end_of_file();
  return pslg;
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_POLY_H
