// SPDX-License-Identifier: GPL-3.0-or-later
//
// check_domain_3(): a mesh of the whole domain is found whole, and whatever is taken out of one is missed.

#include "fixtures/meshing_3.h"
#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/spatial/domain/check_domain_3.h>
#include <weft/spatial/mesh/assemble_mesh_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace meshing;
using namespace surfaces;

constexpr double approximation = 0.01;

Mesh refined(const Oracle& oracle, double size)
{
  return weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria_of(size, approximation), refinement()).restricted);
}

/// The mesh without some cells: of facets and crease edges those stay whose cell does, and nothing new is listed.
template <class Is_lost>
Mesh without(const Mesh& mesh, const Is_lost& is_lost)
{
  Mesh rest = mesh;
  rest.cells.clear(), rest.subdomains.clear(), rest.facets.clear(), rest.patches.clear();
  std::vector<char> is_used(mesh.points.size(), false);
  std::set<std::array<std::size_t, 3>> sides;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& v = mesh.cells[c];
    if (is_lost(CGAL::centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]))) continue;
    rest.cells.push_back(v);
    rest.subdomains.push_back(mesh.subdomains[c]);
    for (std::size_t i = 0; i < 4; ++i)
      sides.insert(weft::internal::sorted<3>({v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]}));
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (sides.count(weft::internal::sorted(mesh.facets[f])) == 0) continue;
    rest.facets.push_back(mesh.facets[f]);
    rest.patches.push_back(mesh.patches[f]);
  }
  return rest;
}

} // namespace

TEST_CASE("a mesh of the whole domain is found whole, with the topology that shapes have")
{
  struct Case
  {
    Surface surface;
    long components, euler;
  };
  for (const Case& c : {Case{cube(), 1, 2}, Case{torus(32, 16), 1, 0}, Case{nested_spheres({0.5}, 3), 2, 4},
                        Case{cylinder(24), 1, 2}}) {
    const Oracle oracle = oracle_of(c.surface);
    const Mesh mesh = refined(oracle, 0.3);
    const auto found = weft::check_domain_3(mesh, oracle, approximation);
    INFO(found);
    CHECK(found.ok());
    CHECK(found.samples > 100);
    REQUIRE(found.subdomains.size() == 1);
    CHECK(found.subdomains[0].expected_components == c.components);
    CHECK(found.subdomains[0].expected_euler == c.euler);
    CHECK(found.subdomains[0].expected_volume == Approx(volume(c.surface)));
    CHECK(found.subdomains[0].volume == Approx(volume_of_cells(mesh)));
  }
}

TEST_CASE("cells that are missing are missed: their boundary, their volume, or the topology")
{
  const Surface surface = torus(48, 24);
  const Oracle oracle = oracle_of(surface);
  const Mesh mesh = refined(oracle, 0.3);
  REQUIRE(weft::check_domain_3(mesh, oracle, approximation).ok());
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    // A piece of the ring, at a random place.
    const double angle = 2 * pi * static_cast<double>(random()) / 4294967296.0;
    const Mesh rest =
        without(mesh, [&](const Point& p) { return std::cos(std::atan2(p.y(), p.x()) - angle) > std::cos(0.4); });
    REQUIRE(rest.cells.size() < mesh.cells.size());
    const auto found = weft::check_domain_3(rest, oracle, approximation);
    INFO(found);
    CHECK_FALSE(found.has_surface());
    CHECK_FALSE(found.has_volumes());
    CHECK_FALSE(found.has_topology()); // a ring that is cut through is a ball
    CHECK(found.largest_distance > 0.1);
    CHECK(found.largest_distance < 1);
  }
}

TEST_CASE("a corner, a crease or a subdomain that is missing is named")
{
  const Oracle oracle = oracle_of(cube());
  const Mesh whole = refined(oracle, 0.4);
  const auto check = [&oracle](const Mesh& mesh) { return weft::check_domain_3(mesh, oracle, approximation); };
  REQUIRE(check(whole).ok());

  Mesh mesh = whole;
  mesh.corners.pop_back();
  CHECK(check(mesh).missing_corners == 1);

  mesh = whole;
  for (std::size_t e = 0; e < mesh.edges.size();) // one of the twelve creases
    if (mesh.creases[e] == 5) {
      mesh.edges.erase(mesh.edges.begin() + static_cast<std::ptrdiff_t>(e));
      mesh.creases.erase(mesh.creases.begin() + static_cast<std::ptrdiff_t>(e));
    } else {
      ++e;
    }
  CHECK(check(mesh).missed_crease_samples > 0);
  CHECK(check(mesh).missed_patch_samples == 0);

  mesh = whole;
  for (int& s : mesh.subdomains) s = 2;
  const auto found = check(mesh);
  REQUIRE(found.subdomains.size() == 2);
  CHECK(found.subdomains[0].volume == 0);
  CHECK_FALSE(found.has_volumes());
}

TEST_CASE("one side of a plate can't stand for the other")
{
  // As thick as the approximation bound: each side is well within twice that of the other one's facets.
  Surface plate = box(1, 1, 1);
  for (Point& p : plate.points) p = Point(p.x(), p.y(), p.z() * approximation);
  const Oracle one_patch = oracle_of(plate, 180);
  const Mesh mesh = refined(oracle_of(plate), 0.1);
  Mesh lower = mesh; // its facets alone
  lower.facets.clear(), lower.patches.clear();
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    double z = 0;
    for (const std::size_t v : mesh.facets[f]) z += mesh.points[v].z() / 3;
    if (z > 0.5 * approximation) continue;
    lower.facets.push_back(mesh.facets[f]);
    lower.patches.push_back(0);
  }
  lower.edges.clear(), lower.creases.clear(), lower.corners.clear();
  CHECK(weft::check_domain_3(lower, one_patch, approximation).missed_patch_samples > 0);
}

TEST_CASE("samples of a triangle are no farther apart than asked, and few where it is thin")
{
  std::mt19937 random(5);
  const auto number = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  for (int round = 0; round < 200; ++round) {
    std::array<weft::internal::Xyz_3, 3> corners;
    for (auto& corner : corners)
      for (double& x : corner) x = number();
    if (round % 2 == 1) corners[2] = corners[0], corners[2][0] += 1e-6; // a needle
    const double spacing = 0.05;
    std::vector<weft::internal::Xyz_3> points;
    weft::internal::for_each_grid_point(corners, spacing, [&](const auto& p) { points.push_back(p); });
    using weft::internal::minus;
    using weft::internal::norm;
    for (int i = 0; i < 20; ++i) { // a point of the triangle has a sample near it
      double s = number(), t = number();
      if (s + t > 1) s = 1 - s, t = 1 - t;
      weft::internal::Xyz_3 p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = corners[0][k] + s * (corners[1][k] - corners[0][k]) + t * (corners[2][k] - corners[0][k]);
      double nearest = 10;
      for (const auto& q : points) nearest = std::min(nearest, norm(minus(p, q)));
      CHECK(nearest <= 1.5 * spacing);
    }
    if (round % 2 == 1) CHECK(points.size() < 40);
  }
}
