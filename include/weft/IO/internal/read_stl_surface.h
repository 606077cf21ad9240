// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads surfaces from STL files, text or binary. Every facet of an STL file has its own corners: those with exactly the
// same coordinates become one point. Normals and attributes are passed over.

#ifndef WEFT_IO_INTERNAL_READ_STL_SURFACE_H
#define WEFT_IO_INTERNAL_READ_STL_SURFACE_H

#include <weft/IO/internal/Group_collector.h>
#include <weft/IO/internal/Line_reader.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace weft::internal {

/// Collects facets corner by corner; equal corners become one point, numbered by first appearance.
template <class K>
class Point_merger_3
{
public:
  void start_facet() { soup_.polygons.emplace_back(); }
  std::size_t corners_of_facet() const { return soup_.polygons.back().size(); }
  void add_corner(double x, double y, double z)
  {
    const auto [place, is_new] = numbers_.emplace(std::array<double, 3>{x, y, z}, soup_.points.size());
    if (is_new) soup_.points.emplace_back(x, y, z);
    soup_.polygons.back().push_back(place->second);
  }
  Polygon_soup_3<K>& soup() { return soup_; }

private:
  Polygon_soup_3<K> soup_;
  std::map<std::array<double, 3>, std::size_t> numbers_;
};

/// Reads a text STL; solids in it are groups.
template <class K>
Polygon_soup_3<K> read_text_stl(const std::string& filename)
{
  Line_reader in(filename);
  Point_merger_3<K> merger;
  Group_collector solids;
  bool in_solid = false, in_facet = false;
  while (in.next_line()) {
    const std::string_view keyword = in.word("a keyword");
    if (keyword == "solid") {
      in_solid = true;
      solids.enter_another(in.rest_of_line());
    } else if (keyword == "facet") {
      if (!in_solid || in_facet) in.fail("unexpected 'facet'");
      in_facet = true;
      merger.start_facet();
      solids.add_facet();
    } else if (keyword == "vertex") {
      if (!in_facet) in.fail("a vertex outside of a facet");
      const double x = in.number("x"), y = in.number("y"), z = in.number("z");
      merger.add_corner(x, y, z);
    } else if (keyword == "endfacet") {
      if (!in_facet || merger.corners_of_facet() != 3) in.fail("a facet needs three vertices");
      in_facet = false;
    } else if (keyword == "endsolid") {
      if (in_facet) in.fail("the solid ends within a facet");
      in_solid = false;
    } else if (keyword != "outer" && keyword != "endloop") {
      in.fail("unknown keyword '" + in.printable(keyword) + "'");
    }
  }
  if (in_solid) in.fail("the file ends where 'endsolid' should follow");
  solids.finish(merger.soup());
  merger.soup().groups_are_solids = !merger.soup().groups.empty();
  return std::move(merger.soup());
}

constexpr std::size_t stl_header_bytes = 84, stl_facet_bytes = 50;

/// A little-endian integer of four bytes.
inline std::uint32_t stl_integer(const std::string& bytes, std::size_t at)
{
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

inline float stl_float(const std::string& bytes, std::size_t at)
{
  static_assert(sizeof(float) == 4, "binary STL holds floats of four bytes");
  const std::uint32_t pattern = stl_integer(bytes, at);
  float value;
  std::memcpy(&value, &pattern, sizeof value);
  return value;
}

/// Reads the facets of a binary STL.
/// \pre The bytes are complete.
template <class K>
Polygon_soup_3<K> read_binary_stl(const std::string& filename, const std::string& bytes)
{
  Point_merger_3<K> merger;
  for (std::size_t at = stl_header_bytes; at < bytes.size(); at += stl_facet_bytes) {
    merger.start_facet();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<double, 3> p{};
      for (std::size_t i = 0; i < 3; ++i) p[i] = stl_float(bytes, at + 12 + 12 * corner + 4 * i); // behind the normal
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        throw File_error(filename, 0,
                         "facet " + std::to_string((at - stl_header_bytes) / stl_facet_bytes) +
                             " has coordinates that aren't finite");
      merger.add_corner(p[0], p[1], p[2]);
    }
  }
  return std::move(merger.soup());
}

/// Reads an STL file. Binary ones are known by their size, as some begin with the keyword of text files.
template <class K>
Polygon_soup_3<K> read_stl_surface(const std::string& filename)
{
  std::ifstream in(filename, std::ios::binary);
  if (!in) throw File_error(filename, 0, "can't be opened");
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const bool has_header = bytes.size() >= stl_header_bytes;
  const std::size_t facets = has_header ? stl_integer(bytes, stl_header_bytes - 4) : 0;
  if (has_header && bytes.size() == stl_header_bytes + facets * stl_facet_bytes)
    return read_binary_stl<K>(filename, bytes);
  if (has_header && bytes.compare(0, 5, "solid") != 0 && facets > 0 &&
      bytes.size() > stl_header_bytes + facets * stl_facet_bytes) // padded
    return read_binary_stl<K>(filename, bytes.substr(0, stl_header_bytes + facets * stl_facet_bytes));
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) throw File_error(filename, 0, "the file is empty");
  if (bytes.compare(start, 5, "solid") == 0) return read_text_stl<K>(filename);
  throw File_error(filename, 0,
                   has_header ? "neither text nor a binary STL of " + std::to_string(facets) +
                                    " facets, which its header announces: the size doesn't fit"
                              : std::string("neither text nor binary STL"));
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_READ_STL_SURFACE_H
