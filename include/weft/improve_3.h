// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE with a tetrahedral mesh that you have: `improve_3()` raises its smallest dihedral angles. With a boundary
// that slides on itself the mesh becomes a Delaunay mesh of the same domain with about the same vertices; with a fixed
// boundary every boundary triangle stays.
//
//   #include <weft/IO/read_tetrahedral_mesh.h>
//   #include <weft/IO/write_mesh_3.h>
//
//   const auto input = weft::IO::read_tetrahedral_mesh<K>("part.mesh");
//   const auto [mesh, report] = weft::improve_3(input.mesh);
//   weft::IO::write_mesh_3("better.mesh", mesh);

#ifndef WEFT_IMPROVE_3_H
#define WEFT_IMPROVE_3_H

#include <weft/errors.h>
#include <weft/spatial/local/improve_fixed_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/check_manifold_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/require_structure_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/run/improve_sliding_3.h>
#include <weft/spatial/run/Oracle_requirements_3.h>

#include <CGAL/Kernel/global_functions.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

namespace weft {

/// Result of `improve_3()`.
template <class K>
struct Improve_result_3
{
  Tetrahedral_mesh_3<K> mesh;
  Improve_report_3 report;
};

namespace internal {

template <class Mesh>
struct Is_tetrahedral_mesh_3 : std::false_type
{};
template <class K>
struct Is_tetrahedral_mesh_3<Tetrahedral_mesh_3<K>> : std::true_type
{};

/// What is returned after a complaint.
struct No_result_3
{
  int mesh = 0;
  Improve_report_3 report;
};

template <class K>
std::size_t count_inverted(const Tetrahedral_mesh_3<K>& mesh)
{
  std::size_t n = 0;
  for (const auto& c : mesh.cells)
    n +=
        CGAL::orientation(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]) != CGAL::POSITIVE;
  return n;
}

/// Whether a mesh has more inverted cells than another one, or as many and a smaller dihedral angle.
template <class K>
bool is_worse(const Tetrahedral_mesh_3<K>& a, const Tetrahedral_mesh_3<K>& b)
{
  if (a.cells.empty()) return true;
  const std::size_t inverted_in_a = count_inverted(a), inverted_in_b = count_inverted(b);
  if (inverted_in_a != inverted_in_b) return inverted_in_a > inverted_in_b;
  return measure_quality_3(a).smallest_dihedral.degrees < measure_quality_3(b).smallest_dihedral.degrees;
}

/// Checks what is given, has `improve(report)` improve the mesh, and measures it before and after.
template <class K, class Improve>
Improve_result_3<K> improve_and_report(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options,
                                       const Improve& improve)
{
  options.check();
  require_structure(mesh);
  for (const std::size_t v : options.fixed_vertices)
    if (v >= mesh.points.size()) throw Option_error("there is no vertex " + std::to_string(v) + " to be fixed");
  Improve_result_3<K> result;
  result.report.before = measure_quality_3(mesh);
  result.report.inverted_before = count_inverted(mesh);
  result.mesh = improve(result.report);
  result.report.manifold = !result.mesh.cells.empty() && check_manifold_3(result.mesh).ok();
  result.report.after = measure_quality_3(result.mesh);
  result.report.inverted_after = count_inverted(result.mesh);
  return result;
}

} // namespace internal

/// Improves a mesh.
///
/// Vertices of the boundary come first in the result where it slides; with a fixed boundary vertices keep their order.
/// \param mesh from a reader, `from_c3t3()` or `assemble_mesh_3()`; cells may be slivers, not Delaunay, or inverted.
/// \throws Option_error for options out of range; Domain_error if the arrays aren't a mesh, or if the boundary is to
///   slide and isn't, for each subdomain, a closed surface without self-intersections.
template <class K>
Improve_result_3<K> improve_3(const Tetrahedral_mesh_3<K>& mesh, const Improve_options_3& options = Improve_options_3())
{
  return internal::improve_and_report(mesh, options, [&](Improve_report_3& report) {
    if (options.boundary == Boundary_3::fixed) return internal::improve_fixed_3(mesh, options, report);
    auto result = internal::improve_sliding_3(mesh, options, report);
    if (options.delaunay || !internal::is_worse(result, mesh)) return result;
    report.notes.emplace_back("nothing better was found: the mesh is as it was"); // or stopped half-way
    return mesh;
  });
}

/// Improves a mesh of a domain that is known better than by the mesh itself: its boundary slides on the surface of
/// that. Sharp edges are those of the domain; `sharp_angle` and `tagged_features` don't matter.
/// \param oracle a domain oracle, see doc/concepts/DomainOracle_3.h; asked during the call alone. Patches, creases and
///   corners of the result are its own.
/// \throws Option_error as above, and if the boundary is to stay fixed; Domain_error as above.
template <class K, class Oracle>
Improve_result_3<K> improve_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, const Improve_options_3& options)
{
  if constexpr (internal::Oracle_requirements_3<Oracle>::holds) {
    if (options.boundary == Boundary_3::fixed) throw Option_error("a fixed boundary needs no domain");
    return internal::improve_and_report(mesh, options, [&](Improve_report_3& report) {
      return internal::improve_on_domain_3(mesh, oracle, options, report);
    });
  } else {
    internal::Oracle_requirements_3<Oracle>::complain();
    return {};
  }
}

/// \cond
// Overloads that only say what is wrong.
template <class Mesh, std::enable_if_t<!internal::Is_tetrahedral_mesh_3<Mesh>::value, int> = 0>
internal::No_result_3 improve_3(const Mesh&, const Improve_options_3& = Improve_options_3())
{
  static_assert(internal::never_v<Mesh>, "weft: improve_3() takes a weft::Tetrahedral_mesh_3<K>: from_c3t3(), "
                                         "tetrahedral_mesh() or assemble_mesh_3() makes one");
  return {};
}
template <class Mesh, class Oracle, std::enable_if_t<!internal::Is_tetrahedral_mesh_3<Mesh>::value, int> = 0>
internal::No_result_3 improve_3(const Mesh& mesh, const Oracle&, const Improve_options_3& options)
{
  return improve_3(mesh, options);
}
/// \endcond

} // namespace weft

#endif // WEFT_IMPROVE_3_H
