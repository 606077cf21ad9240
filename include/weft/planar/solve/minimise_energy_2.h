// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimises the CVT or the ODT energy of a planar mesh by a solver of one's choice (Tournois 2009, sec. 4.2.2). Needs
// Eigen 3.

#ifndef WEFT_PLANAR_SOLVE_MINIMISE_ENERGY_2_H
#define WEFT_PLANAR_SOLVE_MINIMISE_ENERGY_2_H

#include <weft/planar/solve/Planar_model_2.h>
#include <weft/planar/working/Working_mesh_2.h>
#include <weft/sizing/Uniform_sizing.h>
#include <weft/solve/Energy_descent.h>
#include <weft/solve/Solver_options.h>

#include <type_traits>

namespace weft {

/// Moves the vertices of a mesh to where an energy is small: those without constraints anywhere, those that
/// `make_mesh_2()` has inserted on constraints along them. The triangulation stays constrained Delaunay, and the energy
/// after each sweep that is kept is less than before. Neither sizes nor angles are promised.
///
/// A sweep takes linear time but for the solution of a linear system.
/// \tparam Cdt as for `make_mesh_2()`, but without layers.
/// \param cdt a mesh; vertices have the `constraint()` that `make_mesh_2()` has left.
/// \param sizing callable, point -> edge length wanted, to which edges become proportional; or a number: all the same.
/// \throws Option_error for options out of range; Domain_error if there is no domain.
template <class Cdt, class Sizing>
Solver_report minimise_energy_2(Cdt& cdt, const Sizing& sizing, const Solver_options& options = Solver_options())
{
  if constexpr (std::is_arithmetic_v<Sizing>) {
    return minimise_energy_2(cdt, Uniform_sizing<>(sizing), options);
  } else {
    options.check();
    using Mesh = internal::Working_mesh_2<Cdt, Sizing>;
    Mesh mesh(cdt, sizing, Mesh::Given::meshed);
    internal::Planar_model_2<Mesh> model(mesh, options);
    const Solver_report report = internal::Energy_descent<internal::Planar_model_2<Mesh>, 2>(model, options).run();
    mesh.finish();
    return report;
  }
}

} // namespace weft

#endif // WEFT_PLANAR_SOLVE_MINIMISE_ENERGY_2_H
