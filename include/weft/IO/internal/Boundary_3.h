// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary of a spatial mesh by itself: its vertices numbered anew, for surface formats, which must not hold the
// vertices inside.

#ifndef WEFT_IO_INTERNAL_BOUNDARY_3_H
#define WEFT_IO_INTERNAL_BOUNDARY_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

struct Boundary_3
{
  std::vector<Xyz_3> points;                         ///< in the order of the mesh
  std::vector<std::array<std::size_t, 3>> triangles; ///< the mesh's facets
};

template <class K>
Boundary_3 boundary_of(const Tetrahedral_mesh_3<K>& mesh)
{
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> number(mesh.points.size(), none);
  for (const auto& facet : mesh.facets)
    for (const std::size_t v : facet) number[v] = 0;
  Boundary_3 boundary;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == none) continue;
    number[v] = boundary.points.size();
    boundary.points.push_back(xyz(mesh.points[v]));
  }
  for (const auto& f : mesh.facets) boundary.triangles.push_back({number[f[0]], number[f[1]], number[f[2]]});
  return boundary;
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_BOUNDARY_3_H
