// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar triangle mesh in arrays: what `assemble_mesh_2()` returns, `improve_2()` improves and the writers take.

#ifndef WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H
#define WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// A triangle mesh with its constraints; every point is a vertex of a triangle.
/// \tparam K a CGAL kernel.
template <class K>
struct Triangle_mesh_2
{
  using Kernel = K;
  using Geom_traits = K; ///< by the name that triangulations have for it, so that writers take both
  using Point = typename K::Point_2;

  std::vector<Point> points;

  std::vector<std::array<std::size_t, 3>> triangles; ///< counterclockwise
  std::vector<int> regions;                          ///< tag of each triangle

  /// Edges of the boundary and between regions, and others that have to stay.
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<int> edge_tags; ///< of the edges, 0 where the input has none

  std::vector<std::size_t> corners; ///< vertices that stay where they are, whatever the edges there are like
};

} // namespace weft

#endif // WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H
