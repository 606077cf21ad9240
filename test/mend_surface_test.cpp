// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of mending surfaces: closed surfaces with random dirt become what they were, regions of random grids of
// cubes are what a flood fill finds, and what has no inside is refused. Cases are made from seeds, which are in the
// message when one fails.

#include "fixtures/surfaces_3.h"

#include <weft/spatial/surface/mended_complex_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

/// A turn by angles that are far from any axis.
Surface turned(Surface s)
{
  for (Point& p : s.points) {
    const double x = 0.8 * p.x() - 0.6 * p.y(), y = 0.6 * p.x() + 0.8 * p.y(), c = std::cos(1.0), d = std::sin(1.0);
    p = Point(x, c * y - d * p.z(), d * y + c * p.z());
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

TEST_CASE("boxes in one surface that overlap or touch are their union, or refused if they are turned")
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
    // Faces in one plane aren't quite, when they are turned: that may be refused, but never loses a part.
    const Surface oblique = turned(s);
    if (refusal_of(oblique).empty()) CHECK(domain_volume(mended(oblique)) == Approx(expected));
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

// ---- What can't be mended

TEST_CASE("what has no inside or has a hole is refused with the reason")
{
  Surface sheet = cube();
  sheet.triangles.resize(2);
  CHECK(contains(refusal_of(sheet), "a sheet: give it a thickness"));
  Surface open = cube();
  open.triangles.pop_back();
  CHECK(contains(refusal_of(open), "hole"));
  CHECK(contains(refusal_of(together(cube(), moved(open, 1, 0.5, 0.5, 0.5))), "hole"));
  // A body with a hole isn't taken for a fin of another.
  CHECK(contains(refusal_of(together(moved(cube(), 10, 5, 0, 0), open)), "hole"));
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
