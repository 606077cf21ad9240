// SPDX-License-Identifier: GPL-3.0-or-later
//
// The course of one run of the planar mesher: which stage it is in, how long each took, and whether it is to go on.
// Not meant for users.

#ifndef WEFT_PLANAR_RUN_MESH_RUN_2_H
#define WEFT_PLANAR_RUN_MESH_RUN_2_H

#include <weft/internal/cold.h>
#include <weft/internal/timer.h>
#include <weft/options.h>
#include <weft/report.h>

#include <cstddef>

namespace weft::internal {

class Mesh_run_2
{
public:
  /// Starts the clock. The options are kept by reference.
  explicit Mesh_run_2(const Mesh_options_2& options) : options_(options) {}

  /// Runs a stage, unless the run has been stopped, and adds its time to the report.
  template <class Function>
  void timed(Stage stage, Mesh_report_2& report, const Function& function)
  {
    stage_ = stage;
    const double start = timer_.seconds();
    if (!stopped_) function();
    add_seconds(stage, start, report);
  }

  /// Whether to go on, by the clock and the visitor; notes why not.
  bool go_on(std::size_t vertices, std::size_t bad, Mesh_report_2& report)
  {
    if (stopped_) return false;
    if (timer_.seconds() > options_.time_limit)
      stop(Stop_reason::time_limit, report);
    else if (options_.visitor && !options_.visitor({stage_, vertices, bad, timer_.seconds()}))
      stop(Stop_reason::cancelled, report);
    return !stopped_;
  }

  /// The first reason counts.
  void stop(Stop_reason reason, Mesh_report_2& report)
  {
    if (stopped_) return;
    stopped_ = true;
    report.stop_reason = reason;
  }

  bool is_stopped() const { return stopped_; }

private:
  WEFT_COLD void add_seconds(Stage stage, double start, Mesh_report_2& report) const
  {
    const double seconds = timer_.seconds() - start;
    for (auto& [n, s] : report.stage_seconds)
      if (n == name(stage)) {
        s += seconds;
        return;
      }
    report.stage_seconds.emplace_back(name(stage), seconds);
  }

  const Mesh_options_2& options_;
  Timer timer_;
  Stage stage_ = Stage::constraints;
  bool stopped_ = false;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_MESH_RUN_2_H
