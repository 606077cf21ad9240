// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of reading surfaces and of deriving piecewise smooth complexes from them: creases, patches, shells and
// feature vertices agree with brute force; whatever doesn't qualify is refused with the right elements named.

#include "fixtures/surfaces_3.h"

#include <weft/IO/read_surface.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <catch2/catch.hpp>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>
#include <string>

namespace {

using namespace surfaces;
using Complex = weft::Piecewise_smooth_complex_3<K>;
using Soup = weft::Polygon_soup_3<K>;
using Kind = weft::Feature_kind;
using Indices = std::vector<std::size_t>;
using Edge = std::pair<std::size_t, std::size_t>;

Complex complex_of(const Surface& s, const weft::Feature_options& options = {})
{
  return weft::piecewise_smooth_complex(s.points, s.triangles, options);
}

Soup soup_of(const Surface& s)
{
  Soup soup{s.points, {}};
  for (const auto& t : s.triangles) soup.polygons.emplace_back(t.begin(), t.end());
  return soup;
}

/// What the refusal of a surface says and names.
struct Refusal
{
  std::string what;
  Indices vertices, facets;
};

/// The refusal; fails if there is none. Everything named must exist, in order, once, and the text be one line.
Refusal refusal_of(const Surface& s, const weft::Feature_options& options = {})
{
  try {
    complex_of(s, options);
  } catch (const weft::Domain_error& error) {
    const Refusal refusal{error.what(), error.vertices(), error.elements()};
    CHECK(!refusal.what.empty());
    CHECK(refusal.what.find('\n') == std::string::npos);
    CHECK(refusal.what.size() < 300);
    for (const Indices* list : {&refusal.vertices, &refusal.facets}) {
      const auto disorder = std::adjacent_find(list->begin(), list->end(), [](auto a, auto b) { return a >= b; });
      CHECK(disorder == list->end());
    }
    if (!refusal.vertices.empty()) CHECK(refusal.vertices.back() < s.points.size());
    if (!refusal.facets.empty()) CHECK(refusal.facets.back() < s.triangles.size());
    return refusal;
  }
  FAIL("the surface was accepted");
  return {};
}

bool says(const Refusal& refusal, const std::string& text)
{
  return refusal.what.find(text) != std::string::npos;
}

std::size_t count_kind(const Complex& complex, Kind kind)
{
  return static_cast<std::size_t>(std::count_if(complex.features.begin(), complex.features.end(),
                                                [kind](const auto& feature) { return feature.kind == kind; }));
}

std::size_t count_cycles(const Complex& complex)
{
  return static_cast<std::size_t>(
      std::count_if(complex.creases.begin(), complex.creases.end(), [](const auto& crease) { return crease.closed; }));
}

// ---- Brute force

Edge edge_of(std::size_t a, std::size_t b)
{
  return std::minmax(a, b);
}

/// The triangles at every edge of a complex.
std::map<Edge, Indices> edges_of(const Complex& complex)
{
  std::map<Edge, Indices> edges;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      edges[edge_of(complex.triangles[t][i], complex.triangles[t][(i + 1) % 3])].push_back(t);
  return edges;
}

/// Sharp edges by CGAL's dihedral angles.
std::set<Edge> sharp_edges_of(const Complex& complex, double angle)
{
  std::set<Edge> sharp;
  for (const auto& [edge, triangles] : edges_of(complex)) {
    REQUIRE(triangles.size() == 2);
    std::array<Point, 2> apex;
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::size_t v : complex.triangles[triangles[side]])
        if (v != edge.first && v != edge.second) apex[side] = complex.points[v];
    const double dihedral =
        CGAL::approximate_dihedral_angle(complex.points[edge.first], complex.points[edge.second], apex[0], apex[1]);
    if (180 - std::abs(dihedral) >= angle - 1e-6) sharp.insert(edge);
  }
  return sharp;
}

/// Components of triangles by repeated relabelling, numbered by their first triangle.
std::vector<int> components(const Complex& complex, const std::set<Edge>& walls)
{
  std::vector<std::size_t> label(complex.triangles.size());
  std::iota(label.begin(), label.end(), std::size_t(0));
  const auto edges = edges_of(complex);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, t] : edges) {
      if (walls.count(edge) || label[t[0]] == label[t[1]]) continue;
      label[t[0]] = label[t[1]] = std::min(label[t[0]], label[t[1]]);
      changed = true;
    }
  }
  std::map<std::size_t, int> number;
  std::vector<int> result;
  for (const std::size_t l : label) result.push_back(number.emplace(l, int(number.size())).first->second);
  return result;
}

/// Creases cover the sharp edges once each, end in feature vertices and pass none; features have the kind that the
/// number of their sharp edges says; patches and shells are the components; the volume lies behind the facets.
void check_complex(const Complex& complex, const std::set<Edge>& sharp)
{
  std::map<std::size_t, std::size_t> degree;
  for (const auto& [a, b] : sharp) ++degree[a], ++degree[b];
  std::map<std::size_t, Kind> kinds;
  for (const auto& feature : complex.features) {
    CHECK((kinds.empty() || kinds.rbegin()->first < feature.vertex));
    kinds[feature.vertex] = feature.kind;
    const std::size_t d = degree.count(feature.vertex) ? degree[feature.vertex] : 0;
    CHECK(feature.kind == (d == 0 ? Kind::tip : d == 1 ? Kind::dart : d == 2 ? Kind::cusp : Kind::corner));
  }
  for (const auto& [v, d] : degree)
    if (d != 2) CHECK(kinds.count(v) == 1);

  std::multiset<Edge> covered;
  for (std::size_t c = 0; c < complex.creases.size(); ++c) {
    const auto& chain = complex.creases[c].vertices;
    const bool closed = complex.creases[c].closed;
    REQUIRE(chain.size() >= (closed ? 3u : 2u));
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) covered.insert(edge_of(chain[i], chain[i + 1]));
    if (closed) covered.insert(edge_of(chain.back(), chain.front()));
    for (std::size_t i = 0; i < chain.size(); ++i)
      CHECK(kinds.count(chain[i]) == (!closed && (i == 0 || i + 1 == chain.size())));
    if (closed) CHECK(chain.front() == *std::min_element(chain.begin(), chain.end()));
    if (!closed) CHECK(chain.front() <= chain.back());
    if (closed || chain.front() == chain.back()) CHECK(chain[1] < chain[chain.size() - (closed ? 1 : 2)]);
    if (c > 0) CHECK(complex.creases[c - 1].vertices < chain);
  }
  CHECK(covered == std::multiset<Edge>(sharp.begin(), sharp.end()));

  CHECK(complex.patches == components(complex, sharp));
  CHECK(complex.number_of_patches == 1 + *std::max_element(complex.patches.begin(), complex.patches.end()));
  CHECK(complex.shells == components(complex, {}));
  CHECK(complex.number_of_shells == 1 + *std::max_element(complex.shells.begin(), complex.shells.end()));
  CHECK(volume(complex.points, complex.triangles) > 0);
}

struct Expected
{
  const char* name;
  Surface surface;
  int patches, shells;
  std::size_t creases, cycles, corners;
};

std::vector<Expected> good_surfaces()
{
  return {{"cube", cube(), 6, 1, 12, 0, 8},
          {"box with many facets in a plane", box(3, 2, 4), 6, 1, 12, 0, 8},
          {"tetrahedron", tetrahedron(), 4, 1, 6, 0, 4},
          {"L", l_shape(), 8, 1, 18, 0, 12},
          {"cube with a hole", cube_with_hole(), 10, 1, 24, 0, 16},
          {"needles of aspect 1e6", needle_cube(), 6, 1, 12, 0, 8},
          {"needles of aspect 1e12", needle_cube(1e-12), 6, 1, 12, 0, 8},
          {"wedge of 70 degrees", wedge(70), 5, 1, 9, 0, 6},
          {"wedge of 47 degrees", wedge(47), 5, 1, 9, 0, 6},
          {"wedge of 20 degrees", wedge(20), 5, 1, 9, 0, 6},
          {"wedge of 5 degrees", wedge(5), 5, 1, 9, 0, 6},
          {"sphere", sphere(2), 1, 1, 0, 0, 0},
          {"nested spheres", nested_spheres({0.6, 0.3}, 2), 3, 3, 0, 0, 0},
          {"torus", torus(24, 12), 1, 1, 0, 0, 0},
          {"cylinder", cylinder(40), 3, 1, 2, 2, 0},
          {"cone", cone(40, 1), 2, 1, 1, 1, 0},
          {"far from the origin", moved(l_shape(), 1, 1e6, -1e6, 1e6), 8, 1, 18, 0, 12},
          {"tiny", moved(l_shape(), 1e-150, 0, 0, 0), 8, 1, 18, 0, 12},
          {"a tiny component beside a large one", together(sphere(2), moved(cube(), 1e-6, 3, 0, 0)), 7, 2, 12, 0, 8}};
}

bool is_tiny(const Surface& s)
{
  return std::abs(s.points[1].x()) < 1e-100 && std::abs(s.points[1].y()) < 1e-100;
}

// ---- Files

struct Temporary_file
{
  Temporary_file(const std::string& extension, const std::string& bytes) : name("surface_test_tmp." + extension)
  {
    std::ofstream(name, std::ios::binary) << bytes;
  }
  ~Temporary_file() { std::remove(name.c_str()); }
  std::string name;
};

std::string off_text(const Surface& s)
{
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n# a comment\n" << s.points.size() << ' ' << s.triangles.size() << " 0\n";
  for (const Point& p : s.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& t : s.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

std::string obj_text(const Surface& s)
{
  std::ostringstream out;
  out.precision(17);
  out << "o thing\n";
  for (const Point& p : s.points) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& t : s.triangles)
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << "/1 " << static_cast<long>(t[2]) - long(s.points.size()) << "//2\n";
  return out.str();
}

std::string stl_text(const Surface& s)
{
  std::ostringstream out;
  out.precision(17);
  out << "solid thing\n";
  for (const auto& t : s.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const std::size_t v : t)
      out << "vertex " << s.points[v].x() << ' ' << s.points[v].y() << ' ' << s.points[v].z() << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid thing\n";
  return out.str();
}

template <class Number>
void append(std::string& bytes, Number number)
{
  char buffer[sizeof number];
  std::memcpy(buffer, &number, sizeof number); // the machines that run this are little-endian
  bytes.append(buffer, sizeof number);
}

std::string stl_bytes(const Surface& s)
{
  std::string bytes = "solid by name, binary by nature";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(s.triangles.size()));
  for (const auto& t : s.triangles) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.f);
    for (const std::size_t v : t)
      for (int i = 0; i < 3; ++i) append(bytes, static_cast<float>(s.points[v][i]));
    append(bytes, std::uint16_t(0));
  }
  return bytes;
}

/// Appends the bytes of a number in the other order.
template <class Number>
void append_reversed(std::string& bytes, Number number)
{
  append(bytes, number);
  std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(sizeof number), bytes.end());
}

std::string ply_header(const Surface& s, const char* format)
{
  return std::string("ply\nformat ") + format + " 1.0\nelement vertex " + std::to_string(s.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(s.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string ply_text(const Surface& s)
{
  std::ostringstream out;
  out.precision(17);
  out << ply_header(s, "ascii");
  for (const Point& p : s.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& t : s.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

std::string ply_bytes(const Surface& s)
{
  std::string bytes = ply_header(s, "binary_little_endian");
  for (const Point& p : s.points)
    for (int i = 0; i < 3; ++i) append(bytes, p[i]);
  for (const auto& t : s.triangles) {
    append(bytes, std::uint8_t(3));
    for (const std::size_t v : t) append(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

/// Big-endian, single precision, with colours, another list before the corners and an element of edges.
std::string ply_bytes_with_extras(const Surface& s)
{
  std::string bytes = "ply\r\nformat binary_big_endian 1.0\r\ncomment hello\r\nelement vertex " +
                      std::to_string(s.points.size()) +
                      "\r\nproperty uchar red\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
                      "element edge 2\r\nproperty int vertex1\r\nproperty list uchar short stuff\r\nelement face " +
                      std::to_string(s.triangles.size()) +
                      "\r\nproperty list ushort double weights\r\nproperty list uchar uint vertex_index\r\n"
                      "property float quality\r\nend_header\r\n";
  for (const Point& p : s.points) {
    append(bytes, std::uint8_t(200));
    for (int i = 0; i < 3; ++i) append_reversed(bytes, static_cast<float>(p[i]));
  }
  for (int edge = 0; edge < 2; ++edge) {
    append_reversed(bytes, std::int32_t(-1));
    append(bytes, std::uint8_t(edge));
    for (int i = 0; i < edge; ++i) append_reversed(bytes, std::int16_t(i));
  }
  for (const auto& t : s.triangles) {
    append_reversed(bytes, std::uint16_t(1));
    append_reversed(bytes, 0.5);
    append(bytes, std::uint8_t(3));
    for (const std::size_t v : t) append_reversed(bytes, static_cast<std::uint32_t>(v));
    append_reversed(bytes, 1.f);
  }
  return bytes;
}

struct Format
{
  const char* extension;
  std::string (*write)(const Surface&);
};
const Format formats[] = {{"off", off_text},
                          {"obj", obj_text},
                          {"stl", stl_text},
                          {"stl", stl_bytes},
                          {"ply", ply_text},
                          {"ply", ply_bytes},
                          {"ply", ply_bytes_with_extras}};

std::string message_of_reading(const std::string& extension, const std::string& bytes)
{
  const Temporary_file file(extension, bytes);
  try {
    weft::IO::read_surface<K>(file.name);
  } catch (const weft::File_error& error) {
    return error.what();
  }
  return {};
}

double diagonal(const Surface& s)
{
  CGAL::Bbox_3 box;
  for (const Point& p : s.points) box += p.bbox();
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

void insert_edges(const Complex::Crease& crease, std::set<Edge>& edges)
{
  const auto& v = crease.vertices;
  for (std::size_t i = crease.closed ? 0 : 1; i < v.size(); ++i)
    edges.insert(edge_of(v[i == 0 ? v.size() - 1 : i - 1], v[i]));
}

double length(const Complex& complex, const Complex::Crease& crease)
{
  std::set<Edge> edges;
  insert_edges(crease, edges);
  double sum = 0;
  for (const auto& [a, b] : edges)
    sum += std::sqrt(CGAL::to_double(CGAL::squared_distance(complex.points[a], complex.points[b])));
  return sum;
}

/// The edges left when those with an end of their own are taken away again and again.
std::set<Edge> edges_on_cycles(std::set<Edge> edges)
{
  for (std::size_t before = 0; before != edges.size();) {
    before = edges.size();
    std::map<std::size_t, int> degree;
    for (const auto& [a, b] : edges) ++degree[a], ++degree[b];
    for (auto at = edges.begin(); at != edges.end();)
      at = degree[at->first] == 1 || degree[at->second] == 1 ? edges.erase(at) : std::next(at);
  }
  return edges;
}

} // namespace

// ---- Good surfaces

TEST_CASE("creases, patches, shells and features are those of brute force")
{
  for (const Expected& expected : good_surfaces()) {
    INFO(expected.name);
    const Complex complex = complex_of(expected.surface);
    CHECK(complex.points == expected.surface.points);
    CHECK(complex.triangles == expected.surface.triangles);
    CHECK(complex.number_of_patches == expected.patches);
    CHECK(complex.number_of_shells == expected.shells);
    CHECK(complex.creases.size() == expected.creases);
    CHECK(count_cycles(complex) == expected.cycles);
    CHECK(complex.features.size() == expected.corners);
    CHECK(count_kind(complex, Kind::corner) == expected.corners);
    CHECK(complex.changes.empty());
    // CGAL's angles leave the range where coordinates are tiny, and so do volumes.
    if (!is_tiny(expected.surface)) check_complex(complex, sharp_edges_of(complex, 60));
  }
}

TEST_CASE("random surfaces with random sharp edges agree with brute force")
{
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    std::set<Voxel> cubes;
    for (int i = 0; i < 12; ++i) cubes.insert({int(random() % 3), int(random() % 3), int(random() % 3)});
    Surface s = round % 2 ? torus(9, 7) : voxels(cubes);
    weft::Feature_options options(round % 3 == 0 ? 0 : 30 + double(random() % 90));
    options.cusp_angle = 0;
    options.least_open_crease = 0;
    Complex plain;
    try {
      plain = complex_of(s, 0);
    } catch (const weft::Domain_error&) {
      continue; // the cubes touch in a vertex or an edge
    }
    std::set<Edge> given;
    const auto edges = edges_of(plain);
    for (const auto& [edge, triangles] : edges)
      if (random() % 6 == 0) {
        given.insert(edge);
        options.sharp_edges.push_back({edge.second, edge.first});
      }
    std::set<Edge> sharp = options.sharp_angle > 0 ? sharp_edges_of(plain, options.sharp_angle) : std::set<Edge>();
    sharp.insert(given.begin(), given.end());
    const Complex complex = complex_of(s, options);
    check_complex(complex, sharp);
    CHECK(count_kind(complex, Kind::cusp) == 0);
  }
}

TEST_CASE("short creases found by angle that end nowhere are dropped, and nothing else is")
{
  std::mt19937 random(5);
  std::size_t dropped = 0, kept = 0;
  for (int round = 0; round < 30; ++round) {
    Surface s = sphere(2);
    for (Point& p : s.points) {
      const double r = 1 + 0.15 * double(random() % 1000) / 1000;
      p = Point(r * p.x(), r * p.y(), r * p.z());
    }
    weft::Feature_options options(35);
    options.cusp_angle = 0;
    options.least_open_crease = 0;
    const Complex all = complex_of(s, options);
    for (const auto& crease : all.creases) // some of them given
      if (random() % 5 == 0) options.sharp_edges.push_back({crease.vertices[0], crease.vertices[1]});
    options.least_open_crease = 0.3; // of the diagonal of a ball of diameter 2 to 2.3
    const double least = options.least_open_crease * diagonal(s);
    const Complex complex = complex_of(s, options);

    std::set<Edge> before, after;
    for (const auto& crease : all.creases) insert_edges(crease, before);
    std::map<std::size_t, int> degree;
    for (const auto& crease : complex.creases) insert_edges(crease, after);
    for (const auto& [a, b] : after) ++degree[a], ++degree[b];
    CHECK(std::includes(before.begin(), before.end(), after.begin(), after.end()));
    for (const auto& [a, b] : options.sharp_edges) CHECK(after.count(edge_of(a, b)) == 1);
    check_complex(complex, after);
    for (const auto& crease : complex.creases) {
      const bool open = degree[crease.vertices.front()] == 1 || degree[crease.vertices.back()] == 1;
      CHECK((!open || crease.given || length(complex, crease) >= least));
    }
    for (const Edge& edge : edges_on_cycles(before)) CHECK(after.count(edge) == 1);
    dropped += before.size() - after.size();
    kept += after.size();
  }
  CHECK(dropped > 100);
  CHECK(kept > 100);
}

TEST_CASE("the angle between normals decides which edges are sharp, the bound included")
{
  CHECK(complex_of(cube(), 90).creases.size() == 12);
  CHECK(complex_of(cube(), 90.001).creases.empty());
  CHECK(complex_of(cube(), 0).creases.empty());
  CHECK(complex_of(cube(), 180).creases.empty());
  CHECK(complex_of(wedge(70), 115).creases.size() == 2); // 110 degrees at the edge, 125 at the two others
  CHECK(complex_of(wedge(70), 109.999).creases.size() == 3);
}

TEST_CASE("darts, cusps, loops and tips")
{
  SECTION("a crease that ends has darts at its ends")
  {
    const Triangle t = sphere(0).triangles[0];
    weft::Feature_options options(0);
    options.sharp_edges = {{t[0], t[1]}};
    const Complex darts = complex_of(sphere(0), options);
    CHECK(count_kind(darts, Kind::dart) == 2);
    CHECK(darts.creases.size() == 1);
    CHECK(darts.number_of_patches == 1);
    check_complex(darts, {edge_of(t[0], t[1])});
  }
  SECTION("a rim that turns by more than the bound has cusps")
  {
    const auto cusps = [](std::size_t sides, double cusp_angle) {
      weft::Feature_options o(60);
      o.cusp_angle = cusp_angle;
      return count_kind(complex_of(cone(sides, 0.1), o), Kind::cusp);
    };
    // Flat cones: the rim alone is sharp.
    CHECK(cusps(4, 60) == 4);
    CHECK(cusps(6, 60) == 0);
    CHECK(cusps(6, 59) == 6);
    CHECK(cusps(4, 0) == 0);
    CHECK(cusps(4, 180) == 0);
  }
  SECTION("one given cusp turns a cycle into a crease from the cusp to itself")
  {
    weft::Feature_options o(60);
    o.tips_and_cusps = {7, 21}; // on the rim; the tip
    const Complex complex = complex_of(cone(20, 1), o);
    REQUIRE(complex.features.size() == 2);
    CHECK(complex.features[0].vertex == 7);
    CHECK(complex.features[0].kind == Kind::cusp);
    CHECK(complex.features[1].vertex == 21);
    CHECK(complex.features[1].kind == Kind::tip);
    REQUIRE(complex.creases.size() == 1);
    CHECK(!complex.creases[0].closed);
    CHECK(complex.creases[0].vertices.size() == 21);
    CHECK(complex.creases[0].vertices.front() == 7);
    CHECK(complex.creases[0].vertices.back() == 7);
    CHECK(complex.creases[0].vertices[1] == 6);
  }
}

TEST_CASE("given edges and vertices that don't exist are named")
{
  weft::Feature_options options(0);
  options.sharp_edges = {{0, 7}, {0, 1}, {9, 0}};
  try {
    complex_of(cube(), options);
    FAIL("accepted");
  } catch (const weft::Domain_error& error) {
    CHECK(std::string(error.what()).find("no edge") != std::string::npos);
    CHECK(error.vertices().front() == 0);
    CHECK(error.vertices().back() == 9);
  }
  options.sharp_edges.clear();
  options.tips_and_cusps = {3, 8, 1000};
  try {
    complex_of(cube(), options);
    FAIL("accepted");
  } catch (const weft::Domain_error& error) {
    CHECK(error.vertices() == Indices{8, 1000});
  }
  for (const double bad : {-1., 181., std::nan("")}) CHECK_THROWS_AS(complex_of(cube(), bad), weft::Option_error);
}

TEST_CASE("points that no facet uses are left out, in order")
{
  Surface s = l_shape();
  s.points.insert(s.points.begin() + 5, Point(100, 100, 100));
  for (auto& t : s.triangles)
    for (std::size_t& v : t) v += v >= 5;
  s.points.emplace_back(-7, 0, 0);
  const Complex complex = complex_of(s), expected = complex_of(l_shape());
  CHECK(complex.points == expected.points);
  CHECK(complex.triangles == expected.triangles);
  check_complex(complex, sharp_edges_of(complex, 60));
}

TEST_CASE("meshes, soups and arrays give the same complex")
{
  const Surface s = together(l_shape(), moved(sphere(1), 1, 5, 0, 0));
  const Complex expected = complex_of(s);
  const auto same = [&](const Complex& complex) {
    CHECK(complex.points == expected.points);
    CHECK(complex.triangles.size() == expected.triangles.size());
    CHECK(complex.patches == expected.patches);
    REQUIRE(complex.creases.size() == expected.creases.size());
    for (std::size_t c = 0; c < complex.creases.size(); ++c)
      CHECK(complex.creases[c].vertices == expected.creases[c].vertices);
  };
  same(weft::piecewise_smooth_complex(soup_of(s), 60));
  CGAL::Surface_mesh<Point> mesh;
  CGAL::Polyhedron_3<K> polyhedron;
  const Soup soup = soup_of(s);
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, polyhedron);
  same(weft::piecewise_smooth_complex(mesh, 60));
  same(weft::piecewise_smooth_complex(polyhedron));
  same(weft::piecewise_smooth_complex(weft::polygon_soup(mesh, mesh.points()), weft::Feature_options{60.0}));
}

TEST_CASE("polygons are cut into triangles that cover them, reentrant corners included")
{
  // An L-shaped prism of two hexagons and six quadrangles, with a collinear point on one edge of both hexagons.
  Soup soup;
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const std::size_t n = outline.size();
  for (const double z : {0., 1.})
    for (const auto& [x, y] : outline) soup.points.emplace_back(x, y, z);
  soup.polygons = {{6, 5, 4, 3, 2, 1, 0}, {7, 8, 9, 10, 11, 12, 13}};
  for (std::size_t i = 0; i < n; ++i) soup.polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  const Complex complex = weft::piecewise_smooth_complex(soup);
  CHECK(complex.triangles.size() == 2 * 5 + 2 * 7);
  CHECK(volume(complex.points, complex.triangles) == Approx(3));
  CHECK(complex.number_of_patches == 8);
  CHECK(count_kind(complex, Kind::corner) == 12);
  check_complex(complex, sharp_edges_of(complex, 60));

  SECTION("refusals name polygons")
  {
    soup.polygons.erase(soup.polygons.begin() + 3); // the side between 1 and 2
    try {
      weft::piecewise_smooth_complex(soup);
      FAIL("accepted");
    } catch (const weft::Domain_error& error) {
      CHECK(error.elements() == Indices{0, 1, 2, 3});
      CHECK(error.vertices() == Indices{1, 2, 8, 9});
    }
  }
  SECTION("polygons that can't be cut are refused")
  {
    for (const Indices& bad : {Indices{0, 1}, Indices{}, Indices{0, 1, 2, 1}, Indices{0, 1, 99, 2}}) {
      Soup broken = soup;
      broken.polygons[4] = bad;
      try {
        weft::piecewise_smooth_complex(broken);
        FAIL("accepted");
      } catch (const weft::Domain_error& error) {
        CHECK(error.elements() == Indices{4});
      }
    }
    Soup bow_tie = soup;
    std::swap(bow_tie.polygons[2][0], bow_tie.polygons[2][1]);
    CHECK_THROWS_AS(weft::piecewise_smooth_complex(bow_tie), weft::Domain_error);
  }
}

// ---- Orientation

TEST_CASE("shells are turned over as a whole so that the volume lies behind the facets")
{
  for (int turned = 0; turned < 8; ++turned) {
    Surface s;
    double expected = 0, sign = 1;
    std::size_t wrong = 0;
    for (int i = 0; i < 3; ++i, sign = -sign) {
      Surface shell = moved(sphere(1), 1 - 0.3 * i, 0.01 * i, 0, 0);
      expected += sign * volume(shell);
      const bool flip = turned >> i & 1;
      wrong += flip != (i == 1);
      s = together(s, flip ? inside_out(shell) : shell);
    }
    const Complex complex = complex_of(s);
    CHECK(volume(complex.points, complex.triangles) == Approx(expected));
    CHECK(complex.number_of_shells == 3);
    CHECK(complex.changes.size() == (wrong > 0));
    if (wrong > 0) CHECK(complex.changes[0].find(std::to_string(wrong) + " shell") == 0);
    const Complex again = complex_of({complex.points, complex.triangles});
    CHECK(again.changes.empty());
  }
}

TEST_CASE("a surface inside out has the same creases as before")
{
  const Complex complex = complex_of(inside_out(l_shape())), expected = complex_of(l_shape());
  CHECK(volume(complex.points, complex.triangles) == Approx(3));
  REQUIRE(complex.creases.size() == expected.creases.size());
  for (std::size_t c = 0; c < complex.creases.size(); ++c)
    CHECK(complex.creases[c].vertices == expected.creases[c].vertices);
  CHECK(complex.patches == expected.patches);
  check_complex(complex, sharp_edges_of(complex, 60));
}

// ---- Refusals

TEST_CASE("a surface that doesn't qualify is refused and the culprits are named")
{
  Surface s = cube();
  SECTION("nothing at all")
  {
    CHECK(says(refusal_of({}), "no facets"));
    s.triangles.clear();
    CHECK(says(refusal_of(s), "no facets"));
  }
  SECTION("coordinates that aren't finite")
  {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity}) {
      s.points[3] = Point(0, bad, 0);
      const Refusal refusal = refusal_of(s);
      CHECK(says(refusal, "finite"));
      CHECK(refusal.vertices == Indices{3});
      for (const std::size_t t : refusal.facets)
        CHECK(std::count(s.triangles[t].begin(), s.triangles[t].end(), std::size_t(3)) == 1);
    }
  }
  SECTION("corners that don't exist")
  {
    s.triangles[5][1] = 8;
    CHECK(refusal_of(s).facets == Indices{5});
  }
  SECTION("degenerate facets")
  {
    s.triangles.push_back({2, 2, 5});
    s.points.emplace_back(0.5, 0, 0);
    s.points.emplace_back(0.25, 0, 0);
    s.points.emplace_back(0.75, 0, 0);
    s.triangles.push_back({8, 9, 10});
    const Refusal refusal = refusal_of(s);
    CHECK(says(refusal, "2 facets are degenerate: 12, 13"));
    CHECK(refusal.vertices == Indices{2, 5, 8, 9, 10});
  }
  SECTION("duplicated facets, also backwards")
  {
    s.triangles.push_back({s.triangles[4][1], s.triangles[4][2], s.triangles[4][0]});
    s.triangles.push_back({s.triangles[7][1], s.triangles[7][0], s.triangles[7][2]});
    CHECK(refusal_of(s).facets == Indices{4, 7, 12, 13});
  }
  SECTION("open surfaces")
  {
    const Triangle lost = s.triangles.back();
    s.triangles.pop_back();
    const Refusal refusal = refusal_of(s);
    CHECK(says(refusal, "3 edges have only one facet"));
    CHECK(refusal.facets.size() == 3);
    for (const std::size_t v : lost) CHECK(std::count(refusal.vertices.begin(), refusal.vertices.end(), v) == 1);
  }
  SECTION("every triangle with corners of its own")
  {
    Surface loose;
    for (const auto& t : s.triangles) {
      for (const std::size_t v : t) loose.points.push_back(s.points[v]);
      const std::size_t n = loose.points.size();
      loose.triangles.push_back({n - 3, n - 2, n - 1});
    }
    CHECK(says(refusal_of(loose), "28 points repeat the coordinates"));
  }
  SECTION("edges with more than two facets")
  {
    s.points.emplace_back(-1, -1, 5);
    s.triangles.push_back({s.triangles[0][0], s.triangles[0][1], 8});
    const Refusal refusal = refusal_of(s);
    CHECK(says(refusal, "1 edge has more than two facets"));
    CHECK(refusal.vertices.size() == 2);
    CHECK(refusal.facets.size() == 3);
  }
  SECTION("zero volume")
  {
    const Surface flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {2, 1, 3}}};
    CHECK(says(refusal_of(flat), "zero volume"));
    CHECK(refusal_of(together(s, moved(flat, 1, 5, 0, 0))).facets == Indices{12, 13, 14, 15});
    const Surface pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    CHECK(says(refusal_of(pillow), "same three vertices"));
  }
  SECTION("a one-sided surface")
  {
    // A Klein bottle as a combinatorial surface: a grid closed up with a twist.
    Surface klein;
    const std::size_t n = 5;
    std::mt19937 random(3);
    for (std::size_t i = 0; i < n * n; ++i)
      klein.points.emplace_back(double(random() % 1000), double(random() % 1000), double(random() % 1000));
    const auto vertex = [n](std::size_t i, std::size_t j) { return i < n ? i * n + j % n : (n - j % n) % n; };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        klein.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        klein.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    CHECK(says(refusal_of(klein), "one-sided"));
  }
  SECTION("a dent that comes out on the other side")
  {
    Surface t = box(3, 3, 1);
    std::size_t top = 0;
    while (t.points[top] != Point(1, 1, 1)) ++top;
    t.points[top] = Point(1, 1, -0.5);
    const Refusal refusal = refusal_of(t);
    CHECK(says(refusal, "intersect"));
    for (const std::size_t f : refusal.facets) {
      const auto& facet = t.triangles[f];
      const bool is_dent = std::count(facet.begin(), facet.end(), top) == 1;
      const bool is_below = t.points[facet[0]].z() == 0 && t.points[facet[1]].z() == 0 && t.points[facet[2]].z() == 0;
      CHECK((is_dent || is_below));
    }
  }
}

TEST_CASE("parts that touch are refused whether they share points or not")
{
  const int steps[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}};
  for (const auto& step : steps) {
    const Surface apart = touching_cubes(step[0], step[1], step[2], false);
    CHECK(says(refusal_of(apart), "intersect or touch"));
  }
  const Surface edge = touching_cubes(1, 1, 0, true), vertex = touching_cubes(1, 1, 1, true);
  const Refusal at_edge = refusal_of(edge), at_vertex = refusal_of(vertex);
  CHECK(says(at_edge, "1 edge has more than two facets"));
  for (const std::size_t v : at_edge.vertices) CHECK((edge.points[v].x() == 1 && edge.points[v].y() == 1));
  CHECK(at_edge.facets.size() == 4);
  CHECK(says(at_vertex, "touch in a vertex"));
  REQUIRE(at_vertex.vertices.size() == 1);
  CHECK(vertex.points[at_vertex.vertices[0]] == Point(1, 1, 1));
  for (const std::size_t t : at_vertex.facets)
    CHECK(std::count(vertex.triangles[t].begin(), vertex.triangles[t].end(), at_vertex.vertices[0]) == 1);
  // An inner shell that touches the outer one from inside.
  CHECK(says(refusal_of(together(box(3, 3, 3), moved(cube(), 1, 1, 1, 2))), "intersect or touch"));
}

TEST_CASE("random damage to good surfaces is always found")
{
  std::mt19937 random(5);
  const std::vector<Surface> good = {
      sphere(2), torus(12, 8), box(3, 3, 2), cube_with_hole(), nested_spheres({0.5}, 1), cylinder(20)};
  for (int round = 0; round < 400; ++round) {
    Surface s = good[static_cast<std::size_t>(round) % good.size()];
    const std::size_t t = random() % s.triangles.size();
    const Triangle facet = s.triangles[t];
    INFO("round " << round << ", facet " << t);
    switch (round / static_cast<int>(good.size()) % 4) {
    case 0: { // flipped facets
      std::set<std::size_t> flipped = {t};
      while (flipped.size() < 1 + random() % 5) flipped.insert(random() % s.triangles.size());
      for (const std::size_t f : flipped) std::swap(s.triangles[f][0], s.triangles[f][2]);
      CHECK(refusal_of(s).facets == Indices(flipped.begin(), flipped.end()));
      break;
    }
    case 1: { // a missing facet: its corners bound the hole, and its neighbours lie around it
      s.triangles.erase(s.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      const Refusal refusal = refusal_of(s);
      Indices corners(facet.begin(), facet.end());
      std::sort(corners.begin(), corners.end());
      CHECK(refusal.vertices == corners);
      CHECK(refusal.facets.size() == 3);
      for (const std::size_t f : refusal.facets) {
        int common = 0;
        for (const std::size_t v : s.triangles[f]) common += std::count(facet.begin(), facet.end(), v) > 0;
        CHECK(common == 2);
      }
      break;
    }
    case 2: { // a repeated facet
      s.triangles.insert(s.triangles.begin() + static_cast<std::ptrdiff_t>(random() % (t + 1)), facet);
      const Refusal refusal = refusal_of(s);
      REQUIRE(refusal.facets.size() == 2);
      CHECK(s.triangles[refusal.facets[0]] == facet);
      CHECK(s.triangles[refusal.facets[1]] == facet);
      break;
    }
    default: { // two vertices welded
      const std::size_t a = random() % s.points.size(),
                        b = (a + 1 + random() % (s.points.size() - 1)) % s.points.size();
      for (auto& triangle : s.triangles) std::replace(triangle.begin(), triangle.end(), b, a);
      const Refusal refusal = refusal_of(s);
      CHECK(std::count(refusal.vertices.begin(), refusal.vertices.end(), a) == 1);
    }
    }
  }
}

// ---- Files

TEST_CASE("every format gives the surface back")
{
  const Surface s = moved(l_shape(), 0.5, 0.25, 0, -1); // coordinates that a float holds
  for (const Format& format : formats) {
    INFO(format.extension);
    const Temporary_file file(format.extension, format.write(s));
    const Soup soup = weft::IO::read_surface<K>(file.name);
    REQUIRE(soup.polygons.size() == s.triangles.size());
    CHECK(soup.points.size() == s.points.size()); // STL: equal points merged
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      REQUIRE(soup.polygons[t].size() == 3);
      for (std::size_t i = 0; i < 3; ++i) CHECK(soup.points[soup.polygons[t][i]] == s.points[s.triangles[t][i]]);
    }
    CHECK(weft::piecewise_smooth_complex(soup).number_of_patches == 8);
  }
}

TEST_CASE("a file cut anywhere is an error or lacks facets, never a crash or another surface")
{
  const Surface s = moved(tetrahedron(), 0.5, 1.25, 0, 0);
  const Complex expected = complex_of(s);
  for (const Format& format : formats) {
    const std::string bytes = format.write(s);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      INFO(format.extension << " cut to " << size << " of " << bytes.size());
      const Temporary_file file(format.extension, bytes.substr(0, size));
      try {
        const Complex complex = weft::piecewise_smooth_complex(weft::IO::read_surface<K>(file.name));
        // Only what carries nothing may be missing, or digits at the end of the last number.
        CHECK(size + 14 > bytes.size());
        CHECK(complex.triangles.size() == expected.triangles.size());
        CHECK(volume(complex.points, complex.triangles) == Approx(volume(s)));
      } catch (const weft::Error&) {
        SUCCEED();
      }
    }
  }
}

TEST_CASE("a file with random damage is read, refused or an error, never a crash")
{
  std::mt19937 random(11);
  const Surface s = cube();
  for (const Format& format : formats) {
    const std::string good = format.write(s);
    for (int round = 0; round < 150; ++round) {
      std::string bytes = good;
      for (int i = 0; i <= round % 3; ++i) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
      const Temporary_file file(format.extension, bytes);
      try {
        weft::piecewise_smooth_complex(weft::IO::read_surface<K>(file.name));
      } catch (const weft::Error&) {
        SUCCEED();
      }
    }
  }
}

TEST_CASE("what is wrong with a file is said, with the line where there is one")
{
  const auto contains = [](const std::string& text, const std::string& part) {
    INFO(text);
    return text.find(part) != std::string::npos;
  };
  CHECK_THROWS_AS(weft::IO::read_surface<K>("no_such_file.off"), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_surface<K>("no_such_file.stl"), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_surface<K>("no_such_file.ply"), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_surface<K>("."), weft::File_error);
  CHECK(contains(message_of_reading("xyz", "0 0 0"), "extension"));
  for (const char* extension : {"off", "obj", "stl", "ply"}) {
    INFO(extension);
    CHECK(!message_of_reading(extension, "").empty());
    CHECK(!message_of_reading(extension, "\n\n").empty());
    CHECK(!message_of_reading(extension, "complete nonsense\n1 2 3\n").empty());
  }
  CHECK(contains(message_of_reading("off", "OFF\n4 4 0\n0.00000000 0 0\n1.00000000 0 0\n"), ":4: the file ends"));
  CHECK(contains(message_of_reading("off", "OFF\n99999999999 4 0\n"), "too short"));
  CHECK(contains(message_of_reading("off", "OFF\n1 1 0\n0 nan 0\n3 0 0 0\n"), ":3: y is not finite"));
  CHECK(contains(message_of_reading("off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), ":4: there is no point 1"));
  CHECK(contains(message_of_reading("off", "OFF\n1 1 0\n0 0 0\n3 0 0 0\n3 0 0 1\n"), ":5: there is no point 1"));
  CHECK(contains(message_of_reading("off", "OFF\n1 1 0\n0 0 0\n3 0 0 0\nnonsense\n"), ":5: the number of corners"));
  CHECK(contains(message_of_reading("obj", "v 0 0 0\nf 1 \\\n1 2\n"), ":3: there is no point 2"));
  CHECK(contains(message_of_reading("obj", "v 0 0 0\nf 1 1 2\n"), ":2: there is no point 2"));
  CHECK(contains(message_of_reading("obj", "v 0 0 0\n"), "no facets"));
  CHECK(contains(message_of_reading("stl", "solid\nfacet\nvertex 0 0 inf\n"), ":3: z is not finite"));
  CHECK(contains(message_of_reading("stl", "solid\nfacet\nvertex 0 0 0\nendfacet\n"), ":4: a facet needs three"));
  std::string cut = stl_bytes(cube());
  cut[0] = 'x';
  cut.resize(cut.size() - 10);
  CHECK(contains(message_of_reading("stl", cut), "12 facets"));
  CHECK(contains(message_of_reading("ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\n"), "too short"));
  const std::string ply = ply_text(tetrahedron());
  CHECK(contains(message_of_reading("ply", ply.substr(0, ply.size() - 2) + "9\n"), "doesn't exist"));
}

TEST_CASE("files that go their own ways give the surface back")
{
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const auto is_tetrahedron = [](const std::string& extension, const std::string& bytes) {
    const Temporary_file file(extension, bytes);
    const Soup soup = weft::IO::read_surface<K>(file.name);
    const Complex complex = weft::piecewise_smooth_complex(soup);
    return complex.triangles.size() == 4 && complex.changes.empty();
  };
  // Facets over several lines, with colours, and one more than is announced.
  CHECK(is_tetrahedron("off", "OFF\n4 3 0\n" + points + "3 0\n2 1\n3\n0 1 3 255 0 0\n3 1 2 3\n3 0 3 2\n"));
  CHECK(is_tetrahedron("obj", "o thing\nv 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nv 0 0 1\ng a b\nusemtl red\nf 1 3 \\\r\n2\n"
                              "f 1/1 2/2 4/3\ng c\nf 2 3 4\nf -4 -1 -2\n"));
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                             "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                             "end_header\n" +
                             points;
  CHECK(is_tetrahedron("ply", header + "12 0 2 1 3 -1 0 3 2 -1 0 1 3\n"));
  CHECK(is_tetrahedron("ply", header + "6 0 2 1 3 0 2\n"));
  CHECK(is_tetrahedron("ply", header + "15 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2\n"));
  const Surface s = moved(tetrahedron(), 1, 0, 0, 0);
  for (const Format& format : formats) {
    if (std::string(format.extension) != "stl") continue;
    const std::string bytes = format.write(s);
    if (bytes.compare(0, 5, "solid") == 0) continue;
    const Temporary_file file("stl", bytes + std::string(13, '\0'));
    CHECK(weft::IO::read_surface<K>(file.name).polygons.size() == s.triangles.size());
  }
}

TEST_CASE("OFF files may have colours, a header of their own, or none")
{
  const std::string body = "4 4 0\n0 0 0 255 0 0\n1 0 0 1 1 1\n0 1 0 1 1 1\n0 0 1 1 1 1\n"
                           "3 0 2 1 0.5 0.5 0.5\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  for (const char* header : {"COFF\n", "OFF ", "", "OFF\r\n# comment\n\n"}) {
    INFO(header);
    const Temporary_file file("off", header + body);
    CHECK(weft::piecewise_smooth_complex(weft::IO::read_surface<K>(file.name)).triangles.size() == 4);
  }
  CHECK(!message_of_reading("off", "4OFF\n" + body).empty());
}
