// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed triangle surfaces for tests, oriented outwards, and what can be done to them.

#ifndef WEFT_TEST_SURFACE_FIXTURES_H
#define WEFT_TEST_SURFACE_FIXTURES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace surfaces {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_3;
using Triangle = std::array<std::size_t, 3>;

struct Surface
{
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

inline const double pi = std::acos(-1.0);

// ---- What can be done to a surface

/// Six times the volume is the sum of determinants, taken from the first point: no cancellation far from the origin.
inline double volume(const std::vector<Point>& points, const std::vector<Triangle>& triangles)
{
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += CGAL::determinant(points[a] - points[0], points[b] - points[0], points[c] - points[0]) / 6;
  return sum;
}
inline double volume(const Surface& s)
{
  return volume(s.points, s.triangles);
}

inline Surface inside_out(Surface s)
{
  for (auto& t : s.triangles) std::swap(t[1], t[2]);
  return s;
}

/// Both surfaces, the points and triangles of the second behind those of the first.
inline Surface together(Surface a, const Surface& b)
{
  const std::size_t shift = a.points.size();
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

/// Every point scaled about the origin, then moved.
inline Surface moved(Surface s, double scale, double dx, double dy, double dz)
{
  for (Point& p : s.points) p = Point(scale * p.x() + dx, scale * p.y() + dy, scale * p.z() + dz);
  return s;
}

// ---- Surfaces with plane faces

inline Surface tetrahedron()
{
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

using Voxel = std::array<int, 3>;

/// The boundary of a union of unit cubes [x, x + 1] x ...; each square is cut in two. Where cubes meet in an edge or
/// vertex only, the surface isn't manifold.
inline Surface voxels(const std::set<Voxel>& cubes)
{
  Surface s;
  std::map<Voxel, std::size_t> number;
  const auto vertex = [&](const Voxel& at) {
    const auto [place, is_new] = number.emplace(at, s.points.size());
    if (is_new) s.points.emplace_back(at[0], at[1], at[2]);
    return place->second;
  };
  for (const Voxel& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        Voxel beyond = cube;
        beyond[axis] += side ? 1 : -1;
        if (cubes.count(beyond)) continue;
        const std::size_t u = (axis + (side ? 1 : 2)) % 3, v = (axis + (side ? 2 : 1)) % 3; // u x v points outwards
        Voxel a = cube;
        a[axis] += side;
        Voxel b = a, c = a, d = a;
        ++b[u], ++c[u], ++c[v], ++d[v];
        s.triangles.push_back({vertex(a), vertex(b), vertex(c)});
        s.triangles.push_back({vertex(a), vertex(c), vertex(d)});
      }
  return s;
}

/// The box [0, nx] x [0, ny] x [0, nz]; its faces are cut into unit squares, many facets to a plane.
inline Surface box(int nx, int ny, int nz)
{
  std::set<Voxel> cubes;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) cubes.insert({x, y, z});
  return voxels(cubes);
}

/// The unit cube of twelve triangles.
inline Surface cube()
{
  return box(1, 1, 1);
}

/// Three cubes in the shape of an L: a reentrant edge.
inline Surface l_shape()
{
  return voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

/// A cube of 3 x 3 x 1 with a square hole through it.
inline Surface cube_with_hole()
{
  std::set<Voxel> cubes;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1) cubes.insert({x, y, 0});
  return voxels(cubes);
}

/// Unit cubes that touch in a vertex (1 common coordinate step in all axes), along an edge (in two) or in a face (in
/// one); `welded`: with common points.
inline Surface touching_cubes(int dx, int dy, int dz, bool welded)
{
  return welded ? voxels({{0, 0, 0}, {dx, dy, dz}}) : together(cube(), moved(cube(), 1, dx, dy, dz));
}

/// The unit cube with a slab of thickness `width` cut off by a row of needle triangles of aspect 1 / width.
inline Surface needle_cube(double width = 1e-6)
{
  Surface s = box(2, 1, 1);
  for (Point& p : s.points) p = Point(p.x() == 1 ? width : p.x() / 2, p.y(), p.z());
  return s;
}

/// A prism of height 1 whose edge on the z axis has the given dihedral angle in degrees, sides of length 1.
inline Surface wedge(double degrees)
{
  const double x = std::cos(degrees * pi / 180), y = std::sin(degrees * pi / 180);
  return {{{0, 0, 0}, {1, 0, 0}, {x, y, 0}, {0, 0, 1}, {1, 0, 1}, {x, y, 1}},
          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

// ---- Curved surfaces

/// The unit sphere: an icosahedron whose triangles are cut into four `levels` times.
inline Surface sphere(int levels)
{
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<std::array<double, 3>> p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Triangle> t = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middle;
    const auto between = [&](std::size_t a, std::size_t b) {
      const auto [place, is_new] = middle.emplace(std::minmax(a, b), p.size());
      if (is_new) p.push_back({p[a][0] + p[b][0], p[a][1] + p[b][1], p[a][2] + p[b][2]});
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : t) {
      const std::size_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
    for (auto& q : p) {
      const double r = std::hypot(q[0], q[1], q[2]);
      for (double& x : q) x /= r;
    }
  }
  Surface s{{}, std::move(t)};
  for (const auto& q : p) {
    const double r = std::hypot(q[0], q[1], q[2]);
    s.points.emplace_back(q[0] / r, q[1] / r, q[2] / r);
  }
  return s;
}

/// Concentric spheres, the first of radius 1; every second one bounds a cavity.
inline Surface nested_spheres(const std::vector<double>& inner_radii, int levels)
{
  Surface s = sphere(levels);
  for (std::size_t i = 0; i < inner_radii.size(); ++i) {
    const Surface inner = moved(sphere(levels), inner_radii[i], 0, 0, 0);
    s = together(std::move(s), i % 2 == 0 ? inside_out(inner) : inner);
  }
  return s;
}

/// A torus around the z axis of radii 1 and r, n by m quadrangles cut in two.
inline Surface torus(std::size_t n, std::size_t m, double r = 0.4)
{
  Surface s;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const double u = 2 * pi * double(i) / double(n), v = 2 * pi * double(j) / double(m);
      s.points.emplace_back((1 + r * std::cos(v)) * std::cos(u), (1 + r * std::cos(v)) * std::sin(u), r * std::sin(v));
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const std::size_t i1 = (i + 1) % n, j1 = (j + 1) % m;
      s.triangles.push_back({i * m + j, i1 * m + j, i1 * m + j1});
      s.triangles.push_back({i * m + j, i1 * m + j1, i * m + j1});
    }
  return s;
}

/// A cylinder around the z axis of radius 1 and height 1 with n sides: two sharp rims, two flat caps.
inline Surface cylinder(std::size_t n)
{
  Surface s;
  for (const double z : {0., 1.})
    for (std::size_t i = 0; i < n; ++i)
      s.points.emplace_back(std::cos(2 * pi * double(i) / double(n)), std::sin(2 * pi * double(i) / double(n)), z);
  s.points.emplace_back(0, 0, 0);
  s.points.emplace_back(0, 0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    s.triangles.insert(s.triangles.end(), {{i, j, n + j}, {i, n + j, n + i}, {2 * n, j, i}, {2 * n + 1, n + i, n + j}});
  }
  return s;
}

/// A cone around the z axis with n sides: one sharp rim, and a tip that nobody can find by angles.
inline Surface cone(std::size_t n, double height)
{
  Surface s;
  for (std::size_t i = 0; i < n; ++i)
    s.points.emplace_back(std::cos(2 * pi * double(i) / double(n)), std::sin(2 * pi * double(i) / double(n)), 0);
  s.points.emplace_back(0, 0, 0);
  s.points.emplace_back(0, 0, height);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    s.triangles.insert(s.triangles.end(), {{n, j, i}, {n + 1, i, j}});
  }
  return s;
}

} // namespace surfaces

#endif // WEFT_TEST_SURFACE_FIXTURES_H
