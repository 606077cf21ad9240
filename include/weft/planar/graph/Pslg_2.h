// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar straight line graph as plain arrays: what the readers return and `insert_pslg()` takes.

#ifndef WEFT_PLANAR_GRAPH_PSLG_2_H
#define WEFT_PLANAR_GRAPH_PSLG_2_H

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// What to do with segments that cross or overlap.
enum class Crossings
{
  refuse, ///< throw Domain_error
  split   ///< make the crossing a vertex, and the common part of overlapping segments one constraint
};

/// Planar straight line graph: points, segments between them, and optional marks.
/// \tparam K a CGAL kernel.
template <class K>
struct Pslg_2
{
  using Point = typename K::Point_2;

  std::vector<Point> points;
  std::vector<std::array<std::size_t, 2>> segments; ///< pairs of indices into `points`
  std::vector<int> point_markers;                   ///< one per point, or empty
  std::vector<int> segment_markers;                 ///< one per segment, or empty
  std::vector<Point> holes;                         ///< one point in each hole; empty: domain by nesting parity

  /// A point inside a region with the mark that its triangles carry in files.
  struct Region
  {
    Point point;
    int marker;
  };
  std::vector<Region> regions;

  std::size_t first_number = 0; ///< what messages call the first point and the first segment: 0 or 1, as the file does
};

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_PSLG_2_H
