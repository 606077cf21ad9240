// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and result of `minimise_weighted_energy_3()`.

#ifndef WEFT_SPATIAL_SOLVE_WEIGHTED_OPTIONS_3_H
#define WEFT_SPATIAL_SOLVE_WEIGHTED_OPTIONS_3_H

#include <weft/energy/Weighted_energy.h>
#include <weft/errors.h>
#include <weft/solve/Solver_options.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <cstddef>
#include <vector>

namespace weft {

/// Options of `minimise_weighted_energy_3()`.
struct Weighted_options_3
{
  Lifting_error error = Lifting_error::up_to_a_constant; ///< `volume` only if weights stay: it has no minimum in them
  bool move_weights = true;
  bool move_points =
      false; ///< those on the boundary too where there is an oracle, but for creases and feature vertices
  /// Of the squared distance of two points, the most by which their weights may differ, in (0, 1). Below 1 each point
  /// lies in its own power cell, so that none is hidden.
  double bound = 0.9;
  /// Edge lengths wanted at the points, in whose metric the error is measured; empty: one size everywhere.
  std::vector<double> sizes;
  Solver_options solver; ///< `energy` and `move_boundary` don't count; `newton` isn't available

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    solver.check();
    require(bound > 0 && bound < 1, "bound must lie in (0, 1)");
    require(error != Lifting_error::volume || !move_weights, "the volume has no minimum in the weights");
    require(solver.solver != Solver::newton, "Newton's iteration isn't available for weighted meshes");
  }
};

/// What `minimise_weighted_energy_3()` made.
template <class K>
struct Weighted_mesh_3
{
  Tetrahedral_mesh_3<K> mesh;  ///< points in their order; facets, edges and corners as they were
  std::vector<double> weights; ///< of the points, in the unit of squared lengths
  std::size_t taken_back = 0;  ///< moves of single points that would have hidden one or cost a facet of the boundary
  Solver_report report;
};

} // namespace weft

#endif // WEFT_SPATIAL_SOLVE_WEIGHTED_OPTIONS_3_H
