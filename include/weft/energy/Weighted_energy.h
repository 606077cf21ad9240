// SPDX-License-Identifier: GPL-3.0-or-later
//
// An energy of a weighted mesh with its gradients: what `weighted_odt_energy_2()` and `weighted_odt_energy_3()` return,
// and how the error of a lifting is measured.

#ifndef WEFT_ENERGY_WEIGHTED_ENERGY_H
#define WEFT_ENERGY_WEIGHTED_ENERGY_H

#include <weft/energy/Mesh_energy.h>

#include <vector>

namespace weft {

/// How far a lifted mesh is from the paraboloid f = |x|^2. Vertices are lifted to |p|^2 - w; u is the piecewise linear
/// function through them, e = u - f.
enum class Lifting_error
{
  /// The integral of e. Without weights that is the ODT energy, which is the L1 norm, since e isn't negative then. With
  /// weights it isn't a norm: it is linear in them and has no minimum.
  volume,
  /// The integral of e^2. For a given triangulation it is convex in the weights and has one minimum.
  squared,
  /// The least integral of (e - c)^2 over all constants c. The same constant added to all weights changes neither the
  /// regular triangulation nor, where sizes don't vary, this.
  up_to_a_constant
};

/// An energy of a weighted mesh.
/// \tparam Vector `Vector_2` or `Vector_3` of a kernel.
template <class Vector>
struct Weighted_energy
{
  double value = 0;
  std::vector<Vector> gradient;        ///< by the position of each point of the mesh
  std::vector<double> weight_gradient; ///< by the weight of each point
  double constant =
      0; ///< c of `up_to_a_constant`, in squared lengths or, with sizes, in parts of squared sizes; else 0
};

} // namespace weft

#endif // WEFT_ENERGY_WEIGHTED_ENERGY_H
