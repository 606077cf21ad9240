// SPDX-License-Identifier: GPL-3.0-or-later
//
// The topological disk condition (Tournois 2009, sec. 3.2.1.4): around a vertex on the boundary of a subdomain the
// restricted facets of that boundary form one umbrella.

#ifndef WEFT_SPATIAL_RESTRICTED_TOPOLOGICAL_DISK_3_H
#define WEFT_SPATIAL_RESTRICTED_TOPOLOGICAL_DISK_3_H

#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Whether edges, given by their ends, form exactly one cycle. Quadratic in their number, which is small.
template <class Vertex>
bool is_one_cycle(std::vector<std::pair<Vertex, Vertex>>& edges)
{
  if (edges.size() < 3) return false;
  const Vertex first = edges[0].first;
  Vertex at = edges[0].second;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    std::size_t next = k;
    std::size_t ways = 0;
    for (std::size_t e = edges.size(); e-- > k;)
      if (edges[e].first == at || edges[e].second == at) ++ways, next = e;
    if (ways != 1 || at == first) return false; // a dead end or a fork, or closed too soon
    std::swap(edges[k], edges[next]);
    at = edges[k].first == at ? edges[k].second : edges[k].first;
  }
  return at == first;
}

/// Whether the restricted facets around a vertex form one umbrella; where several subdomains meet, those around each of
/// them do. A facet with the same subdomain on both sides belongs to no boundary and breaks the umbrella.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
bool has_topological_disk(const Restricted& mesh, typename Restricted::Vertex_handle v)
{
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Link_edge = std::pair<Vertex_handle, Vertex_handle>;
  thread_local std::vector<Link_edge> link, link_of_one;
  thread_local std::vector<std::pair<int, int>> sides;
  link.clear();
  sides.clear();
  mesh.visit_facets_at(v, [&](const typename Restricted::Restricted_facet& f) {
    Vertex_handle ends[2];
    int n = 0;
    for (int k = 0; k < 4; ++k)
      if (k != f.index && f.cell->vertex(k) != v) ends[n++] = f.cell->vertex(k);
    link.emplace_back(ends[0], ends[1]);
    sides.emplace_back(std::minmax(f.cell->subdomain(), f.cell->neighbor(f.index)->subdomain()));
  });
  const auto differs = [&](const std::pair<int, int>& s) { return s != sides.front(); };
  if (std::none_of(sides.begin(), sides.end(), differs)) return is_one_cycle(link);
  thread_local std::vector<int> subdomains;
  subdomains.clear();
  for (const auto& [low, high] : sides)
    for (const int s : {low, high})
      if (s != 0 && std::find(subdomains.begin(), subdomains.end(), s) == subdomains.end()) subdomains.push_back(s);
  return std::all_of(subdomains.begin(), subdomains.end(), [&](int s) {
    link_of_one.clear();
    for (std::size_t k = 0; k < link.size(); ++k)
      if (sides[k].first == s || sides[k].second == s) link_of_one.push_back(link[k]);
    return is_one_cycle(link_of_one);
  });
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_TOPOLOGICAL_DISK_3_H
