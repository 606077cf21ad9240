// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pieces of a surface that are closed in themselves: what hangs together across edges with two triangles, and has an
// even number of triangles at all others. They bound something whatever else they cross, and have an outer side.

#ifndef WEFT_SPATIAL_SURFACE_CLOSED_PIECES_3_H
#define WEFT_SPATIAL_SURFACE_CLOSED_PIECES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// Which side of a triangle is the outer one of its piece.
enum class Piece_side
{
  unknown, ///< the piece isn't closed, or is one-sided
  before,
  behind
};

/// Of each triangle.
template <class K>
std::vector<Piece_side> sides_of_closed_pieces(const Triangle_surface_3<K>& surface)
{
  const std::size_t n = surface.triangles.size();
  const auto sides = sorted_sides(surface.triangles);
  Disjoint_parts pieces(n);
  std::vector<std::vector<std::pair<std::size_t, bool>>> beside(n); // and whether it is turned like this one
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first != 2) return;
    const auto second = first + 1;
    pieces.unite(first->triangle, second->triangle);
    beside[first->triangle].emplace_back(second->triangle, first->forward != second->forward);
    beside[second->triangle].emplace_back(first->triangle, first->forward != second->forward);
  });
  std::vector<bool> is_closed(n, true); // by the number that stands for a piece
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first == 2) return;
    std::map<std::size_t, int> count;
    for (auto s = first; s != last; ++s) ++count[pieces.find(s->triangle)];
    for (const auto& [piece, number] : count)
      if (number % 2 == 1) is_closed[piece] = false;
  });
  std::vector<int> turn(n, 0); // 1 or -1: against the first triangle of the piece
  std::vector<double> volume(n, 0);
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (turn[seed] != 0) continue;
    const std::size_t piece = pieces.find(seed);
    const Xyz_3 origin = xyz(surface.points[surface.triangles[seed][0]]);
    std::vector<std::size_t> pending = {seed};
    turn[seed] = 1;
    while (!pending.empty()) {
      const std::size_t t = pending.back();
      pending.pop_back();
      const auto& [a, b, c] = surface.triangles[t];
      volume[piece] += turn[t] * dot_product(minus(xyz(surface.points[a]), origin),
                                             cross_product(minus(xyz(surface.points[b]), origin),
                                                           minus(xyz(surface.points[c]), origin)));
      for (const auto& [next, is_alike] : beside[t]) {
        const int expected = is_alike ? turn[t] : -turn[t];
        if (turn[next] == 0) {
          turn[next] = expected;
          pending.push_back(next);
        } else if (turn[next] != expected) {
          is_closed[piece] = false;
        }
      }
    }
  }
  std::vector<Piece_side> result(n, Piece_side::unknown);
  for (std::size_t t = 0; t < n; ++t)
    if (const std::size_t piece = pieces.find(t); is_closed[piece] && volume[piece] != 0)
      result[t] = turn[t] * volume[piece] > 0 ? Piece_side::before : Piece_side::behind;
  return result;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_CLOSED_PIECES_3_H
