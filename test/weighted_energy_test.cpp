// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of weighted energies: values in closed form, gradients against central differences, the best lifting, and
// what minimising over weights and places keeps.

#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/energy/odt_energy_2.h>
#include <weft/energy/odt_energy_3.h>
#include <weft/energy/weighted_odt_energy_2.h>
#include <weft/energy/weighted_odt_energy_3.h>
#include <weft/make_mesh_3.h>
#include <weft/solve/least_squares_weights.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/solve/minimise_weighted_energy_3.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace meshing;
using weft::Lifting_error;
using Mesh_2 = weft::Triangle_mesh_2<K>;

constexpr double accuracy = 1e-6; // of differences, relative
const std::array<Lifting_error, 3> errors{Lifting_error::volume, Lifting_error::squared,
                                          Lifting_error::up_to_a_constant};

double random_part(std::mt19937& random)
{
  return random() / 4294967295.0;
}

Mesh_2 scattered_triangles(unsigned seed)
{
  using Vb = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, K>;
  std::mt19937 random(seed);
  CGAL::Delaunay_triangulation_2<K, CGAL::Triangulation_data_structure_2<Vb>> triangulation;
  Mesh_2 mesh;
  for (int i = 0; i < 25; ++i) {
    mesh.points.emplace_back(i % 5 + 0.5 * random_part(random), i / 5 + 0.5 * random_part(random));
    triangulation.insert(mesh.points.back())->info() = mesh.points.size() - 1;
  }
  for (const auto f : triangulation.finite_face_handles())
    mesh.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  return mesh;
}

/// A Delaunay mesh of a cube or a ball, as refinement leaves it.
Mesh refined_mesh(const Oracle& oracle, double size)
{
  return weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria_of(size, 0.1 * size), refinement()).restricted);
}

template <class Points>
std::vector<double> random_weights(const Points& points, double most, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<double> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.push_back(most * (2 * random_part(random) - 1));
  return result;
}

K::Point_2 shifted(const K::Point_2& p, int k, double h)
{
  return k == 0 ? K::Point_2(p.x() + h, p.y()) : K::Point_2(p.x(), p.y() + h);
}
K::Point_3 shifted(const K::Point_3& p, int k, double h)
{
  return {p.x() + (k == 0) * h, p.y() + (k == 1) * h, p.z() + (k == 2) * h};
}

/// The largest errors of both gradients, in parts of their largest entries.
template <class Mesh_type, class Energy>
std::array<double, 2> gradient_errors(const Mesh_type& mesh, const std::vector<double>& weights, int d,
                                      const Energy& energy_of)
{
  const auto energy = energy_of(mesh, weights);
  const double h = 1e-5;
  std::array<double, 2> worst{0, 0}, scale{0, 0};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int k = 0; k < d; ++k) {
      Mesh_type moved = mesh;
      moved.points[i] = shifted(mesh.points[i], k, h);
      const double after = energy_of(moved, weights).value;
      moved.points[i] = shifted(mesh.points[i], k, -h);
      const double slope = (after - energy_of(moved, weights).value) / (2 * h);
      worst[0] = (std::max)(worst[0], std::abs(slope - energy.gradient[i][k]));
      scale[0] = (std::max)(scale[0], std::abs(energy.gradient[i][k]));
    }
    auto changed = weights;
    changed[i] += h;
    const double after = energy_of(mesh, changed).value;
    changed[i] -= 2 * h;
    const double slope = (after - energy_of(mesh, changed).value) / (2 * h);
    worst[1] = (std::max)(worst[1], std::abs(slope - energy.weight_gradient[i]));
    scale[1] = (std::max)(scale[1], std::abs(energy.weight_gradient[i]));
  }
  return {worst[0] / scale[0], worst[1] / scale[1]};
}

Mesh corner_cell()
{
  Mesh cell;
  cell.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  cell.cells = {{0, 1, 2, 3}};
  cell.subdomains = {1};
  return cell;
}

TEST_CASE("weighted energies of single simplices are those of integration by hand")
{
  const Mesh cell = corner_cell();
  // e = x + y + z - x^2 - y^2 - z^2 over the corner of a cube: integrals of x^a y^b z^c are a! b! c! / (3 + a + b +
  // c)!.
  CHECK(weft::weighted_odt_energy_3(cell, {0, 0, 0, 0}, Lifting_error::volume).value == Approx(9.0 / 120));
  const double xx = 2 / 120., xy = 1 / 120., xxx = 6 / 720., xxy = 2 / 720., xxxx = 24 / 5040., xxyy = 4 / 5040.;
  const double square = 3 * (xx - 2 * xxx + xxxx) + 6 * (xy - 2 * xxy + xxyy);
  CHECK(weft::weighted_odt_energy_3(cell, {0, 0, 0, 0}).value == Approx(square));
  const auto least = weft::weighted_odt_energy_3(cell, {0, 0, 0, 0}, Lifting_error::up_to_a_constant);
  CHECK(least.constant == Approx(9.0 / 20));
  CHECK(least.value == Approx(square - 9.0 / 120 * 9.0 / 20));
  // A weight of 1 at the corner takes 1 - x - y - z away, so that e is -1 there.
  CHECK(weft::weighted_odt_energy_3(cell, {1, 0, 0, 0}, Lifting_error::volume).value == Approx(9.0 / 120 - 1.0 / 24));
  // Sizes of 2: lengths are half as long.
  CHECK(weft::weighted_odt_energy_3(cell, {4, 0, 0, 0}, Lifting_error::squared, {2, 2, 2, 2}).value ==
        Approx(weft::weighted_odt_energy_3(cell, {4, 0, 0, 0}).value / 128));
  Mesh_2 triangle;
  triangle.points = {K::Point_2(0, 0), K::Point_2(2, 0), K::Point_2(0, 1)};
  triangle.triangles = {{0, 1, 2}};
  CHECK(weft::weighted_odt_energy_2(triangle, {0, 0, 0}, Lifting_error::volume).value == Approx(10.0 / 12));
  CHECK(weft::weighted_odt_energy_2(triangle, {0, 3, 0}, Lifting_error::volume).value == Approx(10.0 / 12 - 1));
  CHECK_THROWS_AS(weft::weighted_odt_energy_3(cell, {0, 0, 0}), weft::Option_error);
  CHECK_THROWS_AS(weft::weighted_odt_energy_3(cell, {0, 0, HUGE_VAL, 0}), weft::Option_error);
  CHECK_THROWS_AS(weft::weighted_odt_energy_2(triangle, {0, 0, 0}, Lifting_error::squared, {1, 0, 1}),
                  weft::Option_error);
}

TEST_CASE("without weights the volume is the ODT energy, and a constant changes nothing but the constant")
{
  const Mesh mesh = refined_mesh(oracle_of(surfaces::cube()), 0.5);
  std::vector<double> weights(mesh.points.size(), 0), sizes;
  for (const auto& p : mesh.points) sizes.push_back(0.2 + 0.2 * p.x() + 0.1 * p.y() * p.z());
  for (const auto& s : {std::vector<double>(), sizes}) {
    const auto plain = weft::odt_energy_3(mesh, s);
    const auto weighted = weft::weighted_odt_energy_3(mesh, weights, Lifting_error::volume, s);
    CHECK(weighted.value == Approx(plain.value).epsilon(1e-12));
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (int k = 0; k < 3; ++k)
        CHECK(weighted.gradient[i][k] == Approx(plain.gradient[i][k]).margin(1e-12 * plain.value));
  }
  const Mesh_2 triangles = scattered_triangles(1);
  CHECK(weft::weighted_odt_energy_2(triangles, std::vector<double>(25, 0), Lifting_error::volume).value ==
        Approx(weft::odt_energy_2(triangles).value));
  weights = random_weights(mesh.points, 0.05, 4);
  const auto before = weft::weighted_odt_energy_3(mesh, weights, Lifting_error::up_to_a_constant);
  for (double& w : weights) w += 0.3;
  const auto after = weft::weighted_odt_energy_3(mesh, weights, Lifting_error::up_to_a_constant);
  CHECK(after.value == Approx(before.value));
  CHECK(after.constant == Approx(before.constant - 0.3));
}

TEST_CASE("gradients by places and by weights are central differences")
{
  const Mesh mesh = refined_mesh(oracle_of(surfaces::cube()), 0.6);
  const auto weights = random_weights(mesh.points, 0.05, 1);
  std::vector<double> sizes;
  for (const auto& p : mesh.points) sizes.push_back(0.2 + 0.2 * p.x() + 0.1 * p.y() * p.z());
  const Mesh_2 triangles = scattered_triangles(2);
  const auto weights_2 = random_weights(triangles.points, 0.2, 2);
  std::vector<double> sizes_2;
  for (const auto& p : triangles.points) sizes_2.push_back(1 + 0.1 * p.x() + 0.05 * p.y());
  for (const Lifting_error error : errors) {
    for (const auto& s : {std::vector<double>(), sizes})
      for (const double e : gradient_errors(mesh, weights, 3, [&](const Mesh&m, const std::vector<double>&w) {
             return weft::weighted_odt_energy_3(m, w, error, s);
           }))
        CHECK(e < accuracy);
    for (const auto& s : {std::vector<double>(), sizes_2})
      for (const double e : gradient_errors(triangles, weights_2, 2, [&](const Mesh_2&m, const std::vector<double>&w) {
             return weft::weighted_odt_energy_2(m, w, error, s);
           }))
        CHECK(e < accuracy);
  }
}

TEST_CASE("the best lifting of a triangulation has no gradient by weights and less error than any near it")
{
  const Mesh mesh = refined_mesh(oracle_of(surfaces::cube()), 0.4);
  std::vector<double> sizes;
  for (const auto& p : mesh.points) sizes.push_back(0.2 + 0.2 * p.x());
  for (const auto& s : {std::vector<double>(), sizes}) {
    const auto best = weft::least_squares_weights_3(mesh, s);
    const auto energy = weft::weighted_odt_energy_3(mesh, best, Lifting_error::squared, s);
    const auto none = weft::weighted_odt_energy_3(mesh, std::vector<double>(best.size(), 0), Lifting_error::squared, s);
    for (std::size_t i = 0; i < best.size(); ++i)
      CHECK(std::abs(energy.weight_gradient[i]) < 1e-9 * std::abs(none.weight_gradient[i]) + 1e-12);
    CHECK(energy.value < none.value);
    for (unsigned seed = 0; seed < 5; ++seed) {
      auto other = random_weights(mesh.points, 0.01, seed);
      for (std::size_t i = 0; i < best.size(); ++i) other[i] += best[i];
      CHECK(weft::weighted_odt_energy_3(mesh, other, Lifting_error::squared, s).value > energy.value);
    }
  }
  // One cell: four weights. The mean of the error vanishes, as its products with linear functions do.
  const Mesh cell = corner_cell();
  const auto weights = weft::least_squares_weights_3(cell);
  CHECK(weft::weighted_odt_energy_3(cell, weights, Lifting_error::volume).value == Approx(0).margin(1e-12));
  CHECK(weights[1] == Approx(weights[2]));
  const Mesh_2 triangles = scattered_triangles(3);
  const auto flat = weft::weighted_odt_energy_2(triangles, weft::least_squares_weights_2(triangles));
  for (const double g : flat.weight_gradient) CHECK(g == Approx(0).margin(1e-9));
}

/// What has to hold of a regular mesh of weighted points.
void check_weighted(const weft::Weighted_mesh_3<K>& result, const Mesh& start, const weft::Weighted_options_3& options)
{
  const Mesh& mesh = result.mesh;
  CHECK(std::is_sorted(result.report.energies.rbegin(), result.report.energies.rend()));
  REQUIRE(mesh.points.size() == start.points.size());
  weft::internal::Regular_mesh_3<K> regular(mesh);
  regular.triangulate(mesh.points, result.weights);
  CHECK(regular.hidden() == 0);
  for (const auto& e : regular.triangulation().finite_edges()) {
    const auto &p = e.first->vertex(e.second)->point(), &q = e.first->vertex(e.third)->point();
    CHECK(std::abs(p.weight() - q.weight()) <= (options.bound + 1e-12) * CGAL::squared_distance(p.point(), q.point()));
  }
  for (const auto& c : mesh.cells)
    CHECK(CGAL::orientation(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]) ==
          CGAL::POSITIVE);
}

TEST_CASE("weights lower the error, hide no vertex and keep the boundary")
{
  const bool is_ball = GENERATE(true, false);
  const bool moves_points = GENERATE(false, true);
  const auto error = GENERATE(Lifting_error::squared, Lifting_error::up_to_a_constant);
  const Oracle oracle = oracle_of(is_ball ? surfaces::sphere(2) : surfaces::cube());
  const Mesh start = refined_mesh(oracle, is_ball ? 0.6 : 0.35);
  weft::Weighted_options_3 options;
  options.error = error;
  options.move_points = moves_points;
  options.solver.max_sweeps = 15;
  const auto result = weft::minimise_weighted_energy_3(start, options);
  check_weighted(result, start, options);
  CHECK(result.report.energies.size() > 2);
  CHECK(result.report.energies.back() < result.report.energies.front());
  CHECK(result.report.energies.back() == Approx(weft::weighted_odt_energy_3(result.mesh, result.weights, error).value));
  CHECK(result.mesh.facets == start.facets);
  CHECK(volume_of_cells(result.mesh) == Approx(volume_of_cells(start)));
  CHECK(weft::check_structure_3(result.mesh).ok());
  CHECK(weft::check_boundary_3(result.mesh).ok());
  CHECK(std::any_of(result.weights.begin(), result.weights.end(), [](double w) { return w != 0; }));
  for (std::size_t i = 0; i < start.points.size(); ++i) {
    if (start.locations[i].dimension < 3 || !moves_points) CHECK(result.mesh.points[i] == start.points[i]);
  }
}

TEST_CASE("points that slide along the boundary stay on it, and the domain is the same")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const Mesh start = refined_mesh(oracle, 0.35);
  weft::Weighted_options_3 options;
  options.move_points = GENERATE(false, true);
  options.solver.max_sweeps = 15;
  const auto result = weft::minimise_weighted_energy_3(start, oracle, options);
  check_weighted(result, start, options);
  CHECK(result.report.energies.back() < result.report.energies.front());
  CHECK(volume_of_cells(result.mesh) == Approx(1));
  CHECK(result.mesh.facets == start.facets);
  CHECK(weft::check_boundary_3(result.mesh).ok());
  for (std::size_t i = 0; i < start.points.size(); ++i) {
    int on = 0;
    for (int k = 0; k < 3; ++k) on += result.mesh.points[i][k] == 0 || result.mesh.points[i][k] == 1;
    CHECK(on >= 3 - start.locations[i].dimension);
    if (start.locations[i].dimension < 2) CHECK(result.mesh.points[i] == start.points[i]);
  }
}

TEST_CASE("with weights held at 0, places alone make an optimal Delaunay triangulation")
{
  const Oracle oracle = oracle_of(surfaces::cube());
  const Mesh start = refined_mesh(oracle, 0.3);
  weft::Weighted_options_3 options;
  options.error = Lifting_error::volume;
  options.move_weights = false;
  options.move_points = true;
  options.solver.max_sweeps = 30;
  const auto result = weft::minimise_weighted_energy_3(start, options);
  CHECK(result.report.energies.front() == Approx(weft::odt_energy_3(start).value));
  CHECK(result.report.energies.back() == Approx(weft::odt_energy_3(result.mesh).value));
  CHECK(result.report.energies.back() < 0.99 * result.report.energies.front());
  for (const double w : result.weights) CHECK(w == 0);
}

TEST_CASE("what weighted meshes can't be is refused")
{
  const Mesh start = refined_mesh(oracle_of(surfaces::cube()), 0.5);
  weft::Weighted_options_3 options;
  options.error = Lifting_error::volume;
  CHECK_THROWS_AS(weft::minimise_weighted_energy_3(start, options), weft::Option_error);
  options = {};
  options.bound = 1;
  CHECK_THROWS_AS(weft::minimise_weighted_energy_3(start, options), weft::Option_error);
  options = {};
  options.solver.solver = weft::Solver::newton;
  CHECK_THROWS_AS(weft::minimise_weighted_energy_3(start, options), weft::Option_error);
  options = {};
  CHECK_THROWS_AS(weft::minimise_weighted_energy_3(start, options, {1, 2}), weft::Option_error);
  std::vector<double> weights(start.points.size(), 0);
  weights[0] = 1000; // hides all others
  CHECK_THROWS_AS(weft::minimise_weighted_energy_3(start, options, weights), weft::Error);
}

TEST_CASE("the same weights come out in every run")
{
  const Mesh start = refined_mesh(oracle_of(surfaces::sphere(2)), 0.6);
  weft::Weighted_options_3 options;
  options.move_points = true;
  options.solver.max_sweeps = 6;
  const auto a = weft::minimise_weighted_energy_3(start, options), b = weft::minimise_weighted_energy_3(start, options);
  CHECK(a.weights == b.weights);
  CHECK(a.mesh.points == b.mesh.points);
  CHECK(a.mesh.cells == b.mesh.cells);
}

} // namespace
