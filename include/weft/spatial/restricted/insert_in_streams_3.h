// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inserts many points into a spatial Delaunay triangulation in streams: each follows a stretch of a space-filling
// curve, so that points of different streams are far apart and several threads look for their conflict zones at once.
// Those that are independent are inserted then, the others after them.

#ifndef WEFT_SPATIAL_RESTRICTED_INSERT_IN_STREAMS_3_H
#define WEFT_SPATIAL_RESTRICTED_INSERT_IN_STREAMS_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Handle_marks.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Inserts points; those where there is a vertex already are left out. The result is the same for any number of
/// threads.
/// \param points in rounds, in each of them along a curve: the last one has about seven eighths of them.
/// \param near a cell where to begin.
/// \param batches counted up for each set of independent zones.
/// \param insert `insert(zone, i)` inserts point i and returns its vertex.
template <class Triangulation, class Insert>
void insert_in_streams_3(const Triangulation& tr, const std::vector<typename Triangulation::Point>& points,
                         typename Triangulation::Cell_handle near, int threads, int& batches, const Insert& insert)
{
  using Cell_handle = typename Triangulation::Cell_handle;
  struct Stream
  {
    std::size_t next, end;
    typename Triangulation::Vertex_handle last; ///< inserted
    Conflict_zone_3<Triangulation> zone;
    Zone_result result = Zone_result::no_conflict;
    bool is_late = false;
  };
  constexpr std::size_t number = 32, least_length = 64;
  const std::size_t n = points.size();
  const std::size_t first = n < 2 * number * least_length ? n : n / 8; // until then one by one
  Conflict_zone_3<Triangulation> zone;
  for (std::size_t i = 0; i < first; ++i)
    if (find_conflict_zone(tr, points[i], near, zone) == Zone_result::found) near = insert(zone, i)->cell();
  if (first == n) return;
  std::vector<Stream> streams(number);
  for (std::size_t s = 0; s < number; ++s) {
    streams[s].next = first + s * (n - first) / number;
    streams[s].end = first + (s + 1) * (n - first) / number;
  }
  const auto find = [&](Stream& s, bool aside) {
    const auto& p = points[s.next];
    const Cell_handle start = tr.locate(p, s.last == decltype(s.last)() ? near : s.last->cell());
    thread_local Handle_marks marks;
    s.result = aside ? find_conflict_zone_aside(tr, p, start, no_batch, s.zone, marks)
                     : find_conflict_zone(tr, p, start, no_batch, s.zone);
  };
  for (std::size_t step = 0; step < (n - first) / number + 1; ++step) {
    parallel_for(
        number, threads,
        [&](std::size_t s) {
          if (streams[s].next < streams[s].end) find(streams[s], threads > 1);
        },
        1);
    ++batches;
    for (Stream& s : streams) {
      if (s.next == s.end || s.result != Zone_result::found) continue;
      s.is_late = std::any_of(s.zone.cells.begin(), s.zone.cells.end(),
                              [batches](Cell_handle c) { return c->batch() == batches; });
      if (!s.is_late) claim(s.zone, batches);
    }
    for (Stream& s : streams)
      if (s.next < s.end && s.result == Zone_result::found && !s.is_late) s.last = insert(s.zone, s.next);
    near = Cell_handle();
    for (Stream& s : streams) {
      if (s.next == s.end) continue;
      if (s.is_late) {
        find(s, false);
        if (s.result == Zone_result::found) s.last = insert(s.zone, s.next);
      }
      s.is_late = false;
      if (near == Cell_handle() && s.last != decltype(s.last)()) near = s.last->cell();
      ++s.next;
    }
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_INSERT_IN_STREAMS_3_H
