// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes that vary in space.

#include "result.h"

#include <weft/IO/read_sizing_3.h>
#include <weft/spatial/domain/Image_oracle_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/sizing/Feature_sizing_3.h>
#include <weft/spatial/sizing/grade_criteria_3.h>

namespace mesh_3_program {

std::function<double(const std::array<double, 3>&)> read_size_field(const std::string& filename)
{
  return [field = weft::IO::read_sizing_3<K>(filename)](const std::array<double, 3>& p) {
    return field(K::Point_3(p[0], p[1], p[2]));
  };
}

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

template weft::Criteria_3<K> with_sizes(const weft::Polyhedral_oracle_3<K>&, weft::Criteria_3<K>, const Bounds&);
template weft::Criteria_3<K> with_sizes(const weft::Image_oracle_3<K>&, weft::Criteria_3<K>, const Bounds&);

} // namespace mesh_3_program
