// SPDX-License-Identifier: GPL-3.0-or-later
//
// From triangles of any origin to a planar mesh whose elements fit together: triangles oriented alike, the edges of the
// boundary and between regions derived from them. What can't be a mesh is refused with the offending elements; what
// doesn't matter is left out and noted. Triangles that are turned over by their geometry, or have no area, stay so:
// untangling them is for `improve_2()`.

#ifndef WEFT_PLANAR_MESH_ASSEMBLE_MESH_2_H
#define WEFT_PLANAR_MESH_ASSEMBLE_MESH_2_H

#include <weft/errors.h>
#include <weft/internal/run/Mesh_assembler.h>
#include <weft/planar/mesh/Element_soup_2.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Builds the mesh; `assemble_mesh_2()` runs it.
template <class K>
class Mesh_assembler_2 : private Mesh_assembler<Element_soup_2<K>, Imported_mesh_2<K>>
{
  using Base = Mesh_assembler<Element_soup_2<K>, Imported_mesh_2<K>>;
  using Base::none;
  using Base::note_dropped;
  using Base::number_of;
  using Base::result_;
  using Base::soup_;

public:
  explicit Mesh_assembler_2(Element_soup_2<K> soup) : Base(std::move(soup)) {}

  Imported_mesh_2<K> run()
  {
    check_indices();
    this->check_repetitions(soup_.triangles, "triangle", [](std::size_t) {});
    drop_isolated_points();
    check_places();
    list_sides();
    orient_triangles();
    result_.notes.insert(result_.notes.begin(), soup_.notes.begin(), soup_.notes.end());
    mesh().regions = soup_.triangle_tags;
    mesh().regions.resize(mesh().triangles.size(), 0);
    take_edges();
    Base::take_corners(std::vector<char>(mesh().points.size(), true), "of no triangle or listed again");
    return std::move(result_);
  }

private:
  using Edge = std::array<std::size_t, 2>;

  /// A side of a triangle, with its ends in order.
  struct Side
  {
    Edge ends;
    std::size_t triangle;
    bool forward; ///< whether the triangle has the smaller end first
  };

  Triangle_mesh_2<K>& mesh() { return result_.mesh; }

  // ---- checks

  void check_indices() const
  {
    if (soup_.triangles.empty()) throw Domain_error("there are no triangles", {}, {});
    Base::check_indices(soup_.triangles, soup_.triangle_tags, "triangle");
    Base::check_indices(soup_.edges, soup_.edge_tags, "edge");
    this->check_corner_indices();
  }

  /// Coordinates are finite, and no two vertices are at one place.
  void check_places() const
  {
    const auto& points = result_.mesh.points;
    const auto& origin = result_.point_origin;
    for (std::size_t v = 0; v < points.size(); ++v)
      if (!CGAL::is_finite(points[v].x()) || !CGAL::is_finite(points[v].y()))
        throw Domain_error("vertex " + number_of(origin[v]) + " has coordinates that aren't finite", {origin[v]}, {});
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return CGAL::compare_lexicographically(points[a], points[b]) == CGAL::SMALLER;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (points[order[i - 1]] == points[order[i]]) {
        const std::size_t a = origin[order[i - 1]], b = origin[order[i]];
        throw Domain_error("vertices " + number_of(a) + " and " + number_of(b) + " are at the same place", {a, b}, {});
      }
  }

  // ---- points

  void drop_isolated_points()
  {
    const std::vector<std::size_t> place = this->number_points(soup_.triangles, "triangle");
    for (const std::size_t v : result_.point_origin) mesh().points.push_back(soup_.points[v]);
    mesh().triangles = soup_.triangles;
    for (auto& t : mesh().triangles)
      for (std::size_t& v : t) v = place[v];
    for (auto& e : soup_.edges)
      for (std::size_t& v : e) v = place[v];
    for (std::size_t& v : soup_.corners) v = place[v];
  }

  // ---- triangles

  void list_sides()
  {
    for (std::size_t t = 0; t < mesh().triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = mesh().triangles[t][i], b = mesh().triangles[t][(i + 1) % 3];
        sides_.push_back({{(std::min)(a, b), (std::max)(a, b)}, t, a < b});
      }
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
      return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle);
    });
    for_each_edge([&](const Side* first, const Side* last) {
      if (last - first <= 2) return;
      const std::size_t a = result_.point_origin[first->ends[0]], b = result_.point_origin[first->ends[1]];
      throw Domain_error("the edge with the vertices " + number_of(a) + " " + number_of(b) + " has " +
                             std::to_string(last - first) + " triangles",
                         {a, b}, {first->triangle});
    });
  }

  /// Calls a function with the sides of every edge.
  template <class Function>
  void for_each_edge(const Function& function) const
  {
    const Side* const end = sides_.data() + sides_.size();
    for (const Side* first = sides_.data(); first != end;) {
      const Side* last = first;
      while (last != end && last->ends == first->ends) ++last;
      function(first, last);
      first = last;
    }
  }

  /// Turns triangles so that neighbours run along their common edge in opposite senses and the area of every part that
  /// hangs together is positive. What is negative then is turned over in the plane, not just in the list.
  void orient_triangles()
  {
    auto& triangles = mesh().triangles;
    const auto& points = mesh().points;
    typename Base::Neighbours neighbours(triangles.size());
    for_each_edge([&](const Side* first, const Side* last) {
      if (last - first < 2) return;
      const bool agree = first[0].forward != first[1].forward;
      neighbours[first[0].triangle].emplace_back(first[1].triangle, agree);
      neighbours[first[1].triangle].emplace_back(first[0].triangle, agree);
    });
    const auto area = [&](std::size_t t) {
      const auto& v = triangles[t];
      return CGAL::to_double(CGAL::area(points[v[0]], points[v[1]], points[v[2]]));
    };
    const std::vector<signed char> sense =
        this->orient(neighbours, "triangle", area, [&](std::size_t t) { std::swap(triangles[t][1], triangles[t][2]); });
    for (Side& side : sides_) side.forward = side.forward == (sense[side.triangle] > 0);
    for (const auto& t : mesh().triangles)
      result_.inverted_triangles +=
          CGAL::orientation(mesh().points[t[0]], mesh().points[t[1]], mesh().points[t[2]]) != CGAL::LEFT_TURN;
  }

  // ---- edges and corners

  /// The listed edges, then those of the boundary and between regions that aren't listed. Edges of the boundary run
  /// with the domain to their left.
  void take_edges()
  {
    std::map<Edge, std::size_t> listed;
    std::size_t repeated = 0, dropped = 0;
    for (std::size_t e = 0; e < soup_.edges.size(); ++e) {
      auto [a, b] = soup_.edges[e];
      if (a == none || b == none)
        ++dropped;
      else
        repeated += !listed.emplace(Edge{(std::min)(a, b), (std::max)(a, b)}, e).second;
    }
    std::vector<Edge> taken(soup_.edges.size(), Edge{none, none}), others;
    for_each_edge([&](const Side* first, const Side* last) {
      const auto at = listed.find(first->ends);
      const bool inside = last - first == 2 && mesh().regions[first[0].triangle] == mesh().regions[first[1].triangle];
      if (inside && at == listed.end()) return;
      const Edge edge = first->forward ? first->ends : Edge{first->ends[1], first->ends[0]};
      if (at == listed.end())
        others.push_back(edge);
      else
        taken[at->second] = edge;
    });
    for (std::size_t e = 0; e < taken.size(); ++e) {
      if (taken[e][0] == none) continue;
      mesh().edges.push_back(taken[e]);
      mesh().edge_tags.push_back(soup_.edge_tags.empty() ? 0 : soup_.edge_tags[e]);
    }
    dropped += listed.size() - mesh().edges.size();
    for (const Edge& edge : others) {
      mesh().edges.push_back(edge);
      mesh().edge_tags.push_back(0);
    }
    note_dropped(repeated, "edge", "listed again");
    note_dropped(dropped, "edge", "that no triangle has");
  }

  std::vector<Side> sides_; ///< by edge
};

} // namespace internal

/// Makes a mesh of triangles of any origin.
///
/// Triangles are oriented alike. Edges are the listed ones and those of the boundary and between regions, which are
/// where tags of triangles differ. Left out, with a note: points of no triangle, and edges and corners that aren't
/// there.
/// \throws Domain_error if there are no triangles, for triangles that have a vertex twice or are there twice, edges of
///   three or more triangles, triangles that can't be oriented alike, indices out of range, coordinates that aren't
///   finite, and two vertices at one place; with the offending vertices and triangles.
/// O(n log n) time.
template <class K>
Imported_mesh_2<K> assemble_mesh_2(Element_soup_2<K> soup)
{
  return internal::Mesh_assembler_2<K>(std::move(soup)).run();
}

/// The same for points and triangles in arrays, and a tag of each triangle, which may be left out.
template <class Point, class K = typename CGAL::Kernel_traits<Point>::Kernel>
Imported_mesh_2<K> assemble_mesh_2(const std::vector<Point>& points,
                                   const std::vector<std::array<std::size_t, 3>>& triangles,
                                   const std::vector<int>& tags = {})
{
  Element_soup_2<K> soup;
  soup.points = points;
  soup.triangles = triangles;
  soup.triangle_tags = tags;
  return assemble_mesh_2(std::move(soup));
}

} // namespace weft

#endif // WEFT_PLANAR_MESH_ASSEMBLE_MESH_2_H
