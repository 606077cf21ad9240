// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads tetrahedral meshes in Gmsh's formats 2 and 4.1, ASCII (Gmsh reference manual, "MSH file format"). The tag of an
// element is its first physical group, or its elementary entity where it has none. Points of the geometry are corners,
// line elements edges of creases.

#ifndef WEFT_IO_READ_GMSH_3_H
#define WEFT_IO_READ_GMSH_3_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/read_elements.h>
#include <weft/IO/internal/Svg_canvas.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Reads one file; `IO::read_gmsh_3()` runs it.
template <class K>
class Gmsh_reader_3
{
public:
  explicit Gmsh_reader_3(const std::string& filename) : in_(filename) {}

  Element_soup_3<K> run()
  {
    soup_.first_number = 1;
    bool has_format = false;
    while (in_.next_line()) {
      const std::string section(in_.word("a section"));
      if (section.empty() || section[0] != '$')
        in_.fail("a section should begin, not '" + Line_reader::printable(section) + "'");
      if (section == "$MeshFormat")
        has_format = read_format();
      else if (!has_format)
        in_.fail("a .msh file should begin with '$MeshFormat'");
      else if (section == "$Entities" && is_4_)
        read_entities();
      else if (section == "$Nodes")
        is_4_ ? read_nodes_4() : read_nodes_2();
      else if (section == "$Elements")
        is_4_ ? read_elements_4() : read_elements_2();
      else {
        skip(section);
        continue;
      }
      in_.require_line("$End" + section.substr(1));
      if (in_.word("the end of the section") != "$End" + section.substr(1))
        in_.fail("the section " + section + " should end here");
    }
    if (!has_format) in_.fail("a .msh file should begin with '$MeshFormat'");
    return std::move(soup_);
  }

private:
  bool read_format()
  {
    in_.require_line("the version");
    const double version = in_.number("the version"); // Netgen writes 2.000000
    is_4_ = version == 4.1;
    if (!is_4_ && !(version >= 2 && version <= 2.2))
      in_.fail("this is version " + one_decimal(version) + "; only 2 to 2.2 and 4.1 can be read");
    if (in_.integer("the type of file") != 0) in_.fail("the file is binary; only ASCII can be read");
    return true;
  }

  void skip(const std::string& section)
  {
    const std::string end = "$End" + section.substr(1);
    do in_.require_line(end);
    while (in_.word("") != end);
    if (section != "$PhysicalNames" && section != "$Comments") soup_.notes.push_back("section " + section + " skipped");
  }

  /// The first physical group of every entity that has one.
  void read_entities()
  {
    in_.require_line("numbers of entities");
    std::array<std::size_t, 4> counts;
    for (std::size_t& n : counts) n = in_.count("a number of entities", 2);
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        in_.require_line("an entity");
        const int tag = in_.marker("the tag of an entity");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.number("a bound");
        const long long groups = in_.bounded_count("the number of physical groups");
        if (groups > 0) physical_[{dimension, tag}] = in_.marker("a physical group");
      }
  }

  int tag_of(int dimension, int entity) const
  {
    const auto found = physical_.find({dimension, entity});
    return found == physical_.end() || found->second == 0 ? entity : found->second;
  }

  // ---- nodes

  void read_nodes_2()
  {
    in_.require_line("the number of nodes");
    const std::size_t n = in_.count("the number of nodes", 8);
    for (std::size_t i = 0; i < n; ++i) {
      in_.require_line("node " + std::to_string(i + 1) + " of " + std::to_string(n));
      const long long tag = in_.integer("the number of the node");
      add_node(tag, read_point_3<typename K::Point_3>(in_), 0);
    }
    number_nodes();
  }

  void read_nodes_4()
  {
    in_.require_line("numbers of nodes");
    const long long blocks = in_.bounded_count("the number of blocks");
    in_.count("the number of nodes", 6);
    std::vector<long long> tags;
    for (long long b = 0; b < blocks; ++b) {
      in_.require_line("a block of nodes");
      const long long dimension = in_.integer("the dimension of an entity");
      const int entity = in_.marker("the tag of an entity");
      in_.integer("whether nodes have parameters");
      const std::size_t n = in_.count("the number of nodes", 6);
      tags.clear();
      for (std::size_t i = 0; i < n; ++i) {
        in_.require_line("the number of a node");
        tags.push_back(in_.integer("the number of a node"));
      }
      for (const long long tag : tags) {
        in_.require_line("a node");
        add_node(tag, read_point_3<typename K::Point_3>(in_), tag_of(static_cast<int>(dimension), entity));
      }
    }
    number_nodes();
  }

  void add_node(long long tag, const typename K::Point_3& p, int entity)
  {
    if (!nodes_.emplace(tag, Node{p, entity, 0}).second) in_.fail("node " + std::to_string(tag) + " is there twice");
  }

  void number_nodes()
  {
    for (auto& [tag, node] : nodes_) {
      node.number = soup_.points.size();
      soup_.points.push_back(node.point);
      if (is_4_) soup_.point_tags.push_back(node.entity);
    }
    if (!nodes_.empty()) soup_.first_number = nodes_.begin()->first == 0 ? 0 : 1;
  }

  // ---- elements

  void read_elements_2()
  {
    in_.require_line("the number of elements");
    const std::size_t n = in_.count("the number of elements", 8);
    for (std::size_t i = 0; i < n; ++i) {
      in_.require_line("element " + std::to_string(i + 1) + " of " + std::to_string(n));
      in_.integer("the number of the element");
      const long long type = in_.integer("the type of the element"), tags = in_.bounded_count("the number of tags");
      int physical = 0, elementary = 0;
      for (long long k = 0; k < tags; ++k) {
        const int tag = in_.marker("a tag");
        if (k == 0) physical = tag;
        if (k == 1) elementary = tag;
      }
      add_element(type, physical != 0 ? physical : elementary);
    }
  }

  void read_elements_4()
  {
    in_.require_line("numbers of elements");
    const long long blocks = in_.bounded_count("the number of blocks");
    for (long long b = 0; b < blocks; ++b) {
      in_.require_line("a block of elements");
      const long long dimension = in_.integer("the dimension of an entity");
      const int entity = in_.marker("the tag of an entity");
      const long long type = in_.integer("the type of elements");
      const std::size_t n = in_.count("the number of elements", 4);
      for (std::size_t i = 0; i < n; ++i) {
        in_.require_line("element " + std::to_string(i + 1) + " of " + std::to_string(n));
        in_.integer("the number of the element");
        add_element(type, tag_of(static_cast<int>(dimension), entity));
      }
    }
  }

  void add_element(long long type, int tag)
  {
    if (type == 4) {
      soup_.cell_lines.push_back(in_.line());
      soup_.cells.push_back(vertices<4>());
      soup_.cell_tags.push_back(tag);
    } else if (type == 2) {
      soup_.facets.push_back(vertices<3>());
      soup_.facet_tags.push_back(tag);
    } else if (type == 1) {
      soup_.edges.push_back(vertices<2>());
      soup_.edge_tags.push_back(tag);
    } else if (type == 15) {
      soup_.corners.push_back(vertices<1>()[0]);
    } else {
      in_.fail("an element of type " + std::to_string(type) +
               "; only straight tetrahedra (4), triangles (2), lines (1) and points (15) can be read");
    }
  }

  template <std::size_t N>
  std::array<std::size_t, N> vertices()
  {
    std::array<std::size_t, N> result;
    for (std::size_t& v : result) {
      const long long tag = in_.integer("a node");
      const auto found = nodes_.find(tag);
      if (found == nodes_.end()) in_.fail("there is no node " + std::to_string(tag));
      v = found->second.number;
    }
    in_.require_end_of_line();
    return result;
  }

  struct Node
  {
    typename K::Point_3 point;
    int entity;
    std::size_t number;
  };

  Line_reader in_;
  Element_soup_3<K> soup_;
  bool is_4_ = false;
  std::map<long long, Node> nodes_;
  std::map<std::pair<int, int>, int> physical_; ///< by dimension and tag of the entity
};

} // namespace internal

namespace IO {

/// Reads the tetrahedra of a .msh file, with triangles, lines and points of their boundary. Points keep the order of
/// their numbers.
/// \throws File_error with the line if the file is missing, cut, malformed, binary, has other elements, or if its
///   elements don't make a mesh; see `assemble_mesh_3()`.
template <class K>
Imported_mesh_3<K> read_gmsh_3(const std::string& filename)
{
  return weft::internal::assemble_from_file(filename, weft::internal::Gmsh_reader_3<K>(filename).run());
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_GMSH_3_H
