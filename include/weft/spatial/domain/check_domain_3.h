// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a tetrahedral mesh is the whole domain: every point of the boundary has a facet of its patch near it, every
// crease its edges, every feature vertex a vertex; each subdomain has its volume, and its boundary as many components
// and handles. Independent of what a mesher keeps: it looks at nothing but the arrays of the mesh and the oracle.

#ifndef WEFT_SPATIAL_DOMAIN_CHECK_DOMAIN_3_H
#define WEFT_SPATIAL_DOMAIN_CHECK_DOMAIN_3_H

#include <weft/Domain_comparison_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/Boundary_distance_3.h>
#include <weft/spatial/domain/boundary_samples_3.h>
#include <weft/spatial/domain/Domain_shape_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

template <class Oracle, class = void>
struct Knows_shape_3 : std::false_type
{};
template <class Oracle>
struct Knows_shape_3<Oracle, std::void_t<decltype(std::declval<const Oracle&>().shape())>> : std::true_type
{};

/// Calls `visit(point, crease)` for points of all creases no farther apart than that.
template <class Oracle, class Visit>
void visit_crease_samples(const Oracle& oracle, double spacing, const Visit& visit)
{
  for (int c = 0; c < static_cast<int>(oracle.number_of_creases()); ++c) {
    const auto points = oracle.crease_points(c);
    const std::size_t n = points.size(), segments = oracle.crease_is_closed(c) ? n : n - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      const auto &a = points[i], &b = points[(i + 1) % n];
      const double length = norm(minus(xyz(b), xyz(a)));
      const double parts = std::floor(std::min(length / spacing, 1e6)) + 1;
      for (double k = 0; k < parts; ++k) visit(a + (k / parts) * (b - a), c);
    }
  }
}

constexpr double part_of_facets = 0.25;

/// Side of a square with the mean area of boundary facets; a hundredth of the domain's diagonal where there are none.
template <class K, class Oracle>
double mean_width_of_facets(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle)
{
  double area = 0;
  for (const auto& v : mesh.facets) {
    const Xyz_3 a = xyz(mesh.points[v[0]]);
    area += norm(cross_product(minus(xyz(mesh.points[v[1]]), a), minus(xyz(mesh.points[v[2]]), a))) / 2;
  }
  const auto box = oracle.bbox();
  const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  return area > 0 ? std::sqrt(area / static_cast<double>(mesh.facets.size())) : diagonal / 100;
}

} // namespace internal

/// Compares a mesh with its domain.
///
/// An oracle may have two more members for this; without them the comparison knows what seeds of patches tell.
/// `shape()` returns a Domain_shape_3. `visit_samples(spacing, visit)` calls `visit(point, patch, unit normal)` for
/// points of the boundary no farther apart than that, with zero for the normal where there is none. The normal points
/// out of the domain, and between two subdomains out of the one with the smaller number, as facets of meshes look.
///
/// O((n + samples) log n) time for n elements of the mesh.
/// \param approximation distance of facets from the boundary that was asked for, in the input's units: a number, or
///   called with a point and a patch, -1 on creases. 0 if none was: then patches and creases need only have some facet
///   or edge, and volumes may differ.
/// \param spacing of samples, in the input's units; 0: eight times the bound, where it is a number, at least a quarter
///   of the boundary facets' mean width.
/// \param missed if not null, gets the samples that are missed, with their patches.
/// \pre Patches and creases of the mesh have the numbers that the oracle gives them.
template <class K, class Oracle, class Approximation>
Domain_comparison_3 check_domain_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle,
                                   const Approximation& approximation, double spacing = 0,
                                   std::vector<std::pair<typename K::Point_3, int>>* missed = nullptr)
{
  using Point = typename K::Point_3;
  constexpr bool is_number = std::is_convertible_v<const Approximation&, double>;
  // Of the places of patches that were looked at; infinite if there is none at some. Creases count for no volume.
  double largest_bound = 0;
  const auto bound_at = [&](const Point& p, int patch) {
    double bound = 0;
    if constexpr (is_number)
      bound = static_cast<double>(approximation), static_cast<void>(p);
    else
      bound = approximation(p, patch);
    if (patch >= 0)
      largest_bound = std::max(largest_bound, bound > 0 ? bound : std::numeric_limits<double>::infinity());
    return bound;
  };
  Domain_comparison_3 result;

  internal::Boundary_distance_3<K> distance(static_cast<std::size_t>(oracle.number_of_patches()),
                                            oracle.number_of_creases());
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& v = mesh.facets[f];
    distance.add_facet(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.patches[f]);
  }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    distance.add_edge(mesh.points[mesh.edges[e][0]], mesh.points[mesh.edges[e][1]], mesh.creases[e]);
  distance.build();
  if (!(spacing > 0)) {
    spacing = internal::part_of_facets * internal::mean_width_of_facets(mesh, oracle);
    if constexpr (is_number) spacing = std::max(spacing, 8 * static_cast<double>(approximation));
  }
  constexpr std::size_t most_measured = 1000; // how far what is missed is off; measuring that is dear
  result.samples =
      internal::visit_missed_samples(oracle, distance, spacing, bound_at, [&](const Point& p, int patch, const auto&) {
        if (++result.missed_patch_samples <= most_measured)
          result.largest_distance = std::max(result.largest_distance, distance.distance_to_facets(p, patch));
        if (missed) missed->push_back({p, patch});
      });
  internal::visit_crease_samples(oracle, spacing, [&](const Point& p, int crease) {
    ++result.samples;
    const double d = distance.distance_to_edges(p, crease);
    if (std::isfinite(d) && d <= internal::boundary_tolerance(bound_at(p, -1))) return; // infinite: it has no edge
    ++result.missed_crease_samples;
    result.largest_distance = std::max(result.largest_distance, d);
  });
  result.tolerance = internal::boundary_tolerance(std::isfinite(largest_bound) ? largest_bound : 0);
  std::set<Point> corners;
  for (const std::size_t v : mesh.corners) corners.insert(mesh.points[v]);
  for (std::size_t i = 0; i < oracle.number_of_corners(); ++i)
    result.missing_corners += corners.count(oracle.corner(i)) == 0;

  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Domain_shape_3 shape = shape_of_mesh(mesh);
  std::set<int> subdomains;
  for (const auto& own : shape) subdomains.insert(own.first);
  Domain_shape_3 expected;
  if constexpr (internal::Knows_shape_3<Oracle>::value) expected = oracle.shape();
  for (const auto& own : expected) subdomains.insert(own.first);
  for (const int s : subdomains) {
    Subdomain_comparison_3 row;
    row.subdomain = s;
    const auto is = shape.find(s);
    if (is != shape.end())
      row.volume = is->second.volume, row.components = is->second.components, row.euler = is->second.euler;
    if (!expected.empty()) {
      const Subdomain_shape_3& asked = expected[s];
      row.expected_volume = asked.volume;
      // Rounding of the sums is allowed for, too.
      row.allowed_difference =
          largest_bound > 0 ? largest_bound * asked.area + 1e-9 * std::abs(asked.volume) : infinity;
      row.expected_components = asked.components, row.expected_euler = asked.euler;
    }
    result.subdomains.push_back(row);
  }
  return result;
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_CHECK_DOMAIN_3_H
