// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE to follow sizes that change: `adapt_3()` makes of a mesh and a new sizing field a Delaunay mesh that fits
// the field, and leaves alone what fits already. Where edges are too long it refines, where they are far too short it
// takes vertices away, and around both it smooths and perturbs (Tournois 2009, sec. 4.1).
//
//   #include <weft/IO/read_surface.h>
//   #include <weft/sizing/Lipschitz_sizing_3.h>
//
//   const auto surface = weft::IO::read_surface<K>("part.off");
//   const weft::Polyhedral_oracle_3<K> domain(surface, weft::Feature_options{60});
//   weft::Criteria_3<K> criteria;
//   criteria.size = 0.1;
//   auto mesh = weft::tetrahedral_mesh(weft::make_mesh_3(domain, criteria).restricted);
//   const auto wanted = [](const K::Point_3& p) { return p.x() < 0 ? 0.02 : 0.1; };
//   criteria.size = weft::Lipschitz_sizing_3<K>(wanted, domain.bbox(), 0.5);
//   mesh = weft::tetrahedral_mesh(weft::adapt_3(mesh, domain, criteria).restricted);

#ifndef WEFT_ADAPT_3_H
#define WEFT_ADAPT_3_H

#include <weft/errors.h>
#include <weft/improve_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/run/adapt_vertices_3.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Adapts a mesh of the domain behind `oracle` to other criteria, mostly another size.
///
/// All that `make_mesh_3()` promises holds for the result, too. Vertices stay where every element around them does;
/// those that lie on the boundary keep their place on it.
/// \param mesh of the same oracle, as `tetrahedral_mesh()` returns it; has to be Delaunay as weft's meshes are, or it
/// is
///   made so.
/// \param oracle has to outlive the result.
/// \param criteria with the new size; any callable is one, but it is asked some thousand times a vertex: tabulate one
///   that is dear, and grade one that isn't graded, by `Lipschitz_sizing_3`. Called by one thread.
/// \throws Option_error for criteria or options out of range, or if a field isn't positive; Domain_error if the arrays
///   aren't those of a mesh, or not of this oracle.
template <class Oracle>
Make_mesh_result_3<Oracle> adapt_3(const Tetrahedral_mesh_3<typename Oracle::Kernel>& mesh, const Oracle& oracle,
                                   const Criteria_3<typename Oracle::Kernel>& criteria,
                                   const Mesh_options_3& options = Mesh_options_3())
{
  criteria.check();
  options.check();
  internal::require_structure(mesh);
  const auto initial = internal::adapted_vertices_3(mesh, oracle, criteria);
  internal::Spatial_mesher_3<Oracle> mesher(oracle, criteria, options, initial);
  Mesh_report_3 report = mesher.run();
  report.coarsened += mesh.points.size() - initial.points.size();
  return {mesher.take_mesh(), std::move(report)};
}

/// Result of adapting a mesh to its own boundary.
template <class K>
struct Adapt_result_3
{
  Tetrahedral_mesh_3<K> mesh; ///< with the numbers of subdomains, patches and creases of the mesh that was given
  Mesh_report_3 report;
  std::vector<std::string> notes; ///< what was changed in the boundary, for people
};

/// Adapts a mesh whose boundary is all that is known of its domain. New vertices of the boundary lie on it, so that it
/// doesn't become smoother than it is; where vertices are taken away it keeps within the approximation bound, but
/// errors of many adaptations add up: with an oracle they don't.
/// \param mesh of any origin. Where it isn't Delaunay the result is.
/// \param criteria as above; without an approximation bound, a tenth of the boundary's edges nearby.
/// \param sharp_angle edges of the boundary are sharp from this angle on, in degrees; tagged ones, and those between
///   patches, are in any case.
/// \throws as above; Domain_error if the boundary of a subdomain isn't a closed surface without self-intersections.
template <class K>
Adapt_result_3<K> adapt_3(const Tetrahedral_mesh_3<K>& mesh, Criteria_3<K> criteria,
                          const Mesh_options_3& options = Mesh_options_3(), double sharp_angle = 60)
{
  criteria.check();
  options.check();
  internal::require_structure(mesh);
  Improve_options_3 tags;
  tags.sharp_angle = sharp_angle;
  const internal::Mesh_boundary_3<K> boundary(mesh, internal::features_of_mesh(mesh, tags));
  const internal::Boundary_sizing_3<K> edges(boundary.complex().points, boundary.complex().triangles);
  const Polyhedral_oracle_3<K> oracle(boundary.complex());
  if (!criteria.approximation) {
    criteria.approximation = [edges](const typename K::Point_3& p) { return 0.1 * edges(p); };
    criteria.deviation = criteria.approximation;
  }
  Tetrahedral_mesh_3<K> placed = mesh;
  placed.locations = boundary.locations();
  internal::number_by_location(oracle.number_of_patches(), placed);
  Adapt_result_3<K> result;
  auto adapted = adapt_3(placed, oracle, criteria, options);
  result.mesh = tetrahedral_mesh(adapted.restricted);
  boundary.restore_names(edges, result.mesh);
  result.report = std::move(adapted.report);
  result.notes = boundary.complex().changes;
  return result;
}

/// \cond
// An overload that only says what is wrong.
template <class Oracle>
Make_mesh_result_3<Oracle> adapt_3(const Tetrahedral_mesh_3<typename Oracle::Kernel>&, const Oracle&&,
                                   const Criteria_3<typename Oracle::Kernel>&, const Mesh_options_3& = Mesh_options_3())
{
  internal::complain_about_temporary_3<Oracle>();
  std::abort();
}
/// \endcond

} // namespace weft

#endif // WEFT_ADAPT_3_H
