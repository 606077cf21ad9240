// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of adaptation in the plane: a new size holds, what fits stays, nothing grows in the long run, tags and
// data stay, and solutions travel. Sizes are judged here, edge by edge, without the mesher's code.

#include "fixtures/meshing_2.h"

#include <weft/adapt_2.h>
#include <weft/planar/mesh/from_triangulation_2.h>
#include <weft/planar/mesh/transfer_2.h>

#include <catch2/catch.hpp>

#include <CGAL/squared_distance_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace planar;

struct Edges
{
  std::size_t all = 0, short_ones = 0;
  double largest_ratio = 0; ///< of longest edges of triangles to the size at centroids, and of constrained edges
};

double length(const Point& a, const Point& b)
{
  return std::sqrt(CGAL::squared_distance(a, b));
}

Edges edges(const Cdt& cdt, const Field& size)
{
  Edges result;
  for (const auto f : cdt.finite_face_handles()) {
    if (!f->is_in_domain()) continue;
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      const Point &a = f->vertex(Cdt::ccw(i))->point(), &b = f->vertex(Cdt::cw(i))->point();
      const double l = length(a, b), asked = size(CGAL::midpoint(a, b));
      longest = (std::max)(longest, l);
      if (f->is_constrained(i)) result.largest_ratio = (std::max)(result.largest_ratio, l / asked);
      ++result.all;
      result.short_ones += l < 0.4 * asked;
    }
    const Point c = CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    result.largest_ratio = (std::max)(result.largest_ratio, longest / size(c));
  }
  return result;
}

std::set<Point> points(const Cdt& cdt)
{
  std::set<Point> result;
  for (const auto v : cdt.finite_vertex_handles()) result.insert(v->point());
  return result;
}

Field bump(double x, double y, double least, double most, double growth)
{
  return [=](const Point& p) { return (std::min)(most, least + growth * length(p, Point(x, y))); };
}

/// Everything that holds for any mesh that was adapted.
void check(const Cdt& cdt, const Pslg& pslg, const Field& size, const weft::Mesh_report_2& report)
{
  CHECK(mesh_faults(cdt, pslg) == "");
  CHECK(report.ok());
  CHECK(edges(cdt, size).largest_ratio <= 1 + 1e-9);
  CHECK(report.vertices == cdt.number_of_vertices());
  CHECK(report.input_vertices + report.steiner() == report.vertices);
  CHECK(report.input_vertices == pslg.points.size());
}

Pslg random_graph(Random& random, int kind)
{
  switch (kind % 7) {
  case 0:
    return random_segments(random, 12);
  case 1:
    return star_shaped_polygon(random, 15, 0.5);
  case 2:
    return simple_polygon(random, 20);
  case 3:
    return broken_grid(random, 4, 0.7);
  case 4:
    return slivers(random, 5);
  case 5:
    return collinear_chains(random, 5);
  default:
    return tiny_angles(random, 5);
  }
}

double integral(const weft::Triangle_mesh_2<K>& mesh, const std::vector<double>& values)
{
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += CGAL::area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) / 3 *
           (values[t[0]] + values[t[1]] + values[t[2]]);
  return sum;
}

} // namespace

TEST_CASE("a size that changes nothing leaves every vertex where it is, but for places that the input crowds")
{
  std::size_t all = 0, stays = 0;
  for (const Pslg& pslg : {square(), l_shape(), annulus(), close_constraints(), comb()})
    for (const double growth : {0., 0.1, 0.2}) {
      const Field size = bump(0.4, 0.4, growth > 0 ? 0.008 : 0.02, 0.04, growth);
      Cdt cdt = triangulate(pslg);
      weft::make_mesh_2(cdt, size);
      const auto before = points(cdt);
      const auto report = weft::adapt_2(cdt, size);
      check(cdt, pslg, size, report);
      std::size_t kept = 0;
      for (const Point& p : points(cdt)) kept += before.count(p);
      INFO("growth " << growth << ", " << pslg.points.size() << " input vertices");
      if (pslg.points.size() == 4) CHECK(kept == before.size());
      CHECK(static_cast<double>(kept) >= 0.7 * static_cast<double>(before.size()));
      all += before.size();
      stays += kept;
      const auto once = points(cdt); // then it settles
      weft::adapt_2(cdt, size);
      std::size_t again = 0;
      for (const Point& p : points(cdt)) again += once.count(p);
      CHECK(static_cast<double>(again) >= 0.7 * static_cast<double>(once.size()));
    }
  CHECK(static_cast<double>(stays) >= 0.95 * static_cast<double>(all));
}

TEST_CASE("a mesh adapts to finer sizes in a part of the domain, and back, and stays elsewhere")
{
  for (const Pslg& pslg : {square(), l_shape(), annulus(), nested_holes()}) {
    const Field coarse = [](const Point&) { return 0.03; };
    const Field fine = [](const Point& p) {
      return 0.03 * (std::min)(1., 0.4 + 3 * (std::max)(0., length(p, Point(0.1, 0.15)) - 0.1));
    };
    Cdt cdt = triangulate(pslg);
    weft::make_mesh_2(cdt, coarse);
    const auto before = points(cdt);
    const auto report = weft::adapt_2(cdt, fine);
    check(cdt, pslg, fine, report);
    CHECK(report.smallest_angle > 33);
    const auto now = points(cdt);
    std::size_t far = 0, kept = 0;
    for (const Point& p : before) {
      if (length(p, Point(0.1, 0.15)) < 0.55) continue;
      ++far;
      kept += now.count(p);
    }
    if (pslg.points.size() <= 6) CHECK(kept == far);
    CHECK(static_cast<double>(kept) >= 0.94 * static_cast<double>(far)); // around holes lengths don't divide by sizes
    const Edges all = edges(cdt, fine);
    CHECK(static_cast<double>(all.short_ones) <= 0.02 * static_cast<double>(all.all));

    const auto back = weft::adapt_2(cdt, coarse);
    check(cdt, pslg, coarse, back);
    CHECK(back.smallest_angle > 33);
    CHECK(static_cast<double>(back.vertices) <= 1.05 * static_cast<double>(before.size()));
  }
}

TEST_CASE("after ten adaptations to a field that moves there are hardly more vertices than in a new mesh")
{
  std::size_t adapted = 0, anew = 0;
  for (const Pslg& pslg : {square(), l_shape(), annulus(), comb(), dangling_constraints()})
    for (const double growth : {0.2, 0.4}) {
      const auto field = [&](int i) { return bump(0.15 + 0.06 * i, 0.3 + 0.04 * i, 0.008, 0.05, growth); };
      Cdt cdt = triangulate(pslg);
      weft::make_mesh_2(cdt, field(0));
      weft::Mesh_report_2 report;
      for (int i = 1; i <= 10; ++i) {
        report = weft::adapt_2(cdt, field(i));
        check(cdt, pslg, field(i), report);
      }
      Cdt other = triangulate(pslg);
      const auto once = weft::make_mesh_2(other, field(10));
      CHECK(report.smallest_angle >= (std::min)(33., once.smallest_angle - 1));
      adapted += report.vertices;
      anew += once.vertices;
      CHECK(static_cast<double>(report.vertices) <= 1.06 * static_cast<double>(once.vertices) + 5);
    }
  CHECK(static_cast<double>(adapted) <= 1.05 * static_cast<double>(anew));
}

TEST_CASE("random graphs adapt to random fields")
{
  Random random(20);
  for (int i = 0; i < 40; ++i) {
    const Pslg pslg = random_graph(random, i);
    Cdt cdt = triangulate(pslg, weft::Crossings::split);
    bool has_domain = false;
    for (const auto f : cdt.finite_face_handles()) has_domain = has_domain || f->is_in_domain();
    if (!has_domain) continue;
    double extent = 0;
    for (const Point& p : pslg.points) extent = (std::max)(extent, length(p, pslg.points.front()));
    weft::Mesh_options_2 options;
    options.max_vertices = 20000;
    for (int k = 0; k < 4; ++k) {
      const Point at = pslg.points[below(random, pslg.points.size())];
      const double least = uniform(random, 0.01, 0.05) * extent, growth = uniform(random, 0.05, 0.5);
      const Field size = bump(at.x(), at.y(), least, 0.2 * extent, growth);
      const auto report = k == 0 ? weft::make_mesh_2(cdt, size, options) : weft::adapt_2(cdt, size, options);
      INFO("graph " << i << ", field " << k);
      CHECK(faults(weft::validate_2(cdt)) == "");
      if (report.stop_reason != weft::Stop_reason::criteria_met) break;
      CHECK(edges(cdt, size).largest_ratio <= 1 + 1e-9);
      CHECK(report.vertices == cdt.number_of_vertices());
    }
  }
}

TEST_CASE("adaptation is the same in every run and keeps points that nobody connects")
{
  Pslg pslg = square();
  pslg.points.emplace_back(0.41, 0.52);
  std::vector<Fingerprint> prints;
  for (unsigned seed : {1u, 2u}) {
    const Memory_noise noise(seed);
    Cdt cdt = triangulate(pslg);
    weft::make_mesh_2(cdt, bump(0.2, 0.2, 0.01, 0.06, 0.3));
    const Field size = bump(0.6, 0.6, 0.01, 0.06, 0.3);
    const auto report = weft::adapt_2(cdt, size);
    check(cdt, pslg, size, report);
    prints.push_back(fingerprint(cdt));
  }
  CHECK(prints[0] == prints[1]);
}

TEST_CASE("what is asked for besides sizes holds, and mistakes are named")
{
  Cdt cdt = triangulate(l_shape());
  weft::make_mesh_2(cdt, Field([](const Point&) { return 0.05; }));
  weft::Mesh_options_2 options;
  options.min_angle = 30;
  const Field size = bump(0.2, 0.2, 0.01, 0.06, 0.3);
  CHECK(weft::adapt_2(cdt, size, options).ok());
  CHECK_THROWS_AS(weft::adapt_2(cdt, Field([](const Point&) { return -1.; })), weft::Option_error);
  CHECK(faults(weft::validate_2(cdt)) == "");
  options.max_vertices = 100;
  const auto report = weft::adapt_2(cdt, Field([](const Point&) { return 0.002; }), options);
  CHECK(report.stop_reason == weft::Stop_reason::vertex_budget);
  CHECK(faults(weft::validate_2(cdt)) == "");
}

TEST_CASE("a mesh in arrays adapts with its regions and tags")
{
  const Pslg pslg = nested_holes();
  Cdt cdt = triangulate(pslg);
  const Field coarse = [](const Point&) { return 0.04; };
  weft::make_mesh_2(cdt, coarse);
  auto mesh = weft::triangle_mesh_2(cdt, [](Cdt::Face_handle f) { return f->is_in_domain() ? 7 : 0; });
  for (int& tag : mesh.edge_tags) tag = 5;
  const auto same = weft::adapt_2(mesh, coarse);
  CHECK(std::set<Point>(same.mesh.points.begin(), same.mesh.points.end()) ==
        std::set<Point>(mesh.points.begin(), mesh.points.end()));
  const auto result = weft::adapt_2(mesh, bump(0.2, 0.2, 0.01, 0.05, 0.3));
  CHECK(result.report.ok());
  CHECK(std::set<int>(result.mesh.regions.begin(), result.mesh.regions.end()) == std::set<int>{7});
  CHECK(std::set<int>(result.mesh.edge_tags.begin(), result.mesh.edge_tags.end()) == std::set<int>{5});
  CHECK(integral(result.mesh, std::vector<double>(result.mesh.points.size(), 1)) ==
        Approx(integral(mesh, std::vector<double>(mesh.points.size(), 1))).epsilon(1e-12));
  const std::set<Point> now(result.mesh.points.begin(), result.mesh.points.end());
  for (const Point& p : pslg.points) CHECK(now.count(p) == 1);
}

TEST_CASE("solutions travel: linear functions exactly, and integrals if they have to")
{
  Cdt cdt = triangulate(annulus());
  weft::make_mesh_2(cdt, Field([](const Point&) { return 0.04; }));
  const auto from = weft::triangle_mesh_2(cdt);
  weft::adapt_2(cdt, bump(0.3, 0.3, 0.01, 0.06, 0.3));
  const auto to = weft::triangle_mesh_2(cdt);
  std::vector<double> linear, peak;
  for (const Point& p : from.points) {
    linear.push_back(1 + p.x() - 2 * p.y());
    peak.push_back(std::exp(-20 * CGAL::squared_distance(p, Point(0.25, 0.3))));
  }
  const auto carried = weft::transfer_2(from, linear, to);
  for (std::size_t v = 0; v < to.points.size(); ++v)
    REQUIRE(carried[v] == Approx(1 + to.points[v].x() - 2 * to.points[v].y()).margin(1e-9));
  const auto kept = weft::transfer_2(from, peak, to, weft::Transfer::conserving);
  CHECK(integral(to, kept) == Approx(integral(from, peak)).epsilon(1e-10));
  CHECK(*std::max_element(kept.begin(), kept.end()) <= *std::max_element(peak.begin(), peak.end()) + 1e-12);
  CHECK(*std::min_element(kept.begin(), kept.end()) >= *std::min_element(peak.begin(), peak.end()) - 1e-12);
  for (const double one :
       weft::transfer_2(from, std::vector<double>(from.points.size(), 1), to, weft::Transfer::conserving))
    REQUIRE(one == Approx(1).epsilon(1e-9));
  // Outside, the nearest point counts, found here among all triangles.
  weft::Triangle_mesh_2<K> far;
  far.points = {{2, 0.5}, {3, 0.5}, {2.5, 1}};
  far.triangles = {{0, 1, 2}};
  const auto outside = weft::transfer_2(from, linear, far);
  for (std::size_t v = 0; v < 3; ++v) {
    double least = HUGE_VAL, expected = 0;
    for (const auto& e : from.edges) {
      const K::Segment_2 edge(from.points[e[0]], from.points[e[1]]);
      const Point &a = edge.source(), &p = far.points[v];
      const double s = std::clamp((p - a) * edge.to_vector() / edge.squared_length(), 0., 1.);
      const Point q = a + s * edge.to_vector();
      if (CGAL::squared_distance(p, q) < least) {
        least = CGAL::squared_distance(p, q);
        expected = 1 + q.x() - 2 * q.y();
      }
    }
    CHECK(outside[v] == Approx(expected).margin(1e-9));
  }
  CHECK_THROWS_AS(weft::transfer_2(from, {1., 2.}, to), weft::Option_error);
}

TEST_CASE("data in faces comes from the face of the mesh that was there")
{
  using Fb = CGAL::Triangulation_face_base_with_info_2<int, K, CGAL::Delaunay_mesh_face_base_2<K>>;
  using Tds = CGAL::Triangulation_data_structure_2<weft::Mesh_vertex_base_2<K>, weft::Mesh_face_base_2<K, Fb>>;
  using Data_cdt = CGAL::Constrained_Delaunay_triangulation_2<K, Tds>;
  Data_cdt cdt;
  const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  cdt.insert_constraint(corners.begin(), corners.end(), true);
  cdt.insert_constraint(Point(0, 0.1), Point(1, 0.4));
  cdt.insert_constraint(Point(0, 0), Point(0, 0.1));
  const auto side = [](const Point& p) { return p.y() > 0.1 + 0.3 * p.x() ? 2 : 1; };
  const auto centroid = [](Data_cdt::Face_handle f) {
    return CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
  };
  for (const auto f : cdt.finite_face_handles()) f->info() = side(centroid(f));
  const Field first = bump(0.1, 0.1, 0.02, 0.1, 0.3), second = bump(0.9, 0.4, 0.02, 0.1, 0.3);
  weft::make_mesh_2(cdt, first);
  weft::adapt_2(cdt, second);
  std::size_t wrong = 0;
  for (const auto f : cdt.finite_face_handles()) wrong += f->info() != side(centroid(f));
  CHECK(wrong == 0);
}
