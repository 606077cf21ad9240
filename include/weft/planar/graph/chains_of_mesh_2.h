// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constraints of a finished planar mesh, found by their Steiner vertices.

#ifndef WEFT_PLANAR_GRAPH_CHAINS_OF_MESH_2_H
#define WEFT_PLANAR_GRAPH_CHAINS_OF_MESH_2_H

#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/Unique_hash_map.h>

#include <utility>
#include <vector>

namespace weft::internal {

/// Vertices of each constraint from one input vertex to the other, in order; those between have `constraint()` >= 0 and
/// two constrained edges. Others that say so count as input vertices.
template <class Cdt>
std::vector<std::vector<typename Cdt::Vertex_handle>> chains_of_mesh(const Cdt& cdt)
{
  using Vertex_handle = typename Cdt::Vertex_handle;
  CGAL::Unique_hash_map<Vertex_handle, std::vector<Vertex_handle>> ends;
  std::vector<std::pair<Vertex_handle, Vertex_handle>> edges;
  for (auto e = cdt.constrained_edges_begin(); e != cdt.constrained_edges_end(); ++e) {
    const Vertex_handle a = e->first->vertex(cdt.ccw(e->second)), b = e->first->vertex(cdt.cw(e->second));
    edges.emplace_back(a, b);
    ends[a].push_back(b);
    ends[b].push_back(a);
  }
  const auto is_between = [&](Vertex_handle v) { return v->constraint() >= 0 && ends[v].size() == 2; };
  std::vector<std::vector<Vertex_handle>> chains;
  CGAL::Unique_hash_map<Vertex_handle, bool> is_listed(false);
  for (const auto& [a, b] : edges)
    for (auto [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      if (is_between(from) || (is_between(to) ? is_listed[to] : from != a)) continue;
      std::vector<Vertex_handle> chain{from, to};
      while (is_between(to)) {
        is_listed[to] = true;
        const auto& two = ends[to];
        const Vertex_handle next = two[0] == from ? two[1] : two[0];
        from = to;
        to = next;
        chain.push_back(to);
      }
      chains.push_back(std::move(chain));
    }
  return chains;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_GRAPH_CHAINS_OF_MESH_2_H
