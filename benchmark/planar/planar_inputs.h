// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inputs of the planar benchmarks: what planar meshers are usually shown (square, circle, smooth curve), what they
// stumble over (close parallel constraints, spikes, nested holes), and inputs with details far below the size of the
// elements (a fractal coastline with islands, an airfoil in a box). All of them are computed, with fixed seeds; other
// inputs are read from files.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_INPUTS_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_INPUTS_H

#include <weft/IO/read_pslg.h>
#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Pslg = weft::Pslg_2<Kernel>;

constexpr double pi = 3.14159265358979323846;

struct Planar_input
{
  std::string name;
  Pslg pslg;
};

inline void add_chain(Pslg& pslg, const std::vector<Point>& points, bool closed)
{
  const std::size_t first = pslg.points.size(), n = points.size();
  for (const Point& p : points) pslg.points.push_back(p);
  for (std::size_t i = 0; i + 1 < n; ++i) pslg.segments.push_back({first + i, first + i + 1});
  if (closed) pslg.segments.push_back({first + n - 1, first});
}

inline std::vector<Point> regular_polygon(int corners, double radius, double x = 0, double y = 0, double turn = 0)
{
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * pi * i / corners;
    points.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  return points;
}

inline std::vector<Point> box(double x0, double y0, double x1, double y1)
{
  return {Point(x0, y0), Point(x1, y0), Point(x1, y1), Point(x0, y1)};
}

inline Pslg loops(const std::vector<std::vector<Point>>& polygons)
{
  Pslg pslg;
  for (const auto& polygon : polygons) add_chain(pslg, polygon, true);
  return pslg;
}

inline Pslg square()
{
  return loops({box(0, 0, 1, 1)});
}

/// A regular polygon of 48 corners.
inline Pslg circle()
{
  return loops({regular_polygon(48, 1)});
}

/// A spine with 12 teeth; the gaps between them are a fifth of a tooth wide.
inline Pslg comb()
{
  constexpr int teeth = 12;
  constexpr double width = 0.1, gap = 0.02, spine = 0.2, height = 0.9;
  std::vector<Point> outline{Point(0, 0), Point(teeth * width + (teeth - 1) * gap, 0)};
  for (int i = teeth - 1; i >= 0; --i) {
    const double left = i * (width + gap), right = left + width;
    if (i < teeth - 1) outline.emplace_back(right, spine);
    outline.emplace_back(right, height);
    outline.emplace_back(left, height);
    if (i > 0) outline.emplace_back(left, spine);
  }
  return loops({outline});
}

/// Two open constraints side by side in a square, a fiftieth of its side apart.
inline Pslg parallel()
{
  Pslg pslg = square();
  add_chain(pslg, {Point(0.2, 0.5), Point(0.8, 0.5)}, false);
  add_chain(pslg, {Point(0.2, 0.52), Point(0.8, 0.52)}, false);
  return pslg;
}

/// A disk with 17 spikes, whose tips have angles of 5, 7, ..., 37 degrees.
inline Pslg star()
{
  constexpr int spikes = 17;
  constexpr double radius = 0.4;
  const double half = radius * std::sin(pi / spikes), foot = radius * std::cos(pi / spikes);
  std::vector<Point> outline;
  for (int i = 0; i < spikes; ++i) {
    const double direction = 2 * pi * i / spikes, tip = (5 + 2 * i) * pi / 180;
    const double start = direction - pi / spikes, reach = foot + half / std::tan(tip / 2);
    outline.emplace_back(radius * std::cos(start), radius * std::sin(start));
    outline.emplace_back(reach * std::cos(direction), reach * std::sin(direction));
  }
  return loops({outline});
}

/// A disk with a hole, in it an island, and a hole in that.
inline Pslg nested_holes()
{
  return loops({regular_polygon(12, 2), regular_polygon(4, 1.3, 0.1, 0, pi / 4), regular_polygon(24, 0.75, 0.1, 0),
                regular_polygon(6, 0.35, 0.2, 0.1)});
}

/// A smooth closed curve of 256 points.
inline Pslg smooth_curve()
{
  std::vector<Point> points;
  for (int i = 0; i < 256; ++i) {
    const double t = 2 * pi * i / 256, r = 1 + 0.25 * std::cos(3 * t) + 0.1 * std::sin(5 * t);
    points.emplace_back(r * std::cos(t), r * std::sin(t));
  }
  return loops({points});
}

/// Random numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }

private:
  std::mt19937 engine_;
};

/// Replaces the middle of every edge by a point beside it.
inline std::vector<Point> roughened(const std::vector<Point>& polygon, double roughness, Random& random)
{
  std::vector<Point> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double d = random(-roughness, roughness), along = random(0.4, 0.6);
    const double dx = b.x() - a.x(), dy = b.y() - a.y();
    result.push_back(a);
    result.emplace_back(a.x() + along * dx - d * dy, a.y() + along * dy + d * dx);
  }
  return result;
}

inline double squared_distance(const std::vector<Point>& points, double x, double y)
{
  double least = 1e300;
  for (const Point& p : points) least = std::min(least, (p.x() - x) * (p.x() - x) + (p.y() - y) * (p.y() - y));
  return least;
}

/// A lake with a fractal shore of 1280 segments and 60 rough islands, most of them small.
inline Pslg coastline()
{
  Random random(7);
  std::vector<Point> shore = regular_polygon(10, 1);
  for (int level = 0; level < 7; ++level) shore = roughened(shore, 0.22, random);
  std::vector<std::vector<Point>> polygons{shore};
  std::vector<Point> taken = shore;
  while (polygons.size() < 61) {
    const double x = random(-0.9, 0.9), y = random(-0.9, 0.9);
    const double radius = 0.004 * std::pow(20., random(0, 1) * random(0, 1)), clear = 2.5 * radius + 0.02;
    if (x * x + y * y > 0.7 || squared_distance(taken, x, y) < clear * clear) continue;
    std::vector<Point> island = regular_polygon(5, radius, x, y, random(0, 1));
    for (double edge = radius; edge > 0.005; edge /= 2) island = roughened(island, 0.2, random);
    taken.insert(taken.end(), island.begin(), island.end());
    polygons.push_back(island);
  }
  return loops(polygons);
}

/// The NACA 2412 profile of chord 1, of 200 points, in a box.
inline Pslg airfoil()
{
  constexpr int half = 100;
  constexpr double camber = 0.02, place = 0.4, thickness = 0.12;
  const auto surface = [&](double x, double side) {
    const double t =
        5 * thickness *
        (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
    const double c = x < place ? camber / (place * place) : camber / ((1 - place) * (1 - place));
    const double y = x < place ? c * (2 * place * x - x * x) : c * (1 - 2 * place + 2 * place * x - x * x);
    const double slope = std::atan(2 * c * (place - x));
    return Point(x - side * t * std::sin(slope), y + side * t * std::cos(slope));
  };
  std::vector<Point> profile;
  for (int i = 0; i < half; ++i) profile.push_back(surface((1 + std::cos(pi * i / half)) / 2, 1));
  for (int i = 0; i < half; ++i) profile.push_back(surface((1 - std::cos(pi * i / half)) / 2, -1));
  profile.front() = Point(1, 0); // both sides end here
  return loops({box(-1, -1, 2, 1), profile});
}

inline std::vector<Planar_input> planar_inputs()
{
  return {{"square", square()},
          {"circle", circle()},
          {"comb", comb()},
          {"parallel", parallel()},
          {"star", star()},
          {"nested holes", nested_holes()},
          {"smooth curve", smooth_curve()},
          {"coastline", coastline()},
          {"airfoil", airfoil()}};
}

/// Reads a graph; its name is the file's, without the folder.
inline Planar_input read_planar_input(const std::string& filename)
{
  return {filename.substr(filename.find_last_of('/') + 1), weft::IO::read_pslg<Kernel>(filename)};
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_INPUTS_H
