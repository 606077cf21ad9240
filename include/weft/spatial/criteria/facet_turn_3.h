// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a boundary facet is turned away from the surface that it stands for. Facets that are near to the surface and
// turned like it cover it as a map covers a globe: what closed surface they make has the parts, the handles and the
// sides of the surface, wherever it has facets at all. A facet across a rod, a rib or a slot is turned away.

#ifndef WEFT_SPATIAL_CRITERIA_FACET_TURN_3_H
#define WEFT_SPATIAL_CRITERIA_FACET_TURN_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace weft::internal {

/// Whether an oracle knows normals of its boundary.
template <class Oracle, class = void>
struct Has_normals_3 : std::false_type
{};
template <class Oracle>
struct Has_normals_3<Oracle, std::void_t<decltype(std::declval<const Oracle&>().normal(0, 0))>> : std::true_type
{};

/// Facets whose normal makes less than that cosine with the surface's are turned away from it.
constexpr double least_cosine_to_surface = 0.2;

/// Whether there is an edge that is sharp but no crease in the surface Delaunay ball of a facet or a little beside it:
/// refinement beside such edges goes on to the size floor, and makes nothing better.
template <class Oracle, class Facet>
bool is_beside_sharp_edge(const Oracle& oracle, const Facet& f)
{
  bool found = oracle.is_at_acute_edge(f.steiner, std::sqrt(f.squared_radius));
  oracle.visit_ridges(f.steiner, f.squared_radius, f.patch,
                      [&found](const auto&, const auto&, bool attracts) { found = found || !attracts; });
  return found;
}

/// Which points of a facet are asked about.
enum class Facet_points_3
{
  all,
  steiner_point ///< alone, for facets whose vertices are known to be well
};

/// Least cosine of the angle between the normals of a boundary facet and of its patch, all pointing out of the same
/// subdomain: at its Steiner point and near its vertices; 1 where that isn't known. The Steiner point alone doesn't
/// tell: its Voronoi edge leaves a rod however flat, if only the facet across the rod is a little askew.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
double least_cosine_to_surface_of(const Restricted& mesh, const typename Restricted::Restricted_facet& f,
                                  Facet_points_3 points)
{
  if constexpr (Has_normals_3<typename Restricted::Oracle>::value) {
    if (f.triangle < 0) return 1;
    const auto c = f.cell;
    const int here = c->subdomain(), there = c->neighbor(f.index)->subdomain();
    if (here == there) return 1;
    const int inside = here != 0 ? here : there;
    const auto at = [&](int i) { return xyz(c->vertex((f.index + i) & 3)->point()); };
    const Xyz_3 corners[] = {at(1), at(2), at(3)};
    Xyz_3 normal = cross_product(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double length = norm(normal);
    if (!(length > 0)) return 1;
    const double sign = (dot_product(normal, minus(at(0), corners[0])) < 0) == (here != 0) ? 1 : -1;
    for (double& x : normal) x *= sign / length;
    const auto cosine = [&](int triangle) {
      const Xyz_3 out{mesh.oracle().normal(triangle, inside)};
      return out == Xyz_3() ? 1 : dot_product(normal, out);
    };
    double least = cosine(f.triangle);
    if (points == Facet_points_3::steiner_point) return least;
    for (int i = 0; i < 3 && least >= least_cosine_to_surface; ++i) {
      // A vertex on an edge has several normals: that of the side is meant on which the facet is.
      constexpr double inwards = 0.15;
      Xyz_3 p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = (1 - inwards) * corners[i][k] + inwards * (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
      const auto hit = mesh.oracle().project_on_patch(typename Restricted::Point(p[0], p[1], p[2]), f.patch);
      least = (std::min)(least, cosine(hit.triangle));
    }
    return least;
  } else {
    static_cast<void>(mesh), static_cast<void>(f), static_cast<void>(points);
    return 1;
  }
}

/// The same, but 1 for facets that cut off an edge which is sharp and which nobody marked: they are turned by as much
/// as the surface turns there.
template <class Restricted>
double cosine_to_surface(const Restricted& mesh, const typename Restricted::Restricted_facet& f,
                         Facet_points_3 points = Facet_points_3::all)
{
  const double least = least_cosine_to_surface_of(mesh, f, points);
  return least < least_cosine_to_surface && is_beside_sharp_edge(mesh.oracle(), f) ? 1 : least;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_FACET_TURN_3_H
