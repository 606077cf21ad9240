// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of moving many vertices at once: whatever the targets are, the triangulation is valid and constrained
// Delaunay afterwards, and what is reported is what has happened.

#include "fixtures/planar_fixtures.h"

#include <weft/planar/triangulation/Relocator_2.h>
#include <weft/planar/working/Vertex_remover_2.h>

#include <iterator>

namespace {

using namespace planar;
using Vertices = std::vector<Cdt::Vertex_handle>;
using Points = std::vector<Point>;
using Edges = std::set<std::pair<Point, Point>>;

/// The unit square with random points inside and on its sides, a wall across the middle with points on it and a
/// dangling one. All constraints are parallel to the axes, so points on them are exact.
struct Field_of_points
{
  explicit Field_of_points(unsigned seed, int n = 400) : random(seed)
  {
    insert_chain({0, 0}, {1, 0});
    insert_chain({1, 0}, {1, 1});
    insert_chain({1, 1}, {0, 1});
    insert_chain({0, 1}, {0, 0});
    walls.push_back(insert_chain({0, 0.5}, {1, 0.5}));
    walls.push_back(insert_chain({0.25, 0.125}, {0.25, 0.375}));
    for (int i = 0; i < n; ++i) inside.push_back(cdt.insert(Point(uniform(random, 0, 1), uniform(random, 0, 1))));
    int id = 0;
    for (const auto v : cdt.finite_vertex_handles()) v->set_id(id++);
    weft::mark_domain_by_parity(cdt);
  }

  /// Constraints through random points; returns the inner ones.
  Vertices insert_chain(const Point& a, const Point& b)
  {
    constexpr int pieces = 8;
    Vertices chain{cdt.insert(a)};
    for (int i = 1; i < pieces; ++i) {
      const double t = (i + uniform(random, -0.4, 0.4)) / pieces;
      chain.push_back(cdt.insert(Point(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()))));
    }
    chain.push_back(cdt.insert(b));
    for (std::size_t i = 1; i < chain.size(); ++i) cdt.insert_constraint(chain[i - 1], chain[i]);
    return {chain.begin() + 1, chain.end() - 1};
  }

  Point nearby(Cdt::Vertex_handle v, double distance)
  {
    return {v->point().x() + uniform(random, -distance, distance),
            v->point().y() + uniform(random, -distance, distance)};
  }

  /// On the wall of the vertex.
  Point on_wall(Cdt::Vertex_handle v)
  {
    return v->point().y() == 0.5 ? Point(uniform(random, 0, 1), 0.5) : Point(0.25, uniform(random, 0.125, 0.375));
  }

  Random random;
  Cdt cdt;
  std::vector<Vertices> walls;
  Vertices inside;
};

std::pair<Point, Point> ends(const Cdt& cdt, const Cdt::Edge& e)
{
  const Point &a = e.first->vertex(cdt.ccw(e.second))->point(), &b = e.first->vertex(cdt.cw(e.second))->point();
  return a < b ? std::make_pair(a, b) : std::make_pair(b, a);
}

Edges constraints(const Cdt& cdt)
{
  Edges result;
  for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e) result.insert(ends(cdt, *e));
  return result;
}

/// Edges whose two faces have cocircular corners could as well be the other diagonal.
std::size_t edges_missing_in(const Cdt& a, const Cdt& b)
{
  Edges of_b;
  for (auto e = b.finite_edges_begin(); e != b.finite_edges_end(); ++e) of_b.insert(ends(b, *e));
  std::size_t missing = 0;
  for (auto e = a.finite_edges_begin(); e != a.finite_edges_end(); ++e) {
    if (of_b.count(ends(a, *e))) continue;
    const auto f = e->first, n = f->neighbor(e->second);
    missing += a.is_infinite(f) || a.is_infinite(n) ||
               CGAL::side_of_oriented_circle(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point(),
                                             n->vertex(n->index(f))->point()) != CGAL::ON_ORIENTED_BOUNDARY;
  }
  return missing;
}

/// The constrained Delaunay triangulation of points and constraints from scratch.
Cdt rebuilt(const Cdt& cdt)
{
  Cdt result;
  for (const auto v : cdt.finite_vertex_handles()) result.insert(v->point());
  for (const auto& [a, b] : constraints(cdt)) result.insert_constraint(a, b);
  return result;
}

void check_same_as_from_scratch(const Cdt& cdt)
{
  CHECK(faults(weft::validate_2(cdt)) == "");
  CHECK(cdt.is_valid());
  const Cdt other = rebuilt(cdt);
  CHECK(other.number_of_vertices() == cdt.number_of_vertices());
  CHECK(constraints(other) == constraints(cdt));
  CHECK(edges_missing_in(cdt, other) == 0);
  CHECK(edges_missing_in(other, cdt) == 0);
}

/// Moves and checks all that must hold for any targets.
weft::internal::Relocation_counts move_and_check(Cdt& cdt, const Vertices& vertices, const Points& targets)
{
  std::map<Cdt::Vertex_handle, Point> before;
  for (const auto v : cdt.finite_vertex_handles()) before[v] = v->point();
  const std::size_t number_of_constraints = constraints(cdt).size();

  weft::internal::Relocator_2<Cdt> relocator(cdt);
  const weft::internal::Relocation_counts counts = relocator.move(vertices, targets);

  CHECK(counts.moved + counts.put_back == vertices.size());
  CHECK(counts.one_by_one <= counts.moved);
  std::size_t arrived = 0, already_there = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    arrived += vertices[i]->point() == targets[i];
    already_there += before[vertices[i]] == targets[i];
  }
  CHECK(counts.moved <= arrived);
  CHECK(arrived <= counts.moved + already_there);
  const std::set<Cdt::Vertex_handle> moving(vertices.begin(), vertices.end());
  std::size_t others_moved = 0;
  for (const auto& [v, p] : before) others_moved += !moving.count(v) && v->point() != p;
  CHECK(others_moved == 0);
  CHECK(cdt.number_of_vertices() == before.size());
  CHECK(constraints(cdt).size() == number_of_constraints);
  check_same_as_from_scratch(cdt);
  return counts;
}

} // namespace

TEST_CASE("small moves of all vertices are carried out at once and restore the Delaunay property")
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Field_of_points field(seed);
    Points targets;
    for (const auto v : field.inside) targets.push_back(field.nearby(v, 1e-5));
    const auto counts = move_and_check(field.cdt, field.inside, targets);
    CHECK(counts.moved >= field.inside.size() * 95 / 100);
  }
}

TEST_CASE("moves of any length leave a constrained Delaunay triangulation")
{
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const double length : {0.003, 0.03, 0.3, 3.0, 1e6}) {
      Field_of_points field(seed);
      for (int sweep = 0; sweep < 3; ++sweep) {
        Points targets;
        for (const auto v : field.inside) targets.push_back(field.nearby(v, length));
        move_and_check(field.cdt, field.inside, targets);
      }
    }
}

TEST_CASE("a few moved vertices leave all others alone")
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    Field_of_points field(seed);
    shuffle(field.inside, field.random);
    field.inside.resize(1 + below(field.random, 60));
    Points targets;
    for (const auto v : field.inside) targets.push_back(field.nearby(v, 0.05));
    move_and_check(field.cdt, field.inside, targets);
  }
}

TEST_CASE("vertices sent to one point don't merge")
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Field_of_points field(seed);
    const Point free(0.4, 0.3), wall(0.5, 0.5), vertex = field.inside.front()->point();
    for (const Point& p : {free, wall, vertex, Point(0, 0), Point(5, 5)})
      move_and_check(field.cdt, field.inside, Points(field.inside.size(), p));
  }
}

TEST_CASE("pairs with identical targets don't merge")
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Field_of_points field(seed);
    Points targets;
    for (std::size_t i = 0; i < field.inside.size(); ++i)
      targets.push_back(i % 2 ? targets.back() : field.nearby(field.inside[i], 0.02));
    move_and_check(field.cdt, field.inside, targets);
  }
}

TEST_CASE("vertices don't leave the convex hull and don't cross walls")
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Field_of_points field(seed);
    Points targets;
    std::map<Cdt::Vertex_handle, bool> below_wall;
    for (const auto v : field.inside) {
      below_wall[v] = v->point().y() < 0.5;
      const Point &p = v->point(), mirrored(p.x(), 1 - p.y());
      targets.push_back(seed % 2 ? mirrored : Point(0.5 + 9 * (p.x() - 0.5), 0.5 + 9 * (p.y() - 0.5)));
    }
    move_and_check(field.cdt, field.inside, targets);
    std::size_t strayed = 0;
    for (const auto v : field.inside) {
      const Point& p = v->point();
      strayed += !(p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1) || (p.y() < 0.5) != below_wall[v];
    }
    CHECK(strayed == 0);
  }
}

TEST_CASE("vertices on the hull stay, and so do all vertices whose target is their place")
{
  Field_of_points field(1);
  Vertices all;
  Points places, shifted;
  for (const auto v : field.cdt.finite_vertex_handles()) {
    all.push_back(v);
    places.push_back(v->point());
    shifted.push_back(field.nearby(v, 0.01));
  }
  const Fingerprint before = fingerprint(field.cdt);
  const auto counts = move_and_check(field.cdt, all, places);
  CHECK(counts.flips == 0);
  CHECK(before == fingerprint(field.cdt));

  Vertices hull;
  Points outwards, where_they_were;
  auto around = field.cdt.incident_vertices(field.cdt.infinite_vertex());
  const auto done = around;
  do {
    hull.push_back(around);
    where_they_were.push_back(around->point());
    outwards.push_back(field.nearby(around, 0.01));
  } while (++around != done);
  CHECK(move_and_check(field.cdt, hull, outwards).put_back == hull.size());
  for (std::size_t i = 0; i < hull.size(); ++i) CHECK(hull[i]->point() == where_they_were[i]);
}

TEST_CASE("vertices slide on their walls, keep their order there, and everything else moves at the same time")
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    Field_of_points field(seed);
    for (int sweep = 0; sweep < 5; ++sweep) {
      Vertices vertices = field.inside;
      Points targets;
      for (const auto v : vertices) targets.push_back(field.nearby(v, 0.05));
      for (const Vertices& wall : field.walls)
        for (const auto v : wall) {
          vertices.push_back(v);
          targets.push_back(field.on_wall(v));
        }
      move_and_check(field.cdt, vertices, targets);
      for (const Vertices& wall : field.walls)
        for (std::size_t i = 0; i + 1 < wall.size(); ++i) CHECK(wall[i]->point() < wall[i + 1]->point());
    }
    for (const auto v : field.walls[0]) CHECK(v->point().y() == 0.5);
    for (const auto v : field.walls[1]) CHECK(v->point().x() == 0.25);
  }
}

TEST_CASE("targets at the resolution of coordinates leave no flat face")
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Field_of_points field(seed, 150);
    for (const double spread : {0.0, 1e-300, 1e-18, 1e-16, 1e-15}) {
      Points targets;
      for (std::size_t i = 0; i < field.inside.size(); ++i)
        targets.emplace_back(0.6 + uniform(field.random, -spread, spread),
                             0.3 + uniform(field.random, -spread, spread));
      move_and_check(field.cdt, field.inside, targets);
    }
  }
}

TEST_CASE("a single vertex moves within its star only")
{
  Field_of_points field(3);
  weft::internal::Relocator_2<Cdt> relocator(field.cdt);
  std::size_t flips = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto v = field.inside[below(field.random, field.inside.size())];
    const Point old = v->point(), target = field.nearby(v, 0.05);
    const bool moved = relocator.move_within_star(v, target, flips);
    if (v->point() != (moved ? target : old)) FAIL("the vertex isn't where it was said to be");
    refused += !moved;
  }
  CHECK(flips > 0);
  CHECK(refused > 0);
  CHECK(refused < 3000);
  check_same_as_from_scratch(field.cdt);
}

TEST_CASE("relocation is the same wherever the triangulation lies in memory")
{
  const auto run = [] {
    Field_of_points field(5, 1000);
    weft::internal::Relocator_2<Cdt> relocator(field.cdt);
    for (int sweep = 0; sweep < 5; ++sweep) {
      Points targets;
      for (const auto v : field.inside) targets.push_back(field.nearby(v, 0.03));
      relocator.move(field.inside, targets);
    }
    return fingerprint(field.cdt);
  };
  const Fingerprint first = run();
  const Memory_noise noise(1);
  CHECK(first == run());
}

TEST_CASE("a vertex that was inserted in the middle of an edge can be removed again")
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    INFO("seed " << seed);
    Field_of_points field(seed, 60);
    Cdt& cdt = field.cdt;
    weft::internal::Relocator_2<Cdt> relocator(cdt);
    weft::internal::Vertex_remover_2<Cdt> remover(cdt, relocator);
    const auto all_edges = [&cdt] {
      Edges result;
      for (const auto& e : cdt.finite_edges()) result.insert(ends(cdt, e));
      return result;
    };
    const Edges before = all_edges();
    std::size_t on_line = 0;
    for (const auto& [a, b] : before) {
      const Point p = CGAL::midpoint(a, b);
      int li;
      Cdt::Locate_type type;
      const auto f = cdt.locate(p, type, li);
      if (type == Cdt::EDGE && cdt.is_constrained({f, li})) continue;
      on_line += type == Cdt::EDGE;
      const bool is_inside = f->is_in_domain();
      const auto v = cdt.insert(p);
      auto face = cdt.incident_faces(v);
      const auto done = face;
      do face->set_in_domain(is_inside);
      while (++face != done);
      REQUIRE(remover.remove(v));
    }
    CHECK(on_line > 50);
    CHECK(cdt.is_valid());
    CHECK(all_edges() == before);
  }
  // Between both pairs of its neighbors.
  Cdt cdt;
  const Vertices corners{cdt.insert({0, 0}), cdt.insert({4, 0}), cdt.insert({4, 4}), cdt.insert({0, 4})};
  for (std::size_t i = 0; i < 4; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 4]);
  const auto center = cdt.insert({2, 2});
  weft::mark_domain_by_parity(cdt);
  weft::internal::Relocator_2<Cdt> relocator(cdt);
  CHECK(weft::internal::Vertex_remover_2<Cdt>(cdt, relocator).remove(center));
  CHECK(cdt.is_valid());
  std::size_t inside = 0, constrained = 0;
  for (const auto f : cdt.finite_face_handles()) inside += f->is_in_domain();
  for (const auto& e : cdt.finite_edges()) constrained += cdt.is_constrained(e);
  CHECK(inside == 2);
  CHECK(constrained == 4);
}
