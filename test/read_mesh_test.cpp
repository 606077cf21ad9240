// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of what brings tetrahedral meshes in: files of all formats, arrays and C3t3s come back as they were
// written, and what isn't a mesh is refused with the element and the line to blame.

#include "fixtures/spatial_fixtures.h"

#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/spatial/cgal/from_c3t3.h>
#include <weft/spatial/cgal/to_c3t3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using fixtures::K;
using fixtures::Mesh;
using fixtures::Point;
using Soup = weft::Element_soup_3<K>;

/// A file that goes with the test case.
class File
{
public:
  explicit File(const std::string& name, const std::string& text = "")
      : name_((std::filesystem::temp_directory_path() / ("weft_read_mesh_test_" + name)).string())
  {
    if (!text.empty()) std::ofstream(name_, std::ios::binary) << text;
  }
  ~File() { std::filesystem::remove(name_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& name() const { return name_; }

private:
  std::string name_;
};

std::string error_of(const std::string& filename)
{
  try {
    weft::IO::read_tetrahedral_mesh<K>(filename);
  } catch (const weft::File_error& error) {
    return error.what();
  }
  return "";
}

std::string error_of(Soup soup)
{
  try {
    weft::assemble_mesh_3(std::move(soup));
  } catch (const weft::Domain_error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// An element by the coordinates of its vertices, in lexicographic order, with its tag.
template <std::size_t N>
std::multiset<std::pair<std::vector<Point>, int>>
by_points(const Mesh& mesh, const std::vector<std::array<std::size_t, N>>& elements, const std::vector<int>& tags)
{
  std::multiset<std::pair<std::vector<Point>, int>> result;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::vector<Point> points;
    for (const std::size_t v : elements[e]) points.push_back(mesh.points[v]);
    std::sort(points.begin(), points.end());
    result.emplace(points, tags[e]);
  }
  return result;
}

void check_same(const Mesh& a, const Mesh& b)
{
  CHECK(by_points(a, a.cells, a.subdomains) == by_points(b, b.cells, b.subdomains));
  CHECK(by_points(a, a.facets, a.patches) == by_points(b, b.facets, b.patches));
  CHECK(by_points(a, a.edges, a.creases) == by_points(b, b.edges, b.creases));
  REQUIRE(a.corners.size() == b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i) CHECK(a.points[a.corners[i]] == b.points[b.corners[i]]);
  std::set<std::pair<Point, std::pair<int, int>>> at_a, at_b;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    at_a.insert({a.points[v], {a.locations[v].dimension, a.locations[v].index}});
  for (std::size_t v = 0; v < b.points.size(); ++v)
    at_b.insert({b.points[v], {b.locations[v].dimension, b.locations[v].index}});
  CHECK(at_a == at_b);
}

Soup two_cells()
{
  Soup soup;
  soup.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), Point(0, 0, -1)};
  soup.cells = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  return soup;
}

const std::string medit_head = "MeshVersionFormatted 2\nDimension\n3\n";
const std::string medit_points = "Vertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n";

const std::string gmsh_2 =
    "$MeshFormat\n2.000000 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"a # b\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 0 0 -1\n$EndNodes\n"
    "$Elements\n4\n1 15 2 0 1 10\n2 2 2 5 1 10 30 40\n3 4 2 7 1 10 20 30 40\n4 4 2 7 1 10 20 30 50\n$EndElements\n";

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers, bool long_header)
{
  const std::uint64_t size = numbers.size() * sizeof(Number);
  std::string bytes(long_header ? 8 : 4, '\0');
  std::memcpy(&bytes[0], &size, bytes.size());
  const std::size_t begin = bytes.size();
  bytes.resize(begin + size);
  std::memcpy(&bytes[begin], numbers.data(), size);
  return bytes;
}

std::string base64(const std::string& bytes)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

const std::vector<float> vtu_points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1};
const std::vector<std::int64_t> vtu_connectivity = {0, 1, 2, 3, 0, 1, 2, 4};
const std::vector<std::int32_t> vtu_offsets = {4, 8};
const std::vector<std::uint8_t> vtu_types = {10, 10};

/// A grid of two cells whose arrays are written by `array(type, name, numbers)`.
template <class Array>
std::string vtu(const std::string& attributes, const Array& array, const std::string& rest = "")
{
  return "<?xml version=\"1.0\"?>\n<!-- made <by hand> -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" " +
         attributes + ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<Points>\n" +
         array("Float32", "Points", vtu_points) + "</Points>\n<Cells>\n" +
         array("Int64", "connectivity", vtu_connectivity) + array("Int32", "offsets", vtu_offsets) +
         array("UInt8", "types", vtu_types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n" + rest + "</VTKFile>\n";
}

} // namespace

// ---- round trips

TEST_CASE("names of subdomains and patches are in the files that have some, and don't disturb reading")
{
  const auto two = fixtures::box(2, true);
  weft::Mesh_names_3 names;
  names.subdomains = {{1, "bone \"a\""}, {2, "soft tissue"}};
  names.patches = {{0, "skin"}};
  for (const std::string extension : {"mesh", "vtu", "msh"}) {
    const File file("named." + extension);
    weft::IO::write_mesh_3(file.name(), two.mesh, names);
    check_same(weft::IO::read_tetrahedral_mesh<K>(file.name()).mesh, two.mesh);
    std::ifstream in(file.name());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (extension == "msh")
      CHECK(
          contains(text, "$PhysicalNames\n3\n2 1 \"skin\"\n3 1 \"bone 'a'\"\n3 2 \"soft tissue\"\n$EndPhysicalNames"));
    if (extension == "vtu") {
      CHECK(contains(text, "Name=\"named_subdomains\" NumberOfTuples=\"2\" format=\"ascii\">\n1\n2\n"));
      CHECK(contains(text, "Name=\"patch_names\" NumberOfTuples=\"1\" format=\"ascii\">\n115 107 105 110 0\n"));
    }
  }
}

TEST_CASE("what weft writes comes back with all tags from every format")
{
  const auto box = fixtures::box(2), two = fixtures::box(2, true), ball = fixtures::ball(400, 40);
  for (const std::string extension : {"mesh", "vtu", "msh"})
    for (const Mesh* mesh : {&box.mesh, &two.mesh, &ball.mesh}) {
      const File file("round_trip." + extension);
      weft::IO::write_mesh_3(file.name(), *mesh);
      const auto read = weft::IO::read_tetrahedral_mesh<K>(file.name());
      CAPTURE(extension);
      CHECK(read.notes.empty());
      CHECK(read.inverted_cells == 0);
      CHECK(read.mesh.points == mesh->points);
      CHECK(weft::validate_3(read.mesh).ok() == weft::validate_3(*mesh).ok());
      check_same(read.mesh, *mesh);
    }
}

TEST_CASE("a C3t3 made of a mesh gives that mesh back")
{
  const auto box = fixtures::box(2, true);
  const auto back = weft::from_c3t3(weft::to_c3t3(box.triangulation, box.mesh));
  CHECK(back.notes.empty());
  check_same(back.mesh, box.mesh);
}

TEST_CASE("points and cells in arrays are enough for a mesh")
{
  const Soup soup = two_cells();
  const auto result = weft::assemble_mesh_3(soup.points, soup.cells);
  CHECK(result.mesh.facets.size() == 6);
  CHECK(result.mesh.subdomains == std::vector<int>{1, 1});
  CHECK(weft::check_structure_3(result.mesh).ok());
  CHECK(weft::check_orientation_3(result.mesh).ok()); // the second cell was listed the other way round
  CHECK(weft::check_boundary_3(result.mesh).ok());
  CHECK(result.inverted_cells == 0);
}

// ---- files of other programs

TEST_CASE("TetGen's files are read, numbered from 0 or from 1, inner faces left out")
{
  for (const int first : {0, 1}) {
    const auto n = [first](int i) { return std::to_string(i + first); };
    const File node("t.node", "5 3 1 0\n" + n(0) + " 0 0 0 9\n" + n(1) + " 1 0 0 9\n" + n(2) + " 0 1 0 9\n" + n(3) +
                                  " 0 0 1 9\n" + n(4) + " 0 0 -1 9\n# Generated\n");
    const File ele("t.ele", "2 4 1\n" + n(0) + " " + n(0) + " " + n(1) + " " + n(2) + " " + n(3) + " 3\n" + n(1) + " " +
                                n(0) + " " + n(1) + " " + n(4) + " " + n(2) + " 3\n");
    const File face("t.face", "2 1\n" + n(0) + " " + n(0) + " " + n(1) + " " + n(2) + " 0\n" + n(1) + " " + n(0) + " " +
                                  n(2) + " " + n(3) + " 8\n");
    const auto read = weft::IO::read_tetrahedral_mesh<K>(ele.name());
    CHECK(read.notes.empty());
    CHECK(read.mesh.cells.size() == 2);
    CHECK(read.mesh.subdomains == std::vector<int>{3, 3});
    CHECK(read.mesh.facets.size() == 6);
    CHECK(std::count(read.mesh.patches.begin(), read.mesh.patches.end(), 7) == 1);
  }
}

TEST_CASE("Gmsh's format 2 is read with sparse node numbers, as Netgen writes it, too")
{
  const File file("g.msh", gmsh_2);
  const auto read = weft::IO::read_tetrahedral_mesh<K>(file.name());
  CHECK(read.notes.empty());
  CHECK(read.mesh.points.size() == 5);
  CHECK(read.mesh.cells.size() == 2);
  CHECK(read.mesh.subdomains == std::vector<int>{7, 7});
  CHECK(read.mesh.corners == std::vector<std::size_t>{0});
  CHECK(std::count(read.mesh.patches.begin(), read.mesh.patches.end(), 4) == 1);
}

TEST_CASE("VTK grids are read in ASCII, base64 and appended, raw and encoded, with short and long headers")
{
  for (const bool is_long : {false, true}) {
    const std::string attributes =
        std::string("byte_order=\"LittleEndian\"") + (is_long ? " header_type=\"UInt64\"" : "");
    const auto begin = [](const std::string& type, const std::string& name, const std::string& format) {
      return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" + format + "\"";
    };
    const auto ascii = [&](const char* type, const char* name, const auto& numbers) {
      std::string text = begin(type, name, "ascii") + ">";
      for (const auto x : numbers) text += " " + std::to_string(x);
      return text + "</DataArray>\n";
    };
    const auto inline_binary = [&](const char* type, const char* name, const auto& numbers) {
      return begin(type, name, "binary") + ">\n " + base64(bytes_of(numbers, is_long)) + "\n</DataArray>\n";
    };
    std::string data;
    bool encoded = false;
    const auto appended = [&](const char* type, const char* name, const auto& numbers) {
      const std::string offset = std::to_string(data.size());
      data += encoded ? base64(bytes_of(numbers, is_long)) : bytes_of(numbers, is_long);
      return begin(type, name, "appended") + " offset=\"" + offset + "\"/>\n";
    };
    std::vector<std::string> texts = {vtu(attributes, ascii), vtu(attributes, inline_binary)};
    for (const bool e : {false, true}) {
      encoded = e;
      data.clear();
      std::string text = vtu(attributes, appended);
      text.resize(text.size() - std::string("</VTKFile>\n").size());
      text += std::string("<AppendedData encoding=\"") + (e ? "base64" : "raw") + "\">\n_" + data +
              "\n</AppendedData>\n</VTKFile>\n";
      texts.push_back(text);
    }
    for (const std::string& text : texts) {
      const File file("v.vtu", text);
      CAPTURE(text);
      const auto read = weft::IO::read_tetrahedral_mesh<K>(file.name());
      CHECK(read.mesh.cells.size() == 2);
      CHECK(read.mesh.points[4] == Point(0, 0, -1));
    }
    const File plain("c.vtu", vtu(attributes + " compressor=\"vtkZLibDataCompressor\"", inline_binary));
    CHECK(!error_of(plain.name()).empty()); // the arrays aren't
    const File other("c.vtu", vtu(attributes + " compressor=\"vtkLZ4DataCompressor\"", inline_binary));
    CHECK(contains(error_of(other.name()), "compressed"));
  }
}

// ---- what is refused, and where

TEST_CASE("malformed files are refused with the line")
{
  struct Case
  {
    const char* name;
    std::string text, what;
  };
  const std::vector<Case> cases = {
      {"a.mesh", "Vertices 3\n", "1: a .mesh file should begin"},
      {"a.mesh", "MeshVersionFormatted 2\nDimension 2\n", "2: the dimension should be 3"},
      {"a.mesh", medit_head + medit_points, "there are no tetrahedra"},
      {"a.mesh", medit_head + medit_points + "Tetrahedra\n1\n1 2 3 9 1\n", "13: there is no vertex 9"},
      {"a.mesh", medit_head + medit_points + "Tetrahedra\n2\n1 2 3 4 1\n", "the file"},
      {"a.mesh", medit_head + medit_points + "Tetrahedra\n2\n1 2 3 4 1\n1 2 4 3 1\n", ":14: cell 2 "},
      {"a.mesh", medit_head + medit_points + "Tetrahedra\n1\n1 1 3 4 1\n",
       ":13: cell 1 (vertices 1 1 3 4) has a vertex"},
      {"a.mesh", medit_head + medit_points + "Tetrahedra\n1\n1 2 4 5 1\n",
       ":13: cell 1 (vertices 1 2 4 5) has no volume"},
      {"a.mesh", medit_head + medit_points + "Hexahedra\n1\n1 2 3 4 1 2 3 4 1\n", "Hexahedra"},
      {"a.mesh", medit_head + "Vertices\n1000000000\n0 0 0 0\n", "too short"},
      {"a.mesh", medit_head + "Vertices\n1\n0 0 x 0\n", "6: z should be a number"},
      {"a.mesh", medit_head + "Vertices\n1\n0 0 nan 0\n", "6: z is not finite"},
      {"a.msh", "$Nodes\n", "1: a .msh file should begin"},
      {"a.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", "2: this is version 4.0"},
      {"a.msh", "$MeshFormat\n2.2 1 8\n$EndMeshFormat\n", "2: the file is binary"},
      {"a.msh", gmsh_2.substr(0, gmsh_2.size() - 20), "a node is missing"},
      {"a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 5 0 1 1 1 1\n",
       "10: an element of type 5"},
      {"a.vtu", "<html>\n</html>\n", "no VTK file"},
      {"a.vtu", "<VTKFile type=\"UnstructuredGrid\">\n<Piece NumberOfPoints=\"x\" NumberOfCells=\"1\">\n",
       "2: NumberOfPoints should be a number"},
      {"a.stp", "x", "unknown extension"}};
  for (const Case& c : cases) {
    const File file(c.name, c.text);
    CAPTURE(c.text);
    CHECK_THAT(error_of(file.name()), Catch::Contains(c.what));
  }
  CHECK_THAT(error_of("missing.mesh"), Catch::Contains("can't be opened"));
  const File hexahedron("h.vtu", "<VTKFile type=\"UnstructuredGrid\"><Piece NumberOfPoints=\"1\" NumberOfCells=\"1\">"
                                 "<Points><DataArray type=\"Float64\" format=\"ascii\">0 0 0</DataArray></Points>"
                                 "<Cells><DataArray Name=\"connectivity\" format=\"ascii\">0 0 0 0 0 0 0 0</DataArray>"
                                 "<DataArray Name=\"offsets\" format=\"ascii\">8</DataArray>"
                                 "<DataArray Name=\"types\" format=\"ascii\">12</DataArray></Cells></Piece></VTKFile>");
  CHECK_THAT(error_of(hexahedron.name()), Catch::Contains("type 12"));
}

TEST_CASE("elements that don't make a mesh are refused with the element")
{
  Soup none;
  CHECK_THAT(error_of(none), Catch::Contains("no tetrahedra"));
  Soup duplicate = two_cells();
  duplicate.cells.push_back({3, 2, 1, 0});
  CHECK_THAT(error_of(duplicate), Catch::Contains("cell 2 (vertices 3 2 1 0) is there twice"));
  Soup crowded = two_cells();
  crowded.points.push_back(Point(0.3, 0.3, 2));
  crowded.cells.push_back({0, 1, 2, 5});
  CHECK_THAT(error_of(crowded), Catch::Contains("vertices 0 1 2 has 3 cells"));
  Soup index = two_cells();
  index.cells[1][3] = 5;
  CHECK_THAT(error_of(index), Catch::Contains("cell 1 has the vertex 5"));
  Soup same_place = two_cells();
  same_place.points[4] = same_place.points[3];
  CHECK_THAT(error_of(same_place), Catch::Contains("vertices 3 and 4 are at the same place"));
  Soup infinite = two_cells();
  infinite.points[4] = Point(0, 0, std::numeric_limits<double>::infinity());
  CHECK_THAT(error_of(infinite), Catch::Contains("vertex 4 has coordinates that aren't finite"));
  Soup tags = two_cells();
  tags.cell_tags = {1};
  CHECK_THAT(error_of(tags), Catch::Contains("2 cells and 1 tag of them"));
}

TEST_CASE("what doesn't matter is left out and noted, and the rest renumbered")
{
  Soup soup = two_cells();
  soup.points.insert(soup.points.begin() + 2, Point(7, 7, 7)); // of no cell
  for (auto& cell : soup.cells)
    for (std::size_t& v : cell) v += v >= 2;
  soup.facets = {{0, 1, 3}, {0, 1, 4}, {0, 4, 5}}; // inside, of the boundary, of no cell
  soup.facet_tags = {4, 5, 6};
  soup.corners = {2, 4};
  soup.cell_tags = {0, 0};
  const auto result = weft::assemble_mesh_3(soup);
  CHECK(result.mesh.points.size() == 5);
  CHECK(result.point_origin == std::vector<std::size_t>{0, 1, 3, 4, 5});
  CHECK(result.mesh.facets.size() == 6);
  CHECK(std::count(result.mesh.patches.begin(), result.mesh.patches.end(), 4) == 1);
  CHECK(result.mesh.corners == std::vector<std::size_t>{3});
  CHECK(result.mesh.subdomains == std::vector<int>{1, 1});
  CHECK(result.notes.size() == 3);
  CHECK(weft::check_boundary_3(result.mesh).ok());
}

TEST_CASE("cells are oriented alike, and those turned over in space are kept and counted")
{
  auto mesh = fixtures::box(2).mesh;
  Soup soup;
  soup.points = mesh.points;
  soup.cells = mesh.cells;
  for (std::size_t c = 0; c < soup.cells.size(); c += 3) std::swap(soup.cells[c][0], soup.cells[c][1]);
  auto result = weft::assemble_mesh_3(soup);
  CHECK(result.inverted_cells == 0);
  CHECK(weft::check_orientation_3(result.mesh).ok());
  for (Point& p : soup.points)
    if (p == Point(1, 1, 1)) p = Point(2.6, 1.1, 1.2); // beyond the boundary
  result = weft::assemble_mesh_3(soup);
  CHECK(result.inverted_cells > 0);
  CHECK(result.mesh.cells.size() == mesh.cells.size());
  CHECK(result.mesh.facets.size() == mesh.facets.size());
}

TEST_CASE("facets visited in blocks are all facets, each once with its cells, in the order of the whole list")
{
  std::mt19937 random(3);
  for (const std::size_t n : {1, 2, 5, 40, 400}) {
    // Any four vertices, one of them often repeated: what a damaged file may have.
    std::vector<std::array<std::size_t, 4>> cells(n);
    for (auto& cell : cells)
      for (std::size_t& v : cell) v = random() % (4 + n / 5);
    std::map<std::array<std::size_t, 3>, std::vector<std::size_t>> known;
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t i = 0; i < 4; ++i)
        known[weft::internal::sorted<3>({cells[c][(i + 1) % 4], cells[c][(i + 2) % 4], cells[c][(i + 3) % 4]})]
            .push_back(c);
    std::vector<std::array<std::size_t, 3>> in_blocks, in_whole;
    weft::internal::for_each_facet(cells, [&](auto first, auto last) {
      in_blocks.push_back(first->vertices);
      std::vector<std::size_t> sides;
      for (auto side = first; side != last; ++side) sides.push_back(side->cell);
      REQUIRE(sides == known.at(first->vertices));
    });
    weft::internal::for_each_facet(weft::internal::cell_facets(cells),
                                   [&](auto first, auto) { in_whole.push_back(first->vertices); });
    CHECK(in_blocks == in_whole);
    CHECK(in_blocks.size() == known.size());
  }
}

TEST_CASE("components of random graphs are counted as flooding counts them")
{
  std::mt19937 random(4);
  for (std::size_t n = 2; n < 200; n = n * 3 / 2 + 1) {
    std::vector<std::array<std::size_t, 2>> edges(n / 2);
    for (auto& edge : edges) edge = {random() % n * 1000, random() % n * 1000};
    std::set<std::size_t> left;
    for (const auto& edge : edges) left.insert(edge.begin(), edge.end());
    std::size_t components = 0;
    for (; !left.empty(); ++components) {
      std::vector<std::size_t> stack{*left.begin()};
      left.erase(left.begin());
      while (!stack.empty()) {
        const std::size_t v = stack.back();
        stack.pop_back();
        for (const auto& [a, b] : edges)
          for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
            if (from == v && left.erase(to) > 0) stack.push_back(to);
      }
    }
    CHECK(weft::internal::number_of_components(edges) == components);
  }
}
