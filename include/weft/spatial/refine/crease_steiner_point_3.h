// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where to split a restricted crease edge. Tournois 2009, sec. 3.2.1.4 takes the farthest point where its Voronoi facet
// meets the crease; here that point may give way
//  - near a feature vertex, to a point on one of a series of concentric spheres around it, the same for all creases
//    that end there: else creases that meet at a sharp angle would split each other's edges without end (Ruppert, "A
//    Delaunay refinement algorithm for quality 2-dimensional mesh generation", 1995, sec. 5.2);
//  - where a vertex of another crease that ends there is in the way, to the point as far from the feature vertex as
//    that vertex: the Voronoi cells of such pairs meet halfway between creases, however sharp their angle;
//  - to the vertex nearby where the polyline bends most, so that the edges follow it with fewer vertices.

#ifndef WEFT_SPATIAL_REFINE_CREASE_STEINER_POINT_3_H
#define WEFT_SPATIAL_REFINE_CREASE_STEINER_POINT_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

template <class Point>
double distance_3(const Point& a, const Point& b)
{
  return norm(minus(xyz(a), xyz(b)));
}

/// The first point of a polyline at a given distance from one of its ends.
/// \param from_back whether from its last point.
template <class Point>
Point point_at_distance(const std::vector<Point>& points, bool from_back, double distance)
{
  const auto at = [&](std::size_t i) -> const Point& { return points[from_back ? points.size() - 1 - i : i]; };
  const Point& center = at(0);
  std::size_t i = 1;
  while (i + 1 < points.size() && distance_3(center, at(i)) < distance) ++i;
  double low = 0, high = 1; // bisection: the distance needn't grow along a piece, but it passes the value
  const auto along = [&](double t) { return at(i - 1) + t * (at(i) - at(i - 1)); };
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (distance_3(center, along(middle)) < distance ? low : high) = middle;
  }
  return along(high);
}

/// Cosine of the angle by which a polyline turns at its vertex i.
template <class Point>
double turning_cosine(const std::vector<Point>& points, std::size_t i)
{
  const Xyz_3 u = minus(xyz(points[i]), xyz(points[i - 1])), v = minus(xyz(points[i + 1]), xyz(points[i]));
  return dot_product(u, v) / (norm(u) * norm(v));
}

/// Where a vertex of another crease holds a stretch of crease `e.steiner_crease` and both creases end in the same
/// feature vertex: the point of that crease which is as far from there. Sets `p` unless a vertex is there already.
template <class Restricted>
bool mirror_other_crease(const Restricted& mesh, const typename Restricted::Crease_edge& e,
                         typename Restricted::Point& p)
{
  const auto& points = mesh.creases().points(static_cast<std::size_t>(e.steiner_crease));
  if (points.front() == points.back()) return false;
  for (const auto v : {e.source, e.target}) {
    const auto& at = v->location();
    if (at.dimension != 1 || at.index == e.steiner_crease) continue;
    const auto& others = mesh.creases().points(static_cast<std::size_t>(at.index));
    for (const bool from_back : {false, true}) {
      const auto& corner = from_back ? points.back() : points.front();
      if (corner != others.front() && corner != others.back()) continue;
      const auto x = point_at_distance(points, from_back, distance_3(corner, v->point()));
      const auto nearest = mesh.triangulation().nearest_vertex(x, v->cell());
      const double apart = distance_3(x, v->point());
      if (apart > 2 * std::sqrt(e.squared_radius) || distance_3(x, nearest->point()) < 0.25 * apart) continue;
      p = x;
      return true;
    }
  }
  return false;
}

/// The point at which to split a restricted edge.
template <class Restricted>
typename Restricted::Point crease_steiner_point(const Restricted& mesh, const typename Restricted::Crease_edge& e)
{
  using Point = typename Restricted::Point;
  const auto& points = mesh.creases().points(static_cast<std::size_t>(e.steiner_crease));
  Point mirrored;
  if (mirror_other_crease(mesh, e, mirrored)) return mirrored;
  const bool at_source = e.source->location().dimension == 0, at_target = e.target->location().dimension == 0;
  if (e.crease == e.steiner_crease && (at_source || at_target)) {
    const Point& center = (at_source ? e.source : e.target)->point();
    if (center == (at_source ? points.front() : points.back())) {
      // Spheres with radii of powers of two: about in the middle, 0.35 to 0.71 of the length.
      const double length = distance_3(e.source->point(), e.target->point());
      return point_at_distance(points, !at_source, std::exp2(std::floor(std::log2(length / std::sqrt(2.0)))));
    }
  }
  const double reach = 0.4 * std::sqrt(e.squared_radius);
  const auto piece = static_cast<std::ptrdiff_t>(e.position);
  double sharpest = 0.985; // 10 degrees
  Point best = e.steiner;
  for (const int step : {-1, 1})
    for (std::ptrdiff_t i = step < 0 ? piece : piece + 1; i > 0 && i + 1 < static_cast<std::ptrdiff_t>(points.size());
         i += step) {
      const auto k = static_cast<std::size_t>(i);
      if (distance_3(points[k], e.steiner) > reach) break;
      const double cosine = turning_cosine(points, k);
      if (cosine >= sharpest) continue;
      sharpest = cosine;
      best = points[k];
    }
  return best;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_CREASE_STEINER_POINT_3_H
