// SPDX-License-Identifier: GPL-3.0-or-later
//
// The driver of spatial meshing (Tournois 2009, sec. 3.2.1, Alg. 5): feature vertices and seeds, a first mesh for
// loosened criteria, refinement by batches, and the report.

#ifndef WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H
#define WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H

#include <weft/internal/timer.h>
#include <weft/options.h>
#include <weft/report.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/coarsen_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/refine/Batch_refiner_3.h>
#include <weft/spatial/refine/Crease_divider_3.h>
#include <weft/spatial/refine/seed_lattice_3.h>
#include <weft/spatial/refine/Vertex_set_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Mesh_relocation_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/report_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// The vertices of a mesh that there is already, and what is different from meshing without them.
template <class K>
struct Initial_vertices_3
{
  std::vector<typename K::Point_3> points;  ///< distinct
  std::vector<Vertex_location_3> locations; ///< in the oracle's numbers; all its corners are among them
  std::vector<std::size_t> fixed;           ///< those that have to stay where they are
  /// Whether to go no further where the refined boundary isn't a closed 2-manifold.
  bool only_manifold = false;
  /// Shapes asked for once the vertices are smoothed, as `Criteria_3` has them; 0: only those that the criteria ask
  /// for.
  double facet_shape_in_the_end = 0, cell_shape_in_the_end = 0;
  double smoothing_share = 1; ///< most of the time left that smoothing may take
};

/// Meshes the domain behind an oracle; see `make_mesh_3()`.
template <class Oracle>
class Spatial_mesher_3
{
public:
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Restricted = Restricted_delaunay_3<Oracle>;
  using Refiner = Batch_refiner_3<Restricted>;

  Spatial_mesher_3(const Oracle& oracle, const Criteria_3<Kernel>& criteria, const Mesh_options_3& options)
      : oracle_(oracle), criteria_(criteria), options_(options), mesh_(oracle, options.threads)
  {}

  /// The same beginning with vertices that there are: these instead of seeds, and refinement only as far as the
  /// criteria ask for it.
  Spatial_mesher_3(const Oracle& oracle, const Criteria_3<Kernel>& criteria, const Mesh_options_3& options,
                   const Initial_vertices_3<Kernel>& initial)
      : Spatial_mesher_3(oracle, criteria, options)
  {
    initial_ = &initial;
  }

  /// Runs; afterwards `take_mesh()` has the mesh.
  Mesh_report_3 run()
  {
    meet_criteria();
    start_again_where_bad();
    optimise();
    return report();
  }

  /// The first half of `run()`: refines until the criteria hold or nothing more can be done.
  void meet_criteria()
  {
    begin_stage("initialisation", Stage::seeding);
    goes_on_ = initial_ ? take_initial() : seed();
    begin_stage("surface", Stage::refinement);
    goes_on_ = goes_on_ && refine_surface();
    begin_stage("lattice", Stage::seeding);
    if (goes_on_ && initial_) insert_interior();
    if (goes_on_ && !initial_ && options_.lattice && criteria_.size.is_constant()) insert_lattice();
    begin_stage("interior", Stage::refinement);
    goes_on_ = goes_on_ && refine(1, true);
    if (goes_on_ && initial_ && initial_->only_manifold) goes_on_ = check_manifold_3(tetrahedral_mesh(mesh_)).ok();
  }

  /// To be called in between: takes the vertices around elements that are bad still away and refines once more, up to
  /// twelve times, and keeps the mesh with the fewest.
  void start_again_where_bad()
  {
    if (!goes_on_ || initial_ || bad_left_ == 0) return;
    begin_stage("starting again", Stage::refinement);
    // What went wrong all over isn't bad luck: a cheese of sharp holes goes from 692 bad elements to 22,000 in three
    // rounds.
    const std::size_t few = (std::max)(std::size_t(50), mesh_.vertices().size() / 100);
    Vertex_set_3<Kernel> best;
    std::vector<Ball_3<Kernel>> balls_of_best;
    std::size_t fewest = few + 1;
    for (int round = 0;; ++round) {
      if (bad_left_ == 0 && count_bare_patches(mesh_) == 0) return;
      auto balls = bad_balls(mesh_, criteria_, size_floor());
      const std::size_t bad = balls.size() + count_bare_patches(mesh_);
      if (bad == 0) return;
      const bool is_better = bad < fewest;
      if (is_better) {
        fewest = bad;
        best = vertices_of(mesh_);
        balls_of_best = balls;
      }
      if (best.points.empty()) return;
      // The rest of the budget isn't for this alone: a run that ends here isn't optimised.
      const std::size_t most = (std::min)(most_batches_again, (options_.max_batches - report_.batches) / 2);
      const bool ends = round == most_restarts || most == 0 || !goes_on_;
      bool is_best = is_better;
      if (!is_best && (ends || bad > few)) {
        rebuild(best);
        balls = balls_of_best;
        is_best = true;
      }
      if (ends) return;
      if (drop_vertices(balls, 4 * std::exp2(round % 4), mesh_) == 0) {
        if (!is_best) rebuild(best);
        return;
      }
      goes_on_ = refine(1, true, most, static_cast<unsigned>(round) + 1);
    }
  }

  /// The second half; does nothing if the first was stopped.
  void optimise()
  {
    goes_on_ = goes_on_ && coarsen_and_smooth();
    begin_stage("perturbation", Stage::polishing);
    if (goes_on_ && options_.min_dihedral_angle > 0) perturb();
  }

  /// The report so far.
  Mesh_report_3 report()
  {
    end_stage();
    Mesh_report_3 result = report_;
    fill_report(mesh_, criteria_, size_floor(), result);
    result.segment_queries += earlier_.segments;
    result.location_queries += earlier_.locations;
    result.skipped_queries += earlier_.skipped;
    return result;
  }

  /// The mesh as it is, also while a visitor is called.
  const Restricted& mesh() const { return mesh_; }

  Restricted take_mesh() { return std::move(mesh_); }

private:
  /// Vertices of the boundary and those that have to stay; the others follow when the surface is there.
  bool take_initial()
  {
    std::vector<char> is_first(initial_->points.size(), false);
    std::vector<Point> points;
    std::vector<Vertex_location_3> locations;
    for (const std::size_t i : initial_->fixed) is_first[i] = true;
    for (std::size_t i = 0; i < is_first.size(); ++i) {
      if (initial_->locations[i].dimension < 3) is_first[i] = true;
      if (!is_first[i]) continue;
      points.push_back(initial_->points[i]);
      locations.push_back(initial_->locations[i]);
    }
    mesh_.insert(points, locations);
    std::vector<std::size_t> number(is_first.size(), 0);
    for (std::size_t i = 1; i < number.size(); ++i) number[i] = number[i - 1] + (is_first[i - 1] != 0);
    for (const std::size_t i : initial_->fixed) mesh_.fix(mesh_.vertices()[number[i]]);
    for (std::size_t i = 0; i < is_first.size(); ++i)
      if (!is_first[i]) interior_.push_back(initial_->points[i]);
    return visit(0) || stop(Stop_reason::cancelled);
  }

  /// Those interior vertices that lie in the domain, as few don't where cells are inverted, and don't end up on the
  /// boundary. Otherwise refinement has to surround them with vertices on the surface.
  void insert_interior()
  {
    const std::size_t before = interior_.size();
    const double spacing = 0.1 * criteria_.size(Point(0, 0, 0));
    drop_encroaching(mesh_, spacing, 0, interior_);
    std::vector<Point> inside;
    std::vector<Vertex_location_3> locations;
    for (const Point& p : interior_) {
      const int subdomain = oracle_.subdomain(p);
      if (subdomain == 0) continue;
      inside.push_back(p);
      locations.push_back({3, subdomain});
    }
    report_.coarsened += before - inside.size();
    mesh_.insert(inside, locations);
  }

  bool seed()
  {
    insert_corners();
    insert_crease_seeds();
    begin_stage("first surface", Stage::refinement);
    return refine(options_.initial_loosening, false) && seed_patches();
  }

  void insert_corners()
  {
    for (std::size_t i = 0; i < oracle_.number_of_corners(); ++i)
      mesh_.insert(oracle_.corner(i), {0, static_cast<int>(i)});
  }

  /// Cuts creases into equal parts where that takes fewer of them than halving would, cycles and loops with one feature
  /// vertex into three at least: the fewest that make a polygon.
  void insert_crease_seeds()
  {
    for (std::size_t c = 0; c < oracle_.number_of_creases(); ++c) {
      const auto& points = mesh_.creases().points(c);
      const Crease_divider_3<Kernel> divider(points, criteria_);
      const std::size_t least = points.front() == points.back() ? 3 : 1, parts = divider.parts(least);
      for (std::size_t k = oracle_.crease_is_closed(static_cast<int>(c)) ? 0 : 1; k < parts; ++k) {
        if (k >= least && !has_room()) break;
        mesh_.insert(divider.at(static_cast<double>(k) / static_cast<double>(parts)), {1, static_cast<int>(c)});
      }
    }
  }

  bool has_room() const { return mesh_.vertices().size() < options_.max_vertices; }

  /// Seeds every patch that has no facet yet, and refines again, until all have.
  bool seed_patches()
  {
    for (int round = 0; round < 4; ++round) {
      if (seed_bare_patches(round == 0 ? 4 : 2 * round) == 0) return true;
      if (!refine(options_.initial_loosening, false)) return false;
    }
    return true;
  }

  /// Up to n more points on every patch without a facet; returns how many there were.
  std::size_t seed_bare_patches(std::size_t n)
  {
    std::vector<char> has_facet(static_cast<std::size_t>(oracle_.number_of_patches()), false);
    for (const auto& f : mesh_.facets())
      if (f.cell != typename Restricted::Cell_handle()) has_facet[static_cast<std::size_t>(f.patch)] = true;
    seeded_.resize(has_facet.size(), 0);
    std::size_t inserted = 0;
    for (std::size_t p = 0; p < has_facet.size(); ++p) {
      if (has_facet[p] || seeded_[p] >= most_seeds || !oracle_.is_expected(static_cast<int>(p))) continue;
      const auto seeds = oracle_.patch_seeds(static_cast<int>(p), seeded_[p] + n);
      for (std::size_t k = seeded_[p]; k < seeds.size() && has_room(); ++k, ++inserted)
        mesh_.insert(seeds[k].point, {2, static_cast<int>(p)});
      seeded_[p] += n;
    }
    return inserted;
  }

  bool refine_surface()
  {
    do {
      if (!refine(1, false)) return false;
    } while (seed_bare_patches(1) > 0);
    return true;
  }

  void insert_lattice()
  {
    const double spacing = lattice_spacing * criteria_.size.constant();
    const std::size_t room = options_.max_vertices - (std::min)(options_.max_vertices, mesh_.vertices().size());
    auto points = interior_lattice(oracle_, spacing, lattice_clearance * spacing, room);
    drop_encroaching(mesh_, spacing, lattice_clearance * spacing, points);
    std::vector<int> subdomains;
    for (const Point& p : points) subdomains.push_back(oracle_.subdomain(p));
    mesh_.insert(points, subdomains);
  }

  /// Refines until nothing more can be done, or so many batches are; false when the run has to end.
  bool refine(double factor, bool with_cells, std::size_t most_batches = std::numeric_limits<std::size_t>::max(),
              unsigned luck = 0)
  {
    Refiner refiner(mesh_, criteria_, factor, with_cells, size_floor(), options_.seed + 1 + luck,
                    factor == 1 ? settled_ : 0);
    bool go_on = true;
    for (std::size_t batches = 0; go_on && batches < most_batches; ++batches) {
      if (report_.batches >= options_.max_batches) go_on = stop(Stop_reason::iteration_limit);
      if (!has_room()) go_on = stop(Stop_reason::vertex_budget);
      if (timer_.seconds() >= options_.time_limit) go_on = stop(Stop_reason::time_limit);
      if (!go_on) break;
      const Batch_3 batch = refiner.refine(options_.max_vertices - mesh_.vertices().size());
      ++report_.batches;
      if (!visit(batch.bad)) go_on = stop(Stop_reason::cancelled);
      bad_left_ = batch.bad;
      if (batch.inserted > 0) continue;
      if (factor == 1) settled_ = refiner.settle();
      break;
    }
    report_.candidates += refiner.candidates();
    report_.encroachments += refiner.encroachments();
    return go_on;
  }

  void rebuild(const Vertex_set_3<Kernel>& vertices)
  {
    earlier_.segments += mesh_.counts().segments;
    earlier_.locations += mesh_.counts().locations;
    earlier_.skipped += mesh_.counts().skipped;
    mesh_ = Restricted(oracle_, options_.threads);
    mesh_.insert(vertices.points, vertices.locations);
    settled_ = 0;
  }

  /// Interleaves what Alg. 5 does, in another order: smoothing the coarse mesh and refining it then, as there, takes
  /// more vertices, since it moves vertices away from the folds that attracted them. Criteria come first, then vertices
  /// are taken away as long as they hold, and smoothing, which keeps them too, makes room for more of that. What
  /// couldn't be refined before stays as it is: another refinement mends nothing there, and may make more bad elements.
  bool coarsen_and_smooth()
  {
    if (!options_.coarsen && options_.smoothing_sweeps == 0) return true;
    begin_stage("sorting in memory", Stage::polishing);
    sort_in_memory(mesh_);
    report_.refined_smallest_dihedral = smallest_dihedral();
    if (!(coarsen() && smooth() && (options_.smoothing_sweeps == 0 || coarsen()))) return false;
    return !initial_ || refine_to_final_shapes();
  }

  /// Initial vertices are held to better shapes once they are smoothed.
  bool refine_to_final_shapes()
  {
    begin_stage("refinement after smoothing", Stage::refinement);
    criteria_.facet_shape = tighter(criteria_.facet_shape, initial_->facet_shape_in_the_end);
    criteria_.cell_shape = tighter(criteria_.cell_shape, initial_->cell_shape_in_the_end);
    if (is_good()) return true; // refinement also prevents: it would mirror vertices at acute edges
    guard_.reset();
    return refine(1, true);
  }

  /// Watches all that comes after refinement: one for each stage took a fifth of a run.
  Criteria_guard_3<Restricted>& guard()
  {
    if (!guard_) guard_.emplace(mesh_, criteria_);
    return *guard_;
  }

  /// The smaller of two bounds, of which 0 is none.
  static double tighter(double a, double b) { return a == 0 || b == 0 ? a + b : (std::min)(a, b); }

  bool coarsen()
  {
    begin_stage("coarsening", Stage::polishing);
    if (!options_.coarsen) return true;
    Coarsen_options_3 options;
    options.time_limit = time_left();
    options.go_on = [this] { return goes_on(); };
    report_.coarsened += coarsen_3(mesh_, guard(), options).removed;
    return may_go_on();
  }

  bool smooth()
  {
    begin_stage("smoothing", Stage::relaxation);
    const double share = initial_ ? initial_->smoothing_share : 1;
    // A sweep isn't broken off: it takes about twice the time of all that came before it.
    const bool fits = share == 1 || 2 * timer_.seconds() < share * time_left();
    if (options_.smoothing_sweeps == 0 || !fits) return true;
    Smooth_options_3 options;
    options.max_sweeps = options_.smoothing_sweeps;
    options.threads = options_.threads;
    options.time_limit = share * time_left();
    options.go_on = [this] { return goes_on(); };
    const Smooth_report_3 result = smooth_3(mesh_, guard(), options);
    report_.smoothing_sweeps += result.sweeps;
    report_.smoothing_moves += result.moves;
    report_.smoothing_locked += result.locked;
    report_.smoothing_rejected += result.rejected;
    report_.moved_in_place += result.relocations.in_place;
    report_.moved_one_by_one += result.relocations.one_by_one;
    report_.moved_by_rebuilding += result.relocations.rebuilt;
    return may_go_on();
  }

  /// For optimisers: the visitor isn't called again once it has ended the run.
  bool goes_on() { return report_.stop_reason != Stop_reason::cancelled && (visit(0) || stop(Stop_reason::cancelled)); }

  /// Whether nothing is bad.
  bool is_good() const
  {
    Mesh_report_3 now;
    count_bad_elements(mesh_, criteria_, size_floor(), now);
    return now.bad() == 0;
  }

  double time_left() const { return (std::max)(0.0, options_.time_limit - timer_.seconds()); }

  /// Whether neither the visitor nor the clock has ended the run.
  bool may_go_on()
  {
    if (report_.stop_reason == Stop_reason::cancelled) return false;
    return timer_.seconds() < options_.time_limit || stop(Stop_reason::time_limit);
  }

  double smallest_dihedral() const
  {
    double worst = -1;
    for (const auto c : mesh_.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) worst = (std::max)(worst, cosines_of_cell(c).smallest);
    return degrees_of_cosine(worst);
  }

  void perturb()
  {
    Perturb_options_3 options;
    options.target = options_.min_dihedral_angle;
    // Where something is bad, the input has angles so small that the worst cells stay, whatever is done about them.
    // Given vertices may be beyond what criteria can mend; their slivers are wanted gone all the same.
    options.mend_worst = initial_ || is_good();
    options.seed = options_.seed + 2;
    options.time_limit = time_left();
    options.go_on = [this](double) { return goes_on(); };
    const Perturb_report_3 result = perturb_slivers_3(mesh_, guard(), options);
    report_.smoothed_smallest_dihedral = result.before;
    report_.perturbed = result.by_radius + result.by_volume + result.by_chance;
    report_.perturb_insertions = result.insertions;
    if (options_.min_dihedral_angle < Perturb_options_3::as_far_as_it_goes) may_go_on();
  }

  bool stop(Stop_reason reason)
  {
    report_.stop_reason = reason;
    return false;
  }

  bool visit(std::size_t bad)
  {
    return !options_.visitor || options_.visitor({stage_, mesh_.vertices().size(), bad, timer_.seconds()});
  }

  /// Below this distance from a vertex nothing is inserted. By default small enough for a facet that cuts off an edge
  /// which nobody marked as sharp: its error falls with its size, so that has to get below the approximation bound.
  double size_floor() const
  {
    if (options_.size_floor > 0) return options_.size_floor;
    const CGAL::Bbox_3 b = oracle_.bbox();
    const double diagonal = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    double floor = 1e-3 * (criteria_.size.is_constant() ? (std::min)(diagonal, criteria_.size.constant()) : diagonal);
    if (criteria_.approximation && criteria_.approximation.is_constant())
      floor = (std::min)(floor, 0.1 * criteria_.approximation.constant());
    return floor;
  }

  void begin_stage(const char* name, Stage stage)
  {
    end_stage();
    stage_ = stage;
    stage_name_ = name;
    stage_begin_ = timer_.seconds();
  }

  void end_stage()
  {
    if (stage_name_.empty()) return;
    auto& stages = report_.stage_seconds;
    auto stage = std::find_if(stages.begin(), stages.end(), [this](const auto& s) { return s.first == stage_name_; });
    if (stage == stages.end()) stage = stages.emplace(stage, stage_name_, 0);
    stage->second += timer_.seconds() - stage_begin_;
    stage_name_.clear();
  }

  // The nearer the lattice comes to the boundary, the fewer vertices fill the gap.
  static constexpr double lattice_spacing = 0.98, lattice_clearance = 0.3;
  static constexpr std::size_t most_seeds = 40;
  static constexpr int most_restarts = 12;
  static constexpr std::size_t most_batches_again = 300; ///< of each; what takes more isn't going to end

  const Oracle& oracle_;
  Criteria_3<Kernel> criteria_;
  const Mesh_options_3& options_;
  const Initial_vertices_3<Kernel>* initial_ = nullptr;
  std::vector<Point> interior_; ///< of the initial vertices, those to be inserted later
  Restricted mesh_;
  std::optional<Criteria_guard_3<Restricted>> guard_; ///< from when refinement has ended
  Mesh_report_3 report_;
  Oracle_counts_3 earlier_;  ///< of triangulations that were built again
  int settled_ = 0;          ///< see `Batch_refiner_3::settle()`
  std::size_t bad_left_ = 0; ///< elements that refinement looked at last and left
  bool goes_on_ = false;     ///< neither done nor stopped
  Timer timer_;
  Stage stage_ = Stage::seeding;
  std::string stage_name_;
  double stage_begin_ = 0;
  std::vector<std::size_t> seeded_; ///< by patch, how many seeds it has been given
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_SPATIAL_MESHER_3_H
