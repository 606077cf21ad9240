// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of triangulations that carry more than the mesher needs: polylines of CGAL's
// Constrained_triangulation_plus_2 stay whole, data of users in faces survives.

#include "fixtures/meshing_2.h"

#include <weft/planar/graph/Input_faces_2.h>
#include <weft/planar/graph/Mesh_marks_2.h>

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace planar;
using Plus = CGAL::Constrained_triangulation_plus_2<Cdt>;

/// CGAL's base for data of users below weft's face base.
using Info_face = weft::Mesh_face_base_2<
    K,
    CGAL::Delaunay_mesh_face_base_2<
        K, CGAL::Constrained_Delaunay_triangulation_face_base_2<
               K, CGAL::Constrained_triangulation_face_base_2<K, CGAL::Triangulation_face_base_with_info_2<int, K>>>>>;
using Info_cdt = CGAL::Constrained_Delaunay_triangulation_2<
    K, CGAL::Triangulation_data_structure_2<weft::Mesh_vertex_base_2<K>, Info_face>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// A type with data of its own, which weft knows nothing of.
template <class Fb = weft::Mesh_face_base_2<K>>
struct Named_face : Fb
{
  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Named_face<typename Fb::template Rebind_TDS<Tds>::Other>;
  };
  using Fb::Fb;
  std::string name;
};
using Named_cdt = CGAL::Constrained_Delaunay_triangulation_2<
    K, CGAL::Triangulation_data_structure_2<weft::Mesh_vertex_base_2<K>, Named_face<>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// A polygon of squares side by side, turned, so that constraints are rounded, with a polyline across each.
template <class Triangulation, class Insert>
void fill(Triangulation& cdt, const Insert& insert, int n = 3)
{
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto at = [&](double x, double y) { return Point(c * x - s * y, s * x + c * y); };
  std::vector<Point> outline; // with a corner wherever something ends on it
  for (int i = 0; i <= n; ++i) outline.push_back(at(i, 0));
  outline.push_back(at(n, 0.5));
  for (int i = n; i >= 0; --i) outline.push_back(at(i, 1));
  outline.push_back(at(0, 0.5));
  outline.push_back(at(0, 0));
  insert(cdt, outline);
  for (int i = 1; i < n; ++i) insert(cdt, std::vector<Point>{at(i, 0), at(i, 0.5), at(i, 1)});
  for (int i = 0; i < n; ++i)
    insert(cdt, std::vector<Point>{at(i, 0.5), at(i + 0.4, 0.2), at(i + 0.7, 0.6), at(i + 1, 0.5)});
}

void insert_polyline(Plus& cdt, const std::vector<Point>& points)
{
  cdt.insert_constraint(points.begin(), points.end());
}

template <class Triangulation>
void insert_links(Triangulation& cdt, const std::vector<Point>& points)
{
  for (std::size_t i = 1; i < points.size(); ++i) cdt.insert_constraint(points[i - 1], points[i]);
}

/// Whether each link of each polyline is a constrained edge, and each constrained edge a link.
bool polylines_are_whole(Plus& cdt)
{
  using Link = std::pair<Plus::Vertex_handle, Plus::Vertex_handle>;
  std::set<Link> links, edges;
  for (auto c = cdt.constraints_begin(); c != cdt.constraints_end(); ++c) {
    std::vector<Plus::Vertex_handle> v(cdt.vertices_in_constraint_begin(*c), cdt.vertices_in_constraint_end(*c));
    for (std::size_t i = 1; i < v.size(); ++i) links.insert(std::minmax(v[i - 1], v[i]));
  }
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    edges.insert(
        std::minmax(edge->first->vertex(Plus::ccw(edge->second)), edge->first->vertex(Plus::cw(edge->second))));
  const auto n = static_cast<std::size_t>(std::distance(cdt.subconstraints_begin(), cdt.subconstraints_end()));
  return links == edges && n == edges.size();
}

} // namespace

TEST_CASE("polylines of a Constrained_triangulation_plus_2 stay whole")
{
  Plus cdt;
  fill(cdt, insert_polyline);
  const auto n = cdt.number_of_constraints();
  REQUIRE(polylines_are_whole(cdt));
  Cdt plain;
  fill(plain, insert_links<Cdt>);
  weft::mark_domain_by_seeds(cdt, static_cast<Point*>(nullptr), static_cast<Point*>(nullptr));
  weft::mark_domain_by_seeds(plain, static_cast<Point*>(nullptr), static_cast<Point*>(nullptr));

  SECTION("after a mesh, which is the one without polylines")
  {
    const auto report = weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.1));
    CHECK(report.ok());
    CHECK(report.constraint_steiner > 20);
    CHECK(weft::make_mesh_2(plain, weft::Uniform_sizing<>(0.1)).triangles == Approx(report.triangles).epsilon(0.05));
  }
  SECTION("after relaxing, after a second mesh")
  {
    weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.15));
    weft::relax_2(cdt, weft::Uniform_sizing<>(0.15));
    CHECK(polylines_are_whole(cdt));
    weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.05));
  }
  SECTION("after a run that was cancelled, and one that failed")
  {
    weft::Mesh_options_2 options;
    int calls = 0;
    options.visitor = [&calls](const weft::Progress&) { return ++calls < 12; };
    CHECK(!weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.02), options).ok());
    CHECK(polylines_are_whole(cdt));
    int evaluations = 0;
    const Field failing = [&evaluations](const Point&) { return ++evaluations < 2000 ? 0.02 : -1; };
    CHECK_THROWS_AS(weft::make_mesh_2(cdt, failing), weft::Option_error);
  }
  CHECK(cdt.is_valid());
  CHECK(polylines_are_whole(cdt));
  CHECK(cdt.number_of_constraints() == n);

  // They can be worked with: removed one by one, and inserted again.
  while (cdt.number_of_constraints() > 0) {
    cdt.remove_constraint(*cdt.constraints_begin());
    REQUIRE(polylines_are_whole(cdt));
    REQUIRE(cdt.is_valid());
  }
  CHECK(cdt.constrained_edges_begin() == cdt.constrained_edges_end());
  fill(cdt, [](Plus& t, const std::vector<Point>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) t.insert_constraint(points[i - 1], points[i]);
  });
  CHECK(polylines_are_whole(cdt));
  CHECK(cdt.is_valid());
}

TEST_CASE("info() of faces is that of the input's face in which they lie")
{
  for (const bool cancelled : {false, true}) {
    Info_cdt cdt;
    fill(cdt, insert_links<Info_cdt>, 5);
    weft::mark_domain_by_seeds(cdt, static_cast<Point*>(nullptr), static_cast<Point*>(nullptr));
    int number = 0;
    for (const auto face : cdt.finite_face_handles()) face->info() = ++number;
    std::vector<std::pair<Info_cdt::Triangle, int>> input;
    for (const auto face : cdt.finite_face_handles()) input.emplace_back(cdt.triangle(face), face->info());
    weft::Mesh_options_2 options;
    int calls = 0;
    if (cancelled) options.visitor = [&calls](const weft::Progress&) { return ++calls < 12; };
    CHECK(weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.05), options).ok() != cancelled);
    // By brute force: the input's triangle that holds the centroid.
    int wrong = 0;
    for (const auto face : cdt.finite_face_handles()) {
      const Point p = CGAL::centroid(cdt.triangle(face));
      bool held = !face->is_in_domain();
      for (const auto& [triangle, info] : input)
        held = held || (!triangle.has_on_unbounded_side(p) && info == face->info());
      wrong += !held;
    }
    CHECK(wrong == 0);
    CHECK(cdt.number_of_faces() > 300);
    if (!cancelled) { // and by relaxation it stays
      weft::relax_2(cdt, weft::Uniform_sizing<>(0.05));
      for (const auto face : cdt.finite_face_handles()) CHECK((face->info() >= 1 && face->info() <= number));
    }
  }
}

TEST_CASE("data of a type of the user's own comes from the part between constraints, however thin that is")
{
  Named_cdt cdt;
  // Turned strips down to 1e-14 of their length thick: centroids are rounded across their sides.
  const double c = std::cos(0.7), s = std::sin(0.7);
  double y = 0;
  std::vector<double> heights{0};
  for (const double thickness : {0.3, 1e-3, 1e-14, 0.2, 1e-12, 1e-9, 0.1}) heights.push_back(y += thickness);
  const auto at = [&](double x, double h) { return Point(c * x - s * h, s * x + c * h); };
  for (const double h : heights) cdt.insert_constraint(at(0, h), at(1, h));
  cdt.insert_constraint(at(0, 0), at(0, 0.3));
  for (std::size_t i = 1; i < heights.size(); ++i) {
    cdt.insert_constraint(at(0, heights[i - 1]), at(0, heights[i]));
    cdt.insert_constraint(at(1, heights[i - 1]), at(1, heights[i]));
  }
  weft::mark_domain_by_seeds(cdt, static_cast<Point*>(nullptr), static_cast<Point*>(nullptr));
  const auto parts = weft::internal::face_components(cdt);
  REQUIRE(parts.count == 8);
  for (const auto face : cdt.finite_face_handles()) face->name = std::to_string(parts.number[face]);
  std::map<std::string, double> before, after;
  for (const auto face : cdt.finite_face_handles()) before[face->name] += cdt.triangle(face).area();

  const weft::Input_faces_2<Named_cdt> input(cdt);
  weft::Mesh_options_2 options;
  options.max_vertices = 3000;
  weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.05), options);
  for (const auto face : cdt.finite_face_handles()) face->name = "lost";
  input.for_each(cdt, [](auto from, auto to) { to->name = from->name; });

  for (const auto face : cdt.finite_face_handles()) after[face->name] += cdt.triangle(face).area();
  CHECK(after.count("lost") == 0);
  CHECK(after.size() == before.size());
  for (const auto& [name, area] : before) CHECK(after[name] == Approx(area).epsilon(1e-9).margin(1e-15));
  const auto now = weft::internal::face_components(cdt);
  std::map<int, std::string> name_of;
  for (const auto face : cdt.finite_face_handles())
    CHECK(name_of.emplace(now.number[face], face->name).first->second == face->name);
}

TEST_CASE("numbers of regions at faces come from the input as the manual shows")
{
  Cdt cdt;
  fill(cdt, insert_links<Cdt>);
  const int parts = weft::label_components(cdt);
  weft::mark_domain_by_seeds(cdt, static_cast<Point*>(nullptr), static_cast<Point*>(nullptr));
  const weft::Input_faces_2<Cdt> input(cdt);
  weft::make_mesh_2(cdt, 0.1);
  input.for_each(cdt, [](auto input_face, auto face) { face->set_id(input_face->id()); });
  std::set<int> seen;
  for (const auto face : cdt.finite_face_handles())
    if (face->is_in_domain()) seen.insert(face->id());
  CHECK(seen.size() == static_cast<std::size_t>(parts) - 1);
  for (const auto face : cdt.finite_face_handles())
    for (int i = 0; i < 3 && face->is_in_domain(); ++i)
      CHECK((face->neighbor(i)->id() == face->id()) == !face->is_constrained(i));
}

TEST_CASE("marks of edges and regions hold after meshing")
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {3, 0}, {3, 1}, {0, 1}});
  add_loop(pslg, {{1, 0.25}, {2, 0.25}, {2, 0.75}, {1, 0.75}});
  pslg.segment_markers = {10, 20, 30, 40, 1, 2, 3, 4};
  pslg.regions = {{{0.5, 0.5}, 5}, {{1.5, 0.5}, 6}};
  pslg = transformed(pslg, 1, 0.2, 0, 0);
  const double c = std::cos(-0.2), s = std::sin(-0.2);
  for (auto& r : pslg.regions) r.point = Point(c * r.point.x() + s * r.point.y(), -s * r.point.x() + c * r.point.y());
  Cdt cdt;
  const auto tags = weft::insert_pslg(cdt, pslg).tags;
  CHECK(weft::mark_domain(cdt, pslg).warnings.empty());
  weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.1));
  const weft::Mesh_marks_2<Cdt> marks(cdt, tags);
  std::map<int, double> length, area;
  const auto back = [&](const Point& p) { return Point(c * p.x() - s * p.y(), s * p.x() + c * p.y()); };
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue; // beside the hull, by rounding
    const Point p = back(CGAL::centroid(cdt.triangle(face)));
    const bool inner = p.x() > 1 && p.x() < 2 && p.y() > 0.25 && p.y() < 0.75;
    CHECK(marks.region(face) == (inner ? 6 : 5));
    CHECK(marks.region_index(face) == (inner ? 1 : 0));
    for (int i = 0; i < 3; ++i) {
      CHECK(face->is_constrained(i) == (marks.edge(face, i) != 0));
      CHECK(marks.edge(face, i) == tags.constraints.constraint_marker(cdt, face, i) * face->is_constrained(i));
      CHECK(marks.edge(face, i) == marks.edge(face->neighbor(i), cdt.mirror_index(face, i)));
      length[marks.edge(face, i)] += std::sqrt(cdt.segment(face, i).squared_length());
    }
  }
  for (const auto& [mark, expected] :
       std::map<int, double>{{10, 3}, {20, 1}, {30, 3}, {40, 1}, {1, 2}, {2, 1}, {3, 2}, {4, 1}})
    CHECK(length[mark] == Approx(expected)); // the inner ones from both sides
}
