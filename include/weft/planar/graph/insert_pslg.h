// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fills a constrained Delaunay triangulation with a planar straight line graph. The graph is checked with exact
// predicates first, and what can't be meshed is refused with the elements named. A segment that passes through input
// points is split there. Crossing and overlapping segments are refused, or on request split: a crossing is computed
// exactly and its coordinates are rounded once, so the pieces deviate from the straight segment by rounding; should
// that make them touch something else, they are split again until exact predicates find no contact.

#ifndef WEFT_PLANAR_GRAPH_INSERT_PSLG_H
#define WEFT_PLANAR_GRAPH_INSERT_PSLG_H

#include <weft/errors.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/graph/Pslg_splitter.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// Options of `insert_pslg()`.
struct Pslg_options
{
  Crossings crossings = Crossings::refuse;
};

/// What `insert_pslg()` returns: where the input went.
template <class Cdt>
struct Inserted_pslg
{
  std::vector<typename Cdt::Vertex_handle> vertices; ///< one per input point; equal points share one
  Mesh_tags_2<typename Cdt::Geom_traits> tags;       ///< input segment and marks of constrained edges, for the writers
};

namespace internal {

template <class Vertex, class = void>
struct Has_constraint : std::false_type
{};
template <class Vertex>
struct Has_constraint<Vertex, std::void_t<decltype(std::declval<Vertex&>().set_constraint(0))>> : std::true_type
{};

/// Refuses a triangulation whose constraints enclose nothing, naming the loose ends.
template <class Cdt, class K>
void require_closed_region(const Cdt& cdt, const Pslg_2<K>& pslg, const std::vector<std::size_t>& point_of)
{
  if (cdt.dimension() < 2) throw Domain_error("all points lie on one line", {}, {});
  if (face_components(cdt).count > 1) return;
  std::vector<int> degree(point_of.size(), 0);
  for (const auto& segment : pslg.segments)
    for (const std::size_t end : segment) ++degree[point_of[end]];
  std::vector<std::size_t> loose_ends;
  for (std::size_t i = 0; i < point_of.size(); ++i)
    if (degree[point_of[i]] == 1) loose_ends.push_back(i);
  throw Domain_error("the segments enclose no region: the boundary is not closed", loose_ends, {});
}

/// Inserts the pieces and returns a vertex for each of their points.
template <class Cdt, class K>
std::vector<typename Cdt::Vertex_handle> insert_pieces(Cdt& cdt, const Pslg_splitter<K>& graph)
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [a, b] : graph.segments) pairs.emplace_back(a, b);
  cdt.insert_constraints(graph.points.begin(), graph.points.end(), pairs.begin(), pairs.end());

  std::map<typename K::Point_2, typename Cdt::Vertex_handle> vertex_at;
  for (const auto vertex : cdt.finite_vertex_handles()) {
    vertex_at.emplace(vertex->point(), vertex);
    if constexpr (Has_constraint<typename Cdt::Vertex>::value) vertex->set_constraint(fixed_vertex);
  }
  std::vector<typename Cdt::Vertex_handle> vertices;
  for (const auto& p : graph.points) vertices.push_back(vertex_at.at(p));
  return vertices;
}

/// Whether the constraints of the triangulation are the pieces, each of them one edge.
template <class Cdt, class K>
bool pieces_are_edges(const Cdt& cdt, const Pslg_splitter<K>& graph,
                      const std::vector<typename Cdt::Vertex_handle>& vertices)
{
  if (cdt.number_of_vertices() != vertices.size()) return false;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t> index;
  for (std::size_t i = 0; i < vertices.size(); ++i) index[vertices[i]] = i;
  std::vector<Index_pair> pieces, edges;
  for (const auto& [a, b] : graph.segments) pieces.push_back({std::min(a, b), std::max(a, b)});
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
    const std::size_t a = index[edge->first->vertex(cdt.cw(edge->second))];
    const std::size_t b = index[edge->first->vertex(cdt.ccw(edge->second))];
    edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(pieces.begin(), pieces.end());
  std::sort(edges.begin(), edges.end());
  return pieces == edges;
}

/// Inserts a graph whose segments may still be in contact. The triangulation itself is the fastest test of that, being
/// clean just when it takes every segment as one edge; contacts are looked for only where it doesn't.
template <class Cdt, class K>
std::vector<typename Cdt::Vertex_handle> insert_graph(Cdt& cdt, Pslg_splitter<K>& graph, Crossings crossings)
{
  try {
    const auto vertices = insert_pieces(cdt, graph);
    if (pieces_are_edges(cdt, graph, vertices)) return vertices;
  } catch (const typename Cdt::Intersection_of_constraints_exception&) {
    // A crossing: whether that is an error is decided below.
  }
  cdt.clear();
  graph.split_until_clean(crossings);
  return insert_pieces(cdt, graph);
}

} // namespace internal

/// Inserts all points and segments of the graph into an empty triangulation. Exactly equal points are merged, and so
/// are equal segments (the first keeps its mark). Vertices that have `set_constraint()` become `fixed_vertex`.
/// \returns the vertex of each input point, and what the writers need to mark edges and regions.
/// \throws Domain_error, with the triangulation empty: no points or segments; coordinates that aren't finite; segments
///   that refer to missing points or have length zero; crossing or overlapping segments, unless they are to be split;
///   points all on one line; no closed region.
/// \throws Option_error if the triangulation isn't empty.
/// Takes O(n log n) time for segments that meet at their ends only; otherwise O(n log² n) and the number of pairs of
/// segments with overlapping bounding boxes more.
template <class Cdt, class K>
Inserted_pslg<Cdt> insert_pslg(Cdt& cdt, const Pslg_2<K>& pslg, const Pslg_options& options = {})
{
  static_assert(std::is_same_v<typename K::Point_2, typename Cdt::Point>,
                "graph and triangulation must share a kernel");
  if (cdt.number_of_vertices() > 0) throw Option_error("insert_pslg() needs an empty triangulation");
  internal::Pslg_splitter<K> graph(pslg);

  Inserted_pslg<Cdt> result;
  try {
    const auto vertices = internal::insert_graph(cdt, graph, options.crossings);
    internal::require_closed_region(cdt, pslg, graph.point_of);
    for (const std::size_t i : graph.point_of) result.vertices.push_back(vertices[i]);
  } catch (...) {
    cdt.clear();
    throw;
  }
  for (std::size_t s = 0; s < graph.segments.size(); ++s)
    result.tags.constraints.add(graph.points[graph.segments[s][0]], graph.points[graph.segments[s][1]],
                                static_cast<int>(graph.input_segment[s]));
  result.tags.constraints.set_markers(pslg.segment_markers);
  for (const auto& region : pslg.regions) result.tags.regions.push_back({region.point, region.marker});
  return result;
}

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_INSERT_PSLG_H
