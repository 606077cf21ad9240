// SPDX-License-Identifier: GPL-3.0-or-later
//
// The planar mesher as a sequence of stages over a Working_mesh_2 (Tournois 2009, Alg. 2): sample the constraints, grow
// crystals, relax, then refine and relax in turn until every sizing ratio is at most 1, and polish. `make_mesh_2()` is
// the way to call it.

#ifndef WEFT_PLANAR_PLANAR_MESHER_2_H
#define WEFT_PLANAR_PLANAR_MESHER_2_H

#include <weft/internal/timer.h>
#include <weft/options.h>
#include <weft/planar/input_grading_2.h>
#include <weft/planar/lloyd_2.h>
#include <weft/planar/pliant_2.h>
#include <weft/planar/polish_2.h>
#include <weft/planar/quality_2.h>
#include <weft/planar/refine_2.h>
#include <weft/planar/sample_constraints_2.h>
#include <weft/planar/seed_crystals_2.h>
#include <weft/planar/Working_mesh_2.h>
#include <weft/relocate/Relocator_2.h>
#include <weft/report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace weft {

template <class Cdt, class Sizing>
class Planar_mesher_2
{
public:
  using Mesh = Working_mesh_2<Cdt, Sizing>;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param keep_vertices whether vertices without constraints are to be moved rather than kept as input.
  Planar_mesher_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options, bool keep_vertices)
      : mesh_(cdt, sizing, keep_vertices ? Mesh::Given::relaxable : Mesh::Given::input),
        sizing_(sizing),
        options_(options),
        refiner_(mesh_, options.min_angle),
        polisher_(mesh_),
        pliant_(mesh_, polisher_)
  {
    report_.input_vertices = mesh_.input_vertices();
  }

  Mesh_report_2 mesh()
  {
    if (options_.seeding == Seeding::crystal) {
      if (options_.grade_input) timed(Stage::constraints, [this] { grade_input(); });
      timed(Stage::constraints, [this] { sample_constraints(); });
      timed(Stage::seeding, [this] { seed(); });
      timed(Stage::relaxation, [this] { relax_all(options_.move_ratio, options_.quadrature); });
    }
    interleave();
    return finish();
  }

  Mesh_report_2 relax()
  {
    timed(Stage::relaxation, [this] { relax_all(options_.final_move_ratio, options_.final_quadrature); });
    if (options_.polish) timed(Stage::polishing, [this] { polish_angles(); });
    refiner_.find_bad();
    return finish();
  }

private:
  // Lattice spacing and metric length of constrained edges to aim at, in parts of the target. On the square at 10k
  // triangles a spacing of 0.82 ends at 1.48 times the ideal number of triangles, 0.86 at 1.35; from 0.88 on the layer
  // along the constraints needs so many insertions that the total grows again.
  static constexpr double lattice_spacing = 0.9, constraint_spacing = 0.9;

  // Sizes at details of the input, over edge lengths and channel widths there, and their growth with distance. Where the
  // input is finer than the size, CGAL's refinement (20.7 degrees) needs 2974 Steiner points for a fractal shore, 773 for 302
  // segments of lakes; with growth 0.80 / 0.85 / 0.90 these are 3002 / 2701 / 2505 and 660 / 615 / 616, with smallest angles
  // of 20.6 / 25.1 / 19.3 degrees on the shore.
  static constexpr double detail_edge = 1.2, detail_width = 1.2, detail_growth = 0.85;

  // Costs from which triangles are polished (38 degrees) and mended by inserting or removing a vertex (37 degrees).
  static constexpr double polish_cost = 0.5, pliant_cost = 1;
  static constexpr std::size_t least_insertions = 20;
  static constexpr int most_pliant_passes = 6, most_rounds = 8, most_fruitless_batches = 60;

  template <class Function>
  void timed(Stage stage, const Function& function)
  {
    stage_ = stage;
    const double start = timer_.seconds();
    if (!stopped_) function();
    const double seconds = timer_.seconds() - start;
    for (auto& [n, s] : report_.stage_seconds)
      if (n == name(stage)) {
        s += seconds;
        return;
      }
    report_.stage_seconds.emplace_back(name(stage), seconds);
  }

  /// Whether to go on; notes why not.
  bool go_on(std::size_t vertices)
  {
    if (stopped_) return false;
    if (timer_.seconds() > options_.time_limit)
      stop(Stop_reason::time_limit);
    else if (options_.visitor && !options_.visitor({stage_, vertices, bad_, timer_.seconds()}))
      stop(Stop_reason::cancelled);
    return !stopped_;
  }

  bool go_on() { return go_on(mesh_.vertices().size()); }

  void stop(Stop_reason reason)
  {
    if (stopped_) return;
    stopped_ = true;
    report_.stop_reason = reason;
  }

  void grade_input()
  {
    Cdt copy(mesh_.triangulation());
    remove_frame(copy);
    Mesh scratch(copy, sizing_);
    const auto go = [this](std::size_t n) { return go_on(n); };
    // Whatever stops this will stop the mesh itself.
    if (!sample_constraints_2(scratch, 1, options_.max_vertices, go)) return;
    scratch.renumber();
    const auto details = find_input_details_2(scratch, detail_edge, detail_width);
    if (details.points.empty()) return;
    mesh_.set_grading(typename Mesh::Grading(details.points, details.sizes, detail_growth));
    mesh_.renumber();
  }

  /// Removes from a copy of the working mesh the frame, where the sizing field need not be defined.
  void remove_frame(Cdt& copy) const
  {
    std::vector<Vertex_handle> frame;
    for (const Vertex_handle v : copy.finite_vertex_handles())
      if (v->id() >= static_cast<int>(mesh_.vertices().size())) frame.push_back(v);
    for (const Vertex_handle v : frame) copy.remove(v);
  }

  bool sample_constraints()
  {
    const bool done = sample_constraints_2(mesh_, constraint_spacing, options_.max_vertices,
                                           [this](std::size_t n) { return go_on(n); });
    if (!done) stop(Stop_reason::vertex_budget);
    mesh_.renumber();
    return done;
  }

  void seed()
  {
    Crystal_seeder_2<Mesh> seeder(mesh_, lattice_spacing);
    if (!seeder.run(options_.max_vertices, [this](std::size_t n) { return go_on(n); }))
      stop(Stop_reason::vertex_budget);
    mesh_.renumber();
  }

  /// Relaxes every vertex; those that have come to rest are left alone while their neighbors rest, too.
  void relax_all(double move_ratio, int quadrature)
  {
    relax(mesh_.vertices(), move_ratio, quadrature, options_.max_sweeps);
  }

  void relax(std::vector<Vertex_handle> active, double move_ratio, int quadrature, int sweeps)
  {
    // A vertex rests when it moves less than this part of the stopping ratio.
    constexpr double rest = 0.1;
    Lloyd_2<Mesh> smoother(mesh_, options_.size_feedback, quadrature, options_.threads);
    std::vector<char> is_active(mesh_.vertices().size(), 0);
    std::vector<Vertex_handle> moving;
    std::vector<Point> targets;
    for (int sweep = 0; sweep < sweeps && !active.empty() && go_on(); ++sweep) {
      smoother.compute(faces_around(active, is_active));
      moving.clear();
      targets.clear();
      double largest = 0;
      for (const Vertex_handle v : active) {
        if (v->constraint() == fixed_vertex) continue;
        const auto t = smoother.target(v);
        largest = (std::max)(largest, t.move_ratio);
        if (t.move_ratio < rest * move_ratio) continue;
        moving.push_back(v);
        targets.push_back(t.point);
      }
      count(mesh_.relocator().move(moving, targets));
      for (const Vertex_handle v : moving) mesh_.update_target(v);
      ++report_.sweeps;
      if (largest < move_ratio) break;
      active = with_neighbors(moving);
    }
  }

  void count(const Relocation_counts& c)
  {
    report_.moves += c.moved;
    report_.put_back += c.put_back;
    report_.flips += c.flips;
  }

  /// Faces of the domain around the vertices, once each; marks the vertices in `is_active` meanwhile.
  std::vector<Face_handle> faces_around(const std::vector<Vertex_handle>& active, std::vector<char>& is_active) const
  {
    if (active.size() * 3 > mesh_.vertices().size()) return mesh_.faces();
    for (const Vertex_handle v : active) is_active[v->id()] = 1;
    std::vector<Face_handle> faces;
    for (const Vertex_handle v : active) {
      auto face = mesh_.triangulation().incident_faces(v);
      const auto done = face;
      do
        if (face->is_in_domain() && is_first_active(face, v, is_active)) faces.push_back(face);
      while (++face != done);
    }
    for (const Vertex_handle v : active) is_active[v->id()] = 0;
    return faces;
  }

  /// A face is listed by the active vertex of it with the smallest number.
  static bool is_first_active(Face_handle f, Vertex_handle v, const std::vector<char>& is_active)
  {
    for (int i = 0; i < 3; ++i)
      if (f->vertex(i)->id() < v->id() && is_active[f->vertex(i)->id()]) return false;
    return true;
  }

  std::vector<Vertex_handle> with_neighbors(const std::vector<Vertex_handle>& vertices) const
  {
    std::vector<char> listed(mesh_.vertices().size(), 0);
    std::vector<Vertex_handle> result;
    const auto append = [&](Vertex_handle v) {
      if (mesh_.is_frame(v) || listed[v->id()]) return;
      listed[v->id()] = 1;
      result.push_back(v);
    };
    for (const Vertex_handle v : vertices) {
      append(v);
      auto neighbor = mesh_.triangulation().incident_vertices(v);
      const auto done = neighbor;
      do append(neighbor);
      while (++neighbor != done);
    }
    std::sort(result.begin(), result.end(), [](Vertex_handle a, Vertex_handle b) { return a->id() < b->id(); });
    return result;
  }

  /// Alg. 2: refinement and relaxation in turn, then the last relaxation and polishing; all over again if a criterion
  /// that held before doesn't hold afterwards.
  void interleave()
  {
    const std::size_t n = mesh_.vertices().size();
    pliant_.set_budget(least_insertions + n / 50, 20 * least_insertions + n / 2);
    bool relaxed = false;
    for (int round = 0; round < most_rounds; ++round) {
      refine_until_good();
      if (stopped_) break;
      // Polishing does what the last relaxation is for, and better: with both, the square at 10k triangles takes 2.6
      // times as long for the same mesh, and lakes graded towards their shores end with a smallest angle of 6 degrees,
      // not 12.
      if (!relaxed && !options_.polish) {
        relaxed = true;
        timed(Stage::relaxation, [this] { relax_all(options_.final_move_ratio, options_.final_quadrature); });
        refine_until_good();
      }
      if (options_.polish) timed(Stage::polishing, [this] { polish(); });
      bad_ = refiner_.find_bad();
      if (bad_ == 0) return;
    }
    stop(Stop_reason::iteration_limit);
    bad_ = refiner_.find_bad();
  }

  /// Batches of refinement until no element is bad; stops the run where that takes too long.
  void refine_until_good()
  {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    int fruitless = 0; // batches since there have been so few
    bool polished = false;
    for (;;) {
      bad_ = refiner_.find_bad();
      if (bad_ > 0 && options_.polish && refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal) {
        timed(Stage::polishing, [this] { polish_sizes(); });
        bad_ = refiner_.find_bad();
      }
      if (bad_ > 0 && refiner_.oversized() == 0 && options_.polish && !polished) { // a better angle costs no vertex
        polished = true;
        timed(Stage::polishing, [this] { polish(); });
        continue;
      }
      if (bad_ == 0 || !go_on()) return;
      fruitless = bad_ < fewest ? 0 : fruitless + 1;
      fewest = (std::min)(fewest, bad_);
      // Batches that lower sizes may well find more bad elements than before; those for angles alone have no such
      // excuse.
      const bool stuck = refiner_.oversized() == 0 && fruitless >= most_fruitless_batches;
      if (stuck || report_.batches >= static_cast<std::size_t>(options_.max_batches))
        return stop(Stop_reason::iteration_limit);
      timed(Stage::refinement, [this] { refine(); });
    }
  }

  void refine()
  {
    const std::size_t n = mesh_.vertices().size();
    if (n >= options_.max_vertices) return stop(Stop_reason::vertex_budget);
    const bool near = refiner_.largest_ratio() < Batch_refiner_2<Mesh>::near_goal;
    const std::size_t most = (std::min)(near ? (std::max)(n / 20, std::size_t(1)) : n, options_.max_vertices - n);
    std::vector<Vertex_handle> fresh = refiner_.refine((std::max)(most, std::size_t(1)));
    ++report_.batches;
    mesh_.renumber();
    if (fresh.empty()) return stop(Stop_reason::resolution);
    if (!near) return relax_all(options_.move_ratio, options_.quadrature);
    for (int ring = 0; ring < 4; ++ring) fresh = with_neighbors(fresh);
    relax(fresh, options_.move_ratio, options_.quadrature, 8);
  }

  /// Pulls the last edges that are a little too long below the limit.
  void polish_sizes()
  {
    polisher_.reset();
    for (int pass = 0; pass < 3 && go_on(); ++pass) {
      const std::size_t moved = polisher_.pass(Polisher_2<Mesh>::oversize_cost);
      report_.polished += moved;
      if (moved == 0) break;
    }
  }

  /// Moves, then insertions and removals, for the worst triangles.
  void polish()
  {
    polish_angles();
    for (int pass = 0; pass < most_pliant_passes; ++pass) {
      if (pliant_.pass(pliant_cost, [this] { return go_on(); }) == 0) break;
      polish_angles();
    }
  }

  void polish_angles()
  {
    polisher_.reset();
    for (int pass = 0; pass < 30 && go_on(); ++pass) {
      const std::size_t moved = polisher_.pass(polish_cost);
      report_.polished += moved;
      if (moved == 0) break;
    }
  }

  Mesh_report_2 finish()
  {
    for (const Vertex_handle v : mesh_.vertices())
      if (v->constraint() >= 0) ++report_.constraint_steiner;
    report_.vertices = mesh_.vertices().size();
    report_.interior_steiner = report_.vertices - report_.input_vertices - report_.constraint_steiner;
    report_.triangles = mesh_.faces().size();
    report_.largest_ratio = refiner_.largest_ratio();
    report_.oversized = refiner_.oversized();
    const auto sharp = refiner_.count_sharp();
    report_.below_min_angle = sharp.mendable;
    report_.at_input_angle = sharp.given;
    mesh_.finish();
    const Quality_2 quality = measure_quality_2(mesh_.triangulation());
    report_.smallest_angle = quality.smallest_angle.degrees;
    report_.largest_angle = quality.largest_angle.degrees;
    return report_;
  }

  Mesh mesh_;
  const Sizing& sizing_;
  const Mesh_options_2& options_;
  internal::Timer timer_;
  Batch_refiner_2<Mesh> refiner_;
  Polisher_2<Mesh> polisher_;
  Pliant_improver_2<Mesh> pliant_;
  Mesh_report_2 report_;
  Stage stage_ = Stage::constraints;
  std::size_t bad_ = 0;
  bool stopped_ = false;
};

} // namespace weft

#endif // WEFT_PLANAR_PLANAR_MESHER_2_H
