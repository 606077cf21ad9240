// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small angles between parts of the boundary: sheets at an edge, creases at a vertex. Meshes of such domains are held
// to what other meshes are held to, but for the shapes that the input forces.

#include "fixtures/angle_surfaces.h"
#include "fixtures/domain_judge.h"
#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/domain/sheet_pairs_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/surface/merge_surfaces_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace meshing;
using surfaces::pi;

/// A surface turned at random.
Surface turned(Surface surface, unsigned seed)
{
  std::mt19937 random(seed);
  const auto draw = [&] { return static_cast<double>(random()) / 4294967295.0 - 0.5; };
  std::array<double, 4> q{{draw(), draw(), draw(), draw()}};
  double length = 0;
  for (const double x : q) length += x * x;
  for (double& x : q) x /= std::sqrt(length);
  const auto [w, x, y, z] = q;
  for (Point& p : surface.points)
    p = Point((1 - 2 * (y * y + z * z)) * p.x() + 2 * (x * y - z * w) * p.y() + 2 * (x * z + y * w) * p.z(),
              2 * (x * y + z * w) * p.x() + (1 - 2 * (x * x + z * z)) * p.y() + 2 * (y * z - x * w) * p.z(),
              2 * (x * z - y * w) * p.x() + 2 * (y * z + x * w) * p.y() + (1 - 2 * (x * x + y * y)) * p.z());
  return surface;
}

/// Two pyramids over a regular polygon of radius 1, base to base: n acute edges around the rim.
Surface lens(std::size_t n, double height)
{
  Surface s;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 2 * pi * static_cast<double>(i) / static_cast<double>(n);
    s.points.emplace_back(std::cos(a), std::sin(a), 0);
  }
  s.points.emplace_back(0, 0, height);
  s.points.emplace_back(0, 0, -height);
  for (std::size_t i = 0; i < n; ++i) {
    s.triangles.push_back({i, (i + 1) % n, n});
    s.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  return s;
}

/// A star of n teeth between two radii, extruded to height 0.5.
Surface extruded_star(std::size_t n, double inner, double outer)
{
  Surface s;
  const std::size_t m = 2 * n;
  for (const double z : {0., 0.5}) {
    for (std::size_t i = 0; i < m; ++i) {
      const double a = pi * static_cast<double>(i) / static_cast<double>(n), r = i % 2 == 0 ? outer : inner;
      s.points.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  s.points.emplace_back(0, 0, 0);
  s.points.emplace_back(0, 0, 0.5);
  for (std::size_t i = 0; i < m; ++i) {
    const std::size_t j = (i + 1) % m;
    s.triangles.push_back({i, j, m + j});
    s.triangles.push_back({i, m + j, m + i});
    s.triangles.push_back({j, i, 2 * m});
    s.triangles.push_back({m + i, m + j, 2 * m + 1});
  }
  return s;
}

/// Wedges of the same angle side by side around the z axis.
std::vector<Surface> book(std::size_t pages, double degrees)
{
  std::vector<Surface> result;
  const auto at = [&](std::size_t i, double z) {
    const double a = static_cast<double>(i) * degrees * pi / 180;
    return Point(std::cos(a), std::sin(a), z);
  };
  for (std::size_t i = 0; i < pages; ++i) {
    result.push_back({{Point(0, 0, 0), at(i, 0), at(i + 1, 0), Point(0, 0, 1), at(i, 1), at(i + 1, 1)},
                      {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 5}, {0, 3, 5}}});
  }
  return result;
}

weft::Polygon_soup_3<K> soup_of(const Surface& surface)
{
  weft::Polygon_soup_3<K> soup;
  soup.points = surface.points;
  for (const auto& [a, b, c] : surface.triangles) soup.polygons.push_back({a, b, c});
  return soup;
}

judge::Triangles triangles_of(const Surface& surface)
{
  judge::Triangles result;
  for (const Point& p : surface.points) result.points.push_back({p.x(), p.y(), p.z()});
  result.triangles = surface.triangles;
  return result;
}

/// The smallest dihedral angles of the cells that have a vertex inside, and of those that have none.
std::pair<double, double> smallest_angles(const Mesh& mesh)
{
  double inside = 180, at_boundary = 180;
  for (const auto& c : mesh.cells) {
    const double angle = weft::internal::degrees_of_cosine(weft::internal::cosine_of_smallest_dihedral(
        mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]));
    const bool is_inside =
        std::any_of(c.begin(), c.end(), [&](std::size_t v) { return mesh.locations[v].dimension == 3; });
    (is_inside ? inside : at_boundary) = std::min(is_inside ? inside : at_boundary, angle);
  }
  return {inside, at_boundary};
}

} // namespace

TEST_CASE("domains with dihedral angles down to half a degree are meshed like others, creases or not")
{
  for (const double angle : {40., 25., 10., 3., 1., 0.5})
    for (const double sharp : {60., 180.}) {
      INFO("a wedge of " << angle << " degrees, sharp from " << sharp);
      const Oracle oracle = oracle_of(turned(surfaces::wedge(angle), 7), sharp);
      const Criteria criteria = criteria_of(0.2, 0.01, sharp < 180);
      const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
      INFO(report);
      CHECK(report.ok());
      CHECK(report.manifold);
      CHECK(report.vertices < 3500);
      CHECK((angle > 25 || report.forced_cells > 0));
      check_consistent(restricted, report);
      check_complete(weft::tetrahedral_mesh(restricted), oracle, criteria, 0.01);
    }
}

TEST_CASE("edges at tips, around stars and lenses are met however they are turned")
{
  for (const auto& [name, surface] :
       std::vector<std::pair<std::string, Surface>>{{"a lens of 6 at 19 degrees", lens(6, 0.144)},
                                                    {"a lens of 5 at 3 degrees", lens(5, 0.021)},
                                                    {"a star of 5 teeth", extruded_star(5, 0.4, 1)},
                                                    {"a star of 9 teeth", extruded_star(9, 0.55, 1)},
                                                    {"a wedge of 2 degrees", surfaces::wedge(2)}})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      INFO(name << ", turned " << seed);
      const Oracle oracle = oracle_of(turned(surface, seed));
      const Criteria criteria = criteria_of(0.25, 0.005);
      const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
      INFO(report);
      CHECK(report.ok());
      check_complete(weft::tetrahedral_mesh(restricted), oracle, criteria, 0.005);
    }
}

TEST_CASE("subdomains may meet like the pages of a book")
{
  for (const double angle : {20., 4.}) {
    INFO("pages of " << angle << " degrees");
    std::vector<weft::Polygon_soup_3<K>> pages;
    for (const Surface& page : book(3, angle)) pages.push_back(soup_of(page));
    const Oracle oracle(weft::piecewise_smooth_complex(pages, weft::Feature_options{60}));
    const auto pairs = weft::internal::sheet_pairs_3(oracle.complex(), pi / 3);
    CHECK(pairs.size() == 3); // around the only edge with acute angles
    for (const auto& pair : pairs) CHECK(std::abs(pair.angle - angle * pi / 180) < 1e-12);
    const Criteria criteria = criteria_of(0.25, 0.01);
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
    INFO(report);
    CHECK(report.ok());
    check_consistent(restricted, report);
    weft::Validity_3 validity = weft::check_structure_3(weft::tetrahedral_mesh(restricted));
    validity += weft::check_criteria_3(weft::tetrahedral_mesh(restricted), criteria, oracle);
    INFO(validity);
    CHECK(validity.ok());
  }
}

TEST_CASE("random solids with small angles are what their volumes and topology say, and are meshed whole")
{
  std::set<std::string> kinds;
  // Grooves and wedges that end in a block, sheets that meet at both ends of a crease, rims and notches, teeth.
  for (const unsigned seed : {0u, 1u, 2u, 3u, 10u, 11u, 26u, 51u, 57u, 59u, 92u}) {
    const angles::Angle_solid solid = angles::angle_solid(seed);
    INFO("seed " << seed << ", " << solid.kind << " of " << solid.angle << " degrees");
    kinds.insert(solid.kind);
    const judge::Triangles whole = triangles_of(solid.whole);
    const judge::Topology topology = judge::topology(whole);
    CHECK((topology.bad_edges == 0 && topology.bad_vertices == 0 && topology.shells == 1 && topology.euler == 2));
    double volume = 0;
    std::vector<weft::Polygon_soup_3<K>> soups;
    for (const Surface& part : solid.parts) {
      volume += thin::exact_volume(part);
      soups.push_back(soup_of(part));
    }
    CHECK(volume == Approx(thin::exact_volume(solid.whole)).epsilon(1e-9));
    const auto complex = soups.size() == 1 ? weft::piecewise_smooth_complex(soups[0], weft::Feature_options{60})
                                           : weft::piecewise_smooth_complex(soups, weft::Feature_options{60});
    const Oracle oracle(complex);
    CGAL::Bbox_3 box;
    for (const Point& p : solid.whole.points) box += p.bbox();
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    const auto [restricted, report] =
        weft::make_mesh_3(oracle, criteria_of(0.1 * diagonal, 0.001 * diagonal), refinement());
    INFO(report);
    CHECK(report.ok());
    const Mesh mesh = weft::tetrahedral_mesh(restricted);
    std::vector<judge::Vector> points;
    for (const Point& p : mesh.points) points.push_back({p.x(), p.y(), p.z()});
    const judge::Verdict verdict = judge::verdict(points, mesh.cells, whole, {volume, 1, 1, 2}, 0.001 * diagonal, 500);
    INFO(judge::describe(verdict));
    CHECK(verdict.is_right());
  }
  CHECK(kinds.size() == angles::number_of_kinds);
}

TEST_CASE("a vertex whose mirror image is nearer than any other vertex has a twin there")
{
  const double angle = 6;
  const Oracle oracle = oracle_of(surfaces::wedge(angle));
  const auto [restricted, report] = weft::make_mesh_3(oracle, criteria_of(0.15, 0.01), refinement());
  REQUIRE(report.ok());
  const Mesh mesh = weft::tetrahedral_mesh(restricted);
  const double c = std::cos(angle * pi / 180), s = std::sin(angle * pi / 180);
  std::size_t twins = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point& p = mesh.points[v];
    const bool on_first = p.y() < 1e-9, on_second = std::abs(p.y() * c - p.x() * s) < 1e-9;
    if (mesh.locations[v].dimension > 2 || on_first == on_second || mesh.locations[v].dimension == 0) continue;
    const Point image(c * p.x() + s * p.y(), s * p.x() - c * p.y(), p.z());
    const double apart = std::sqrt(CGAL::squared_distance(p, image));
    double nearest_to_image = 10, nearest = 10;
    for (std::size_t w = 0; w < mesh.points.size(); ++w) {
      const double d = std::sqrt(CGAL::squared_distance(mesh.points[w], image));
      nearest_to_image = std::min(nearest_to_image, d);
      if (w != v && d > 0.3 * apart) nearest = std::min(nearest, std::sqrt(CGAL::squared_distance(mesh.points[w], p)));
    }
    if (apart >= nearest) continue;
    CHECK(nearest_to_image <= 0.26 * apart);
    twins += nearest_to_image < 1e-9;
  }
  CHECK(twins > 100);
}

TEST_CASE("cells between twins aren't flat, and others are good")
{
  for (const double angle : {15., 4., 0.7}) {
    INFO("a wedge of " << angle << " degrees");
    const Oracle oracle = oracle_of(turned(surfaces::wedge(angle), 3));
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria_of(0.2, 0.01));
    INFO(report);
    CHECK(report.ok());
    const auto [inside, at_boundary] = smallest_angles(weft::tetrahedral_mesh(restricted));
    CHECK(inside > 19);
    CHECK(at_boundary > 0.7 * angle);
    CHECK(report.largest_dihedral < 165);
  }
}

TEST_CASE("a wedge that begins narrower than its vertices are apart has good cells beside it, however it is turned")
{
  // Two teeth of 11.5 degrees around a shaft, 0.2 wide at their roots, where edges may be 1 long.
  const Surface s = thin::revolved(
      {{0, 0}, {2, 0}, {2.6, 0.35}, {3.6, 0.45}, {2.6, 0.55}, {2.6, 1.15}, {3.6, 1.25}, {2.6, 1.35}, {2, 2}, {0, 2}},
      24);
  for (const unsigned seed : {1u, 2u}) {
    INFO("turned " << seed);
    const Oracle oracle = oracle_of(turned(s, seed));
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria_of(1, 0.0075));
    INFO(report);
    CHECK(report.ok());
    const auto [inside, at_boundary] = smallest_angles(weft::tetrahedral_mesh(restricted));
    CHECK(inside > 18);
    CHECK(at_boundary > 0.6 * 11.5);
    CHECK(report.largest_dihedral < 165);
  }
}

TEST_CASE("a closed crease is whole though its first point is as far from one vertex as from another")
{
  // Two pyramids base to base, over an octagon with coordinates that make distances exact.
  Surface s;
  s.points = {{4, 0, 0}, {3, 3, 0}, {0, 4, 0}, {-3, 3, 0}, {-4, 0, 0}, {-3, -3, 0}, {0, -4, 0}, {3, -3, 0}};
  for (const double z : {2., -2.}) s.points.emplace_back(0, 0, z);
  for (std::size_t i = 0; i < 8; ++i) {
    s.triangles.push_back({i, (i + 1) % 8, 8});
    s.triangles.push_back({(i + 1) % 8, i, 9});
  }
  const Oracle oracle = oracle_of(s);
  REQUIRE(oracle.number_of_creases() == 1);
  REQUIRE(oracle.crease_is_closed(0));
  const auto rim = oracle.crease_points(0);
  for (const std::size_t first : {0u, 1u}) { // with a vertex at the first point, and without
    weft::Restricted_delaunay_3<Oracle> mesh(oracle, 1);
    std::vector<Point> points;
    for (std::size_t i = first; i < 8; i += 2) points.push_back(rim[i]);
    mesh.insert(points, std::vector<weft::Vertex_location_3>(4, {1, 0}));
    const auto& edges = mesh.creases().edges();
    CHECK(edges.size() == 4);
    for (const auto& e : edges) CHECK(!e.is_tangled);
  }
}

TEST_CASE("shapes that nothing forces are still found bad beside small angles")
{
  const Oracle oracle = oracle_of(surfaces::wedge(10));
  const Criteria criteria = criteria_of(0.2, 0.01);
  Mesh mesh = weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria, refinement()).restricted);
  REQUIRE(weft::check_criteria_3(mesh, criteria, oracle).ok());
  CHECK(weft::check_criteria_3(mesh, criteria).count(weft::Fault_kind_3::shape) > 0);
  // The same cells, but their vertices said to lie inside.
  for (auto& at : mesh.locations) at = {3, 1};
  CHECK(weft::check_criteria_3(mesh, criteria, oracle).count(weft::Fault_kind_3::shape) > 0);
}

TEST_CASE("domains without small angles have no mirror images")
{
  for (const Surface& surface : {surfaces::cube(), surfaces::sphere(2)}) {
    const Oracle oracle = oracle_of(surface);
    CHECK(!oracle.has_mirror_images());
  }
  CHECK(oracle_of(surfaces::wedge(59)).has_mirror_images());
}
