// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights with which the lifting of a triangulation approximates the paraboloid best (Tournois 2009, sec. 4.1 and
// 4.2.3): for a given triangulation the integral of the squared error is convex in the weights, and its minimum is the
// L2 projection to piecewise linear functions. Needs Eigen 3.

#ifndef WEFT_SOLVE_LEAST_SQUARES_WEIGHTS_H
#define WEFT_SOLVE_LEAST_SQUARES_WEIGHTS_H

#include <weft/energy/Simplices.h>
#include <weft/energy/simplices_of_mesh.h>
#include <weft/energy/weighted_odt_terms.h>
#include <weft/errors.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace weft {
namespace internal {

/// The mass matrix is as well conditioned as stars are alike in volume: a few dozen iterations, whatever its size.
/// Points of no simplex get 0.
/// \param start where to begin; empty: 0.
template <std::size_t d>
std::vector<double> least_squares_weights(const Simplices<d>& mesh, const std::vector<double>& start = {})
{
  using Forms = Barycentric_forms<d>;
  constexpr double tolerance = 1e-12;
  const auto n = static_cast<Eigen::Index>(mesh.points.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n), diagonal = Eigen::VectorXd::Zero(n), guess = right;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(mesh.simplices.size() * (d + 1) * (d + 1));
  for (const auto& s : mesh.simplices) {
    const Lifted_simplex<d> t(mesh, {}, 0, s);
    typename Forms::Form slope;
    t.mean_square(slope);
    for (std::size_t i = 0; i <= d; ++i) {
      double by_weight = 0;
      for (std::size_t j = 0; j <= d; ++j) {
        by_weight += slope[Forms::number(i, j)] / 2;
        const double entry = t.mass * t.unit[i] * t.unit[j] * Forms::means()[Forms::number(i, j)];
        entries.emplace_back(static_cast<int>(s[i]), static_cast<int>(s[j]), entry);
        if (i == j) diagonal[s[i]] += entry;
      }
      right[s[i]] += t.mass * t.unit[i] * by_weight;
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!start.empty()) guess[i] = start[static_cast<std::size_t>(i)];
    if (diagonal[i] == 0) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> iteration;
  iteration.setTolerance(tolerance);
  iteration.compute(matrix);
  const Eigen::VectorXd result = iteration.solveWithGuess(right, guess);
  return std::vector<double>(result.data(), result.data() + n);
}

} // namespace internal

/// Weights of the points of a mesh for which `weighted_odt_energy_3()` with `Lifting_error::squared` is least. They
/// aren't bounded, and the mesh is seldom the regular triangulation of the points with these weights. O(n log n), and
/// a few dozen products with a sparse matrix.
/// \param sizes as of `weighted_odt_energy_3()`.
/// \returns in the unit of squared lengths.
/// \pre cells are positively oriented and not flat.
/// \throws Option_error if sizes are too few or not positive.
template <class K>
std::vector<double> least_squares_weights_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<double>& sizes = {})
{
  internal::require_sizes(sizes, mesh.points.size());
  auto simplices = internal::simplices_of_mesh(mesh);
  simplices.sizes = sizes;
  return internal::least_squares_weights(simplices);
}

/// The same of a planar mesh.
/// \param sizes as of `weighted_odt_energy_2()`.
/// \returns in the unit of squared lengths.
/// \throws Option_error if sizes are too few or not positive.
template <class K>
std::vector<double> least_squares_weights_2(const Triangle_mesh_2<K>& mesh, const std::vector<double>& sizes = {})
{
  internal::require_sizes(sizes, mesh.points.size());
  auto simplices = internal::simplices_of_mesh(mesh);
  simplices.sizes = sizes;
  return internal::least_squares_weights(simplices);
}

} // namespace weft

#endif // WEFT_SOLVE_LEAST_SQUARES_WEIGHTS_H
