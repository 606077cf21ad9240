// SPDX-License-Identifier: GPL-3.0-or-later
//
// What one sweep of the relaxation over all vertices costs, against building their Delaunay triangulation from
// scratch.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_SWEEP_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_SWEEP_H

#include "planar_inputs.h"
#include "planar_measure.h"
#include "planar_peers.h"

#include <weft/options.h>
#include <weft/planar/relax/Lloyd_2.h>
#include <weft/planar/triangulation/Relocator_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/Delaunay_triangulation_2.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace benchmark {

struct Sweep
{
  std::size_t vertices = 0;
  double delaunay = 0, first = 0, first_positions = 0, late = 0, late_positions = 0; // seconds
};

/// Seconds to compute all new positions, and to move all vertices there.
template <class Mesh>
std::pair<double, double> sweep(Mesh& mesh, weft::internal::Lloyd_2<Mesh>& smoother,
                                weft::internal::Relocator_2<Weft_cdt>& relocator)
{
  std::vector<typename Mesh::Vertex_handle> moving;
  std::vector<Point> targets;
  const double start = user_seconds();
  smoother.compute(mesh.faces());
  for (const auto v : mesh.vertices()) {
    if (v->constraint() == weft::fixed_vertex) continue;
    moving.push_back(v);
    targets.push_back(smoother.target(v).point);
  }
  const double positions = user_seconds();
  relocator.move(moving, targets);
  return {positions - start, user_seconds() - positions};
}

inline Sweep measure_sweep(double vertices)
{
  using Mesh = weft::internal::Working_mesh_2<Weft_cdt, weft::Uniform_sizing<>>;
  constexpr int repeats = 5, sweeps = 40;
  const Domain domain({"square", square()});
  const weft::Uniform_sizing<> sizing(domain.size_for(vertices / 1.09)); // CGAL makes 1.09 vertices an ideal triangle
  Weft_cdt refined(domain.weft);
  refine_with_cgal(refined, sizing.size());

  Sweep result;
  result.vertices = refined.number_of_vertices();
  std::vector<Point> points(refined.points_begin(), refined.points_end());
  std::mt19937 engine(1);
  std::shuffle(points.begin(), points.end(), engine);
  std::vector<double> delaunay, first, first_positions, late, late_positions;
  for (int i = 0; i < repeats; ++i) {
    const double start = user_seconds();
    const CGAL::Delaunay_triangulation_2<Kernel> triangulation(points.begin(), points.end());
    delaunay.push_back(user_seconds() - start);
    Weft_cdt cdt(refined);
    Mesh mesh(cdt, sizing, Mesh::Given::relaxable);
    const weft::Mesh_options_2 options;
    weft::internal::Lloyd_2<Mesh> smoother(mesh, options.size_feedback, options.quadrature, 1);
    weft::internal::Relocator_2<Weft_cdt> relocator(cdt);
    std::pair<double, double> times = sweep(mesh, smoother, relocator);
    first_positions.push_back(times.first);
    first.push_back(times.first + times.second);
    for (int k = 1; k < sweeps; ++k) times = sweep(mesh, smoother, relocator);
    late_positions.push_back(times.first);
    late.push_back(times.first + times.second);
  }
  result.delaunay = median(delaunay);
  result.first = median(first);
  result.first_positions = median(first_positions);
  result.late = median(late);
  result.late_positions = median(late_positions);
  return result;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_SWEEP_H
