// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of Alg. 5 of Tournois 2009 as it is printed, `mesh_as_published_3()`.

#ifndef WEFT_SPATIAL_RUN_AS_PUBLISHED_OPTIONS_3_H
#define WEFT_SPATIAL_RUN_AS_PUBLISHED_OPTIONS_3_H

#include <weft/errors.h>
#include <weft/options.h>
#include <weft/spatial/optimise/Published_perturb_options_3.h>

#include <cstddef>
#include <limits>

namespace weft {

/// Parts of Algorithms 5, 6 and 7, all as printed. Each can be switched alone to what `make_mesh_3()` does.
struct As_published_options_3
{
  // ---- Initialisation and refinement, sec. 3.2.1.3, 3.2.1.4, Alg. 6

  double initial_loosening = 2; ///< factor by which criteria are loosened for the first mesh; weft: 2.6, surface only
  int target_steps = 1;         ///< in how many steps that factor falls to 1 then; 1: at once
  bool plain_points = true;     ///< Steiner points are circumcenters and surface centers; weft: chosen among candidates
  bool mixed_batches = true;    ///< edges, facets and cells in one batch; weft: cells wait for facets
  bool plain_creases = true;    ///< creases are halved; weft: equal parts, concentric spheres, bends of the polyline
  bool follow_folds = false;    ///< folds of the surface attract Steiner points
  bool see_ridges = false;      ///< facets have to be near ridges and at their middles, not at Steiner points alone
  bool mirror = false;          ///< pairs and twins beside acute edges
  bool lattice = false;         ///< inside, where the size is constant; the surface is refined before
  bool grade = true;            ///< no edge longer than the dynamic sizing function; weft: sizes as asked for alone
  double lipschitz = 1;         ///< the K of that function, which the metric of smoothing has, too

  // ---- Optimisation, sec. 3.2.1.5, 3.3.3

  bool interleave = true; ///< smoothing after each batch; else batches to the end, smoothing, batches to the end again
  int sweeps = 2;         ///< of Natural ODT after a batch
  /// Batches within which the number of bad elements has to halve once they are few, or smoothing ends and refinement
  /// goes on alone. The thesis doesn't say what ends the loop: without this it goes on, see doc/theory_3d.md. 0: never.
  std::size_t patience = 10;
  int final_sweeps = 20;      ///< of Natural ODT if it isn't interleaved
  bool lock = true;           ///< vertices of excellent cells alone stay
  bool keep_criteria = false; ///< what would violate a criterion goes back; else that is left to refinement
  bool smooth_surface =
      false;            ///< vertices on the boundary go by half to where ODT of facets or crease edges wants them
  bool coarsen = false; ///< takes vertices away that no criterion needs, at the end

  // ---- Sliver removal, sec. 3.2.2, Alg. 7

  double min_dihedral_angle = 20;           ///< bound that defines slivers, in degrees; 0: no perturbation
  bool published_perturbation = true;       ///< Alg. 7; else `perturb_slivers_3()`
  Published_perturb_options_3 perturbation; ///< its parts; bound, seed, time and `go_on` are set by the run

  // ---- Limits

  double size_floor = 0;               ///< no Steiner point closer to a vertex; 0: chosen from the criteria
  std::size_t max_batches = 500;       ///< most batches of refinement
  std::size_t max_vertices = 20000000; ///< vertex budget
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;                                           ///< start of every random choice
  int threads = 1; ///< threads to use where oneTBB is linked; never changes the result
  Visitor visitor; ///< sees progress, may stop the run; may be empty

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(initial_loosening >= 1, "initial_loosening must be at least 1");
    require(target_steps >= 1, "target_steps must be positive");
    require(lipschitz > 0, "lipschitz must be positive");
    require(sweeps >= 0 && final_sweeps >= 0, "numbers of sweeps must not be negative");
    require(min_dihedral_angle >= 0 && min_dihedral_angle <= 70, "min_dihedral_angle must lie in [0, 70] degrees");
    perturbation.check();
    require(size_floor >= 0, "size_floor must not be negative");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_RUN_AS_PUBLISHED_OPTIONS_3_H
