// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE coming from CGAL's Mesh_3. `weft::make_mesh_3<C3t3>(domain, criteria)` takes what CGAL's function of that
// name takes, any MeshDomain_3 and MeshCriteria_3, and returns what it returns:
//
//   const C3t3 c3t3 = weft::make_mesh_3<C3t3>(domain, criteria);

#ifndef WEFT_MAKE_C3T3_H
#define WEFT_MAKE_C3T3_H

#include <weft/make_mesh_3.h>
#include <weft/spatial/cgal_criteria_3.h>
#include <weft/spatial/Mesh_domain_oracle_3.h>
#include <weft/spatial/to_c3t3.h>

#include <cmath>

namespace weft {

/// The options that `make_mesh_3()` takes for CGAL's domains unless others are given: slivers go up to 22 degrees,
/// since CGAL's own chain of optimisers reaches 17.5 where a domain is simple, and whoever changes the line wants more.
inline Mesh_options_3 mesh_options_for_c3t3()
{
  Mesh_options_3 options;
  options.min_dihedral_angle = 22;
  return options;
}

/// Meshes a CGAL domain to CGAL criteria.
/// \tparam C3t3 a CGAL::Mesh_complex_3_in_triangulation_3 with the indices of the domain.
/// \param domain models MeshDomain_3 or MeshDomainWithFeatures_3; its kernel's coordinates are doubles.
/// \param criteria models MeshCriteria_3, or MeshCriteriaWithFeatures_3 where the domain has features. They hold for
///        the result, unless the report says which don't.
/// \param report if given, receives what holds and what doesn't.
/// \throws Domain_error if no point of the domain's boundary is found.
template <class C3t3, class Domain, class Criteria>
C3t3 make_mesh_3(const Domain& domain, const Criteria& criteria,
                 const Mesh_options_3& options = mesh_options_for_c3t3(), Mesh_report_3* report = nullptr)
{
  using Oracle = Mesh_domain_oracle_3<Domain>;
  const Oracle oracle(domain);
  // In diagonals. Creases may part at small angles; what else is as small are steps of images, at which the search for
  // a manifold boundary doesn't end by itself.
  const double smallest_detail = oracle.number_of_creases() > 0 ? 1e-4 : 1e-3;
  const auto own_criteria = cgal_criteria_3<C3t3>(criteria, oracle);
  Mesh_options_3 own_options = options;
  const auto b = oracle.bbox();
  if (options.size_floor == 0)
    own_options.size_floor =
        smallest_detail * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
  const auto result = make_mesh_3(oracle, own_criteria, own_options);
  if (report) *report = result.report;
  return to_c3t3<C3t3>(result.restricted, oracle);
}

} // namespace weft

#endif // WEFT_MAKE_C3T3_H
