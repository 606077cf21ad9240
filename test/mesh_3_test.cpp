// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of `make_mesh_3()`: what a mesh that meets its criteria has to be, that what the restricted triangulation
// keeps agrees with what the oracle says after every batch, and that every run ends, early or not, with a sound
// triangulation and a report that tells what it is.

#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/IO/read_surface.h>
#include <weft/make_mesh_3.h>
#include <weft/mesh_surface_3.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/refine/Batch_refiner_3.h>
#include <weft/spatial/refine/Steiner_chooser_3.h>
#include <weft/spatial/refine/Vertex_set_3.h>
#include <weft/spatial/restricted/check_restricted_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace meshing;

/// Meshes a surface, and checks everything that holds for a mesh that meets its criteria.
weft::Mesh_report_3 check_meshing(const Surface& surface, const Criteria& criteria, double approximation,
                                  double angle = 60)
{
  const Oracle oracle = oracle_of(surface, angle);
  const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
  INFO(report);
  CHECK(report.ok());
  CHECK(report.manifold);
  check_consistent(restricted, report);
  check_complete(weft::tetrahedral_mesh(restricted), oracle, criteria, approximation);
  return report;
}
weft::Mesh_report_3 check_meshing(const Surface& surface, double size, double approximation, double angle = 60)
{
  return check_meshing(surface, criteria_of(size, approximation), approximation, angle);
}

/// Turned by an angle about an axis that no face is parallel to.
Surface turned(Surface surface, double angle = 0.7)
{
  const double n = std::sqrt(14.), x = 1 / n, y = 2 / n, z = 3 / n, c = std::cos(angle), s = std::sin(angle);
  for (Point& p : surface.points) {
    const double along = (x * p.x() + y * p.y() + z * p.z()) * (1 - c);
    p = Point(c * p.x() + s * (y * p.z() - z * p.y()) + along * x, c * p.y() + s * (z * p.x() - x * p.z()) + along * y,
              c * p.z() + s * (x * p.y() - y * p.x()) + along * z);
  }
  return surface;
}

/// The same surface with its points and triangles in another order.
Surface shuffled(const Surface& surface, unsigned seed)
{
  std::mt19937 random(seed);
  const auto shuffle = [&random](auto& items) { // not std::shuffle: libraries differ
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
  };
  std::vector<std::size_t> place(surface.points.size());
  std::iota(place.begin(), place.end(), std::size_t(0));
  shuffle(place);
  Surface result = surface;
  for (std::size_t i = 0; i < place.size(); ++i) result.points[place[i]] = surface.points[i];
  for (auto& t : result.triangles)
    for (std::size_t& v : t) v = place[v];
  shuffle(result.triangles);
  return result;
}

} // namespace

TEST_CASE("meshes of plain models meet all criteria and are meshes of the whole domain")
{
  const std::vector<std::pair<std::string, Surface>> models = {{"cube", surfaces::cube()},
                                                               {"tetrahedron", surfaces::tetrahedron()},
                                                               {"L", surfaces::l_shape()},
                                                               {"cube with a hole", surfaces::cube_with_hole()},
                                                               {"turned cube", turned(surfaces::cube())},
                                                               {"torus", surfaces::torus(48, 24)},
                                                               {"cylinder", surfaces::cylinder(48)},
                                                               {"turned cylinder", turned(surfaces::cylinder(30))},
                                                               {"cone", surfaces::cone(40, 2)},
                                                               {"sphere", surfaces::sphere(3)}};
  for (const auto& [name, surface] : models) {
    INFO(name);
    check_meshing(surface, 0.4, 0.02);
  }
}

TEST_CASE("a box whose faces lie in those of its bounding box, of one or of many facets, has exactly its volume")
{
  for (const int n : {1, 4}) {
    const Surface box = surfaces::moved(surfaces::box(n, n, n), 1. / n, 0, 0, 0);
    const Oracle oracle = oracle_of(box);
    const auto mesh =
        weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria_of(0.3, 0.01), refinement()).restricted);
    CHECK(volume_of_cells(mesh) == Approx(1).epsilon(1e-12));
    CHECK(area(mesh) == Approx(6).epsilon(1e-12));
  }
}

TEST_CASE("cavities and components, tiny beside large ones, are all there")
{
  check_meshing(surfaces::nested_spheres({0.6, 0.3}, 3), 0.3, 0.01);
  for (const double size : {0.5, 1e-2, 1e-5}) {
    INFO("a component of size " << size);
    check_meshing(surfaces::together(surfaces::sphere(3), surfaces::moved(surfaces::sphere(2), size, 3, 0, 0)), 0.4,
                  0.02);
    check_meshing(surfaces::together(surfaces::cube(), surfaces::moved(surfaces::cube(), size, 3, 0.1, 0.2)), 0.4,
                  0.02);
  }
}

TEST_CASE("needle triangles in the input don't show in the mesh")
{
  const auto plain = check_meshing(surfaces::cube(), 0.3, 0.01);
  for (const double width : {1e-3, 1e-6}) {
    INFO("triangles of aspect " << 1 / width);
    CHECK(check_meshing(surfaces::needle_cube(width), 0.3, 0.01).vertices < 2 * plain.vertices);
  }
}

TEST_CASE("models far from the origin, tiny or huge, are meshed like others")
{
  const auto cube = check_meshing(surfaces::cube(), 0.3, 0.01), ball = check_meshing(surfaces::sphere(3), 0.3, 0.01);
  const auto is_close = [](std::size_t a, std::size_t b) {
    return std::abs(std::log(static_cast<double>(a) / static_cast<double>(b))) < 0.25;
  };
  for (const double offset : {1e3, 1e6}) {
    INFO("moved by " << offset);
    const auto far_off = [offset](const Surface& s) { return surfaces::moved(s, 1, offset, -offset, 2 * offset); };
    CHECK(is_close(check_meshing(far_off(surfaces::cube()), 0.3, 0.01).vertices, cube.vertices));
    CHECK(is_close(check_meshing(far_off(turned(surfaces::cube())), 0.3, 0.01).vertices, cube.vertices));
    CHECK(is_close(check_meshing(far_off(surfaces::sphere(3)), 0.3, 0.01).vertices, ball.vertices));
  }
  for (const double scale : {1e-6, 1e6}) {
    INFO("scaled by " << scale);
    const auto scaled = [scale](const Surface& s) { return surfaces::moved(s, scale, 0, 0, 0); };
    CHECK(is_close(check_meshing(scaled(surfaces::cube()), 0.3 * scale, 0.01 * scale).vertices, cube.vertices));
    CHECK(is_close(check_meshing(scaled(surfaces::sphere(3)), 0.3 * scale, 0.01 * scale).vertices, ball.vertices));
  }
}

TEST_CASE("scaling by a power of two scales the mesh and changes nothing else")
{
  const auto mesh_scaled_by = [](double scale) {
    const Oracle oracle = oracle_of(surfaces::moved(surfaces::cylinder(20), scale, 0, 0, 0));
    return weft::tetrahedral_mesh(
        weft::make_mesh_3(oracle, criteria_of(0.5 * scale, 0.02 * scale), refinement()).restricted);
  };
  Mesh mesh = mesh_scaled_by(1);
  const Mesh large = mesh_scaled_by(1024);
  for (Point& p : mesh.points) p = Point(1024 * p.x(), 1024 * p.y(), 1024 * p.z());
  CHECK(same(mesh, large));
}

TEST_CASE("after every batch everything kept agrees with what the oracle says")
{
  for (const Surface& surface :
       {surfaces::l_shape(), turned(surfaces::cube()), surfaces::cylinder(16), surfaces::torus(20, 10),
        surfaces::nested_spheres({0.5}, 1), surfaces::wedge(30), surfaces::moved(surfaces::cube(), 1, 1e6, 1e6, 1e6)}) {
    const Oracle oracle = oracle_of(surface);
    const Criteria criteria = criteria_of(0.7, 0.05);
    Options options = refinement();
    const Mesher* running = nullptr;
    std::size_t calls = 0;
    options.visitor = [&](const weft::Progress& progress) {
      ++calls;
      CHECK(progress.vertices == running->mesh().vertices().size());
      const auto agreement = weft::check_restricted_3(running->mesh());
      INFO(agreement);
      CHECK(agreement.ok());
      return true;
    };
    Mesher mesher(oracle, criteria, options);
    running = &mesher;
    const auto report = mesher.run();
    CHECK(calls == report.batches);
    CHECK(calls > 5);
  }
}

TEST_CASE("each criterion can be asked for by itself")
{
  const Oracle bar = oracle_of(surfaces::box(6, 1, 1)), cylinder = oracle_of(surfaces::cylinder(24));
  const auto vertices = [](const Oracle& oracle, double size, double approximation, double facet_shape,
                           double cell_shape) {
    Criteria criteria = criteria_of(size, approximation, false);
    criteria.facet_shape = facet_shape;
    criteria.cell_shape = cell_shape;
    Options options = refinement();
    options.lattice = false;
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, options);
    INFO(report);
    CHECK(report.ok());
    const Mesh mesh = weft::tetrahedral_mesh(restricted);
    CHECK(weft::check_criteria_3(mesh, criteria).ok());
    CHECK(weft::validate_3(mesh).ok());
    return mesh.points.size();
  };
  const std::size_t bare = vertices(bar, 100, 0, 0, 0), coarse = vertices(cylinder, 1.5, 0, 0, 0);
  CHECK(vertices(bar, 100, 0, 1, 0) > bare);
  CHECK(vertices(bar, 100, 0, 0, 1.5) > bare);
  CHECK(vertices(bar, 0.5, 0, 0, 0) > 4 * bare);
  CHECK(vertices(cylinder, 1.5, 0.01, 0, 0) > coarse);
}

TEST_CASE("a size far beyond the model still gives a mesh of it")
{
  for (const Surface& surface :
       {surfaces::cube(), surfaces::sphere(3), surfaces::torus(30, 15), surfaces::cylinder(20)}) {
    const Oracle oracle = oracle_of(surface);
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria_of(1e9, 0), refinement());
    INFO(report);
    CHECK(report.ok());
    const Mesh mesh = weft::tetrahedral_mesh(restricted);
    CHECK(mesh.points.size() < 1000);
    CHECK(weft::validate_3(mesh).ok());
    CHECK(euler_characteristic(mesh.facets) == euler_characteristic(surface.triangles));
  }
}

TEST_CASE("size and approximation may be fields of the place")
{
  const auto graded = [](const Point& p) { return 0.08 + 0.3 * std::abs(p.x()); };
  const Surface sphere = surfaces::sphere(3);
  Criteria criteria = criteria_of(1, 0.05);
  criteria.size = graded;
  const auto report = check_meshing(sphere, criteria, 0.05);
  criteria.size = 0.08;
  const Oracle whole = oracle_of(sphere);
  CHECK(report.vertices < weft::make_mesh_3(whole, criteria, refinement()).report.vertices);

  // A constant and a field that is constant ask for the same, but the field gets no lattice.
  Options options = refinement();
  options.lattice = false;
  const Oracle oracle = oracle_of(sphere);
  criteria = criteria_of(0.3, 0.02);
  Criteria field = criteria;
  field.size = [](const Point&) { return 0.3; };
  field.approximation = [](const Point&) { return 0.02; };
  options.size_floor = 1e-4;
  CHECK(same(weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria, options).restricted),
             weft::tetrahedral_mesh(weft::make_mesh_3(oracle, field, options).restricted)));

  criteria.approximation = [](const Point& p) { return p.z() > 0 ? 0.005 : 0.05; };
  check_meshing(sphere, criteria, 0.05);
}

TEST_CASE("a field that fails ends the run with its exception and leaves nothing behind")
{
  struct Own_error : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
  const Oracle oracle = oracle_of(surfaces::cylinder(20));
  const auto run = [&oracle](int good_calls, double value, bool throws, bool as_size) {
    const auto token = std::make_shared<int>(0); // lives as long as a copy of the field
    auto calls = std::make_shared<int>(0);
    const auto field = [=, keep = token](const Point&) {
      if (++*calls <= good_calls) return 0.3;
      if (throws) throw Own_error("no size here");
      return value;
    };
    {
      Criteria criteria = criteria_of(0.4, 0.02);
      (as_size ? criteria.size : criteria.approximation) = field;
      if (throws)
        CHECK_THROWS_AS(weft::make_mesh_3(oracle, criteria, refinement()), Own_error);
      else
        CHECK_THROWS_AS(weft::make_mesh_3(oracle, criteria, refinement()), weft::Option_error);
    }
    CHECK(token.use_count() == 2); // here and in `field`
  };
  for (const bool as_size : {true, false})
    for (const int good_calls : {0, 1, 100, 2000}) {
      for (const double value : {not_a_number, -1., 0., infinite}) run(good_calls, value, false, as_size);
      run(good_calls, 0, true, as_size);
    }
}

TEST_CASE("criteria and options out of range are refused")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const auto refuses = [&oracle](const Criteria& criteria, const Options& options = refinement()) {
    CHECK_THROWS_AS(weft::make_mesh_3(oracle, criteria, options), weft::Option_error);
  };
  for (const double bad : {0., -1., not_a_number, infinite}) refuses(criteria_of(bad, 0.01));
  for (const double bad : {-1., not_a_number, infinite}) refuses(criteria_of(0.3, bad));
  for (const double bad : {-1., 0.5, not_a_number}) {
    Criteria facets = criteria_of(0.3, 0.01), cells = facets;
    facets.facet_shape = bad;
    cells.cell_shape = bad;
    refuses(facets);
    refuses(cells);
  }
  const Criteria good = criteria_of(0.3, 0.01);
  for (const double bad : {-1., not_a_number}) {
    Options floor, relaxation, time;
    floor.size_floor = bad;
    relaxation.initial_loosening = bad;
    time.time_limit = bad;
    refuses(good, floor);
    refuses(good, relaxation);
    refuses(good, time);
  }
  Options threads;
  threads.threads = 0;
  refuses(good, threads);
}

TEST_CASE("a run is repeatable to the last bit, with any number of threads")
{
  const Oracle oracle =
      oracle_of(surfaces::together(surfaces::sphere(4), surfaces::moved(surfaces::cube(), 1, 2, 0, 0)));
  const Criteria criteria = criteria_of(0.12, 0.005);
  const auto mesh = [&](int threads, unsigned seed) {
    Options options = refinement();
    options.threads = threads;
    options.seed = seed;
    return weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria, options).restricted);
  };
  const Mesh first = mesh(1, 0);
  CHECK(first.points.size() > 5000);
  for (const int threads : {1, 2, 3, 4, 8}) CHECK(same(first, mesh(threads, 0)));
  CHECK(!same(first, mesh(1, 1)));
}

TEST_CASE("a lattice inserted in streams gives the same mesh for any number of threads")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const auto mesh = [&](int threads) {
    Options options = refinement();
    options.lattice = true;
    options.threads = threads;
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria_of(0.06, 0.01), options);
    CHECK(report.ok());
    CHECK(weft::validate_3(weft::tetrahedral_mesh(restricted)).ok());
    return weft::tetrahedral_mesh(restricted);
  };
  const Mesh first = mesh(1);
  CHECK(first.points.size() > 9000);
  for (const int threads : {2, 3, 8}) CHECK(same(first, mesh(threads)));
}

TEST_CASE("the order of the input's points and triangles hardly changes the number of vertices")
{
  for (const Surface& surface : {surfaces::cylinder(32), surfaces::torus(40, 20), surfaces::l_shape()}) {
    const double vertices = static_cast<double>(check_meshing(surface, 0.25, 0.01).vertices);
    for (const unsigned seed : {1u, 2u, 3u})
      CHECK(static_cast<double>(check_meshing(shuffled(surface, seed), 0.25, 0.01).vertices) ==
            Approx(vertices).epsilon(0.1));
  }
}

TEST_CASE("a run that a limit ends says so and leaves a sound triangulation")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(24));
  const Criteria criteria = criteria_of(0.2, 0.005);
  const auto run = [&](const Options& options, weft::Stop_reason reason) {
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, options);
    INFO(report);
    CHECK(report.stop_reason == reason);
    CHECK(!report.ok());
    check_consistent(restricted, report);
    return restricted.vertices().size();
  };
  for (const std::size_t most : {0, 1, 3, 10, 40, 200, 600}) {
    INFO("at most " << most << " vertices");
    Options options = refinement();
    options.max_vertices = most;
    CHECK(run(options, weft::Stop_reason::vertex_budget) <= (std::max)(most, std::size_t(6))); // three on each rim
  }
  for (const std::size_t most : {0, 1, 2, 5, 20}) {
    Options options = refinement();
    options.max_batches = most;
    run(options, weft::Stop_reason::iteration_limit);
  }
  for (const double seconds : {0., 1e-3, 1e-2}) {
    Options options = refinement();
    options.time_limit = seconds;
    run(options, weft::Stop_reason::time_limit);
  }
}

TEST_CASE("a run that is cancelled at any moment says so and leaves a sound triangulation")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(12));
  const Criteria criteria = criteria_of(0.5, 0.05);
  Options options = refinement();
  std::size_t batches = 1;
  for (std::size_t last = 1; last <= batches; ++last) {
    std::size_t calls = 0;
    options.visitor = [&](const weft::Progress&) { return ++calls < last; };
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, options);
    INFO(report);
    CHECK(report.stop_reason == weft::Stop_reason::cancelled);
    CHECK(report.batches == last);
    CHECK(calls == last);
    check_consistent(restricted, report);
    if (last == 1) batches = weft::make_mesh_3(oracle, criteria, refinement()).report.batches;
  }
  CHECK(batches > 10);
}

TEST_CASE("an exception from the visitor goes to the caller")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  Options options = refinement();
  options.visitor = [](const weft::Progress&) -> bool { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(weft::make_mesh_3(oracle, criteria_of(0.5, 0.01), options), "enough");
}

TEST_CASE("at acute dihedral angles a run ends by itself, with few vertices")
{
  for (const double angle : {70., 55., 47., 30., 25., 20., 5., 1.})
    for (const double sharp : {60., 180.}) // creases, or nothing marked
      for (const bool topology : {false, true}) {
        INFO("a wedge of " << angle << " degrees, sharp from " << sharp << ", topology " << topology);
        const Oracle oracle = oracle_of(surfaces::wedge(angle), sharp);
        const Criteria criteria = criteria_of(0.2, 0.01, topology);
        const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
        INFO(report);
        CHECK(report.cells > 0);
        CHECK(report.vertices < 20000);
        check_consistent(restricted, report);
        const Mesh mesh = weft::tetrahedral_mesh(restricted);
        CHECK(weft::check_sizes_3(mesh, criteria.size).ok());
        CHECK(weft::check_distances_3(mesh, oracle).ok());
        CHECK(report.ok());
        CHECK(report.manifold);
        CHECK(weft::validate_3(mesh).ok());
      }
}

TEST_CASE("creases found by angle are given up where only they keep criteria from holding; given ones never are")
{
  const auto soup = weft::IO::read_surface<K>(WEFT_TEST_DATA_DIR "/ball_with_sharp_noise.off");
  const auto complex = weft::piecewise_smooth_complex(soup);
  // On one side crease edges would have to be shorter than the size floor; patches don't have to.
  Criteria criteria = criteria_of(0.2, 0.05, false);
  criteria.crease_size = [](const Point& p) { return p.x() > 0 ? 0.024 : 1.; };
  Options options = refinement();
  options.size_floor = 0.03;
  options.give_up_creases = false;
  const auto with_all = weft::mesh_surface_3(complex, criteria, options);
  CHECK(!with_all.report.ok());
  CHECK(with_all.report.creases_given_up == 0);
  options.give_up_creases = true;
  const auto result = weft::mesh_surface_3(complex, criteria, options);
  CHECK(result.report.ok());
  CHECK(result.report.creases_given_up > 0);
  CHECK(result.domain->number_of_creases() < complex.creases.size());
  CHECK(result.domain->number_of_creases() > 0);
  check_consistent(result.restricted, result.report);

  auto given = complex;
  for (auto& crease : given.creases) crease.given = true;
  const auto kept = weft::mesh_surface_3(given, criteria, options);
  CHECK(kept.report.creases_given_up == 0);
  CHECK(same(weft::tetrahedral_mesh(kept.restricted), weft::tetrahedral_mesh(with_all.restricted)));
}

TEST_CASE("giving up creases that isn't enough leaves the mesh with all of them")
{
  const auto surface = surfaces::wedge(8);
  const auto complex = weft::piecewise_smooth_complex(surface.points, surface.triangles, {});
  Criteria criteria = criteria_of(0.2, 0.01);
  criteria.cell_demand = [](const weft::Cell_view_3<K>&) { return 2.; }; // nothing meets it
  Options options = refinement();
  options.size_floor = 0.03;
  const auto result = weft::mesh_surface_3(complex, criteria, options);
  CHECK(!result.report.ok());
  CHECK(result.report.creases_given_up == 0);
  CHECK(result.domain->number_of_creases() == complex.creases.size());
}

TEST_CASE("slivers are perturbed away beside what the input's angles make impossible")
{
  const Oracle oracle = oracle_of(surfaces::wedge(8));
  const Criteria criteria = criteria_of(0.1, 0.01);
  Options options;
  const auto slivers = [](const Mesh& mesh) { // that don't touch the acute edge, the z axis
    std::size_t n = 0;
    for (const auto& c : mesh.cells) {
      const auto at_edge = [&](std::size_t v) { return std::hypot(mesh.points[v].x(), mesh.points[v].y()) < 0.5; };
      if (std::any_of(c.begin(), c.end(), at_edge)) continue;
      const auto x = weft::internal::cosines_of_extreme_dihedrals(mesh.points[c[0]], mesh.points[c[1]],
                                                                  mesh.points[c[2]], mesh.points[c[3]]);
      n += weft::internal::degrees_of_cosine(x.smallest) < 12;
    }
    return n;
  };
  options.min_dihedral_angle = 0;
  const auto [plain, before] = weft::make_mesh_3(oracle, criteria, options);
  options.min_dihedral_angle = 12;
  const auto [perturbed, after] = weft::make_mesh_3(oracle, criteria, options);
  REQUIRE(before.forced_cells > 0);
  CHECK(after.bad() <= before.bad());
  CHECK(slivers(weft::tetrahedral_mesh(plain)) > 0);
  CHECK(slivers(weft::tetrahedral_mesh(perturbed)) * 4 <= slivers(weft::tetrahedral_mesh(plain)));
  check_consistent(perturbed, after);
}

TEST_CASE("creases that meet at a sharp angle don't split each other without end")
{
  // A tetrahedron whose faces at the tip are narrow, dihedral angles being large.
  for (const double width : {0.3, 0.1, 0.03}) {
    INFO("a spike of width " << width);
    Surface spike = surfaces::tetrahedron();
    for (Point& p : spike.points) p = Point(width * p.x(), width * p.y(), p.z());
    const Oracle oracle = oracle_of(spike);
    Criteria criteria = criteria_of(0.1, 0.01);
    const auto [restricted, report] = weft::make_mesh_3(oracle, criteria, refinement());
    INFO(report);
    CHECK(report.bad_edges.elements == 0);
    CHECK(report.vertices < 20000);
    check_consistent(restricted, report);
    CHECK(weft::check_features_3(weft::tetrahedral_mesh(restricted), oracle.complex()).ok());
  }
}

TEST_CASE("perturbation raises the smallest dihedral angle and breaks nothing that held")
{
  struct Case
  {
    Surface surface;
    double size, approximation, target, reached;
  };
  for (const Case& c : {Case{surfaces::torus(48, 24), 0.3, 0.02, 15, 10},
                        Case{surfaces::cylinder(40), 0.4, 0.02, 15, 10}, Case{surfaces::cube(), 0.2, 0, 20, 15}}) {
    const Oracle oracle = oracle_of(c.surface);
    const Criteria criteria = criteria_of(c.size, c.approximation);
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, refinement());
    REQUIRE(refined.ok());
    weft::Perturb_options_3 options;
    options.target = c.target;
    double last = 0;
    options.go_on = [&](double angle) {
      CHECK(angle >= last); // hill climbing
      last = angle;
      return true;
    };
    const weft::Perturb_report_3 report = weft::perturb_slivers_3(mesh, criteria, options);
    CHECK(report.before == Approx(refined.smallest_dihedral).margin(1e-6));
    CHECK(report.after >= report.before);
    CHECK(report.after > c.reached);
    const auto agreement = weft::check_restricted_3(mesh);
    INFO(agreement);
    CHECK(agreement.ok());
    const Mesh arrays = weft::tetrahedral_mesh(mesh);
    CHECK(weft::measure_quality_3(arrays).smallest_dihedral.degrees == Approx(report.after).margin(1e-6));
    CHECK(arrays.points.size() <= 1.05 * static_cast<double>(refined.vertices) + 1);
    check_complete(arrays, oracle, criteria, c.approximation);
  }
}

TEST_CASE("perturbation is repeatable to the last bit and may be stopped between passes")
{
  const Oracle oracle = oracle_of(surfaces::torus(48, 24));
  const Criteria criteria = criteria_of(0.3, 0.02);
  Options options = refinement();
  options.min_dihedral_angle = 18;
  const auto first = weft::make_mesh_3(oracle, criteria, options),
             second = weft::make_mesh_3(oracle, criteria, options);
  CHECK(same(weft::tetrahedral_mesh(first.restricted), weft::tetrahedral_mesh(second.restricted)));
  CHECK(first.report.perturbed > 0);
  CHECK(first.report.smallest_dihedral > first.report.smoothed_smallest_dihedral);
  for (const int calls : {0, 1, 3}) {
    auto [mesh, refined] = weft::make_mesh_3(oracle, criteria, refinement());
    weft::Perturb_options_3 perturb;
    int left = calls;
    perturb.go_on = [&](double) { return left-- > 0; };
    const auto report = weft::perturb_slivers_3(mesh, criteria, perturb);
    CHECK(report.after >= refined.smallest_dihedral - 1e-6);
    CHECK(weft::check_restricted_3(mesh).ok());
    CHECK(weft::validate_3(weft::tetrahedral_mesh(mesh)).ok());
  }
}

TEST_CASE("options of perturbation out of range are refused")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  auto [mesh, report] = weft::make_mesh_3(oracle, criteria_of(0.5, 0), refinement());
  const auto refused = [&, &mesh = mesh](auto change) {
    weft::Perturb_options_3 options;
    change(options);
    CHECK_THROWS_AS(weft::perturb_slivers_3(mesh, criteria_of(0.5, 0), options), weft::Option_error);
  };
  refused([](auto& o) { o.target = -1; });
  refused([](auto& o) { o.target = not_a_number; });
  refused([](auto& o) { o.step = 0; });
  refused([](auto& o) { o.random_reach = 1; });
  refused([](auto& o) { o.insertions = -1; });
  refused([](auto& o) { o.time_limit = -1; });
}

TEST_CASE("a point that is a vertex already isn't inserted again")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  auto result = weft::make_mesh_3(oracle, criteria_of(0.5, 0.05), refinement());
  const auto vertices = result.restricted.vertices();
  for (const auto v : vertices) CHECK(result.restricted.insert(v->point(), v->location()) == v);
  CHECK(result.restricted.vertices().size() == vertices.size());
}

TEST_CASE("edges form one cycle only if that doesn't meet itself")
{
  using Edges = std::vector<std::pair<int, int>>;
  const auto is_cycle = [](Edges edges) {
    std::sort(edges.begin(), edges.end());
    Edges first = edges; // is_one_cycle() changes the order
    const bool expected = weft::internal::is_one_cycle(first);
    while (std::next_permutation(edges.begin(), edges.end())) {
      Edges copy = edges;
      CHECK(weft::internal::is_one_cycle(copy) == expected); // whatever the order
    }
    return expected;
  };
  CHECK(is_cycle({{0, 1}, {2, 1}, {2, 0}}));
  CHECK(is_cycle({{0, 1}, {2, 1}, {2, 3}, {4, 3}, {0, 4}}));
  CHECK(!is_cycle({{0, 1}, {1, 0}}));
  CHECK(!is_cycle({{0, 1}, {1, 2}, {2, 3}}));
  CHECK(!is_cycle({{0, 1}, {1, 2}, {2, 0}, {2, 3}}));
  CHECK(!is_cycle({{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}}));
  CHECK(!is_cycle({{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 2}})); // a figure of eight
}

TEST_CASE("what disagrees in a restricted triangulation is found")
{
  const Oracle oracle = oracle_of(surfaces::l_shape());
  auto result = weft::make_mesh_3(oracle, criteria_of(0.5, 0.05), refinement());
  auto& mesh = result.restricted;
  const auto faults = [&mesh] { return weft::check_restricted_3(mesh).count(weft::Fault_kind_3::restricted); };
  REQUIRE(faults() == 0);
  using Cell_handle = weft::Restricted_delaunay_3<Oracle>::Cell_handle;
  const auto find_cell = [&mesh](int subdomain) -> Cell_handle {
    for (const auto c : mesh.triangulation().finite_cell_handles())
      if (c->subdomain() == subdomain && !mesh.is_at_box(c)) return c;
    return {};
  };
  for (const int subdomain : {0, 1}) {
    const auto c = find_cell(subdomain);
    REQUIRE(c != Cell_handle());
    c->set_subdomain(1 - subdomain);
    CHECK(faults() > 0);
    c->set_subdomain(subdomain);
  }
  const auto inner = find_cell(1);
  const Point center = inner->circumcenter();
  inner->set_circumcenter(CGAL::midpoint(center, inner->vertex(0)->point()));
  CHECK(faults() > 0);
  inner->set_circumcenter(center);
  for (const auto& f : mesh.facets())
    if (f.cell != Cell_handle()) {
      const int record = f.cell->facet_record(f.index);
      f.cell->set_facet_record(f.index, -1);
      CHECK(faults() > 0); // its two cells disagree
      f.cell->neighbor(f.index)->set_facet_record(f.cell->neighbor(f.index)->index(f.cell), -1);
      CHECK(faults() > 0); // it is missing
      f.cell->set_facet_record(f.index, record);
      f.cell->neighbor(f.index)->set_facet_record(f.cell->neighbor(f.index)->index(f.cell), record);
      break;
    }
  CHECK(faults() == 0);
  // A vertex on a crease that nobody has told the creases about.
  const auto& points = mesh.creases().points(0);
  mesh.insert(points[0] + 0.377 * (points[1] - points[0]), {1, 0});
  CHECK(faults() > 0);
  mesh.update();
  CHECK(faults() == 0);
}

TEST_CASE("the Steiner point chosen for a cell mends no less than its circumcenter")
{
  using Restricted = weft::Restricted_delaunay_3<Oracle>;
  using Zone = Restricted::Zone;
  const Oracle oracle = oracle_of(surfaces::sphere(3), 0);
  const Criteria loose = criteria_of(0.3, 0.02), criteria = criteria_of(0.2, 0.02);
  const auto begin = [&] { return std::move(weft::make_mesh_3(oracle, loose, refinement()).restricted); };
  const auto squared = [](const Point& p, const Point& q) { return CGAL::to_double(CGAL::squared_distance(p, q)); };
  // Marks bad cells as refinement does, and returns them, in an order that doesn't depend on memory.
  const auto mark_bad_cells = [&criteria](const Restricted& mesh) {
    const weft::internal::Badness_measure_3<Restricted> measure(mesh, criteria, 1);
    std::vector<Restricted::Cell_handle> bad;
    for (const auto c : mesh.triangulation().finite_cell_handles()) {
      c->set_bad_index(-1);
      if (c->subdomain() == 0 || !measure.cell(c).is_bad()) continue;
      c->set_bad_index(static_cast<int>(bad.size()));
      bad.push_back(c);
    }
    std::sort(bad.begin(), bad.end(), [](auto c, auto d) { return c->circumcenter() < d->circumcenter(); });
    return bad;
  };
  constexpr int batch = 1 << 30; // nothing is claimed for it
  const Restricted first = begin();
  const std::size_t cells = mark_bad_cells(first).size();
  REQUIRE(cells > 50);
  int compared = 0, better = 0;
  for (std::size_t k = 0; k < cells; k += cells / 25) {
    std::array<std::size_t, 2> left{};
    bool is_comparable = true;
    for (const bool choosing : {true, false}) {
      Restricted mesh = begin();
      const auto bad = mark_bad_cells(mesh);
      REQUIRE(bad.size() == cells);
      const auto c = bad[k];
      const weft::internal::Badness_measure_3<Restricted> measure(mesh, criteria, 1);
      weft::internal::Steiner_chooser_3<Restricted> chooser(mesh, measure, 1e-12);
      Zone zone;
      const auto result =
          choosing ? chooser.choose(c, batch, zone)
                   : weft::internal::find_conflict_zone(mesh.triangulation(), c->circumcenter(), c, batch, zone);
      is_comparable = is_comparable && result == weft::internal::Zone_result::found && !chooser.encroached_facet(zone);
      if (result != weft::internal::Zone_result::found) continue;
      if (choosing) {
        CHECK(!chooser.encroached_facet(zone));
        CHECK(chooser.nearest_in(zone) >= 0.35 * squared(c->circumcenter(), c->vertex(0)->point()));
        CHECK(oracle.subdomain(zone.point) == c->subdomain());
      }
      // Cells outside would count for one side only.
      for (const auto d : zone.cells) is_comparable = is_comparable && d->subdomain() == 1;
      for (const auto& f : zone.hull) is_comparable = is_comparable && f.first->subdomain() == 1;
      mesh.insert(zone, {3, 1});
      mesh.update();
      left[choosing ? 0 : 1] = mark_bad_cells(mesh).size();
    }
    if (!is_comparable) continue;
    ++compared;
    better += left[0] < left[1];
    CHECK(left[0] <= left[1]);
  }
  CHECK(compared >= 5);
  CHECK(better >= 1);
}

TEST_CASE("a refiner that doesn't look again at what another has settled does the same")
{
  for (const Surface& surface : {surfaces::torus(48, 24), surfaces::l_shape(), surfaces::cylinder(40)}) {
    const Oracle oracle = oracle_of(surface);
    const auto coarse =
        weft::internal::vertices_of(weft::make_mesh_3(oracle, criteria_of(1, 0.1), refinement()).restricted);
    const Criteria criteria = criteria_of(0.5, 0.02);
    const auto refined = [&](bool settles) {
      weft::Restricted_delaunay_3<Oracle> mesh(oracle);
      mesh.insert(coarse.points, coarse.locations);
      const auto refine = [&](bool with_cells, int settled) {
        weft::internal::Batch_refiner_3<weft::Restricted_delaunay_3<Oracle>> refiner(mesh, criteria, 1, with_cells,
                                                                                     1e-3, 5, settled);
        for (int batch = 0; batch < 200 && refiner.refine(100000).inserted > 0;) ++batch;
        return refiner.settle();
      };
      const int settled = refine(false, 0);
      const std::size_t before = mesh.vertices().size();
      refine(true, settles ? settled : 0);
      CHECK(mesh.vertices().size() > before);
      CHECK(weft::check_restricted_3(mesh).ok());
      return weft::internal::vertices_of(mesh).points;
    };
    CHECK(refined(true) == refined(false));
  }
}

TEST_CASE("a mesh is built again from its vertices, and what is around bad elements can be left out")
{
  const Oracle oracle = oracle_of(surfaces::l_shape());
  const auto result = weft::make_mesh_3(oracle, criteria_of(0.5, 0.05), refinement());
  const auto& mesh = result.restricted;
  CHECK(weft::internal::bad_balls(mesh, criteria_of(0.5, 0.05), 1e-3).empty());
  const auto all = weft::internal::vertices_of(mesh);
  weft::Restricted_delaunay_3<Oracle> again(oracle);
  again.insert(all.points, all.locations);
  CHECK(weft::check_restricted_3(again).ok());
  CHECK(weft::tetrahedral_mesh(again).cells.size() == weft::tetrahedral_mesh(mesh).cells.size());

  auto balls = weft::internal::bad_balls(mesh, criteria_of(0.4, 0.05), 1e-3);
  REQUIRE(balls.size() > 5);
  CHECK(weft::internal::drop_vertices(balls, 1000, again) == 0);
  CHECK(weft::internal::vertices_of(again).points == all.points);
  balls.resize(5);
  const std::size_t dropped =
      weft::internal::drop_vertices(balls, 1.01, again); // the vertices of an element lie on its ball
  CHECK(weft::check_restricted_3(again).ok());
  const auto fewer = weft::internal::vertices_of(again);
  CHECK(dropped > 0);
  CHECK(fewer.points.size() + dropped == all.points.size());
  const auto corners = [](const auto& vertices) {
    return std::count_if(vertices.locations.begin(), vertices.locations.end(),
                         [](auto at) { return at.dimension == 0; });
  };
  CHECK(corners(fewer) == corners(all));
  for (std::size_t i = 0; i < fewer.points.size(); ++i)
    if (fewer.locations[i].dimension > 0)
      CHECK(std::none_of(balls.begin(), balls.end(), [&](const auto& b) {
        return CGAL::squared_distance(b.center, fewer.points[i]) < 1.01 * 1.01 * b.squared_radius;
      }));
}

TEST_CASE("flat faces take the same vertices whatever the bound, the extent and the position")
{
  const auto vertices = [](double extent, double offset, double bound) {
    Surface turned = surfaces::cube();
    const double a = 0.7, b = 1.1; // radians, about z and x
    for (Point& p : turned.points) {
      const double x = std::cos(a) * p.x() - std::sin(a) * p.y(), y = std::sin(a) * p.x() + std::cos(a) * p.y();
      p = Point(extent * x + offset, extent * (std::cos(b) * y - std::sin(b) * p.z()) + offset,
                extent * (std::sin(b) * y + std::cos(b) * p.z()) + offset);
    }
    const Oracle oracle = oracle_of(turned);
    const auto report = weft::make_mesh_3(oracle, criteria_of(0.25 * extent, bound * extent), refinement()).report;
    INFO(report);
    CHECK(report.ok());
    return static_cast<double>(report.vertices);
  };
  const double usual = vertices(1, 0, 1e-3);
  for (const double bound : {1e-6, 1e-8, 1e-10, 1e-12}) CHECK(vertices(1, 0, bound) == Approx(usual).epsilon(0.02));
  for (const double extent : {1e-9, 1e6, 1e9}) CHECK(vertices(extent, 0, 1e-9) == Approx(usual).epsilon(0.02));
  CHECK(vertices(1, 1e6, 1e-6) == Approx(usual).epsilon(0.02));
}

TEST_CASE("the approximation of a patch binds its creases, too")
{
  const Oracle oracle = oracle_of(surfaces::cylinder(200));
  REQUIRE(oracle.number_of_creases() == 2);
  int side = -1; // the patch at both creases
  const auto incidence = oracle.incidence();
  for (const int p : incidence.patches_of_crease(0))
    for (const int q : incidence.patches_of_crease(1))
      if (p == q) side = p;
  REQUIRE(side >= 0);
  const auto farthest = [&](const Criteria& criteria) {
    const auto result = weft::make_mesh_3(oracle, criteria, refinement());
    CHECK(result.report.ok());
    const Mesh mesh = weft::tetrahedral_mesh(result.restricted);
    double distance = 0;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
      const Point middle = CGAL::midpoint(mesh.points[mesh.edges[e][0]], mesh.points[mesh.edges[e][1]]);
      distance = std::max(distance, CGAL::squared_distance(middle, oracle.project_on_crease(middle, mesh.creases[e])));
    }
    return std::sqrt(distance);
  };
  Criteria criteria = criteria_of(0.8, 0.1);
  CHECK(farthest(criteria) > 0.01); // so that there is something to bind
  criteria.patches[side].approximation = 0.002;
  CHECK(farthest(criteria) <= 0.0021); // rounding, and the crease is a polygon
}

TEST_CASE("a thin rod, a needle and the walls of a narrow slot are whole, with few vertices")
{
  const auto stretched = [](Surface s, double x, double y, double z) {
    for (Point& p : s.points) p = Point(x * p.x(), y * p.y(), z * p.z());
    return s;
  };
  // A block with a slot 0.03 wide and 7 deep.
  Surface slot = surfaces::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}});
  const double xs[] = {0, 5, 5.03, 10}, ys[] = {0, 3, 10};
  for (Point& p : slot.points) p = Point(xs[static_cast<int>(p.x())], ys[static_cast<int>(p.y())], 3 * p.z());
  struct Case
  {
    Surface surface;
    double size, approximation;
    std::size_t most_vertices;
  };
  for (const Case& c : {Case{stretched(surfaces::cylinder(24), 0.05, 0.05, 20), 4, 0.1, 5000},
                        Case{surfaces::cone(24, 60), 4, 0.1, 6000}, Case{slot, 2, 0.01, 8000}}) {
    const Oracle oracle = oracle_of(c.surface);
    const auto result = weft::make_mesh_3(oracle, criteria_of(c.size, c.approximation, false), refinement());
    INFO(result.report);
    CHECK(result.report.domain.ok());
    CHECK(result.report.manifold);
    CHECK(result.report.vertices < c.most_vertices);
    const Mesh mesh = weft::tetrahedral_mesh(result.restricted);
    CHECK(number_of_shells(mesh) == 1);
    CHECK(volume_of_cells(mesh) == Approx(surfaces::volume(c.surface)).epsilon(0.5)); // the bound is wider than the rod
  }
}
