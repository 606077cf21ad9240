// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest points of a segment and of a triangle, in doubles.

#ifndef WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H
#define WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <limits>

namespace weft::internal {

template <class Point>
Xyz_3 difference(const Point& a, const Point& b)
{
  return {{a.x() - b.x(), a.y() - b.y(), a.z() - b.z()}};
}

/// Nearest point of the segment ab to p, rounded; an end where it is one.
template <class Point>
Point nearest_point_on_segment(const Point& p, const Point& a, const Point& b)
{
  const Xyz_3 ab = difference(b, a);
  const double length = dot_product(ab, ab), along = dot_product(difference(p, a), ab);
  if (!(along > 0)) return a;
  if (along >= length) return b;
  const double t = along / length;
  return Point(a.x() + t * ab[0], a.y() + t * ab[1], a.z() + t * ab[2]);
}

/// Nearest point of the triangle abc to p, a rounded mean of the corners. By cross products: products of edge lengths,
/// as in Ericson's "Real-Time Collision Detection" (2005, sec. 5.1.5), lose all digits in needles of aspect 1e6.
template <class Point>
Point nearest_point_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c)
{
  const Xyz_3 ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
  const Xyz_3 n = cross_product(ab, ac), turned = cross_product(ap, n);
  const double square = dot_product(n, n), w = dot_product(ab, turned), v = -dot_product(ac, turned);
  const double u = square - v - w; // weights of the corners; negative: beyond the opposite edge
  if (square > 0 && u >= 0 && v >= 0 && w >= 0) {
    const double s = v / square, t = w / square;
    return Point(a.x() + s * ab[0] + t * ac[0], a.y() + s * ab[1] + t * ac[1], a.z() + s * ab[2] + t * ac[2]);
  }
  Point best = a;
  double least = std::numeric_limits<double>::infinity();
  const auto try_edge = [&](double weight, const Point& from, const Point& to) {
    if (square > 0 && !(weight < 0)) return;
    const Point x = nearest_point_on_segment(p, from, to);
    const Xyz_3 d = difference(x, p);
    const double squared = dot_product(d, d);
    if (squared < least) best = x, least = squared;
  };
  try_edge(w, a, b), try_edge(v, a, c), try_edge(u, b, c);
  return best;
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H
