// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the bounded Voronoi diagram, most of them against brute force with exact arithmetic.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>
#include <weft/planar/triangulation/Bounded_voronoi_diagram_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Point = K::Point_2;
using Segment = K::Segment_2;
using Cdt = weft::Mesh_triangulation_2<K>;
using Diagram = weft::Bounded_voronoi_diagram_2<Cdt>;
using Polygon = std::vector<Point>;
using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

Exact::Point_2 exact(const Point& p)
{
  return {p.x(), p.y()};
}

/// Constrained points and closed rings; the domain is what lies in the first ring and in none of the others.
struct Input
{
  std::vector<Polygon> rings;
  std::vector<Segment> segments;
  Polygon points;

  bool crosses(const Segment& s) const
  {
    const auto hits = [&](const Segment& t) {
      for (const Point& p : {t.source(), t.target()})
        if (p == s.source() || p == s.target()) // meeting at an end is fine
          return CGAL::collinear(s.source(), s.target(), t.source() == p ? t.target() : t.source());
      return CGAL::do_intersect(s, t);
    };
    for (const Polygon& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (hits(Segment(ring[i], ring[(i + 1) % ring.size()]))) return true;
    return std::any_of(segments.begin(), segments.end(), hits);
  }
  bool contains(const Point& p) const
  {
    for (std::size_t i = 0; i < rings.size(); ++i)
      if ((CGAL::bounded_side_2(rings[i].begin(), rings[i].end(), p) == CGAL::ON_BOUNDED_SIDE) != (i == 0))
        return false;
    return true;
  }
};

Polygon unit_square()
{
  return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

Input random_input(unsigned seed)
{
  Random random(seed);
  Input in;
  in.rings.push_back(unit_square());
  if (seed % 3 != 0) in.rings.push_back({{0.4, 0.35}, {0.65, 0.45}, {0.5, 0.5}, {0.45, 0.7}}); // reflex corner
  if (seed % 4 == 1)                                                                           // a thin channel
    for (int i = 0; i < 5; ++i)
      in.segments.emplace_back(Point(0.05 + 0.07 * i, 0.8 + 0.01 * i), Point(0.9 - 0.03 * i, 0.8 + 0.0101 * i));
  if (seed % 5 == 2) in.segments.emplace_back(Point(0.5, 0.5), Point(0.8, 0.75)); // hangs on the hole, or dangles
  const int segment_count = static_cast<int>(random() % 12);
  for (int i = 0; i < segment_count; ++i) {
    const Point p{uniform(random, 0.01, 0.99), uniform(random, 0.01, 0.99)};
    const double length = i % 2 == 0 ? 0.7 : 0.1;
    const Point q{p.x() + uniform(random, -length, length), p.y() + uniform(random, -length, length)};
    const Segment s(p, q);
    if (in.contains(p) && in.contains(q) && !in.crosses(s)) in.segments.push_back(s);
  }
  const int point_count = static_cast<int>(random() % (seed % 2 == 0 ? 8 : 60));
  for (int i = 0; i < point_count; ++i) {
    const Point p{uniform(random, 0, 1), uniform(random, 0, 1)};
    if (in.contains(p)) in.points.push_back(p);
  }
  return in;
}

/// Everything on a coarse grid: cocircular points, right angles, points on constraints, chains and crossings of walls.
Input grid_input(unsigned seed)
{
  Random random(seed);
  Input in;
  in.rings.push_back(unit_square());
  if (seed % 3 != 0) in.rings.push_back({{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.625}, {0.375, 0.375}});
  const auto any = [&] { return Point{(random() % 17) / 16.0, (random() % 17) / 16.0}; };
  Point p = any();
  for (int i = 0; i < 30; ++i) {
    const Point q = any();
    const Segment s(p, q);
    if (p != q && in.contains(CGAL::midpoint(p, q)) && !in.crosses(s)) in.segments.push_back(s);
    if (i % 3 != 0) p = q;
  }
  for (unsigned i = random() % 60; i > 0; --i) in.points.push_back(any());
  const auto outside = [&](const Point& q) { return !in.contains(q); };
  in.points.erase(std::remove_if(in.points.begin(), in.points.end(), outside), in.points.end());
  return in;
}

/// Inputs in general position, then, from `first_grid_input` on, degenerate ones.
constexpr unsigned first_grid_input = 40, input_count = 80;
Input input_number(unsigned i)
{
  return i < first_grid_input ? random_input(i) : grid_input(i);
}

Cdt triangulate(const Input& in, unsigned shuffle_seed = 0)
{
  Cdt cdt;
  std::vector<Segment> segments = in.segments;
  Polygon points = in.points;
  for (const Polygon& ring : in.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) segments.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  if (shuffle_seed != 0) {
    Random random(shuffle_seed);
    for (std::size_t i = segments.size(); i > 1; --i) std::swap(segments[i - 1], segments[random() % i]);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random() % i]);
    for (const Point& p : points) cdt.insert(p);
  }
  for (const Segment& s : segments) cdt.insert_constraint(s.source(), s.target());
  for (const Point& p : points) cdt.insert(p);
  for (Cdt::Face_handle f : cdt.finite_face_handles()) f->set_in_domain(in.contains(CGAL::centroid(cdt.triangle(f))));
  return cdt;
}

std::vector<Cdt::Edge> walls_of(const Diagram& diagram)
{
  std::vector<Cdt::Edge> walls;
  for (Cdt::Face_handle f : diagram.triangulation().finite_face_handles())
    for (int i = 0; i < 3; ++i)
      if (diagram.is_in_domain(f) && diagram.is_wall({f, i})) walls.emplace_back(f, i);
  return walls;
}

/// The visible sites by distance, at most two; nothing but segment tests.
std::vector<Cdt::Vertex_handle> nearest_visible(const Diagram& diagram, const std::vector<Cdt::Edge>& walls,
                                                const Point& p)
{
  const Cdt& cdt = diagram.triangulation();
  std::vector<Cdt::Vertex_handle> visible;
  for (Cdt::Vertex_handle v : cdt.finite_vertex_handles()) {
    const bool hidden = !diagram.has_cell(v) || std::any_of(walls.begin(), walls.end(), [&](const Cdt::Edge& wall) {
      const Segment s = cdt.segment(wall);
      return s.source() != v->point() && s.target() != v->point() && CGAL::do_intersect(s, Segment(p, v->point()));
    });
    if (!hidden) visible.push_back(v);
  }
  std::sort(visible.begin(), visible.end(),
            [&](auto a, auto b) { return CGAL::has_smaller_distance_to_point(p, a->point(), b->point()); });
  if (visible.size() > 2) visible.resize(2);
  return visible;
}

double distance(const Point& p, const Point& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

/// Even-odd rule, which doesn't mind slits.
bool polygon_contains(const Polygon& polygon, const Point& p)
{
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

double signed_area(const Polygon& polygon)
{
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Turns right nowhere by more than rounding.
bool is_convex(const Polygon& polygon)
{
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()], &c = polygon[(i + 2) % polygon.size()];
    if (CGAL::determinant(b - a, c - b) < -1e-11) return false;
  }
  return true;
}

template <class Triangulation>
typename Triangulation::Vertex_handle vertex_at(const Triangulation& cdt, double x, double y)
{
  for (typename Triangulation::Vertex_handle v : cdt.finite_vertex_handles())
    if (v->point() == typename Triangulation::Point(x, y)) return v;
  return nullptr;
}

/// Side of the line s, t on which the circumcenter lies, by construction in rationals.
CGAL::Orientation side_by_construction(const Point& a, const Point& b, const Point& c, const Point& s, const Point& t)
{
  return CGAL::orientation(exact(s), exact(t), CGAL::circumcenter(exact(a), exact(b), exact(c)));
}

using Coordinates = std::pair<double, double>;
Coordinates coordinates(const Point& p)
{
  return {p.x(), p.y()};
}

/// For every blind face of the domain, by coordinates: its corners and the ends of its wall.
std::map<std::array<Coordinates, 3>, std::array<Coordinates, 2>> tags_of(const Diagram& diagram)
{
  std::map<std::array<Coordinates, 3>, std::array<Coordinates, 2>> tags;
  for (Cdt::Face_handle f : diagram.triangulation().finite_face_handles()) {
    if (!diagram.is_in_domain(f) || !diagram.is_blind(f)) continue;
    std::array<Coordinates, 3> face;
    for (int i = 0; i < 3; ++i) face[i] = coordinates(f->vertex(i)->point());
    std::sort(face.begin(), face.end());
    const Segment wall = diagram.triangulation().segment(diagram.blinding_edge(f));
    tags[face] = {coordinates(wall.source()), coordinates(wall.target())}; // counterclockwise in the near face
  }
  return tags;
}

} // namespace

TEST_CASE("the blindness predicate agrees with an exactly constructed circumcenter")
{
  Random random(1);
  const weft::internal::Side_of_circumcenter_2<K> side;
  const weft::internal::Is_blinded_by_2<K> is_blinded;
  int degenerate = 0, blinded = 0;
  const auto check = [&](const Point& a, const Point& b, const Point& c, const Point& s, const Point& t) {
    if (CGAL::collinear(a, b, c) || s == t) return;
    const CGAL::Orientation expected = side_by_construction(a, b, c, s, t);
    REQUIRE(side(a, b, c, s, t) == expected);
    REQUIRE(side(c, b, a, s, t) == expected);
    REQUIRE(side(a, b, c, t, s) == -expected);
    degenerate += expected == CGAL::COLLINEAR;
    const std::array<int, 3> at{CGAL::orientation(s, t, a), CGAL::orientation(s, t, b), CGAL::orientation(s, t, c)};
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    if (*low * *high < 0) return; // straddles the line
    const int triangle_side = *low + *high > 0 ? 1 : -1;
    REQUIRE(is_blinded(a, b, c, s, t) == (expected == -triangle_side));
    blinded += is_blinded(a, b, c, s, t);
  };

  SECTION("random points at many scales")
  {
    for (double scale : {1.0, 1e-150, 1e150, 1e-80, 1e60}) {
      for (int i = 0; i < 300; ++i) {
        std::array<Point, 5> p;
        for (Point& q : p) q = Point{scale * uniform(random, -1, 1), scale * uniform(random, -1, 1)};
        check(p[0], p[1], p[2], p[3], p[4]);
      }
    }
    REQUIRE(blinded > 10);
  }
  SECTION("small integer coordinates, far from the origin and where products underflow too")
  {
    const std::array<std::pair<double, double>, 3> shifts_and_units{{{0, 1}, {1e8, 1}, {0, std::ldexp(1.0, -269)}}};
    for (const auto& [shift, unit] : shifts_and_units) {
      const auto any = [&, shift = shift, unit = unit] { return shift + unit * static_cast<int>(random() % 6); };
      for (int i = 0; i < 3000; ++i) {
        std::array<Point, 5> p;
        for (Point& q : p) {
          const double x = any();
          q = Point(x, any());
        }
        check(p[0], p[1], p[2], p[3], p[4]);
      }
    }
    REQUIRE(degenerate > 100);
  }
  SECTION("a triangle so small that its products underflow, and a long constraint")
  {
    const double unit = std::ldexp(1.0, -359);
    const auto any = [&] { return static_cast<int>(random() % 6); };
    for (int i = 0; i < 3000; ++i) {
      std::array<Point, 5> p;
      for (Point& q : p) {
        const double x = any(), y = any(), scale = &q == &p[4] ? 1 : unit;
        q = Point(scale * x, scale * y);
      }
      check(p[0], p[1], p[2], p[3], p[4]);
    }
  }
  SECTION("right triangles with the hypotenuse on the constraint are not blinded")
  {
    for (int i = 1; i < 200; ++i) {
      // s and t are integers, so the corner below is exactly at the right angle of a Thales circle of diameter s, t.
      const double m = 1 + static_cast<int>(random() % 50), n = static_cast<int>(random() % 50);
      const Point s(0, 0), t(m * m + n * n, 0), c(m * m, m * n);
      if (n == 0) continue;
      check(s, t, c, s, t);
      REQUIRE_FALSE(is_blinded(s, t, c, s, t));
      REQUIRE(is_blinded(s, t, Point(c.x(), std::nextafter(c.y(), 0.0)), s, t));
      REQUIRE_FALSE(is_blinded(s, t, Point(c.x(), std::nextafter(c.y(), 1e9)), s, t));
    }
  }
  SECTION("nearly collinear triangles")
  {
    for (int i = 0; i < 1000; ++i) {
      const Point a{uniform(random, 0, 1), uniform(random, 0, 1)}, b{uniform(random, 0, 1), uniform(random, 0, 1)};
      const double f = uniform(random, 0, 1);
      const Point c(a.x() + f * (b.x() - a.x()), a.y() + f * (b.y() - a.y()));
      check(a, b, c, a, b);
      const Point s{uniform(random, 0, 1), 2}, t{uniform(random, 0, 1), 3};
      check(a, b, c, s, t);
    }
  }
}

TEST_CASE("corners are accurate for needle-like triangles and nearly parallel walls")
{
  Random random(2);
  const auto error = [](const Point& p, const Exact::Point_2& q) {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(exact(p), q)));
  };
  for (int i = 0; i < 300; ++i) {
    const double step = std::pow(10.0, uniform(random, -8, 0)), from = uniform(random, 0, 6);
    const auto on_circle = [&](double at) { return Point(std::cos(from + at * step), 3 + std::sin(from + at * step)); };
    const Point a = on_circle(0), b = on_circle(0.3), c = on_circle(1);
    if (CGAL::collinear(a, b, c)) continue;
    const auto center = CGAL::circumcenter(exact(a), exact(b), exact(c));
    const double radius = std::sqrt(CGAL::to_double(CGAL::squared_distance(exact(a), center)));
    REQUIRE(error(weft::internal::accurate_circumcenter<K>(a, b, c), center) <= 1e-10 * (radius + 1));

    // The bisector of p, q passes through the middle of the wall at a small angle.
    const Point s(0.1, 0.2), t(0.7, 0.2 + 0.1 * step);
    const double x = uniform(random, 0.3, 0.5), y = uniform(random, 0.1, 1), turn = uniform(random, -1, 1) * step;
    const Point p(x, 0.2 + y), q(x + 2 * y * turn, 0.2 - y);
    const Exact::Line_2 wall(exact(s), exact(t)), bisector = CGAL::bisector(exact(p), exact(q));
    const Exact::FT w = wall.a() * bisector.b() - bisector.a() * wall.b();
    if (w == 0) continue;
    const Exact::Point_2 crossing((wall.b() * bisector.c() - bisector.b() * wall.c()) / w,
                                  (bisector.a() * wall.c() - wall.a() * bisector.c()) / w);
    if (crossing.x() < s.x() || crossing.x() > t.x()) continue;
    REQUIRE(error(weft::internal::bisector_on_segment<K>(p, q, s, t), crossing) <= 1e-10);
  }
}

TEST_CASE("the tag of a face is the first wall on its line of sight, from wherever in the face it starts")
{
  std::size_t blind = 0, through_others = 0;
  for (unsigned seed = 0; seed < input_count; ++seed) {
    CAPTURE(seed);
    const Cdt cdt = triangulate(input_number(seed));
    const Diagram diagram(cdt);
    const auto walls = walls_of(diagram);
    for (Cdt::Face_handle f : cdt.finite_face_handles()) {
      if (!diagram.is_in_domain(f)) continue;
      const auto a = exact(f->vertex(0)->point()), b = exact(f->vertex(1)->point()), c = exact(f->vertex(2)->point());
      const Exact::Point_2 center = CGAL::circumcenter(a, b, c);
      const std::array<std::array<int, 3>, 3> weights{{{1, 1, 1}, {97, 1, 3}, {1, 2, 150}}};
      for (const auto& w : weights) {
        const Exact::Point_2 start = CGAL::barycenter(a, Exact::FT(w[0]), b, Exact::FT(w[1]), c, Exact::FT(w[2]));
        Cdt::Edge first;
        Exact::FT at = 2;
        for (const Cdt::Edge& wall : walls) {
          const auto s = exact(cdt.segment(wall).source()), t = exact(cdt.segment(wall).target());
          const Exact::FT d0 = CGAL::determinant(t - s, start - s), d1 = CGAL::determinant(t - s, center - s);
          if (!(d0 > 0 && d1 < 0)) continue; // crossed from the near side only
          const Exact::FT fraction = d0 / (d0 - d1);
          if (fraction < at && CGAL::do_intersect(Exact::Segment_2(s, t), Exact::Segment_2(start, center))) {
            at = fraction;
            first = wall;
          }
        }
        REQUIRE(diagram.blinding_edge(f) == first);
      }
      blind += diagram.is_blind(f);
      through_others += diagram.is_blind(f) && diagram.blinding_edge(f).first != f;
    }
  }
  REQUIRE(blind > 500);
  REQUIRE(through_others > 100);
}

TEST_CASE("every point lies in the cell of the nearest site that it sees, and in no other")
{
  int samples = 0;
  for (unsigned seed = 0; seed < input_count; ++seed) {
    CAPTURE(seed);
    const Input input = input_number(seed);
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    const auto walls = walls_of(diagram);
    const auto range = diagram.cells();
    const std::vector<Diagram::Cell> cells(range.begin(), range.end());
    Random random(seed + 1000);
    for (int i = 0; i < 150; ++i) {
      const Point p{uniform(random, -0.1, 1.1), uniform(random, -0.1, 1.1)};
      if (!input.contains(p)) {
        REQUIRE(diagram.locate(p) == nullptr);
        continue;
      }
      const auto nearest = nearest_visible(diagram, walls, p);
      REQUIRE(diagram.locate(p) == nearest[0]);
      if (nearest.size() > 1 && distance(p, nearest[1]->point()) - distance(p, nearest[0]->point()) < 1e-9) continue;
      ++samples;
      for (const Diagram::Cell& cell : cells) {
        const auto count = std::count_if(cell.polygons.begin(), cell.polygons.end(),
                                         [&](const Polygon& polygon) { return polygon_contains(polygon, p); });
        CAPTURE(p.x(), p.y(), cell.site->point().x(), cell.site->point().y());
        REQUIRE(count == (cell.site == nearest[0]));
      }
    }
  }
  REQUIRE(samples > 2500);
}

TEST_CASE("the cells have the domain's area, and those of free vertices are convex around their vertex")
{
  std::size_t free_cells = 0;
  for (unsigned seed = 0; seed < input_count; ++seed) {
    CAPTURE(seed);
    const Input input = input_number(seed);
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    double domain = 0, sum = 0;
    for (std::size_t i = 0; i < input.rings.size(); ++i)
      domain += (i == 0 ? 1 : -1) * std::abs(signed_area(input.rings[i]));
    for (const Diagram::Cell& cell : diagram.cells()) {
      double area = 0;
      for (const Polygon& polygon : cell.polygons) {
        REQUIRE(polygon.size() >= 3);
        area += signed_area(polygon);
      }
      REQUIRE(area > 0);
      REQUIRE(diagram.area(cell.site) == Approx(area).epsilon(1e-9));
      sum += area;
      if (!diagram.is_free(cell.site)) {
        for (const Polygon& polygon : cell.polygons) REQUIRE(polygon.front() == cell.site->point());
        continue;
      }
      ++free_cells;
      REQUIRE(cell.polygons.size() == 1);
      REQUIRE(is_convex(cell.polygons[0]));
      REQUIRE(polygon_contains(cell.polygons[0], cell.site->point()));
      REQUIRE(polygon_contains(cell.polygons[0], diagram.centroid(cell.site)));
    }
    REQUIRE(sum == Approx(domain).epsilon(1e-9));
  }
  REQUIRE(free_cells > 200);
}

TEST_CASE("neither the order of insertion nor that of the constraints changes the diagram")
{
  for (unsigned seed = 0; seed < input_count; ++seed) {
    CAPTURE(seed);
    const Input input = input_number(seed);
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    for (unsigned shuffle = 1; shuffle < 4; ++shuffle) {
      const Cdt shuffled = triangulate(input, shuffle);
      const Diagram other(shuffled);
      if (seed < first_grid_input) REQUIRE(tags_of(other) == tags_of(diagram)); // else there are several triangulations
      for (Cdt::Vertex_handle v : shuffled.finite_vertex_handles()) {
        const auto w = vertex_at(cdt, v->point().x(), v->point().y());
        REQUIRE(other.area(v) == Approx(diagram.area(w)).margin(1e-12));
        REQUIRE(distance(other.centroid(v), diagram.centroid(w)) < 1e-10);
      }
    }
  }
}

TEST_CASE("cells at dangling constraints, reflex corners and holes are what a ruler gives")
{
  SECTION("a dangling constraint from the middle of a side to the centre of a square")
  {
    Input input;
    input.rings.push_back(unit_square());
    input.segments.emplace_back(Point(0.5, 0.5), Point(0.5, 0));
    input.rings[0].insert(input.rings[0].begin() + 1, Point(0.5, 0));
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    const auto tip = diagram.cell(vertex_at(cdt, 0.5, 0.5)), foot = diagram.cell(vertex_at(cdt, 0.5, 0));
    REQUIRE(tip.size() == 1);
    REQUIRE(signed_area(tip[0]) == Approx(0.5 - 0.0625));
    REQUIRE(foot.size() == 2);
    REQUIRE(signed_area(foot[0]) == Approx(0.0625));
    REQUIRE(signed_area(foot[1]) == Approx(0.0625));
    REQUIRE(diagram.centroid(vertex_at(cdt, 0.5, 0)).x() == Approx(0.5));
    REQUIRE_FALSE(diagram.is_free(vertex_at(cdt, 0.5, 0.5)));
  }
  SECTION("an L: the reflex corner has one polygon that is not convex")
  {
    Input input;
    input.rings.push_back({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    const auto corner = diagram.cell(vertex_at(cdt, 1, 1));
    REQUIRE(corner.size() == 1);
    REQUIRE(signed_area(corner[0]) == Approx(1.25));
    REQUIRE_FALSE(is_convex(corner[0]));
    REQUIRE(diagram.locate(Point(0.75, 0.9)) == vertex_at(cdt, 1, 1));
    REQUIRE(diagram.locate(Point(1.1, 1.1)) == nullptr);
  }
  SECTION("a wall hides the nearest site")
  {
    Input input;
    input.rings.push_back({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}});
    input.segments.emplace_back(Point(-3, 0), Point(3, 0));
    input.points = {{0, 0.125}};
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    const auto free = vertex_at(cdt, 0, 0.125);
    REQUIRE(diagram.is_free(free));
    Polygon polygon;
    diagram.free_cell(free, polygon);
    REQUIRE(is_convex(polygon));
    for (const Point& p : polygon) REQUIRE(p.y() >= 0);
    REQUIRE(diagram.locate(Point(0.5, 0.01)) == free);
    REQUIRE(diagram.locate(Point(0.5, -0.01)) == vertex_at(cdt, 3, 0));
    REQUIRE(diagram.locate(Point(0, 0)) == free); // a point on the wall sees both sides
    REQUIRE(diagram.area(vertex_at(cdt, -3, 0)) == Approx(diagram.area(vertex_at(cdt, 3, 0))));
  }
  SECTION("a chain of needle triangles is blinded by one far wall")
  {
    Input input;
    input.rings.push_back({{-100, 0}, {100, 0}, {100, 50}, {-100, 50}});
    for (int i = -5; i <= 5; ++i) input.points.emplace_back(i, 20 + i * i * (1 / 64.));
    const Cdt cdt = triangulate(input);
    const Diagram diagram(cdt);
    double sum = 0;
    for (Cdt::Vertex_handle v : cdt.finite_vertex_handles()) sum += diagram.area(v);
    REQUIRE(sum == Approx(10000).epsilon(1e-12));
    REQUIRE(tags_of(diagram).size() > 3);
  }
}

TEST_CASE("tiny and huge coordinates give the same diagram")
{
  for (unsigned seed : {4u, 45u, 52u}) {
    CAPTURE(seed);
    const Cdt cdt = triangulate(input_number(seed));
    const Diagram diagram(cdt);
    for (int exponent : {-498, 498}) { // about 1e-150 and 1e150
      const auto scale = [&](double x) { return std::ldexp(x, exponent); };
      Input scaled = input_number(seed);
      const auto scale_point = [&](const Point& p) { return Point(scale(p.x()), scale(p.y())); };
      for (Polygon& ring : scaled.rings) std::transform(ring.begin(), ring.end(), ring.begin(), scale_point);
      std::transform(scaled.points.begin(), scaled.points.end(), scaled.points.begin(), scale_point);
      for (Segment& s : scaled.segments) s = Segment(scale_point(s.source()), scale_point(s.target()));
      const Cdt other_cdt = triangulate(scaled);
      const Diagram other(other_cdt);
      for (Cdt::Vertex_handle v : cdt.finite_vertex_handles()) {
        const auto w = vertex_at(other_cdt, scale(v->point().x()), scale(v->point().y()));
        if (!diagram.has_cell(v)) continue;
        REQUIRE(std::ldexp(other.area(w), -2 * exponent) == Approx(diagram.area(v)));
        REQUIRE(std::ldexp(other.centroid(w).x(), -exponent) == Approx(diagram.centroid(v).x()));
      }
    }
  }
}

TEST_CASE("locate breaks ties by coordinates and finds sites and edges")
{
  Input input;
  input.rings.push_back(unit_square());
  const Cdt cdt = triangulate(input);
  const Diagram diagram(cdt);
  REQUIRE(diagram.locate(Point(0.5, 0.5)) == vertex_at(cdt, 0, 0));
  REQUIRE(diagram.locate(Point(0.5, 1)) == vertex_at(cdt, 0, 1));
  REQUIRE(diagram.locate(Point(1, 1)) == vertex_at(cdt, 1, 1));
  REQUIRE(diagram.locate(Point(0.5, 1.001)) == nullptr);
}

TEST_CASE("the cells are in the order of the triangulation's vertices, without those outside of the domain")
{
  Input input = random_input(4);
  input.points.emplace_back(0.48, 0.48); // in the hole
  const Cdt cdt = triangulate(input);
  const Diagram diagram(cdt);
  const auto lost = vertex_at(cdt, 0.48, 0.48);
  REQUIRE_FALSE(diagram.has_cell(lost));
  REQUIRE(diagram.cell(lost).empty());
  REQUIRE(diagram.area(lost) == 0);
  REQUIRE(diagram.centroid(lost) == lost->point());
  std::vector<Cdt::Vertex_handle> expected, sites;
  for (Cdt::Vertex_handle v : cdt.finite_vertex_handles())
    if (v != lost) expected.push_back(v);
  for (const Diagram::Cell& cell : diagram.cells()) sites.push_back(cell.site);
  REQUIRE(sites == expected);
}

TEST_CASE("a plain CGAL triangulation, a chosen domain and exact constructions work as well")
{
  using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Plain = CGAL::Constrained_Delaunay_triangulation_2<Exact_kernel>;
  Plain cdt;
  Random random(5);
  const std::array<Plain::Point, 4> corner{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  for (int i = 0; i < 4; ++i) cdt.insert_constraint(corner[i], corner[(i + 1) % 4]);
  cdt.insert_constraint(Plain::Point(0, 0), Plain::Point(4, 4));
  for (int i = 0; i < 20; ++i) cdt.insert(Plain::Point{uniform(random, 0, 4), uniform(random, 0, 4)});

  const weft::Bounded_voronoi_diagram_2 all(cdt);
  Exact_kernel::FT sum = 0;
  for (const auto& cell : all.cells()) sum += all.area(cell.site);
  REQUIRE(sum == 16); // exactly

  const auto below = [&](Plain::Face_handle f) {
    const auto c = CGAL::centroid(cdt.triangle(f));
    return c.y() < c.x();
  };
  const weft::Bounded_voronoi_diagram_2 half(cdt, below);
  sum = 0;
  for (const auto& cell : half.cells()) sum += half.area(cell.site);
  REQUIRE(sum == 8);
  REQUIRE(half.locate(Plain::Point(1, 3)) == nullptr);
  REQUIRE(half.locate(Plain::Point(3.9, 0.05)) == vertex_at(cdt, 4, 0));
}

TEST_CASE("edges between faces inside and outside of the domain are walls without being constrained")
{
  Random random(6);
  Cdt cdt;
  for (int i = 0; i < 200; ++i) cdt.insert(Point{uniform(random, 0, 1), uniform(random, 0, 1)});
  double domain = 0, sum = 0;
  for (Cdt::Face_handle f : cdt.finite_face_handles()) {
    f->set_in_domain(random() % 3 != 0);
    if (f->is_in_domain()) domain += cdt.triangle(f).area();
  }
  const Diagram diagram(cdt);
  for (const auto& cell : diagram.cells()) sum += diagram.area(cell.site);
  REQUIRE(sum == Approx(domain).epsilon(1e-9));
}

TEST_CASE("triangulations without a face have an empty diagram")
{
  Cdt cdt;
  for (int i = 0; i < 4; ++i) {
    const Diagram diagram(cdt);
    const auto cells = diagram.cells();
    REQUIRE(cells.begin() == cells.end());
    REQUIRE(diagram.locate(Point(0, 0)) == nullptr);
    const auto v = cdt.insert(Point(i, i)); // collinear
    REQUIRE(Diagram(cdt).cell(v).empty());
    REQUIRE_FALSE(Diagram(cdt).is_free(v));
  }
}

TEST_CASE("the diagram follows changes of the triangulation after update()")
{
  Input input;
  input.rings.push_back(unit_square());
  input.points = {{0.3, 0.6}, {0.7, 0.5}};
  Cdt cdt = triangulate(input);
  Diagram diagram(cdt);
  const auto before = tags_of(diagram);
  input.segments.emplace_back(Point(0.1, 0.55), Point(0.9, 0.52));
  cdt = triangulate(input);
  diagram.update();
  REQUIRE(tags_of(diagram) == tags_of(Diagram(cdt)));
  REQUIRE(tags_of(diagram) != before);
}
