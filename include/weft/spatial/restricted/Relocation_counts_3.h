// SPDX-License-Identifier: GPL-3.0-or-later
//
// What became of vertices that were moved many at once, and how long that took.

#ifndef WEFT_SPATIAL_RESTRICTED_RELOCATION_COUNTS_3_H
#define WEFT_SPATIAL_RESTRICTED_RELOCATION_COUNTS_3_H

#include <cstddef>

namespace weft::internal {

/// What became of a set of moves in space.
struct Relocation_counts_3
{
  std::size_t in_place = 0;   ///< vertices that moved with the cells around them, whether or not those were flipped
  std::size_t one_by_one = 0; ///< vertices that were taken away and put back
  std::size_t rebuilt = 0;    ///< vertices that moved when the triangulation was built anew
  std::size_t put_back = 0;   ///< vertices that stayed where they were
  std::size_t flips = 0;
  std::size_t regions = 0; ///< places where flips were stuck and a few cells were built anew
  std::size_t stuck = 0;   ///< facets that weren't Delaunay after that
  std::size_t rebuilds = 0;
  // Wall time:
  double moving_seconds = 0;      ///< moving vertices and putting those back that would turn cells over
  double flipping_seconds = 0;    ///< finding what isn't Delaunay, and flips
  double rebuilding_seconds = 0;  ///< moving vertices one by one, or building anew
  double classifying_seconds = 0; ///< finding out what the new cells and facets are

  Relocation_counts_3& operator+=(const Relocation_counts_3& o)
  {
    in_place += o.in_place;
    one_by_one += o.one_by_one;
    rebuilt += o.rebuilt;
    put_back += o.put_back;
    flips += o.flips;
    regions += o.regions;
    stuck += o.stuck;
    rebuilds += o.rebuilds;
    add_times(o);
    return *this;
  }

  void add_times(const Relocation_counts_3& o)
  {
    moving_seconds += o.moving_seconds;
    flipping_seconds += o.flipping_seconds;
    rebuilding_seconds += o.rebuilding_seconds;
    classifying_seconds += o.classifying_seconds;
  }
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_RELOCATION_COUNTS_3_H
