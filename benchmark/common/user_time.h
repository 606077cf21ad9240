// SPDX-License-Identifier: GPL-3.0-or-later
//
// User CPU time, which other load moves less than wall time.

#ifndef WEFT_BENCHMARK_COMMON_USER_TIME_H
#define WEFT_BENCHMARK_COMMON_USER_TIME_H

#include <sys/resource.h>

namespace benchmark {

/// User CPU seconds of this process so far; or of the processes that it has waited for.
inline double user_seconds(int who = RUSAGE_SELF)
{
  rusage usage;
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// User time that can be stopped to measure.
class Stopwatch
{
public:
  double seconds() const { return user_seconds() - start_; }
  /// Runs something that doesn't count.
  template <class Function>
  void pause(const Function& function)
  {
    const double before = user_seconds();
    function();
    start_ += user_seconds() - before;
  }

private:
  double start_ = user_seconds();
};

} // namespace benchmark

#endif // WEFT_BENCHMARK_COMMON_USER_TIME_H
