// SPDX-License-Identifier: GPL-3.0-or-later
//
// A growing set of points in space, each with a distance that it keeps others away, in a grid of cubes.

#ifndef WEFT_INTERNAL_BOXES_POINT_GRID_3_H
#define WEFT_INTERNAL_BOXES_POINT_GRID_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace weft::internal {

class Point_grid_3
{
public:
  /// \param cell side of the cubes, about the least of the distances.
  explicit Point_grid_3(double cell) : cell_(cell) {}

  /// Adds a point unless one that was added before is nearer to it than that; whether it was added.
  bool add(const Xyz_3& p, double distance)
  {
    const Key low = key({{p[0] - distance, p[1] - distance, p[2] - distance}}),
              high = key({{p[0] + distance, p[1] + distance, p[2] + distance}});
    Key k;
    for (k[0] = low[0]; k[0] <= high[0]; ++k[0])
      for (k[1] = low[1]; k[1] <= high[1]; ++k[1])
        for (auto place = points_.lower_bound({{k[0], k[1], low[2]}});
             place != points_.end() && place->first <= Key{{k[0], k[1], high[2]}}; ++place)
          for (const Xyz_3& q : place->second)
            if (norm(minus(p, q)) < distance) return false;
    points_[key(p)].push_back(p);
    return true;
  }

private:
  using Key = std::array<std::int64_t, 3>;

  Key key(const Xyz_3& p) const
  {
    return {{static_cast<std::int64_t>(std::floor(p[0] / cell_)), static_cast<std::int64_t>(std::floor(p[1] / cell_)),
             static_cast<std::int64_t>(std::floor(p[2] / cell_))}};
  }

  double cell_;
  std::map<Key, std::vector<Xyz_3>> points_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_POINT_GRID_3_H
