// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the planar sizing fields. The local feature size is judged by its definition: all pairs of features.

#include <weft/planar/sizing/Lfs_sizing_2.h>
#include <weft/sizing/Background_sizing_2.h>
#include <weft/sizing/Cached_sizing_2.h>
#include <weft/sizing/Lipschitz_sizing_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_2;
using Segment = K::Segment_2;
using Pslg = weft::Pslg_2<K>;
using Lfs = weft::Lfs_sizing_2<K>;
using Lipschitz = weft::Lipschitz_sizing_2<K>;
using Delaunay = CGAL::Delaunay_triangulation_2<K>;
using Background = weft::Background_sizing_2<K>;

namespace {

const double infinity = std::numeric_limits<double>::infinity();

double distance(const Point& p, const Point& q)
{
  return std::hypot(p.x() - q.x(), p.y() - q.y());
}

double distance(const Point& p, const Point& a, const Point& b)
{
  const double length2 = CGAL::squared_distance(a, b);
  const double t = length2 > 0 ? std::clamp(((p - a) * (b - a)) / length2, 0., 1.) : 0.;
  return distance(p, a + t * (b - a));
}

// Radius of the smallest disk at s that meets two features without a common point, by trying all pairs.
double brute_lfs(const Pslg& pslg, const Point& s)
{
  struct Feature
  {
    std::size_t a, b;
    double distance;
  };
  std::vector<Feature> features;
  for (std::size_t i = 0; i < pslg.points.size(); ++i) features.push_back({i, i, distance(s, pslg.points[i])});
  for (const auto& e : pslg.segments)
    features.push_back({e[0], e[1], distance(s, pslg.points[e[0]], pslg.points[e[1]])});
  double radius = infinity;
  for (const Feature& f : features)
    for (const Feature& g : features)
      if (f.a != g.a && f.a != g.b && f.b != g.a && f.b != g.b)
        radius = std::min(radius, std::max(f.distance, g.distance));
  return radius;
}

// Points of the graph with their local feature sizes.
struct Sampled
{
  std::vector<Point> at;
  std::vector<double> lfs;
};
Sampled sample(const Pslg& pslg, int per_segment)
{
  Sampled result;
  const auto add = [&](const Point& p) { result.at.push_back(p), result.lfs.push_back(brute_lfs(pslg, p)); };
  for (const Point& p : pslg.points) add(p);
  for (const auto& e : pslg.segments)
    for (int i = 0; i <= per_segment; ++i)
      add(pslg.points[e[0]] + double(i) / per_segment * (pslg.points[e[1]] - pslg.points[e[0]]));
  return result;
}

double brute_mu(const Sampled& s, double k, const Point& x)
{
  double mu = infinity;
  for (std::size_t i = 0; i < s.at.size(); ++i) mu = std::min(mu, k * distance(x, s.at[i]) + s.lfs[i]);
  return mu;
}

Pslg polygon(const std::vector<Point>& points)
{
  Pslg result;
  result.points = points;
  for (std::size_t i = 0; i < points.size(); ++i) result.segments.push_back({i, (i + 1) % points.size()});
  return result;
}

Pslg square()
{
  return polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

Pslg random_disjoint_segments(std::size_t n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(0.05, 0.95);
  const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(double(n))));
  Pslg result;
  for (std::size_t i = 0; i < n; ++i) {
    for (int end = 0; end < 2; ++end) {
      const double x = double(i % width) + within(random);
      result.points.emplace_back(x / double(width), (double(i / width) + within(random)) / double(width));
    }
    result.segments.push_back({2 * i, 2 * i + 1});
  }
  return result;
}

// Part of a Delaunay triangulation's edges: many angles, junctions of high degree, isolated points.
Pslg random_graph(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Pslg result;
  Delaunay triangulation;
  std::map<Point, std::size_t> index;
  for (int i = 0; i < n; ++i) {
    const double x = unit(random);
    result.points.emplace_back(x, unit(random));
    index[result.points.back()] = result.points.size() - 1;
    triangulation.insert(result.points.back());
  }
  std::vector<std::array<std::size_t, 2>> edges;
  for (auto e = triangulation.finite_edges_begin(); e != triangulation.finite_edges_end(); ++e) {
    const Segment s = triangulation.segment(*e);
    edges.push_back({index.at(s.source()), index.at(s.target())});
    if (edges.back()[0] > edges.back()[1]) std::swap(edges.back()[0], edges.back()[1]);
  }
  std::sort(edges.begin(), edges.end()); // the triangulation's order depends on addresses
  for (const auto& e : edges)
    if (unit(random) < 0.4) result.segments.push_back(e);
  return result;
}

Pslg circle(std::size_t n)
{
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * double(i) / double(n);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return polygon(points);
}

std::vector<std::pair<std::string, Pslg>> nasty_graphs()
{
  std::vector<std::pair<std::string, Pslg>> result;
  result.emplace_back("square", square());
  result.emplace_back("triangle", polygon({{0, 0}, {1, 0}, {0.3, 0.8}}));
  result.emplace_back("needle", polygon({{0, 0}, {1, 0}, {1, 0.02}}));
  result.emplace_back("one segment", Pslg{{{0, 0}, {1, 0}}, {{0, 1}}, {}, {}, {}, {}});
  result.emplace_back("thin channel",
                      Pslg{{{0, 0}, {1, 0}, {-0.3, 1e-3}, {1.2, 2e-3}}, {{0, 1}, {2, 3}}, {}, {}, {}, {}});
  result.emplace_back("two isolated points", Pslg{{{0, 0}, {0.1, 0}}, {}, {}, {}, {}, {}});
  Pslg star; // spikes of 2 to 6 degrees from one point, and an isolated point
  star.points.emplace_back(0, 0);
  for (int i = 0; i < 9; ++i) {
    const double angle = 0.035 * i + 0.01 * i * i;
    star.points.emplace_back((1 + 0.1 * (i % 3)) * std::cos(angle), (1 + 0.1 * (i % 3)) * std::sin(angle));
    star.segments.push_back({0, std::size_t(i + 1)});
  }
  star.points.emplace_back(0.5, -0.01);
  result.emplace_back("star", star);
  Pslg chain; // collinear, lengths from 1 to 1/64, and a point beside it
  for (int i = 0; i < 8; ++i) chain.points.emplace_back(2 - std::ldexp(2., -i), 0);
  for (std::size_t i = 0; i < 7; ++i) chain.segments.push_back({i, i + 1});
  chain.points.emplace_back(0.4, 0.05);
  result.emplace_back("collinear chain", chain);
  Pslg slit = square(); // a hole as thin as a hair
  for (const Point& p : {Point(0.2, 0.5), Point(0.8, 0.5), Point(0.8, 0.5005), Point(0.2, 0.5005)})
    slit.points.push_back(p);
  for (std::size_t i = 0; i < 4; ++i) slit.segments.push_back({4 + i, 4 + (i + 1) % 4});
  result.emplace_back("slit", slit);
  for (unsigned seed = 1; seed <= 6; ++seed)
    result.emplace_back("random graph " + std::to_string(seed), random_graph(24, seed));
  result.emplace_back("random segments", random_disjoint_segments(30, 5));
  return result;
}

std::vector<Point> random_points(int n, unsigned seed, double low = -0.5, double high = 1.5)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(low, high);
  std::vector<Point> result;
  for (int i = 0; i < n; ++i) {
    const double x = in(random);
    result.emplace_back(x, in(random));
  }
  return result;
}

template <class F>
Pslg mapped(Pslg pslg, F map)
{
  for (Point& p : pslg.points) p = map(p);
  return pslg;
}

Delaunay random_triangulation(int n, unsigned seed)
{
  const std::vector<Point> points = random_points(n, seed, 0, 1);
  return Delaunay(points.begin(), points.end());
}

} // namespace

TEST_CASE("a uniform field is known at compile time and refuses sizes that aren't lengths")
{
  STATIC_REQUIRE(weft::is_uniform_sizing<weft::Uniform_sizing<>>::value);
  STATIC_REQUIRE(weft::is_uniform_sizing_v<const weft::Uniform_sizing<double>&>);
  STATIC_REQUIRE_FALSE(weft::is_uniform_sizing<Lfs>::value);
  CHECK(weft::Uniform_sizing<>(0.25)(Point(3, 4)) == 0.25);
  for (const double bad : {0., -1., infinity, std::nan("")})
    CHECK_THROWS_AS(weft::Uniform_sizing<>(bad), weft::Option_error);
}

TEST_CASE("a Lipschitz field is the infimum over its sources")
{
  const std::vector<Point> points = random_points(200, 1, 0, 1);
  std::mt19937 random(2);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) sizes.push_back(std::exp(-4. * double(random() % 1000) / 1000));
  for (const double k : {0., 0.1, 0.7, 3.}) {
    const Lipschitz field(points, sizes, k, 0.02, 0.9);
    for (const Point& x : random_points(500, 3)) {
      double expected = infinity;
      for (std::size_t i = 0; i < points.size(); ++i)
        expected = std::min(expected, k * distance(points[i], x) + sizes[i]);
      CHECK(field(x) == Approx(std::min(0.9, std::max(0.02, expected))).epsilon(1e-12));
    }
  }
}

TEST_CASE("a segment source is the infimum over its points")
{
  for (const double other_end : {0.1, 0.12, 0.3, 0.55, 2.}) {
    const Lipschitz field({{Point(0.1, 0.2), Point(0.8, 0.5), 0.1, other_end}}, 0.5);
    for (const Point& x : random_points(200, 4)) {
      double expected = infinity;
      for (int i = 0; i <= 2000; ++i) {
        const double t = i / 2000.;
        const Point s(0.1 + 0.7 * t, 0.2 + 0.3 * t);
        expected = std::min(expected, 0.5 * distance(s, x) + 0.1 + t * (other_end - 0.1));
      }
      CHECK(field(x) <= expected + 1e-12);
      CHECK(field(x) >= expected - 1e-3);
    }
  }
}

TEST_CASE("below a limit a Lipschitz field is the smaller of the two")
{
  const std::vector<Point> points = random_points(200, 5, 0, 1);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) sizes.push_back(0.01 + 0.001 * static_cast<double>(i));
  const Lipschitz field(points, sizes, 0.7, 0.02, 0.15);
  for (const Point& x : random_points(500, 6))
    for (const double limit : {0.005, 0.02, 0.04, 0.06, 0.1, 0.15, 0.3, infinity}) {
      CHECK(field.below(x, limit) == Approx(std::min(limit, field(x))).epsilon(1e-14));
      CHECK(field.below(x, limit) <= limit);
    }
}

TEST_CASE("the lfs field is below the infimum over the graph and within its tolerance")
{
  for (const auto& [name, pslg] : nasty_graphs()) {
    INFO(name);
    const Sampled coarse = sample(pslg, 150);
    Sampled fine; // only where the coarse samples miss the infimum
    for (const double k : {0., 0.3, 1., 2.}) {
      const Lfs field(pslg, k);
      double worst_above = 0, worst_below = 0;
      for (const Point& x : random_points(150, 7)) {
        const double value = field(x);
        double expected = brute_mu(coarse, k, x);
        worst_above = std::max(worst_above, value / expected - 1);
        if (expected > 1.01 * value) {
          if (fine.at.empty()) fine = sample(pslg, 4000);
          expected = std::min(expected, brute_mu(fine, k, x));
        }
        worst_below = std::max(worst_below, expected / value - 1);
      }
      CHECK(worst_above < 1e-9);
      CHECK(worst_below < 0.01 + 0.002); // the second for the samples
    }
  }
}

TEST_CASE("on the graph the lfs field for a large k is the local feature size")
{
  for (const auto& [name, pslg] : nasty_graphs()) {
    INFO(name);
    const Lfs field(pslg, 1.);
    const Sampled on_graph = sample(pslg, 37);
    double highest = 0, lowest = 2;
    for (std::size_t i = 0; i < on_graph.at.size(); ++i) {
      const double ratio = field(on_graph.at[i]) / on_graph.lfs[i];
      highest = std::max(highest, ratio), lowest = std::min(lowest, ratio);
    }
    CHECK(highest <= 1 + 1e-9);
    CHECK(lowest >= 1 / 1.01 - 1e-9); // lfs is 1-Lipschitz, so with k = 1 nothing else is smaller
  }
}

TEST_CASE("the lfs field of a unit square is the known one")
{
  const Lfs field(square(), 0.5);
  CHECK(field(Point(0.5, 0)) == Approx(0.5).epsilon(0.01)); // half a side
  CHECK(field(Point(0, 0)) == Approx(0.75).epsilon(0.01));  // lfs is 1, the middle of a side gives 0.5 + 0.5 / 2
  CHECK(field(Point(0.5, 0.5)) == Approx(0.75).epsilon(0.01));
  CHECK(Lfs(square(), 0.)(Point(0.3, 0.3)) == Approx(0.5).epsilon(0.01));
}

TEST_CASE("the lfs field is k-Lipschitz and positive, and stays in its range")
{
  for (const auto& [name, pslg] : nasty_graphs()) {
    INFO(name);
    for (const double k : {0.1, 0.8}) {
      const Lfs field(pslg, k), clamped(pslg, k, 0.05, 0.2);
      const std::vector<Point> p = random_points(300, 8), q = random_points(300, 9);
      double least = infinity, steepest = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        for (const Point& x : {q[i], p[i] + 1e-3 * (q[i] - p[i])}) {
          least = std::min(least, field(x));
          steepest = std::max(steepest, std::abs(field(p[i]) - field(x)) / distance(p[i], x));
          CHECK(clamped(x) == Approx(std::clamp(field(x), 0.05, 0.2)).epsilon(0.011));
        }
      CHECK(least > 0);
      CHECK(steepest <= k * (1 + 1e-9));
    }
  }
}

TEST_CASE("the lfs field moves, turns and scales with its graph")
{
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const auto& [name, pslg] : nasty_graphs()) {
    INFO(name);
    const Lfs field(pslg, 0.4);
    const auto turned = [&](const Point& p) { return Point(3 + c * p.x() - s * p.y(), -2 + s * p.x() + c * p.y()); };
    const Lfs turned_field(mapped(pslg, turned), 0.4);
    const auto scaled = [](double factor) {
      return [factor](const Point& p) { return Point(factor * p.x(), factor * p.y()); };
    };
    for (const Point& x : random_points(60, 10)) CHECK(turned_field(turned(x)) == Approx(field(x)).epsilon(0.0101));
    for (const double factor : {1e150, 1e-150, 3.}) {
      const Lfs scaled_field(mapped(pslg, scaled(factor)), 0.4);
      for (const Point& x : random_points(60, 11))
        CHECK(scaled_field(scaled(factor)(x)) / factor == Approx(field(x)).epsilon(0.0101));
    }
    const Lfs doubled(mapped(pslg, scaled(1024)), 0.4); // by a power of two: the same bits
    for (const Point& x : random_points(60, 12)) CHECK(doubled(scaled(1024)(x)) == 1024 * field(x));
  }
}

TEST_CASE("the lfs field doesn't depend on the order of points and segments, nor on repetitions")
{
  for (const auto& [name, pslg] : nasty_graphs()) {
    INFO(name);
    Pslg reversed = pslg;
    std::reverse(reversed.points.begin(), reversed.points.end());
    std::reverse(reversed.segments.begin(), reversed.segments.end());
    for (auto& e : reversed.segments) e = {pslg.points.size() - 1 - e[1], pslg.points.size() - 1 - e[0]};
    Pslg repeated = pslg; // each segment once more, with points of its own
    for (const auto& e : pslg.segments) {
      repeated.segments.push_back({repeated.points.size(), e[0]});
      repeated.points.push_back(pslg.points[e[1]]);
    }
    const Lfs field(pslg, 0.4), same(reversed, 0.4), again(repeated, 0.4), copy(pslg, 0.4);
    for (const Point& x : random_points(100, 13)) {
      CHECK(same(x) == Approx(field(x)).epsilon(0.0101));
      CHECK(again(x) == Approx(field(x)).epsilon(0.0101));
      CHECK(copy(x) == field(x));
    }
  }
}

TEST_CASE("the lfs field refuses arguments out of range and graphs whose features meet")
{
  for (const double bad : {-0.1, infinity, std::nan("")}) CHECK_THROWS_AS(Lfs(square(), bad), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, 2, 1), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, std::nan(""), 1), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, -1, 1), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, 0, std::nan("")), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, 0, 0), weft::Option_error);
  CHECK_THROWS_AS(Lfs(square(), 0.5, 0, 1, 0), weft::Option_error);
  CHECK_THROWS_AS(Lfs(Pslg{}, 0.5), weft::Option_error);
  CHECK(Lfs(Pslg{}, 0.5, 0, 3)(Point(1, 1)) == 3);
  CHECK_THROWS_AS(Lfs(Pslg{{{0, 0}}, {{0, 1}}, {}, {}, {}, {}}, 0.5), weft::Domain_error);
  CHECK_THROWS_AS(Lfs(Pslg{{{0, 0}, {std::nan(""), 1}}, {{0, 1}}, {}, {}, {}, {}}, 0.5), weft::Domain_error);

  const Pslg crossing{{{0, 0}, {1, 1}, {0, 1}, {1, 0.1}}, {{0, 1}, {2, 3}}, {}, {}, {}, {}};
  const Pslg overlapping{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {{0, 2}, {1, 3}}, {}, {}, {}, {}};
  const Pslg junction{{{0, 0}, {2, 0}, {1, 0}, {1, 1}}, {{0, 1}, {2, 3}}, {}, {}, {}, {}};
  const Pslg point_on_segment{{{0, 0}, {2, 0}, {0.75, 0}}, {{0, 1}}, {}, {}, {}, {}};
  for (const Pslg& bad : {crossing, overlapping, junction, point_on_segment}) {
    CHECK_THROWS_AS(Lfs(bad, 0.5), weft::Domain_error);
    CHECK(Lfs(bad, 0.5, 0.01)(Point(0.75, 0)) >= 0.01); // a smallest size makes sense of them
  }
  try {
    Lfs field(crossing, 0.5);
  } catch (const weft::Domain_error& error) {
    CHECK(error.elements() == std::vector<std::size_t>{0, 1});
  }
}

TEST_CASE("evaluating the lfs field takes logarithmic work")
{
  const auto work = [](const Pslg& pslg, double low) {
    const Lfs field(pslg, 0.4);
    std::size_t sum = 0;
    const std::vector<Point> at = random_points(2000, 14, low, 1);
    for (const Point& x : at) sum += field.sources().visited_nodes(x);
    return double(sum) / double(at.size());
  };
  // From 10^2 to 10^5 segments log n grows by 2.5; work that is linear would grow by 1000, a square root by 32.
  const double random_100 = work(random_disjoint_segments(100, 1), 0), circle_100 = work(circle(100), -1);
  for (const std::size_t n : {1000, 10000, 100000}) {
    const double growth = std::log(double(n)) / std::log(100.);
    CHECK(work(random_disjoint_segments(n, 1), 0) < 1.6 * growth * random_100);
    CHECK(work(circle(n), -1) < 1.6 * growth * circle_100);
  }
}

TEST_CASE("a channel of parallel segments takes few sources however thin it is")
{
  for (const double width : {1e-2, 1e-5, 1e-9}) {
    const Pslg channel{{{0, 0}, {1, 0}, {0, width}, {1, width}}, {{0, 1}, {2, 3}}, {}, {}, {}, {}};
    const Lfs field(channel, 0.5);
    CHECK(field.sources().number_of_sources() <= 4);
    CHECK(field(Point(0.5, 0)) == Approx(width).epsilon(0.0101));
    CHECK(field(Point(0.5, 1)) == Approx(0.5).epsilon(0.011).margin(width));
  }
}

TEST_CASE("a background field has its sizes at the vertices and is linear between them")
{
  const Delaunay triangulation = random_triangulation(500, 20);
  const auto linear = [](const Point& p) { return 2 + 0.5 * p.x() - 0.25 * p.y(); };
  const Background field(triangulation, [&](Delaunay::Vertex_handle v) { return linear(v->point()); });
  const Background bumpy(triangulation, [](Delaunay::Vertex_handle v) { return 1 + std::sin(99 * v->point().x()); });
  for (std::size_t i = 0; i < field.points().size(); ++i) {
    CHECK(field(field.points()[i]) == Approx(field.sizes()[i]).epsilon(1e-14));
    CHECK(bumpy(bumpy.points()[i]) == Approx(bumpy.sizes()[i]).epsilon(1e-14));
  }
  for (const Point& x : random_points(2000, 21, 0.1, 0.9)) CHECK(field(x) == Approx(linear(x)).epsilon(1e-12));
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
    double mean = 0;
    for (int i = 0; i < 3; ++i) mean += (1 + std::sin(99 * f->vertex(i)->point().x())) / 3;
    const Point centre = CGAL::centroid(triangulation.triangle(f));
    CHECK(bumpy(centre) == Approx(mean).epsilon(1e-6).margin(1e-6));
  }
}

TEST_CASE("outside of its triangulation a background field is that of the closest point of the hull")
{
  const Delaunay triangulation = random_triangulation(300, 22);
  const Background field(triangulation,
                         [](Delaunay::Vertex_handle v) { return 1 + std::abs(std::sin(30 * v->point().x())); });
  std::vector<Segment> hull;
  auto face = triangulation.incident_faces(triangulation.infinite_vertex());
  const auto done = face;
  do hull.push_back(triangulation.segment(face, face->index(triangulation.infinite_vertex())));
  while (++face != done);
  for (const Point& x : random_points(2000, 23, -2, 3)) {
    const auto place = triangulation.locate(x);
    if (!triangulation.is_infinite(place)) continue;
    Point closest = hull.front().source();
    for (const Segment& e : hull) {
      const double t = std::clamp(((x - e.source()) * e.to_vector()) / e.squared_length(), 0., 1.);
      const Point p = e.source() + t * e.to_vector();
      if (distance(x, p) < distance(x, closest)) closest = p;
    }
    CHECK(field(x) == Approx(field(closest)).epsilon(1e-7));
  }
}

TEST_CASE("limiting the gradient makes a background field k-Lipschitz and never raises it")
{
  for (const int n : {3, 4, 50, 2000})
    for (const double k : {0., 0.05, 0.3, 2.}) {
      INFO(n << " points, k = " << k);
      const Delaunay triangulation = random_triangulation(n, 24);
      std::mt19937 random(25);
      std::uniform_real_distribution<double> size(0.01, 1);
      Background field(triangulation, [&](Delaunay::Vertex_handle) { return size(random); });
      const std::vector<double> before = field.sizes();
      field.limit_gradient(k);
      CHECK(field.max_gradient() <= k);
      for (std::size_t i = 0; i < before.size(); ++i) CHECK(field.sizes()[i] <= before[i]);
      CHECK(*std::min_element(field.sizes().begin(), field.sizes().end()) ==
            *std::min_element(before.begin(), before.end()));
      double steepest = 0; // judged by values alone, along short and long ways, inside and outside
      const std::vector<Point> p = random_points(500, 26, -0.2, 1.2), q = random_points(500, 27, -0.2, 1.2);
      for (std::size_t i = 0; i < p.size(); ++i)
        for (const Point& x : {q[i], p[i] + 0.01 * (q[i] - p[i])})
          steepest = std::max(steepest, std::abs(field(p[i]) - field(x)) / distance(p[i], x));
      CHECK(steepest <= k + 1e-9);
    }
}

TEST_CASE("limiting keeps a field that is gentle already and leaves a cone around a small size")
{
  const Delaunay triangulation = random_triangulation(400, 28);
  Background gentle(triangulation, [](Delaunay::Vertex_handle v) { return 1 + 0.1 * v->point().x(); });
  const std::vector<double> before = gentle.sizes();
  gentle.limit_gradient(0.2);
  CHECK(gentle.sizes() == before);

  // One small size on a fine grid: what is left is a cone, up to what the grid resolves and never above it at a vertex.
  Delaunay grid;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) grid.insert(Point(i / 40., j / 40.));
  Background cone(grid, [](Delaunay::Vertex_handle v) { return v->point() == Point(0.5, 0.5) ? 0.1 : 10.; });
  cone.limit_gradient(0.4);
  for (const Point& x : random_points(300, 29, 0, 1))
    CHECK(cone(x) == Approx(0.1 + 0.4 * distance(x, Point(0.5, 0.5))).epsilon(0.11));
}

TEST_CASE("a background field refuses sizes that aren't lengths and triangulations without a triangle")
{
  const Delaunay triangulation = random_triangulation(10, 30);
  for (const double bad : {0., -1., infinity, std::nan("")})
    CHECK_THROWS_AS(Background(triangulation, [&](Delaunay::Vertex_handle) { return bad; }), weft::Option_error);
  CHECK_THROWS_AS(Background(Delaunay(), [](Delaunay::Vertex_handle) { return 1.; }), weft::Domain_error);
  Background field(triangulation, [](Delaunay::Vertex_handle) { return 1.; });
  for (const double bad : {-1., infinity, std::nan("")}) CHECK_THROWS_AS(field.limit_gradient(bad), weft::Option_error);
}

TEST_CASE("many threads read a background field and get what one gets")
{
  const Delaunay triangulation = random_triangulation(2000, 31);
  const Background field(triangulation, [](Delaunay::Vertex_handle v) { return 1 + v->point().x() * v->point().y(); });
  const std::vector<Point> at = random_points(20000, 32);
  std::vector<double> forwards(at.size()), backwards(at.size());
  std::thread first([&] {
    for (std::size_t i = 0; i < at.size(); ++i) forwards[i] = field(at[i]);
  });
  std::thread second([&] {
    for (std::size_t i = at.size(); i-- > 0;) backwards[i] = field(at[i]);
  });
  first.join(), second.join();
  CHECK(forwards == backwards);
}

TEST_CASE("a cached field is as near as asked and not above the field")
{
  const Lfs lfs(random_graph(60, 33), 0.5);
  const auto wave = [](const Point& p) { return 1.5 + std::sin(7 * p.x()) * std::cos(9 * p.y()); };
  const auto judge = [](const auto& field, double error) {
    weft::Cache_options options;
    options.relative_error = error;
    const weft::Cached_sizing_2<K, std::decay_t<decltype(field)>> cache(field, CGAL::Bbox_2(0, 0, 1, 0.7), options);
    CHECK(cache.coarse_leaves() == 0);
    CHECK(cache.worst_error() <= error);
    double above = 0, below = 0;
    for (const Point& x : random_points(20000, 34, 0, 1)) {
      above = std::max(above, cache(x) / field(x) - 1);
      below = std::max(below, 1 - cache(x) / field(x));
    }
    CHECK(above <= error); // between test points
    CHECK(below <= 2 * error);
    const Point outside(2, 3);
    CHECK(cache(outside) == field(outside));
    CHECK(cache.evaluations() <= 13 * cache.number_of_leaves());
  };
  for (const double error : {0.2, 0.05, 0.01}) judge(lfs, error), judge(wave, error);
}

TEST_CASE("a cache on a budget errs on the small side")
{
  const auto spike = [](const Point& p) { return 0.001 + distance(p, Point(0.51, 0.47)); };
  for (const bool by_depth : {true, false}) {
    weft::Cache_options options;
    options.first_cells = 4;
    if (by_depth)
      options.max_depth = 3;
    else
      options.max_leaves = 100;
    const weft::Cached_sizing_2<K, decltype(spike)> cache(spike, CGAL::Bbox_2(0, 0, 1, 1), options);
    CHECK(cache.coarse_leaves() > 0);
    if (!by_depth) CHECK(cache.number_of_leaves() <= 100);
    // A lattice that is made of test points of every leaf that these trees can have at least this coarse.
    for (int i = 0; i <= 16; ++i)
      for (int j = 0; j <= 16; ++j) {
        const Point x(i / 16., j / 16.);
        CHECK(cache(x) <= spike(x) * (1 + 1e-9));
        CHECK(cache(x) > 0);
      }
  }
}

TEST_CASE("a cache refuses bad options and bad fields")
{
  const auto one = [](const Point&) { return 1.; };
  const auto make = [&](double error, int cells, int depth, const CGAL::Bbox_2& box) {
    weft::Cache_options options;
    options.relative_error = error, options.first_cells = cells, options.max_depth = depth;
    return weft::Cached_sizing_2<K, decltype(one)>(one, box, options);
  };
  const CGAL::Bbox_2 box(0, 0, 1, 1);
  CHECK(make(0.1, 4, 3, box)(Point(0.3, 1)) == 1);
  CHECK_THROWS_AS(make(0, 4, 3, box), weft::Option_error);
  CHECK_THROWS_AS(make(std::nan(""), 4, 3, box), weft::Option_error);
  CHECK_THROWS_AS(make(0.1, 0, 3, box), weft::Option_error);
  CHECK_THROWS_AS(make(0.1, 4, 40, box), weft::Option_error);
  CHECK_THROWS_AS(make(0.1, 4, 3, CGAL::Bbox_2(0, 0, 0, 0)), weft::Option_error);
  CHECK_THROWS_AS(make(0.1, 4, 3, CGAL::Bbox_2()), weft::Option_error);
  const auto zero = [](const Point&) { return 0.; };
  CHECK_THROWS_AS((weft::Cached_sizing_2<K, decltype(zero)>(zero, box)), weft::Option_error);
}

TEST_CASE(
    "features so near to each other that lfs rounds to zero are refused with their place, or need a smallest size")
{
  // The corner at (1e-200, 0.5) is off the side of the square, but the square of its distance underflows.
  const Pslg pslg{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1e-200, 0.5}, {0.5, 0.3}, {0.5, 0.7}},
                  {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 4}},
                  {},
                  {},
                  {},
                  {}};
  try {
    Lfs(pslg, 0.5);
    FAIL("accepted");
  } catch (const weft::Domain_error& error) {
    CHECK(std::string(error.what()).find("rounds to 0 near (") != std::string::npos);
  }
  CHECK(Lfs(pslg, 0.5, 1e-3)(pslg.points[4]) == Approx(1e-3));
}
