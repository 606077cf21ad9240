// SPDX-License-Identifier: GPL-3.0-or-later
//
// An approximating lifting (Tournois 2009, sec. 4.1), to measure what it is worth: points move to where the best
// lifting of their Delaunay triangulation has a small error. By the envelope theorem the gradient is that with the
// weights of this lifting held.

#ifndef WEFT_BENCHMARK_OPTIMISATION_FITTED_LIFTING_3_H
#define WEFT_BENCHMARK_OPTIMISATION_FITTED_LIFTING_3_H

#include <weft/energy/weighted_odt_terms.h>
#include <weft/solve/Energy_descent.h>
#include <weft/solve/least_squares_weights.h>
#include <weft/spatial/solve/Weighted_model_3.h>
#include <weft/spatial/solve/Weighted_options_3.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace benchmark {

/// The triangulation stays Delaunay: weights of the lifting aren't those of a regular triangulation.
template <class K>
class Fitted_model_3 : public weft::internal::Weighted_model_3<K>
{
  using Base = weft::internal::Weighted_model_3<K>;

public:
  using Base::Base;

  weft::internal::Energy_terms<4> terms(bool with_weights)
  {
    auto result = Base::terms(with_weights);
    if (!std::isfinite(result.value)) return result;
    fitted_ = weft::internal::least_squares_weights(this->simplices(), fitted_);
    const auto terms =
        weft::internal::weighted_odt_terms(this->simplices(), fitted_, weft::Lifting_error::squared, false);
    result.value = terms.points.value;
    for (std::size_t i = 0; i < result.gradient.size(); ++i) {
      const auto& g = terms.points.gradient[i];
      result.gradient[i] = {g[0], g[1], g[2], 0};
    }
    return result;
  }

private:
  std::vector<double> fitted_;
};

/// \param options `error` doesn't count; weights stay.
template <class K>
weft::Weighted_mesh_3<K> minimise_fitted_lifting(const weft::Tetrahedral_mesh_3<K>& mesh,
                                                 weft::Weighted_options_3 options)
{
  options.error = weft::Lifting_error::up_to_a_constant; // whose second derivatives are about the same
  options.move_weights = false;
  const weft::internal::Boundary_kept_3 boundary;
  Fitted_model_3<K> model(mesh, std::vector<double>(mesh.points.size(), 0), boundary, options);
  auto report = weft::internal::Energy_descent<Fitted_model_3<K>, 4>(model, options.solver).run();
  return {model.mesh(), model.weights(), model.taken_back(), std::move(report)};
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_OPTIMISATION_FITTED_LIFTING_3_H
