// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C as a wish that a program looks at when it suits it.

#ifndef WEFT_EXAMPLES_INTERRUPTION_H
#define WEFT_EXAMPLES_INTERRUPTION_H

#include <atomic>
#include <csignal>
#include <ctime>
#include <initializer_list>

namespace command_line {

/// Turns Ctrl-C (or SIGTERM) into a wish that a program looks at when it suits it. Another one a second later or more
/// ends the program as usual; sooner it is the same wish, which some senders deliver twice.
class Interruption
{
public:
  Interruption()
  {
    for (const int signal : {SIGINT, SIGTERM})
      if (std::signal(signal, note) == SIG_IGN) std::signal(signal, SIG_IGN); // as nohup wants it
  }
  static bool wished() { return first_ != 0; }

private:
  static void note(int signal)
  {
    const auto now = static_cast<long>(std::time(nullptr));
    if (first_ == 0) first_ = now;
    // Some systems restore the default before they call this.
    std::signal(signal, now > first_ + 1 ? SIG_DFL : note);
    if (now > first_ + 1) std::raise(signal);
  }
  static inline std::atomic<long> first_{0}; // lock-free, as a signal handler needs it
};

} // namespace command_line

#endif // WEFT_EXAMPLES_INTERRUPTION_H
