// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a planar mesh is valid: a triangulation of the plane (combinatorially, and by the orientation of its faces
// and hull), constrained Delaunay, conforming to the graph it was made from, with the right faces in the domain, and no
// larger than a sizing field allows. Exact predicates decide wherever the truth doesn't depend on rounding; the two
// checks that do depend on it say how. Every check walks the triangulation by itself, needs no assertions of CGAL and
// changes nothing, and each can be called alone.
//
// Works on any CGAL constrained triangulation whose faces have `is_in_domain()`.

#ifndef WEFT_PLANAR_CHECK_VALIDATE_2_H
#define WEFT_PLANAR_CHECK_VALIDATE_2_H

#include <weft/planar/check/check_conformity_2.h>
#include <weft/planar/check/check_delaunay_2.h>
#include <weft/planar/check/check_domain_2.h>
#include <weft/planar/check/check_sizing_2.h>
#include <weft/planar/check/check_structure_2.h>
#include <weft/planar/check/Validity_2.h>
#include <weft/planar/graph/Pslg_2.h>

namespace weft {

/// Checks structure, orientation and Delaunay property. What needs a sound structure or orientation is left out where
/// that isn't found. Linear time.
template <class Cdt>
Validity_2 validate_2(const Cdt& cdt)
{
  Validity_2 validity = check_structure_2(cdt);
  if (!validity.ok()) return validity;
  validity += check_orientation_2(cdt);
  validity += check_delaunay_2(cdt);
  return validity;
}

/// Checks structure, orientation, Delaunay property, conformity and domain; O(n log n) time. The domain must have been
/// marked by mark_domain(), or in another way that comes to the same. What needs a sound structure or orientation is
/// left out where that isn't found.
template <class Cdt, class K>
Validity_2 validate_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  Validity_2 validity = validate_2(cdt);
  if (validity.count(Fault_kind::structure) > 0) return validity;
  validity += check_conformity_2(cdt, pslg);
  if (validity.count(Fault_kind::orientation) == 0) validity += check_domain_2(cdt, pslg);
  return validity;
}

/// Checks everything: the above, and that the mesh keeps to a sizing field.
/// \throws Option_error if the field returns anything but a positive finite number.
template <class Cdt, class K, class Sizing>
Validity_2 validate_2(const Cdt& cdt, const Pslg_2<K>& pslg, const Sizing& sizing)
{
  Validity_2 validity = validate_2(cdt, pslg);
  if (validity.count(Fault_kind::structure) == 0) validity += check_sizing_2(cdt, sizing);
  return validity;
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_VALIDATE_2_H
