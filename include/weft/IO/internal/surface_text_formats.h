// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads surfaces from OFF and Wavefront OBJ files, text only, line by line. Colours of facets, materials and groups are
// kept as groups; normals and texture coordinates are passed over.

#ifndef WEFT_IO_INTERNAL_SURFACE_TEXT_FORMATS_H
#define WEFT_IO_INTERNAL_SURFACE_TEXT_FORMATS_H

#include <weft/IO/internal/Group_collector.h>
#include <weft/IO/internal/Line_reader.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace weft::internal {

/// The three coordinates that come next.
template <class Point>
Point read_coordinates(Line_reader& in)
{
  const double x = in.number("x"), y = in.number("y"), z = in.number("z");
  return Point(x, y, z);
}

/// Goes to the line with the numbers of an OFF file, past the optional keyword: OFF behind prefixes that announce more
/// values for each vertex.
inline void read_off_header(Line_reader& in)
{
  in.require_line("the header");
  Line_reader rest = in;
  const std::string_view keyword = rest.word("the header");
  const std::size_t off = keyword.find("OFF");
  if (off == std::string_view::npos) return;
  if (off == 0 && keyword.find_first_not_of("0123456789", 3) == std::string_view::npos && keyword.size() > 3) {
    in.skip(3); // the number of points follows without a blank
    return;
  }
  if (keyword.substr(0, off).find_first_not_of("STCN") != std::string_view::npos || off + 3 != keyword.size())
    in.fail("only three coordinates are supported, not '" + in.printable(keyword) + "'");
  in.word("the header");
  if (in.at_end_of_line()) in.require_line("the numbers of points and facets");
}

/// The colour of a facet of an OFF file, which is the rest of its line: one number of a palette, or three or four from
/// 0 to 1, or up to 255. Empty if there is none, or what is there is none.
inline std::string read_off_colour(Line_reader& in)
{
  std::vector<std::string> words;
  while (!in.at_end_of_line()) words.emplace_back(in.word("a colour"));
  std::array<double, 3> colour{};
  if (words.size() != 1 && words.size() != 3 && words.size() != 4) return "";
  bool is_whole = true;
  for (std::size_t i = 0; i < words.size(); ++i) {
    char* end = nullptr;
    const double value = std::strtod(words[i].c_str(), &end);
    if (*end || !(value >= 0)) return "";
    is_whole = is_whole && words[i].find('.') == std::string::npos;
    if (i < 3) colour[i] = value;
  }
  if (words.size() == 1) return "colour " + words[0];
  return name_of_colour(colour, is_whole ? 255 : 1);
}

/// Reads a facet of an OFF file, which may go over several lines, but for what follows on its last line.
inline std::vector<std::size_t> read_off_facet(Line_reader& in, std::size_t number_of_points)
{
  const long long corners = in.bounded_count("the number of corners");
  std::vector<std::size_t> facet;
  for (long long i = 0; i < corners; ++i) {
    in.require_word("a corner");
    const long long v = in.bounded_count("a corner");
    if (static_cast<std::size_t>(v) >= number_of_points) in.fail("there is no point " + std::to_string(v));
    facet.push_back(static_cast<std::size_t>(v));
  }
  return facet;
}

/// Reads an OFF file. Facets beyond those that it announces are facets, too.
template <class K>
Polygon_soup_3<K> read_off_surface(const std::string& filename)
{
  Line_reader in(filename);
  read_off_header(in);
  const std::size_t number_of_points = in.count("the number of points", 6);
  const std::size_t number_of_facets = in.count("the number of facets", 2);

  Polygon_soup_3<K> soup;
  soup.points.reserve(number_of_points);
  for (std::size_t i = 0; i < number_of_points; ++i) {
    in.require_line("point " + std::to_string(i) + " of " + std::to_string(number_of_points));
    soup.points.push_back(read_coordinates<typename K::Point_3>(in));
  }
  soup.polygons.reserve(number_of_facets);
  Group_collector colours;
  const auto read_facet = [&] {
    soup.polygons.push_back(read_off_facet(in, number_of_points));
    colours.enter(read_off_colour(in));
    colours.add_facet();
  };
  for (std::size_t f = 0; f < number_of_facets; ++f) {
    in.require_line("facet " + std::to_string(f) + " of " + std::to_string(number_of_facets));
    read_facet();
  }
  while (in.next_line()) read_facet(); // not lost without a word
  colours.finish(soup);
  return soup;
}

/// Reads the points (v) and faces (f) of an OBJ file, whose lines go on after a backslash. Objects (o) are groups if
/// there are several, otherwise groups (g), otherwise materials (usemtl).
template <class K>
Polygon_soup_3<K> read_obj_surface(const std::string& filename)
{
  Line_reader in(filename);
  in.join_lines();
  Polygon_soup_3<K> soup;
  const std::array<std::string_view, 3> kinds = {"o", "g", "usemtl"};
  std::array<Group_collector, 3> groups;
  while (in.next_line()) {
    const std::string_view keyword = in.word("a keyword");
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (keyword == kinds[i]) groups[i].enter(in.rest_of_line());
    if (keyword == "v") soup.points.push_back(read_coordinates<typename K::Point_3>(in));
    if (keyword != "f") continue; // the format has some fifty more keywords
    soup.polygons.emplace_back();
    for (Group_collector& kind : groups) kind.add_facet();
    do {
      const std::string_view text = in.word("a corner");
      const long long number = in.parse<long long>(text.substr(0, text.find('/')), "a corner");
      const long long n = static_cast<long long>(soup.points.size());
      if (number == 0 || number > n || number < -n) in.fail("there is no point " + std::to_string(number));
      soup.polygons.back().push_back(static_cast<std::size_t>(number > 0 ? number - 1 : n + number));
    } while (!in.at_end_of_line());
  }
  for (Group_collector& kind : groups)
    if (soup.groups.empty()) kind.finish(soup);
  return soup;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_SURFACE_TEXT_FORMATS_H
