// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the checks of spatial meshes find: faults by kind, with the vertices that are to blame.

#ifndef WEFT_SPATIAL_MESH_VALIDITY_3_H
#define WEFT_SPATIAL_MESH_VALIDITY_3_H

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What can be wrong with a spatial mesh.
enum class Fault_kind_3
{
  structure,   ///< the arrays don't make a mesh: sizes, indices, repeated or isolated vertices, facets of three cells
  orientation, ///< a cell is turned over or flat
  delaunay,    ///< a facet isn't locally Delaunay
  boundary,    ///< the facets listed aren't those of the boundary, or look inwards
  manifold,    ///< the boundary isn't a 2-manifold
  location,    ///< vertices, crease edges and facets don't agree about what they lie on
  distance,    ///< a vertex is off its patch, crease or feature
  size,        ///< an edge is longer than the criteria allow
  shape,       ///< a facet or cell is shaped worse than the criteria allow
  topology,    ///< a facet joins vertices of several patches, or a crease edge vertices of several creases
  restricted   ///< what is kept of a restricted Delaunay triangulation isn't what the oracle says
};

/// Name of a kind of fault for people.
inline const char* name(Fault_kind_3 kind)
{
  constexpr std::array<const char*, 11> names = {"structure", "orientation", "delaunay",  "boundary",
                                                 "manifold",  "location",    "distance",  "size",
                                                 "shape",     "topology",    "restricted"};
  return names[static_cast<std::size_t>(kind)];
}

/// One thing that is wrong.
struct Fault_3
{
  Fault_kind_3 kind;
  std::string text;                  ///< one line for a person, with the vertices
  std::vector<std::size_t> vertices; ///< to blame, as indices: one a vertex, two an edge, three a facet, four a cell
};

/// What the checks found.
struct Validity_3
{
  static constexpr std::size_t most_listed = 100; ///< faults of one kind; more are only counted

  std::vector<Fault_3> faults;          ///< in the order in which they were found
  std::array<std::size_t, 11> counts{}; ///< number of faults by kind, listed or not

  bool ok() const { return counts == std::array<std::size_t, 11>{}; }
  std::size_t count(Fault_kind_3 kind) const { return counts[static_cast<std::size_t>(kind)]; }

  void add(Fault_kind_3 kind, const std::string& what, std::vector<std::size_t> vertices = {})
  {
    if (++counts[static_cast<std::size_t>(kind)] > most_listed) return;
    std::string text = what;
    if (!vertices.empty()) text += vertices.size() == 1 ? ": vertex" : ": vertices";
    for (const std::size_t v : vertices) text += " " + std::to_string(v);
    faults.push_back({kind, std::move(text), std::move(vertices)});
  }

  Validity_3& operator+=(const Validity_3& other)
  {
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
    return *this;
  }
};

/// One line a fault, or "valid".
inline std::ostream& operator<<(std::ostream& out, const Validity_3& validity)
{
  for (const Fault_3& fault : validity.faults) out << name(fault.kind) << ": " << fault.text << "\n";
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if (validity.counts[i] > Validity_3::most_listed)
      out << name(static_cast<Fault_kind_3>(i)) << ": " << validity.counts[i] << " faults in all\n";
  return validity.ok() ? out << "valid\n" : out;
}

namespace internal {

/// As faults have them.
template <std::size_t N>
std::vector<std::size_t> listed(const std::array<std::size_t, N>& vertices)
{
  return {vertices.begin(), vertices.end()};
}

} // namespace internal

} // namespace weft

#endif // WEFT_SPATIAL_MESH_VALIDITY_3_H
