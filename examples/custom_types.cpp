// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh by an oracle, a criterion and a smoother of one's own: a ball with small cells where a function is steep.
//
//   custom_types [FILE]    writes ball.vtu, or FILE; status 1 if the mesh isn't what was asked for

#include "custom_criterion.h"
#include "custom_oracle.h"
#include "custom_smoother.h"

#include <weft/IO/write_mesh_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/smooth_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <iostream>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

int main(int argc, char** argv)
{
  const Unit_ball<K> ball;
  const auto steep = [](const K::Point_3& p) { return std::tanh(5 * p.x()); };
  weft::Criteria_3<K> criteria;
  criteria.size = 0.6;
  criteria.approximation = 0.05;
  criteria.cell_demand = Interpolation_demand<K>(steep, 0.05);

  auto [restricted, report] = weft::make_mesh_3(ball, criteria, weft::Mesh_options_3::refinement());
  std::cout << report;
  std::cout << weft::smooth_3(restricted, criteria, weft::Smooth_options_3(), Laplacian_smoother()).moves
            << " moves of smoothing\n";

  const auto mesh = weft::tetrahedral_mesh(restricted);
  bool is_right = report.ok() && weft::validate_3(mesh).ok();
  for (std::size_t v = 0; v < mesh.points.size(); ++v) // the boundary is exact, not a polyhedron
    if (mesh.locations[v].dimension == 2)
      is_right = is_right && std::abs(CGAL::squared_distance(mesh.points[v], K::Point_3(0, 0, 0)) - 1) < 1e-12;
  weft::IO::write_mesh_3(argc > 1 ? argv[1] : "ball.vtu", mesh);
  return is_right ? 0 : 1;
}
