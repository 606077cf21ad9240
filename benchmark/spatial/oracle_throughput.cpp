// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time per query of the domain oracle against CGAL's AABB tree, on the same queries in the same process, one thread:
//   oracle_throughput [FILE...] [--queries N]
// Files are closed surfaces (.off, .obj, .stl, .ply). Without one: a sphere of 20,000 triangles. Times are user CPU
// time; the two take turns, and the best of five rounds counts.

#include "../common/program.h"

#include <weft/internal/boxes/cgal_aabb_tree.h>
#include <weft/IO/read_surface.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_3;
using Segment = K::Segment_3;
using Complex = weft::Piecewise_smooth_complex_3<K>;
using Mesh = CGAL::Surface_mesh<Point>;
using Tree = weft::internal::Triangle_tree_3<K>;

// One patch, no creases: the triangles are what queries cost.
Complex finished(Complex complex)
{
  complex.patches.assign(complex.triangles.size(), 0);
  complex.shells.assign(complex.triangles.size(), 0);
  complex.number_of_patches = complex.number_of_shells = 1;
  return complex;
}

Complex sphere(int rings, int sides)
{
  Complex complex;
  const double pi = std::acos(-1.);
  complex.points.emplace_back(0, 0, 1);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double theta = pi * i / rings, phi = 2 * pi * j / sides;
      complex.points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  complex.points.emplace_back(0, 0, -1);
  const auto at = [&](int ring, int side) { return std::size_t(1 + (ring - 1) * sides + side % sides); };
  for (int j = 0; j < sides; ++j) {
    complex.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      complex.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      complex.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
    complex.triangles.push_back({at(rings - 1, j + 1), at(rings - 1, j), complex.points.size() - 1});
  }
  return finished(complex);
}

Complex read(const std::string& file)
{
  return finished(weft::piecewise_smooth_complex(weft::IO::read_surface<K>(file), weft::Feature_options(0)));
}

Mesh mesh_of(const Complex& complex)
{
  Mesh mesh;
  for (const Point& p : complex.points) mesh.add_vertex(p);
  for (const auto& t : complex.triangles)
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  return mesh;
}

double seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double nanoseconds(std::size_t queries, const std::function<void()>& run)
{
  const double start = seconds();
  run();
  return (seconds() - start) / static_cast<double>(queries) * 1e9;
}

struct Row
{
  std::string name;
  std::function<std::size_t()> weft, cgal; // return a sum of answers: both have to agree
};

struct Queries
{
  std::vector<Segment> across, edges;
  std::vector<Point> anywhere, near_surface;
};

Queries make_queries(const Complex& complex, const CGAL::Bbox_3& box, std::size_t n)
{
  Queries result;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  const auto anywhere = [&] {
    return Point(box.xmin() + unit(random) * box.x_span(), box.ymin() + unit(random) * box.y_span(),
                 box.zmin() + unit(random) * box.z_span());
  };
  const auto near = [&](double size) {
    const Point p = complex.points[random() % complex.points.size()];
    return Point(p.x() + (unit(random) - 0.5) * size, p.y() + (unit(random) - 0.5) * size,
                 p.z() + (unit(random) - 0.5) * size);
  };
  for (std::size_t i = 0; i < n; ++i) {
    result.across.emplace_back(anywhere(), anywhere());
    const Point p = near(0.2 * longest);
    result.edges.emplace_back(p, Point(p.x() + 0.1 * longest * (unit(random) - 0.5),
                                       p.y() + 0.1 * longest * (unit(random) - 0.5),
                                       p.z() + 0.1 * longest * (unit(random) - 0.5)));
    result.anywhere.push_back(anywhere());
    result.near_surface.push_back(near(0.02 * longest));
  }
  return result;
}

void measure(const std::string& name, const Complex& complex, std::size_t n)
{
  double start = seconds();
  const weft::Polyhedral_oracle_3<K> oracle(complex);
  const double build = seconds() - start;
  const Mesh mesh = mesh_of(complex);
  std::vector<K::Triangle_3> triangles;
  for (const auto& t : complex.triangles)
    triangles.emplace_back(complex.points[t[0]], complex.points[t[1]], complex.points[t[2]]);
  start = seconds();
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  const double cgal_build = seconds() - start;
  tree.accelerate_distance_queries();
  const CGAL::Side_of_triangle_mesh<Mesh, K> side(mesh);
  const Queries queries = make_queries(complex, oracle.bbox(), n);

  const auto intersections = [&](const std::vector<Segment>& segments) {
    std::size_t sum = 0;
    std::vector<weft::Surface_hit_3<K>> hits;
    for (const Segment& s : segments) {
      hits.clear();
      oracle.intersect(s.source(), s.target(), hits);
      sum += hits.size();
    }
    return sum;
  };
  const auto cgal_intersections = [&](const std::vector<Segment>& segments) {
    std::size_t sum = 0;
    std::vector<Tree::Intersection_and_primitive_id<Segment>::Type> hits;
    for (const Segment& s : segments) {
      hits.clear();
      tree.all_intersections(s, std::back_inserter(hits));
      sum += hits.size();
    }
    return sum;
  };
  const auto tests = [&](const std::vector<Segment>& segments) {
    std::size_t sum = 0;
    for (const Segment& s : segments) sum += oracle.meets(s.source(), s.target());
    return sum;
  };
  const auto cgal_tests = [&](const std::vector<Segment>& segments) {
    std::size_t sum = 0;
    for (const Segment& s : segments) sum += tree.do_intersect(s);
    return sum;
  };
  const auto locations = [&](const std::vector<Point>& points) {
    std::size_t sum = 0;
    for (const Point& p : points) sum += static_cast<std::size_t>(oracle.subdomain(p));
    return sum;
  };
  const auto cgal_locations = [&](const std::vector<Point>& points) {
    std::size_t sum = 0;
    for (const Point& p : points) sum += side(p) == CGAL::ON_BOUNDED_SIDE;
    return sum;
  };
  // In units of 1e-6 of the box: enough to see that the answers agree.
  const auto distances = [&](const std::vector<Point>& points, const std::function<Point(const Point&)>& nearest) {
    double sum = 0;
    for (const Point& p : points) sum += std::sqrt(CGAL::squared_distance(p, nearest(p)));
    return static_cast<std::size_t>(std::llround(sum / oracle.bbox().x_span() / static_cast<double>(n) * 1e6));
  };
  const std::function<Point(const Point&)> closest = [&](const Point& p) { return oracle.closest(p).point; };
  const std::function<Point(const Point&)> cgal_closest = [&](const Point& p) { return tree.closest_point(p); };

  std::vector<Row> rows{
      {"intersections, across the box", [&] { return intersections(queries.across); },
       [&] { return cgal_intersections(queries.across); }},
      {"intersections, short, near the surface", [&] { return intersections(queries.edges); },
       [&] { return cgal_intersections(queries.edges); }},
      {"does a segment meet, across the box", [&] { return tests(queries.across); },
       [&] { return cgal_tests(queries.across); }},
      {"does a segment meet, short", [&] { return tests(queries.edges); }, [&] { return cgal_tests(queries.edges); }},
      {"location, anywhere", [&] { return locations(queries.anywhere); },
       [&] { return cgal_locations(queries.anywhere); }},
      {"location, near the surface", [&] { return locations(queries.near_surface); },
       [&] { return cgal_locations(queries.near_surface); }},
      {"closest point, anywhere", [&] { return distances(queries.anywhere, closest); },
       [&] { return distances(queries.anywhere, cgal_closest); }},
      {"closest point, near the surface", [&] { return distances(queries.near_surface, closest); },
       [&] { return distances(queries.near_surface, cgal_closest); }},
      {"clearance, anywhere",
       [&] {
         double sum = 0;
         for (const Point& p : queries.anywhere) sum += oracle.clearance(p);
         return static_cast<std::size_t>(sum > 0);
       },
       {}},
      {"clearance, near the surface",
       [&] {
         double sum = 0;
         for (const Point& p : queries.near_surface) sum += oracle.clearance(p);
         return static_cast<std::size_t>(sum > 0);
       },
       {}},
  };
  std::printf("\n%s: %zu triangles, built in %.1f ms (CGAL %.1f ms)\n\n", name.c_str(), complex.triangles.size(),
              build * 1e3, cgal_build * 1e3);
  std::printf("| query | weft, ns | CGAL, ns | ratio | answers agree |\n| --- | --- | --- | --- | --- |\n");
  for (const Row& row : rows) {
    double weft_time = 1e300, cgal_time = 1e300;
    std::size_t weft_answer = 0, cgal_answer = 0;
    for (int round = 0; round < 5; ++round) {
      weft_time = std::min(weft_time, nanoseconds(n, [&] { weft_answer = row.weft(); }));
      if (row.cgal && round < 2) cgal_time = std::min(cgal_time, nanoseconds(n, [&] { cgal_answer = row.cgal(); }));
    }
    if (!row.cgal)
      std::printf("| %s | %.0f | | | |\n", row.name.c_str(), weft_time);
    else
      std::printf("| %s | %.0f | %.0f | %.1f | %s |\n", row.name.c_str(), weft_time, cgal_time, cgal_time / weft_time,
                  weft_answer == cgal_answer
                      ? "yes"
                      : (std::to_string(weft_answer) + " / " + std::to_string(cgal_answer)).c_str());
  }
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("oracle_throughput", [&] {
    benchmark::Argument_reader reader(argc, argv);
    std::vector<std::string> files;
    std::size_t queries = 20000;
    while (reader.next()) {
      if (reader.is("--queries"))
        queries = static_cast<std::size_t>(reader.positive());
      else
        files.push_back(reader.operand());
    }
    for (const std::string& file : files) measure(file.substr(file.find_last_of('/') + 1), read(file), queries);
    if (files.empty()) measure("sphere", sphere(100, 100), queries);
  });
}
