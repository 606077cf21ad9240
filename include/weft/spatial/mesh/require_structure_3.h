// SPDX-License-Identifier: GPL-3.0-or-later
//
// What functions that take a mesh in arrays ask of it before anything else.

#ifndef WEFT_SPATIAL_MESH_REQUIRE_STRUCTURE_3_H
#define WEFT_SPATIAL_MESH_REQUIRE_STRUCTURE_3_H

#include <weft/errors.h>
#include <weft/spatial/mesh/check_boundary_3.h>
#include <weft/spatial/mesh/check_structure_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

namespace weft::internal {

/// \throws Domain_error if the arrays aren't those of a mesh.
template <class K>
void require_structure(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity = check_structure_3(mesh);
  if (validity.ok()) validity += check_boundary_3(mesh);
  if (validity.ok() || validity.faults.empty()) return;
  const Fault_3& fault = validity.faults.front();
  throw Domain_error(fault.text + "; assemble_mesh_3() makes a mesh of points and cells", fault.vertices, {});
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_REQUIRE_STRUCTURE_3_H
