// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and report of `improve_2()`.

#ifndef WEFT_PLANAR_RUN_IMPROVE_OPTIONS_2_H
#define WEFT_PLANAR_RUN_IMPROVE_OPTIONS_2_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/report.h>
#include <weft/visitor.h>

#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What may happen to the boundary of a planar mesh, and to the edges between its regions and those it lists.
enum class Boundary_2
{
  slide, ///< vertices between corners slide along it, come and go
  fixed  ///< every such edge stays as it is, to the last bit; only what lies between them changes
};

/// Options of `improve_2()`.
struct Improve_options_2
{
  Boundary_2 boundary = Boundary_2::slide;
  std::vector<std::size_t> fixed_vertices; ///< of the input, that have to stay where they are

  /// Smallest angle in degrees to reach, where angles of the input allow it; 60: as far as it goes.
  double min_angle = 35;
  /// For boundaries that slide: its vertices are corners, which stay, where it turns by this angle or more, in degrees;
  /// 0: all vertices are where it turns at all, so that the domain is exactly that of the input.
  double corner_angle = 20;
  /// For boundaries that slide: how far a curved one may get from that of the input, in parts of the length of edges
  /// nearby.
  double deviation = 0.1;

  /// How many vertices may be added where angles can't be reached otherwise, in parts of those that there are; 20 may
  /// in any case.
  double growth = 0.25;
  double time_limit = std::numeric_limits<double>::infinity(); ///< seconds of wall time
  unsigned seed = 0;                                           ///< start of every random choice
  int threads = 1; ///< threads to use where oneTBB is linked; never changes the result
  Visitor visitor; ///< sees progress, may stop the run; may be empty

  /// \throws Option_error naming the first option outside its range.
  void check() const
  {
    const auto require = [](bool holds, const char* what) {
      if (!holds) throw Option_error(what);
    };
    require(min_angle >= 0 && min_angle <= 60, "min_angle must lie in [0, 60] degrees");
    require(corner_angle >= 0 && corner_angle <= 90, "corner_angle must lie in [0, 90] degrees");
    require(deviation >= 0 && deviation <= 1, "deviation must lie in [0, 1]");
    require(growth >= 0, "growth must not be negative");
    require(time_limit >= 0, "time_limit must not be negative");
    require(threads > 0, "threads must be positive");
  }
};

/// What `improve_2()` did.
struct Improve_report_2
{
  Quality_2 before, after;
  std::size_t inverted_before = 0, inverted_after = 0; ///< triangles that aren't counterclockwise
  std::size_t below_min_angle = 0;                     ///< triangles below the smallest angle asked for
  std::size_t at_input_angle = 0;                      ///< below it since edges that stay meet at less than 60 degrees
  double input_bound = 60; ///< degrees; the smallest angle between edges that stay, if that is below 60
  std::size_t moves = 0, flips = 0;
  Stop_reason stop_reason = Stop_reason::criteria_met;
  std::vector<std::string> notes;                            ///< about the input, for people
  std::vector<std::pair<std::string, double>> stage_seconds; ///< wall time by stage, in order

  /// Whether no triangle is inverted and the run ended by itself, with the angle that was asked for.
  bool ok() const { return stop_reason == Stop_reason::criteria_met && inverted_after == 0; }
};

/// Several lines for a person.
inline std::ostream& operator<<(std::ostream& out, const Improve_report_2& r)
{
  using internal::counted;
  const auto line = [&out](const char* when, const Quality_2& q, std::size_t inverted) {
    out << when << q.vertices << " vertices, " << q.triangles << " triangles, angles " << q.smallest_angle.degrees
        << " to " << q.largest_angle.degrees << " degrees, mean smallest angle " << q.mean_smallest_angle;
    if (inverted) out << "; " << inverted << " inverted";
    out << "\n";
  };
  line("before: ", r.before, r.inverted_before);
  line("after:  ", r.after, r.inverted_after);
  out << counted(r.moves, "move", "moves") << ", " << counted(r.flips, "flip", "flips") << "\n" << name(r.stop_reason);
  if (r.below_min_angle)
    out << ", " << counted(r.below_min_angle, "triangle", "triangles") << " below the smallest angle asked for";
  if (r.at_input_angle) out << ", " << r.at_input_angle << " at angles of the input";
  if (r.input_bound < 60) out << "; edges that stay meet at " << r.input_bound << " degrees";
  out << "\n";
  for (std::size_t i = 0; i < r.stage_seconds.size(); ++i)
    out << (i ? " " : "") << r.stage_seconds[i].first << " " << r.stage_seconds[i].second << " s";
  return out << "\n";
}

} // namespace weft

#endif // WEFT_PLANAR_RUN_IMPROVE_OPTIONS_2_H
