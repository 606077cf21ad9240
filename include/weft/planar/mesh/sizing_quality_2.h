// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a planar mesh keeps to a sizing field, and how its number of triangles compares with the number that
// equilateral triangles of the wanted size would need (Tournois 2009, sec. 1.3.1.1 and 2.4; that number is computed
// there from the mean size, here by integration, and the two agree for uniform fields).
//
// Works on any CGAL constrained triangulation whose faces have `is_in_domain()`; a mesh is the finite faces in the
// domain.

#ifndef WEFT_PLANAR_MESH_SIZING_QUALITY_2_H
#define WEFT_PLANAR_MESH_SIZING_QUALITY_2_H

#include <weft/errors.h>
#include <weft/internal/Compensated_sum.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>

namespace weft {

/// How well a mesh keeps to a sizing field. The sizing ratio of a triangle is its longest edge over the size at its
/// centroid, that of a constrained edge its length over the size at its midpoint. Constrained edges count if a face
/// beside them is in the domain. Without elements, ratios are NaN.
struct Sizing_quality_2
{
  /// Ratios of one kind of element.
  struct Ratios
  {
    std::size_t elements = 0;
    std::size_t oversized = 0; ///< with a ratio above 1
    double largest = std::numeric_limits<double>::quiet_NaN(), mean = std::numeric_limits<double>::quiet_NaN();
  };
  Ratios triangles, constrained_edges;

  /// Number of triangles if all were equilateral with the edge length that the field asks for: the integral of
  /// 1 / (sqrt(3)/4 size^2) over the domain, by the edge midpoint rule on each triangle.
  double ideal_triangles = 0;

  /// Number of triangles over the ideal number.
  double relative_count() const { return static_cast<double>(triangles.elements) / ideal_triangles; }
  bool ok() const { return triangles.oversized == 0 && constrained_edges.oversized == 0; }
};

namespace internal {

template <class Sizing, class Point>
double checked_size(const Sizing& sizing, const Point& p)
{
  const double size = CGAL::to_double(sizing(p));
  if (size > 0 && std::isfinite(size)) return size;
  std::ostringstream what;
  what << "the sizing field returned " << size << " at (" << p << "); sizes must be positive and finite";
  throw Option_error(what.str());
}

/// Sizing ratio of a triangle.
template <class Point, class Sizing>
double sizing_ratio(const Scaled_triangle_2& t, const Sizing& sizing)
{
  const Point centroid((t.corner[0][0] + t.corner[1][0] + t.corner[2][0]) / 3,
                       (t.corner[0][1] + t.corner[1][1] + t.corner[2][1]) / 3);
  return t.unscaled(t.longest()) / checked_size(sizing, centroid);
}

/// Calls `visit(face, i)` for every constrained edge beside the domain.
template <class Cdt, class Visit>
void for_each_constrained_edge(const Cdt& cdt, const Visit& visit)
{
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    if (edge->first->is_in_domain() || edge->first->neighbor(edge->second)->is_in_domain())
      visit(edge->first, edge->second);
}

/// Sizing ratio of a constrained edge.
template <class Cdt, class Sizing>
double sizing_ratio(typename Cdt::Face_handle face, int i, const Sizing& sizing)
{
  const Xy_2 a = xy(face->vertex(Cdt::ccw(i))->point()), b = xy(face->vertex(Cdt::cw(i))->point());
  return edge_length(b[0] - a[0], b[1] - a[1]) / checked_size(sizing, edge_middle<typename Cdt::Point>(a, b));
}

/// Integral of 1 / (sqrt(3)/4 size^2) over a triangle: exact for sizes whose inverse square is quadratic.
template <class Point, class Sizing>
double ideal_triangles(const Scaled_triangle_2& t, const Sizing& sizing)
{
  double mean = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double size = checked_size(sizing, edge_middle<Point>(t.corner[(i + 1) % 3], t.corner[(i + 2) % 3]));
    const double per_unit = std::ldexp(1 / size, t.exponent);
    mean += per_unit * per_unit / 3;
  }
  return mean * (t.twice_area / 2) / (std::sqrt(3.) / 4);
}

/// Gathers the ratios of one kind of element.
class Ratio_gatherer
{
public:
  void add(double ratio)
  {
    ++ratios_.elements;
    if (!(ratio <= 1)) ++ratios_.oversized;
    ratios_.largest = std::fmax(ratios_.largest, ratio);
    sum_.add(ratio);
  }
  Sizing_quality_2::Ratios result() const
  {
    Sizing_quality_2::Ratios result = ratios_;
    if (result.elements > 0) result.mean = sum_.value() / static_cast<double>(result.elements);
    return result;
  }

private:
  Sizing_quality_2::Ratios ratios_;
  Compensated_sum sum_;
};

} // namespace internal

/// Measures how well the triangles in the domain and the constrained edges beside it keep to a sizing field. Four
/// evaluations of the field a triangle.
/// \param sizing callable, point -> target edge length in the input's units.
/// \throws Option_error if the field returns anything but a positive finite number.
template <class Cdt, class Sizing>
Sizing_quality_2 measure_sizing_2(const Cdt& cdt, const Sizing& sizing)
{
  using Point = typename Cdt::Point;
  internal::Ratio_gatherer triangles, edges;
  internal::Compensated_sum ideal;
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const internal::Scaled_triangle_2 triangle(face);
    triangles.add(internal::sizing_ratio<Point>(triangle, sizing));
    ideal.add(internal::ideal_triangles<Point>(triangle, sizing));
  }
  internal::for_each_constrained_edge(
      cdt, [&](auto face, int i) { edges.add(internal::sizing_ratio<Cdt>(face, i, sizing)); });
  return {triangles.result(), edges.result(), ideal.value()};
}

/// A few lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Sizing_quality_2& q)
{
  const auto line = [&out](const char* name, const Sizing_quality_2::Ratios& r) {
    out << "sizing ratios of " << r.elements << " " << name << ": ";
    if (r.elements > 0) out << r.largest << " at most, " << r.mean << " on average, ";
    out << r.oversized << " above 1\n";
  };
  line("triangles", q.triangles);
  line("constrained edges", q.constrained_edges);
  return out << "triangles / ideal number: " << q.relative_count() << "\n";
}

} // namespace weft

#endif // WEFT_PLANAR_MESH_SIZING_QUALITY_2_H
