// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good a planar mesh is: angles, aspect ratios and edges, how well it keeps to a sizing field, and how its number
// of triangles compares with the number that equilateral triangles of the wanted size would need (Tournois 2009,
// sec. 1.3.1.1 and 2.4; that number is computed there from the mean size, here by integration, and the two agree for
// uniform fields). The aspect ratio of a triangle is its circumradius over its shortest edge, 1/sqrt(3) at best.
//
// Works on any CGAL constrained triangulation whose faces have `is_in_domain()`; a mesh is the finite faces in the
// domain. All measures are rounded, but none over- or underflows before its result does.

#ifndef WEFT_PLANAR_MESH_QUALITY_2_H
#define WEFT_PLANAR_MESH_QUALITY_2_H

#include <weft/errors.h>

#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace weft {

/// An angle and the triangle that has it.
struct Angle_extreme_2
{
  double degrees = std::numeric_limits<double>::quiet_NaN();
  std::size_t triangle = 0;                       ///< counted from 0 over the faces in the domain, as writers do
  std::array<std::array<double, 2>, 3> corners{}; ///< of the triangle; the first is where the angle is
};

/// Shape of the triangles of a mesh. Lengths are in the input's units. Of no triangles, all but the counts and the
/// area is NaN. A triangle with area zero counts with angles of 0 or 180 degrees and infinite aspect ratio.
struct Quality_2
{
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::size_t bins = 180; ///< of the histogram, one degree each

  std::size_t vertices = 0; ///< of the triangles; others aren't counted
  std::size_t triangles = 0;
  double area = 0; ///< signed: triangles that are turned over count negative

  Angle_extreme_2 smallest_angle, largest_angle;
  double mean_smallest_angle = nothing;   ///< degrees; mean over triangles of the smallest of the three angles
  std::array<std::size_t, bins> angles{}; ///< angles of all triangles, by whole degrees

  double largest_aspect_ratio = nothing, mean_aspect_ratio = nothing;  ///< circumradius over shortest edge; >= 0.577
  double smallest_radius_ratio = nothing, mean_radius_ratio = nothing; ///< 2 inradius / circumradius; in [0, 1]
  double shortest_edge = nothing, longest_edge = nothing;

  /// The angles as a histogram for pictures.
  /// \tparam Histogram has members `counts`, `smallest`, `largest` and a constructor (name, number of bins), for
  ///   instance Angle_histogram of IO/write_angle_histogram_svg.h.
  /// \param wanted_bins number of bins, a divisor of 180.
  /// \throws Option_error if it isn't one.
  template <class Histogram>
  Histogram histogram(const std::string& name, std::size_t wanted_bins = 60) const
  {
    if (wanted_bins == 0 || bins % wanted_bins != 0)
      throw Option_error("the number of bins of an angle histogram must divide 180");
    Histogram result(name, wanted_bins);
    for (std::size_t i = 0; i < bins; ++i) result.counts[i * wanted_bins / bins] += angles[i];
    if (triangles == 0) return result;
    result.smallest = smallest_angle.degrees;
    result.largest = largest_angle.degrees;
    return result;
  }
};

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
    double largest = Quality_2::nothing, mean = Quality_2::nothing;
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

inline double degrees(double radians)
{
  return radians * (180 / 3.14159265358979323846);
}

/// Neumaier's sum: the error doesn't grow with the number of terms, and hardly with their order.
class Compensated_sum
{
public:
  void add(double x)
  {
    const double sum = sum_ + x;
    const double lost = std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    if (std::isfinite(lost)) lost_ += lost;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

private:
  double sum_ = 0, lost_ = 0;
};

using Xy_2 = std::array<double, 2>;

template <class Point>
Xy_2 xy(const Point& p)
{
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y())};
}

/// Length of a vector, without over- or underflow, and otherwise the same bits as from the plain formula.
inline double edge_length(double dx, double dy)
{
  int exponent = 0;
  std::frexp((std::max)(std::abs(dx), std::abs(dy)), &exponent);
  dx = std::ldexp(dx, -exponent);
  dy = std::ldexp(dy, -exponent);
  return std::ldexp(std::sqrt(dx * dx + dy * dy), exponent);
}

/// A triangle in units of a power of two of about its size, so that scaling is exact and products stay in range.
struct Scaled_triangle_2
{
  std::array<Xy_2, 3> corner;   ///< unscaled
  std::array<double, 3> dx, dy; ///< edge i is opposite to corner i and goes counterclockwise
  std::array<double, 3> length;
  double twice_area; ///< signed
  int exponent = 0;  ///< lengths are to be multiplied by 2^exponent

  template <class Face_handle>
  explicit Scaled_triangle_2(Face_handle face)
      : Scaled_triangle_2(std::array<Xy_2, 3>{xy(face->vertex(0)->point()), xy(face->vertex(1)->point()),
                                              xy(face->vertex(2)->point())})
  {}

  explicit Scaled_triangle_2(const std::array<Xy_2, 3>& corners) : corner(corners)
  {
    double extent = 0;
    for (int i = 0; i < 3; ++i) {
      const auto &from = corner[(i + 1) % 3], &to = corner[(i + 2) % 3];
      dx[i] = to[0] - from[0];
      dy[i] = to[1] - from[1];
      extent = (std::max)({extent, std::abs(dx[i]), std::abs(dy[i])});
    }
    std::frexp(extent, &exponent);
    for (int i = 0; i < 3; ++i) {
      dx[i] = std::ldexp(dx[i], -exponent);
      dy[i] = std::ldexp(dy[i], -exponent);
      length[i] = std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]);
    }
    twice_area = dy[2] * dx[1] - dx[2] * dy[1];
  }

  double unscaled(double scaled_length) const { return std::ldexp(scaled_length, exponent); }
  double longest() const { return *std::max_element(length.begin(), length.end()); }
  double shortest() const { return *std::min_element(length.begin(), length.end()); }
  double area() const { return std::ldexp(twice_area, 2 * exponent - 1); }
  double angle(int i) const
  {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    return degrees(std::atan2(std::abs(twice_area), -(dx[j] * dx[k] + dy[j] * dy[k])));
  }
  double aspect_ratio() const { return length[0] * length[1] * length[2] / (2 * std::abs(twice_area) * shortest()); }
  double radius_ratio() const
  {
    const double perimeter = length[0] + length[1] + length[2];
    return 4 * twice_area * twice_area / (perimeter * length[0] * length[1] * length[2]);
  }
};

/// Gathers a Quality_2 triangle by triangle.
class Quality_gatherer_2
{
public:
  void add(const Scaled_triangle_2& triangle)
  {
    double smallest = 180;
    for (int i = 0; i < 3; ++i) {
      const double angle = triangle.angle(i);
      ++quality_.angles[(std::min)(static_cast<std::size_t>(angle), Quality_2::bins - 1)];
      smallest = (std::min)(smallest, angle);
      // Also true while there is none yet.
      if (!(angle >= quality_.smallest_angle.degrees)) take(quality_.smallest_angle, triangle, i, angle);
      if (!(angle <= quality_.largest_angle.degrees)) take(quality_.largest_angle, triangle, i, angle);
    }
    smallest_angles_.add(smallest);
    area_.add(triangle.area());
    // fmin and fmax pass over the NaN that stands for "none yet".
    quality_.shortest_edge = std::fmin(quality_.shortest_edge, triangle.unscaled(triangle.shortest()));
    quality_.longest_edge = std::fmax(quality_.longest_edge, triangle.unscaled(triangle.longest()));
    const bool degenerate = triangle.twice_area == 0;
    add_ratios(degenerate ? std::numeric_limits<double>::infinity() : triangle.aspect_ratio(),
               degenerate ? 0 : triangle.radius_ratio());
    ++quality_.triangles;
  }

  Quality_2 result() const
  {
    Quality_2 result = quality_;
    result.area = area_.value();
    const double n = static_cast<double>(result.triangles);
    if (result.triangles == 0) return result;
    result.mean_smallest_angle = smallest_angles_.value() / n;
    result.mean_aspect_ratio = aspect_ratios_.value() / n;
    result.mean_radius_ratio = radius_ratios_.value() / n;
    return result;
  }

private:
  void take(Angle_extreme_2& extreme, const Scaled_triangle_2& t, int i, double angle) const
  {
    extreme = {angle, quality_.triangles, {t.corner[i], t.corner[(i + 1) % 3], t.corner[(i + 2) % 3]}};
  }

  void add_ratios(double aspect_ratio, double radius_ratio)
  {
    quality_.largest_aspect_ratio = std::fmax(quality_.largest_aspect_ratio, aspect_ratio);
    quality_.smallest_radius_ratio = std::fmin(quality_.smallest_radius_ratio, radius_ratio);
    aspect_ratios_.add(aspect_ratio);
    radius_ratios_.add(radius_ratio);
  }

  Quality_2 quality_;
  Compensated_sum area_, smallest_angles_, aspect_ratios_, radius_ratios_;
};

template <class Sizing, class Point>
double checked_size(const Sizing& sizing, const Point& p)
{
  const double size = CGAL::to_double(sizing(p));
  if (size > 0 && std::isfinite(size)) return size;
  std::ostringstream what;
  what << "the sizing field returned " << size << " at (" << p << "); sizes must be positive and finite";
  throw Option_error(what.str());
}

template <class Point>
Point edge_middle(const Xy_2& a, const Xy_2& b)
{
  return Point((a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
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
  for (int i = 0; i < 3; ++i) {
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

/// Degrees from the constrained edge (face, cw(i)), counterclockwise about vertex i, to the next constrained edge; 360
/// if that is the same edge, or none is met inside of the triangulation.
template <class Cdt>
double degrees_to_next_constraint(const Cdt& cdt, typename Cdt::Face_handle face, int i)
{
  const auto center = face->vertex(i), first = face->vertex(Cdt::ccw(i));
  while (!face->is_constrained(Cdt::ccw(i))) {
    face = face->neighbor(Cdt::ccw(i));
    i = face->index(center);
    if (cdt.is_infinite(face)) return 360;
  }
  const auto last = face->vertex(Cdt::cw(i));
  if (first == last) return 360;
  const Xy_2 o = xy(center->point()), a = xy(first->point()), b = xy(last->point());
  const double la = edge_length(a[0] - o[0], a[1] - o[1]), lb = edge_length(b[0] - o[0], b[1] - o[1]);
  const double ux = (a[0] - o[0]) / la, uy = (a[1] - o[1]) / la, vx = (b[0] - o[0]) / lb, vy = (b[1] - o[1]) / lb;
  const double angle = degrees(std::atan2(ux * vy - uy * vx, ux * vx + uy * vy));
  return angle < 0 ? angle + 360 : angle;
}

} // namespace internal

/// Measures the shape of the triangles in the domain. Linear time.
template <class Cdt>
Quality_2 measure_quality_2(const Cdt& cdt)
{
  internal::Quality_gatherer_2 gatherer;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, bool> seen(false);
  std::size_t vertices = 0;
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    gatherer.add(internal::Scaled_triangle_2(face));
    for (int i = 0; i < 3; ++i) {
      bool& known = seen[face->vertex(i)];
      vertices += !known;
      known = true;
    }
  }
  Quality_2 quality = gatherer.result();
  quality.vertices = vertices;
  return quality;
}

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

/// Smallest angle in degrees between two constrained edges that follow each other around a vertex with faces in the
/// domain between them: no mesh of these constraints can do without it. 360 if there are no two such edges. Steiner
/// vertices on constraints count with their 180 degrees. Linear time.
template <class Cdt>
double smallest_constraint_angle_2(const Cdt& cdt)
{
  double smallest = 360;
  for (const auto face : cdt.finite_face_handles())
    for (int i = 0; i < 3 && face->is_in_domain(); ++i)
      if (face->is_constrained(Cdt::cw(i)))
        smallest = (std::min)(smallest, internal::degrees_to_next_constraint(cdt, face, i));
  return smallest;
}

/// A few lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Quality_2& q)
{
  out << q.triangles << " triangles, " << q.vertices << " vertices, area " << q.area << "\n";
  if (q.triangles == 0) return out;
  return out << "angles " << q.smallest_angle.degrees << " (triangle " << q.smallest_angle.triangle << ") to "
             << q.largest_angle.degrees << " degrees (triangle " << q.largest_angle.triangle
             << "), mean smallest angle " << q.mean_smallest_angle << "\n"
             << "circumradius / shortest edge " << q.largest_aspect_ratio << " at most, " << q.mean_aspect_ratio
             << " on average (0.577 at best)\n"
             << "2 inradius / circumradius " << q.smallest_radius_ratio << " at least, " << q.mean_radius_ratio
             << " on average (1 at best)\n"
             << "edges " << q.shortest_edge << " to " << q.longest_edge << "\n";
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

#endif // WEFT_PLANAR_MESH_QUALITY_2_H
