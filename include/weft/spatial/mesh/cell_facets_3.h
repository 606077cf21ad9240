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

/// Facets are found by their first vertices, the smallest ones: a cell has three facets at its smallest vertex, and one
/// at the next.
class Facets_by_first_vertex
{
public:
  /// \param cells whose vertices must exist; has to outlive this.
  explicit Facets_by_first_vertex(const std::vector<std::array<std::size_t, 4>>& cells) : cells_(cells)
  {
    for (const auto& cell : cells) {
      const auto [first, second] = smallest(cell);
      if (second >= counts_.size()) counts_.resize(second + 1, 0);
      counts_[first] += 3;
      ++counts_[second];
    }
  }

  std::size_t vertices() const { return counts_.size(); } ///< some more may be no facet's first
  /// How many facets have v as their first vertex; each side counts.
  std::size_t count(std::size_t v) const { return counts_[v]; }

  /// The facets whose first vertices are in [begin, end), in order. O(n + m log k) time for n cells, m facets and k at
  /// a vertex.
  std::vector<Cell_facet_3> between(std::size_t begin, std::size_t end) const
  {
    std::vector<std::size_t> last(end - begin, 0); // of each vertex' facets, once they are all there
    std::size_t sum = 0;
    for (std::size_t v = begin; v < end; ++v) {
      last[v - begin] = sum;
      sum += counts_[v];
    }
    const auto is_in = [&](std::size_t v) { return v >= begin && v < end; };
    std::vector<Cell_facet_3> facets(sum);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto [first, second] = smallest(cells_[c]);
      if (!is_in(first) && !is_in(second)) continue;
      for (int i = 0; i < 4; ++i) {
        const auto vertices = sorted(outward_vertices(cells_[c], i));
        if (is_in(vertices[0])) facets[last[vertices[0] - begin]++] = {vertices, c, i};
      }
    }
    // Ties between the cells of a facet are broken by their indices.
    const auto is_before = [](const Cell_facet_3& a, const Cell_facet_3& b) {
      if (a.vertices[1] != b.vertices[1]) return a.vertices[1] < b.vertices[1];
      return a.vertices[2] != b.vertices[2] ? a.vertices[2] < b.vertices[2] : a.cell < b.cell;
    };
    const auto at = [&](std::size_t i) { return facets.begin() + static_cast<std::ptrdiff_t>(i); };
    for (std::size_t v = 0, from = 0; v < last.size(); from = last[v++]) std::sort(at(from), at(last[v]), is_before);
    return facets;
  }

private:
  /// The smallest vertex of a cell and the next.
  static std::array<std::size_t, 2> smallest(const std::array<std::size_t, 4>& cell)
  {
    const auto a = std::minmax(cell[0], cell[1]), b = std::minmax(cell[2], cell[3]);
    if (a.first < b.first) return {a.first, (std::min)(a.second, b.first)};
    return {b.first, (std::min)(b.second, a.first)};
  }

  const std::vector<std::array<std::size_t, 4>>& cells_;
  std::vector<std::size_t> counts_;
};

/// All facets of all cells; those of several cells stand beside each other. Vertices of cells must exist. O(n) time
/// where vertices have boundedly many cells: facets are distributed to their first vertices, and sorted there.
inline std::vector<Cell_facet_3> cell_facets(const std::vector<std::array<std::size_t, 4>>& cells)
{
  const Facets_by_first_vertex facets(cells);
  return facets.between(0, facets.vertices());
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

/// The same for the facets of cells, in the order of `cell_facets()` but with an eighth of its memory: it goes through
/// the cells eight times.
template <class Visit>
void for_each_facet(const std::vector<std::array<std::size_t, 4>>& cells, const Visit& visit)
{
  constexpr std::size_t blocks = 8;
  const Facets_by_first_vertex facets(cells);
  const std::size_t least = 4 * cells.size() / blocks;
  for (std::size_t begin = 0, end = 0; begin < facets.vertices(); begin = end) {
    for (std::size_t sum = 0; end < facets.vertices() && sum <= least; ++end) sum += facets.count(end);
    for_each_facet(facets.between(begin, end), visit);
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_CELL_FACETS_3_H
