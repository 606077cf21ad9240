// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the triangles of a surface fit together, worked out on index arrays so that surfaces of any defect can be looked
// at: the sides of the triangles sorted into edges, the neighbours across edges with two sides, and components.

#ifndef WEFT_SPATIAL_SURFACE_SURFACE_TOPOLOGY_3_H
#define WEFT_SPATIAL_SURFACE_SURFACE_TOPOLOGY_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace weft::internal {

/// A surface that is being checked. Triangles that come from polygons remember them, so that complaints name the
/// caller's facets.
template <class K>
struct Triangle_surface_3
{
  std::vector<typename K::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::size_t> origins; ///< the caller's facet of each triangle; empty: the triangle itself

  std::size_t origin(std::size_t triangle) const { return origins.empty() ? triangle : origins[triangle]; }
};

/// Side number `side` of a triangle, from its vertex of that number to the next.
struct Surface_side_3
{
  std::size_t low, high; ///< its two vertices, the smaller index first
  std::size_t triangle;
  std::size_t side;
  bool forward; ///< runs from low to high
};

/// All sides of all triangles, those of one edge next to each other; edges in the order of their vertices. O(n) for n
/// triangles if vertices have few of them: sides are dealt to their lower vertices before they are sorted.
inline std::vector<Surface_side_3> sorted_sides(const std::vector<std::array<std::size_t, 3>>& triangles)
{
  std::size_t vertices = 0;
  for (const auto& triangle : triangles)
    for (const std::size_t v : triangle) vertices = (std::max)(vertices, v + 1);
  std::vector<std::size_t> start(vertices + 1, 0);
  for (const auto& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) ++start[(std::min)(triangle[i], triangle[(i + 1) % 3]) + 1];
  for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  std::vector<Surface_side_3> sides(3 * triangles.size());
  std::vector<std::size_t> end(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(vertices));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = triangles[t][i], to = triangles[t][(i + 1) % 3], low = (std::min)(from, to);
      sides[end[low]++] = {low, (std::max)(from, to), t, i, from < to};
    }
  const auto at = [&](std::size_t i) { return sides.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t v = 0; v < vertices; ++v)
    std::sort(at(start[v]), at(start[v + 1]), [](const Surface_side_3& a, const Surface_side_3& b) {
      return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
    });
  return sides;
}

/// Calls `visit(first, last)` for the sides of each edge.
/// \tparam Side has `low` and `high` as Surface_side_3 does.
/// \param sides those of one edge next to each other.
template <class Side, class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit)
{
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->low == first->low && last->high == first->high) ++last;
    visit(first, last);
    first = last;
  }
}

/// Calls `visit(triangle, other, from, to)` where a side of a triangle runs from one vertex to another, and one of a
/// triangle before it the other way; of several such the last. In the order of the triangles and their sides.
template <class Visit>
void visit_opposite_sides(const std::vector<std::array<std::size_t, 3>>& triangles, const Visit& visit)
{
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> triangle_of_side;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      const auto other = triangle_of_side.find({to, from});
      if (other == triangle_of_side.end())
        triangle_of_side[{from, to}] = t;
      else
        visit(t, other->second, from, to);
    }
}

/// What lies across a side of a triangle.
struct Surface_neighbour_3
{
  std::size_t triangle;
  bool consistent; ///< both triangles are oriented alike
};
using Surface_neighbours_3 = std::vector<std::array<Surface_neighbour_3, 3>>;

/// The neighbours of all triangles.
/// \pre Every edge has two sides.
inline Surface_neighbours_3 surface_neighbours(std::size_t number_of_triangles,
                                               const std::vector<Surface_side_3>& sides)
{
  Surface_neighbours_3 neighbours(number_of_triangles);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Surface_side_3 &a = sides[i], &b = sides[i + 1];
    neighbours[a.triangle][a.side] = {b.triangle, a.forward != b.forward};
    neighbours[b.triangle][b.side] = {a.triangle, a.forward != b.forward};
  }
  return neighbours;
}

/// Numbers of the components of triangles that hang together across the sides for which `connects(triangle, side)`
/// holds, and how many there are. Components are numbered by their first triangle.
template <class Connects>
std::pair<std::vector<int>, int> surface_components(const Surface_neighbours_3& neighbours, const Connects& connects)
{
  std::vector<int> component(neighbours.size(), -1);
  std::vector<std::size_t> pending;
  int count = 0;
  for (std::size_t seed = 0; seed < neighbours.size(); ++seed) {
    if (component[seed] >= 0) continue;
    component[seed] = count;
    pending.push_back(seed);
    while (!pending.empty()) {
      const std::size_t t = pending.back();
      pending.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = neighbours[t][i].triangle;
        if (component[next] >= 0 || !connects(t, i)) continue;
        component[next] = count;
        pending.push_back(next);
      }
    }
    ++count;
  }
  return {std::move(component), count};
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_SURFACE_TOPOLOGY_3_H
