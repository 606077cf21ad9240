// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the labels of an image meet at edges of voxels alone, as the squares of a checkerboard do: two surfaces touch
// there, which no mesh of a size can tell apart.

#ifndef WEFT_SPATIAL_DOMAIN_CONTACTS_AT_EDGES_3_H
#define WEFT_SPATIAL_DOMAIN_CONTACTS_AT_EDGES_3_H

#include <weft/spatial/domain/Label_image_3.h>

#include <cstddef>

namespace weft {

/// In how many squares of four voxels two labels are across from themselves. O(voxels).
inline std::size_t number_of_contacts_at_edges(const Label_image_3& image)
{
  std::size_t contacts = 0;
  const auto& n = image.size();
  Voxel_image_3::Voxel v;
  for (v[2] = 0; v[2] < static_cast<std::ptrdiff_t>(n[2]); ++v[2])
    for (v[1] = 0; v[1] < static_cast<std::ptrdiff_t>(n[1]); ++v[1])
      for (v[0] = 0; v[0] < static_cast<std::ptrdiff_t>(n[0]); ++v[0])
        for (std::size_t axis = 0; axis < 3; ++axis) {
          auto across = v, right = v, up = v;
          ++right[(axis + 1) % 3], ++up[(axis + 2) % 3], ++across[(axis + 1) % 3], ++across[(axis + 2) % 3];
          if (!image.contains(across)) continue;
          const int a = image.label(v), b = image.label(right);
          contacts += a != b && image.label(across) == a && image.label(up) == b;
        }
  return contacts;
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_CONTACTS_AT_EDGES_3_H
