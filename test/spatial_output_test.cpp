// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of what comes after the spatial mesher: the writers lose nothing, the measures agree with closed forms,
// and the checkers find every fault that is planted.

#include "fixtures/checks_3.h"
#include "fixtures/spatial_fixtures.h"

#include <weft/errors.h>
#include <weft/IO/write_gmsh_2.h>
#include <weft/IO/write_medit_2.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/IO/write_off_2.h>
#include <weft/IO/write_report_json_3.h>
#include <weft/IO/write_vtu_2.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

using namespace fixtures;
using Kind = weft::Fault_kind_3;
using weft::internal::sorted;

namespace {

/// A file that goes with the test case.
class Scratch_file
{
public:
  explicit Scratch_file(const std::string& extension) : name_("spatial_output_test_scratch." + extension) {}
  ~Scratch_file() { std::remove(name_.c_str()); }
  const std::string& name() const { return name_; }
  std::string content() const
  {
    std::ifstream in(name_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

private:
  std::string name_;
};

/// A mesh as a file has it, with the file's own tags.
struct Contents
{
  std::vector<Point> points;
  std::vector<int> point_tags;
  std::map<std::vector<std::size_t>, int> cells, facets, edges; ///< exactly as in the file, orientation included
  std::vector<std::size_t> corners, required, ridges;
};

template <class Elements>
std::map<std::vector<std::size_t>, int> as_map(const Elements& elements, const std::vector<int>& tags, int added)
{
  std::map<std::vector<std::size_t>, int> result;
  for (std::size_t i = 0; i < elements.size(); ++i) result[{elements[i].begin(), elements[i].end()}] = tags[i] + added;
  return result;
}

void read_elements(std::istream& in, std::size_t vertices, std::map<std::vector<std::size_t>, int>& elements)
{
  std::size_t count = 0;
  in >> count;
  for (; count > 0; --count) {
    std::vector<std::size_t> element(vertices);
    for (auto& v : element) in >> v, --v;
    in >> elements[element];
  }
}

void read_list(std::istream& in, std::vector<std::size_t>& list)
{
  std::size_t count = 0;
  in >> count;
  list.resize(count);
  for (auto& v : list) in >> v, --v;
}

Contents read_medit(const std::string& filename)
{
  std::ifstream in(filename);
  Contents contents;
  for (std::string word; in >> word && word != "End";) {
    if (word == "Vertices") {
      std::size_t count = 0;
      in >> count;
      for (; count > 0; --count) {
        double x = 0, y = 0, z = 0;
        int tag = 0;
        in >> x >> y >> z >> tag;
        contents.points.emplace_back(x, y, z);
        contents.point_tags.push_back(tag);
      }
    } else if (word == "Corners")
      read_list(in, contents.corners);
    else if (word == "RequiredVertices")
      read_list(in, contents.required);
    else if (word == "Ridges")
      read_list(in, contents.ridges);
    else if (word == "Edges")
      read_elements(in, 2, contents.edges);
    else if (word == "Triangles")
      read_elements(in, 3, contents.facets);
    else if (word == "Tetrahedra")
      read_elements(in, 4, contents.cells);
    else if (word == "MeshVersionFormatted" || word == "Dimension")
      in >> word;
    else
      FAIL("unexpected " << word);
  }
  CHECK(in);
  return contents;
}

/// The numbers of a data array of a .vtu file.
std::vector<double> vtu_array(const std::string& text, const std::string& name)
{
  const std::size_t tag = text.find("Name=\"" + name + "\"");
  REQUIRE(tag != std::string::npos);
  const std::size_t start = text.find('>', tag) + 1, end = text.find('<', start);
  std::istringstream in(text.substr(start, end - start));
  return {std::istream_iterator<double>(in), {}};
}

/// A mesh whose coordinates have many digits.
Mesh uneven_box(bool two_subdomains)
{
  Mesh mesh = box(4, two_subdomains).mesh;
  for (Point& p : mesh.points) p = Point(p.x() / 3 + 1e6, p.y() / 7, p.z() * 1.1e-5);
  return mesh;
}

/// Volume enclosed by triangles that look outwards.
double enclosed_volume(const std::vector<Point>& points, const std::vector<std::array<std::size_t, 3>>& triangles)
{
  double volume = 0;
  for (const auto& t : triangles) volume += CGAL::volume(points[0], points[t[0]], points[t[1]], points[t[2]]);
  return volume;
}

double volume_of(const Mesh& mesh)
{
  double volume = 0;
  for (const auto& c : mesh.cells)
    volume += CGAL::volume(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]);
  return volume;
}

float float_at(const std::string& bytes, std::size_t place)
{
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i > 0; --i) bits = bits << 8 | static_cast<unsigned char>(bytes[place + i - 1]);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string text_of(const weft::Validity_3& validity)
{
  std::ostringstream out;
  out << validity;
  return out.str();
}

/// Whether the checks find faults of this kind, and of no other.
bool finds_only(const weft::Validity_3& validity, Kind kind)
{
  UNSCOPED_INFO(text_of(validity));
  std::size_t others = 0;
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if (static_cast<Kind>(i) != kind) others += validity.counts[i];
  return validity.count(kind) > 0 && others == 0;
}

bool mentions(const weft::Validity_3& validity, const std::string& text)
{
  return text_of(validity).find(text) != std::string::npos;
}

/// A regular tetrahedron with this edge, positively oriented.
Mesh regular_tetrahedron(double edge)
{
  const double a = edge / std::sqrt(8.);
  return single_cell(Point(a, a, a), Point(a, -a, -a), Point(-a, -a, a), Point(-a, a, -a));
}

/// What Polyhedral_oracle_3 answers, for the cube [0, n]^3 of the fixture.
struct Cube_oracle
{
  double n;
  struct Hit
  {
    Point point;
    int patch;
  };
  Hit project_on_patch(const Point& p, int patch) const
  {
    std::array<double, 3> q = {p.x(), p.y(), p.z()};
    q[static_cast<std::size_t>(patch / 2)] = patch % 2 * n;
    return {Point(q[0], q[1], q[2]), patch};
  }
  Point project_on_crease(const Point& p, int crease) const
  {
    std::array<double, 3> q = {p.x(), p.y(), p.z()};
    const int axis = crease / 4;
    q[static_cast<std::size_t>((axis + 1) % 3)] = (crease & 1) * n;
    q[static_cast<std::size_t>((axis + 2) % 3)] = (crease >> 1 & 1) * n;
    return {q[0], q[1], q[2]};
  }
};

} // namespace

// ---- Writers

TEST_CASE("a Medit file holds all coordinates, elements and tags")
{
  const bool two_subdomains = GENERATE(false, true);
  const Mesh mesh = uneven_box(two_subdomains);
  const Scratch_file file("mesh");
  weft::IO::write_mesh_3(file.name(), mesh);
  const Contents read = read_medit(file.name());
  CHECK(read.points == mesh.points);
  CHECK(read.cells == as_map(mesh.cells, mesh.subdomains, 0));
  CHECK(read.facets == as_map(mesh.facets, mesh.patches, 1));
  CHECK(read.edges == as_map(mesh.edges, mesh.creases, 1));
  CHECK(read.corners == mesh.corners);
  CHECK(read.required == mesh.corners);
  CHECK(read.ridges.size() == mesh.edges.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    CHECK(read.point_tags[v] == mesh.locations[v].index + (mesh.locations[v].dimension < 3));
}

TEST_CASE("a .vtu file holds all coordinates, elements and tags")
{
  const Mesh mesh = uneven_box(true);
  const Scratch_file file("vtu");
  weft::IO::write_vtu(file.name(), mesh, {}, {}, weft::Vtu_encoding::ascii);
  const std::string text = file.content();
  std::vector<double> points, connectivity, offsets, types, subdomains, patches, creases, features;
  const auto add = [&](const auto& element, int type, int subdomain, int patch, int crease, int feature) {
    connectivity.insert(connectivity.end(), element.begin(), element.end());
    offsets.push_back(static_cast<double>(connectivity.size()));
    types.push_back(type);
    subdomains.push_back(subdomain), patches.push_back(patch), creases.push_back(crease), features.push_back(feature);
  };
  for (const Point& p : mesh.points) points.insert(points.end(), {p.x(), p.y(), p.z()});
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) add(mesh.cells[i], 10, mesh.subdomains[i], -1, -1, -1);
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) add(mesh.facets[i], 5, 0, mesh.patches[i], -1, -1);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) add(mesh.edges[i], 3, 0, -1, mesh.creases[i], -1);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    add(std::array<std::size_t, 1>{mesh.corners[i]}, 1, 0, -1, -1, static_cast<int>(i));
  CHECK(vtu_array(text, "Points") == points);
  CHECK(vtu_array(text, "connectivity") == connectivity);
  CHECK(vtu_array(text, "offsets") == offsets);
  CHECK(vtu_array(text, "types") == types);
  CHECK(vtu_array(text, "subdomain") == subdomains);
  CHECK(vtu_array(text, "patch") == patches);
  CHECK(vtu_array(text, "crease") == creases);
  CHECK(vtu_array(text, "feature") == features);
  const auto dimensions = vtu_array(text, "dimension"), indices = vtu_array(text, "index");
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    CHECK(mesh.locations[v] == Location{static_cast<int>(dimensions[v]), static_cast<int>(indices[v])});
  const std::string cells = std::to_string(types.size());
  CHECK(text.find("NumberOfPoints=\"125\" NumberOfCells=\"" + cells + "\"") != std::string::npos);
}

TEST_CASE("a Gmsh file holds all coordinates and elements in entities with the tags and bounding boxes")
{
  const Mesh mesh = uneven_box(true);
  const Scratch_file file("msh");
  weft::IO::write_mesh_3(file.name(), mesh);
  std::ifstream in(file.name());
  const auto expect = [&in](const std::string& wanted) {
    std::string word;
    in >> word;
    REQUIRE(word == wanted);
  };
  for (const char* word : {"$MeshFormat", "4.1", "0", "8", "$EndMeshFormat", "$Entities"}) expect(word);
  std::array<std::size_t, 4> entities{};
  for (auto& n : entities) in >> n;
  CHECK(entities == std::array<std::size_t, 4>{8, 12, 7, 2});
  std::map<std::pair<int, int>, std::array<double, 6>> boxes;
  std::map<std::pair<int, int>, std::set<int>> bounds;
  for (int d = 0; d < 4; ++d)
    for (std::size_t i = 0; i < entities[static_cast<std::size_t>(d)]; ++i) {
      int tag = 0, physical_tags = 0, physical = 0;
      std::size_t parts = 0;
      in >> tag;
      auto& sides = boxes[{d, tag}];
      for (int k = 0; k < (d == 0 ? 3 : 6); ++k) in >> sides[static_cast<std::size_t>(k)];
      in >> physical_tags >> physical;
      CHECK(physical_tags == 1);
      CHECK(physical == tag);
      if (d > 0) in >> parts;
      for (int part = 0; parts > 0; --parts) in >> part, bounds[{d, tag}].insert(part);
    }
  for (int crease = 1; crease <= 12; ++crease) CHECK(bounds[{1, crease}].size() == 2);
  for (int patch = 1; patch <= 6; ++patch) CHECK(bounds[{2, patch}].size() == 4);
  CHECK(bounds[{3, 1}] == std::set<int>{1, 3, 4, 5, 6, 7});
  CHECK(bounds[{3, 2}] == std::set<int>{2, 3, 4, 5, 6, 7});
  for (const char* word : {"$EndEntities", "$Nodes"}) expect(word);

  std::size_t blocks = 0, total = 0, least = 0, most = 0, count = 0;
  in >> blocks >> total >> least >> most;
  REQUIRE(total == mesh.points.size());
  std::vector<Point> points(total);
  std::set<std::size_t> seen;
  for (; blocks > 0; --blocks) {
    int d = 0, tag = 0, parametric = 0;
    in >> d >> tag >> parametric >> count;
    std::vector<std::size_t> numbers(count);
    for (auto& number : numbers) in >> number;
    for (const std::size_t number : numbers) {
      double x = 0, y = 0, z = 0;
      in >> x >> y >> z;
      points.at(number - 1) = Point(x, y, z);
      CHECK(seen.insert(number).second);
      CHECK(mesh.locations[number - 1] == Location{d, tag - (d < 3)});
    }
  }
  CHECK(points == mesh.points);
  CHECK(seen.size() == total);
  for (const char* word : {"$EndNodes", "$Elements"}) expect(word);

  in >> blocks >> total >> least >> most;
  std::array<std::map<std::vector<std::size_t>, int>, 4> elements;
  for (; blocks > 0; --blocks) {
    int d = 0, tag = 0, type = 0;
    std::size_t number = 0;
    in >> d >> tag >> type >> count;
    CHECK(type == std::array<int, 4>{15, 1, 2, 4}[static_cast<std::size_t>(d)]);
    const auto& sides = boxes.at({d, tag});
    for (; count > 0; --count) {
      std::vector<std::size_t> element(static_cast<std::size_t>(d) + 1);
      in >> number;
      for (auto& v : element) {
        in >> v, --v;
        for (int k = 0; k < 3 && d > 0; ++k)
          CHECK((sides[static_cast<std::size_t>(k)] <= points[v][k] &&
                 points[v][k] <= sides[static_cast<std::size_t>(k) + 3]));
      }
      elements[static_cast<std::size_t>(d)][element] = tag;
    }
  }
  CHECK(elements[3] == as_map(mesh.cells, mesh.subdomains, 0));
  CHECK(elements[2] == as_map(mesh.facets, mesh.patches, 1));
  CHECK(elements[1] == as_map(mesh.edges, mesh.creases, 1));
  REQUIRE(elements[0].size() == 8);
  for (std::size_t i = 0; i < 8; ++i) CHECK(elements[0].at({mesh.corners[i]}) == static_cast<int>(i) + 1);
  expect("$EndElements");
}

TEST_CASE("an OFF file holds the boundary alone, looking outwards")
{
  const Mesh mesh = ball(200, 100).mesh;
  const Scratch_file file("off");
  weft::IO::write_mesh_3(file.name(), mesh);
  std::ifstream in(file.name());
  std::string word;
  std::size_t vertices = 0, facets = 0, edges = 0;
  in >> word >> vertices >> facets >> edges;
  CHECK(word == "OFF");
  CHECK(vertices == 200); // none of the 100 inside
  CHECK(facets == mesh.facets.size());
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles(facets);
  for (std::size_t i = 0; i < vertices; ++i) {
    double x = 0, y = 0, z = 0;
    in >> x >> y >> z;
    points.emplace_back(x, y, z);
  }
  std::set<std::size_t> used;
  for (auto& t : triangles) {
    int corners = 0;
    in >> corners;
    CHECK(corners == 3);
    for (auto& v : t) in >> v, used.insert(v);
  }
  CHECK(in);
  CHECK(used.size() == vertices);
  CHECK(enclosed_volume(points, triangles) == Approx(volume_of(mesh)).epsilon(1e-12));
}

TEST_CASE("a binary STL file holds the boundary, with normals that look outwards")
{
  const Mesh mesh = ball(200, 100).mesh;
  const Scratch_file file("stl");
  weft::IO::write_mesh_3(file.name(), mesh);
  const std::string bytes = file.content();
  REQUIRE(bytes.size() == 84 + 50 * mesh.facets.size());
  CHECK(bytes.substr(0, 5) != "solid");
  std::uint32_t count = 0;
  for (std::size_t i = 4; i > 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + i - 1]);
  CHECK(count == mesh.facets.size());
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    K::Vector_3 normal = CGAL::NULL_VECTOR;
    std::array<Point, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t at = 84 + 50 * f + 12 * i;
      p[i] = Point(float_at(bytes, at), float_at(bytes, at + 4), float_at(bytes, at + 8));
    }
    normal = p[0] - CGAL::ORIGIN;
    CHECK(normal.squared_length() == Approx(1).epsilon(1e-5));
    CHECK(normal * (p[1] - CGAL::ORIGIN) > 0); // the ball's center is the origin
    for (std::size_t i = 0; i < 3; ++i) CHECK(CGAL::squared_distance(p[i + 1], mesh.points[mesh.facets[f][i]]) < 1e-13);
  }
}

TEST_CASE("an unknown extension and a folder that doesn't exist are refused")
{
  const Mesh mesh = regular_tetrahedron(1);
  CHECK_THROWS_AS(weft::IO::write_mesh_3("mesh.svg", mesh), weft::File_error);
  for (const char* extension : {"mesh", "vtu", "msh", "off", "stl"}) {
    CHECK(weft::IO::is_mesh_3_filename(std::string("a.b/mesh.") + extension));
    CHECK_THROWS_AS(weft::IO::write_mesh_3(std::string("no such folder/mesh.") + extension, mesh), weft::File_error);
  }
  CHECK_FALSE(weft::IO::is_mesh_3_filename("mesh"));
}

TEST_CASE("the planar headers of formats write spatial meshes, too")
{
  const Mesh mesh = regular_tetrahedron(1);
  const Scratch_file file("txt");
  weft::IO::write_medit(file.name(), mesh);
  CHECK(file.content().find("Tetrahedra\n1\n1 2 3 4 1\n") != std::string::npos);
  weft::IO::write_vtu(file.name(), mesh);
  CHECK(file.content().find("</VTKFile>") != std::string::npos);
  weft::IO::write_gmsh(file.name(), mesh);
  CHECK(file.content().find("$EndElements") != std::string::npos);
  weft::IO::write_off(file.name(), mesh);
  CHECK(file.content().find("OFF\n4 4 0\n") == 0);
}

TEST_CASE("a report is JSON with counts, reasons and the histogram")
{
  weft::Mesh_report_3 report;
  report.vertices = 4;
  report.bad_facets = {0, 0, 3, 0, 0, 3, 2};
  const weft::Quality_3 quality = weft::measure_quality_3(regular_tetrahedron(1));
  std::ostringstream out;
  weft::IO::write_report_json(out, report, quality);
  const std::string text = out.str();
  for (const char* part : {"\"ok\": false", "\"stop_reason\": \"all criteria met\"", "\"vertices\": 4", "\"shape\": 3",
                           "\"at_floor\": 2", "\"cells\": 1", "\"bin_degrees\": 1", "\"cells_below\": {"})
    CHECK(text.find(part) != std::string::npos);
  weft::Quality_3 nothing;
  std::ostringstream empty;
  weft::IO::write_report_json(empty, report, nothing);
  CHECK(empty.str().find("nan") == std::string::npos);
  CHECK(empty.str().find("\"longest_edge\": null") != std::string::npos);
}

// ---- Quality

TEST_CASE("measures of a regular tetrahedron are those of the books, at any scale")
{
  const double edge = GENERATE(1., 3e-90, 7e90);
  const weft::Quality_3 q = weft::measure_quality_3(regular_tetrahedron(edge));
  const double angle = std::acos(1. / 3) * 180 / 3.14159265358979323846;
  CHECK(q.vertices == 4);
  CHECK(q.cells == 1);
  CHECK(q.facets == 4);
  CHECK(q.smallest_dihedral.degrees == Approx(angle).epsilon(1e-14));
  CHECK(q.largest_dihedral.degrees == Approx(angle).epsilon(1e-14));
  CHECK(q.mean_smallest_dihedral == Approx(angle).epsilon(1e-14));
  CHECK(q.dihedrals[70] == 6);
  CHECK(q.smallest_dihedrals[70] == 1);
  CHECK(q.cells_below(70) == 0);
  CHECK(q.cells_below(71) == 1);
  CHECK(q.largest_radius_edge_ratio == Approx(std::sqrt(6.) / 4).epsilon(1e-14));
  CHECK(q.smallest_radius_ratio == Approx(1).epsilon(1e-14));
  CHECK(q.shortest_edge == Approx(edge).epsilon(1e-14));
  CHECK(q.longest_edge == Approx(edge).epsilon(1e-14));
  CHECK(q.volume / edge / edge / edge == Approx(std::sqrt(2.) / 12).epsilon(1e-13));
  CHECK(q.boundary_area / edge / edge == Approx(std::sqrt(3.)).epsilon(1e-13));
  CHECK(q.smallest_facet_angle.degrees == Approx(60).epsilon(1e-13));
  CHECK(q.largest_facet_angle.degrees == Approx(60).epsilon(1e-13));
  CHECK(q.largest_facet_ratio == Approx(1 / std::sqrt(3.)).epsilon(1e-13));
}

TEST_CASE("measures of the corner of a cube are those of the books, at any distance from the origin")
{
  const double o = GENERATE(0., 1e6);
  const weft::Quality_3 q =
      weft::measure_quality_3(single_cell(Point(o, o, o), Point(o + 1, o, o), Point(o, o + 1, o), Point(o, o, o + 1)));
  const double slanted = std::atan(std::sqrt(2.)) * 180 / 3.14159265358979323846;
  CHECK(q.smallest_dihedral.degrees == Approx(slanted).epsilon(1e-14));
  CHECK(q.largest_dihedral.degrees == Approx(90).epsilon(1e-14));
  CHECK(sorted(q.largest_dihedral.vertices)[0] == 0); // at one of the edges to the corner
  CHECK(sorted(q.smallest_dihedral.vertices)[0] > 0);
  CHECK(q.dihedrals[54] == 3);
  CHECK(q.dihedrals[90] + q.dihedrals[89] == 3);
  CHECK(q.largest_radius_edge_ratio == Approx(std::sqrt(3.) / 2).epsilon(1e-14));
  // Inradius 3 V / A with V = 1/6, A = 3/2 + sqrt(3)/2; circumradius sqrt(3) / 2.
  CHECK(q.smallest_radius_ratio == Approx(3 * (0.5 / (1.5 + std::sqrt(3.) / 2)) / (std::sqrt(3.) / 2)).epsilon(1e-14));
  CHECK(q.volume == Approx(1. / 6).epsilon(1e-14));
  CHECK(q.smallest_facet_angle.degrees == Approx(45).epsilon(1e-14));
  CHECK(q.largest_facet_angle.degrees == Approx(90).epsilon(1e-14));
}

TEST_CASE("flat, degenerate and overturned cells have measures, none of them NaN")
{
  const Point a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  const weft::Quality_3 flat = weft::measure_quality_3(single_cell(a, b, c, d));
  CHECK(flat.smallest_dihedral.degrees == 0);
  CHECK(flat.largest_dihedral.degrees == Approx(180).epsilon(1e-15));
  CHECK(flat.dihedrals[0] == 4); // a square seen from the side: its diagonals have 180 degrees
  CHECK(flat.dihedrals[179] == 2);
  CHECK(flat.cells_below(5) == 1);
  CHECK(flat.volume == 0);
  CHECK(flat.smallest_radius_ratio == 0);
  CHECK(std::isinf(flat.largest_radius_edge_ratio));

  const weft::Quality_3 needle = weft::measure_quality_3(single_cell(a, b, Point(2, 0, 0), Point(3, 0, 0)));
  CHECK(needle.smallest_dihedral.degrees == 0);
  CHECK_FALSE(std::isnan(needle.largest_dihedral.degrees));
  CHECK(std::isinf(needle.largest_facet_ratio));

  // A sliver of height h over the square: dihedral angles from its sides are about h in radians.
  for (const double h : {1e-3, 1e-6, 1e-9}) {
    const weft::Quality_3 sliver = weft::measure_quality_3(single_cell(a, b, Point(1, 1, h), Point(0, 1, 0)));
    const double expected = sliver.smallest_dihedral.degrees * 3.14159265358979323846 / 180 / h;
    CHECK(expected == Approx(1).epsilon(1e-2));
  }
  const weft::Quality_3 turned = weft::measure_quality_3(single_cell(a, c, b, Point(0, 0, 1)));
  CHECK(turned.volume == Approx(-1. / 6));
  CHECK(turned.smallest_dihedral.degrees > 30);
}

TEST_CASE("of an empty mesh all measures but counts and sums are NaN")
{
  const weft::Quality_3 q = weft::measure_quality_3(Mesh());
  CHECK(q.cells == 0);
  CHECK(q.volume == 0);
  CHECK(std::isnan(q.smallest_dihedral.degrees));
  CHECK(std::isnan(q.mean_radius_ratio));
  CHECK(std::isnan(q.longest_edge));
}

TEST_CASE("measures of a mesh add up those of its cells")
{
  const Mesh mesh = ball(150, 100).mesh;
  const weft::Quality_3 q = weft::measure_quality_3(mesh);
  CHECK(q.volume == Approx(volume_of(mesh)).epsilon(1e-12));
  double smallest = 180, sum = 0;
  for (const auto& c : mesh.cells) {
    double of_cell = 180;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        std::vector<std::size_t> others;
        for (int k = 0; k < 4; ++k)
          if (k != i && k != j) others.push_back(c[static_cast<std::size_t>(k)]);
        const auto& p = mesh.points;
        of_cell = std::min(of_cell, std::abs(CGAL::approximate_dihedral_angle(p[c[static_cast<std::size_t>(i)]],
                                                                              p[c[static_cast<std::size_t>(j)]],
                                                                              p[others[0]], p[others[1]])));
      }
    sum += of_cell;
    smallest = std::min(smallest, of_cell);
  }
  CHECK(q.smallest_dihedral.degrees == Approx(smallest).margin(1e-6));
  CHECK(q.mean_smallest_dihedral == Approx(sum / static_cast<double>(mesh.cells.size())).margin(1e-6));
  std::size_t angles = 0;
  for (const std::size_t n : q.dihedrals) angles += n;
  CHECK(angles == 6 * mesh.cells.size());
  CHECK(q.cells_below(180) == mesh.cells.size());
}

// ---- Checkers

TEST_CASE("sound meshes are valid")
{
  for (const Mesh& mesh : {ball(200, 150).mesh, box(3).mesh, box(4, true).mesh, regular_tetrahedron(2)}) {
    const weft::Validity_3 validity = weft::validate_3(mesh);
    INFO(text_of(validity));
    CHECK(validity.ok());
    // The rim of the interface isn't a crease: facets beside it have vertices of another patch.
    const bool has_interface = std::count(mesh.patches.begin(), mesh.patches.end(), 6) > 0;
    CHECK(weft::check_topology_3(mesh).ok() != has_interface);
  }
}

TEST_CASE("faults of the arrays are found")
{
  const Mesh sound = box(3).mesh;
  Mesh mesh = sound;
  const auto finds = [&mesh](const std::string& text) {
    const weft::Validity_3 validity = weft::validate_3(mesh);
    return finds_only(validity, Kind::structure) && mentions(validity, text);
  };
  SECTION("an isolated vertex")
  {
    mesh.points.emplace_back(9, 9, 9);
    mesh.locations.push_back({3, 1});
    CHECK(finds("a vertex has no cell: vertex 64"));
  }
  SECTION("a cell twice")
  {
    mesh.cells.push_back(mesh.cells[5]);
    mesh.subdomains.push_back(1);
    CHECK(finds("a cell is there twice"));
  }
  SECTION("a facet with three cells")
  {
    mesh.points.emplace_back(1.5, 1.5, 1.5);
    mesh.locations.push_back({3, 1});
    mesh.cells.push_back({mesh.cells[0][0], mesh.cells[0][1], mesh.cells[0][2], 64});
    mesh.subdomains.push_back(1);
    const auto& cell = mesh.cells[0];
    // The facet may have been on the boundary; then the cells are on one side of it.
    CHECK((finds("a facet has 3 cells") || finds("same side")));
    CHECK(cell.size() == 4);
  }
  SECTION("a cell that is turned over in its array is on the wrong side of its facets")
  {
    std::swap(mesh.cells[3][0], mesh.cells[3][1]);
    CHECK(finds("two cells are on the same side of their facet"));
  }
  SECTION("an index out of range")
  {
    mesh.cells[3][2] = 64;
    CHECK(finds("a cell has a vertex that doesn't exist"));
  }
  SECTION("the same vertex twice")
  {
    mesh.facets[3][2] = mesh.facets[3][1];
    CHECK(finds("a facet has the same vertex twice"));
  }
  SECTION("tags of another number")
  {
    mesh.patches.pop_back();
    CHECK(finds("the tags of facets aren't as many as the facets"));
  }
  SECTION("locations of another number")
  {
    mesh.locations.pop_back();
    CHECK(finds("the locations aren't as many as the points"));
  }
  SECTION("a cell of no subdomain")
  {
    mesh.subdomains[3] = 0;
    CHECK(finds("the tag of a cell is 0"));
  }
  SECTION("coordinates that aren't numbers")
  {
    mesh.points[3] = Point(0, std::nan(""), 0);
    CHECK(finds("a coordinate isn't finite: vertex 3"));
  }
  SECTION("two vertices at one place")
  {
    mesh.points[3] = mesh.points[40];
    CHECK(finds("two vertices are at the same place: vertices 3 40"));
  }
  SECTION("a vertex of the larger box")
  {
    mesh.locations[3] = {-1, 0};
    CHECK(finds("a vertex lies nowhere: vertex 3"));
  }
}

TEST_CASE("flat and overturned cells are found")
{
  Mesh mesh = regular_tetrahedron(1);
  mesh.points[3] = CGAL::centroid(mesh.points[0], mesh.points[1], mesh.points[2]);
  mesh.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0)};
  CHECK(mentions(weft::check_orientation_3(mesh), "a cell is flat: vertices 0 1 2 3"));
  mesh.points[3] = Point(0, 0, -1);
  CHECK(mentions(weft::check_orientation_3(mesh), "a cell is turned over: vertices 0 1 2 3"));
  CHECK(finds_only(weft::validate_3(mesh), Kind::orientation));
  // By less than rounding can tell: exact predicates do.
  mesh.points = {Point(0.1, 0.1, 0.1), Point(0.2, 0.2, 0.3), Point(0.3, 0.4, 0.3), Point(0.4, 0.4, 0.5)};
  const auto sign = CGAL::orientation(mesh.points[0], mesh.points[1], mesh.points[2], mesh.points[3]);
  CHECK(weft::check_orientation_3(mesh).ok() == (sign == CGAL::POSITIVE));
}

TEST_CASE("a facet that isn't Delaunay is found, a cospherical one isn't")
{
  // Two cells at the facet 0 1 2, apexes 3 and 4.
  const auto pair_of_cells = [](double height) {
    Mesh mesh;
    mesh.points = {Point(1, 0, 0), Point(0, 1, 0), Point(-1, -1, 0), Point(0, 0, 1), Point(0, 0, -height)};
    mesh.locations.assign(5, {2, 0});
    mesh.cells = {{0, 1, 2, 3}, {1, 0, 2, 4}};
    mesh.subdomains = {1, 1};
    mesh.facets = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {0, 2, 4}, {2, 1, 4}};
    mesh.patches.assign(6, 0);
    return mesh;
  };
  CHECK(weft::validate_3(pair_of_cells(3)).ok());
  const weft::Validity_3 validity = weft::validate_3(pair_of_cells(0.3));
  CHECK(finds_only(validity, Kind::delaunay));
  REQUIRE(validity.faults.size() == 1);
  CHECK(validity.faults[0].vertices == std::vector<std::size_t>{0, 1, 2});
  CHECK(weft::check_delaunay_3(box(4).mesh).ok()); // every unit cube is cospherical

  // In a larger mesh: one vertex moved a little, so that cells stay oriented but not Delaunay.
  Mesh mesh = box(4).mesh;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.points[v] == Point(2, 2, 2)) mesh.points[v] = Point(2.01, 2.003, 2.002);
  CHECK(finds_only(weft::validate_3(mesh), Kind::delaunay));
}

TEST_CASE("missing, superfluous and inward facets are found")
{
  Mesh mesh = box(4, true).mesh;
  SECTION("missing")
  {
    const auto gone = mesh.facets[7];
    mesh.facets.erase(mesh.facets.begin() + 7);
    mesh.patches.erase(mesh.patches.begin() + 7);
    const weft::Validity_3 validity = weft::validate_3(mesh);
    CHECK(finds_only(validity, Kind::boundary));
    REQUIRE(validity.faults.size() == 1);
    const auto wanted = sorted(gone);
    CHECK(validity.faults[0].vertices == std::vector<std::size_t>(wanted.begin(), wanted.end()));
  }
  SECTION("superfluous")
  {
    std::set<std::array<std::size_t, 3>> listed;
    for (const auto& facet : mesh.facets) listed.insert(sorted(facet));
    std::array<std::size_t, 3> inner{};
    for (const auto& c : mesh.cells)
      if (!listed.count(sorted<3>({c[0], c[1], c[2]}))) inner = {c[0], c[1], c[2]};
    mesh.facets.push_back(inner);
    mesh.patches.push_back(0);
    CHECK(mentions(weft::check_boundary_3(mesh), "a facet is listed that isn't one of the boundary"));
  }
  SECTION("inward")
  {
    std::size_t f = 0;
    while (mesh.patches[f] == 6) ++f;
    std::swap(mesh.facets[f][0], mesh.facets[f][1]);
    CHECK(finds_only(weft::validate_3(mesh), Kind::boundary));
    CHECK(mentions(weft::validate_3(mesh), "a facet of the boundary looks inwards"));
  }
  SECTION("a cell in the wrong subdomain moves the interface")
  {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      double x = 0;
      for (const std::size_t v : mesh.cells[c]) x += mesh.points[v].x() / 4;
      if (x > 1 || mesh.subdomains[c] != 1) continue;
      mesh.subdomains[c] = 2;
      break;
    }
    CHECK(mentions(weft::validate_3(mesh), "a facet of the boundary isn't listed"));
  }
}

TEST_CASE("a boundary that isn't a manifold is found")
{
  // Two cells that share an edge only, or a vertex only.
  Mesh mesh;
  mesh.points = {Point(0, 0, -1), Point(0, 0, 1), Point(2, 0, 0), Point(2, 1, 0), Point(-2, 0, 0), Point(-2, -1, 0)};
  mesh.cells = {{0, 2, 3, 1}, {0, 4, 5, 1}};
  const auto complete = [&mesh] {
    mesh.locations.assign(mesh.points.size(), {2, 0});
    mesh.subdomains.assign(mesh.cells.size(), 1);
    mesh.facets.clear();
    for (const auto& cell : mesh.cells)
      for (int i = 0; i < 4; ++i) mesh.facets.push_back(weft::internal::outward_vertices(cell, i));
    mesh.patches.assign(mesh.facets.size(), 0);
  };
  SECTION("at an edge")
  {
    complete();
    const weft::Validity_3 validity = weft::validate_3(mesh);
    CHECK(finds_only(validity, Kind::manifold));
    CHECK(mentions(validity, "an edge has 4 facets of the boundary of subdomain 1: vertices 0 1"));
  }
  SECTION("at a vertex")
  {
    mesh.points.emplace_back(0, -1, 1);
    mesh.cells[1] = {0, 4, 5, 6};
    if (CGAL::orientation(mesh.points[0], mesh.points[4], mesh.points[5], mesh.points[6]) != CGAL::POSITIVE)
      std::swap(mesh.cells[1][0], mesh.cells[1][1]);
    complete();
    const weft::Validity_3 validity = weft::validate_3(mesh);
    CHECK(finds_only(validity, Kind::manifold));
    CHECK(mentions(validity, "a vertex has 2 umbrellas on the boundary of subdomain 1: vertex 0"));
  }
  SECTION("of one subdomain, though that of all of them is")
  {
    mesh = box(2).mesh;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      std::array<double, 3> center{};
      for (const std::size_t v : mesh.cells[c])
        for (int k = 0; k < 3; ++k) center[static_cast<std::size_t>(k)] += mesh.points[v][k] / 4;
      mesh.subdomains[c] = (center[0] > 1) == (center[1] > 1) ? 2 : 1; // a checkerboard of four columns
    }
    CHECK(mentions(weft::check_manifold_3(mesh), "an edge has 4 facets of the boundary of subdomain 2"));
  }
}

TEST_CASE("vertices, creases and corners that disagree are found")
{
  const Mesh sound = box(4).mesh;
  Mesh mesh = sound;
  const auto vertex_of = [&mesh](int dimension) {
    std::size_t v = 0;
    while (mesh.locations[v].dimension != dimension) ++v;
    return v;
  };
  const auto finds = [&mesh](const std::string& text) {
    const weft::Validity_3 validity = weft::validate_3(mesh);
    return finds_only(validity, Kind::location) && mentions(validity, text);
  };
  SECTION("a corner that isn't listed")
  {
    mesh.corners.pop_back();
    CHECK(finds("a feature vertex isn't listed as corner"));
  }
  SECTION("corners out of order")
  {
    std::swap(mesh.corners[0], mesh.corners[1]);
    CHECK(finds("a corner is out of order or there twice"));
  }
  SECTION("a corner that is none")
  {
    mesh.corners.push_back(vertex_of(3));
    CHECK(finds("a corner isn't a feature vertex"));
  }
  SECTION("a gap in a crease")
  {
    mesh.edges.pop_back();
    mesh.creases.pop_back();
    CHECK(finds("a vertex on a crease has 1 crease edges"));
  }
  SECTION("an edge of another crease")
  {
    mesh.creases[0] = (mesh.creases[0] + 1) % 12;
    CHECK(finds("a crease edge ends on another crease"));
  }
  SECTION("a crease edge inside")
  {
    const std::size_t v = vertex_of(3);
    for (const auto& cell : mesh.cells)
      if (std::find(cell.begin(), cell.end(), v) != cell.end()) {
        mesh.edges.push_back({v, cell[0] == v ? cell[1] : cell[0]});
        break;
      }
    mesh.creases.push_back(0);
    CHECK(finds("a crease edge isn't on the boundary"));
  }
  SECTION("a vertex inside that says it is on a patch")
  {
    mesh.locations[vertex_of(3)] = {2, 0};
    CHECK(finds("a vertex of the surface has no boundary facet"));
  }
  SECTION("a vertex on a patch that says it is inside")
  {
    mesh.locations[vertex_of(2)] = {3, 1};
    CHECK(finds("a vertex inside is on the boundary"));
  }
  SECTION("a vertex inside of another subdomain")
  {
    mesh.locations[vertex_of(3)] = {3, 2};
    CHECK(finds("a vertex inside has a cell of another subdomain"));
  }
  SECTION("a wrong patch is a fault of topology")
  {
    std::size_t f = 0;
    while (mesh.patches[f] != 0) ++f;
    // Where some corner of the facet is within the patch.
    const auto on_patch = [&](std::size_t v) { return mesh.locations[v].dimension == 2; };
    while (mesh.patches[f] != 0 || std::none_of(mesh.facets[f].begin(), mesh.facets[f].end(), on_patch)) ++f;
    mesh.patches[f] = 3;
    CHECK(finds_only(weft::check_topology_3(mesh), Kind::topology));
  }
  SECTION("a crease edge of a vertex on a patch is a fault of topology")
  {
    std::size_t v = mesh.edges[0][0];
    if (mesh.locations[v].dimension != 1) v = mesh.edges[0][1];
    mesh.locations[v] = {2, 0};
    CHECK(mentions(weft::check_topology_3(mesh), "a crease edge has an end off its crease"));
  }
}

TEST_CASE("faults beyond the hundredth of a kind are counted, not listed")
{
  Mesh mesh = ball(200, 200).mesh;
  for (auto& location : mesh.locations)
    if (location.dimension == 3) location.index = 2;
  const weft::Validity_3 validity = weft::validate_3(mesh);
  CHECK(validity.faults.size() == 100);
  CHECK(validity.count(Kind::location) > 100);
  CHECK(mentions(validity, "location: " + std::to_string(validity.count(Kind::location)) + " faults in all"));
}

TEST_CASE("edges, facets and cells that miss the criteria are found, those at the bound aren't")
{
  const Mesh mesh = regular_tetrahedron(1);
  weft::Criteria_3<K> criteria;
  criteria.size = 1;
  criteria.facet_shape = 1; // 0.577 at best: holds
  criteria.cell_shape = 1;
  CHECK(weft::check_criteria_3(mesh, criteria).ok());
  CHECK(weft::check_sizes_3(mesh, weft::Length_field_3<K>(0.999)).count(Kind::size) == 6);
  // A field that is coarse but near one edge's midpoint.
  const Point m = CGAL::midpoint(mesh.points[1], mesh.points[3]);
  const weft::Length_field_3<K> field([m](const Point& p) { return CGAL::squared_distance(p, m) < 1e-6 ? 0.5 : 2; });
  const weft::Validity_3 one = weft::check_sizes_3(mesh, field);
  REQUIRE(one.count(Kind::size) == 1);
  CHECK(one.faults[0].vertices == std::vector<std::size_t>{1, 3});
  CHECK(weft::check_shapes_3(mesh, 1 / std::sqrt(3.), std::sqrt(6.) / 4).ok());
  CHECK(weft::check_shapes_3(mesh, 0.577, 0).count(Kind::shape) == 4);
  CHECK(weft::check_shapes_3(mesh, 0, 0.612).count(Kind::shape) == 1);
  const Mesh flat = single_cell(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0));
  CHECK(weft::check_shapes_3(flat, 2, 2).count(Kind::shape) == 1);
}

TEST_CASE("vertices off their patch, crease or feature are found")
{
  Mesh mesh = box(4).mesh;
  const Cube_oracle oracle{4};
  CHECK(weft::check_distances_3(mesh, oracle).ok());
  weft::Piecewise_smooth_complex_3<K> complex;
  for (std::size_t i = 0; i < 8; ++i) {
    complex.points.push_back(mesh.points[mesh.corners[i]]);
    complex.features.push_back({i, weft::Feature_kind::corner});
  }
  CHECK(weft::check_features_3(mesh, complex).ok());
  std::size_t on_patch = 0, on_crease = 0;
  while (mesh.locations[on_patch].dimension != 2 || mesh.locations[on_patch].index != 0) ++on_patch;
  while (mesh.locations[on_crease].dimension != 1) ++on_crease;
  Mesh moved = mesh;
  moved.points[on_patch] = mesh.points[on_patch] + K::Vector_3(1e-6, 0, 0);
  moved.points[on_crease] = mesh.points[on_crease] + K::Vector_3(1e-6, 1e-6, 1e-6);
  const weft::Validity_3 validity = weft::check_distances_3(moved, oracle);
  CHECK(finds_only(validity, Kind::distance));
  CHECK(validity.count(Kind::distance) == 2);
  CHECK(weft::check_distances_3(moved, oracle, 1e-5).ok());

  moved = mesh;
  moved.points[mesh.corners[3]] = mesh.points[mesh.corners[3]] + K::Vector_3(0, 1e-15 * 4, 0);
  moved.points[mesh.corners[3]] = Point(0, 4.000000001, 4);
  CHECK(weft::check_features_3(moved, complex).count(Kind::distance) == 1);
  moved = mesh;
  moved.corners.pop_back();
  CHECK(mentions(weft::check_features_3(moved, complex), "feature vertex 7 of the domain is missing"));
}

TEST_CASE("the Hausdorff distance of two surfaces is found from both sides")
{
  // A cube against itself, and against a cube with a pyramid of height 1 on top of one face.
  const Mesh mesh = box(2).mesh;
  const weft::Hausdorff_3 zero = weft::hausdorff_3(mesh, mesh.points, mesh.facets, 1000);
  CHECK(zero.two_sided() < 1e-12);
  std::vector<Point> points = mesh.points;
  std::vector<std::array<std::size_t, 3>> triangles = mesh.facets;
  for (Point& p : points)
    if (p == Point(2, 1, 1)) p = Point(3, 1, 1);
  const weft::Hausdorff_3 spike = weft::hausdorff_3(mesh, points, triangles, 20000);
  CHECK(spike.surface_to_mesh == Approx(1).epsilon(1e-12));
  CHECK(spike.mesh_to_surface == Approx(1 / std::sqrt(3.)).epsilon(1e-9)); // from the vertex to the pyramid's sides
  CHECK(spike.two_sided() == spike.surface_to_mesh);
  CHECK(spike.mean_surface_to_mesh > 0);
  CHECK(spike.mean_surface_to_mesh < 0.2);
  const weft::Hausdorff_3 again = weft::hausdorff_3(mesh, points, triangles, 20000);
  CHECK(again.mean_mesh_to_surface == spike.mean_mesh_to_surface);

  // The inscribed polyhedron of a sphere: the farthest points are circumcenters of facets.
  const Mesh round = ball(500, 10).mesh;
  double farthest = 0;
  for (const auto& f : round.facets)
    farthest = std::max(
        farthest, 1 - std::sqrt(CGAL::squared_distance(
                          Point(0, 0, 0), K::Plane_3(round.points[f[0]], round.points[f[1]], round.points[f[2]]))));
  const Mesh fine = ball(20000, 0).mesh;
  const weft::Hausdorff_3 sphere = weft::hausdorff_3(round, fine.points, fine.facets, 50000);
  CHECK(sphere.two_sided() == Approx(farthest).epsilon(0.1));
  CHECK_THROWS_AS(weft::hausdorff_3(Mesh(), points, triangles), weft::Option_error);
}
