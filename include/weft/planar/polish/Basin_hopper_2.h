// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last bad triangles of a mesh sit in minima that no change of a single vertex leaves. Basin hopping (Wales and
// Doye, "Global optimization by basin-hopping", 1997) does: vertices near the triangle are shaken, a few removed or
// inserted, and the neighborhood is polished; the outcome is kept only if it is better than what was there, else all is
// taken back. No angle of the mesh becomes worse than its worst, and no edge too long.

#ifndef WEFT_PLANAR_POLISH_BASIN_HOPPER_2_H
#define WEFT_PLANAR_POLISH_BASIN_HOPPER_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/polish/Neighborhood_2.h>
#include <weft/planar/polish/Polisher_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/working/Failure_memory.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace weft::internal {

/// Mends the worst triangles of a Working_mesh_2 by random changes of their neighborhoods.
template <class Mesh>
class Basin_hopper_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  Basin_hopper_2(Mesh& mesh, Polisher_2<Mesh>& polisher, unsigned seed)
      : mesh_(mesh), polisher_(polisher), random_(seed)
  {}

  /// Tries to mend the triangles whose cost exceeds `bound`, worst first. The mesh is renumbered.
  /// \param insertions allowed beyond the number of removals.
  /// \param go_on callable; false stops.
  /// \returns the number of changes that were kept.
  template <class Go_on>
  std::size_t run(double bound, std::size_t insertions, const Go_on& go_on)
  {
    std::size_t kept = 0;
    insertions_left_ = static_cast<std::ptrdiff_t>(insertions);
    std::vector<Triangle> worst = polisher_.worst_triangles(bound);
    set_budget(worst.size());
    for (const int patience : patiences) {
      if (worst.empty() || trials_left_ == 0) break;
      polisher_.reset();
      kept += pass(worst, bound, patience, go_on);
      mesh_.renumber();
      worst = polisher_.worst_triangles(bound);
    }
    polisher_.reset();
    return kept;
  }

private:
  // Rings of vertices that are polished; with three, figures are no better. Shaking vertices on constraints, too, gains
  // nothing either.
  static constexpr int rings = 2;

  // Rounds of polishing at most; more change nothing. Ending hopeless trials earlier loses more than it saves.
  static constexpr int most_rounds = 12;

  // How far vertices are shaken, in parts of their targets.
  static constexpr double least_shake = 0.1, most_shake = 0.5;

  // Failures in a row after which a triangle is left, in a first pass over all and in a second one. A single pass with
  // 40 wastes its trials on the first triangles where many are bad (the mean then is 29.4 degrees).
  static constexpr std::array<int, 2> patiences{20, 100};

  // What a change must leave of the cost.
  static constexpr double worth_keeping = 0.95;

  using Triangle = typename Polisher_2<Mesh>::Triangle;
  using Region = Neighborhood_2<Mesh>;

  /// The worst of some angles, as cotangents.
  struct Worst
  {
    double small = -std::numeric_limits<double>::infinity(), large = std::numeric_limits<double>::infinity();

    void add(const Worst& o)
    {
      small = (std::max)(small, o.small);
      large = (std::min)(large, o.large);
    }
    bool is_within(const Worst& o) const { return small <= o.small && large >= o.large; }
  };

  /// What a trial is judged by.
  struct Judgement
  {
    double sum = 0, highest = 0; // of costs
    Worst worst;
  };

  /// Few bad triangles are worth more trials than many, most of which details of the input force.
  void set_budget(std::size_t bad)
  {
    const std::size_t n = mesh_.vertices().size();
    trials_left_ = bad <= 20 + mesh_.faces().size() / 500 ? 100 + n / 50 : 50 + n / 200;
  }

  struct Removed
  {
    Point place;
    int id;
  };

  struct Trial
  {
    std::vector<Vertex_handle> core; ///< what is shaken
    Region region;                   ///< what is polished
    /// Around these all that may change. Faces that have no vertex in the region can, when vertices of it retreat.
    std::vector<Vertex_handle> witnesses;
    std::vector<Removed> removed{};
    std::vector<Vertex_handle> inserted{};

    WEFT_NOINLINE Trial(Mesh& mesh, Face_handle f, int rings)
        : core(Region(mesh, f, 1).vertices()), region(mesh, f, rings), witnesses(Region(mesh, f, rings + 1).vertices())
    {}
  };

  template <class Go_on>
  std::size_t pass(const std::vector<Triangle>& worst, double bound, int patience, const Go_on& go_on)
  {
    limits_ = Worst();
    for (const Face_handle f : mesh_.faces()) limits_.add(worst_angles(f));
    std::size_t kept = 0;
    for (const Triangle& t : worst) {
      if (trials_left_ == 0 || !go_on()) break;
      Face_handle f;
      if (polisher_.find(t, f)) kept += hop(f, bound, patience, go_on);
    }
    return kept;
  }

  /// Trials at a triangle, then at whatever is the worst one near it, until all are good or too many trials in a row
  /// have failed. Returns the number of changes that were kept.
  template <class Go_on>
  std::size_t hop(Face_handle f, double bound, int patience, const Go_on& go_on)
  {
    std::size_t kept = 0;
    for (int failed = 0; failed < patience && polisher_.cost(f) > bound && trials_left_ > 0 && go_on();) {
      --trials_left_;
      Trial trial(mesh_, f, rings);
      if (try_change(trial)) {
        ++kept;
        failed = 0;
      } else {
        ++failed;
      }
      f = worst_around(trial.region.vertices());
    }
    return kept;
  }

  Face_handle worst_around(const std::vector<Vertex_handle>& vertices) const
  {
    Face_handle worst;
    double highest = -1;
    for_domain_faces_around(mesh_, vertices, [&](Face_handle f) {
      if (const double c = polisher_.cost(f); c > highest) {
        highest = c;
        worst = f;
      }
    });
    return worst;
  }

  /// Changes the neighborhood of a face at random. Returns whether the change was kept.
  bool try_change(Trial& trial)
  {
    // Numbers of vertices to remove and to insert.
    static constexpr std::array<std::array<int, 2>, 6> changes{{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}}};
    const auto [removals, insertions] = changes[below(changes.size())];
    const Judgement before = judge(trial.witnesses);
    shake(trial.core);
    for (int k = 0; k < removals; ++k) remove_one(trial);
    for (int k = 0; k < insertions; ++k) insert_one(trial);
    const auto more =
        static_cast<std::ptrdiff_t>(trial.inserted.size()) - static_cast<std::ptrdiff_t>(trial.removed.size());
    if (more <= insertions_left_ && settle(trial, before)) {
      insertions_left_ -= more;
      return true;
    }
    take_back(trial);
    return false;
  }

  Judgement judge(const std::vector<Vertex_handle>& vertices) const
  {
    Judgement result;
    for_domain_faces_around(mesh_, vertices, [&](Face_handle f) {
      double c = polisher_.cost(f);
      for (int i = 0; i < 3; ++i)
        if (f->is_constrained(i) && mesh_.edge_ratio(f, i) > 1) c += Polisher_2<Mesh>::oversize_cost;
      result.sum += c;
      result.highest = (std::max)(result.highest, c);
      result.worst.add(worst_angles(f));
    });
    return result;
  }

  bool is_free(Vertex_handle v) const { return v->constraint() == free_vertex && !mesh_.is_frozen(v); }

  /// Moves the free ones of some vertices at random by parts of their target sizes.
  void shake(const std::vector<Vertex_handle>& vertices)
  {
    const double part = least_shake + (most_shake - least_shake) * uniform();
    std::vector<Vertex_handle> moving;
    std::vector<Point> targets;
    for (const Vertex_handle v : vertices) {
      const double d = part * mesh_.target(v), dx = d * (2 * uniform() - 1), dy = d * (2 * uniform() - 1);
      if (!is_free(v)) continue;
      moving.push_back(v);
      targets.emplace_back(CGAL::to_double(v->point().x()) + dx, CGAL::to_double(v->point().y()) + dy);
    }
    mesh_.relocator().move(moving, targets);
    for (const Vertex_handle v : moving) mesh_.update_target(v);
  }

  /// Removes one of the free vertices of the core.
  void remove_one(Trial& trial)
  {
    std::vector<Vertex_handle> free;
    for (const Vertex_handle v : trial.core)
      if (is_free(v)) free.push_back(v);
    if (free.empty()) return;
    const Vertex_handle v = free[below(free.size())];
    const int id = v->id();
    if (!mesh_.remove(v)) return;
    trial.removed.push_back({trial.region.forget(v), id});
    for (auto* list : {&trial.core, &trial.witnesses}) list->erase(std::find(list->begin(), list->end(), v));
  }

  /// Inserts a vertex at a random place of a face around the core.
  void insert_one(Trial& trial)
  {
    std::vector<Face_handle> faces;
    for_domain_faces_around(mesh_, trial.core, [&](Face_handle f) { faces.push_back(f); });
    if (faces.empty()) return;
    const Face_handle f = faces[below(faces.size())];
    double a = uniform(), b = uniform();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Point p = CGAL::barycenter(f->vertex(0)->point(), a, f->vertex(1)->point(), b, f->vertex(2)->point());
    const Vertex_handle v = mesh_.insert_inside(p, f);
    if (v == Vertex_handle()) return;
    mesh_.adopt(v, static_cast<int>(mesh_.vertices().size()));
    trial.region.add(v);
    trial.witnesses.push_back(v);
    trial.inserted.push_back(v);
  }

  /// Polishes the region. Returns whether the outcome is better.
  bool settle(const Trial& trial, const Judgement& before)
  {
    const std::vector<Vertex_handle>& vertices = trial.region.vertices();
    for (const Vertex_handle v : vertices) polisher_.give_hope(v);
    for (int round = 0; round < most_rounds; ++round) {
      bool moved = false;
      for (const Vertex_handle v : vertices) moved |= polisher_.improve(v);
      if (!moved) break;
    }
    const Judgement after = judge(trial.witnesses);
    return after.sum < worth_keeping * before.sum && after.highest < before.highest && after.worst.is_within(limits_);
  }

  WEFT_NOINLINE void take_back(Trial& trial)
  {
    for (const Vertex_handle v : trial.inserted) {
      trial.region.forget(v);
      mesh_.remove(v);
    }
    trial.region.put_back();
    for (const Removed& r : trial.removed) {
      const Vertex_handle v = mesh_.insert_inside(r.place, trial.region.vertices().front()->face());
      if (v == Vertex_handle()) continue;
      mesh_.adopt(v, r.id);
      trial.region.add(v);
    }
  }

  /// Cotangents of the smallest angle that isn't given by the input, and of the largest.
  static Worst worst_angles(Face_handle f)
  {
    std::array<double, 3> x, y;
    for (int i = 0; i < 3; ++i) {
      x[as_index(i)] = CGAL::to_double(f->vertex(i)->point().x());
      y[as_index(i)] = CGAL::to_double(f->vertex(i)->point().y());
    }
    const double doubled_area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    Worst result;
    for (int i = 0; i < 3; ++i) {
      const int j = Triangulation::ccw(i), k = Triangulation::cw(i);
      const double cot = ((x[as_index(j)] - x[as_index(i)]) * (x[as_index(k)] - x[as_index(i)]) +
                          (y[as_index(j)] - y[as_index(i)]) * (y[as_index(k)] - y[as_index(i)])) /
                         doubled_area;
      if (!(f->is_constrained(j) && f->is_constrained(k))) result.small = (std::max)(result.small, cot);
      result.large = (std::min)(result.large, cot);
    }
    return result;
  }

  double uniform() { return static_cast<double>(next() >> 11) / 9007199254740992.0; } // in [0, 1)
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
  std::uint64_t next() { return scrambled(random_ += 0x9e3779b97f4a7c15u); }

  Mesh& mesh_;
  Polisher_2<Mesh>& polisher_;
  std::uint64_t random_;
  std::size_t trials_left_ = 0;
  std::ptrdiff_t insertions_left_ = 0;
  Worst limits_; // no angle may become worse than the mesh's worst was
};

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_BASIN_HOPPER_2_H
