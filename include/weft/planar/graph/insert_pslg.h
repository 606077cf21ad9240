// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fills a constrained Delaunay triangulation with a planar straight line graph. The graph is checked with exact
// predicates first, and what can't be meshed is refused with the elements named. A segment that passes through input
// points is split there. Within a tolerance, points that nearly coincide are one and segments are split at points that
// they nearly pass, so that parts which touch up to rounding make one conforming mesh; what was joined is returned.
// Crossing segments, and without a tolerance overlapping ones, are refused, or on request split: a crossing is computed
// exactly and its coordinates are rounded once, so the pieces deviate from the straight segment by rounding; should
// that make them touch something else, they are split again until exact predicates find no contact.

#ifndef WEFT_PLANAR_GRAPH_INSERT_PSLG_H
#define WEFT_PLANAR_GRAPH_INSERT_PSLG_H

#include <weft/errors.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/graph/pslg_near_contacts.h>
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
  /// How far apart points, or a point and a segment, may be to count as touching; in parts of the larger side of the
  /// segments' bounding box, but at least four units in the last place of the largest coordinate. 0: exact.
  double tolerance = 3e-10;
};

/// What `insert_pslg()` returns: where the input went.
template <class Cdt>
struct Inserted_pslg
{
  std::vector<typename Cdt::Vertex_handle> vertices; ///< one per input point; those that were merged share one
  Mesh_tags_2<typename Cdt::Geom_traits> tags;       ///< input segment and marks of constrained edges, for the writers
  Pslg_2<typename Cdt::Geom_traits>
      graph;            ///< as inserted: segments meet at their ends only. For `Lfs_sizing_2`, checks
  Pslg_changes changes; ///< what was merged, split and left out
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
    for (const std::size_t end : segment)
      if (point_of[segment[0]] != point_of[segment[1]]) ++degree[point_of[end]];
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
/// clean just when it takes every segment as one edge, and has no flat face where there is a tolerance; contacts are
/// looked for only where that isn't so.
template <class Cdt, class K>
std::vector<typename Cdt::Vertex_handle> insert_graph(Cdt& cdt, Pslg_splitter<K>& graph, Crossings crossings)
{
  std::vector<typename Cdt::Vertex_handle> vertices;
  bool is_clean = false;
  try {
    vertices = insert_pieces(cdt, graph);
    is_clean = pieces_are_edges(cdt, graph, vertices);
  } catch (const typename Cdt::Intersection_of_constraints_exception&) {
    // A crossing: whether that is an error is decided below.
  }
  // Altitudes are rounded, so twice the tolerance is asked for.
  if (is_clean && !(graph.tolerance() > 0 && smallest_altitude(cdt) <= 2 * graph.tolerance())) return vertices;
  if (!graph.join_what_is_close() && is_clean) return vertices;
  cdt.clear();
  graph.split_until_clean(crossings);
  return insert_pieces(cdt, graph);
}

/// The graph as it was inserted, with the marks of the input.
template <class K>
Pslg_2<K> inserted_graph(const Pslg_2<K>& pslg, const Pslg_splitter<K>& graph)
{
  Pslg_2<K> result = pslg;
  result.points = graph.points;
  result.segments = graph.segments;
  if (!pslg.point_markers.empty()) {
    result.point_markers.assign(graph.points.size(), 0);
    for (std::size_t i = graph.point_of.size(); i-- > 0;)
      result.point_markers[graph.point_of[i]] = pslg.point_markers[i]; // the first of equal points
  }
  if (!pslg.segment_markers.empty()) {
    result.segment_markers.clear();
    for (const std::size_t s : graph.input_segment) result.segment_markers.push_back(pslg.segment_markers[s]);
  }
  return result;
}

} // namespace internal

/// Inserts all points and segments of the graph into an empty triangulation. Points within the tolerance of each other
/// are one vertex, at the place of the first, and so are equal parts of segments one constraint (with the mark of the
/// first). A segment is split at points within the tolerance of it. Segments of length zero are left out. A graph
/// without any of that is inserted exactly. Vertices that have `set_constraint()` become `fixed_vertex`.
/// \returns the vertex of each input point, what the writers need to mark edges and regions, and what was merged.
/// \throws Domain_error, with the triangulation empty: no points or segments; coordinates that aren't finite; segments
///   that refer to missing points; crossing segments, unless they are to be split; with tolerance 0 also overlapping
///   ones; points all on one line; no closed region.
/// \throws Option_error if the triangulation isn't empty, or the tolerance isn't in [0, 0.1].
/// Takes O(n log n) time for segments that meet at their ends only; otherwise O(n log² n) and the number of pairs of
/// segments with overlapping bounding boxes more.
template <class Cdt, class K>
Inserted_pslg<Cdt> insert_pslg(Cdt& cdt, const Pslg_2<K>& pslg, const Pslg_options& options = {})
{
  static_assert(std::is_same_v<typename K::Point_2, typename Cdt::Point>,
                "graph and triangulation must share a kernel");
  if (cdt.number_of_vertices() > 0) throw Option_error("insert_pslg() needs an empty triangulation");
  if (!(options.tolerance >= 0 && options.tolerance <= 0.1)) throw Option_error("tolerance must lie in [0, 0.1]");
  internal::Pslg_splitter<K> graph(pslg, options.tolerance);

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
  for (const auto& region : pslg.regions)
    if (!internal::is_on_constraint(cdt, region.point, cdt.locate(region.point))) result.tags.regions.push_back(region);
  result.graph = internal::inserted_graph(pslg, graph);
  result.changes = graph.changes();
  return result;
}

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_INSERT_PSLG_H
