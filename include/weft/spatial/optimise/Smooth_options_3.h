// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and report of `smooth_3()`.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTH_OPTIONS_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTH_OPTIONS_3_H

#include <weft/errors.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/restricted/Relocation_counts_3.h>

#include <cstddef>
#include <functional>
#include <limits>

namespace weft {

/// Options of `smooth_3()`.
struct Smooth_options_3
{
  int max_sweeps = 20;
  double move_ratio = 0.02; ///< vertices that would move less stay, in parts of their size; ends when all do
  double lipschitz = 1;     ///< of the dynamic sizing field: by how much sizes grow per distance
  double locked_smallest = internal::smallest_excellent_dihedral,
         locked_largest =
             internal::largest_excellent_dihedral; ///< vertices whose cells have all dihedral angles between these stay
  bool uniform = false;      ///< measure lengths as they are instead of in the metric of the sizes that the mesh has
  bool keep_criteria = true; ///< move back what violates a criterion afterwards; else that is left to refinement
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  int threads = 1;             ///< threads to use where oneTBB is linked; never changes the result
  std::function<bool()> go_on; ///< called before every sweep; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(max_sweeps >= 0, "max_sweeps must not be negative");
    require(move_ratio > 0, "move_ratio must be positive");
    require(lipschitz > 0, "lipschitz must be positive");
    require(locked_smallest >= 0 && locked_largest <= 180, "locking angles must lie in [0, 180] degrees");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

/// What `smooth_3()` did.
struct Smooth_report_3
{
  std::size_t sweeps = 0;        ///< that were kept
  std::size_t undone_sweeps = 0; ///< that would have raised the energy
  std::size_t moves = 0;         ///< of vertices, in sweeps that were kept
  std::size_t locked = 0;        ///< vertices that stayed since all their cells are excellent, summed over sweeps
  std::size_t rejected = 0;      ///< moves shortened or taken back, mostly since a criterion would have been violated
  double energy_before = 0, energy_after = 0; ///< ODT energy; only with `uniform`: other metrics change with the mesh
  internal::Relocation_counts_3 relocations;  ///< with the times that they took, those of moves taken back included
  // Wall time:
  double sizing_seconds = 0;   ///< the dynamic sizing field
  double position_seconds = 0; ///< where vertices want to be, projected
  double guard_seconds = 0;    ///< looking for violated criteria
  double seconds = 0;          ///< altogether
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTH_OPTIONS_3_H
