// SPDX-License-Identifier: GPL-3.0-or-later
//
// One loop for one and for many threads: oneTBB where it is linked, else a plain loop. The body writes only what
// belongs to its own index, so the result is the same for every number of threads.

#ifndef WEFT_INTERNAL_PARALLEL_FOR_H
#define WEFT_INTERNAL_PARALLEL_FOR_H

#include <cstddef>

#ifdef WEFT_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace weft::internal {

/// Calls `body(i)` for i in [0, n), on at most `threads` threads.
/// \param grain the fewest of them that a thread takes at once.
template <class Body>
void parallel_for(std::size_t n, int threads, const Body& body, std::size_t grain = 512)
{
#ifdef WEFT_LINKED_WITH_TBB
  if (threads > 1 && n > 2 * grain) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
      });
    });
    return;
  }
#else
  static_cast<void>(threads);
  static_cast<void>(grain);
#endif
  for (std::size_t i = 0; i < n; ++i) body(i);
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_PARALLEL_FOR_H
