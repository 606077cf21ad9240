// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the cells of a tetrahedral mesh are locally Delaunay.

#ifndef WEFT_SPATIAL_MESH_CHECK_DELAUNAY_3_H
#define WEFT_SPATIAL_MESH_CHECK_DELAUNAY_3_H

#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <CGAL/enum.h>

#include <cstddef>

namespace weft {

/// Checks for every facet between two cells that the sphere through one of them doesn't have the other's fourth vertex
/// strictly inside. Exact, O(n log n) time. Where the cells fill a convex set that makes them Delaunay; else a vertex
/// may also be hidden behind the boundary, which this doesn't see. Cells must be positively oriented.
template <class K>
Validity_3 check_delaunay_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const typename K::Side_of_oriented_sphere_3 side{};
  const auto& p = mesh.points;
  internal::for_each_facet(mesh.cells, [&](auto first, auto last) {
    if (last - first != 2) return;
    const auto& cell = mesh.cells[first->cell];
    const std::size_t across = mesh.cells[(first + 1)->cell][(first + 1)->opposite];
    if (side(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]], p[across]) == CGAL::ON_POSITIVE_SIDE)
      validity.add(Fault_kind_3::delaunay, "a facet isn't locally Delaunay", internal::listed(first->vertices));
  });
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_DELAUNAY_3_H
