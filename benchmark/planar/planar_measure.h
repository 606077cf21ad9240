// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures planar meshes and the time they take. It shares nothing with weft's own statistics, and any mesher's mesh
// goes through it in the same way: as plain arrays of points and triangles.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_MEASURE_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_MEASURE_H

#include "../common/user_time.h"

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace benchmark {

inline double median(std::vector<double> values)
{
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

using Xy = std::array<double, 2>;

inline double length(const Xy& a, const Xy& b)
{
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

inline Xy middle(const Xy& a, const Xy& b)
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

inline double signed_area(const Xy& a, const Xy& b, const Xy& c)
{
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
}

/// Degrees at corner o between directions to p and q, in [0, 180].
inline double angle(const Xy& o, const Xy& p, const Xy& q)
{
  const double ux = p[0] - o[0], uy = p[1] - o[1], vx = q[0] - o[0], vy = q[1] - o[1];
  return std::atan2(std::abs(ux * vy - uy * vx), ux * vx + uy * vy) * (180 / std::acos(-1.));
}

/// A mesh as arrays. `constrained[t][i]`: whether the edge opposite corner i of triangle t is part of a constraint.
struct Flat_mesh
{
  std::vector<Xy> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<bool, 3>> constrained;
};

/// The triangles in the domain of a CGAL triangulation, with their vertices.
template <class Cdt>
Flat_mesh flat_mesh(const Cdt& cdt)
{
  Flat_mesh mesh;
  std::unordered_map<const void*, int> index;
  index.reserve(cdt.number_of_vertices());
  for (const auto f : cdt.finite_face_handles()) {
    if (!f->is_in_domain()) continue;
    std::array<int, 3> triangle;
    for (int i = 0; i < 3; ++i) {
      const auto v = f->vertex(i);
      const auto found = index.emplace(&*v, static_cast<int>(mesh.points.size()));
      if (found.second) mesh.points.push_back({CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y())});
      triangle[i] = found.first->second;
    }
    mesh.triangles.push_back(triangle);
    mesh.constrained.push_back({f->is_constrained(0), f->is_constrained(1), f->is_constrained(2)});
  }
  return mesh;
}

struct Measures
{
  std::size_t vertices = 0, triangles = 0;
  double smallest_angle = 180, largest_angle = 0; ///< degrees
  double largest_ratio = 0;                       ///< longest edge over size at the centroid, over triangles
  double largest_edge_ratio = 0;                  ///< length over size at the midpoint, over constrained edges
  std::size_t oversize = 0;                       ///< triangles whose ratio exceeds 1
  std::size_t oversize_edges = 0;                 ///< constrained edges whose ratio exceeds 1
  std::size_t inverted = 0;                       ///< triangles without positive area
  std::size_t non_delaunay = 0; ///< edges between two triangles, not constrained, that break the Delaunay property
  double area = 0;              ///< of all triangles
  double constraint_length = 0; ///< of all constrained edges, once each
  double ideal_triangles = 0;   ///< equilateral triangles with the asked edge length that would fill the area

  double relative_count() const { return static_cast<double>(triangles) / ideal_triangles; }
};

/// \param size callable, (x, y) -> largest edge length.
template <class Size>
Measures measure(const Flat_mesh& mesh, const Size& size)
{
  constexpr double rounding = 1e-9;
  struct Edge
  {
    std::uint64_t ends;
    double angle; // opposite
    bool constrained;
  };
  Measures m;
  m.vertices = mesh.points.size();
  m.triangles = mesh.triangles.size();
  std::vector<Edge> edges;
  edges.reserve(3 * m.triangles);
  for (std::size_t t = 0; t < m.triangles; ++t) {
    const auto& v = mesh.triangles[t];
    const std::array<Xy, 3> p{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
    const double area = signed_area(p[0], p[1], p[2]);
    m.inverted += !(area > 0);
    m.area += std::abs(area);
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double degrees = angle(p[i], p[j], p[k]);
      m.smallest_angle = std::min(m.smallest_angle, degrees);
      m.largest_angle = std::max(m.largest_angle, degrees);
      longest = std::max(longest, length(p[j], p[k]));
      const Xy half = middle(p[j], p[k]);
      const double s = size(half[0], half[1]);
      m.ideal_triangles += std::abs(area) / 3 / (std::sqrt(3.) / 4 * s * s);
      const auto a = static_cast<std::uint64_t>(std::min(v[j], v[k])),
                 b = static_cast<std::uint64_t>(std::max(v[j], v[k]));
      edges.push_back({a << 32 | b, degrees, mesh.constrained[t][i]});
    }
    const double ratio = longest / size((p[0][0] + p[1][0] + p[2][0]) / 3, (p[0][1] + p[1][1] + p[2][1]) / 3);
    m.largest_ratio = std::max(m.largest_ratio, ratio);
    m.oversize += ratio > 1 + rounding;
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  for (std::size_t i = 0, next; i < edges.size(); i = next) {
    double sum = 0;
    for (next = i; next < edges.size() && edges[next].ends == edges[i].ends; ++next) sum += edges[next].angle;
    if (edges[i].constrained) {
      const Xy &a = mesh.points[edges[i].ends >> 32], &b = mesh.points[edges[i].ends & 0xffffffffu],
               half = middle(a, b);
      const double ratio = length(a, b) / size(half[0], half[1]);
      m.constraint_length += length(a, b);
      m.largest_edge_ratio = std::max(m.largest_edge_ratio, ratio);
      m.oversize_edges += ratio > 1 + rounding;
    } else if (next - i > 1) {
      m.non_delaunay += sum > 180 + 1e-6;
    }
  }
  return m;
}

/// Smallest angle inside of the domain between two constraints that meet, in degrees; 360 if none do.
template <class Cdt>
double smallest_input_angle(const Cdt& cdt)
{
  double smallest = 360;
  const auto xy = [](const auto& p) { return Xy{CGAL::to_double(p.x()), CGAL::to_double(p.y())}; };
  for (const auto v : cdt.finite_vertex_handles()) {
    // Walks counterclockwise once around to the first constraint, then once more to sum angles between constraints.
    auto face = cdt.incident_faces(v), start = face;
    const auto opens_constraint = [&](auto f) { return f->is_constrained(Cdt::cw(f->index(v))); };
    while (!opens_constraint(face))
      if (++face == start) break;
    if (!opens_constraint(face)) continue;
    start = face;
    double sum = 0;
    do {
      if (opens_constraint(face)) sum = 0;
      const int i = face->index(v);
      if (cdt.is_infinite(face) || !face->is_in_domain()) {
        sum = 360;
      } else {
        sum += angle(xy(v->point()), xy(face->vertex(Cdt::ccw(i))->point()), xy(face->vertex(Cdt::cw(i))->point()));
        if (face->is_constrained(Cdt::ccw(i))) smallest = std::min(smallest, sum);
      }
    } while (++face != start);
  }
  return smallest;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_MEASURE_H
