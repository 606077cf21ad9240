// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the quality of a mesh grows with the time spent on it, as an SVG picture: smallest angle, number of triangles and
// longest edge of four ways to a mesh of the same sizes:
//  - weft: crystal seeding, refinement and relaxation interleaved;
//  - weft from nothing: the same without seeding, as in Tournois 2009, Alg. 2;
//  - refine, then relax: CGAL's refinement, then weft's relaxation;
//  - CGAL: refinement, then lloyd_optimize_mesh_2.
// Times are user CPU seconds without those spent on measuring.
//
//   quality_over_time [--triangles N] [--output FILE.svg] [FILE.poly]

#include "../common/program.h"
#include "../common/quality_plot.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "planar_inputs.h"
#include "planar_measure.h"
#include "planar_peers.h"

#include <weft/make_mesh_2.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

template <class Cdt>
void sample(const Cdt& cdt, double size, double seconds, Series& series)
{
  const Measures m = measure(flat_mesh(cdt), [size](double, double) { return size; });
  series.samples.push_back({seconds, {m.smallest_angle, m.relative_count(), m.largest_ratio}, m.oversize == 0});
}

/// A run of weft that is measured whenever the mesher calls its visitor, at most every hundredth part of a decade.
template <class Run>
void sample_weft(Weft_cdt& cdt, double size, double already, Series& series, const Run& run)
{
  Stopwatch watch;
  double last = -1;
  weft::Mesh_options_2 options;
  options.visitor = [&](const weft::Progress&) {
    const double now = already + watch.seconds();
    if (now > 0 && now > last * 1.023) {
      watch.pause([&] { sample(cdt, size, now, series); });
      last = now;
    }
    return true;
  };
  run(options);
  sample(cdt, size, already + watch.seconds(), series);
}

Series interleaved(const Domain& domain, double size, weft::Seeding seeding)
{
  Series series;
  Weft_cdt cdt(domain.weft);
  sample_weft(cdt, size, 0, series, [&](weft::Mesh_options_2& options) {
    options.seeding = seeding;
    weft::make_mesh_2(cdt, weft::Uniform_sizing<>(size), options);
  });
  return series;
}

Series refine_then_relax(const Domain& domain, double size)
{
  Series series;
  Weft_cdt cdt(domain.weft);
  Stopwatch watch;
  refine_with_cgal(cdt, size);
  const double refined = watch.seconds();
  sample(cdt, size, refined, series);
  sample_weft(cdt, size, refined, series,
              [&](weft::Mesh_options_2& options) { weft::relax_2(cdt, weft::Uniform_sizing<>(size), options); });
  return series;
}

/// CGAL's Lloyd iteration can't be watched: each sample is a run of its own from the refined mesh.
Series refine_then_cgal(const Domain& domain, double size)
{
  Series series;
  Cgal_cdt refined(domain.cgal);
  Stopwatch watch;
  refine_with_cgal(refined, size);
  const double seconds = watch.seconds();
  sample(refined, size, seconds, series);
  for (const int iterations : {1, 2, 4, 8, 16, 32, 64, 100}) {
    Cgal_cdt cdt(refined);
    Stopwatch lloyd;
    lloyd_with_cgal(cdt, iterations);
    sample(cdt, size, seconds + lloyd.seconds(), series);
  }
  return series;
}

// ---- The picture

void run(int argc, char** argv)
{
  double triangles = 10000;
  std::string output = "quality_over_time.svg";
  Planar_input input{"square", square()};
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if ((arg == "--triangles" || arg == "--output") && i + 1 < argc) {
      if (arg == "--output")
        output = argv[++i];
      else
        triangles = std::strtod(argv[++i], nullptr);
    } else if (arg.rfind("--", 0) == 0) {
      throw weft::Option_error("unknown option, or one without its value: " + arg);
    } else {
      input = read_planar_input(arg);
    }
  }
  if (!(triangles > 0)) throw weft::Option_error("--triangles needs a positive number");
  const Domain domain(input);
  const double size = domain.size_for(triangles / 1.5);

  std::vector<Series> series{interleaved(domain, size, weft::Seeding::crystal),
                             interleaved(domain, size, weft::Seeding::none), refine_then_relax(domain, size),
                             refine_then_cgal(domain, size)};
  const std::array<std::array<const char*, 2>, 4> names{{{"weft: seeded, interleaved", "#2166ac"},
                                                         {"weft from nothing, interleaved", "#35978f"},
                                                         {"CGAL refine, then weft relax", "#e08214"},
                                                         {"CGAL refine, then CGAL Lloyd", "#b2182b"}}};
  std::cout << "\n## Quality over time: " << input.name << ", " << text(triangles, 0) << " triangles asked\n\n"
            << markdown_head({"way", "seconds", "smallest angle", "T/m_Δ", "longest edge / size"});
  for (std::size_t k = 0; k < series.size(); ++k) {
    series[k].name = names[k][0];
    series[k].colour = names[k][1];
    const Sample& end = series[k].samples.back();
    std::cout << markdown_row({series[k].name, seconds_text(end.seconds), text(end.values[0], 1),
                               text(end.values[1], 3), text(end.values[2], 3)});
  }
  const std::vector<Panel> panels{
      {"smallest angle, degrees", 0, 50, 10, 0, 32},
      {"triangles / m_Δ", 0, 2.5, 0.5, 1, 1.58},
      {"longest edge / size (shown up to 2; an open disk: it ends above 1)", 0.5, 2, 0.5, 1, 1}};
  Plot(output, "Quality over time: " + input.name + ", " + text(triangles, 0) + " triangles asked", panels, series);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("quality_over_time", [&] { run(argc, argv); });
}
