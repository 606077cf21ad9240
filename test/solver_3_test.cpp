// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of solvers in space: the energy falls in every sweep, the mesh stays one of its domain, and slivers become
// fewer.

#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/energy/odt_energy_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/optimise/optimise_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/restricted/check_restricted_3.h>
#include <weft/spatial/run/Delaunay_mesh_3.h>
#include <weft/spatial/solve/minimise_energy_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace meshing;
using weft::Energy;
using weft::Solver;

template <class Restricted>
std::size_t cells_below(const Restricted& mesh, double degrees)
{
  std::size_t n = 0;
  for (const auto c : mesh.triangulation().finite_cell_handles())
    n +=
        c->subdomain() != 0 && weft::internal::degrees_of_cosine(weft::internal::cosines_of_cell(c).smallest) < degrees;
  return n;
}

TEST_CASE("solvers lower the energy in every sweep and keep to the domain")
{
  const auto surface = surfaces::cube();
  const Oracle oracle = oracle_of(surface);
  const Criteria criteria = criteria_of(0.3, 0.01);
  const auto energy = GENERATE(Energy::odt, Energy::cvt);
  const auto solver = GENERATE(Solver::fixed_point, Solver::quasi_newton, Solver::newton);
  auto mesh = weft::make_mesh_3(oracle, criteria, refinement()).restricted;
  weft::Solver_options options;
  options.energy = energy;
  options.solver = solver;
  options.max_sweeps = 12;
  weft::Smooth_options_3 smoothing;
  smoothing.uniform = true;
  const auto report = weft::minimise_energy_3(mesh, criteria, options, smoothing);
  REQUIRE(report.energies.size() > 3);
  CHECK(std::is_sorted(report.energies.rbegin(), report.energies.rend()));
  CHECK(report.energies.back() < 0.97 * report.energies.front());
  CHECK(weft::check_restricted_3(mesh).ok());
  const Mesh result = weft::tetrahedral_mesh(mesh);
  CHECK(volume_of_cells(result) == Approx(1));
  CHECK(weft::check_locations_3(result).ok());
  for (std::size_t v = 0; v < result.points.size(); ++v) { // on a face at least one coordinate is 0 or 1
    if (result.locations[v].dimension > 2) continue;
    const Point& p = result.points[v];
    int on = 0;
    for (int k = 0; k < 3; ++k) on += p[k] == 0 || p[k] == 1;
    CHECK(on >= 3 - result.locations[v].dimension);
  }
  if (energy == Energy::odt) // of a cube, whose volume stays, that per volume
    CHECK(report.energies.back() == Approx(weft::odt_energy_3(result).value));
}

TEST_CASE("with the criteria kept, nothing that a solver makes is bad")
{
  const Oracle oracle = oracle_of(surfaces::sphere(3));
  const Criteria criteria = criteria_of(0.3, 0.02);
  auto mesh = weft::make_mesh_3(oracle, criteria, refinement()).restricted;
  const bool uniform = GENERATE(true, false);
  const std::size_t before = cells_below(mesh, 12);
  weft::Smooth_options_3 smoothing;
  smoothing.uniform = uniform;
  smoothing.max_sweeps = 20;
  const auto report = weft::smooth_3(mesh, criteria, smoothing, weft::Energy_smoother_3());
  CHECK(report.sweeps > 3);
  CHECK(report.energy_after < report.energy_before);
  CHECK(weft::check_restricted_3(mesh).ok());
  const Mesh result = weft::tetrahedral_mesh(mesh);
  CHECK(weft::check_criteria_3(result, criteria).ok());
  CHECK(3 * cells_below(mesh, 12) < before);
}

TEST_CASE("free sweeps of the metric's energy leave few slivers")
{
  const Oracle oracle = oracle_of(surfaces::sphere(3));
  const Criteria criteria = criteria_of(0.25, 0.02);
  auto mesh = weft::make_mesh_3(oracle, criteria, refinement()).restricted;
  const std::size_t before = cells_below(mesh, 10);
  REQUIRE(before > 10);
  weft::Smooth_options_3 smoothing;
  smoothing.keep_criteria = false;
  weft::Solver_options options;
  options.max_sweeps = 40;
  const auto report = weft::minimise_energy_3(mesh, criteria, options, smoothing);
  CHECK(std::is_sorted(report.energies.rbegin(), report.energies.rend()));
  CHECK(weft::check_restricted_3(mesh).ok());
  CHECK(5 * cells_below(mesh, 10) < before);
}

/// A mesh of a cube as others may make it: interior vertices moved at random, cells as they were, tags of one's own.
Mesh others_mesh()
{
  const Oracle oracle = oracle_of(surfaces::cube());
  Mesh mesh = weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria_of(0.2, 0.01), refinement()).restricted);
  std::mt19937 random(1);
  const auto shift = [&random] { return 0.03 * (random() / 4294967296.0 - 0.5); };
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.locations[v].dimension < 3) continue;
    const Point& p = mesh.points[v];
    const double x = p.x() + shift(), y = p.y() + shift(), z = p.z() + shift();
    mesh.points[v] = Point(x, y, z);
  }
  for (int& patch : mesh.patches) patch += 7;
  for (int& subdomain : mesh.subdomains) subdomain = 5;
  return mesh;
}

TEST_CASE("a mesh of any origin can be optimised by any smoother")
{
  const Mesh given = others_mesh();
  weft::Delaunay_mesh_3<K> delaunay(given);
  CHECK(delaunay.report().bad() == 0);
  CHECK(weft::check_restricted_3(delaunay.restricted()).ok());
  CHECK(delaunay.restricted().vertices().size() < 1.05 * static_cast<double>(given.points.size()));
  weft::Optimise_options_3 options;
  options.coarsen = false;
  options.perturbation.target = 15;
  weft::Optimise_report_3 report;
  const int way = GENERATE(0, 1, 2);
  if (way == 0) report = weft::optimise_3(delaunay.restricted(), delaunay.criteria(), options);
  if (way == 1) report = weft::optimise_3(delaunay.restricted(), delaunay.criteria(), options, weft::Lloyd_3());
  if (way == 2)
    report = weft::optimise_3(delaunay.restricted(), delaunay.criteria(), options, weft::Energy_smoother_3());
  CHECK(report.coarsening.tried == 0);
  CHECK(report.smoothing.sweeps > 0);
  CHECK(report.perturbation.after >= 15);
  const Mesh mesh = delaunay.mesh();
  CHECK(volume_of_cells(mesh) == Approx(1));
  CHECK(weft::validate_3(mesh).ok());
  CHECK(weft::measure_quality_3(mesh).smallest_dihedral.degrees >= 15 - 1e-6);
  CHECK(*std::min_element(mesh.patches.begin(), mesh.patches.end()) == 7);
  CHECK(std::all_of(mesh.subdomains.begin(), mesh.subdomains.end(), [](int s) { return s == 5; }));
  weft::Improve_options_3 wrong;
  wrong.deviation = 2;
  CHECK_THROWS_AS(weft::Delaunay_mesh_3<K>(given, wrong), weft::Option_error);
}

TEST_CASE("the CVT energy of sizes that vary is refused")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  auto mesh = weft::make_mesh_3(oracle, criteria_of(0.5, 0.01), refinement()).restricted;
  weft::Solver_options options;
  options.energy = Energy::cvt;
  CHECK_THROWS_AS(weft::minimise_energy_3(mesh, criteria_of(0.5, 0.01), options), weft::Option_error);
}

} // namespace
