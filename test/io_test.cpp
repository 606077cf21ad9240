// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the planar readers and writers: what is written reads back bit for bit, tags survive, and a broken
// file is refused with its line, wherever it is broken.

#include <weft/IO/read_pslg.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/planar/graph/insert_pslg.h>

#include <catch2/catch.hpp>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;
using Point = K::Point_2;

/// A file in the working directory that is removed at the end.
class Temporary_file
{
public:
  explicit Temporary_file(std::string name, const std::string& text = "") : name_("io_test_" + std::move(name))
  {
    if (!text.empty()) std::ofstream(name_, std::ios::binary) << text;
  }
  ~Temporary_file() { std::remove(name_.c_str()); }
  const std::string& name() const { return name_; }

private:
  std::string name_;
};

Pslg read(const std::string& extension, const std::string& text)
{
  const Temporary_file file("input." + extension, text);
  if (text.empty()) std::ofstream(file.name(), std::ios::binary);
  return weft::IO::read_pslg<K>(file.name());
}

/// Line that the reader complains about.
std::size_t refused_at(const std::string& extension, const std::string& text)
{
  try {
    read(extension, text);
  } catch (const weft::File_error& error) {
    CHECK(std::string(error.what()).find("input." + extension) != std::string::npos);
    return error.line();
  }
  FAIL("was not refused: " << text);
  return 0;
}

const std::string square_poly = "# a square with a hole and a region\n"
                                "5 2 1 1 # counts\n"
                                "1 0 0 7.5 10\n"
                                "\n"
                                "2 1 0 7.5 20\r\n"
                                "3 1 1 -1e-3 30\n"
                                "4 0 1 0 40\n"
                                "5 .5 +0.25 0 50\n"
                                "4 1\n"
                                "1 1 2 11\n2 2 3 12\n3 3 4 13\n4 4 1 14\n"
                                "1\n1 0.125 0.875\n"
                                "1\n1 0.75 0.75 3 0.1\n";

const std::string triangle_edg = "3\n0 0 1 0\n1 0 0.25 1\n0.25 1 0 0\n";

const std::string triangle_obj = "o triangle # named\nv 0 0 5\nv 1 0 5\nv 0.25 1 5\nl 1 2 3 -3\nvt 0 0\ns off\n";

Pslg two_squares()
{
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0.3, 1. / 3}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}, {1, 4}};
  pslg.segment_markers = {5, 5, 6, 7, 7, 8, 9};
  pslg.regions = {{{0.5, 0.5}, 21}, {{1.5, 0.5}, 22}};
  return pslg;
}

/// The two squares, refined by CGAL.
struct Refined
{
  Cdt cdt;
  weft::Mesh_tags_2<K> tags;
  std::size_t vertices, faces = 0, constraints = 0;

  explicit Refined(const Pslg& pslg = two_squares(), double size = 0.2)
  {
    tags = weft::insert_pslg(cdt, pslg).tags;
    weft::mark_domain(cdt, pslg);
    using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;
    CGAL::Delaunay_mesher_2<Cdt, Criteria>(cdt, Criteria(0.125, size)).refine_mesh();
    vertices = cdt.number_of_vertices();
    for (const auto face : cdt.finite_face_handles()) faces += face->is_in_domain();
    constraints = std::distance(cdt.constrained_edges_begin(), cdt.constrained_edges_end());
  }
};

std::string contents(const std::string& name)
{
  std::ifstream in(name, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Input marker of an edge of the two squares between two points, by geometry.
int expected_marker(const std::array<double, 2>& p, const std::array<double, 2>& q)
{
  const double x = (p[0] + q[0]) / 2, y = (p[1] + q[1]) / 2;
  return y == 0 ? 5 : x == 2 ? 6 : y == 1 ? 7 : x == 0 ? 8 : x == 1 ? 9 : -1;
}

int expected_region(double x)
{
  return x < 1 ? 21 : 22;
}

/// Moves a stream behind the next line that is exactly `keyword`.
void skip_to(std::istream& in, const std::string& keyword)
{
  std::string line;
  while (std::getline(in, line))
    if (line == keyword) return;
  FAIL("no " << keyword);
}

std::multiset<std::array<double, 2>> coordinates(const Cdt& cdt)
{
  std::multiset<std::array<double, 2>> result;
  for (const auto vertex : cdt.finite_vertex_handles()) result.insert({vertex->point().x(), vertex->point().y()});
  return result;
}

} // namespace

TEST_CASE("a poly file is read with everything in it")
{
  const Pslg pslg = read("poly", square_poly);
  CHECK(pslg.points == std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.25}});
  CHECK(pslg.point_markers == std::vector<int>{10, 20, 30, 40, 50});
  REQUIRE(pslg.segments.size() == 4);
  CHECK(pslg.segments[3] == std::array<std::size_t, 2>{3, 0});
  CHECK(pslg.segment_markers == std::vector<int>{11, 12, 13, 14});
  CHECK(pslg.holes == std::vector<Point>{{0.125, 0.875}});
  REQUIRE(pslg.regions.size() == 1);
  CHECK(pslg.regions[0].marker == 3);
  CHECK(pslg.regions[0].point == Point(0.75, 0.75));
}

TEST_CASE("a poly file without points takes them from the node file beside it")
{
  const Temporary_file node("beside.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
  const Temporary_file poly("beside.poly", "0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n");
  const Pslg pslg = weft::IO::read_pslg<K>(poly.name());
  CHECK(pslg.points.size() == 3);
  CHECK(pslg.segments.size() == 3);
  CHECK(weft::IO::read_pslg<K>(node.name()).points == pslg.points);
  const Temporary_file lonely("lonely.poly", "0 2 0 0\n0 0\n0\n");
  CHECK_THROWS_WITH(weft::IO::read_pslg<K>(lonely.name()), Catch::Contains("lonely.node"));
}

TEST_CASE("an edg file merges equal points in the order of their first appearance")
{
  const Pslg pslg = read("edg", triangle_edg);
  CHECK(pslg.points == std::vector<Point>{{0, 0}, {1, 0}, {0.25, 1}});
  CHECK(pslg.segments == std::vector<std::array<std::size_t, 2>>{{0, 1}, {1, 2}, {2, 0}});
}

TEST_CASE("an obj file gives polylines, with indices from either end")
{
  const Pslg pslg = read("obj", triangle_obj);
  CHECK(pslg.points == std::vector<Point>{{0, 0}, {1, 0}, {0.25, 1}});
  CHECK(pslg.segments == std::vector<std::array<std::size_t, 2>>{{0, 1}, {1, 2}, {2, 0}});
}

TEST_CASE("a broken file is refused with its line")
{
  CHECK_THROWS_AS(weft::IO::read_pslg<K>("no_such_file.poly"), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_pslg<K>("."), weft::File_error);
  CHECK_THROWS_AS(weft::IO::read_poly<K>("."), weft::File_error);
  CHECK_THROWS_AS(read("xyz", "1\n"), weft::File_error);
  CHECK(refused_at("poly", "") == 0);
  const std::string points = "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n";
  for (const std::string x : {"nan", "inf", "-inf", "1e999", "1,5", "x", "0x10", "1.5.2", "--1"})
    CHECK(refused_at("poly", "3 2 0 0\n0 0 0\n1 " + x + " 0\n2 0 1\n0\n0\n") == 3);
  CHECK(refused_at("poly", "-3 2 0 0\n") == 1);
  CHECK(refused_at("poly", "3 3 0 0\n") == 1);
  CHECK(refused_at("poly", "3 2 0 2\n") == 1);
  CHECK(refused_at("poly", "3 2 0 0 junk\n" + points) == 1);
  CHECK(refused_at("poly", "4000000000000 2 0 0\n0 0 0\n") == 1);
  CHECK(refused_at("poly", "99999999999999999999 2 0 0\n0 0 0\n") == 1);
  CHECK(refused_at("poly", "3 2 0 0\n0 0 0\n2 1 0\n3 0 1\n0\n0\n") == 3);
  CHECK(refused_at("poly", "1 2 0 0\n5 0 0\n0\n0\n") == 2);
  CHECK(refused_at("poly", points + "1 0\n0 0 3\n0\n") == 6);
  CHECK(refused_at("poly", points + "1 0\n0 -1 2\n0\n") == 6);
  CHECK(refused_at("poly", points + "1 0\n0 0 1.5\n0\n") == 6);
  CHECK(refused_at("poly", points + "-1 0\n0\n") == 5);
  CHECK(refused_at("poly", points + "1000000 0\n0 0 1\n0\n") == 5);
  CHECK(refused_at("poly", points + "1 0\n0 0 1 9\n0\n") == 6);
  CHECK(refused_at("poly", points + "1 1\n0 0 1 99999999999\n0\n") == 6);
  CHECK(refused_at("poly", points + "1 0\n0 0 1\n-1\n") == 7);
  CHECK(refused_at("poly", points + "1 0\n0 0 1\n0\n0\nmore\n") == 9);
  CHECK(refused_at("edg", "2\n0 0 1 0\n") == 1);
  CHECK(refused_at("edg", "1\n0 0 1\n\n\n\n") == 2);
  CHECK(refused_at("edg", "1\n0 0 1 nan\n") == 2);
  CHECK(refused_at("edg", "1\n0 0 1 1\n0 0 2 2\n") == 3);
  CHECK(refused_at("edg", "-1\n") == 1);
  CHECK(refused_at("obj", "v 0 0\nl 1 2\n") == 2);
  CHECK(refused_at("obj", "v 0 0\nv 1 0\nl 0 1\n") == 3);
  CHECK(refused_at("obj", "v 0 0\nv 1 0\nl -3 1\n") == 3);
  CHECK(refused_at("obj", "v 0 0\nv 1 0\nl 1\n") == 3);
  CHECK(refused_at("obj", "v 0\n") == 1);
  CHECK(refused_at("obj", "hello\n") == 1);
}

TEST_CASE("a file cut at any byte is refused or is a beginning of the whole")
{
  const auto is_prefix = [](const auto& part, const auto& whole) {
    return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
  };
  for (const auto& [extension, text] : {std::make_pair("poly", square_poly), std::make_pair("edg", triangle_edg),
                                        std::make_pair("obj", triangle_obj)}) {
    const Pslg whole = read(extension, text);
    for (std::size_t length = 0; length < text.size(); ++length) {
      Pslg part;
      try {
        part = read(extension, text.substr(0, length));
      } catch (const weft::File_error&) {
        continue;
      }
      INFO(extension << " cut after " << length << " bytes");
      CHECK(length > 0);
      // A cut inside the last word of a line can only be seen if a line's end must follow it; such a file may be read
      // with that one number shortened, so whole lines are what is compared.
      const bool at_line_end = text[length] == '\n' || text[length] == '\r' || text[length - 1] == '\n';
      if (at_line_end) {
        CHECK(is_prefix(part.points, whole.points));
        CHECK(is_prefix(part.segments, whole.segments));
        CHECK(is_prefix(part.holes, whole.holes));
      }
      if (std::string(extension) != "obj") { // the formats with counts
        CHECK(part.points.size() == whole.points.size());
        CHECK(part.segments.size() == whole.segments.size());
        CHECK(part.holes.size() == whole.holes.size());
      }
    }
  }
}

TEST_CASE("arbitrary bytes are refused, not crashed on")
{
  unsigned state = 1;
  for (int round = 0; round < 300; ++round) {
    std::string text = square_poly;
    for (int i = 0; i < 3; ++i) {
      state = state * 1664525u + 1013904223u;
      text[(state >> 8) % text.size()] = static_cast<char>(state >> 24);
    }
    for (const char* extension : {"poly", "node", "edg", "obj"}) {
      try {
        read(extension, text);
      } catch (const weft::File_error&) {
      }
    }
  }
}

TEST_CASE("off files hold the mesh bit for bit")
{
  const Refined mesh;
  const Temporary_file file("mesh.off");
  weft::IO::write_mesh_2(file.name(), mesh.cdt);
  std::ifstream in(file.name());
  std::string word;
  std::size_t vertices, faces, zero;
  in >> word >> vertices >> faces >> zero;
  CHECK(word == "OFF");
  CHECK(vertices == mesh.vertices);
  CHECK(faces == mesh.faces);
  std::vector<Point> points;
  std::multiset<std::array<double, 2>> read_back;
  for (std::size_t i = 0; i < vertices; ++i) {
    double x, y, z;
    in >> x >> y >> z;
    points.emplace_back(x, y);
    read_back.insert({x, y});
  }
  CHECK(read_back == coordinates(mesh.cdt));
  for (std::size_t i = 0; i < faces; ++i) {
    std::size_t n, a, b, c;
    in >> n >> a >> b >> c;
    REQUIRE(std::max({a, b, c}) < points.size());
    CHECK(CGAL::left_turn(points[a], points[b], points[c]));
  }
  CHECK(bool(in));
}

TEST_CASE("medit files keep points, segment marks, region marks and input vertices")
{
  const Refined mesh;
  const Temporary_file file("mesh.mesh");
  weft::IO::write_mesh_2(file.name(), mesh.cdt, mesh.tags);
  std::ifstream in(file.name());
  std::size_t n;
  skip_to(in, "Vertices");
  in >> n;
  CHECK(n == mesh.vertices);
  std::vector<std::array<double, 2>> points(n);
  int reference;
  for (auto& p : points) in >> p[0] >> p[1] >> reference;
  CHECK(std::multiset<std::array<double, 2>>(points.begin(), points.end()) == coordinates(mesh.cdt));
  skip_to(in, "Edges");
  in >> n;
  CHECK(n == mesh.constraints);
  for (std::size_t i = 0, a, b; i < n; ++i) {
    in >> a >> b >> reference;
    CHECK(reference == expected_marker(points.at(a - 1), points.at(b - 1)));
  }
  skip_to(in, "Triangles");
  in >> n;
  CHECK(n == mesh.faces);
  for (std::size_t i = 0, a, b, c; i < n; ++i) {
    in >> a >> b >> c >> reference;
    CHECK(reference == expected_region((points.at(a - 1)[0] + points.at(b - 1)[0] + points.at(c - 1)[0]) / 3));
  }
  skip_to(in, "RequiredVertices");
  in >> n;
  CHECK(n == 7);
  CHECK(bool(in));
}

TEST_CASE("gmsh files are consistent and keep all tags")
{
  const Refined mesh;
  const Temporary_file file("mesh.msh");
  weft::IO::write_mesh_2(file.name(), mesh.cdt, mesh.tags);
  std::ifstream in(file.name());
  std::string text;
  std::size_t counts[4];
  skip_to(in, "$MeshFormat");
  std::getline(in, text);
  CHECK(text == "4.1 0 8");
  skip_to(in, "$Entities");
  for (std::size_t& n : counts) in >> n;
  CHECK(counts[0] == 7);
  CHECK(counts[1] == 7);
  CHECK(counts[2] == 2);
  CHECK(counts[3] == 0);
  std::map<std::pair<int, int>, int> physical;
  for (int dimension = 0; dimension < 3; ++dimension)
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      int tag, groups, group = 0, bounds = 0;
      double skip;
      in >> tag;
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in >> skip;
      in >> groups;
      for (int k = 0; k < groups; ++k) in >> group;
      if (dimension > 0) in >> bounds;
      CHECK(bounds == 0);
      CHECK(physical.emplace(std::make_pair(dimension, tag), group).second);
    }
  skip_to(in, "$Nodes");
  std::size_t blocks, total, lowest, highest;
  in >> blocks >> total >> lowest >> highest;
  CHECK(total == mesh.vertices);
  std::map<std::size_t, std::array<double, 2>> points;
  for (std::size_t b = 0; b < blocks; ++b) {
    int dimension, tag, parametric;
    std::size_t n;
    in >> dimension >> tag >> parametric >> n;
    CHECK(physical.count({dimension, tag}) == 1);
    std::vector<std::size_t> numbers(n);
    double z;
    for (auto& i : numbers) in >> i;
    for (auto& i : numbers) in >> points[i][0] >> points[i][1] >> z;
  }
  CHECK(points.size() == total);
  CHECK(points.begin()->first == lowest);
  CHECK(points.rbegin()->first == highest);
  skip_to(in, "$Elements");
  in >> blocks >> total >> lowest >> highest;
  CHECK(total == mesh.faces + mesh.constraints);
  std::size_t seen = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    int dimension, tag, type;
    std::size_t n, number, node;
    in >> dimension >> tag >> type >> n;
    CHECK(type == dimension);
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<std::array<double, 2>> corners;
      in >> number;
      CHECK(number == ++seen);
      for (int k = 0; k <= dimension; ++k) in >> node, corners.push_back(points.at(node));
      const int group = physical.at({dimension, tag});
      if (dimension == 1)
        CHECK(group == expected_marker(corners[0], corners[1]));
      else
        CHECK(group == expected_region((corners[0][0] + corners[1][0] + corners[2][0]) / 3));
    }
  }
  CHECK(seen == total);
  in >> text;
  CHECK(text == "$EndElements");
}

TEST_CASE("vtu files hold triangles and constraints with their data")
{
  const Refined mesh;
  const Temporary_file file("mesh.vtu");
  weft::IO::write_vtu(file.name(), mesh.cdt, mesh.tags, weft::Vtu_encoding::ascii);
  const std::string text = contents(file.name());
  const auto array = [&text](const std::string& name) {
    const std::size_t begin = text.find('>', text.find("Name=\"" + name + "\"")) + 1;
    std::istringstream in(text.substr(begin, text.find('<', begin) - begin));
    return std::vector<double>(std::istream_iterator<double>(in), std::istream_iterator<double>());
  };
  const std::size_t cells = mesh.faces + mesh.constraints;
  CHECK(text.find("NumberOfCells=\"" + std::to_string(cells) + "\"") != std::string::npos);
  const auto points = array("Points"), connectivity = array("connectivity"), types = array("types");
  const auto domain = array("domain"), marker = array("marker"), segment = array("segment"), ends = array("offsets");
  REQUIRE(points.size() == 3 * mesh.vertices);
  REQUIRE(connectivity.size() == 3 * mesh.faces + 2 * mesh.constraints);
  for (const auto* data : {&types, &domain, &marker, &segment, &ends}) REQUIRE(data->size() == cells);
  for (std::size_t c = 0, at = 0; c < cells; at = static_cast<std::size_t>(ends[c++])) {
    const auto corner = [&](std::size_t k) {
      const std::size_t v = static_cast<std::size_t>(connectivity.at(at + k));
      return std::array<double, 2>{points.at(3 * v), points.at(3 * v + 1)};
    };
    if (types[c] == 5) {
      CHECK(domain[c] == expected_region((corner(0)[0] + corner(1)[0] + corner(2)[0]) / 3));
      CHECK(segment[c] == -1);
    } else {
      CHECK(types[c] == 3);
      CHECK(marker[c] == expected_marker(corner(0), corner(1)));
      CHECK(two_squares().segment_markers.at(static_cast<std::size_t>(segment[c])) == marker[c]);
    }
  }
}

TEST_CASE("a mesh without marks numbers its segments, and what lies outside the domain isn't written")
{
  Pslg pslg = two_squares();
  pslg.segment_markers.clear();
  pslg.regions.clear();
  pslg.points.emplace_back(5, 5); // an isolated point outside
  const Refined mesh(pslg, 0);
  const Temporary_file file("plain.mesh");
  weft::IO::write_medit(file.name(), mesh.cdt, mesh.tags);
  std::ifstream in(file.name());
  std::size_t n;
  skip_to(in, "Vertices");
  in >> n;
  CHECK(n == mesh.vertices - 1);
  skip_to(in, "Edges");
  in >> n;
  std::set<int> references;
  for (std::size_t i = 0, a, b; i < n; ++i) {
    int reference;
    in >> a >> b >> reference;
    references.insert(reference);
  }
  CHECK(references == std::set<int>{1, 2, 3, 4, 5, 6, 7});
}

TEST_CASE("a mesh refined and copied keeps its tags, whatever vertices it has")
{
  using Plain = CGAL::Constrained_Delaunay_triangulation_2<
      K,
      CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<K>, CGAL::Delaunay_mesh_face_base_2<K>>>;
  Plain cdt;
  const auto tags = weft::insert_pslg(cdt, two_squares()).tags;
  weft::mark_domain_by_parity(cdt);
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Plain>;
  CGAL::Delaunay_mesher_2<Plain, Criteria>(cdt, Criteria(0.125, 0.1)).refine_mesh();
  const Plain copy = cdt;
  std::size_t n = 0;
  for (const auto& [edge, segment] : tags.constraints.constrained_edges(copy)) {
    const Point p = copy.segment(edge).source(), q = copy.segment(edge).target();
    CHECK(tags.constraints.marker(segment) == expected_marker({p.x(), p.y()}, {q.x(), q.y()}));
    CHECK(tags.constraints.segment(copy, edge.first, edge.second) == segment);
    ++n;
  }
  CHECK(n > 60);
}

TEST_CASE("a failing write is an error")
{
  const Refined mesh;
  for (const char* extension : {"off", "mesh", "msh", "vtu", "svg"}) {
    CHECK_THROWS_AS(weft::IO::write_mesh_2(std::string("no/such/folder/mesh.") + extension, mesh.cdt),
                    weft::File_error);
  }
  CHECK_THROWS_AS(weft::IO::write_mesh_2("mesh.xyz", mesh.cdt), weft::File_error);
  if (std::ifstream("/dev/full")) {
    CHECK_THROWS_AS(weft::IO::write_off("/dev/full", mesh.cdt), weft::File_error);
    CHECK_THROWS_AS(weft::IO::write_gmsh("/dev/full", mesh.cdt), weft::File_error);
    CHECK_THROWS_AS(weft::IO::write_svg("/dev/full", mesh.cdt), weft::File_error);
    CHECK_THROWS_AS(weft::IO::write_medit("/dev/full", mesh.cdt), weft::File_error);
    CHECK_THROWS_AS(weft::IO::write_vtu("/dev/full", mesh.cdt), weft::File_error);
  }
}

TEST_CASE("numbers are written so that they read back the same")
{
  const Temporary_file file("numbers.txt");
  const std::vector<double> numbers = {1. / 3, 0.1, -1e-300, 5e-324, 1.7976931348623157e308, 123456789.123456789,
                                       -0.,    1e22};
  weft::internal::Text_writer out(file.name());
  for (const double x : numbers) out << x << '\n';
  out.close();
  weft::internal::Line_reader in(file.name());
  for (const double x : numbers) {
    REQUIRE(in.next_line());
    CHECK(in.number("x") == x);
  }
}

TEST_CASE("pictures are drawn for every mesh, also for large, tiny and empty ones")
{
  const Temporary_file file("picture.svg");
  for (const double scale : {1., 1e150, 1e-150}) {
    Pslg pslg = two_squares();
    for (Point& p : pslg.points) p = Point(scale * p.x(), scale * p.y());
    const Refined mesh(pslg, 0);
    weft::IO::write_svg(file.name(), mesh.cdt, "<&>");
    const std::string text = contents(file.name());
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("inf") == std::string::npos);
    CHECK(text.find("&lt;&amp;&gt;") != std::string::npos);
    CHECK(text.rfind("</svg>\n") == text.size() - 7);
    const weft::Angle_histogram histogram = weft::IO::angle_histogram(mesh.cdt);
    CHECK(histogram.total() == 3 * mesh.faces);
    CHECK(histogram.smallest > 0);
  }
  weft::IO::write_svg(file.name(), Cdt());
  weft::IO::write_angle_histogram_svg(file.name(), weft::Angle_histogram("none"));
  weft::IO::write_voronoi_svg<Point>(file.name(), {});
  weft::IO::write_voronoi_svg<Point>(file.name(), {{{0, 0}, {1, 0}, {1, 1}}, {}}, {{0.5, 0.3}},
                                     {{Point(0, 0), Point(1, 0)}});
  CHECK(contents(file.name()).find("circle") != std::string::npos);
}
