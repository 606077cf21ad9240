// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundaries of the subdomains of a tetrahedral mesh, and what they are like as surfaces.

#ifndef WEFT_SPATIAL_MESH_SUBDOMAIN_BOUNDARIES_3_H
#define WEFT_SPATIAL_MESH_SUBDOMAIN_BOUNDARIES_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace weft::internal {

/// A facet as the boundary of one subdomain has it.
struct Boundary_facet_3
{
  int subdomain;
  std::array<std::size_t, 3> vertices; ///< counterclockwise seen from outside the subdomain
};

/// The boundaries of all subdomains; an interface is there twice.
template <class K>
std::vector<Boundary_facet_3> subdomain_boundaries(const Tetrahedral_mesh_3<K>& mesh)
{
  std::vector<Boundary_facet_3> boundary;
  for_each_facet(mesh.cells, [&](auto first, auto last) {
    if (last - first == 2 && mesh.subdomains[first->cell] == mesh.subdomains[(first + 1)->cell]) return;
    for (auto side = first; side != last; ++side)
      boundary.push_back({mesh.subdomains[side->cell], outward_vertices(mesh.cells[side->cell], side->opposite)});
  });
  return boundary;
}

/// Number of connected components of a graph given by its edges. O(n log n).
inline std::size_t number_of_components(const std::vector<std::array<std::size_t, 2>>& edges)
{
  std::vector<std::size_t> vertices;
  for (const auto& edge : edges) vertices.insert(vertices.end(), edge.begin(), edge.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto number = [&vertices](std::size_t v) {
    return static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  Disjoint_parts parts(vertices.size());
  for (const auto& [v, w] : edges) parts.unite(number(v), number(w));
  std::size_t components = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) components += parts.find(i) == i;
  return components;
}

/// V - E + F and the number of connected components of a triangle surface.
inline std::array<long, 2> topology_of_facets(const std::vector<std::array<std::size_t, 3>>& facets)
{
  std::vector<std::array<std::size_t, 2>> edges, links;
  std::vector<std::size_t> vertices;
  for (const auto& f : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(sorted<2>({f[i], f[(i + 1) % 3]}));
      vertices.push_back(f[i]);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return {static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + static_cast<long>(facets.size()),
          static_cast<long>(number_of_components(edges))};
}

/// The same of the boundary of each subdomain.
template <class K>
std::map<int, std::array<long, 2>> topology_of_subdomains(const Tetrahedral_mesh_3<K>& mesh)
{
  std::map<int, std::vector<std::array<std::size_t, 3>>> boundaries;
  for (const Boundary_facet_3& facet : subdomain_boundaries(mesh))
    boundaries[facet.subdomain].push_back(facet.vertices);
  std::map<int, std::array<long, 2>> result;
  for (const auto& [subdomain, facets] : boundaries) result[subdomain] = topology_of_facets(facets);
  return result;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_SUBDOMAIN_BOUNDARIES_3_H
