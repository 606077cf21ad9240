// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh in arrays as a triangulation that `adapt_2()` takes, and back: its outline becomes a planar straight line
// graph, vertices on straight parts of that are Steiner vertices, and so are those inside.

#ifndef WEFT_PLANAR_RUN_TRIANGULATED_MESH_2_H
#define WEFT_PLANAR_RUN_TRIANGULATED_MESH_2_H

#include <weft/errors.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/run/Mesh_improver_2.h>
#include <weft/planar/run/outline_2.h>
#include <weft/planar/run/outline_graph_2.h>
#include <weft/planar/run/require_structure_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam K a CGAL kernel.
template <class K>
class Triangulated_mesh_2
{
public:
  using Cdt = Mesh_triangulation_2<K>;
  using Point = typename K::Point_2;

  /// \throws Domain_error if the arrays aren't those of a mesh, or its outline crosses itself.
  explicit Triangulated_mesh_2(const Triangle_mesh_2<K>& mesh) : corners_(mesh.corners)
  {
    require_structure(mesh);
    std::vector<char> stays(mesh.points.size(), false), is_inside(mesh.points.size(), true);
    for (const std::size_t v : mesh.corners) stays[v] = true;
    for (const auto& e : mesh.edges) is_inside[e[0]] = is_inside[e[1]] = false;
    std::vector<Point> inside;
    for (std::size_t v = 0; v < is_inside.size(); ++v)
      if (is_inside[v] && !stays[v]) inside.push_back(mesh.points[v]);
    outline_.graph = outline_graph_2(
        mesh, outline_2(mesh, stays, corner_angle, false), stays, [](const auto&) { return 1; }, 0);
    if (outline_.triangulate() < outline_.graph.segments.size())
      throw Domain_error("parts of the mesh lie on each other: its edges contradict the regions of its triangles", {},
                         {});
    const Uniform_sizing<> any(1);
    Working working(outline_.triangulation, any);
    insert_on_segments(working);
    CGAL::spatial_sort(inside.begin(), inside.end(), outline_.triangulation.geom_traits());
    auto hint = outline_.triangulation.infinite_face();
    for (const Point& p : inside)
      if (const auto v = working.insert_inside(p, hint); v != typename Cdt::Vertex_handle()) hint = v->face();
  }

  Cdt& triangulation() { return outline_.triangulation; }

  /// Vertices of the outline that are left come first, in the order that they had.
  Triangle_mesh_2<K> extract() const { return extract_mesh_2(outline_, corners_); }

private:
  using Working = Working_mesh_2<Cdt, Uniform_sizing<>>;

  static constexpr double corner_angle = 20; // by which the outline turns at its corners; other bends stay as well

  void insert_on_segments(Working& working) const
  {
    std::map<std::pair<Point, Point>, std::size_t> segment_between;
    const auto& graph = outline_.graph;
    for (std::size_t s = 0; s < graph.segments.size(); ++s)
      segment_between[std::minmax(graph.pslg.points[graph.segments[s].source],
                                  graph.pslg.points[graph.segments[s].target])] = s;
    for (const auto& chain : working.chains()) {
      const auto at = segment_between.find(std::minmax(chain.source->point(), chain.target->point()));
      if (at == segment_between.end()) continue;
      const auto& segment = graph.segments[at->second];
      std::vector<Point> points = segment.between;
      if (chain.source->point() != graph.pslg.points[segment.source]) std::reverse(points.begin(), points.end());
      auto before = chain.source;
      for (const Point& p : points) {
        typename Cdt::Face_handle f;
        int i;
        if (!working.triangulation().is_edge(before, chain.target, f, i)) break;
        if (const auto v = working.insert_on_constraint(p, f, i); v != typename Cdt::Vertex_handle()) before = v;
      }
    }
  }

  Triangulated_outline_2<K> outline_;
  std::vector<std::size_t> corners_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_TRIANGULATED_MESH_2_H
