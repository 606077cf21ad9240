// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which smallest angle refinement in the plane works for: the one asked for; once all criteria hold, 25 degrees, as far
// as that is cheap; and 25 degrees, too, where the one asked for can't be had.

#ifndef WEFT_PLANAR_RUN_ANGLE_GOAL_2_H
#define WEFT_PLANAR_RUN_ANGLE_GOAL_2_H

#include <weft/options.h>

#include <algorithm>
#include <cstddef>

namespace weft::internal {

/// A state machine; the mesher says when it changes.
class Angle_goal_2
{
public:
  /// The options are kept by reference.
  explicit Angle_goal_2(const Mesh_options_2& options) : options_(options), degrees_(options.min_angle) {}

  /// The angle to refine for now.
  double degrees() const { return degrees_; }

  /// To be called when all sizes hold; the first call counts.
  void note_sizes_hold(std::size_t vertices)
  {
    if (sized_vertices_ == 0) sized_vertices_ = vertices;
  }

  /// Goes for the angle that nobody asked for, the first time that this is called.
  /// \returns whether there is a new angle to refine for.
  bool begin_mending(std::size_t vertices)
  {
    if (most_mended_vertices_ > 0 || !options_.grade_input || !options_.polish || options_.min_angle >= mended_angle)
      return false;
    most_mended_vertices_ = vertices + least_growth + vertices / 4;
    is_mending_ = true;
    degrees_ = mended_angle;
    return true;
  }

  /// Only what was asked for counts again.
  void stop_mending()
  {
    is_mending_ = false;
    judge_as_asked();
  }
  bool is_mending() const { return is_mending_; }

  /// The angle asked for counts for now, even if mending goes on afterwards.
  void judge_as_asked() { degrees_ = options_.min_angle; }

  /// Whether only an angle is missing that is more than refinement can be sure of.
  bool can_give_up(bool sizes_hold) const
  {
    return !has_given_up_ && sizes_hold && options_.polish && options_.min_angle > mended_angle;
  }

  /// Goes on for an angle that can be had: where refinement is stuck it leaves angles far below the one asked for.
  void give_up()
  {
    has_given_up_ = true;
    degrees_ = mended_angle;
  }
  bool has_given_up() const { return has_given_up_; }

  /// Whether the angle has taken as many vertices as it may.
  bool is_too_dear(std::size_t vertices, bool sizes_hold) const
  {
    if (is_mending_ && vertices >= (std::min)(most_mended_vertices_, options_.max_vertices)) return true;
    return sizes_hold && options_.min_angle > mended_angle && !has_given_up_ && vertices >= most_vertices();
  }

private:
  // Angles below this are refined even if nobody asks for it. On details of the input finer than the size the pliant
  // step's budget leaves smaller ones; much larger bounds cost many vertices there.
  static constexpr double mended_angle = 25;
  static constexpr std::size_t growth = 4, least_growth = 20;

  /// What refinement for angles may take: several times as many vertices as sizes need say that it doesn't end.
  std::size_t most_vertices() const { return least_growth + growth * sized_vertices_; }

  const Mesh_options_2& options_;
  double degrees_;
  std::size_t sized_vertices_ = 0; ///< when all sizes held for the first time
  std::size_t most_mended_vertices_ = 0;
  bool is_mending_ = false;
  bool has_given_up_ = false; ///< the angle asked for
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_ANGLE_GOAL_2_H
