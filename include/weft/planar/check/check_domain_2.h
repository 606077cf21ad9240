// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the right faces are in the domain: those that nesting parity or the graph's holes and its regions put there,
// and of the right area.

#ifndef WEFT_PLANAR_CHECK_CHECK_DOMAIN_2_H
#define WEFT_PLANAR_CHECK_CHECK_DOMAIN_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/internal/Compensated_sum.h>
#include <weft/planar/check/check_conformity_2.h>
#include <weft/planar/check/Validity_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace weft {

namespace internal {

/// Faults of faces whose flag isn't that of their region.
template <class Cdt>
Validity_2 compare_flags(const Cdt& cdt, const Face_components<Cdt>& components, const std::vector<char>& in_domain)
{
  Validity_2 validity;
  for (const auto face : cdt.all_face_handles()) {
    const bool wanted = in_domain[as_index(components.number[face])];
    if (face->is_in_domain() != wanted)
      validity.add(Fault_kind::domain, wanted ? "a face isn't in the domain" : "a face is wrongly in the domain",
                   corners(cdt, face));
  }
  return validity;
}

template <class Cdt>
std::vector<char> odd_levels(const Cdt& cdt, const Face_components<Cdt>& components)
{
  std::vector<char> in_domain;
  for (const int level : nesting_levels(cdt, components)) in_domain.push_back(level % 2 == 1);
  return in_domain;
}

/// What the graph's holes and regions, or else nesting parity, put into the domain.
template <class Cdt, class K>
Validity_2 check_flags(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  const auto components = face_components(cdt);
  std::vector<char> in_domain =
      pslg.holes.empty() ? odd_levels(cdt, components) : std::vector<char>(as_index(components.count), 1);
  const auto put = [&](const typename K::Point_2& p, char value) {
    const auto face = cdt.locate(p);
    if (!is_on_constraint(cdt, p, face)) in_domain[as_index(components.number[face])] = value;
  };
  for (const auto& region : pslg.regions) put(region.point, 1);
  for (const auto& p : pslg.holes) put(p, 0);
  in_domain[0] = 0;
  return compare_flags(cdt, components, in_domain);
}

struct Area
{
  double value, rounding; ///< in units of 4^exponent
};

/// Area of the domain, and a bound of its rounding error.
template <class Cdt>
Area domain_area(const Cdt& cdt, int exponent)
{
  Compensated_sum area, products;
  for (const auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const Scaled_triangle_2 triangle(face);
    const double longest = triangle.longest();
    area.add(std::ldexp(triangle.twice_area, 2 * (triangle.exponent - exponent) - 1));
    products.add(std::ldexp(longest * longest, 2 * (triangle.exponent - exponent)));
  }
  return {area.value(), ulps_of(products.value(), 4)};
}

/// Compares the area of the domain with that of the graph's own triangulation. Vertices on segments are rounded, so the
/// areas may differ by a strip along each segment.
template <class Cdt, class K>
void check_area(const Cdt& cdt, const Pslg_2<K>& pslg, Validity_2& validity)
{
  Mesh_triangulation_2<K> input;
  try {
    insert_pslg(input, pslg, {Crossings::split, 0});
    mark_domain(input, pslg);
  } catch (const Domain_error& error) {
    validity.add(Fault_kind::domain, std::string("the input has no domain: ") + error.what());
    return;
  }
  double largest = 0;
  for (const auto& p : pslg.points) largest = (std::max)(largest, largest_coordinate(p));
  int exponent = 0;
  std::frexp(largest, &exponent);
  Compensated_sum length;
  for (const auto& [a, b] : pslg.segments) {
    const Xy_2 p = xy(pslg.points[a]), q = xy(pslg.points[b]);
    length.add(std::ldexp(edge_length(q[0] - p[0], q[1] - p[1]), -exponent));
  }
  const Area wanted = domain_area(input, exponent), found = domain_area(cdt, exponent);
  const double strip = 2 * ulps_of(length.value(), most_ulps_off_segment);
  if (std::abs(wanted.value - found.value) <= wanted.rounding + found.rounding + strip) return;
  std::ostringstream what;
  what.precision(std::numeric_limits<double>::max_digits10);
  what << "the area of the domain is " << std::ldexp(found.value, 2 * exponent) << ", that of the input "
       << std::ldexp(wanted.value, 2 * exponent);
  validity.add(Fault_kind::domain, what.str());
}

} // namespace internal

/// Checks that the faces in the domain are those that nesting parity puts there, see mark_domain.h. Exact, linear time.
/// The structure must be sound.
template <class Cdt>
Validity_2 check_domain_2(const Cdt& cdt)
{
  const auto components = internal::face_components(cdt);
  return internal::compare_flags(cdt, components, internal::odd_levels(cdt, components));
}

/// Checks that the faces in the domain are those that the graph describes, by its holes if it has any, else by nesting
/// parity, and by its regions; and that their area is that of the graph's own triangulation, up to the rounding of
/// vertices on segments. O(n log n) time. Structure and orientation must be sound.
template <class Cdt, class K>
Validity_2 check_domain_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  Validity_2 validity;
  internal::check_area(cdt, pslg, validity);
  validity += internal::check_flags(cdt, pslg);
  return validity;
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_CHECK_DOMAIN_2_H
