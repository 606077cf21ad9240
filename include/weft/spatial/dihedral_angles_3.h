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
  using namespace internal;
  const Xyz_3 ab = minus(xyz(b), xyz(a)), ac = minus(xyz(c), xyz(a)), ad = minus(xyz(d), xyz(a));
  const Xyz_3 bc = minus(xyz(c), xyz(b)), bd = minus(xyz(d), xyz(b));
  // Outward normals of the facets opposite to a, b, c, d.
  const std::array<Xyz_3, 4> n = {
      {cross_product(bc, bd), cross_product(ad, ac), cross_product(ab, ad), cross_product(ac, ab)}};
  if (!(dot_product(n[3], ad) < 0)) return {1, -1};
  std::array<double, 4> length;
  for (int i = 0; i < 4; ++i) length[i] = norm(n[i]);
  Dihedral_cosines_3 extreme;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 4; ++j) {
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

} // namespace weft

#endif // WEFT_SPATIAL_DIHEDRAL_ANGLES_3_H
