// SPDX-License-Identifier: GPL-3.0-or-later
//
// A progress bar for weft's meshers, which Ctrl-C stops with a valid mesh.

#ifndef WEFT_EXAMPLES_MESHING_PROGRESS_H
#define WEFT_EXAMPLES_MESHING_PROGRESS_H

#include "interruption.h"
#include "progress_bar.h"

#include <weft/visitor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

/// Maps a run, whose length nobody knows beforehand, to a bar: relaxation approaches its end step by step, refinement
/// and polishing are as far as bad elements have become fewer. A visitor of the meshers.
class Meshing_progress
{
public:
  /// \param refinement_begins part of the bar where refinement begins; below it are seeding and relaxation.
  explicit Meshing_progress(bool wanted, double refinement_begins) : bar_(wanted), refinement_begins_(refinement_begins)
  {}

  bool operator()(const weft::Progress& progress)
  {
    std::string text = std::string(name(progress.stage)) + ", " + std::to_string(progress.vertices) + " vertices";
    if (progress.bad > 0) text += ", " + std::to_string(progress.bad) + " bad";
    bar_.show(part(progress), text);
    return !command_line::Interruption::wished();
  }

  command_line::Progress_bar& bar() { return bar_; }

private:
  double part(const weft::Progress& progress)
  {
    const double relaxation_begins = refinement_begins_ / 5;
    switch (progress.stage) {
    case weft::Stage::constraints:
    case weft::Stage::seeding:
      return 0.5 * relaxation_begins;
    case weft::Stage::relaxation:
      unrelaxed_ *= 0.9;
      return refinement_begins_ - (refinement_begins_ - relaxation_begins) * unrelaxed_;
    default:
      most_bad_ = std::max(most_bad_, progress.bad);
      return 1 - (1 - refinement_begins_) * std::log1p(progress.bad) / std::log1p(std::max<std::size_t>(most_bad_, 1));
    }
  }

  command_line::Progress_bar bar_;
  double refinement_begins_;
  double unrelaxed_ = 1;
  std::size_t most_bad_ = 0;
};

#endif // WEFT_EXAMPLES_MESHING_PROGRESS_H
