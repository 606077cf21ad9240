// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of a tetrahedral mesh whose boundary slides on itself: the boundary triangles are the domain, the
// vertices of the mesh those that meshing begins with (Tournois 2009, sec. 3.2, from the second step on).

#ifndef WEFT_SPATIAL_RUN_IMPROVE_SLIDING_3_H
#define WEFT_SPATIAL_RUN_IMPROVE_SLIDING_3_H

#include <weft/internal/counted.h>
#include <weft/options.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/local/improve_fixed_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/subdomain_boundaries_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/run/Boundary_sizing_3.h>
#include <weft/spatial/run/Initial_vertices_3.h>
#include <weft/spatial/run/Mesh_boundary_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>
#include <weft/spatial/run/Vertices_on_domain_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace weft::internal {

/// What meshing is held to: loose sizes, an approximation that follows the boundary's own edges, and shapes as long as
/// only a few elements are worse, for nothing that comes later mends what those leave. Smoothing mends most of them, so
/// that `mesh_from_vertices()` asks for more afterwards.
template <class K>
Criteria_3<K> criteria_of_mesh(const Tetrahedral_mesh_3<K>& mesh, const Boundary_sizing_3<K>& sizing,
                               const Improve_options_3& options)
{
  double longest = 0;
  for (const auto& c : mesh.cells)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        longest = (std::max)(longest, CGAL::to_double(CGAL::squared_distance(mesh.points[c[i]], mesh.points[c[j]])));
  const auto deviation = [sizing, part = options.deviation](const typename K::Point_3& p) { return part * sizing(p); };
  Criteria_3<K> criteria;
  criteria.size = 1.5 * std::sqrt(longest); // no element of the input is too large, nor becomes so by sliding
  criteria.approximation = deviation;
  criteria.deviation = deviation;
  criteria.facet_shape = 4;
  criteria.cell_shape = 6;
  criteria.topology = true;
  return criteria;
}

/// Options of the mesher.
inline Mesh_options_3 mesher_options(const Improve_options_3& options, double size_floor)
{
  Mesh_options_3 result;
  result.coarsen = options.coarsen;
  result.smoothing_sweeps = options.smoothing_sweeps;
  result.min_dihedral_angle = options.delaunay ? options.min_dihedral_angle : 0;
  result.size_floor = size_floor;
  result.lattice = false;
  result.max_vertices = options.max_vertices;
  // The rest of the time is for local changes: smoothing alone leaves more slivers than there were.
  result.time_limit = (options.delaunay ? 1 : 0.9) * options.time_limit;
  result.seed = options.seed;
  result.threads = options.threads;
  result.visitor = options.visitor;
  return result;
}

/// Takes what the mesher reports over.
inline void take_report(const Mesh_report_3& from, Improve_report_3& to)
{
  to.manifold = from.manifold;
  to.unrepresented = from.bad();
  to.moves = from.smoothing_moves + from.perturbed;
  to.insertions = from.perturb_insertions;
  to.removals = from.coarsened;
  to.stop_reason = from.stop_reason;
  to.stage_seconds.insert(to.stage_seconds.end(), from.stage_seconds.begin(), from.stage_seconds.end());
}

/// Sharp whatever their angle: edges listed, and those between patches.
template <class K>
Feature_options features_of_mesh(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& improve_options)
{
  Feature_options options(improve_options.sharp_angle);
  if (!improve_options.tagged_features) return options;
  options.sharp_edges = mesh.edges;
  options.tips_and_cusps = mesh.corners;
  std::vector<std::pair<std::array<std::size_t, 2>, int>> sides;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      sides.emplace_back(sorted<2>({mesh.facets[f][i], mesh.facets[f][(i + 1) % 3]}), mesh.patches[f]);
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i - 1].first == sides[i].first && sides[i - 1].second != sides[i].second)
      options.sharp_edges.push_back(sides[i].first);
  return options;
}

/// Local changes inside, after the boundary has slid to where it is good.
template <class K>
Tetrahedral_mesh_3<K> finish_locally(const Tetrahedral_mesh_3<K>& mesh, const Tetrahedral_mesh_3<K>& input,
                                     const Improve_options_3& options, Improve_report_3& report)
{
  Improve_options_3 rest = options;
  std::set<typename K::Point_3> fixed; // vertices are numbered anew
  for (const std::size_t v : options.fixed_vertices) fixed.insert(input.points[v]);
  rest.fixed_vertices.clear();
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (fixed.count(mesh.points[v]) > 0) rest.fixed_vertices.push_back(v);
  for (const auto& stage : report.stage_seconds) rest.time_limit = (std::max)(0.0, rest.time_limit - stage.second);
  Improve_report_3 local;
  auto result = improve_fixed_3(mesh, rest, local);
  report.moves += local.moves;
  report.insertions += local.insertions;
  report.removals += local.removals;
  report.flips += local.flips;
  report.stop_reason = local.stop_reason;
  report.stage_seconds.insert(report.stage_seconds.end(), local.stage_seconds.begin(), local.stage_seconds.end());
  return result;
}

/// Meshes a domain beginning with vertices that there are.
template <class Oracle, class K>
Tetrahedral_mesh_3<K> mesh_from_vertices(const Oracle& oracle, Initial_vertices_3<K> initial,
                                         const Tetrahedral_mesh_3<K>& mesh, const Boundary_sizing_3<K>& sizing,
                                         const Improve_options_3& options, Improve_report_3& report)
{
  initial.facet_shape_in_the_end = 1.7;
  initial.cell_shape_in_the_end = 2.5;
  initial.smoothing_share = options.delaunay ? 1 : 0.4; // sweeps take long: it ends later than that
  const Criteria_3<K> criteria = criteria_of_mesh(mesh, sizing, options);
  Mesh_options_3 meshing = mesher_options(options, 0.1 * sizing.shortest_edge());
  for (const auto& stage : report.stage_seconds) meshing.time_limit -= stage.second;
  meshing.time_limit = (std::max)(0.0, meshing.time_limit);
  Spatial_mesher_3<Oracle> mesher(oracle, criteria, meshing, initial);
  take_report(mesher.run(), report);
  return tetrahedral_mesh(mesher.mesh());
}

/// Meshes the domain that a mesh bounds. At folds too sharp for a Delaunay mesh with about its own vertices, the
/// boundary doesn't come out manifold, or not connected as it was. Creases that were found there by their angle are
/// what makes it so difficult: without them both sides may round the fold off, as far as `deviation` lets them.
/// \returns an empty mesh if nothing helps.
template <class K>
Tetrahedral_mesh_3<K> mesh_own_domain(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options,
                                      Improve_report_3& report)
{
  const Feature_options tagged = features_of_mesh(mesh, options);
  Feature_options features = tagged;
  constexpr int attempts = 4;
  std::size_t crease_edges_at_first = 0, crease_edges = std::size_t(-1);
  for (int attempt = 1; attempt <= attempts; ++attempt) {
    const Mesh_boundary_3<K> boundary(mesh, features);
    if (attempt == 1) crease_edges_at_first = boundary.number_of_crease_edges();
    if (boundary.number_of_crease_edges() >= crease_edges) break;
    crease_edges = boundary.number_of_crease_edges();
    if (attempt == 1) report.notes = boundary.complex().changes;
    const Boundary_sizing_3<K> sizing(boundary.complex().points, boundary.complex().triangles);
    const Polyhedral_oracle_3<K> oracle(boundary.complex());
    Initial_vertices_3<K> initial{mesh.points, boundary.locations(), options.fixed_vertices, true};
    initial.spacings = mean_edges_of_vertices(mesh);
    auto result = mesh_from_vertices(oracle, initial, mesh, sizing, options, report);
    boundary.restore_names(sizing, result);
    const bool is_alike = report.manifold && topology_of_subdomains(result) == topology_of_subdomains(mesh);
    if (is_alike && attempt > 1)
      report.notes.push_back(counted(crease_edges_at_first - crease_edges, "sharp edge", "sharp edges") +
                             " found by angle may be rounded off: the folds there are too sharp");
    if (is_alike || report.stop_reason != Stop_reason::exhausted) return result;
    std::vector<typename K::Point_3> faults;
    if (attempt + 1 < attempts && !report.manifold)
      for (const Fault_3& fault : check_manifold_3(result).faults)
        for (const std::size_t v : fault.vertices) faults.push_back(result.points[v]);
    features = boundary.features_apart_from(faults, tagged, sizing);
  }
  return {};
}

/// Improves a mesh whose boundary slides on itself. Where the boundary can't be had as one of a Delaunay mesh with
/// about its own vertices, it stays fixed. The report's notes say so.
template <class K>
Tetrahedral_mesh_3<K> improve_sliding_3(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options,
                                        Improve_report_3& report)
{
  auto result = mesh_own_domain(mesh, options, report);
  if (report.stop_reason == Stop_reason::cancelled) return result;
  if (result.cells.empty() || !report.manifold || topology_of_subdomains(result) != topology_of_subdomains(mesh)) {
    report.moves = report.insertions = report.removals = report.unrepresented = 0;
    report.notes.emplace_back("the boundary can't be that of a Delaunay mesh with these vertices: it stays fixed");
    result = mesh;
  } else if (options.delaunay) {
    return result;
  }
  return finish_locally(result, mesh, options, report);
}

/// Improves a mesh of a given domain, on whose surface the boundary slides. Vertices of the boundary go to the nearest
/// point of the surface, those as good as on a crease or feature vertex to that.
/// \param oracle a domain oracle, see Polyhedral_oracle_3.h; patches, creases and corners of the result are its own.
template <class K, class Oracle>
Tetrahedral_mesh_3<K> improve_on_domain_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle,
                                          const Improve_options_3& options, Improve_report_3& report)
{
  const Boundary_sizing_3<K> sizing(mesh.points, mesh.facets);
  const Vertices_on_domain_3<K, Oracle> vertices(mesh, oracle, sizing, options);
  auto result = mesh_from_vertices(oracle, vertices.initial(), mesh, sizing, options, report);
  if (options.delaunay || report.stop_reason == Stop_reason::cancelled || result.cells.empty()) return result;
  return finish_locally(result, mesh, options, report);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_IMPROVE_SLIDING_3_H
