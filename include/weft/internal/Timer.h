// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wall clock for budgets and stage times.

#ifndef WEFT_INTERNAL_TIMER_H
#define WEFT_INTERNAL_TIMER_H

#include <chrono>

namespace weft::internal {

/// Seconds since construction.
class Timer
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Seconds between calls.
class Lap_timer
{
public:
  /// Since the last call, or construction.
  double seconds()
  {
    const double now = timer_.seconds(), lap = now - last_;
    last_ = now;
    return lap;
  }

private:
  Timer timer_;
  double last_ = 0;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_TIMER_H
