// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the validity checker: good meshes pass whoever made them, however they are rotated and scaled, and each
// way of breaking a mesh is found and named by the check that is meant for it.

#include <weft/planar/check/validate_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <catch2/catch.hpp>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;
using Point = K::Point_2;
using weft::Fault_kind;

void add_loop(Pslg& pslg, const std::vector<Point>& corners)
{
  const std::size_t first = pslg.points.size(), n = corners.size();
  pslg.points.insert(pslg.points.end(), corners.begin(), corners.end());
  for (std::size_t i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n});
}

/// A square with a hole in which there is an island, a dangling segment, a segment through an input point, one across
/// the island, and an isolated point.
Pslg archipelago()
{
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_loop(pslg, {{0.2, 0.2}, {0.7, 0.2}, {0.7, 0.7}, {0.2, 0.7}});
  add_loop(pslg, {{0.3, 0.3}, {0.6, 0.3}, {0.45, 0.6}});
  pslg.points.insert(pslg.points.end(), {{0.85, 0.9}, {0.1, 0.9}, {0.25, 0.9}, {0.5, 0.9}, {0.9, 0.1}});
  pslg.segments.push_back({2, 11});
  pslg.segments.push_back({12, 14}); // passes through point 13
  pslg.segments.push_back({8, 9});   // once more
  return pslg;
}

Cdt insert(const Pslg& pslg, weft::Crossings crossings = weft::Crossings::refuse)
{
  Cdt cdt;
  weft::insert_pslg(cdt, pslg, {crossings, 0});
  weft::mark_domain(cdt, pslg);
  return cdt;
}

/// Refined by CGAL, which is told of the domain by a seed in each of its triangles.
Cdt refine(const Pslg& pslg, double size, weft::Crossings crossings = weft::Crossings::refuse)
{
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;
  Cdt cdt = insert(pslg, crossings);
  std::vector<Point> seeds;
  for (const auto f : cdt.finite_face_handles())
    if (f->is_in_domain()) seeds.push_back(CGAL::centroid(cdt.triangle(f)));
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(0.125, size));
  mesher.set_seeds(seeds.begin(), seeds.end(), true);
  mesher.refine_mesh();
  return cdt;
}

Pslg moved(Pslg pslg, double angle, double scale, double dx, double dy)
{
  for (auto* list : {&pslg.points, &pslg.holes})
    for (Point& p : *list)
      p = Point(scale * (std::cos(angle) * p.x() - std::sin(angle) * p.y()) + dx,
                scale * (std::sin(angle) * p.x() + std::cos(angle) * p.y()) + dy);
  return pslg;
}

std::string text(const weft::Validity_2& validity)
{
  std::ostringstream out;
  out << validity;
  return out.str();
}

#define CHECK_VALID(...)                                                                                               \
  do {                                                                                                                 \
    const weft::Validity_2 validity = __VA_ARGS__;                                                                     \
    INFO(text(validity));                                                                                              \
    CHECK(validity.ok());                                                                                              \
  } while (false)

/// Whether faults of this kind and of no other were found.
bool only(Fault_kind kind, const weft::Validity_2& validity)
{
  for (std::size_t i = 0; i < validity.counts.size(); ++i)
    if ((validity.counts[i] > 0) != (static_cast<Fault_kind>(i) == kind)) return false;
  return !validity.faults.empty() && !validity.faults.front().text.empty();
}

Cdt::Vertex_handle vertex_at(const Cdt& cdt, double x, double y)
{
  for (const auto v : cdt.finite_vertex_handles())
    if (v->point() == Point(x, y)) return v;
  return {};
}

/// A vertex that isn't in the input, inside of the domain.
Cdt::Vertex_handle interior_vertex(const Cdt& cdt)
{
  for (const auto v : cdt.finite_vertex_handles()) {
    bool inside = true;
    auto face = cdt.incident_faces(v);
    const auto done = face;
    do inside = inside && face->is_in_domain();
    while (++face != done);
    if (inside && v->constraint() == weft::free_vertex && !cdt.are_there_incident_constraints(v)) return v;
  }
  return {};
}

/// A vertex in the domain whose neighbors have no constraints either.
Cdt::Vertex_handle lonely_vertex(const Cdt& cdt)
{
  for (const auto v : cdt.finite_vertex_handles()) {
    bool lonely = v->face()->is_in_domain() && !cdt.are_there_incident_constraints(v);
    auto w = cdt.incident_vertices(v);
    const auto done = w;
    do lonely = lonely && !cdt.is_infinite(w) && !cdt.are_there_incident_constraints(w);
    while (++w != done);
    if (lonely) return v;
  }
  return {};
}

/// An inner vertex of an input segment: at the middle of the square's lower side after refinement.
Cdt::Vertex_handle vertex_on_lower_side(const Cdt& cdt)
{
  for (const auto v : cdt.finite_vertex_handles())
    if (v->point().y() == 0 && v->point().x() > 0.3 && v->point().x() < 0.7) return v;
  return {};
}

void set_constrained(Cdt::Face_handle f, int i, bool constrained)
{
  const auto n = f->neighbor(i);
  n->set_constraint(n->index(f), constrained);
  f->set_constraint(i, constrained);
}

Cdt::Edge constrained_edge(const Cdt& cdt, const Point& a, const Point& b)
{
  for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e) {
    const K::Segment_2 s = cdt.segment(*e);
    if ((s.source() == a && s.target() == b) || (s.source() == b && s.target() == a)) return *e;
  }
  return {};
}

} // namespace

TEST_CASE("fresh triangulations and meshes of CGAL are valid")
{
  const Pslg pslg = archipelago();
  const Cdt fresh = insert(pslg), mesh = refine(pslg, 0.03);
  CHECK(fresh.is_valid());
  CHECK(mesh.is_valid());
  REQUIRE(mesh.number_of_vertices() > 1000);
  CHECK_VALID(weft::validate_2(fresh));
  CHECK_VALID(weft::validate_2(fresh, pslg));
  CHECK_VALID(weft::validate_2(mesh, pslg));
  CHECK_VALID(weft::validate_2(mesh, pslg, weft::Uniform_sizing<>(0.03)));
  CHECK_VALID(weft::check_domain_2(mesh));
  CHECK(text(weft::validate_2(mesh)) == "valid\n");
}

TEST_CASE("validity survives rotation, scaling and distance from the origin")
{
  for (const double angle : {0.1, 1.0, 2.5})
    for (const auto& [scale, shift] :
         {std::pair(1., 0.), std::pair(1e-9, 0.), std::pair(1e12, 1e9), std::pair(1., 1e6)}) {
      const Pslg pslg = [&, shift = shift, scale = scale] {
        Pslg p = archipelago();
        p.segments.erase(p.segments.end() - 2); // what lies exactly on a segment doesn't after rotation
        return moved(p, angle, scale, shift, -shift);
      }();
      CAPTURE(angle, scale, shift);
      CHECK_VALID(weft::validate_2(refine(pslg, 0.02 * scale), pslg, weft::Uniform_sizing<>(0.02 * scale)));
    }
}

TEST_CASE("a deeply graded chain of midpoints still lies on its segment")
{
  // A short input segment next to a long one: refinement bisects the long one some forty times over.
  Pslg pslg;
  add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  pslg.points.insert(pslg.points.end(), {{0.3, 1e-9}, {0.3, 2e-9}});
  pslg.segments.push_back({4, 5});
  const Pslg rotated = moved(pslg, 0.3, 1, 3, 5);
  const Cdt mesh = refine(rotated, 1);
  REQUIRE(mesh.number_of_vertices() > 100);
  CHECK_VALID(weft::validate_2(mesh, rotated));
}

TEST_CASE("domains with holes given by points are checked by them")
{
  Pslg pslg = archipelago();
  pslg.holes = {{0.25, 0.25}};
  const Cdt mesh = refine(pslg, 0.05);
  CHECK_VALID(weft::validate_2(mesh, pslg));
  pslg.holes = {{0.45, 0.4}};
  const auto wrong = weft::check_domain_2(mesh, pslg);
  CHECK(only(Fault_kind::domain, wrong));
  CHECK(text(wrong).find("area") != std::string::npos);
}

TEST_CASE("segments split at crossings and overlaps conform")
{
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    Pslg pslg;
    add_loop(pslg, {{-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}});
    for (int i = 0; i < 24; ++i) {
      const double x = static_cast<double>(random()) / 4294967296., y = static_cast<double>(random()) / 4294967296.;
      pslg.points.emplace_back(x, y);
      if (i % 2) pslg.segments.push_back({pslg.points.size() - 2, pslg.points.size() - 1});
    }
    pslg.points.insert(pslg.points.end(), {{0.2, -0.1}, {0.9, -0.1}});
    pslg.segments.push_back({28, 29}); // on the lower side
    const Cdt cdt = insert(pslg, weft::Crossings::split);
    CHECK_VALID(weft::validate_2(cdt, pslg));
    if (round < 3) CHECK_VALID(weft::validate_2(refine(pslg, 0.1, weft::Crossings::split), pslg));
  }
}

TEST_CASE("random Delaunay triangulations pass, and every flipped edge is found")
{
  for (const unsigned seed : {1u, 2u, 3u}) {
    Pslg pslg;
    add_loop(pslg, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
      const double x = static_cast<double>(random()) / 4294967296., y = static_cast<double>(random()) / 4294967296.;
      pslg.points.emplace_back(x, y);
    }
    const Cdt original = insert(pslg);
    CHECK_VALID(weft::validate_2(original, pslg));
    const auto edges = std::distance(original.finite_edges_begin(), original.finite_edges_end());
    int flipped = 0;
    for (int k = 0; k < edges; ++k) {
      Cdt cdt = original;
      const auto edge = *std::next(cdt.finite_edges_begin(), k);
      Cdt::Face_handle f = edge.first;
      const int i = edge.second;
      if (f->is_constrained(i)) continue;
      const auto &p = f->vertex(i)->point(), &q = cdt.mirror_vertex(f, i)->point(),
                 &a = f->vertex(Cdt::ccw(i))->point(), &b = f->vertex(Cdt::cw(i))->point();
      if (CGAL::orientation(p, a, q) != CGAL::LEFT_TURN || CGAL::orientation(p, q, b) != CGAL::LEFT_TURN) continue;
      cdt.flip(f, i);
      CHECK(only(Fault_kind::delaunay, weft::validate_2(cdt, pslg)));
      ++flipped;
    }
    CHECK(flipped > 100);
  }
}

TEST_CASE("a vertex moved across its star turns faces over; one moved a little isn't Delaunay")
{
  const Pslg pslg = archipelago();
  Cdt mesh = refine(pslg, 0.05);
  const auto v = interior_vertex(mesh);
  REQUIRE(v != Cdt::Vertex_handle());
  const Point before = v->point();

  v->set_point(Point(before.x() + 0.2, before.y()));
  CHECK(weft::check_structure_2(mesh).ok());
  CHECK(only(Fault_kind::orientation, weft::check_orientation_2(mesh)));
  CHECK(weft::validate_2(mesh, pslg).count(Fault_kind::orientation) > 0);

  // To the middle of an edge of its star: a flat face, which only an exact test tells from a thin one.
  const auto f = v->face();
  const int i = f->index(v);
  v->set_point(f->vertex(Cdt::ccw(i))->point());
  CHECK(weft::check_orientation_2(mesh).count(Fault_kind::orientation) >= 2);

  // Towards that corner, as far as nothing is turned over.
  const Point corner = f->vertex(Cdt::ccw(i))->point();
  double step = 1;
  do {
    step *= 0.9;
    v->set_point(Point(before.x() + step * (corner.x() - before.x()), before.y() + step * (corner.y() - before.y())));
  } while (!weft::check_orientation_2(mesh).ok());
  const auto validity = weft::validate_2(mesh, pslg);
  INFO(text(validity));
  CHECK(only(Fault_kind::delaunay, validity));

  v->set_point(before);
  CHECK_VALID(weft::validate_2(mesh, pslg));
}

TEST_CASE("a dented hull and one that winds around twice are found")
{
  Pslg octagon;
  const std::vector<Point> corners = {{4, 0}, {3, 3}, {0, 4}, {-3, 3}, {-4, 0}, {-3, -3}, {0, -4}, {3, -3}};
  add_loop(octagon, corners);
  octagon.points.emplace_back(0, 0);
  Cdt cdt = insert(octagon);
  CHECK_VALID(weft::check_orientation_2(cdt));

  const auto v = vertex_at(cdt, corners[1].x(), corners[1].y());
  v->set_point(Point(2, 2)); // on the line between its neighbors: a flat corner is fine
  CHECK_VALID(weft::check_orientation_2(cdt));
  v->set_point(Point(1.9, 1.9));
  const auto dented = weft::check_orientation_2(cdt);
  CHECK(dented.count(Fault_kind::orientation) == 1);
  CHECK(text(dented).find("hull") != std::string::npos);
  v->set_point(corners[1]);

  // Twice the angle at every corner: all faces are counterclockwise and the hull turns left everywhere.
  for (const auto w : cdt.finite_vertex_handles())
    w->set_point(
        Point(w->point().x() * w->point().x() - w->point().y() * w->point().y(), 2 * w->point().x() * w->point().y()));
  for (const auto f : cdt.finite_face_handles()) REQUIRE(cdt.triangle(f).orientation() == CGAL::COUNTERCLOCKWISE);
  const auto twice = weft::check_orientation_2(cdt);
  CHECK(twice.count(Fault_kind::orientation) == 1);
  CHECK(text(twice).find("once") != std::string::npos);
}

TEST_CASE("links that lead astray are found without being followed")
{
  const Pslg pslg = archipelago();
  const auto broken = [&pslg](const auto& damage) {
    Cdt cdt = refine(pslg, 0.1);
    const auto f = interior_vertex(cdt)->face();
    damage(cdt, f);
    const auto validity = weft::validate_2(cdt, pslg, weft::Uniform_sizing<>(0.1));
    return only(Fault_kind::structure, validity);
  };
  CHECK_FALSE(broken([](Cdt&, Cdt::Face_handle) {}));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->set_neighbor(0, Cdt::Face_handle()); }));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->set_neighbor(0, f->neighbor(1)); }));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->set_vertex(0, Cdt::Vertex_handle()); }));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->set_vertex(0, f->vertex(1)); }));
  CHECK(broken([](Cdt& cdt, Cdt::Face_handle f) { f->set_vertex(0, cdt.infinite_vertex()); }));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->vertex(0)->set_face(f->neighbor(0)); }));
  CHECK(broken([](Cdt& cdt, Cdt::Face_handle) { cdt.tds().create_vertex(); }));
  CHECK(broken([](Cdt&, Cdt::Face_handle f) { f->set_constraint(0, true); }));

  Cdt line;
  line.insert(Point(0, 0));
  line.insert(Point(1, 0));
  CHECK(only(Fault_kind::structure, weft::validate_2(line)));
}

TEST_CASE("a dropped constraint is named by its input segment")
{
  const Pslg pslg = archipelago();
  Cdt cdt = insert(pslg);
  const auto [f, i] = constrained_edge(cdt, Point(0.85, 0.9), Point(1, 1)); // dangling: the domain stays as it is
  REQUIRE(f != Cdt::Face_handle());
  set_constrained(f, i, false);
  const auto validity = weft::check_conformity_2(cdt, pslg);
  CHECK(only(Fault_kind::conformity, validity));
  CHECK(validity.count(Fault_kind::conformity) == 1);
  CHECK(text(validity).find("input segment 11 ") != std::string::npos);
  CHECK(weft::check_domain_2(cdt, pslg).ok());

  // One piece of many.
  Cdt mesh = refine(pslg, 0.05);
  const auto v = vertex_on_lower_side(mesh);
  auto edge = mesh.incident_edges(v);
  while (!mesh.is_constrained(*edge)) ++edge;
  set_constrained(edge->first, edge->second, false);
  const auto refined = weft::check_conformity_2(mesh, pslg);
  CHECK(only(Fault_kind::conformity, refined));
  CHECK(text(refined).find("input segment 0 ") != std::string::npos);
  // Now the outside reaches in.
  CHECK(weft::check_domain_2(mesh).count(Fault_kind::domain) > 0);
}

TEST_CASE("constraints that the input doesn't have are found")
{
  const Pslg pslg = archipelago();
  Cdt cdt = refine(pslg, 0.1);
  const auto f = interior_vertex(cdt)->face();
  set_constrained(f, 0, true);
  CHECK(only(Fault_kind::conformity, weft::validate_2(cdt, pslg)));

  // A closed loop of them around a vertex, away from every input point.
  Cdt loop = refine(pslg, 0.02);
  const Cdt::Vertex_handle center = lonely_vertex(loop);
  REQUIRE(center != Cdt::Vertex_handle());
  auto face = loop.incident_faces(center);
  const auto done = face;
  do set_constrained(face, face->index(center), true);
  while (++face != done);
  CHECK(weft::check_conformity_2(loop, pslg).count(Fault_kind::conformity) == 1);
}

TEST_CASE("input points must be vertices to the last bit")
{
  const Pslg pslg = archipelago();
  for (const std::size_t i : {0u, 6u, 11u, 13u, 15u}) {
    Cdt cdt = insert(pslg);
    const Point p = pslg.points[i];
    vertex_at(cdt, p.x(), p.y())->set_point(Point(std::nextafter(p.x(), 2.), p.y()));
    const auto validity = weft::check_conformity_2(cdt, pslg);
    CHECK(only(Fault_kind::conformity, validity));
    CHECK(text(validity).find("input point " + std::to_string(i) + " ") != std::string::npos);
  }
  Pslg more = pslg;
  more.points.emplace_back(0.9, 0.2);
  more.segments.push_back({16, 15});
  more.segments.push_back({16, 99});
  const auto validity = weft::check_conformity_2(insert(pslg), more);
  CHECK(validity.count(Fault_kind::conformity) == 2);
  CHECK(text(validity).find("input segment 15 refers to a point that doesn't exist") != std::string::npos);
}

TEST_CASE("vertices on segments may be rounded but not displaced, and must come in order")
{
  const Pslg pslg = archipelago();
  Cdt mesh = refine(pslg, 0.05);
  const auto v = vertex_on_lower_side(mesh);
  REQUIRE(v != Cdt::Vertex_handle());
  const Point p = v->point();
  const double ulp = std::numeric_limits<double>::epsilon(); // the segment's largest coordinate is 1

  v->set_point(Point(p.x(), 2 * ulp));
  CHECK_VALID(weft::check_conformity_2(mesh, pslg));
  CHECK_VALID(weft::check_domain_2(mesh, pslg));
  for (const double off : {20 * ulp, -20 * ulp, 1e-10, 1e-3}) {
    v->set_point(Point(p.x(), off));
    const auto validity = weft::check_conformity_2(mesh, pslg);
    CHECK(only(Fault_kind::conformity, validity));
    CHECK(validity.count(Fault_kind::conformity) == 1);
    CHECK(text(validity).find("input segment 0 has a vertex off its line") != std::string::npos);
  }
  v->set_point(Point(p.x(), 1e-6));
  CHECK(text(weft::check_domain_2(mesh, pslg)).find("area") != std::string::npos);

  for (const double x : {-0.5, 1., 1.5, 0.01, 0.99}) { // past a neighbor or an end
    v->set_point(Point(x, 0));
    CHECK(only(Fault_kind::conformity, weft::check_conformity_2(mesh, pslg)));
  }
}

TEST_CASE("every face with a wrong flag is found")
{
  const Pslg pslg = archipelago();
  Cdt mesh = refine(pslg, 0.1);
  for (const auto f : mesh.all_face_handles()) {
    f->set_in_domain(!f->is_in_domain());
    CHECK(weft::check_domain_2(mesh).count(Fault_kind::domain) == 1);
    f->set_in_domain(!f->is_in_domain());
  }
  CHECK(weft::check_domain_2(mesh).ok());
  for (const auto f : mesh.finite_face_handles()) f->set_in_domain(true); // the hole filled
  const auto validity = weft::validate_2(mesh, pslg);
  CHECK(only(Fault_kind::domain, validity));
  CHECK(text(validity).find("the area of the domain is") != std::string::npos);
}

TEST_CASE("the area tells a mesh of another domain whose own flags agree")
{
  Pslg pslg = archipelago();
  Pslg smaller;
  add_loop(smaller, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const Cdt mesh = insert(pslg);
  CHECK(weft::check_domain_2(mesh).ok());
  const auto validity = weft::check_domain_2(mesh, smaller);
  CHECK(only(Fault_kind::domain, validity));
  CHECK(validity.count(Fault_kind::domain) == 1);

  Pslg open;
  open.points = {{0, 0}, {1, 0}, {0, 1}};
  open.segments = {{0, 1}};
  CHECK(text(weft::check_domain_2(mesh, open)).find("the input has no domain") != std::string::npos);
}

TEST_CASE("oversized triangles and constrained edges are counted")
{
  const Pslg pslg = archipelago();
  const Cdt mesh = refine(pslg, 0.05);
  for (const double size : {0.05, 0.04, 0.03, 0.001}) {
    const weft::Uniform_sizing<> sizing(size);
    const auto validity = weft::check_sizing_2(mesh, sizing);
    const auto measured = weft::measure_sizing_2(mesh, sizing);
    CHECK(validity.count(Fault_kind::sizing) == measured.triangles.oversized + measured.constrained_edges.oversized);
    CHECK(validity.ok() == (size == 0.05));
    CHECK(weft::check_sizing_2(mesh, sizing, 0.05 / size + 1e-9).ok());
  }
  CHECK(only(Fault_kind::sizing, weft::validate_2(mesh, pslg, weft::Uniform_sizing<>(0.04))));
  CHECK_THROWS_AS(weft::check_sizing_2(mesh, [](const Point&) { return 0.; }), weft::Option_error);
}

TEST_CASE("long lists of faults are cut, counts are not")
{
  const Cdt mesh = refine(archipelago(), 0.02);
  const auto validity = weft::check_sizing_2(mesh, weft::Uniform_sizing<>(1e-3));
  const std::size_t count = validity.count(Fault_kind::sizing);
  CHECK(count > weft::Validity_2::most_listed);
  CHECK(validity.faults.size() == weft::Validity_2::most_listed);
  CHECK(text(validity).find(std::to_string(count) + " faults in all") != std::string::npos);
}

TEST_CASE("a star of many spokes and nearly equal points conform")
{
  Pslg pslg;
  add_loop(pslg, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
  pslg.points.emplace_back(0, 0);
  for (int i = 0; i < 2000; ++i) {
    pslg.points.emplace_back(std::cos(i * std::acos(-1.) / 1000), std::sin(i * std::acos(-1.) / 1000));
    pslg.segments.push_back({pslg.points.size() - 1, 4});
  }
  CHECK_VALID(weft::validate_2(insert(pslg), pslg));

  Pslg twins;
  add_loop(twins, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
  const double x = 0.7, y = 0.3;
  twins.points.insert(twins.points.end(), {{-1, -0.5}, {x, y}, {std::nextafter(x, 0.), y}, {x, std::nextafter(y, 1.)}});
  for (const std::size_t i : {5u, 6u, 7u}) twins.segments.push_back({4, i});
  CHECK_VALID(weft::validate_2(insert(twins), twins));
}
