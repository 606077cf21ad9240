// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE to follow sizes that change in 2D: `adapt_2()` makes of a mesh and a new sizing field a mesh that fits the
// field, and leaves alone what fits already. Elsewhere the mesh is emptied, filled with a new lattice that goes on from
// what stays, relaxed, refined and polished as `make_mesh_2()` does it (Tournois 2009, chapter 2).
//
//   weft::Mesh_triangulation_2<K> cdt;
//   const std::vector<K::Point_2> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
//   cdt.insert_constraint(corners.begin(), corners.end(), true);
//   weft::make_mesh_2(cdt, 0.05);
//   const auto wanted = [](const K::Point_2& p) { return p.x() < 0.5 ? 0.01 : 0.05; };
//   const auto report = weft::adapt_2(cdt, wanted);

#ifndef WEFT_ADAPT_2_H
#define WEFT_ADAPT_2_H

#include <weft/make_mesh_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/run/require_structure_2.h>
#include <weft/planar/run/Triangulated_mesh_2.h>
#include <weft/report.h>

#include <type_traits>

namespace weft {

namespace internal {

/// Polylines can't lose vertices.
template <class Cdt>
struct Has_polylines_2
{
  template <class Tr>
  static std::true_type test(const CGAL::Constrained_triangulation_plus_2<Tr>*);
  static std::false_type test(const void*);
  static constexpr bool value = decltype(test(static_cast<Cdt*>(nullptr)))::value;
};

} // namespace internal

/// Adapts a mesh to another sizing field.
///
/// All that `make_mesh_2()` promises holds for the result, too: sizes, angles, constraints, the domain, `info()` of
/// faces. Input vertices stay where they are. So do most Steiner vertices where sizes are as they were, but for a few
/// rings around what changes, and but for places that the input crowds with vertices; those on constraints move and go
/// along them.
///
/// Time is that of meshing what changes, and a small part of meshing the rest.
/// \param cdt as `make_mesh_2()` leaves it: `constraint()` of a vertex is `free_vertex` inside, from 0 on where it may
///   slide along the constraint on which it lies, `fixed_vertex` for input vertices. Other vertices with constraints
///   count as input vertices. No `Constrained_triangulation_plus_2`, whose polylines couldn't lose vertices.
/// \param sizing callable, point -> largest edge length in the input's units; or a number, which holds everywhere.
/// \throws Option_error for options out of range, and when the sizing field returns anything but positive numbers.
/// \throws Domain_error when there is no domain.
/// On every way out, exceptions included, the triangulation is valid and constrained Delaunay.
template <class Cdt, class Sizing, std::enable_if_t<!internal::Is_triangle_mesh_2<Cdt>::value, int> = 0>
Mesh_report_2 adapt_2(Cdt& cdt, const Sizing& sizing, const Mesh_options_2& options = Mesh_options_2())
{
  static_assert(
      !internal::Has_polylines_2<Cdt>::value,
      "weft: adapt_2() takes vertices away, which polylines of a Constrained_triangulation_plus_2 can't follow; "
      "use weft::Mesh_triangulation_2<K>");
  if constexpr (std::is_arithmetic_v<Sizing>) {
    return adapt_2(cdt, Uniform_sizing<>(sizing), options);
  } else if constexpr (internal::Planar_requirements_2<Cdt, Sizing>::holds) {
    options.check();
    const auto run = [&](Cdt& triangulation) {
      using Mesher = internal::Planar_mesher_2<Cdt, Sizing>;
      return Mesher(triangulation, sizing, options, Mesher::Mesh::Given::meshed).adapt();
    };
    return internal::keep_face_info_2(cdt, run, true);
  } else {
    internal::Planar_requirements_2<Cdt, Sizing>::complain();
    return {};
  }
}

/// Result of adapting a mesh in arrays.
template <class K>
struct Adapt_result_2
{
  Triangle_mesh_2<K> mesh;
  Mesh_report_2 report;
};

/// Adapts a mesh in arrays, of any origin.
///
/// Its outline is the domain: edges of the boundary, between regions, and others that it lists. Vertices on straight
/// parts of it move and go; those where it turns stay, and so do corners. Tags of regions and edges are kept.
/// \param mesh from a reader, `triangle_mesh_2()` or `assemble_mesh_2()`. Where it isn't constrained Delaunay the
/// result
///   is.
/// \throws as above; Domain_error if the arrays aren't a mesh, or edges of the outline cross or overlap.
template <class K, class Sizing>
Adapt_result_2<K> adapt_2(const Triangle_mesh_2<K>& mesh, const Sizing& sizing,
                          const Mesh_options_2& options = Mesh_options_2())
{
  options.check();
  internal::Triangulated_mesh_2<K> triangulated(mesh);
  Adapt_result_2<K> result;
  result.report = adapt_2(triangulated.triangulation(), sizing, options);
  result.mesh = triangulated.extract();
  return result;
}

} // namespace weft

#endif // WEFT_ADAPT_2_H
