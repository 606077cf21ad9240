// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ODT energy of a weighted mesh in both dimensions (Tournois 2009, sec. 4.2.3). In barycentric coordinates l of a
// simplex the error of the lifting is e = sum over i < j of L_ij l_i l_j - sum of w_i l_i, L_ij being squared lengths.
// As the l_i add up to 1, that is a quadratic form in them, whose mean over the simplex and whose mean square have
// closed forms: the mean of a product of powers a_i of the l_i is d! a_0! ... a_d! / (d + a_0 + ... + a_d)!.

#ifndef WEFT_ENERGY_WEIGHTED_ODT_TERMS_H
#define WEFT_ENERGY_WEIGHTED_ODT_TERMS_H

#include <weft/energy/coordinates.h>
#include <weft/energy/odt_terms.h>
#include <weft/energy/Simplices.h>
#include <weft/energy/Weighted_energy.h>
#include <weft/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace weft::internal {

/// Quadratic forms in barycentric coordinates: coefficients of l_i l_j, i <= j.
template <std::size_t d>
struct Barycentric_forms
{
  static constexpr std::size_t size = (d + 1) * (d + 2) / 2;
  using Form = std::array<double, size>;

  /// Of l_i l_j.
  static constexpr std::size_t number(std::size_t i, std::size_t j)
  {
    return i <= j ? i * (2 * d + 1 - i) / 2 + j : number(j, i);
  }

  /// Means of all l_i l_j over the simplex.
  static const Form& means()
  {
    static const Form result = [] {
      Form m{};
      for (std::size_t i = 0; i <= d; ++i)
        for (std::size_t j = i; j <= d; ++j) m[number(i, j)] = mean({i, j});
      return m;
    }();
    return result;
  }

  /// Means of the products of any two of them.
  static const std::array<Form, size>& products()
  {
    static const std::array<Form, size> result = [] {
      std::array<Form, size> m{};
      for (std::size_t i = 0; i <= d; ++i)
        for (std::size_t j = i; j <= d; ++j)
          for (std::size_t k = 0; k <= d; ++k)
            for (std::size_t l = k; l <= d; ++l) m[number(i, j)][number(k, l)] = mean({i, j, k, l});
      return m;
    }();
    return result;
  }

private:
  /// Of the product of barycentric coordinates with these indices.
  static double mean(std::initializer_list<std::size_t> indices)
  {
    std::array<std::size_t, d + 1> powers{};
    double result = 1;
    std::size_t k = 0;
    for (const std::size_t i : indices) {
      result *= static_cast<double>(++powers[i]); // makes a factorial of each power
      result /= static_cast<double>(d + 1 + k++);
    }
    return result;
  }
};

/// Energy and gradients of a weighted mesh.
template <std::size_t d>
struct Weighted_terms
{
  Energy_terms<d> points;
  std::vector<double> gradient; ///< by weights
  std::vector<double> diagonal; ///< by weights: gradient over this is a step that lowers what is quadratic in them
  double constant = 0;          ///< of `Lifting_error::up_to_a_constant`
  double mass = 0;              ///< of the mesh, in the metric
};

/// The error over one simplex, in the metric.
template <std::size_t d>
struct Lifted_simplex
{
  using Forms = Barycentric_forms<d>;
  using Form = typename Forms::Form;

  /// \param weights may be empty: all are 0.
  /// \param constant added to all weights, in the metric.
  Lifted_simplex(const Simplices<d>& mesh, const std::vector<double>& weights, double constant,
                 const typename Simplices<d>::Simplex& s)
      : cell(mesh, s), mass(cell.metric.measure * cell.measure.value)
  {
    std::array<double, d + 1> w{};
    for (std::size_t i = 0; i <= d; ++i) {
      const double size = mesh.sizes.empty() ? 1 : mesh.sizes[s[i]];
      unit[i] = 1 / (size * size);
      w[i] = constant + (weights.empty() ? 0 : weights[s[i]] * unit[i]);
    }
    for (std::size_t i = 0; i <= d; ++i) {
      error[Forms::number(i, i)] = -w[i];
      for (std::size_t j = i + 1; j <= d; ++j) {
        const auto edge = difference(cell.points[i], cell.points[j]);
        error[Forms::number(i, j)] = cell.metric.squared_length[i][j] * dot(edge, edge) - w[i] - w[j];
      }
    }
  }

  double mean() const
  {
    double result = 0;
    for (std::size_t k = 0; k < Forms::size; ++k) result += Forms::means()[k] * error[k];
    return result;
  }

  /// Mean square; and its derivatives by the coefficients of the error.
  double mean_square(Form& slope) const
  {
    double result = 0;
    for (std::size_t k = 0; k < Forms::size; ++k) {
      double sum = 0;
      for (std::size_t l = 0; l < Forms::size; ++l) sum += Forms::products()[k][l] * error[l];
      slope[k] = 2 * sum;
      result += sum * error[k];
    }
    return result;
  }

  Odt_simplex<d> cell;
  double mass;
  std::array<double, d + 1> unit{}; ///< of the metric for weights
  Form error{};
};

/// The ODT energy of a weighted mesh; gradients include what the domain changes by where its boundary moves. Linear.
/// \param weights of the points; empty: all are 0.
template <std::size_t d>
Weighted_terms<d> weighted_odt_terms(const Simplices<d>& mesh, const std::vector<double>& weights, Lifting_error kind,
                                     bool with_weights_of_edges = false)
{
  using Forms = Barycentric_forms<d>;
  const std::size_t n = mesh.points.size();
  Weighted_terms<d> result;
  result.points.gradient.assign(n, Coordinates<d>{});
  result.points.diagonal.assign(n, 0);
  result.gradient.assign(n, 0);
  result.diagonal.assign(n, 0);
  double volume = 0;
  for (const auto& s : mesh.simplices) {
    const Lifted_simplex<d> t(mesh, weights, 0, s);
    volume += t.mass * t.mean();
    result.mass += t.mass;
  }
  // Derivatives by the constant vanish where it is the best one.
  if (kind == Lifting_error::up_to_a_constant) result.constant = volume / result.mass;
  const double square = Forms::means()[0];
  for (const auto& s : mesh.simplices) {
    const Lifted_simplex<d> t(mesh, weights, result.constant, s);
    typename Forms::Form slope = Forms::means();
    const double mean = t.mean(), value = kind == Lifting_error::volume ? mean : t.mean_square(slope);
    result.points.value += t.mass * value;
    // Of the square: twice the square of the first derivative of e, and twice e times the second one.
    double curvature = t.cell.curvature * t.cell.measure.value;
    if (kind != Lifting_error::volume) {
      const double edge = 2 * t.cell.sum / (d * (d + 1.0));
      curvature *= 2 * square * edge + 2 * (std::max)(mean, 0.0);
    }
    for (std::size_t i = 0; i <= d; ++i) {
      double by_weight = slope[Forms::number(i, i)];
      add_to(result.points.gradient[s[i]], t.cell.metric.measure * value, t.cell.measure.gradient[i]);
      for (std::size_t j = 0; j <= d; ++j) {
        if (j == i) continue;
        const double by_edge = slope[Forms::number(i, j)];
        by_weight += by_edge;
        add_to(result.points.gradient[s[i]], 2 * t.mass * by_edge * t.cell.metric.squared_length[i][j],
               difference(t.cell.points[i], t.cell.points[j]));
        if (with_weights_of_edges && i < j) result.points.weights.push_back({s[i], s[j], curvature / d});
      }
      result.gradient[s[i]] -= t.mass * t.unit[i] * by_weight;
      result.points.diagonal[s[i]] += curvature;
      result.diagonal[s[i]] += 2 * t.mass * t.unit[i] * t.unit[i] / (d + 1); // sums of rows of the mass matrix
    }
  }
  return result;
}

/// \throws Option_error unless there is a weight for each point, and a finite one.
inline void require_weights(const std::vector<double>& weights, std::size_t points)
{
  if (weights.size() != points) throw Option_error("weights must be as many as points");
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return !std::isfinite(w); }))
    throw Option_error("weights must be finite");
}

} // namespace weft::internal

#endif // WEFT_ENERGY_WEIGHTED_ODT_TERMS_H
