// SPDX-License-Identifier: GPL-3.0-or-later
//
// A weighted mesh while its energy is minimised. A point has four coordinates: its place, and its weight over the mean
// length of its edges, so that all four are lengths.

#ifndef WEFT_SPATIAL_SOLVE_WEIGHTED_MODEL_3_H
#define WEFT_SPATIAL_SOLVE_WEIGHTED_MODEL_3_H

#include <weft/energy/coordinates.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/Simplices.h>
#include <weft/energy/weighted_odt_terms.h>
#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/solve/Newton_step.h>
#include <weft/spatial/domain/project_on_location_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/solve/Regular_mesh_3.h>
#include <weft/spatial/solve/Weighted_options_3.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// Instead of an oracle: points on the boundary stay where they are.
struct Boundary_kept_3
{};

/// Model of Energy_descent.
/// \tparam Oracle a domain oracle, where points slide along the boundary, or Boundary_kept_3.
template <class K, class Oracle = Boundary_kept_3>
class Weighted_model_3
{
public:
  static constexpr bool keeps_boundary = std::is_same_v<Oracle, Boundary_kept_3>;
  using Vector = Coordinates<4>;
  using Place = Coordinates<3>;
  using Point = typename K::Point_3;
  using Regular = Regular_mesh_3<K>;

  /// \throws Error if the mesh isn't the regular triangulation of its points.
  Weighted_model_3(const Tetrahedral_mesh_3<K>& mesh, const std::vector<double>& weights, const Oracle& oracle,
                   const Weighted_options_3& options)
      : mesh_(mesh), oracle_(oracle), options_(options), regular_(mesh), points_(mesh.points), weights_(weights)
  {
    simplices_.sizes = options.sizes;
    regular_.triangulate(points_, weights_);
    if (regular_.hidden() > 0) throw Error("a point is hidden by the weights");
    if (!regular_.label_by_walls()) throw Error("the boundary isn't that of the regular triangulation of the points");
    load();
    measure_edges();
    old_points_ = points_;
    old_weights_ = weights_;
  }

  const Simplices<3>& simplices() const { return simplices_; } ///< as `terms()` has seen them last
  const std::vector<double>& weights() const { return weights_; }
  std::size_t taken_back() const { return taken_back_; }

  std::vector<Vector> positions() const
  {
    std::vector<Vector> result(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Place p = place(points_[i]);
      result[i] = {p[0], p[1], p[2], weights_[i] / length_[i]};
    }
    return result;
  }

  bool is_free(std::size_t i) const { return options_.move_weights || can_move(i); }

  Vector to_tangent(std::size_t i, const Vector& v) const
  {
    Vector result{0, 0, 0, options_.move_weights ? v[3] : 0};
    if (!can_move(i)) return result;
    Place p{v[0], v[1], v[2]};
    if (dimension(i) == 2) add_to(p, -dot(normals_[i], p), normals_[i]);
    std::copy(p.begin(), p.end(), result.begin());
    return result;
  }

  /// Weights are held within their bounds; points whose moves would hide a point or cost a wall go back.
  void move(const std::vector<std::size_t>& points, const std::vector<Vector>& targets)
  {
    regular_.find_centers();
    old_points_ = points_;
    old_weights_ = weights_;
    tries_.assign(points_.size(), 0);
    for (const std::size_t i : points) {
      if (can_move(i)) set_place(i, targets[i]);
      if (options_.move_weights)
        weights_[i] = std::clamp(targets[i][3] * length_[i], (std::min)(lowest(i), old_weights_[i]),
                                 (std::max)(highest(i), old_weights_[i]));
    }
    for (bool is_settled = false; !is_settled;) {
      regular_.triangulate(points_, weights_);
      is_settled = true;
      const auto refuse = [&](std::size_t i) {
        if (take_back(i)) is_settled = false;
      };
      refuse_crowds(refuse);
      if (regular_.hidden() == 0 && !regular_.label_by_walls()) regular_.visit_lost_walls(refuse);
    }
    if (options_.move_points) measure_reaches();
  }

  void move_back(const std::vector<std::size_t>&, const std::vector<Vector>&)
  {
    points_ = old_points_;
    weights_ = old_weights_;
    regular_.triangulate(points_, weights_);
    regular_.label_by_walls();
    load();
    if (options_.move_points) measure_reaches();
  }

  /// Infinite where the boundary has been lost. Normalised where points slide along it: they change the domain.
  Energy_terms<4> terms(bool with_weights)
  {
    Energy_terms<4> result;
    result.gradient.assign(points_.size(), Vector{});
    result.diagonal.assign(points_.size(), 0);
    result.value = std::numeric_limits<double>::infinity();
    if (regular_.hidden() > 0 || !regular_.label_by_walls()) return result;
    load();
    Weighted_terms<3> terms =
        weighted_odt_terms(simplices_, weights_, options_.error, with_weights && options_.move_points);
    double factor = 1;
    if constexpr (!keeps_boundary)
      factor = normalise(simplices_, terms.points, options_.error == Lifting_error::volume ? 2 : 4);
    result.value = terms.points.value;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Place& g = terms.points.gradient[i];
      const double g_weight = is_stopped(i, terms.gradient[i]) ? 0 : factor * length_[i] * terms.gradient[i];
      result.gradient[i] = {g[0], g[1], g[2], g_weight};
      const double by_weight = factor * length_[i] * length_[i] * terms.diagonal[i];
      if (options_.move_points) result.diagonal[i] = terms.points.diagonal[i];
      if (options_.move_weights) result.diagonal[i] = (std::max)(result.diagonal[i], by_weight);
    }
    for (const auto& w : terms.points.weights) result.weights.push_back({w.from, w.to, w.value});
    return result;
  }

  std::vector<Jacobian_block<4>> newton_system() const { return {}; } // `check()` refuses Newton's iteration

  /// The mesh as it is now.
  Tetrahedral_mesh_3<K> mesh() const
  {
    Tetrahedral_mesh_3<K> result = mesh_;
    result.points = points_;
    result.cells.clear();
    result.subdomains.clear();
    const auto& tr = regular_.triangulation();
    for (const auto c : tr.finite_cell_handles()) {
      if (c->info() == 0) continue;
      result.cells.push_back({c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
      result.subdomains.push_back(c->info());
    }
    return result;
  }

private:
  static constexpr int most_tries = 2; ///< to bring a weight nearer to what it was, before it is that again

  static Place place(const Point& p)
  {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  int dimension(std::size_t i) const
  {
    if (mesh_.locations.empty()) return regular_.is_on_wall(i) ? 0 : 3;
    return mesh_.locations[i].dimension;
  }

  bool can_move(std::size_t i) const
  {
    return options_.move_points && (!regular_.is_on_wall(i) || (!keeps_boundary && dimension(i) == 2));
  }

  // Two points whose weights are within these don't differ by more than the bound. All errors of an interpolation are
  // positive, so that its best weights are, too, unless a constant is taken off.
  double lowest(std::size_t i) const { return options_.error == Lifting_error::squared ? 0 : -reach_[i] / 2; }
  double highest(std::size_t i) const { return lowest(i) + reach_[i]; }

  /// Whether a weight is at its bound and its energy falls beyond.
  bool is_stopped(std::size_t i, double gradient) const
  {
    return gradient < 0 ? weights_[i] >= highest(i) : weights_[i] <= lowest(i);
  }

  void set_place(std::size_t i, const Vector& target)
  {
    const Point wanted(target[0], target[1], target[2]);
    if constexpr (!keeps_boundary)
      if (dimension(i) == 2) {
        const std::optional<Point> p = project_on_location(oracle_, wanted, mesh_.locations[i]);
        if (p) points_[i] = *p;
        return;
      }
    points_[i] = wanted;
  }

  /// A changed weight is tried by half and by a quarter first.
  /// \returns whether it had moved.
  bool take_back(std::size_t i)
  {
    if (points_[i] == old_points_[i] && weights_[i] == old_weights_[i]) return false;
    const bool is_halved = points_[i] == old_points_[i] && ++tries_[i] <= most_tries;
    weights_[i] = is_halved ? (weights_[i] + old_weights_[i]) / 2 : old_weights_[i];
    points_[i] = old_points_[i];
    ++taken_back_;
    return true;
  }

  /// Calls `refuse` for points that are hidden, and those whose weights differ by more than the bound.
  template <class Refuse>
  void refuse_crowds(const Refuse& refuse) const
  {
    const auto& tr = regular_.triangulation();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (regular_.vertex(i) != typename Regular::Vertex_handle()) continue;
      refuse(i);
      const auto c = tr.locate(typename Regular::Weighted_point(points_[i]));
      for (int k = 0; k < 4; ++k)
        if (!tr.is_infinite(c->vertex(k))) refuse(c->vertex(k)->info());
    }
    for (const auto& e : tr.finite_edges()) {
      const std::size_t i = e.first->vertex(e.second)->info(), j = e.first->vertex(e.third)->info();
      if (std::abs(weights_[i] - weights_[j]) <=
          options_.bound * CGAL::to_double(CGAL::squared_distance(points_[i], points_[j])))
        continue;
      refuse(i);
      refuse(j);
    }
  }

  /// The bound at the nearest point.
  void measure_reaches()
  {
    reach_.assign(points_.size(), std::numeric_limits<double>::infinity());
    for (const auto& e : regular_.triangulation().finite_edges()) {
      const std::size_t i = e.first->vertex(e.second)->info(), j = e.first->vertex(e.third)->info();
      const double most = options_.bound * CGAL::to_double(CGAL::squared_distance(points_[i], points_[j]));
      for (const std::size_t v : {i, j}) reach_[v] = (std::min)(reach_[v], most);
    }
  }

  void measure_edges()
  {
    measure_reaches();
    std::vector<double> count(points_.size(), 0);
    length_.assign(points_.size(), 0);
    for (const auto& s : simplices_.simplices)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          const Place edge = difference(simplices_.points[s[i]], simplices_.points[s[j]]);
          if (i != j) length_[s[i]] += std::sqrt(dot(edge, edge)), count[s[i]] += 1;
        }
    double mean = 0, all = 0;
    for (std::size_t i = 0; i < count.size(); ++i) mean += length_[i], all += count[i];
    for (std::size_t i = 0; i < count.size(); ++i) length_[i] = count[i] > 0 ? length_[i] / count[i] : mean / all;
  }

  void load()
  {
    simplices_.points.clear();
    for (const Point& p : points_) simplices_.points.push_back(place(p));
    simplices_.simplices.clear();
    normals_.assign(points_.size(), Place{0, 0, 0});
    for (const auto c : regular_.triangulation().finite_cell_handles()) {
      if (c->info() == 0) continue;
      simplices_.simplices.emplace_back();
      for (int i = 0; i < 4; ++i)
        simplices_.simplices.back()[as_index(i)] = static_cast<Simplices<3>::Number>(c->vertex(i)->info());
      for (int i = 0; !keeps_boundary && i < 4; ++i)
        if (c->neighbor(i)->info() < c->info()) add_normal(c, i);
    }
    for (Place& n : normals_)
      if (const double length = std::sqrt(dot(n, n)); length > 0)
        for (double& x : n) x /= length;
  }

  void add_normal(typename Regular::Cell_handle c, int i)
  {
    std::array<std::size_t, 3> f;
    for (int k = 0; k < 3; ++k) f[as_index(k)] = c->vertex(regular_.triangulation().vertex_triple_index(i, k))->info();
    const Place p = simplices_.points[f[0]];
    const Place n = cross(difference(simplices_.points[f[1]], p), difference(simplices_.points[f[2]], p));
    for (const std::size_t v : f) add_to(normals_[v], 1, n);
  }

  const Tetrahedral_mesh_3<K>& mesh_;
  const Oracle& oracle_;
  const Weighted_options_3& options_;
  Regular regular_;
  std::vector<Point> points_, old_points_;
  std::vector<double> weights_, old_weights_;
  std::vector<double> length_; ///< by point: mean length of its edges in the beginning
  std::vector<double> reach_;  ///< by point: the most by which weights within bounds differ
  std::vector<char> tries_;    ///< by point: how often it has been taken back in this sweep
  std::vector<Place> normals_; ///< by point
  Simplices<3> simplices_;
  std::size_t taken_back_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SOLVE_WEIGHTED_MODEL_3_H
