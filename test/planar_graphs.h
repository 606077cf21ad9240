// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planar straight line graphs for tests and benchmarks: domains, random graphs, transformations.

#ifndef WEFT_TEST_PLANAR_GRAPHS_H
#define WEFT_TEST_PLANAR_GRAPHS_H

#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace planar {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Pslg = weft::Pslg_2<K>;
using Point = K::Point_2;
using Random = std::mt19937;

inline const double pi = std::acos(-1.0);

/// The same on every platform, which std::uniform_real_distribution isn't.
inline double uniform(Random& random, double low, double high)
{
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

/// Random integer in [0, n).
inline std::size_t below(Random& random, std::size_t n)
{
  return random() % n;
}

template <class T>
void shuffle(std::vector<T>& items, Random& random)
{
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(random, i)]);
}

// ---- Domains

/// Adds a closed polygon.
inline void add_loop(Pslg& pslg, const std::vector<Point>& corners)
{
  const std::size_t first = pslg.points.size(), n = corners.size();
  pslg.points.insert(pslg.points.end(), corners.begin(), corners.end());
  for (std::size_t i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n});
}

inline void add_segment(Pslg& pslg, const Point& a, const Point& b)
{
  pslg.segments.push_back({pslg.points.size(), pslg.points.size() + 1});
  pslg.points.push_back(a);
  pslg.points.push_back(b);
}

inline void add_square(Pslg& pslg, double x, double y, double half)
{
  add_loop(pslg, {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}});
}

inline void add_circle(Pslg& pslg, double x, double y, double radius, int n)
{
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i)
    corners.emplace_back(x + radius * std::cos(2 * pi * i / n), y + radius * std::sin(2 * pi * i / n));
  add_loop(pslg, corners);
}

inline Pslg square()
{
  Pslg pslg;
  add_square(pslg, 0.5, 0.5, 0.5);
  return pslg;
}

inline Pslg circle(int n = 40)
{
  Pslg pslg;
  add_circle(pslg, 0.5, 0.5, 0.5, n);
  return pslg;
}

inline Pslg l_shape()
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}});
  return pslg;
}

inline Pslg annulus()
{
  Pslg pslg = circle();
  add_circle(pslg, 0.5, 0.5, 0.2, 25);
  return pslg;
}

/// A ring, an island in its hole, and a hole in the island.
inline Pslg nested_holes()
{
  Pslg pslg = square();
  add_square(pslg, 0.5, 0.5, 0.35);
  add_circle(pslg, 0.5, 0.5, 0.25, 20);
  add_square(pslg, 0.45, 0.5, 0.1);
  return pslg;
}

inline Pslg close_constraints()
{
  Pslg pslg = square();
  add_segment(pslg, {0.1, 0.5}, {0.9, 0.5});
  add_segment(pslg, {0.1, 0.51}, {0.9, 0.51});
  return pslg;
}

/// Spikes of 5 to 37 degrees around a disk.
inline Pslg star(int spikes = 17)
{
  Pslg pslg;
  std::vector<Point> corners;
  const double step = 2 * pi / spikes, r = 0.25, half_base = r * std::sin(step / 2);
  for (int i = 0; i < spikes; ++i) {
    const double at = i * step, tip = (5 + 32.0 * i / (spikes - 1)) * pi / 180;
    const double reach = r * std::cos(step / 2) + (std::min)(half_base / std::tan(tip / 2), 0.7);
    corners.emplace_back(0.5 + r * std::cos(at - step / 2), 0.5 + r * std::sin(at - step / 2));
    corners.emplace_back(0.5 + reach * std::cos(at), 0.5 + reach * std::sin(at));
  }
  add_loop(pslg, corners);
  return pslg;
}

inline Pslg comb(int teeth = 6)
{
  Pslg pslg;
  std::vector<Point> corners{{0, 0}, {1, 0}};
  const double width = 1.0 / (2 * teeth - 1);
  for (int i = 0; i < teeth; ++i) {
    const double right = 1 - 2 * i * width, left = right - width;
    corners.emplace_back(right, 1);
    corners.emplace_back(i + 1 == teeth ? 0 : left, 1);
    if (i + 1 == teeth) break;
    corners.emplace_back(left, 0.2);
    corners.emplace_back(left - width, 0.2);
  }
  add_loop(pslg, corners);
  return pslg;
}

inline Pslg several_components()
{
  Pslg pslg;
  add_square(pslg, 0.15, 0.15, 0.15);
  add_circle(pslg, 0.7, 0.3, 0.25, 30);
  add_loop(pslg, {{0.1, 0.5}, {0.4, 0.6}, {0.2, 0.95}});
  return pslg;
}

inline Pslg dangling_constraints()
{
  Pslg pslg = square();
  const std::size_t corner = 0, n = pslg.points.size();
  pslg.points.insert(pslg.points.end(), {{0.3, 0.2}, {0.4, 0.45}, {0.6, 0.3}, {0.8, 0.8}, {0.5, 0.7}});
  pslg.segments.insert(pslg.segments.end(), {{corner, n}, {n, n + 1}, {n, n + 2}, {n + 3, n + 4}});
  add_segment(pslg, {1.2, 0.2}, {1.4, 0.9}); // outside
  return pslg;
}

inline Pslg isolated_points()
{
  Pslg pslg = square();
  pslg.points.insert(pslg.points.end(), {{0.31, 0.52}, {0.32, 0.52}, {0.7, 0.23}, {0.5, 0.01}, {1.3, 0.4}, {0.5, 0}});
  return pslg;
}

struct Domain
{
  std::string name;
  Pslg pslg;
};

inline std::vector<Domain> domains()
{
  return {{"square", square()},
          {"circle", circle()},
          {"L", l_shape()},
          {"annulus", annulus()},
          {"nested holes", nested_holes()},
          {"close parallel constraints", close_constraints()},
          {"star", star()},
          {"comb", comb()},
          {"several components", several_components()},
          {"dangling constraints", dangling_constraints()},
          {"isolated points", isolated_points()}};
}

// ---- Random graphs

/// Segments that meet nowhere, in a square.
inline Pslg random_segments(Random& random, int n)
{
  Pslg pslg = square();
  std::vector<K::Segment_2> taken;
  for (std::size_t i = 0; i < 4; ++i) taken.emplace_back(pslg.points[i], pslg.points[(i + 1) % 4]);
  for (int tries = 0; tries < n; ++tries) {
    const double reach = std::pow(10.0, uniform(random, -3, 0));
    const Point a(uniform(random, 0, 1), uniform(random, 0, 1)),
        b(a.x() + uniform(random, -reach, reach), a.y() + uniform(random, -reach, reach));
    const K::Segment_2 s(a, b);
    if (std::any_of(taken.begin(), taken.end(), [&](const auto& t) { return CGAL::do_intersect(s, t); })) continue;
    taken.push_back(s);
    add_segment(pslg, a, b);
  }
  return pslg;
}

/// A polygon that its center sees whole; spikes are longer the larger `roughness` is.
inline Pslg star_shaped_polygon(Random& random, int n, double roughness)
{
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back(uniform(random, 0, 2 * pi));
  std::sort(angles.begin(), angles.end());
  std::vector<Point> corners;
  for (const double a : angles) {
    const double r = std::exp(uniform(random, -roughness, 0));
    corners.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  Pslg pslg;
  add_loop(pslg, corners);
  return pslg;
}

/// A simple polygon through random points: crossing sides are exchanged until none is left.
inline Pslg simple_polygon(Random& random, int n)
{
  std::vector<Point> p;
  for (int i = 0; i < n; ++i) p.emplace_back(uniform(random, 0, 1), uniform(random, 0, 1));
  for (bool crossing = true; crossing;) {
    crossing = false;
    for (int i = 0; i < n; ++i)
      for (int k = i + 2; k < n - (i == 0); ++k)
        if (CGAL::do_intersect(K::Segment_2(p[i], p[i + 1]), K::Segment_2(p[k], p[(k + 1) % n]))) {
          std::reverse(p.begin() + i + 1, p.begin() + k + 1);
          crossing = true;
        }
  }
  Pslg pslg;
  add_loop(pslg, p);
  return pslg;
}

/// A square grid from which edges are missing.
inline Pslg broken_grid(Random& random, int n, double kept)
{
  Pslg pslg;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) pslg.points.emplace_back(x, y);
  const auto at = [n](int x, int y) { return static_cast<std::size_t>(y * (n + 1) + x); };
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      if (x < n && uniform(random, 0, 1) < kept) pslg.segments.push_back({at(x, y), at(x + 1, y)});
      if (y < n && uniform(random, 0, 1) < kept) pslg.segments.push_back({at(x, y), at(x, y + 1)});
    }
  return pslg;
}

/// Triangles and quadrilaterals above each other, down to 1e-12 of their length high.
inline Pslg slivers(Random& random, int n)
{
  Pslg pslg;
  for (int i = 0; i < n; ++i) {
    const double h = std::pow(10.0, uniform(random, -12, -1)), x = uniform(random, 0.1, 0.9);
    if (random() % 2)
      add_loop(pslg, {Point(0, i), Point(1, i), Point(x, i + h)});
    else
      add_loop(pslg, {Point(0, i), Point(1, i), Point(1, i + h), Point(x, i + 0.5 * h), Point(0, i + h)});
  }
  return pslg;
}

/// A polygon whose corners come in pairs that are a few units in the last place apart, and points just as near to them.
inline Pslg nearly_duplicate_points(Random& random, int n)
{
  const Pslg rough = star_shaped_polygon(random, n, 1);
  const double ulp = std::numeric_limits<double>::epsilon();
  const auto near = [&](const Point& p) {
    const auto steps = [&] { return (static_cast<double>(below(random, 9)) - 4) * ulp; };
    const double dx = steps(), dy = steps();
    return Point(p.x() + dx, p.y() + dy);
  };
  std::vector<Point> corners;
  for (const Point& p : rough.points) {
    corners.push_back(p);
    const Point q = near(p);
    if (random() % 2 && q != p) corners.push_back(q);
  }
  Pslg pslg;
  add_loop(pslg, corners);
  for (const Point& p : rough.points)
    if (random() % 2) pslg.points.push_back(near(p));
  return pslg;
}

/// A turned rectangle with many points on its sides, as near to collinear as rounding lets them be, and a diagonal.
inline Pslg collinear_chains(Random& random, int n)
{
  const double angle = random() % 2 ? 0 : uniform(random, 0, 2 * pi), c = std::cos(angle), s = std::sin(angle);
  const std::array<Point, 4> corner{Point(0, 0), Point(2, 0), Point(2, 1), Point(0, 1)};
  std::vector<Point> loop;
  const auto add = [&](double x, double y) { loop.emplace_back(c * x - s * y, s * x + c * y); };
  for (int k = 0; k < 4; ++k) {
    const Point &a = corner[k], &b = corner[(k + 1) % 4];
    std::vector<double> at{0};
    for (int i = 0; i < n; ++i) at.push_back(std::pow(uniform(random, 0, 1), 1 + below(random, 6)));
    std::sort(at.begin(), at.end());
    for (const double t : at)
      if (t < 1) add(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()));
  }
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  Pslg pslg;
  add_loop(pslg, loop);
  if (random() % 2) pslg.segments.push_back({0, below(random, loop.size() - 1) + 1});
  return pslg;
}

/// Segments that fan out from one corner with angles down to 1e-6, some of them closed to triangles.
inline Pslg tiny_angles(Random& random, int n)
{
  Pslg pslg;
  pslg.points.emplace_back(0, 0);
  double angle = uniform(random, 0, pi);
  for (int i = 0; i < n; ++i) {
    angle += std::pow(10.0, uniform(random, -6, -0.5));
    const double r = std::pow(10.0, uniform(random, -2, 0));
    pslg.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    pslg.segments.push_back({0, pslg.points.size() - 1});
    if (i > 0 && random() % 4) pslg.segments.push_back({pslg.points.size() - 2, pslg.points.size() - 1});
  }
  return pslg;
}

/// Polygons within polygons.
inline Pslg random_rings(Random& random, int n)
{
  Pslg pslg;
  double radius = 1;
  for (int i = 0; i < n; ++i) {
    const int corners = 3 + static_cast<int>(below(random, 30));
    add_circle(pslg, 0, 0, radius, corners);
    radius *= std::cos(pi / corners) * uniform(random, 0.3, 1);
  }
  return pslg;
}

/// Anything between a few points: repeated points and segments, crossings, overlaps, points on segments.
inline Pslg anything(Random& random, int n)
{
  Pslg pslg;
  const bool on_grid = random() % 2;
  const auto coordinate = [&] { return on_grid ? static_cast<double>(below(random, 5)) : uniform(random, 0, 1); };
  for (int i = 0; i < n; ++i) {
    const double x = coordinate(), y = coordinate();
    pslg.points.emplace_back(x, y);
  }
  for (int i = 0; i < 2 * n; ++i)
    pslg.segments.push_back({below(random, pslg.points.size()), below(random, pslg.points.size())});
  return pslg;
}

constexpr int kinds_of_random_graphs = 10;

/// A random graph of the given kind, with coordinates of about 1.
inline Pslg random_pslg(int kind, Random& random)
{
  const int n = 3 + static_cast<int>(below(random, 30));
  switch (kind) {
  case 0:
    return random_segments(random, 2 * n);
  case 1:
    return star_shaped_polygon(random, n, uniform(random, 0, 5));
  case 2:
    return simple_polygon(random, n);
  case 3:
    return broken_grid(random, 1 + n / 3, uniform(random, 0.3, 1));
  case 4:
    return slivers(random, 1 + n / 4);
  case 5:
    return nearly_duplicate_points(random, n);
  case 6:
    return collinear_chains(random, n / 2);
  case 7:
    return tiny_angles(random, n);
  case 8:
    return random_rings(random, 1 + n / 4);
  default:
    return anything(random, n);
  }
}

// ---- Transformations

inline Pslg transformed(Pslg pslg, double scale, double angle, double dx, double dy)
{
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  const auto map = [&](Point& p) { p = Point(c * p.x() - s * p.y() + dx, s * p.x() + c * p.y() + dy); };
  for (Point& p : pslg.points) map(p);
  for (Point& p : pslg.holes) map(p);
  return pslg;
}

/// The same graph with points and segments in another order and some segments turned around.
inline Pslg shuffled(const Pslg& pslg, unsigned seed)
{
  Random random(seed);
  std::vector<std::size_t> order(pslg.points.size()), place(pslg.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  shuffle(order, random);
  Pslg result = pslg;
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.points[i] = pslg.points[order[i]];
    place[order[i]] = i;
  }
  shuffle(result.segments, random);
  for (auto& [a, b] : result.segments) {
    a = place[a];
    b = place[b];
    if (random() % 2) std::swap(a, b);
  }
  return result;
}

inline double diameter(const Pslg& pslg)
{
  CGAL::Bbox_2 box;
  for (const Point& p : pslg.points) box += p.bbox();
  return (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
}

} // namespace planar

#endif // WEFT_TEST_PLANAR_GRAPHS_H
