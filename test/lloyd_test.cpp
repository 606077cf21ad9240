// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of Lloyd's iteration on the bounded Voronoi diagram and of its quadratures: targets are the centroids of
// cells, quadratures converge to closed forms, and the iteration lowers the energy whose minima it looks for.

#include "fixtures/planar_fixtures.h"

#include <weft/planar/relax/Lloyd_2.h>
#include <weft/planar/relax/quadrature_2.h>
#include <weft/planar/run/mesh_as_published_2.h>
#include <weft/planar/triangulation/Bounded_voronoi_diagram_2.h>
#include <weft/planar/triangulation/Relocator_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/sizing/Uniform_sizing.h>

namespace {

using namespace planar;
using Uniform = weft::Uniform_sizing<>;

/// A working mesh with random points inside and on its constraints.
template <class Sizing>
struct Mesh_of
{
  using Mesh = weft::internal::Working_mesh_2<Cdt, Sizing>;
  using Lloyd = weft::internal::Lloyd_2<Mesh>;

  Mesh_of(const Pslg& pslg, Sizing field, unsigned seed, int inside, int on_constraints)
      : cdt(triangulate(pslg)), sizing(std::move(field)), mesh(cdt, sizing)
  {
    Random random(seed);
    for (int i = 0; i < on_constraints; ++i) {
      std::vector<Cdt::Edge> edges;
      for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e) edges.push_back(*e);
      const auto [f, k] = edges[below(random, edges.size())];
      const Point &a = f->vertex(cdt.ccw(k))->point(), &b = f->vertex(cdt.cw(k))->point();
      const double t = uniform(random, 0.1, 0.9);
      mesh.insert_on_constraint(Point(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y())), f, k);
    }
    const double extent = diameter(pslg);
    for (int i = 0; i < inside; ++i)
      mesh.insert_inside(Point(uniform(random, 0, extent), uniform(random, 0, extent)), Cdt::Face_handle());
    mesh.renumber();
  }

  /// One sweep over the vertices that `moves` lets.
  template <class Moves>
  void sweep(Lloyd& lloyd, const Moves& moves)
  {
    lloyd.compute(mesh.faces());
    std::vector<Cdt::Vertex_handle> vertices;
    std::vector<Point> targets;
    for (const auto v : mesh.vertices()) {
      if (!moves(v)) continue;
      vertices.push_back(v);
      targets.push_back(lloyd.target(v).point);
    }
    weft::internal::Relocator_2<Cdt>(cdt).move(vertices, targets);
    for (const auto v : vertices) mesh.update_target(v);
  }

  Cdt cdt;
  Sizing sizing;
  Mesh mesh;
};

using Uniform_mesh = Mesh_of<Uniform>;
using Graded_mesh = Mesh_of<Field>;

bool is_free(Cdt::Vertex_handle v)
{
  return v->constraint() == weft::free_vertex;
}

double distance(const Point& a, const Point& b)
{
  return std::sqrt(CGAL::squared_distance(a, b));
}

/// Splits edges on the bottom of the square `n` times, each time the longest.
template <class Mesh, class Place>
void split_bottom(Mesh& m, int n, const Place& place)
{
  for (int k = 0; k < n; ++k) {
    Cdt::Edge longest;
    double length = 0;
    for (auto e = m.cdt.constrained_edges_begin(); e != m.cdt.constrained_edges_end(); ++e) {
      const K::Segment_2 s = m.cdt.segment(*e);
      if (s.source().y() != 0 || s.target().y() != 0 || s.squared_length() <= length) continue;
      length = s.squared_length();
      longest = *e;
    }
    const K::Segment_2 s = m.cdt.segment(longest);
    m.mesh.insert_on_constraint(place(s.source(), s.target()), longest.first, longest.second);
  }
}

/// Abscissae of the vertices on the bottom of the square, in order.
std::vector<double> bottom(const std::vector<Cdt::Vertex_handle>& vertices)
{
  std::vector<double> x;
  for (const auto v : vertices)
    if (v->point().y() == 0) x.push_back(v->point().x());
  std::sort(x.begin(), x.end());
  return x;
}

double factorial(int n)
{
  return n <= 1 ? 1 : n * factorial(n - 1);
}

/// Integral of x^a y^b over the triangle (0,0), (1,0), (0,1).
double monomial_integral(int a, int b)
{
  return factorial(a) * factorial(b) / factorial(a + b + 2);
}

/// Mean squared distance of the square's points to the nearest vertex, by a fine grid.
double energy_of_square(const std::vector<Cdt::Vertex_handle>& vertices)
{
  constexpr int n = 150;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Point p((i + 0.5) / n, (k + 0.5) / n);
      double nearest = 4;
      for (const auto v : vertices) nearest = (std::min)(nearest, CGAL::squared_distance(p, v->point()));
      sum += nearest;
    }
  return sum / (n * n);
}

TEST_CASE("Alg. 2 as printed meshes the domain, and each of its parts saves vertices")
{
  const Pslg pslg = nested_holes();
  const auto run = [&](const weft::As_published_options_2& options) {
    Cdt cdt = triangulate(pslg);
    const auto report = weft::mesh_as_published_2(cdt, 0.04 * diameter(pslg), options);
    CHECK(mesh_faults(cdt, pslg).empty());
    CHECK(report.sizes_held);
    CHECK(report.largest_ratio < 1.2);
    CHECK(report.batches > 1);
    CHECK(report.sweeps > 0);
    return cdt.number_of_vertices();
  };
  const std::size_t printed = run({});
  weft::As_published_options_2 options;
  options.interleave = false;
  CHECK(run(options) > printed);
  options = {};
  options.alter_triangles = false;
  CHECK(run(options) > printed);
  options = {};
  options.alter_edges = false;
  CHECK(run(options) != printed);
  options = {};
  options.lower_slowly = false;
  CHECK(run(options) != printed);
  options = {};
  options.move_ratio = 0;
  Cdt cdt = triangulate(pslg);
  CHECK_THROWS_AS(weft::mesh_as_published_2(cdt, 0.1, options), weft::Option_error);
}

} // namespace

TEST_CASE("without feedback the targets of free vertices are the centroids of their bounded Voronoi cells")
{
  std::size_t blind = 0;
  for (const Domain& domain : domains())
    for (unsigned seed = 0; seed < 4; ++seed) {
      INFO(domain.name << ", seed " << seed);
      // Few vertices on constraints, so that many triangles at walls are obtuse and blind.
      Uniform_mesh m(domain.pslg, Uniform(0.1), seed, seed % 2 ? 30 : 300, seed < 2 ? 0 : 60);
      const weft::Bounded_voronoi_diagram_2<Cdt> voronoi(m.cdt);
      for (const auto f : m.mesh.faces()) blind += voronoi.is_blind(f);
      Uniform_mesh::Lloyd lloyd(m.mesh, 0, 10, 1);
      lloyd.compute(m.mesh.faces());
      double worst = 0;
      for (const auto v : m.mesh.vertices())
        if (is_free(v)) worst = (std::max)(worst, distance(lloyd.target(v).point, voronoi.centroid(v)));
      CHECK(worst < 1e-9);
    }
  CHECK(blind > 500);
}

TEST_CASE("the targets behind a wall that hides several circumcenters are centroids, too")
{
  // Rows of vertices just above a long wall without vertices, with others far away: whole trees of blind triangles.
  for (unsigned seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Uniform_mesh m(square(), Uniform(0.1), seed, 3, 0);
    for (int i = 0; i < 25; ++i)
      m.mesh.insert_inside(Point(uniform(random, 0, 1), std::pow(uniform(random, 0.1, 1), 3) * 0.2),
                           Cdt::Face_handle());
    m.mesh.renumber();
    const weft::Bounded_voronoi_diagram_2<Cdt> voronoi(m.cdt);
    Uniform_mesh::Lloyd lloyd(m.mesh, 0, 10, 1);
    lloyd.compute(m.mesh.faces());
    for (const auto v : m.mesh.vertices())
      if (is_free(v)) CHECK(distance(lloyd.target(v).point, voronoi.centroid(v)) < 1e-9);
  }
}

TEST_CASE("input vertices and ends of constraints stay, vertices on constraints stay on them")
{
  Graded_mesh m(
      dangling_constraints(), [](const Point& p) { return 0.05 + 0.1 * p.x(); }, 1, 100, 80);
  Graded_mesh::Lloyd lloyd(m.mesh, 3, 30, 1);
  lloyd.compute(m.mesh.faces());
  std::size_t sliding = 0;
  for (const auto v : m.mesh.vertices()) {
    const auto [p, ratio] = lloyd.target(v);
    CHECK(ratio >= 0);
    if (v->constraint() == weft::fixed_vertex) {
      CHECK(p == v->point());
      CHECK(ratio == 0);
    } else if (v->constraint() >= 0) {
      const auto& chain = m.mesh.chains().at(v->constraint());
      const K::Segment_2 s(chain.source->point(), chain.target->point());
      CHECK(CGAL::squared_distance(p, s) < 1e-30);
      sliding += p != v->point();
    }
  }
  CHECK(sliding > 70);
}

TEST_CASE("a field that is constant without saying so gives the targets of the uniform one")
{
  for (const double feedback : {0.0, 2.0, 3.0, 4.5})
    for (const int quadrature : {1, 10, 100}) {
      INFO("feedback " << feedback << ", quadrature " << quadrature);
      Uniform_mesh m(annulus(), Uniform(0.1), 7, 150, 50);
      Graded_mesh n(
          annulus(), [](const Point&) { return 0.1; }, 7, 150, 50);
      Uniform_mesh::Lloyd lloyd(m.mesh, feedback, quadrature, 1);
      Graded_mesh::Lloyd other(n.mesh, feedback, quadrature, 1);
      lloyd.compute(m.mesh.faces());
      other.compute(n.mesh.faces());
      REQUIRE(m.mesh.vertices().size() == n.mesh.vertices().size());
      double worst = 0;
      for (std::size_t i = 0; i < m.mesh.vertices().size(); ++i) {
        REQUIRE(m.mesh.vertices()[i]->point() == n.mesh.vertices()[i]->point());
        const auto t = lloyd.target(m.mesh.vertices()[i]);
        const auto u = other.target(n.mesh.vertices()[i]);
        worst = (std::max)({worst, distance(t.point, u.point), std::abs(t.move_ratio - u.move_ratio)});
      }
      CHECK(worst < 1e-9);
    }
}

TEST_CASE("targets don't depend on the number of threads")
{
  Graded_mesh m(
      nested_holes(), [](const Point& p) { return 0.05 + 0.1 * p.y(); }, 3, 2000, 100);
  std::vector<Point> targets;
  for (const int threads : {1, 2, 4}) {
    Graded_mesh::Lloyd lloyd(m.mesh, 3, 30, threads);
    lloyd.compute(m.mesh.faces());
    std::vector<Point> now;
    for (const auto v : m.mesh.vertices()) now.push_back(lloyd.target(v).point);
    if (targets.empty()) targets = now;
    CHECK(targets == now);
  }
}

TEST_CASE("graded targets are drawn towards small sizes, and finer quadratures agree on them")
{
  const auto targets = [](int quadrature) {
    Graded_mesh m(
        square(), [](const Point& p) { return 0.02 + 0.3 * p.x(); }, 5, 60, 30);
    Graded_mesh::Lloyd lloyd(m.mesh, 0, quadrature, 1);
    lloyd.compute(m.mesh.faces());
    const weft::Bounded_voronoi_diagram_2<Cdt> voronoi(m.cdt);
    std::vector<Point> result;
    double to_the_left = 0;
    for (const auto v : m.mesh.vertices())
      if (is_free(v)) {
        result.push_back(lloyd.target(v).point);
        to_the_left += voronoi.centroid(v).x() - result.back().x();
      }
    CHECK(to_the_left > 0.1);
    return result;
  };
  const auto difference = [](const std::vector<Point>& a, const std::vector<Point>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = (std::max)(worst, distance(a[i], b[i]));
    return worst;
  };
  const auto limit = targets(200000);
  const double coarse = difference(targets(100), limit), middling = difference(targets(1000), limit),
               fine = difference(targets(10000), limit);
  CHECK(middling < coarse / 2);
  CHECK(fine < middling / 2);
  CHECK(fine < 1e-3);
}

TEST_CASE("the quadrature over a triangle is exact for quadratic moments and converges beyond")
{
  const std::array<double, 2> a{0, 0}, b{1, 0}, c{0, 1};
  for (const int parts : {1, 2, 3, 7, 10, 100}) {
    const auto one = weft::internal::integrate_triangle(a, b, c, parts, [](double, double) { return 1.0; });
    CHECK(one.mass == Approx(0.5));
    CHECK(one.x == Approx(1 / 6.));
    CHECK(one.y == Approx(1 / 6.));
    const auto linear =
        weft::internal::integrate_triangle(a, b, c, parts, [](double x, double y) { return 1 + 2 * x - 3 * y; });
    CHECK(linear.mass == Approx(0.5 + 2 / 6. - 3 / 6.));
    CHECK(linear.x == Approx(1 / 6. + 2 * monomial_integral(2, 0) - 3 * monomial_integral(1, 1)));
    CHECK(linear.y == Approx(1 / 6. + 2 * monomial_integral(1, 1) - 3 * monomial_integral(0, 2)).margin(1e-12));
  }
  const auto high = [](double x, double y) { return std::pow(x, 4) * y * y; };
  double last = 1;
  for (const int parts : {16, 256, 4096}) {
    const auto m = weft::internal::integrate_triangle(a, b, c, parts, high);
    const double error = std::abs(m.mass / monomial_integral(4, 2) - 1) + std::abs(m.x / monomial_integral(5, 2) - 1) +
                         std::abs(m.y / monomial_integral(4, 3) - 1);
    CHECK(error < last / 16); // at least second order in the parts' diameter; the rule has order three
    last = error;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("the quadrature counts triangles that are turned over negative and is additive")
{
  const auto density = [](double x, double y) { return 1 + x * x + y; };
  const std::array<double, 2> a{0.1, 0.2}, b{1, 0.3}, c{0.4, 0.9}, middle{0.5, 0.5};
  for (const int parts : {1, 4, 32}) { // with other numbers the halves of a triangle get different numbers of parts
    const auto there = weft::internal::integrate_triangle(a, b, c, parts, density),
               back = weft::internal::integrate_triangle(a, c, b, parts, density);
    CHECK(there.mass == Approx(-back.mass));
    CHECK(there.x == Approx(-back.x));
    CHECK(there.y == Approx(-back.y));
  }
  weft::internal::Moments_2 sum;
  sum += weft::internal::integrate_triangle(a, b, middle, 3000, density);
  sum += weft::internal::integrate_triangle(b, c, middle, 3000, density);
  sum += weft::internal::integrate_triangle(c, a, middle, 3000, density);
  const auto whole = weft::internal::integrate_triangle(a, b, c, 3000, density);
  CHECK(sum.mass == Approx(whole.mass).epsilon(1e-6));
  CHECK(sum.x == Approx(whole.x).epsilon(1e-6));
  CHECK(sum.y == Approx(whole.y).epsilon(1e-6));
}

TEST_CASE("the quadrature along a segment converges to closed forms")
{
  const std::array<double, 2> a{1, 2}, b{4, 6}; // length 5
  const auto one = weft::internal::integrate_segment(a, b, 1, [](double, double) { return 1.0; });
  CHECK(one.mass == Approx(5));
  CHECK(one.x == Approx(12.5));
  CHECK(one.y == Approx(20));
  // Integral of 5 (1 + 3t)^-3 dt, and the same times x = 1 + 3t.
  const auto density = [](double x, double) { return weft::internal::linear_density(x); };
  const double mass = 5 / 6. * (1 - 1 / 16.), x = 5 / 3. * (1 - 1 / 4.);
  double last = 1e9;
  for (const int parts : {4, 16, 64, 256}) {
    const auto m = weft::internal::integrate_segment(a, b, parts, density);
    const double error = std::abs(m.mass - mass) + std::abs(m.x - x);
    CHECK(error < last / 4); // second order: a sixteenth in the limit
    last = error;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("Lloyd's iteration on a constraint converges to equal spacing")
{
  Uniform_mesh m(square(), Uniform(0.1), 11, 40, 0);
  Random random(2);
  split_bottom(m, 7, [&](const Point& a, const Point& b) {
    const double t = uniform(random, 0.2, 0.8);
    return Point(a.x() + t * (b.x() - a.x()), 0);
  });
  m.mesh.renumber();
  Uniform_mesh::Lloyd lloyd(m.mesh, 0, 10, 1);
  for (int sweep = 0; sweep < 400; ++sweep)
    m.sweep(lloyd, [](Cdt::Vertex_handle v) { return v->constraint() != weft::fixed_vertex; });
  const std::vector<double> x = bottom(m.mesh.vertices());
  REQUIRE(x.size() == 9);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(i / 8.0).margin(1e-6));
}

TEST_CASE("on a constraint spacing settles in proportion to the size")
{
  const auto size = [](const Point& p) { return 0.02 + 0.2 * p.x(); };
  Graded_mesh m(square(), size, 11, 10, 0);
  split_bottom(m, 11, [](const Point& a, const Point& b) { return CGAL::midpoint(a, b); });
  m.mesh.renumber();
  Graded_mesh::Lloyd lloyd(m.mesh, 0, 200, 1);
  for (int sweep = 0; sweep < 2000; ++sweep) m.sweep(lloyd, [](Cdt::Vertex_handle v) { return v->constraint() >= 0; });
  const std::vector<double> x = bottom(m.mesh.vertices());
  double smallest = 1e9, largest = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double spacing = (x[i + 1] - x[i]) / size(Point((x[i] + x[i + 1]) / 2, 0));
    smallest = (std::min)(smallest, spacing);
    largest = (std::max)(largest, spacing);
  }
  REQUIRE(x.size() == 13);
  // Proportional as far as pieces are small against the scale on which the size changes.
  CHECK(largest / smallest < 1.25);
}

TEST_CASE("every sweep with a fixed density lowers the energy of the tessellation")
{
  for (unsigned seed = 0; seed < 5; ++seed) {
    INFO("seed " << seed);
    Uniform_mesh m(square(), Uniform(0.1), seed, 60, 30);
    Uniform_mesh::Lloyd lloyd(m.mesh, 0, 10, 1);
    const double start = energy_of_square(m.mesh.vertices());
    double energy = start;
    for (int sweep = 0; sweep < 15; ++sweep) {
      m.sweep(lloyd, is_free);
      const double now = energy_of_square(m.mesh.vertices());
      CHECK(now < energy * (1 + 1e-4)); // the energy is that of a grid's points
      energy = now;
    }
    CHECK(energy < 0.9 * start);
    CHECK(faults(weft::validate_2(m.cdt)) == "");
  }
}

TEST_CASE("feedback draws vertices towards long edges")
{
  // A triangular lattice with a vertex missing.
  Uniform_mesh m(square(), Uniform(0.1), 0, 0, 0);
  const Point gap(0.5, 0.5);
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      const Point p(gap.x() + 0.1 * (i + 0.5 * k), gap.y() + 0.1 * std::sqrt(0.75) * k);
      if (p != gap && std::abs(p.x() - 0.5) < 0.45) m.mesh.insert_inside(p, Cdt::Face_handle());
    }
  m.mesh.renumber();
  std::vector<double> last(m.mesh.vertices().size(), 0.1);
  for (const double feedback : {0.0, 1.0, 2.0, 3.0}) {
    Uniform_mesh::Lloyd lloyd(m.mesh, feedback, 10, 1);
    lloyd.compute(m.mesh.faces());
    int neighbors = 0;
    for (const auto v : m.mesh.vertices()) {
      if (distance(v->point(), gap) > 0.11) continue;
      ++neighbors;
      const double now = distance(lloyd.target(v).point, gap);
      CHECK(now < last[v->id()] - 1e-4);
      last[v->id()] = now;
    }
    CHECK(neighbors == 6);
  }
}
