// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a tetrahedral mesh is valid: cells that meet facet to facet, positively oriented and locally Delaunay; a
// boundary that is listed completely, looks outwards and is a closed 2-manifold; crease edges in chains; vertices that
// agree with the facets and edges around them. Everything is recomputed from the cells, exact predicates decide, and
// each check can be called alone. Whether the mesh meets criteria and lies on its domain is asked in
// check_criteria_3.h, how far it is from a surface in hausdorff_3.h.

#ifndef WEFT_SPATIAL_MESH_VALIDATE_3_H
#define WEFT_SPATIAL_MESH_VALIDATE_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

template <std::size_t N>
std::vector<std::size_t> listed(const std::array<std::size_t, N>& vertices)
{
  return {vertices.begin(), vertices.end()};
}

/// Checks indices and tags of one kind of element.
template <std::size_t N>
void check_elements(const std::vector<std::array<std::size_t, N>>& elements, const std::vector<int>& tags,
                    int least_tag, std::size_t points, const std::string& what, Validity_3& validity)
{
  if (tags.size() != elements.size()) {
    validity.add(Fault_kind_3::structure, "the tags of " + what + "s aren't as many as the " + what + "s");
    return;
  }
  std::vector<std::array<std::size_t, N>> all;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto vertices = sorted(elements[i]);
    if (vertices.back() >= points)
      validity.add(Fault_kind_3::structure, "a " + what + " has a vertex that doesn't exist", listed(elements[i]));
    if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end())
      validity.add(Fault_kind_3::structure, "a " + what + " has the same vertex twice", listed(elements[i]));
    if (tags[i] < least_tag)
      validity.add(Fault_kind_3::structure, "the tag of a " + what + " is " + std::to_string(tags[i]),
                   listed(elements[i]));
    all.push_back(vertices);
  }
  std::sort(all.begin(), all.end());
  for (auto twin = std::adjacent_find(all.begin(), all.end()); twin != all.end();
       twin = std::adjacent_find(twin + 1, all.end()))
    validity.add(Fault_kind_3::structure, "a " + what + " is there twice", listed(*twin));
}

template <class K>
void check_points(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  const std::size_t n = mesh.points.size();
  std::vector<Xyz_3> coordinates;
  for (std::size_t v = 0; v < n; ++v) {
    coordinates.push_back(xyz(mesh.points[v]));
    for (const double x : coordinates.back())
      if (!std::isfinite(x)) validity.add(Fault_kind_3::structure, "a coordinate isn't finite", {v});
    if (mesh.locations[v].dimension < 0 || mesh.locations[v].dimension > 3 || mesh.locations[v].index < 0)
      validity.add(Fault_kind_3::structure, "a vertex lies nowhere", {v});
  }
  if (!validity.ok()) return; // NaN can't be sorted
  std::vector<std::size_t> order(n);
  for (std::size_t v = 0; v < n; ++v) order[v] = v;
  std::sort(order.begin(), order.end(), [&](std::size_t v, std::size_t w) {
    return coordinates[v] != coordinates[w] ? coordinates[v] < coordinates[w] : v < w;
  });
  for (std::size_t i = 1; i < n; ++i)
    if (coordinates[order[i - 1]] == coordinates[order[i]])
      validity.add(Fault_kind_3::structure, "two vertices are at the same place", {order[i - 1], order[i]});
}

template <class K>
void check_isolated(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& cell : mesh.cells)
    for (const std::size_t v : cell) used[v] = 1;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) validity.add(Fault_kind_3::structure, "a vertex has no cell", {v});
}

/// At most two cells at a facet, on different sides: two positively oriented cells go around it in opposite senses.
template <class K>
void check_facets(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  for_each_facet(cell_facets(mesh.cells), [&](auto first, auto last) {
    if (last - first > 2)
      validity.add(Fault_kind_3::structure, "a facet has " + std::to_string(last - first) + " cells",
                   listed(first->vertices));
    else if (last - first == 2 && same_sense(outward_vertices(mesh.cells[first->cell], first->opposite),
                                             outward_vertices(mesh.cells[(first + 1)->cell], (first + 1)->opposite)))
      validity.add(Fault_kind_3::structure, "two cells are on the same side of their facet", listed(first->vertices));
  });
}

/// A facet as the boundary of one subdomain has it.
struct Boundary_facet_3
{
  int subdomain;
  std::array<std::size_t, 3> vertices; ///< counterclockwise seen from outside the subdomain
};

/// The boundaries of all subdomains; an interface is there twice.
template <class K>
std::vector<Boundary_facet_3> subdomain_boundaries(const Tetrahedral_mesh_3<K>& mesh)
{
  std::vector<Boundary_facet_3> boundary;
  for_each_facet(cell_facets(mesh.cells), [&](auto first, auto last) {
    if (last - first == 2 && mesh.subdomains[first->cell] == mesh.subdomains[(first + 1)->cell]) return;
    for (auto side = first; side != last; ++side)
      boundary.push_back({mesh.subdomains[side->cell], outward_vertices(mesh.cells[side->cell], side->opposite)});
  });
  return boundary;
}

inline void check_manifold_edges(const std::vector<Boundary_facet_3>& boundary, Validity_3& validity)
{
  std::vector<std::pair<int, std::array<std::size_t, 2>>> edges; // one entry for each facet beside the edge
  for (const auto& [subdomain, f] : boundary)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({subdomain, sorted<2>({f[i], f[(i + 1) % 3]})});
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    if (last - first != 2)
      validity.add(Fault_kind_3::manifold,
                   "an edge has " + std::to_string(last - first) + " facets of the boundary of subdomain " +
                       std::to_string(first->first),
                   listed(first->second));
    first = last;
  }
}

/// Number of connected components of a graph given by its edges.
inline std::size_t number_of_components(const std::vector<std::array<std::size_t, 2>>& edges)
{
  std::map<std::size_t, std::size_t> parent;
  const auto root = [&parent](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& edge : edges)
    for (const std::size_t v : edge) parent.emplace(v, v);
  std::size_t components = parent.size();
  for (const auto& [v, w] : edges) {
    const std::size_t a = root(v), b = root(w);
    components -= a != b;
    parent[a] = b;
  }
  return components;
}

/// The facets around a vertex must be connected through their edges: one umbrella.
inline void check_manifold_vertices(const std::vector<Boundary_facet_3>& boundary, Validity_3& validity)
{
  struct Link_edge
  {
    int subdomain;
    std::size_t vertex;
    std::array<std::size_t, 2> edge;
  };
  std::vector<Link_edge> links;
  for (const auto& [subdomain, f] : boundary)
    for (std::size_t i = 0; i < 3; ++i) links.push_back({subdomain, f[i], {f[(i + 1) % 3], f[(i + 2) % 3]}});
  const auto key = [](const Link_edge& l) { return std::pair(l.subdomain, l.vertex); };
  std::sort(links.begin(), links.end(), [&](const Link_edge& a, const Link_edge& b) {
    return key(a) != key(b) ? key(a) < key(b) : a.edge < b.edge;
  });
  for (auto first = links.begin(); first != links.end();) {
    std::vector<std::array<std::size_t, 2>> edges;
    auto last = first;
    for (; last != links.end() && key(*last) == key(*first); ++last) edges.push_back(last->edge);
    const std::size_t umbrellas = number_of_components(edges);
    if (umbrellas != 1)
      validity.add(Fault_kind_3::manifold,
                   "a vertex has " + std::to_string(umbrellas) + " umbrellas on the boundary of subdomain " +
                       std::to_string(first->subdomain),
                   {first->vertex});
    first = last;
  }
}

/// Feature vertices are those listed as corners, once each and in the order of the input's.
template <class K>
void check_corners(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::vector<char> is_listed(mesh.points.size(), 0);
  int last_index = -1;
  for (const std::size_t v : mesh.corners) {
    is_listed[v] = 1;
    if (mesh.locations[v].dimension != 0)
      validity.add(Fault_kind_3::location, "a corner isn't a feature vertex", {v});
    else if (mesh.locations[v].index <= last_index)
      validity.add(Fault_kind_3::location, "a corner is out of order or there twice", {v});
    else
      last_index = mesh.locations[v].index;
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.locations[v].dimension == 0 && !is_listed[v])
      validity.add(Fault_kind_3::location, "a feature vertex isn't listed as corner", {v});
}

/// A vertex on a crease has two edges, both of that crease; a crease edge ends on its crease or at feature vertices
/// and is an edge of a facet. So the edges of a crease form chains between feature vertices, or cycles.
template <class K>
void check_creases(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::set<std::array<std::size_t, 2>> boundary_edges;
  for (const auto& f : mesh.facets)
    for (int i = 0; i < 3 && !mesh.edges.empty(); ++i) boundary_edges.insert(sorted<2>({f[i], f[(i + 1) % 3]}));
  std::vector<int> edges_at(mesh.points.size(), 0);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (boundary_edges.count(sorted(mesh.edges[e])) == 0)
      validity.add(Fault_kind_3::location, "a crease edge isn't on the boundary", listed(mesh.edges[e]));
    for (const std::size_t v : mesh.edges[e]) {
      ++edges_at[v];
      const auto& location = mesh.locations[v];
      if (location.dimension > 1)
        validity.add(Fault_kind_3::location, "a crease edge ends at a vertex that isn't on a crease", {v});
      else if (location.dimension == 1 && location.index != mesh.creases[e])
        validity.add(Fault_kind_3::location, "a crease edge ends on another crease", listed(mesh.edges[e]));
    }
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.locations[v].dimension == 1 && edges_at[v] != 2)
      validity.add(Fault_kind_3::location, "a vertex on a crease has " + std::to_string(edges_at[v]) + " crease edges",
                   {v});
}

/// Vertices of features, creases and patches are on the boundary, those inside aren't and have cells of one subdomain.
template <class K>
void check_sides(const Tetrahedral_mesh_3<K>& mesh, Validity_3& validity)
{
  std::vector<char> on_boundary(mesh.points.size(), 0);
  for (const auto& facet : mesh.facets)
    for (const std::size_t v : facet) on_boundary[v] = 1;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const bool inside = mesh.locations[v].dimension == 3;
    if (inside && on_boundary[v]) validity.add(Fault_kind_3::location, "a vertex inside is on the boundary", {v});
    if (!inside && !on_boundary[v])
      validity.add(Fault_kind_3::location, "a vertex of the surface has no boundary facet", {v});
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const std::size_t v : mesh.cells[c])
      if (mesh.locations[v].dimension == 3 && mesh.locations[v].index != mesh.subdomains[c])
        validity.add(Fault_kind_3::location, "a vertex inside has a cell of another subdomain", {v});
}

} // namespace internal

/// Checks the arrays by themselves: sizes, indices, tags and coordinates; no element or vertex twice, no vertex without
/// a cell, and no facet with more than two cells or with two on one side. O(n log n) time. Everything else here relies
/// on it.
template <class K>
Validity_3 check_structure_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const std::size_t n = mesh.points.size();
  if (mesh.locations.size() != n) {
    validity.add(Fault_kind_3::structure, "the locations aren't as many as the points");
    return validity;
  }
  internal::check_elements(mesh.cells, mesh.subdomains, 1, n, "cell", validity);
  internal::check_elements(mesh.facets, mesh.patches, 0, n, "facet", validity);
  internal::check_elements(mesh.edges, mesh.creases, 0, n, "crease edge", validity);
  for (const std::size_t v : mesh.corners)
    if (v >= n) validity.add(Fault_kind_3::structure, "a corner is a vertex that doesn't exist", {v});
  internal::check_points(mesh, validity);
  if (!validity.ok()) return validity;
  internal::check_isolated(mesh, validity);
  internal::check_facets(mesh, validity);
  return validity;
}

/// Checks that all cells are positively oriented. Exact, linear time.
template <class K>
Validity_3 check_orientation_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const typename K::Orientation_3 orientation{};
  const auto& p = mesh.points;
  for (const auto& cell : mesh.cells) {
    const auto sign = orientation(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]);
    if (sign == CGAL::POSITIVE) continue;
    validity.add(Fault_kind_3::orientation, sign == CGAL::ZERO ? "a cell is flat" : "a cell is turned over",
                 internal::listed(cell));
  }
  return validity;
}

/// Checks for every facet between two cells that the sphere through one of them doesn't have the other's fourth vertex
/// strictly inside. Exact, O(n log n) time. Where the cells fill a convex set that makes them Delaunay; else a vertex
/// may also be hidden behind the boundary, which this doesn't see. Cells must be positively oriented.
template <class K>
Validity_3 check_delaunay_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const typename K::Side_of_oriented_sphere_3 side{};
  const auto& p = mesh.points;
  internal::for_each_facet(internal::cell_facets(mesh.cells), [&](auto first, auto last) {
    if (last - first != 2) return;
    const auto& cell = mesh.cells[first->cell];
    const std::size_t across = mesh.cells[(first + 1)->cell][(first + 1)->opposite];
    if (side(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]], p[across]) == CGAL::ON_POSITIVE_SIDE)
      validity.add(Fault_kind_3::delaunay, "a facet isn't locally Delaunay", internal::listed(first->vertices));
  });
  return validity;
}

/// Checks that the facets listed are exactly those with one cell or between different subdomains, and that those with
/// one cell are counterclockwise seen from outside; an interface may look either way. O(n log n) time.
template <class K>
Validity_3 check_boundary_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  std::map<std::array<std::size_t, 3>, std::size_t> wanting; // the facets not found yet
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) wanting.emplace(internal::sorted(mesh.facets[f]), f);
  internal::for_each_facet(internal::cell_facets(mesh.cells), [&](auto first, auto last) {
    const bool alone = last - first == 1;
    if (!alone && mesh.subdomains[first->cell] == mesh.subdomains[(first + 1)->cell]) return;
    const auto found = wanting.find(first->vertices);
    if (found == wanting.end()) {
      validity.add(Fault_kind_3::boundary, "a facet of the boundary isn't listed", internal::listed(first->vertices));
      return;
    }
    const auto& facet = mesh.facets[found->second];
    if (alone && !internal::same_sense(facet, internal::outward_vertices(mesh.cells[first->cell], first->opposite)))
      validity.add(Fault_kind_3::boundary, "a facet of the boundary looks inwards", internal::listed(facet));
    wanting.erase(found);
  });
  for (const auto& [vertices, f] : wanting)
    validity.add(Fault_kind_3::boundary, "a facet is listed that isn't one of the boundary",
                 internal::listed(vertices));
  return validity;
}

/// Checks that the boundary of every subdomain, as the cells give it, is a closed 2-manifold: two facets at every edge,
/// one umbrella of facets at every vertex. O(n log n) time.
template <class K>
Validity_3 check_manifold_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  const auto boundary = internal::subdomain_boundaries(mesh);
  internal::check_manifold_edges(boundary, validity);
  internal::check_manifold_vertices(boundary, validity);
  return validity;
}

/// Checks that vertices, crease edges and boundary facets agree: the corners are the feature vertices; crease edges
/// form chains between feature vertices or cycles, on the boundary; vertices of the surface are on the boundary, and
/// only they are. Boundary facets and crease edges may still join vertices of several patches or creases, see
/// `check_topology_3()` in check_criteria_3.h. O(n log n) time.
template <class K>
Validity_3 check_locations_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  internal::check_corners(mesh, validity);
  internal::check_creases(mesh, validity);
  internal::check_sides(mesh, validity);
  return validity;
}

/// Checks all of the above. What needs a sound structure or orientation is left out where that isn't found.
template <class K>
Validity_3 validate_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity = check_structure_3(mesh);
  if (!validity.ok()) return validity;
  validity += check_orientation_3(mesh);
  if (validity.ok()) validity += check_delaunay_3(mesh);
  validity += check_boundary_3(mesh);
  validity += check_manifold_3(mesh);
  validity += check_locations_3(mesh);
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_VALIDATE_3_H
