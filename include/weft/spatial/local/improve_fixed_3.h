// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of a tetrahedral mesh with a fixed boundary by local changes (Klingner, Shewchuk, "Aggressive tetrahedral
// mesh improvement", 2007): every boundary and interface facet stays, the rest need not be Delaunay. Cells below the
// angle asked for are worked on, worst first, by one change at a time that makes things better; where none does,
// several at once are tried and undone if they don't. Inverted cells count as worse than any other and are mended
// first.

#ifndef WEFT_SPATIAL_LOCAL_IMPROVE_FIXED_3_H
#define WEFT_SPATIAL_LOCAL_IMPROVE_FIXED_3_H

#include <weft/internal/timer.h>
#include <weft/spatial/local/Editable_mesh_3.h>
#include <weft/spatial/local/fixed_facets_bound_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/local/Local_operations_3.h>
#include <weft/spatial/local/star_optimiser_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace weft::internal {

/// The improver; `improve_fixed_3()` runs it.
template <class K>
class Fixed_improver_3
{
public:
  using Mesh = Editable_mesh_3<K>;
  using Point = typename K::Point_3;

  Fixed_improver_3(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options)
      : options_(options),
        mesh_(mesh, options.fixed_vertices),
        operations_(mesh_),
        target_(quality_of_angle_3(options.min_dihedral_angle)),
        enough_(quality_of_angle_3((std::min)(options.min_dihedral_angle + 2, 90.0))),
        random_(options.seed + 3),
        vertices_(mesh.points.size())
  {}

  Stop_reason run()
  {
    if (options_.min_dihedral_angle == 0) target_ = enough_ = 1e-15; // only untangling
    int idle = 0;
    for (int pass = 0; idle < most_idle; ++pass) {
      const std::vector<Bad_cell> bad = bad_cells();
      if (bad.empty() || !may_go_on(bad.size())) break;
      const Standing before = standing(bad);
      // Most of what can be done is done by single changes; what is left then is worth more.
      work_on(bad, pass < plain_passes ? 0 : idle + 1);
      mesh_.compact();
      if (stop_reason_ != Stop_reason::criteria_met) break;
      const Standing after = standing(bad_cells());
      idle = after.is_clearly_better_than(before) ? 0 : idle + 1;
    }
    return stop_reason_;
  }

  const Mesh& mesh() const { return mesh_; }
  const Local_counts_3& counts() const { return operations_.counts(); }

private:
  using Bad_cell = std::pair<double, int>; ///< quality, number

  static constexpr int most_idle = 3, plain_passes = 3;
  static constexpr std::size_t worst_few = 30;

  /// How bad the cells below the target are altogether.
  struct Standing
  {
    double worst = HUGE_VAL, sum = 0;

    bool is_clearly_better_than(const Standing& other) const
    {
      return worst > other.worst + 0.01 * std::abs(other.worst) || sum < 0.97 * other.sum;
    }
  };

  Standing standing(const std::vector<Bad_cell>& bad) const
  {
    Standing result;
    for (const auto& [q, c] : bad) {
      result.worst = (std::min)(result.worst, q);
      result.sum += target_ - q;
    }
    return result;
  }

  /// Worst first, ties by number.
  std::vector<Bad_cell> bad_cells() const
  {
    std::vector<Bad_cell> bad;
    for (int c = 0; c < mesh_.number_of_cells(); ++c) {
      if (!mesh_.cell(c).is_alive) continue;
      const double q = operations_.quality(c);
      if (q < target_) bad.emplace_back(q, c);
    }
    std::sort(bad.begin(), bad.end());
    return bad;
  }

  bool may_go_on(std::size_t bad)
  {
    if (timer_.seconds() >= options_.time_limit) return stop(Stop_reason::time_limit);
    const std::size_t vertices = vertices_ + operations_.counts().insertions - operations_.counts().contractions;
    if (vertices >= options_.max_vertices) return stop(Stop_reason::vertex_budget);
    if (options_.visitor && !options_.visitor({Stage::polishing, vertices, bad, timer_.seconds()}))
      return stop(Stop_reason::cancelled);
    return true;
  }

  bool stop(Stop_reason reason)
  {
    stop_reason_ = reason;
    return false;
  }

  /// \param effort 0: single changes only; more: so many times as many trials of several changes at once.
  void work_on(const std::vector<Bad_cell>& bad, int effort)
  {
    std::size_t done = 0;
    for (const auto& [q, c] : bad) {
      if (done++ % 32 == 0 && !may_go_on(bad.size() - done)) return;
      if (!mesh_.cell(c).is_alive || operations_.quality(c) >= target_) continue;
      mesh_.begin();
      if (improve(c, true) || effort == 0) continue;
      const int trials = effort * (done <= worst_few ? 24 : 2);
      for (int trial = 0; trial < trials && mesh_.cell(c).is_alive; ++trial)
        if (shake(c, trial)) break;
    }
  }

  /// The first single change that helps.
  bool improve(int c, bool with_insertion)
  {
    const auto vertices = mesh_.cell(c).vertices;
    bool smoothed = false;
    for (const int v : vertices) smoothed = operations_.smooth(v, enough_) || smoothed;
    if (smoothed && operations_.quality(c) >= target_) return true;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (operations_.remove_edge(c, vertices[i], vertices[j])) return true;
    for (int i = 0; i < 4; ++i)
      if (operations_.remove_facets(c, i)) return true;
    if (smoothed) return true;
    for (const int v : vertices)
      if (operations_.remove_vertex(v)) return true;
    return with_insertion && operations_.insert_vertex(c, center(c));
  }

  Point center(int c) const
  {
    const auto& v = mesh_.cell(c).vertices;
    return CGAL::centroid(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  }

  // ---- several changes at once

  /// Makes a change that needn't help by itself, mends what it touched, and keeps all if every cell touched is better
  /// than c was.
  bool shake(int c, int trial)
  {
    const double before = operations_.quality(c);
    const Local_counts_3 counts = operations_.counts();
    mesh_.begin();
    const bool changed = trial % 3 == 0 ? insert_near(c) : move_near(c);
    if (changed) {
      for (int round = 0; round < 3; ++round)
        if (!mend_touched(before)) break;
      if (worst_touched(c) > before + 1e-6) return true;
    }
    mesh_.undo();
    operations_.set_counts(counts);
    return false;
  }

  bool insert_near(int c)
  {
    const auto& v = mesh_.cell(c).vertices;
    std::array<double, 4> weight;
    double sum = 0;
    for (double& w : weight) sum += w = 0.02 + unit_random();
    double x = 0, y = 0, z = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& p = mesh_.point(v[i]);
      x += weight[i] / sum * p.x(), y += weight[i] / sum * p.y(), z += weight[i] / sum * p.z();
    }
    return operations_.insert_vertex(c, Point(x, y, z), std::numeric_limits<double>::max());
  }

  /// Moves a free vertex of the cell, or of one beside it, at random.
  bool move_near(int c)
  {
    std::vector<int> around;
    const auto add = [&](int cell) {
      for (const int v : mesh_.cell(cell).vertices)
        if (mesh_.is_free(v) && std::find(around.begin(), around.end(), v) == around.end()) around.push_back(v);
    };
    add(c);
    for (int i = 0; i < 4; ++i)
      if (mesh_.neighbour(c, i) != Mesh::none) add(mesh_.neighbour(c, i));
    if (around.empty()) return false;
    const int v = around[random_() % around.size()];
    double shortest = HUGE_VAL;
    for (const int cell : mesh_.star(v))
      for (const int w : mesh_.cell(cell).vertices)
        if (w != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(mesh_.point(v), mesh_.point(w))));
    const double reach = 0.7 * std::sqrt(shortest);
    const auto shift = [&] { return reach * (2 * unit_random() - 1); };
    const Point& p = mesh_.point(v);
    const double x = p.x() + shift(), y = p.y() + shift(), z = p.z() + shift();
    mesh_.move(v, Point(x, y, z));
    return true;
  }

  double unit_random() { return static_cast<double>(random_()) / 4294967296.0; }

  /// Works on the touched cells that aren't better than that; whether that changed anything.
  bool mend_touched(double bound)
  {
    std::vector<Bad_cell> bad;
    for (const int t : mesh_.touched_cells()) {
      const double q = operations_.quality(t);
      if (q <= bound + 1e-6 || q < 0.8 * target_) bad.emplace_back(q, t);
    }
    std::sort(bad.begin(), bad.end());
    bool changed = false;
    for (std::size_t k = 0; k < (std::min)(bad.size(), std::size_t(12)); ++k)
      if (mesh_.cell(bad[k].second).is_alive) changed = improve(bad[k].second, false) || changed;
    return changed;
  }

  double worst_touched(int c)
  {
    double worst = mesh_.cell(c).is_alive ? operations_.quality(c) : HUGE_VAL;
    for (const int t : mesh_.touched_cells()) worst = (std::min)(worst, operations_.quality(t));
    return worst;
  }

  const Improve_options_3& options_;
  Mesh mesh_;
  Local_operations_3<K> operations_;
  double target_, enough_;
  std::mt19937 random_;
  std::size_t vertices_;
  Timer timer_;
  Stop_reason stop_reason_ = Stop_reason::criteria_met;
};

/// Improves a mesh and keeps its boundary and interfaces exactly.
template <class K>
Tetrahedral_mesh_3<K> improve_fixed_3(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options,
                                      Improve_report_3& report)
{
  Lap_timer lap;
  Fixed_improver_3<K> improver(mesh, options);
  report.stage_seconds.emplace_back("initialisation", lap.seconds());
  report.stop_reason = improver.run();
  report.stage_seconds.emplace_back("local changes", lap.seconds());
  report.boundary_bound = fixed_facets_bound_3(improver.mesh()); // now: around inverted cells there are no angles
  report.stage_seconds.emplace_back("bound", lap.seconds());
  const Local_counts_3& counts = improver.counts();
  report.moves = counts.moves;
  report.insertions = counts.insertions;
  report.removals = counts.contractions;
  report.flips = counts.edge_removals + counts.facet_removals;
  return improver.mesh().mesh(mesh);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_LOCAL_IMPROVE_FIXED_3_H
