// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small tetrahedral meshes for tests, made of Delaunay triangulations without weft's mesher.

#ifndef WEFT_TEST_SPATIAL_FIXTURES_H
#define WEFT_TEST_SPATIAL_FIXTURES_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/restricted/Mesh_triangulation_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace fixtures {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_3;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using Triangulation = weft::Mesh_triangulation_3<K>;
using Location = weft::Vertex_location_3;

/// A mesh and the triangulation that holds its cells.
struct Triangulated
{
  Triangulation triangulation;
  Mesh mesh;
};

/// Fills in vertices and cells; `subdomain(cell)` is 0 outside. Vertices keep the locations of the triangulation.
template <class Subdomain>
std::map<Triangulation::Vertex_handle, std::size_t> add_cells(Triangulated& result, const Subdomain& subdomain)
{
  std::map<Triangulation::Vertex_handle, std::size_t> number;
  std::map<Point, Triangulation::Vertex_handle> in_order; // handles are ordered by address, points aren't
  const auto& t = result.triangulation;
  for (const auto cell : t.finite_cell_handles())
    for (int i = 0; i < 4 && subdomain(cell) > 0; ++i) in_order.emplace(cell->vertex(i)->point(), cell->vertex(i));
  for (const auto& [point, vertex] : in_order) {
    number[vertex] = result.mesh.points.size();
    result.mesh.points.push_back(point);
    result.mesh.locations.push_back(vertex->location());
  }
  for (const auto cell : t.finite_cell_handles()) {
    if (subdomain(cell) == 0) continue;
    std::array<std::size_t, 4> vertices{};
    for (int i = 0; i < 4; ++i) vertices[static_cast<std::size_t>(i)] = number.at(cell->vertex(i));
    result.mesh.cells.push_back(vertices);
    result.mesh.subdomains.push_back(subdomain(cell));
  }
  return number;
}

/// Adds the facets around and between subdomains, seen from outside, or from the subdomain of the larger number;
/// `patch(a, b, c)`.
template <class Subdomain, class Patch>
void add_facets(Triangulated& result, const std::map<Triangulation::Vertex_handle, std::size_t>& number,
                const Subdomain& subdomain, const Patch& patch)
{
  const auto& t = result.triangulation;
  for (const auto cell : t.finite_cell_handles())
    for (int i = 0; i < 4; ++i) {
      const auto neighbor = cell->neighbor(i);
      const int here = subdomain(cell), there = t.is_infinite(neighbor) ? 0 : subdomain(neighbor);
      if (here == there || here == 0 || (there != 0 && there < here)) continue;
      std::array<std::size_t, 3> f{};
      for (int k = 0; k < 3; ++k) // backwards: CGAL's triples are counterclockwise seen from inside the cell
        f[static_cast<std::size_t>(2 - k)] = number.at(cell->vertex(Triangulation::vertex_triple_index(i, k)));
      result.mesh.facets.push_back(f);
      result.mesh.patches.push_back(
          patch(result.mesh.points[f[0]], result.mesh.points[f[1]], result.mesh.points[f[2]]));
    }
}

/// A ball of radius 1 with vertices at random on the sphere and inside: one patch, no creases, many slivers.
inline Triangulated ball(std::size_t on_sphere, std::size_t inside, unsigned seed = 1)
{
  std::mt19937 random(seed);
  const auto coordinate = [&random] { return static_cast<double>(random()) / 2147483648. - 1; };
  Triangulated result;
  const auto insert = [&](const Point& p, Location location) {
    result.triangulation.insert(p)->set_location(location);
  };
  while (on_sphere + inside > 0) {
    const double x = coordinate(), y = coordinate(), z = coordinate(), r = std::sqrt(x * x + y * y + z * z);
    if (r > 1 || r < 0.1) continue;
    if (on_sphere > 0)
      insert(Point(x / r, y / r, z / r), {2, 0}), --on_sphere;
    else
      insert(Point(0.9 * x, 0.9 * y, 0.9 * z), {3, 1}), --inside;
  }
  const auto one = [](auto) { return 1; };
  const auto number = add_cells(result, one);
  add_facets(result, number, one, [](auto...) { return 0; });
  return result;
}

/// Number of a face of the box [0, n]^3 (0 to 5: x = 0, x = n, y = 0, ...) or of the interface x = n / 2 (6).
inline int box_patch(const Point& a, const Point& b, const Point& c, double n)
{
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      if (a[axis] == side * n && b[axis] == side * n && c[axis] == side * n) return 2 * axis + side;
  return 6;
}

/// Number of an edge of the box, from 0 to 11, or -1: by the two axes on whose sides the points lie.
inline int box_crease(const std::vector<Point>& points, double n)
{
  int number = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int s = 0; s < 4; ++s, ++number) {
      const double u = (s & 1) * n, v = (s >> 1) * n;
      if (std::all_of(points.begin(), points.end(),
                      [&](const Point& p) { return p[(axis + 1) % 3] == u && p[(axis + 2) % 3] == v; }))
        return number;
    }
  return -1;
}

inline Location box_location(const Point& p, int n, bool two_subdomains)
{
  int corner = 0, sides = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sides += p[axis] == 0 || p[axis] == n;
    corner = 2 * corner + (p[axis] == n);
  }
  if (sides == 3) return {0, corner};
  if (sides == 2) return {1, box_crease({p}, n)};
  if (sides == 1) return {2, box_patch(p, p, p, n)};
  if (two_subdomains && 2 * p.x() == n) return {2, 6};
  return {3, two_subdomains && 2 * p.x() > n ? 2 : 1};
}

/// The cube [0, n]^3 with vertices at all integer points, each unit cube cospherical, within a larger box of eight
/// points; six patches, twelve creases, eight corners. Two subdomains: an even n, meeting at x = n / 2 in patch 6,
/// whose rim isn't a crease.
inline Triangulated box(int n, bool two_subdomains = false)
{
  Triangulated result;
  for (int i = 0; i < 8; ++i) // locations stay { -1, 0 }
    result.triangulation.insert(Point((i & 1) ? 5 * n : -4 * n, (i & 2) ? 5 * n : -4 * n, (i & 4) ? 5 * n : -4 * n));
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      for (int z = 0; z <= n; ++z) {
        const Point p(x, y, z);
        result.triangulation.insert(p)->set_location(box_location(p, n, two_subdomains));
      }
  const auto subdomain = [&](Triangulation::Cell_handle cell) {
    double x = 0;
    for (int i = 0; i < 4; ++i) {
      if (cell->vertex(i)->location().dimension < 0) return 0;
      x += cell->vertex(i)->point().x() / 4;
    }
    return two_subdomains && 2 * x > n ? 2 : 1;
  };
  const auto number = add_cells(result, subdomain);
  add_facets(result, number, subdomain,
             [n](const Point& a, const Point& b, const Point& c) { return box_patch(a, b, c, n); });
  auto& mesh = result.mesh;
  for (auto edge = result.triangulation.finite_edges_begin(); edge != result.triangulation.finite_edges_end(); ++edge) {
    const auto v = edge->first->vertex(edge->second), w = edge->first->vertex(edge->third);
    if (v->location().dimension < 0 || w->location().dimension < 0) continue;
    const int crease = box_crease({v->point(), w->point()}, n);
    if (crease < 0) continue;
    mesh.edges.push_back({number.at(v), number.at(w)});
    mesh.creases.push_back(crease);
  }
  for (int corner = 0; corner < 8; ++corner)
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (mesh.locations[v] == Location{0, corner}) mesh.corners.push_back(v);
  return result;
}

/// One cell with these corners, all of them feature vertices, all facets on patches of their own.
inline Mesh single_cell(const Point& a, const Point& b, const Point& c, const Point& d)
{
  Mesh mesh;
  mesh.points = {a, b, c, d};
  for (int i = 0; i < 4; ++i) mesh.locations.push_back({0, i});
  mesh.cells = {{0, 1, 2, 3}};
  mesh.subdomains = {1};
  mesh.facets = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  mesh.patches = {0, 1, 2, 3};
  mesh.edges = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  mesh.creases = {0, 1, 2, 3, 4, 5};
  mesh.corners = {0, 1, 2, 3};
  return mesh;
}

} // namespace fixtures

#endif // WEFT_TEST_SPATIAL_FIXTURES_H
