// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes that vary in space.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_3_SIZES_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_3_SIZES_H

#include "result.h"

#include <weft/spatial/sizing/Feature_sizing_3.h>
#include <weft/spatial/sizing/grade_criteria_3.h>

#include <algorithm>
#include <utility>

namespace mesh_3_program {

/// Criteria with the sizes that are asked for.
/// \tparam Oracle of the domain.
template <class Oracle>
weft::Criteria_3<K> with_sizes(const Oracle& oracle, weft::Criteria_3<K> criteria, const Bounds& bounds)
{
  if (!bounds.vary()) return criteria;
  constexpr double usual = 0.5;
  const double k = bounds.gradation > 0 ? bounds.gradation : usual, most = criteria.size.constant();
  if (bounds.size_field)
    criteria.size = [field = bounds.size_field, most](const K::Point_3& p) {
      return std::min(most, field({p.x(), p.y(), p.z()}));
    };
  if (bounds.by_features) {
    weft::Feature_sizing_options_3 options;
    options.max_size = most;
    criteria.size = [field = weft::Feature_sizing_3<K>(oracle, k, options),
                     other = criteria.size](const K::Point_3& p) { return std::min(field(p), other(p)); };
  }
  return weft::grade_criteria_3(oracle, criteria, k);
}

} // namespace mesh_3_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_3_SIZES_H
