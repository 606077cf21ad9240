// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the points (v) and polylines (l) of a Wavefront OBJ file as a planar straight line graph. z is dropped; faces,
// normals, texture coordinates, groups and materials are passed over.

#ifndef WEFT_IO_READ_OBJ_GRAPH_H
#define WEFT_IO_READ_OBJ_GRAPH_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/planar/graph/Pslg_2.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace weft {
namespace internal {

/// A vertex reference of an OBJ element, `v`, `v/vt` or `v/vt/vn`; negative numbers count back from the last point.
inline std::size_t read_obj_reference(Line_reader& in, std::size_t number_of_points)
{
  const std::string_view text = in.word("a point of the line");
  const long long number = in.parse<long long>(text.substr(0, text.find('/')), "a point of the line");
  const long long n = static_cast<long long>(number_of_points);
  if (number == 0 || number > n || number < -n) in.fail("there is no point " + std::to_string(number));
  return static_cast<std::size_t>(number > 0 ? number - 1 : n + number);
}

inline bool is_other_obj_keyword(std::string_view word)
{
  static constexpr std::array<std::string_view, 16> known = {
      "vt", "vn", "vp", "f", "p", "o", "g", "s", "mg", "cstype", "deg", "curv", "usemtl", "mtllib", "end", "parm"};
  return std::find(known.begin(), known.end(), word) != known.end();
}

} // namespace internal

namespace IO {

/// Reads an OBJ file. All its points are taken, also those that no line uses.
/// \throws File_error with the line if the file is missing or malformed.
template <class K>
Pslg_2<K> read_obj_graph(const std::string& filename)
{
  internal::Line_reader in(filename);
  Pslg_2<K> pslg;
  pslg.first_number = 1;
  while (in.next_line()) {
    const std::string_view keyword = in.word("a keyword");
    if (keyword == "v") {
      const double x = in.number("x"), y = in.number("y");
      while (!in.at_end_of_line()) in.number("z, a weight or a colour");
      pslg.points.emplace_back(x, y);
    } else if (keyword == "l") {
      std::size_t from = internal::read_obj_reference(in, pslg.points.size());
      do {
        const std::size_t to = internal::read_obj_reference(in, pslg.points.size());
        pslg.segments.push_back({from, to});
        from = to;
      } while (!in.at_end_of_line());
    } else if (!internal::is_other_obj_keyword(keyword)) {
      in.fail("unknown keyword '" + in.printable(keyword) + "'");
    }
  }
  if (pslg.points.empty()) in.fail("there are no points");
  return pslg;
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_OBJ_GRAPH_H
