// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Jacobian of Lloyd's iteration (Du, Emelianenko, "Acceleration schemes for computing centroidal Voronoi
// tessellations", 2006; Tournois 2009, sec. 4.2.2): a centroid changes as the walls of its cell move. Where x_j moves,
// a point y of the wall between x_i and x_j moves at (x_j - y) / |x_i - x_j| times the velocity of x_j out of the cell
// of x_i.

#ifndef WEFT_SOLVE_CVT_JACOBIAN_BLOCKS_H
#define WEFT_SOLVE_CVT_JACOBIAN_BLOCKS_H

#include <weft/energy/Bounded_cells_2.h>
#include <weft/energy/coordinates.h>
#include <weft/energy/cvt_terms_3.h>
#include <weft/energy/quadrature_rules.h>
#include <weft/energy/Simplices.h>
#include <weft/solve/Newton_step.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::internal {

/// Collects what walls between two cells add.
template <std::size_t d>
class Wall_jacobian
{
public:
  using Vector = Coordinates<d>;
  using Block = Jacobian_block<d>;

  /// \param terms the energy; the centroid is the point less gradient / diagonal, but for what moves of the boundary
  /// add.
  Wall_jacobian(const Simplices<d>& mesh, const Energy_terms<d>& terms, std::vector<Block>& blocks)
      : mesh_(mesh), terms_(terms), blocks_(blocks)
  {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      Block block{static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(v), {}};
      for (std::size_t c = 0; c < d; ++c) block.entries[c][c] = terms.diagonal[v];
      blocks.push_back(block);
    }
  }

  void begin(std::uint32_t i, std::uint32_t j)
  {
    at_ = {Block{i, i, {}}, Block{i, j, {}}, Block{j, i, {}}, Block{j, j, {}}};
    const auto edge = difference(mesh_.points[j], mesh_.points[i]);
    length_ = std::sqrt(dot(edge, edge));
  }

  /// A point of the wall, with the mass that it stands for.
  void add(const Vector& y, double mass)
  {
    for (std::size_t a = 0; a < 2; ++a) {
      const auto row = at_[2 * a].row;
      const Vector& x = mesh_.points[row];
      const Vector centroid = moved(x, -1 / terms_.diagonal[row], terms_.gradient[row]);
      const Vector lever = difference(y, centroid);
      for (std::size_t b = 0; b < 2; ++b) {
        Block& block = at_[2 * a + b];
        const Vector way = difference(y, mesh_.points[block.column]);
        add_outer(block.entries, (a == b ? -2 : 2) * mass / length_, lever, way);
      }
    }
  }

  void end() { blocks_.insert(blocks_.end(), at_.begin(), at_.end()); }

private:
  const Simplices<d>& mesh_;
  const Energy_terms<d>& terms_;
  std::vector<Block>& blocks_;
  std::array<Block, 4> at_;
  double length_ = 1;
};

/// The diagonal times I - dF, block by block; those of the same points count together. Exact for densities of the first
/// degree.
template <class Density>
std::vector<Jacobian_block<2>> cvt_jacobian_blocks(const Simplices<2>& mesh, const Energy_terms<2>& terms,
                                                   const Density& density)
{
  std::vector<Jacobian_block<2>> result;
  Wall_jacobian<2> walls(mesh, terms, result);
  const Bounded_cells_2 cells(mesh);
  static const double gauss = 0.5 / std::sqrt(3.0);
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = mesh.simplices[t][i];
      walls.begin(v, mesh.simplices[t][(i + 1) % 3]);
      const auto wall = cells.half_wall(t, i);
      const auto way = difference(wall.to, wall.from);
      for (const double part : {0.5 - gauss, 0.5 + gauss}) {
        const auto y = moved(mesh.points[v], 1, moved(wall.from, part, way));
        walls.add(y, wall.sense * std::sqrt(dot(way, way)) / 2 * density(y));
      }
      walls.end();
    }
  return result;
}

/// The same in space, for points whose cells don't reach the boundary.
template <class Density>
std::vector<Jacobian_block<3>> cvt_jacobian_blocks(const Simplices<3>& mesh, const Energy_terms<3>& terms,
                                                   const Density& density)
{
  using Vector = Coordinates<3>;
  std::vector<Jacobian_block<3>> result;
  Wall_jacobian<3> walls(mesh, terms, result);
  for (const auto& s : mesh.simplices) {
    const Vector origin = mesh.points[s[0]];
    const Tetrahedron_centers_3 at({origin, mesh.points[s[1]], mesh.points[s[2]], mesh.points[s[3]]});
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        walls.begin(s[i], s[j]);
        const Vector m = at.middle(i, j), edge = difference(at.corners[j], at.corners[i]);
        for (std::size_t f = 0; f < 4; ++f) {
          if (f == i || f == j) continue;
          const std::size_t k = 6 - i - j - f;
          const bool even = ((i > j) + (i > k) + (i > f) + (j > k) + (j > f) + (k > f)) % 2 == 0;
          const Vector turn = cross(difference(at.facets[f], m), difference(at.cell, m));
          const double area = (even ? 0.5 : -0.5) * dot(turn, edge) / std::sqrt(dot(edge, edge));
          visit_triangle_points([&](const std::array<double, 3>& b, double weight) {
            const auto y = moved(combine<3>(std::array<Vector, 3>{m, at.facets[f], at.cell}, b), 1, origin);
            walls.add(y, weight * area * density(y));
          });
        }
        walls.end();
      }
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_SOLVE_CVT_JACOBIAN_BLOCKS_H
