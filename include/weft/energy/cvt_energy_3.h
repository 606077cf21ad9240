// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CVT energy of a tetrahedral mesh (Du, Faber, Gunzburger 1999; Tournois 2009, sec. 2.2.2 and 4.2.2): what
// Lloyd's iteration on the Voronoi cells inside the domain minimises.

#ifndef WEFT_ENERGY_CVT_ENERGY_3_H
#define WEFT_ENERGY_CVT_ENERGY_3_H

#include <weft/energy/cvt_terms_3.h>
#include <weft/energy/Mesh_energy.h>
#include <weft/energy/simplices_of_mesh.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

namespace weft {

/// The CVT energy, in the fifth power of the unit of length times that of the density. Voronoi cells end at the
/// boundary of the mesh; what of them lies beyond counts with sign, so that they add up to the domain. The gradient is
/// by all points, those of the boundary included, which change the domain. O(n log n).
/// \param density callable, point -> positive number; for edge lengths proportional to a size, size^-5. Integrated over
///        each of the 24 pieces of a cell by a rule for polynomials of the third degree.
/// \pre cells are positively oriented, and Delaunay.
template <class K, class Density>
Mesh_energy<typename K::Vector_3> cvt_energy_3(const Tetrahedral_mesh_3<K>& mesh, const Density& density)
{
  const auto at = [&](const internal::Coordinates<3>& x) { return density(typename K::Point_3(x[0], x[1], x[2])); };
  return internal::mesh_energy<typename K::Vector_3>(internal::cvt_terms(internal::simplices_of_mesh(mesh), at));
}

/// The same with density 1, by closed forms.
template <class K>
Mesh_energy<typename K::Vector_3> cvt_energy_3(const Tetrahedral_mesh_3<K>& mesh)
{
  return internal::mesh_energy<typename K::Vector_3>(
      internal::cvt_terms(internal::simplices_of_mesh(mesh), internal::Constant_density()));
}

} // namespace weft

#endif // WEFT_ENERGY_CVT_ENERGY_3_H
