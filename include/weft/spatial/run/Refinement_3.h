// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first half of spatial meshing (Tournois 2009, sec. 3.2.1, Alg. 5): a first mesh of the surface for loosened
// criteria, and batches of refinement until the criteria hold, as far as the run's budget goes.

#ifndef WEFT_SPATIAL_RUN_REFINEMENT_3_H
#define WEFT_SPATIAL_RUN_REFINEMENT_3_H

#include <weft/internal/run/Run.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Approximation_multiples.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/refine/Batch_refiner_3.h>
#include <weft/spatial/refine/Boundary_seeder_3.h>
#include <weft/spatial/refine/Refinement_policy_3.h>
#include <weft/spatial/refine/Vertex_set_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Refinement_3
{
public:
  using Kernel = typename Restricted::Kernel;

  /// Everything has to live as long as this object; criteria may change between calls.
  Refinement_3(Restricted& mesh, const Criteria_3<Kernel>& criteria, const Mesh_options_3& options, Run& run,
               Mesh_report_3& report, const Refinement_policy_3& policy = Refinement_policy_3())
      : mesh_(mesh),
        criteria_(criteria),
        options_(options),
        run_(run),
        report_(report),
        policy_(policy),
        seeder_(mesh, criteria, options.max_vertices, policy),
        leaves_knife_edges_(!policy.mirrors)
  {}

  /// Leaves small elements unrefined at all acute edges. Elsewhere than where twins end refinement that is the rule.
  void leave_knife_edges() { leaves_knife_edges_ = true; }

  Restricted& mesh() { return mesh_; }
  const Criteria_3<Kernel>& criteria() const { return criteria_; }

  /// Inserts the first vertices and refines the surface for loosened criteria; false when the run has to end.
  bool mesh_first_surface()
  {
    seeder_.insert_corners();
    seeder_.insert_crease_seeds();
    run_.begin_stage("first surface", Stage::refinement);
    return refine(options_.initial_loosening, false) && seed_patches();
  }

  /// Refines the surface; false when the run has to end.
  bool refine_surface()
  {
    do {
      if (!refine(1, false)) return false;
    } while (seeder_.seed_bare_patches(1) > 0);
    return true;
  }

  /// Refines until nothing more can be done, or so many batches are; false when the run has to end.
  /// \param factor by which criteria are loosened.
  /// \param luck starts other random choices.
  bool refine(double factor, bool with_cells, std::size_t most_batches = std::numeric_limits<std::size_t>::max(),
              unsigned luck = 0)
  {
    bool go_on = true;
    std::size_t batches = 0;
    while (refine_until_turned(factor, with_cells, most_batches, luck, batches, go_on)) seeder_.seed_missed();
    return go_on;
  }

  /// See Boundary_seeder_3.
  std::size_t seed_missed() { return seeder_.seed_missed(); }

  /// Builds the mesh anew, of other vertices.
  void rebuild(const Vertex_set_3<Kernel>& vertices)
  {
    earlier_.segments += mesh_.counts().segments;
    earlier_.locations += mesh_.counts().locations;
    earlier_.skipped += mesh_.counts().skipped;
    mesh_ = Restricted(mesh_.oracle(), options_.threads);
    mesh_.insert(vertices.points, vertices.locations);
    settled_ = 0;
  }

  /// Elements that refinement looked at last and left.
  std::size_t bad_left() const { return bad_left_; }

  std::size_t batches_left() const { return options_.max_batches - report_.batches; }

  /// Below this distance from a vertex nothing is inserted. By default small enough for a facet that cuts off an edge
  /// which nobody marked as sharp: its error falls with its size, so that has to get below the approximation bound.
  double size_floor() const
  {
    if (options_.size_floor > 0) return options_.size_floor;
    const CGAL::Bbox_3 b = mesh_.oracle().bbox();
    const double diagonal = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    const double smallest = criteria_.size.smallest();
    double floor = 1e-3 * (smallest > 0 ? (std::min)(diagonal, smallest) : diagonal);
    if (criteria_.approximation && criteria_.approximation.is_constant())
      floor = (std::min)(floor, Approximation_multiples::size_floor * criteria_.approximation.constant());
    for (const auto& [patch, own] : criteria_.patches)
      if (own.approximation && own.approximation.is_constant())
        floor = (std::min)(floor, Approximation_multiples::size_floor * own.approximation.constant());
    return floor;
  }

  /// Adds to a report what oracles were asked by triangulations that were built again.
  void add_earlier_queries(Mesh_report_3& report) const
  {
    report.segment_queries += earlier_.segments;
    report.location_queries += earlier_.locations;
    report.skipped_queries += earlier_.skipped;
  }

private:
  /// Returns whether it ended since it has found the first facet that is turned away from the surface: what the mesh
  /// misses has to be seeded then, and refinement to be begun again.
  bool refine_until_turned(double factor, bool with_cells, std::size_t most_batches, unsigned luck,
                           std::size_t& batches, bool& go_on)
  {
    Batch_refiner_3<Restricted> refiner(mesh_, criteria_, factor, with_cells, size_floor(), options_.seed + 1 + luck,
                                        factor == 1 ? settled_ : 0, policy_);
    if (leaves_knife_edges_) refiner.leave_knife_edges();
    bool begins_again = false;
    for (; go_on && !begins_again && batches < most_batches; ++batches) {
      go_on = may_refine();
      if (!go_on) break;
      const Batch_3 batch = refiner.refine(options_.max_vertices - mesh_.vertices().size());
      ++report_.batches;
      go_on = run_.visit(mesh_.vertices().size(), batch.bad);
      bad_left_ = batch.bad;
      begins_again = factor == 1 && !has_seeded_missed_ && refiner.has_found_turned();
      if (batch.inserted > 0 || begins_again) continue;
      if (factor == 1) settled_ = refiner.settle();
      break;
    }
    has_seeded_missed_ = has_seeded_missed_ || begins_again;
    report_.candidates += refiner.candidates();
    report_.encroachments += refiner.encroachments();
    return begins_again && go_on;
  }

  /// Whether the budget allows another batch. Of several limits time is named first, then vertices.
  bool may_refine()
  {
    if (!run_.has_time()) return false;
    if (mesh_.vertices().size() >= options_.max_vertices) return run_.stop(Stop_reason::vertex_budget);
    return report_.batches < options_.max_batches || run_.stop(Stop_reason::iteration_limit);
  }

  /// Seeds every patch that has no facet yet, and refines again, until all have.
  bool seed_patches()
  {
    for (int round = 0; round < 4; ++round) {
      if (seeder_.seed_bare_patches(round == 0 ? 4 : 2 * static_cast<std::size_t>(round)) == 0) return true;
      if (!refine(options_.initial_loosening, false)) return false;
    }
    return true;
  }

  Restricted& mesh_;
  const Criteria_3<Kernel>& criteria_;
  const Mesh_options_3& options_;
  Run& run_;
  Mesh_report_3& report_;
  Refinement_policy_3 policy_;
  Boundary_seeder_3<Restricted> seeder_;
  Oracle_counts_3 earlier_;  ///< of triangulations that were built again
  int settled_ = 0;          ///< see `Batch_refiner_3::settle()`
  std::size_t bad_left_ = 0; ///< elements that refinement looked at last and left
  bool has_seeded_missed_ = false;
  bool leaves_knife_edges_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_REFINEMENT_3_H
