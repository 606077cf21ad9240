// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain that the boundary of a tetrahedral mesh encloses, and what its parts are called in the mesh.

#ifndef WEFT_SPATIAL_RUN_MESH_BOUNDARY_3_H
#define WEFT_SPATIAL_RUN_MESH_BOUNDARY_3_H

#include <weft/errors.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/subdomain_boundaries_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>
#include <weft/spatial/run/Boundary_sizing_3.h>
#include <weft/spatial/surface/interface_complex_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

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

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_MESH_BOUNDARY_3_H
