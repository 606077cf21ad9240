// SPDX-License-Identifier: GPL-3.0-or-later
//
// The graph Laplacian of a mesh as a preconditioner of energies (Chen, Holst, "Efficient mesh optimization schemes
// based on optimal Delaunay triangulations", 2011; Hateley, Wei, Chen, "Fast methods for computing centroidal Voronoi
// tessellations", 2015): it has the diagonal of the fixed-point iteration, and knows how vertices follow each other.

#ifndef WEFT_SOLVE_GRAPH_LAPLACIAN_H
#define WEFT_SOLVE_GRAPH_LAPLACIAN_H

#include <weft/energy/coordinates.h>
#include <weft/energy/Simplices.h>

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Solves with the Laplacian of an energy on the points that are free; all others are held.
///
/// Half of the fixed-point iteration's diagonal is added. Without it, waves longer than a few edges get steps far too
/// long, as defects of the mesh move between any two minima; and few iterations are enough then.
template <std::size_t d>
class Graph_laplacian
{
public:
  /// \param number of each point among the free ones, or -1.
  void set(const Energy_terms<d>& terms, const std::vector<int>& number, int free)
  {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(terms.weights.size());
    for (const auto& w : terms.weights) {
      const int i = number[w.from], j = number[w.to];
      if (i >= 0 && j >= 0) entries.emplace_back((std::max)(i, j), (std::min)(i, j), w.value);
    }
    Matrix off(free, free);
    off.setFromTriplets(entries.begin(), entries.end());
    // Weights beyond the boundary may be negative: such edges don't count.
    entries.clear();
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(free);
    for (int k = 0; k < off.outerSize(); ++k)
      for (Matrix::InnerIterator it(off, k); it; ++it) {
        if (!(it.value() > 0)) continue;
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(it.col()), -it.value());
        diagonal[it.row()] += it.value();
        diagonal[it.col()] += it.value();
      }
    for (const auto& w : terms.weights) { // to points that are held
      const int i = number[w.from], j = number[w.to];
      if ((i >= 0) != (j >= 0)) diagonal[(std::max)(i, j)] += (std::max)(w.value, 0.0);
    }
    for (std::size_t v = 0; v < number.size(); ++v)
      if (number[v] >= 0) entries.emplace_back(number[v], number[v], diagonal[number[v]] + shift * terms.diagonal[v]);
    matrix_.resize(free, free);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    iteration_.setTolerance(tolerance);
    iteration_.compute(matrix_);
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const { return iteration_.solve(right); }

private:
  using Matrix = Eigen::SparseMatrix<double>;

  static constexpr double shift = 0.5; ///< in parts of the diagonal
  static constexpr double tolerance = 1e-2;

  Matrix matrix_; ///< its lower half
  Eigen::ConjugateGradient<Matrix, Eigen::Lower> iteration_;
};

} // namespace weft::internal

#endif // WEFT_SOLVE_GRAPH_LAPLACIAN_H
