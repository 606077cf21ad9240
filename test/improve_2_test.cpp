// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of improving planar meshes that there are: the domain, its regions and tags stay, what is fixed stays to
// the last bit, nothing gets worse, slivers and inverted triangles go; files come back as they were written, and what
// isn't a mesh is refused with the elements to blame.

#include "fixtures/improvement_2.h"

#include <weft/improve_2.h>
#include <weft/IO/read_triangle_mesh.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/planar/mesh/from_triangulation_2.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using planar::Cdt;
using planar::K;
using planar::Point;
using Mesh = weft::Triangle_mesh_2<K>;
using Options = weft::Improve_options_2;
using Soup = weft::Element_soup_2<K>;
using weft::Boundary_2;

Options options_of(Boundary_2 boundary)
{
  Options options;
  options.boundary = boundary;
  return options;
}

const std::array<Boundary_2, 2> both{Boundary_2::slide, Boundary_2::fixed};

double uniform(std::mt19937& random)
{
  return static_cast<double>(random()) / 4294967296.0;
}

/// Squares cut in two, nx by ny of side 1; vertices inside are moved at random as far as `reach`, from 0.5 on so that
/// triangles turn over.
/// \param region tag of the square at (x, y), 0 for a hole.
Mesh grid(int nx, int ny, double reach, const std::function<int(int, int)>& region = {}, unsigned seed = 1)
{
  std::mt19937 random(seed);
  Soup soup;
  const auto tag = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= nx || y >= ny) return 0;
    return region ? region(x, y) : 1;
  };
  for (int y = 0; y <= ny; ++y)
    for (int x = 0; x <= nx; ++x) {
      const double dx = reach * (2 * uniform(random) - 1), dy = reach * (2 * uniform(random) - 1);
      const int here = tag(x, y);
      const bool inside = here != 0 && here == tag(x - 1, y) && here == tag(x, y - 1) && here == tag(x - 1, y - 1);
      soup.points.emplace_back(x + (inside ? dx : 0), y + (inside ? dy : 0));
    }
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      if (tag(x, y) == 0) continue;
      const auto a = static_cast<std::size_t>(y * (nx + 1) + x), b = a + 1, c = a + static_cast<std::size_t>(nx) + 1;
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({c, b, c + 1});
      soup.triangle_tags.insert(soup.triangle_tags.end(), 2, tag(x, y));
    }
  return weft::assemble_mesh_2(std::move(soup)).mesh;
}

/// The constrained Delaunay triangulation of a graph and random points in its box.
Mesh random_mesh(const planar::Pslg& pslg, int points, unsigned seed)
{
  Cdt cdt;
  weft::insert_pslg(cdt, pslg);
  CGAL::Bbox_2 box;
  for (const Point& p : pslg.points) box += p.bbox();
  std::mt19937 random(seed);
  for (int i = 0; i < points; ++i) {
    const double x = box.xmin() + uniform(random) * (box.xmax() - box.xmin());
    const double y = box.ymin() + uniform(random) * (box.ymax() - box.ymin());
    cdt.insert(Point(x, y));
  }
  weft::mark_domain(cdt, pslg);
  return weft::triangle_mesh_2(cdt);
}

planar::Pslg polygon(const std::vector<Point>& corners)
{
  planar::Pslg pslg;
  pslg.points = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) pslg.segments.push_back({i, (i + 1) % corners.size()});
  return pslg;
}

planar::Pslg square_graph(double side)
{
  return polygon({Point(0, 0), Point(side, 0), Point(side, side), Point(0, side)});
}

/// A circle whose vertices are spaced at random.
planar::Pslg rough_circle(int n)
{
  std::mt19937 random(3);
  std::vector<double> turns;
  for (int i = 0; i < n; ++i) turns.push_back((i + 0.7 * uniform(random)) / n);
  std::vector<Point> corners;
  for (const double t : turns) corners.emplace_back(std::cos(2 * M_PI * t), std::sin(2 * M_PI * t));
  return polygon(corners);
}

/// What the tests compare of an edge: its ends in order, and its tag.
using Edge_set = std::set<std::pair<std::pair<Point, Point>, int>>;

Edge_set edges_of(const Mesh& mesh)
{
  Edge_set result;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    result.insert({std::minmax(mesh.points[mesh.edges[e][0]], mesh.points[mesh.edges[e][1]]), mesh.edge_tags[e]});
  return result;
}

std::multiset<std::pair<std::vector<Point>, int>> triangles_of(const Mesh& mesh)
{
  std::multiset<std::pair<std::vector<Point>, int>> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<Point> points;
    for (const std::size_t v : mesh.triangles[t]) points.push_back(mesh.points[v]);
    std::sort(points.begin(), points.end());
    result.emplace(points, mesh.regions[t]);
  }
  return result;
}

std::map<int, double> areas_of(const Mesh& mesh)
{
  std::map<int, double> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    result[mesh.regions[t]] += CGAL::area(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
  }
  return result;
}

bool same(const Mesh& a, const Mesh& b)
{
  return a.points == b.points && a.triangles == b.triangles && a.regions == b.regions && a.edges == b.edges &&
         a.edge_tags == b.edge_tags && a.corners == b.corners;
}

/// Conforming, counterclockwise, with the edges that belong to it, and constrained Delaunay.
void check_valid(const Mesh& mesh)
{
  Soup soup{mesh.points, mesh.triangles, mesh.regions, mesh.edges, mesh.edge_tags, mesh.corners, {}, 0, {}};
  const auto again = weft::assemble_mesh_2(soup);
  CHECK(again.notes.empty());
  CHECK(again.inverted_triangles == 0);
  CHECK(edges_of(again.mesh) == edges_of(mesh));
  Cdt cdt;
  std::size_t faces = 0;
  weft::fill_triangulation_2(cdt, mesh, [&](Cdt::Face_handle f, int) {
    faces += !f->is_in_domain();
    f->set_in_domain(true);
  });
  CHECK(planar::faults(weft::validate_2(cdt)) == "");
  CHECK(faces == mesh.triangles.size());
  CHECK(weft::measure_quality_2(cdt).smallest_angle.degrees ==
        Approx(weft::measure_quality_2(mesh).smallest_angle.degrees).margin(1e-6));
}

/// The domain and its regions are the same.
void check_same_domain(const Mesh& before, const Mesh& after, double tolerance = 1e-9)
{
  const auto a = areas_of(before), b = areas_of(after);
  REQUIRE(a.size() == b.size());
  for (const auto& [region, area] : a) {
    CAPTURE(region);
    CHECK(b.at(region) == Approx(area).epsilon(tolerance));
  }
}

std::string error_of(Soup soup)
{
  try {
    weft::improve_2(weft::assemble_mesh_2(std::move(soup)).mesh);
  } catch (const weft::Domain_error& error) {
    return error.what();
  }
  return "";
}

/// A file that goes with the test case.
class File
{
public:
  explicit File(const std::string& name, const std::string& text = "")
      : name_((std::filesystem::temp_directory_path() / ("weft_improve_2_test_" + name)).string())
  {
    if (!text.empty()) std::ofstream(name_, std::ios::binary) << text;
  }
  ~File() { std::filesystem::remove(name_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& name() const { return name_; }
  std::string text() const
  {
    std::ifstream in(name_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

private:
  std::string name_;
};

std::string error_of(const std::string& filename)
{
  try {
    weft::IO::read_triangle_mesh<K>(filename);
  } catch (const weft::File_error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

} // namespace

// ---- angles and domains

TEST_CASE("a mesh of random vertices becomes a good one of the same domain with about as many vertices")
{
  const auto pslg = polygon({Point(0, 0), Point(3, 0), Point(3, 1), Point(1, 1), Point(1, 2), Point(0, 2)});
  const Mesh mesh = random_mesh(pslg, 600, 7);
  for (const Boundary_2 boundary : both) {
    const auto [result, report] = weft::improve_2(mesh, options_of(boundary));
    CAPTURE(boundary == Boundary_2::fixed, report);
    check_valid(result);
    check_same_domain(mesh, result);
    CHECK(report.before.smallest_angle.degrees < 5);
    CHECK(report.inverted_after == 0);
    CHECK(report.after.smallest_angle.degrees == weft::measure_quality_2(result).smallest_angle.degrees);
    CHECK(result.points.size() <= 1.35 * mesh.points.size());
    CHECK(result.points.size() >= 0.8 * mesh.points.size());
    if (boundary == Boundary_2::fixed) { // each side of the outline is a single edge
      CHECK(edges_of(result) == edges_of(mesh));
      CHECK(report.after.smallest_angle.degrees > report.before.smallest_angle.degrees);
    } else {
      CHECK(report.after.smallest_angle.degrees >= 30);
    }
  }
}

TEST_CASE("the manual's lines improve a mesh from a file and write it")
{
  weft::IO::write_mesh_2("part.msh", grid(8, 6, 0.6));

  const auto input = weft::IO::read_triangle_mesh<K>("part.msh"); // input.notes: what was left out
  const auto [mesh, report] = weft::improve_2(input.mesh);
  std::cout << report; // before and after
  weft::IO::write_mesh_2("better.msh", mesh);

  CHECK(report.after.smallest_angle.degrees > report.before.smallest_angle.degrees);
  const Mesh again = weft::IO::read_triangle_mesh<K>("better.msh").mesh; // Gmsh's files know no corners
  CHECK(again.points == mesh.points);
  CHECK(again.triangles == mesh.triangles);
  std::filesystem::remove("part.msh");
  std::filesystem::remove("better.msh");
}

TEST_CASE("inverted triangles and slivers are mended, with a fixed boundary, too")
{
  for (const double reach : {0.2, 0.6, 1.5})
    for (const Boundary_2 boundary : both) {
      const Mesh mesh = grid(16, 12, reach);
      const auto [result, report] = weft::improve_2(mesh, options_of(boundary));
      CAPTURE(reach, boundary == Boundary_2::fixed, report);
      CHECK((reach < 0.5 || report.inverted_before > 0));
      CHECK(report.ok());
      CHECK(report.after.smallest_angle.degrees >= 35);
      check_valid(result);
      check_same_domain(mesh, result);
      if (boundary == Boundary_2::fixed) {
        CHECK(edges_of(result) == edges_of(mesh));
        for (std::size_t e = 0; e < mesh.edges.size(); ++e) { // in the order that they had
          CHECK(result.points[result.edges[e][0]] == mesh.points[mesh.edges[e][0]]);
          CHECK(result.points[result.edges[e][1]] == mesh.points[mesh.edges[e][1]]);
        }
      }
    }
}

TEST_CASE("no mesh gets worse")
{
  std::vector<Mesh> meshes;
  for (const unsigned seed : {1u, 2u, 3u}) {
    meshes.push_back(grid(5, 4, 0.2 * seed, {}, seed));
    meshes.push_back(random_mesh(square_graph(1), 40, seed));
    meshes.push_back(random_mesh(polygon({Point(0, 0), Point(10, 0), Point(0, 0.3)}), 30, seed)); // sharp corners
    meshes.push_back(random_mesh(rough_circle(24), 60, seed));
  }
  meshes.push_back(grid(1, 1, 0));
  meshes.push_back(
      weft::assemble_mesh_2(std::vector<Point>{Point(0, 0), Point(1, 0), Point(0.5, std::sqrt(0.75))}, {{0, 1, 2}})
          .mesh);
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (const Boundary_2 boundary : both)
      for (const double min_angle : {20., 60.}) {
        Options options = options_of(boundary);
        options.min_angle = min_angle;
        const auto [result, report] = weft::improve_2(meshes[i], options);
        CAPTURE(i, boundary == Boundary_2::fixed, min_angle, report);
        const weft::Quality_2 before = weft::measure_quality_2(meshes[i]), after = weft::measure_quality_2(result);
        CHECK(report.inverted_after <= report.inverted_before);
        if (report.inverted_after == report.inverted_before)
          CHECK(after.smallest_angle.degrees >= before.smallest_angle.degrees - 1e-9);
        CHECK(after.area == Approx(before.area).epsilon(0.03)); // curves may be respaced
      }
}

TEST_CASE("an angle of the input is the bound, and is reported")
{
  const Mesh mesh = random_mesh(polygon({Point(0, 0), Point(4, 0), Point(4, 1)}), 80, 1);
  const auto [result, report] = weft::improve_2(mesh);
  const double angle = std::atan(0.25) * 180 / M_PI;
  CAPTURE(report);
  CHECK(report.input_bound == Approx(angle));
  CHECK(report.after.smallest_angle.degrees == Approx(angle));
  CHECK(report.at_input_angle > 0);
}

TEST_CASE("curves with badly spaced vertices are respaced within the deviation, or stay to the last bit")
{
  const Mesh mesh = random_mesh(rough_circle(60), 250, 4);
  const auto [result, report] = weft::improve_2(mesh);
  CAPTURE(report);
  check_valid(result);
  CHECK(report.after.smallest_angle.degrees >= 35);
  CHECK(report.after.area == Approx(report.before.area).epsilon(0.01));
  for (const auto& e : result.edges)
    CHECK(std::hypot(result.points[e[0]].x(), result.points[e[0]].y()) == Approx(1).epsilon(0.005));
  Options exact;
  exact.corner_angle = 0;
  const auto kept = weft::improve_2(mesh, exact);
  check_same_domain(mesh, kept.mesh, 1e-12);
  std::set<Point> points(kept.mesh.points.begin(), kept.mesh.points.end());
  for (const auto& e : mesh.edges) CHECK(points.count(mesh.points[e[0]]) == 1);
}

TEST_CASE("regions, the edges between them and tags stay")
{
  const auto region = [](int x, int y) { return x >= 4 && x < 9 && y >= 3 && y < 8 ? 7 : -2; };
  Mesh mesh = grid(14, 12, 0.45, region);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) // the bottom has a tag of its own
    if (mesh.points[mesh.edges[e][0]].y() == 0 && mesh.points[mesh.edges[e][1]].y() == 0) mesh.edge_tags[e] = 5;
  for (const Boundary_2 boundary : both) {
    const auto [result, report] = weft::improve_2(mesh, options_of(boundary));
    CAPTURE(boundary == Boundary_2::fixed, report);
    check_valid(result);
    check_same_domain(mesh, result);
    CHECK(report.after.smallest_angle.degrees >= 35);
    double bottom = 0;
    for (std::size_t e = 0; e < result.edges.size(); ++e) {
      const Point &a = result.points[result.edges[e][0]], &b = result.points[result.edges[e][1]];
      if (result.edge_tags[e] == 5) bottom += std::abs(b.x() - a.x());
      CHECK((result.edge_tags[e] == 5) == (a.y() == 0 && b.y() == 0));
    }
    CHECK(bottom == Approx(14));
    if (boundary == Boundary_2::fixed) CHECK(edges_of(result) == edges_of(mesh));
  }
}

TEST_CASE("holes and parts that touch at a point stay")
{
  const auto region = [](int x, int y) {
    if (x >= 3 && x < 6 && y >= 3 && y < 6) return 0;          // a hole
    return (x < 10 && y < 10) || (x >= 10 && y >= 10) ? 1 : 0; // two squares that share a corner
  };
  const Mesh mesh = grid(16, 16, 0.4, region);
  for (const Boundary_2 boundary : both) {
    const auto [result, report] = weft::improve_2(mesh, options_of(boundary));
    CAPTURE(boundary == Boundary_2::fixed, report);
    check_valid(result);
    check_same_domain(mesh, result);
    CHECK(report.after.smallest_angle.degrees >= 35);
  }
}

TEST_CASE("edges inside that are listed, corners and fixed vertices stay")
{
  Soup soup;
  {
    const Mesh mesh = grid(10, 10, 0);
    soup.points = mesh.points;
    soup.triangles = mesh.triangles;
    for (std::size_t i = 0; i < 4; ++i) { // a line from (3, 5) to (7, 5), which ends inside
      soup.edges.push_back({5 * 11 + 3 + i, 5 * 11 + 4 + i});
      soup.edge_tags.push_back(9);
    }
    soup.corners = {2 * 11 + 4};
  }
  const Mesh mesh = weft::assemble_mesh_2(soup).mesh;
  for (const Boundary_2 boundary : both) {
    Options options = options_of(boundary);
    options.fixed_vertices = {8 * 11 + 3, 4}; // inside, and on the bottom
    const auto [result, report] = weft::improve_2(mesh, options);
    check_valid(result);
    const std::set<Point> points(result.points.begin(), result.points.end());
    for (const Point& p : {Point(4, 2), Point(3, 8), Point(4, 0), Point(3, 5), Point(7, 5)})
      CHECK(points.count(p) == 1);
    REQUIRE(result.corners.size() == 1);
    CHECK(result.points[result.corners[0]] == Point(4, 2));
    double length = 0;
    for (std::size_t e = 0; e < result.edges.size(); ++e)
      if (result.edge_tags[e] == 9)
        length += std::abs(result.points[result.edges[e][1]].x() - result.points[result.edges[e][0]].x());
    CHECK(length == Approx(4));
  }
}

TEST_CASE("angles and counts hardly depend on where and how large the mesh is")
{
  const Mesh mesh = random_mesh(rough_circle(40), 200, 9);
  const auto reference = weft::improve_2(mesh);
  for (const double scale : {1e-20, 1., 1e15})
    for (const double turn : {0., 0.7}) {
      Mesh moved = mesh;
      for (Point& p : moved.points)
        p = Point(scale * (std::cos(turn) * p.x() - std::sin(turn) * p.y() + 3),
                  scale * (std::sin(turn) * p.x() + std::cos(turn) * p.y() - 2));
      const auto [result, report] = weft::improve_2(moved);
      CAPTURE(scale, turn, report);
      check_valid(result);
      CHECK(report.after.smallest_angle.degrees >= 35);
      CHECK(static_cast<double>(result.points.size()) ==
            Approx(static_cast<double>(reference.mesh.points.size())).epsilon(0.05));
    }
}

TEST_CASE("the result is the same for any number of threads and wherever memory lies")
{
  const Mesh mesh = random_mesh(rough_circle(50), 400, 2);
  for (const Boundary_2 boundary : both) {
    Options options = options_of(boundary);
    options.min_angle = 40; // some work for every step
    const Mesh reference = weft::improve_2(mesh, options).mesh;
    for (const int threads : {1, 4}) {
      const planar::Memory_noise noise(static_cast<unsigned>(threads));
      options.threads = threads;
      CHECK(same(weft::improve_2(mesh, options).mesh, reference));
    }
  }
}

TEST_CASE("a run that is stopped has a valid mesh that isn't worse")
{
  const Mesh mesh = random_mesh(square_graph(1), 300, 5);
  Options options;
  options.time_limit = 0;
  const auto late = weft::improve_2(mesh, options);
  CHECK(late.report.stop_reason == weft::Stop_reason::time_limit);
  int calls = 0;
  options = Options();
  options.visitor = [&calls](const weft::Progress&) { return ++calls < 5; };
  const auto cancelled = weft::improve_2(mesh, options);
  CHECK(cancelled.report.stop_reason == weft::Stop_reason::cancelled);
  for (const auto& [result, report] : {late, cancelled}) {
    CHECK(report.after.smallest_angle.degrees >= report.before.smallest_angle.degrees - 1e-9);
    check_valid(result);
  }
}

// ---- what isn't a mesh

TEST_CASE("what isn't a mesh is refused with the elements to blame")
{
  Soup good;
  good.points = {Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1), Point(2, 0.5)};
  good.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  CHECK(error_of(good) == "");
  const auto with = [&good](const auto& change) {
    Soup soup = good;
    change(soup);
    return error_of(std::move(soup));
  };
  CHECK(contains(with([](Soup& s) { s.triangles.clear(); }), "there are no triangles"));
  CHECK(contains(with([](Soup& s) { s.triangles.push_back({2, 0, 1}); }), "is there twice"));
  CHECK(contains(with([](Soup& s) { s.triangles[1] = {0, 2, 2}; }), "has a vertex twice"));
  CHECK(contains(with([](Soup& s) { s.triangles[1] = {0, 2, 9}; }), "triangle 1 has the vertex 9"));
  CHECK(contains(with([](Soup& s) {
                   s.triangles.push_back({1, 2, 3});
                 }),
                 "edge with the vertices 1 2 has 3 triangles"));
  CHECK(contains(with([](Soup& s) { s.points[4] = Point(std::nan(""), 0); }), "vertex 4 has coordinates"));
  CHECK(contains(with([](Soup& s) { s.points[4] = Point(0, std::numeric_limits<double>::infinity()); }), "vertex 4"));
  CHECK(contains(with([](Soup& s) { s.points[4] = s.points[3]; }), "at the same place"));
  CHECK(contains(with([](Soup& s) { s.triangle_tags = {1}; }), "1 tag of them"));
  CHECK(contains(with([](Soup& s) { s.corners = {7}; }), "there is no vertex 7"));
  CHECK(contains(with([](Soup& s) { s.points[4] = Point(-1, 0.5); }), "crosses or overlaps"));
  CHECK(contains(with([](Soup& s) { // a small triangle on a large one
                   s.points = {Point(0, 0), Point(9, 0), Point(0, 9), Point(1, 1), Point(2, 1), Point(1, 2)};
                   s.triangles = {{0, 1, 2}, {3, 4, 5}};
                 }),
                 "lie on each other"));
  Mesh broken = weft::assemble_mesh_2(good).mesh;
  broken.edges.pop_back();
  broken.edge_tags.pop_back();
  CHECK_THROWS_AS(weft::improve_2(broken), weft::Domain_error);
  Options options;
  options.fixed_vertices = {99};
  CHECK_THROWS_AS(weft::improve_2(weft::assemble_mesh_2(good).mesh, options), weft::Option_error);
  options = Options();
  options.min_angle = 61;
  CHECK_THROWS_AS(weft::improve_2(weft::assemble_mesh_2(good).mesh, options), weft::Option_error);
}

TEST_CASE("what doesn't matter is left out and noted, and triangles without area are mended")
{
  Soup soup;
  soup.points = {Point(0, 0), Point(2, 0), Point(2, 2), Point(0, 2), Point(1, 0), Point(7, 7)};
  soup.triangles = {{0, 1, 4}, {0, 4, 3}, {2, 4, 1}, {2, 4, 3}}; // the first is flat, the last clockwise
  soup.edges = {{0, 5}, {0, 1}, {1, 0}};
  const auto imported = weft::assemble_mesh_2(soup);
  CHECK(imported.inverted_triangles == 1);
  CHECK(imported.notes.size() == 3);
  CHECK(imported.mesh.points.size() == 5);
  for (const Boundary_2 boundary : both) {
    const auto [result, report] = weft::improve_2(imported.mesh, options_of(boundary));
    CAPTURE(report);
    CHECK(report.inverted_before == 1);
    CHECK(report.inverted_after == 0);
    check_valid(result);
    CHECK(report.after.area == Approx(4));
  }
}

// ---- files and triangulations

TEST_CASE("meshes come back from files as they were written")
{
  const auto region = [](int x, int) { return x < 3 ? 4 : 6; };
  Mesh mesh = grid(6, 4, 0.3, region);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) mesh.edge_tags[e] = static_cast<int>(2 + e % 3);
  mesh.corners = {8, 20};
  for (const std::string type : {"msh", "mesh", "vtu", "off"}) {
    const File file("round." + type);
    weft::IO::write_mesh_2(file.name(), mesh);
    const auto read = weft::IO::read_triangle_mesh<K>(file.name());
    CAPTURE(type, read.notes);
    if (type == "off") { // has no room for tags
      CHECK(read.mesh.triangles.size() == mesh.triangles.size());
    } else {
      CHECK(triangles_of(read.mesh) == triangles_of(mesh));
      CHECK(edges_of(read.mesh) == edges_of(mesh));
      if (type == "mesh") CHECK(read.mesh.corners.size() == 2); // the others have no place for them
    }
    const std::string text = file.text();
    for (std::size_t part = 1; part < 20; ++part) { // cut anywhere
      const File cut("cut." + type, text.substr(0, text.size() * part / 20));
      CAPTURE(part);
      CHECK(error_of(cut.name()) != "");
    }
  }
}

TEST_CASE("Triangle's files are read, with segments from a .poly or an .edge file")
{
  const File nodes("t.node", "4 2 1 1\n1 0 0 0.5 1\n2 1 0 0.5 1\n3 1 1 0.5 1\n4 0 1 0.5 1\n");
  const File triangles("t.ele", "2 3 1\n1 1 2 3 8\n2 1 3 4 8\n");
  CHECK(weft::IO::read_triangle_mesh<K>(triangles.name()).mesh.edges.size() == 4);
  {
    const File edges("t.edge", "5 1\n1 1 2 3\n2 2 3 3\n3 3 4 3\n4 4 1 3\n5 1 3 0\n");
    const Mesh mesh = weft::IO::read_triangle_mesh<K>(nodes.name()).mesh;
    CHECK(mesh.regions == std::vector<int>{8, 8});
    CHECK(mesh.edges.size() == 4);
    CHECK(mesh.edge_tags == std::vector<int>(4, 3));
  }
  const File graph("t.poly", "0 2 0 1\n5 1\n1 1 2 3\n2 2 3 3\n3 3 4 3\n4 4 1 3\n5 1 3 2\n0\n");
  CHECK(weft::IO::read_triangle_mesh<K>(triangles.name()).mesh.edges.size() == 5);
}

TEST_CASE("files that hold no planar triangle mesh are refused")
{
  const auto error = [](const std::string& name, const std::string& text) {
    const File file(name, text);
    return error_of(file.name());
  };
  CHECK(contains(error_of("missing.msh"), "can't be opened"));
  CHECK(contains(error("a.stl", "solid"), "unknown extension"));
  CHECK(contains(error("q.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), "has 4 corners"));
  CHECK(contains(error("z.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1\n3 0 1 2\n"), "isn't planar: vertices 0 and 2"));
  CHECK(contains(error("q.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                 "Quadrilaterals\n1\n1 2 3 4 0\nEnd\n"),
                 "there are Quadrilaterals"));
  CHECK(
      contains(error("t.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 0 1 0\n"
                               "Tetrahedra\n1\n1 2 3 4 0\nEnd\n"),
               "tetrahedra: the mesh isn't planar"));
  CHECK(contains(error("n.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 nan 0\n1 1 0\n"
                                 "Triangles\n1\n1 2 3 0\nEnd\n"),
                 ":6: "));
}

TEST_CASE("triangulations of CGAL become meshes, and meshes triangulations")
{
  Cdt cdt = planar::triangulate(square_graph(1));
  cdt.insert(Point(0.5, 0.25));
  weft::mark_domain_by_parity(cdt);
  const Mesh mesh = weft::triangle_mesh_2(cdt);
  CHECK(mesh.triangles.size() == 4);
  CHECK(mesh.edges.size() == 4);
  Cdt again;
  std::size_t faces = 0;
  weft::fill_triangulation_2(again, mesh, [&](Cdt::Face_handle, int tag) { faces += tag == 1; });
  CHECK(faces == 4);
  CHECK_THROWS_AS(weft::fill_triangulation_2(again, mesh, [](Cdt::Face_handle, int) {}), weft::Option_error);
  CHECK_THROWS_AS(weft::triangle_mesh_2(Cdt()), weft::Domain_error);
}
