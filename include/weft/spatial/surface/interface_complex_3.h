// SPDX-License-Identifier: GPL-3.0-or-later
//
// The piecewise smooth complex of triangles that are known to bound subdomains (Tournois 2009, sec. 4.2.1.2): creases
// are where subdomains meet along edges, where the surface is sharp, and where they are given.

#ifndef WEFT_SPATIAL_SURFACE_INTERFACE_COMPLEX_3_H
#define WEFT_SPATIAL_SURFACE_INTERFACE_COMPLEX_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/crease_chains_3.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/surface_complaints_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/box_intersection_d.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/intersections.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Builds the complex of a surface of which `sides` tells the subdomains behind and before each triangle. Where
/// neighbouring triangles have the same, they should be oriented alike. Edges are sharp that are given, are so by their
/// angle, or have other than two triangles with the same subdomains.
/// \throws Domain_error if given edges or vertices aren't those of the surface.
template <class K>
Piecewise_smooth_complex_3<K> interface_complex_3(Triangle_surface_3<K> surface,
                                                  const std::vector<std::pair<int, int>>& sides,
                                                  const Feature_options& options)
{
  const auto sorted = sorted_sides(surface.triangles);
  std::vector<std::array<bool, 3>> is_given(surface.triangles.size(), {false, false, false});
  mark_given_edges(sorted, options.sharp_edges, is_given);
  const bool by_angle = options.sharp_angle > 0 && options.sharp_angle < 180;
  const auto normal = [&](std::size_t t) {
    const auto& [a, b, c] = surface.triangles[t];
    return unit_facet_normal(surface.points[a], surface.points[b], surface.points[c]);
  };
  Sharp_edges_3 sharp;
  Disjoint_parts shells(surface.triangles.size());
  for_each_edge(sorted, [&](auto first, auto last) {
    for (auto other = first + 1; other != last; ++other) shells.unite(first->triangle, other->triangle);
    const auto second = first + 1;
    const bool meet = last - first != 2 || sides[first->triangle] != sides[second->triangle] ||
                      first->forward == second->forward ||
                      is_given[first->triangle][static_cast<std::size_t>(first->side)];
    const bool is_sharp = meet || (by_angle && angle_between(normal(first->triangle), normal(second->triangle)) >=
                                                   options.sharp_angle - angle_tolerance);
    if (is_sharp) sharp.all.push_back({first->low, first->high});
    if (meet) sharp.given.push_back({first->low, first->high});
  });
  Piecewise_smooth_complex_3<K> result;
  const auto given_vertices = given_features(surface, options.tips_and_cusps);
  result.points = std::move(surface.points);
  result.triangles = std::move(surface.triangles);
  drop_short_open_creases<K>(result.points, least_open_crease(result.points, options), sharp);
  derive_features(sharp, sorted, given_vertices, options.cusp_angle, result);
  result.number_of_shells = number_parts(shells, result.triangles.size(), result.shells);
  result.sides.resize(static_cast<std::size_t>(result.number_of_patches));
  for (std::size_t t = 0; t < sides.size(); ++t) result.sides[static_cast<std::size_t>(result.patches[t])] = sides[t];
  drop_unused_points(result);
  return result;
}

/// Whether two triangles have more in common than vertices and an edge that both have.
template <class K>
bool meet_improperly(const Triangle_surface_3<K>& surface, std::size_t s, std::size_t t)
{
  const auto& p = surface.points;
  std::vector<std::size_t> common, only_s, only_t;
  for (const std::size_t v : surface.triangles[s]) {
    const auto& other = surface.triangles[t];
    (std::find(other.begin(), other.end(), v) != other.end() ? common : only_s).push_back(v);
  }
  for (const std::size_t v : surface.triangles[t])
    if (std::find(common.begin(), common.end(), v) == common.end()) only_t.push_back(v);
  const auto triangle = [&](std::size_t i) {
    const auto& [a, b, c] = surface.triangles[i];
    return typename K::Triangle_3(p[a], p[b], p[c]);
  };
  if (common.size() == 3) return true;
  if (common.size() == 2) { // folded flat
    const auto &a = p[common[0]], &b = p[common[1]], &c = p[only_s[0]], &d = p[only_t[0]];
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }
  if (common.size() == 1) // one of the edges opposite to the common vertex passes through the other triangle
    return CGAL::do_intersect(typename K::Segment_3(p[only_s[0]], p[only_s[1]]), triangle(t)) ||
           CGAL::do_intersect(typename K::Segment_3(p[only_t[0]], p[only_t[1]]), triangle(s));
  return CGAL::do_intersect(triangle(s), triangle(t));
}

/// \throws Domain_error where triangles of a surface of any topology intersect, or touch other than in vertices and
/// edges they share. CGAL 5.5 has this for manifold surfaces only.
template <class K>
void check_interfaces_apart(const Triangle_surface_3<K>& surface)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    boxes.emplace_back(surface.points[a].bbox() + surface.points[b].bbox() + surface.points[c].bbox(), t);
  }
  std::vector<std::array<std::size_t, 2>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& s, const Box& t) {
    const std::array<std::size_t, 2> pair = {(std::min)(s.info(), t.info()), (std::max)(s.info(), t.info())};
    if (meet_improperly(surface, pair[0], pair[1])) pairs.push_back(pair);
  });
  if (pairs.empty()) return;
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::size_t> triangles;
  for (const auto& pair : pairs) triangles.insert(triangles.end(), pair.begin(), pair.end());
  const std::string what = counted(pairs.size(), "pair of facets intersects", "pairs of facets intersect or touch");
  refuse(surface, what + ": " + first_few(pairs), corners_of(surface, triangles), triangles);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_INTERFACE_COMPLEX_3_H
