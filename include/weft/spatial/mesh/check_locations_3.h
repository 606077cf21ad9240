// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the vertices of a tetrahedral mesh agree with the facets and crease edges around them.

#ifndef WEFT_SPATIAL_MESH_CHECK_LOCATIONS_3_H
#define WEFT_SPATIAL_MESH_CHECK_LOCATIONS_3_H

#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// Feature vertices are those listed as corners, once each and in the order of the input's.
template <class K>
void check_corners(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::vector<char> is_listed(mesh.points.size(), 0);
  int last_index = -1;
  for (const std::size_t v : mesh.corners) {
    is_listed[v] = 1;
    if (mesh.locations[v].dimension != 0)
      validity.add(Fault_kind_3::location, "a corner isn't a feature vertex", {v});
    else if (mesh.locations[v].index <= last_index)
      validity.add(Fault_kind_3::location, "a corner is out of order or there twice", {v});
    else
      last_index = mesh.locations[v].index;
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.locations[v].dimension == 0 && !is_listed[v])
      validity.add(Fault_kind_3::location, "a feature vertex isn't listed as corner", {v});
}

/// A vertex on a crease has two edges, both of that crease; a crease edge ends on its crease or at feature vertices
/// and is an edge of a facet. So the edges of a crease form chains between feature vertices, or cycles.
template <class K>
void check_creases(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::set<std::array<std::size_t, 2>> boundary_edges;
  for (const auto& f : mesh.facets)
    for (int i = 0; i < 3 && !mesh.edges.empty(); ++i) boundary_edges.insert(sorted<2>({f[i], f[(i + 1) % 3]}));
  std::vector<int> edges_at(mesh.points.size(), 0);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (boundary_edges.count(sorted(mesh.edges[e])) == 0)
      validity.add(Fault_kind_3::location, "a crease edge isn't on the boundary", listed(mesh.edges[e]));
    for (const std::size_t v : mesh.edges[e]) {
      ++edges_at[v];
      const auto& location = mesh.locations[v];
      if (location.dimension > 1)
        validity.add(Fault_kind_3::location, "a crease edge ends at a vertex that isn't on a crease", {v});
      else if (location.dimension == 1 && location.index != mesh.creases[e])
        validity.add(Fault_kind_3::location, "a crease edge ends on another crease", listed(mesh.edges[e]));
    }
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.locations[v].dimension == 1 && edges_at[v] != 2)
      validity.add(Fault_kind_3::location, "a vertex on a crease has " + std::to_string(edges_at[v]) + " crease edges",
                   {v});
}

/// Vertices of features, creases and patches are on the boundary, those inside aren't and have cells of one subdomain.
template <class K>
void check_sides(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::vector<char> on_boundary(mesh.points.size(), 0);
  for (const auto& facet : mesh.facets)
    for (const std::size_t v : facet) on_boundary[v] = 1;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const bool inside = mesh.locations[v].dimension == 3;
    if (inside && on_boundary[v]) validity.add(Fault_kind_3::location, "a vertex inside is on the boundary", {v});
    if (!inside && !on_boundary[v])
      validity.add(Fault_kind_3::location, "a vertex of the surface has no boundary facet", {v});
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const std::size_t v : mesh.cells[c])
      if (mesh.locations[v].dimension == 3 && mesh.locations[v].index != mesh.subdomains[c])
        validity.add(Fault_kind_3::location, "a vertex inside has a cell of another subdomain", {v});
}

} // namespace internal

/// Checks that vertices, crease edges and boundary facets agree: the corners are the feature vertices; crease edges
/// form chains between feature vertices or cycles, on the boundary; vertices of the surface are on the boundary, and
/// only they are. Boundary facets and crease edges may still join vertices of several patches or creases, see
/// `check_topology_3()` in check_criteria_3.h. O(n log n) time.
template <class K>
Validity_3 check_locations_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  internal::check_corners(mesh, validity);
  internal::check_creases(mesh, validity);
  internal::check_sides(mesh, validity);
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_LOCATIONS_3_H
