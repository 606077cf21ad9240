// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of filling a triangulation with a planar straight line graph and of marking its domain: good input ends
// up in the triangulation exactly, bad input is refused with the elements named, crossings split on request.

#include <weft/planar/graph/insert_pslg.h>

#include <catch2/catch.hpp>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;
using Point = K::Point_2;
using Indices = std::vector<std::size_t>;

/// Adds a closed polygon.
void add_loop(Pslg& pslg, const std::vector<Point>& corners)
{
  const std::size_t first = pslg.points.size(), n = corners.size();
  pslg.points.insert(pslg.points.end(), corners.begin(), corners.end());
  for (std::size_t i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n});
}

/// Adds the boundary of a square with the given centre.
void add_square(Pslg& pslg, double x, double y, double half)
{
  add_loop(pslg, {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}});
}

Pslg square()
{
  Pslg pslg;
  add_square(pslg, 0, 0, 1);
  return pslg;
}

double domain_area(const Cdt& cdt)
{
  double area = 0;
  for (const auto face : cdt.finite_face_handles())
    if (face->is_in_domain()) area += cdt.triangle(face).area();
  return area;
}

double parity_area(const Pslg& pslg)
{
  Cdt cdt;
  weft::insert_pslg(cdt, pslg);
  weft::mark_domain_by_parity(cdt);
  return domain_area(cdt);
}

/// Whether the points lie on constrained edges from one to the other, exactly on the segment.
bool is_union_of_constraints(const Cdt& cdt, Cdt::Vertex_handle from, Cdt::Vertex_handle to)
{
  while (from != to) {
    Cdt::Vertex_handle next;
    auto edge = cdt.incident_edges(from);
    const auto done = edge;
    do {
      if (cdt.is_infinite(*edge) || !cdt.is_constrained(*edge)) continue;
      const auto a = edge->first->vertex(cdt.ccw(edge->second)), b = edge->first->vertex(cdt.cw(edge->second));
      const auto other = a == from ? b : a;
      if (other == to || CGAL::are_strictly_ordered_along_line(from->point(), other->point(), to->point()))
        next = other;
    } while (++edge != done);
    if (next == Cdt::Vertex_handle()) return false;
    from = next;
  }
  return true;
}

/// Refuses the graph and tells which elements and vertices are to blame.
struct Refusal
{
  Indices elements, vertices;
  std::string text;

  explicit Refusal(const Pslg& pslg, const weft::Pslg_options& options = {})
  {
    Cdt cdt;
    try {
      weft::insert_pslg(cdt, pslg, options);
      FAIL("was not refused");
    } catch (const weft::Domain_error& error) {
      elements = error.elements();
      vertices = error.vertices();
      text = error.what();
    }
    CHECK(cdt.number_of_vertices() == 0);
  }
};

const weft::Pslg_options exact = {weft::Crossings::refuse, 0};

Pslg random_segments(unsigned seed, std::size_t n)
{
  std::mt19937 random(seed);
  const auto coordinate = [&random] { return static_cast<double>(random()) / 4294967296.; };
  Pslg pslg;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const double x = coordinate(), y = coordinate();
    pslg.points.emplace_back(x, y);
  }
  for (std::size_t i = 0; i < n; ++i) pslg.segments.push_back({2 * i, 2 * i + 1});
  return pslg;
}

/// Triangulation invariants that hold after every insertion.
void check_structure(const Cdt& cdt)
{
  CHECK(cdt.is_valid());
  // Euler: every edge is enumerated once, no matter how faces are ordered.
  const std::size_t edges = std::distance(cdt.finite_edges_begin(), cdt.finite_edges_end());
  CHECK(edges + 1 == cdt.number_of_vertices() + cdt.number_of_faces());
  for (const auto vertex : cdt.finite_vertex_handles()) CHECK(vertex->constraint() == weft::fixed_vertex);
}

} // namespace

TEST_CASE("every input point is a vertex where it was and every segment a union of constraints")
{
  Pslg pslg = square();
  pslg.points.emplace_back(0.25, 0.5); // isolated
  pslg.points.emplace_back(0.5, -1);   // in the interior of segment 0
  pslg.points.emplace_back(-1, -1);    // the same as point 0
  pslg.segments.push_back({6, 2});     // the same as a diagonal from point 0
  pslg.segments.push_back({1, 0});     // the same as segment 0
  Cdt cdt;
  const auto inserted = weft::insert_pslg(cdt, pslg);
  check_structure(cdt);
  CHECK(cdt.number_of_vertices() == 6);
  REQUIRE(inserted.vertices.size() == pslg.points.size());
  for (std::size_t i = 0; i < pslg.points.size(); ++i) CHECK(inserted.vertices[i]->point() == pslg.points[i]);
  for (const auto& [a, b] : pslg.segments)
    CHECK(is_union_of_constraints(cdt, inserted.vertices[a], inserted.vertices[b]));
  std::map<int, int> edges_of;
  for (const auto& [edge, segment] : inserted.tags.constraints.constrained_edges(cdt)) ++edges_of[segment];
  CHECK(edges_of == std::map<int, int>{{0, 2}, {1, 1}, {2, 1}, {3, 1}, {4, 1}});
}

TEST_CASE("edges know their input segment after refinement")
{
  Pslg pslg = square();
  pslg.points.emplace_back(0.5, -1);
  pslg.segment_markers = {7, 8, 8, -3};
  Cdt cdt;
  const auto markers = weft::insert_pslg(cdt, pslg).tags.constraints;
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;
  CGAL::Delaunay_mesher_2<Cdt, Criteria>(cdt, Criteria(0.125, 0.1)).refine_mesh();
  CHECK(cdt.is_valid());
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
    const auto segment = cdt.segment(*edge);
    const Point middle = CGAL::midpoint(segment.source(), segment.target());
    const int expected = middle.y() == -1 ? 0 : middle.x() == 1 ? 1 : middle.y() == 1 ? 2 : 3;
    CHECK(markers.segment(cdt, edge->first, edge->second) == expected);
    CHECK(markers.constraint_marker(cdt, edge->first, edge->second) == pslg.segment_markers[expected]);
  }
  CHECK(weft::Constraint_markers<K>().segment(cdt, cdt.constrained_edges_begin()->first,
                                              cdt.constrained_edges_begin()->second) == -1);
  const std::size_t edges = std::distance(cdt.finite_edges_begin(), cdt.finite_edges_end());
  CHECK(edges + 1 == cdt.number_of_vertices() + cdt.number_of_faces());
}

TEST_CASE("crossing segments are refused by name")
{
  Pslg pslg = square();
  pslg.segments.push_back({0, 2});
  pslg.segments.push_back({1, 3});
  const Refusal refusal(pslg);
  CHECK(refusal.elements == Indices{4, 5});
  CHECK(refusal.text.find("segments 4 and 5, counted from 0, cross") != std::string::npos);
}

TEST_CASE("messages number points and segments as their file does")
{
  Pslg pslg = square();
  pslg.first_number = 1;
  pslg.segments.push_back({0, 2});
  pslg.segments.push_back({1, 3});
  const Refusal crossing(pslg);
  CHECK(crossing.elements == Indices{4, 5});
  CHECK(crossing.text == "segments 5 and 6, counted from 1, cross");
  pslg.segments[4] = {0, 9};
  CHECK(Refusal(pslg).text == "segment 5, counted from 1, refers to point 10, which doesn't exist");
  pslg.segments[4] = {2, 2};
  pslg.segments.pop_back();
  Cdt cdt;
  CHECK(weft::insert_pslg(cdt, pslg).changes.notes ==
        std::vector<std::string>{"segment 5, counted from 1, has length zero and is left out"});
  pslg.points[3] = Point(0, std::numeric_limits<double>::infinity());
  CHECK(Refusal(pslg).text == "point 4, counted from 1, has a coordinate that is not finite");
}

TEST_CASE("segments that cross by less than rounding are refused")
{
  Pslg pslg = square();
  // The end is one unit in the last place beyond the diagonal.
  const double beyond = std::nextafter(0.3, 0.);
  pslg.points.emplace_back(0.3, beyond);
  pslg.points.emplace_back(-0.5, 0.5);
  pslg.segments.push_back({0, 2});
  pslg.segments.push_back({4, 5});
  CHECK(Refusal(pslg, exact).elements == Indices{4, 5});
  Cdt joined; // within the tolerance it is a T junction
  const auto inserted = weft::insert_pslg(joined, pslg);
  check_structure(joined);
  CHECK(joined.number_of_vertices() == 6);
  CHECK(inserted.changes.split_segments == std::vector<std::array<std::size_t, 2>>{{4, 4}});
  pslg.points[4] = Point(0.3, 0.3);
  Cdt cdt;
  weft::insert_pslg(cdt, pslg); // exactly on it: a T junction
  check_structure(cdt);
  CHECK(cdt.number_of_vertices() == 6);
}

TEST_CASE("overlapping segments are refused by name where there is no tolerance")
{
  Pslg pslg = square();
  pslg.points.emplace_back(0, -1);
  SECTION("from a common end")
  {
    pslg.segments.push_back({0, 4});
    CHECK(Refusal(pslg, exact).elements == Indices{0, 4});
  }
  SECTION("one reaching beyond the other")
  {
    pslg.points.emplace_back(2, -1);
    pslg.segments.push_back({5, 4});
    const Refusal refusal(pslg, exact);
    CHECK(refusal.elements == Indices{0, 4});
    CHECK(refusal.text.find("overlap") != std::string::npos);
  }
  SECTION("one within the other")
  {
    pslg.points.emplace_back(0.5, -1);
    pslg.segments.push_back({5, 4});
    CHECK(Refusal(pslg, exact).elements == Indices{0, 4});
  }
}

TEST_CASE("bad input is refused with what is bad about it")
{
  Pslg pslg;
  CHECK(Refusal(pslg).text.find("no points") != std::string::npos);
  pslg.points = {{0, 0}};
  CHECK(Refusal(pslg).text.find("no segments") != std::string::npos);
  pslg.points.emplace_back(0, 0);
  pslg.segments = {{0, 1}};
  CHECK(Refusal(pslg).text.find("length zero") != std::string::npos);
  CHECK(Refusal(pslg).vertices == Indices{0, 1});
  pslg.segments = {{0, 2}};
  CHECK(Refusal(pslg).elements == Indices{0});
  pslg.points = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  pslg.segments = {{0, 1}, {1, 2}};
  CHECK(Refusal(pslg).text.find("on one line") != std::string::npos);
  pslg.points[3] = Point(3, 4);
  pslg.segments.push_back({2, 3});
  CHECK(Refusal(pslg).text.find("not closed") != std::string::npos);
  CHECK(Refusal(pslg).vertices == Indices{0, 3});
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    pslg = square();
    pslg.points[2] = Point(0, x);
    CHECK(Refusal(pslg).vertices == Indices{2});
    pslg = square();
    pslg.holes = {Point(x, 0)};
    CHECK(Refusal(pslg).text.find("hole 0") != std::string::npos);
  }
  Cdt full;
  full.insert(Point(0, 0));
  CHECK_THROWS_AS(weft::insert_pslg(full, square()), weft::Option_error);
}

TEST_CASE("crossings are split on request and the pieces know their segments")
{
  Pslg pslg = square();
  pslg.points.insert(pslg.points.end(), {{-2, 0}, {2, 0.7}, {0, -2}, {0.3, 2}, {0, -1}});
  pslg.segments.push_back({4, 5});
  pslg.segments.push_back({6, 7});
  pslg.segments.push_back({0, 8}); // overlaps segment 0
  Cdt cdt;
  const auto inserted = weft::insert_pslg(cdt, pslg, {weft::Crossings::split});
  check_structure(cdt);
  CHECK(cdt.number_of_vertices() == 9 + 5); // two with the square by each, and one with each other
  std::map<int, int> edges_of;
  for (const auto& [edge, segment] : inserted.tags.constraints.constrained_edges(cdt)) ++edges_of[segment];
  CHECK(edges_of[4] == 4);
  CHECK(edges_of[5] == 4);
  CHECK(edges_of[-1] == 0);
  CHECK(edges_of.count(6) == 0); // segment 0 owns the common part
  for (std::size_t i = 0; i < pslg.points.size(); ++i) CHECK(inserted.vertices[i]->point() == pslg.points[i]);
}

TEST_CASE("many crossings are split, with pieces close to their segments")
{
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Pslg pslg = random_segments(seed, 120);
    Cdt cdt;
    const auto inserted = weft::insert_pslg(cdt, pslg, {weft::Crossings::split});
    check_structure(cdt);
    CHECK(cdt.number_of_vertices() > 1000);
    for (const auto& [edge, segment] : inserted.tags.constraints.constrained_edges(cdt)) {
      REQUIRE(segment >= 0);
      const auto& [a, b] = pslg.segments[segment];
      const K::Segment_2 line(pslg.points[a], pslg.points[b]);
      CHECK(CGAL::squared_distance(line, cdt.segment(edge).source()) < 1e-28);
      CHECK(CGAL::squared_distance(line, cdt.segment(edge).target()) < 1e-28);
    }
  }
}

TEST_CASE("splitting ends where crossings crowd within rounding of each other")
{
  // Lines that nearly pass through one point, at a place where doubles are coarse.
  for (const double offset : {0., 1e6, 1e15}) {
    Pslg pslg;
    add_square(pslg, offset, offset, 100);
    for (int i = 0; i < 40; ++i) {
      const double a = 0.08 * i;
      pslg.points.emplace_back(offset + 90 * std::cos(a), offset + 90 * std::sin(a));
      pslg.points.emplace_back(offset - 90 * std::cos(a), offset - 90 * std::sin(a) + 1e-14 * i);
      if (pslg.points.back() != *(pslg.points.end() - 2))
        pslg.segments.push_back({pslg.points.size() - 2, pslg.points.size() - 1});
    }
    Cdt cdt;
    weft::insert_pslg(cdt, pslg, {weft::Crossings::split});
    check_structure(cdt);
  }
}

TEST_CASE("segments on a small grid are split whatever they do to each other")
{
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    Pslg pslg;
    add_square(pslg, 0, 0, 10);
    for (int i = 0; i < 24; ++i) pslg.points.emplace_back(int(random() % 7) - 3, int(random() % 7) - 3);
    for (std::size_t i = 4; i < 28; i += 2)
      if (pslg.points[i] != pslg.points[i + 1]) pslg.segments.push_back({i, i + 1});
    Cdt cdt;
    weft::insert_pslg(cdt, pslg, {weft::Crossings::split});
    CHECK(cdt.is_valid());
    Cdt refusing;
    try {
      const auto inserted = weft::insert_pslg(refusing, pslg);
      for (const auto& [a, b] : pslg.segments)
        CHECK(is_union_of_constraints(refusing, inserted.vertices[a], inserted.vertices[b]));
    } catch (const weft::Domain_error& error) {
      REQUIRE(error.elements().size() == 2);
      const auto &s = pslg.segments[error.elements()[0]], &t = pslg.segments[error.elements()[1]];
      CHECK(CGAL::do_intersect(K::Segment_2(pslg.points[s[0]], pslg.points[s[1]]),
                               K::Segment_2(pslg.points[t[0]], pslg.points[t[1]])));
    }
  }
}

TEST_CASE("extreme coordinates are inserted exactly")
{
  for (const double scale : {1e150, 1e-150}) {
    Pslg pslg;
    add_square(pslg, 0, 0, scale);
    pslg.points.emplace_back(0.25 * scale, 0);
    Cdt cdt;
    weft::insert_pslg(cdt, pslg);
    check_structure(cdt);
    weft::mark_domain_by_parity(cdt);
    CHECK(cdt.number_of_vertices() == 5);
  }
}

TEST_CASE("the same graph gives the same triangulation in the same order")
{
  const auto vertices = [] {
    Cdt cdt;
    weft::insert_pslg(cdt, random_segments(5, 60), {weft::Crossings::split});
    std::vector<Point> points;
    for (const auto face : cdt.finite_face_handles())
      for (int i = 0; i < 3; ++i) points.push_back(face->vertex(i)->point());
    return points;
  };
  CHECK(vertices() == vertices());
}

TEST_CASE("triangulations that split crossings themselves get the same checks")
{
  using Tds = CGAL::Triangulation_data_structure_2<weft::Mesh_vertex_base_2<K>, weft::Mesh_face_base_2<K>>;
  using Splitting = CGAL::Constrained_Delaunay_triangulation_2<K, Tds, CGAL::Exact_predicates_tag>;
  Pslg pslg = square();
  pslg.segments.push_back({0, 2});
  Splitting cdt;
  weft::insert_pslg(cdt, pslg);
  CHECK(cdt.number_of_vertices() == 4);
  pslg.segments.push_back({1, 3});
  Splitting other;
  CHECK_THROWS_AS(weft::insert_pslg(other, pslg), weft::Domain_error);
}

TEST_CASE("parity: rings alternate")
{
  Pslg pslg = square(); // area 4
  add_square(pslg, 0, 0, 0.5);
  CHECK(parity_area(pslg) == Approx(3));
  add_square(pslg, 0, 0, 0.25);
  CHECK(parity_area(pslg) == Approx(3.25));
  add_square(pslg, 10, 0, 0.5); // a second component
  CHECK(parity_area(pslg) == Approx(4.25));
}

TEST_CASE("parity: dangling and interior constraints change nothing, shared sides neither")
{
  Pslg pslg = square();
  pslg.points.insert(pslg.points.end(), {{0, 0}, {0.5, 0.5}, {-0.5, 0.5}, {3, 3}, {0, -1}, {0, 1}});
  pslg.segments.push_back({4, 5}); // an open polyline inside
  pslg.segments.push_back({4, 6});
  pslg.segments.push_back({2, 7}); // dangling outwards
  CHECK(parity_area(pslg) == Approx(4));
  pslg = square();
  pslg.points.insert(pslg.points.end(), {{0, -1}, {0, 1}});
  pslg.segments.push_back({4, 5}); // from side to side: two regions of level one
  CHECK(parity_area(pslg) == Approx(4));
}

TEST_CASE("parity: the level is the least number of constraints crossed")
{
  Pslg pslg = square();
  add_loop(pslg, {{-1, -0.5}, {0, -0.5}, {0, 0.5}, {-1, 0.5}}); // shares a part of the outer boundary
  pslg.segments.pop_back();
  CHECK(parity_area(pslg) == Approx(4));
}

TEST_CASE("seeds name holes or the domain")
{
  Pslg pslg = square();
  add_square(pslg, 0, 0, 0.5);
  Cdt cdt;
  weft::insert_pslg(cdt, pslg);
  const std::vector<Point> inner = {{0, 0}}, outer = {{0.75, 0}, {50, 50}}, both = {{0, 0}, {0.75, 0}};
  weft::mark_domain_by_seeds(cdt, inner.begin(), inner.end());
  CHECK(domain_area(cdt) == Approx(3));
  weft::mark_domain_by_seeds(cdt, inner.begin(), inner.end(), true);
  CHECK(domain_area(cdt) == Approx(1));
  weft::mark_domain_by_seeds(cdt, outer.begin(), outer.end(), true);
  CHECK(domain_area(cdt) == Approx(3));
  weft::mark_domain_by_seeds(cdt, inner.end(), inner.end());
  CHECK(domain_area(cdt) == Approx(4));
  CHECK_THROWS_AS(weft::mark_domain_by_seeds(cdt, both.begin(), both.end()), weft::Domain_error);
  CHECK(domain_area(cdt) == 0);
  for (const bool in : {false, true}) { // the same as CGAL's mesher
    Cdt copy = cdt;
    weft::mark_domain_by_seeds(cdt, inner.begin(), inner.end(), in);
    CGAL::Delaunay_mesher_2<Cdt, CGAL::Delaunay_mesh_size_criteria_2<Cdt>>::mark_facets(copy, inner.begin(),
                                                                                        inner.end(), in);
    CHECK(domain_area(cdt) == domain_area(copy));
  }
}

TEST_CASE("an empty domain is refused")
{
  Cdt cdt;
  CHECK_THROWS_AS(weft::mark_domain_by_parity(cdt), weft::Domain_error);
  for (const Point& p : {Point(0, 0), Point(1, 0), Point(0, 1)}) cdt.insert(p);
  CHECK_THROWS_AS(weft::mark_domain_by_parity(cdt), weft::Domain_error);
}

TEST_CASE("components are numbered from the outside and separated by constraints")
{
  Pslg pslg = square();
  add_square(pslg, 0, 0, 0.5);
  add_square(pslg, 5, 0, 0.5);
  Cdt cdt;
  weft::insert_pslg(cdt, pslg);
  CHECK(weft::label_components(cdt) == 4);
  CHECK(cdt.infinite_face()->id() == 0);
  std::set<int> seen;
  int highest = 0;
  for (const auto face : cdt.finite_face_handles()) {
    if (seen.insert(face->id()).second && face->id() != 0) CHECK(face->id() == ++highest);
    for (int i = 0; i < 3; ++i) CHECK((face->is_constrained(i) || face->neighbor(i)->id() == face->id()));
  }
  CHECK(highest == 3);
}
