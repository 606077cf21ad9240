// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in arrays as energies see them.

#ifndef WEFT_ENERGY_SIMPLICES_OF_MESH_H
#define WEFT_ENERGY_SIMPLICES_OF_MESH_H

#include <weft/energy/Simplices.h>
#include <weft/errors.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// \throws Option_error unless there is none or a positive number for each point.
inline void require_sizes(const std::vector<double>& sizes, std::size_t points)
{
  if (!sizes.empty() && sizes.size() != points) throw Option_error("sizes must be as many as points");
  if (std::any_of(sizes.begin(), sizes.end(), [](double s) { return !(s > 0); }))
    throw Option_error("sizes must be positive");
}

template <class Mesh, std::size_t n>
void copy_simplices(const Mesh& mesh, const std::vector<std::array<std::size_t, n>>& from, Simplices<n - 1>& to)
{
  for (const auto& p : mesh.points) {
    to.points.emplace_back();
    for (std::size_t k = 0; k + 1 < n; ++k) to.points.back()[k] = CGAL::to_double(p[static_cast<int>(k)]);
  }
  for (const auto& s : from) {
    to.simplices.emplace_back();
    for (std::size_t k = 0; k < n; ++k) to.simplices.back()[k] = static_cast<typename Simplices<n - 1>::Number>(s[k]);
  }
}

/// With neighbours, which triangles across an edge of the mesh aren't.
template <class K>
Simplices<2> simplices_of_mesh(const Triangle_mesh_2<K>& mesh)
{
  using Number = Simplices<2>::Number;
  Simplices<2> result;
  copy_simplices(mesh, mesh.triangles, result);
  result.connect();
  std::vector<std::array<std::size_t, 2>> walls = mesh.edges;
  for (auto& e : walls) std::sort(e.begin(), e.end());
  std::sort(walls.begin(), walls.end());
  for (std::size_t t = 0; t < result.simplices.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<std::size_t, 2> e{mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3]};
      std::sort(e.begin(), e.end());
      if (std::binary_search(walls.begin(), walls.end(), e)) result.neighbors[t][i] = static_cast<Number>(-1);
    }
  return result;
}

template <class K>
Simplices<3> simplices_of_mesh(const Tetrahedral_mesh_3<K>& mesh)
{
  Simplices<3> result;
  copy_simplices(mesh, mesh.cells, result);
  result.connect();
  return result;
}

} // namespace weft::internal

#endif // WEFT_ENERGY_SIMPLICES_OF_MESH_H
