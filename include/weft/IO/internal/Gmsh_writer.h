// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file in Gmsh's format 4.1, ASCII (Gmsh reference manual, "MSH file format"), of a mesh in the plane or in space
// whose nodes and elements have been distributed over entities.

#ifndef WEFT_IO_INTERNAL_GMSH_WRITER_H
#define WEFT_IO_INTERNAL_GMSH_WRITER_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/IO/internal/Text_writer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace weft::internal {

/// A point, curve, surface or volume of the file with what belongs to it.
struct Gmsh_entity
{
  int physical = 0; ///< tag of its physical group; 0: none
  std::string name; ///< of that group; may be empty
  std::array<double, 3> lower, upper;
  std::vector<std::size_t> nodes, elements; ///< indices into the mesh's arrays
  std::set<int> boundary;                   ///< tags of the entities of one dimension less around it, where known

  Gmsh_entity()
  {
    lower.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
  }

  void include(const std::array<double, 3>& p)
  {
    for (std::size_t i = 0; i < 3; ++i) lower[i] = (std::min)(lower[i], p[i]), upper[i] = (std::max)(upper[i], p[i]);
  }
};

/// Entities by dimension and tag.
using Gmsh_entities = std::array<std::map<int, Gmsh_entity>, 4>;

/// Writes the sections in the order in which its functions stand here; each is to be called once, `write_elements()`
/// for each dimension in ascending order.
class Gmsh_writer
{
public:
  /// \param entities have to live as long as this object.
  /// \throws File_error if the file can't be opened for writing.
  WEFT_COLD Gmsh_writer(const std::string& filename, const Gmsh_entities& entities)
      : out_(filename), entities_(entities)
  {
    out_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    write_names();
    write_entities();
  }

  /// \param point coordinates of node v, which is number v + 1 of the file.
  template <class Point>
  WEFT_COLD void write_nodes(const Point& point)
  {
    std::size_t blocks = 0, n = 0;
    for (const auto& of_dimension : entities_)
      for (const auto& [tag, entity] : of_dimension) blocks += !entity.nodes.empty(), n += entity.nodes.size();
    out_ << "$Nodes\n" << blocks << ' ' << n << " 1 " << n << '\n';
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (const auto& [tag, entity] : entities_[as_index(dimension)]) {
        if (entity.nodes.empty()) continue;
        out_ << dimension << ' ' << tag << " 0 " << entity.nodes.size() << '\n';
        for (const std::size_t v : entity.nodes) out_ << v + 1 << '\n';
        for (const std::size_t v : entity.nodes) {
          const std::array<double, 3> p = point(v);
          out_ << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        }
      }
    out_ << "$EndNodes\n";
  }

  WEFT_COLD void begin_elements()
  {
    std::size_t blocks = 0, n = 0;
    for (const auto& of_dimension : entities_)
      for (const auto& [tag, entity] : of_dimension) blocks += !entity.elements.empty(), n += entity.elements.size();
    out_ << "$Elements\n" << blocks << ' ' << n << " 1 " << n << '\n';
  }

  /// The elements of one dimension.
  /// \param vertices nodes of element i.
  /// \param order of the elements, 1 or 2.
  template <class Vertices>
  WEFT_COLD void write_elements(int dimension, const Vertices& vertices, int order = 1)
  {
    // Point, line, triangle, tetrahedron.
    static constexpr std::array<std::array<int, 4>, 2> types{{{{15, 1, 2, 4}}, {{15, 8, 9, 11}}}};
    for (const auto& [tag, entity] : entities_[as_index(dimension)]) {
      if (entity.elements.empty()) continue;
      out_ << dimension << ' ' << tag << ' ' << types[as_index(order - 1)][as_index(dimension)] << ' '
           << entity.elements.size() << '\n';
      for (const std::size_t i : entity.elements) {
        out_ << ++number_;
        for (const std::size_t v : vertices(i)) out_ << ' ' << v + 1;
        out_ << '\n';
      }
    }
  }

  /// Ends the elements and the file.
  /// \throws File_error if anything could not be written.
  WEFT_COLD void close()
  {
    out_ << "$EndElements\n";
    out_.close();
  }

private:
  /// A group's name is that of its first entity that has one.
  void write_names()
  {
    std::map<std::array<int, 2>, std::string> names;
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (const auto& [tag, entity] : entities_[as_index(dimension)])
        if (entity.physical != 0 && !entity.name.empty()) names.try_emplace({dimension, entity.physical}, entity.name);
    if (names.empty()) return;
    out_ << "$PhysicalNames\n" << names.size() << '\n';
    for (const auto& [group, name] : names) {
      out_ << group[0] << ' ' << group[1] << " \"";
      for (const char c : name) out_ << (c == '"' || static_cast<unsigned char>(c) < ' ' ? '\'' : c);
      out_ << "\"\n";
    }
    out_ << "$EndPhysicalNames\n";
  }

  void write_entities()
  {
    out_ << "$Entities\n"
         << entities_[0].size() << ' ' << entities_[1].size() << ' ' << entities_[2].size() << ' '
         << entities_[3].size() << '\n';
    for (std::size_t dimension = 0; dimension <= 3; ++dimension)
      for (const auto& [tag, entity] : entities_[dimension]) {
        out_ << tag << ' ';
        for (const double x : entity.lower) out_ << x << ' ';
        if (dimension > 0)
          for (const double x : entity.upper) out_ << x << ' ';
        if (entity.physical != 0)
          out_ << "1 " << entity.physical;
        else
          out_ << '0';
        if (dimension > 0) {
          out_ << ' ' << entity.boundary.size();
          for (const int part : entity.boundary) out_ << ' ' << part;
        }
        out_ << '\n';
      }
    out_ << "$EndEntities\n";
  }

  Text_writer out_;
  const Gmsh_entities& entities_;
  std::size_t number_ = 0; ///< of the last element
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_GMSH_WRITER_H
