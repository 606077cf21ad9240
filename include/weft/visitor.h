// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a caller watches a run and stops it: a callable that receives `Progress` and returns whether to go on. It is
// called between steps, always from the thread that called the mesher, and whenever it is called the mesh is valid. And
// why runs end.

#ifndef WEFT_VISITOR_H
#define WEFT_VISITOR_H

#include <cstddef>
#include <functional>

namespace weft {

/// What a run is doing.
enum class Stage
{
  constraints, ///< sampling constraints
  seeding,     ///< placing vertices inside
  relaxation,  ///< moving vertices
  refinement,  ///< inserting Steiner points
  polishing    ///< improving the worst elements
};

/// Name of a stage for people.
inline const char* name(Stage stage)
{
  switch (stage) {
  case Stage::constraints:
    return "sampling constraints";
  case Stage::seeding:
    return "seeding";
  case Stage::relaxation:
    return "relaxation";
  case Stage::refinement:
    return "refinement";
  default:
    return "polishing";
  }
}

/// A moment of a run.
struct Progress
{
  Stage stage;
  std::size_t vertices; ///< vertices of the mesh so far
  std::size_t bad;      ///< elements that violated a criterion when last counted
  double seconds;       ///< wall time since the run began
};

/// Why a run ended.
enum class Stop_reason
{
  criteria_met,
  iteration_limit,
  vertex_budget,
  time_limit,
  cancelled,
  exhausted, ///< nothing more can be done about the elements that are still bad
  resolution ///< elements would be smaller than coordinates can tell apart
};

/// Name of a stop reason for people.
inline const char* name(Stop_reason reason)
{
  switch (reason) {
  case Stop_reason::criteria_met:
    return "all criteria met";
  case Stop_reason::iteration_limit:
    return "iteration limit reached";
  case Stop_reason::vertex_budget:
    return "vertex budget reached";
  case Stop_reason::time_limit:
    return "time limit reached";
  case Stop_reason::cancelled:
    return "cancelled";
  case Stop_reason::exhausted:
    return "nothing more can be done about what is still bad";
  default:
    return "resolution of coordinates reached";
  }
}

/// Called with the progress of a run; returning false ends the run early, with a valid mesh.
using Visitor = std::function<bool(const Progress&)>;

} // namespace weft

#endif // WEFT_VISITOR_H
