// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a mesh keeps to a sizing field.

#ifndef WEFT_PLANAR_CHECK_CHECK_SIZING_2_H
#define WEFT_PLANAR_CHECK_CHECK_SIZING_2_H

#include <weft/planar/check/Validity_2.h>
#include <weft/planar/mesh/sizing_quality_2.h>

namespace weft {

/// Checks that no sizing ratio of a triangle in the domain or of a constrained edge beside it, as in Sizing_quality_2,
/// exceeds a bound. Linear time.
/// \param sizing callable, point -> target edge length in the input's units.
/// \throws Option_error if the field returns anything but a positive finite number.
template <class Cdt, class Sizing>
Validity_2 check_sizing_2(const Cdt& cdt, const Sizing& sizing, double bound = 1)
{
  Validity_2 validity;
  const auto judge = [&](double ratio, const char* what, const auto& points) {
    if (!(ratio <= bound)) // so that NaN is a fault
      validity.add(Fault_kind::sizing, what + (" has sizing ratio " + std::to_string(ratio)), points());
  };
  for (const auto face : cdt.finite_face_handles())
    if (face->is_in_domain())
      judge(internal::sizing_ratio<typename Cdt::Point>(internal::Scaled_triangle_2(face), sizing), "a triangle",
            [&] { return internal::corners(cdt, face); });
  internal::for_each_constrained_edge(cdt, [&](auto face, int i) {
    judge(internal::sizing_ratio<Cdt>(face, i, sizing), "a constrained edge",
          [&] { return internal::ends(cdt, face, i); });
  });
  return validity;
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_CHECK_SIZING_2_H
