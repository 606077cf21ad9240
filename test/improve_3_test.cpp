// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of improving tetrahedral meshes that there are: what slides stays on the surface, what is fixed stays to
// the last bit, nothing gets worse, slivers and inverted cells go.

#include "fixtures/improvement_3.h"
#include "fixtures/spatial_fixtures.h"

#include <weft/improve_3.h>
#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/spatial/mesh/assemble_mesh_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/surface/merge_surfaces_3.h>

#include <catch2/catch.hpp>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using fixtures::K;
using fixtures::Mesh;
using fixtures::Point;
using Options = weft::Improve_options_3;
using weft::Boundary_3;

Options fixed()
{
  Options options;
  options.boundary = Boundary_3::fixed;
  options.min_dihedral_angle = 12; // random boundaries allow little
  return options;
}

/// A ball full of slivers whose interior vertices are at random.
Mesh ball(unsigned seed = 1)
{
  return fixtures::ball(500, 500, seed).mesh;
}

/// A box whose interior vertices are moved at random, as far as that.
Mesh shaken_box(int n, double reach, bool two_subdomains = false)
{
  Mesh mesh = fixtures::box(n, two_subdomains).mesh;
  std::mt19937 random(5);
  const auto shift = [&random, reach] { return 2 * reach * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double x = shift(), y = shift(), z = shift();
    const Point& p = mesh.points[v];
    if (mesh.locations[v].dimension == 3) mesh.points[v] = Point(p.x() + x, p.y() + y, p.z() + z);
  }
  return mesh;
}

using Facet_set = std::set<std::pair<std::vector<Point>, int>>;

/// The facets by coordinates, beginning with the least corner, in their sense, and their patches.
Facet_set facets_of(const Mesh& mesh)
{
  Facet_set result;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    std::vector<Point> points;
    for (const std::size_t v : mesh.facets[f]) points.push_back(mesh.points[v]);
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    result.emplace(points, mesh.patches[f]);
  }
  return result;
}

double volume_of(const Mesh& mesh, int subdomain)
{
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& v = mesh.cells[c];
    if (mesh.subdomains[c] == subdomain)
      sum += CGAL::volume(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
  }
  return sum;
}

bool same(const Mesh& a, const Mesh& b)
{
  return a.points == b.points && a.cells == b.cells && a.facets == b.facets && a.patches == b.patches &&
         a.edges == b.edges && a.locations == b.locations;
}

/// Everything but the Delaunay property.
void check_valid(const Mesh& mesh)
{
  weft::Validity_3 validity = weft::check_structure_3(mesh);
  validity += weft::check_orientation_3(mesh);
  validity += weft::check_boundary_3(mesh);
  validity += weft::check_manifold_3(mesh);
  validity += weft::check_locations_3(mesh);
  CAPTURE(validity);
  CHECK(validity.ok());
}

/// Distance of a point from the facets of a mesh.
double distance_from(const Mesh& mesh, const Point& p)
{
  double nearest = HUGE_VAL;
  for (const auto& f : mesh.facets)
    nearest = std::min(
        nearest, CGAL::squared_distance(p, K::Triangle_3(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]])));
  return std::sqrt(nearest);
}

} // namespace

// ---- boundaries that slide

TEST_CASE("a ball full of slivers becomes a good mesh whose boundary vertices lie on the surface it had")
{
  const Mesh mesh = ball();
  for (const bool delaunay : {false, true}) {
    Options options;
    options.delaunay = delaunay;
    options.min_dihedral_angle = 18;
    const auto [result, report] = weft::improve_3(mesh, options);
    CAPTURE(delaunay, report);
    CHECK(report.before.smallest_dihedral.degrees < 2);
    CHECK(report.after.smallest_dihedral.degrees >= 18);
    CHECK(report.ok());
    CHECK(report.notes.empty());
    check_valid(result);
    if (delaunay) CHECK(weft::check_delaunay_3(result).ok());
    for (std::size_t v = 0; v < result.points.size(); ++v)
      if (result.locations[v].dimension == 2) CHECK(distance_from(mesh, result.points[v]) < 1e-9);
    CHECK(report.after.volume == Approx(report.before.volume).epsilon(0.03));
    CHECK(result.points.size() < 1.1 * mesh.points.size());
    CHECK(result.points.size() > 0.8 * mesh.points.size());
  }
}

TEST_CASE("a fine interior stays fine under a coarse boundary")
{
  const Mesh mesh = fixtures::ball(60, 900).mesh;
  const auto [better, report] = weft::improve_3(mesh);
  check_valid(better);
  CHECK(10 * better.points.size() > 7 * mesh.points.size());
  CHECK(10 * better.points.size() < 14 * mesh.points.size());
  CHECK(10 * better.cells.size() > 6 * mesh.cells.size());
  CHECK(report.after.smallest_dihedral.degrees > 15);
  CHECK(volume_of(better, 1) == Approx(volume_of(mesh, 1)).epsilon(0.05));
}

TEST_CASE("the manual's lines improve a mesh from a file and write it")
{
  weft::IO::write_mesh_3("part.msh", ball());

  const auto input = weft::IO::read_tetrahedral_mesh<K>("part.msh"); // .mesh, .msh, .vtu, .ele; input.notes: left out
  weft::Improve_options_3 options;
  options.min_dihedral_angle = 28;            // degrees
  options.boundary = weft::Boundary_3::slide; // or fixed
  const auto [mesh, report] = weft::improve_3(input.mesh, options);
  std::cout << report; // before and after
  weft::IO::write_mesh_3("part.vtu", mesh);

  CHECK(report.after.smallest_dihedral.degrees > report.before.smallest_dihedral.degrees);
  CHECK(weft::IO::read_tetrahedral_mesh<K>("part.vtu").mesh.cells.size() == mesh.cells.size());
  std::remove("part.msh");
  std::remove("part.vtu");
}

TEST_CASE("patches, creases and corners keep their names, and sharp edges found by angle get new ones")
{
  Mesh mesh = shaken_box(3, 0.4);
  for (int& patch : mesh.patches) patch += 10;
  for (auto& at : mesh.locations)
    if (at.dimension == 2) at.index += 10;
  for (int& s : mesh.subdomains) s = 4;
  for (auto& at : mesh.locations)
    if (at.dimension == 3) at.index = 4;
  const auto [result, report] = weft::improve_3(mesh);
  CAPTURE(report);
  check_valid(result);
  CHECK(std::set<int>(result.patches.begin(), result.patches.end()) ==
        std::set<int>(mesh.patches.begin(), mesh.patches.end()));
  CHECK(std::set<int>(result.creases.begin(), result.creases.end()) ==
        std::set<int>(mesh.creases.begin(), mesh.creases.end()));
  CHECK(std::set<int>(result.subdomains.begin(), result.subdomains.end()) == std::set<int>{4});
  CHECK(result.corners.size() == 8);
  CHECK(report.after.volume == Approx(27));
  const auto bare = weft::assemble_mesh_3(mesh.points, mesh.cells).mesh; // no tags at all
  CHECK(bare.edges.empty());
  const auto found = weft::improve_3(bare).mesh;
  CHECK(found.corners.size() == 8);
  CHECK(std::set<int>(found.creases.begin(), found.creases.end()).size() == 12);
  CHECK(std::set<int>(found.patches.begin(), found.patches.end()) == std::set<int>{0});
}

TEST_CASE("a mesh is improved on a domain that is given")
{
  const Mesh mesh = shaken_box(3, 0.4);
  const auto bare = weft::assemble_mesh_3(mesh.points, mesh.cells).mesh;
  const weft::Polyhedral_oracle_3<K> oracle(
      weft::piecewise_smooth_complex(mesh.points, mesh.facets, weft::Feature_options{60}));
  const auto [result, report] = weft::improve_3(bare, oracle, Options());
  CAPTURE(report);
  check_valid(result);
  CHECK(report.ok());
  CHECK(result.corners.size() == 8);
  CHECK(std::set<int>(result.patches.begin(), result.patches.end()).size() == 6);
  CHECK(report.after.volume == Approx(27));
  CHECK_THROWS_AS(weft::improve_3(bare, oracle, fixed()), weft::Option_error);
}

/// Points of a sphere, nearly evenly.
void add_sphere(double radius, int n, std::vector<Point>& points)
{
  constexpr double golden_angle = 2.399963229728653;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.) / n, r = std::sqrt(1 - z * z);
    points.emplace_back(radius * r * std::cos(golden_angle * i), radius * r * std::sin(golden_angle * i), radius * z);
  }
}

/// A ball of radius 1 with subdomain 7 in one of radius 2 with subdomain 3: slivers, no tags of facets.
Mesh ball_in_ball()
{
  std::vector<Point> points;
  add_sphere(2, 700, points);
  add_sphere(1, 200, points);
  std::mt19937 random(11);
  const auto coordinate = [&random] { return static_cast<double>(random()) / 1073741824. - 2; };
  while (points.size() < 1500) {
    const double x = coordinate(), y = coordinate(), z = coordinate(), r = std::sqrt(x * x + y * y + z * z);
    if (r < 1.85 && std::abs(r - 1) > 0.12) points.emplace_back(x, y, z);
  }
  fixtures::Triangulation triangulation(points.begin(), points.end());
  std::map<Point, std::size_t> number;
  for (std::size_t v = 0; v < points.size(); ++v) number.emplace(points[v], v);
  std::vector<std::array<std::size_t, 4>> cells;
  std::vector<int> subdomains;
  for (const auto cell : triangulation.finite_cell_handles()) {
    double farthest = 0;
    std::array<std::size_t, 4> corners{};
    for (int i = 0; i < 4; ++i) {
      const Point& p = cell->vertex(i)->point();
      farthest = std::max(farthest, CGAL::squared_distance(p, Point(0, 0, 0)));
      corners[static_cast<std::size_t>(i)] = number.at(p);
    }
    cells.push_back(corners);
    subdomains.push_back(farthest < 1.001 ? 7 : 3);
  }
  return weft::assemble_mesh_3(points, cells, subdomains).mesh;
}

/// The longest distance of a vertex on a boundary or interface from the facets of a mesh.
double farthest_from(const Mesh& mesh, const Mesh& result)
{
  double farthest = 0;
  for (std::size_t v = 0; v < result.points.size(); ++v)
    if (result.locations[v].dimension < 3) farthest = std::max(farthest, distance_from(mesh, result.points[v]));
  return farthest;
}

TEST_CASE("two boxes with a common face: the interface slides on itself, and each keeps its volume and its names")
{
  Mesh mesh = shaken_box(4, 0.3, true);
  for (int& patch : mesh.patches) patch += 10;
  for (auto& at : mesh.locations)
    if (at.dimension == 2) at.index += 10;
  for (const bool delaunay : {false, true}) {
    Options options;
    options.delaunay = delaunay;
    options.min_dihedral_angle = 18;
    const auto [result, report] = weft::improve_3(mesh, options);
    CAPTURE(delaunay, report);
    CHECK(report.ok());
    CHECK(report.notes.empty());
    CHECK(report.after.smallest_dihedral.degrees >= 18);
    CHECK(volume_of(result, 1) == Approx(32));
    CHECK(volume_of(result, 2) == Approx(32));
    CHECK(result.corners.size() == 12); // the rim of the interface is sharp
    CHECK(std::set<int>(result.patches.begin(), result.patches.end()) ==
          std::set<int>(mesh.patches.begin(), mesh.patches.end()));
    const std::set<int> before(mesh.creases.begin(), mesh.creases.end());
    const std::set<int> after(result.creases.begin(), result.creases.end());
    CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    CHECK(after.size() == 16); // and has no name in the mesh
    CHECK(farthest_from(mesh, result) < 1e-9);
    check_valid(result);
  }
}

TEST_CASE("a ball in a ball: both boundaries slide on themselves, with a fixed boundary they stay to the last bit")
{
  const Mesh mesh = ball_in_ball();
  Options options;
  options.min_dihedral_angle = 18;
  const auto [result, report] = weft::improve_3(mesh, options);
  CAPTURE(report);
  CHECK(report.before.smallest_dihedral.degrees < 2);
  CHECK(report.after.smallest_dihedral.degrees >= 18);
  CHECK(report.ok());
  CHECK(report.notes.empty());
  CHECK(result.points.size() < 1.1 * mesh.points.size());
  CHECK(volume_of(result, 3) == Approx(volume_of(mesh, 3)).epsilon(0.01));
  CHECK(volume_of(result, 7) == Approx(volume_of(mesh, 7)).epsilon(0.03));
  CHECK(farthest_from(mesh, result) < 1e-9);
  check_valid(result);
  CHECK(same(result, weft::improve_3(mesh, options).mesh));
  options.boundary = Boundary_3::fixed;
  CHECK(facets_of(weft::improve_3(mesh, options).mesh) == facets_of(mesh));
}

TEST_CASE("several subdomains are improved on a domain that is given")
{
  const Mesh mesh = ball_in_ball();
  std::vector<weft::Polygon_soup_3<K>> surfaces(2); // the outer surface, and that of the ball inside
  for (auto& surface : surfaces) surface.points = mesh.points;
  for (const auto& [subdomain, facet] : weft::internal::subdomain_boundaries(mesh)) {
    const std::vector<std::size_t> corners(facet.begin(), facet.end());
    if (subdomain == 7) surfaces[1].polygons.push_back(corners);
    if (subdomain == 3 && CGAL::squared_distance(mesh.points[facet[0]], Point(0, 0, 0)) > 2)
      surfaces[0].polygons.push_back(corners);
  }
  const weft::Polyhedral_oracle_3<K> oracle(weft::piecewise_smooth_complex(surfaces));
  const auto [result, report] = weft::improve_3(mesh, oracle, Options());
  CAPTURE(report);
  CHECK(report.ok());
  CHECK(report.after.smallest_dihedral.degrees >= 15);
  CHECK(volume_of(result, 1) == Approx(volume_of(mesh, 3)).epsilon(0.01));
  CHECK(volume_of(result, 2) == Approx(volume_of(mesh, 7)).epsilon(0.03));
  check_valid(result);
}

TEST_CASE("subdomains whose boundaries aren't manifold or meet improperly don't slide, but take a fixed boundary")
{
  Mesh mesh = fixtures::box(2).mesh; // two opposite octants meet at a point
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    double x = 0, y = 0, z = 0;
    for (const std::size_t v : mesh.cells[c])
      x += mesh.points[v].x() / 4, y += mesh.points[v].y() / 4, z += mesh.points[v].z() / 4;
    mesh.subdomains[c] = (x > 1) == (y > 1) && (y > 1) == (z > 1) ? 2 : 1;
  }
  const Mesh touching = weft::assemble_mesh_3(mesh.points, mesh.cells, mesh.subdomains).mesh;
  CHECK_THROWS_AS(weft::improve_3(touching), weft::Domain_error);
  CHECK(facets_of(weft::improve_3(touching, fixed()).mesh) == facets_of(touching));
  Mesh crossing = fixtures::box(4, true).mesh;
  for (std::size_t v = 0; v < crossing.points.size(); ++v)
    if (crossing.locations[v] == fixtures::Location{2, 6} && crossing.points[v] == Point(2, 2, 2))
      crossing.points[v] = Point(9, 2, 2); // out at the other end
  CHECK_THROWS_AS(weft::improve_3(crossing), weft::Domain_error);
}

TEST_CASE("several subdomains keep their interfaces with a fixed boundary")
{
  const Mesh mesh = fixtures::box(4, true).mesh;
  Mesh shaken = mesh;
  for (std::size_t v = 0; v < shaken.points.size(); ++v)
    if (shaken.locations[v].dimension == 3) {
      const Point& p = shaken.points[v];
      shaken.points[v] = Point(p.x() + 0.3, p.y() - 0.2, p.z() + 0.35);
    }
  Options options = fixed();
  options.min_dihedral_angle = 25;
  const auto [result, report] = weft::improve_3(shaken, options);
  CAPTURE(report);
  CHECK(facets_of(result) == facets_of(mesh));
  CHECK(volume_of(result, 1) == Approx(32));
  CHECK(volume_of(result, 2) == Approx(32));
  CHECK(report.after.smallest_dihedral.degrees > report.before.smallest_dihedral.degrees);
  check_valid(result);
}

// ---- fixed boundaries

TEST_CASE("with a fixed boundary every facet stays to the last bit and the worst angle rises")
{
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = ball(seed);
    const auto [result, report] = weft::improve_3(mesh, fixed());
    CAPTURE(seed, report);
    CHECK(facets_of(result) == facets_of(mesh));
    CHECK(report.after.smallest_dihedral.degrees > report.before.smallest_dihedral.degrees);
    CHECK(report.after.cells_below(10) < report.before.cells_below(10) / 5);
    CHECK(report.after.smallest_dihedral.degrees <= report.boundary_bound);
    CHECK(report.after.volume == Approx(report.before.volume));
    check_valid(result);
  }
}

TEST_CASE("inverted cells are turned over")
{
  const Mesh mesh = shaken_box(4, 0.8);
  const auto [result, report] = weft::improve_3(mesh, fixed());
  CAPTURE(report);
  CHECK(report.inverted_before > 20);
  CHECK(report.inverted_after == 0);
  CHECK(report.after.smallest_dihedral.degrees >= 12);
  CHECK(facets_of(result) == facets_of(mesh));
  check_valid(result);
  const auto slid = weft::improve_3(mesh);
  CHECK(slid.report.inverted_after == 0);
  check_valid(slid.mesh);
}

TEST_CASE("fixed vertices stay where they are, whatever else moves")
{
  const Mesh mesh = ball(2);
  for (const bool slides : {true, false}) {
    Options options;
    options.boundary = slides ? Boundary_3::slide : Boundary_3::fixed;
    options.min_dihedral_angle = 8;
    for (std::size_t v = 0; v < mesh.points.size(); v += 7) options.fixed_vertices.push_back(v);
    const auto [result, report] = weft::improve_3(mesh, options);
    const std::set<Point> points(result.points.begin(), result.points.end());
    std::size_t missing = 0;
    for (const std::size_t v : options.fixed_vertices) missing += points.count(mesh.points[v]) == 0;
    CAPTURE(slides, report);
    CHECK(missing == 0);
    check_valid(result);
    CHECK(report.after.cells_below(5) < report.before.cells_below(5));
    options.delaunay = true;
    if (!slides) continue;
    const auto perturbed = weft::improve_3(mesh, options).mesh;
    const std::set<Point> left(perturbed.points.begin(), perturbed.points.end());
    for (const std::size_t v : options.fixed_vertices) CHECK(left.count(mesh.points[v]) == 1);
  }
}

// ---- both

TEST_CASE("the same input gives the same mesh, whatever the number of threads")
{
  const Mesh mesh = ball(3);
  for (const Boundary_3 boundary : {Boundary_3::slide, Boundary_3::fixed}) {
    Options options;
    options.boundary = boundary;
    options.min_dihedral_angle = 12;
    const auto first = weft::improve_3(mesh, options).mesh;
    options.threads = 3;
    CHECK(same(first, weft::improve_3(mesh, options).mesh));
  }
}

TEST_CASE("a run that is stopped at any time leaves a valid mesh that isn't worse than before")
{
  const Mesh mesh = ball(4);
  for (const Boundary_3 boundary : {Boundary_3::slide, Boundary_3::fixed})
    for (int calls : {0, 1, 2, 4, 8, 16}) {
      Options options;
      options.boundary = boundary;
      options.min_dihedral_angle = 12;
      options.visitor = [&calls](const weft::Progress&) { return calls-- > 0; };
      const auto [result, report] = weft::improve_3(mesh, options);
      CHECK((report.stop_reason == weft::Stop_reason::cancelled || calls >= 0));
      CHECK(report.after.smallest_dihedral.degrees >= report.before.smallest_dihedral.degrees);
      check_valid(result);
    }
}

TEST_CASE("little time leaves a valid mesh that isn't worse than before")
{
  const Mesh mesh = ball(4);
  for (const Boundary_3 boundary : {Boundary_3::slide, Boundary_3::fixed})
    for (const double seconds : {0., 0.002, 0.02, 0.1}) {
      Options options;
      options.boundary = boundary;
      options.time_limit = seconds;
      const auto [result, report] = weft::improve_3(mesh, options);
      CHECK(report.after.smallest_dihedral.degrees >= report.before.smallest_dihedral.degrees);
      CHECK(result.cells.size() > 0);
      check_valid(result);
    }
}

TEST_CASE("options out of range and arrays that aren't a mesh are refused")
{
  const Mesh mesh = ball();
  Options options;
  options.min_dihedral_angle = 91;
  CHECK_THROWS_AS(weft::improve_3(mesh, options), weft::Option_error);
  options = fixed();
  options.fixed_vertices = {mesh.points.size()};
  CHECK_THROWS_AS(weft::improve_3(mesh, options), weft::Option_error);
  Mesh broken = mesh;
  broken.cells[0][0] = broken.cells[0][1];
  CHECK_THROWS_AS(weft::improve_3(broken), weft::Domain_error);
  broken = mesh;
  broken.facets.pop_back();
  broken.patches.pop_back();
  CHECK_THROWS_AS(weft::improve_3(broken, fixed()), weft::Domain_error);
}

// ---- local changes

namespace {

using Editable = weft::internal::Editable_mesh_3<K>;
using Operations = weft::internal::Local_operations_3<K>;

double worst_of(const Editable& mesh, const Operations& operations)
{
  double worst = HUGE_VAL;
  for (int c = 0; c < mesh.number_of_cells(); ++c)
    if (mesh.cell(c).is_alive) worst = std::min(worst, operations.quality(c));
  return worst;
}

/// One change of any kind at a cell, if it helps.
bool change(Operations& operations, const Editable& mesh, int c, unsigned kind)
{
  const auto v = mesh.cell(c).vertices;
  switch (kind % 5) {
  case 0:
    return operations.smooth(v[kind / 5 % 4]);
  case 1:
    return operations.remove_edge(c, v[kind / 5 % 4], v[(kind / 5 + 1) % 4]);
  case 2:
    return operations.remove_facets(c, static_cast<int>(kind / 5 % 4));
  case 3:
    return operations.remove_vertex(v[kind / 5 % 4]);
  default:
    return operations.insert_vertex(
        c, CGAL::centroid(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])));
  }
}

} // namespace

TEST_CASE("local changes climb: each of them raises the worst cell it touches, and all are made somewhere")
{
  const Mesh input = ball(5);
  Editable mesh(input, {});
  Operations operations(mesh);
  std::mt19937 random(7);
  double worst = worst_of(mesh, operations);
  for (int k = 0; k < 3000; ++k) {
    const int c = static_cast<int>(random() % static_cast<unsigned>(mesh.number_of_cells()));
    if (!mesh.cell(c).is_alive) continue;
    mesh.begin();
    if (!change(operations, mesh, c, static_cast<unsigned>(random()))) continue;
    const double now = worst_of(mesh, operations);
    REQUIRE(now >= worst);
    worst = now;
  }
  const auto& counts = operations.counts();
  CHECK(counts.moves > 20);
  CHECK(counts.edge_removals > 20);
  CHECK(counts.facet_removals > 20);
  CHECK(counts.contractions > 5);
  CHECK(counts.insertions > 5);
  const Mesh result = mesh.mesh(input);
  check_valid(result);
  CHECK(facets_of(result) == facets_of(input));
  CHECK(volume_of(result, 1) == Approx(volume_of(input, 1)));
}

TEST_CASE("local changes can be undone, all or the last of them")
{
  const Mesh input = ball(6);
  Editable mesh(input, {});
  Operations operations(mesh);
  std::mt19937 random(8);
  for (int round = 0; round < 30; ++round) {
    const Mesh before = mesh.mesh(input);
    mesh.begin();
    for (int k = 0; k < 40; ++k) {
      const int c = static_cast<int>(random() % static_cast<unsigned>(mesh.number_of_cells()));
      if (mesh.cell(c).is_alive) change(operations, mesh, c, static_cast<unsigned>(random()));
    }
    mesh.undo();
    REQUIRE(same(mesh.mesh(input), before));
    for (int c = 0; c < mesh.number_of_cells(); ++c)
      for (int i = 0; i < 4 && mesh.cell(c).is_alive; ++i) {
        const int n = mesh.cell(c).neighbours[static_cast<std::size_t>(i)];
        REQUIRE((n == Editable::none || mesh.cell(n).is_alive));
      }
    for (int k = 0; k < 20; ++k) { // something stays
      const int c = static_cast<int>(random() % static_cast<unsigned>(mesh.number_of_cells()));
      if (mesh.cell(c).is_alive) change(operations, mesh, c, static_cast<unsigned>(random()));
    }
    if (round % 10 == 9) mesh.compact();
  }
  check_valid(mesh.mesh(input));
}
