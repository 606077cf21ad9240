// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extreme dihedral angles of a tetrahedron, as fast as it goes: the innermost measure of optimisation.

#ifndef WEFT_SPATIAL_MESH_DIHEDRAL_ANGLES_3_H
#define WEFT_SPATIAL_MESH_DIHEDRAL_ANGLES_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft::internal {

constexpr double radians_per_degree = 3.14159265358979323846 / 180;

/// Cosines of the smallest and the largest dihedral angle of a tetrahedron.
struct Dihedral_cosines_3
{
  double smallest = -1; ///< of the smallest angle, so the larger the worse
  double largest = 1;   ///< of the largest angle, so the smaller the worse
};

/// Cosines of the extreme dihedral angles; those of 0 and 180 degrees where a facet is degenerate or the orientation
/// isn't positive. Rounded: angles below 1e-6 degrees can't be told from 0.
template <class Point>
Dihedral_cosines_3 cosines_of_extreme_dihedrals(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const Xyz_3 ab = minus(xyz(b), xyz(a)), ac = minus(xyz(c), xyz(a)), ad = minus(xyz(d), xyz(a));
  const Xyz_3 bc = minus(xyz(c), xyz(b)), bd = minus(xyz(d), xyz(b));
  // Outward normals of the facets opposite to a, b, c, d.
  const std::array<Xyz_3, 4> n = {
      {cross_product(bc, bd), cross_product(ad, ac), cross_product(ab, ad), cross_product(ac, ab)}};
  if (!(dot_product(n[3], ad) < 0)) return {1, -1};
  std::array<double, 4> length;
  for (std::size_t i = 0; i < 4; ++i) length[i] = norm(n[i]);
  Dihedral_cosines_3 extreme;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double product = length[i] * length[j];
      if (!(product > 0)) return {1, -1};
      const double cosine = -dot_product(n[i], n[j]) / product;
      extreme.smallest = (std::max)(extreme.smallest, cosine);
      extreme.largest = (std::min)(extreme.largest, cosine);
    }
  return extreme;
}

/// Cosine of the smallest dihedral angle of a tetrahedron, so the larger the worse; as above.
template <class Point>
double cosine_of_smallest_dihedral(const Point& a, const Point& b, const Point& c, const Point& d)
{
  return cosines_of_extreme_dihedrals(a, b, c, d).smallest;
}

/// The same of a cell of a triangulation.
template <class Cell_handle>
Dihedral_cosines_3 cosines_of_cell(Cell_handle c)
{
  return cosines_of_extreme_dihedrals(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                      c->vertex(3)->point());
}

/// The angle of a cosine, in degrees; cosines that rounding has brought out of [-1, 1] count as the nearest in it.
inline double degrees_of_cosine(double cosine)
{
  return std::acos((std::max)(-1.0, (std::min)(1.0, cosine))) / radians_per_degree;
}

/// The cosine of an angle in degrees.
inline double cosine_of_degrees(double degrees)
{
  return std::cos(degrees * radians_per_degree);
}

/// Whether all dihedral angles of a cell lie between two angles, whose cosines are given.
template <class Cell_handle>
bool has_dihedrals_between(Cell_handle c, double cosine_of_least, double cosine_of_most)
{
  const Dihedral_cosines_3 angles = cosines_of_cell(c);
  return angles.smallest <= cosine_of_least && angles.largest >= cosine_of_most;
}

/// Dihedral angles of excellent cells, in degrees: vertices among such cells are left alone (Tournois 2009,
/// sec. 3.3.3).
constexpr double smallest_excellent_dihedral = 45,
                 largest_excellent_dihedral = 95; ///< as above

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_DIHEDRAL_ANGLES_3_H
