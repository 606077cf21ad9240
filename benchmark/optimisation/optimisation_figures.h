// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures that weft's optimisation in space is to reach, beside those of the thesis, filled with those of runs.

#ifndef WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_FIGURES_H
#define WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_FIGURES_H

#include "../common/table.h"
#include "optimisation_run.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

/// A figure and what the thesis has.
struct Thesis_figure
{
  std::string thesis;
  Figure figure;

  static std::vector<std::string> head()
  {
    auto cells = Figure::head();
    cells.insert(cells.begin() + 1, "thesis");
    return cells;
  }
  std::vector<std::string> cells() const
  {
    auto cells = figure.cells();
    cells.insert(cells.begin() + 1, thesis);
    return cells;
  }
};

enum class Better
{
  more,
  less
};

inline Thesis_figure asked(const std::string& name, const std::string& thesis, Better better, double at_least,
                           double aim, int decimals, const std::string& unit = "")
{
  return {thesis, {name, better == Better::more, false, at_least, aim, decimals, unit, {}, true}};
}

inline Thesis_figure asked_without_aim(const std::string& name, const std::string& thesis, Better better,
                                       double at_least, int decimals, const std::string& unit = "")
{
  Thesis_figure result = asked(name, thesis, better, at_least, at_least, decimals, unit);
  result.figure.has_aim = false;
  return result;
}

inline std::vector<Thesis_figure> whole_figures(const std::vector<Whole_run>& runs)
{
  Thesis_figure smooth = asked("smallest dihedral angle, smooth models", "15–17° (Bimba), 28.5° (Dinosaur)",
                               Better::more, 24, 32, 1, "°"),
                creased = asked("smallest dihedral angle, creased models", "", Better::more, 18, 28, 1, "°"),
                fine = asked("smallest dihedral angle, turbine", "15° (turbine)", Better::more, 13, 22, 1, "°"),
                sphere = asked("smallest dihedral angle, sphere", "30.02°", Better::more, 36, 42, 1, "°"),
                sphere_largest = asked("largest dihedral angle, sphere", "138.03°", Better::less, 134, 125, 1, "°"),
                largest = asked("largest dihedral angle, smooth models", "", Better::less, 152, 140, 1, "°"),
                default_angle =
                    asked_without_aim("smallest dihedral angle of the default run", "", Better::more, 20, 1, "°"),
                holds = asked_without_aim("runs that keep all criteria, of the default run and of the farthest", "",
                                          Better::more, 1, 2),
                hausdorff = asked_without_aim("Hausdorff distance against the refined mesh's, both runs", "",
                                              Better::less, 1.1, 2, " ×"),
                vertices = asked("vertices against CGAL's refinement, on average", "0.67–0.87 ×", Better::less, 0.88,
                                 0.7, 3, " ×"),
                time = asked("user time of the default run against CGAL's chain", "", Better::less, 1.2, 0.25, 3, " ×");
  vertices.figure.on_average = true;
  for (const Whole_run& r : runs) {
    if (r.failed()) {
      holds.figure.add(r.input, 0);
      continue;
    }
    for (const Spatial_measures* m : {&r.whole, &r.farthest}) {
      const std::string label = r.input + (m == &r.whole ? "" : ", farthest");
      holds.figure.add(label, !m->failed() && m->criteria_hold);
      if (!m->failed()) hausdorff.figure.add(label, m->hausdorff / r.refined.hausdorff);
    }
    default_angle.figure.add(r.input, r.whole.smallest_dihedral);
    vertices.figure.add(r.input, r.whole.vertices / r.cgal_refined.vertices);
    if (!r.cgal_chain.failed()) time.figure.add(r.input, r.whole.seconds / r.cgal_chain.seconds);
    if (r.farthest.failed()) continue;
    Thesis_figure& smallest = r.family == Family::smooth         ? smooth
                              : r.family == Family::creased      ? creased
                              : r.family == Family::fine_creased ? fine
                                                                 : sphere;
    smallest.figure.add(r.input, r.farthest.smallest_dihedral);
    if (r.family == Family::smooth) largest.figure.add(r.input, r.farthest.largest_dihedral);
    if (r.family == Family::uniform) sphere_largest.figure.add(r.input, r.farthest.largest_dihedral);
  }
  return {smooth, creased, fine, sphere, sphere_largest, largest, default_angle, holds, hausdorff, vertices, time};
}

inline std::vector<Thesis_figure> smoother_figures(const std::vector<Smoother_run>& runs)
{
  const std::string thesis = "NODT 3, Lloyd 55";
  Thesis_figure against_odt = asked_without_aim("cells below 10° after 100 free sweeps, NODT less ODT", thesis,
                                                Better::less, 0, 0),
                against_lloyd = asked_without_aim("cells below 10° after 100 free sweeps, NODT less Lloyd", thesis,
                                                  Better::less, 0, 0),
                kept_odt = asked_without_aim("the same with criteria kept, NODT less ODT", "", Better::less, 0, 0),
                kept_lloyd = asked_without_aim("the same with criteria kept, NODT less Lloyd", "", Better::less, 0, 0),
                none = asked("cells below 10° after 100 free sweeps of NODT", "3", Better::less, 3, 0, 0);
  for (const Smoother_run& r : runs) {
    if (r.nodt[1].failure[0] || r.odt[1].failure[0] || r.lloyd[1].failure[0]) continue;
    against_odt.figure.add(r.input, r.nodt[1].after_100 - r.odt[1].after_100);
    against_lloyd.figure.add(r.input, r.nodt[1].after_100 - r.lloyd[1].after_100);
    none.figure.add(r.input, r.nodt[1].after_100);
    kept_odt.figure.add(r.input, r.nodt[0].after_100 - r.odt[0].after_100);
    kept_lloyd.figure.add(r.input, r.nodt[0].after_100 - r.lloyd[0].after_100);
  }
  return {against_odt, against_lloyd, none, kept_odt, kept_lloyd};
}

inline std::vector<Thesis_figure> sweep_figures(const std::vector<std::pair<std::string, Sweep_costs>>& runs)
{
  Thesis_figure first = asked("a first NODT sweep against Delaunay from scratch", "", Better::less, 3, 1, 2, " ×"),
                late = asked("a sweep near convergence", "", Better::less, 1.5, 0.4, 2, " ×");
  for (const auto& [input, r] : runs) {
    if (r.failure[0]) continue;
    first.figure.add(input, r.first.ratio());
    late.figure.add(input, r.late.ratio());
  }
  return {first, late};
}

/// A random perturbation that doesn't reach the angle counts with the time it had: a lower bound. Where neither does,
/// there is no such time.
inline std::vector<Thesis_figure> perturb_figures(const std::vector<Perturb_run>& runs)
{
  Thesis_figure faster =
      asked("random perturbation's time against combined, to the same angle", "6 ×", Better::more, 1, 3, 2, " ×");
  for (const Perturb_run& r : runs) {
    if (r.combined.failure[0] || r.random.failure[0]) continue;
    const bool combined = r.combined.after >= r.target, random = r.random.after >= r.target;
    if (combined || random) faster.figure.add(r.input + " to " + text(r.target, 0) + "°", combined ? r.ratio() : 0);
  }
  return {faster};
}

/// A row of the thesis' table 3.1.
struct Best_row
{
  std::string input, preparation;
  double thesis_input, thesis_combined, thesis_random, thesis_exuded;
  Best_angles measured;
};

inline std::vector<Thesis_figure> best_figures(const std::vector<Best_row>& rows)
{
  Thesis_figure exudation = asked_without_aim("smallest angle, combined perturbation less CGAL's exudation", "14–24°",
                                              Better::more, 0, 1, "°"),
                thesis = asked_without_aim("smallest angle, combined perturbation less the thesis' (the aim)", "0°",
                                           Better::more, 0, 1, "°");
  for (const Best_row& r : rows) {
    if (r.measured.failure[0]) continue;
    const std::string label = r.input + ", " + r.preparation;
    exudation.figure.add(label, r.measured.combined - r.measured.exuded);
    thesis.figure.add(label, r.measured.combined - r.thesis_combined);
  }
  return {exudation, thesis};
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_FIGURES_H
