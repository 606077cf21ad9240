// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the quality measures: they agree with plain formulas in longer arithmetic, don't depend on where the
// mesh lies or how large it is, and reports of them are valid JSON whatever they contain.

#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/IO/write_report_json_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;
using Point = K::Point_2;

const long double pi = std::acos(-1.0L);

void add_loop(Pslg& pslg, const std::vector<Point>& corners)
{
  const std::size_t first = pslg.points.size(), n = corners.size();
  pslg.points.insert(pslg.points.end(), corners.begin(), corners.end());
  for (std::size_t i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n});
}

Cdt mesh(const Pslg& pslg)
{
  Cdt cdt;
  weft::insert_pslg(cdt, pslg);
  weft::mark_domain(cdt, pslg);
  return cdt;
}

Cdt polygon(const std::vector<Point>& corners)
{
  Pslg pslg;
  add_loop(pslg, corners);
  return mesh(pslg);
}

/// The unit square with a triangular hole, a dangling segment and random points in and around it.
Pslg square_with_points(unsigned seed, int n)
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_loop(pslg, {{0.25, 0.25}, {0.5, 0.25}, {0.375, 0.5}});
  pslg.points.emplace_back(0.75, 0.75);
  pslg.segments.push_back({2, 7});
  std::mt19937 random(seed);
  for (int i = 0; i < n; ++i) {
    const double x = static_cast<double>(random()) / 4294967296., y = static_cast<double>(random()) / 4294967296.;
    pslg.points.emplace_back(1.5 * x - 0.25, 1.5 * y - 0.25);
  }
  return pslg;
}

/// A triangle measured by the law of cosines and Heron's formula.
struct Plain_triangle
{
  std::array<long double, 3> length, angle;
  long double area, circumradius, inradius;

  explicit Plain_triangle(Cdt::Face_handle f)
  {
    for (int i = 0; i < 3; ++i) {
      const Point &p = f->vertex((i + 1) % 3)->point(), &q = f->vertex((i + 2) % 3)->point();
      length[i] = std::hypot(static_cast<long double>(p.x()) - q.x(), static_cast<long double>(p.y()) - q.y());
    }
    const long double half = (length[0] + length[1] + length[2]) / 2;
    area = std::sqrt(half * (half - length[0]) * (half - length[1]) * (half - length[2]));
    circumradius = length[0] * length[1] * length[2] / (4 * area);
    inradius = area / half;
    for (int i = 0; i < 3; ++i) {
      const long double a = length[i], b = length[(i + 1) % 3], c = length[(i + 2) % 3];
      angle[i] = std::acos((b * b + c * c - a * a) / (2 * b * c)) * 180 / pi;
    }
  }
  long double longest() const { return std::max({length[0], length[1], length[2]}); }
  long double shortest() const { return std::min({length[0], length[1], length[2]}); }
};

std::vector<Cdt::Face_handle> domain(const Cdt& cdt)
{
  std::vector<Cdt::Face_handle> faces;
  for (const auto f : cdt.finite_face_handles())
    if (f->is_in_domain()) faces.push_back(f);
  return faces;
}

Approx near(long double x, double relative = 1e-10)
{
  return Approx(static_cast<double>(x)).epsilon(relative).margin(0);
}

/// The members that shouldn't depend on position or size, one after the other.
std::vector<double> shape(const weft::Quality_2& q)
{
  return {q.smallest_angle.degrees,
          q.largest_angle.degrees,
          q.mean_smallest_angle,
          q.largest_aspect_ratio,
          q.mean_aspect_ratio,
          q.smallest_radius_ratio,
          q.mean_radius_ratio,
          q.longest_edge / q.shortest_edge,
          static_cast<double>(q.triangles),
          static_cast<double>(q.vertices),
          q.area / q.longest_edge / q.longest_edge};
}

/// Accepts exactly the JSON grammar; strings must be UTF-8, of which it knows lead and continuation bytes.
class Json_reader
{
public:
  explicit Json_reader(const std::string& text) : text_(text) {}
  bool is_valid()
  {
    value();
    space();
    return good_ && at_ == text_.size();
  }

private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void space()
  {
    while (at_ < text_.size() && std::string(" \n\r\t").find(text_[at_]) != std::string::npos) ++at_;
  }
  bool accept(const std::string& token)
  {
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  void require(bool holds) { good_ = good_ && holds; }
  void value()
  {
    space();
    if (!good_ || accept("null") || accept("true") || accept("false")) return;
    if (peek() == '{')
      list('{', '}', true);
    else if (peek() == '[')
      list('[', ']', false);
    else if (peek() == '"')
      string();
    else
      number();
  }
  void list(char open, char close, bool named)
  {
    require(accept(std::string(1, open)));
    space();
    if (accept(std::string(1, close))) return;
    do {
      space();
      if (named) {
        string();
        space();
        require(accept(":"));
      }
      value();
      space();
    } while (good_ && accept(","));
    require(accept(std::string(1, close)));
  }
  void digits()
  {
    require(peek() >= '0' && peek() <= '9');
    while (peek() >= '0' && peek() <= '9') ++at_;
  }
  void number()
  {
    accept("-");
    if (!accept("0")) digits();
    if (accept(".")) digits();
    if (accept("e") || accept("E")) {
      if (!accept("+")) accept("-");
      digits();
    }
  }
  void string()
  {
    require(accept("\""));
    while (good_ && peek() != '"') {
      const auto byte = static_cast<unsigned char>(peek());
      require(at_ < text_.size() && byte >= 0x20);
      ++at_;
      if (byte == '\\') {
        const bool unicode = peek() == 'u';
        require(std::string("\"\\/bfnrtu").find(peek()) != std::string::npos);
        ++at_;
        for (int i = 0; unicode && i < 4; ++i) require(std::isxdigit(static_cast<unsigned char>(text_.at(at_++))) != 0);
      }
      const int more = byte < 0x80 ? 0 : byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : 1;
      require(byte < 0x80 || (byte >= 0xC2 && byte < 0xF5));
      for (int i = 0; i < more; ++i, ++at_) require((static_cast<unsigned char>(peek()) & 0xC0) == 0x80);
    }
    require(accept("\""));
  }

  const std::string& text_;
  std::size_t at_ = 0;
  bool good_ = true;
};

std::string json(const weft::Mesh_report_2& report, const weft::Quality_2& quality)
{
  std::ostringstream out;
  weft::IO::write_report_json(out, report, quality);
  return out.str();
}

} // namespace

TEST_CASE("a right triangle has the measures that are known by heart")
{
  const weft::Quality_2 q = weft::measure_quality_2(polygon({{0, 0}, {4, 0}, {4, 3}}));
  CHECK(q.triangles == 1);
  CHECK(q.vertices == 3);
  CHECK(q.area == near(6));
  CHECK(q.largest_angle.degrees == near(90));
  CHECK(q.largest_angle.corners[0] == std::array<double, 2>{4, 0});
  CHECK(q.smallest_angle.degrees == near(std::atan(0.75) * 180 / pi));
  CHECK(q.smallest_angle.corners[0] == std::array<double, 2>{0, 0});
  CHECK(q.mean_smallest_angle == q.smallest_angle.degrees);
  CHECK(q.largest_aspect_ratio == near(2.5 / 3));
  CHECK(q.smallest_radius_ratio == near(0.8));
  CHECK(q.shortest_edge == near(3));
  CHECK(q.longest_edge == near(5));
  CHECK(q.angles[36] == 1);
  CHECK(q.angles[53] == 1);
}

TEST_CASE("an equilateral triangle has the best ratios")
{
  const weft::Quality_2 q = weft::measure_quality_2(polygon({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}));
  CHECK(q.largest_aspect_ratio == near(1 / std::sqrt(3.L)));
  CHECK(q.mean_radius_ratio == near(1));
  CHECK(q.mean_smallest_angle == near(60));
}

TEST_CASE("quality agrees with plain formulas in longer arithmetic")
{
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Cdt cdt = mesh(square_with_points(seed, 200));
    const weft::Quality_2 q = weft::measure_quality_2(cdt);
    const auto faces = domain(cdt);
    REQUIRE(faces.size() > 100);

    long double smallest = 180, largest = 0, minima = 0, area = 0, aspect = 0, worst_aspect = 0, radius = 0,
                worst_radius = 1, shortest = 10, longest = 0;
    std::vector<std::size_t> bins(180, 0);
    for (const auto f : faces) {
      const Plain_triangle t(f);
      long double least = 180;
      for (const long double a : t.angle) {
        least = std::min(least, a);
        largest = std::max(largest, a);
        ++bins.at(static_cast<std::size_t>(a));
      }
      smallest = std::min(smallest, least);
      minima += least;
      area += t.area;
      aspect += t.circumradius / t.shortest();
      worst_aspect = std::max(worst_aspect, t.circumradius / t.shortest());
      radius += 2 * t.inradius / t.circumradius;
      worst_radius = std::min(worst_radius, 2 * t.inradius / t.circumradius);
      shortest = std::min(shortest, t.shortest());
      longest = std::max(longest, t.longest());
    }
    const auto n = static_cast<long double>(faces.size());
    CHECK(q.triangles == faces.size());
    CHECK(q.area == near(area));
    CHECK(q.area == near(1 - 0.25 * 0.25 / 2)); // the square without its hole
    CHECK(q.smallest_angle.degrees == near(smallest));
    CHECK(q.largest_angle.degrees == near(largest));
    CHECK(q.mean_smallest_angle == near(minima / n));
    CHECK(q.mean_aspect_ratio == near(aspect / n));
    CHECK(q.largest_aspect_ratio == near(worst_aspect));
    CHECK(q.mean_radius_ratio == near(radius / n));
    CHECK(q.smallest_radius_ratio == near(worst_radius));
    CHECK(q.shortest_edge == near(shortest));
    CHECK(q.longest_edge == near(longest));
    CHECK(std::equal(bins.begin(), bins.end(), q.angles.begin()));

    // The triangles named have these angles at their first corner.
    for (const auto* extreme : {&q.smallest_angle, &q.largest_angle}) {
      const auto f = faces.at(extreme->triangle);
      const Plain_triangle t(f);
      int i = 0;
      while (i < 3 && f->vertex(i)->point() != Point(extreme->corners[0][0], extreme->corners[0][1])) ++i;
      REQUIRE(i < 3);
      CHECK(extreme->degrees == near(t.angle[i]));
    }
  }
}

TEST_CASE("scaling by a power of two changes lengths alone, however far it goes")
{
  const Pslg pslg = square_with_points(4, 60);
  const weft::Quality_2 q = weft::measure_quality_2(mesh(pslg));
  for (const int exponent : {-600, -20, 20, 600}) {
    const double factor = std::ldexp(1, exponent);
    // The same triangulation with every point scaled: nothing but the measures is tested at these sizes.
    Cdt cdt = mesh(pslg);
    for (const auto v : cdt.finite_vertex_handles())
      v->set_point(Point(factor * v->point().x(), factor * v->point().y()));
    const weft::Quality_2 scaled = weft::measure_quality_2(cdt);
    CHECK(scaled.angles == q.angles);
    CHECK(scaled.smallest_angle.degrees == q.smallest_angle.degrees);
    CHECK(scaled.smallest_angle.triangle == q.smallest_angle.triangle);
    CHECK(scaled.largest_aspect_ratio == q.largest_aspect_ratio);
    CHECK(scaled.mean_radius_ratio == q.mean_radius_ratio);
    CHECK(scaled.shortest_edge == factor * q.shortest_edge);
    CHECK(scaled.longest_edge == factor * q.longest_edge);

    const auto sizes = weft::measure_sizing_2(mesh(pslg), weft::Uniform_sizing<>(0.1));
    const auto scaled_sizes = weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(0.1 * factor));
    CHECK(scaled_sizes.triangles.mean == sizes.triangles.mean);
    CHECK(scaled_sizes.constrained_edges.largest == sizes.constrained_edges.largest);
    CHECK(scaled_sizes.ideal_triangles == near(sizes.ideal_triangles));
  }
}

TEST_CASE("rotating and moving a mesh changes its shape by rounding alone")
{
  const Pslg pslg = square_with_points(5, 100);
  const Cdt original = mesh(pslg);
  const auto expected = shape(weft::measure_quality_2(original));
  const double c = std::cos(0.7), s = std::sin(0.7);
  Cdt cdt = mesh(pslg);
  for (const auto v : cdt.finite_vertex_handles()) {
    const Point p = v->point();
    v->set_point(Point(3 * (c * p.x() - s * p.y()) + 7, 3 * (s * p.x() + c * p.y()) - 2));
  }
  const auto rotated = shape(weft::measure_quality_2(cdt));
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(rotated[i] == near(expected[i], 1e-9));
  CHECK(weft::smallest_constraint_angle_2(cdt) == near(weft::smallest_constraint_angle_2(original)));
}

TEST_CASE("of an empty domain nothing but counts and area is known")
{
  Cdt cdt;
  for (int points = 0; points < 5; ++points) {
    const weft::Quality_2 q = weft::measure_quality_2(cdt);
    CHECK(q.triangles == 0);
    CHECK(q.vertices == 0);
    CHECK(q.area == 0);
    CHECK(std::isnan(q.smallest_angle.degrees));
    CHECK(std::isnan(q.mean_aspect_ratio));
    CHECK(std::isnan(q.longest_edge));
    CHECK(weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(1)).ok());
    CHECK(weft::smallest_constraint_angle_2(cdt) == 360);
    CHECK(q.histogram<weft::Angle_histogram>("empty").total() == 0);
    cdt.insert(Point(points % 2, points));
  }
}

TEST_CASE("a flat triangle has the worst ratios and spoils no mean with NaN")
{
  Cdt cdt = polygon({{0, 0}, {2, 0}, {1, 1}});
  for (const auto v : cdt.finite_vertex_handles()) v->set_point(Point(v->point().x(), 0));
  const weft::Quality_2 q = weft::measure_quality_2(cdt);
  CHECK(q.smallest_angle.degrees == 0);
  CHECK(q.largest_angle.degrees == 180);
  CHECK(std::isinf(q.mean_aspect_ratio));
  CHECK(q.mean_radius_ratio == 0);
  CHECK(q.area == 0);
  CHECK(q.angles[179] == 1);
}

TEST_CASE("the histogram for pictures is that of the angles added one by one")
{
  const Cdt cdt = mesh(square_with_points(6, 150));
  const weft::Quality_2 q = weft::measure_quality_2(cdt);
  for (const std::size_t bins : {180u, 60u, 18u, 1u}) {
    weft::Angle_histogram expected("mesh", bins);
    for (const auto f : domain(cdt))
      for (const long double a : Plain_triangle(f).angle) expected.add(static_cast<double>(a));
    const auto histogram = q.histogram<weft::Angle_histogram>("mesh", bins);
    CHECK(histogram.counts == expected.counts);
    CHECK(histogram.smallest == near(expected.smallest));
    CHECK(histogram.largest == near(expected.largest));
    CHECK(histogram.name == "mesh");
  }
  CHECK_THROWS_AS(q.histogram<weft::Angle_histogram>("mesh", 7), weft::Option_error);
  CHECK_THROWS_AS(q.histogram<weft::Angle_histogram>("mesh", 0), weft::Option_error);
}

TEST_CASE("sizing ratios agree with plain formulas")
{
  const Cdt cdt = mesh(square_with_points(7, 200));
  const auto size = [](const Point& p) { return 0.1 + 0.05 * p.x() + 0.02 * p.y() * p.y(); };
  const auto q = weft::measure_sizing_2(cdt, size);

  long double sum = 0, largest = 0;
  std::size_t above = 0;
  const auto add = [&](long double ratio) {
    sum += ratio;
    largest = std::max(largest, ratio);
    above += ratio > 1;
  };
  const auto faces = domain(cdt);
  for (const auto f : faces) {
    const Point &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
    add(Plain_triangle(f).longest() / size(CGAL::centroid(a, b, c)));
  }
  CHECK(q.triangles.elements == faces.size());
  CHECK(q.triangles.largest == near(largest));
  CHECK(q.triangles.mean == near(sum / static_cast<long double>(faces.size())));
  CHECK(q.triangles.oversized == above);
  REQUIRE(above > 0);
  CHECK_FALSE(q.ok());

  sum = largest = 0;
  above = 0;
  std::size_t edges = 0;
  for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e, ++edges) {
    const K::Segment_2 s = cdt.segment(*e);
    add(std::sqrt(s.squared_length()) / size(CGAL::midpoint(s.source(), s.target())));
  }
  CHECK(q.constrained_edges.elements == edges);
  CHECK(q.constrained_edges.largest == near(largest));
  CHECK(q.constrained_edges.mean == near(sum / static_cast<long double>(edges)));
  CHECK(q.constrained_edges.oversized == above);
}

TEST_CASE("a ratio of exactly 1 isn't oversized, the next larger one is")
{
  const Cdt cdt = polygon({{0, 0}, {0.3, 0}, {0.3, 0.3}, {0, 0.3}});
  const double diagonal = weft::measure_quality_2(cdt).longest_edge;
  CHECK(weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(diagonal)).ok());
  const auto q = weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(std::nextafter(diagonal, 0)));
  CHECK(q.triangles.oversized == 2);
  CHECK(q.constrained_edges.oversized == 0);
}

TEST_CASE("constraints away from the domain have no sizing ratio")
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  pslg.points.emplace_back(2, 0);
  pslg.points.emplace_back(2, 100);
  pslg.segments.push_back({4, 5});
  const auto q = weft::measure_sizing_2(mesh(pslg), weft::Uniform_sizing<>(2));
  CHECK(q.constrained_edges.elements == 4);
  CHECK(q.ok());
}

TEST_CASE("the ideal number of triangles is the integral over the domain")
{
  const Cdt cdt = mesh(square_with_points(8, 20000));
  const double area = 1 - 0.25 * 0.25 / 2;
  const auto uniform = weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(0.01));
  CHECK(uniform.ideal_triangles == near(area / (std::sqrt(3.) / 4 * 1e-4)));
  CHECK(uniform.relative_count() == near(uniform.triangles.elements / uniform.ideal_triangles));

  const auto linear = weft::measure_sizing_2(cdt, [](const Point& p) { return 1 + p.x(); });
  // Over the square the integral is 2/sqrt(3); the hole is cut into thin strips.
  double hole = 0;
  const int strips = 1000;
  for (int i = 0; i < strips; ++i) {
    const double half_width = 0.125 * (1 - (i + 0.5) / strips);
    hole += 0.25 / strips * (1 / (1.375 - half_width) - 1 / (1.375 + half_width)) * 4 / std::sqrt(3.);
  }
  CHECK(linear.ideal_triangles == near(2 / std::sqrt(3.) - hole, 1e-6));
}

TEST_CASE("a sizing field that returns nonsense is refused")
{
  const Cdt cdt = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const double bad : {0., -1., std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(weft::measure_sizing_2(cdt, [bad](const Point&) { return bad; }), weft::Option_error);
}

TEST_CASE("the smallest constraint angle counts inside of the domain only")
{
  const Cdt wedge = polygon({{0, 0}, {10, 0}, {10, 1}});
  CHECK(weft::smallest_constraint_angle_2(wedge) == near(std::atan(0.1) * 180 / pi));

  // The notch is outside of the domain: its edges meet at 1.3 degrees there.
  const Cdt notched = polygon({{0, 0}, {10, 0}, {10, 10}, {5.1, 10}, {5, 1}, {4.9, 10}, {0, 10}});
  CHECK(weft::smallest_constraint_angle_2(notched) == near(90));
}

TEST_CASE("the smallest constraint angle agrees with sorting all directions")
{
  // Spokes in a box, at random angles: every wedge between two of them is in the domain.
  std::mt19937 random(9);
  for (int round = 0; round < 20; ++round) {
    Pslg pslg;
    add_loop(pslg, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
    pslg.points.emplace_back(0.1, 0.2);
    std::vector<double> directions;
    for (int i = 0; i < 7; ++i) {
      const double angle = static_cast<double>(random()) / 4294967296. * 360;
      directions.push_back(angle);
      pslg.points.emplace_back(0.1 + std::cos(angle * static_cast<double>(pi) / 180),
                               0.2 + std::sin(angle * static_cast<double>(pi) / 180));
      pslg.segments.push_back({4, pslg.points.size() - 1});
    }
    std::sort(directions.begin(), directions.end());
    double smallest = std::min(90., directions.front() + 360 - directions.back());
    for (std::size_t i = 1; i < directions.size(); ++i)
      smallest = std::min(smallest, directions[i] - directions[i - 1]);
    Cdt cdt = mesh(pslg);
    CHECK(weft::smallest_constraint_angle_2(cdt) == near(smallest, 1e-8));
    // Points that aren't on constraints don't matter, nor does the triangulation of the wedges.
    for (int i = 0; i < 50; ++i) cdt.insert(Point(0.03 * i - 0.7, 0.01 * ((i * 37) % 100) - 0.5));
    weft::mark_domain(cdt, pslg);
    CHECK(weft::smallest_constraint_angle_2(cdt) == near(smallest, 1e-8));
  }
}

TEST_CASE("a lone segment inside makes no angle")
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  pslg.points.emplace_back(0.4, 0.5);
  pslg.points.emplace_back(0.6, 0.5);
  pslg.segments.push_back({4, 5});
  CHECK(weft::smallest_constraint_angle_2(mesh(pslg)) == near(90));
}

TEST_CASE("reports for people and machines name the figures")
{
  const Cdt cdt = mesh(square_with_points(10, 50));
  const weft::Quality_2 quality = weft::measure_quality_2(cdt);
  const auto sizing = weft::measure_sizing_2(cdt, weft::Uniform_sizing<>(0.1));
  std::ostringstream people, machines;
  people << quality << sizing;
  CHECK(people.str().find("mean smallest angle") != std::string::npos);
  CHECK(people.str().find("nan") == std::string::npos);

  weft::Mesh_report_2 report;
  report.stage_seconds = {{"refine", 0.25}, {"relax", 1e-7}, {"refine", 3}};
  weft::IO::write_report_json(machines, report, quality, sizing);
  const std::string text = machines.str();
  CHECK(Json_reader(text).is_valid());
  for (const char* member : {"\"ok\": true", "\"stop_reason\": \"all criteria met\"", "\"seconds\": 0.25",
                             "\"quality\"", "\"bin_degrees\": 1", "\"sizing\"", "\"relative_count\""})
    CHECK(text.find(member) != std::string::npos);
  CHECK(text.find("\"triangles\": " + std::to_string(quality.triangles)) != std::string::npos);
  CHECK(text.find("null") == std::string::npos);
}

TEST_CASE("JSON is valid whatever the numbers and names are")
{
  const double infinity = std::numeric_limits<double>::infinity();
  weft::Quality_2 quality; // nothing but NaN
  quality.area = -infinity;
  weft::Mesh_report_2 report;
  report.largest_ratio = infinity;
  report.smallest_angle = -0.;
  report.largest_angle = std::numeric_limits<double>::denorm_min();
  CHECK(Json_reader(json(report, quality)).is_valid());
  CHECK(json(report, quality).find("nan") == std::string::npos);
  CHECK(json(report, quality).find("inf") == std::string::npos);

  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::string name;
    for (unsigned i = 0; i < 1 + random() % 12; ++i) {
      const std::array<std::string, 6> pieces = {"\"", "\\", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xED\xA0\x80", "a"};
      name += random() % 2 ? std::string(1, static_cast<char>(random() % 256)) : pieces[random() % pieces.size()];
    }
    report.stage_seconds = {{name, random() % 2 ? std::nan("") : 1. / (1 + random() % 1000)}};
    INFO(json(report, quality));
    CHECK(Json_reader(json(report, quality)).is_valid());
  }
  report.stage_seconds = {{"a\"b\\c\n\xE2\x82\xAC\xFF", 1}};
  CHECK(json(report, quality).find("\"a\\\"b\\\\c\\n\xE2\x82\xAC\xEF\xBF\xBD\"") != std::string::npos);
}

TEST_CASE("the JSON file holds what the stream gets, and a file that can't be written is an error")
{
  const weft::Quality_2 quality = weft::measure_quality_2(polygon({{0, 0}, {1, 0}, {0, 1}}));
  const std::string filename = "quality_test_report.json";
  weft::IO::write_report_json(filename, {}, quality);
  std::ifstream in(filename, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  CHECK(text == json({}, quality));
  in.close();
  std::remove(filename.c_str());
  CHECK_THROWS_AS(weft::IO::write_report_json("no/such/folder/report.json", {}, quality), weft::File_error);
}
