// SPDX-License-Identifier: GPL-3.0-or-later
//
// A progress bar for the command-line programs.

#ifndef WEFT_EXAMPLES_PROGRESS_BAR_H
#define WEFT_EXAMPLES_PROGRESS_BAR_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace command_line {

/// A bar on the last line of the terminal that standard error is; nothing at all if it isn't one.
class Progress_bar
{
public:
  explicit Progress_bar(bool wanted) : is_shown_(wanted && is_terminal()) {}
  ~Progress_bar() { clear(); }
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// \param part in [0, 1]; the bar never goes back.
  /// \param text what is being done, some 45 characters.
  void show(double part, const std::string& text)
  {
    using namespace std::chrono;
    part_ = std::clamp(part, part_, 1.);
    const auto now = steady_clock::now();
    if (!is_shown_ || now - last_ < milliseconds(80)) return;
    last_ = now;
    constexpr std::size_t width = 28;
    const auto full = static_cast<std::size_t>(part_ * static_cast<double>(width));
    const std::string line = "[" + std::string(full, '#') + std::string(width - full, '.') + "] " + text;
    std::fprintf(stderr, "\r%.78s\033[K", line.c_str());
    std::fflush(stderr);
    is_dirty_ = true;
  }

  /// Removes the bar and begins anew.
  void clear()
  {
    part_ = 0;
    if (!is_dirty_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    is_dirty_ = false;
  }

private:
  static bool is_terminal()
  {
#ifdef _WIN32
    return _isatty(_fileno(stderr));
#else
    return isatty(STDERR_FILENO);
#endif
  }

  bool is_shown_, is_dirty_ = false;
  double part_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

} // namespace command_line

#endif // WEFT_EXAMPLES_PROGRESS_BAR_H
