// SPDX-License-Identifier: GPL-3.0-or-later
//
// What weights do for slivers (Tournois 2009, sec. 4.2.3) and what an approximating lifting does for meshes (sec. 4.1).
//
//   weights_3 [--size S] [--approximation A] [--sharp ANGLE] [--sweeps N] [--smoothing] FILE
//   weights_3 --lifting [--size S] [--sweeps N] [FILE]
//
// FILE is a surface, or ball. Lengths are in parts of the longest side: size 0.1 and approximation 0.001 unless given.
// The first form prints the slivers that are left by smoothing, weights, CGAL's sliver exudation and perturbation, each
// of the same mesh with its boundary kept, with --smoothing what smoothing alone leaves. The second one prints what
// interior points make of a mesh that move to where liftings of several kinds have small errors; of the unit ball
// without a file.

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "../spatial/spatial_inputs.h"
#include "fitted_lifting_3.h"
#include "optimisation_peers.h"

#include <weft/energy/weighted_odt_energy_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/cgal/from_c3t3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/solve/minimise_weighted_energy_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

using K = Spatial_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;

struct Arguments
{
  double size = 0.1, approximation = 0.001, sharp = 0;
  int sweeps = 100;
  bool lifting = false, smoothing = false;
  std::string file;
};

Arguments read_arguments(int argc, char** argv)
{
  Arguments result;
  for (Argument_reader a(argc, argv); a.next();) {
    if (a.is("--size"))
      result.size = a.positive();
    else if (a.is("--approximation"))
      result.approximation = a.positive();
    else if (a.is("--sharp"))
      result.sharp = a.number();
    else if (a.is("--sweeps"))
      result.sweeps = static_cast<int>(a.positive());
    else if (a.is("--lifting"))
      result.lifting = true;
    else if (a.is("--smoothing"))
      result.smoothing = true;
    else
      result.file = a.operand();
  }
  return result;
}

/// Cells with their points ascending, to compare meshes with the same points.
std::set<std::array<std::size_t, 4>> cells_of(const Mesh& mesh)
{
  std::set<std::array<std::size_t, 4>> result;
  for (auto c : mesh.cells) {
    std::sort(c.begin(), c.end());
    result.insert(c);
  }
  return result;
}

std::vector<std::string> quality_columns(const Mesh& mesh)
{
  const auto q = weft::measure_quality_3(mesh);
  return {std::to_string(q.cells),           std::to_string(q.cells_below(5)),     std::to_string(q.cells_below(10)),
          std::to_string(q.cells_below(15)), text(q.smallest_dihedral.degrees, 2), text(q.largest_dihedral.degrees, 2),
          text(q.mean_smallest_dihedral, 2), text(q.mean_radius_ratio, 4)};
}

const std::vector<std::string> quality_head{"cells",    "below 5", "below 10",      "below 15",
                                            "smallest", "largest", "mean smallest", "radius ratio"};

void print(const std::string& name, const Mesh& mesh, double seconds, const std::string& remark)
{
  std::vector<std::string> cells{name, std::to_string(mesh.points.size())};
  for (const auto& c : quality_columns(mesh)) cells.push_back(c);
  cells.push_back(seconds_text(seconds));
  cells.push_back(remark);
  std::cout << markdown_row(cells) << std::flush;
}

void print_head(const std::string& remark)
{
  std::vector<std::string> head{"mesh", "vertices"};
  head.insert(head.end(), quality_head.begin(), quality_head.end());
  head.push_back("user s");
  head.push_back(remark);
  std::cout << markdown_head(head);
}

/// Slivers by how many of their points lie on the boundary, and their parts of the volume and of the ODT energy: what
/// removing them could gain.
std::string about_slivers(const Mesh& mesh, double degrees)
{
  std::array<int, 5> counts{};
  double slivers = 0, sliver_volume = 0, all = 0, volume = 0;
  for (const auto& c : mesh.cells) {
    weft::internal::Simplices<3> one;
    for (const std::size_t v : c) one.points.push_back({mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z()});
    one.simplices = {{0, 1, 2, 3}};
    const double error = weft::internal::odt_terms(one).value, v = weft::internal::volume_terms(one, false).value;
    all += error, volume += v;
    if (weft::internal::degrees_of_cosine(weft::internal::cosine_of_smallest_dihedral(
            mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]])) >= degrees)
      continue;
    slivers += error, sliver_volume += v;
    ++counts[static_cast<std::size_t>(
        std::count_if(c.begin(), c.end(), [&](std::size_t p) { return mesh.locations[p].dimension < 3; }))];
  }
  const auto inside =
      std::count_if(mesh.locations.begin(), mesh.locations.end(), [](const auto& at) { return at.dimension == 3; });
  std::string result = "below " + text(degrees, 0) + " with 4, 3, ... 0 points on the boundary:";
  for (std::size_t k = 5; k-- > 0;) result += " " + std::to_string(counts[k]);
  return result + "; " + text(100 * sliver_volume / volume, 3) + " % of the volume, " + text(100 * slivers / all, 3) +
         " % of the energy; points inside " + std::to_string(inside);
}

/// Edge lengths around points, as the metric of smoothing.
std::vector<double> sizes_of(const Mesh& mesh)
{
  std::vector<double> sum(mesh.points.size(), 0), count(mesh.points.size(), 0);
  for (const auto& c : mesh.cells)
    for (const std::size_t v : c)
      for (const std::size_t w : c)
        if (v != w) sum[v] += std::sqrt(CGAL::squared_distance(mesh.points[v], mesh.points[w])), ++count[v];
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1.);
  return sum;
}

void print_weights(const std::string& name, const Mesh& start, const weft::Weighted_options_3& options,
                   const weft::Polyhedral_oracle_3<K>* oracle = nullptr)
{
  const Stopwatch watch;
  const auto result = oracle ? weft::minimise_weighted_energy_3(start, *oracle, options)
                             : weft::minimise_weighted_energy_3(start, options);
  const double seconds = watch.seconds();
  const auto before = cells_of(start), after = cells_of(result.mesh);
  const auto kept = std::count_if(before.begin(), before.end(), [&](const auto& c) { return after.count(c) > 0; });
  const auto& energies = result.report.energies;
  print(name, result.mesh, seconds,
        "energy " + text(100 * (energies.back() / energies.front() - 1), 2) + " % in " +
            std::to_string(result.report.sweeps) + " sweeps, " + std::to_string(result.report.undone_sweeps) +
            " undone; cells gone " +
            text(100 - 100. * static_cast<double>(kept) / static_cast<double>(before.size()), 1) +
            " %; moves taken back " + std::to_string(result.taken_back));
}

/// Holds the points on the boundary.
template <class Restricted>
void fix_boundary(Restricted& mesh)
{
  for (const auto v : mesh.vertices())
    if (v->location().dimension < 3) mesh.fix(v);
}

void compare_slivers(const Arguments& arguments)
{
  const Spatial_input input =
      arguments.file == "ball" ? make_input("ball", unit_sphere(5), 0) : read_input(arguments.file, arguments.sharp);
  const weft::Polyhedral_oracle_3<K> oracle(input.complex);
  weft::Criteria_3<K> criteria;
  criteria.size = arguments.size;
  criteria.approximation = arguments.approximation;
  criteria.facet_shape = criteria.cell_shape = 2;
  criteria.topology = input.is_creased();
  print_head("remark");
  bool is_first = true;
  const auto smoothed = [&](bool free) { // as make_mesh_3() does, or as fig. 3.6 of the thesis
    auto options = free ? weft::Mesh_options_3::refinement() : weft::Mesh_options_3();
    options.min_dihedral_angle = 0;
    auto mesh = weft::make_mesh_3(oracle, criteria, options).restricted;
    weft::Smooth_options_3 smoothing;
    smoothing.keep_criteria = !free;
    smoothing.max_sweeps = arguments.sweeps;
    if (free) {
      const Mesh refined = weft::tetrahedral_mesh(mesh);
      if (std::exchange(is_first, false)) print("refined", refined, 0, about_slivers(refined, 10));
    }
    weft::smooth_3(mesh, criteria, smoothing, weft::Natural_odt_3());
    return mesh;
  };
  for (const bool free : {false, true}) {
    const std::string name = free ? "free ODT" : "ODT";
    auto restricted = smoothed(free);
    const Mesh start = weft::tetrahedral_mesh(restricted);
    print(name, start, 0, about_slivers(start, 10));
    if (arguments.smoothing) continue;
    weft::Weighted_options_3 weighted;
    weighted.solver.max_sweeps = arguments.sweeps;
    weighted.sizes = sizes_of(start);
    for (const auto error : {weft::Lifting_error::up_to_a_constant, weft::Lifting_error::squared})
      for (const bool both : {false, true}) {
        weighted.error = error;
        weighted.move_points = both;
        print_weights(name + (both ? ", weights and places" : ", weights") +
                          (error == weft::Lifting_error::squared ? ", squared" : ""),
                      start, weighted);
      }
    weighted.error = weft::Lifting_error::up_to_a_constant;
    weighted.move_points = true;
    print_weights(name + ", weights and places, boundary slides", start, weighted, &oracle);
    {
      const Stopwatch watch;
      const auto complex = exude_with_cgal(restricted, 0);
      print(name + ", exudation", weft::from_c3t3(complex).mesh, watch.seconds(), "");
    }
    for (const bool fixed : {true, false}) {
      auto mesh = smoothed(free);
      if (fixed) fix_boundary(mesh);
      weft::Perturb_options_3 perturbation;
      const Stopwatch watch;
      weft::perturb_slivers_3(mesh, criteria, perturbation);
      print(name + ", perturbation" + (fixed ? ", boundary held" : ""), weft::tetrahedral_mesh(mesh), watch.seconds(),
            "");
    }
  }
}

void compare_liftings(const Arguments& arguments)
{
  const Spatial_input input =
      arguments.file.empty() ? make_input("ball", unit_sphere(5), 0) : read_input(arguments.file, arguments.sharp);
  const weft::Polyhedral_oracle_3<K> oracle(input.complex);
  weft::Criteria_3<K> criteria;
  criteria.size = arguments.size;
  criteria.approximation = arguments.file.empty() ? 0.1 * arguments.size : arguments.approximation;
  criteria.facet_shape = criteria.cell_shape = 2;
  auto refining = weft::Mesh_options_3::refinement();
  refining.lattice = false;
  const Mesh start = weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria, refining).restricted);
  const bool uniform = arguments.file.empty();
  const std::vector<double> sizes = uniform ? std::vector<double>() : sizes_of(start);
  const std::vector<double> none(start.points.size(), 0);
  print_head("L2 error, interpolated; up to a constant; best lifting; weights vary by");
  const auto remark = [&](const Mesh& mesh) {
    const auto fitted = weft::least_squares_weights_3(mesh, sizes);
    const auto error = [&](const std::vector<double>& w, weft::Lifting_error kind) {
      return text(1e3 * std::sqrt(weft::weighted_odt_energy_3(mesh, w, kind, sizes).value), 4);
    };
    double mean = 0, square = 0;
    for (std::size_t v = 0; v < fitted.size(); ++v) {
      const double w = fitted[v] / (uniform ? 1 : sizes[v] * sizes[v]);
      mean += w / static_cast<double>(fitted.size()), square += w * w / static_cast<double>(fitted.size());
    }
    return error(none, weft::Lifting_error::squared) + "; " + error(none, weft::Lifting_error::up_to_a_constant) +
           "; " + error(fitted, weft::Lifting_error::squared) + "; " +
           text(100 * std::sqrt(std::max(0., square - mean * mean)) / mean, 1) + " %";
  };
  print("refined", start, 0, remark(start));
  weft::Weighted_options_3 options;
  options.move_weights = false;
  options.move_points = true;
  options.sizes = sizes;
  options.solver.max_sweeps = arguments.sweeps;
  const auto run = [&](const std::string& name, weft::Lifting_error error) {
    options.error = error;
    const Stopwatch watch;
    const auto result = weft::minimise_weighted_energy_3(start, options);
    print(name, result.mesh, watch.seconds(), remark(result.mesh) + "; sweeps " + std::to_string(result.report.sweeps));
  };
  run("ODT: interpolation, L1", weft::Lifting_error::volume);
  run("interpolation, L2", weft::Lifting_error::squared);
  run("interpolation up to a constant, L2", weft::Lifting_error::up_to_a_constant);
  const Stopwatch watch;
  const auto result = minimise_fitted_lifting(start, options);
  print("best lifting, L2", result.mesh, watch.seconds(),
        remark(result.mesh) + "; sweeps " + std::to_string(result.report.sweeps));
  options.move_weights = true;
  run("regular triangulation, weights and places, L2 up to a constant", weft::Lifting_error::up_to_a_constant);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("weights_3", [&] {
    const Arguments arguments = read_arguments(argc, argv);
    if (arguments.lifting)
      compare_liftings(arguments);
    else
      compare_slivers(arguments);
  });
}
