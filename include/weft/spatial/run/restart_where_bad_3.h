// SPDX-License-Identifier: GPL-3.0-or-later
//
// Starting again where refinement went wrong: beside acute edges that nobody marked, whether it comes to an end is
// luck. See Vertex_set_3.h.

#ifndef WEFT_SPATIAL_RUN_RESTART_WHERE_BAD_3_H
#define WEFT_SPATIAL_RUN_RESTART_WHERE_BAD_3_H

#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/refine/Vertex_set_3.h>
#include <weft/spatial/run/fill_report_3.h>
#include <weft/spatial/run/Refinement_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Takes the vertices around elements that are bad still away and refines once more, up to twelve times, and keeps the
/// mesh with the fewest.
/// \returns false when the run has to end.
template <class Restricted>
bool restart_where_bad_3(Refinement_3<Restricted>& refinement)
{
  using Kernel = typename Restricted::Kernel;
  constexpr int most_restarts = 12;
  constexpr std::size_t most_batches_again = 300; // of each; what takes more isn't going to end
  Restricted& mesh = refinement.mesh();
  // What went wrong all over isn't bad luck, and only gets worse.
  const std::size_t few = (std::max)(std::size_t(50), mesh.vertices().size() / 100);
  Vertex_set_3<Kernel> best;
  std::vector<Ball_3<Kernel>> balls_of_best;
  std::size_t fewest = few + 1;
  bool goes_on = true;
  for (int round = 0;; ++round) {
    if (refinement.bad_left() == 0 && count_bare_patches(mesh) == 0) return goes_on;
    auto balls = bad_balls(mesh, refinement.criteria(), refinement.size_floor());
    const std::size_t bad = balls.size() + count_bare_patches(mesh);
    if (bad == 0) return goes_on;
    const bool is_better = bad < fewest;
    if (is_better) {
      fewest = bad;
      best = vertices_of(mesh);
      balls_of_best = balls;
    }
    if (best.points.empty()) return goes_on;
    // The rest of the budget isn't for this alone: a run that ends here isn't optimised.
    const std::size_t most = (std::min)(most_batches_again, refinement.batches_left() / 2);
    const bool ends = round == most_restarts || most == 0 || !goes_on;
    bool is_best = is_better;
    if (!is_best && (ends || bad > few)) {
      refinement.rebuild(best);
      balls = balls_of_best;
      is_best = true;
    }
    if (ends) return goes_on;
    if (drop_vertices(balls, 4 * std::exp2(round % 4), mesh) == 0) {
      if (!is_best) refinement.rebuild(best);
      return goes_on;
    }
    goes_on = refinement.refine(1, true, most, static_cast<unsigned>(round) + 1);
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_RESTART_WHERE_BAD_3_H
