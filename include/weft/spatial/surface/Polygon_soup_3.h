// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface as plain arrays: what the readers return and `piecewise_smooth_complex()` takes. Groups of its polygons may
// name what they bound: `mended_complex_3()`.

#ifndef WEFT_SPATIAL_SURFACE_POLYGON_SOUP_3_H
#define WEFT_SPATIAL_SURFACE_POLYGON_SOUP_3_H

#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// Points and polygons that refer to them by position; nothing is promised about how the polygons fit together.
/// \tparam K a CGAL kernel.
template <class K>
struct Polygon_soup_3
{
  using Kernel = K;
  using Point = typename K::Point_3;

  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons; ///< corners in order, counterclockwise seen from outside

  std::string name = {};                     ///< of what the surface bounds; may be empty
  std::vector<std::size_t> groups = {};      ///< of each polygon, a position in `group_names`; empty: none has one
  std::vector<std::string> group_names = {}; ///< of solids, materials or colours; may be empty strings
  bool groups_are_solids = false;            ///< whether each group bounds a solid, rather than being a part of one
};

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_POLYGON_SOUP_3_H
