// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar triangle mesh in arrays: what `assemble_mesh_2()` makes of anybody's triangles, `improve_2()` improves and
// the writers take.

#ifndef WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H
#define WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H

#include <weft/planar/mesh/quality_2.h>

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

/// Measures the shape of the triangles. Linear time.
template <class K>
Quality_2 measure_quality_2(const Triangle_mesh_2<K>& mesh)
{
  internal::Quality_gatherer_2 gatherer;
  for (const auto& t : mesh.triangles)
    gatherer.add(internal::Scaled_triangle_2(std::array<internal::Xy_2, 3>{
        internal::xy(mesh.points[t[0]]), internal::xy(mesh.points[t[1]]), internal::xy(mesh.points[t[2]])}));
  Quality_2 quality = gatherer.result();
  quality.vertices = mesh.points.size();
  return quality;
}

} // namespace weft

#endif // WEFT_PLANAR_MESH_TRIANGLE_MESH_2_H
