// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bounded Voronoi cells of a constrained Delaunay mesh (Tournois 2009, sec. 2.2.2) as signed pieces of its
// triangles: each triangle gives its vertices kites between vertex, midpoints and circumcenter, and those of a blind
// triangle are clipped at the constraint that blinds it.

#ifndef WEFT_ENERGY_BOUNDED_CELLS_2_H
#define WEFT_ENERGY_BOUNDED_CELLS_2_H

#include <weft/energy/coordinates.h>
#include <weft/energy/Simplices.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// \pre the triangles are constrained Delaunay with `neighbors` set.
class Bounded_cells_2
{
public:
  using Vector = Coordinates<2>;
  using Number = Simplices<2>::Number;

  /// Half a wall between two cells: from the midpoint of an edge towards the circumcenter, positions relative to the
  /// edge's first vertex. `sense` is -1 where the circumcenter lies beyond the edge, and the half counts negative.
  struct Half_wall
  {
    Vector from, to;
    double sense;
  };

  /// Tags the blind triangles (Alg. 3). Plain arithmetic: a wrong tag on a near tie moves a corner by rounding error.
  explicit Bounded_cells_2(const Simplices<2>& mesh) : mesh_(mesh), wall_(mesh.simplices.size(), none)
  {
    for (std::size_t t = 0; t < mesh.simplices.size(); ++t) centers_.push_back(circumcenter(corners(t)));
    for (std::size_t t = 0; t < mesh.simplices.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        if (mesh.neighbors[t][i] != Simplices<2>::none || wall_[t] != none) continue;
        const auto p = corners(t);
        const Vector &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
        if (dot(difference(a, p[i]), difference(b, p[i])) < 0) tag_behind(t, a, b);
      }
  }

  /// The triangle's vertices.
  std::array<Vector, 3> corners(std::size_t t) const
  {
    const auto& s = mesh_.simplices[t];
    return {mesh_.points[s[0]], mesh_.points[s[1]], mesh_.points[s[2]]};
  }

  /// Calls `visit(triangle)` with three corners for each piece of the cell of the triangle's vertex i, relative to that
  /// vertex; clockwise ones count negative.
  template <class Visit>
  void visit_pieces(std::size_t t, std::size_t i, const Visit& visit) const
  {
    const auto p = corners(t);
    const Vector c = difference(centers_[t], p[i]);
    const Vector right = half(difference(p[(i + 1) % 3], p[i])), left = half(difference(p[(i + 2) % 3], p[i]));
    for (const auto& piece : {std::array<Vector, 3>{Vector{0, 0}, right, c}, {Vector{0, 0}, c, left}}) {
      if (wall_[t] == none)
        visit(piece);
      else
        visit_clipped(piece, p[i], walls_[wall_[t]], visit);
    }
  }

  /// The half wall that a triangle adds between the cells of its vertices i and i + 1.
  Half_wall half_wall(std::size_t t, std::size_t i) const
  {
    const auto p = corners(t);
    const Vector edge = difference(p[(i + 1) % 3], p[i]), middle = half(edge);
    Vector c = difference(centers_[t], p[i]);
    const double sense = cross(edge, difference(c, middle)) < 0 ? -1 : 1;
    if (wall_[t] != none) {
      const auto& [a, b] = walls_[wall_[t]];
      const Vector along = difference(b, a);
      const double at_middle = cross(along, difference(moved(p[i], 1, middle), a)),
                   at_center = cross(along, difference(moved(p[i], 1, c), a));
      if (at_center < 0)
        c = at_middle > 0 ? moved(middle, at_middle / (at_middle - at_center), difference(c, middle)) : middle;
    }
    return {middle, c, sense};
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  static Vector half(const Vector& a) { return {a[0] / 2, a[1] / 2}; }

  static Vector circumcenter(const std::array<Vector, 3>& p)
  {
    const Vector b = difference(p[1], p[0]), c = difference(p[2], p[0]);
    const double b2 = dot(b, b), c2 = dot(c, c), f = 0.5 / cross(b, c);
    return {p[0][0] + f * (c[1] * b2 - b[1] * c2), p[0][1] + f * (b[0] * c2 - c[0] * b2)};
  }

  /// Tags the tree of triangles that the constraint from a to b blinds, beginning with one to its left.
  void tag_behind(std::size_t first, const Vector& a, const Vector& b)
  {
    std::vector<std::size_t> stack(1, first);
    while (!stack.empty()) {
      const std::size_t t = stack.back();
      stack.pop_back();
      if (wall_[t] != none) continue;
      wall_[t] = walls_.size();
      for (const Number n : mesh_.neighbors[t])
        if (n != Simplices<2>::none && wall_[n] == none && cross(difference(b, a), difference(centers_[n], a)) < 0)
          stack.push_back(n);
    }
    walls_.push_back({a, b});
  }

  template <class Visit>
  static void visit_clipped(const std::array<Vector, 3>& piece, const Vector& origin,
                            const std::pair<Vector, Vector>& wall, const Visit& visit)
  {
    const Vector along = difference(wall.second, wall.first);
    std::array<double, 3> side;
    for (std::size_t k = 0; k < 3; ++k) side[k] = cross(along, difference(moved(origin, 1, piece[k]), wall.first));
    std::array<Vector, 4> kept;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (side[k] >= 0) kept[n++] = piece[k];
      if ((side[k] > 0 && side[next] < 0) || (side[k] < 0 && side[next] > 0))
        kept[n++] = moved(piece[k], side[k] / (side[k] - side[next]), difference(piece[next], piece[k]));
    }
    for (std::size_t k = 1; k + 1 < n; ++k) visit(std::array<Vector, 3>{kept[0], kept[k], kept[k + 1]});
  }

  const Simplices<2>& mesh_;
  std::vector<Vector> centers_;
  std::vector<std::size_t> wall_;                ///< by triangle, its place in `walls_`
  std::vector<std::pair<Vector, Vector>> walls_; ///< with the blind triangles to their left
};

} // namespace weft::internal

#endif // WEFT_ENERGY_BOUNDED_CELLS_2_H
