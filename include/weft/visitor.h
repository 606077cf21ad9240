// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a caller watches a run and stops it: a callable that receives `Progress` and returns whether to go on. It is
// called between steps, always from the thread that called the mesher, and whenever it is called the mesh is valid.

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

/// Called with the progress of a run; returning false ends the run early, with a valid mesh.
using Visitor = std::function<bool(const Progress&)>;

} // namespace weft

#endif // WEFT_VISITOR_H
