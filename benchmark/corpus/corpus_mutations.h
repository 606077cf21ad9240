// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces, damaged at random: what becomes of models on their way through other programs.

#ifndef WEFT_BENCHMARK_CORPUS_CORPUS_MUTATIONS_H
#define WEFT_BENCHMARK_CORPUS_CORPUS_MUTATIONS_H

#include "../../test/fixtures/planar_graphs.h"
#include "../../test/fixtures/surface_fixtures.h"

#include <CGAL/centroid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace corpus {

using planar::below;
using planar::Random;
using planar::uniform;
using surfaces::Point;
using surfaces::Surface;
using surfaces::Triangle;

/// 10 to a power in [low, high), each power as likely.
inline double power(Random& random, double low, double high)
{
  return std::pow(10.0, uniform(random, low, high));
}

inline double longest_side(const Surface& s)
{
  CGAL::Bbox_3 box;
  for (const Point& p : s.points) box += p.bbox();
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

inline Point shifted(const Point& p, Random& random, double reach)
{
  const double dx = uniform(random, -reach, reach), dy = uniform(random, -reach, reach),
               dz = uniform(random, -reach, reach);
  return {p.x() + dx, p.y() + dy, p.z() + dz};
}

// ---- Damage

/// Takes facets around a vertex away, once or a few times.
inline void punch_holes(Surface& s, Random& random)
{
  for (std::size_t holes = 1 + below(random, 4); holes > 0 && s.triangles.size() > 1; --holes) {
    const std::size_t center = s.triangles[below(random, s.triangles.size())][below(random, 3)];
    const std::size_t most = random() % 2 ? 1 : s.triangles.size() - 1;
    std::size_t taken = 0;
    const auto is_taken = [&](const Triangle& t) {
      return taken < most && std::find(t.begin(), t.end(), center) != t.end() && ++taken > 0;
    };
    s.triangles.erase(std::remove_if(s.triangles.begin(), s.triangles.end(), is_taken), s.triangles.end());
  }
}

/// Turns some facets, or most, the wrong way round.
inline void flip_facets(Surface& s, Random& random)
{
  const double share = random() % 2 ? power(random, -3, 0) : 0;
  std::swap(s.triangles[0][1], s.triangles[0][2]);
  for (Triangle& t : s.triangles)
    if (uniform(random, 0, 1) < share) std::swap(t[1], t[2]);
}

/// Makes one vertex of two, neighbours or not. Facets that lose a corner stay, or go.
inline void merge_vertices(Surface& s, Random& random)
{
  for (std::size_t i = 1 + below(random, 5); i > 0; --i) {
    const Triangle& t = s.triangles[below(random, s.triangles.size())];
    const std::size_t a = t[0], b = random() % 2 ? t[1] : below(random, s.points.size());
    for (Triangle& u : s.triangles) std::replace(u.begin(), u.end(), b, a);
  }
  if (random() % 2) return;
  const auto is_degenerate = [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  s.triangles.erase(std::remove_if(s.triangles.begin(), s.triangles.end(), is_degenerate), s.triangles.end());
}

/// Moves all vertices, from a few units in the last place to a third of the surface.
inline void add_noise(Surface& s, Random& random)
{
  const double reach = power(random, -16, -0.5) * longest_side(s);
  for (Point& p : s.points) p = shifted(p, random, reach);
}

/// Moves one vertex far, or onto another one but for rounding.
inline void move_one_vertex(Surface& s, Random& random)
{
  const double side = longest_side(s);
  Point& p = s.points[below(random, s.points.size())];
  if (random() % 2) {
    p = shifted(p, random, power(random, -1, 1) * side);
  } else {
    const Point& q = s.points[below(random, s.points.size())];
    p = shifted(q, random, power(random, -16, -9) * side);
  }
}

/// Rounds coordinates, as text files with few digits do.
inline void round_coordinates(Surface& s, Random& random)
{
  const double unit = power(random, -7, -1) * longest_side(s);
  const auto rounded = [unit](double x) { return unit * std::round(x / unit); };
  for (Point& p : s.points) p = Point(rounded(p.x()), rounded(p.y()), rounded(p.z()));
}

/// Makes the surface nearly flat, huge, tiny or far from the origin.
inline void distort(Surface& s, Random& random)
{
  const double scale = power(random, -12, 12), flat = random() % 2 ? power(random, -9, 0) : 1;
  const double away = random() % 2 ? scale * power(random, 0, 10) : 0;
  for (Point& p : s.points) p = Point(scale * p.x() + away, scale * p.y() - away, scale * flat * p.z() + away);
}

/// A second copy that overlaps, touches, equals or lies inside the first; perhaps inside out.
inline void add_copy(Surface& s, Random& random)
{
  Surface copy = s;
  const double side = longest_side(s);
  switch (below(random, 4)) {
  case 0:
    break;
  case 1:
    copy = surfaces::moved(std::move(copy), 1, side, 0, 0);
    break;
  case 2:
    copy = surfaces::moved(std::move(copy), 1, power(random, -15, 0.1) * side, 0, 0);
    break;
  default: {
    const Point c = CGAL::centroid(s.points.begin(), s.points.end());
    const double scale = 1 - power(random, -12, 0);
    copy = surfaces::moved(std::move(copy), scale, (1 - scale) * c.x(), (1 - scale) * c.y(), (1 - scale) * c.z());
  }
  }
  if (random() % 2) copy = surfaces::inside_out(std::move(copy));
  s = surfaces::together(std::move(s), copy);
}

/// Splits edges' facets with points on an edge or within a facet, as near to it as rounding lets them be: collinear
/// edges, coplanar facets, slivers.
inline void split_facets(Surface& s, Random& random)
{
  for (std::size_t i = 1 + below(random, 20); i > 0; --i) {
    const std::size_t at = below(random, s.triangles.size()), n = s.points.size();
    const auto [a, b, c] = s.triangles[at];
    const double u = random() % 2 ? power(random, -12, -0.5) : 0.3, v = random() % 2 ? power(random, -12, -0.5) : 0.3;
    s.points.push_back(CGAL::barycenter(s.points[a], u, s.points[b], v, s.points[c], 1 - u - v));
    s.triangles[at] = {a, b, n};
    s.triangles.push_back({b, c, n});
    s.triangles.push_back({c, a, n});
  }
}

/// Facets twice, points twice, points that no facet has.
inline void repeat(Surface& s, Random& random)
{
  for (std::size_t i = 1 + below(random, 5); i > 0; --i) {
    Triangle t = s.triangles[below(random, s.triangles.size())];
    s.points.push_back(s.points[t[0]]);
    if (random() % 2) t[0] = s.points.size() - 1;
    if (random() % 3) s.triangles.push_back(t);
  }
}

constexpr int kinds_of_mutations = 10;

inline void mutate(Surface& s, int kind, Random& random)
{
  using Mutation = void (*)(Surface&, Random&);
  constexpr Mutation mutations[kinds_of_mutations] = {
      punch_holes,       flip_facets, merge_vertices, add_noise,    move_one_vertex,
      round_coordinates, distort,     add_copy,       split_facets, repeat};
  mutations[kind](s, random);
}

// ---- What is damaged

/// One of the tests' simple shapes.
inline Surface simple_shape(Random& random)
{
  // Drawn beforehand: the order in which arguments are evaluated isn't the same everywhere.
  const std::size_t shape = below(random, 11), n = below(random, 30), m = below(random, 10);
  const double x = uniform(random, 0, 1);
  switch (shape) {
  case 0:
    return surfaces::tetrahedron();
  case 1:
    return surfaces::box(1 + int(n % 3), 1 + int(m % 3), 1);
  case 2:
    return surfaces::l_shape();
  case 3:
    return surfaces::cube_with_hole();
  case 4:
    return surfaces::needle_cube(std::pow(10.0, -1 - 8 * x));
  case 5:
    return surfaces::wedge(std::pow(10.0, 3 * x - 1));
  case 6:
    return surfaces::sphere(1 + int(n % 3));
  case 7:
    return surfaces::nested_spheres({0.1 + 0.89 * x}, 2);
  case 8:
    return surfaces::torus(5 + n, 5 + m, 0.02 + 0.88 * x);
  case 9:
    return surfaces::cylinder(3 + n);
  default:
    return surfaces::cone(3 + n, std::pow(10.0, 3.5 * x - 2));
  }
}

} // namespace corpus

#endif // WEFT_BENCHMARK_CORPUS_CORPUS_MUTATIONS_H
