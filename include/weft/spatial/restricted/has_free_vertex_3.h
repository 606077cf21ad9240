// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a cell of a restricted triangulation can change when vertices that aren't fixed move.

#ifndef WEFT_SPATIAL_RESTRICTED_HAS_FREE_VERTEX_3_H
#define WEFT_SPATIAL_RESTRICTED_HAS_FREE_VERTEX_3_H

namespace weft::internal {

/// Whether a cell has a vertex that may move.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
bool has_free_vertex(const Restricted& mesh, typename Restricted::Cell_handle c)
{
  for (int i = 0; i < 4; ++i)
    if (c->vertex(i)->id() >= 0 && !mesh.is_fixed(c->vertex(i))) return true;
  return false;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_HAS_FREE_VERTEX_3_H
