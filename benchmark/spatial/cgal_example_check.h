// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `run_cgal_examples` adds to CGAL's example programs: after weft's mesh is there, CGAL's own functions mesh the
// same domain to the same criteria, both are measured, and a line of a table is printed.

#ifndef WEFT_BENCHMARK_SPATIAL_CGAL_EXAMPLE_CHECK_H
#define WEFT_BENCHMARK_SPATIAL_CGAL_EXAMPLE_CHECK_H

#include "../common/user_time.h"

#include <weft/make_c3t3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>

#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace cgal_example {

struct Figures
{
  std::size_t vertices = 0, cells = 0, bad_facets = 0, bad_cells = 0;
  double smallest = 180, seconds = 0;
};

template <class C3t3, class Criteria>
Figures measure(const C3t3& c3t3, const Criteria& criteria)
{
  Figures figures;
  const auto& tr = c3t3.triangulation();
  figures.vertices = tr.number_of_vertices();
  const auto facet_criteria = criteria.facet_criteria_object();
  const auto cell_criteria = criteria.cell_criteria_object();
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) {
    int on_features = 0; // between features angles are the input's
    for (int i = 1; i < 4; ++i) on_features += c3t3.in_dimension(f->first->vertex((f->second + i) & 3)) < 2;
    figures.bad_facets += on_features < 3 && facet_criteria(tr, *f);
  }
  double worst = -1;
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c) {
    ++figures.cells;
    int on_features = 0;
    for (int i = 0; i < 4; ++i) on_features += c3t3.in_dimension(c->vertex(i)) < 2;
    figures.bad_cells += on_features < 3 && cell_criteria(tr, c);
    const auto p = [&](int i) { return c->vertex(i)->point().point(); };
    worst = (std::max)(worst, weft::internal::cosine_of_smallest_dihedral(p(0), p(1), p(2), p(3)));
  }
  figures.smallest = std::acos((std::min)(1., worst)) * 180 / 3.14159265358979323846;
  return figures;
}

inline void print(const char* what, const Figures& f)
{
  std::printf(" %s | %zu | %zu | %zu + %zu | %.1f | %.2f |", what, f.vertices, f.cells, f.bad_facets, f.bad_cells,
              f.smallest, f.seconds);
}

/// Meshes with weft, and with CGAL's refinement, perturbation and exudation; returns weft's mesh. Ends the program
/// where that has elements that violate the criteria.
template <class C3t3, class Domain, class Criteria>
C3t3 make_mesh_3(const Domain& domain, const Criteria& criteria, const char* name)
{
  std::printf("| %s |", name);
  double begin = benchmark::user_seconds();
  weft::Mesh_report_3 report;
  weft::Mesh_options_3 options = weft::mesh_options_for_c3t3();
  options.time_limit = 120;
  if (const char* angle = std::getenv("WEFT_EXAMPLES_ANGLE")) options.min_dihedral_angle = std::atof(angle);
  const C3t3 mine = weft::make_mesh_3<C3t3>(domain, criteria, options, &report);
  Figures figures = measure(mine, criteria);
  figures.seconds = benchmark::user_seconds() - begin;
  print("weft", figures);
  std::fflush(stdout);
  begin = benchmark::user_seconds();
  const C3t3 peer = CGAL::make_mesh_3<C3t3>(domain, criteria); // perturbs and exudes
  Figures peers = measure(peer, criteria);
  peers.seconds = benchmark::user_seconds() - begin;
  print("CGAL", peers);
  std::printf(" %+.1f | %s |\n", figures.smallest - peers.smallest, report.ok() ? "all" : "not all");
  if (!report.ok()) std::cerr << name << ": " << report << "\n";
  std::fflush(stdout);
  if (figures.bad_facets + figures.bad_cells > 0 || figures.cells == 0) {
    std::cerr << name << ": weft's mesh doesn't satisfy CGAL's criteria\n";
    std::exit(EXIT_FAILURE);
  }
  return mine;
}

} // namespace cgal_example

#endif // WEFT_BENCHMARK_SPATIAL_CGAL_EXAMPLE_CHECK_H
