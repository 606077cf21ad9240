// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the input segment that a constrained edge of a mesh is part of. Refinement only ever splits constraints, so an
// edge is followed along its constraint, both ways, to the next input points; they name the piece of the input
// segment. Points are recognised by their coordinates, since input points never move: the answer holds for copies of
// the triangulation, for one rebuilt from its points, and for one refined by anybody, CGAL's own mesher included.

#ifndef WEFT_PLANAR_GRAPH_CONSTRAINT_MARKERS_H
#define WEFT_PLANAR_GRAPH_CONSTRAINT_MARKERS_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace weft {

/// A constrained edge of a mesh with its input segment, or -1 where that isn't known.
template <class Cdt>
struct Marked_edge
{
  typename Cdt::Edge edge;
  int segment;
};

/// Input segments of constrained edges, and the marks that they carry in files.
/// \tparam K the kernel of the triangulation.
template <class K>
class Constraint_markers
{
public:
  using Point = typename K::Point_2;
  static constexpr int none = -1; ///< "no input segment"

  /// Says that the straight piece between the input points `p` and `q` belongs to `segment`. The first segment of a
  /// piece keeps it.
  void add(const Point& p, const Point& q, int segment)
  {
    pieces_.emplace(std::minmax(p, q), segment);
    ends_.insert(p);
    ends_.insert(q);
  }

  /// Marks per input segment, as in the file; empty if there were none.
  void set_markers(std::vector<int> markers) { markers_ = std::move(markers); }

  bool empty() const { return pieces_.empty(); }
  bool has_markers() const { return !markers_.empty(); }

  /// Mark of an input segment; its number counted from 1 where the input had no marks, 0 for `none`.
  int marker(int segment) const
  {
    if (segment < 0) return 0;
    return static_cast<std::size_t>(segment) < markers_.size() ? markers_[internal::as_index(segment)] : segment + 1;
  }

  /// Input segment of the constrained edge, or `none`. Linear in the number of edges on the piece of the segment.
  template <class Cdt>
  int segment(const Cdt& cdt, typename Cdt::Face_handle face, int i) const
  {
    return segment_of(chain(cdt, face, i));
  }

  /// Mark of the input segment that the constrained edge is part of, 0 if there is none.
  template <class Cdt>
  int constraint_marker(const Cdt& cdt, typename Cdt::Face_handle face, int i) const
  {
    return marker(segment(cdt, face, i));
  }

  /// All constrained edges, in the order of the triangulation, with their segments. O(m log s) for m edges, s segments.
  template <class Cdt>
  WEFT_NOINLINE std::vector<Marked_edge<Cdt>> constrained_edges(const Cdt& cdt) const
  {
    constexpr int unknown = -2;
    // A vertex between input points lies on one constraint only, so it remembers the answer for both its edges.
    CGAL::Unique_hash_map<typename Cdt::Vertex_handle, int> segment_at(unknown);
    std::vector<Marked_edge<Cdt>> result;
    for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
      const auto [face, i] = *edge;
      // Copies: a look-up may move the table.
      const int at_source = segment_at[face->vertex(cdt.ccw(i))], at_target = segment_at[face->vertex(cdt.cw(i))];
      int found = std::max(at_source, at_target);
      if (found == unknown) {
        const auto vertices = chain(cdt, face, i);
        found = segment_of(vertices);
        for (std::size_t k = 1; k + 1 < vertices.size(); ++k) segment_at[vertices[k]] = found;
      }
      result.push_back({*edge, found});
    }
    return result;
  }

private:
  /// Vertices along the constraint through an edge, from one input point to the next.
  template <class Cdt>
  std::vector<typename Cdt::Vertex_handle> chain(const Cdt& cdt, typename Cdt::Face_handle face, int i) const
  {
    std::vector<typename Cdt::Vertex_handle> vertices{face->vertex(cdt.ccw(i)), face->vertex(cdt.cw(i))};
    follow(cdt, vertices);
    std::reverse(vertices.begin(), vertices.end());
    follow(cdt, vertices);
    return vertices;
  }

  /// Goes on from the last edge of the chain until an input point, a fork, a loose end or the chain's own start.
  template <class Cdt>
  void follow(const Cdt& cdt, std::vector<typename Cdt::Vertex_handle>& vertices) const
  {
    while (ends_.count(vertices.back()->point()) == 0 && vertices.back() != vertices.front()) {
      const typename Cdt::Vertex_handle here = vertices.back(), before = vertices[vertices.size() - 2];
      typename Cdt::Vertex_handle next;
      int others = 0;
      auto edge = cdt.incident_edges(here);
      const auto done = edge;
      do {
        if (cdt.is_infinite(*edge) || !cdt.is_constrained(*edge)) continue;
        const typename Cdt::Vertex_handle a = edge->first->vertex(cdt.ccw(edge->second));
        const typename Cdt::Vertex_handle other = a == here ? edge->first->vertex(cdt.cw(edge->second)) : a;
        if (other == before) continue;
        next = other;
        ++others;
      } while (++edge != done);
      if (others != 1) return;
      vertices.push_back(next);
    }
  }

  template <class Vertex_handle>
  int segment_of(const std::vector<Vertex_handle>& vertices) const
  {
    const auto piece = pieces_.find(std::minmax(vertices.front()->point(), vertices.back()->point()));
    return piece == pieces_.end() ? none : piece->second;
  }

  std::map<std::pair<Point, Point>, int> pieces_;
  std::set<Point> ends_;
  std::vector<int> markers_;
};

/// What a file can say about a mesh besides its geometry: marks of constraints, and of regions.
template <class K>
struct Mesh_tags_2
{
  Constraint_markers<K> constraints;
  std::vector<typename Pslg_2<K>::Region> regions;
};

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_CONSTRAINT_MARKERS_H
