// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles that bound a CGAL mesh domain, where it is one of triangles and says so: Polyhedral_mesh_domain_3, with
// or without features, Polyhedral_complex_mesh_domain_3, and what is derived from them.

#ifndef WEFT_SPATIAL_CGAL_DOMAIN_TRIANGLES_3_H
#define WEFT_SPATIAL_CGAL_DOMAIN_TRIANGLES_3_H

#include <weft/internal/boxes/farthest_points_3.h>
#include <weft/internal/boxes/perturbed_crossing_3.h>
#include <weft/internal/Disjoint_parts.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// Whether a domain has a tree of the faces of its bounding surfaces and tells the patches of those.
template <class Domain, class = void>
struct Has_triangles_3 : std::false_type
{};
template <class Domain>
struct Has_triangles_3<Domain,
                       std::void_t<decltype(std::declval<const Domain&>().bounding_aabb_tree_ptr()->bbox()),
                                   decltype(std::declval<const Domain&>().aabb_tree().size()),
                                   decltype(halfedge(std::declval<typename Domain::AABB_primitive_id>().first,
                                                     *std::declval<typename Domain::AABB_primitive_id>().second)),
                                   decltype(std::declval<const Domain&>().make_surface_index(
                                       std::declval<typename Domain::AABB_primitive_id>()))>> : std::true_type
{};

/// Whether it says which subdomains lie on the two sides of a patch.
template <class Domain, class = void>
struct Has_sides_3 : std::false_type
{};
template <class Domain>
struct Has_sides_3<Domain, std::void_t<decltype(std::declval<const Domain&>().incident_subdomains_indices(
                               std::declval<typename Domain::Surface_patch_index>()))>> : std::true_type
{};

/// The triangles of a domain's bounding surfaces; none if it bounds no volume. Linear, but for a factor log n.
/// \param patch_number,label give the numbers of a patch and of a subdomain. A subdomain 0 is the outside; where the
///        domain doesn't say what lies beside its patches, there is but one subdomain, whose label is 1.
template <class Domain, class Patch_number, class Label>
std::vector<Surface_triangle_3<typename Domain::R>>
domain_triangles_3(const Domain& domain, const Patch_number& patch_number, const Label& label)
{
  using K = typename Domain::R;
  using Point = typename K::Point_3;
  std::vector<Surface_triangle_3<K>> triangles;
  const auto* tree = domain.bounding_aabb_tree_ptr();
  if (tree == nullptr || tree->empty()) return triangles;
  const CGAL::Bbox_3 b = tree->bbox();
  std::vector<typename Domain::AABB_primitive_id> primitives;
  tree->all_intersected_primitives(
      typename K::Iso_cuboid_3(Point(b.xmin(), b.ymin(), b.zmin()), Point(b.xmax(), b.ymax(), b.zmax())),
      std::back_inserter(primitives)); // all of them, in the order of the tree
  std::map<Point, std::uint32_t> number_of_vertex;
  for (const auto& id : primitives) {
    Surface_triangle_3<K> t;
    const auto& graph = *id.second;
    auto side = halfedge(id.first, graph);
    for (std::size_t i = 0; i < 3; ++i, side = next(side, graph)) {
      t.points[i] = get(CGAL::vertex_point, graph, target(side, graph));
      t.vertices[i] =
          number_of_vertex.try_emplace(t.points[i], static_cast<std::uint32_t>(number_of_vertex.size())).first->second;
    }
    t.index = static_cast<std::uint32_t>(triangles.size());
    const auto patch = domain.make_surface_index(id);
    t.patch = patch_number(patch);
    if constexpr (Has_sides_3<Domain>::value) {
      const auto [behind, before] = domain.incident_subdomains_indices(patch);
      t.change = (behind == 0 ? 0 : label(behind)) ^ (before == 0 ? 0 : label(before));
    }
    if (t.change != 0) triangles.push_back(t); // else it bounds nothing
  }
  return triangles;
}

/// By patch and connected part, points within it: as many as there are triangles, and at least 64.
template <class K>
std::vector<std::vector<std::vector<typename K::Point_3>>>
triangle_seeds_3(const std::vector<Surface_triangle_3<K>>& triangles, std::size_t number_of_patches)
{
  constexpr std::size_t least = 64;
  std::map<std::pair<int, std::uint32_t>, std::size_t> first_at; // by patch and vertex
  Disjoint_parts parts(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t].vertices)
      parts.unite(first_at.try_emplace({triangles[t].patch, v}, t).first->second, t);
  std::map<std::size_t, std::size_t> size_of_part, number_of_part;
  for (std::size_t t = 0; t < triangles.size(); ++t) ++size_of_part[parts.find(t)];
  std::vector<std::vector<std::vector<typename K::Point_3>>> seeds(number_of_patches);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto& of_patch = seeds[static_cast<std::size_t>(triangles[t].patch)];
    const auto [part, is_new] = number_of_part.try_emplace(parts.find(t), of_patch.size());
    if (is_new) of_patch.emplace_back();
    int cuts = 0; // lines parallel to each side
    const std::size_t n = size_of_part[part->first];
    while (n * static_cast<std::size_t>((cuts + 1) * (cuts + 1)) < least) ++cuts;
    const auto& p = triangles[t].points;
    for_each_centroid(p[0], p[1], p[2], cuts, [&, into = part->second](const auto& x) { of_patch[into].push_back(x); });
  }
  return seeds;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CGAL_DOMAIN_TRIANGLES_3_H
