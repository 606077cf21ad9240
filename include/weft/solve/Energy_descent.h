// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimises an energy of a mesh by sweeps in which all vertices move at once and the triangulation is made Delaunay
// again (Tournois 2009, sec. 4.2.2). The energy that counts is that after the flips: a sweep that doesn't lower it
// enough is undone, and a shorter one follows.

#ifndef WEFT_SOLVE_ENERGY_DESCENT_H
#define WEFT_SOLVE_ENERGY_DESCENT_H

#include <weft/energy/coordinates.h>
#include <weft/energy/Simplices.h>
#include <weft/errors.h>
#include <weft/internal/Timer.h>
#include <weft/solve/Graph_laplacian.h>
#include <weft/solve/Newton_step.h>
#include <weft/solve/Quasi_newton.h>
#include <weft/solve/Solver_options.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam d number of coordinates of a point: those of its place, and of weighted points one more.
/// \tparam Model the mesh that is worked on, with points numbered from 0:
///   - `terms(with_weights)`, its energy; `simplices()`, those that belong to it;
///   - `positions()`; `is_free(i)`; `to_tangent(i, vector)`, projected to where point i may go;
///   - `move(points, targets)` moves points i to `targets[i]`, projected, as far as possible, and makes the mesh
///   Delaunay;
///     `move_back(points, old)` undoes that;
///   - `newton_system()`, the Jacobian of the fixed-point iteration, see Newton_step.h.
template <class Model, std::size_t d>
class Energy_descent
{
public:
  using Point = Coordinates<d>;
  using Matrix = Eigen::MatrixXd;

  Energy_descent(Model& model, const Solver_options& options)
      : model_(model),
        options_(options),
        memory_(options.memory),
        newton_start_(options.newton_start),
        positions_(model.positions())
  {
    number_.assign(positions_.size(), -1);
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (!model.is_free(i)) continue;
      number_[i] = static_cast<int>(free_.size());
      free_.push_back(i);
    }
  }

  Solver_report run()
  {
    measure();
    record();
    int idle = 0;
    while (!report_.converged && goes_on()) {
      const double before = terms_.value;
      if (!sweep()) break;
      idle = before - terms_.value < options_.tolerance * before ? idle + 1 : 0;
      report_.converged = idle >= most_idle;
    }
    report_.seconds = timer_.seconds();
    return std::move(report_);
  }

private:
  static constexpr int most_idle = 3, most_halvings = 5, most_passes_back = 50;
  static constexpr double most_reach = 0.5; ///< of a point's mean edge length
  static constexpr int most_dampings = 4;   ///< tries of Newton's step
  static constexpr double least_damping = 0.03;
  static constexpr double sufficient = 1e-4; ///< part of the decrease that the gradient promises (Armijo)

  bool goes_on() const
  {
    return !free_.empty() && report_.sweeps < static_cast<std::size_t>(options_.max_sweeps) &&
           timer_.seconds() < options_.time_limit && (!options_.go_on || options_.go_on());
  }

  void measure()
  {
    const bool with_weights = options_.solver == Solver::quasi_newton && since_refresh_ == 0;
    terms_ = model_.terms(with_weights);
    gradient_ = rows([&](std::size_t i) { return terms_.gradient[i]; });
  }

  void record()
  {
    report_.energies.push_back(terms_.value);
    report_.times.push_back(timer_.seconds());
  }

  /// A row for each free point, projected to where the point may go.
  template <class Vector_of>
  Matrix rows(const Vector_of& vector_of) const
  {
    Matrix result(static_cast<Eigen::Index>(free_.size()), static_cast<Eigen::Index>(d));
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Point v = model_.to_tangent(free_[k], vector_of(free_[k]));
      for (std::size_t c = 0; c < d; ++c) result(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = v[c];
    }
    return result;
  }

  Matrix to_tangent(const Matrix& m) const
  {
    return rows([&](std::size_t i) {
      Point v;
      for (std::size_t c = 0; c < d; ++c) v[c] = m(number_[i], static_cast<Eigen::Index>(c));
      return v;
    });
  }

  // ---- directions

  /// One accepted sweep; false where nothing lowers the energy any more.
  bool sweep()
  {
    if (options_.solver == Solver::newton && in_newton_) {
      for (int k = 0; k < most_dampings; ++k) {
        if (descend(newton_direction(), Kind::newton)) {
          damping_ = damping_ > least_damping ? damping_ / 4 : 0;
          return true;
        }
        damping_ = (std::max)(4 * damping_, least_damping);
      }
      in_newton_ = false; // Alg. 8: back to the fixed-point iteration, for longer than last time
      newton_start_ /= 4;
    }
    if (options_.solver == Solver::quasi_newton) {
      if (descend(quasi_newton_direction(), Kind::quasi_newton)) return true;
      if (!memory_.is_empty()) {
        memory_.forget();
        since_refresh_ = 0;
        measure();
        if (descend(quasi_newton_direction(), Kind::quasi_newton)) return true;
      }
    }
    if (descend(fixed_point_direction(), Kind::fixed_point)) return true;
    report_.converged = goes_on();
    return false;
  }

  Matrix fixed_point_direction() const
  {
    Matrix result = gradient_;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const double diagonal = terms_.diagonal[free_[k]];
      result.row(static_cast<Eigen::Index>(k)) *= diagonal > 0 ? -1 / diagonal : 0;
    }
    return result;
  }

  Matrix quasi_newton_direction()
  {
    Lap_timer lap;
    if (since_refresh_ == 0) laplacian_.set(terms_, number_, static_cast<int>(free_.size()));
    since_refresh_ = since_refresh_ + 1 < options_.refresh ? since_refresh_ + 1 : 0;
    const auto precondition = [&](const Matrix& g) { return to_tangent(laplacian_.solve(g)); };
    Matrix result = -to_tangent(memory_(gradient_, precondition));
    report_.solving_seconds += lap.seconds();
    return result;
  }

  Matrix newton_direction()
  {
    Lap_timer lap;
    auto blocks = model_.newton_system();
    for (std::size_t k = 0; k < free_.size() && damping_ > 0; ++k) {
      const auto i = static_cast<std::uint32_t>(free_[k]);
      Jacobian_block<d> block{i, i, {}};
      for (std::size_t c = 0; c < d; ++c) block.entries[c][c] = damping_ * terms_.diagonal[i];
      blocks.push_back(block);
    }
    Matrix result = newton_step<d>(blocks, free_, number_, gradient_,
                                   [&](std::size_t i, const Point& v) { return model_.to_tangent(i, v); });
    report_.solving_seconds += lap.seconds();
    return result;
  }

  enum class Kind
  {
    fixed_point,
    quasi_newton,
    newton
  };

  // ---- steps

  /// Goes along a direction as far as that lowers the energy enough; whether it does.
  bool descend(const Matrix& direction, Kind kind)
  {
    if (!(direction.cwiseProduct(gradient_).sum() < 0) || !direction.allFinite()) return false;
    const std::vector<Point> old = positions_;
    const double before = terms_.value;
    const std::vector<double> reach = reaches();
    double step = 1;
    const int halvings = kind == Kind::newton ? 1 : most_halvings;
    for (int k = 0; k <= halvings && goes_on(); ++k, step /= 2) {
      std::vector<Point> targets = old;
      for (std::size_t i = 0; i < free_.size(); ++i) {
        const auto way = direction.row(static_cast<Eigen::Index>(i));
        const double length = way.norm(), most = most_reach * reach[free_[i]];
        const double part = step * length > most ? most / length : step;
        for (std::size_t c = 0; c < d; ++c) targets[free_[i]][c] += part * way[static_cast<Eigen::Index>(c)];
      }
      model_.move(free_, targets);
      ++report_.sweeps;
      positions_ = model_.positions();
      const Matrix went = rows([&](std::size_t i) { return difference(positions_[i], old[i]); });
      const Energy_terms<d> old_terms = std::move(terms_);
      const Matrix old_gradient = gradient_;
      measure();
      if (terms_.value < before + sufficient * (std::min)(0.0, went.cwiseProduct(old_gradient).sum())) {
        if (kind == Kind::quasi_newton) memory_.learn(went, gradient_ - old_gradient);
        report_.newton_sweeps += kind == Kind::newton;
        in_newton_ = in_newton_ || before - terms_.value < newton_start_ * before;
        record();
        return true;
      }
      ++report_.undone_sweeps;
      go_back(old);
      terms_ = old_terms;
      gradient_ = old_gradient;
    }
    return false;
  }

  /// Mean lengths of edges at points: far moves of single ones are shortened.
  std::vector<double> reaches() const
  {
    std::vector<double> sum(positions_.size(), 0), count(positions_.size(), 0);
    for (const auto& s : model_.simplices().simplices)
      for (std::size_t i = 0; i < s.size(); ++i)
        for (std::size_t j = i + 1; j < s.size(); ++j) {
          const Point edge = difference(positions_[s[i]], positions_[s[j]]);
          const double length = std::sqrt(dot(edge, edge));
          for (const auto v : {s[i], s[j]}) sum[v] += length, count[v] += 1;
        }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= (std::max)(count[v], 1.0);
    return sum;
  }

  /// Where vertices stand in each other's way several passes may be needed.
  void go_back(const std::vector<Point>& old)
  {
    for (int pass = 0; pass < most_passes_back; ++pass) {
      model_.move_back(free_, old);
      positions_ = model_.positions();
      if (positions_ == old) return;
    }
    throw Error("vertices can't be moved back to where they were"); // a triangulation follows from its points
  }

  Model& model_;
  const Solver_options& options_;
  Quasi_newton memory_;
  double newton_start_;
  double damping_ = 0; ///< part of the diagonal that is added to Newton's system: shorter steps, that lead down
  Graph_laplacian<d> laplacian_;
  std::vector<Point> positions_;
  std::vector<int> number_;       ///< of each point among the free ones, or -1
  std::vector<std::size_t> free_; ///< the points that move
  Energy_terms<d> terms_;
  Matrix gradient_; ///< of the free points
  int since_refresh_ = 0;
  bool in_newton_ = false;
  Timer timer_;
  Solver_report report_;
};

} // namespace weft::internal

#endif // WEFT_SOLVE_ENERGY_DESCENT_H
