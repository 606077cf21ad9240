// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells around a vertex of a spatial triangulation, listed without marks in them, while other threads look at it.

#ifndef WEFT_SPATIAL_RESTRICTED_STAR_ASIDE_3_H
#define WEFT_SPATIAL_RESTRICTED_STAR_ASIDE_3_H

#include <weft/spatial/restricted/Handle_marks.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// Lists the cells around a vertex; `marks` number them in their order. Linear, and faster than what CGAL has for that.
template <class Vertex_handle, class Cell_handle>
void list_star_aside(Vertex_handle v, std::vector<Cell_handle>& star, Handle_marks& marks)
{
  star.assign(1, v->cell());
  marks.clear();
  marks.add(star.front(), 0);
  for (std::size_t k = 0; k < star.size(); ++k)
    for (int i = 0; i < 4; ++i) {
      if (star[k]->vertex(i) == v) continue;
      const Cell_handle n = star[k]->neighbor(i);
      if (marks.add(n, static_cast<int>(star.size()))) star.push_back(n);
    }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_STAR_ASIDE_3_H
