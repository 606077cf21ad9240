// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell by the ids of its vertices: handles don't outlive a change of the mesh.

#ifndef WEFT_SPATIAL_RESTRICTED_CELL_IDS_3_H
#define WEFT_SPATIAL_RESTRICTED_CELL_IDS_3_H

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft::internal {

/// In increasing order.
using Cell_ids_3 = std::array<int, 4>;

template <class Cell_handle>
Cell_ids_3 ids_of_cell(Cell_handle c)
{
  Cell_ids_3 ids;
  for (std::size_t i = 0; i < 4; ++i) ids[i] = c->vertex(static_cast<int>(i))->id();
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The cell with these vertices; null if there is none, also if there are fewer vertices now.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
typename Restricted::Cell_handle find_cell(const Restricted& mesh, const Cell_ids_3& ids)
{
  std::array<typename Restricted::Vertex_handle, 4> v;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto id = static_cast<std::size_t>(ids[i]);
    if (id >= mesh.vertices().size()) return {};
    v[i] = mesh.vertices()[id];
  }
  typename Restricted::Cell_handle c;
  int i, j, k, l;
  if (!mesh.triangulation().is_cell(v[0], v[1], v[2], v[3], c, i, j, k, l)) return {};
  return c;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_CELL_IDS_3_H
