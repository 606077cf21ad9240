// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's optimisers of spatial meshes, and what they make of CGAL's refinement.

#ifndef WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_PEERS_H
#define WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_PEERS_H

#include "../spatial/spatial_peers.h"

#include <weft/spatial/cgal/to_c3t3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <CGAL/exude_mesh_3.h>
#include <CGAL/odt_optimize_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <CGAL/Delaunay_triangulation_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace benchmark {

/// ODT as long as CGAL sees fit, or so many sweeps in which every vertex has its turn.
inline void odt_with_cgal(Cgal_complex& complex, const Cgal_domain& domain, std::size_t sweeps = 0)
{
  namespace with = CGAL::parameters;
  if (sweeps == 0)
    CGAL::odt_optimize_mesh_3(complex, domain);
  else
    CGAL::odt_optimize_mesh_3(complex, domain, with::max_iteration_number = sweeps, with::convergence = 0,
                              with::freeze_bound = 0, with::do_freeze = false);
}

/// Perturbs until the smallest dihedral angle reaches the bound, in degrees, or CGAL gives up.
/// \param seconds wall time that it may take; 0: any.
inline void perturb_with_cgal(Cgal_complex& complex, const Cgal_domain& domain, double bound, double seconds = 0)
{
  namespace with = CGAL::parameters;
  CGAL::perturb_mesh_3(complex, domain, with::time_limit = seconds, with::sliver_bound = bound);
}

/// weft's mesh after CGAL's sliver exudation, which gives vertices weights.
template <class Oracle>
auto exude_with_cgal(const weft::Restricted_delaunay_3<Oracle>& mesh, double seconds)
{
  namespace with = CGAL::parameters;
  auto complex = weft::to_c3t3(mesh);
  CGAL::exude_mesh_3(complex, with::time_limit = seconds);
  return complex;
}

/// The smallest dihedral angle of a complex, in degrees.
template <class Complex>
double smallest_dihedral(const Complex& complex)
{
  double worst = -1;
  for (auto c = complex.cells_in_complex_begin(); c != complex.cells_in_complex_end(); ++c) {
    const auto point = [&](int i) { return c->vertex(i)->point().point(); };
    worst = std::max(worst, weft::internal::cosine_of_smallest_dihedral(point(0), point(1), point(2), point(3)));
  }
  return std::acos(std::min(1., worst)) * 180 / std::acos(-1.);
}

/// Triangulates points from scratch, so many times.
inline void delaunay_with_cgal(const std::vector<Spatial_kernel::Point_3>& points, int times)
{
  for (int i = 0; i < times; ++i)
    CGAL::Delaunay_triangulation_3<Spatial_kernel> triangulation(points.begin(), points.end());
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_PEERS_H
