// SPDX-License-Identifier: GPL-3.0-or-later
//
// From triangles of any origin to a planar mesh whose elements fit together: triangles oriented alike, the edges of the
// boundary and between regions derived from them. What can't be a mesh is refused with the offending elements; what
// doesn't matter is left out and noted. Triangles that are turned over by their geometry, or have no area, stay so:
// untangling them is for `improve_2()`.

#ifndef WEFT_PLANAR_MESH_ASSEMBLE_MESH_2_H
#define WEFT_PLANAR_MESH_ASSEMBLE_MESH_2_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
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
class Mesh_assembler_2
{
public:
  explicit Mesh_assembler_2(Element_soup_2<K> soup) : soup_(std::move(soup)) {}

  Imported_mesh_2<K> run()
  {
    check_indices();
    check_triangles();
    drop_isolated_points();
    check_places();
    list_sides();
    orient_triangles();
    result_.notes.insert(result_.notes.begin(), soup_.notes.begin(), soup_.notes.end());
    mesh().regions = soup_.triangle_tags;
    mesh().regions.resize(mesh().triangles.size(), 0);
    take_edges();
    take_corners();
    return std::move(result_);
  }

private:
  using Edge = std::array<std::size_t, 2>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// A side of a triangle, with its ends in order.
  struct Side
  {
    Edge ends;
    std::size_t triangle;
    bool forward; ///< whether the triangle has the smaller end first
  };

  Triangle_mesh_2<K>& mesh() { return result_.mesh; }

  // ---- checks

  std::string number_of(std::size_t v) const { return std::to_string(v + soup_.first_number); }

  [[noreturn]] void refuse_triangle(std::size_t t, const std::string& what) const
  {
    const auto& v = soup_.triangles[t];
    throw Domain_error("triangle " + std::to_string(t + soup_.first_number) + " (vertices " + number_of(v[0]) + " " +
                           number_of(v[1]) + " " + number_of(v[2]) + ") " + what,
                       {v.begin(), v.end()}, {t});
  }

  void check_indices() const
  {
    if (soup_.triangles.empty()) throw Domain_error("there are no triangles", {}, {});
    check_indices(soup_.triangles, soup_.triangle_tags, "triangle");
    check_indices(soup_.edges, soup_.edge_tags, "edge");
    for (const std::size_t v : soup_.corners)
      if (v >= soup_.points.size())
        throw Domain_error("there is no vertex " + number_of(v) + " to be a corner", {v}, {});
  }

  template <std::size_t N>
  void check_indices(const std::vector<std::array<std::size_t, N>>& elements, const std::vector<int>& tags,
                     const std::string& name) const
  {
    if (!tags.empty() && tags.size() != elements.size())
      throw Domain_error("there are " + counted(elements.size(), name, name + "s") + " and " +
                             counted(tags.size(), "tag", "tags") + " of them",
                         {}, {});
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const std::size_t v : elements[e])
        if (v >= soup_.points.size())
          throw Domain_error(name + " " + std::to_string(e + soup_.first_number) + " has the vertex " + number_of(v) +
                                 ", which there isn't",
                             {v}, {e});
  }

  void check_triangles() const
  {
    std::vector<std::pair<std::array<std::size_t, 3>, std::size_t>> keys;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      auto key = soup_.triangles[t];
      std::sort(key.begin(), key.end());
      if (std::adjacent_find(key.begin(), key.end()) != key.end()) refuse_triangle(t, "has a vertex twice");
      keys.emplace_back(key, t);
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i - 1].first == keys[i].first)
        refuse_triangle(keys[i].second, "is there twice: it has the vertices of triangle " +
                                            std::to_string(keys[i - 1].second + soup_.first_number));
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
    std::vector<std::size_t> place(soup_.points.size(), none);
    for (const auto& t : soup_.triangles)
      for (const std::size_t v : t) place[v] = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] == none) continue;
      place[v] = mesh().points.size();
      mesh().points.push_back(soup_.points[v]);
      result_.point_origin.push_back(v);
    }
    mesh().triangles = soup_.triangles;
    for (auto& t : mesh().triangles)
      for (std::size_t& v : t) v = place[v];
    for (auto& e : soup_.edges)
      for (std::size_t& v : e) v = place[v];
    for (std::size_t& v : soup_.corners) v = place[v];
    const std::size_t dropped = place.size() - mesh().points.size();
    if (dropped == 0) return;
    const auto first = static_cast<std::size_t>(std::find(place.begin(), place.end(), none) - place.begin());
    result_.notes.push_back(counted(dropped, "vertex", "vertices") + " of no triangle left out, the first is " +
                            number_of(first));
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
    const std::size_t n = mesh().triangles.size();
    std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(n); // and whether they agree as they are
    for_each_edge([&](const Side* first, const Side* last) {
      if (last - first < 2) return;
      const bool agree = first[0].forward != first[1].forward;
      neighbours[first[0].triangle].emplace_back(first[1].triangle, agree);
      neighbours[first[1].triangle].emplace_back(first[0].triangle, agree);
    });
    std::vector<signed char> sense(n, 0);
    for (std::size_t seed = 0; seed < n; ++seed)
      if (sense[seed] == 0) orient_part(seed, neighbours, sense);
    for (Side& side : sides_) side.forward = side.forward == (sense[side.triangle] > 0);
    for (const auto& t : mesh().triangles)
      result_.inverted_triangles +=
          CGAL::orientation(mesh().points[t[0]], mesh().points[t[1]], mesh().points[t[2]]) != CGAL::LEFT_TURN;
  }

  /// Afterwards `sense` says of each triangle of the part whether it was left as it was (1) or turned (-1).
  void orient_part(std::size_t seed, const std::vector<std::vector<std::pair<std::size_t, bool>>>& neighbours,
                   std::vector<signed char>& sense)
  {
    std::vector<std::size_t> part = {seed};
    sense[seed] = 1;
    double area = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::size_t t = part[k];
      const auto& v = mesh().triangles[t];
      area += sense[t] * CGAL::to_double(CGAL::area(mesh().points[v[0]], mesh().points[v[1]], mesh().points[v[2]]));
      for (const auto& [other, agree] : neighbours[t]) {
        const auto wanted = static_cast<signed char>(agree ? sense[t] : -sense[t]);
        if (sense[other] == 0) {
          sense[other] = wanted;
          part.push_back(other);
        } else if (sense[other] != wanted) {
          throw Domain_error("the triangles can't be oriented alike: triangles " +
                                 std::to_string(t + soup_.first_number) + " and " +
                                 std::to_string(other + soup_.first_number) + " contradict each other",
                             {}, {t, other});
        }
      }
    }
    for (const std::size_t t : part) {
      if (area < 0) sense[t] = static_cast<signed char>(-sense[t]);
      if (sense[t] < 0) std::swap(mesh().triangles[t][1], mesh().triangles[t][2]);
    }
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

  void note_dropped(std::size_t n, const std::string& name, const std::string& why)
  {
    if (n > 0) result_.notes.push_back(counted(n, name, name + "s") + " " + why + " left out");
  }

  /// Once each.
  void take_corners()
  {
    std::vector<char> is_corner(mesh().points.size(), false);
    std::size_t dropped = 0;
    for (const std::size_t v : soup_.corners) {
      if (v == none || is_corner[v]) {
        ++dropped;
        continue;
      }
      mesh().corners.push_back(v);
      is_corner[v] = true;
    }
    note_dropped(dropped, "corner", "of no triangle or listed again");
  }

  Element_soup_2<K> soup_;
  Imported_mesh_2<K> result_;
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
