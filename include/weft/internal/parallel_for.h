// SPDX-License-Identifier: GPL-3.0-or-later
//
// One loop for one and for many threads: oneTBB where it is linked, else a plain loop. The body writes only what
// belongs to its own index, so the result is the same for every number of threads.

#ifndef WEFT_INTERNAL_PARALLEL_FOR_H
#define WEFT_INTERNAL_PARALLEL_FOR_H

#include <weft/internal/cold.h>

#include <cstddef>

#ifdef WEFT_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <map>
#endif

namespace weft::internal {

#ifdef WEFT_LINKED_WITH_TBB
/// Where loops of this thread run on so many threads: making an arena takes longer than many a loop.
WEFT_NOINLINE inline tbb::task_arena& arena(int threads)
{
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

/// Calls `run(body, first, last)` for parts of [0, n) of about `grain`. Not a template: oneTBB takes long to compile.
WEFT_NOINLINE inline void run_parts(std::size_t n, int threads, std::size_t grain,
                                    void (*run)(const void*, std::size_t, std::size_t), const void* body)
{
  // What oneTBB sees to anyway, where ThreadSanitizer sees it.
  std::atomic<int> begun{0}, ended{0};
  begun.store(1, std::memory_order_release);
  arena(threads).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
      static_cast<void>(begun.load(std::memory_order_acquire));
      run(body, range.begin(), range.end());
      ended.fetch_add(1, std::memory_order_release);
    });
  });
  static_cast<void>(ended.load(std::memory_order_acquire));
}
#endif

/// Calls `body(i)` for i in [0, n), on at most `threads` threads.
/// \param grain the fewest of them that a thread takes at once.
template <class Body>
void parallel_for(std::size_t n, int threads, const Body& body, std::size_t grain = 512)
{
#ifdef WEFT_LINKED_WITH_TBB
  const auto run = [](const void* of, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i != last; ++i) (*static_cast<const Body*>(of))(i);
  };
  if (threads > 1 && n > 2 * grain)
    run_parts(n, threads, grain, run, &body);
  else
    run(&body, 0, n);
#else
  static_cast<void>(threads);
  static_cast<void>(grain);
  for (std::size_t i = 0; i < n; ++i) body(i);
#endif
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_PARALLEL_FOR_H
