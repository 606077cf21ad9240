// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh of second order in arrays: a mesh and a node in the middle of each of its edges.

#ifndef WEFT_SPATIAL_MESH_QUADRATIC_MESH_3_H
#define WEFT_SPATIAL_MESH_QUADRATIC_MESH_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// A mesh of tetrahedra with 10 nodes, triangles with 6 and lines with 3. Nodes are numbered through: the points of
/// `vertices` first, then `middles`. Elements stand in the order of those of `vertices`.
/// \tparam K a CGAL kernel.
template <class K>
struct Quadratic_mesh_3
{
  using Kernel = K;
  using Point = typename K::Point_3;

  Tetrahedral_mesh_3<K> vertices; ///< the mesh of first order with the same vertices, and all tags

  std::vector<Point> middles;                      ///< nodes between the two ends of an edge of `vertices`
  std::vector<Vertex_location_3> middle_locations; ///< of the part of the domain that they lie on

  std::vector<std::array<std::size_t, 6>> cell_middles;  ///< nodes between corners 01, 12, 02, 03, 13, 23 of each cell
  std::vector<std::array<std::size_t, 3>> facet_middles; ///< between corners 01, 12, 20 of each facet
  std::vector<std::size_t> edge_middles;                 ///< of each edge

  std::size_t number_of_nodes() const { return vertices.points.size() + middles.size(); }

  /// The place of a node.
  const Point& node(std::size_t i) const
  {
    return i < vertices.points.size() ? vertices.points[i] : middles[i - vertices.points.size()];
  }

  /// The nodes of a cell: its corners, then `cell_middles`.
  std::array<std::size_t, 10> cell(std::size_t c) const
  {
    const auto& v = vertices.cells[c];
    const auto& m = cell_middles[c];
    return {v[0], v[1], v[2], v[3], m[0], m[1], m[2], m[3], m[4], m[5]};
  }

  /// The nodes of a facet: its corners, then `facet_middles`.
  std::array<std::size_t, 6> facet(std::size_t f) const
  {
    const auto& v = vertices.facets[f];
    const auto& m = facet_middles[f];
    return {v[0], v[1], v[2], m[0], m[1], m[2]};
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_MESH_QUADRATIC_MESH_3_H
