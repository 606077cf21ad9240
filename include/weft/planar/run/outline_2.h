// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline of a planar mesh: the edges of its boundary, between its regions, and others that have to stay. Corners
// divide it into chains, along which vertices may slide; straight parts of a chain are segments of a planar straight
// line graph. A segment knows the regions on its two sides, so that a triangulation of the graph can be given its
// regions back, and a change of the outline that would mix them up shows.

#ifndef WEFT_PLANAR_RUN_OUTLINE_2_H
#define WEFT_PLANAR_RUN_OUTLINE_2_H

#include <weft/errors.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Edges of the outline from corner to corner, or once around.
struct Outline_chain_2
{
  std::vector<std::size_t> vertices; ///< of the mesh; the first is the last where it goes around
  int tag;
  int left, right; ///< sides: 0 the outside, else 1 more than the position of the region's tag in `Outline_2::regions`
};

/// All chains of a mesh.
struct Outline_2
{
  std::vector<int> regions; ///< tags, in increasing order
  std::vector<Outline_chain_2> chains;
};

/// Finds the chains; `outline_2()` runs it.
template <class K>
class Outline_builder_2
{
public:
  Outline_builder_2(const Triangle_mesh_2<K>& mesh, double corner_angle)
      : mesh_(mesh), least_cosine_(std::cos(corner_angle * std::acos(-1.0) / 180)), edges_at_(mesh.points.size())
  {
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      for (const std::size_t v : mesh.edges[e]) edges_at_[v].push_back(e);
  }

  /// \param stays by vertex, those that are corners in any case.
  /// \param all whether all of the outline are.
  Outline_2 run(std::vector<char> stays, bool all)
  {
    find_sides();
    for (std::size_t v = 0; v < stays.size(); ++v)
      if (!edges_at_[v].empty() && (all || is_corner(v))) stays[v] = true;
    std::vector<char> is_listed(mesh_.edges.size(), false);
    const auto add = [&](std::size_t e, std::size_t from) {
      if (is_listed[e]) return;
      Outline_chain_2 chain{{from}, mesh_.edge_tags[e], side(e, from, 0), side(e, from, 1)};
      for (;;) {
        is_listed[e] = true;
        from = other_end(e, from);
        chain.vertices.push_back(from);
        if (stays[from]) break;
        e = edges_at_[from][edges_at_[from][0] == e ? 1 : 0];
        if (is_listed[e]) break; // once around
      }
      outline_.chains.push_back(std::move(chain));
    };
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      for (const std::size_t v : mesh_.edges[e])
        if (stays[v]) add(e, v);
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) add(e, mesh_.edges[e][0]);
    return std::move(outline_);
  }

private:
  using Edge = std::array<std::size_t, 2>;

  std::size_t other_end(std::size_t e, std::size_t v) const { return mesh_.edges[e][mesh_.edges[e][0] == v ? 1 : 0]; }

  /// The side to the left (0) or right (1) of an edge that is followed from one of its ends.
  int side(std::size_t e, std::size_t from, std::size_t which) const
  {
    return sides_[e][mesh_.edges[e][0] == from ? which : 1 - which];
  }

  void find_sides()
  {
    outline_.regions = mesh_.regions;
    std::sort(outline_.regions.begin(), outline_.regions.end());
    outline_.regions.erase(std::unique(outline_.regions.begin(), outline_.regions.end()), outline_.regions.end());
    std::map<Edge, std::size_t> number;
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) number[mesh_.edges[e]] = e;
    sides_.assign(mesh_.edges.size(), {0, 0});
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
        const auto region = std::lower_bound(outline_.regions.begin(), outline_.regions.end(), mesh_.regions[t]);
        const int value = static_cast<int>(region - outline_.regions.begin()) + 1;
        if (const auto at = number.find({a, b}); at != number.end()) sides_[at->second][0] = value;
        if (const auto at = number.find({b, a}); at != number.end()) sides_[at->second][1] = value;
      }
  }

  /// Whether other than two edges meet at a vertex, or two that differ, or that turn there.
  bool is_corner(std::size_t v) const
  {
    if (edges_at_[v].size() != 2) return true;
    const std::size_t e = edges_at_[v][0], f = edges_at_[v][1], a = other_end(e, v), b = other_end(f, v);
    if (mesh_.edge_tags[e] != mesh_.edge_tags[f] || side(e, v, 0) != side(f, v, 1) || side(e, v, 1) != side(f, v, 0))
      return true;
    const Xy_2 o = xy(mesh_.points[v]), p = xy(mesh_.points[a]), q = xy(mesh_.points[b]);
    const double ux = o[0] - p[0], uy = o[1] - p[1], vx = q[0] - o[0], vy = q[1] - o[1];
    return ux * vx + uy * vy <= least_cosine_ * edge_length(ux, uy) * edge_length(vx, vy);
  }

  const Triangle_mesh_2<K>& mesh_;
  double least_cosine_;
  Outline_2 outline_;
  std::vector<std::vector<std::size_t>> edges_at_; ///< by vertex
  std::vector<std::array<int, 2>> sides_;          ///< by edge, to its left and right
};

/// The outline of a mesh. O(n log n) time.
/// \param stays by vertex, whether it is a corner in any case, besides those of the mesh.
/// \param corner_angle degrees by which the outline turns at a corner at least.
/// \param all whether every vertex of the outline is a corner.
template <class K>
Outline_2 outline_2(const Triangle_mesh_2<K>& mesh, const std::vector<char>& stays, double corner_angle, bool all)
{
  return Outline_builder_2<K>(mesh, corner_angle).run(stays, all);
}

/// A straight part of a chain.
template <class K>
struct Outline_segment_2
{
  std::size_t source, target; ///< points of `Outline_graph_2::pslg`
  std::size_t chain;
  std::vector<typename K::Point_2> between; ///< vertices of the mesh that lie on it, in order, without its ends
};

/// An outline as a planar straight line graph.
template <class K>
struct Outline_graph_2
{
  Outline_2 outline;
  Pslg_2<K> pslg; ///< its segments are those below
  std::vector<Outline_segment_2<K>> segments;
  std::vector<std::size_t> origin; ///< of the points, the vertex of the mesh, or -1 for new ones
  std::size_t respaced = 0;        ///< curved parts that got other vertices
};

/// Gives the faces of a triangulation of the graph their sides.
///
/// \param tags as `insert_pslg()` returned them.
/// \param visit called with every finite face and its side, as in Outline_chain_2, if there are no contradictions.
/// \returns the first segment whose sides contradict those of others; the number of segments if there is none.
/// O(n log n) time.
template <class Cdt, class K, class Visit>
std::size_t visit_sides_2(const Cdt& cdt, const Mesh_tags_2<K>& tags, const Outline_graph_2<K>& graph,
                          const Visit& visit)
{
  constexpr int unknown = -1;
  const auto components = face_components(cdt);
  std::vector<int> side_of(static_cast<std::size_t>(components.count), unknown);
  if (components.count > 0) side_of[0] = 0;
  for (const auto& [edge, number] : tags.constraints.constrained_edges(cdt)) {
    if (number < 0) continue;
    const auto& segment = graph.segments[static_cast<std::size_t>(number)];
    const auto& chain = graph.outline.chains[segment.chain];
    const auto face = edge.first;
    const int i = edge.second;
    const auto &a = face->vertex(Cdt::ccw(i))->point(), &b = face->vertex(Cdt::cw(i))->point();
    const auto along = graph.pslg.points[segment.target] - graph.pslg.points[segment.source];
    const bool forward = CGAL::to_double((b - a) * along) > 0;
    for (const auto& [f, side] : {std::pair(face, forward ? chain.left : chain.right),
                                  std::pair(face->neighbor(i), forward ? chain.right : chain.left)}) {
      int& known = side_of[static_cast<std::size_t>(components.number[f])];
      if (known != unknown && known != side) return static_cast<std::size_t>(number);
      known = side;
    }
  }
  for (const auto face : cdt.finite_face_handles())
    visit(face, (std::max)(0, side_of[static_cast<std::size_t>(components.number[face])]));
  return graph.segments.size();
}

/// Divides a chain into its straight parts: no vertex is farther from the part than `tolerance` times the edges there.
/// \param points along the chain.
/// \returns positions of the ends of the parts, the first and the last included.
template <class Point>
std::vector<std::size_t> straight_parts(const std::vector<Point>& points, double tolerance)
{
  std::vector<std::size_t> ends(1, 0);
  while (ends.back() + 1 < points.size()) {
    const std::size_t first = ends.back();
    const Xy_2 o = xy(points[first]), p = xy(points[first + 1]);
    const double dx = p[0] - o[0], dy = p[1] - o[1];
    double low = -1, high = 1; // slopes against the first edge that pass by all vertices so far
    double reached = 0;
    std::size_t last = first + 1;
    for (std::size_t k = first + 1; k < points.size(); ++k) {
      const Xy_2 q = xy(points[k]), before = xy(points[k - 1]);
      const double x = dx * (q[0] - o[0]) + dy * (q[1] - o[1]), y = dx * (q[1] - o[1]) - dy * (q[0] - o[0]);
      if (!(x > reached)) break;
      reached = x;
      const double slope = y / x;
      if (k > first + 1 && (slope < low || slope > high)) break;
      last = k;
      const double room =
          tolerance * edge_length(q[0] - before[0], q[1] - before[1]) * edge_length(dx, dy) / x; // as a slope
      low = (std::max)(low, slope - room);
      high = (std::min)(high, slope + room);
    }
    ends.push_back(last);
  }
  return ends;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_OUTLINE_2_H
