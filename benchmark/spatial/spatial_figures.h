// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures that weft is to reach in space, filled with those of runs; and the growth of time with the number of
// vertices.

#ifndef WEFT_BENCHMARK_SPATIAL_SPATIAL_FIGURES_H
#define WEFT_BENCHMARK_SPATIAL_SPATIAL_FIGURES_H

#include "../common/table.h"
#include "spatial_run.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace benchmark {

/// Runs on one domain at finer and finer sizes.
using Growth = std::vector<Spatial_run>;

/// The exponent p of time ~ vertices^p that fits best.
inline double exponent(const Growth& growth, Spatial_measures Spatial_run::*mesher)
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Spatial_run& run : growth) {
    const Spatial_measures& m = run.*mesher;
    if (m.failed()) continue;
    const double u = std::log(m.vertices), v = std::log(m.seconds);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

inline std::vector<Figure> spatial_figures(const std::vector<Spatial_run>& runs, const Growth& growth)
{
  std::vector<Figure> result;
  // The references stay valid: no more than the reserved number is added.
  result.reserve(16);
  const auto ask = [&](const std::string& name, bool larger, bool on_average, double at_least, double aim, int decimals,
                       const std::string& unit = "") -> Figure& {
    result.push_back({name, larger, on_average, at_least, aim, decimals, unit, {}, true});
    return result.back();
  };
  Figure& holds = ask("meshes of which all criteria hold", true, false, 1, 1, 2);
  Figure& checked = ask("meshes in which the checker finds no fault", true, false, 1, 1, 2);
  Figure& manifold = ask("meshes whose boundary is a closed manifold", true, false, 1, 1, 2);
  for (Figure* f : {&holds, &checked, &manifold}) f->has_aim = false;
  Figure& smooth = ask("Hausdorff distance / ε, parts without creases", false, false, 3, 1.5, 2);
  Figure& creased = ask("Hausdorff distance / ε, creased parts", false, false, 3, 1.5, 2);
  Figure& against = ask("Hausdorff distance against CGAL's", false, false, 1, 1, 2, " ×");
  against.has_aim = false;
  Figure& mean = ask("vertices against CGAL, on average", false, true, 0.95, 0.8, 3, " ×");
  Figure& each = ask("vertices against CGAL, each", false, false, 1.05, 0.8, 3, " ×");
  Figure& fair = ask("vertices against CGAL, on average, its edge size lowered where that is needed for 3 ε", false,
                     true, 0.95, 0.8, 3, " ×");
  Figure& time = ask("user time against CGAL, each", false, false, 1.5, 0.5, 2, " ×");
  Figure& mean_time = ask("user time against CGAL, on average", false, true, 1.5, 0.5, 2, " ×");
  Figure& asked =
      ask("questions put to the oracle, of those that asking every time would put", false, true, 0.5, 0.5, 3);
  asked.has_aim = false;
  Figure& power = ask("time grows as vertices to the power", false, true, 1.15, 1, 3);
  Figure& memory = ask("peak memory per vertex against CGAL, 50k vertices and more", false, false, 1, 1, 2, " ×");
  memory.has_aim = false;
  for (const Spatial_run& r : runs) {
    if (r.failed()) {
      holds.add(r.label(), 0);
      continue;
    }
    const std::string label = r.label();
    holds.add(label, r.weft.criteria_hold);
    checked.add(label, r.weft.checked);
    manifold.add(label, r.weft.manifold);
    if (r.bounds.approximation > 0) {
      (r.creased ? creased : smooth).add(label, r.weft.hausdorff / r.bounds.approximation);
      against.add(label, r.weft.hausdorff / r.cgal.hausdorff);
    }
    const double ratio = r.weft.vertices / r.cgal.vertices;
    mean.add(label, ratio);
    each.add(label, ratio);
    fair.add(label, r.weft.vertices / (r.lowered_edge_size > 0 ? r.lowered : r.cgal).vertices);
    time.add(label, r.weft.seconds / r.cgal.seconds);
    mean_time.add(label, r.weft.seconds / r.cgal.seconds);
    asked.add(label, r.weft.segments / (r.weft.segments + r.weft.skipped));
    if (r.weft.vertices >= 50000) memory.add(label, r.weft.bytes_per_vertex() / r.cgal.bytes_per_vertex());
  }
  for (const Spatial_run& r : growth)
    if (!r.failed() && r.weft.vertices >= 50000)
      memory.add("sphere of " + text(r.weft.vertices, 0), r.weft.bytes_per_vertex() / r.cgal.bytes_per_vertex());
  if (growth.size() > 1) power.add("sphere", exponent(growth, &Spatial_run::weft));
  return result;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_SPATIAL_SPATIAL_FIGURES_H
