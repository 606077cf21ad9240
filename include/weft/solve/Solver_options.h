// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and report of what minimises an energy of a mesh: `minimise_energy_2()` and `minimise_energy_3()`.

#ifndef WEFT_SOLVE_SOLVER_OPTIONS_H
#define WEFT_SOLVE_SOLVER_OPTIONS_H

#include <weft/errors.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace weft {

/// What is minimised.
enum class Energy
{
  cvt, ///< of centroidal Voronoi tessellations: cvt_energy_2.h, cvt_energy_3.h
  odt  ///< of optimal Delaunay triangulations: odt_energy_2.h, odt_energy_3.h
};

/// How an energy is minimised. All take the same time a sweep but for the solution of a linear system.
enum class Solver
{
  /// Each vertex goes to its own optimal position with the others held: Lloyd's iteration, or that of ODT.
  fixed_point,
  /// L-BFGS from the first sweep on (Tournois 2009, sec. 4.2.2, after Liu et al. 2009), preconditioned by the graph
  /// Laplacian (Chen, Holst 2011; Hateley, Wei, Chen 2015).
  quasi_newton,
  /// Fixed-point sweeps while these lower the energy fast, then Newton's iteration for the fixed point (Tournois 2009,
  /// sec. 4.2.2, Alg. 8), damped: where a step doesn't lower the energy, a part of the diagonal is added to the system,
  /// and if that doesn't help, fixed-point sweeps go on.
  newton
};

/// Options of `minimise_energy_2()` and `minimise_energy_3()`.
struct Solver_options
{
  Energy energy = Energy::odt;
  Solver solver = Solver::quasi_newton;
  /// Most sweeps: in each all vertices move and the triangulation is made Delaunay again. Those undone count.
  int max_sweeps = 100;
  /// Ends when three sweeps in turn lower the energy by less than this part of it each.
  double tolerance = 1e-6;
  bool move_boundary = true;  ///< whether vertices on constraints, patches and creases slide along them
  int memory = 7;             ///< of the quasi-Newton iteration: pairs of steps and changes of the gradient
  int refresh = 15;           ///< sweeps after which the preconditioner is made anew
  double newton_start = 1e-3; ///< Newton's iteration begins when a sweep lowers the energy by less than this part
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  std::function<bool()> go_on;                                 ///< called before every sweep; false ends the run

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(max_sweeps >= 0, "max_sweeps must not be negative");
    require(tolerance >= 0, "tolerance must not be negative");
    require(memory > 0 && refresh > 0, "memory and refresh must be positive");
    require(newton_start >= 0, "newton_start must not be negative");
    require(time_limit >= 0, "time_limit must not be negative");
  }
};

/// What a solver did.
struct Solver_report
{
  std::size_t sweeps = 0;        ///< those undone included
  std::size_t undone_sweeps = 0; ///< that would have raised the energy
  std::size_t newton_sweeps = 0; ///< that followed Newton's direction and were kept
  std::vector<double> energies;  ///< at the start and after each sweep that was kept; they fall
  std::vector<double> times;     ///< when that was, in seconds of wall time since the start
  bool converged = false;        ///< by the tolerance, or since no direction lowers the energy any more
  double solving_seconds = 0;    ///< linear systems
  double seconds = 0;            ///< altogether, wall time
};

} // namespace weft

#endif // WEFT_SOLVE_SOLVER_OPTIONS_H
