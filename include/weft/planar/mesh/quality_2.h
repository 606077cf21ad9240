// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the triangles of a planar mesh are: angles, aspect ratios and edges. The aspect ratio of a triangle is its
// circumradius over its shortest edge, 1/sqrt(3) at best. How well a mesh keeps to its sizes is measured in
// sizing_quality_2.h, which comes with this header.
//
// Works on arrays and on any CGAL constrained triangulation whose faces have `is_in_domain()`; there a mesh is the
// finite faces in the domain. All measures are rounded, but none over- or underflows before its result does.

#ifndef WEFT_PLANAR_MESH_QUALITY_2_H
#define WEFT_PLANAR_MESH_QUALITY_2_H

#include <weft/errors.h>
#include <weft/internal/cold.h>
#include <weft/internal/Compensated_sum.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/mesh/sizing_quality_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <string>

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

namespace internal {

/// Gathers a Quality_2 triangle by triangle.
class Quality_gatherer_2
{
public:
  void add(const Scaled_triangle_2& triangle)
  {
    double smallest = 180;
    for (std::size_t i = 0; i < 3; ++i) {
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
  void take(Angle_extreme_2& extreme, const Scaled_triangle_2& t, std::size_t i, double angle) const
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
WEFT_NOINLINE Quality_2 measure_quality_2(const Cdt& cdt)
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

/// Measures the shape of the triangles. Linear time.
template <class K>
Quality_2 measure_quality_2(const Triangle_mesh_2<K>& mesh)
{
  internal::Quality_gatherer_2 gatherer;
  for (const auto& t : mesh.triangles)
    gatherer.add(internal::Scaled_triangle_2(std::array<internal::Xy_2, 3>{
        internal::xy(mesh.points[t[0]]), internal::xy(mesh.points[t[1]]), internal::xy(mesh.points[t[2]])}));
  Quality_2 quality = gatherer.result();
  quality.vertices = mesh.points.size();
  return quality;
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

} // namespace weft

#endif // WEFT_PLANAR_MESH_QUALITY_2_H
