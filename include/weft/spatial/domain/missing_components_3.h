// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which components of an image's labels a mesh has no cells of.

#ifndef WEFT_SPATIAL_DOMAIN_MISSING_COMPONENTS_3_H
#define WEFT_SPATIAL_DOMAIN_MISSING_COMPONENTS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft {

/// The components that stay out of a mesh: no cell of their subdomain has its centroid in one of their voxels, or one
/// of their voxels' centers in it. The largest first. O(voxels in the cells' bounding boxes), of each cell at most some
/// thousands.
/// \param components those of the image.
/// \param mesh its subdomains are labels of the image.
template <class K>
std::vector<Voxel_component_3> missing_components_3(const Voxel_image_3& image, const Voxel_components_3& components,
                                                    const Tetrahedral_mesh_3<K>& mesh)
{
  using internal::Xyz_3;
  using Voxel = Voxel_image_3::Voxel;
  constexpr std::ptrdiff_t most = 4096; // a cell with more voxels has its centroid in what it belongs to
  std::vector<char> is_there(components.components().size(), false);
  const auto mark = [&](const Voxel& v, int label) {
    if (image.label(v) == label) is_there[components.component(v)] = true;
  };
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    std::array<Xyz_3, 4> p;
    Xyz_3 centroid{{{0, 0, 0}}};
    Voxel low{}, high{};
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = internal::xyz(mesh.points[mesh.cells[c][i]]);
      const Voxel v = image.voxel_at(mesh.points[mesh.cells[c][i]]);
      for (std::size_t k = 0; k < 3; ++k) {
        centroid[k] += p[i][k] / 4;
        low[k] = i == 0 ? v[k] : (std::min)(low[k], v[k]);
        high[k] = i == 0 ? v[k] : (std::max)(high[k], v[k]);
      }
    }
    mark(image.voxel_at(typename K::Point_3(centroid[0], centroid[1], centroid[2])), mesh.subdomains[c]);
    if ((high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1) > most) continue;
    const auto volume = [](const Xyz_3& a, const Xyz_3& b, const Xyz_3& d, const Xyz_3& e) {
      return internal::dot_product(internal::minus(b, a),
                                   internal::cross_product(internal::minus(d, a), internal::minus(e, a)));
    };
    Voxel v;
    for (v[2] = low[2]; v[2] <= high[2]; ++v[2])
      for (v[1] = low[1]; v[1] <= high[1]; ++v[1])
        for (v[0] = low[0]; v[0] <= high[0]; ++v[0]) {
          if (image.label(v) != mesh.subdomains[c] || is_there[components.component(v)]) continue;
          Xyz_3 x;
          for (std::size_t k = 0; k < 3; ++k) x[k] = image.coordinate(k, static_cast<double>(v[k]));
          if (volume(x, p[1], p[2], p[3]) >= 0 && volume(p[0], x, p[2], p[3]) >= 0 &&
              volume(p[0], p[1], x, p[3]) >= 0 && volume(p[0], p[1], p[2], x) >= 0)
            mark(v, mesh.subdomains[c]);
        }
  }
  std::vector<Voxel_component_3> missing;
  for (std::size_t i = 0; i < is_there.size(); ++i)
    if (!is_there[i] && components.components()[i].label != 0) missing.push_back(components.components()[i]);
  std::stable_sort(missing.begin(), missing.end(),
                   [](const Voxel_component_3& a, const Voxel_component_3& b) { return a.voxels > b.voxels; });
  return missing;
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_MISSING_COMPONENTS_3_H
