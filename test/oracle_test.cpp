// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the domain oracle of triangle surfaces: its answers are those of brute force over all triangles in
// exact arithmetic, and those of CGAL's AABB tree.

#include <weft/internal/boxes/cgal_aabb_tree.h>
#include <weft/internal/cgal_version.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = K::Point_3;
using Complex = weft::Piecewise_smooth_complex_3<K>;
using Oracle = weft::Polyhedral_oracle_3<K>;
using Hit = weft::Surface_hit_3<K>;
using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.);
}

// ---- Surfaces

void finish(Complex& complex)
{
  complex.patches.resize(complex.triangles.size(), 0);
  complex.shells.resize(complex.triangles.size(), 0);
  complex.number_of_patches = 1 + *std::max_element(complex.patches.begin(), complex.patches.end());
  complex.number_of_shells = 1 + *std::max_element(complex.shells.begin(), complex.shells.end());
}

// The cube [0, 1]^3, n by n squares on each side, cut by diagonals; six patches, twelve creases, eight corners.
Complex cube(int n)
{
  Complex complex;
  std::map<std::array<int, 3>, std::size_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = number.emplace(at, complex.points.size());
    if (is_new) complex.points.emplace_back(at[0] / double(n), at[1] / double(n), at[2] / double(n));
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int top = 0; top < 2; ++top)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::array<std::size_t, 4> corner{};
          for (int c = 0; c < 4; ++c) {
            std::array<int, 3> at{};
            at[axis] = top * n, at[(axis + 1) % 3] = i + (c == 1 || c == 2), at[(axis + 2) % 3] = j + (c >= 2);
            corner[c] = vertex(at);
          }
          if (!top) std::swap(corner[1], corner[3]);
          complex.triangles.push_back({corner[0], corner[1], corner[2]});
          complex.triangles.push_back({corner[0], corner[2], corner[3]});
          complex.patches.insert(complex.patches.end(), 2, 2 * axis + top);
        }
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      complex.creases.emplace_back();
      for (int i = 0; i <= n; ++i) {
        std::array<int, 3> at{};
        at[axis] = i, at[(axis + 1) % 3] = side % 2 * n, at[(axis + 2) % 3] = side / 2 * n;
        complex.creases.back().vertices.push_back(number.at(at));
      }
    }
  for (int c = 0; c < 8; ++c)
    complex.features.push_back({number.at({c % 2 * n, c / 2 % 2 * n, c / 4 * n}), weft::Feature_kind::corner});
  finish(complex);
  return complex;
}

// Adds the quadrilaterals of a grid that is closed in both directions, cut by diagonals.
void add_closed_grid(Complex& complex, int rows, int columns, const std::function<Point(int, int)>& point)
{
  const std::size_t first = complex.points.size();
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) complex.points.push_back(point(i, j));
  const auto at = [&](int i, int j) { return first + static_cast<std::size_t>(i % rows * columns + j % columns); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      complex.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      complex.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

Complex torus(int rows, int columns)
{
  Complex complex;
  const double turn = 2 * std::acos(-1.);
  add_closed_grid(complex, rows, columns, [&](int i, int j) {
    const double a = turn * i / rows, b = turn * j / columns, r = 1 + 0.4 * std::cos(b);
    return Point(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
  });
  finish(complex);
  return complex;
}

void add_sphere(Complex& complex, int rings, int sides, double radius, bool outwards, int number)
{
  const std::size_t first = complex.points.size();
  const double pi = std::acos(-1.);
  complex.points.emplace_back(0, 0, radius);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double a = pi * i / rings, b = 2 * pi * j / sides, r = radius * std::sin(a);
      complex.points.emplace_back(r * std::cos(b), r * std::sin(b), radius * std::cos(a));
    }
  complex.points.emplace_back(0, 0, -radius);
  const auto at = [&](int ring, int side) {
    if (ring == 0) return first;
    if (ring == rings) return complex.points.size() - 1;
    return first + static_cast<std::size_t>(1 + (ring - 1) * sides + side % sides);
  };
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (a == b || b == c || c == a) return;
    if (outwards)
      complex.triangles.push_back({a, b, c});
    else
      complex.triangles.push_back({a, c, b});
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  complex.patches.resize(complex.triangles.size(), number);
  complex.shells.resize(complex.triangles.size(), number);
}

Complex nested_spheres(int rings, int sides)
{
  Complex complex;
  add_sphere(complex, rings, sides, 1, true, 0);
  add_sphere(complex, rings, sides, 0.5, false, 1);
  add_sphere(complex, rings, sides, 0.25, true, 2);
  finish(complex);
  return complex;
}

Complex moved(Complex complex, double sx, double sy, double sz, double offset)
{
  for (Point& p : complex.points) p = Point(sx * p.x() + offset, sy * p.y() + offset, sz * p.z() + offset);
  return complex;
}

struct Named
{
  std::string name;
  Complex complex;
};

std::vector<Named> surfaces()
{
  return {{"cube", cube(4)},
          {"torus", torus(16, 12)},
          {"nested spheres", nested_spheres(8, 12)},
          {"sphere of needles", moved(nested_spheres(8, 12), 1e6, 1, 1, 0)},
          {"plate", moved(cube(3), 1, 1, 1e-6, 0)},
          {"torus far from the origin", moved(torus(16, 12), 1, 1, 1, 1e6)},
          {"cube far from the origin", moved(cube(4), 1, 1, 1, 1e6)},
          {"tiny torus", moved(torus(16, 12), 1e-9, 1e-9, 1e-9, 0)}};
}

// ---- Brute force

class Brute_force
{
public:
  explicit Brute_force(const Complex& complex) : complex_(complex)
  {
    for (const auto& t : complex.triangles)
      triangles_.emplace_back(to_exact_(complex.points[t[0]]), to_exact_(complex.points[t[1]]),
                              to_exact_(complex.points[t[2]]));
  }

  // All different points that the segment has in common with triangles; of common pieces the ends.
  std::set<Exact::Point_3> contacts(const Point& p, const Point& q) const
  {
    std::set<Exact::Point_3> points;
    const Exact::Segment_3 segment(to_exact_(p), to_exact_(q));
    const CGAL::Bbox_3 box = p.bbox() + q.bbox();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!CGAL::do_overlap(box, input_box(t))) continue;
      const auto common = CGAL::intersection(segment, triangles_[t]);
      if (const auto* point = weft::internal::intersection_as<Exact::Point_3>(common)) points.insert(*point);
      if (const auto* piece = weft::internal::intersection_as<Exact::Segment_3>(common))
        points.insert(piece->source()), points.insert(piece->target());
    }
    return points;
  }

  bool on_boundary(const Point& p) const
  {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (CGAL::do_overlap(p.bbox(), input_box(t)) && triangles_[t].has_on(to_exact_(p))) return true;
    return false;
  }

  // By a ray in a random direction; another one if an edge or a vertex is exactly on it.
  int subdomain(const Point& p) const
  {
    if (on_boundary(p)) return 0;
    Random random(7);
    for (;;) {
      const Point far(p.x() + uniform(random, -1, 1) * 1e8, p.y() + uniform(random, -1, 1) * 1e8,
                      p.z() + uniform(random, -1, 1) * 1e8);
      const int parity = ray_parity(to_exact_(p), to_exact_(far));
      if (parity >= 0) return parity;
    }
  }

  double distance(const Point& p, int patch = -1) const
  {
    Exact::FT least = -1;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (patch >= 0 && complex_.patches[t] != patch) continue;
      const Exact::FT d = CGAL::squared_distance(to_exact_(p), triangles_[t]);
      if (least < 0 || d < least) least = d;
    }
    return std::sqrt(CGAL::to_double(least));
  }

  static Exact::Point_3 exact(const Point& p) { return to_exact_(p); }

private:
  CGAL::Bbox_3 input_box(std::size_t t) const
  {
    const auto& v = complex_.triangles[t];
    return complex_.points[v[0]].bbox() + complex_.points[v[1]].bbox() + complex_.points[v[2]].bbox();
  }

  int ray_parity(const Exact::Point_3& p, const Exact::Point_3& far) const
  {
    int parity = 0;
    for (const auto& t : triangles_) {
      const auto of_p = CGAL::orientation(t[0], t[1], t[2], p), of_far = CGAL::orientation(t[0], t[1], t[2], far);
      if (of_p != CGAL::ZERO && of_p == of_far) continue;
      const auto u = CGAL::orientation(p, far, t[0], t[1]), v = CGAL::orientation(p, far, t[1], t[2]),
                 w = CGAL::orientation(p, far, t[2], t[0]);
      if (u * v < 0 || v * w < 0 || w * u < 0) continue;
      if (u == CGAL::ZERO || v == CGAL::ZERO || w == CGAL::ZERO || of_p == CGAL::ZERO || of_far == CGAL::ZERO)
        return -1;
      parity ^= 1;
    }
    return parity;
  }

  const Complex& complex_;
  std::vector<Exact::Triangle_3> triangles_;
  static inline const CGAL::Cartesian_converter<K, Exact> to_exact_;
};

double distance(const Point& p, const Point& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

double size_of(const CGAL::Bbox_3& box)
{
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

// What coordinates of this size can't tell apart.
double resolution(const CGAL::Bbox_3& box)
{
  double largest = 0;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.min(k)), std::abs(box.max(k))});
  return 1e-12 * size_of(box) + 8 * std::numeric_limits<double>::epsilon() * largest;
}

// Points where queries are hard: vertices, middles of edges and triangles, a grid that the cube's faces and diagonals
// belong to; and points anywhere, the box's surroundings included.
class Point_source
{
public:
  Point_source(const Complex& complex, const CGAL::Bbox_3& box) : complex_(complex), box_(box) {}

  Point nasty(Random& random) const
  {
    const auto& t = complex_.triangles[random() % complex_.triangles.size()];
    const Point &a = complex_.points[t[0]], &b = complex_.points[t[1]], &c = complex_.points[t[2]];
    switch (random() % 6) {
    case 0:
      return a;
    case 1:
      return CGAL::midpoint(a, b);
    case 2:
      return CGAL::centroid(a, b, c);
    case 3:
      return on_grid(random, 4);
    case 4:
      return on_grid(random, 12);
    default:
      return anywhere(random);
    }
  }

  Point on_grid(Random& random, int n) const
  {
    const auto coordinate = [&](int k) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(n + 3)) - 1;
      return box_.min(k) + (box_.max(k) - box_.min(k)) * i / n;
    };
    const double x = coordinate(0), y = coordinate(1), z = coordinate(2);
    return Point(x, y, z);
  }

  Point anywhere(Random& random, double margin = 0.25) const
  {
    const auto coordinate = [&](int k) {
      const double extra = margin * (box_.max(k) - box_.min(k));
      return uniform(random, box_.min(k) - extra, box_.max(k) + extra);
    };
    const double x = coordinate(0), y = coordinate(1), z = coordinate(2);
    return Point(x, y, z);
  }

private:
  const Complex& complex_;
  CGAL::Bbox_3 box_;
};

// A segment through a point of the surface, to the mirror image of its other end; or between two points.
std::pair<Point, Point> nasty_segment(const Point_source& source, Random& random)
{
  const Point p = source.nasty(random), q = source.nasty(random);
  switch (random() % 4) {
  case 0:
    return {p, Point(2 * q.x() - p.x(), 2 * q.y() - p.y(), 2 * q.z() - p.z())};
  case 1: { // axis-parallel
    std::array<double, 3> x{p.x(), p.y(), p.z()};
    const int k = static_cast<int>(random() % 3);
    x[k] = q[k];
    return {p, Point(x[0], x[1], x[2])};
  }
  case 2: { // in an axis-parallel plane
    std::array<double, 3> x{q.x(), q.y(), q.z()};
    const int k = static_cast<int>(random() % 3);
    x[k] = p[k];
    return {p, Point(x[0], x[1], x[2])};
  }
  default:
    return {p, q};
  }
}

void check_segment(const Oracle& oracle, const Brute_force& brute, const Point& p, const Point& q, double tolerance)
{
  CAPTURE(p, q);
  std::vector<Hit> hits;
  CHECK(oracle.intersect(p, q, hits) == (oracle.subdomain(p) ^ oracle.subdomain(q)));
  CHECK(oracle.meets(p, q) == !hits.empty());
  for (std::size_t i = 1; i < hits.size(); ++i)
    CHECK((hits[i].point - p) * (q - p) >= (hits[i - 1].point - p) * (q - p));
  if (p == q) return;
  const auto expected = brute.contacts(p, q);
  REQUIRE(hits.size() == expected.size());
  for (const auto& exact : expected) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Hit& hit : hits)
      nearest =
          std::min(nearest, std::sqrt(CGAL::to_double(CGAL::squared_distance(exact, Brute_force::exact(hit.point)))));
    CHECK(nearest <= tolerance);
  }
}

} // namespace

TEST_CASE("segments meet the boundary where exact arithmetic says, whatever they graze")
{
  for (const auto& [name, complex] : surfaces()) {
    CAPTURE(name);
    const Oracle oracle(complex);
    const Brute_force brute(complex);
    const Point_source source(complex, oracle.bbox());
    Random random(1);
    for (int i = 0; i < 400; ++i) {
      const auto [p, q] =
          i % 4 ? nasty_segment(source, random) : std::pair(source.anywhere(random), source.anywhere(random));
      check_segment(oracle, brute, p, q, resolution(oracle.bbox()));
    }
  }
}

TEST_CASE("a point's subdomain is what exact arithmetic says, 0 on the boundary")
{
  for (const auto& [name, complex] : surfaces()) {
    CAPTURE(name);
    const Oracle oracle(complex);
    const Brute_force brute(complex);
    const Point_source source(complex, oracle.bbox());
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      const Point p = i % 3 ? source.nasty(random) : source.anywhere(random);
      CAPTURE(p);
      CHECK(oracle.subdomain(p) == brute.subdomain(p));
    }
    for (const Point& p : complex.points) CHECK(oracle.subdomain(p) == 0);
  }
}

TEST_CASE("what a segment crosses is the exclusive or of its ends' subdomains, always")
{
  for (const auto& [name, complex] : surfaces()) {
    CAPTURE(name);
    const Oracle oracle(complex);
    const Point_source source(complex, oracle.bbox());
    Random random(3);
    std::vector<Hit> hits;
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto [p, q] = nasty_segment(source, random);
      wrong += oracle.intersect(p, q, hits) != (oracle.subdomain(p) ^ oracle.subdomain(q));
      hits.clear();
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("segments from a thousand diagonals away are met as near ones are")
{
  for (const auto& [name, complex] : surfaces()) {
    CAPTURE(name);
    const Oracle oracle(complex);
    const Brute_force brute(complex);
    const Point_source source(complex, oracle.bbox());
    Random random(4);
    for (int i = 0; i < 60; ++i) {
      const Point target = source.nasty(random), far = source.anywhere(random, 1000);
      check_segment(oracle, brute, far, target, 10 * resolution(oracle.bbox()));
      const Point beyond(2 * target.x() - far.x(), 2 * target.y() - far.y(), 2 * target.z() - far.z());
      check_segment(oracle, brute, beyond, far, 10 * resolution(oracle.bbox()));
    }
  }
}

TEST_CASE("hits lie on the patch that they name, at a shared edge on that of the first triangle")
{
  const Complex complex = cube(4);
  const Oracle oracle(complex);
  std::vector<Hit> hits;
  CHECK(oracle.intersect(Point(0.3, 0.4, -1), Point(0.3, 0.4, 0.5), hits) == 1);
  REQUIRE(hits.size() == 1);
  CHECK(hits[0].patch == 4);
  CHECK(hits[0].point == Point(0.3, 0.4, 0));
  hits.clear();
  CHECK_FALSE(oracle.intersect(Point(-1, 0.5, -1), Point(1, 0.5, 1), hits)); // through the middle of x = z = 0 to a rim
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].patch == 0);
  CHECK(hits[0].point == Point(0, 0.5, 0));
  CHECK(hits[1].point == Point(1, 0.5, 1));
  hits.clear();
  CHECK_FALSE(oracle.intersect(Point(-1, 0, 1), Point(1, 0, -1), hits)); // grazes a vertex from outside
  REQUIRE(hits.size() == 1);
  CHECK(hits[0].point == Point(0, 0, 0));
}

TEST_CASE("the nearest point is that of brute force")
{
  for (const auto& [name, complex] : surfaces()) {
    CAPTURE(name);
    const Oracle oracle(complex);
    const Brute_force brute(complex);
    const Point_source source(complex, oracle.bbox());
    Random random(5);
    for (int i = 0; i < 100; ++i) {
      const Point p = i % 10 == 9 ? source.anywhere(random, 100)
                      : i % 2     ? source.nasty(random)
                                  : source.anywhere(random);
      CAPTURE(p);
      const double expected = brute.distance(p), tolerance = 1e-12 * expected + resolution(oracle.bbox());
      const Hit hit = oracle.closest(p);
      CHECK(std::abs(distance(p, hit.point) - expected) <= tolerance);
      CHECK(brute.distance(hit.point, hit.patch) <= resolution(oracle.bbox()));
      CHECK(oracle.clearance(p) <= expected);
      CHECK(oracle.clearance(p) >= expected - 1e-5 * (size_of(oracle.bbox()) + expected));
      const int patch = static_cast<int>(random() % static_cast<unsigned>(complex.number_of_patches));
      const Hit projected = oracle.project_on_patch(p, patch);
      CHECK(projected.patch == patch);
      CHECK(std::abs(distance(p, projected.point) - brute.distance(p, patch)) <=
            1e-12 * distance(p, projected.point) + resolution(oracle.bbox()));
    }
  }
}

TEST_CASE("the answers are those of CGAL's AABB tree")
{
  const Complex complex = torus(80, 50);
  const Oracle oracle(complex);
  std::vector<K::Triangle_3> triangles;
  for (const auto& t : complex.triangles)
    triangles.emplace_back(complex.points[t[0]], complex.points[t[1]], complex.points[t[2]]);
  weft::internal::Triangle_tree_3<K> tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  const Point_source source(complex, oracle.bbox());
  Random random(6);
  std::vector<Hit> hits;
  for (int i = 0; i < 3000; ++i) {
    const Point p = source.anywhere(random), q = source.anywhere(random);
    CAPTURE(p, q);
    hits.clear();
    oracle.intersect(p, q, hits);
    CHECK(hits.size() == tree.number_of_intersected_primitives(K::Segment_3(p, q)));
    CHECK(std::abs(distance(p, oracle.closest(p).point) - std::sqrt(tree.squared_distance(p))) <= 1e-12);
  }
}

TEST_CASE("creases are met where they cross the bisecting plane within the polygon")
{
  const Complex complex = cube(4);
  const Oracle oracle(complex);
  const Point_source source(complex, oracle.bbox());
  Random random(8);
  int met = 0;
  for (int i = 0; i < 500; ++i) {
    const Point a = source.anywhere(random), b = i % 2 ? source.anywhere(random) : Point(a.x() + 0.25, a.y(), a.z());
    const Point m = CGAL::midpoint(a, b);
    const K::Plane_3 plane(m, b - a);
    const K::Vector_3 u = plane.base1() / std::sqrt(plane.base1().squared_length()),
                      v = plane.base2() / std::sqrt(plane.base2().squared_length());
    const double r = i % 3 ? 0.4 : 10;
    const std::vector<Point> polygon{m + r * u, m + r * v, m - r * u, m - r * v};
    std::vector<weft::Crease_hit_3<K>> hits;
    oracle.intersect_creases(a, b, polygon, hits);
    std::size_t expected = 0;
    for (std::size_t c = 0; c < complex.creases.size(); ++c) {
      const auto& vertices = complex.creases[c].vertices;
      for (std::size_t s = 0; s + 1 < vertices.size(); ++s) {
        const Point &x = complex.points[vertices[s]], &y = complex.points[vertices[s + 1]];
        if (CGAL::has_smaller_distance_to_point(x, b, a) == CGAL::has_smaller_distance_to_point(y, b, a)) continue;
        const double hx = (x - m) * (b - a), hy = (y - m) * (b - a), t = hx / (hx - hy);
        const Point z = x + t * (y - x);
        if (std::abs((z - m) * u) + std::abs((z - m) * v) > r) continue;
        ++expected;
        CHECK(std::any_of(hits.begin(), hits.end(), [&](const auto& hit) {
          return hit.crease == static_cast<int>(c) && distance(hit.point, z) <= 1e-12;
        }));
      }
    }
    CHECK(hits.size() == expected);
    met += !hits.empty();
    for (const auto& hit : hits) {
      CHECK(distance(hit.point, oracle.project_on_crease(hit.point, hit.crease)) <= 1e-12);
      CHECK(std::abs(distance(hit.point, a) - distance(hit.point, b)) <= 1e-12);
    }
  }
  CHECK(met > 100);
}

TEST_CASE("projection on a crease is the nearest point of its segments")
{
  Complex complex = torus(16, 12);
  complex.creases.emplace_back();
  complex.creases[0].closed = true;
  for (std::size_t i = 0; i < 16; ++i) complex.creases[0].vertices.push_back(12 * i);
  const Oracle oracle(complex);
  CHECK(oracle.crease_is_closed(0));
  REQUIRE(oracle.crease_points(0).size() == 16);
  const auto points = oracle.crease_points(0);
  const Point_source source(complex, oracle.bbox());
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const Point p = i % 10 ? source.anywhere(random) : source.anywhere(random, 100);
    double expected = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < 16; ++s)
      expected =
          std::min(expected, std::sqrt(CGAL::squared_distance(p, K::Segment_3(points[s], points[(s + 1) % 16]))));
    CHECK(distance(p, oracle.project_on_crease(p, 0)) == Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("seeds lie on their patch or shell, off its creases, and are well spread")
{
  const Complex cubic = cube(1);
  const Oracle box(cubic);
  for (int patch = 0; patch < 6; ++patch)
    for (const std::size_t n : {1, 4, 50}) {
      const auto seeds = box.patch_seeds(patch, n);
      REQUIRE(seeds.size() == n);
      double nearest = 1;
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(seeds[i].patch == patch);
        CHECK(distance(seeds[i].point, box.project_on_patch(seeds[i].point, patch).point) <= 1e-15);
        for (int c = 0; c < 12; ++c) CHECK(distance(seeds[i].point, box.project_on_crease(seeds[i].point, c)) > 0.001);
        for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, distance(seeds[i].point, seeds[j].point));
      }
      // Farthest-point sampling of a square: n disks of half that radius fit in a slightly larger square.
      CHECK(nearest >= 0.5 / std::sqrt(static_cast<double>(n)));
    }
  const Complex balls = nested_spheres(12, 16);
  const Oracle oracle(balls);
  const std::array<double, 3> radius{1, 0.5, 0.25};
  for (int shell = 0; shell < 3; ++shell) {
    const auto seeds = oracle.shell_seeds(shell, 6);
    REQUIRE(seeds.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(distance(seeds[i].point, Point(0, 0, 0)) == Approx(radius[shell]).epsilon(0.1));
      for (std::size_t j = 0; j < i; ++j) CHECK(distance(seeds[i].point, seeds[j].point) > radius[shell]);
    }
  }
}

TEST_CASE("several threads get the answers of one, and a second oracle those of the first")
{
  const Complex complex = nested_spheres(24, 32);
  const Oracle first(complex), second(complex);
  const auto answers = [](const Oracle& oracle, const Complex& surface) {
    std::vector<Hit> hits;
    const Point_source source(surface, oracle.bbox());
    Random random(10);
    for (int i = 0; i < 3000; ++i) {
      const auto [p, q] = nasty_segment(source, random);
      oracle.intersect(p, q, hits);
      hits.push_back(oracle.closest(p));
      hits.push_back({q, oracle.subdomain(q)});
    }
    for (const Hit& seed : oracle.shell_seeds(1, 20)) hits.push_back(seed);
    return hits;
  };
  const auto same = [](const std::vector<Hit>& x, const std::vector<Hit>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Hit& a, const Hit& b) { return a.point == b.point && a.patch == b.patch; });
  };
  const auto expected = answers(first, complex);
  CHECK(same(expected, answers(second, complex)));
  std::vector<std::vector<Hit>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = answers(first, complex); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) CHECK(same(expected, result));
}

TEST_CASE("an oracle without triangles has nothing inside and meets nothing")
{
  const Oracle oracle{Complex()};
  std::vector<Hit> hits;
  CHECK(oracle.subdomain(Point(0, 0, 0)) == 0);
  CHECK_FALSE(oracle.intersect(Point(-1, 0, 0), Point(1, 0, 0), hits));
  CHECK(hits.empty());
  CHECK_FALSE(oracle.meets(Point(-1, 0, 0), Point(1, 0, 0)));
}

TEST_CASE("boxes hold what they have to, in blocks of up to four")
{
  Random random(11);
  for (const std::size_t n : {1, 3, 4, 5, 17, 1000}) {
    std::vector<weft::internal::Box_3> boxes(n);
    for (auto& box : boxes)
      for (int i = 0; i < 2; ++i) box.add(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
    if (n == 17) boxes.assign(n, boxes[0]); // all alike
    const weft::internal::Box_hierarchy_3 hierarchy(boxes);
    std::vector<std::uint32_t> items;
    for (const std::uint32_t item : hierarchy.items())
      if (item != weft::internal::Box_hierarchy_3::nothing) items.push_back(item);
    std::sort(items.begin(), items.end());
    REQUIRE(items.size() == n);
    for (std::uint32_t i = 0; i < n; ++i) CHECK(items[i] == i);
  }
}
