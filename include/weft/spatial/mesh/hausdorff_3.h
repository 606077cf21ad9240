// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the boundary of a mesh and a surface are from each other: their two-sided Hausdorff distance, from below, by
// distances of sample points (Cignoni, Rocchini, Scopigno, "Metro: measuring error on simplified surfaces", 1998).
// Stands on CGAL's AABB tree and shares no code with weft's oracles, so that it can judge them.

#ifndef WEFT_SPATIAL_MESH_HAUSDORFF_3_H
#define WEFT_SPATIAL_MESH_HAUSDORFF_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/cgal_aabb_tree.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/centroid.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace weft {

/// Distances between two surfaces, in the input's units.
struct Hausdorff_3
{
  double mesh_to_surface = 0, surface_to_mesh = 0;           ///< largest distance of a sample of the one to the other
  double mean_mesh_to_surface = 0, mean_surface_to_mesh = 0; ///< mean over the samples that are uniform by area

  double two_sided() const { return (std::max)(mesh_to_surface, surface_to_mesh); }
};

namespace internal {

template <class K>
std::vector<typename K::Triangle_3> triangles_of(const std::vector<typename K::Point_3>& points,
                                                 const std::vector<std::array<std::size_t, 3>>& triangles)
{
  std::vector<typename K::Triangle_3> result;
  result.reserve(triangles.size());
  for (const auto& t : triangles) result.emplace_back(points[t[0]], points[t[1]], points[t[2]]);
  return result;
}

/// Sums of the areas of the triangles up to each one, as what picks triangles by area.
template <class Triangle>
std::vector<double> cumulated_areas(const std::vector<Triangle>& triangles)
{
  std::vector<double> sums;
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Xyz_3 origin = xyz(t[0]);
    sum += norm(cross_product(minus(xyz(t[1]), origin), minus(xyz(t[2]), origin))) / 2;
    sums.push_back(sum);
  }
  return sums;
}

template <class K>
typename K::Point_3 point_in_triangle(const typename K::Triangle_3& t, double s, double u)
{
  const Xyz_3 a = xyz(t[0]), b = xyz(t[1]), c = xyz(t[2]);
  const double r = std::sqrt(s); // uniform by area
  std::array<double, 3> p{};
  for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] + r * (1 - u) * (b[i] - a[i]) + r * u * (c[i] - a[i]);
  return {p[0], p[1], p[2]};
}

struct Sampled_distance
{
  double largest = 0, mean = 0;
};

/// Distances of samples of some triangles to a tree: corners, centroids and middles of sides of all, and points uniform
/// by area.
template <class K>
Sampled_distance sample_distance(const std::vector<typename K::Triangle_3>& from, const Triangle_tree_3<K>& to,
                                 std::size_t samples, unsigned seed)
{
  Sampled_distance distance;
  const auto measure = [&](const typename K::Point_3& p) {
    const double d = std::sqrt(CGAL::to_double(to.squared_distance(p)));
    distance.largest = (std::max)(distance.largest, d);
    return d;
  };
  for (const auto& triangle : from) {
    for (int i = 0; i < 3; ++i) {
      measure(triangle[i]);
      measure(CGAL::midpoint(triangle[i], triangle[i + 1])); // at a fold between facets, say
    }
    measure(CGAL::centroid(triangle));
  }
  const std::vector<double> areas = cumulated_areas(from);
  std::mt19937_64 random(seed);
  // Not std::uniform_real_distribution: standard libraries differ in that.
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * std::ldexp(1., -53); };
  for (std::size_t i = 0; i < samples; ++i) {
    const double place = uniform() * areas.back(), s = uniform(), u = uniform();
    const auto found = std::lower_bound(areas.begin(), areas.end() - 1, place) - areas.begin();
    distance.mean += measure(point_in_triangle<K>(from[static_cast<std::size_t>(found)], s, u));
  }
  if (samples > 0) distance.mean /= static_cast<double>(samples);
  return distance;
}

} // namespace internal

/// Measures the distances between the boundary facets of a mesh and a surface. The true Hausdorff distance is at least
/// what is found. O((samples + triangles) log triangles) time.
/// \param points,triangles the surface, for instance those of a Piecewise_smooth_complex_3.
/// \param samples points on each surface beside the corners, centroids and middles of sides of all triangles.
/// \throws Option_error if one of the surfaces has no triangle.
template <class K>
Hausdorff_3 hausdorff_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<typename K::Point_3>& points,
                        const std::vector<std::array<std::size_t, 3>>& triangles, std::size_t samples = 200000,
                        unsigned seed = 0)
{
  if (mesh.facets.empty() || triangles.empty()) throw Option_error("a surface without triangles has no distance");
  const auto boundary = internal::triangles_of<K>(mesh.points, mesh.facets);
  const auto surface = internal::triangles_of<K>(points, triangles);
  internal::Triangle_tree_3<K> boundary_tree(boundary.begin(), boundary.end()),
      surface_tree(surface.begin(), surface.end());
  boundary_tree.accelerate_distance_queries();
  surface_tree.accelerate_distance_queries();
  const auto there = internal::sample_distance<K>(boundary, surface_tree, samples, seed);
  const auto back = internal::sample_distance<K>(surface, boundary_tree, samples, seed);
  return {there.largest, back.largest, there.mean, back.mean};
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_HAUSDORFF_3_H
