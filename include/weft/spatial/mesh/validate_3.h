// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a tetrahedral mesh is valid: cells that meet facet to facet, positively oriented and locally Delaunay; a
// boundary that is listed completely, looks outwards and is a closed 2-manifold; crease edges in chains; vertices that
// agree with the facets and edges around them. Everything is recomputed from the cells, exact predicates decide, and
// each check can be called alone. Whether the mesh meets criteria and lies on its domain is asked in
// check_criteria_3.h, how far it is from a surface in hausdorff_3.h.

#ifndef WEFT_SPATIAL_MESH_VALIDATE_3_H
#define WEFT_SPATIAL_MESH_VALIDATE_3_H

#include <weft/spatial/mesh/check_boundary_3.h>
#include <weft/spatial/mesh/check_delaunay_3.h>
#include <weft/spatial/mesh/check_locations_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/check_orientation_3.h>
#include <weft/spatial/mesh/check_structure_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

namespace weft {

/// Makes all these checks. What needs a sound structure or orientation is left out where that isn't found.
template <class K>
Validity_3 validate_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity = check_structure_3(mesh);
  if (!validity.ok()) return validity;
  validity += check_orientation_3(mesh);
  if (validity.ok()) validity += check_delaunay_3(mesh);
  validity += check_boundary_3(mesh);
  validity += check_manifold_3(mesh);
  validity += check_locations_3(mesh);
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_VALIDATE_3_H
