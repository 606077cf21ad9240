// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fills the report of a spatial mesher: every element is measured once more against the criteria as they were asked.

#ifndef WEFT_SPATIAL_RUN_FILL_REPORT_3_H
#define WEFT_SPATIAL_RUN_FILL_REPORT_3_H

#include <weft/report.h>
#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/domain/check_domain_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Counts a bad element with the given Delaunay ball.
template <class Kernel, class Oracle>
void count_bad(const Badness_3& badness, const Ball_3<Kernel>& ball, double size_floor, const Oracle& oracle,
               Unsatisfied_3& count)
{
  ++count.elements;
  count.size += (badness.reasons & bad_size) != 0;
  count.approximation += (badness.reasons & bad_approximation) != 0;
  count.shape += (badness.reasons & bad_shape) != 0;
  count.topology += (badness.reasons & bad_topology) != 0;
  count.disk += (badness.reasons & bad_disk) != 0;
  count.demand += (badness.reasons & bad_demand) != 0;
  count.at_floor += ball.squared_radius < size_floor * size_floor;
  count.at_acute_edge += oracle.is_at_acute_edge(ball.center, std::sqrt(ball.squared_radius));
}

template <class Restricted, class Kernel>
void count_bad_elements(const Restricted& mesh, const Criteria_3<Kernel>& criteria, double size_floor,
                        Mesh_report_3& report)
{
  const auto counter = [&](Unsatisfied_3& count) {
    return [&](const auto&, const Badness_3& badness, const Ball_3<Kernel>& ball) {
      count_bad(badness, ball, size_floor, mesh.oracle(), count);
    };
  };
  visit_bad_elements(mesh, criteria, counter(report.bad_edges), counter(report.bad_facets), counter(report.bad_cells),
                     [&](auto) { ++report.bad_vertices; });
}

/// Counts the elements whose shape the input forces. Linear.
/// \param is_perturbed whether slivers should be gone: then flat cells are bad, for no angle forces them.
template <class Restricted, class Kernel>
void count_forced_elements(const Restricted& mesh, const Criteria_3<Kernel>& criteria, bool is_perturbed,
                           Mesh_report_3& report)
{
  if (!mesh.oracle().has_mirror_images()) return;
  const Badness_measure_3<Restricted> measure(mesh, criteria, 1);
  for (const auto& f : mesh.facets())
    report.forced_facets += f.cell != typename Restricted::Cell_handle() && measure.has_forced_shape(f);
  for (const auto c : mesh.triangulation().finite_cell_handles()) {
    if (c->subdomain() == 0 || !measure.has_forced_shape(c)) continue;
    const bool is_bad = is_perturbed && is_flat(cosines_of_cell(c));
    report.forced_cells += !is_bad;
    report.bad_cells.elements += is_bad;
    report.bad_cells.shape += is_bad;
    report.bad_cells.at_acute_edge += is_bad;
  }
}

template <class Restricted>
std::size_t count_bare_patches(const Restricted& mesh)
{
  std::vector<char> is_bare(static_cast<std::size_t>(mesh.oracle().number_of_patches()));
  for (std::size_t p = 0; p < is_bare.size(); ++p) is_bare[p] = mesh.oracle().is_expected(static_cast<int>(p));
  for (const auto& f : mesh.facets())
    if (f.cell != typename Restricted::Cell_handle() && mesh.is_boundary(f))
      is_bare[static_cast<std::size_t>(f.patch)] = false;
  return static_cast<std::size_t>(std::count(is_bare.begin(), is_bare.end(), true));
}

/// The mesh beside its domain, by the approximation bounds that were asked for.
template <class Kernel, class Oracle>
Domain_comparison_3 compare_with_domain(const Tetrahedral_mesh_3<Kernel>& mesh, const Oracle& oracle,
                                        const Criteria_3<Kernel>& criteria)
{
  const auto& everywhere = criteria.approximation;
  if (everywhere.is_constant() && criteria.patches.empty()) return check_domain_3(mesh, oracle, everywhere.constant());
  return check_domain_3(mesh, oracle, [&](const typename Kernel::Point_3& p, int patch) {
    return least_bound(everywhere, criteria.own_approximation(patch), p);
  });
}

/// Criteria that are met are enough only if nothing is bad and the mesh is the domain.
inline void set_exhausted_if_bad(Mesh_report_3& report)
{
  if (report.stop_reason == Stop_reason::criteria_met && !report.ok()) report.stop_reason = Stop_reason::exhausted;
}

/// Counts, worst elements and criteria of a mesh into `report`. Linear.
/// \param is_perturbed see `count_forced_elements()`.
template <class Restricted, class Kernel>
void fill_report(const Restricted& restricted, const Criteria_3<Kernel>& criteria, double size_floor, bool is_perturbed,
                 Mesh_report_3& report)
{
  const auto mesh = tetrahedral_mesh(restricted);
  report.vertices = mesh.points.size();
  for (const auto& at : mesh.locations)
    ++(at.dimension == 0   ? report.corner_vertices
       : at.dimension == 1 ? report.crease_vertices
       : at.dimension == 2 ? report.patch_vertices
                           : report.interior_vertices);
  const Quality_3 quality = measure_quality_3(mesh, restricted.threads());
  report.smallest_dihedral = quality.smallest_dihedral.degrees;
  report.largest_dihedral = quality.largest_dihedral.degrees;
  report.largest_facet_shape = quality.largest_facet_ratio;
  report.largest_cell_shape = quality.largest_radius_edge_ratio;
  report.cells = mesh.cells.size();
  report.facets = mesh.facets.size();
  report.crease_edges = mesh.edges.size();
  count_bad_elements(restricted, criteria, size_floor, report);
  count_forced_elements(restricted, criteria, is_perturbed, report);
  report.bare_patches = count_bare_patches(restricted);
  // Where every vertex has its disk of facets, all of them between inside and outside, the boundary is a manifold.
  const bool clean = report.bad_vertices == 0 && report.bad_facets.disk == 0 && !mesh.cells.empty();
  report.manifold = clean || (!mesh.cells.empty() && check_manifold_3(mesh).ok());
  set_exhausted_if_bad(report);
  report.segment_queries = restricted.counts().segments;
  report.location_queries = restricted.counts().locations;
  report.skipped_queries = restricted.counts().skipped;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_FILL_REPORT_3_H
