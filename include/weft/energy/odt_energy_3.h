// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ODT energy of a tetrahedral mesh (Chen 2004; Tournois 2009, sec. 3.2.1.5, eq. 3.1): the volume between the
// paraboloid and its piecewise linear interpolation over the mesh. For given points Delaunay triangulations minimise
// it.

#ifndef WEFT_ENERGY_ODT_ENERGY_3_H
#define WEFT_ENERGY_ODT_ENERGY_3_H

#include <weft/energy/Mesh_energy.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/simplices_of_mesh.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <vector>

namespace weft {

/// The ODT energy, in the fifth power of the unit of length; without unit in the metric of sizes. The gradient is by
/// all points, those of the boundary included, which change the domain that is integrated over. O(n log n).
/// \param sizes edge lengths wanted at the points, in whose metric lengths and volumes are measured; they move along
///        with the points. Empty: lengths as they are.
/// \pre cells are positively oriented.
/// \throws Option_error if sizes are too few or not positive.
template <class K>
Mesh_energy<typename K::Vector_3> odt_energy_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<double>& sizes = {})
{
  internal::require_sizes(sizes, mesh.points.size());
  auto simplices = internal::simplices_of_mesh(mesh);
  simplices.sizes = sizes;
  return internal::mesh_energy<typename K::Vector_3>(internal::odt_terms(simplices));
}

} // namespace weft

#endif // WEFT_ENERGY_ODT_ENERGY_3_H
