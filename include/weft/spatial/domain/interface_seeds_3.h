// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points on the interfaces of a domain that is known by labels: where the edges of a grid change their label, collected
// to connected parts. Not meant for users.

#ifndef WEFT_SPATIAL_DOMAIN_INTERFACE_SEEDS_3_H
#define WEFT_SPATIAL_DOMAIN_INTERFACE_SEEDS_3_H

#include <weft/internal/as_index.h>
#include <weft/internal/boxes/farthest_points_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/domain/oracle_hits_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// A grid of cubes over a box, one cube wider on each side.
class Seed_grid_3
{
public:
  Seed_grid_3(const CGAL::Bbox_3& b, int parts)
  {
    const std::array<double, 3> sides{{b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()}};
    step_ = *std::max_element(sides.begin(), sides.end()) / parts;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cubes = std::ceil(sides[k] / step_ - 1e-9);
      n_[k] = static_cast<int>(cubes) + 3;
      low_[k] = (k == 0 ? b.xmin() : k == 1 ? b.ymin() : b.zmin()) - step_ - 0.5 * (cubes * step_ - sides[k]);
    }
  }

  std::size_t size() const { return as_index(n_[0]) * as_index(n_[1]) * as_index(n_[2]); }
  int count(std::size_t axis) const { return n_[axis]; }
  std::size_t index(const std::array<int, 3>& at) const
  {
    return (as_index(at[2]) * as_index(n_[1]) + as_index(at[1])) * as_index(n_[0]) + as_index(at[0]);
  }
  template <class Point>
  Point point(const std::array<int, 3>& at) const
  {
    return Point(low_[0] + at[0] * step_, low_[1] + at[1] * step_, low_[2] + at[2] * step_);
  }

  template <class Visit>
  void for_each(const Visit& visit) const
  {
    std::array<int, 3> at;
    for (at[2] = 0; at[2] < n_[2]; ++at[2])
      for (at[1] = 0; at[1] < n_[1]; ++at[1])
        for (at[0] = 0; at[0] < n_[0]; ++at[0]) visit(at);
  }

private:
  std::array<int, 3> n_;
  std::array<double, 3> low_;
  double step_;
};

/// By patch and connected part, points of it. Parts hang together where they cross the same cube.
template <class K, class Oracle>
std::vector<std::vector<std::vector<typename K::Point_3>>> interface_seeds_3(const Oracle& oracle, int parts)
{
  using Point = typename K::Point_3;
  const Seed_grid_3 grid(oracle.bbox(), parts);
  std::vector<int> labels(grid.size());
  grid.for_each(
      [&](const std::array<int, 3>& at) { labels[grid.index(at)] = oracle.subdomain(grid.template point<Point>(at)); });
  std::vector<Surface_hit_3<K>> hits;
  std::map<std::pair<std::size_t, int>, std::size_t> hit_in_cube; // by cube and patch
  std::vector<std::pair<std::size_t, std::size_t>> joined;
  grid.for_each([&](const std::array<int, 3>& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<int, 3> next = at;
      if (++next[axis] >= grid.count(axis)) continue;
      const int a = labels[grid.index(at)], b = labels[grid.index(next)];
      if (a == b) continue;
      hits.push_back(oracle.crossing(grid.template point<Point>(at), grid.template point<Point>(next), a, b));
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int k = 0; k < 4; ++k) { // the cubes around the edge
        std::array<int, 3> cube = at;
        cube[u] -= k & 1;
        cube[v] -= k >> 1;
        if (cube[u] < 0 || cube[v] < 0) continue;
        const auto [first, is_new] = hit_in_cube.try_emplace({grid.index(cube), hits.back().patch}, hits.size() - 1);
        if (!is_new) joined.emplace_back(first->second, hits.size() - 1);
      }
    }
  });
  Disjoint_parts sets(hits.size());
  for (const auto& [i, j] : joined) sets.unite(i, j);
  std::vector<std::vector<std::vector<Point>>> seeds;
  std::map<std::size_t, std::size_t> part_of; // by first hit
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].patch < 0) continue;
    const auto patch = static_cast<std::size_t>(hits[i].patch);
    if (patch >= seeds.size()) seeds.resize(patch + 1);
    const auto [part, is_new] = part_of.try_emplace(sets.find(i), seeds[patch].size());
    if (is_new) seeds[patch].emplace_back();
    seeds[patch][part->second].push_back(hits[i].point);
  }
  return seeds;
}

/// n well-spread points of each part, or all where there are fewer.
template <class K>
std::vector<Surface_hit_3<K>> spread_over_parts(const std::vector<std::vector<typename K::Point_3>>& parts, int patch,
                                                std::size_t n)
{
  std::vector<Surface_hit_3<K>> hits;
  for (const auto& part : parts) {
    std::vector<Candidate<typename K::Point_3>> candidates;
    for (const auto& p : part) candidates.emplace_back(p, 0);
    for (const auto& chosen : farthest_points(candidates, n)) hits.push_back({chosen.first, patch});
  }
  return hits;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_INTERFACE_SEEDS_3_H
