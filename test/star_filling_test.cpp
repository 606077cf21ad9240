// SPDX-License-Identifier: GPL-3.0-or-later
//
// What fills the place of a vertex is what CGAL fills it with, whatever the points: both are the Delaunay triangulation
// with the same symbolic perturbation.

#include <weft/spatial/restricted/Mesh_triangulation_3.h>
#include <weft/spatial/restricted/Star_filling_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <random>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_3;
using Triangulation = weft::Mesh_triangulation_3<K>;
using Cell_handle = Triangulation::Cell_handle;
using Vertex_handle = Triangulation::Vertex_handle;
using Filling = weft::internal::Star_filling_3<Triangulation>;

/// Cells by their points, in order.
std::vector<std::array<Point, 4>> by_points(const std::vector<Cell_handle>& cells)
{
  std::vector<std::array<Point, 4>> all;
  for (const Cell_handle c : cells) {
    all.push_back({c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point()});
    std::sort(all.back().begin(), all.back().end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Points with their vertices, numbered, in a box of eight without numbers.
Triangulation triangulated(const std::vector<Point>& points, double scale)
{
  Triangulation tr;
  for (int i = 0; i < 8; ++i)
    tr.insert(Point(i & 1 ? 9 * scale : -8 * scale, i & 2 ? 9 * scale : -8 * scale, i & 4 ? 9 * scale : -8 * scale));
  int id = 0;
  for (const Point& p : points) {
    const std::size_t before = tr.number_of_vertices();
    const Vertex_handle v = tr.insert(p);
    if (tr.number_of_vertices() > before) v->set_id(id++);
  }
  return tr;
}

struct Cloud
{
  const char* name;
  double scale;
  std::function<Point(std::mt19937&)> draw;
};

double uniform(std::mt19937& random)
{
  return random() / 4294967296.0;
}

std::vector<Cloud> clouds()
{
  const auto lattice = [](std::mt19937& random) { return static_cast<double>(random() % 8) / 8; };
  return {{"at random", 1,
           [](std::mt19937& r) {
             const double x = uniform(r), y = uniform(r);
             return Point(x, y, uniform(r));
           }},
          {"on a lattice, cospherical by dozens", 1,
           [=](std::mt19937& r) {
             const double x = lattice(r), y = lattice(r);
             return Point(x - 0.3, y, lattice(r));
           }},
          {"nearly in a plane", 1,
           [](std::mt19937& r) {
             const double x = uniform(r), y = uniform(r);
             return Point(x, y, 1e-13 * uniform(r));
           }},
          {"far from the origin", 1,
           [](std::mt19937& r) {
             const double x = uniform(r), y = uniform(r);
             return Point(8 + x / 1e6, 8 + y / 1e6, 8 + uniform(r) / 1e6);
           }},
          {"on a sphere", 1,
           [](std::mt19937& r) {
             const double z = 2 * uniform(r) - 1, a = 6.3 * uniform(r), s = std::sqrt(1 - z * z);
             return Point(s * std::cos(a), s * std::sin(a), z);
           }},
          {"so small that sixth powers vanish", 1e-60, [=](std::mt19937& r) {
             const double x = lattice(r), y = lattice(r);
             return Point(1e-60 * x, 1e-60 * y, 1e-60 * uniform(r));
           }}};
}

} // namespace

TEST_CASE("the place of a vertex is filled as CGAL fills it")
{
  for (const Cloud& cloud : clouds()) {
    CAPTURE(cloud.name);
    std::mt19937 random(7);
    std::vector<Point> points;
    for (int i = 0; i < 400; ++i) points.push_back(cloud.draw(random));
    Triangulation tr = triangulated(points, cloud.scale);
    Triangulation other = tr;
    std::shuffle(points.begin(), points.end(), random);
    points.resize(points.size() * 4 / 5);
    Filling filling;
    std::size_t filled = 0;
    for (const Point& p : points) {
      Vertex_handle v, w;
      if (!tr.is_vertex(p, v)) continue; // twice in the list
      REQUIRE(other.is_vertex(p, w));
      std::vector<Cell_handle> star, made, others;
      tr.incident_cells(v, std::back_inserter(star));
      const bool found = filling.find(tr, v, star);
      if (found) {
        for (const Cell_handle c : filling.cells()) // they know their neighbours before they are there
          for (int i = 0; i < 4; ++i)
            for (int k = 1; k < 4; ++k) CHECK(c->neighbor(i)->has_vertex(c->vertex((i + k) & 3)));
        filling.replace(tr, v, star, made);
        ++filled;
      } else {
        tr.remove_and_give_new_cells(v, std::back_inserter(made));
      }
      other.remove_and_give_new_cells(w, std::back_inserter(others));
      REQUIRE(by_points(made) == by_points(others));
    }
    CHECK(tr.is_valid());
    CHECK(filled > points.size() / 2);
  }
}
