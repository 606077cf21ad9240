// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ODT energy of a weighted tetrahedral mesh (Tournois 2009, sec. 4.2.3): vertices are lifted to |p|^2 - w, so that
// the piecewise linear function through them approximates the paraboloid instead of interpolating it. The lower hull of
// these points is the regular triangulation.

#ifndef WEFT_ENERGY_WEIGHTED_ODT_ENERGY_3_H
#define WEFT_ENERGY_WEIGHTED_ODT_ENERGY_3_H

#include <weft/energy/simplices_of_mesh.h>
#include <weft/energy/Weighted_energy.h>
#include <weft/energy/weighted_odt_terms.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <utility>
#include <vector>

namespace weft {

/// The error of the lifting over a mesh whose points have weights, and its gradients by positions and by weights; the
/// triangulation is held, whether or not it is the regular one. Boundary points change the domain that is integrated
/// over. O(n log n).
/// \param weights of the points, in the unit of squared lengths.
/// \param error which error: `volume` is in the fifth power of the unit of length and without weights the same as
///        `odt_energy_3()`; the others are in the seventh.
/// \param sizes as of `odt_energy_3()`; weights are measured in squares of them, and the energy has no unit.
/// \pre cells are positively oriented.
/// \throws Option_error if weights or sizes are too few, weights not finite or sizes not positive.
template <class K>
Weighted_energy<typename K::Vector_3>
weighted_odt_energy_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<double>& weights,
                      Lifting_error error = Lifting_error::squared, const std::vector<double>& sizes = {})
{
  internal::require_sizes(sizes, mesh.points.size());
  internal::require_weights(weights, mesh.points.size());
  auto simplices = internal::simplices_of_mesh(mesh);
  simplices.sizes = sizes;
  auto terms = internal::weighted_odt_terms(simplices, weights, error);
  auto points = internal::mesh_energy<typename K::Vector_3>(std::move(terms.points));
  return {points.value, std::move(points.gradient), std::move(terms.gradient), terms.constant};
}

} // namespace weft

#endif // WEFT_ENERGY_WEIGHTED_ODT_ENERGY_3_H
