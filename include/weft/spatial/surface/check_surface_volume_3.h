// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a closed, oriented, manifold surface bound a volume? Its shells must not be flat, and its facets may meet in
// shared vertices and edges only. Shells are then turned so that the volume lies behind the facets, by the parity of
// their nesting. Everything is decided exactly, by what domain oracles decide with: CGAL's Polygon_mesh_processing,
// which has the same tests, would double the time to compile.

#ifndef WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H
#define WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H

#include <weft/internal/boxes/perturbed_crossing_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/surface/check_surface_topology_3.h>

#include <CGAL/enum.h>
#include <CGAL/MP_Float.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Shells whose vertices are all coplanar: they'd bound nothing.
template <class K>
void check_flat_shells(const Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  const auto number_of_shells = static_cast<std::size_t>(topology.number_of_shells);
  std::vector<std::size_t> base(number_of_shells, surface.triangles.size()), bad;
  std::vector<bool> has_volume(number_of_shells, false);
  const auto coplanar = K().coplanar_3_object();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto shell = static_cast<std::size_t>(topology.shells[t]);
    if (base[shell] == surface.triangles.size()) base[shell] = t;
    const auto [a, b, c] = surface.triangles[base[shell]];
    for (const std::size_t v : surface.triangles[t])
      if (!has_volume[shell] && !coplanar(surface.points[a], surface.points[b], surface.points[c], surface.points[v]))
        has_volume[shell] = true;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!has_volume[static_cast<std::size_t>(topology.shells[t])]) bad.push_back(t);
  if (!bad.empty()) refuse_facets(surface, "bounds no volume", "form shells of zero volume", bad);
}

/// A triangle of a surface as hierarchies take it.
template <class K>
Surface_triangle_3<K> hierarchy_triangle(const Triangle_surface_3<K>& surface, std::size_t triangle)
{
  Surface_triangle_3<K> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t v = surface.triangles[triangle][i];
    result.points[i] = surface.points[v];
    result.vertices[i] = static_cast<std::uint32_t>(v);
  }
  result.index = static_cast<std::uint32_t>(triangle);
  result.patch = 0;
  return result;
}

/// Whether two triangles that share an edge lie in one plane, on the same side of it.
template <class K>
bool are_folded(const Triangle_surface_3<K>& surface, const Surface_side_3& a, const Surface_side_3& b)
{
  const auto &p = surface.points[a.low], &q = surface.points[a.high],
             &r = surface.points[surface.triangles[a.triangle][static_cast<std::size_t>((a.side + 2) % 3)]],
             &s = surface.points[surface.triangles[b.triangle][static_cast<std::size_t>((b.side + 2) % 3)]];
  return K().orientation_3_object()(p, q, r, s) == CGAL::COPLANAR &&
         K().coplanar_orientation_3_object()(p, q, r, s) == CGAL::POSITIVE;
}

/// The pairs of triangles that have more in common than a vertex or an edge that both have, some of them several times.
/// Unless they share an edge, an edge of one of them meets the other, and none of its ends is a vertex of that.
/// \pre No facet is degenerate, and no two have the same vertices.
template <class K>
std::vector<std::array<std::size_t, 2>> intersecting_triangles(const Triangle_surface_3<K>& surface,
                                                               const std::vector<Surface_side_3>& sides)
{
  using Triangle = Surface_triangle_3<K>;
  std::vector<Triangle> triangles;
  triangles.reserve(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) triangles.push_back(hierarchy_triangle(surface, t));
  const Triangle_hierarchy_3<K> hierarchy(triangles);
  std::vector<std::array<std::size_t, 2>> found;
  for_each_edge(sides, [&](auto first, auto last) {
    for (auto side = first; side != last; ++side)
      for (auto other = side + 1; other != last; ++other)
        if (are_folded(surface, *side, *other)) found.push_back({side->triangle, other->triangle});
    const std::size_t low = first->low, high = first->high;
    const auto &p = surface.points[low], &q = surface.points[high];
    hierarchy.visit_near_segment(p, q, [&](const Triangle& triangle) {
      for (const std::size_t v : triangle.vertices)
        if (v == low || v == high) return false;
      const Segment_and_triangle_3<K> pair(p, q, triangle);
      if (pair.misses()) return false;
      bool touches = !pair.is_degenerate();
      if (!touches) pair.contacts([&](const auto&) { touches = true; });
      for (auto side = first; touches && side != last; ++side) found.push_back({side->triangle, triangle.index});
      return false;
    });
  });
  return found;
}

template <class K>
void check_self_intersections(const Triangle_surface_3<K>& surface, const std::vector<Surface_side_3>& sides)
{
  std::vector<std::array<std::size_t, 2>> found = intersecting_triangles(surface, sides);
  if (found.empty()) return;
  for (auto& pair : found) std::sort(pair.begin(), pair.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<std::array<std::size_t, 2>> pairs;
  std::vector<std::size_t> triangles;
  for (const auto& [a, b] : found) {
    triangles.insert(triangles.end(), {a, b});
    pairs.push_back({std::min(surface.origin(a), surface.origin(b)), std::max(surface.origin(a), surface.origin(b))});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const std::string what = counted(pairs.size(), "pair of facets intersects", "pairs of facets intersect or touch");
  refuse(surface, what + ": " + first_few(pairs), corners_of(surface, triangles), triangles);
}

/// Six times the volume that one triangle adds to that of its shell, seen from a point; in exact numbers.
template <class K>
CGAL::MP_Float exact_volume(const Triangle_surface_3<K>& surface, std::size_t triangle, const Xyz_3& seen_from)
{
  using Exact = CGAL::MP_Float;
  std::array<std::array<Exact, 3>, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Xyz_3 corner = xyz(surface.points[surface.triangles[triangle][i]]);
    for (std::size_t k = 0; k < 3; ++k) v[i][k] = Exact(corner[k]) - Exact(seen_from[k]);
  }
  const auto& [a, b, c] = v;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Whether the facets of a shell look outwards: its volume is positive.
/// \pre The shell is closed, oriented alike and doesn't meet itself, so its volume isn't zero.
template <class K>
bool looks_outwards(const Triangle_surface_3<K>& surface, const std::vector<std::size_t>& shell)
{
  const Xyz_3 origin = xyz(surface.points[surface.triangles[shell[0]][0]]);
  double volume = 0, error = 0, absolute = 0;
  for (const std::size_t t : shell) {
    std::array<Xyz_3, 3> v;
    std::array<double, 3> largest;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = minus(xyz(surface.points[surface.triangles[t][i]]), origin);
      largest[i] = std::max({std::abs(v[i][0]), std::abs(v[i][1]), std::abs(v[i][2])});
    }
    const double part = dot_product(v[0], cross_product(v[1], v[2]));
    volume += part, absolute += std::abs(part);
    error += 6e-15 * largest[0] * largest[1] * largest[2]; // see filtered_determinant()
  }
  error += 1.2e-16 * static_cast<double>(shell.size()) * absolute; // of the sum: u for each addition
  if (error > 1e-280 && std::abs(volume) > 1.01 * error) return volume > 0;
  CGAL::MP_Float exact(0);
  for (const std::size_t t : shell) exact = exact + exact_volume(surface, t, origin);
  return CGAL::sign(exact) == CGAL::POSITIVE;
}

/// In how many other shells each shell lies.
/// \pre Shells are closed and meet neither themselves nor each other.
template <class K>
std::vector<int> nesting_depths(const Triangle_surface_3<K>& surface,
                                const std::vector<std::vector<std::size_t>>& shells)
{
  std::vector<int> depths(shells.size(), 0);
  if (shells.size() < 2) return depths;
  for (std::size_t outer = 0; outer < shells.size(); ++outer) {
    std::vector<Surface_triangle_3<K>> triangles;
    for (const std::size_t t : shells[outer]) triangles.push_back(hierarchy_triangle(surface, t));
    const Triangle_hierarchy_3<K> hierarchy(triangles);
    for (std::size_t inner = 0; inner < shells.size(); ++inner)
      if (inner != outer)
        depths[inner] += hierarchy.subdomain(surface.points[surface.triangles[shells[inner][0]][0]]) != 0;
  }
  return depths;
}

/// Turns whole shells over so that the volume lies behind all facets: outermost shells bound it from outside, shells in
/// them are cavities, and so on. Returns the shells that were turned.
/// \pre No self-intersections.
template <class K>
std::vector<std::size_t> orient_shells(Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  std::vector<std::vector<std::size_t>> shells(static_cast<std::size_t>(topology.number_of_shells));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    shells[static_cast<std::size_t>(topology.shells[t])].push_back(t);
  const std::vector<int> depths = nesting_depths(surface, shells);
  std::vector<std::size_t> turned;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (looks_outwards(surface, shells[s]) == (depths[s] % 2 == 0)) continue;
    for (const std::size_t t : shells[s]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    turned.push_back(s);
  }
  return turned;
}

/// All the checks above; turns shells where needed and returns one line that says so, or none.
/// \throws Domain_error.
template <class K>
std::vector<std::string> check_surface_volume(Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  check_flat_shells(surface, topology);
  check_self_intersections(surface, topology.sides);
  const std::vector<std::size_t> turned = orient_shells(surface, topology);
  if (turned.empty()) return {};
  return {counted(turned.size(), "shell was", "shells were") + " inside out and turned over: " + first_few(turned)};
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_CHECK_SURFACE_VOLUME_3_H
