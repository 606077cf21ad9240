// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE in 2D: `make_mesh_2()` turns a constrained Delaunay triangulation into a mesh of large, well-shaped
// triangles whose edges respect a sizing field, by interleaving refinement with relaxation (Tournois 2009, chapter 2,
// Alg. 2). `relax_2()` moves the vertices of a mesh of any origin to better places and inserts none.
//
//   const K::Point_2 a(0, 0), b(1, 0), c(0, 1);
//   weft::Mesh_triangulation_2<K> cdt; // or weft::insert_pslg()
//   cdt.insert_constraint(a, b);
//   cdt.insert_constraint(b, c);
//   cdt.insert_constraint(c, a);
//   const auto report = weft::make_mesh_2(cdt, 0.1); // no edge longer than 0.1

#ifndef WEFT_MAKE_MESH_2_H
#define WEFT_MAKE_MESH_2_H

#include <weft/options.h>
#include <weft/planar/run/keep_layers_2.h>
#include <weft/planar/run/Planar_mesher_2.h>
#include <weft/planar/run/Planar_requirements_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/report.h>
#include <weft/sizing/Uniform_sizing.h>

#include <type_traits>

namespace weft {

/// Meshes a domain: inserts Steiner points and moves them until no triangle or constrained edge is longer than the
/// sizing field admits (longest edge over the size at the centroid, at most 1) and angles are good.
///
/// Vertices of `cdt` at the call are input vertices: they stay exactly where they are, and every constraint becomes a
/// chain of constrained edges. The domain is the set of faces with `is_in_domain()`; if there is none, it is marked by
/// nesting parity. Afterwards Steiner vertices have `constraint()` >= 0 on constraints, else `free_vertex`; vertices
/// have running ids. Faces with CGAL's `info()` have that of the input's face in which they lie (Input_faces_2, also
/// for other data). On every way out, exceptions included, the triangulation is valid and constrained Delaunay.
///
/// Time is about linear in the number of vertices; the result depends on nothing but the arguments, not on threads.
/// \tparam Cdt a CGAL constrained Delaunay triangulation with the bases of Mesh_triangulation_2.h, or a
///         `Constrained_triangulation_plus_2` of it, whose polylines get the Steiner points. No
///         `Triangulation_hierarchy_2`, whose levels the mesher doesn't keep.
/// \param sizing callable, point -> largest edge length in the input's units; or a number, which holds everywhere.
/// \throws Option_error for options out of range, and when the sizing field returns anything but positive numbers.
/// \throws Domain_error when there is no domain.
template <class Cdt, class Sizing>
Mesh_report_2 make_mesh_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options = Mesh_options_2())
{
  if constexpr (std::is_arithmetic_v<Sizing>) {
    return make_mesh_2(cdt, Uniform_sizing<>(sizing), options);
  } else if constexpr (internal::Planar_requirements_2<Cdt, Sizing>::holds) {
    options.check();
    return internal::keep_layers_2(cdt, [&](auto& triangulation) {
      using Triangulation = std::remove_reference_t<decltype(triangulation)>;
      using Mesher = internal::Planar_mesher_2<Triangulation, Sizing>;
      return Mesher(triangulation, sizing, options, Mesher::Mesh::Given::input).mesh();
    });
  } else {
    internal::Planar_requirements_2<Cdt, Sizing>::complain();
    return {};
  }
}

/// Relaxes an existing mesh: vertices without constraints move to better places, those on constraints stay, nothing is
/// inserted. Parameters and guarantees as above; the report says whether sizes hold, which relaxation can't promise.
/// But it never makes the mesh worse: the smallest and largest angle (but those between two constraints), the mean of
/// the triangles' smallest angles and, beyond 1, the largest sizing ratio are as good as before or better.
template <class Cdt, class Sizing>
Mesh_report_2 relax_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options = Mesh_options_2())
{
  if constexpr (std::is_arithmetic_v<Sizing>) {
    return relax_2(cdt, Uniform_sizing<>(sizing), options);
  } else if constexpr (internal::Planar_requirements_2<Cdt, Sizing>::holds) {
    options.check();
    return internal::keep_layers_2(cdt, [&](auto& triangulation) {
      using Triangulation = std::remove_reference_t<decltype(triangulation)>;
      using Mesher = internal::Planar_mesher_2<Triangulation, Sizing>;
      return Mesher(triangulation, sizing, options, Mesher::Mesh::Given::relaxable).relax();
    });
  } else {
    internal::Planar_requirements_2<Cdt, Sizing>::complain();
    return {};
  }
}

} // namespace weft

#endif // WEFT_MAKE_MESH_2_H
