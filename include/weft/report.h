// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a mesher did: counts, worst elements, which criteria hold, why it stopped and where the time went.

#ifndef WEFT_REPORT_H
#define WEFT_REPORT_H

#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Why a run ended.
enum class Stop_reason
{
  criteria_met,
  iteration_limit,
  vertex_budget,
  time_limit,
  cancelled,
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
  default:
    return "resolution of coordinates reached";
  }
}

/// Result of `make_mesh_2()` and `relax_2()`.
struct Mesh_report_2
{
  std::size_t input_vertices = 0;     ///< vertices before
  std::size_t vertices = 0;           ///< vertices after
  std::size_t constraint_steiner = 0; ///< of them, inserted on constraints
  std::size_t interior_steiner = 0;   ///< of them, inserted inside
  std::size_t triangles = 0;          ///< triangles in the domain

  double smallest_angle = 0, largest_angle = 0; ///< degrees, over all triangles in the domain
  double largest_ratio = 0;        ///< of longest edge to target size, over triangles and constrained edges
  std::size_t oversized = 0;       ///< triangles and constrained edges whose ratio exceeds 1
  std::size_t below_min_angle = 0; ///< triangles below the requested smallest angle, input angles apart
  std::size_t at_input_angle = 0;  ///< triangles below it that hold an input angle below it

  std::size_t batches = 0, sweeps = 0, flips = 0;
  std::size_t moves = 0;    ///< single vertex moves of the relaxation
  std::size_t put_back = 0; ///< of them, not carried out since a triangle would have turned over
  std::size_t polished = 0; ///< vertex moves of the polishing

  Stop_reason stop_reason = Stop_reason::criteria_met;
  std::vector<std::pair<std::string, double>> stage_seconds; ///< wall time by stage, in order

  std::size_t steiner() const { return constraint_steiner + interior_steiner; }
  /// Whether every requested criterion holds.
  bool ok() const { return stop_reason == Stop_reason::criteria_met && oversized == 0 && below_min_angle == 0; }
};

/// Several lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Mesh_report_2& r)
{
  out << r.vertices << " vertices (" << r.input_vertices << " given, " << r.constraint_steiner << " on constraints, "
      << r.interior_steiner << " inside), " << r.triangles << " triangles\n"
      << "angles " << r.smallest_angle << " to " << r.largest_angle << " degrees, largest edge / size "
      << r.largest_ratio << "\n"
      << name(r.stop_reason);
  if (r.oversized) out << ", " << r.oversized << " elements too large";
  if (r.below_min_angle) out << ", " << r.below_min_angle << " triangles below the smallest angle asked for";
  if (r.at_input_angle) out << ", " << r.at_input_angle << " at input angles below it";
  out << "\n" << r.batches << " batches, " << r.sweeps << " sweeps, " << r.flips << " flips;";
  for (const auto& [stage, seconds] : r.stage_seconds) out << " " << stage << " " << seconds << " s";
  return out << "\n";
}

} // namespace weft

#endif // WEFT_REPORT_H
