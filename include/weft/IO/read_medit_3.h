// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads tetrahedral meshes in Medit's .mesh format, text (Frey, "Medit: an interactive mesh visualization software",
// INRIA 2001). References are tags. Required vertices are corners; sections that say nothing about tetrahedra, their
// boundary and its features are skipped and noted.

#ifndef WEFT_IO_READ_MEDIT_3_H
#define WEFT_IO_READ_MEDIT_3_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/read_elements.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Reads one file; `IO::read_medit_3()` runs it.
template <class K>
class Medit_reader_3
{
public:
  /// \param may_be_planar whether the dimension may be 2: then points have no z.
  explicit Medit_reader_3(const std::string& filename, bool may_be_planar = false)
      : in_(filename), may_be_planar_(may_be_planar)
  {}

  Element_soup_3<K> run()
  {
    soup_.first_number = 1;
    in_.require_word("'MeshVersionFormatted'");
    if (in_.word("") != "MeshVersionFormatted") in_.fail("a .mesh file should begin with 'MeshVersionFormatted'");
    in_.require_word("the version");
    in_.integer("the version");
    bool ended = false;
    while (!ended && (!in_.at_end_of_line() || in_.next_line())) ended = !read_section(std::string(in_.word("")));
    for (const auto& corner : corners_) soup_.corners.push_back(corner.second);
    return std::move(soup_);
  }

private:
  /// False at the end.
  bool read_section(const std::string& name)
  {
    if (name == "End") return false;
    if (name == "Dimension") {
      in_.require_word("the dimension");
      const long long dimension = in_.integer("the dimension");
      is_planar_ = may_be_planar_ && dimension == 2;
      if (dimension != 3 && !is_planar_) in_.fail("the dimension should be 3, not " + std::to_string(dimension));
    } else if (name == "Vertices") {
      read_points();
    } else if (name == "Tetrahedra") {
      read_elements(soup_.cells, soup_.cell_tags, true);
    } else if (name == "Triangles") {
      read_elements(soup_.facets, soup_.facet_tags, false);
    } else if (name == "Edges") {
      read_elements(soup_.edges, soup_.edge_tags, false);
    } else if (name == "Corners" || name == "RequiredVertices") {
      read_corners();
    } else {
      skip(name);
    }
    return true;
  }

  std::size_t read_count(std::size_t bytes_each)
  {
    in_.require_word("a number of elements");
    return in_.count("the number of elements", bytes_each);
  }

  int read_tag()
  {
    in_.require_word("a reference");
    return in_.marker("the reference");
  }

  void read_points()
  {
    const std::size_t n = read_count(8);
    for (std::size_t i = 0; i < n; ++i) {
      if (is_planar_) {
        in_.require_word("x");
        const double x = in_.number("x");
        in_.require_word("y");
        soup_.points.emplace_back(x, in_.number("y"), 0);
      } else {
        soup_.points.push_back(read_point_3<typename K::Point_3>(in_));
      }
      soup_.point_tags.push_back(read_tag());
    }
  }

  template <std::size_t N>
  void read_elements(std::vector<std::array<std::size_t, N>>& elements, std::vector<int>& tags, bool are_cells)
  {
    const std::size_t n = read_count(2 * N + 2);
    for (std::size_t i = 0; i < n; ++i) {
      in_.require_word("an element");
      if (are_cells) soup_.cell_lines.push_back(in_.line());
      elements.push_back(read_vertices<N>(in_, 1, soup_.points.size()));
      tags.push_back(read_tag());
    }
  }

  void read_corners()
  {
    const std::size_t n = read_count(2);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t v = read_vertices<1>(in_, 1, soup_.points.size())[0];
      corners_.insert({soup_.point_tags[v], v}); // corners are often listed as required vertices, too
    }
  }

  /// Passes over the numbers of a section.
  void skip(const std::string& name)
  {
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0])))
      in_.fail("a keyword should follow, not '" + Line_reader::printable(name) + "'");
    in_.require_word("the number of elements");
    const std::size_t n = in_.count("the number of elements", 2);
    static const char* const refused[] = {"Quadrilaterals", "Hexahedra",   "Prisms",  "Pyramids",
                                          "TetrahedraP2",   "TrianglesP2", "EdgesP2", "Pentahedra"};
    if (n > 0 && std::find(std::begin(refused), std::end(refused), name) != std::end(refused))
      in_.fail("there are " + name + "; only straight tetrahedra, triangles and edges can be read");
    while (in_.at_end_of_line() ? in_.next_line() : true) {
      if (std::isalpha(static_cast<unsigned char>(in_.front()))) break;
      in_.number("a number of the section " + name);
    }
    if (n > 0 && name != "Ridges" && name != "RequiredEdges") soup_.notes.push_back("section " + name + " skipped");
  }

  Line_reader in_;
  bool may_be_planar_, is_planar_ = false;
  Element_soup_3<K> soup_;
  std::set<std::pair<int, std::size_t>> corners_; ///< by their tags, as weft numbers features
};

} // namespace internal

namespace IO {

/// Reads the tetrahedra of a .mesh file, text, with triangles, edges and corners of their boundary.
/// \throws File_error with the line if the file is missing, cut, malformed, has other cells than tetrahedra, or if its
///   elements don't make a mesh; see `assemble_mesh_3()`.
template <class K>
Imported_mesh_3<K> read_medit_3(const std::string& filename)
{
  return weft::internal::assemble_from_file(filename, weft::internal::Medit_reader_3<K>(filename).run());
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_MEDIT_3_H
