// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimises the ODT energy of a weighted mesh over weights, places of points or both (Tournois 2009, sec. 4.2.3): in
// each sweep all change, and the regular triangulation of the points is made again. Needs Eigen 3.

#ifndef WEFT_SPATIAL_SOLVE_MINIMISE_WEIGHTED_ENERGY_3_H
#define WEFT_SPATIAL_SOLVE_MINIMISE_WEIGHTED_ENERGY_3_H

#include <weft/energy/simplices_of_mesh.h>
#include <weft/energy/weighted_odt_terms.h>
#include <weft/solve/Energy_descent.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/solve/Weighted_model_3.h>
#include <weft/spatial/solve/Weighted_options_3.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

template <class K, class Oracle>
Weighted_mesh_3<K> minimise_weighted_energy(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle,
                                            const Weighted_options_3& options, std::vector<double> weights)
{
  using Model = Weighted_model_3<K, Oracle>;
  options.check();
  require_sizes(options.sizes, mesh.points.size());
  if (weights.empty()) weights.assign(mesh.points.size(), 0);
  require_weights(weights, mesh.points.size());
  Model model(mesh, weights, oracle, options);
  Solver_report report = Energy_descent<Model, 4>(model, options.solver).run();
  return {model.mesh(), model.weights(), model.taken_back(), std::move(report)};
}

} // namespace internal

/// Makes the error of the lifting of a mesh small with its boundary kept: points on the boundary and on interfaces
/// between subdomains keep their places, and every facet there stays; they have weights as all others, as far as these
/// cost no such facet. The result is the regular triangulation of the points with their weights, no point is hidden,
/// and the error after each sweep that is kept is less than before. A sweep takes as long as a few regular
/// triangulations from scratch.
/// \param mesh the regular triangulation of its points with the weights given, restricted to a domain.
/// \param weights to begin with, in the unit of squared lengths; empty: 0, the mesh is Delaunay.
/// \throws Option_error for options or weights out of range; Error if a facet of the boundary isn't one of the regular
///   triangulation, or a point is hidden.
template <class K>
Weighted_mesh_3<K> minimise_weighted_energy_3(const Tetrahedral_mesh_3<K>& mesh,
                                              const Weighted_options_3& options = Weighted_options_3(),
                                              std::vector<double> weights = {})
{
  return internal::minimise_weighted_energy(mesh, internal::Boundary_kept_3(), options, std::move(weights));
}

/// The same with points that slide along the patches of a domain, but for those on creases and feature vertices. The
/// facets of the boundary keep their points. What is minimised is the error over a power of the volume, see
/// doc/theory_energies.md.
/// \param oracle of the domain, see Polyhedral_oracle_3.h.
/// \pre the mesh has locations.
/// \throws Option_error, Error as above.
template <class K, class Oracle>
Weighted_mesh_3<K> minimise_weighted_energy_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle,
                                              const Weighted_options_3& options, std::vector<double> weights = {})
{
  return internal::minimise_weighted_energy(mesh, oracle, options, std::move(weights));
}

} // namespace weft

#endif // WEFT_SPATIAL_SOLVE_MINIMISE_WEIGHTED_ENERGY_3_H
