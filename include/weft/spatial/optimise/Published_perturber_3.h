// SPDX-License-Identifier: GPL-3.0-or-later
//
// Alg. 7 of Tournois 2009 as it is printed: a queue of the vertices of slivers, each of which moves along the gradient
// of squared circumradii, then down that of volumes, then at random.

#ifndef WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURBER_3_H
#define WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURBER_3_H

#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_guard_3.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/optimise/Perturb_options_3.h>
#include <weft/spatial/optimise/Perturbation_judge_3.h>
#include <weft/spatial/optimise/Published_perturb_options_3.h>
#include <weft/spatial/optimise/sliver_gradients_3.h>
#include <weft/spatial/restricted/Mesh_without_vertex_3.h>
#include <weft/spatial/restricted/Vertex_transaction_3.h>

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Published_perturber_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Vector = typename Kernel::Vector_3;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Judge = Perturbation_judge_3<Restricted>;

  /// Everything has to live as long as this object.
  Published_perturber_3(Restricted& mesh, Criteria_guard_3<Restricted>& guard,
                        const Published_perturb_options_3& options)
      : mesh_(mesh), options_(options), judge_(mesh, guard), without_(mesh), random_(options.seed)
  {
    if (!options.large_angles) judge_.judge_by_smallest_alone();
  }

  Perturb_report_3 run()
  {
    report_.before = smallest_angle();
    constexpr double first = 4, step = 2;
    for (double bound = options_.rising_bounds ? first : options_.target; goes_on(); bound += step) {
      bound_ = cosine_of_degrees((std::min)(bound, options_.target));
      empty_queue();
      if (bound >= options_.target) break;
    }
    report_.after = smallest_angle();
    report_.seconds = timer_.seconds();
    return report_;
  }

private:
  enum Direction
  {
    by_radius,
    by_volume,
    by_chance
  };

  /// A vertex of slivers.
  struct Candidate
  {
    int id = -1, direction = by_radius, slivers = 0;
    bool on_boundary = false;
    double measure = -1; ///< of its worst cell
  };

  /// Inside first, then those with fewer slivers, then the smaller angle, then the elder.
  struct Before
  {
    bool in_order;

    bool operator()(const Candidate& a, const Candidate& b) const
    {
      if (!in_order) return a.id < b.id;
      if (a.on_boundary != b.on_boundary) return b.on_boundary;
      if (a.slivers != b.slivers) return a.slivers < b.slivers;
      if (a.measure != b.measure) return a.measure > b.measure;
      return a.id < b.id;
    }
  };

  bool goes_on() { return timer_.seconds() < options_.time_limit && (!options_.go_on || options_.go_on()); }

  double smallest_angle() const
  {
    double smallest = -1;
    for (const Cell_handle c : mesh_.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) smallest = (std::max)(smallest, cosines_of_cell(c).smallest);
    return degrees_of_cosine(smallest);
  }

  // ---- the queue

  void empty_queue()
  {
    ++report_.passes;
    queue_.clear();
    waiting_.assign(mesh_.vertices().size(), std::nullopt);
    for (int id = 0; id < static_cast<int>(mesh_.vertices().size()); ++id) enqueue(id, by_radius);
    constexpr std::size_t between_questions = 16;
    for (std::size_t k = 0; !queue_.empty() && (k % between_questions != 0 || goes_on()); ++k) {
      const Candidate next = *queue_.begin();
      dequeue(next.id);
      process(next);
    }
  }

  void dequeue(int id)
  {
    auto& waiting = waiting_[static_cast<std::size_t>(id)];
    if (waiting) queue_.erase(*waiting);
    waiting.reset();
  }

  /// Puts a vertex in its place in the queue if it belongs to a sliver.
  void enqueue(int id, int direction)
  {
    dequeue(id);
    const Vertex_handle v = vertex(id);
    if (mesh_.is_fixed(v)) return;
    Candidate candidate;
    candidate.id = id;
    candidate.direction = direction;
    candidate.on_boundary = v->location().dimension < 3;
    star_.clear();
    mesh_.triangulation().incident_cells(v, std::back_inserter(star_));
    for (const Cell_handle c : star_) {
      if (c->subdomain() == 0) continue;
      const double x = judge_.measure(c);
      candidate.measure = (std::max)(candidate.measure, x);
      candidate.slivers += x > bound_;
    }
    if (candidate.slivers == 0) return;
    waiting_[static_cast<std::size_t>(id)] = candidate;
    queue_.insert(candidate);
  }

  void process(const Candidate& candidate)
  {
    ++report_.tried_vertices;
    const int direction = candidate.direction;
    look_at(candidate.id);
    const bool has_moved = direction == by_chance ? try_at_random() : try_along(direction);
    if (has_moved) {
      ++(direction == by_radius ? report_.by_radius : direction == by_volume ? report_.by_volume : report_.by_chance);
      affected_.clear();
      for (const Cell_handle c : mesh_.new_cells())
        for (int i = 0; i < 4; ++i)
          if (c->vertex(i)->id() >= 0) affected_.push_back(c->vertex(i)->id());
      std::sort(affected_.begin(), affected_.end());
      affected_.erase(std::unique(affected_.begin(), affected_.end()), affected_.end());
      for (const int id : affected_) enqueue(id, by_radius);
    } else if (direction != by_chance) {
      enqueue(candidate.id, direction + 1);
    }
  }

  // ---- one vertex

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  /// What has to be known to move a vertex; to be called again when a move was rolled back.
  void look_at(int id)
  {
    id_ = id;
    is_stale_ = false;
    const Vertex_handle v = vertex(id);
    without_.look_at(v, false);
    double shortest = std::numeric_limits<double>::infinity();
    limit_ = -1;
    for (const Cell_handle c : without_.star()) {
      if (c->subdomain() == 0) continue;
      limit_ = (std::max)(limit_, judge_.measure(c));
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != v)
          shortest = (std::min)(shortest, CGAL::to_double(CGAL::squared_distance(v->point(), c->vertex(i)->point())));
    }
    limit_ -= Judge::least_gain;
    shortest_ = std::sqrt(shortest);
    judge_.set_location(v->location());
    is_crowded_ = !without_.leave_out();
    if (!is_crowded_) judge_.set_filling(without_);
  }

  bool try_along(int direction)
  {
    const Vector step = perturbation(direction);
    if (step == CGAL::NULL_VECTOR) return false;
    const Point origin = vertex(id_)->point();
    Point p = origin;
    const int most = options_.repeats_steps ? options_.random_trials : 3;
    for (int k = 1; k <= most; ++k) {
      const std::optional<Point> next = possible(options_.repeats_steps ? p + step : origin + k * step);
      if (!next || *next == p) return false;
      p = *next;
      ++report_.trials;
      if (!would_flip(p)) continue;
      if (relocate(p)) return true;
      if (options_.repeats_steps) return false;
      if (is_stale_) look_at(id_);
    }
    return false;
  }

  /// The mean of what the slivers at the vertex suggest, zero if they disagree.
  Vector perturbation(int direction)
  {
    const Vertex_handle v = vertex(id_);
    gradients_.clear();
    for (const Cell_handle c : without_.star()) {
      if (c->subdomain() == 0 || judge_.measure(c) <= bound_) continue;
      const int i = c->index(v);
      const Point &a = c->vertex((i + 1) % 4)->point(), &b = c->vertex((i + 2) % 4)->point(),
                  &d = c->vertex((i + 3) % 4)->point();
      const Vector g = direction == by_radius ? gradient_of_squared_radius(v->point(), a, b, d, c->circumcenter())
                                              : -gradient_of_volume(v->point(), a, b, d);
      gradients_.push_back(options_.averages ? unit(g) : g);
    }
    Vector sum(0, 0, 0);
    for (std::size_t i = 0; i < gradients_.size(); ++i) {
      for (std::size_t j = 0; j < i && options_.only_compatible; ++j)
        if (!(gradients_[i] * gradients_[j] > 0)) return Vector(0, 0, 0);
      sum = sum + gradients_[i];
    }
    if (gradients_.empty()) return sum;
    return options_.reach * shortest_ * (options_.averages ? sum / static_cast<double>(gradients_.size()) : unit(sum));
  }

  static Vector unit(const Vector& v)
  {
    const double length = std::sqrt(CGAL::to_double(v.squared_length()));
    return length > 0 && std::isfinite(length) ? v / length : Vector(0, 0, 0);
  }

  bool try_at_random()
  {
    const Point origin = vertex(id_)->point();
    for (int k = 0; k < options_.random_trials; ++k) {
      const double x = random(), y = random(), z = random(); // in this order, whatever the compiler
      const Vector v(x, y, z);
      if (CGAL::to_double(v.squared_length()) > 1) continue; // inside a sphere
      const std::optional<Point> p = possible(origin + options_.reach * shortest_ * v);
      ++report_.trials;
      if (!p || !would_flip(*p)) continue;
      if (relocate(*p)) return true;
      if (is_stale_) look_at(id_);
    }
    return false;
  }

  /// In [-1, 1].
  double random() { return 2 * (static_cast<double>(random_()) / 4294967295.0) - 1; }

  /// The nearest place that the vertex may have.
  std::optional<Point> possible(const Point& p) const
  {
    const Vertex_location_3& at = vertex(id_)->location();
    if (at.dimension == 3 && mesh_.oracle().subdomain(p) != at.index) return std::nullopt;
    return project_on_location(mesh_.oracle(), p, at);
  }

  /// Whether the triangulation would change if the vertex were there.
  bool would_flip(const Point& p) const
  {
    const Vertex_handle v = vertex(id_);
    const auto corners = [&](Cell_handle c) {
      std::array<Point, 4> q;
      for (int k = 0; k < 4; ++k) q[static_cast<std::size_t>(k)] = c->vertex(k) == v ? p : c->vertex(k)->point();
      return q;
    };
    for (const Cell_handle c : without_.star()) {
      const auto q = corners(c);
      if (CGAL::orientation(q[0], q[1], q[2], q[3]) != CGAL::POSITIVE) return true;
    }
    for (const Cell_handle c : without_.star()) {
      const auto q = corners(c);
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        const Vertex_handle w = n->vertex(n->index(c));
        if (mesh_.triangulation().is_infinite(w)) continue;
        if (CGAL::side_of_oriented_sphere(q[0], q[1], q[2], q[3], w->point()) == CGAL::ON_POSITIVE_SIDE) return true;
      }
    }
    return false;
  }

  /// Moves the vertex if that betters the cells that it changes and nothing is refused; whether it has moved.
  bool relocate(const Point& p)
  {
    if (!is_crowded_ && !(judge_.find_zone(p, Cell_handle()) && judge_.judge(limit_) < Judge::no_good)) return false;
    is_stale_ = true;
    Vertex_transaction_3<Restricted> move(mesh_, vertex(id_));
    judge_.set_filling(move.filling());
    if (judge_.find_zone(p, move.filling().front()) && (!is_crowded_ || judge_.judge(limit_) < Judge::no_good)) {
      move.place(judge_.zone());
      if (judge_.is_acceptable(report_)) {
        move.commit();
        return true;
      }
    }
    move.roll_back();
    return false;
  }

  Restricted& mesh_;
  const Published_perturb_options_3& options_;
  Judge judge_;
  Mesh_without_vertex_3<Restricted> without_;
  std::mt19937 random_;
  Timer timer_;
  Perturb_report_3 report_;
  double bound_ = 1; ///< cells that measure more are slivers
  std::set<Candidate, Before> queue_{Before{options_.in_order}};
  std::vector<std::optional<Candidate>> waiting_; ///< by id, as it stands in the queue
  std::vector<Cell_handle> star_;
  std::vector<int> affected_;
  std::vector<Vector> gradients_;
  // Of the vertex that is looked at:
  int id_ = -1;
  double limit_ = -1, shortest_ = 0; ///< what a move has to better; its shortest edge
  bool is_stale_ = false;            ///< the mesh has been changed since
  bool is_crowded_ = false;          ///< it has too many neighbours to judge places while it stays
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_PUBLISHED_PERTURBER_3_H
