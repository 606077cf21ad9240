// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models that spatial optimisation is measured on.

#ifndef WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_MODELS_H
#define WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_MODELS_H

#include "../spatial/spatial_inputs.h"
#include "../spatial/spatial_peers.h"

#include <string>
#include <vector>

namespace benchmark {

/// What a model is asked.
enum class Family
{
  smooth,
  creased,
  fine_creased, ///< whose creases are close to each other
  uniform
};

struct Model
{
  std::string name;
  Family family;
  bool is_quick; ///< whether it's among the few that represent the others

  Bounds bounds() const { return family == Family::uniform ? Bounds{0.05, 0, 2} : Bounds{0.1, 0.001, 2}; }
  double sharp_angle() const { return family == Family::creased || family == Family::fine_creased ? 60 : 0; }
};

inline std::vector<Model> optimisation_models()
{
  return {{"elephant", Family::smooth, true},   {"dino", Family::smooth, true},
          {"bunny00", Family::smooth, false},   {"homer", Family::smooth, false},
          {"armadillo", Family::smooth, false}, {"anchor", Family::creased, true},
          {"fandisk", Family::creased, false},  {"joint", Family::creased, false},
          {"dragknob", Family::creased, false}, {"turbine", Family::fine_creased, false},
          {"sphere", Family::uniform, false}};
}

/// \param folder of the models, as files in OFF; the sphere is made.
inline Spatial_input read_model(const std::string& folder, const Model& model)
{
  if (model.family == Family::uniform) return make_input(model.name, unit_sphere(5), 0);
  return read_input(folder + "/" + model.name + ".off", model.sharp_angle());
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_OPTIMISATION_OPTIMISATION_MODELS_H
