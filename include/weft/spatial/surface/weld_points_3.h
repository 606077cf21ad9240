// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points are to be one: those with equal coordinates, or those near to an earlier one, found in a grid of cubes.

#ifndef WEFT_SPATIAL_SURFACE_WELD_POINTS_3_H
#define WEFT_SPATIAL_SURFACE_WELD_POINTS_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace weft::internal {

/// Of each point the first one with its coordinates. O(n log n).
inline std::vector<std::size_t> weld_equal_points(const std::vector<Xyz_3>& points)
{
  std::vector<std::size_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[a] != points[b] ? points[a] < points[b] : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? place[order[i - 1]] : order[i];
  return place;
}

/// Welds points one after the other to the nearest of those before it that stay and are within the tolerance. Chains
/// don't drift: no point moves farther than that. Changes `place`, where points say which they are now.
/// \param candidates the points in question, each of which stays so far.
/// \returns how many were welded. O(n) unless many points are within the tolerance of each other.
inline std::size_t weld_near_points(const std::vector<Xyz_3>& points, const std::vector<std::size_t>& candidates,
                                    double tolerance, std::vector<std::size_t>& place)
{
  if (!(tolerance > 0)) return 0;
  using Key = std::array<std::int64_t, 3>;
  struct Hash
  {
    std::size_t operator()(const Key& key) const
    {
      std::uint64_t h = 0;
      for (const std::int64_t k : key) h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<Key, std::vector<std::size_t>, Hash> grid;
  const auto coordinate = [cell = 2 * tolerance](double x) {
    return static_cast<std::int64_t>(std::floor((std::max)(-4e18, (std::min)(4e18, x / cell))));
  };
  std::size_t welded = 0;
  for (const std::size_t v : candidates) {
    const Xyz_3& p = points[v];
    std::size_t nearest = v;
    double least = tolerance;
    Key low, high, key;
    for (std::size_t k = 0; k < 3; ++k) low[k] = coordinate(p[k] - tolerance), high[k] = coordinate(p[k] + tolerance);
    for (key[0] = low[0]; key[0] <= high[0]; ++key[0])
      for (key[1] = low[1]; key[1] <= high[1]; ++key[1])
        for (key[2] = low[2]; key[2] <= high[2]; ++key[2]) {
          const auto cube = grid.find(key);
          if (cube == grid.end()) continue;
          for (const std::size_t w : cube->second) {
            const double distance = norm(minus(p, points[w]));
            if (distance > least || (distance == least && w > nearest)) continue;
            least = distance;
            nearest = w;
          }
        }
    if (nearest == v) {
      grid[{{coordinate(p[0]), coordinate(p[1]), coordinate(p[2])}}].push_back(v);
    } else {
      place[v] = nearest;
      ++welded;
    }
  }
  if (welded > 0)
    for (std::size_t& v : place) v = place[v];
  return welded;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_WELD_POINTS_3_H
