// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of spatial optimisation: where smoothers want vertices to be, what moving many vertices at once leaves
// behind, that smoothing and coarsening undo nothing that refinement has achieved, and the whole interleaved run.

#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/criteria/Deviation_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/optimise/coarsen_3.h>
#include <weft/spatial/optimise/Dynamic_sizing_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/optimise/smoothers_3.h>
#include <weft/spatial/restricted/check_restricted_3.h>
#include <weft/spatial/run/Optimisation_plan_3.h>

#include <CGAL/Delaunay_triangulation_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace meshing;
using Restricted = weft::Restricted_delaunay_3<Oracle>;
using Vector = K::Vector_3;
using Triangulation = Restricted::Triangulation;
using Vertex_handle = Restricted::Vertex_handle;
using Cell_handle = Restricted::Cell_handle;

double uniform(std::mt19937& random)
{
  return random() / 4294967295.0;
}

Vector random_vector(std::mt19937& random)
{
  const double x = 2 * uniform(random) - 1, y = 2 * uniform(random) - 1, z = 2 * uniform(random) - 1;
  return Vector(x, y, z);
}

/// What smoothers need of a mesh that is but a triangulation.
struct Bare_mesh
{
  using Kernel = K;
  using Point = K::Point_3;
  using Vertex_handle = Triangulation::Vertex_handle;
  using Cell_handle = Triangulation::Cell_handle;

  struct No_creases
  {
    std::vector<Restricted::Crease_edge> edges() const { return {}; }
  };
  No_creases creases() const { return {}; }
  const Restricted::Restricted_facet* facet(Cell_handle, int) const { return nullptr; }
};

/// A vertex in the origin and others around it, at distance 1 or scattered; cells with centroids below a plane belong
/// to the domain.
struct Ring
{
  Triangulation triangulation;
  Vertex_handle center;
  std::vector<Cell_handle> star;

  Ring(int n, bool on_sphere, double plane, unsigned seed)
  {
    std::mt19937 random(seed);
    center = triangulation.insert(Point(0, 0, 0));
    while (static_cast<int>(triangulation.number_of_vertices()) < n) {
      const Vector v = random_vector(random);
      const double length = std::sqrt(v.squared_length());
      if (length > 1 || length < 0.2) continue;
      triangulation.insert(CGAL::ORIGIN + (on_sphere ? 1 : 0.7 + 0.3 * uniform(random)) / length * v);
    }
    int id = 0;
    for (const auto v : triangulation.finite_vertex_handles()) v->set_id(id++);
    for (const auto c : triangulation.all_cell_handles()) c->set_subdomain(0);
    for (const auto c : triangulation.finite_cell_handles()) {
      c->set_circumcenter(weft::internal::circumcenter_3<K>(c->vertex(0)->point(), c->vertex(1)->point(),
                                                            c->vertex(2)->point(), c->vertex(3)->point()));
      double z = 0;
      for (int i = 0; i < 4; ++i) z += c->vertex(i)->point().z();
      if (z / 4 < plane) c->set_subdomain(1);
    }
    triangulation.incident_cells(center, std::back_inserter(star));
  }

  template <class Smoother, class Sizes>
  Point target(const Smoother& smoother, const Sizes& sizes) const
  {
    const Bare_mesh mesh;
    const weft::Smoothing_context_3<Bare_mesh, Sizes> context(mesh, sizes);
    const std::optional<Point> p = smoother(context, center, star);
    REQUIRE(p);
    return *p;
  }
};

double norm(const Vector& v)
{
  return std::sqrt(v.squared_length());
}

/// Twenty times the ODT energy of the domain's cells, with one vertex elsewhere.
double energy(const std::vector<Cell_handle>& star, Vertex_handle moved, const Point& to)
{
  double sum = 0;
  for (const auto c : star) {
    if (c->subdomain() == 0) continue;
    std::array<Point, 4> p;
    for (int i = 0; i < 4; ++i) p[i] = c->vertex(i) == moved ? to : c->vertex(i)->point();
    double edges = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j) edges += CGAL::squared_distance(p[i], p[j]);
    sum += CGAL::volume(p[0], p[1], p[2], p[3]) * edges;
  }
  return sum;
}

/// Refined meshes that have inner vertices, patches and creases.
struct Case
{
  Surface surface;
  double size, approximation;
};
std::vector<Case> cases()
{
  return {{surfaces::torus(48, 24), 0.3, 0.02}, {surfaces::cylinder(40), 0.4, 0.02}, {surfaces::l_shape(), 0.3, 0}};
}

using Cell_set = std::set<std::array<Point, 4>>;

template <class Any_triangulation>
Cell_set cells_of(const Any_triangulation& tr)
{
  Cell_set cells;
  for (const auto c : tr.finite_cell_handles()) {
    std::array<Point, 4> p;
    for (int i = 0; i < 4; ++i) p[static_cast<std::size_t>(i)] = c->vertex(i)->point();
    std::sort(p.begin(), p.end());
    cells.insert(p);
  }
  return cells;
}

void check_delaunay(const Restricted& mesh)
{
  CHECK(mesh.triangulation().is_valid());
  std::vector<Point> points;
  for (const auto v : mesh.triangulation().finite_vertex_handles()) points.push_back(v->point());
  const CGAL::Delaunay_triangulation_3<K> scratch(points.begin(), points.end());
  CHECK(cells_of(mesh.triangulation()) == cells_of(scratch));
  const auto agreement = weft::check_restricted_3(mesh);
  INFO(agreement);
  CHECK(agreement.ok());
}

/// Everything that refinement guarantees.
void check_criteria(const Restricted& mesh, const Oracle& oracle, const Criteria& criteria, double approximation)
{
  check_delaunay(mesh);
  check_complete(weft::tetrahedral_mesh(mesh), oracle, criteria, approximation);
}

} // namespace

TEST_CASE("a vertex whose neighbours lie on a sphere around it stays, with a full ring or a partial one")
{
  const auto size = [](Vertex_handle) { return 0.37; };
  for (const double plane : {2., 0.2, 0., -0.2})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Ring ring(40, true, plane, seed);
      INFO("cells below " << plane << ", seed " << seed);
      CHECK(norm(ring.target(weft::Natural_odt_3(), size) - Point(0, 0, 0)) < 1e-9);
    }
}

TEST_CASE("Natural ODT and ODT agree inside, and put a vertex where the ODT energy of its star is least")
{
  const auto size = [](Vertex_handle) { return 1.; };
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Ring ring(30, false, 2, seed);
    const Point p = ring.target(weft::Odt_3(), size);
    CHECK(norm(p - ring.target(weft::Natural_odt_3(), size)) < 1e-9);
    const double least = energy(ring.star, ring.center, p);
    for (const Vector& d : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)}) {
      const double h = 1e-4,
                   slope = (energy(ring.star, ring.center, p + h * d) - energy(ring.star, ring.center, p - h * d)) /
                           (2 * h);
      CHECK(std::abs(slope) < 1e-5 * least);
      CHECK(energy(ring.star, ring.center, p + 0.1 * d) > least);
    }
  }
}

TEST_CASE("a constant sizing field gives the uniform formulas back, whatever the constant")
{
  for (const double plane : {2., 0.1})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Ring ring(30, false, plane, seed);
      const auto one = [](Vertex_handle) { return 1.; };
      const auto other = [](Vertex_handle) { return 123.4; };
      CHECK(norm(ring.target(weft::Natural_odt_3(), one) - ring.target(weft::Natural_odt_3(), other)) < 1e-12);
      CHECK(norm(ring.target(weft::Odt_3(), one) - ring.target(weft::Odt_3(), other)) < 1e-12);
    }
}

TEST_CASE("Lloyd's position is the centroid of the Voronoi cell, as sampling finds it")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  Options options = refinement();
  options.lattice = false;
  const auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.3, 0), options);
  const auto size = [](Vertex_handle) { return 1.; };
  const weft::Smoothing_context_3<Restricted, decltype(size)> context(mesh, size);
  std::mt19937 random(5);
  int tested = 0;
  for (const auto v : mesh.vertices()) {
    if (v->location().dimension < 3 || oracle.clearance(v->point()) < 0.3) continue;
    std::vector<Cell_handle> star;
    mesh.triangulation().incident_cells(v, std::back_inserter(star));
    double reach = 0;
    for (const auto c : star) reach = (std::max)(reach, norm(c->circumcenter() - v->point()));
    Vector sum(0, 0, 0);
    int inside = 0;
    while (inside < 20000) {
      const Vector d = reach * random_vector(random);
      if (d.squared_length() > reach * reach || mesh.triangulation().nearest_vertex(v->point() + d, star[0]) != v)
        continue;
      sum = sum + d;
      ++inside;
    }
    const auto p = weft::Lloyd_3()(context, v, star);
    REQUIRE(p);
    CHECK(norm(*p - v->point() - sum / inside) < 0.02 * reach);
    if (++tested == 5) break;
  }
  CHECK(tested == 5);
}

TEST_CASE("dynamic sizes are K-Lipschitz along edges and the largest that are")
{
  const Oracle oracle = oracle_of(surfaces::torus(48, 24));
  const auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.3, 0.01), refinement());
  for (const double lipschitz : {0.1, 0.5, 2.}) {
    weft::internal::Dynamic_sizing_3<Restricted> sizing(lipschitz), free(1e9);
    sizing.update(mesh);
    free.update(mesh); // as good as ungraded
    const Mesh arrays = weft::tetrahedral_mesh(mesh);
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const auto& c : arrays.cells)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) edges.insert(std::minmax(c[i], c[j]));
    // Brute force: relax all edges until nothing changes.
    const std::size_t n = arrays.points.size();
    REQUIRE(n == mesh.vertices().size());
    std::map<Point, std::size_t> index;
    for (std::size_t i = 0; i < n; ++i) index[arrays.points[i]] = i;
    std::vector<double> sum(n, 0), count(n, 0), expected(n);
    for (const auto& [a, b] : edges) {
      const double length = std::sqrt(CGAL::squared_distance(arrays.points[a], arrays.points[b]));
      for (const std::size_t v : {a, b}) sum[v] += length, ++count[v];
    }
    for (std::size_t i = 0; i < n; ++i) expected[i] = sum[i] / count[i];
    for (const auto v : mesh.vertices()) CHECK(free(v) == Approx(expected[index[v->point()]]));
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b] : edges) {
        const double reach = lipschitz * std::sqrt(CGAL::squared_distance(arrays.points[a], arrays.points[b]));
        for (const auto& [x, y] : {std::make_pair(a, b), std::make_pair(b, a)})
          if (expected[x] > (expected[y] + reach) * (1 + 1e-12)) expected[x] = expected[y] + reach, changed = true;
      }
    }
    for (const auto v : mesh.vertices()) CHECK(sizing(v) == Approx(expected[index[v->point()]]));
  }
}

TEST_CASE("after many vertices have moved at once, the triangulation is that of the points from scratch")
{
  std::mt19937 random(3);
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation), refinement());
    weft::internal::Relocation_counts_3 all;
    for (const double part : {1., 0.3, 0.02})
      for (const double step : {0.001, 0.01, 0.1, 0.5}) {
        std::vector<int> ids;
        std::vector<Point> targets;
        for (const auto v : mesh.vertices()) {
          if (v->location().dimension < 1 || uniform(random) > part) continue;
          Point p = v->point() + step * c.size * random_vector(random);
          if (v->location().dimension == 1) p = oracle.project_on_crease(p, v->location().index);
          if (v->location().dimension == 2) p = oracle.project_on_patch(p, v->location().index).point;
          ids.push_back(v->id());
          targets.push_back(p);
        }
        const auto locations = [&mesh = mesh] {
          std::vector<weft::Vertex_location_3> all_locations;
          for (const auto v : mesh.vertices()) all_locations.push_back(v->location());
          return all_locations;
        };
        const auto before = locations();
        const weft::internal::Relocation_counts_3 counts = weft::internal::relocate(mesh, ids, targets);
        INFO("part " << part << ", step " << step);
        CHECK(counts.in_place + counts.one_by_one + counts.rebuilt + counts.put_back == ids.size());
        CHECK(before == locations());
        std::size_t there = 0;
        for (std::size_t i = 0; i < ids.size(); ++i)
          there += mesh.vertices()[static_cast<std::size_t>(ids[i])]->point() == targets[i];
        CHECK(there + counts.put_back == ids.size());
        check_delaunay(mesh);
        all += counts;
      }
    CHECK(all.in_place > 0);
    CHECK(all.one_by_one > 0);
    CHECK(all.rebuilt > 0);
    CHECK(all.flips > 0);
  }
}

TEST_CASE("vertices that may stay do so instead of being moved one by one, and the others move in place")
{
  std::mt19937 random(4);
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation), refinement());
    std::size_t staying = 0;
    for (int round = 0; round < 4; ++round) {
      std::vector<int> ids;
      std::vector<Point> targets, before;
      for (const auto v : mesh.vertices()) {
        if (v->location().dimension < 3) continue;
        ids.push_back(v->id());
        before.push_back(v->point());
        targets.push_back(v->point() + 0.25 * c.size * random_vector(random));
      }
      std::vector<std::size_t> stayed;
      const weft::internal::Relocation_counts_3 counts = weft::internal::relocate(mesh, ids, targets, &stayed);
      CHECK(counts.one_by_one == 0);
      CHECK(counts.put_back == stayed.size());
      CHECK(std::is_sorted(stayed.begin(), stayed.end()));
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const bool stays = std::binary_search(stayed.begin(), stayed.end(), i);
        CHECK(mesh.vertices()[static_cast<std::size_t>(ids[i])]->point() == (stays ? before[i] : targets[i]));
      }
      staying += stayed.size();
      check_delaunay(mesh);
    }
    CHECK(staying > 0);
  }
}

/// Random points with running ids, in a box whose corners have none.
Triangulation random_triangulation(unsigned seed, int n)
{
  std::mt19937 random(seed);
  Triangulation tr;
  for (int i = 0; i < 8; ++i) tr.insert(Point(i & 1 ? 9 : -9, i & 2 ? 9 : -9, i & 4 ? 9 : -9));
  for (int i = 0; i < n; ++i) tr.insert(Point(0, 0, 0) + random_vector(random))->set_id(i);
  return tr;
}

TEST_CASE("where flips are stuck, a few cells built anew set them free")
{
  weft::internal::Relocation_counts_3 all;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Triangulation tr = random_triangulation(seed, 4000);
    const double step = 0.02 * (1 + seed % 4); // neighbours are 0.07 apart
    std::mt19937 random(seed + 100);
    std::vector<Vertex_handle> vertices;
    std::vector<Point> targets;
    for (const auto v : tr.finite_vertex_handles())
      if (v->id() >= 0) vertices.push_back(v), targets.push_back(v->point() + step * random_vector(random));
    std::vector<std::size_t> deferred;
    weft::internal::Relocation_counts_3 counts;
    weft::internal::Relocator_3<Triangulation> relocator(tr);
    const auto ignore = [](Cell_handle) {};
    relocator.place(vertices, targets, ignore, deferred);
    relocator.restore_delaunay(ignore, counts);
    CHECK(tr.tds().is_valid());
    std::vector<Point> points;
    for (const auto v : tr.finite_vertex_handles()) points.push_back(v->point());
    const CGAL::Delaunay_triangulation_3<K> scratch(points.begin(), points.end());
    CHECK(cells_of(tr) == cells_of(scratch));
    all += counts;
  }
  CHECK(all.flips > 0);
  CHECK(all.regions > 0);
  CHECK(all.stuck == 0);
}

TEST_CASE("a region of a Delaunay triangulation that is built anew is as it was")
{
  Triangulation tr = random_triangulation(5, 300);
  const auto before = cells_of(tr);
  std::mt19937 random(6);
  weft::internal::Region_rebuilder_3<Triangulation> rebuilder(tr);
  for (int round = 0; round < 50; ++round) {
    std::vector<Cell_handle> cells;
    for (const auto c : tr.finite_cell_handles())
      if (c->vertex(0)->id() >= 0 && c->vertex(1)->id() >= 0 && c->vertex(2)->id() >= 0 && c->vertex(3)->id() >= 0)
        cells.push_back(c);
    const Cell_handle c = cells[random() % cells.size()];
    std::set<Cell_handle> gone;
    const auto made = rebuilder.rebuild(c, static_cast<int>(random() % 4), [&](Cell_handle d) { gone.insert(d); });
    CHECK(!made.empty());
    CHECK(made.size() == gone.size());
    CHECK(gone.count(c) == 1);
    CHECK(tr.is_valid());
    CHECK(cells_of(tr) == before);
  }
}

TEST_CASE("a mesh sorted in memory is the same mesh")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    Restricted mesh(oracle);
    {
      auto [refined, report] = weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation), refinement());
      std::vector<Point> points;
      std::vector<weft::Vertex_location_3> locations;
      std::vector<std::size_t> order;
      for (std::size_t i = 0; i < refined.vertices().size(); ++i) order.push_back(i);
      std::shuffle(order.begin(), order.end(), std::mt19937(7));
      for (const std::size_t i : order) {
        points.push_back(refined.vertices()[i]->point());
        locations.push_back(refined.vertices()[i]->location());
      }
      mesh.insert(points, locations);
    }
    const auto picture = [&] {
      std::vector<std::pair<Point, weft::Vertex_location_3>> vertices;
      for (const auto v : mesh.vertices()) vertices.emplace_back(v->point(), v->location());
      std::vector<std::pair<int, int>> creases;
      for (const auto& e : mesh.creases().edges()) creases.emplace_back(e.source->id(), e.target->id());
      std::vector<Point> steiner;
      for (const auto& f : mesh.facets()) steiner.push_back(f.steiner);
      return std::make_tuple(vertices, cells_of(mesh.triangulation()), creases, steiner);
    };
    const auto before = picture();
    weft::internal::sort_in_memory(mesh);
    CHECK(picture() == before);
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) CHECK(mesh.vertices()[i]->id() == static_cast<int>(i));
    check_delaunay(mesh);
    std::vector<int> ids; // it can be worked with
    std::vector<Point> targets;
    std::mt19937 random(8);
    for (const auto v : mesh.vertices())
      if (v->location().dimension == 3)
        ids.push_back(v->id()), targets.push_back(v->point() + 0.02 * c.size * random_vector(random));
    weft::internal::relocate(mesh, ids, targets);
    check_delaunay(mesh);
  }
}

TEST_CASE("facets listed at vertices are those that have them as corners, also after changes")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation), refinement());
    using Stars = std::vector<std::set<const Restricted::Restricted_facet*>>;
    const auto listed = [&mesh = mesh] {
      Stars all;
      for (const auto v : mesh.vertices()) {
        all.emplace_back();
        mesh.visit_facets_at(v, [&](const auto& f) { CHECK(all.back().insert(&f).second); });
      }
      return all;
    };
    const auto by_corners = [&mesh = mesh] {
      Stars all(mesh.vertices().size());
      for (const auto& f : mesh.facets())
        if (f.cell != Restricted::Cell_handle())
          for (int i = 1; i < 4; ++i) all[static_cast<std::size_t>(f.cell->vertex((f.index + i) & 3)->id())].insert(&f);
      return all;
    };
    CHECK(listed() == by_corners());
    const auto found = std::find_if(mesh.vertices().begin(), mesh.vertices().end(),
                                    [](auto v) { return v->location().dimension == 2; });
    REQUIRE(found != mesh.vertices().end());
    const std::size_t before = mesh.vertices().size();
    weft::internal::Vertex_transaction_3<Restricted> removal(mesh, *found);
    removal.leave_out();
    CHECK(listed() == by_corners());
    CHECK(mesh.vertices().size() == before - 1);
    removal.roll_back();
    CHECK(listed() == by_corners());
    weft::internal::sort_in_memory(mesh);
    CHECK(listed() == by_corners());
    CHECK(mesh.vertices().size() == before);
  }
}

TEST_CASE("vertices that are sent to the same place don't end up in one")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.3, 0), refinement());
  for (const bool all : {false, true}) {
    std::vector<int> ids;
    for (const auto v : mesh.vertices())
      if (v->location().dimension == 3 && (all || ids.size() < 2)) ids.push_back(v->id());
    REQUIRE(ids.size() >= 2);
    const std::size_t n = mesh.vertices().size();
    const auto counts = weft::internal::relocate(mesh, ids, std::vector<Point>(ids.size(), Point(0.503, 0.501, 0.497)));
    CHECK(counts.put_back > 0);
    CHECK(mesh.triangulation().number_of_vertices() == n + 8);
    check_delaunay(mesh);
  }
}

TEST_CASE("with uniform sizes every sweep that is kept lowers the ODT energy")
{
  const auto smoothed = [](auto smoother, bool keep) {
    const Oracle oracle = oracle_of(surfaces::sphere(3));
    const Criteria criteria = criteria_of(0.25, 0);
    Options meshing_options = refinement();
    meshing_options.lattice = false;
    auto [mesh, report] = weft::make_mesh_3(oracle, criteria, meshing_options);
    weft::Smooth_options_3 options;
    options.uniform = true;
    options.keep_criteria = keep;
    options.max_sweeps = 1;
    std::size_t kept = 0;
    for (int sweep = 0; sweep < 8; ++sweep) {
      const weft::Smooth_report_3 r = weft::smooth_3(mesh, criteria, options, smoother);
      CHECK(r.energy_after <= r.energy_before);
      if (r.sweeps > 0) CHECK(r.energy_after < r.energy_before);
      kept += r.sweeps;
    }
    CHECK(kept >= 3);
    check_delaunay(mesh);
  };
  smoothed(weft::Odt_3(), false);
  smoothed(weft::Natural_odt_3(), false);
  smoothed(weft::Odt_3(), true);
  smoothed(weft::Natural_odt_3(), true);
}

TEST_CASE("smoothing moves vertices and keeps every criterion, with any smoother")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    const Criteria criteria = criteria_of(c.size, c.approximation);
    const auto run = [&](auto smoother) {
      auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, refinement());
      REQUIRE(refined.ok());
      const std::size_t n = mesh.vertices().size();
      const weft::Smooth_report_3 report = weft::smooth_3(mesh, criteria, weft::Smooth_options_3(), smoother);
      CHECK(report.sweeps > 0);
      CHECK(report.moves > 0);
      CHECK(mesh.vertices().size() == n);
      check_criteria(mesh, oracle, criteria, c.approximation);
      const auto& moved = report.relocations;
      CHECK(moved.in_place + moved.one_by_one + moved.rebuilt + moved.put_back >= report.moves);
    };
    run(weft::Natural_odt_3());
    run(weft::Odt_3());
    run(weft::Lloyd_3());
  }
}

TEST_CASE("vertices among excellent cells are locked")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const Criteria criteria = criteria_of(0.1, 0);
  auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, refinement()); // mostly lattice
  weft::Smooth_options_3 options;
  options.max_sweeps = 1;
  const auto locked = weft::smooth_3(mesh, criteria, options).locked;
  CHECK(locked > mesh.vertices().size() / 10);
  options.locked_smallest = options.locked_largest = 70;
  CHECK(weft::smooth_3(mesh, criteria, options).locked == 0);
}

TEST_CASE("coarsening takes vertices away and keeps every criterion")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    const Criteria criteria = criteria_of(c.size, c.approximation);
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, refinement());
    REQUIRE(refined.ok());
    const std::size_t n = mesh.vertices().size();
    const weft::Coarsen_report_3 report = weft::coarsen_3(mesh, criteria);
    CHECK(report.removed > 0);
    CHECK(mesh.vertices().size() + report.removed == n);
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) CHECK(mesh.vertices()[i]->id() == static_cast<int>(i));
    check_criteria(mesh, oracle, criteria, c.approximation);
  }
}

TEST_CASE("a coarsening that its caller ends by an exception leaves a mesh without gaps in its numbers")
{
  const Oracle oracle = oracle_of(surfaces::torus(48, 24));
  const Criteria criteria = criteria_of(0.3, 0.02);
  auto [mesh, report] = weft::make_mesh_3(oracle, criteria, refinement());
  const std::size_t n = mesh.vertices().size();
  weft::Coarsen_options_3 options;
  options.go_on = [calls = 0]() mutable {
    if (++calls == 3) throw std::runtime_error("enough");
    return true;
  };
  CHECK_THROWS_AS(weft::coarsen_3(mesh, criteria, options), std::runtime_error);
  CHECK(mesh.vertices().size() < n);
  CHECK(mesh.triangulation().number_of_vertices() == mesh.vertices().size() + 8);
  for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
    REQUIRE(mesh.vertices()[i] != Restricted::Vertex_handle());
    CHECK(mesh.vertices()[i]->id() == static_cast<int>(i));
  }
  const auto agreement = weft::check_restricted_3(mesh);
  INFO(agreement);
  CHECK(agreement.ok());
}

TEST_CASE("coarsening with an angle makes no cell below it that isn't better than those it replaces")
{
  const Oracle oracle = oracle_of(surfaces::torus(48, 24));
  const Criteria criteria = criteria_of(0.3, 0.02);
  Options options = refinement();
  options.min_dihedral_angle = 12;
  auto [mesh, report] = weft::make_mesh_3(oracle, criteria, options);
  weft::Coarsen_options_3 coarsen;
  coarsen.min_dihedral_angle = 90;
  weft::coarsen_3(mesh, criteria, coarsen);
  CHECK(weft::measure_quality_3(weft::tetrahedral_mesh(mesh)).smallest_dihedral.degrees >=
        report.smallest_dihedral - 1e-9);
}

TEST_CASE("the whole run meets all criteria with fewer vertices than refinement and the angle asked for")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    const Criteria criteria = criteria_of(c.size, c.approximation);
    const auto refined = weft::make_mesh_3(oracle, criteria, refinement()).report;
    Options options;
    options.min_dihedral_angle = 15;
    const auto [mesh, report] = weft::make_mesh_3(oracle, criteria, options);
    INFO(report);
    CHECK(report.ok());
    CHECK(report.manifold);
    CHECK(report.vertices < refined.vertices);
    CHECK(report.refined_smallest_dihedral == Approx(refined.smallest_dihedral).margin(1e-6));
    CHECK(report.smallest_dihedral >= report.smoothed_smallest_dihedral);
    CHECK(report.smallest_dihedral >= 15);
    CHECK(report.coarsened > 0);
    CHECK(report.smoothing_sweeps > 0);
    check_consistent(mesh, report);
    check_criteria(mesh, oracle, criteria, c.approximation);
  }
}

TEST_CASE("more effort never ends with a smaller angle: 0 is refinement, 0.5 the default")
{
  for (const Surface& surface : {surfaces::torus(48, 24), surfaces::cylinder(40)}) {
    const Oracle oracle = oracle_of(surface);
    const Criteria criteria = criteria_of(0.35, 0.02);
    const auto mesh = [&](const Options& options) { return weft::make_mesh_3(oracle, criteria, options); };
    const auto arrays = [](const auto& result) { return weft::tetrahedral_mesh(result.restricted); };
    double last = 0;
    for (const double effort : {0., 0.2, 0.4, 0.5, 0.57, 0.64}) {
      INFO("effort " << effort);
      Options options;
      options.effort = effort;
      const auto result = mesh(options);
      CHECK(result.report.ok());
      CHECK(result.report.smallest_dihedral >= last);
      CHECK(result.report.smallest_dihedral >= (effort <= 0.5 ? 40 * effort : 20));
      last = result.report.smallest_dihedral;
      check_consistent(result.restricted, result.report);
      if (effort == 0) CHECK(same(arrays(result), arrays(mesh(refinement()))));
      if (effort == 0.5) CHECK(same(arrays(result), arrays(mesh(Options()))));
      options.threads = 3;
      CHECK(same(arrays(result), arrays(mesh(options))));
    }
  }
}

TEST_CASE(
    "a plan leaves time for perturbation, the more of it the less there is, and none of it hangs on time without a "
    "limit")
{
  using weft::internal::Optimisation_plan_3;
  const auto plan = [](const Options& options, double left) {
    Optimisation_plan_3 result(options, true);
    result.fit(1, left);
    return result;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double angle : {20., 25., 90.}) {
    Options options;
    options.min_dihedral_angle = angle;
    int coarsens = 0, sweeps = 0;
    for (const double left : {0.5, 2., 5., 20., 100., infinity}) {
      const Optimisation_plan_3 now = plan(options, left);
      CHECK(now.coarsens() >= coarsens);
      CHECK(now.sweeps() >= sweeps);
      CHECK(now.sweeps() <= options.smoothing_sweeps);
      CHECK(now.time_before_perturbation(left) <= left);
      coarsens = now.coarsens();
      sweeps = now.sweeps();
    }
    CHECK(!plan(options, 0.5).coarsens());
    CHECK(coarsens);
    CHECK(sweeps == options.smoothing_sweeps);
    Options unperturbed = options;
    unperturbed.min_dihedral_angle = 0;
    CHECK(plan(unperturbed, 0.5).coarsens());
  }
  int steps = 0;
  double target = 0;
  for (int k = 0; k <= 100; ++k) {
    Options options;
    options.effort = k / 100.;
    const Optimisation_plan_3 now = plan(options, infinity);
    CHECK(now.target() >= target);
    CHECK(now.steps() >= steps);
    for (int step = 1; step < now.steps(); ++step) CHECK(now.target_of_step(step) > now.target_of_step(step - 1));
    target = now.target();
    steps = now.steps();
  }
  CHECK(target == 20);
  Options options;
  options.min_dihedral_angle = 26.5;
  const Optimisation_plan_3 now = plan(options, infinity);
  CHECK(now.target_of_step(now.steps() - 1) == 26.5);
}

TEST_CASE("the whole run is the same to the last bit, also for several threads")
{
  for (const Case& c : cases()) {
    const Oracle oracle = oracle_of(c.surface);
    const auto run = [&](int threads) {
      Options options;
      options.threads = threads;
      return weft::tetrahedral_mesh(
          weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation), options).restricted);
    };
    const Mesh once = run(1);
    for (const int threads : {1, 2, 3, 4, 8}) CHECK(same(once, run(threads)));
  }
}

TEST_CASE("motions and scalings of the input change the angles reached by little")
{
  const Surface torus = surfaces::torus(48, 24);
  const auto reached = [](const Surface& surface, double scale) {
    Options options;
    options.min_dihedral_angle = 18;
    const Oracle oracle = oracle_of(surface);
    const auto report = weft::make_mesh_3(oracle, criteria_of(0.3 * scale, 0.02 * scale), options).report;
    CHECK(report.ok());
    return report.smallest_dihedral;
  };
  const double first = reached(torus, 1);
  CHECK(first >= 18);
  Surface turned = torus;
  for (Point& p : turned.points) p = Point(0.6 * p.x() - 0.8 * p.y(), 0.8 * p.x() + 0.6 * p.y(), p.z()); // a rotation
  CHECK(std::abs(reached(turned, 1) - first) < 3);
  for (const double scale : {1e-6, 1e6})
    CHECK(std::abs(reached(surfaces::moved(torus, scale, 3 * scale, -scale, scale), scale) - first) < 3);
}

TEST_CASE("a run cancelled at any call of the visitor leaves a valid mesh and says so")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(24));
  const Criteria criteria = criteria_of(0.6, 0.05);
  int total = 0;
  Options options;
  options.visitor = [&](const weft::Progress&) { return ++total > 0; };
  weft::make_mesh_3(oracle, criteria, options);
  CHECK(total > 20);
  for (int last = 1; last < total; last += 1 + total / 60) {
    int calls = 0;
    options.visitor = [&](const weft::Progress&) { return ++calls < last; };
    const auto [mesh, report] = weft::make_mesh_3(oracle, criteria, options);
    INFO("cancelled at call " << last);
    CHECK(calls == last);
    CHECK(report.stop_reason == weft::Stop_reason::cancelled);
    check_consistent(mesh, report);
  }
}

/// Spheres with spikes, flattened ones with noise, and ones with more noise, by `kind`; no edge of them is marked.
Surface rough_sphere(int kind, std::mt19937& random)
{
  Surface surface = surfaces::sphere(3);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Point p = surface.points[i];
    const double height = kind == 0 ? (i % 9 == 0 ? 1.3 : 1) : 1 + (kind == 1 ? 0.06 : 0.1) * uniform(random);
    surface.points[i] = Point(height * p.x(), height * p.y(), (kind == 1 ? 0.25 : 1) * height * p.z());
  }
  return surface;
}

/// Calls `visit(surface, oracle)` for one of each kind.
template <class Visit>
void visit_rough_spheres(unsigned seed, const Visit& visit)
{
  std::mt19937 random(seed);
  for (int kind = 0; kind < 3; ++kind) {
    INFO("kind " << kind);
    const Surface surface = rough_sphere(kind, random);
    visit(surface, oracle_of(surface, 0));
  }
}

TEST_CASE("how far tips and ridges are from a mesh is what brute force says, on thin sheets, too")
{
  visit_rough_spheres(67, [](const Surface& surface, const Oracle& oracle) {
    const auto result = weft::make_mesh_3(oracle, criteria_of(0.4, 0.01), refinement());
    const weft::internal::Deviation_3<Restricted> deviation(result.restricted);
    double height = 0;
    for (const auto& f : result.restricted.facets())
      if (f.cell != Cell_handle()) height = (std::max)(height, std::sqrt(deviation.of(f).height));
    const auto mesh = weft::tetrahedral_mesh(result.restricted);
    double of_tips = 0;
    for (const Point& p : surface.points) {
      double nearest = HUGE_VAL;
      for (const auto& f : mesh.facets)
        nearest = (std::min)(
            nearest, CGAL::squared_distance(p, K::Triangle_3(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]])));
      of_tips = (std::max)(of_tips, std::sqrt(nearest));
    }
    const double of_all = weft::hausdorff_3(mesh, surface.points, surface.triangles, 200000).surface_to_mesh;
    CHECK(height >= 0.999 * of_tips);
    CHECK(height <= 1.05 * of_all); // which is sampled
  });
}

TEST_CASE("a whole run takes the mesh no farther from unmarked tips, rims and noise than refinement has left it")
{
  visit_rough_spheres(61, [](const Surface& surface, const Oracle& oracle) {
    const auto distance = [&](const weft::Mesh_options_3& options) {
      const auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.4, 0.01), options);
      INFO(report);
      CHECK(report.bad() == 0);
      return weft::hausdorff_3(weft::tetrahedral_mesh(mesh), surface.points, surface.triangles, 100000).two_sided();
    };
    CHECK(distance({}) <= 1.1 * distance(refinement()));
  });
}

TEST_CASE("options of smoothing and coarsening out of range are refused")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const Criteria criteria = criteria_of(0.5, 0);
  auto [mesh, report] = weft::make_mesh_3(oracle, criteria, refinement());
  const auto smoothing_refused = [&, &mesh = mesh](auto change) {
    weft::Smooth_options_3 options;
    change(options);
    CHECK_THROWS_AS(weft::smooth_3(mesh, criteria, options), weft::Option_error);
  };
  smoothing_refused([](auto& o) { o.max_sweeps = -1; });
  smoothing_refused([](auto& o) { o.move_ratio = 0; });
  smoothing_refused([](auto& o) { o.lipschitz = not_a_number; });
  smoothing_refused([](auto& o) { o.locked_smallest = -1; });
  smoothing_refused([](auto& o) { o.time_limit = not_a_number; });
  smoothing_refused([](auto& o) { o.threads = 0; });
  const auto coarsening_refused = [&, &mesh = mesh](auto change) {
    weft::Coarsen_options_3 options;
    change(options);
    CHECK_THROWS_AS(weft::coarsen_3(mesh, criteria, options), weft::Option_error);
  };
  coarsening_refused([](auto& o) { o.min_dihedral_angle = 91; });
  coarsening_refused([](auto& o) { o.most_passes = -1; });
  coarsening_refused([](auto& o) { o.least_gain = not_a_number; });
  coarsening_refused([](auto& o) { o.time_limit = -1; });
  for (const double effort : {-0.1, 1.1, not_a_number}) {
    Options options;
    options.effort = effort;
    CHECK_THROWS_AS(weft::make_mesh_3(oracle, criteria, options), weft::Option_error);
  }
}
