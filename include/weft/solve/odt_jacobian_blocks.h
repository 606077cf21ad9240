// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Jacobian of the ODT iteration (Tournois 2009, sec. 4.2.2). With F(x) = x - gradient / diagonal, and the diagonal
// 2 |star| / (d + 1), it follows from second derivatives of volumes; inside it is the one of the thesis.

#ifndef WEFT_SOLVE_ODT_JACOBIAN_BLOCKS_H
#define WEFT_SOLVE_ODT_JACOBIAN_BLOCKS_H

#include <weft/energy/coordinates.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/Simplices.h>
#include <weft/solve/Newton_step.h>

#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Adds f times the derivative of the gradient of a triangle's area by vertex i, by vertex k.
inline void add_second_derivative(std::array<Coordinates<2>, 2>& m, double f, const std::array<Coordinates<2>, 3>&,
                                  std::size_t i, std::size_t k)
{
  if (i == k) return;
  const double half = (k == (i + 1) % 3 ? 0.5 : -0.5) * f;
  m[0][1] += half;
  m[1][0] -= half;
}

/// The same of a tetrahedron's volume: the thesis' x -> x cross (p - q) / 6 with (k, p, q, i) in direct order.
inline void add_second_derivative(std::array<Coordinates<3>, 3>& m, double f, const std::array<Coordinates<3>, 4>& p,
                                  std::size_t i, std::size_t k)
{
  if (i == k) return;
  std::size_t a = 0;
  while (a == i || a == k) ++a;
  std::size_t b = 6 - i - k - a;
  const bool even = ((k > a) + (k > b) + (k > i) + (a > b) + (a > i) + (b > i)) % 2 == 0;
  const auto w = even ? difference(p[a], p[b]) : difference(p[b], p[a]);
  const double sixth = f / 6;
  // x cross w as a matrix.
  m[0][1] += sixth * w[2], m[0][2] -= sixth * w[1];
  m[1][0] -= sixth * w[2], m[1][2] += sixth * w[0];
  m[2][0] += sixth * w[1], m[2][1] -= sixth * w[0];
}

/// The diagonal times I - dF, block by block; those of the same points count together.
/// \param terms the energy of the mesh.
template <std::size_t d>
std::vector<Jacobian_block<d>> odt_jacobian_blocks(const Simplices<d>& mesh, const Energy_terms<d>& terms)
{
  std::vector<Jacobian_block<d>> result;
  result.reserve(mesh.simplices.size() * (d + 1) * (d + 1));
  for (const auto& s : mesh.simplices) {
    const Odt_simplex<d> t(mesh, s);
    for (std::size_t i = 0; i <= d; ++i)
      for (std::size_t k = 0; k <= d; ++k) {
        Jacobian_block<d> block{s[i], s[k], {}};
        add_outer(block.entries, t.scale, t.measure.gradient[i], t.slope[k]);
        add_outer(block.entries, t.scale, t.slope[i], t.measure.gradient[k]);
        add_second_derivative(block.entries, t.scale * t.sum, t.points, i, k);
        double same = 0; // of the slope by its own vertex; minus the factor of the edge by another one
        for (std::size_t j = 0; j <= d; ++j)
          if (j != i) same += t.metric.squared_length[i][j];
        const double twist = t.scale * t.measure.value * 2 * (i == k ? same : -t.metric.squared_length[i][k]);
        for (std::size_t c = 0; c < d; ++c) block.entries[c][c] += twist;
        add_outer(block.entries, -t.curvature / terms.diagonal[s[i]], terms.gradient[s[i]], t.measure.gradient[k]);
        result.push_back(block);
      }
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_SOLVE_ODT_JACOBIAN_BLOCKS_H
