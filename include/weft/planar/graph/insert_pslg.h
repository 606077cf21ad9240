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
#include <weft/internal/counted.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/graph/pslg_contacts.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// What to do with segments that cross or overlap.
enum class Crossings
{
  refuse, ///< throw Domain_error
  split   ///< make the crossing a vertex, and the common part of overlapping segments one constraint
};

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

/// Turns a graph into segments that meet at their ends only.
template <class K>
class Pslg_splitter
{
public:
  using Point = typename K::Point_2;

  /// Checks the graph and merges what is equal; contacts between segments are left.
  explicit Pslg_splitter(const Pslg_2<K>& pslg) : first_number_(pslg.first_number)
  {
    take_points(pslg);
    take_segments(pslg);
  }

  /// Removes all contacts between segments, or refuses them.
  void split_until_clean(Crossings crossings)
  {
    // Two or three rounds are the rule: rounded crossings seldom touch anything. The bound is there to end for sure.
    constexpr int most_rounds = 50;
    for (int round = 0; round < most_rounds; ++round) {
      const Segment_contacts contacts = segment_contacts<K>(points, segments);
      if (crossings == Crossings::refuse) refuse(contacts);
      split(contacts);
      // Splitting at points that are exactly on a segment creates no new contacts.
      if (contacts.crossings.empty()) return;
    }
    refuse(segment_contacts<K>(points, segments));
  }

  std::vector<Point> points;              ///< distinct
  std::vector<std::size_t> point_of;      ///< index into `points` per input point
  std::vector<Index_pair> segments;       ///< pieces, distinct
  std::vector<std::size_t> input_segment; ///< input segment per piece

private:
  void take_points(const Pslg_2<K>& pslg)
  {
    if (pslg.points.empty()) throw Domain_error("the input has no points", {}, {});
    for (std::size_t i = 0; i < pslg.points.size(); ++i) {
      require_finite(pslg.points[i], "point " + numbered(i) + ",", {i});
      point_of.push_back(add_point(pslg.points[i]));
    }
    for (std::size_t i = 0; i < pslg.holes.size(); ++i)
      require_finite(pslg.holes[i], "the point of hole " + numbered(i) + ",", {});
    for (std::size_t i = 0; i < pslg.regions.size(); ++i)
      require_finite(pslg.regions[i].point, "the point of region " + numbered(i) + ",", {});
  }

  /// "5, counted from 1".
  std::string numbered(std::size_t i) const
  {
    return std::to_string(i + first_number_) + ", counted from " + std::to_string(first_number_);
  }

  static void require_finite(const Point& p, const std::string& name, std::vector<std::size_t> vertices)
  {
    if (!std::isfinite(CGAL::to_double(p.x())) || !std::isfinite(CGAL::to_double(p.y())))
      throw Domain_error(name + " has a coordinate that is not finite", std::move(vertices), {});
  }

  /// Exactly equal points are one.
  std::size_t add_point(const Point& p)
  {
    const auto [place, is_new] = index_.emplace(p, points.size());
    if (is_new) points.push_back(p);
    return place->second;
  }

  void take_segments(const Pslg_2<K>& pslg)
  {
    if (pslg.segments.empty()) throw Domain_error("the input has no segments, so it encloses no region", {}, {});
    for (std::size_t s = 0; s < pslg.segments.size(); ++s) {
      for (const std::size_t end : pslg.segments[s])
        if (end >= point_of.size())
          throw Domain_error("segment " + numbered(s) + ", refers to point " + std::to_string(end + first_number_) +
                                 ", which doesn't exist",
                             {}, {s});
      const Index_pair ends = {point_of[pslg.segments[s][0]], point_of[pslg.segments[s][1]]};
      if (ends[0] == ends[1])
        throw Domain_error("segment " + numbered(s) + ", has length zero", {pslg.segments[s][0], pslg.segments[s][1]},
                           {s});
      segments.push_back(ends);
      input_segment.push_back(s);
    }
    merge_equal_segments();
  }

  /// Of equal segments the one with the lowest input number stays; the order of the others is kept.
  void merge_equal_segments()
  {
    std::map<Index_pair, std::size_t> owner;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto place = owner.emplace(sorted(segments[s]), input_segment[s]).first;
      place->second = std::min(place->second, input_segment[s]);
    }
    std::size_t kept = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto place = owner.find(sorted(segments[s]));
      if (place == owner.end()) continue;
      segments[kept] = segments[s];
      input_segment[kept++] = place->second;
      owner.erase(place);
    }
    segments.resize(kept);
    input_segment.resize(kept);
  }

  static Index_pair sorted(const Index_pair& s) { return {std::min(s[0], s[1]), std::max(s[0], s[1])}; }

  void refuse(const Segment_contacts& contacts) const
  {
    refuse(contacts.overlaps, "overlap");
    refuse(contacts.crossings, "cross");
  }

  void refuse(const std::vector<Index_pair>& pairs, const std::string& verb) const
  {
    if (pairs.empty()) return;
    const std::size_t s = input_segment[pairs[0][0]], t = input_segment[pairs[0][1]];
    std::string more;
    if (pairs.size() > 1) more = " (and " + counted(pairs.size() - 1, "other pair", "other pairs") + ")";
    throw Domain_error("segments " + std::to_string(s + first_number_) + " and " + numbered(t) + ", " + verb + more, {},
                       {s, t});
  }

  /// Splits every segment at the points that lie on it and at its rounded crossings.
  void split(const Segment_contacts& contacts)
  {
    std::vector<std::vector<std::size_t>> on_segment(segments.size());
    for (const auto& [s, p] : contacts.touching) on_segment[s].push_back(p);
    for (const auto& [s, t] : contacts.crossings) {
      const std::size_t p = add_point(crossing(segments[s], segments[t]));
      on_segment[s].push_back(p);
      on_segment[t].push_back(p);
    }
    std::vector<Index_pair> pieces;
    std::vector<std::size_t> piece_of;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      auto& chain = on_segment[s];
      sort_along(segments[s], chain);
      chain.push_back(segments[s][1]);
      std::size_t from = segments[s][0];
      for (const std::size_t to : chain) {
        if (from == to) continue; // the rounded crossing is an end, or another crossing
        pieces.push_back({from, to});
        piece_of.push_back(input_segment[s]);
        from = to;
      }
    }
    segments.swap(pieces);
    input_segment.swap(piece_of);
    merge_equal_segments();
  }

  /// By distance from the first end; points at equal distance by index.
  void sort_along(const Index_pair& segment, std::vector<std::size_t>& chain) const
  {
    const Point& origin = points[segment[0]];
    const typename K::Compare_distance_2 compare{};
    std::sort(chain.begin(), chain.end(), [&](std::size_t p, std::size_t q) {
      const auto order = compare(origin, points[p], points[q]);
      return order == CGAL::EQUAL ? p < q : order == CGAL::SMALLER;
    });
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
  }

  /// The common point of two crossing segments: computed exactly, then each coordinate rounded.
  Point crossing(const Index_pair& s, const Index_pair& t) const
  {
    using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
    const CGAL::Cartesian_converter<K, Exact> exact;
    const auto a = exact(points[s[0]]), b = exact(points[s[1]]), c = exact(points[t[0]]), d = exact(points[t[1]]);
    const auto across = [](const Exact::Vector_2& u, const Exact::Vector_2& v) {
      return CGAL::Exact_rational(u.x() * v.y() - u.y() * v.x());
    };
    const Exact::Point_2 p = a + (across(c - a, d - c) / across(b - a, d - c)) * (b - a);
    return Point(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
  }

  std::map<Point, std::size_t> index_;
  std::size_t first_number_;
};

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
