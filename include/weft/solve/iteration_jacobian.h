// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Jacobians of the fixed-point iterations that minimise the energies of a mesh (Tournois 2009, sec. 4.2.2), as
// sparse matrices of Eigen.

#ifndef WEFT_SOLVE_ITERATION_JACOBIAN_H
#define WEFT_SOLVE_ITERATION_JACOBIAN_H

#include <weft/energy/cvt_terms_2.h>
#include <weft/energy/cvt_terms_3.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/simplices_of_mesh.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/solve/cvt_jacobian_blocks.h>
#include <weft/solve/Newton_step.h>
#include <weft/solve/odt_jacobian_blocks.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace weft {
namespace internal {

template <std::size_t d>
Eigen::SparseMatrix<double> jacobian_matrix(const std::vector<Jacobian_block<d>>& blocks,
                                            const std::vector<double>& diagonal)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto at = [](std::size_t point, std::size_t c) { return static_cast<int>(d * point + c); };
  for (std::size_t i = 0; i < d * diagonal.size(); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1);
  for (const auto& block : blocks)
    for (std::size_t r = 0; r < d; ++r)
      for (std::size_t c = 0; c < d; ++c)
        entries.emplace_back(at(block.row, r), at(block.column, c), -block.entries[r][c] / diagonal[block.row]);
  const int size = at(diagonal.size(), 0);
  Eigen::SparseMatrix<double> result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

} // namespace internal

/// The Jacobian of the map from the points of a planar mesh to their optimal positions of ODT, of which row and column
/// 2 i + c belong to coordinate c of point i. Rows of boundary points are those of point - gradient / diagonal. Linear.
template <class K>
Eigen::SparseMatrix<double> odt_jacobian_2(const Triangle_mesh_2<K>& mesh)
{
  const auto simplices = internal::simplices_of_mesh(mesh);
  const auto terms = internal::odt_terms(simplices);
  return internal::jacobian_matrix(internal::odt_jacobian_blocks(simplices, terms), terms.diagonal);
}

/// The same in space (Tournois 2009, sec. 4.2.2, "ODT-Newton"), with 3 i + c for coordinate c of point i.
template <class K>
Eigen::SparseMatrix<double> odt_jacobian_3(const Tetrahedral_mesh_3<K>& mesh)
{
  const auto simplices = internal::simplices_of_mesh(mesh);
  const auto terms = internal::odt_terms(simplices);
  return internal::jacobian_matrix(internal::odt_jacobian_blocks(simplices, terms), terms.diagonal);
}

/// The Jacobian of the map from the points of a planar mesh to the centroids of their bounded Voronoi cells, with
/// density 1: valid for points inside, by moves of all others that leave the domain as it is. Linear.
template <class K>
Eigen::SparseMatrix<double> cvt_jacobian_2(const Triangle_mesh_2<K>& mesh)
{
  const internal::Constant_density density;
  const auto simplices = internal::simplices_of_mesh(mesh);
  const auto terms = internal::cvt_terms(simplices, density);
  return internal::jacobian_matrix(internal::cvt_jacobian_blocks(simplices, terms, density), terms.diagonal);
}

/// The same in space.
template <class K>
Eigen::SparseMatrix<double> cvt_jacobian_3(const Tetrahedral_mesh_3<K>& mesh)
{
  const internal::Constant_density density;
  const auto simplices = internal::simplices_of_mesh(mesh);
  const auto terms = internal::cvt_terms(simplices, density);
  return internal::jacobian_matrix(internal::cvt_jacobian_blocks(simplices, terms, density), terms.diagonal);
}

} // namespace weft

#endif // WEFT_SOLVE_ITERATION_JACOBIAN_H
