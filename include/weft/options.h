// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of the meshers. Each says its unit and what it does; the defaults suit most inputs.

#ifndef WEFT_OPTIONS_H
#define WEFT_OPTIONS_H

#include <weft/errors.h>
#include <weft/visitor.h>

#include <cstddef>
#include <limits>
#include <optional>

namespace weft {

/// Where the first vertices come from.
enum class Seeding
{
  /// A triangular lattice in the metric of the sizing field, grown through every room of the domain.
  crystal,
  /// Nothing: refinement in batches and relaxation in turn, from the bare constraints. That is the order of Alg. 2 of
  /// Tournois 2009, with what weft adds to it (feedback, polishing, mended angles, target ratios of at least 1.2), but
  /// for the grading of `grade_input`. `mesh_as_published_2()` is Alg. 2 itself.
  none
};

/// Options of `make_mesh_2()` and `relax_2()`.
struct Mesh_options_2
{
  Seeding seeding = Seeding::crystal;

  /// Relaxation ends when no vertex moves farther, in parts of its Voronoi cell's size. That is twice the distance from
  /// the vertex to the farthest corner of the cell.
  double move_ratio = 0.03;
  /// The same for the last relaxation: that of `relax_2()`, and in `make_mesh_2()` the one that takes the place of
  /// polishing where `polish` is off.
  double final_move_ratio = 0.01;
  /// About how many quadrature triangles a Voronoi cell has while refining. Each of the about twelve parts into which
  /// the triangles of the mesh cut a cell is cut into quadrature / 12 ones, rounded up: from 1 to 12 the density is
  /// constant on each part. Ignored by uniform sizing.
  int quadrature = 10;
  int final_quadrature = 100; ///< the same for the last relaxation, as above
  /// Exponent with which long edges draw vertices near: the density of Lloyd's iteration is that of the sizing field
  /// times (longest edge of the triangle / its size) to that power. The density of the field is size^-3 then; with 0,
  /// Lloyd's iteration proper, it is size^-4.
  double size_feedback = 3;
  int max_sweeps = 12;   ///< most sweeps a relaxation; 0: no relaxation at all
  int max_batches = 400; ///< most batches of refinement

  /// Smallest angle in degrees to refine for, where the input allows it; 0: only sizes count. With `grade_input` and
  /// `polish` on, angles below 25 degrees are mended in any case, as far as a quarter more vertices suffices; what is
  /// left of them then is not a criterion that failed.
  double min_angle = 0;
  /// Let elements shrink towards input details finer than the sizing field. With `Seeding::none` that isn't done; then
  /// it only decides whether angles are mended, as said above.
  bool grade_input = true;
  bool polish = true; ///< improve the worst triangles at the end

  /// Vertex budget. With crystals, a run whose constraints need more, or whose domain does at a uniform size, ends
  /// before it inserts anything.
  std::size_t max_vertices = 5000000;
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;                                           ///< start of every random choice
  int threads = 1; ///< threads to use where oneTBB is linked; never changes the result
  Visitor visitor; ///< sees progress, may stop the run; may be empty

  /// \throws Option_error naming the first option outside its range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(move_ratio > 0 && final_move_ratio > 0, "move ratios must be positive");
    require(quadrature > 0 && final_quadrature > 0, "quadrature sizes must be positive");
    require(size_feedback >= 0 && size_feedback <= 8, "size_feedback must lie in [0, 8]");
    require(max_sweeps >= 0 && max_batches >= 0, "iteration limits must not be negative");
    require(min_angle >= 0 && min_angle <= 40, "min_angle must lie in [0, 40] degrees");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

/// Options of `make_mesh_3()`.
struct Mesh_options_3
{
  bool coarsen = true; ///< take away vertices that no criterion needs
  /// Sweeps of Natural ODT smoothing, which keeps all criteria; 0: none.
  int smoothing_sweeps = 3;
  /// Smallest dihedral angle in degrees to perturb slivers for; 0: no perturbation; 90: as far as it goes, which takes
  /// minutes without a `time_limit`, and which that limit may end without the run counting as stopped early.
  double min_dihedral_angle = 20;
  /// From 0 to 1: how much work is done after refinement. If given, it takes the place of the three above. 0: none; up
  /// to 0.5 the target of perturbation rises to 20 degrees, and from 0.25 on vertices are taken away; 0.5: the defaults
  /// above; from there on slivers are perturbed for a degree more at each thirtieth, and 1 is as far as it goes, which
  /// takes minutes. It stands for amounts of work, not for time: the mesh is the same on all machines. A `time_limit`
  /// may leave some out.
  std::optional<double> effort;
  double size_floor = 0; ///< no Steiner point closer to a vertex, in the input's units; 0: chosen from the criteria
  bool lattice = true;   ///< fill thick parts with a body-centred cubic lattice where the size is constant
  bool give_up_creases = true; ///< of those found by angle, where criteria can't hold with them; for `mesh_surface_3()`
  double initial_loosening = 2.6;      ///< factor by which criteria are loosened for the first mesh
  std::size_t max_batches = 100000;    ///< most batches of refinement
  std::size_t max_vertices = 20000000; ///< vertex budget
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;                                           ///< start of every random choice
  int threads = 1; ///< threads to use where oneTBB is linked; never changes the result
  Visitor visitor; ///< sees progress, may stop the run; may be empty

  /// Options for refinement without any optimisation.
  static Mesh_options_3 refinement()
  {
    Mesh_options_3 options;
    options.coarsen = false;
    options.smoothing_sweeps = 0;
    options.min_dihedral_angle = 0;
    return options;
  }

  /// \throws Option_error naming the first option outside its range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(smoothing_sweeps >= 0, "smoothing_sweeps must not be negative");
    require(min_dihedral_angle >= 0 && min_dihedral_angle <= 90, "min_dihedral_angle must lie in [0, 90] degrees");
    require(!effort || (*effort >= 0 && *effort <= 1), "effort must lie in [0, 1]");
    require(size_floor >= 0, "size_floor must not be negative");
    require(initial_loosening >= 1, "initial_loosening must be at least 1");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

} // namespace weft

#endif // WEFT_OPTIONS_H
