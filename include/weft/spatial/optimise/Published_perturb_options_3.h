// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of Alg. 7 of Tournois 2009 as it is printed, `perturb_as_published_3()`.

#ifndef WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURB_OPTIONS_3_H
#define WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURB_OPTIONS_3_H

#include <weft/errors.h>

#include <functional>
#include <limits>

namespace weft {

/// Parts of Alg. 7, all as printed. Each can be switched alone to what `perturb_slivers_3()` does.
struct Published_perturb_options_3
{
  double target = 20;      ///< the bound alpha that defines slivers, in degrees
  int random_trials = 100; ///< N_max: of random places, and of steps along a gradient
  double reach = 0.1;      ///< length of a step and of random ones, in parts of the shortest edge: 0.05 to 0.2

  bool only_compatible = true; ///< gradients of several slivers count if their dot products are positive; else always
  bool averages = true;        ///< a direction is the mean of unit vectors; else the sum of gradients as they are
  bool repeats_steps = true;  ///< a vertex goes on until flips would come; else one step of 1, 2 and 3 lengths is tried
  bool in_order = true;       ///< inside first, then fewer slivers, then smaller angles; else the elder vertex first
  bool rising_bounds = false; ///< the bound rises by 2 degrees from 4 on, as sec. 3.2.2.3 suggests
  bool large_angles = false;  ///< large dihedral angles count, too
  bool keep_criteria = false; ///< criteria that hold are kept; else only the topology of the boundary

  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;
  std::function<bool()> go_on; ///< called now and then; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(target >= 0 && target <= 70, "target must lie in [0, 70] degrees");
    require(random_trials >= 0, "random_trials must not be negative");
    require(reach > 0 && reach < 1, "reach must lie in (0, 1)");
    require(time_limit >= 0, "time_limit must not be negative");
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURB_OPTIONS_3_H
