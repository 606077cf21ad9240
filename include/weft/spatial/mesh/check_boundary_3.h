// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the boundary of a tetrahedral mesh is listed completely and looks outwards.

#ifndef WEFT_SPATIAL_MESH_CHECK_BOUNDARY_3_H
#define WEFT_SPATIAL_MESH_CHECK_BOUNDARY_3_H

#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <array>
#include <cstddef>
#include <map>

namespace weft {

/// Checks that the facets listed are exactly those with one cell or between different subdomains, and that those with
/// one cell are counterclockwise seen from outside; an interface may look either way. O(n log n) time.
template <class K>
Validity_3 check_boundary_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  std::map<std::array<std::size_t, 3>, std::size_t> wanting; // the facets not found yet
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) wanting.emplace(internal::sorted(mesh.facets[f]), f);
  internal::for_each_facet(mesh.cells, [&](auto first, auto last) {
    const bool alone = last - first == 1;
    if (!alone && mesh.subdomains[first->cell] == mesh.subdomains[(first + 1)->cell]) return;
    const auto found = wanting.find(first->vertices);
    if (found == wanting.end()) {
      validity.add(Fault_kind_3::boundary, "a facet of the boundary isn't listed", internal::listed(first->vertices));
      return;
    }
    const auto& facet = mesh.facets[found->second];
    if (alone && !internal::same_sense(facet, internal::outward_vertices(mesh.cells[first->cell], first->opposite)))
      validity.add(Fault_kind_3::boundary, "a facet of the boundary looks inwards", internal::listed(facet));
    wanting.erase(found);
  });
  for (const auto& [vertices, f] : wanting)
    validity.add(Fault_kind_3::boundary, "a facet is listed that isn't one of the boundary",
                 internal::listed(vertices));
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_BOUNDARY_3_H
