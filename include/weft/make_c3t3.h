// SPDX-License-Identifier: GPL-3.0-or-later
//
// START HERE coming from CGAL's Mesh_3: `weft::make_mesh_3<C3t3>(domain, criteria)` has the arguments and the result of
// CGAL's function of that name. The domain may be any MeshDomain_3, the criteria any MeshCriteria_3.
//
//   #include <CGAL/Labeled_mesh_domain_3.h>
//   #include <CGAL/Mesh_complex_3_in_triangulation_3.h>
//   #include <CGAL/Mesh_criteria_3.h>
//   #include <CGAL/Mesh_triangulation_3.h>
//
//   using Domain = CGAL::Labeled_mesh_domain_3<K>;
//   using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<CGAL::Mesh_triangulation_3<Domain>::type>;
//
//   const auto ball = [](const K::Point_3& p) { return CGAL::squared_distance(p, K::Point_3(0, 0, 0)) - 1; };
//   const Domain domain = Domain::create_implicit_mesh_domain(ball, K::Sphere_3(CGAL::ORIGIN, 4));
//   const CGAL::Mesh_criteria_3<C3t3::Triangulation> criteria(CGAL::parameters::cell_size = 0.2);
//   const C3t3 c3t3 = weft::make_mesh_3<C3t3>(domain, criteria); // was CGAL::make_mesh_3

#ifndef WEFT_MAKE_C3T3_H
#define WEFT_MAKE_C3T3_H

#include <weft/internal/answers.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/cgal/cgal_criteria_3.h>
#include <weft/spatial/cgal/Mesh_domain_oracle_3.h>
#include <weft/spatial/cgal/to_c3t3.h>

#include <cmath>
#include <cstdlib>
#include <type_traits>
#include <utility>

namespace weft {

namespace internal {

/// What CGAL's own function asks for. `complain()` is the sentence where `holds` is false.
template <class C3t3, class Domain, class Criteria>
struct C3t3_requirements
{
private:
  template <class T>
  using Complex = std::void_t<typename T::Triangulation, typename T::Surface_patch_index, typename T::Corner_index>;
  template <class T>
  using Mesh_domain = std::void_t<typename T::R, typename T::Is_in_domain, typename T::Construct_intersection>;
  template <class T>
  using Coordinate = typename T::R::FT;
  template <class T>
  using Mesh_criteria =
      decltype(std::declval<const T&>().facet_criteria_object(), std::declval<const T&>().cell_criteria_object());

  static constexpr bool is_complex = answers_v<void, Complex, C3t3>;
  static constexpr bool is_domain = answers_v<void, Mesh_domain, Domain>;
  static constexpr bool has_doubles = answers_v<double, Coordinate, Domain>;
  static constexpr bool are_criteria = answers_v<void, Mesh_criteria, Criteria>;

public:
  static constexpr bool holds = is_complex && is_domain && has_doubles && are_criteria;

  static void complain()
  {
    static_assert(is_complex,
                  "weft: make_mesh_3<C3t3>() returns a CGAL::Mesh_complex_3_in_triangulation_3; C3t3 is none");
    static_assert(is_domain, "weft: make_mesh_3<C3t3>() takes a model of CGAL's MeshDomain_3");
    static_assert(!is_domain || has_doubles, "weft: the domain's kernel needs exact predicates and coordinates of type "
                                             "double, such as CGAL::Exact_predicates_inexact_constructions_kernel");
    static_assert(are_criteria, "weft: make_mesh_3<C3t3>() takes a model of CGAL's MeshCriteria_3");
  }
};

} // namespace internal

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
  using Requirements = internal::C3t3_requirements<C3t3, Domain, Criteria>;
  if constexpr (Requirements::holds) {
    using Oracle = Mesh_domain_oracle_3<Domain>;
    const Oracle oracle(domain);
    // In diagonals. Creases may part at small angles; what else is as small are steps of images, at which the search
    // for a manifold boundary doesn't end by itself.
    const double smallest_detail = oracle.number_of_creases() > 0 ? 1e-4 : 1e-3;
    const auto own_criteria = internal::cgal_criteria_3<C3t3>(criteria, oracle);
    Mesh_options_3 own_options = options;
    const auto b = oracle.bbox();
    if (options.size_floor == 0)
      own_options.size_floor =
          smallest_detail * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    const auto result = make_mesh_3(oracle, own_criteria, own_options);
    if (report) *report = result.report;
    return to_c3t3<C3t3>(result.restricted, oracle);
  } else {
    Requirements::complain();
    std::abort();
  }
}

} // namespace weft

#endif // WEFT_MAKE_C3T3_H
