// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells of a tetrahedral mesh are on the sides of each facet: found by sorting, from the cells alone.

#ifndef WEFT_SPATIAL_MESH_CELL_FACETS_3_H
#define WEFT_SPATIAL_MESH_CELL_FACETS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// The vertices of an element in increasing order.
template <std::size_t N>
std::array<std::size_t, N> sorted(std::array<std::size_t, N> vertices)
{
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Corners of the facet opposite to corner i of a positively oriented cell, counterclockwise seen from outside the
/// cell.
constexpr std::array<std::array<std::size_t, 3>, 4> outward_facet = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A facet of a cell.
struct Cell_facet_3
{
  std::array<std::size_t, 3> vertices; ///< in increasing order
  std::size_t cell;
  int opposite; ///< corner of the cell that isn't of the facet
};

inline std::array<std::size_t, 3> outward_vertices(const std::array<std::size_t, 4>& cell, int opposite)
{
  const auto& corners = outward_facet[static_cast<std::size_t>(opposite)];
  return {cell[corners[0]], cell[corners[1]], cell[corners[2]]};
}

/// Whether two lists of the same three vertices go around in the same sense.
inline bool same_sense(const std::array<std::size_t, 3>& a, const std::array<std::size_t, 3>& b)
{
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(start + 1) % 3] == a[1];
}

/// All facets of all cells; those of several cells stand beside each other. Vertices of cells must exist. O(n) time
/// where vertices have boundedly many cells: facets are distributed to their first vertices, and sorted there.
inline std::vector<Cell_facet_3> cell_facets(const std::vector<std::array<std::size_t, 4>>& cells)
{
  std::size_t n = 0;
  for (const auto& cell : cells) n = (std::max)(n, 1 + *std::max_element(cell.begin(), cell.end()));
  std::vector<std::size_t> end(n, 0); // of each vertex' facets, once they are all there
  for (const auto& cell : cells)
    for (int i = 0; i < 4; ++i) {
      const auto v = outward_vertices(cell, i);
      ++end[(std::min)({v[0], v[1], v[2]})];
    }
  for (std::size_t v = 0, sum = 0; v < n; ++v) {
    const std::size_t count = end[v];
    end[v] = sum;
    sum += count;
  }
  std::vector<Cell_facet_3> facets(4 * cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int i = 0; i < 4; ++i) {
      const auto vertices = sorted(outward_vertices(cells[c], i));
      facets[end[vertices[0]]++] = {vertices, c, i};
    }
  // Ties between the cells of a facet are broken by their indices.
  const auto is_before = [](const Cell_facet_3& a, const Cell_facet_3& b) {
    if (a.vertices[1] != b.vertices[1]) return a.vertices[1] < b.vertices[1];
    return a.vertices[2] != b.vertices[2] ? a.vertices[2] < b.vertices[2] : a.cell < b.cell;
  };
  for (std::size_t v = 0, begin = 0; v < n; begin = end[v++])
    std::sort(facets.begin() + static_cast<std::ptrdiff_t>(begin), facets.begin() + static_cast<std::ptrdiff_t>(end[v]),
              is_before);
  return facets;
}

/// Calls `visit(first, last)` with the range of entries of each facet.
template <class Visit>
void for_each_facet(const std::vector<Cell_facet_3>& facets, const Visit& visit)
{
  for (auto first = facets.begin(); first != facets.end();) {
    auto last = first + 1;
    while (last != facets.end() && last->vertices == first->vertices) ++last;
    visit(first, last);
    first = last;
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_CELL_FACETS_3_H
