// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's iteration for the fixed point x = F(x) of Lloyd's iteration or that of ODT (Tournois 2009, sec. 4.2.2): the
// linear system (I - dF) step = F(x) - x, of which each row is multiplied with the diagonal of the energy, so that its
// right side is the negative gradient.

#ifndef WEFT_SOLVE_NEWTON_STEP_H
#define WEFT_SOLVE_NEWTON_STEP_H

#include <weft/energy/coordinates.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// What the optimal position of a point changes by that of another one: `entries[r][c]` of the diagonal times I - dF.
template <std::size_t d>
struct Jacobian_block
{
  std::uint32_t row, column;
  std::array<Coordinates<d>, d> entries;
};

/// Multiplies all blocks with f.
template <std::size_t d>
void scale_blocks(std::vector<Jacobian_block<d>>& blocks, double f)
{
  for (auto& block : blocks)
    for (auto& row : block.entries)
      for (double& x : row) x *= f;
}

/// Adds f times the outer product a b^T.
template <std::size_t d>
void add_outer(std::array<Coordinates<d>, d>& m, double f, const Coordinates<d>& a, const Coordinates<d>& b)
{
  for (std::size_t r = 0; r < d; ++r) add_to(m[r], f * a[r], b);
}

/// Directions in which points may go, as orthonormal bases, one after the other.
template <std::size_t d>
struct Free_directions
{
  std::vector<Coordinates<d>> vectors;
  std::vector<std::size_t> first; ///< of each free point

  template <class To_tangent>
  Free_directions(const std::vector<std::size_t>& free, const To_tangent& to_tangent)
  {
    for (const std::size_t i : free) {
      first.push_back(vectors.size());
      for (std::size_t k = 0; k < d; ++k) {
        Coordinates<d> e{};
        e[k] = 1;
        Coordinates<d> v = to_tangent(i, e);
        for (std::size_t b = first.back(); b < vectors.size(); ++b) add_to(v, -dot(vectors[b], v), vectors[b]);
        const double length = std::sqrt(dot(v, v));
        if (length < least_length) continue;
        for (double& x : v) x /= length;
        vectors.push_back(v);
      }
    }
    first.push_back(vectors.size());
  }

private:
  static constexpr double least_length = 0.1; ///< the longest of d projected unit vectors is longer
};

/// Newton's step of the free points, a row for each; without a finite entry if the system is singular.
/// \param number of each point among the free ones, or -1.
template <std::size_t d, class To_tangent>
Eigen::MatrixXd newton_step(const std::vector<Jacobian_block<d>>& blocks, const std::vector<std::size_t>& free,
                            const std::vector<int>& number, const Eigen::MatrixXd& gradient,
                            const To_tangent& to_tangent)
{
  const Free_directions<d> directions(free, to_tangent);
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& block : blocks) {
    if (number[block.row] < 0 || number[block.column] < 0) continue;
    const auto row = static_cast<std::size_t>(number[block.row]),
               column = static_cast<std::size_t>(number[block.column]);
    for (std::size_t a = directions.first[row]; a < directions.first[row + 1]; ++a)
      for (std::size_t b = directions.first[column]; b < directions.first[column + 1]; ++b) {
        double value = 0;
        for (std::size_t r = 0; r < d; ++r)
          value += directions.vectors[a][r] * dot(block.entries[r], directions.vectors[b]);
        entries.emplace_back(static_cast<int>(a), static_cast<int>(b), value);
      }
  }
  const auto size = static_cast<Eigen::Index>(directions.vectors.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd right(size);
  for (std::size_t k = 0; k < free.size(); ++k)
    for (std::size_t a = directions.first[k]; a < directions.first[k + 1]; ++a) {
      double value = 0;
      for (std::size_t c = 0; c < d; ++c)
        value -= directions.vectors[a][c] * gradient(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c));
      right[static_cast<Eigen::Index>(a)] = value;
    }
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(gradient.rows(), gradient.cols(), HUGE_VAL);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors;
  factors.compute(matrix);
  if (factors.info() != Eigen::Success) return result;
  const Eigen::VectorXd solution = factors.solve(right);
  for (std::size_t k = 0; k < free.size(); ++k) {
    Coordinates<d> step{};
    for (std::size_t a = directions.first[k]; a < directions.first[k + 1]; ++a)
      add_to(step, solution[static_cast<Eigen::Index>(a)], directions.vectors[a]);
    for (std::size_t c = 0; c < d; ++c) result(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = step[c];
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_SOLVE_NEWTON_STEP_H
