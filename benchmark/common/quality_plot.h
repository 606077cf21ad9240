// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plots of how the quality of a mesh grows with the time spent on it, as SVG.

#ifndef WEFT_BENCHMARK_COMMON_QUALITY_PLOT_H
#define WEFT_BENCHMARK_COMMON_QUALITY_PLOT_H

#include "table.h"

#include <weft/IO/internal/Svg_canvas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace benchmark {

/// A moment of a run.
struct Sample
{
  double seconds;
  std::vector<double> values; ///< one per panel
  bool complete;              ///< whether it has what was asked for; an open disk at the end says that it hasn't
};

/// One way to a mesh.
struct Series
{
  std::string name, colour;
  std::vector<Sample> samples;
};

/// One diagram above others.
struct Panel
{
  std::string title;
  double low, high, step;
  int decimals;
  double mark; ///< a level that is asked for
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

  /// The last sample gets a disk, open if it lacks something.
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
    if (!end.complete) canvas_.line(px, py, px + 0.01, py, weft::internal::Svg_canvas::stroke("white", 6));
  }

  std::vector<Panel> panels_;
  double first_ = -10, last_ = -10; // decimal logarithms of seconds
  weft::internal::Svg_canvas canvas_;
};

} // namespace benchmark

#endif // WEFT_BENCHMARK_COMMON_QUALITY_PLOT_H
