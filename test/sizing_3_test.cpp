// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the sizing fields in space: gradation against its definition, backgrounds and grids against linear
// functions, features against known thicknesses, and files of sizes.

#include "fixtures/spatial_fixtures.h"
#include "fixtures/surface_fixtures.h"

#include <weft/errors.h>
#include <weft/IO/read_sizing_3.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/IO/write_solution_3.h>
#include <weft/sizing/Combined_sizing.h>
#include <weft/sizing/Grid_sizing.h>
#include <weft/sizing/Lipschitz_sizing_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/sizing/Background_sizing_3.h>
#include <weft/spatial/sizing/Feature_sizing_3.h>
#include <weft/spatial/sizing/grade_criteria_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <CGAL/Delaunay_triangulation_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using fixtures::K;
using Point = K::Point_3;
using Lipschitz = weft::Lipschitz_sizing_3<K>;
using Background = weft::Background_sizing_3<K>;
using Oracle = weft::Polyhedral_oracle_3<K>;

const CGAL::Bbox_3 box(0, 0, 0, 1, 2, 0.7);

double distance(const Point& p, const Point& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

class Random_points
{
public:
  double number(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  Point in_box(double beyond = 0)
  {
    const double x = number(-beyond, 1 + beyond), y = number(-beyond, 2 + beyond), z = number(-beyond, 0.7 + beyond);
    return Point(x, y, z);
  }
  Point near(const Point& p, double reach)
  {
    const double x = number(-reach, reach), y = number(-reach, reach), z = number(-reach, reach);
    return Point(p.x() + x, p.y() + y, p.z() + z);
  }

private:
  std::mt19937 random_{7};
};

/// Pairs of points near and far, some outside of the box: none may have sizes that differ by more than k times the
/// distance.
void check_gradation(const Lipschitz& field, double k)
{
  Random_points random;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point p = random.in_box(0.1), q = i % 2 == 0 ? random.in_box(0.1) : random.near(p, i % 3 == 0 ? 0.001 : 0.03);
    worst = std::max(worst, std::abs(field(p) - field(q)) / distance(p, q));
  }
  CHECK(worst <= k * (1 + 1e-9) + 1e-12);
  CHECK(field.max_gradient() <= k * (1 + 1e-9));
  CHECK(worst >= 0.5 * k); // it does grow
}

Oracle oracle_of(const surfaces::Surface& surface)
{
  return Oracle(weft::piecewise_smooth_complex(surface.points, surface.triangles, weft::Feature_options(60)));
}

double one(const Point&)
{
  return 1;
}

} // namespace

TEST_CASE("sizes at points spread by at most k, above no source and near the largest such field")
{
  const double k = GENERATE(0.1, 0.3, 1.0);
  CAPTURE(k);
  Random_points random;
  std::vector<Lipschitz::Source> sources;
  for (int i = 0; i < 30; ++i) sources.push_back({random.in_box(), random.number(0.03, 0.1)});
  weft::Gradation_options_3 options;
  options.max_size = 0.5;
  const Lipschitz field(sources, box, k, options);
  check_gradation(field, k);
  for (const auto& s : sources) CHECK(field(s.point) <= s.size * (1 + 1e-9));
  double mean = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    const Point p = random.in_box();
    double exact = 0.5;
    for (const auto& s : sources) exact = std::min(exact, s.size + k * distance(p, s.point));
    REQUIRE(field(p) <= exact * (1 + 1e-6));
    mean += field(p) / exact / samples;
  }
  CHECK(mean > 0.65);
  CHECK(field.smallest() > 0);
}

TEST_CASE("a field that jumps is graded, and one that grows slowly stays as it is")
{
  const auto jump = [](const Point& p) { return p.x() < 0.3 ? 0.05 : 0.3; };
  check_gradation(Lipschitz(jump, box, 0.4), 0.4);
  CHECK(Lipschitz(jump, box, 0.4)(Point(0.1, 1, 0.3)) == Approx(0.05).epsilon(0.02));
  const auto slow = [](const Point& p) { return 0.05 + 0.1 * p.x() + 0.05 * p.y(); };
  const Lipschitz field(slow, box, 0.5);
  Random_points random;
  for (int i = 0; i < 1000; ++i) {
    const Point p = random.in_box();
    REQUIRE(field(p) == Approx(slow(p)).epsilon(1e-9));
  }
}

TEST_CASE("without growth the field is the smallest size everywhere")
{
  const Lipschitz field({{Point(0.5, 0.5, 0.5), 0.1}, {Point(0.1, 1.5, 0.5), 0.2}}, box, 0);
  CHECK(field(Point(0, 2, 0)) == 0.1);
  CHECK(field(Point(-9, 2, 0)) == 0.1);
}

TEST_CASE("gradation refuses what makes no field")
{
  CHECK_THROWS_AS(Lipschitz(one, box, -1), weft::Option_error);
  CHECK_THROWS_AS(Lipschitz(one, box, std::nan("")), weft::Option_error);
  CHECK_THROWS_AS(Lipschitz([](const Point&) { return 0.; }, box, 1), weft::Option_error);
  CHECK_THROWS_AS(Lipschitz(std::vector<Lipschitz::Source>(), box, 1), weft::Option_error);
  CHECK_THROWS_AS(Lipschitz({{Point(0, 0, 0), -1}}, box, 1), weft::Option_error);
  CHECK_THROWS_AS(Lipschitz(one, CGAL::Bbox_3(0, 0, 0, 0, 0, 0), 1), weft::Option_error);
  weft::Gradation_options_3 options;
  options.min_size = 2, options.max_size = 1;
  CHECK_THROWS_AS(Lipschitz(one, box, 1, options), weft::Option_error);
}

TEST_CASE("a background mesh gives linear functions back, and outside the value at the nearest point")
{
  const auto linear = [](const Point& p) { return 1 + p.x() + 2 * p.y() + 3 * p.z(); };
  Random_points random;
  CGAL::Delaunay_triangulation_3<K> triangulation;
  for (int x = 0; x <= 1; ++x)
    for (int y = 0; y <= 1; ++y)
      for (int z = 0; z <= 1; ++z) triangulation.insert(Point(x, y, z));
  for (int i = 0; i < 300; ++i) {
    const double x = random.number(0, 1), y = random.number(0, 1), z = random.number(0, 1);
    triangulation.insert(Point(x, y, z));
  }
  const Background field(triangulation, [&](auto v) { return linear(v->point()); });
  for (int i = 0; i < 1000; ++i) {
    const double x = random.number(-1, 2), y = random.number(-1, 2), z = random.number(-1, 2);
    const auto clamped = [](double t) { return std::min(1., std::max(0., t)); };
    REQUIRE(field(Point(x, y, z)) == Approx(linear(Point(clamped(x), clamped(y), clamped(z)))).epsilon(1e-9));
  }
  CHECK_THROWS_AS(Background({Point(0, 0, 0)}, {}, {1.}), weft::Domain_error);
  const auto cell = fixtures::single_cell(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1));
  CHECK_THROWS_AS(Background(cell, {1, 1, 1}), weft::Option_error);
  CHECK_THROWS_AS(Background(cell, {1, 1, 1, 0}), weft::Option_error);
}

TEST_CASE("grids give linear functions back in both dimensions")
{
  std::vector<double> values;
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) values.push_back(1 + 0.5 * x + y + 2 * z);
  const weft::Grid_sizing_3 field({5, 3, 4}, {0.5, 1, 2}, {10, 0, 0}, values); // 1 + (x - 10) + y + z
  CHECK(field(Point(10.7, 1.3, 2.9)) == Approx(1 + 0.7 + 1.3 + 2.9));
  CHECK(field(Point(-5, 9, 2.9)) == Approx(1 + 0 + 2 + 2.9));
  const weft::Grid_sizing_2 flat({2, 2}, {1, 1}, {0, 0}, {1, 2, 3, 4});
  CHECK(flat(K::Point_2(0.25, 0.5)) == Approx(2.25));
  CHECK(weft::Grid_sizing_2({1, 1}, {1, 1}, {0, 0}, {7})(K::Point_2(3, 4)) == 7);
  CHECK_THROWS_AS(weft::Grid_sizing_2({2, 2}, {1, 1}, {0, 0}, {1, 2, 3}), weft::Option_error);
  CHECK_THROWS_AS(weft::Grid_sizing_2({2, 1}, {1, 1}, {0, 0}, {1, -2}), weft::Option_error);

  CHECK(weft::least_sizing(field, one)(Point(10, 1, 1)) == 1);
  CHECK(weft::greatest_sizing(field, one)(Point(10, 1, 1)) == Approx(3));
}

TEST_CASE("features are thicknesses and gaps, not edges")
{
  const auto size_at = [](const surfaces::Surface& surface, const Point& p, double cells) {
    weft::Feature_sizing_options_3 options;
    options.cells = cells;
    options.max_size = 1;
    return weft::Feature_sizing_3<K>(oracle_of(surface), 0.5, options)(p);
  };
  const auto plate = surfaces::box(8, 8, 1);              // unit cubes
  CHECK(size_at(plate, Point(4, 4, 1), 2) <= 0.5 + 0.05); // half a step between samples, and k
  CHECK(size_at(plate, Point(4, 4, 1), 2) >= 0.35);
  CHECK(size_at(plate, Point(4, 4, 0), 4) <= 0.25 + 0.05);
  CHECK(size_at(plate, Point(4, 4, 0), 4) >= 0.15);
  const auto cube = surfaces::box(4, 4, 4);
  CHECK(size_at(cube, Point(0, 0, 0), 2) >= 0.9); // its edges and corners ask for nothing
  const auto two = surfaces::together(surfaces::box(4, 4, 4), surfaces::moved(surfaces::box(4, 4, 4), 1, 4.5, 0, 0));
  CHECK(size_at(two, Point(4, 2, 2), 2) <= 0.25 + 0.05); // half of the gap
}

TEST_CASE("sizes of subdomains, patches and creases grade")
{
  const Oracle oracle = oracle_of(surfaces::box(4, 4, 4));
  weft::Criteria_3<K> criteria;
  criteria.size = 1;
  criteria.crease_size = 0.2;
  const auto graded = weft::grade_criteria_3(oracle, criteria, 0.4);
  CHECK(graded.size(Point(0, 2, 0)) <= 0.2 * (1 + 1e-9));
  CHECK(graded.size(Point(2, 2, 2)) > 0.6);
  criteria.crease_size = 0;
  const int patch = oracle.closest(Point(2, 2, 0)).patch;
  criteria.patches[patch].size = 0.25;
  const auto by_patch = weft::grade_criteria_3(oracle, criteria, 0.4);
  CHECK(by_patch.size(Point(2, 2, 0)) <= 0.3);
  CHECK(by_patch.size(Point(2, 2, 4)) > 0.8);
  criteria.patches.clear();
  criteria.subdomains[1].size = 0.3;
  CHECK(weft::grade_criteria_3(oracle, criteria, 0.4).size(Point(2, 2, 2)) == Approx(0.3));
}

TEST_CASE("files of sizes are read")
{
  const auto mesh = fixtures::single_cell(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1));
  const auto check = [](const auto& field) {
    CHECK(field(Point(0.25, 0.25, 0.25)) == Approx(0.25 * (0.5 + 1 + 2 + 4)));
    CHECK(field(Point(2, 0, 0)) == Approx(1));
  };
  weft::IO::write_mesh_3("sizes.mesh", mesh);
  const auto order = [&](std::size_t v) { // sizes belong to places: the writer may number anew
    const Point& p = mesh.points[v];
    return p.x() > 0 ? 1. : p.y() > 0 ? 2. : p.z() > 0 ? 4. : 0.5;
  };
  std::ofstream sol("sizes.sol");
  sol << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 1\n";
  for (std::size_t v = 0; v < 4; ++v) sol << order(v) << "\n";
  sol << "End\n";
  sol.close();
  check(weft::IO::read_sizing_3<K>("sizes.mesh"));
  check(weft::IO::read_sizing_3<K>("sizes.sol"));

  std::ofstream("sizes.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
         "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n$NodeData\n1\n\"size\"\n1\n0\n"
         "3\n0\n1\n4\n1 0.5\n3 2\n2 1\n4 4\n$EndNodeData\n";
  check(weft::IO::read_sizing_3<K>("sizes.msh"));
  CHECK_THROWS_AS(weft::IO::read_sizing_3<K>("sizes.msh", "other"), weft::File_error);

  std::ofstream("sizes.vtu")
      << "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>\n<DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray>\n</Points>\n<Cells>\n"
         "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>\n</Cells>\n<PointData>\n"
         "<DataArray type=\"Float64\" Name=\"h\" format=\"ascii\">0.5 1 2 4</DataArray>\n</PointData>\n"
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  check(weft::IO::read_sizing_3<K>("sizes.vtu"));
  CHECK_THROWS_AS(weft::IO::read_sizing_3<K>("sizes.vtu", "size"), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_sizing_3<K>("missing.mesh"), weft::File_error);
}

TEST_CASE("solutions that are written read back to the last bit")
{
  const auto mesh = fixtures::box(2).mesh;
  Random_points random;
  weft::Mesh_solution_3 solution;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) solution.at_vertices["heat"].push_back(random.number(0.1, 1));
  solution.in_cells["error"].assign(mesh.cells.size(), 0.25);
  for (const std::string name : {"heat.vtu", "heat.msh", "heat.mesh"}) {
    CAPTURE(name);
    weft::IO::write_solution_3(name, mesh, solution);
    CHECK(weft::IO::read_solution(name) == solution.at_vertices["heat"]);
    CHECK(weft::IO::read_tetrahedral_mesh<K>(name).mesh.cells == mesh.cells);
  }
  CHECK(weft::IO::read_solution("heat.vtu", "heat") == solution.at_vertices["heat"]);
  CHECK_THROWS_AS(weft::IO::write_solution_3("heat.off", mesh, solution), weft::File_error);
  solution.at_vertices["heat"].pop_back();
  CHECK_THROWS_AS(weft::IO::write_solution_3("heat.vtu", mesh, solution), weft::Option_error);
}
