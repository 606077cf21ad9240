// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of energies and of solvers in the plane: values in closed form, gradients and Jacobians against central
// differences, and energies that fall in every sweep to a critical point.

#include "fixtures/meshing_2.h"
#include "fixtures/planar_fixtures.h"

#include <weft/energy/cvt_energy_2.h>
#include <weft/energy/cvt_energy_3.h>
#include <weft/energy/odt_energy_2.h>
#include <weft/energy/odt_energy_3.h>
#include <weft/planar/mesh/from_triangulation_2.h>
#include <weft/planar/solve/minimise_energy_2.h>
#include <weft/solve/iteration_jacobian.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace planar;
using weft::Energy;
using weft::Solver;
using Mesh_2 = weft::Triangle_mesh_2<K>;
using Mesh_3 = weft::Tetrahedral_mesh_3<K>;

constexpr double accuracy = 1e-6; // of differences, relative

double random_part(std::mt19937& random)
{
  return random() / 4294967295.0;
}

/// A cube of 4^3 points, shaken; cells whose spheres reach far beyond it are left out.
Mesh_3 shaken_cube(unsigned seed)
{
  using Vb = CGAL::Triangulation_vertex_base_with_info_3<std::size_t, K>;
  using Triangulation = CGAL::Delaunay_triangulation_3<K, CGAL::Triangulation_data_structure_3<Vb>>;
  std::mt19937 random(seed);
  Mesh_3 mesh;
  Triangulation triangulation;
  for (int i = 0; i < 64; ++i) {
    const auto at = [&](int k) { return k / 3.0 + 0.12 * (random_part(random) - 0.5); };
    const double x = at(i & 3), y = at(i >> 2 & 3), z = at(i >> 4);
    mesh.points.emplace_back(x, y, z);
    triangulation.insert(mesh.points.back())->info() = mesh.points.size() - 1;
  }
  for (const auto c : triangulation.finite_cell_handles()) {
    const auto center =
        CGAL::circumcenter(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
    if (CGAL::squared_distance(center, c->vertex(0)->point()) > 0.13) continue;
    mesh.cells.push_back({c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  }
  return mesh;
}

bool is_inside(const K::Point_3& p)
{
  const auto in = [](double x) { return x > 0.2 && x < 0.8; };
  return in(p.x()) && in(p.y()) && in(p.z());
}

/// An L with scattered points, some so near the walls that triangles are blind.
Mesh_2 scattered_l(unsigned seed)
{
  std::mt19937 random(seed);
  Cdt cdt;
  const std::vector<Point> outline{Point(0, 0), Point(2, 0), Point(2, 1), Point(1, 1), Point(1, 2), Point(0, 2)};
  for (std::size_t i = 0; i < outline.size(); ++i) cdt.insert_constraint(outline[i], outline[(i + 1) % outline.size()]);
  weft::mark_domain_by_parity(cdt);
  for (int k = 0; k < 60;) {
    const Point p(0.01 + 1.98 * random_part(random), 0.01 + 1.98 * random_part(random));
    if (p.x() > 0.99 && p.y() > 0.99) continue;
    const auto v = cdt.insert(p);
    auto f = cdt.incident_faces(v);
    const auto done = f;
    do f->set_in_domain(true);
    while (++f != done);
    ++k;
  }
  return weft::triangle_mesh_2(cdt);
}

template <class Vector>
double largest(const std::vector<Vector>& gradient)
{
  double result = 0;
  for (const auto& g : gradient) result = (std::max)(result, std::sqrt(g.squared_length()));
  return result;
}

K::Vector_2 unit(const Mesh_2&, int k)
{
  return k == 0 ? K::Vector_2(1, 0) : K::Vector_2(0, 1);
}
K::Vector_3 unit(const Mesh_3&, int k)
{
  return k == 0 ? K::Vector_3(1, 0, 0) : k == 1 ? K::Vector_3(0, 1, 0) : K::Vector_3(0, 0, 1);
}

/// The largest error of a gradient, in parts of its largest vector.
template <class Mesh, class Energy_of, class Counts>
double gradient_error(const Mesh& mesh, const Energy_of& energy_of, int d, const Counts& counts)
{
  const auto energy = energy_of(mesh);
  const double h = 1e-5, scale = largest(energy.gradient);
  double worst = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int k = 0; counts(i) && k < d; ++k) {
      Mesh moved = mesh;
      moved.points[i] = mesh.points[i] + h * unit(mesh, k);
      const double after = energy_of(moved).value;
      moved.points[i] = mesh.points[i] - h * unit(mesh, k);
      const double slope = (after - energy_of(moved).value) / (2 * h);
      worst = (std::max)(worst, std::abs(slope - energy.gradient[i][k]) / scale);
    }
  return worst;
}

/// The largest error of a Jacobian of the map point - gradient / diagonal.
template <class Mesh, class Energy_of, class Counts>
double jacobian_error(const Mesh& mesh, const Energy_of& energy_of, const Eigen::MatrixXd& jacobian, int d,
                      const Counts& counts)
{
  const auto image = [&](const Mesh& m) {
    const auto energy = energy_of(m);
    std::vector<double> result;
    for (std::size_t i = 0; i < m.points.size(); ++i)
      for (int k = 0; k < d; ++k) result.push_back(m.points[i][k] - energy.gradient[i][k] / energy.diagonal[i]);
    return result;
  };
  const double h = 1e-6;
  double worst = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int k = 0; counts(i) && k < d; ++k) {
      Mesh moved = mesh;
      moved.points[i] = mesh.points[i] + h * unit(mesh, k);
      const auto after = image(moved);
      moved.points[i] = mesh.points[i] - h * unit(mesh, k);
      const auto before = image(moved);
      for (std::size_t j = 0; j < after.size(); ++j)
        if (counts(j / static_cast<std::size_t>(d)))
          worst = (std::max)(worst, std::abs((after[j] - before[j]) / (2 * h) -
                                             jacobian(static_cast<int>(j), static_cast<int>(i) * d + k)));
    }
  return worst;
}

constexpr auto all = [](std::size_t) { return true; };

TEST_CASE("energies of single simplices are those of integration by hand")
{
  Mesh_2 triangle;
  triangle.points = {Point(0, 0), Point(2, 0), Point(0, 1)};
  triangle.triangles = {{0, 1, 2}};
  // Area 1, squared edges 4, 1 and 5, over 12; in cells of the three corners of a right triangle, four small ones each.
  CHECK(weft::odt_energy_2(triangle).value == Approx(10.0 / 12));
  triangle.edges = {{0, 1}, {1, 2}, {2, 0}};
  CHECK(weft::cvt_energy_2(triangle).value == Approx(4 * (1.0 / 48 + 4.0 / 48) + 0.0).margin(1e-12));
  CHECK(weft::odt_energy_2(triangle, {2, 2, 2}).value == Approx(10.0 / 12 / 16));
  Mesh_3 cell;
  cell.points = {K::Point_3(0, 0, 0), K::Point_3(1, 0, 0), K::Point_3(0, 1, 0), K::Point_3(0, 0, 1)};
  cell.cells = {{0, 1, 2, 3}};
  CHECK(weft::odt_energy_3(cell).value == Approx(9.0 / 6 / 20));
  CHECK(weft::odt_energy_3(cell, {2, 2, 2, 2}).value == Approx(9.0 / 6 / 20 / 32));
  CHECK_THROWS_AS(weft::odt_energy_3(cell, {1, 1, 1}), weft::Option_error);
  CHECK_THROWS_AS(weft::odt_energy_3(cell, {1, 1, 0, 1}), weft::Option_error);
}

TEST_CASE("the CVT energy is that of the bounded Voronoi cells")
{
  const Mesh_2 mesh = scattered_l(3);
  const auto energy = weft::cvt_energy_2(mesh);
  double area = 0, sampled = 0;
  for (const double m : energy.diagonal) area += m / 2;
  CHECK(area == Approx(3));
  // Brute force: each point of a grid belongs to the nearest vertex that it sees.
  const int n = 150;
  const auto sees = [](const Point& p, const Point& q) { // past the only reflex corner
    const CGAL::Segment_2<K> s(p, q);
    return !CGAL::do_intersect(s, CGAL::Segment_2<K>(Point(1 + 1e-9, 1 + 1e-9), Point(3, 3)));
  };
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const Point p((i + 0.5) / n, (j + 0.5) / n);
      if (p.x() > 1 && p.y() > 1) continue;
      double nearest = 8;
      for (const Point& q : mesh.points)
        if (const double length2 = CGAL::squared_distance(p, q); length2 < nearest && sees(p, q)) nearest = length2;
      sampled += nearest / (n * n);
    }
  CHECK(energy.value == Approx(sampled).epsilon(2e-3));
}

TEST_CASE("gradients are central differences")
{
  const auto seed = GENERATE(1u, 2u);
  const Mesh_3 cube = shaken_cube(seed);
  std::vector<double> sizes;
  for (const auto& p : cube.points) sizes.push_back(0.2 + 0.2 * p.x() + 0.1 * p.y() * p.z());
  CHECK(gradient_error(
            cube, [](const Mesh_3& m) { return weft::odt_energy_3(m); }, 3, all) < accuracy);
  CHECK(gradient_error(
            cube, [&](const Mesh_3& m) { return weft::odt_energy_3(m, sizes); }, 3, all) < accuracy);
  CHECK(gradient_error(
            cube, [](const Mesh_3& m) { return weft::cvt_energy_3(m); }, 3, all) < accuracy);
  const auto density_3 = [](const K::Point_3& p) { return 1 + p.x() + 2 * p.y() * p.z() + p.x() * p.x() * p.y(); };
  CHECK(gradient_error(
            cube, [&](const Mesh_3& m) { return weft::cvt_energy_3(m, density_3); }, 3, all) < accuracy);

  const Mesh_2 l = scattered_l(seed);
  sizes.clear();
  for (const auto& p : l.points) sizes.push_back(0.2 + 0.2 * p.x() + 0.1 * p.y());
  const auto is_free = [&](std::size_t i) {
    return std::none_of(l.edges.begin(), l.edges.end(), [i](const auto& e) { return e[0] == i || e[1] == i; });
  };
  CHECK(gradient_error(
            l, [](const Mesh_2& m) { return weft::odt_energy_2(m); }, 2, all) < accuracy);
  CHECK(gradient_error(
            l, [&](const Mesh_2& m) { return weft::odt_energy_2(m, sizes); }, 2, all) < accuracy);
  CHECK(gradient_error(
            l, [](const Mesh_2& m) { return weft::cvt_energy_2(m); }, 2, is_free) < accuracy);
  const auto density_2 = [](const Point& p) { return 1 + p.x() + 2 * p.y() * p.x() + p.x() * p.x() * p.y(); };
  CHECK(gradient_error(
            l, [&](const Mesh_2& m) { return weft::cvt_energy_2(m, density_2); }, 2, is_free) < accuracy);
}

TEST_CASE("Jacobians of the fixed-point iterations are central differences")
{
  const Mesh_3 cube = shaken_cube(3);
  const auto inside = [&](std::size_t i) { return is_inside(cube.points[i]); };
  const auto odt_3 = [](const Mesh_3& m) { return weft::odt_energy_3(m); };
  const auto cvt_3 = [](const Mesh_3& m) { return weft::cvt_energy_3(m); };
  CHECK(jacobian_error(cube, odt_3, weft::odt_jacobian_3(cube), 3, all) < accuracy);
  CHECK(jacobian_error(cube, cvt_3, weft::cvt_jacobian_3(cube), 3, inside) < accuracy);
  const Mesh_2 l = scattered_l(4);
  const auto is_free = [&](std::size_t i) {
    return std::none_of(l.edges.begin(), l.edges.end(), [i](const auto& e) { return e[0] == i || e[1] == i; });
  };
  const auto odt_2 = [](const Mesh_2& m) { return weft::odt_energy_2(m); };
  const auto cvt_2 = [](const Mesh_2& m) { return weft::cvt_energy_2(m); };
  CHECK(jacobian_error(l, odt_2, weft::odt_jacobian_2(l), 2, all) < accuracy);
  CHECK(jacobian_error(l, cvt_2, weft::cvt_jacobian_2(l), 2, is_free) < accuracy);
}

const std::vector<Point> crooked_l{Point(0, 0),    Point(2.1, 0.1), Point(1.9, 1.13),
                                   Point(1.02, 1), Point(1.07, 2),  Point(-0.1, 1.9)};

/// A mesh of a crooked L refined without being relaxed; of a straight one that is a regular grid already.
Cdt refined_l(double size)
{
  Cdt cdt;
  for (std::size_t i = 0; i < crooked_l.size(); ++i)
    cdt.insert_constraint(crooked_l[i], crooked_l[(i + 1) % crooked_l.size()]);
  weft::Mesh_options_2 options;
  options.seeding = weft::Seeding::none;
  options.max_sweeps = 0;
  options.polish = options.grade_input = false;
  weft::make_mesh_2(cdt, Uniform(size), options);
  return cdt;
}

TEST_CASE("solvers lower the energy in every sweep and keep the mesh")
{
  const auto energy = GENERATE(Energy::cvt, Energy::odt);
  const auto solver = GENERATE(Solver::fixed_point, Solver::quasi_newton, Solver::newton);
  const bool moves_boundary = GENERATE(true, false);
  Cdt cdt = refined_l(0.1);
  std::vector<Point> fixed;
  for (const auto v : cdt.finite_vertex_handles())
    if (v->constraint() == weft::fixed_vertex || (v->constraint() >= 0 && !moves_boundary)) fixed.push_back(v->point());
  weft::Solver_options options;
  options.energy = energy;
  options.solver = solver;
  options.move_boundary = moves_boundary;
  options.max_sweeps = 60;
  const auto report = weft::minimise_energy_2(cdt, Uniform(0.1), options);
  REQUIRE(report.energies.size() > 5);
  CHECK(report.sweeps == report.energies.size() - 1 + report.undone_sweeps);
  CHECK(std::is_sorted(report.energies.rbegin(), report.energies.rend()));
  CHECK(report.energies.back() < 0.95 * report.energies.front());
  if (solver == Solver::newton) CHECK(report.newton_sweeps > 0);
  CHECK(cdt.is_valid());
  const Mesh_2 mesh = weft::triangle_mesh_2(cdt);
  const double value = energy == Energy::odt ? weft::odt_energy_2(mesh).value : weft::cvt_energy_2(mesh).value;
  CHECK(report.energies.back() == Approx(value));
  for (const Point& p : fixed)
    CHECK(std::any_of(mesh.points.begin(), mesh.points.end(), [&](const Point& q) { return p == q; }));
  double area = 0, wanted = 0;
  for (const auto& t : mesh.triangles) area += CGAL::area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  for (std::size_t i = 0; i < crooked_l.size(); ++i)
    wanted += CGAL::area(Point(0, 0), crooked_l[i], crooked_l[(i + 1) % crooked_l.size()]);
  CHECK(area == Approx(wanted));
}

TEST_CASE("the quasi-Newton iteration needs a quarter of Lloyd's sweeps, Newton's ends at a critical point")
{
  const auto run = [](Solver solver, double tolerance, Cdt& cdt) {
    weft::Solver_options options;
    options.energy = Energy::cvt;
    options.solver = solver;
    options.max_sweeps = 2000;
    options.tolerance = tolerance;
    return weft::minimise_energy_2(cdt, Uniform(0.08), options);
  };
  const auto sweeps_to = [](const weft::Solver_report& report, double energy) {
    std::size_t k = 0;
    while (k < report.energies.size() && report.energies[k] > energy) ++k;
    return k;
  };
  Cdt a = refined_l(0.08), b = refined_l(0.08), c = refined_l(0.08);
  const auto lloyd = run(Solver::fixed_point, 1e-7, a), fast = run(Solver::quasi_newton, 1e-7, b),
             newton = run(Solver::newton, 1e-12, c);
  const double least = (std::min)(lloyd.energies.back(), fast.energies.back());
  CHECK(4 * sweeps_to(fast, 1.001 * least) <= sweeps_to(lloyd, 1.001 * least));
  CHECK(newton.converged);
  const auto energy = weft::cvt_energy_2(weft::triangle_mesh_2(c));
  double largest_move = 0;
  const Mesh_2 mesh = weft::triangle_mesh_2(c);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (std::none_of(mesh.edges.begin(), mesh.edges.end(), [i](const auto& e) { return e[0] == i || e[1] == i; }))
      largest_move = (std::max)(largest_move, std::sqrt(energy.gradient[i].squared_length()) / energy.diagonal[i]);
  CHECK(largest_move < 1e-5 * 0.08);
}

TEST_CASE("energies with variable sizes fall, too")
{
  const auto energy = GENERATE(Energy::cvt, Energy::odt);
  Cdt cdt = refined_l(0.1);
  weft::Solver_options options;
  options.energy = energy;
  options.max_sweeps = 30;
  const Field field([](const Point& p) { return 0.05 + 0.05 * p.x(); });
  const auto report = weft::minimise_energy_2(cdt, field, options);
  CHECK(report.energies.size() > 5);
  CHECK(std::is_sorted(report.energies.rbegin(), report.energies.rend()));
  CHECK(cdt.is_valid());
  options.tolerance = -1;
  CHECK_THROWS_AS(weft::minimise_energy_2(cdt, field, options), weft::Option_error);
}

} // namespace
