// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact answers about a segment, or an axis-parallel ray, and a triangle. Parities are those of the query moved by
// (e, e^2, e^3) for an infinitesimal e > 0, the triangle staying where it is (simulation of simplicity: Edelsbrunner
// and Muecke 1990). All queries move alike, so all parities agree with each other: the moved query meets no vertex and
// no edge of a closed surface, and each crossing lies in exactly one triangle. What the query touches where it really
// is comes from the signs before the move. Signs are those of doubles where an error bound proves them, else of the
// kernel's exact predicates.

#ifndef WEFT_INTERNAL_BOXES_PERTURBED_CROSSING_3_H
#define WEFT_INTERNAL_BOXES_PERTURBED_CROSSING_3_H

#include <weft/internal/boxes/nearest_point_3.h>

#include <CGAL/enum.h>
#include <CGAL/MP_Float.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace weft::internal {

/// A triangle of a surface. Vertices and triangles are known by their input indices.
template <class K>
struct Surface_triangle_3
{
  std::array<typename K::Point_3, 3> points;
  std::array<std::uint32_t, 3> vertices;
  std::uint32_t index;
  int patch;
  int change = 1; ///< exclusive or of the subdomains on its two sides
};

/// An approximate value and its exact sign.
struct Signed_value
{
  double value;
  int sign;
};

/// Determinant of three vectors whose coordinates are rounded differences of exact numbers; sign 2: unknown.
/// With u = 2^-53: each of the six products of entries is wrong by 3u from its entries and 5u from the operations, so
/// the sum by 48u times the product of the vectors' largest entries; below 1e-280 products may underflow.
inline Signed_value filtered_determinant(const Xyz_3& a, const Xyz_3& b, const Xyz_3& c)
{
  const double value =
      a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  const auto largest = [](const Xyz_3& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); };
  const double error = 6e-15 * largest(a) * largest(b) * largest(c);
  if (error > 1e-280 && std::abs(value) > error) return {value, value > 0 ? 1 : -1};
  return {value, 2};
}

/// det(q - p, r - p, s - p): positive if s is on the positive side of the plane through p, q and r.
template <class K>
Signed_value orientation_value(const typename K::Point_3& p, const typename K::Point_3& q, const typename K::Point_3& r,
                               const typename K::Point_3& s)
{
  Signed_value result = filtered_determinant(difference(q, p), difference(r, p), difference(s, p));
  if (result.sign == 2) result.sign = static_cast<int>(typename K::Orientation_3()(p, q, r, s));
  return result;
}

/// Exact sign of coordinate k of (b - a) x (d - c).
inline int sign_of_cross_product(const Xyz_3& a, const Xyz_3& b, const Xyz_3& c, const Xyz_3& d, std::size_t k)
{
  using Exact = CGAL::MP_Float;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const double left = (b[i] - a[i]) * (d[j] - c[j]), right = (b[j] - a[j]) * (d[i] - c[i]);
  const double error = 6e-16 * (std::abs(left) + std::abs(right)); // 4u of each
  if (error > 1e-280 && std::abs(left - right) > error) return left > right ? 1 : -1;
  if ((b[i] == a[i] || d[j] == c[j]) && (b[j] == a[j] || d[i] == c[i])) return 0;
  const Exact exact = (Exact(b[i]) - Exact(a[i])) * (Exact(d[j]) - Exact(c[j])) -
                      (Exact(b[j]) - Exact(a[j])) * (Exact(d[i]) - Exact(c[i]));
  return static_cast<int>(CGAL::sign(exact));
}

template <class Point>
int sign_of_cross_product(const Point& a, const Point& b, const Point& c, const Point& d, std::size_t k)
{
  return sign_of_cross_product(xyz(a), xyz(b), xyz(c), xyz(d), k);
}

/// On which side of the line pq, seen along it, an edge ab passes once p and q are moved: the sign of
/// det(q - p, a - p, b - p), which moves by -(move) * ((b - a) x (q - p)). 0 if ab is parallel to pq.
template <class Point>
int moved_edge_sign(int sign, const Point& p, const Point& q, const Point& a, const Point& b)
{
  for (std::size_t k = 0; k < 3 && sign == 0; ++k) sign = -sign_of_cross_product(a, b, p, q, k);
  return sign;
}

/// The side of the plane of the triangle that p lies on once it is moved. 0 if the triangle has no area.
template <class K>
int moved_side(int sign, const Surface_triangle_3<K>& t)
{
  for (std::size_t k = 0; k < 3 && sign == 0; ++k)
    sign = sign_of_cross_product(t.points[0], t.points[1], t.points[0], t.points[2], k);
  return sign;
}

/// Which end of a segment a contact is.
enum class Segment_end
{
  none,
  p,
  q
};

/// What a query touches of a triangle: a vertex, the inside of an edge, or the inside of the triangle. Two triangles
/// touched at the same place have the same `first`, `second` and `end`.
template <class Point>
struct Contact_3
{
  Point point;                 ///< rounded, unless an end or a vertex
  std::uint32_t first, second; ///< vertex: twice the same; edge: its ends, the smaller first; triangle: its index, -1
  Segment_end end;             ///< none at a vertex
  std::uint32_t triangle;
  int patch;

  static constexpr std::uint32_t inside = 0xffffffff;
};

template <class K>
class Segment_and_triangle_3
{
public:
  using Point = typename K::Point_3;
  using Triangle = Surface_triangle_3<K>;
  using Contact = Contact_3<Point>;

  /// Signs of the two ends and of the three edges.
  Segment_and_triangle_3(const Point& p, const Point& q, const Triangle& triangle) : p_(p), q_(q), t_(triangle)
  {
    const Point &a = t_.points[0], &b = t_.points[1], &c = t_.points[2];
    const Xyz_3 d = difference(q, p);
    edges_[0] = edge_value(d, b, c);
    edges_[1] = edge_value(d, c, a);
    if (misses(edges_[0].sign, edges_[1].sign)) return;
    edges_[2] = edge_value(d, a, b);
    if (misses(edges_[0].sign, edges_[2].sign) || misses(edges_[1].sign, edges_[2].sign)) return;
    of_p_ = orientation_value<K>(a, b, c, p).sign, of_q_ = orientation_value<K>(a, b, c, q).sign;
    misses_ = of_p_ * of_q_ > 0;
  }

  /// Nothing is touched, and nothing will be by a move.
  bool misses() const { return misses_; }
  /// An end or an edge lies exactly on the plane or the line.
  bool is_degenerate() const { return !of_p_ || !of_q_ || !edges_[0].sign || !edges_[1].sign || !edges_[2].sign; }

  int patch() const { return t_.patch; }
  int triangle() const { return static_cast<int>(t_.index); }
  int change() const { return t_.change; }

  /// Whether the moved segment crosses the triangle.
  bool crosses() const
  {
    if (!is_degenerate()) return true;
    if (moved_side(of_p_, t_) == moved_side(of_q_, t_)) return false;
    const Point &a = t_.points[0], &b = t_.points[1], &c = t_.points[2];
    const int first = moved_edge_sign(edges_[0].sign, p_, q_, b, c);
    return first != 0 && first == moved_edge_sign(edges_[1].sign, p_, q_, c, a) &&
           first == moved_edge_sign(edges_[2].sign, p_, q_, a, b);
  }

  /// The point in the triangle, if nothing is degenerate: a mean of the vertices, so on the surface up to rounding.
  Point point() const
  {
    if (values_are_vague_) return exact_point();
    const double sum = edges_[0].value + edges_[1].value + edges_[2].value; // all of the same sign
    return mean(edges_[1].value / sum, edges_[2].value / sum);
  }

  /// All contacts of a degenerate pair, before the move.
  template <class Add>
  void contacts(const Add& add) const
  {
    if (of_p_ == 0 && of_q_ == 0)
      coplanar_contacts(add);
    else
      transversal_contacts(add);
  }

private:
  static bool misses(int a, int b) { return a * b < 0; }

  // det(q - p, a - p, b - p), by the short vector b - a, which loses less than b - p.
  Signed_value edge_value(const Xyz_3& d, const Point& a, const Point& b)
  {
    Signed_value result = filtered_determinant(d, difference(a, p_), difference(b, a));
    if (result.sign == 2) {
      result.sign = static_cast<int>(typename K::Orientation_3()(p_, q_, a, b));
      values_are_vague_ = true;
    }
    return result;
  }

  Point mean(double second, double third) const
  {
    const Point& a = t_.points[0];
    const Xyz_3 ab = difference(t_.points[1], a), ac = difference(t_.points[2], a);
    return Point(a.x() + second * ab[0] + third * ac[0], a.y() + second * ab[1] + third * ac[1],
                 a.z() + second * ab[2] + third * ac[2]);
  }

  // det(q - p, a - p, b - p), correctly rounded or nearly so.
  double exact_edge_value(const Point& a, const Point& b) const
  {
    using Exact = CGAL::MP_Float;
    std::array<Exact, 3> d, u, v;
    const Xyz_3 at_a = xyz(a), at_b = xyz(b), at_p = xyz(p_), at_q = xyz(q_);
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = Exact(at_q[k]) - Exact(at_p[k]), u[k] = Exact(at_a[k]) - Exact(at_p[k]);
      v[k] = Exact(at_b[k]) - Exact(at_p[k]);
    }
    return CGAL::to_double(d[0] * (u[1] * v[2] - u[2] * v[1]) + d[1] * (u[2] * v[0] - u[0] * v[2]) +
                           d[2] * (u[0] * v[1] - u[1] * v[0]));
  }

  // Where the doubles' values have lost their signs.
  Point exact_point() const
  {
    const Point &a = t_.points[0], &b = t_.points[1], &c = t_.points[2];
    const double u = std::abs(exact_edge_value(b, c)), v = std::abs(exact_edge_value(c, a)),
                 w = std::abs(exact_edge_value(a, b));
    return mean(v / (u + v + w), w / (u + v + w));
  }

  Contact at_vertex(std::size_t i) const
  {
    return {t_.points[i], t_.vertices[i], t_.vertices[i], Segment_end::none, t_.index, t_.patch};
  }
  Contact on_edge(std::size_t opposite, const Point& x, Segment_end end) const
  {
    const std::uint32_t a = t_.vertices[(opposite + 1) % 3], b = t_.vertices[(opposite + 2) % 3];
    return {x, std::min(a, b), std::max(a, b), end, t_.index, t_.patch};
  }
  Contact within(const Point& x, Segment_end end) const
  {
    return {x, t_.index, Contact::inside, end, t_.index, t_.patch};
  }

  // The line meets the plane in one point, the segment does too, and the signs say that it is in the triangle.
  template <class Add>
  void transversal_contacts(const Add& add) const
  {
    const int zeros = !edges_[0].sign + !edges_[1].sign + !edges_[2].sign;
    if (zeros == 3) return; // a triangle without area: its neighbours are touched instead
    if (zeros == 2) {
      for (std::size_t i = 0; i < 3; ++i)
        if (edges_[i].sign) add(at_vertex(i));
      return;
    }
    const Segment_end end = of_p_ == 0 ? Segment_end::p : of_q_ == 0 ? Segment_end::q : Segment_end::none;
    const auto at_end = [&] { return end == Segment_end::p ? p_ : q_; };
    for (std::size_t i = 0; i < 3; ++i)
      if (edges_[i].sign == 0) add(on_edge(i, end == Segment_end::none ? point_on_edge(i) : at_end(), end));
    if (zeros == 0) add(within(at_end(), end));
  }

  Point point_on_edge(std::size_t i) const
  {
    const Point &a = t_.points[(i + 1) % 3], &b = t_.points[(i + 2) % 3], &c = t_.points[i];
    // The weight of an end is the value of the edge opposite to it.
    const double at_a = std::abs(exact_edge_value(b, c)), at_b = std::abs(exact_edge_value(c, a));
    const double t = at_b / (at_a + at_b);
    return Point(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()), a.z() + t * (b.z() - a.z()));
  }

  // The ends of the pieces that the segment has in common with the triangle's edges and inside.
  template <class Add>
  void coplanar_contacts(const Add& add) const
  {
    std::size_t axis = 0; // that the plane isn't parallel to
    const Point& a = t_.points[0];
    while (axis < 3 && sign_of_cross_product(a, t_.points[1], a, t_.points[2], axis) == 0) ++axis;
    if (axis == 3) return; // a triangle without area
    const auto side = [axis](const Point& x, const Point& y, const Point& z) {
      return sign_of_cross_product(x, y, x, z, axis);
    };
    const auto between = [](const Point& x, const Point& y, const Point& z) { // x strictly, on the line yz
      return x != y && x != z && ((y < x && x < z) || (z < x && x < y));
    };
    std::array<int, 3> of_p, of_q, of_vertex;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &b = t_.points[(i + 1) % 3], &c = t_.points[(i + 2) % 3];
      of_p[i] = side(b, c, p_), of_q[i] = side(b, c, q_), of_vertex[i] = side(p_, q_, t_.points[i]);
      const Point& vertex = t_.points[i];
      if (vertex == p_ || vertex == q_ || (of_vertex[i] == 0 && between(vertex, p_, q_))) add(at_vertex(i));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t b = (i + 1) % 3, c = (i + 2) % 3;
      if (of_p[i] == 0 && between(p_, t_.points[b], t_.points[c])) add(on_edge(i, p_, Segment_end::p));
      if (of_q[i] == 0 && q_ != p_ && between(q_, t_.points[b], t_.points[c])) add(on_edge(i, q_, Segment_end::q));
      if (of_p[i] * of_q[i] < 0 && of_vertex[b] * of_vertex[c] < 0)
        add(on_edge(i, coplanar_point(i, axis), Segment_end::none));
    }
    const auto is_within = [](const std::array<int, 3>& of) { return of[0] && of[0] == of[1] && of[1] == of[2]; };
    if (is_within(of_p)) add(within(p_, Segment_end::p));
    if (q_ != p_ && is_within(of_q)) add(within(q_, Segment_end::q));
  }

  // Where pq crosses the edge opposite to vertex i, by the coordinates other than `axis`.
  Point coplanar_point(std::size_t i, std::size_t axis) const
  {
    using Exact = CGAL::MP_Float;
    const Point &a = t_.points[(i + 1) % 3], &b = t_.points[(i + 2) % 3];
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const Xyz_3 p = xyz(p_), q = xyz(q_);
    const auto area = [&](const Xyz_3& v) {
      return std::abs(CGAL::to_double((Exact(q[x]) - Exact(p[x])) * (Exact(v[y]) - Exact(p[y])) -
                                      (Exact(q[y]) - Exact(p[y])) * (Exact(v[x]) - Exact(p[x]))));
    };
    const double of_a = area(xyz(a)), of_b = area(xyz(b)), t = of_a / (of_a + of_b);
    return Point(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()), a.z() + t * (b.z() - a.z()));
  }

  const Point& p_;
  const Point& q_;
  const Triangle& t_;
  std::array<Signed_value, 3> edges_; // of the edge opposite to each vertex
  int of_p_ = 0, of_q_ = 0;
  bool misses_ = true, values_are_vague_ = false;
};

/// What an axis-parallel ray does to a triangle.
enum class Ray_event
{
  none,
  crossing,
  starts_on_triangle
};

/// The ray from p along axis k, upwards or downwards; p moved as above decides crossings.
template <class K>
Ray_event ray_event(const typename K::Point_3& p, std::size_t k, bool upwards, const Surface_triangle_3<K>& t)
{
  using Point = typename K::Point_3;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  bool degenerate = false;
  std::array<int, 3> moved;
  const Xyz_3 x = xyz(p);
  const std::array<Xyz_3, 3> corners{{xyz(t.points[0]), xyz(t.points[1]), xyz(t.points[2])}};
  for (std::size_t v = 0; v < 3; ++v) {
    const Xyz_3 &a = corners[(v + 1) % 3], &b = corners[(v + 2) % 3];
    const int sign = sign_of_cross_product(a, b, a, x, k);
    degenerate = degenerate || sign == 0;
    // The moved value changes by (b - a)_i (move)_j - (b - a)_j (move)_i; the smaller axis moves more.
    const int by_i = a[j] < b[j] ? -1 : a[j] > b[j], by_j = a[i] < b[i] ? 1 : -(a[i] > b[i]);
    moved[v] = sign ? sign : (i < j ? (by_i ? by_i : by_j) : (by_j ? by_j : by_i));
    if (v > 0 && !degenerate && moved[v] != moved[v - 1]) return Ray_event::none;
  }
  const int side = orientation_value<K>(t.points[0], t.points[1], t.points[2], p).sign;
  if (side == 0) {
    // The segment pp touches the triangle where p does.
    bool touches = false;
    Segment_and_triangle_3<K>(p, p, t).contacts([&](const Contact_3<Point>&) { touches = true; });
    if (touches) return Ray_event::starts_on_triangle;
  }
  if (moved[0] == 0 || moved[0] != moved[1] || moved[1] != moved[2]) return Ray_event::none;
  // The common sign is that of the normal's coordinate k.
  const int towards = upwards ? moved[0] : -moved[0];
  return moved_side(side, t) * towards < 0 ? Ray_event::crossing : Ray_event::none;
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_PERTURBED_CROSSING_3_H
