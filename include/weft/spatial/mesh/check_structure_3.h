// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the arrays of a tetrahedral mesh make a mesh: cells that meet facet to facet.

#ifndef WEFT_SPATIAL_MESH_CHECK_STRUCTURE_3_H
#define WEFT_SPATIAL_MESH_CHECK_STRUCTURE_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

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
  for_each_facet(mesh.cells, [&](auto first, auto last) {
    if (last - first > 2)
      validity.add(Fault_kind_3::structure, "a facet has " + std::to_string(last - first) + " cells",
                   listed(first->vertices));
    else if (last - first == 2 && same_sense(outward_vertices(mesh.cells[first->cell], first->opposite),
                                             outward_vertices(mesh.cells[(first + 1)->cell], (first + 1)->opposite)))
      validity.add(Fault_kind_3::structure, "two cells are on the same side of their facet", listed(first->vertices));
  });
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

} // namespace weft

#endif // WEFT_SPATIAL_MESH_CHECK_STRUCTURE_3_H
