// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's own mesh domains and criteria: polyhedral, with features, and polyhedral complexes.

#include "fixtures/complex_cgal_domain.h"

#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace parameters = CGAL::parameters;
using namespace cgal_domains;

using Surface = CGAL::Surface_mesh<Point>;

/// A domain of CGAL's that counts how often it is asked, and may mean the opposite of what its triangles say.
class Watched_domain : public CGAL::Polyhedral_mesh_domain_3<Surface, K>
{
public:
  Watched_domain(const Surface& surface, bool is_inverted)
      : CGAL::Polyhedral_mesh_domain_3<Surface, K>(surface), is_inverted_(is_inverted)
  {}

  auto is_in_domain_object() const
  {
    return [this](const Point& p) {
      ++questions;
      const auto inside = CGAL::Polyhedral_mesh_domain_3<Surface, K>::is_in_domain_object()(p);
      return is_inverted_ ? (inside ? Subdomain() : Subdomain(1)) : inside;
    };
  }

  mutable int questions = 0;

private:
  bool is_inverted_;
};

/// Part of the boundary of the box [x0, x1] x [0, 1] x [0, 1]: the sides of which `takes` says so, in the order x0, x1,
/// y0, y1, z0, z1.
Polyhedron box(double x0, double x1, const std::string& takes)
{
  static const char* const sides[] = {"3 0 4 6\n3 0 6 2\n", "3 1 3 7\n3 1 7 5\n", "3 0 1 5\n3 0 5 4\n",
                                      "3 2 6 7\n3 2 7 3\n", "3 0 2 3\n3 0 3 1\n", "3 4 5 7\n3 4 7 6\n"};
  std::vector<std::string> facets;
  for (std::size_t i = 0; i < 6; ++i)
    if (takes[i] == '1') facets.push_back(sides[i]);
  std::ostringstream off;
  off << "OFF\n8 " << 2 * facets.size() << " 0\n";
  for (const int z : {0, 1})
    for (const int y : {0, 1})
      for (const double x : {x0, x1}) off << x << " " << y << " " << z << "\n";
  for (const std::string& facet : facets) off << facet;
  std::istringstream in(off.str());
  Polyhedron polyhedron;
  in >> polyhedron;
  return polyhedron;
}

double squared_distance_to(const Surface& surface, const Point& p)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto f : surface.faces()) {
    const auto side = surface.halfedge(f);
    const K::Triangle_3 triangle(surface.point(surface.source(side)), surface.point(surface.target(side)),
                                 surface.point(surface.target(surface.next(side))));
    least = (std::min)(least, CGAL::squared_distance(p, triangle));
  }
  return least;
}

} // namespace

TEST_CASE("a polyhedral complex keeps its features, its subdomains and CGAL's indices")
{
  const std::vector<Polyhedron> parts = {box(0, 1, "101111"), box(1, 2, "011111"), box(0, 1, "010000")};
  const std::vector<std::pair<int, int>> sides = {{1, 0}, {2, 0}, {1, 2}};
  Complex_domain domain(parts.begin(), parts.end(), sides.begin(), sides.end());
  domain.detect_features();
  const Complex_criteria criteria(parameters::edge_size = 0.2, parameters::facet_angle = 25,
                                  parameters::facet_size = 0.2, parameters::facet_distance = 0.01,
                                  parameters::cell_radius_edge_ratio = 3, parameters::cell_size = 0.2);
  weft::Mesh_report_3 report;
  const auto c3t3 = weft::make_mesh_3<Complex_c3t3>(domain, criteria, weft::Mesh_options_3(), &report);
  INFO(report);
  CHECK(report.ok());
  CHECK(report.corner_vertices == 12);
  CHECK(count_bad(c3t3, criteria) == 0);
  auto volume = volumes(c3t3);
  CHECK(volume[1] == Approx(1).epsilon(1e-6));
  CHECK(volume[2] == Approx(1).epsilon(1e-6));
  std::size_t corners = 0;
  for (auto v = c3t3.vertices_in_complex_begin(); v != c3t3.vertices_in_complex_end(); ++v) ++corners;
  CHECK(corners == 12);
  std::set<Complex_domain::Curve_index> curves;
  for (auto e = c3t3.edges_in_complex_begin(); e != c3t3.edges_in_complex_end(); ++e) {
    curves.insert(c3t3.curve_index(*e));
    CHECK(c3t3.triangulation().segment(*e).squared_length() <= 0.04 * (1 + 1e-9));
  }
  CHECK(curves.size() == 20);
}

TEST_CASE("a CGAL domain of triangles is known by those")
{
  Surface surface;
  CGAL::copy_face_graph(box(0, 1, "111111"), surface);
  CGAL::copy_face_graph(box(3, 3.01, "111111"), surface); // thin, and far from the other
  const Watched_domain domain(surface, false);
  const weft::Mesh_domain_oracle_3<Watched_domain> oracle(domain);
  const int questions = domain.questions;
  CGAL::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto coordinate = [&](double low, double high) { return random.get_double(low, high); };
    const Point p(coordinate(-0.2, 3.2), coordinate(-0.2, 1.2), coordinate(-0.2, 1.2)),
        q(coordinate(-0.2, 3.2), coordinate(-0.2, 1.2), coordinate(-0.2, 1.2));
    const bool inside = domain.CGAL::Polyhedral_mesh_domain_3<Surface, K>::is_in_domain_object()(p).has_value();
    CHECK(oracle.subdomain(p) == (inside ? 1 : 0));
    const auto nearest = oracle.closest(p);
    CHECK(CGAL::squared_distance(p, nearest.point) == Approx(squared_distance_to(surface, p)).margin(1e-12));
    const double distance = std::sqrt(CGAL::squared_distance(p, nearest.point));
    CHECK(oracle.is_within(p, 1.001 * 1.001 * distance * distance));
    CHECK_FALSE(oracle.is_within(p, 0.998 * distance * distance));
    CHECK(oracle.is_clear(p, 0.9 * distance - 1e-5)); // which may be wrong by that
    CHECK_FALSE(oracle.is_clear(p, 1.01 * distance + 1e-9));
    std::vector<weft::Surface_hit_3<Watched_domain::R>> hits;
    if (oracle.intersect(p, q, hits) == 0) continue;
    REQUIRE(hits.size() == 1);
    CHECK(squared_distance_to(surface, hits[0].point) < 1e-20);
    CHECK(CGAL::squared_distance(hits[0].point, K::Segment_3(p, q)) < 1e-20);
  }
  CHECK(domain.questions == questions);
  const auto seeds = oracle.patch_seeds(0, 5); // of either box
  CHECK(seeds.size() == 10);
  CHECK(std::count_if(seeds.begin(), seeds.end(), [](const auto& seed) { return seed.point.x() > 2; }) == 5);
}

TEST_CASE("a domain that means something else than its triangles is asked")
{
  Surface surface;
  CGAL::copy_face_graph(box(0, 1, "111111"), surface);
  const Watched_domain domain(surface, true);
  const weft::Mesh_domain_oracle_3<Watched_domain> oracle(domain);
  const int questions = domain.questions;
  CHECK(oracle.subdomain(Point(0.5, 0.5, 0.5)) == 0);
  CHECK(oracle.subdomain(Point(1.0005, 0.5, 0.5)) == 1);
  CHECK(domain.questions == questions + 2);
}

TEST_CASE("surfaces within a subdomain are refused")
{
  const Polyhedron sheet = box(0.2, 0.8, "100000"), surface = box(0, 1, "111111");
  using Domain = CGAL::Polyhedral_mesh_domain_3<Polyhedron, K>;
  const Domain domain(sheet, surface);
  CHECK_THROWS_WITH(weft::Mesh_domain_oracle_3<Domain>(domain), Catch::Contains("2 of the domain's 14 triangles"));
  const std::vector<Polyhedron> parts = {box(0, 1, "111111"), box(0.2, 0.8, "010000")};
  const std::vector<std::pair<int, int>> sides = {{1, 0}, {1, 1}};
  const Complex_domain complex(parts.begin(), parts.end(), sides.begin(), sides.end());
  CHECK_THROWS_AS(weft::Mesh_domain_oracle_3<Complex_domain>(complex), weft::Domain_error);
}
