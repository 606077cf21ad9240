// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of the facets of a surface, such as the solids of a file, its materials or colours: do they bound regions of
// their own? Then these are subdomains with their names. Groups that are parts of one boundary don't divide anything.

#ifndef WEFT_SPATIAL_SURFACE_SURFACE_GROUPS_3_H
#define WEFT_SPATIAL_SURFACE_SURFACE_GROUPS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/surface_topology_3.h>
#include <weft/spatial/surface/weld_points_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// What groups of a surface bound by themselves.
template <class K>
struct Surface_solids_3
{
  std::vector<Polygon_soup_3<K>> surfaces; ///< on the points of the whole; empty if groups bound nothing by themselves
  std::vector<double> volumes;             ///< of each
};

/// An edge of a polygon that belongs to a group.
struct Group_side_3
{
  std::size_t low, high, group;
  bool operator<(const Group_side_3& other) const
  {
    return std::array<std::size_t, 3>{low, high, group} <
           std::array<std::size_t, 3>{other.low, other.high, other.group};
  }
};

/// Groups that meet in an edge where one of them is open are parts of one surface. If there are several of these, each
/// nearly closed and all turned the same way, each bounds a solid; one that is turned the other way may be a cavity.
/// O(n log n) for n corners.
template <class K>
Surface_solids_3<K> solids_of_groups(const Polygon_soup_3<K>& soup)
{
  constexpr double most_open = 0.2; // of the edges
  Surface_solids_3<K> result;
  const std::size_t n = soup.group_names.size();
  if (n < 2 || soup.groups.size() != soup.polygons.size()) return result;
  std::vector<Xyz_3> points;
  for (const auto& p : soup.points) points.push_back(xyz(p));
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (const std::size_t v : soup.polygons[f])
      if (v >= points.size() || soup.groups[f] >= n || !std::isfinite(norm(points[v]))) return result;
  const std::vector<std::size_t> place = weld_equal_points(points);
  std::vector<Group_side_3> sides;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (std::size_t i = 0, m = soup.polygons[f].size(); i < m; ++i) {
      const auto [low, high] = std::minmax(place[soup.polygons[f][i]], place[soup.polygons[f][(i + 1) % m]]);
      if (low != high) sides.push_back({low, high, soup.groups[f]});
    }
  std::sort(sides.begin(), sides.end());
  Disjoint_parts united(n);
  const auto is_open = [](auto first, auto last, std::size_t group) {
    return std::count_if(first, last, [&](const Group_side_3& s) { return s.group == group; }) % 2 == 1;
  };
  for_each_edge(sides, [&](auto first, auto last) {
    if (first->group == (last - 1)->group) return;
    if (std::none_of(first, last, [&](const Group_side_3& s) { return is_open(first, last, s.group); })) return;
    for (auto s = first; s != last; ++s) united.unite(first->group, s->group);
  });
  std::vector<std::size_t> edges(n, 0), open(n, 0);
  for_each_edge(sides, [&](auto first, auto last) {
    std::map<std::size_t, std::size_t> count;
    for (; first != last; ++first) ++count[united.find(first->group)];
    for (const auto& [surface, times] : count) ++edges[surface], open[surface] += times % 2;
  });
  std::map<std::size_t, std::size_t> number;
  std::vector<Xyz_3> origins;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    if (soup.polygons[f].empty()) continue;
    const std::size_t all = united.find(soup.groups[f]);
    if (static_cast<double>(open[all]) > most_open * static_cast<double>(edges[all])) return {};
    const auto [at, is_new] = number.try_emplace(all, result.surfaces.size());
    if (is_new) {
      result.surfaces.push_back({soup.points, {}, "", {}, soup.group_names, soup.groups_are_solids});
      result.volumes.push_back(0);
      origins.push_back(points[soup.polygons[f][0]]);
    }
    result.surfaces[at->second].polygons.push_back(soup.polygons[f]);
    result.surfaces[at->second].groups.push_back(soup.groups[f]);
    const auto from = [&](std::size_t i) { return minus(points[soup.polygons[f][i]], origins[at->second]); };
    for (std::size_t i = 2; i < soup.polygons[f].size(); ++i)
      result.volumes[at->second] += dot_product(from(0), cross_product(from(i - 1), from(i)));
  }
  const auto [least, most] = std::minmax_element(result.volumes.begin(), result.volumes.end());
  if (result.surfaces.size() < 2 || *least * *most <= 0) return {};
  for (auto& surface : result.surfaces) {
    const std::set<std::size_t> groups(surface.groups.begin(), surface.groups.end());
    if (groups.size() == 1) surface.name = soup.group_names[*groups.begin()];
  }
  for (double& volume : result.volumes) volume = std::abs(volume) / 6;
  return result;
}

/// Makes names that are there several times differ, by numbers from 2 on.
inline void make_names_differ(std::vector<std::string>& names)
{
  std::set<std::string> used;
  for (std::string& name : names) {
    if (name.empty()) continue;
    const std::string given = name;
    for (int i = 2; !used.insert(name).second; ++i) name = given + " " + std::to_string(i);
  }
}

/// The names of subdomains, from 1: a group that has nearly all of what lies between a subdomain and the outside, or of
/// its whole boundary if it has none of the outside, names it. None if fewer than two groups do.
/// \param sides of each triangle, the subdomains behind and before it.
/// \param origins of each triangle, the facet that it is part of.
template <class K, class Triangles>
std::vector<std::string> names_of_subdomains(const std::vector<typename K::Point_3>& points, const Triangles& triangles,
                                             const std::vector<std::pair<int, int>>& sides,
                                             const std::vector<std::size_t>& origins, const Polygon_soup_3<K>& soup)
{
  constexpr double nearly_all = 0.98;
  if (soup.groups.size() != soup.polygons.size()) return {};
  struct Boundary
  {
    std::map<std::size_t, double> outer, all; // areas by group
  };
  std::map<int, Boundary> boundaries;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const Xyz_3 a = xyz(points[triangles[t][0]]), b = xyz(points[triangles[t][1]]), c = xyz(points[triangles[t][2]]);
    const double area = norm(cross_product(minus(b, a), minus(c, a)));
    const std::size_t group = soup.groups[origins[t]];
    const auto [behind, before] = sides[t];
    for (const auto& [one, other] : {std::make_pair(behind, before), std::make_pair(before, behind)}) {
      if (one == 0) continue;
      boundaries[one].all[group] += area;
      if (other == 0) boundaries[one].outer[group] += area;
    }
  }
  std::vector<std::string> names;
  std::set<std::size_t> naming;
  for (const auto& [subdomain, boundary] : boundaries) {
    const auto& areas = boundary.outer.empty() ? boundary.all : boundary.outer;
    double sum = 0;
    auto most = areas.begin();
    for (auto at = areas.begin(); at != areas.end(); ++at) {
      sum += at->second;
      if (at->second > most->second) most = at;
    }
    names.resize(static_cast<std::size_t>(subdomain));
    if (most->second < nearly_all * sum || soup.group_names[most->first].empty()) continue;
    names.back() = soup.group_names[most->first];
    naming.insert(most->first);
  }
  if (naming.size() < 2) return {};
  make_names_differ(names);
  return names;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_SURFACE_GROUPS_3_H
