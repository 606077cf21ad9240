// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of the thesis' spatial algorithms as they are printed: meshes are valid restricted Delaunay triangulations
// whichever part is switched, reports say what checks that know nothing of the mesher say, limits hold, and runs
// repeat.

#include "fixtures/meshing_fixtures_3.h"

#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/optimise_3.h>
#include <weft/spatial/optimise/perturb_as_published_3.h>
#include <weft/spatial/run/Delaunay_mesh_3.h>
#include <weft/thesis.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace {

using namespace meshing;
using Published = weft::As_published_options_3;

const Oracle& ball()
{
  static const Oracle oracle = oracle_of(surfaces::sphere(2));
  return oracle;
}

const Oracle& box()
{
  static const Oracle oracle = oracle_of(surfaces::cube());
  return oracle;
}

void check_mesh(const Restricted& restricted, const weft::Mesh_report_3& report)
{
  CHECK(weft::check_restricted_3(restricted).ok());
  const Mesh mesh = weft::tetrahedral_mesh(restricted);
  CHECK(weft::validate_3(mesh).ok());
  CHECK(report.vertices == mesh.points.size());
  CHECK(report.cells == mesh.cells.size());
}

struct Switch
{
  const char* name;
  std::function<void(Published&)> set;
};

const std::vector<Switch>& switches()
{
  static const std::vector<Switch> all = {
      {"as printed", [](Published&) {}},
      {"initial_loosening", [](Published& o) { o.initial_loosening = 1; }},
      {"target_steps", [](Published& o) { o.target_steps = 3; }},
      {"plain_points", [](Published& o) { o.plain_points = false; }},
      {"mixed_batches", [](Published& o) { o.mixed_batches = false; }},
      {"plain_creases", [](Published& o) { o.plain_creases = false; }},
      {"follow_folds", [](Published& o) { o.follow_folds = true; }},
      {"see_ridges", [](Published& o) { o.see_ridges = true; }},
      {"mirror", [](Published& o) { o.mirror = true; }},
      {"lattice", [](Published& o) { o.lattice = true; }},
      {"grade", [](Published& o) { o.grade = false; }},
      {"interleave", [](Published& o) { o.interleave = false; }},
      {"sweeps", [](Published& o) { o.sweeps = 0; }},
      {"lock", [](Published& o) { o.lock = false; }},
      {"keep_criteria", [](Published& o) { o.keep_criteria = true; }},
      {"smooth_surface", [](Published& o) { o.smooth_surface = true; }},
      {"coarsen", [](Published& o) { o.coarsen = true; }},
      {"published_perturbation", [](Published& o) { o.published_perturbation = false; }},
      {"only_compatible", [](Published& o) { o.perturbation.only_compatible = false; }},
      {"averages", [](Published& o) { o.perturbation.averages = false; }},
      {"repeats_steps", [](Published& o) { o.perturbation.repeats_steps = false; }},
      {"in_order", [](Published& o) { o.perturbation.in_order = false; }},
      {"rising_bounds", [](Published& o) { o.perturbation.rising_bounds = true; }},
      {"large_angles", [](Published& o) { o.perturbation.large_angles = true; }},
      {"perturbation.keep_criteria", [](Published& o) { o.perturbation.keep_criteria = true; }},
  };
  return all;
}

/// Whether sizes, shapes and topology are as asked for, found without the mesher's code.
bool meets(const Restricted& restricted, const Criteria& criteria)
{
  return weft::check_criteria_3(weft::tetrahedral_mesh(restricted), criteria).ok();
}

} // namespace

TEST_CASE("each part of Alg. 5 to 7 can be switched alone, and the mesh is valid and what the report says")
{
  const Criteria criteria = criteria_of(0.5, 0.05);
  for (const Oracle* oracle : {&ball(), &box()})
    for (const Switch& s : switches()) {
      CAPTURE(s.name, oracle == &ball());
      Published options;
      options.min_dihedral_angle = 10;
      options.max_batches = 80;
      s.set(options);
      const auto result = weft::mesh_as_published_3(*oracle, criteria, options);
      check_mesh(result.restricted, result.report);
      CHECK((meets(result.restricted, criteria) || result.report.bad() > 0));
      CHECK((result.report.ok() || result.report.stop_reason != weft::Stop_reason::criteria_met));
      CHECK(result.report.bad() >= result.bad_as_refined);
      CHECK(result.perturbation.after >= result.perturbation.before);
      CHECK(result.report.smallest_dihedral == Approx(result.perturbation.after).margin(1e-4));
    }
}

TEST_CASE("without perturbation the criteria hold as refinement understood them")
{
  Published options;
  options.min_dihedral_angle = 0;
  options.interleave = GENERATE(true, false);
  const auto result = weft::mesh_as_published_3(ball(), criteria_of(0.3, 0.01), options);
  CHECK(result.bad_as_refined == 0);
  CHECK(result.report.smoothing_sweeps > 0);
  CHECK(result.report.batches > 1);
  CHECK(result.perturbation.tried_vertices == 0);
}

TEST_CASE("perturbation as printed takes slivers away, and keeps criteria where it is asked to")
{
  Published options;
  options.min_dihedral_angle = 0;
  const Criteria criteria = criteria_of(0.25, 0.02);
  auto result = weft::mesh_as_published_3(ball(), criteria, options);
  weft::Published_perturb_options_3 perturbing;
  perturbing.target = 12;
  perturbing.keep_criteria = true;
  CHECK(meets(result.restricted, criteria));
  const auto report = weft::perturb_as_published_3(result.restricted, criteria, perturbing);
  CHECK(report.by_radius + report.by_volume + report.by_chance > 0);
  CHECK(report.after >= report.before);
  CHECK(meets(result.restricted, criteria));
  CHECK(weft::check_restricted_3(result.restricted).ok());
}

TEST_CASE("limits of runs as printed are kept, and the mesh is valid then")
{
  const Criteria criteria = criteria_of(0.1, 0.01);
  Published options;
  SECTION("vertices")
  {
    options.max_vertices = 150;
    const auto result = weft::mesh_as_published_3(ball(), criteria, options);
    CHECK(result.report.stop_reason == weft::Stop_reason::vertex_budget);
    CHECK(result.restricted.vertices().size() <= 150);
    check_mesh(result.restricted, result.report);
  }
  SECTION("time")
  {
    options.time_limit = 0.2;
    const auto result = weft::mesh_as_published_3(ball(), criteria, options);
    CHECK(result.report.stop_reason == weft::Stop_reason::time_limit);
    check_mesh(result.restricted, result.report);
  }
  SECTION("batches")
  {
    options.max_batches = 30;
    const auto result = weft::mesh_as_published_3(ball(), criteria, options);
    CHECK(result.report.stop_reason == weft::Stop_reason::iteration_limit);
    CHECK(result.report.batches == 30);
    check_mesh(result.restricted, result.report);
  }
  SECTION("the visitor, in any stage")
  {
    const weft::Stage stage = GENERATE(weft::Stage::refinement, weft::Stage::relaxation, weft::Stage::polishing);
    bool is_over = false, was_called_again = false;
    options.visitor = [&](const weft::Progress& progress) {
      was_called_again = was_called_again || is_over;
      is_over = progress.stage == stage;
      return !is_over;
    };
    const auto result = weft::mesh_as_published_3(ball(), criteria_of(0.3, 0.02), options);
    CHECK(is_over);
    CHECK_FALSE(was_called_again);
    CHECK(result.report.stop_reason == weft::Stop_reason::cancelled);
    check_mesh(result.restricted, result.report);
  }
}

TEST_CASE("runs as printed repeat to the last bit, with any number of threads")
{
  const auto points = [](int threads, unsigned seed) {
    Published options;
    options.threads = threads;
    options.seed = seed;
    return weft::tetrahedral_mesh(weft::mesh_as_published_3(ball(), criteria_of(0.3, 0.02), options).restricted).points;
  };
  const auto once = points(1, 0);
  CHECK(once == points(1, 0));
  CHECK(once == points(2, 0));
  CHECK_FALSE(once == points(1, 1));
}

TEST_CASE("options out of range are refused by name")
{
  const auto refused = [](const auto& set) {
    Published options;
    set(options);
    CHECK_THROWS_AS(weft::mesh_as_published_3(ball(), criteria_of(0.3, 0.02), options), weft::Option_error);
  };
  refused([](Published& o) { o.initial_loosening = 0.5; });
  refused([](Published& o) { o.target_steps = 0; });
  refused([](Published& o) { o.lipschitz = 0; });
  refused([](Published& o) { o.sweeps = -1; });
  refused([](Published& o) { o.min_dihedral_angle = 80; });
  refused([](Published& o) { o.perturbation.reach = 0; });
  refused([](Published& o) { o.threads = 0; });
  refused([](Published& o) { o.time_limit = not_a_number; });
}

TEST_CASE("points, cells and labels become a mesh that the optimisers take")
{
  // A box of two cubes, each of 6 cells around its diagonal, with a label each.
  weft::Element_soup_3<K> soup;
  for (int i = 0; i < 12; ++i) soup.points.emplace_back(i % 3, i / 3 % 2, i / 6);
  const std::array<std::size_t, 3> steps{{1, 3, 6}};
  for (const std::size_t first : {0, 1})
    for (std::size_t a = 0; a < 3; ++a)
      for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3}) {
        soup.cells.push_back({first, first + steps[a], first + steps[a] + steps[b], first + 10});
        soup.cell_tags.push_back(first == 0 ? 4 : 9);
      }
  weft::Delaunay_mesh_3<K> delaunay(soup);
  CHECK(weft::check_restricted_3(delaunay.restricted()).ok());
  const auto report = weft::optimise_3(delaunay.restricted(), delaunay.criteria());
  CHECK(report.perturbation.after >= report.perturbation.before);
  const Mesh mesh = delaunay.mesh();
  CHECK(weft::validate_3(mesh).ok());
  CHECK(volume_of_cells(mesh) == Approx(2));
  for (const int label : {4, 9}) CHECK(std::count(mesh.subdomains.begin(), mesh.subdomains.end(), label) > 0);
  CHECK(std::count_if(mesh.subdomains.begin(), mesh.subdomains.end(), [](int s) { return s == 4 || s == 9; }) ==
        static_cast<long>(mesh.cells.size()));
  soup.cells.push_back(soup.cells.front());
  soup.cell_tags.push_back(4);
  CHECK_THROWS_AS(weft::Delaunay_mesh_3<K>(soup), weft::Error);
}
