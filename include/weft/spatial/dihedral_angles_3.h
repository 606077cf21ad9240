// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extreme dihedral angles of a tetrahedron, as fast as it goes: the innermost measure of optimisation.

#ifndef WEFT_SPATIAL_DIHEDRAL_ANGLES_3_H
#define WEFT_SPATIAL_DIHEDRAL_ANGLES_3_H

#include <weft/internal/coordinates_3.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {

/// Cosines of the extreme dihedral angles of a tetrahedron.
struct Dihedral_cosines_3
{
  double of_smallest = 1; ///< the larger the worse
  double of_largest = -1; ///< the smaller the worse
};

/// The extreme dihedral angles of a tetrahedron; 0 and 180 degrees where a facet is degenerate or the orientation isn't
/// positive. Rounded: angles below 1e-6 degrees can't be told from 0.
template <class Point>
Dihedral_cosines_3 extreme_dihedral_cosines(const Point& a, const Point& b, const Point& c, const Point& d)
{
  using namespace internal;
  const Xyz_3 ab = minus(xyz(b), xyz(a)), ac = minus(xyz(c), xyz(a)), ad = minus(xyz(d), xyz(a));
  const Xyz_3 bc = minus(xyz(c), xyz(b)), bd = minus(xyz(d), xyz(b));
  // Outward normals of the facets opposite to a, b, c, d.
  const std::array<Xyz_3, 4> n = {
      {cross_product(bc, bd), cross_product(ad, ac), cross_product(ab, ad), cross_product(ac, ab)}};
  if (!(dot_product(n[3], ad) < 0)) return {};
  std::array<double, 4> length;
  for (int i = 0; i < 4; ++i) length[i] = norm(n[i]);
  Dihedral_cosines_3 extreme{-1, 1};
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const double product = length[i] * length[j];
      if (!(product > 0)) return {};
      const double cosine = -dot_product(n[i], n[j]) / product;
      extreme.of_smallest = (std::max)(extreme.of_smallest, cosine);
      extreme.of_largest = (std::min)(extreme.of_largest, cosine);
    }
  return extreme;
}

/// Cosine of the smallest dihedral angle of a tetrahedron, see `extreme_dihedral_cosines()`.
template <class Point>
double cosine_of_smallest_dihedral(const Point& a, const Point& b, const Point& c, const Point& d)
{
  return extreme_dihedral_cosines(a, b, c, d).of_smallest;
}

} // namespace weft

#endif // WEFT_SPATIAL_DIHEDRAL_ANGLES_3_H
