// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and report of `perturb_slivers_3()`.

#ifndef WEFT_SPATIAL_OPTIMISE_PERTURB_OPTIONS_3_H
#define WEFT_SPATIAL_OPTIMISE_PERTURB_OPTIONS_3_H

#include <weft/errors.h>

#include <cstddef>
#include <functional>
#include <limits>

namespace weft {

/// Which way vertices of slivers go.
enum class Perturb_directions_3
{
  combined, ///< along the gradients of the slivers' circumradii and volumes first, then anywhere (Tournois 2009, Alg.
            ///< 7)
  random    ///< anywhere
};

/// Options of `perturb_slivers_3()`.
struct Perturb_options_3
{
  /// Degrees: the dihedral angle of a regular tetrahedron. From there on a target isn't an angle to reach.
  static constexpr double as_far_as_it_goes = 70.53;

  double target = 20;         ///< smallest dihedral angle to reach, in degrees; 90: as far as it goes
  double first_bound = 4;     ///< bound of the first passes, in degrees
  double step = 2;            ///< by which the bound is raised
  int most_passes = 8;        ///< over the vertices of cells below a bound
  int random_trials = 24;     ///< random places for a vertex
  double insertions = 0.15;   ///< most vertices to add, those removed counted off, in parts of those there are
  double random_reach = 0.35; ///< how far from it, in parts of its shortest edge
  bool mend_worst = true;     ///< go on with the worst few cells once bounds have risen over the whole mesh
  /// Gives the target up when reaching it at the latest pace would take so many times all the trials so far.
  double persistence = 3;
  Perturb_directions_3 directions = Perturb_directions_3::combined;
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;
  std::function<bool(double)> go_on; ///< called with the smallest dihedral angle between passes; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(target >= 0 && target <= 90, "target must lie in [0, 90] degrees");
    require(first_bound > 0 && step > 0, "bounds must be positive");
    require(most_passes > 0 && random_trials >= 0, "numbers of passes and trials must not be negative");
    require(insertions >= 0 && insertions <= 1, "insertions must lie in [0, 1]");
    require(random_reach > 0 && random_reach < 1, "random_reach must lie in (0, 1)");
    require(persistence > 0, "persistence must be positive");
    require(time_limit >= 0, "time_limit must not be negative");
  }
};

/// What `perturb_slivers_3()` did.
struct Perturb_report_3
{
  double before = 0, after = 0; ///< smallest dihedral angles, in degrees
  std::size_t passes = 0, tried_vertices = 0, trials = 0;
  std::size_t by_radius = 0, by_volume = 0, by_chance = 0; ///< moves that were kept, by direction
  std::size_t insertions = 0, removals = 0;                ///< of vertices, where no move helped
  /// Good moves not made, by what would have suffered.
  std::size_t refused_cells = 0, refused_facets = 0, refused_disks = 0, refused_creases = 0, refused_bare = 0;
  std::size_t kicks = 0, kicks_kept = 0; ///< of the neighbourhood of stuck cells
  double seconds = 0;

  std::size_t refused() const
  {
    return refused_cells + refused_facets + refused_disks + refused_creases + refused_bare;
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_PERTURB_OPTIONS_3_H
