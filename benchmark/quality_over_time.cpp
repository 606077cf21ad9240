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

#include "planar_inputs.h"
#include "planar_measure.h"
#include "planar_peers.h"
#include "planar_table.h"

#include <weft/IO/internal/Svg_canvas.h>
#include <weft/make_mesh_2.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

struct Sample
{
  double seconds;
  std::array<double, 3> values; // one per panel
  bool sizes_hold;
};

struct Series
{
  std::string name, colour;
  std::vector<Sample> samples;
};

/// User time that can be stopped to measure.
class Stopwatch
{
public:
  double seconds() const { return user_seconds() - start_; }
  /// Runs something that doesn't count.
  template <class Function>
  void pause(const Function& function)
  {
    const double before = user_seconds();
    function();
    start_ += user_seconds() - before;
  }

private:
  double start_ = user_seconds();
};

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

struct Panel
{
  std::string title;
  double low, high, step;
  int decimals;
  double mark; // a level that is asked for
};

/// Plots values against the logarithm of time.
class Plot
{
public:
  Plot(const std::string& filename, const std::string& title, const std::vector<Panel>& panels,
       const std::vector<Series>& series)
      : panels_(panels), canvas_(filename, width, bottom(panels.size() - 1) + 60)
  {
    canvas_.text(left, 34, 20, "start", title, "font-weight=\"bold\"");
    for (const Series& s : series) last_ = std::max(last_, std::ceil(std::log10(s.samples.back().seconds) * 4) / 4);
    first_ = last_ - decades;
    legend(series);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      axes(i);
      for (const Series& s : series) curve(i, s);
    }
    canvas_.text((left + right) / 2, bottom(panels.size() - 1) + 48, 15, "middle", "user CPU time in seconds");
    canvas_.close();
  }

private:
  static constexpr double width = 1000, left = 80, right = 960, decades = 3.25, first_top = 130, height = 210,
                          space = 50;

  static double top(std::size_t i) { return first_top + static_cast<double>(i) * (height + space); }
  static double bottom(std::size_t i) { return top(i) + height; }
  double x(double seconds) const { return left + (right - left) * (std::log10(seconds) - first_) / (last_ - first_); }
  double y(std::size_t i, double value) const
  {
    const double part = (value - panels_[i].low) / (panels_[i].high - panels_[i].low);
    return bottom(i) - height * std::min(1., std::max(0., part));
  }

  void legend(const std::vector<Series>& series)
  {
    for (std::size_t k = 0; k < series.size(); ++k) {
      const double x0 = left + 440 * static_cast<double>(k % 2), y0 = 62 + 24 * static_cast<double>(k / 2);
      canvas_.line(x0, y0, x0 + 36, y0, weft::internal::Svg_canvas::stroke(series[k].colour, 3));
      canvas_.text(x0 + 46, y0 + 5, 15, "start", series[k].name);
    }
  }

  void axes(std::size_t i)
  {
    using weft::internal::Svg_canvas;
    const Panel& p = panels_[i];
    for (double v = p.low; v <= p.high + 1e-9; v += p.step) {
      canvas_.line(left, y(i, v), right, y(i, v), Svg_canvas::stroke("#e2e2e2", 1));
      canvas_.text(left - 8, y(i, v) + 5, 13, "end", text(v, p.decimals));
    }
    for (double e = std::ceil(first_); e <= last_ + 1e-9; e += 1) {
      const double at = x(std::pow(10, e));
      canvas_.line(at, top(i), at, bottom(i), Svg_canvas::stroke("#e2e2e2", 1));
      canvas_.text(at, bottom(i) + 18, 13, "middle", text(std::pow(10, e), std::max(0, static_cast<int>(-e))));
    }
    canvas_.line(left, y(i, p.mark), right, y(i, p.mark),
                 Svg_canvas::stroke("#888888", 1) + " stroke-dasharray=\"6 5\"");
    canvas_.line(left, bottom(i), right, bottom(i), Svg_canvas::stroke("#222222", 1.2));
    canvas_.line(left, top(i), left, bottom(i), Svg_canvas::stroke("#222222", 1.2));
    canvas_.text(left, top(i) - 10, 15, "start", p.title);
  }

  /// The last sample gets a disk, open if an edge is too long.
  void curve(std::size_t i, const Series& s)
  {
    if (s.samples.empty()) return;
    canvas_.begin_path("fill=\"none\" " + weft::internal::Svg_canvas::stroke(s.colour, 2));
    bool begun = false;
    for (const Sample& p : s.samples) {
      if (std::log10(p.seconds) < first_) continue; // a handful of triangles
      begun ? canvas_.line_to(x(p.seconds), y(i, p.values[i])) : canvas_.move_to(x(p.seconds), y(i, p.values[i]));
      begun = true;
    }
    canvas_.end_path();
    const Sample& end = s.samples.back();
    const double px = x(end.seconds), py = y(i, end.values[i]);
    // The canvas' circles take their colour from the group, of which it has none but translations: a short thick line.
    canvas_.line(px, py, px + 0.01, py, weft::internal::Svg_canvas::stroke(s.colour, 11));
    if (!end.sizes_hold) canvas_.line(px, py, px + 0.01, py, weft::internal::Svg_canvas::stroke("white", 6));
  }

  std::vector<Panel> panels_;
  double first_ = -10, last_ = -10; // decimal logarithms of seconds
  weft::internal::Svg_canvas canvas_;
};

int run(int argc, char** argv)
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
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "quality_over_time: " << error.what() << "\n";
    return 1;
  }
}
