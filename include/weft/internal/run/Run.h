// SPDX-License-Identifier: GPL-3.0-or-later
//
// The course of one run of a mesher: which stage it is in, how long each took, and whether it is to go on.

#ifndef WEFT_INTERNAL_RUN_RUN_H
#define WEFT_INTERNAL_RUN_RUN_H

#include <weft/internal/cold.h>
#include <weft/internal/Timer.h>
#include <weft/visitor.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

class Run
{
public:
  /// Starts the clock.
  /// \param visitor may be empty; has to live as long as this object.
  /// \param time_limit in seconds.
  Run(const Visitor& visitor, double time_limit) : visitor_(visitor), time_limit_(time_limit) {}

  // ---- stages

  /// Ends the stage before. Time is added to that of earlier stages of the same name.
  void begin_stage(const std::string& called, Stage stage)
  {
    end_stage();
    stage_ = stage;
    stage_name_ = called;
    stage_begin_ = timer_.seconds();
  }

  void end_stage()
  {
    if (stage_name_.empty()) return;
    auto stage = std::find_if(stages_.begin(), stages_.end(), [this](const auto& s) { return s.first == stage_name_; });
    if (stage == stages_.end()) stage = stages_.emplace(stage, stage_name_, 0);
    stage->second += timer_.seconds() - stage_begin_;
    stage_name_.clear();
  }

  /// A function as a stage; it isn't called any more when the run has been stopped.
  template <class Function>
  void timed(Stage stage, const Function& function)
  {
    begin_stage(name(stage), stage);
    if (!is_stopped()) function();
    end_stage();
  }

  // ---- whether to go on

  /// Stops the run; the first reason counts.
  /// \returns false.
  bool stop(Stop_reason reason)
  {
    if (!is_stopped()) reason_ = reason;
    return false;
  }

  bool is_stopped() const { return reason_ != Stop_reason::criteria_met; }

  /// Whether there is time left; stops the run otherwise.
  bool has_time() { return timer_.seconds() < time_limit_ || stop(Stop_reason::time_limit); }

  /// Whether neither the visitor nor anything else has stopped the run, and there is time left.
  bool may_go_on() { return !is_stopped() && has_time(); }

  /// Whether the visitor lets the run go on; stops it otherwise. Once it has, the visitor isn't called again.
  bool visit(std::size_t vertices, std::size_t bad)
  {
    if (is_cancelled()) return false;
    return !visitor_ || visitor_({stage_, vertices, bad, timer_.seconds()}) || stop(Stop_reason::cancelled);
  }

  /// All of that.
  WEFT_NOINLINE bool go_on(std::size_t vertices, std::size_t bad) { return may_go_on() && visit(vertices, bad); }

  bool is_cancelled() const { return reason_ == Stop_reason::cancelled; }

  /// Since the run began.
  double seconds() const { return timer_.seconds(); }
  double time_left() const { return (std::max)(0.0, time_limit_ - timer_.seconds()); }

  /// Writes to a report why the run was stopped and what its stages took.
  template <class Report>
  void report(Report& report) const
  {
    report.stop_reason = reason_;
    report.stage_seconds = stages_;
  }

private:
  const Visitor& visitor_;
  double time_limit_;
  Timer timer_;
  Stage stage_ = Stage::constraints;
  std::string stage_name_; ///< empty between stages
  double stage_begin_ = 0;
  std::vector<std::pair<std::string, double>> stages_; ///< seconds by name, in order
  Stop_reason reason_ = Stop_reason::criteria_met;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_RUN_RUN_H
