// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checks of surfaces that are weft's own, because CGAL's Polygon_mesh_processing takes long to compile, agree with
// it: which facets intersect, how shells are nested and which way they look. The surfaces are random, from fixed seeds.
// Many have coordinates on a small grid, so that facets touch in vertices and edges and lie in common planes.

#include "fixtures/surface_fixtures.h"

#include <weft/spatial/surface/check_surface_topology_3.h>
#include <weft/spatial/surface/check_surface_volume_3.h>

#include <catch2/catch.hpp>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace surfaces;
namespace PMP = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<Point>;
using Checked_surface = weft::internal::Triangle_surface_3<K>;
using Topology = weft::internal::Surface_topology_3;
using Triangles = std::vector<std::size_t>;
using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

/// Face t is triangle t. The surface has to be manifold.
Mesh mesh_of(const Surface& s)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (const Point& p : s.points) vertices.push_back(mesh.add_vertex(p));
  for (const auto& [a, b, c] : s.triangles)
    REQUIRE(mesh.add_face(vertices[a], vertices[b], vertices[c]) != Mesh::null_face());
  return mesh;
}

Mesh::Face_index face(std::size_t triangle)
{
  return Mesh::Face_index(static_cast<Mesh::size_type>(triangle));
}

/// Some triangles of a surface, with the points that they have.
Surface part(const Surface& s, const Triangles& triangles)
{
  Surface result;
  std::map<std::size_t, std::size_t> number;
  for (const std::size_t t : triangles) {
    Triangle triangle = s.triangles[t];
    for (std::size_t& v : triangle) {
      const auto [place, is_new] = number.emplace(v, result.points.size());
      if (is_new) result.points.push_back(s.points[v]);
      v = place->second;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

Checked_surface checked(const Surface& s)
{
  return {s.points, s.triangles, {}};
}

bool has_degenerate_facet(const Surface& s)
{
  for (const auto& [a, b, c] : s.triangles)
    if (CGAL::collinear(s.points[a], s.points[b], s.points[c])) return true;
  return false;
}

// ---- Self-intersections

Pairs intersections_by_cgal(const Surface& s)
{
  const Mesh mesh = mesh_of(s);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  PMP::self_intersections(mesh, std::back_inserter(found));
  Pairs pairs;
  for (const auto& [a, b] : found) pairs.insert(std::minmax(std::size_t(a), std::size_t(b)));
  return pairs;
}

Pairs intersections_by_weft(const Surface& s)
{
  Pairs pairs;
  for (const auto& [a, b] :
       weft::internal::intersecting_triangles(checked(s), weft::internal::sorted_sides(s.triangles)))
    pairs.insert(std::minmax(a, b));
  return pairs;
}

/// How many surfaces had intersections, and how many had none.
struct Seen
{
  int intersecting = 0, embedded = 0;
};

void compare_intersections(const Surface& s, Seen& seen)
{
  const Pairs expected = intersections_by_cgal(s);
  REQUIRE(intersections_by_weft(s) == expected);
  const Topology topology = weft::internal::check_surface_topology(checked(s));
  if (expected.empty()) {
    ++seen.embedded;
    CHECK_NOTHROW(weft::internal::check_self_intersections(checked(s), topology.sides));
  } else {
    ++seen.intersecting;
    CHECK_THROWS_AS(weft::internal::check_self_intersections(checked(s), topology.sides), weft::Domain_error);
  }
}

// ---- Nested shells

using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

bool one_in(Random& random, unsigned n)
{
  return random() % n == 0;
}

/// A sphere whose vertices are at 0.8 to 1 of its radius.
Surface rough_sphere(Random& random)
{
  Surface s = sphere(1);
  for (Point& p : s.points) p = CGAL::ORIGIN + uniform(random, 0.8, 1) * (p - CGAL::ORIGIN);
  return s;
}

/// Adds a shell in the ball of that centre and radius, either way round, and others in it or, where it is a torus, in
/// its hole.
void add_shells(Random& random, const Point& center, double radius, int depth, Surface& result)
{
  const auto add = [&](const Surface& shell, double scale) {
    const Surface placed = moved(shell, scale, center.x(), center.y(), center.z());
    result = together(std::move(result), one_in(random, 2) ? placed : inside_out(placed));
  };
  const auto add_inner = [&](double along, std::size_t axis, double part) {
    if (depth == 0 || one_in(random, 4)) return;
    std::array<double, 3> at{center.x(), center.y(), center.z()};
    at[axis] += along * radius;
    add_shells(random, Point(at[0], at[1], at[2]), part * radius, depth - 1, result);
  };
  const std::size_t axis = random() % 3;
  switch (random() % 3) {
  case 0: // faces and inner shells along the axes: rays run through edges and vertices
    add(moved(cube(), 1, -0.5, -0.5, -0.5), radius);
    add_inner(-0.25, axis, 0.1875);
    add_inner(0.25, axis, 0.1875);
    break;
  case 1:
    add(rough_sphere(random), radius);
    add_inner(-0.3, axis, 0.25);
    add_inner(0.3, axis, 0.25);
    break;
  default:
    add(torus(12, 6), radius / 1.4);
    add_inner(0, axis, 0.25);
    add_inner(1 / 1.4, 0, 0.15); // in the tube
  }
}

/// A few of those beside each other.
Surface nested_shells(Random& random)
{
  Surface result;
  const int outermost = 1 + static_cast<int>(random() % 2);
  for (int i = 0; i < outermost; ++i) add_shells(random, Point(3 * i, 0, 0), 1, 3, result);
  return result;
}

} // namespace

TEST_CASE("facets of rough surfaces intersect where CGAL says so")
{
  Random random(1);
  Seen seen;
  for (const Surface& smooth : {sphere(2), torus(12, 8), voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}})})
    for (int k = 0; k < 25; ++k) {
      CAPTURE(k);
      const double roughness = 0.016 * k;
      Surface s = smooth;
      for (Point& p : s.points)
        p = Point(p.x() + uniform(random, -roughness, roughness), p.y() + uniform(random, -roughness, roughness),
                  p.z() + uniform(random, -roughness, roughness));
      compare_intersections(s, seen);
    }
  CHECK(seen.intersecting > 20);
  CHECK(seen.embedded > 20);
}

TEST_CASE("facets with coordinates on a small grid intersect or touch where CGAL says so")
{
  Random random(2);
  Seen seen;
  const auto coordinate = [&](int n) { return static_cast<double>(random() % static_cast<unsigned>(n)); };
  SECTION("tetrahedra that lie anywhere")
  {
    for (int k = 0; k < 600; ++k) {
      CAPTURE(k);
      Surface s;
      const std::size_t count = 2 + random() % 3;
      for (std::size_t i = 0; i < count; ++i) {
        Surface one = tetrahedron();
        do
          for (Point& p : one.points) p = Point(coordinate(5), coordinate(5), coordinate(5));
        while (CGAL::coplanar(one.points[0], one.points[1], one.points[2], one.points[3]));
        s = together(std::move(s), one);
      }
      compare_intersections(s, seen);
    }
    CHECK(seen.embedded > 20);
  }
  SECTION("surfaces with folds, creases and flat parts")
  {
    for (int k = 0; k < 300; ++k) {
      CAPTURE(k);
      Surface s = k % 2 ? sphere(0) : cube();
      do
        for (Point& p : s.points) p = Point(coordinate(6), coordinate(6), coordinate(6));
      while (has_degenerate_facet(s));
      compare_intersections(s, seen);
    }
  }
  SECTION("cubes that touch, or not")
  {
    for (int k = 0; k < 300; ++k) {
      CAPTURE(k);
      const double size = 1 + coordinate(3);
      compare_intersections(together(moved(cube(), 2, 0, 0, 0),
                                     moved(cube(), size, coordinate(7) - 3, coordinate(7) - 3, coordinate(7) - 3)),
                            seen);
    }
    CHECK(seen.embedded > 20);
  }
  CHECK(seen.intersecting > 100);
}

TEST_CASE("shells look outwards, are turned, and are as deep in others as CGAL says")
{
  Random random(3);
  std::set<std::size_t> depths_seen;
  int turned = 0;
  for (int k = 0; k < 30; ++k) {
    CAPTURE(k);
    const Surface s = nested_shells(random);
    Checked_surface surface = checked(s);
    const Topology topology = weft::internal::check_surface_topology(surface);
    std::vector<Triangles> shells(static_cast<std::size_t>(topology.number_of_shells));
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
      shells[static_cast<std::size_t>(topology.shells[t])].push_back(t);
    const std::vector<int> depths = weft::internal::nesting_depths(surface, shells);
    for (const Triangles& shell : shells)
      REQUIRE(weft::internal::looks_outwards(surface, shell) == PMP::is_outward_oriented(mesh_of(part(s, shell))));

    turned += !weft::internal::check_surface_volume(surface, topology).empty();
    Mesh turned_by_cgal = mesh_of(s);
    PMP::orient_to_bound_a_volume(turned_by_cgal);
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      const auto halfedge = turned_by_cgal.halfedge(face(t));
      const auto [a, b, c] = surface.triangles[t];
      const std::size_t from = turned_by_cgal.source(halfedge), to = turned_by_cgal.target(halfedge);
      REQUIRE(((from == a && to == b) || (from == b && to == c) || (from == c && to == a)));
    }

    // Of shells that look the wrong way CGAL 5.5 can't say how deep they are.
    Mesh mesh = mesh_of({surface.points, surface.triangles});
    REQUIRE(PMP::does_bound_a_volume(mesh));
    const auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component").first;
    const auto volume = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:volume").first;
    std::vector<std::size_t> levels;
    PMP::volume_connected_components(
        mesh, volume, CGAL::parameters::face_connected_component_map(component).nesting_levels(std::ref(levels)));
    REQUIRE(levels.size() == shells.size());
    for (std::size_t i = 0; i < shells.size(); ++i) {
      const std::size_t level = levels[component[face(shells[i][0])]];
      REQUIRE(static_cast<std::size_t>(depths[i]) == level);
      depths_seen.insert(level);
    }
  }
  CHECK(depths_seen.count(3) == 1);
  CHECK(turned > 10);
}
