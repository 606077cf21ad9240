// SPDX-License-Identifier: GPL-3.0-or-later
//
// What coarsening may do, and what it did.

#ifndef WEFT_SPATIAL_OPTIMISE_COARSEN_OPTIONS_3_H
#define WEFT_SPATIAL_OPTIMISE_COARSEN_OPTIONS_3_H

#include <weft/errors.h>

#include <cstddef>
#include <functional>
#include <limits>

namespace weft {

/// Options of `coarsen_3()`.
struct Coarsen_options_3
{
  /// Cells below this smallest dihedral angle, in degrees, are made only where those that they replace were worse.
  double min_dihedral_angle = 0;
  int most_passes = 3;      ///< over all vertices
  double least_gain = 0.02; ///< ends when a pass takes away less than this part of the vertices
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  std::function<bool()> go_on;                                 ///< called now and then; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(min_dihedral_angle >= 0 && min_dihedral_angle <= 90, "min_dihedral_angle must lie in [0, 90] degrees");
    require(most_passes >= 0, "most_passes must not be negative");
    require(least_gain >= 0 && least_gain <= 1, "least_gain must lie in [0, 1]");
    require(time_limit >= 0, "time_limit must not be negative");
  }
};

/// What `coarsen_3()` did.
struct Coarsen_report_3
{
  std::size_t tried = 0, removed = 0, passes = 0;
  double seconds = 0;
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_COARSEN_OPTIONS_3_H
