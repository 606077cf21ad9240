// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distribution of a planar mesh's angles as an SVG file, alone or beside that of another mesh.

#ifndef WEFT_IO_WRITE_ANGLE_HISTOGRAM_SVG_H
#define WEFT_IO_WRITE_ANGLE_HISTOGRAM_SVG_H

#include <weft/internal/as_index.h>
#include <weft/IO/internal/Svg_canvas.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// All angles of a planar mesh, counted in bins of equal width from 0 to 180 degrees.
struct Angle_histogram
{
  std::string name;                ///< for the legend
  std::vector<std::size_t> counts; ///< angles per bin
  double smallest = 180;           ///< degrees
  double largest = 0;              ///< degrees

  explicit Angle_histogram(std::string name_ = "mesh", std::size_t bins = 60) : name(std::move(name_)), counts(bins, 0)
  {}

  void add(double degrees)
  {
    const double bin = degrees / 180 * static_cast<double>(counts.size());
    ++counts[static_cast<std::size_t>(std::clamp(bin, 0., static_cast<double>(counts.size()) - 1))];
    smallest = std::min(smallest, degrees);
    largest = std::max(largest, degrees);
  }

  std::size_t total() const
  {
    std::size_t sum = 0;
    for (const std::size_t n : counts) sum += n;
    return sum;
  }
};

namespace internal {

/// The plotting area of a histogram and its vertical scale.
struct Histogram_axes
{
  double left = 90, top = 96, width = 880, height = 400;
  double most = 1; ///< per cent at the top
  double step = 1; ///< per cent between grid lines

  double x(double degrees) const { return left + degrees / 180 * width; }
  double y(double percent) const { return top + height * (1 - percent / most); }
};

/// Per cent of the angles in each bin.
inline std::vector<double> shares(const Angle_histogram& histogram)
{
  const double total = static_cast<double>(std::max<std::size_t>(histogram.total(), 1));
  std::vector<double> result;
  for (const std::size_t n : histogram.counts) result.push_back(100 * static_cast<double>(n) / total);
  return result;
}

/// Chooses grid lines at 1, 2 or 5 times a power of ten, four to ten of them.
inline Histogram_axes histogram_axes(const std::vector<const Angle_histogram*>& histograms)
{
  Histogram_axes axes;
  double most = 0.1;
  for (const Angle_histogram* histogram : histograms)
    for (const double share : shares(*histogram)) most = std::max(most, share);
  const double power = std::pow(10, std::floor(std::log10(most)));
  const double leading = most / power;
  axes.step = leading <= 2 ? 0.2 * power * (leading <= 1 ? 1 : 2) : leading <= 5 ? power : 2 * power;
  axes.most = axes.step * std::ceil(1.02 * most / axes.step);
  return axes;
}

inline void draw_histogram_axes(Svg_canvas& canvas, const Histogram_axes& axes)
{
  const int lines = static_cast<int>(std::lround(axes.most / axes.step));
  for (int i = 0; i <= lines; ++i) {
    const double share = i * axes.step, y = axes.y(share);
    canvas.line(axes.left, y, axes.left + axes.width, y, Svg_canvas::stroke(i == 0 ? "#222222" : "#dcdcdc", 1));
    canvas.text(axes.left - 10, y + 5, 15, "end",
                axes.step >= 1 ? std::to_string(std::lround(share)) : one_decimal(share));
  }
  for (int degrees = 0; degrees <= 180; degrees += 20) {
    const double x = axes.x(degrees), bottom = axes.y(0);
    canvas.line(x, bottom, x, bottom + 6, Svg_canvas::stroke("#222222", 1));
    canvas.text(x, bottom + 24, 15, "middle", std::to_string(degrees) + "°");
  }
  canvas.text(axes.x(90), axes.y(0) + 50, 16, "middle", "angle");
  const std::string middle = Svg_canvas::decimals(axes.top + axes.height / 2);
  canvas.text(34, axes.top + axes.height / 2, 16, "middle", "share of all angles (%)",
              "transform=\"rotate(-90 34 " + middle + ")\"");
}

/// Bars of one histogram: the `which`-th of `of` in each bin.
inline void draw_bars(Svg_canvas& canvas, const Histogram_axes& axes, const Angle_histogram& histogram,
                      const std::string& fill, int which, int of)
{
  const std::vector<double> share = shares(histogram);
  const double bin = axes.width / static_cast<double>(share.size()), bar = 0.88 * bin / of;
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (share[i] <= 0) continue;
    const double y = axes.y(share[i]);
    canvas.rectangle(axes.left + static_cast<double>(i) * bin + 0.06 * bin + which * bar, y, bar, axes.y(0) - y,
                     "fill=\"" + fill + "\"");
  }
}

/// Marks the smallest and the largest angle on the axis and says them in the legend.
inline void draw_extremes(Svg_canvas& canvas, const Histogram_axes& axes, const Angle_histogram& histogram,
                          const std::string& fill, int which)
{
  const double y = axes.top + 14 + 26 * which, x = axes.x(180) - 350;
  canvas.rectangle(x, y - 12, 22, 14, "fill=\"" + fill + "\"");
  std::string text = histogram.name;
  if (histogram.total() > 0)
    text += ": " + one_decimal(histogram.smallest) + "° to " + one_decimal(histogram.largest) + "°";
  canvas.text(x + 30, y, 15, "start", text);
  if (histogram.total() == 0) return;
  for (const double angle : {histogram.smallest, histogram.largest})
    canvas.line(axes.x(angle), axes.y(0) - 26, axes.x(angle), axes.y(0),
                Svg_canvas::stroke(fill, 2) + " stroke-dasharray=\"4 4\"");
}

inline void draw_histograms(const std::string& filename, const std::vector<const Angle_histogram*>& histograms,
                            const std::string& title)
{
  const std::array<const char*, 2> fills = {"#3168a8", "#e08a3c"};
  const Histogram_axes axes = histogram_axes(histograms);
  Svg_canvas canvas(filename, 1000, 580);
  canvas.text(500, 44, 22, "middle", title);
  draw_histogram_axes(canvas, axes);
  const int n = static_cast<int>(histograms.size());
  for (int i = 0; i < n; ++i) draw_bars(canvas, axes, *histograms[as_index(i)], fills[as_index(i)], i, n);
  for (int i = 0; i < n; ++i) draw_extremes(canvas, axes, *histograms[as_index(i)], fills[as_index(i)], i);
  canvas.close();
}

} // namespace internal

namespace IO {

/// Draws the distribution of a mesh's angles.
/// \throws File_error if the file can't be written.
inline void write_angle_histogram_svg(const std::string& filename, const Angle_histogram& mesh,
                                      const std::string& title = "Angles")
{
  internal::draw_histograms(filename, {&mesh}, title);
}

/// Draws the distribution of a mesh's angles beside that of a reference mesh.
/// \throws File_error if the file can't be written.
inline void write_angle_histogram_svg(const std::string& filename, const Angle_histogram& mesh,
                                      const Angle_histogram& reference, const std::string& title = "Angles")
{
  internal::draw_histograms(filename, {&mesh, &reference}, title);
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_WRITE_ANGLE_HISTOGRAM_SVG_H
