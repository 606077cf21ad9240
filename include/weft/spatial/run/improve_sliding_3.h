// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of a tetrahedral mesh whose boundary slides on itself: the boundary triangles are the domain, the
// vertices of the mesh those that meshing begins with (Tournois 2009, sec. 3.2, from the second step on).

#ifndef WEFT_SPATIAL_RUN_IMPROVE_SLIDING_3_H
#define WEFT_SPATIAL_RUN_IMPROVE_SLIDING_3_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/options.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/local/improve_fixed_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/run/Boundary_sizing_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>
#include <weft/spatial/surface/interface_complex_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
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

/// The domain that a mesh bounds, and its vertices in the numbers of that domain.
template <class K>
class Mesh_boundary_3
{
public:
  using Point = typename K::Point_3;

  /// \param features in the numbers of the mesh.
  /// \throws Domain_error if the boundary of a subdomain isn't a closed surface without self-intersections.
  Mesh_boundary_3(const Tetrahedral_mesh_3<K>& mesh, const Feature_options& features) : mesh_(mesh)
  {
    if (has_one_subdomain())
      complex_ = piecewise_smooth_complex(mesh.points, mesh.facets, features);
    else
      complex_ = complex_of_interfaces(features);
    place_vertices();
    name_parts();
  }

  const Piecewise_smooth_complex_3<K>& complex() const { return complex_; }

  /// Where the vertices of the mesh lie.
  const std::vector<Vertex_location_3>& locations() const { return locations_; }

  /// Gives patches, creases and subdomain the numbers that they have in the mesh.
  /// \param sizing knows the nearest of the complex' triangles.
  void restore_names(const Boundary_sizing_3<K>& sizing, Tetrahedral_mesh_3<K>& result) const
  {
    const auto patch_at = [&](const typename K::Point_3& p) { return names_of_triangles_[sizing.nearest_triangle(p)]; };
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
      const auto& v = result.facets[f];
      int& patch = result.patches[f];
      patch = names_are_unique_
                  ? patch_names_[static_cast<std::size_t>(patch)]
                  : patch_at(CGAL::centroid(result.points[v[0]], result.points[v[1]], result.points[v[2]]));
    }
    for (int& crease : result.creases) crease = crease_names_[static_cast<std::size_t>(crease)];
    const bool is_one = has_one_subdomain();
    if (is_one) result.subdomains.assign(result.cells.size(), mesh_.subdomains.front());
    for (std::size_t v = 0; v < result.points.size(); ++v) {
      auto& at = result.locations[v];
      if (at.dimension == 1) at.index = crease_names_[static_cast<std::size_t>(at.index)];
      if (at.dimension == 2)
        at.index = names_are_unique_ ? patch_names_[static_cast<std::size_t>(at.index)] : patch_at(result.points[v]);
      if (at.dimension == 3 && is_one) at.index = mesh_.subdomains.front();
    }
  }

  std::size_t number_of_crease_edges() const
  {
    std::size_t n = 0;
    for (const auto& crease : complex_.creases) n += crease.vertices.size() - (crease.closed ? 0 : 1);
    return n;
  }

  /// The features that are left without creases that come near to one of these points and aren't tagged; with no
  /// points, without any such crease.
  Feature_options features_apart_from(const std::vector<Point>& points, const Feature_options& tagged,
                                      const Boundary_sizing_3<K>& sizing) const
  {
    Feature_options result = tagged;
    result.sharp_angle = 0;
    if (points.empty()) return result;
    for (const auto& crease : complex_.creases) {
      if (comes_near(crease.vertices, points, sizing)) continue;
      const std::size_t n = crease.vertices.size();
      for (std::size_t i = crease.closed ? 0 : 1; i < n; ++i)
        result.sharp_edges.push_back(
            {original_[crease.vertices[i == 0 ? n - 1 : i - 1]], original_[crease.vertices[i]]});
    }
    return result;
  }

private:
  using Edge = std::array<std::size_t, 2>;

  /// Whether a vertex of a crease is as near to a point as edges there are long.
  bool comes_near(const std::vector<std::size_t>& crease, const std::vector<Point>& points,
                  const Boundary_sizing_3<K>& sizing) const
  {
    return std::any_of(points.begin(), points.end(), [&](const Point& p) {
      const double size = sizing(p);
      return std::any_of(crease.begin(), crease.end(),
                         [&](std::size_t v) { return CGAL::squared_distance(p, complex_.points[v]) <= size * size; });
    });
  }

  bool has_one_subdomain() const
  {
    return std::all_of(mesh_.subdomains.begin(), mesh_.subdomains.end(),
                       [this](int s) { return s == mesh_.subdomains.front(); });
  }

  /// The complex of several subdomains. Facets look away from the smaller number, outwards if there is but one.
  Piecewise_smooth_complex_3<K> complex_of_interfaces(const Feature_options& options) const
  {
    const Validity_3 validity = check_manifold_3(mesh_);
    if (!validity.ok()) throw Domain_error(validity.faults.front().text, validity.faults.front().vertices, {});
    std::map<std::array<std::size_t, 3>, std::vector<Boundary_facet_3>> cells_at;
    for (const Boundary_facet_3& side : subdomain_boundaries(mesh_)) cells_at[sorted(side.vertices)].push_back(side);
    Triangle_surface_3<K> surface;
    std::vector<std::pair<int, int>> sides;
    surface.points = mesh_.points;
    for (const auto& facet : mesh_.facets) { // in this order: messages count them
      const auto& found = cells_at.at(sorted(facet));
      const bool last_is_behind = found.back().subdomain < found.front().subdomain;
      const Boundary_facet_3& behind = last_is_behind ? found.back() : found.front();
      const Boundary_facet_3& before = last_is_behind ? found.front() : found.back();
      surface.triangles.push_back(behind.vertices);
      sides.emplace_back(behind.subdomain, found.size() == 1 ? 0 : before.subdomain);
    }
    check_degenerate_facets(surface);
    check_interfaces_apart(surface);
    return interface_complex_3(std::move(surface), sides, options);
  }

  void place_vertices()
  {
    std::vector<Vertex_location_3> of_complex(complex_.points.size(), {4, 0});
    for (std::size_t t = complex_.triangles.size(); t-- > 0;)
      for (const std::size_t v : complex_.triangles[t]) of_complex[v] = {2, complex_.patches[t]};
    for (std::size_t c = 0; c < complex_.creases.size(); ++c)
      for (const std::size_t v : complex_.creases[c].vertices) of_complex[v] = {1, static_cast<int>(c)};
    for (std::size_t i = 0; i < complex_.features.size(); ++i)
      of_complex[complex_.features[i].vertex] = {0, static_cast<int>(i)};
    std::vector<char> is_on_boundary(mesh_.points.size(), false);
    for (const auto& facet : mesh_.facets)
      for (const std::size_t v : facet) is_on_boundary[v] = true;
    std::vector<int> subdomain(mesh_.points.size(), 1);
    for (std::size_t c = 0; c < mesh_.cells.size() && !complex_.sides.empty(); ++c)
      for (const std::size_t v : mesh_.cells[c]) subdomain[v] = mesh_.subdomains[c];
    for (std::size_t v = 0, next = 0; v < mesh_.points.size(); ++v) { // the complex keeps the order
      locations_.push_back(is_on_boundary[v] ? of_complex[next] : Vertex_location_3{3, subdomain[v]});
      if (is_on_boundary[v]) original_.push_back(v), ++next;
    }
  }

  /// What the parts of the complex are called in the mesh. Creases found by angle come after the listed ones.
  void name_parts()
  {
    std::map<std::array<std::size_t, 3>, int> patch_of;
    for (std::size_t f = 0; f < mesh_.facets.size(); ++f) patch_of[sorted(mesh_.facets[f])] = mesh_.patches[f];
    patch_names_.assign(static_cast<std::size_t>(complex_.number_of_patches), unnamed_patch);
    for (std::size_t t = 0; t < complex_.triangles.size(); ++t) {
      auto triangle = complex_.triangles[t];
      for (std::size_t& v : triangle) v = original_[v];
      int& name = patch_names_[static_cast<std::size_t>(complex_.patches[t])];
      names_of_triangles_.push_back(patch_of.at(sorted(triangle)));
      names_are_unique_ = names_are_unique_ && (name == unnamed_patch || name == names_of_triangles_.back());
      name = names_of_triangles_.back();
    }
    std::map<Edge, int> crease_of;
    int unnamed = 0;
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      crease_of[sorted(mesh_.edges[e])] = mesh_.creases[e];
      unnamed = (std::max)(unnamed, mesh_.creases[e] + 1);
    }
    for (const auto& crease : complex_.creases) {
      const auto found = crease_of.find(sorted<2>({original_[crease.vertices[0]], original_[crease.vertices[1]]}));
      crease_names_.push_back(found == crease_of.end() ? unnamed++ : found->second);
    }
  }

  const Tetrahedral_mesh_3<K>& mesh_;
  Piecewise_smooth_complex_3<K> complex_;
  std::vector<Vertex_location_3> locations_;
  std::vector<std::size_t> original_; ///< by point of the complex, its number in the mesh
  static constexpr int unnamed_patch = -1;
  std::vector<int> patch_names_, crease_names_, names_of_triangles_;
  bool names_are_unique_ = true; ///< whether every patch of the complex has one name
};

/// The vertices of a mesh on the parts of a domain.
template <class K, class Oracle>
class Vertices_on_domain_3
{
public:
  using Point = typename K::Point_3;

  Vertices_on_domain_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, const Boundary_sizing_3<K>& sizing,
                       const Improve_options_3& options)
      : oracle_(oracle)
  {
    std::vector<char> is_on_boundary(mesh.points.size(), false), is_fixed(mesh.points.size(), false);
    for (const auto& facet : mesh.facets)
      for (const std::size_t v : facet) is_on_boundary[v] = true;
    for (const std::size_t v : options.fixed_vertices) is_fixed[v] = true;
    for (std::size_t i = 0; i < oracle.number_of_corners(); ++i) add(oracle.corner(i), {0, static_cast<int>(i)});
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Point& p = mesh.points[v];
      if (is_fixed[v] && taken_.count(p) == 0) initial_.fixed.push_back(initial_.points.size());
      if (is_on_boundary[v]) {
        add_on_surface(p, near * sizing(p), is_fixed[v]);
        continue;
      }
      const int subdomain = oracle.subdomain(p);
      if (is_fixed[v] || subdomain != 0) add(p, {3, (std::max)(subdomain, 1)});
    }
  }

  const Initial_vertices_3<K>& initial() const { return initial_; }

private:
  static constexpr double near = 1e-3; ///< in parts of the length of edges nearby: on a crease or feature vertex

  void add(const Point& p, const Vertex_location_3& at)
  {
    if (!taken_.insert(p).second) return;
    initial_.points.push_back(p);
    initial_.locations.push_back(at);
  }

  void add_on_surface(const Point& p, double tolerance, bool stays)
  {
    const auto is_near = [&](const Point& q) { return CGAL::squared_distance(p, q) <= tolerance * tolerance; };
    for (std::size_t i = 0; i < oracle_.number_of_corners(); ++i)
      if (is_near(oracle_.corner(i))) return;
    for (std::size_t c = 0; c < oracle_.number_of_creases(); ++c) {
      const Point q = oracle_.project_on_crease(p, static_cast<int>(c));
      if (is_near(q)) return add(stays ? p : q, {1, static_cast<int>(c)});
    }
    const auto hit = oracle_.closest(p);
    add(stays ? p : hit.point, {2, hit.patch});
  }

  const Oracle& oracle_;
  Initial_vertices_3<K> initial_;
  std::set<Point> taken_;
};

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

/// V - E + F and the number of connected components of a triangle surface.
inline std::array<long, 2> topology_of_facets(const std::vector<std::array<std::size_t, 3>>& facets)
{
  std::vector<std::array<std::size_t, 2>> edges, links;
  std::vector<std::size_t> vertices;
  for (const auto& f : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(sorted<2>({f[i], f[(i + 1) % 3]}));
      vertices.push_back(f[i]);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return {static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + static_cast<long>(facets.size()),
          static_cast<long>(number_of_components(edges))};
}

/// The same of the boundary of each subdomain.
template <class K>
std::map<int, std::array<long, 2>> topology_of_subdomains(const Tetrahedral_mesh_3<K>& mesh)
{
  std::map<int, std::vector<std::array<std::size_t, 3>>> boundaries;
  for (const Boundary_facet_3& facet : subdomain_boundaries(mesh))
    boundaries[facet.subdomain].push_back(facet.vertices);
  std::map<int, std::array<long, 2>> result;
  for (const auto& [subdomain, facets] : boundaries) result[subdomain] = topology_of_facets(facets);
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
    const Initial_vertices_3<K> initial{mesh.points, boundary.locations(), options.fixed_vertices, true};
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
