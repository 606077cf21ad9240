// SPDX-License-Identifier: GPL-3.0-or-later
//
// The blindness predicate of bounded Voronoi diagrams, and the two points that the corners of their cells are made
// of (Tournois 2009, sec. 2.2.2). A triangle is blinded by a segment when its circumcenter lies strictly on the other
// side of the segment's line. The predicate is exact and never constructs the circumcenter: it evaluates the sign of
// one polynomial of degree 4, first in double with an error bound, then in rationals. The constructions round, but
// turn to rationals where plain double arithmetic would lose more than about 11 digits, so that a corner is
// accurate for needle-like triangles too.

#ifndef WEFT_PLANAR_TRIANGULATION_BLIND_TRIANGLE_2_H
#define WEFT_PLANAR_TRIANGULATION_BLIND_TRIANGLE_2_H

#include <algorithm>
#include <CGAL/Algebraic_structure_traits.h>
#include <CGAL/enum.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <cmath>
#include <type_traits>

namespace weft::internal {

/// Number types that need no filter of ours: rationals, or lazy ones that filter themselves.
template <class FT>
inline constexpr bool is_exact_v = CGAL::Algebraic_structure_traits<FT>::Is_exact::value;

/// A vector with the sums of the absolute values of the terms behind it, which bound what rounding may have done.
template <class T>
struct Vector_with_bound
{
  T x, y;
  T bound; ///< of |x| + |y|, before cancellation
};

/// Circumcenter of the triangle 0, b, c as a fraction.
template <class T>
struct Circumcenter_fraction
{
  Vector_with_bound<T> numerator;
  T denominator, denominator_bound;
};

template <class T>
Circumcenter_fraction<T> circumcenter_fraction(const T& bx, const T& by, const T& cx, const T& cy)
{
  using CGAL::abs;
  const T b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {{cy * b2 - by * c2, bx * c2 - cx * b2, (abs(cy) + abs(cx)) * b2 + (abs(by) + abs(bx)) * c2},
          T(2) * (bx * cy - by * cx),
          T(2) * (abs(bx * cy) + abs(by * cx))};
}

/// Where the bisector of p, q meets the line from s to t, as a fraction of the way from s to t.
template <class T>
struct Bisector_fraction
{
  T numerator, numerator_bound, denominator, denominator_bound;
};

/// From the differences q-p, p-s, q-s, t-s.
template <class T>
Bisector_fraction<T> bisector_fraction(const T& dx, const T& dy, const T& px, const T& py, const T& qx, const T& qy,
                                       const T& tx, const T& ty)
{
  using CGAL::abs;
  return {dx * (px + qx) + dy * (py + qy), abs(dx) * (abs(px) + abs(qx)) + abs(dy) * (abs(py) + abs(qy)),
          T(2) * (tx * dx + ty * dy), T(2) * (abs(tx * dx) + abs(ty * dy))};
}

/// True when at most about four of the sixteen digits were cancelled and nothing over- or underflowed.
inline bool is_accurate(double value, double bound)
{
  return std::abs(value) > 1e-290 && bound < 1e290 && bound <= 1e4 * std::abs(value);
}

/// Orientation of (s, t, circumcenter of a, b, c) times that of (a, b, c), from differences: b-a, c-a, s-a, t-s.
template <class T>
T circumcenter_side(const T& bx, const T& by, const T& cx, const T& cy, const T& sx, const T& sy, const T& tx,
                    const T& ty, T& bound)
{
  using CGAL::abs;
  const Circumcenter_fraction<T> u = circumcenter_fraction(bx, by, cx, cy);
  bound = (abs(tx) + abs(ty)) * u.numerator.bound + u.denominator_bound * (abs(tx * sy) + abs(ty * sx));
  return tx * (u.numerator.y - u.denominator * sy) - ty * (u.numerator.x - u.denominator * sx);
}

template <class T, class Point>
T circumcenter_side(const Point& a, const Point& b, const Point& c, const Point& s, const Point& t, T& bound)
{
  const T ax(a.x()), ay(a.y()), sx(s.x()), sy(s.y());
  return circumcenter_side<T>(T(b.x()) - ax, T(b.y()) - ay, T(c.x()) - ax, T(c.y()) - ay, sx - ax, sy - ay,
                              T(t.x()) - sx, T(t.y()) - sy, bound);
}

/// The circumcenter of a, b, c; false when T is double and too many digits are lost.
template <class T, class Point>
bool circumcenter_coordinates(const Point& a, const Point& b, const Point& c, T& x, T& y)
{
  const T ax(a.x()), ay(a.y());
  const auto u = circumcenter_fraction<T>(T(b.x()) - ax, T(b.y()) - ay, T(c.x()) - ax, T(c.y()) - ay);
  if constexpr (std::is_same_v<T, double>) {
    if (!is_accurate(u.denominator, u.denominator_bound)) return false;
    if (!is_accurate(std::abs(u.numerator.x) + std::abs(u.numerator.y), u.numerator.bound)) return false;
  }
  x = ax + u.numerator.x / u.denominator;
  y = ay + u.numerator.y / u.denominator;
  return true;
}

/// The point of the segment s, t that is as far from p as from q; false as above.
template <class T, class Point>
bool bisector_coordinates(const Point& p, const Point& q, const Point& s, const Point& t, T& x, T& y)
{
  const T sx(s.x()), sy(s.y()), tx = T(t.x()) - sx, ty = T(t.y()) - sy;
  const T px(p.x()), py(p.y()), qx(q.x()), qy(q.y());
  const auto u = bisector_fraction<T>(qx - px, qy - py, px - sx, py - sy, qx - sx, qy - sy, tx, ty);
  if constexpr (std::is_same_v<T, double>) {
    // A small numerator may well be cancelled: the corner is then near s and its error small against p and q.
    if (!is_accurate(u.denominator, u.denominator_bound) || !is_accurate(u.denominator, u.numerator_bound))
      return false;
  }
  // The corner is known to lie on the segment; rounding must not carry it past an end.
  const T fraction = (std::max)(T(0), (std::min)(T(1), T(u.numerator / u.denominator)));
  x = sx + fraction * tx;
  y = sy + fraction * ty;
  return true;
}

/// Runs `compute(x, y)` in double, in rationals where that returns false, or in FT alone when that is exact.
template <class K, class Compute>
typename K::Point_2 construct_accurately(const Compute& compute)
{
  using FT = typename K::FT;
  if constexpr (is_exact_v<FT>) {
    FT x, y;
    compute(x, y);
    return typename K::Point_2(x, y);
  } else {
    double x, y;
    if (!compute(x, y)) {
      CGAL::Exact_rational exact_x, exact_y;
      compute(exact_x, exact_y);
      x = CGAL::to_double(exact_x);
      y = CGAL::to_double(exact_y);
    }
    return typename K::Point_2(FT(x), FT(y));
  }
}

/// On which side of the oriented line from s to t the circumcenter of the triangle a, b, c lies.
/// Exact for every kernel whose numbers are exact or convert to double without loss; Tournois 2009, sec. 2.2.2.
/// \pre a, b, c are not collinear and s differs from t.
template <class K>
struct Side_of_circumcenter_2
{
  using Point = typename K::Point_2;

  CGAL::Oriented_side operator()(const Point& a, const Point& b, const Point& c, const Point& s, const Point& t) const
  {
    return typename K::Orientation_2()(a, b, c) == CGAL::COUNTERCLOCKWISE ? of_counterclockwise(a, b, c, s, t)
                                                                          : of_counterclockwise(a, c, b, s, t);
  }

  /// The same when a, b, c are known to be in counterclockwise order.
  CGAL::Oriented_side of_counterclockwise(const Point& a, const Point& b, const Point& c, const Point& s,
                                          const Point& t) const
  {
    if constexpr (is_exact_v<typename K::FT>) {
      return exact_side<typename K::FT>(a, b, c, s, t);
    } else {
      // At most 12 roundings lie behind each term: an error below 12 * 2^-53 * bound, itself rounded alike. The range
      // keeps what underflows (times at most 1e150) far below that.
      double bound;
      const double side = circumcenter_side<double>(a, b, c, s, t, bound);
      const double range =
          (std::max)({std::abs(double(b.x()) - double(a.x())), std::abs(double(b.y()) - double(a.y())),
                      std::abs(double(c.x()) - double(a.x())), std::abs(double(c.y()) - double(a.y())),
                      std::abs(double(s.x()) - double(a.x())), std::abs(double(s.y()) - double(a.y())),
                      std::abs(double(t.x()) - double(s.x())), std::abs(double(t.y()) - double(s.y()))});
      if (range < 1e50 && bound > 1e-100 && std::abs(side) > 1e-14 * bound)
        return side > 0 ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
      return exact_side<CGAL::Exact_rational>(a, b, c, s, t);
    }
  }

private:
  template <class Exact>
  CGAL::Oriented_side exact_side(const Point& a, const Point& b, const Point& c, const Point& s, const Point& t) const
  {
    Exact bound;
    return CGAL::sign(circumcenter_side<Exact>(a, b, c, s, t, bound));
  }
};

/// Whether the segment s, t keeps the triangle a, b, c from its circumcenter, i.e. lies between them: predicate P
/// of Tournois 2009, sec. 2.2.2. A circumcenter on the segment's line is seen.
/// \pre a, b, c are not collinear and all on one side of the line through s and t, or on it.
template <class K>
struct Is_blinded_by_2
{
  using Point = typename K::Point_2;

  bool operator()(const Point& a, const Point& b, const Point& c, const Point& s, const Point& t) const
  {
    CGAL::Oriented_side triangle = CGAL::ON_ORIENTED_BOUNDARY;
    for (const Point* p : {&a, &b, &c})
      if (triangle == CGAL::ON_ORIENTED_BOUNDARY) triangle = typename K::Orientation_2()(s, t, *p);
    return Side_of_circumcenter_2<K>()(a, b, c, s, t) == -triangle;
  }
};

/// The circumcenter of a, b, c.
template <class K>
typename K::Point_2 accurate_circumcenter(const typename K::Point_2& a, const typename K::Point_2& b,
                                          const typename K::Point_2& c)
{
  return construct_accurately<K>([&](auto& x, auto& y) { return circumcenter_coordinates(a, b, c, x, y); });
}

/// The point of the segment s, t that is as far from p as from q.
template <class K>
typename K::Point_2 bisector_on_segment(const typename K::Point_2& p, const typename K::Point_2& q,
                                        const typename K::Point_2& s, const typename K::Point_2& t)
{
  return construct_accurately<K>([&](auto& x, auto& y) { return bisector_coordinates(p, q, s, t, x, y); });
}

} // namespace weft::internal

#endif // WEFT_PLANAR_TRIANGULATION_BLIND_TRIANGLE_2_H
