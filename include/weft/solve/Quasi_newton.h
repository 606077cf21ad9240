// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two-loop recursion of L-BFGS with a preconditioner (Nocedal 1980; Nocedal, Wright, "Numerical optimization",
// Alg. 7.4).

#ifndef WEFT_SOLVE_QUASI_NEWTON_H
#define WEFT_SOLVE_QUASI_NEWTON_H

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <deque>
#include <vector>

namespace weft::internal {

/// Approximates an inverse Hessian by the last steps and the changes of the gradient along them.
class Quasi_newton
{
public:
  using Matrix = Eigen::MatrixXd; ///< a row for each free point

  explicit Quasi_newton(int memory) : memory_(static_cast<std::size_t>(memory)) {}

  void forget() { pairs_.clear(); }
  bool is_empty() const { return pairs_.empty(); }

  /// Takes a step and the change of the gradient in; those of no positive curvature are left out.
  void learn(Matrix step, Matrix change)
  {
    const double curvature = step.cwiseProduct(change).sum();
    if (!(curvature > least_curvature * step.norm() * change.norm())) return;
    pairs_.push_back({std::move(step), std::move(change), curvature});
    if (pairs_.size() > memory_) pairs_.pop_front();
  }

  /// The inverse Hessian times a gradient.
  /// \param precondition the first approximation of it, as a function.
  template <class Precondition>
  Matrix operator()(Matrix gradient, const Precondition& precondition) const
  {
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alpha[k] = pairs_[k].step.cwiseProduct(gradient).sum() / pairs_[k].curvature;
      gradient -= alpha[k] * pairs_[k].change;
    }
    Matrix direction = precondition(gradient);
    if (!pairs_.empty()) {
      const Pair& last = pairs_.back();
      const double scale = last.curvature / last.change.cwiseProduct(precondition(last.change)).sum();
      if (scale > 0 && std::isfinite(scale)) direction *= scale;
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double beta = pairs_[k].change.cwiseProduct(direction).sum() / pairs_[k].curvature;
      direction += (alpha[k] - beta) * pairs_[k].step;
    }
    return direction;
  }

private:
  struct Pair
  {
    Matrix step, change;
    double curvature;
  };

  static constexpr double least_curvature = 1e-8;

  std::size_t memory_;
  std::deque<Pair> pairs_;
};

} // namespace weft::internal

#endif // WEFT_SOLVE_QUASI_NEWTON_H
