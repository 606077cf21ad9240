// SPDX-License-Identifier: GPL-3.0-or-later
//
// An energy of a mesh with its gradient: what the energies return.

#ifndef WEFT_ENERGY_MESH_ENERGY_H
#define WEFT_ENERGY_MESH_ENERGY_H

#include <weft/energy/Simplices.h>

#include <utility>
#include <vector>

namespace weft {

/// An energy and its gradient.
/// \tparam Vector `Vector_2` or `Vector_3` of a kernel.
template <class Vector>
struct Mesh_energy
{
  double value = 0;             ///< at the points as they are
  std::vector<Vector> gradient; ///< by the position of each point of the mesh
  /// By point: the gradient over this is the step of the fixed-point iteration, which is Lloyd's for the CVT energy,
  /// and that to the volume-weighted mean of circumcenters for the ODT energy.
  std::vector<double> diagonal;
};

namespace internal {

template <class Vector>
Mesh_energy<Vector> mesh_energy(Energy_terms<2>&& terms)
{
  Mesh_energy<Vector> result{terms.value, {}, std::move(terms.diagonal)};
  for (const auto& g : terms.gradient) result.gradient.emplace_back(g[0], g[1]);
  return result;
}

template <class Vector>
Mesh_energy<Vector> mesh_energy(Energy_terms<3>&& terms)
{
  Mesh_energy<Vector> result{terms.value, {}, std::move(terms.diagonal)};
  for (const auto& g : terms.gradient) result.gradient.emplace_back(g[0], g[1], g[2]);
  return result;
}

} // namespace internal
} // namespace weft

#endif // WEFT_ENERGY_MESH_ENERGY_H
