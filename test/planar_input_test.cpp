// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of inputs that are less than perfect, or say more than their outlines: parts that touch up to rounding,
// points that nearly coincide, points of holes and regions, sizes per region.

#include "fixtures/meshing_2.h"

#include <weft/planar/graph/Mesh_marks_2.h>
#include <weft/planar/sizing/Region_sizing_2.h>

#include <string>
#include <vector>

namespace {

using namespace planar;
using Pair = std::array<std::size_t, 2>;
const double default_tolerance = weft::Pslg_options().tolerance;

/// A rectangle with its lower left corner at (x, y), turned around the origin.
void add_turned_rectangle(Pslg& pslg, double x, double y, double width, double height, double degrees)
{
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  const auto turned = [=](double px, double py) { return Point(c * px - s * py, s * px + c * py); };
  add_loop(pslg, {turned(x, y), turned(x + width, y), turned(x + width, y + height), turned(x, y + height)});
  pslg.regions.push_back({turned(x + width / 2, y + height / 2), static_cast<int>(pslg.regions.size()) + 1});
}

/// Cuts a rectangle at random until `parts` are left. Each part has corners of its own, off by `noise`.
void add_random_parts(Pslg& pslg, Random& random, const std::array<double, 4>& box, int parts, double degrees,
                      double noise)
{
  const auto [x, y, width, height] = box;
  if (parts == 1) {
    const std::size_t first = pslg.points.size();
    add_turned_rectangle(pslg, x, y, width, height, degrees);
    for (std::size_t i = first; i < pslg.points.size(); ++i) {
      const double dx = uniform(random, -noise, noise), dy = uniform(random, -noise, noise);
      pslg.points[i] = Point(pslg.points[i].x() + dx, pslg.points[i].y() + dy);
    }
    return;
  }
  const int left = parts / 2;
  const double at = uniform(random, 0.3, 0.7);
  if (width > height) {
    add_random_parts(pslg, random, {x, y, at * width, height}, left, degrees, noise);
    add_random_parts(pslg, random, {x + at * width, y, width - at * width, height}, parts - left, degrees, noise);
  } else {
    add_random_parts(pslg, random, {x, y, width, at * height}, left, degrees, noise);
    add_random_parts(pslg, random, {x, y + at * height, width, height - at * height}, parts - left, degrees, noise);
  }
}

double area(const Cdt& cdt, const std::function<bool(Cdt::Face_handle)>& counts)
{
  double sum = 0;
  for (const auto face : cdt.finite_face_handles())
    if (counts(face)) sum += cdt.triangle(face).area();
  return sum;
}

double domain_area(const Cdt& cdt)
{
  return area(cdt, [](Cdt::Face_handle face) { return face->is_in_domain(); });
}

/// Whether one can walk through all of the domain, across constraints.
bool is_connected(const Cdt& cdt)
{
  std::set<Cdt::Face_handle> left;
  for (const auto face : cdt.finite_face_handles())
    if (face->is_in_domain()) left.insert(face);
  std::vector<Cdt::Face_handle> stack{*left.begin()};
  left.erase(left.begin());
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i)
      if (left.erase(face->neighbor(i)) > 0) stack.push_back(face->neighbor(i));
  }
  return left.empty();
}

/// Looks at all pairs: two vertices within the tolerance, or a vertex within it of a constraint between its ends?
bool keeps_distance(const Cdt& cdt, double tolerance)
{
  const double squared = tolerance * tolerance;
  for (const auto v : cdt.finite_vertex_handles()) {
    for (const auto w : cdt.finite_vertex_handles())
      if (v != w && !(CGAL::squared_distance(v->point(), w->point()) > squared)) return false;
    for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
      const auto s = cdt.segment(*edge);
      const bool beside = CGAL::compare_distance_to_point(s.source(), v->point(), s.target()) == CGAL::SMALLER &&
                          CGAL::compare_distance_to_point(s.target(), v->point(), s.source()) == CGAL::SMALLER;
      if (beside && v->point() != s.source() && v->point() != s.target() &&
          !(CGAL::squared_distance(s, v->point()) > squared))
        return false;
    }
  }
  return true;
}

weft::Inserted_pslg<Cdt> insert(Cdt& cdt, const Pslg& pslg, double tolerance = default_tolerance)
{
  return weft::insert_pslg(cdt, pslg, {weft::Crossings::refuse, tolerance});
}

} // namespace

// ---- Parts that touch

TEST_CASE("rectangles side by side, turned by any angle, become one conforming mesh")
{
  for (int degrees = 0; degrees < 90; ++degrees) {
    CAPTURE(degrees);
    Pslg pslg;
    add_turned_rectangle(pslg, 0, 0, 2, 3, degrees);
    add_turned_rectangle(pslg, 2, 0.4, 1, 2, degrees); // a part of the common side
    Cdt cdt;
    const auto inserted = insert(cdt, pslg);
    CHECK(cdt.number_of_vertices() == 8);
    CHECK(weft::mark_domain(cdt, pslg).warnings.empty());
    const auto report = weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.2));
    CHECK(report.ok());
    CHECK(report.smallest_angle >= 30);
    CHECK(report.triangles < 700);
    CHECK(mesh_faults(cdt, inserted.graph) == "");
    CHECK(is_connected(cdt));
    const weft::Mesh_marks_2<Cdt> marks(cdt, inserted.tags);
    for (const int region : {1, 2})
      CHECK(area(cdt, [&](auto face) { return marks.region(face) == region; }) == Approx(region == 1 ? 6 : 2));
  }
}

namespace {

bool is_whole_without_tolerance(const Pslg& pslg)
{
  Cdt cdt;
  try {
    insert(cdt, pslg, 0);
  } catch (const weft::Domain_error&) {
    return false;
  }
  weft::mark_domain(cdt, pslg);
  return is_connected(cdt);
}

void check_random_parts(unsigned seed, int rounds)
{
  Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    CAPTURE(round);
    const double degrees = uniform(random, 0, 360), noise = round % 3 ? 1e-11 : 1e-7;
    const double tolerance = round % 3 ? default_tolerance : 1e-6;
    Pslg pslg;
    add_random_parts(pslg, random, {-1, -1, 2, 2}, 2 + round % 40, degrees, noise);
    Cdt cdt;
    const auto inserted = insert(cdt, pslg, tolerance);
    CHECK(weft::mark_domain(cdt, pslg).warnings.empty()); // each region has a part of its own
    CHECK(!inserted.changes.empty());
    CHECK(domain_area(cdt) == Approx(4).epsilon(1e-5));
    CHECK(weft::label_components(cdt) == 1 + static_cast<int>(pslg.regions.size()));
    CHECK(keeps_distance(cdt, tolerance));
    CHECK(faults(weft::validate_2(cdt, inserted.graph)) == "");
    for (std::size_t i = 0; i < pslg.points.size(); ++i)
      CHECK(CGAL::squared_distance(inserted.vertices[i]->point(), pslg.points[i]) <= std::pow(4 * tolerance, 2));
    CHECK(!is_whole_without_tolerance(pslg)); // else the case says nothing
  }
}

} // namespace

TEST_CASE("random parts that touch within the tolerance are joined without a gap or an overlap")
{
  check_random_parts(3, 30);
}

TEST_CASE("many random parts that touch are joined", "[.nightly]")
{
  check_random_parts(4, 1500);
}

TEST_CASE("a graph without anything close is inserted bit for bit as without a tolerance")
{
  Random random(5);
  std::vector<Pslg> graphs;
  for (const Domain& domain : domains()) graphs.push_back(domain.pslg);
  for (int kind = 0; kind < 4; ++kind) graphs.push_back(random_pslg(kind, random));
  graphs.push_back(collinear_chains(random, 20)); // flat triangles along the hull, but nothing is close
  std::size_t compared = 0;
  for (const Pslg& pslg : graphs)
    for (const double scale : {1., 1e-8, 1e8}) {
      const Pslg scaled = transformed(pslg, scale, 0.3, 0, 0);
      Cdt with, without;
      weft::Inserted_pslg<Cdt> inserted;
      try {
        insert(without, scaled, 0);
        inserted = insert(with, scaled);
      } catch (const weft::Domain_error&) {
        continue; // crossings by rounding
      }
      if (!inserted.changes.empty()) continue;
      ++compared;
      CHECK(fingerprint(with) == fingerprint(without));
      CHECK(inserted.graph.segments.size() ==
            static_cast<std::size_t>(std::distance(with.constrained_edges_begin(), with.constrained_edges_end())));
    }
  CHECK(compared > 2 * graphs.size());
  for (const Domain& domain : domains()) {
    Cdt cdt;
    CHECK(insert(cdt, domain.pslg).changes.empty());
  }
}

TEST_CASE("rounding far from the origin is no more than rounding near it")
{
  for (const double offset : {1e3, 1e6, 1e9, 1e12}) {
    CAPTURE(offset);
    Pslg pslg;
    add_turned_rectangle(pslg, 0, 0, 100, 100, 25);
    add_turned_rectangle(pslg, 100, 20, 100, 50, 25);
    pslg = transformed(pslg, 1, 0, offset, -offset);
    Cdt cdt;
    insert(cdt, pslg);
    CHECK(weft::label_components(cdt) == 3);
    CHECK(cdt.number_of_vertices() == 8);
  }
}

// ---- Points that nearly coincide

TEST_CASE("an outline whose last point misses the first is closed, and says so")
{
  Pslg pslg = circle(24);
  pslg.points.emplace_back(pslg.points[0].x() + 1e-16, pslg.points[0].y() - 3e-16);
  pslg.segments.back()[1] = 24;
  pslg.point_markers.assign(25, 0);
  for (int i = 0; i < 25; ++i) pslg.point_markers[static_cast<std::size_t>(i)] = i;
  CHECK_THROWS_AS(insert(*std::make_unique<Cdt>(), pslg, 0), weft::Domain_error);
  Cdt cdt;
  const auto inserted = insert(cdt, pslg);
  CHECK(cdt.number_of_vertices() == 24);
  CHECK(inserted.vertices[24] == inserted.vertices[0]);
  CHECK(inserted.graph.point_markers[0] == 0);
  CHECK(inserted.changes.merged_points == std::vector<Pair>{{24, 0}});
  REQUIRE(inserted.changes.notes.size() == 1);
  CHECK(inserted.changes.notes[0] == "point 24, counted from 0, is joined to point 0 close to it");
}

TEST_CASE("a corner given twice is one, whether its segment has length zero or nearly")
{
  for (const double miss : {0., 1e-17, 1e-12}) {
    Pslg pslg;
    add_loop(pslg, {{0, 0}, {4, 0}, {4, 3}, {1, 3}, {1 + miss, 3}});
    Cdt cdt;
    const auto inserted = insert(cdt, pslg);
    CHECK(cdt.number_of_vertices() == 4);
    CHECK(inserted.changes.dropped_segments == std::vector<std::size_t>{3});
    CHECK(inserted.vertices[3] == inserted.vertices[4]);
    weft::mark_domain(cdt, pslg);
    CHECK(domain_area(cdt) == Approx(10.5));
    if (miss == 0) CHECK(insert(*std::make_unique<Cdt>(), pslg, 0).changes.dropped_segments.size() == 1);
  }
}

TEST_CASE("a row of points nearer to each other than the tolerance keeps its shape")
{
  Pslg pslg = circle(5000);
  const double tolerance = 3e-3; // three times the distance of the points
  Cdt cdt;
  insert(cdt, pslg, tolerance);
  CHECK(keeps_distance(cdt, tolerance));
  weft::mark_domain_by_parity(cdt);
  CHECK(domain_area(cdt) == Approx(pi / 4).epsilon(1e-3));
}

TEST_CASE("numbers of what was joined are those of the input")
{
  Pslg pslg;
  pslg.first_number = 1;
  pslg.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 1e-13}, {1, 1 + 1e-14}, {0.2, 0}, {0.8, 0}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {6, 7}};
  Cdt cdt;
  const auto inserted = insert(cdt, pslg);
  CHECK(inserted.changes.merged_points == std::vector<Pair>{{5, 2}});
  CHECK(inserted.changes.overlapping_segments == std::vector<Pair>{{0, 4}});
  const auto& split = inserted.changes.split_segments;
  CHECK(std::count(split.begin(), split.end(), Pair{0, 4}) == 1);
  CHECK(inserted.changes.notes.front() == "point 6, counted from 1, is joined to point 3 close to it");
  CHECK(cdt.number_of_vertices() == 7);
  for (const double bad : {-1., 0.2, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(insert(*std::make_unique<Cdt>(), pslg, bad), weft::Option_error);
}

// ---- Holes and regions

namespace {

/// A plate of 10 x 10 with an inclusion of 2 x 2 in the middle.
Pslg plate()
{
  Pslg pslg;
  pslg.first_number = 1;
  add_loop(pslg, {{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_square(pslg, 5, 5, 1);
  return pslg;
}

struct Marked
{
  Cdt cdt;
  weft::Mesh_tags_2<K> tags;
  weft::Domain_marks marks;

  explicit Marked(const Pslg& pslg)
  {
    tags = insert(cdt, pslg).tags;
    marks = weft::mark_domain(cdt, pslg);
  }
  double area() const { return domain_area(cdt); }
};

} // namespace

TEST_CASE("a region belongs to the domain wherever its point lies")
{
  Pslg pslg = plate();
  CHECK(Marked(pslg).area() == Approx(96));
  pslg.regions = {{{1, 1}, 1}, {{5, 5}, 2}};
  Marked both(pslg);
  CHECK(both.area() == Approx(100));
  CHECK(both.marks.warnings.empty());
  weft::make_mesh_2(both.cdt, weft::Uniform_sizing<>(1));
  const weft::Mesh_marks_2<Cdt> marks(both.cdt, both.tags);
  CHECK(area(both.cdt, [&](auto face) { return marks.region(face) == 2; }) == Approx(4));
  CHECK(area(both.cdt, [&](auto face) { return marks.region(face) == 1; }) == Approx(96));
}

TEST_CASE("points that name nothing, or the same, are warned about by number")
{
  Pslg pslg = plate();
  SECTION("a hole's point on a segment")
  {
    pslg.holes = {{5, 4}};
    const Marked m(pslg);
    CHECK(m.area() == Approx(100));
    CHECK(m.marks.warnings ==
          std::vector<std::string>{"the point of hole 1, counted from 1, lies on a segment, so it names no hole"});
  }
  SECTION("nearly on a turned one")
  {
    pslg = transformed(pslg, 1, 0.7, 0, 0);
    const Point p = CGAL::midpoint(pslg.points[4], pslg.points[5]);
    pslg.holes = {p};
    CHECK(Marked(pslg).marks.holes_on_constraints.size() == 1);
  }
  SECTION("on a corner, on the outer boundary")
  {
    pslg.holes = {{4, 4}, {10, 3}};
    CHECK(Marked(pslg).marks.holes_on_constraints == std::vector<std::size_t>{0, 1});
  }
  SECTION("outside")
  {
    pslg.holes = {{5, 5}, {50, 50}};
    pslg.regions = {{{-1, 0}, 3}, {{1, 1}, 2}};
    const Marked m(pslg);
    CHECK(m.area() == Approx(96));
    CHECK(m.marks.holes_outside == std::vector<std::size_t>{1});
    CHECK(m.marks.regions_outside == std::vector<std::size_t>{0});
    CHECK(m.marks.warnings.size() == 2);
  }
  SECTION("a region in a hole, two in one part, a part without one")
  {
    add_square(pslg, 2, 2, 0.5);
    pslg.holes = {{5, 5}};
    pslg.regions = {{{5.5, 5.5}, 1}, {{1, 1}, 2}, {{9, 9}, 3}, {{4, 5}, 4}};
    const Marked m(pslg);
    CHECK(m.area() == Approx(96));
    CHECK(m.marks.regions_in_holes == std::vector<std::size_t>{0});
    CHECK(m.marks.regions_overruled == std::vector<std::size_t>{1});
    CHECK(m.marks.regions_on_constraints == std::vector<std::size_t>{3});
    CHECK(m.marks.unnamed_parts == 1);
    CHECK(m.marks.warnings.size() == 4);
    CHECK(m.tags.regions.size() == 3);
  }
}

TEST_CASE("each region has its size, and areas bound triangles")
{
  Pslg pslg = plate();
  pslg.regions = {{{1, 1}, 1}, {{5, 5}, 2}};
  const auto smaller = [](double a, double b) { return a < b * (1 + 1e-9); };
  for (const bool by_area : {false, true}) {
    const double largest_area = 0.004, edge = std::sqrt(4 / std::sqrt(3.) * largest_area);
    if (by_area) pslg.regions[1].max_area = largest_area;
    Marked m(pslg);
    const auto sizes = by_area ? std::map<int, double>() : std::map<int, double>{{2, edge}};
    const weft::Region_sizing_2<Cdt> field(m.cdt, m.tags, 1.5, sizes);
    CHECK(field(Point(5, 5)) == Approx(edge));
    CHECK(field(Point(0, 0)) == Approx(1.5));
    CHECK(field(Point(3, 5)) == Approx(edge + 0.5)); // grows from the inclusion
    const auto report = weft::make_mesh_2(m.cdt, Field(field));
    CHECK(report.ok());
    CHECK(report.smallest_angle > 25);
    const weft::Mesh_marks_2<Cdt> marks(m.cdt, m.tags);
    double outer = 0;
    for (const auto face : m.cdt.finite_face_handles()) {
      const double a = m.cdt.triangle(face).area();
      if (marks.region(face) == 2) CHECK(smaller(a, largest_area));
      outer = (std::max)(outer, a);
    }
    CHECK(outer > 20 * largest_area);
  }
  const Marked m(pslg);
  CHECK_THROWS_AS(weft::Region_sizing_2<Cdt>(m.cdt, m.tags, 1, {{7, 0.1}}), weft::Option_error);
  CHECK_THROWS_AS(weft::Region_sizing_2<Cdt>(m.cdt, m.tags, 1, {{1, -0.1}}), weft::Option_error);
}
