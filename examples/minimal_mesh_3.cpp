// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least that a spatial mesh takes: a gear, meshed with edges of at most 3 mm. Prints the report and writes
// mesh.vtu.

#include <iostream>
#include <weft/IO/read_surface.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

int main()
{
  using K = CGAL::Exact_predicates_inexact_constructions_kernel;
  const weft::Polyhedral_oracle_3<K> domain(weft::IO::read_surface<K>("data/gear.off"), weft::Feature_options(60));
  weft::Criteria_3<K> criteria;
  criteria.size = 3;             // no edge longer than 3
  criteria.approximation = 0.05; // facets no farther than this from the surface
  const auto result = weft::make_mesh_3(domain, criteria);
  std::cout << result.report;
  weft::IO::write_mesh_3("mesh.vtu", weft::tetrahedral_mesh(result.restricted));
}
