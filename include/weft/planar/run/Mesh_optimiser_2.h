// SPDX-License-Identifier: GPL-3.0-or-later
//
// What improves a planar mesh without refining it, with the bounds and budgets that meshing and improving share:
// relaxation, polishing, insertions and removals near bad angles, and random changes.

#ifndef WEFT_PLANAR_RUN_MESH_OPTIMISER_2_H
#define WEFT_PLANAR_RUN_MESH_OPTIMISER_2_H

#include <weft/planar/polish/Basin_hopper_2.h>
#include <weft/planar/polish/Pliant_improver_2.h>
#include <weft/planar/polish/Polisher_2.h>
#include <weft/planar/relax/Relaxer_2.h>
#include <weft/report.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Every step takes a `go_on`, callable without arguments, which ends it where it returns false.
/// \tparam Mesh a Working_mesh_2.
template <class Mesh>
class Mesh_optimiser_2
{
public:
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Effort = typename Relaxer_2<Mesh>::Effort;

  static constexpr std::size_t least_insertions = 20; ///< what even the smallest mesh may take

  /// \param size_feedback,threads,seed as in Mesh_options_2.
  /// \param report gets the counts.
  Mesh_optimiser_2(Mesh& mesh, double size_feedback, int threads, unsigned seed, Mesh_report_2& report)
      : mesh_(mesh),
        report_(report),
        relaxer_(mesh, size_feedback, threads),
        polisher_(mesh),
        pliant_(mesh, polisher_),
        hopper_(mesh, polisher_, seed)
  {}

  template <class Go_on>
  void relax(std::vector<Vertex_handle> active, const Effort& effort, const Go_on& go_on)
  {
    const auto outcome = relaxer_.run(std::move(active), effort, go_on);
    report_.sweeps += outcome.sweeps;
    report_.moves += outcome.moves.moved;
    report_.put_back += outcome.moves.put_back;
    report_.flips += outcome.moves.flips;
  }

  std::vector<Vertex_handle> with_neighbors(const std::vector<Vertex_handle>& vertices) const
  {
    return relaxer_.with_neighbors(vertices);
  }

  /// Pulls the last edges that are a little too long below the limit.
  template <class Go_on>
  void polish_sizes(const Go_on& go_on)
  {
    report_.polished += polisher_.run(Polisher_2<Mesh>::oversize_cost, 3, go_on);
  }

  template <class Go_on>
  void polish_angles(const Go_on& go_on)
  {
    report_.polished += polisher_.run(polish_cost, most_polishing_passes, go_on);
  }

  /// Moves, then insertions and removals, for the worst triangles.
  template <class Go_on>
  void polish(const Go_on& go_on)
  {
    polish_angles(go_on);
    for (int pass = 0; pass < most_pliant_passes; ++pass) {
      if (pliant_.pass(pliant_cost, go_on) == 0) break;
      polish_angles(go_on);
    }
  }

  /// Random changes near the very worst triangles.
  template <class Go_on>
  void hop(std::size_t most_insertions, const Go_on& go_on)
  {
    hopper_.run(pliant_cost, most_insertions, go_on);
  }

  /// Lets `polish()` insert so many vertices more than it removes. More trials cost more time than they mend angles.
  void allow_insertions(std::size_t most)
  {
    pliant_.set_budget(most, 20 * least_insertions + mesh_.vertices().size() / 5);
  }

private:
  // Costs from which triangles are polished (38 degrees) and mended by inserting or removing a vertex (37 degrees).
  static constexpr double polish_cost = 0.5, pliant_cost = 1;
  static constexpr int most_pliant_passes = 6, most_polishing_passes = 30;

  Mesh& mesh_;
  Mesh_report_2& report_;
  Relaxer_2<Mesh> relaxer_;
  Polisher_2<Mesh> polisher_;
  Pliant_improver_2<Mesh> pliant_;
  Basin_hopper_2<Mesh> hopper_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_MESH_OPTIMISER_2_H
