// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the labels of an image look like grey values or distances instead.

#ifndef WEFT_SPATIAL_DOMAIN_LOOKS_LIKE_GREY_VALUES_H
#define WEFT_SPATIAL_DOMAIN_LOOKS_LIKE_GREY_VALUES_H

#include <weft/spatial/domain/Label_image_3.h>

#include <cmath>
#include <cstddef>

namespace weft {

/// Many values, which differ between neighbours more often than not far, but by little: labels fill regions, grey
/// values rise and fall. What it says is a reason to ask, not a proof. O(voxels).
inline bool looks_like_grey_values(const Label_image_3& image)
{
  constexpr int least_labels = 16;
  constexpr double often = 0.3;  // of neighbours; regions of labels are 6 voxels across then
  constexpr double little = 0.2; // of the range; a third between random labels
  const int labels = image.number_of_labels();
  if (labels <= least_labels) return false;
  const double range = static_cast<double>(image.value(labels - 1)) - image.value(1);
  double pairs = 0, different = 0, difference = 0;
  Voxel_image_3::Voxel v{{0, 0, 0}};
  for (; image.contains(v); ++v[2]) {
    for (; image.contains(v); ++v[1]) {
      for (; image.contains(v); ++v[0]) {
        const int label = image.label(v);
        if (label == 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          auto next = v;
          ++next[axis];
          if (!image.contains(next)) continue;
          const int other = image.label(next);
          if (other == 0) continue;
          ++pairs;
          different += other != label;
          difference += std::abs(static_cast<double>(image.value(other)) - image.value(label));
        }
      }
      v[0] = 0;
    }
    v[1] = 0;
  }
  return different > often * pairs && difference < little * range * different;
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_LOOKS_LIKE_GREY_VALUES_H
