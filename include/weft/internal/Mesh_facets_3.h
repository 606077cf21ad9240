// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells of a tetrahedral mesh are on the sides of each facet: found by sorting, from the cells alone.

#ifndef WEFT_INTERNAL_MESH_FACETS_3_H
#define WEFT_INTERNAL_MESH_FACETS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft {
namespace internal {

/// The vertices of an element in increasing order.
template <std::size_t N>
std::array<std::size_t, N> sorted(std::array<std::size_t, N> vertices)
{
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Corners of the facet opposite to corner i of a positively oriented cell, counterclockwise seen from outside the
/// cell.
constexpr std::array<std::array<int, 3>, 4> outward_facet = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

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

/// All facets of all cells; those of several cells stand beside each other. O(n log n) time.
inline std::vector<Cell_facet_3> cell_facets(const std::vector<std::array<std::size_t, 4>>& cells)
{
  std::vector<Cell_facet_3> facets;
  facets.reserve(4 * cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int i = 0; i < 4; ++i) facets.push_back({sorted(outward_vertices(cells[c], i)), c, i});
  // Ties between the cells of a facet are broken by their indices.
  std::sort(facets.begin(), facets.end(), [](const Cell_facet_3& a, const Cell_facet_3& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.cell < b.cell;
  });
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

} // namespace internal
} // namespace weft

#endif // WEFT_INTERNAL_MESH_FACETS_3_H
