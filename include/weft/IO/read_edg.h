// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the .edg files of CGAL's 2D mesh generation examples: the number of edges, then one edge a line as
// x1 y1 x2 y2. Ends with exactly equal coordinates are one point.

#ifndef WEFT_IO_READ_EDG_H
#define WEFT_IO_READ_EDG_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/planar/graph/Pslg_2.h>

#include <array>
#include <map>
#include <string>
#include <utility>

namespace weft {
namespace IO {

/// Reads a .edg file. Points are numbered in the order in which they first appear.
/// \throws File_error with the line if the file is missing, cut or malformed.
template <class K>
Pslg_2<K> read_edg(const std::string& filename)
{
  internal::Line_reader in(filename);
  in.require_line("the number of edges");
  const std::size_t n = in.count("the number of edges", 8);
  in.require_end_of_line();

  Pslg_2<K> pslg;
  pslg.first_number = 1;
  std::map<std::pair<double, double>, std::size_t> numbers;
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("edge " + std::to_string(i + 1) + " of " + std::to_string(n));
    std::array<std::size_t, 2> segment{};
    for (std::size_t& end : segment) {
      const double x = in.number("x"), y = in.number("y");
      const auto [place, is_new] = numbers.emplace(std::make_pair(x, y), pslg.points.size());
      if (is_new) pslg.points.emplace_back(x, y);
      end = place->second;
    }
    in.require_end_of_line();
    pslg.segments.push_back(segment);
  }
  in.require_end_of_file();
  return pslg;
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_EDG_H
