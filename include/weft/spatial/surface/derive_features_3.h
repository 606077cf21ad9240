// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the sharp edges of a surface to creases, feature vertices and patches (Tournois 2009, sec. 3.2.1.1). Creases
// found by angle that end in the middle of a patch and are short are noise of the surface more often than a feature.

#ifndef WEFT_SPATIAL_SURFACE_DERIVE_FEATURES_3_H
#define WEFT_SPATIAL_SURFACE_DERIVE_FEATURES_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/crease_chains_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace weft::internal {

/// Edges by their two vertices, the smaller index first, ascending.
using Surface_edges_3 = std::vector<std::array<std::size_t, 2>>;

/// The edges that are sharp, and those of them that are so whatever their angle.
struct Sharp_edges_3
{
  Surface_edges_3 all, given;

  bool is_given(std::size_t a, std::size_t b) const { return contains(given, a, b); }
  static bool contains(const Surface_edges_3& edges, std::size_t a, std::size_t b)
  {
    return std::binary_search(edges.begin(), edges.end(),
                              std::array<std::size_t, 2>{{(std::min)(a, b), (std::max)(a, b)}});
  }
};

/// Calls `visit(a, b)` for the edges of a crease.
template <class Crease, class Visit>
void for_each_crease_edge(const Crease& crease, const Visit& visit)
{
  const auto& v = crease.vertices;
  for (std::size_t i = 1; i < v.size(); ++i) visit(v[i - 1], v[i]);
  if (crease.closed) visit(v.back(), v.front());
}

/// Number of the sharp edges of the crease in `edges`.
template <class Crease>
std::size_t count_crease_edges(const Crease& crease, const Surface_edges_3& edges)
{
  std::size_t n = 0;
  for_each_crease_edge(crease, [&](std::size_t a, std::size_t b) { n += Sharp_edges_3::contains(edges, a, b); });
  return n;
}

/// One round of `drop_short_open_creases()`; how many creases it took away. Where several open ones meet, only the
/// shortest goes: what is left may be a long one.
template <class K>
std::size_t drop_shortest_open_creases(const std::vector<typename K::Point_3>& points, double least,
                                       Sharp_edges_3& edges)
{
  const Sharp_graph_3 graph(points.size(), edges.all);
  const auto ends = feature_vertices<K>(graph, points, std::vector<bool>(points.size(), false), 180);
  const auto creases = chain_creases<K>(graph, ends);
  struct Open
  {
    std::size_t crease, fork; ///< where it meets others; the end of another crease if it doesn't
    double length;
  };
  std::vector<Open> open;
  std::map<std::size_t, double> shortest; // by fork
  for (std::size_t c = 0; c < creases.size(); ++c) {
    const std::size_t first = creases[c].vertices.front(), last = creases[c].vertices.back();
    if (creases[c].closed || (graph.degree(first) != 1 && graph.degree(last) != 1)) continue;
    if (count_crease_edges(creases[c], edges.given) > 0) continue;
    double length = 0;
    for_each_crease_edge(creases[c],
                         [&](std::size_t a, std::size_t b) { length += norm(minus(xyz(points[b]), xyz(points[a]))); });
    if (length >= least) continue;
    open.push_back({c, graph.degree(first) == 1 ? last : first, length});
    const auto [at, is_new] = shortest.try_emplace(open.back().fork, length);
    if (!is_new) at->second = (std::min)(at->second, length);
  }
  Surface_edges_3 dropped;
  for (const Open& o : open)
    if (o.length <= shortest[o.fork])
      for_each_crease_edge(creases[o.crease], [&](std::size_t a, std::size_t b) {
        dropped.push_back({(std::min)(a, b), (std::max)(a, b)});
      });
  std::sort(dropped.begin(), dropped.end());
  Surface_edges_3 left;
  std::set_difference(edges.all.begin(), edges.all.end(), dropped.begin(), dropped.end(), std::back_inserter(left));
  edges.all.swap(left);
  return dropped.size();
}

/// Takes creases away that aren't given, end without meeting another one, and are shorter than `least`; then those
/// that end so without these.
template <class K>
void drop_short_open_creases(const std::vector<typename K::Point_3>& points, double least, Sharp_edges_3& edges)
{
  while (least > 0 && drop_shortest_open_creases<K>(points, least, edges) > 0) {
  }
}

/// Sets features, creases and patches of a complex of which points and triangles are known. Patches are separated by
/// sharp edges and wherever other than two triangles meet.
/// \param is_given by point, whether it is given as a tip or cusp.
template <class K>
void derive_features(const Sharp_edges_3& edges, const std::vector<Surface_side_3>& sides,
                     const std::vector<bool>& is_given, double cusp_angle, Piecewise_smooth_complex_3<K>& complex)
{
  const Sharp_graph_3 graph(complex.points.size(), edges.all);
  complex.features = feature_vertices<K>(graph, complex.points, is_given, cusp_angle);
  complex.creases = chain_creases<K>(graph, complex.features);
  for (auto& crease : complex.creases) crease.given = count_crease_edges(crease, edges.given) > 0;
  Disjoint_parts patches(complex.triangles.size());
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first == 2 && !Sharp_edges_3::contains(edges.all, first->low, first->high))
      patches.unite(first->triangle, (first + 1)->triangle);
  });
  complex.number_of_patches = number_parts(patches, complex.triangles.size(), complex.patches);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_DERIVE_FEATURES_3_H
