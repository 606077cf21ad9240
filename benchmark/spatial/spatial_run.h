// SPDX-License-Identifier: GPL-3.0-or-later
//
// One comparison in space: both meshers on a domain, each run in a process of its own, so that the peak of its memory
// is known and neither inherits the other's heap.

#ifndef WEFT_BENCHMARK_SPATIAL_SPATIAL_RUN_H
#define WEFT_BENCHMARK_SPATIAL_SPATIAL_RUN_H

#include "../common/table.h"
#include "spatial_inputs.h"
#include "spatial_peers.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace benchmark {

/// What is measured of one mesh. Plain numbers, since they come through a pipe; -1 is "not measured".
struct Spatial_measures
{
  double vertices = -1, cells = -1, seconds = -1, bytes = -1;
  double hausdorff = -1;                    ///< two-sided, in parts of the longest side
  double longest_edge = -1;                 ///< the same
  double cell_shape = -1, facet_shape = -1; ///< largest circumradius / shortest edge
  double smallest_dihedral = -1, largest_dihedral = -1;
  bool manifold = false;
  double dangling = 0; ///< facets listed that don't separate the domain from the outside
  // weft alone:
  bool criteria_hold = false; ///< by the report, which measures distances to the surface, too
  bool checked = false;       ///< by the checkers of validate_3.h and check_criteria_3.h
  double segments = -1, locations = -1, skipped = -1, candidates = -1; ///< see Mesh_report_3
  char failure[200] = "";

  double bytes_per_vertex() const { return bytes / vertices; }
  bool failed() const { return failure[0] != 0; }
};

inline rusage usage()
{
  rusage result;
  getrusage(RUSAGE_SELF, &result);
  return result;
}

inline double user_seconds(const rusage& r)
{
  return static_cast<double>(r.ru_utime.tv_sec) + 1e-6 * static_cast<double>(r.ru_utime.tv_usec);
}

/// User seconds and peak memory of what happens between construction and `stop()`, in a fresh child process.
class Gauge
{
public:
  Gauge() : before_(usage()) {}
  void stop(Spatial_measures& m) const
  {
    const rusage after = usage();
    m.seconds = user_seconds(after) - user_seconds(before_);
    m.bytes = 1024. * static_cast<double>(after.ru_maxrss - before_.ru_maxrss);
  }

private:
  rusage before_;
};

/// Calls `run(measures)` in a child process, which is killed after the time limit.
/// \tparam Measures plain numbers and `failure`.
template <class Measures = Spatial_measures, class Run>
Measures in_child(const Run& run, unsigned time_limit)
{
  static_assert(std::is_trivially_copyable_v<Measures>);
  int ends[2];
  std::cout.flush();
  malloc_trim(0); // else the child would first use up what the parent has freed
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  Measures m;
  if (child == 0) {
    close(ends[0]);
    alarm(time_limit);
    try {
      run(m);
    } catch (const std::exception& error) {
      std::snprintf(m.failure, sizeof m.failure, "%s", error.what());
    }
    const bool sent = write(ends[1], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  const bool received = read(ends[0], &m, sizeof m) == static_cast<ssize_t>(sizeof m);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!received) {
    m = {};
    std::snprintf(m.failure, sizeof m.failure, "killed by signal %d (14: time limit)", WTERMSIG(status));
  }
  return m;
}

inline void measure(const weft::Tetrahedral_mesh_3<Spatial_kernel>& mesh, const Spatial_input& input,
                    Spatial_measures& m)
{
  const weft::Quality_3 quality = weft::measure_quality_3(mesh);
  m.longest_edge = quality.longest_edge;
  m.cell_shape = quality.largest_radius_edge_ratio;
  m.facet_shape = quality.largest_facet_ratio;
  m.smallest_dihedral = quality.smallest_dihedral.degrees;
  m.largest_dihedral = quality.largest_dihedral.degrees;
  m.manifold = weft::check_manifold_3(mesh).ok();
  m.hausdorff = weft::hausdorff_3(mesh, input.complex.points, input.complex.triangles).two_sided();
}

/// The bounds in weft's terms.
inline weft::Criteria_3<Spatial_kernel> weft_criteria(const Spatial_input& input, const Bounds& bounds)
{
  weft::Criteria_3<Spatial_kernel> criteria;
  criteria.size = bounds.size;
  criteria.approximation = bounds.approximation;
  criteria.facet_shape = criteria.cell_shape = bounds.shape;
  criteria.topology = input.is_creased();
  if (!bounds.circumradii) return criteria;
  criteria.size = 4 / std::sqrt(5.) * bounds.cell_radius(); // the longest edge of a body-centred lattice
  criteria.crease_size = bounds.size;
  criteria.facet_demand = [r = bounds.facet_radius()](const weft::Facet_view_3<Spatial_kernel>& f) {
    return std::sqrt(CGAL::to_double(CGAL::squared_radius(*f.points[0], *f.points[1], *f.points[2]))) / r;
  };
  criteria.cell_demand = [r = bounds.cell_radius()](const weft::Cell_view_3<Spatial_kernel>& c) {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(*c.points[0], *c.circumcenter))) / r;
  };
  return criteria;
}

/// \param thorough whether the mesh itself is measured, besides counts, time and memory.
inline void run_weft(const weft::Polyhedral_oracle_3<Spatial_kernel>& oracle, const Spatial_input& input,
                     const Bounds& bounds, const weft::Mesh_options_3& options, bool thorough, Spatial_measures& m)
{
  const weft::Criteria_3<Spatial_kernel> criteria = weft_criteria(input, bounds);
  const Gauge gauge;
  const auto result = weft::make_mesh_3(oracle, criteria, options);
  gauge.stop(m);
  const weft::Mesh_report_3& report = result.report;
  m.vertices = static_cast<double>(report.vertices);
  m.cells = static_cast<double>(report.cells);
  m.criteria_hold = report.bad() == 0; // a run that the clock ended may have met them, too
  m.segments = static_cast<double>(report.segment_queries);
  m.locations = static_cast<double>(report.location_queries);
  m.skipped = static_cast<double>(report.skipped_queries);
  m.candidates = static_cast<double>(report.candidates);
  if (!thorough) return;
  const auto mesh = weft::tetrahedral_mesh(result.restricted);
  measure(mesh, input, m);
  weft::Validity_3 validity = weft::validate_3(mesh);
  validity += weft::check_criteria_3(mesh, criteria, oracle);
  validity += weft::check_distances_3(mesh, oracle);
  validity += weft::check_features_3(mesh, input.complex);
  m.checked = validity.ok();
}

inline void run_cgal(const Cgal_domain& domain, const Spatial_input& input, const Bounds& bounds, double edge_size,
                     bool thorough, Spatial_measures& m)
{
  const Gauge gauge;
  const Cgal_complex complex = mesh_with_cgal(domain, bounds, edge_size);
  gauge.stop(m);
  const auto mesh = arrays(complex);
  m.vertices = static_cast<double>(mesh.points.size());
  m.cells = static_cast<double>(mesh.cells.size());
  if (!thorough) return;
  measure(mesh, input, m);
  m.dangling = static_cast<double>(dangling_facets(complex));
}

/// One row of the comparison.
struct Spatial_run
{
  std::string input;
  bool creased = false;
  Bounds bounds;
  Spatial_measures cgal, weft;
  double lowered_edge_size = 0; ///< of `lowered`; 0: there is none
  Spatial_measures lowered;     ///< CGAL's, with an edge size for which it gets within 3 approximation bounds

  bool failed() const { return weft.failed() || cgal.failed(); }
  double hausdorff_unit() const { return bounds.approximation > 0 ? bounds.approximation : bounds.size; }
  std::string label() const
  {
    return input + ", " +
           (bounds.approximation > 0 ? "ε " + text(bounds.approximation, 4) : "l " + text(bounds.size, 2));
  }
};

inline double median_of(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// A domain of both meshers, and what building it took.
class Spatial_domain
{
public:
  Spatial_domain(const Spatial_input& input, unsigned time_limit)
      : input_(input),
        polyhedron_(polyhedron(input.complex)),
        oracle_(input.complex),
        cgal_(polyhedron_),
        time_limit_(time_limit)
  {
    if (input.is_creased()) cgal_.detect_features(input.sharp_angle);
  }

  Spatial_run compare(const Bounds& bounds, bool thorough) const
  {
    Spatial_run run{input_.name, input_.is_creased(), bounds, {}, {}, 0, {}};
    run.weft = weft(bounds, thorough);
    run.cgal = cgal(bounds, bounds.size, thorough);
    if (run.failed()) return run;
    const double slower = std::max(run.weft.seconds, run.cgal.seconds);
    std::vector<double> weft_seconds{run.weft.seconds}, cgal_seconds{run.cgal.seconds};
    const int repeats = slower < 0.1 ? 9 : slower < 5 ? 3 : 1;
    for (int i = 1; i < repeats; ++i) { // by turns, so that a busy machine slows both
      weft_seconds.push_back(weft(bounds, false).seconds);
      cgal_seconds.push_back(cgal(bounds, bounds.size, false).seconds);
    }
    run.weft.seconds = median_of(weft_seconds);
    run.cgal.seconds = median_of(cgal_seconds);
    if (thorough && run.creased && bounds.approximation > 0 && run.cgal.hausdorff > 3 * bounds.approximation)
      lower_edge_size(run);
    return run;
  }

  const Spatial_input& input() const { return input_; }
  const weft::Polyhedral_oracle_3<Spatial_kernel>& oracle() const { return oracle_; }
  const Cgal_domain& cgal_domain() const { return cgal_; }
  unsigned time_limit() const { return time_limit_; }

private:
  Spatial_measures weft(const Bounds& bounds, bool thorough) const
  {
    return in_child(
        [&](Spatial_measures& m) {
          run_weft(oracle_, input_, bounds, weft::Mesh_options_3::refinement(), thorough, m);
        },
        time_limit_);
  }

  Spatial_measures cgal(const Bounds& bounds, double edge_size, bool thorough) const
  {
    return in_child([&](Spatial_measures& m) { run_cgal(cgal_, input_, bounds, edge_size, thorough, m); }, time_limit_);
  }

  /// Lowers CGAL's edge size by a quarter each time.
  void lower_edge_size(Spatial_run& run) const
  {
    double edge_size = run.bounds.size;
    for (int i = 0; i < 14; ++i) {
      edge_size *= 0.75;
      const Spatial_measures m = cgal(run.bounds, edge_size, true);
      if (m.failed()) return;
      run.lowered = m;
      run.lowered_edge_size = edge_size;
      if (m.hausdorff <= 3 * run.bounds.approximation) return;
    }
  }

  const Spatial_input& input_;
  Cgal_polyhedron polyhedron_;
  weft::Polyhedral_oracle_3<Spatial_kernel> oracle_;
  Cgal_domain cgal_;
  unsigned time_limit_;
};

} // namespace benchmark

#endif // WEFT_BENCHMARK_SPATIAL_SPATIAL_RUN_H
