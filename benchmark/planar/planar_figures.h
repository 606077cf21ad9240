// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures that weft is to reach in the plane, filled with those of runs.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_FIGURES_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_FIGURES_H

#include "../common/table.h"
#include "planar_run.h"
#include "planar_sweep.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

/// Exponents of time in the number of triangles, between the given sizes, for uniform runs.
inline Figure growth(const std::vector<Run>& runs, double from, double to)
{
  Figure f{"time grows as triangles to the power, from " + Run::size_label(from) + " to " + Run::size_label(to),
           false,
           true,
           1.1,
           1,
           3,
           "",
           {}};
  for (const Run& a : runs)
    for (const Run& b : runs)
      if (a.field.empty() && b.field.empty() && a.input == b.input && a.triangles == from && b.triangles == to &&
          a.weft.triangles > 0 && b.weft.triangles > 0)
        f.add(a.input, std::log(b.weft_seconds / a.weft_seconds) /
                           std::log(static_cast<double>(b.weft.triangles) / static_cast<double>(a.weft.triangles)));
  return f;
}

inline std::vector<Figure> figures(const std::vector<Run>& runs, const Sweep& sweep)
{
  std::vector<Figure> result;
  // The references stay valid: no more than the reserved number is added.
  result.reserve(32);
  const auto ask = [&](const std::string& name, bool larger, bool on_average, double at_least, double aim, int decimals,
                       const std::string& unit = "") -> Figure& {
    result.push_back({name, larger, on_average, at_least, aim, decimals, unit, {}});
    return result.back();
  };
  Figure& each = ask("Steiner points against CGAL, uniform, each", false, false, -20, -34, 1, " %");
  Figure& mean = ask("Steiner points against CGAL, uniform, on average", false, true, -26, -34, 1, " %");
  Figure& count = ask("triangles / m_Δ at 10k, on average", false, true, 1.58, 1.45, 3);
  Figure& small = ask("smallest angle, inputs without angles below 60°", true, false, 32, 37, 1, "°");
  Figure& large = ask("largest angle, same inputs", false, false, 102, 94, 1, "°");
  Figure& spike = ask("spikes: smallest angle less the input's own", true, false, 0, 0, 3, "°");
  spike.has_aim = false;
  Figure& spike_large = ask("spikes: largest angle", false, false, 115, 108, 1, "°");
  Figure& fine_angle = ask("input finer than the size: smallest angle less CGAL's", true, false, 0, 0, 1, "°");
  fine_angle.has_aim = false;
  Figure& fine_points = ask("input finer than the size: Steiner points against CGAL", false, false, 0, -15, 1, " %");
  Figure& graded = ask("Steiner points against CGAL, graded", false, false, -25, -35, 1, " %");
  Figure& ratio = ask("longest edge / size at the centroid, over triangles", false, false, 1, 1, 6);
  ratio.has_aim = false;
  Figure& edge_ratio = ask("length / size at the middle, over constrained edges", false, false, 1, 1, 6);
  edge_ratio.has_aim = false;
  Figure& wrong = ask("edges that break Delaunay, turned triangles, meshes that don't conform", false, false, 0, 0, 0);
  wrong.has_aim = false;
  Figure& time_10k = ask("user time against CGAL, uniform, 10k", false, false, 8, 2, 1, " ×");
  Figure& time_100k = ask("user time against CGAL, uniform, 100k", false, false, 5, 1.5, 1, " ×");
  Figure& time_1m = ask("user time against CGAL, uniform, 1M", false, false, 3, 0.7, 2, " ×");
  Figure& graded_10k = ask("user time against CGAL, graded, 10k", false, false, 20, 4, 1, " ×");
  Figure& graded_100k = ask("user time against CGAL, graded, 100k", false, false, 20, 4, 1, " ×");
  for (const Run& r : runs) {
    if (r.weft.triangles == 0) continue;
    const std::string label = r.label();
    ratio.add(label, r.weft.largest_ratio);
    edge_ratio.add(label, r.weft.largest_edge_ratio);
    wrong.add(label, static_cast<double>(r.weft.non_delaunay + r.weft.inverted + !r.conforming));
    const bool graded_field = !r.field.empty();
    if (r.triangles == 10000) (graded_field ? graded_10k : time_10k).add(label, r.time_ratio());
    if (r.triangles == 100000) (graded_field ? graded_100k : time_100k).add(label, r.time_ratio());
    if (r.triangles == 1000000) time_1m.add(label, r.time_ratio());
    if (!r.stop.empty()) continue; // few points of an unfinished mesh are no merit
    if (r.finer) {
      fine_angle.add(label, r.weft.smallest_angle - r.cgal.smallest_angle);
      fine_points.add(label, r.more_points());
      continue;
    }
    if (graded_field) {
      graded.add(label, r.more_points());
      continue;
    }
    each.add(label, r.more_points());
    mean.add(label, r.more_points());
    if (r.triangles == 10000) count.add(label, r.weft.relative_count());
    if (r.input_angle >= 60 - 1e-6) {
      small.add(label, r.weft.smallest_angle);
      large.add(label, r.weft.largest_angle);
    } else {
      spike.add(label, std::min(0., r.weft.smallest_angle - r.input_angle));
      spike_large.add(label, r.weft.largest_angle);
    }
  }
  if (sweep.vertices > 0) {
    ask("one sweep over 100k vertices against their Delaunay triangulation, far from rest", false, false, 1, 0.6, 2,
        " ×")
        .add("first sweep", sweep.first / sweep.delaunay);
    ask("the same after 40 sweeps", false, false, 1, 0.6, 2, " ×").add("40th sweep", sweep.late / sweep.delaunay);
  }
  for (const double to : {100000., 1000000.})
    if (Figure f = growth(runs, 10000, to); !f.values.empty()) result.push_back(std::move(f));
  return result;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_FIGURES_H
