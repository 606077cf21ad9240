// SPDX-License-Identifier: GPL-3.0-or-later
//
// Alg. 5 of Tournois 2009 as it is printed, to compare with: batches of refinement (Alg. 6) and Natural ODT in turns,
// then perturbation (Alg. 7). Each of its parts can be switched alone to what weft does. `make_mesh_3()` makes better
// meshes.

#ifndef WEFT_SPATIAL_RUN_MESH_AS_PUBLISHED_3_H
#define WEFT_SPATIAL_RUN_MESH_AS_PUBLISHED_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/run/Run.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/coarsen_3.h>
#include <weft/spatial/optimise/Dynamic_field_3.h>
#include <weft/spatial/optimise/perturb_as_published_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/refine/interior_lattice_3.h>
#include <weft/spatial/refine/Refinement_policy_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/As_published_options_3.h>
#include <weft/spatial/run/fill_report_3.h>
#include <weft/spatial/run/Refinement_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace weft {

/// Result of `mesh_as_published_3()`.
template <class Oracle>
struct As_published_result_3
{
  Restricted_delaunay_3<Oracle> restricted; ///< asks the oracle, which has to outlive it
  Mesh_report_3 report;           ///< as that of `make_mesh_3()`: by all that its criteria mean, ridges included
  std::size_t bad_as_refined = 0; ///< elements that violate the criteria as refinement understood them
  Perturb_report_3 perturbation;
};

namespace internal {

/// See `mesh_as_published_3()`.
template <class Oracle>
class As_published_mesher_3
{
public:
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Restricted = Restricted_delaunay_3<Oracle>;

  As_published_mesher_3(const Oracle& oracle, const Criteria_3<Kernel>& criteria, const As_published_options_3& options)
      : oracle_(oracle),
        wanted_(criteria),
        present_(criteria),
        options_(options),
        meshing_(meshing_options(options)),
        mesh_(oracle, options.threads),
        run_(options.visitor, options.time_limit),
        refinement_(mesh_, present_, meshing_, run_, report_, policy_of(options))
  {
    meshing_.size_floor = refinement_.size_floor(); // by the criteria before they are graded
  }

  As_published_mesher_3(const As_published_mesher_3&) = delete; // its parts know each other
  As_published_mesher_3& operator=(const As_published_mesher_3&) = delete;

  As_published_result_3<Oracle> run()
  {
    bool goes_on = initialise() && refine_and_optimise();
    report_.refined_smallest_dihedral = smallest_dihedral();
    goes_on = goes_on && coarsen();
    Perturb_report_3 perturbation;
    if (goes_on && options_.min_dihedral_angle > 0) perturbation = perturb();
    run_.end_stage();
    Mesh_report_3 result = report_;
    run_.report(result);
    fill_report(mesh_, wanted_, refinement_.size_floor(), false, result);
    refinement_.add_earlier_queries(result);
    result.domain = compare_with_domain(tetrahedral_mesh(mesh_), oracle_, wanted_);
    set_exhausted_if_bad(result);
    const std::size_t bad = bad_as_refined();
    return {std::move(mesh_), std::move(result), bad, perturbation};
  }

private:
  static Mesh_options_3 meshing_options(const As_published_options_3& options)
  {
    Mesh_options_3 result;
    result.size_floor = options.size_floor;
    result.initial_loosening = options.initial_loosening;
    result.max_batches = options.max_batches;
    result.max_vertices = options.max_vertices;
    result.seed = options.seed;
    result.threads = options.threads;
    return result;
  }

  static Refinement_policy_3 policy_of(const As_published_options_3& options)
  {
    Refinement_policy_3 policy;
    policy.chooses_points = !options.plain_points;
    policy.sorts_dimensions = !options.mixed_batches;
    policy.shapes_creases = !options.plain_creases;
    policy.follows_folds = options.follow_folds;
    policy.sees_ridges = options.see_ridges;
    policy.mirrors = options.mirror;
    return policy;
  }

  bool initialise()
  {
    run_.begin_stage("initialisation", Stage::seeding);
    if (!refinement_.mesh_first_surface()) return false;
    run_.begin_stage("first mesh", Stage::refinement);
    if (options_.lattice && wanted_.size.is_constant()) {
      if (!refinement_.refine_surface()) return false;
      insert_lattice(mesh_, wanted_.size.constant(), options_.max_vertices);
    }
    return refinement_.refine(options_.initial_loosening, true);
  }

  /// The loop of Alg. 5: until the criteria hold, or nothing more can be done about those that don't.
  bool refine_and_optimise()
  {
    bool has_smoothed = options_.interleave || options_.final_sweeps == 0, optimises = options_.interleave;
    for (int step = options_.target_steps; step > 0;) {
      const bool is_last = step == 1;
      std::size_t inserted = 0;
      if (!refine(std::pow(options_.initial_loosening, (step - 1.) / options_.target_steps), inserted)) return false;
      if (inserted > 0) {
        optimises = optimises && !(is_last && goes_in_circles());
        if (optimises && !smooth(options_.sweeps)) return false;
      } else if (!is_last) {
        --step;
      } else if (!has_smoothed) {
        if (!smooth(options_.final_sweeps)) return false;
        has_smoothed = true;
      } else {
        --step;
      }
    }
    return true;
  }

  /// Whether smoothing makes about as many bad elements as refinement mends: few are left, but not half as many as
  /// some batches ago.
  bool goes_in_circles()
  {
    bad_.push_back(refinement_.bad_left());
    const std::size_t n = bad_.size(), patience = options_.patience;
    return patience > 0 && n > patience && few * bad_.back() < mesh_.vertices().size() &&
           2 * bad_.back() > bad_[n - 1 - patience];
  }

  /// One batch.
  bool refine(double factor, std::size_t& inserted)
  {
    run_.begin_stage("refinement", Stage::refinement);
    if (options_.grade) {
      const auto field = std::make_shared<Dynamic_field_3>(mesh_, options_.lipschitz);
      const Length_field_3<Kernel> size = wanted_.size;
      // Loosened criteria multiply all sizes; those that the mesh has are what they are.
      present_.size = [field, size, factor](const Point& p) { return (std::min)(size(p), field->at(xyz(p)) / factor); };
    }
    const std::size_t before = mesh_.vertices().size();
    const bool goes_on = refinement_.refine(factor, true, 1, static_cast<unsigned>(report_.batches));
    inserted = mesh_.vertices().size() - before;
    return goes_on;
  }

  bool smooth(int sweeps)
  {
    run_.begin_stage("smoothing", Stage::relaxation);
    Smooth_options_3 options;
    options.max_sweeps = sweeps;
    options.lipschitz = options_.lipschitz;
    options.keep_criteria = options_.keep_criteria;
    options.threads = options_.threads;
    options.time_limit = run_.time_left();
    options.go_on = [this] { return visit(); };
    if (!options_.lock) options.locked_smallest = 180;
    const Natural_odt_3 smoother = options_.smooth_surface ? Natural_odt_3() : Natural_odt_3{0, 0};
    const Smooth_report_3 result = smooth_3(mesh_, wanted_, options, smoother);
    report_.smoothing_sweeps += result.sweeps;
    report_.smoothing_moves += result.moves;
    report_.smoothing_locked += result.locked;
    report_.smoothing_rejected += result.rejected;
    report_.moved_in_place += result.relocations.in_place;
    report_.moved_one_by_one += result.relocations.one_by_one;
    report_.moved_by_rebuilding += result.relocations.rebuilt;
    return run_.may_go_on();
  }

  bool coarsen()
  {
    if (!options_.coarsen) return true;
    run_.begin_stage("coarsening", Stage::polishing);
    Coarsen_options_3 options;
    options.time_limit = run_.time_left();
    options.go_on = [this] { return visit(); };
    report_.coarsened += coarsen_3(mesh_, wanted_, options).removed;
    return run_.may_go_on();
  }

  Perturb_report_3 perturb()
  {
    run_.begin_stage("perturbation", Stage::polishing);
    Perturb_report_3 result;
    if (options_.published_perturbation) {
      Published_perturb_options_3 options = options_.perturbation;
      options.target = options_.min_dihedral_angle;
      options.seed = options_.seed + 2;
      options.time_limit = run_.time_left();
      options.go_on = [this] { return visit(); };
      result = perturb_as_published_3(mesh_, wanted_, options);
    } else {
      Perturb_options_3 options;
      options.target = options_.min_dihedral_angle;
      options.seed = options_.seed + 2;
      options.time_limit = run_.time_left();
      options.go_on = [this](double) { return visit(); };
      result = perturb_slivers_3(mesh_, wanted_, options);
    }
    report_.smoothed_smallest_dihedral = result.before;
    report_.perturbed = result.by_radius + result.by_volume + result.by_chance;
    report_.perturb_insertions = result.insertions;
    run_.may_go_on();
    return result;
  }

  bool visit() { return run_.visit(mesh_.vertices().size(), refinement_.bad_left()); }

  double smallest_dihedral() const
  {
    double worst = -1;
    for (const auto c : mesh_.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) worst = (std::max)(worst, cosines_of_cell(c).smallest);
    return degrees_of_cosine(worst);
  }

  std::size_t bad_as_refined() const
  {
    std::size_t bad = 0;
    const auto count = [&bad](const auto&, const Badness_3&, const auto&) { ++bad; };
    visit_bad_elements(
        mesh_, wanted_, count, count, count, [&bad](auto) { ++bad; }, options_.see_ridges);
    return bad;
  }

  static constexpr std::size_t few = 20; ///< one bad element for so many vertices

  const Oracle& oracle_;
  const Criteria_3<Kernel> wanted_;
  Criteria_3<Kernel> present_; ///< graded
  const As_published_options_3& options_;
  Mesh_options_3 meshing_;
  Restricted mesh_;
  Mesh_report_3 report_;
  Run run_;
  Refinement_3<Restricted> refinement_;
  std::vector<std::size_t> bad_; ///< elements that each batch has found
};

} // namespace internal

/// Meshes a domain by Alg. 5 of Tournois 2009. Parameters are those of `make_mesh_3()`. The mesh is the restricted
/// Delaunay triangulation at any time, also after early stops. Criteria hold after refinement and optimisation if that
/// ended by itself; perturbation, as printed, comes after that and doesn't keep them.
/// \param oracle a domain oracle, see doc/concepts/DomainOracle_3.h; has to outlive the result.
/// \throws Option_error for criteria or options out of range, or if a field of the criteria isn't positive.
template <class Oracle>
As_published_result_3<Oracle> mesh_as_published_3(const Oracle& oracle,
                                                  const Criteria_3<typename Oracle::Kernel>& criteria,
                                                  const As_published_options_3& options = As_published_options_3())
{
  criteria.check();
  options.check();
  return internal::As_published_mesher_3<Oracle>(oracle, criteria, options).run();
}

template <class Oracle>
As_published_result_3<Oracle> mesh_as_published_3(const Oracle&&, const Criteria_3<typename Oracle::Kernel>&,
                                                  const As_published_options_3& = As_published_options_3()) = delete;

} // namespace weft

#endif // WEFT_SPATIAL_RUN_MESH_AS_PUBLISHED_3_H
