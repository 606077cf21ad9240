// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measurements of spatial optimisation, one domain at a time, each in a process of its own: the whole run, sweeps
// of the three smoothers, what one sweep costs, perturbation by direction, and how far perturbation goes.

#ifndef WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_RUN_H
#define WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_RUN_H

#include "../common/user_time.h"
#include "../spatial/spatial_run.h"
#include "optimisation_models.h"
#include "optimisation_peers.h"

#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace benchmark {

using Weft_mesh = weft::Restricted_delaunay_3<weft::Polyhedral_oracle_3<Spatial_kernel>>;

/// Ends a run after so many user seconds, at the next question whether to go on: on a busy machine wall time would end
/// it sooner. As a last resort, wall time does, after ten times as many.
class User_limit
{
public:
  explicit User_limit(double seconds) : seconds_(seconds), end_(user_seconds() + seconds) {}

  void limit(weft::Mesh_options_3& options) const
  {
    options.time_limit = 10 * seconds_;
    options.visitor = [end = end_](const weft::Progress&) { return user_seconds() < end; };
  }
  void limit(weft::Perturb_options_3& options) const
  {
    options.time_limit = 10 * seconds_;
    options.go_on = [end = end_](double) { return user_seconds() < end; };
  }

private:
  double seconds_, end_;
};

// ---- The whole run

/// weft's refinement, default run and run as far as it goes; CGAL's refinement and its chain of optimisers.
struct Whole_run
{
  std::string input;
  Family family;
  Bounds bounds;
  Spatial_measures refined, whole, farthest, cgal_refined, cgal_chain;

  bool failed() const { return refined.failed() || whole.failed() || cgal_refined.failed(); }
};

/// \param seconds user time; 0: any.
inline Spatial_measures weft_in_child(const Spatial_domain& domain, const Bounds& bounds, weft::Mesh_options_3 options,
                                      double seconds = 0)
{
  const auto run = [&](Spatial_measures& m) {
    if (seconds > 0) User_limit(seconds).limit(options);
    run_weft(domain.oracle(), domain.input(), bounds, options, true, m);
  };
  return in_child(run, domain.time_limit());
}

/// CGAL's refinement, with or without ODT and a perturbation for 12 degrees after it.
inline Spatial_measures cgal_in_child(const Spatial_domain& domain, const Bounds& bounds, bool optimise)
{
  const auto run = [&](Spatial_measures& m) {
    const Gauge gauge;
    Cgal_complex complex = mesh_with_cgal(domain.cgal_domain(), bounds, bounds.size);
    if (optimise) {
      odt_with_cgal(complex, domain.cgal_domain());
      perturb_with_cgal(complex, domain.cgal_domain(), 12);
    }
    gauge.stop(m);
    const auto mesh = arrays(complex);
    m.vertices = static_cast<double>(mesh.points.size());
    m.cells = static_cast<double>(mesh.cells.size());
    measure(mesh, domain.input(), m);
  };
  return in_child(run, domain.time_limit());
}

/// \param seconds user time for the run as far as it goes.
inline Whole_run whole_run(const Spatial_domain& domain, Family family, const Bounds& bounds, double seconds)
{
  Whole_run run{domain.input().name, family, bounds, {}, {}, {}, {}, {}};
  run.refined = weft_in_child(domain, bounds, weft::Mesh_options_3::refinement());
  run.whole = weft_in_child(domain, bounds, {});
  weft::Mesh_options_3 far;
  far.min_dihedral_angle = 90;
  run.farthest = weft_in_child(domain, bounds, far, seconds);
  run.cgal_refined = cgal_in_child(domain, bounds, false);
  run.cgal_chain = cgal_in_child(domain, bounds, true);
  return run;
}

// ---- Sweeps

inline Weft_mesh refined_mesh(const Spatial_domain& domain, const Bounds& bounds)
{
  return weft::make_mesh_3(domain.oracle(), weft_criteria(domain.input(), bounds), weft::Mesh_options_3::refinement())
      .restricted;
}

/// Cells with a dihedral angle below so many degrees.
inline double cells_below(const Weft_mesh& mesh, double degrees)
{
  const double cosine = std::cos(degrees * std::acos(-1.) / 180);
  double count = 0;
  for (const auto c : mesh.triangulation().finite_cell_handles())
    count += c->subdomain() != 0 &&
             weft::internal::cosine_of_smallest_dihedral(c->vertex(0)->point(), c->vertex(1)->point(),
                                                         c->vertex(2)->point(), c->vertex(3)->point()) > cosine;
  return count;
}

/// Cells below 10 degrees before and after 20 and 100 sweeps.
struct Sweep_counts
{
  double before = -1, after_20 = -1, after_100 = -1, cells = -1;
  char failure[200] = "";
};

template <class Smoother>
Sweep_counts sweep_counts(const Spatial_domain& domain, const Bounds& bounds, bool keep_criteria)
{
  const auto run = [&](Sweep_counts& m) {
    const auto criteria = weft_criteria(domain.input(), bounds);
    Weft_mesh mesh = refined_mesh(domain, bounds);
    m.before = cells_below(mesh, 10);
    weft::Smooth_options_3 options;
    options.keep_criteria = keep_criteria;
    options.max_sweeps = 20;
    weft::smooth_3(mesh, criteria, options, Smoother());
    m.after_20 = cells_below(mesh, 10);
    options.max_sweeps = 80;
    weft::smooth_3(mesh, criteria, options, Smoother());
    m.after_100 = cells_below(mesh, 10);
    m.cells = static_cast<double>(weft::tetrahedral_mesh(mesh).cells.size());
  };
  return in_child<Sweep_counts>(run, domain.time_limit());
}

/// All smoothers on one domain; [0]: criteria are kept, [1]: they aren't.
struct Smoother_run
{
  std::string input;
  Sweep_counts nodt[2], odt[2], lloyd[2];
};

inline Smoother_run smoother_run(const Spatial_domain& domain, const Bounds& bounds)
{
  Smoother_run run;
  run.input = domain.input().name;
  for (int free = 0; free < 2; ++free) {
    run.nodt[free] = sweep_counts<weft::Natural_odt_3>(domain, bounds, free == 0);
    run.odt[free] = sweep_counts<weft::Odt_3>(domain, bounds, free == 0);
    run.lloyd[free] = sweep_counts<weft::Lloyd_3>(domain, bounds, free == 0);
  }
  return run;
}

// ---- The cost of a sweep

/// One sweep against a Delaunay triangulation of the same points.
struct Sweep_cost
{
  double seconds = 0, delaunay = 0;   ///< user time
  double sizing = -1, positions = -1; ///< shares of wall time; -1: not measured
  double moving = -1, flips = -1, rebuilding = -1, labels = -1;
  double in_place = 0, stayed = 0, rebuilt = 0, flipped = 0, regions = 0; ///< vertices, flips, and regions built anew

  /// Adds the counts of so many sweeps.
  void count(const weft::internal::Relocation_counts_3& r, int sweeps)
  {
    in_place += static_cast<double>(r.in_place) / sweeps;
    stayed += static_cast<double>(r.put_back) / sweeps;
    rebuilt += static_cast<double>(r.rebuilt) / sweeps;
    flipped += static_cast<double>(r.flips) / sweeps;
    regions += static_cast<double>(r.regions) / sweeps;
  }

  double ratio() const { return seconds / delaunay; }
};

struct Sweep_costs
{
  double vertices = -1;
  double ordering = -1;   ///< what whole runs do once before they optimise, sorting in memory, against Delaunay
  Sweep_cost first, late; ///< on the refined mesh in order; after 30 sweeps of the same run
  double cgal = -1;       ///< one sweep of CGAL's ODT against Delaunay of its points
  char failure[200] = "";
};

inline double delaunay_seconds(const Weft_mesh& mesh)
{
  std::vector<Spatial_kernel::Point_3> points;
  for (const auto v : mesh.vertices()) points.push_back(v->point());
  const int times = static_cast<int>(std::max(3., 2e5 / static_cast<double>(points.size())));
  const double start = user_seconds();
  delaunay_with_cgal(points, times);
  return (user_seconds() - start) / times;
}

/// The first sweep, by itself.
inline Sweep_cost first_sweep_cost(Weft_mesh& mesh, const weft::Criteria_3<Spatial_kernel>& criteria)
{
  weft::Smooth_options_3 options;
  options.keep_criteria = false;
  options.max_sweeps = 1;
  Sweep_cost cost;
  cost.delaunay = delaunay_seconds(mesh);
  const double start = user_seconds();
  const weft::Smooth_report_3 report = weft::smooth_3(mesh, criteria, options);
  cost.seconds = user_seconds() - start;
  cost.count(report.relocations, 1);
  const weft::internal::Relocation_counts_3& r = report.relocations;
  cost.sizing = report.sizing_seconds / report.seconds;
  cost.positions = report.position_seconds / report.seconds;
  cost.moving = r.moving_seconds / report.seconds;
  cost.flips = r.flipping_seconds / report.seconds;
  cost.rebuilding = r.rebuilding_seconds / report.seconds;
  cost.labels = r.classifying_seconds / report.seconds;
  return cost;
}

/// The last sweeps of one run, on average: a run that ends before them tells what they add to its counts.
inline Sweep_cost last_sweeps_cost(Weft_mesh& shorter, Weft_mesh& mesh,
                                   const weft::Criteria_3<Spatial_kernel>& criteria, int sweeps, int last)
{
  weft::Smooth_options_3 options;
  options.keep_criteria = false;
  options.max_sweeps = sweeps - last;
  const weft::internal::Relocation_counts_3 before = weft::smooth_3(shorter, criteria, options).relocations;
  std::vector<double> starts; // of the sweeps
  options.max_sweeps = sweeps;
  options.go_on = [&] {
    starts.push_back(user_seconds());
    return true;
  };
  const weft::internal::Relocation_counts_3 after = weft::smooth_3(mesh, criteria, options).relocations;
  starts.push_back(user_seconds());
  Sweep_cost cost;
  last = std::min(last, static_cast<int>(starts.size()) - 1); // it may have converged
  cost.seconds = (starts.back() - starts[starts.size() - 1 - static_cast<std::size_t>(last)]) / last;
  cost.count(after, last);
  cost.count(before, -last);
  cost.delaunay = delaunay_seconds(mesh);
  return cost;
}

inline void run_sweep_costs(const Spatial_domain& domain, const Bounds& bounds, bool with_cgal, Sweep_costs& m)
{
  const auto criteria = weft_criteria(domain.input(), bounds);
  Weft_mesh mesh = refined_mesh(domain, bounds), other = refined_mesh(domain, bounds);
  m.vertices = static_cast<double>(mesh.vertices().size());
  weft::internal::sort_in_memory(mesh);
  weft::internal::sort_in_memory(other);
  m.late = last_sweeps_cost(other, mesh, criteria, 35, 5);
  mesh = refined_mesh(domain, bounds);
  const double start = user_seconds();
  weft::internal::sort_in_memory(mesh);
  const double seconds = user_seconds() - start;
  m.first = first_sweep_cost(mesh, criteria);
  m.ordering = seconds / m.first.delaunay;
  if (!with_cgal) return;
  Cgal_complex complex = mesh_with_cgal(domain.cgal_domain(), bounds, bounds.size);
  std::vector<Spatial_kernel::Point_3> points;
  for (const auto v : complex.triangulation().finite_vertex_handles()) points.push_back(v->point().point());
  const double begin = user_seconds();
  delaunay_with_cgal(points, 5);
  const double middle = user_seconds();
  odt_with_cgal(complex, domain.cgal_domain(), 1);
  m.cgal = (user_seconds() - middle) / ((middle - begin) / 5);
}

/// The medians, by ratio, of three runs.
inline Sweep_costs sweep_costs(const Spatial_domain& domain, const Bounds& bounds)
{
  std::vector<Sweep_costs> runs;
  for (int i = 0; i < 3; ++i)
    runs.push_back(in_child<Sweep_costs>([&](Sweep_costs& m) { run_sweep_costs(domain, bounds, i == 0, m); },
                                         domain.time_limit()));
  for (const Sweep_costs& r : runs)
    if (r.failure[0]) return r;
  Sweep_costs result = runs[0]; // has CGAL's
  for (auto cost : {&Sweep_costs::first, &Sweep_costs::late}) {
    std::sort(runs.begin(), runs.end(),
              [&](const Sweep_costs& a, const Sweep_costs& b) { return (a.*cost).ratio() < (b.*cost).ratio(); });
    result.*cost = runs[1].*cost;
  }
  return result;
}

// ---- Perturbation

/// Sums over several seeds.
struct Perturb_cost
{
  double before = -1, after = 180, seconds = 0; ///< degrees, of the worst seed; user time
  double squared_seconds = 0;
  double by_radius = 0, by_volume = 0, by_chance = 0, insertions = 0, removals = 0;
  char failure[200] = "";

  void add(const Perturb_cost& other)
  {
    before = other.before;
    after = std::min(after, other.after);
    seconds += other.seconds;
    squared_seconds += other.seconds * other.seconds;
    by_radius += other.by_radius;
    by_volume += other.by_volume;
    by_chance += other.by_chance;
    insertions += other.insertions;
    removals += other.removals;
    if (other.failure[0]) std::copy(std::begin(other.failure), std::end(other.failure), failure);
  }
};

/// Both ways, for every seed from the same mesh one after the other, so that what else runs on the machine slows both.
struct Perturb_costs
{
  Perturb_cost combined, random;
};

struct Perturb_run
{
  std::string input;
  double target = 0; ///< degrees
  Perturb_cost combined, random;

  double ratio() const { return random.seconds / combined.seconds; }
  /// Of the ratio, from how the times of the seeds scatter.
  double standard_error() const
  {
    const auto variance = [](const Perturb_cost& c) { // of the sum, relative
      return std::max(0., c.squared_seconds / (c.seconds * c.seconds) - 1. / seeds) * seeds / (seeds - 1.);
    };
    return ratio() * std::sqrt(variance(combined) + variance(random));
  }

  /// The last few slivers may take longer than all others, by chance: on anchor the time of a seed scatters by half,
  /// that of five by a fifth, which says nothing yet.
  static constexpr unsigned seeds = 20;
};

/// \param mesh stays as it is: a child process perturbs its own. What the criteria say of it beforehand, which a whole
/// run knows by then, isn't in the time.
inline Perturb_cost perturb_cost(Weft_mesh& mesh, const weft::Criteria_3<Spatial_kernel>& criteria,
                                 weft::Perturb_options_3 options, double limit, unsigned time_limit)
{
  const auto run = [&](Perturb_cost& m) {
    weft::internal::Criteria_guard_3<Weft_mesh> guard(mesh, criteria);
    User_limit(limit).limit(options);
    const double start = user_seconds();
    const weft::Perturb_report_3 report = weft::perturb_slivers_3(mesh, guard, options);
    m.seconds = user_seconds() - start;
    m.before = report.before;
    m.after = report.after;
    m.by_radius = static_cast<double>(report.by_radius);
    m.by_volume = static_cast<double>(report.by_volume);
    m.by_chance = static_cast<double>(report.by_chance);
    m.insertions = static_cast<double>(report.insertions);
    m.removals = static_cast<double>(report.removals);
  };
  return in_child<Perturb_cost>(run, time_limit);
}

/// Degrees: that which the thesis quotes times for, and the default.
constexpr std::array<double, 2> perturb_targets = {17, 20};

/// Optimises but for the perturbation, then perturbs to each of the targets.
inline std::vector<Perturb_run> perturb_runs(const Spatial_domain& domain, const Bounds& bounds, double limit)
{
  struct All
  {
    Perturb_costs costs[perturb_targets.size()];
    char failure[200] = "";
  };
  const auto run = [&](All& all) {
    const auto criteria = weft_criteria(domain.input(), bounds);
    weft::Mesh_options_3 unperturbed;
    unperturbed.min_dihedral_angle = 0;
    Weft_mesh mesh = weft::make_mesh_3(domain.oracle(), criteria, unperturbed).restricted;
    weft::Perturb_options_3 options;
    for (std::size_t t = 0; t < perturb_targets.size(); ++t) {
      options.target = perturb_targets[t];
      for (options.seed = 0; options.seed < Perturb_run::seeds; ++options.seed) {
        options.directions = weft::Perturb_directions_3::combined;
        all.costs[t].combined.add(perturb_cost(mesh, criteria, options, limit, domain.time_limit()));
        options.directions = weft::Perturb_directions_3::random;
        all.costs[t].random.add(perturb_cost(mesh, criteria, options, limit, domain.time_limit()));
      }
    }
  };
  All all = in_child<All>(run, domain.time_limit());
  std::vector<Perturb_run> runs;
  for (std::size_t t = 0; t < perturb_targets.size(); ++t) {
    if (all.failure[0]) std::copy(std::begin(all.failure), std::end(all.failure), all.costs[t].combined.failure);
    runs.push_back({domain.input().name, perturb_targets[t], all.costs[t].combined, all.costs[t].random});
  }
  return runs;
}

// ---- As far as it goes

/// User seconds until no dihedral angle was below so many degrees (figures 3.10 and 3.11 of the thesis).
struct Bound_times
{
  static constexpr std::array<double, 8> bounds = {3, 5, 9, 13, 17, 21, 25, 28};
  std::array<double, bounds.size()> seconds = {-1, -1, -1, -1, -1, -1, -1, -1}; ///< -1: never

  void reached(double angle, double now)
  {
    for (std::size_t i = 0; i < bounds.size(); ++i)
      if (seconds[i] < 0 && angle >= bounds[i]) seconds[i] = now;
  }
};

/// A row of the thesis' table 3.1: smallest dihedral angles; and how long it took to get there.
struct Best_angles
{
  double before = -1, combined = -1, random = -1, exuded = -1;
  Bound_times combined_times, random_times;
  char failure[200] = "";
};

enum class Preparation
{
  none,
  lloyd,
  odt
};

/// What is left to keep after smoothing that kept no criterion, nor the distance to the surface, as in the thesis.
/// Where facets may get no farther from the surface than they have come, a facet with an angle of 16 degrees that the
/// free sweeps leave on the dinosaur ends everything at 19.3 degrees.
inline weft::Criteria_3<Spatial_kernel> topology_alone()
{
  weft::Criteria_3<Spatial_kernel> criteria;
  criteria.size = criteria.deviation = 1e9;
  criteria.facet_shape = criteria.cell_shape = 0;
  return criteria;
}

/// Table 3.1's three ways in one process, each from its own refined and smoothed mesh.
inline Best_angles best_angles(const Spatial_domain& domain, const Bounds& bounds, Preparation preparation,
                               double limit)
{
  const auto criteria = weft_criteria(domain.input(), bounds);
  const auto prepared = [&] {
    Weft_mesh mesh = refined_mesh(domain, bounds);
    weft::Smooth_options_3 options;
    options.keep_criteria = false;
    options.max_sweeps = 50;
    if (preparation == Preparation::lloyd) weft::smooth_3(mesh, criteria, options, weft::Lloyd_3());
    if (preparation == Preparation::odt) weft::smooth_3(mesh, criteria, options, weft::Odt_3());
    return mesh;
  };
  const auto perturbed = [&](weft::Perturb_directions_3 directions, Bound_times& times) {
    Weft_mesh mesh = prepared();
    weft::Perturb_options_3 options;
    options.target = 90;
    User_limit(limit).limit(options);
    options.directions = directions;
    const double start = user_seconds();
    options.go_on = [&times, start, within_limit = options.go_on](double angle) {
      times.reached(angle, user_seconds() - start);
      return within_limit(angle);
    };
    const auto report =
        weft::perturb_slivers_3(mesh, preparation == Preparation::none ? criteria : topology_alone(), options);
    times.reached(report.after, user_seconds() - start);
    return report;
  };
  const auto run = [&](Best_angles& m) {
    const weft::Perturb_report_3 combined = perturbed(weft::Perturb_directions_3::combined, m.combined_times);
    m.before = combined.before;
    m.combined = combined.after;
    m.random = perturbed(weft::Perturb_directions_3::random, m.random_times).after;
    m.exuded = smallest_dihedral(exude_with_cgal(prepared(), limit));
  };
  return in_child<Best_angles>(run, domain.time_limit());
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_RUN_H
