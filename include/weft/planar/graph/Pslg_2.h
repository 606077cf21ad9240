// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar straight line graph as plain arrays: what the readers return and `insert_pslg()` takes.

#ifndef WEFT_PLANAR_GRAPH_PSLG_2_H
#define WEFT_PLANAR_GRAPH_PSLG_2_H

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// What to do with segments that cross, or that overlap where there is no tolerance.
enum class Crossings
{
  refuse, ///< throw Domain_error
  split   ///< make the crossing a vertex, and the common part of overlapping segments one constraint
};

/// What `insert_pslg()` joined or left out. Numbers are indices into the arrays of the input.
struct Pslg_changes
{
  using Pair = std::array<std::size_t, 2>;

  double tolerance = 0;             ///< as a length; 0: exact
  std::vector<Pair> merged_points;  ///< a point, and the one whose vertex it shares though it isn't equal to it
  std::vector<Pair> split_segments; ///< a segment, and a point within the tolerance at which it is split
  std::vector<std::size_t> dropped_segments; ///< length zero, or no longer than the tolerance
  std::vector<Pair> overlapping_segments;    ///< two segments with a common part, which is one constraint
  std::vector<std::string> notes;            ///< the same in words, one sentence a kind; empty if there was nothing

  bool empty() const { return notes.empty(); }
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

  /// A point inside a region with the mark that its triangles carry in files. A region is part of the domain.
  struct Region
  {
    Point point;
    int marker;
    double max_area = 0; ///< largest area of its triangles, for `Region_sizing_2`; 0: no bound
  };
  std::vector<Region> regions;

  std::size_t first_number = 0; ///< what messages call the first point and the first segment: 0 or 1, as the file does
};

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_PSLG_2_H
