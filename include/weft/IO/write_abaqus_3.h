// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a spatial mesh of first or second order as an input deck of Abaqus and CalculiX (keywords *NODE, *ELEMENT,
// *SURFACE, *NSET): elements of type C3D4 or C3D10, a set of elements for each subdomain, for each patch a surface of
// element faces and a set of nodes. Loads, materials and steps are up to the user.

#ifndef WEFT_IO_WRITE_ABAQUS_3_H
#define WEFT_IO_WRITE_ABAQUS_3_H

#include <weft/internal/cold.h>
#include <weft/IO/internal/Mesh_nodes_3.h>
#include <weft/IO/internal/Text_writer.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Mesh_names_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// A name as decks take it: letters, digits and underscores, the first a letter; at most 80 characters.
inline std::string abaqus_name(const std::string& name)
{
  std::string result;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'), is_digit = c >= '0' && c <= '9';
    result += is_letter || is_digit ? c : '_';
  }
  if (result.empty() || (result[0] >= '0' && result[0] <= '9') || result[0] == '_') result.insert(0, "N_");
  return result.substr(0, 80);
}

/// Names of the parts with these numbers: those that they were given, else `kind` and the number; none twice.
inline std::map<int, std::string> abaqus_names(const std::set<int>& numbers, const std::map<int, std::string>& given,
                                               const std::string& kind)
{
  std::map<int, std::string> result;
  std::set<std::string> taken;
  for (const int number : numbers) {
    const auto found = given.find(number);
    const std::string own = kind + '_' + std::to_string(number);
    std::string name = found == given.end() ? own : abaqus_name(found->second);
    if (!taken.insert(name).second) name = name.substr(0, 60) + '_' + own;
    taken.insert(name);
    result[number] = name;
  }
  return result;
}

/// Numbers, at most 16 on a line.
WEFT_COLD inline void write_abaqus_numbers(Text_writer& out, const std::set<std::size_t>& indices)
{
  std::size_t on_line = 0;
  for (const std::size_t i : indices) {
    if (on_line > 0) out << (on_line % 16 == 0 ? ",\n" : ", ");
    out << i + 1;
    ++on_line;
  }
  out << '\n';
}

template <class K>
WEFT_COLD void write_abaqus(const std::string& filename, Mesh_nodes_3<K> nodes, const Mesh_names_3& names)
{
  const Tetrahedral_mesh_3<K>& mesh = nodes.mesh();
  const std::set<int> subdomains(mesh.subdomains.begin(), mesh.subdomains.end()),
      patches(mesh.patches.begin(), mesh.patches.end());
  const auto name_of_subdomain = abaqus_names(subdomains, names.subdomains, "SUBDOMAIN"),
             name_of_patch = abaqus_names(patches, names.patches, "PATCH");
  Text_writer out(filename);
  out << "*HEADING\nweft\n*NODE\n";
  for (std::size_t i = 0; i < nodes.number_of_nodes(); ++i) {
    const Xyz_3 p = nodes.node(i);
    out << i + 1 << ", " << p[0] << ", " << p[1] << ", " << p[2] << '\n';
  }
  for (const auto& [subdomain, name] : name_of_subdomain) {
    out << "*ELEMENT, TYPE=" << (nodes.is_quadratic() ? "C3D10" : "C3D4") << ", ELSET=" << name << '\n';
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      if (mesh.subdomains[c] != subdomain) continue;
      out << c + 1;
      for (const std::size_t v : nodes.cell(c)) out << ", " << v + 1;
      out << '\n';
    }
  }
  std::map<std::array<std::size_t, 3>, std::size_t> facet_of;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) facet_of[sorted(mesh.facets[f])] = f;
  // Faces 1 to 4 of an element, without its vertex 3, 2, 0, 1. Where a facet has cells on both sides both are there.
  static constexpr std::array<std::array<std::size_t, 3>, 4> faces{
      {{{0, 1, 2}}, {{0, 3, 1}}, {{1, 3, 2}}, {{2, 3, 0}}}};
  std::map<int, std::vector<std::array<std::size_t, 2>>> faces_of;
  std::map<int, std::set<std::size_t>> nodes_of;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& cell = mesh.cells[c];
      const auto found = facet_of.find(sorted<3>({cell[faces[i][0]], cell[faces[i][1]], cell[faces[i][2]]}));
      if (found != facet_of.end()) faces_of[mesh.patches[found->second]].push_back({c + 1, i + 1});
    }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const std::size_t v : nodes.facet(f)) nodes_of[mesh.patches[f]].insert(v);
  for (const auto& [patch, name] : name_of_patch) {
    out << "*SURFACE, NAME=" << name << ", TYPE=ELEMENT\n";
    for (const auto& face : faces_of[patch]) out << face[0] << ", S" << face[1] << '\n';
    out << "*NSET, NSET=" << name << "_NODES\n";
    write_abaqus_numbers(out, nodes_of[patch]);
  }
  out.close();
}

} // namespace internal

namespace IO {

/// Writes a mesh as an .inp file. Nodes, elements and their faces count from 1, in the order of the arrays; a facet
/// between two subdomains is a face of both of its elements.
/// \param names of sets of elements and of surfaces; `SUBDOMAIN_1` and `PATCH_0` and the like where there are none.
///   Characters that decks don't take become underscores.
/// \throws File_error if the file can't be written. O(n log n).
template <class K>
WEFT_COLD void write_abaqus(const std::string& filename, const Tetrahedral_mesh_3<K>& mesh,
                            const Mesh_names_3& names = Mesh_names_3())
{
  internal::write_abaqus(filename, internal::Mesh_nodes_3<K>(mesh), names);
}

/// The same of second order.
template <class K>
WEFT_COLD void write_abaqus(const std::string& filename, const Quadratic_mesh_3<K>& mesh,
                            const Mesh_names_3& names = Mesh_names_3())
{
  internal::write_abaqus(filename, internal::Mesh_nodes_3<K>(mesh), names);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_ABAQUS_3_H
