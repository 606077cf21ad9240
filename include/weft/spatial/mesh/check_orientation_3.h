// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the cells of a tetrahedral mesh are positively oriented.

#ifndef WEFT_SPATIAL_MESH_CHECK_ORIENTATION_3_H
#define WEFT_SPATIAL_MESH_CHECK_ORIENTATION_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <CGAL/enum.h>

namespace weft {

/// Checks that all cells are positively oriented. Exact, linear time.
template <class K>
Validity_3 check_orientation_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const typename K::Orientation_3 orientation{};
  const auto& p = mesh.points;
  for (const auto& cell : mesh.cells) {
    const auto sign = orientation(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]);
    if (sign == CGAL::POSITIVE) continue;
    validity.add(Fault_kind_3::orientation, sign == CGAL::ZERO ? "a cell is flat" : "a cell is turned over",
                 internal::listed(cell));
  }
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_ORIENTATION_3_H
