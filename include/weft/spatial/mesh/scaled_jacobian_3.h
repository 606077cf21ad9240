// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the cells of a mesh of second order are from being inverted, by the Bezier coefficients of their Jacobian
// determinants (Johnen, Remacle, Geuzaine, "Geometrical validity of curvilinear finite elements", 2013).

#ifndef WEFT_SPATIAL_MESH_SCALED_JACOBIAN_3_H
#define WEFT_SPATIAL_MESH_SCALED_JACOBIAN_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace internal {

/// The ends of the edges that have the middle nodes of a cell, in their order.
inline constexpr std::array<std::array<std::size_t, 2>, 6> edges_of_cell{
    {{{0, 1}}, {{1, 2}}, {{0, 2}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};

/// A lower bound of the least Jacobian determinant over an upper bound of the greatest, of a tetrahedron with 10 nodes.
///
/// The map is quadratic, so each column of its Jacobian is linear and the determinant cubic: its Bezier coefficients
/// are means of determinants of columns at corners, and it lies between the least and the greatest of them.
inline double scaled_jacobian(const std::array<Xyz_3, 10>& x)
{
  std::array<std::array<Xyz_3, 4>, 4> b; // Bezier points of the map
  for (std::size_t i = 0; i < 4; ++i) b[i][i] = x[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = edges_of_cell[e];
    for (std::size_t k = 0; k < 3; ++k) b[i][j][k] = b[j][i][k] = 2 * x[4 + e][k] - (x[i][k] + x[j][k]) / 2;
  }
  std::array<std::array<Xyz_3, 4>, 3> column; // of the Jacobian, by corner
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) column[i][k] = minus(b[k][i + 1], b[k][0]);
  std::array<double, 64> sum{};
  std::array<int, 64> terms{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) {
      const Xyz_3 normal = cross_product(column[0][k], column[1][l]);
      for (std::size_t m = 0; m < 4; ++m) {
        std::array<std::size_t, 3> corners{k, l, m};
        std::sort(corners.begin(), corners.end());
        const std::size_t place = 16 * corners[0] + 4 * corners[1] + corners[2];
        sum[place] += dot_product(normal, column[2][m]);
        ++terms[place];
      }
    }
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (terms[i] == 0) continue;
    least = (std::min)(least, sum[i] / terms[i]);
    greatest = (std::max)(greatest, sum[i] / terms[i]);
  }
  return greatest > 0 ? least / greatest : -1;
}

} // namespace internal

/// The scaled Jacobian of a cell: its least Jacobian determinant over its greatest, or a little less, since both are
/// bounded. 1 for a straight cell with its nodes in the middle of its edges; a cell isn't inverted anywhere if it is
/// positive.
/// \param cell its number. Constant.
template <class K>
double scaled_jacobian_3(const Quadratic_mesh_3<K>& mesh, std::size_t cell)
{
  const auto nodes = mesh.cell(cell);
  std::array<internal::Xyz_3, 10> x;
  for (std::size_t i = 0; i < 10; ++i) x[i] = internal::xyz(mesh.node(nodes[i]));
  return internal::scaled_jacobian(x);
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_SCALED_JACOBIAN_3_H
