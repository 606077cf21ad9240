// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the boundaries of a tetrahedral mesh and of its subdomains are closed surfaces.

#ifndef WEFT_SPATIAL_MESH_CHECK_MANIFOLD_3_H
#define WEFT_SPATIAL_MESH_CHECK_MANIFOLD_3_H

#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/subdomain_boundaries_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

inline void check_manifold_edges(const std::vector<Boundary_facet_3>& boundary, Validity_3& validity)
{
  std::vector<std::pair<int, std::array<std::size_t, 2>>> edges; // one entry for each facet beside the edge
  for (const auto& [subdomain, f] : boundary)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({subdomain, sorted<2>({f[i], f[(i + 1) % 3]})});
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    if (last - first != 2)
      validity.add(Fault_kind_3::manifold,
                   "an edge has " + std::to_string(last - first) + " facets of the boundary of subdomain " +
                       std::to_string(first->first),
                   listed(first->second));
    first = last;
  }
}

/// The facets around a vertex must be connected through their edges: one umbrella.
inline void check_manifold_vertices(const std::vector<Boundary_facet_3>& boundary, Validity_3& validity)
{
  struct Link_edge
  {
    int subdomain;
    std::size_t vertex;
    std::array<std::size_t, 2> edge;
  };
  std::vector<Link_edge> links;
  for (const auto& [subdomain, f] : boundary)
    for (std::size_t i = 0; i < 3; ++i) links.push_back({subdomain, f[i], {f[(i + 1) % 3], f[(i + 2) % 3]}});
  const auto key = [](const Link_edge& l) { return std::pair(l.subdomain, l.vertex); };
  std::sort(links.begin(), links.end(), [&](const Link_edge& a, const Link_edge& b) {
    return key(a) != key(b) ? key(a) < key(b) : a.edge < b.edge;
  });
  for (auto first = links.begin(); first != links.end();) {
    std::vector<std::array<std::size_t, 2>> edges;
    auto last = first;
    for (; last != links.end() && key(*last) == key(*first); ++last) edges.push_back(last->edge);
    const std::size_t umbrellas = number_of_components(edges);
    if (umbrellas != 1)
      validity.add(Fault_kind_3::manifold,
                   "a vertex has " + std::to_string(umbrellas) + " umbrellas on the boundary of subdomain " +
                       std::to_string(first->subdomain),
                   {first->vertex});
    first = last;
  }
}

} // namespace internal

/// Checks that the boundary of every subdomain, as the cells give it, is a closed 2-manifold: two facets at every edge,
/// one umbrella of facets at every vertex. O(n log n) time.
template <class K>
Validity_3 check_manifold_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const auto boundary = internal::subdomain_boundaries(mesh);
  internal::check_manifold_edges(boundary, validity);
  internal::check_manifold_vertices(boundary, validity);
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_MANIFOLD_3_H
