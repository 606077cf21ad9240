// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest points of a segment and of a triangle, in doubles.

#ifndef WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H
#define WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
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

/// A triangle that many points are measured against.
class Measured_triangle_3
{
public:
  Measured_triangle_3(const Xyz_3& a, const Xyz_3& b, const Xyz_3& c) : a_(a), ab_(minus(b, a)), ac_(minus(c, a))
  {
    normal_ = cross_product(ab_, ac_);
    square_ = dot_product(normal_, normal_);
  }

  /// Squared distance to the nearest point of the triangle, by weights as in `nearest_point_on_triangle()`.
  double squared_distance(const Xyz_3& p) const
  {
    const Xyz_3 ap = minus(p, a_), turned = cross_product(ap, normal_);
    const double w = dot_product(ab_, turned), v = -dot_product(ac_, turned), u = square_ - v - w;
    if (square_ > 0 && u >= 0 && v >= 0 && w >= 0) {
      const double height = dot_product(ap, normal_);
      return height * height / square_;
    }
    double least = std::numeric_limits<double>::infinity();
    if (!(square_ > 0) || w < 0) least = (std::min)(least, squared_distance_to_edge(ap, ab_));
    if (!(square_ > 0) || v < 0) least = (std::min)(least, squared_distance_to_edge(ap, ac_));
    if (!(square_ > 0) || u < 0) least = (std::min)(least, squared_distance_to_edge(minus(ap, ab_), minus(ac_, ab_)));
    return least;
  }

private:
  static double squared_distance_to_edge(const Xyz_3& from, const Xyz_3& edge)
  {
    const double length = dot_product(edge, edge), along = dot_product(from, edge);
    if (!(along > 0)) return dot_product(from, from);
    const double t = along >= length ? 1 : along / length;
    const Xyz_3 rest{{from[0] - t * edge[0], from[1] - t * edge[1], from[2] - t * edge[2]}};
    return dot_product(rest, rest);
  }

  Xyz_3 a_, ab_, ac_, normal_;
  double square_; ///< of the length of the normal
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_NEAREST_POINT_3_H
