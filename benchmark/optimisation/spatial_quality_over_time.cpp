// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the quality of a spatial mesh grows with the time spent on it, as an SVG picture: smallest dihedral angle and
// number of cells below 15 degrees of three ways to a mesh of the same criteria:
//  - weft: make_mesh_3 as it is, which interleaves refinement, coarsening, smoothing and perturbation;
//  - refine, then optimise: weft's refinement, free sweeps of Natural ODT, refinement again, perturbation, the order of
//    Tournois 2009;
//  - CGAL: refinement, odt_optimize_mesh_3, perturb_mesh_3 with rising bounds.
// Times are user CPU seconds without those spent on measuring.
//
//   spatial_quality_over_time [--target DEG] [--limit SECONDS] [--sharp-angle DEG] [--output FILE.svg] FILE
//
// --target: dihedral angle that each perturbs for, 20 unless given. --limit: wall time of each way, 60 unless given.

#include "../common/program.h"
#include "../common/quality_plot.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "optimisation_run.h"

#include <weft/spatial/refine/Batch_refiner_3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

struct Arguments
{
  double target = 20, limit = 60, sharp_angle = 0;
  std::string output = "spatial_quality_over_time.svg", file;
};

Arguments parse(int argc, char** argv)
{
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if (arg.rfind("--", 0) != 0) {
      a.file = arg;
      continue;
    }
    if (i + 1 == argc) throw weft::Option_error(arg + " needs a value");
    const std::string value = argv[++i];
    if (arg == "--output")
      a.output = value;
    else if (arg == "--target")
      a.target = std::strtod(value.c_str(), nullptr);
    else if (arg == "--limit")
      a.limit = std::strtod(value.c_str(), nullptr);
    else if (arg == "--sharp-angle")
      a.sharp_angle = std::strtod(value.c_str(), nullptr);
    else
      throw weft::Option_error("unknown option " + arg);
  }
  if (a.file.empty()) throw weft::Option_error("needs a surface file");
  if (!(a.target > 0 && a.limit > 0)) throw weft::Option_error("target and limit must be positive");
  return a;
}

/// Samples a run, at most once in every hundredth part of a decade.
class Sampler
{
public:
  explicit Sampler(Series& series) : series_(series) {}

  double seconds() const { return watch_.seconds(); }

  /// \param complete whether the criteria are known to hold.
  template <class Mesh>
  bool operator()(const Mesh& mesh, bool complete = true, bool always = false)
  {
    const double now = watch_.seconds();
    if (always || now > 1.023 * last_) watch_.pause([&] { add(mesh, now, complete); });
    return true;
  }

private:
  template <class Mesh>
  void add(const Mesh& mesh, double now, bool complete)
  {
    double worst = -1, below_15 = 0;
    for_cells(mesh, [&](double cosine) {
      worst = std::max(worst, cosine);
      below_15 += cosine > std::cos(15 * std::acos(-1.) / 180);
    });
    if (worst < 0) return; // no cells
    const double smallest = std::acos(std::min(1., worst)) * 180 / std::acos(-1.);
    series_.samples.push_back({now, {smallest, std::log10(1 + below_15)}, complete});
    last_ = now;
  }

  /// Calls `visit(cosine of the smallest dihedral angle)` for all cells. While a visitor is called, the mesh may have
  /// gaps in its list of vertices; so only cells are looked at.
  template <class Visit>
  static void for_cells(const Weft_mesh& mesh, const Visit& visit)
  {
    for (const auto c : mesh.triangulation().finite_cell_handles())
      if (c->subdomain() != 0)
        visit(weft::internal::cosine_of_smallest_dihedral(c->vertex(0)->point(), c->vertex(1)->point(),
                                                          c->vertex(2)->point(), c->vertex(3)->point()));
  }
  template <class Visit>
  static void for_cells(const Cgal_complex& mesh, const Visit& visit)
  {
    for (auto c = mesh.cells_in_complex_begin(); c != mesh.cells_in_complex_end(); ++c) {
      const auto point = [&](int i) { return c->vertex(i)->point().point(); };
      visit(weft::internal::cosine_of_smallest_dihedral(point(0), point(1), point(2), point(3)));
    }
  }

  Series& series_;
  Stopwatch watch_;
  double last_ = 0;
};

Series interleaved(const Spatial_domain& domain, const Bounds& bounds, const Arguments& a)
{
  Series series;
  const auto criteria = weft_criteria(domain.input(), bounds);
  weft::Mesh_options_3 options;
  options.min_dihedral_angle = a.target;
  options.time_limit = a.limit;
  using Mesher = weft::internal::Spatial_mesher_3<weft::Polyhedral_oracle_3<Spatial_kernel>>;
  Sampler sampler(series);
  const Mesher* running = nullptr;
  options.visitor = [&](const weft::Progress& progress) {
    const bool refined = progress.stage == weft::Stage::relaxation || progress.stage == weft::Stage::polishing;
    return sampler(running->mesh(), refined);
  };
  Mesher mesher(domain.oracle(), criteria, options);
  running = &mesher;
  const weft::Mesh_report_3 report = mesher.run();
  sampler(mesher.mesh(), report.bad() == 0, true);
  return series;
}

/// Refines until nothing more can be done.
void refine(Weft_mesh& mesh, const weft::Criteria_3<Spatial_kernel>& criteria, double floor, Sampler& sampler)
{
  weft::internal::Batch_refiner_3<Weft_mesh> refiner(mesh, criteria, 1, true, floor, 1);
  while (refiner.refine(1000000).inserted > 0) sampler(mesh, false);
}

Series refine_then_optimise(const Spatial_domain& domain, const Bounds& bounds, const Arguments& a)
{
  Series series;
  const auto criteria = weft_criteria(domain.input(), bounds);
  Sampler sampler(series);
  Weft_mesh mesh = refined_mesh(domain, bounds);
  sampler(mesh, true, true);
  weft::Smooth_options_3 smoothing;
  smoothing.keep_criteria = false;
  smoothing.max_sweeps = 100;
  smoothing.go_on = [&] { return sampler(mesh, false); };
  weft::smooth_3(mesh, criteria, smoothing);
  const double floor = bounds.approximation > 0 ? 0.1 * bounds.approximation : 1e-3 * bounds.size; // make_mesh_3's
  refine(mesh, criteria, floor, sampler);
  sampler(mesh, true, true);
  weft::Perturb_options_3 perturbation;
  perturbation.target = a.target;
  perturbation.time_limit = a.limit;
  perturbation.go_on = [&](double) { return sampler(mesh); };
  weft::perturb_slivers_3(mesh, criteria, perturbation);
  sampler(mesh, true, true);
  return series;
}

/// CGAL's optimisers can't be watched: they run by steps.
Series cgal_chain(const Spatial_domain& domain, const Bounds& bounds, const Arguments& a)
{
  Series series;
  const weft::internal::Timer wall;
  Sampler sampler(series);
  Cgal_complex complex = mesh_with_cgal(domain.cgal_domain(), bounds, bounds.size);
  sampler(complex, true, true);
  odt_with_cgal(complex, domain.cgal_domain());
  sampler(complex, false, true); // edges and shapes don't keep their bounds
  for (double bound = 1; bound <= std::max(12., a.target) && wall.seconds() < a.limit; bound += 1) {
    perturb_with_cgal(complex, domain.cgal_domain(), bound, a.limit - wall.seconds());
    sampler(complex, false, true);
    if (smallest_dihedral(complex) < bound) break; // it has given up
  }
  return series;
}

void run(const Arguments& a)
{
  const Spatial_input input = read_input(a.file, a.sharp_angle);
  const Bounds bounds{0.1, 0.001, 2};
  const Spatial_domain domain(input, 3600);
  std::vector<Series> series{interleaved(domain, bounds, a), refine_then_optimise(domain, bounds, a),
                             cgal_chain(domain, bounds, a)};
  series[0].name = "weft: make_mesh_3, interleaved", series[0].colour = "#2166ac";
  series[1].name = "weft: refine, NODT, refine, perturb", series[1].colour = "#e08214";
  series[2].name = "CGAL: refine, ODT, perturb", series[2].colour = "#b2182b";
  std::cout << "\n## Quality over time: " << input.name << "\n\n"
            << markdown_head({"way", "seconds", "smallest dihedral angle", "cells below 15°", "criteria hold"});
  double most = 1;
  for (const Series& s : series) {
    for (const Sample& p : s.samples) most = std::max(most, p.values[1]);
    const Sample& end = s.samples.back();
    std::cout << markdown_row({s.name, seconds_text(end.seconds), text(end.values[0], 1),
                               text(std::pow(10, end.values[1]) - 1, 0), end.complete ? "yes" : "not asked for"});
  }
  const double top = 10 * std::ceil((a.target + 2) / 10);
  Plot(a.output, "Quality over time: " + input.name,
       {{"smallest dihedral angle, degrees (an open disk: criteria aren't kept)", 0, top, 5, 0, a.target},
        {"cells below 15°: decimal logarithm of their number + 1", 0, std::ceil(most), 1, 0, 0}},
       series);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("spatial_quality_over_time", [&] { run(parse(argc, argv)); });
}
