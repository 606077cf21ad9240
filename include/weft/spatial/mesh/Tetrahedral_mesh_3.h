// SPDX-License-Identifier: GPL-3.0-or-later
//
// A finished tetrahedral mesh in arrays: what writers, statistics and users who don't want a triangulation need.

#ifndef WEFT_SPATIAL_MESH_TETRAHEDRAL_MESH_3_H
#define WEFT_SPATIAL_MESH_TETRAHEDRAL_MESH_3_H

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// Where a vertex lies: on the feature vertex, crease, patch or in the subdomain with that index.
struct Vertex_location_3
{
  int dimension = 3; ///< 0 feature vertex, 1 crease, 2 patch, 3 inside
  int index = 0;

  friend bool operator==(const Vertex_location_3& a, const Vertex_location_3& b)
  {
    return a.dimension == b.dimension && a.index == b.index;
  }
  friend bool operator!=(const Vertex_location_3& a, const Vertex_location_3& b) { return !(a == b); }
};

/// A tetrahedral mesh with its boundary, creases and feature vertices; every point is a vertex of a cell.
/// \tparam K a CGAL kernel.
template <class K>
struct Tetrahedral_mesh_3
{
  using Kernel = K;
  using Point = typename K::Point_3;

  std::vector<Point> points;
  std::vector<Vertex_location_3> locations; ///< of the points

  std::vector<std::array<std::size_t, 4>> cells; ///< positively oriented
  std::vector<int> subdomains;                   ///< of the cells, from 1

  std::vector<std::array<std::size_t, 3>> facets; ///< of the boundary, counterclockwise seen from outside
  std::vector<int> patches;                       ///< of the facets, from 0

  std::vector<std::array<std::size_t, 2>> edges; ///< on creases
  std::vector<int> creases;                      ///< of the edges, from 0

  std::vector<std::size_t> corners; ///< feature vertices, in the order of the input's
};

} // namespace weft

#endif // WEFT_SPATIAL_MESH_TETRAHEDRAL_MESH_3_H
