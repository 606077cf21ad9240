// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the conversion to CGAL's Mesh_complex_3_in_triangulation_3: it has the same elements with the same
// tags, and CGAL's own sliver exudation and Medit writer work on it. The only test that compiles CGAL's Mesh_3.

#include "fixtures/spatial_fixtures.h"

#include <weft/spatial/cgal/to_c3t3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <CGAL/exude_mesh_3.h>

#include <catch2/catch.hpp>

#include <sstream>
#include <string>

using namespace fixtures;
using C3t3 = weft::C3t3<K>;

namespace {

/// Back to arrays, with vertices in the order of `mesh`; tags as weft has them.
Mesh from_c3t3(const C3t3& c3t3)
{
  Mesh mesh;
  std::map<C3t3::Vertex_handle, std::size_t> number;
  std::map<Point, C3t3::Vertex_handle> in_order;
  for (const auto v : c3t3.triangulation().finite_vertex_handles()) in_order.emplace(v->point().point(), v);
  for (const auto& [point, v] : in_order) {
    number[v] = mesh.points.size();
    mesh.points.push_back(point);
    mesh.locations.push_back({c3t3.in_dimension(v), c3t3.index(v) - (c3t3.in_dimension(v) < 3)});
  }
  for (auto cell = c3t3.cells_in_complex_begin(); cell != c3t3.cells_in_complex_end(); ++cell) {
    mesh.cells.push_back({number.at(cell->vertex(0)), number.at(cell->vertex(1)), number.at(cell->vertex(2)),
                          number.at(cell->vertex(3))});
    mesh.subdomains.push_back(c3t3.subdomain_index(cell));
  }
  for (auto facet = c3t3.facets_in_complex_begin(); facet != c3t3.facets_in_complex_end(); ++facet) {
    auto [cell, i] = *facet;
    const auto mirror = c3t3.triangulation().mirror_facet(*facet);
    CHECK(c3t3.is_in_complex(mirror));
    CHECK(c3t3.surface_patch_index(mirror) == c3t3.surface_patch_index(*facet));
    const int here = c3t3.subdomain_index(cell), there = c3t3.subdomain_index(mirror.first);
    if (here == 0 || (there != 0 && there < here)) std::tie(cell, i) = mirror;
    std::array<std::size_t, 3> f{};
    for (int k = 0; k < 3; ++k)
      f[static_cast<std::size_t>(2 - k)] = number.at(cell->vertex(Triangulation::vertex_triple_index(i, k)));
    mesh.facets.push_back(f);
    mesh.patches.push_back(c3t3.surface_patch_index(*facet) - 1);
  }
  for (auto e = c3t3.edges_in_complex_begin(); e != c3t3.edges_in_complex_end(); ++e) {
    mesh.edges.push_back({number.at(e->first->vertex(e->second)), number.at(e->first->vertex(e->third))});
    mesh.creases.push_back(c3t3.curve_index(*e) - 1);
  }
  std::map<int, std::size_t> corners;
  for (auto v = c3t3.vertices_in_complex_begin(); v != c3t3.vertices_in_complex_end(); ++v)
    corners[c3t3.corner_index(v)] = number.at(v);
  for (const auto& corner : corners) mesh.corners.push_back(corner.second);
  return mesh;
}

/// Elements with their tags, whatever their order and that of their vertices.
template <std::size_t N>
std::map<std::array<std::size_t, N>, int> tagged(const std::vector<std::array<std::size_t, N>>& elements,
                                                 const std::vector<int>& tags)
{
  std::map<std::array<std::size_t, N>, int> result;
  for (std::size_t i = 0; i < elements.size(); ++i) result[weft::internal::sorted(elements[i])] = tags[i];
  return result;
}

void check_same(const Mesh& a, const Mesh& b)
{
  CHECK(a.points == b.points);
  CHECK(a.locations == b.locations);
  CHECK(tagged(a.cells, a.subdomains) == tagged(b.cells, b.subdomains));
  CHECK(tagged(a.facets, a.patches) == tagged(b.facets, b.patches));
  CHECK(tagged(a.edges, a.creases) == tagged(b.edges, b.creases));
  CHECK(a.corners == b.corners);
}

} // namespace

TEST_CASE("a C3t3 has the elements and tags of the mesh, also where all points are cospherical with others")
{
  for (const bool two_subdomains : {false, true}) {
    const Triangulated given = box(4, two_subdomains);
    const C3t3 from_points = weft::to_c3t3(given.mesh);
    const C3t3 from_triangulation = weft::to_c3t3(given.triangulation, given.mesh);
    for (const C3t3* c3t3 : {&from_points, &from_triangulation}) {
      check_same(from_c3t3(*c3t3), given.mesh);
      CHECK(c3t3->triangulation().is_valid());
      CHECK(c3t3->triangulation().number_of_vertices() == 125); // without the corners of the larger box
      std::ostringstream faults;
      const weft::Validity_3 validity = weft::validate_3(from_c3t3(*c3t3));
      faults << validity;
      INFO(faults.str());
      CHECK(validity.ok());
    }
  }
}

TEST_CASE("a mesh that isn't Delaunay is refused with the cell that is to blame")
{
  Mesh mesh = ball(60, 20).mesh;
  // Two cells that cross the mesh: the hull's diameter with vertices beside it.
  mesh.cells.push_back({0, mesh.points.size() - 1, 1, mesh.points.size() - 2});
  mesh.subdomains.push_back(1);
  try {
    weft::to_c3t3(mesh);
    FAIL("accepted");
  } catch (const weft::Domain_error& error) {
    CHECK(error.elements() == std::vector<std::size_t>{mesh.cells.size() - 1});
  }
}

TEST_CASE("a triangulation that lacks a vertex of the mesh is refused with that vertex")
{
  Triangulated given = ball(60, 20);
  given.mesh.points[7] = Point(5, 6, 7);
  try {
    weft::to_c3t3(given.triangulation, given.mesh);
    FAIL("accepted");
  } catch (const weft::Domain_error& error) {
    CHECK(error.vertices() == std::vector<std::size_t>{7});
  }
}

TEST_CASE("CGAL's sliver exudation improves the mesh and keeps its boundary")
{
  const Triangulated given = ball(150, 400);
  C3t3 c3t3 = weft::to_c3t3(given.triangulation, given.mesh);
  CGAL::exude_mesh_3(c3t3, CGAL::parameters::time_limit = 30);
  const Mesh after = from_c3t3(c3t3);
  const auto before_quality = weft::measure_quality_3(given.mesh), quality = weft::measure_quality_3(after);
  CHECK(quality.smallest_dihedral.degrees >= before_quality.smallest_dihedral.degrees);
  CHECK(quality.cells_below(5) < before_quality.cells_below(5));
  CHECK(quality.volume == Approx(before_quality.volume).epsilon(1e-12));
  CHECK(tagged(after.facets, after.patches) == tagged(given.mesh.facets, given.mesh.patches));
}

TEST_CASE("CGAL's Medit writer writes the elements of the mesh")
{
  const Triangulated given = box(2);
  const C3t3 c3t3 = weft::to_c3t3(given.triangulation, given.mesh);
  std::ostringstream out;
  c3t3.output_to_medit(out, false, true); // with the patches as tags, and every facet once
  std::istringstream in(out.str());
  std::map<std::string, std::size_t> counts;
  for (std::string word; in >> word;)
    if (word == "Vertices" || word == "Triangles" || word == "Tetrahedra") in >> counts[word];
  CHECK(counts["Vertices"] == 27);
  CHECK(counts["Triangles"] == given.mesh.facets.size());
  CHECK(counts["Tetrahedra"] == given.mesh.cells.size());
}
