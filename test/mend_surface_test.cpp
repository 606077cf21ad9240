// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of mending surfaces: closed surfaces with random dirt become what they were, regions of random grids of
// cubes are what a flood fill finds, and what has no inside is refused. Cases are made from seeds, which are in the
// message when one fails.

#include "fixtures/surfaces_3.h"

#include <weft/IO/read_surface.h>
#include <weft/spatial/domain/domain_from_triangles.h>
#include <weft/spatial/surface/compare_with_given_3.h>
#include <weft/spatial/surface/mended_complex_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace {

using namespace surfaces;
using Complex = weft::Piecewise_smooth_complex_3<K>;
using Soup = weft::Polygon_soup_3<K>;
using Random = std::mt19937;

Soup soup_of(const Surface& s)
{
  Soup soup{s.points, {}};
  for (const auto& t : s.triangles) soup.polygons.emplace_back(t.begin(), t.end());
  return soup;
}

Complex mended(const Surface& s, const weft::Mend_options_3& options = {})
{
  return weft::mended_complex_3(soup_of(s), weft::Feature_options(), options);
}

bool is_accepted(const Surface& s)
{
  try {
    weft::piecewise_smooth_complex(s.points, s.triangles, weft::Feature_options{});
  } catch (const weft::Domain_error&) {
    return false;
  }
  return true;
}

std::string refusal_of(const Surface& s, const weft::Mend_options_3& options = {})
{
  try {
    mended(s, options);
  } catch (const weft::Domain_error& error) {
    return error.what();
  }
  return "";
}

std::string all_changes(const Complex& complex)
{
  std::string text;
  for (const std::string& change : complex.changes) text += change + "\n";
  return text;
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

double area(const Surface& s)
{
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles)
    sum += std::sqrt(CGAL::cross_product(s.points[b] - s.points[a], s.points[c] - s.points[a]).squared_length()) / 2;
  return sum;
}

double diagonal(const Surface& s)
{
  CGAL::Bbox_3 box;
  for (const auto& p : s.points) box += p.bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

double uniform(Random& random, double low, double high)
{
  return low + (high - low) * (random() / 4294967296.);
}
bool chance(Random& random, double p)
{
  return uniform(random, 0, 1) < p;
}
std::size_t below(Random& random, std::size_t n)
{
  return random() % n;
}

// ---- Random surfaces and their dirt

/// A part of size about 1 around the origin.
Surface random_part(Random& random)
{
  switch (random() % 5) {
  case 0:
    return moved(box(1 + int(random() % 3), 1 + int(random() % 3), 2), 0.3, -0.3, -0.3, -0.3);
  case 1:
    return sphere(1 + int(random() % 2));
  case 2:
    return torus(9 + random() % 8, 7 + random() % 4);
  case 3:
    return cylinder(7 + random() % 20);
  default:
    return nested_spheres({0.5}, 2);
  }
}

/// One to three parts that are apart from each other, turned in space.
Surface random_surface(Random& random)
{
  Surface s;
  const std::size_t n = 1 + random() % 3;
  for (std::size_t i = 0; i < n; ++i) s = together(s, moved(random_part(random), 1, 3.5 * double(i), 0.1, -0.2));
  const double a = uniform(random, 0, 3), b = uniform(random, 0, 3), scale = std::pow(10., uniform(random, -3, 3));
  for (Point& p : s.points) {
    const double x = std::cos(a) * p.x() - std::sin(a) * p.y(), y = std::sin(a) * p.x() + std::cos(a) * p.y();
    p = Point(scale * x, scale * (std::cos(b) * y - std::sin(b) * p.z()),
              scale * (std::sin(b) * y + std::cos(b) * p.z()));
  }
  return s;
}

/// Gives corners of facets points of their own, off by up to a distance in each coordinate.
void cut_seams(Surface& s, Random& random, double share, double jitter)
{
  for (Triangle& t : s.triangles)
    for (std::size_t& v : t) {
      if (!chance(random, share)) continue;
      const Point p = s.points[v];
      v = s.points.size();
      const auto off = [&] { return jitter == 0 ? 0 : uniform(random, -jitter, jitter); };
      s.points.emplace_back(p.x() + off(), p.y() + off(), p.z() + off());
    }
}

void flip_facets(Surface& s, Random& random, double share)
{
  for (Triangle& t : s.triangles)
    if (chance(random, share)) std::swap(t[1], t[2]);
}

void add_duplicates(Surface& s, Random& random, std::size_t n)
{
  for (; n > 0; --n) {
    Triangle t = s.triangles[below(random, s.triangles.size())];
    std::rotate(t.begin(), t.begin() + long(random() % 3), t.end());
    if (random() % 2) std::swap(t[0], t[1]);
    s.triangles.insert(s.triangles.begin() + long(below(random, s.triangles.size())), t);
  }
}

/// Facets with a corner twice, or with two corners at one place.
void add_degenerate(Surface& s, Random& random, std::size_t n)
{
  for (; n > 0; --n) {
    const Triangle t = s.triangles[below(random, s.triangles.size())];
    if (random() % 2) {
      s.triangles.push_back({t[0], t[1], t[1]});
    } else {
      s.points.push_back(s.points[t[0]]);
      s.triangles.push_back({t[0], t[1], s.points.size() - 1});
    }
  }
}

/// Cuts facets in two at a point on an edge whose other facet stays whole.
void add_t_junctions(Surface& s, Random& random, std::size_t n)
{
  std::set<std::pair<std::size_t, std::size_t>> used; // an edge is cut from one side only
  for (; n > 0; --n) {
    const std::size_t at = below(random, s.triangles.size());
    const auto [a, b, c] = s.triangles[at];
    if (!used.insert(std::minmax(a, b)).second) continue;
    s.points.push_back(CGAL::midpoint(s.points[a], s.points[b]));
    s.triangles[at] = {a, s.points.size() - 1, c};
    s.triangles.push_back({s.points.size() - 1, b, c});
  }
}

/// Small facets that stick out; every second one is held by an edge, others float. Their area.
double add_fins(Surface& s, Random& random, std::size_t n)
{
  Surface fins;
  for (; n > 0; --n) {
    const auto [a, b, c] = s.triangles[below(random, s.triangles.size())];
    const Point &p = s.points[a], &q = s.points[b];
    const auto normal = CGAL::cross_product(q - p, s.points[c] - p);
    const Point apex = CGAL::midpoint(p, q) + 0.02 * normal / std::sqrt(std::sqrt(normal.squared_length()));
    if (random() % 2) {
      s.points.push_back(apex);
      s.triangles.push_back({a, b, s.points.size() - 1});
      fins = together(fins, {{p, q, apex}, {{0, 1, 2}}});
    } else {
      const Surface fin{
          {apex, apex + 0.3 * (q - p), apex + 0.02 * normal / std::sqrt(std::sqrt(normal.squared_length()))},
          {{0, 1, 2}}};
      s = together(s, fin);
      fins = together(fins, fin);
    }
  }
  return area(fins);
}

/// The mended surface is closed, its facets look outwards, and it has this volume, area and number of shells.
void check_is(const Complex& complex, const Surface& clean, double tolerance)
{
  const Complex expected = weft::piecewise_smooth_complex(clean.points, clean.triangles, weft::Feature_options{});
  const Surface before{expected.points, expected.triangles}, after{complex.points, complex.triangles};
  const double size = diagonal(clean);
  CHECK(complex.sides.empty());
  CHECK(complex.number_of_shells == expected.number_of_shells);
  CHECK(volume(after) == Approx(volume(before)).margin(area(clean) * tolerance * size));
  CHECK(area(after) == Approx(area(before)).margin(20 * double(clean.triangles.size()) * tolerance * size * size));
  CHECK(is_accepted(after));
}

} // namespace

TEST_CASE("surfaces without faults are the same with mending as without")
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Surface s = random_surface(random);
    const Complex with = mended(s),
                  without = weft::piecewise_smooth_complex(s.points, s.triangles, weft::Feature_options{});
    CHECK(with.points == without.points);
    CHECK(with.triangles == without.triangles);
    CHECK(with.patches == without.patches);
    CHECK(with.shells == without.shells);
    CHECK(with.creases.size() == without.creases.size());
    CHECK(with.features.size() == without.features.size());
    CHECK(with.changes == without.changes);
  }
}

TEST_CASE("each kind of dirt is mended, said, and nothing else is")
{
  struct Kind
  {
    const char* note;
    void (*soil)(Surface&, Random&);
  };
  const std::vector<Kind> kinds = {
      {"welded to", [](Surface& s, Random& r) { cut_seams(s, r, 0.3, 0); }},
      {"welded to", [](Surface& s, Random& r) { cut_seams(s, r, 1, 0); }},
      {"welded to near", [](Surface& s, Random& r) { cut_seams(s, r, 0.3, 2e-7 * diagonal(s)); }},
      {"turned over",
       [](Surface& s, Random& r) { std::swap(s.triangles[0][0], s.triangles[0][1]), flip_facets(s, r, 0.4); }},
      {"twice", [](Surface& s, Random& r) { add_duplicates(s, r, 3); }},
      {"degenerate", [](Surface& s, Random& r) { add_degenerate(s, r, 3); }},
      {"split", [](Surface& s, Random& r) { add_t_junctions(s, r, 5); }},
      {"left out", [](Surface& s, Random& r) { add_fins(s, r, 3); }}};
  for (unsigned seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const Surface clean = random_surface(random);
    const Kind& kind = kinds[seed % kinds.size()];
    INFO("seed " << seed << ", " << kind.note);
    Surface dirty = clean;
    kind.soil(dirty, random);
    REQUIRE(!is_accepted(dirty));
    const Complex complex = mended(dirty);
    INFO(all_changes(complex));
    check_is(complex, clean, 2e-6);
    CHECK(contains(all_changes(complex), kind.note));
  }
}

TEST_CASE("all kinds of dirt together are mended, and the share of fins is right")
{
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Random random(1000 + seed);
    const Surface clean = random_surface(random);
    Surface dirty = clean;
    add_t_junctions(dirty, random, random() % 6);
    const double fins = add_fins(dirty, random, 1 + random() % 3);
    add_duplicates(dirty, random, random() % 6);
    flip_facets(dirty, random, uniform(random, 0, 1));
    cut_seams(dirty, random, uniform(random, 0, 0.7), random() % 2 ? 2e-7 * diagonal(clean) : 0);
    add_degenerate(dirty, random, random() % 6);
    const Complex complex = mended(dirty);
    const std::string changes = all_changes(complex);
    INFO(changes);
    check_is(complex, clean, 4e-6);
    const auto at = changes.find("bounds nothing, ") != std::string::npos ? changes.find("bounds nothing, ") + 16
                                                                          : changes.find("bound nothing, ") + 15;
    REQUIRE(at < changes.size());
    CHECK(std::stod(changes.substr(at)) == Approx(100 * fins / (fins + area(clean))).epsilon(0.06));
  }
}

TEST_CASE("points farther than the tolerance aren't welded")
{
  Random random(5);
  Surface s = sphere(2);
  cut_seams(s, random, 0.3, 1e-4);
  CHECK(!refusal_of(s).empty());
  weft::Mend_options_3 options;
  options.tolerance = 1e-3;
  CHECK(refusal_of(s, options).empty());
  options.tolerance = -1;
  CHECK_THROWS_AS(mended(s, options), weft::Option_error);
}

// ---- Regions

namespace {

/// A grid of cubes with a kind each, 0 outside.
struct Grid
{
  int n;
  std::map<Voxel, int> kind;

  int at(const Voxel& v) const
  {
    const auto found = kind.find(v);
    return found == kind.end() ? 0 : found->second;
  }
  /// Cubes that hang together by faces between equal kinds; the outside is number 0, and so is all of kind 0 that the
  /// outside reaches.
  std::map<Voxel, int> regions() const
  {
    std::map<Voxel, int> region;
    int count = 0;
    const auto fill = [&](const Voxel& seed, int number) {
      region[seed] = number;
      flood(seed, [&](const Voxel& v, const Voxel& w) {
        const bool is_inside = std::all_of(w.begin(), w.end(), [this](int x) { return x >= -1 && x <= n; });
        return is_inside && at(w) == at(v) && region.emplace(w, number).second;
      });
    };
    fill({-1, -1, -1}, 0);
    for (const auto& [v, k] : kind)
      if (!region.count(v)) fill(v, ++count);
    return region;
  }
  /// The squares between cubes of different kinds, each once, cut in two, looking to the lesser kind.
  Surface walls() const
  {
    Surface s;
    std::map<Voxel, std::size_t> number;
    const auto vertex = [&](const Voxel& v) {
      const auto [place, is_new] = number.emplace(v, s.points.size());
      if (is_new) s.points.emplace_back(v[0], v[1], v[2]);
      return place->second;
    };
    for (int x = -1; x <= n; ++x)
      for (int y = -1; y <= n; ++y)
        for (int z = -1; z <= n; ++z)
          for (std::size_t k = 0; k < 3; ++k) {
            const Voxel v = {x, y, z};
            Voxel w = v;
            ++w[k];
            if (at(v) == at(w)) continue;
            Voxel a = w, b = w, c = w, d = w;
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            ++b[i], ++c[i], ++c[j], ++d[j];
            if (at(v) < at(w)) std::swap(b, d);
            s.triangles.push_back({vertex(a), vertex(b), vertex(c)});
            s.triangles.push_back({vertex(a), vertex(c), vertex(d)});
          }
    return s;
  }
};

Grid random_grid(Random& random, int n, int kinds, double density)
{
  Grid grid{n, {}};
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        if (const int kind = chance(random, density) ? 1 + int(random() % unsigned(kinds)) : 0)
          grid.kind[{x, y, z}] = kind;
        else
          grid.kind[{x, y, z}] = 0;
  return grid;
}

/// The centers of cubes have the same subdomain exactly if they are in the same region.
void check_regions(const Complex& complex, const Grid& grid, const std::map<Voxel, int>& regions)
{
  const weft::Polyhedral_oracle_3<K> oracle(complex);
  std::map<int, int> subdomain;
  std::set<int> used;
  for (const auto& [v, region] : regions) {
    const int found = oracle.subdomain(Point(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5));
    const int expected = grid.at(v) == 0 ? 0 : region;
    CHECK((found == 0) == (expected == 0));
    const auto [at, is_new] = subdomain.emplace(expected, found);
    CHECK(at->second == found);
    if (is_new) CHECK(used.insert(found).second);
  }
}

} // namespace

TEST_CASE("unions of cubes that touch in edges and vertices: regions are what a flood fill finds")
{
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Grid grid = random_grid(random, 3 + int(seed % 2), 1, uniform(random, 0.2, 0.8));
    Surface s = grid.walls();
    if (is_accepted(s)) continue;
    check_regions(mended(s), grid, grid.regions());
  }
}

TEST_CASE(
    "cubes of several kinds: walls of any orientation become interfaces between the regions that a flood fill finds")
{
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Grid grid = random_grid(random, 3, 3, uniform(random, 0.5, 1));
    auto regions = grid.regions();
    for (auto& [v, kind] : grid.kind)
      if (kind == 0 && regions[v] != 0) kind = 4; // cavities would be subdomains or not by their orientation
    grid.kind[{1, 1, 1}] = grid.at({1, 1, 0}) == 0 ? 1 : grid.at({1, 1, 0}); // nothing lies inside without contact
    regions = grid.regions();
    Surface s = grid.walls();
    if (is_accepted(s)) continue;
    flip_facets(s, random, 0.5);
    cut_seams(s, random, seed % 2 ? 0.5 : 0, 0);
    const Complex complex = mended(s);
    check_regions(complex, grid, regions);
    double sum = 0; // of all subdomains
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
      const auto [behind, before] = complex.sides[std::size_t(complex.patches[t])];
      sum += (int(behind != 0) - int(before != 0)) *
             CGAL::determinant(complex.points[complex.triangles[t][0]] - CGAL::ORIGIN,
                               complex.points[complex.triangles[t][1]] - CGAL::ORIGIN,
                               complex.points[complex.triangles[t][2]] - CGAL::ORIGIN) /
             6;
    }
    CHECK(sum ==
          Approx(std::count_if(grid.kind.begin(), grid.kind.end(), [](const auto& c) { return c.second != 0; })));
  }
}

TEST_CASE("two cubes with a double wall are two subdomains, whichever way they are turned")
{
  for (unsigned turned = 0; turned < 4; ++turned) {
    INFO(turned);
    Surface a = cube(), b = moved(cube(), 1, 1, 0, 0);
    if (turned & 1) a = inside_out(a);
    if (turned & 2) b = inside_out(b);
    const Complex complex = mended(together(a, b));
    CHECK(complex.triangles.size() == 22);
    const weft::Polyhedral_oracle_3<K> oracle(complex);
    CHECK(oracle.subdomain(Point(0.4, 0.4, 0.4)) + oracle.subdomain(Point(1.4, 0.4, 0.4)) == 3);
    CHECK(oracle.subdomain(Point(2.4, 0.4, 0.4)) == 0);
  }
}

TEST_CASE("surfaces with several subdomains merge with others")
{
  Surface two = together(cube(), moved(cube(), 1, 1, 0, 0));
  const auto complex =
      weft::mended_complex_3(std::vector<Soup>{soup_of(two), soup_of(moved(cube(), 1, 2, 0, 0)), soup_of(cube())});
  const weft::Polyhedral_oracle_3<K> oracle(complex);
  CHECK(oracle.subdomain(Point(0.4, 0.4, 0.4)) == 4); // the last of those that have it
  CHECK(oracle.subdomain(Point(1.4, 0.4, 0.4)) == 2);
  CHECK(oracle.subdomain(Point(2.4, 0.4, 0.4)) == 3);
}

// ---- Facets that intersect

namespace {

/// A box [low, high) of cubes.
struct Block
{
  Voxel low, high;

  bool has(const Voxel& v) const
  {
    for (std::size_t k = 0; k < 3; ++k)
      if (v[k] < low[k] || v[k] >= high[k]) return false;
    return true;
  }
  Surface surface() const
  {
    Surface s = cube();
    for (Point& p : s.points) {
      std::array<double, 3> x = {p.x(), p.y(), p.z()};
      for (std::size_t k = 0; k < 3; ++k) x[k] = x[k] == 0 ? low[k] : high[k];
      p = Point(x[0], x[1], x[2]);
    }
    return s;
  }
};

Block random_block(Random& random, int n)
{
  Block block;
  for (std::size_t k = 0; k < 3; ++k) {
    block.low[k] = int(random() % unsigned(n));
    block.high[k] = block.low[k] + 1 + int(random() % unsigned(n - block.low[k]));
  }
  return block;
}

/// A random turn, rounded to single precision or not.
Surface turned(Surface s, Random& random, bool to_float)
{
  std::array<double, 3> angle;
  for (double& a : angle) a = uniform(random, 0, 6);
  for (Point& p : s.points) {
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    for (std::size_t k = 0; k < 3; ++k) {
      double &u = x[k], &v = x[(k + 1) % 3];
      const double c = std::cos(angle[k]), d = std::sin(angle[k]), w = c * u - d * v;
      v = d * u + c * v;
      u = w;
    }
    p = to_float ? Point(float(x[0]), float(x[1]), float(x[2])) : Point(x[0], x[1], x[2]);
  }
  return s;
}

/// The volume in front of no facet: that of all subdomains together.
double domain_volume(const Complex& complex)
{
  double sum = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    const auto [behind, before] =
        complex.sides.empty() ? std::make_pair(1, 0) : complex.sides[std::size_t(complex.patches[t])];
    const auto& [a, b, c] = complex.triangles[t];
    sum += (int(behind != 0) - int(before != 0)) *
           CGAL::determinant(complex.points[a] - CGAL::ORIGIN, complex.points[b] - CGAL::ORIGIN,
                             complex.points[c] - CGAL::ORIGIN) /
           6;
  }
  return sum;
}

} // namespace

TEST_CASE("boxes in one surface that overlap or touch are their union, also if they are turned")
{
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const int n = 4;
    std::vector<Block> blocks;
    Surface s;
    while (blocks.size() < 2 + seed % 3) {
      const Block block = random_block(random, n);
      // What lies in another block would be a cavity, if rounding keeps it from touching.
      const bool is_inside = std::any_of(blocks.begin(), blocks.end(), [&](const Block& other) {
        bool in = true, out = true;
        for (std::size_t k = 0; k < 3; ++k) {
          in = in && other.low[k] <= block.low[k] && block.high[k] <= other.high[k];
          out = out && block.low[k] <= other.low[k] && other.high[k] <= block.high[k];
        }
        return in || out;
      });
      if (is_inside) continue;
      blocks.push_back(block);
      s = together(s, random() % 2 ? block.surface() : inside_out(block.surface()));
    }
    double expected = 0;
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z)
          expected += std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.has({x, y, z}); });
    CHECK(domain_volume(mended(s)) == Approx(expected));
    // Faces in one plane aren't quite, when they are turned or in single precision.
    if (seed % 4 == 0) CHECK(domain_volume(mended(turned(s, random, false))) == Approx(expected));
    CHECK(domain_volume(mended(turned(s, random, true))) == Approx(expected).epsilon(1e-5));
  }
}

TEST_CASE("boxes in several surfaces that overlap or touch: the last counts")
{
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const int n = 4;
    std::vector<Block> blocks;
    std::vector<Soup> soups;
    for (unsigned i = 0; i < 2 + seed % 2; ++i) {
      blocks.push_back(random_block(random, n));
      soups.push_back(soup_of(blocks.back().surface()));
    }
    const weft::Polyhedral_oracle_3<K> oracle(weft::mended_complex_3(soups));
    for (int x = -1; x <= n; ++x)
      for (int y = -1; y <= n; ++y)
        for (int z = -1; z <= n; ++z) {
          int expected = 0;
          for (std::size_t i = 0; i < blocks.size(); ++i)
            if (blocks[i].has({x, y, z})) expected = int(i) + 1;
          CHECK(oracle.subdomain(Point(x + 0.5, y + 0.45, z + 0.55)) == expected);
        }
  }
}

TEST_CASE("balls that cross are united along a crease")
{
  for (const double distance : {0.3, 1.0, 1.5}) {
    const Surface a = sphere(3), b = moved(sphere(3), 1, distance, 0.01, 0.02);
    const Complex complex = mended(together(a, b));
    const double d = distance, lens = pi * (4 + d) * (2 - d) * (2 - d) / 12;
    CHECK(domain_volume(complex) == Approx(8 * pi / 3 - lens).epsilon(0.03));
    CHECK(complex.number_of_shells == 1);
    REQUIRE(complex.creases.size() == 1);
    CHECK(complex.creases[0].closed);
  }
}

// ---- Holes

TEST_CASE("holes are capped: random facets are taken out of random surfaces, volume and area are what they were")
{
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Surface clean = random_surface(random);
    Surface open = clean;
    double removed = 0;
    for (std::size_t n = 1 + random() % 4; n > 0; --n) {
      const std::size_t at = below(random, open.triangles.size());
      removed += area({open.points, {open.triangles[at]}});
      open.triangles.erase(open.triangles.begin() + long(at));
    }
    if (seed % 2) flip_facets(open, random, 0.5);
    const Complex complex = mended(open);
    INFO(all_changes(complex));
    check_is(complex, clean, removed / area(clean)); // across edges, caps may cut corners or fill notches
    CHECK(complex.mending.holes > 0);
    CHECK(complex.mending.area_of_caps <= removed * (1 + 1e-9));
    CHECK(contains(all_changes(complex), "capped"));
  }
}

TEST_CASE("a wide hole gets a flat cap, and a part of another one with a hole is united with it")
{
  Surface cup = sphere(3);
  const auto is_above = [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::size_t v) { return cup.points[v].z() > 0.5; });
  };
  cup.triangles.erase(std::remove_if(cup.triangles.begin(), cup.triangles.end(), is_above), cup.triangles.end());
  const Complex one = mended(cup);
  // A ball without a cap of height 1/2.
  CHECK(domain_volume(one) == Approx(4 * pi / 3 - pi * 0.25 * 2.5 / 3).epsilon(0.08));
  CHECK(one.mending.holes == 1);
  weft::Mend_options_3 less;
  less.most_capped = 0.1;
  CHECK(contains(refusal_of(cup, less), "caps of its holes would be"));
  const Complex both = mended(together(cup, moved(cube(), 0.5, 0.7, 0.1, 0.1)));
  CHECK(both.number_of_shells == 1);
  CHECK(domain_volume(both) > domain_volume(one) + 0.03);
}

// ---- Soups of parts

namespace {

/// The parts, whether points are in one of them, and how many pieces they are.
struct Parts
{
  Surface soup;
  std::vector<Surface> surfaces;
  int pieces = 0;
};

/// Boxes, balls and tubes in a row: each crosses the one before it or is apart from it.
Parts random_parts(Random& random)
{
  Parts parts;
  double end = 0;
  for (std::size_t n = 2 + random() % 3; n > 0; --n) {
    Surface s;
    switch (random() % 3) {
    case 0:
      s = moved(cube(), 1, -0.5, -0.5, -0.5);
      break;
    case 1:
      s = sphere(2);
      break;
    default:
      s = moved(cylinder(9 + random() % 8), 1, 0, 0, -0.5);
    }
    s = turned(moved(s, uniform(random, 0.8, 1.2), 0, 0, 0), random, false);
    CGAL::Bbox_3 box;
    for (const Point& p : s.points) box += p.bbox();
    const bool is_apart = parts.pieces == 0 || random() % 3 == 0;
    s = moved(s, 1, end - box.xmin() + (is_apart ? 0.3 : -0.4), uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
    parts.pieces += is_apart;
    end = 0;
    for (const Point& p : s.points) end = std::max(end, p.x());
    parts.surfaces.push_back(s);
    parts.soup = together(parts.soup, s);
  }
  return parts;
}

} // namespace

TEST_CASE("soups of random boxes, balls and tubes with dirt are their union: volume, pieces, and where points lie")
{
  for (unsigned seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Parts parts = random_parts(random);
    Surface dirty = parts.soup;
    std::shuffle(dirty.triangles.begin(), dirty.triangles.end(), random);
    add_duplicates(dirty, random, random() % 4);
    add_degenerate(dirty, random, random() % 3);
    if (seed % 3 == 0) dirty.triangles.erase(dirty.triangles.begin() + long(below(random, dirty.triangles.size())));
    if (seed % 2) flip_facets(dirty, random, 0.5);
    cut_seams(dirty, random, uniform(random, 0, 0.5), seed % 4 < 2 ? 1e-7 * diagonal(dirty) : 0);
    const Complex complex = mended(dirty);
    INFO(all_changes(complex));
    CHECK(complex.number_of_shells == parts.pieces);
    std::vector<weft::Polyhedral_oracle_3<K>> oracles;
    for (const Surface& s : parts.surfaces)
      oracles.emplace_back(weft::piecewise_smooth_complex(s.points, s.triangles, weft::Feature_options{}));
    const weft::Polyhedral_oracle_3<K> oracle(complex);
    CGAL::Bbox_3 box;
    for (const Point& p : parts.soup.points) box += p.bbox();
    int differ = 0, inside = 0;
    constexpr int samples = 2000;
    for (int i = 0; i < samples; ++i) {
      const Point p(uniform(random, box.xmin(), box.xmax()), uniform(random, box.ymin(), box.ymax()),
                    uniform(random, box.zmin(), box.zmax()));
      const bool is_in =
          std::any_of(oracles.begin(), oracles.end(), [&](const auto& o) { return o.subdomain(p) != 0; });
      inside += is_in;
      differ += is_in != (oracle.subdomain(p) != 0);
    }
    CHECK(differ <= (seed % 3 == 0 ? samples / 50 : 0)); // a missing facet of a tube is a strip that its cap cuts off
    CHECK(domain_volume(complex) == Approx(box.x_span() * box.y_span() * box.z_span() * inside / samples).epsilon(0.1));
  }
}

// ---- Groups of facets

namespace {

/// Surfaces as groups of one soup.
Soup grouped(const std::vector<Surface>& parts, const std::vector<std::string>& names, bool are_solids)
{
  Surface all;
  Soup soup;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all = together(all, parts[i]);
    soup.groups.resize(all.triangles.size(), i);
  }
  const Soup plain = soup_of(all);
  soup.points = plain.points;
  soup.polygons = plain.polygons;
  soup.group_names = names;
  soup.groups_are_solids = are_solids;
  return soup;
}

std::string name_of(const Complex& complex, int subdomain)
{
  const auto i = std::size_t(subdomain);
  return i > 0 && i <= complex.names.size() ? complex.names[i - 1] : "";
}

std::string name_at(const Complex& complex, double x, double y, double z)
{
  const weft::Polyhedral_oracle_3<K> oracle(complex);
  const int subdomain = oracle.subdomain(Point(x, y, z));
  return subdomain == 0 ? "outside" : name_of(complex, subdomain);
}

} // namespace

TEST_CASE("solids of one surface are subdomains with their names; the smaller has what two have in common")
{
  for (unsigned seed = 0; seed < 24; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const int n = 4;
    std::vector<Block> blocks;
    std::vector<Surface> parts;
    std::vector<std::string> names;
    for (unsigned i = 0; i < 2 + seed % 3; ++i) {
      blocks.push_back(random_block(random, n));
      parts.push_back(blocks.back().surface());
      names.push_back("block " + std::to_string(i));
    }
    Soup soup = grouped(parts, names, true);
    if (seed % 3 == 0) { // a hole
      const std::size_t at = below(random, soup.polygons.size());
      soup.polygons.erase(soup.polygons.begin() + long(at));
      soup.groups.erase(soup.groups.begin() + long(at));
    }
    const Complex complex = weft::mended_complex_3(soup);
    const weft::Polyhedral_oracle_3<K> oracle(complex);
    const auto size = [&](const Block& b) {
      return (b.high[0] - b.low[0]) * (b.high[1] - b.low[1]) * (b.high[2] - b.low[2]);
    };
    INFO(all_changes(complex));
    int differ = 0;
    for (int x = -1; x <= n; ++x)
      for (int y = -1; y <= n; ++y)
        for (int z = -1; z <= n; ++z) {
          std::size_t expected = blocks.size();
          for (std::size_t i = 0; i < blocks.size(); ++i)
            if (blocks[i].has({x, y, z}) && (expected == blocks.size() || size(blocks[i]) <= size(blocks[expected])))
              expected = i;
          const int subdomain = oracle.subdomain(Point(x + 0.5, y + 0.45, z + 0.55));
          differ += expected == blocks.size() ? subdomain != 0 : name_of(complex, subdomain) != names[expected];
        }
    CHECK(differ == 0);
  }
}

TEST_CASE("groups name the regions that they bound with walls in common")
{
  // Two cubes, of which only the first has the wall between them.
  const Surface left = cube();
  Surface right = moved(cube(), 1, 1, 0, 0);
  const auto is_wall = [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::size_t v) { return right.points[v].x() == 1; });
  };
  right.triangles.erase(std::remove_if(right.triangles.begin(), right.triangles.end(), is_wall), right.triangles.end());
  REQUIRE(right.triangles.size() + 2 == left.triangles.size());
  for (const bool are_solids : {false, true}) {
    const Complex complex = weft::mended_complex_3(grouped({left, right}, {"iron", "wood"}, are_solids));
    CHECK(name_at(complex, 0.5, 0.4, 0.3) == "iron");
    CHECK(name_at(complex, 1.5, 0.4, 0.3) == "wood");
    CHECK(domain_volume(complex) == Approx(2));
  }
}

TEST_CASE("groups that are parts of one boundary, or aren't solids and overlap, divide nothing")
{
  const Surface one = cube();
  Soup sides = soup_of(one);
  for (std::size_t f = 0; f < sides.polygons.size(); ++f) {
    sides.groups.push_back(f / 2);
    sides.group_names.push_back("side " + std::to_string(f));
  }
  const Complex box = weft::mended_complex_3(sides);
  CHECK(box.sides.empty());
  CHECK(box.names.empty());
  CHECK(box.changes.empty());
  const Complex both = weft::mended_complex_3(grouped({one, moved(cube(), 1, 0.5, 0.3, 0.2)}, {"red", "blue"}, false));
  CHECK(both.sides.empty());
  CHECK(both.names.empty());
  CHECK(domain_volume(both) == Approx(2 - 0.5 * 0.7 * 0.8));
}

TEST_CASE("a group within another is a subdomain, unless it is turned the other way: then it is a cavity")
{
  const Surface outer = sphere(2), inner = moved(sphere(1), 0.4, 0, 0, 0);
  const Complex filled = weft::mended_complex_3(grouped({inner, outer}, {"core", "hull"}, false));
  CHECK(name_at(filled, 0, 0, 0) == "core");
  CHECK(name_at(filled, 0.7, 0, 0) == "hull");
  CHECK(filled.mending.turned == 0);
  const Complex hollow = weft::mended_complex_3(grouped({inside_out(inner), outer}, {"core", "hull"}, false));
  CHECK(name_at(hollow, 0, 0, 0) == "outside");
  CHECK(domain_volume(hollow) == Approx(volume(outer) - volume(inner)));
}

TEST_CASE("groups of triangles name subdomains for users, who are told when groups don't fit")
{
  const Soup soup = grouped({cube(), moved(cube(), 1, 2, 0, 0)}, {"one", "two"}, false);
  weft::Triangle_domain_options_3 options;
  options.groups = soup.groups;
  options.group_names = soup.group_names;
  const auto domain = weft::domain_from_triangles(soup.points, soup.polygons, options);
  CHECK(domain.names() == std::vector<std::string>{"one", "two"});
  CHECK(domain.oracle->subdomain(Point(2.5, 0.5, 0.5)) == 2);
  options.group_names.pop_back();
  CHECK_THROWS_AS(weft::domain_from_triangles(soup.points, soup.polygons, options), weft::Option_error);
  options.groups.pop_back();
  CHECK_THROWS_AS(weft::domain_from_triangles(soup.points, soup.polygons, options), weft::Option_error);
}

TEST_CASE("names of several surfaces are those of their subdomains, and differ")
{
  std::vector<Soup> soups = {soup_of(cube()), soup_of(moved(cube(), 1, 1, 0, 0)), soup_of(moved(cube(), 1, 3, 0, 0))};
  for (Soup& soup : soups) soup.name = "part";
  const Complex complex = weft::mended_complex_3(soups);
  CHECK(complex.names == std::vector<std::string>{"part", "part 2", "part 3"});
  CHECK(name_at(complex, 1.5, 0.5, 0.5) == "part 2");
}

TEST_CASE("readers keep solids, objects, groups, materials and colours apart")
{
  using Names = std::vector<std::string>;
  using Groups = std::vector<std::size_t>;
  const auto read = [](const std::string& extension, const std::string& text) {
    const std::string name =
        (std::filesystem::temp_directory_path() / ("weft_mend_surface_test_groups." + extension)).string();
    std::ofstream(name) << text;
    const Soup soup = weft::IO::read_surface<K>(name);
    std::remove(name.c_str());
    return soup;
  };
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const Soup stl = read("stl", "solid a bolt \n" + facet + facet + "endsolid a bolt\nsolid\n" + facet + "endsolid\n");
  CHECK(stl.group_names == Names{"a bolt", ""});
  CHECK(stl.groups == Groups{0, 0, 1});
  CHECK(stl.groups_are_solids);
  CHECK(read("stl", "solid a\n" + facet + "endsolid a\n").groups.empty());

  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const Soup objects = read("obj", points + "o x\ng p\nusemtl m\nf 1 2 3\no y\nf 1 2 3\no x\nf 1 2 3\n");
  CHECK(objects.group_names == Names{"x", "y"});
  CHECK(objects.groups == Groups{0, 1, 0});
  CHECK(!objects.groups_are_solids);
  const Soup materials = read("obj", points + "o x\nf 1 2 3\nusemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n");
  CHECK(materials.group_names == Names{"", "m", "n"});
  CHECK(read("obj", points + "o x\nf 1 2 3\n").groups.empty());

  const std::string off = "3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 128 0\n3 0 1 2 1.0 0.5 0.0 1.0\n3 0 1 2\n";
  const Soup colours = read("off", "OFF\n" + off);
  CHECK(colours.group_names == Names{"#ff8000", ""});
  CHECK(colours.groups == Groups{0, 0, 1});
  CHECK(read("off", "OFF" + off).polygons.size() == 3); // no blank behind the keyword

  const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\nelement face 2\nproperty list uchar int vertex_indices\n";
  const std::string corners = "end_header\n0 0 0\n1 0 0\n0 1 0\n";
  const Soup ply = read("ply", header + "property uchar red\nproperty uchar green\nproperty uchar blue\n" + corners +
                                   "3 0 1 2 255 0 0\n3 0 1 2 0 0 255\n");
  CHECK(ply.group_names == Names{"#ff0000", "#0000ff"});
  CHECK(ply.groups == Groups{0, 1});
  // More than the header tells, on the same lines.
  const Soup surplus = read("ply", header + corners + "3 0 1 2 9 1 1 1\n3 0 1 2 9 1 1 1\n");
  CHECK(surplus.polygons == std::vector<std::vector<std::size_t>>{{0, 1, 2}, {0, 1, 2}});
  CHECK_THROWS_AS(read("ply", header + corners + "3 0 1 2\n3 0 1 2\n3 0 1 2\n"), weft::File_error);
}

// ---- For users

TEST_CASE("triangles become a domain with a record of what was done")
{
  Random random(1);
  const Surface clean = cube();
  const auto plain = weft::domain_from_triangles(clean.points, clean.triangles);
  CHECK(plain.changes().empty());
  CHECK(plain.oracle->subdomain(Point(0.5, 0.5, 0.5)) == 1);
  Surface dirty = clean;
  dirty.triangles.erase(dirty.triangles.begin());
  add_duplicates(dirty, random, 2);
  const double fins = add_fins(dirty, random, 2);
  cut_seams(dirty, random, 1, 0);
  std::vector<std::vector<int>> polygons;
  for (const auto& [a, b, c] : dirty.triangles) polygons.push_back({int(a), int(b), int(c)});
  const auto domain = weft::domain_from_triangles(dirty.points, polygons);
  CHECK(domain.oracle->subdomain(Point(0.5, 0.5, 0.5)) == 1);
  CHECK(domain.record().duplicate == 2);
  CHECK(domain.record().holes == 1);
  CHECK(domain.record().left_out == 2);
  CHECK(domain.record().area_left_out == Approx(fins));
  CHECK(domain.record().equal_points > 0);
  CHECK(domain.changes() == domain.record().lines());
  CHECK(domain.complex().left_out.size() == 2);
  const auto two =
      weft::domain_from_triangles(std::vector<Soup>{soup_of(clean), soup_of(moved(clean, 1, 0.5, 0.2, 0.3))});
  CHECK(two.oracle->subdomain(Point(0.25, 0.5, 0.5)) == 1);
  CHECK(two.oracle->subdomain(Point(0.75, 0.5, 0.5)) == 2);
  CHECK(two.record().cut > 0);
  CHECK_THROWS_AS(weft::domain_from_triangles(clean.points, std::vector<Triangle>{{0, 1, 2}}), weft::Domain_error);
}

TEST_CASE("mending ends when its caller doesn't want to go on, whenever that is")
{
  const Surface s = together(sphere(2), moved(sphere(2), 1, 0.5, 0, 0));
  weft::Mend_options_3 options;
  std::size_t asked = 0;
  options.go_on = [&](const char*) { return ++asked > 0; };
  mended(s, options);
  const std::size_t all = asked;
  REQUIRE(all > 100);
  for (std::size_t last = 1; last <= all; last += 1 + all / 10) {
    asked = 0;
    options.go_on = [&](const char* doing) { return std::string(doing) != "" && ++asked < last; };
    CHECK_THROWS_AS(mended(s, options), weft::Stopped_error);
    CHECK(asked == last);
  }
}

TEST_CASE("what a mesh lacks of the surface as given is found by area")
{
  Surface given = together(cube(), moved(cube(), 1, 0.5, 0.5, 0.5));
  given.points.insert(given.points.end(), {{3, 0, 0}, {3.1, 0, 0}, {3, 0.1, 0}});
  const std::size_t n = given.points.size();
  given.triangles.push_back({n - 3, n - 2, n - 1});
  const Complex complex = mended(given);
  weft::Tetrahedral_mesh_3<K> mesh;
  mesh.points = complex.points;
  for (const auto& t : complex.triangles) mesh.facets.push_back(t);
  const auto whole = weft::compare_with_given_3<K>({soup_of(given)}, complex, mesh, 1e-3);
  CHECK(whole.is_known);
  CHECK(whole.area == Approx(12.005));
  CHECK(whole.missed_area == 0);
  CHECK(whole.area_left_out == Approx(0.005));
  CHECK(whole.ok());
  const double removed = area({mesh.points, {mesh.facets.back()}});
  mesh.facets.pop_back();
  const auto less = weft::compare_with_given_3<K>({soup_of(given)}, complex, mesh, 1e-3);
  CHECK(less.missed_area == Approx(removed).epsilon(0.05));
  CHECK(less.ok() == (removed <= 0.005 * 12.005));
  CHECK(less.largest_distance > 1e-3);
}

// ---- What can't be mended

TEST_CASE("what has no inside or has a hole is refused with the reason")
{
  Surface sheet = cube();
  sheet.triangles.resize(2);
  CHECK(contains(refusal_of(sheet), "a sheet: give it a thickness"));
  Surface open = cube();
  open.triangles.pop_back();
  weft::Mend_options_3 uncapped;
  uncapped.most_capped = 0;
  CHECK(contains(refusal_of(open, uncapped), "hole"));
  CHECK(contains(refusal_of(together(cube(), moved(open, 1, 0.5, 0.5, 0.5)), uncapped), "hole"));
  // A body with a hole isn't taken for a fin of another.
  CHECK(contains(refusal_of(together(moved(cube(), 10, 5, 0, 0), open), uncapped), "hole"));
  // Three of six faces: half of the area would be caps.
  Surface half = cube();
  half.triangles.erase(half.triangles.begin() + 4, half.triangles.end());
  CHECK(!refusal_of(half).empty());
  // A sheet beside a small body is too much to be left out.
  CHECK(contains(refusal_of(together(cube(), moved(sheet, 3, 5, 0, 0))), "give them a thickness"));
  CHECK(!refusal_of(Surface{}).empty());
  CHECK(!refusal_of(Surface{cube().points, {{0, 1, 99}}}).empty());
  Surface not_finite = cube();
  not_finite.points[0] = Point(std::nan(""), 0, 0);
  CHECK(!refusal_of(not_finite).empty());
}

TEST_CASE("given sharp edges and tips follow their points")
{
  Surface s = cone(12, 2);
  const std::size_t tip = 13;
  Random random(3);
  flip_facets(s, random, 0.5);
  cut_seams(s, random, 1, 0);
  weft::Feature_options options;
  options.tips_and_cusps = {s.triangles[1][0]}; // a copy of one of its points
  options.sharp_edges = {{s.triangles[1][0], s.triangles[1][1]}};
  const Point given = s.points[s.triangles[1][0]];
  const Complex complex = weft::mended_complex_3(soup_of(s), options);
  bool is_there = false;
  for (const auto& feature : complex.features) is_there = is_there || complex.points[feature.vertex] == given;
  CHECK(is_there);
  CHECK(!contains(all_changes(complex), "lost"));
  CHECK(complex.points.size() == tip + 1);
}
