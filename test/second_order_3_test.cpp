// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of second order: nodes on the boundary, no inverted cell, and what files hold of them.

#include "fixtures/domains_3.h"
#include "fixtures/meshing_fixtures_3.h"

#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/spatial/domain/raise_order_3.h>
#include <weft/spatial/mesh/scaled_jacobian_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using domains::Implicit;
using meshing::K;
using meshing::Mesh;
using meshing::Point;
using weft::internal::Xyz_3;
using Quadratic = weft::Quadratic_mesh_3<K>;

double ball(const Point& p)
{
  return p.x() * p.x() + p.y() * p.y() + p.z() * p.z() - 1;
}

const Implicit& ball_oracle()
{
  static const Implicit oracle(domains::Function(ball), CGAL::Bbox_3(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1));
  return oracle;
}

const Mesh& ball_mesh()
{
  static const Mesh mesh = [] {
    weft::Criteria_3<K> criteria;
    criteria.size = 0.5;
    criteria.approximation = 0.05;
    return weft::tetrahedral_mesh(weft::make_mesh_3(ball_oracle(), criteria).restricted);
  }();
  return mesh;
}

double radius(const Xyz_3& p)
{
  return std::hypot(p[0], p[1], p[2]);
}

/// A point of a facet of second order.
Xyz_3 on_facet(const Quadratic& mesh, std::size_t f, double a, double b)
{
  const double c = 1 - a - b;
  const std::array<double, 6> weights{c * (2 * c - 1), a * (2 * a - 1), b * (2 * b - 1),
                                      4 * c * a,       4 * a * b,       4 * b * c};
  const auto nodes = mesh.facet(f);
  Xyz_3 p{};
  for (std::size_t i = 0; i < 6; ++i) {
    const Xyz_3 x = weft::internal::xyz(mesh.node(nodes[i]));
    for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * x[k];
  }
  return p;
}

double farthest_from_sphere(const Quadratic& mesh)
{
  double farthest = 0;
  constexpr int n = 12;
  for (std::size_t f = 0; f < mesh.vertices.facets.size(); ++f)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        farthest = std::max(farthest, std::abs(radius(on_facet(mesh, f, double(i) / n, double(j) / n)) - 1));
  return farthest;
}

/// The Jacobian determinant of a cell of second order, by the derivatives of its shape functions.
double jacobian(const std::array<Xyz_3, 10>& x, const std::array<double, 4>& l)
{
  std::array<Xyz_3, 4> by_corner{}; // derivatives by barycentric coordinates
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) by_corner[i][k] += (4 * l[i] - 1) * x[i][k];
  const std::array<std::array<std::size_t, 2>, 6> ends{{{{0, 1}}, {{1, 2}}, {{0, 2}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};
  for (std::size_t e = 0; e < 6; ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      by_corner[ends[e][0]][k] += 4 * l[ends[e][1]] * x[4 + e][k];
      by_corner[ends[e][1]][k] += 4 * l[ends[e][0]] * x[4 + e][k];
    }
  using weft::internal::minus;
  const Xyz_3 a = minus(by_corner[1], by_corner[0]), b = minus(by_corner[2], by_corner[0]),
              c = minus(by_corner[3], by_corner[0]);
  return weft::internal::dot_product(a, weft::internal::cross_product(b, c));
}

/// An oracle whose boundary is far from where the mesh is.
struct Far_oracle
{
  using Kernel = K;
  std::mt19937* random;

  weft::Surface_hit_3<K> project_on_patch(const Point& p, int patch) const
  {
    std::uniform_real_distribution<double> step(-0.7, 0.7);
    const double x = step(*random), y = step(*random), z = step(*random);
    return {Point(p.x() + x, p.y() + y, p.z() + z), patch};
  }
  Point project_on_crease(const Point& p, int) const { return p; }
};

std::string content(const std::string& filename)
{
  std::ifstream in(filename, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

} // namespace

TEST_CASE("the scaled Jacobian bounds what determinants of random cells are")
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> step(-0.25, 0.25), unit(0, 1);
  int positive = 0, tight = 0;
  for (int run = 0; run < 400; ++run) {
    std::array<Xyz_3, 10> x{{{{{0, 0, 0}}}, {{{1, 0, 0}}}, {{{0, 1, 0}}}, {{{0, 0, 1}}}}};
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = weft::internal::edges_of_cell[e];
      for (std::size_t k = 0; k < 3; ++k) x[4 + e][k] = (x[i][k] + x[j][k]) / 2 + (run % 5) / 4. * step(random);
    }
    const double bound = weft::internal::scaled_jacobian(x);
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (int k = 0; k < 2000; ++k) {
      std::array<double, 4> l;
      double sum = 0;
      for (double& t : l) sum += t = k < 4 ? (&t - l.data() == k) : -std::log(1 - unit(random));
      for (double& t : l) t /= sum;
      const double determinant = jacobian(x, l);
      least = std::min(least, determinant), greatest = std::max(greatest, determinant);
    }
    if (run % 5 == 0) CHECK(bound == Approx(1).epsilon(1e-12));
    if (greatest <= 0) continue;
    if (bound > 0) {
      ++positive;
      CHECK(least > 0);
      CHECK(bound <= least / greatest + 1e-9);
      tight += bound > 0.5 * least / greatest;
    }
  }
  CHECK(positive > 200);
  CHECK(2 * tight > positive); // it isn't far below
}

TEST_CASE("middle nodes lie on the boundary and bring facets closer to it")
{
  const Mesh& mesh = ball_mesh();
  const auto straight = weft::raise_order_3(mesh);
  CHECK(straight.curved_edges == 0);
  CHECK(straight.smallest_scaled_jacobian == Approx(1).epsilon(1e-9));
  const auto raised = weft::raise_order_3(mesh, ball_oracle());
  const Quadratic& q = raised.mesh;
  CHECK(raised.straightened_edges == 0);
  CHECK(raised.smallest_scaled_jacobian >= 0.3);

  // One node on each edge of the mesh, shared by all elements there.
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> node_of;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = weft::internal::edges_of_cell[e];
      const auto ends = std::minmax(mesh.cells[c][i], mesh.cells[c][j]);
      CHECK(node_of.try_emplace(ends, q.cell_middles[c][e]).first->second == q.cell_middles[c][e]);
    }
  CHECK(node_of.size() == q.middles.size());
  std::set<std::size_t> on_boundary;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto ends = std::minmax(mesh.facets[f][i], mesh.facets[f][(i + 1) % 3]);
      CHECK(node_of.at(ends) == q.facet_middles[f][i]);
      on_boundary.insert(q.facet_middles[f][i]);
    }
  CHECK(on_boundary.size() == raised.curved_edges);
  for (const std::size_t node : on_boundary) CHECK(radius(weft::internal::xyz(q.node(node))) == Approx(1).margin(1e-6));
  for (const auto& [ends, node] : node_of)
    if (on_boundary.count(node) == 0)
      CHECK(q.node(node) == CGAL::midpoint(mesh.points[ends.first], mesh.points[ends.second]));
  const double curved = farthest_from_sphere(q), flat = farthest_from_sphere(straight.mesh);
  INFO(flat / curved);
  CHECK(8 * curved < flat);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    CHECK(weft::scaled_jacobian_3(q, c) >= raised.smallest_scaled_jacobian);
}

TEST_CASE("edges are bent less where cells would be inverted")
{
  const Mesh& mesh = ball_mesh();
  for (const double least : {0., 0.3, 0.9}) {
    std::mt19937 random(5);
    const auto raised = weft::raise_order_3(mesh, Far_oracle{&random}, least);
    CHECK(raised.straightened_edges > 0);
    CHECK(raised.smallest_scaled_jacobian >= least);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) CHECK(weft::scaled_jacobian_3(raised.mesh, c) >= least);
  }
  CHECK_THROWS_AS(weft::raise_order_3(mesh, ball_oracle(), 1.5), weft::Option_error);
}

TEST_CASE("vtu files of all encodings hold the same mesh")
{
  const Mesh& mesh = ball_mesh();
  std::size_t size = 0;
  for (const auto encoding : {weft::Vtu_encoding::ascii, weft::Vtu_encoding::binary, weft::Vtu_encoding::compressed}) {
    weft::IO::write_vtu("order.vtu", mesh, {}, {}, encoding);
    const auto read = weft::IO::read_tetrahedral_mesh<K>("order.vtu");
    CHECK(read.notes.empty());
    CHECK(read.mesh.points == mesh.points);
    CHECK(read.mesh.cells == mesh.cells);
    CHECK(read.mesh.facets == mesh.facets);
    const std::string text = content("order.vtu");
#ifdef WEFT_LINKED_WITH_ZLIB
    if (encoding == weft::Vtu_encoding::compressed) {
      CHECK(text.size() < size);
      // Damage is an error, whatever it hits.
      std::mt19937 random(3);
      int refused = 0;
      for (int k = 0; k < 60; ++k) {
        std::string damaged = text;
        damaged[text.find("<Points>") + random() % 4000] = 'A';
        std::ofstream("damaged.vtu", std::ios::binary) << damaged;
        std::size_t cells = 0;
        try {
          cells = weft::IO::read_tetrahedral_mesh<K>("damaged.vtu").mesh.cells.size();
        } catch (const weft::File_error&) {
          ++refused;
        }
        CHECK(cells <= mesh.cells.size());
      }
      CHECK(refused > 30);
      std::remove("damaged.vtu");
    }
#endif
    size = text.size();
  }
  const auto raised = weft::raise_order_3(mesh, ball_oracle());
  weft::IO::write_mesh_3("order.vtu", raised.mesh);
  const auto corners = weft::IO::read_tetrahedral_mesh<K>("order.vtu");
  CHECK(corners.notes.size() >= 1);
  CHECK(corners.mesh.cells == mesh.cells);
  CHECK(corners.mesh.points == mesh.points);
  std::remove("order.vtu");
}

TEST_CASE("Gmsh's and Abaqus' files have ten nodes a cell in their own orders")
{
  const auto raised = weft::raise_order_3(ball_mesh(), ball_oracle());
  const Quadratic& q = raised.mesh;
  const auto names = weft::Mesh_names_3{{{1, "body of rock"}}, {}};
  weft::IO::write_mesh_3("order.msh", q, names);
  std::istringstream msh(content("order.msh"));
  std::string line;
  std::vector<std::vector<std::size_t>> cells;
  std::size_t left = 0;
  while (std::getline(msh, line)) {
    std::istringstream words(line);
    std::size_t n = 0;
    std::vector<std::size_t> numbers;
    while (words >> n) numbers.push_back(n);
    if (numbers.size() == 4 && numbers[0] == 3 && numbers[2] == 11)
      left = numbers[3];
    else if (left > 0 && numbers.size() == 11)
      cells.push_back(numbers), --left;
  }
  REQUIRE(cells.size() == q.vertices.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    auto own = q.cell(c);
    std::swap(own[8], own[9]);
    for (std::size_t i = 0; i < 10; ++i) CHECK(cells[c][i + 1] == own[i] + 1);
  }
  weft::IO::write_mesh_3("order.inp", q, names);
  const std::string inp = content("order.inp");
  CHECK(inp.find("*ELEMENT, TYPE=C3D10, ELSET=body_of_rock\n1, ") != std::string::npos);
  CHECK(inp.find("*SURFACE, NAME=PATCH_0, TYPE=ELEMENT\n") != std::string::npos);
  CHECK(static_cast<std::size_t>(std::count(inp.begin(), inp.end(), 'S')) >= q.vertices.facets.size());
  weft::IO::write_mesh_3("order.inp", q.vertices, names);
  CHECK(content("order.inp").find("TYPE=C3D4, ELSET=body_of_rock") != std::string::npos);
  CHECK_THROWS_AS(weft::IO::write_mesh_3("order.mesh", q), weft::File_error);
  std::remove("order.msh");
  std::remove("order.inp");
}
