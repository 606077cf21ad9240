// SPDX-License-Identifier: GPL-3.0-or-later
//
// What adaptation begins with: the vertices of a mesh of the same domain, without those that are too many.

#ifndef WEFT_SPATIAL_RUN_ADAPT_VERTICES_3_H
#define WEFT_SPATIAL_RUN_ADAPT_VERTICES_3_H

#include <weft/errors.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/run/Initial_vertices_3.h>
#include <weft/spatial/run/Vertex_thinner_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// Whether the vertices of a mesh can lie where they say on the parts of a domain.
template <class K, class Oracle>
bool is_mesh_of(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle)
{
  if (mesh.locations.size() != mesh.points.size()) return false;
  std::vector<char> has_corner(oracle.number_of_corners(), false);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vertex_location_3& at = mesh.locations[v];
    const std::size_t parts = at.dimension == 0   ? oracle.number_of_corners()
                              : at.dimension == 1 ? oracle.number_of_creases()
                              : at.dimension == 2 ? static_cast<std::size_t>(oracle.number_of_patches())
                                                  : ~std::size_t(0);
    if (at.dimension < 0 || at.dimension > 3 || at.index < 0 || static_cast<std::size_t>(at.index) >= parts)
      return false;
    if (at.dimension != 0) continue;
    if (mesh.points[v] != oracle.corner(static_cast<std::size_t>(at.index))) return false;
    has_corner[static_cast<std::size_t>(at.index)] = true;
  }
  for (const char there : has_corner)
    if (!there) return false;
  return true;
}

/// Gives the facets and crease edges of a mesh the numbers of the parts that their vertices lie on, as far as thinning
/// asks for them: which facets lie on one patch, and which edges lie on a crease. Of facets with vertices on creases
/// alone it isn't known: they get numbers of their own, so that nothing beside them counts as a bend of a patch.
template <class K>
void number_by_location(int number_of_patches, Tetrahedral_mesh_3<K>& mesh)
{
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    mesh.patches[f] = number_of_patches + static_cast<int>(f);
    for (const std::size_t v : mesh.facets[f])
      if (mesh.locations[v].dimension == 2) mesh.patches[f] = mesh.locations[v].index;
  }
  mesh.edges.clear();
  mesh.creases.clear();
  for (const auto& facet : mesh.facets)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = facet[i], b = facet[(i + 1) % 3];
      const Vertex_location_3 &p = mesh.locations[a], &q = mesh.locations[b];
      if (a > b || p.dimension > 1 || q.dimension > 1 || (p.dimension == 1 && q.dimension == 1 && p != q)) continue;
      mesh.edges.push_back({a, b});
      mesh.creases.push_back(p.dimension == 1 ? p.index : q.index);
    }
}

/// \throws Domain_error for a mesh of another domain.
template <class K, class Oracle>
Initial_vertices_3<K> adapted_vertices_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle,
                                         const Criteria_3<K>& criteria)
{
  if (!is_mesh_of(mesh, oracle)) throw Domain_error("the mesh isn't one of this domain", {}, {});
  const std::vector<char> fixed(mesh.points.size(), false);
  Vertex_thinner_3<K> thinner(mesh, criteria, fixed);
  const std::vector<char> stays = thinner.run();
  std::vector<char> changed(mesh.points.size(), false);
  thinner.mark_around(stays, changed);
  Initial_vertices_3<K> initial;
  initial.is_adaptation = true;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!stays[v]) continue;
    initial.points.push_back(mesh.points[v]);
    initial.locations.push_back(mesh.locations[v]);
    initial.changed.push_back(changed[v]);
  }
  return initial;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_ADAPT_VERTICES_3_H
