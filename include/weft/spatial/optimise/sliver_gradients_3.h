// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the squared circumradius and the volume of a tetrahedron change with one of its vertices (Tournois 2009, sec.
// 3.2.2.2 and 3.2.2.3): the directions in which slivers are perturbed.

#ifndef WEFT_SPATIAL_OPTIMISE_SLIVER_GRADIENTS_3_H
#define WEFT_SPATIAL_OPTIMISE_SLIVER_GRADIENTS_3_H

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>

namespace weft::internal {

/// Gradient of the volume of the tetrahedron v, a, b, c with respect to v; positive whatever the orientation. 0 for
/// a flat one, where it has none.
template <class Point>
auto gradient_of_volume(const Point& v, const Point& a, const Point& b, const Point& c)
{
  auto n = CGAL::cross_product(b - a, c - a) / 6;
  const double side = CGAL::to_double(n * (v - a));
  return (side > 0 ? 1.0 : side < 0 ? -1.0 : 0.0) * n;
}

/// Gradient of the squared circumradius of the tetrahedron v, a, b, c with respect to v. While v moves the circumcenter
/// o can only move along the normal n of abc, and stays as far from v as from a, which gives
/// 2 ((o - a) n / (a - v) n) (o - v). 0 for a flat one.
template <class Point>
auto gradient_of_squared_radius(const Point& v, const Point& a, const Point& b, const Point& c,
                                const Point& circumcenter)
{
  const auto n = CGAL::cross_product(b - a, c - a);
  const double below = CGAL::to_double((a - v) * n);
  const double speed = below == 0 ? 0 : 2 * CGAL::to_double((circumcenter - a) * n) / below;
  return speed * (circumcenter - v);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_SLIVER_GRADIENTS_3_H
