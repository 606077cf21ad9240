// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CVT energy of a planar mesh (Tournois 2009, sec. 2.2.2): what Lloyd's iteration on the bounded Voronoi diagram
// minimises.

#ifndef WEFT_ENERGY_CVT_ENERGY_2_H
#define WEFT_ENERGY_CVT_ENERGY_2_H

#include <weft/energy/cvt_terms_2.h>
#include <weft/energy/Mesh_energy.h>
#include <weft/energy/simplices_of_mesh.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

namespace weft {

/// The CVT energy of the bounded Voronoi diagram of a mesh, in the fourth power of the unit of length times that of the
/// density. The gradient holds for moves that leave the domain as it is: of points inside in all directions, of those
/// on straight constraints along these. O(n log n).
/// \param density callable, point -> positive number; for edge lengths proportional to a size, size^-4. Integrated over
///        each of the about twelve pieces of a cell by a rule for polynomials of the third degree.
/// \pre the mesh is constrained Delaunay with respect to its edges.
template <class K, class Density>
Mesh_energy<typename K::Vector_2> cvt_energy_2(const Triangle_mesh_2<K>& mesh, const Density& density)
{
  const auto at = [&](const internal::Coordinates<2>& x) { return density(typename K::Point_2(x[0], x[1])); };
  return internal::mesh_energy<typename K::Vector_2>(internal::cvt_terms(internal::simplices_of_mesh(mesh), at));
}

/// The same with density 1, by closed forms.
template <class K>
Mesh_energy<typename K::Vector_2> cvt_energy_2(const Triangle_mesh_2<K>& mesh)
{
  return internal::mesh_energy<typename K::Vector_2>(
      internal::cvt_terms(internal::simplices_of_mesh(mesh), internal::Constant_density()));
}

} // namespace weft

#endif // WEFT_ENERGY_CVT_ENERGY_2_H
