// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which creases and patches of a piecewise smooth complex meet: what the topology criterion asks (Tournois 2009, sec.
// 3.2.1.4, "Topology").

#ifndef WEFT_SPATIAL_SURFACE_FEATURE_INCIDENCE_3_H
#define WEFT_SPATIAL_SURFACE_FEATURE_INCIDENCE_3_H

#include <weft/internal/as_index.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft {

/// Incidences of feature vertices, creases and patches.
class Feature_incidence_3
{
public:
  /// For domains without feature vertices and creases.
  Feature_incidence_3() = default;

  /// Linear in the size of the complex, but for a factor log(number of sharp edges).
  template <class K>
  explicit Feature_incidence_3(const Piecewise_smooth_complex_3<K>& complex)
      : creases_of_corner_(complex.features.size()),
        patches_of_corner_(complex.features.size()),
        patches_of_crease_(complex.creases.size())
  {
    std::vector<int> corner_of_point(complex.points.size(), -1);
    for (std::size_t i = 0; i < complex.features.size(); ++i)
      corner_of_point[complex.features[i].vertex] = static_cast<int>(i);
    std::map<std::pair<std::size_t, std::size_t>, int> crease_of_edge;
    for (std::size_t c = 0; c < complex.creases.size(); ++c) {
      const auto& crease = complex.creases[c];
      const std::size_t n = crease.vertices.size();
      for (std::size_t k = 0; k + (crease.closed ? 0 : 1) < n; ++k)
        crease_of_edge[std::minmax(crease.vertices[k], crease.vertices[(k + 1) % n])] = static_cast<int>(c);
      if (crease.closed) continue;
      add_crease_at(corner_of_point[crease.vertices.front()], static_cast<int>(c));
      add_crease_at(corner_of_point[crease.vertices.back()], static_cast<int>(c));
    }
    for (std::size_t t = 0; t < complex.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = complex.triangles[t][i], b = complex.triangles[t][(i + 1) % 3];
        if (corner_of_point[a] >= 0)
          patches_of_corner_[internal::as_index(corner_of_point[a])].push_back(complex.patches[t]);
        const auto found = crease_of_edge.find(std::minmax(a, b));
        if (found != crease_of_edge.end())
          patches_of_crease_[internal::as_index(found->second)].push_back(complex.patches[t]);
      }
    for (auto* lists : {&creases_of_corner_, &patches_of_corner_, &patches_of_crease_})
      for (auto& list : *lists) sort_and_thin(list);
  }

  /// For domains that don't tell which patches meet at a crease: any may.
  /// \param ends of each crease, the numbers of the feature vertices there; -1 and -1 for a closed one.
  Feature_incidence_3(std::size_t number_of_corners, const std::vector<std::pair<int, int>>& ends)
      : knows_patches_(false), creases_of_corner_(number_of_corners)
  {
    for (std::size_t c = 0; c < ends.size(); ++c) {
      add_crease_at(ends[c].first, static_cast<int>(c));
      add_crease_at(ends[c].second, static_cast<int>(c));
    }
    for (auto& list : creases_of_corner_) sort_and_thin(list);
  }

  bool corner_is_on_crease(int corner, int crease) const
  {
    return contains(creases_of_corner_[internal::as_index(corner)], crease);
  }

  /// Creases that end in a feature vertex, in order; one that starts and ends there counts once.
  const std::vector<int>& creases_of_corner(int corner) const { return creases_of_corner_[internal::as_index(corner)]; }

  /// Patches that meet at a crease, in order; none where that isn't known.
  const std::vector<int>& patches_of_crease(int crease) const
  {
    static const std::vector<int> none;
    return knows_patches_ ? patches_of_crease_[internal::as_index(crease)] : none;
  }

  /// Whether a location lies on the closure of a patch, as far as that is known.
  bool is_on_patch(const Vertex_location_3& at, int patch) const
  {
    if (at.dimension < 2 && !knows_patches_) return true;
    switch (at.dimension) {
    case 0:
      return contains(patches_of_corner_[internal::as_index(at.index)], patch);
    case 1:
      return contains(patches_of_crease_[internal::as_index(at.index)], patch);
    default:
      return at.dimension == 2 && at.index == patch;
    }
  }

private:
  void add_crease_at(int corner, int crease)
  {
    if (corner >= 0) creases_of_corner_[internal::as_index(corner)].push_back(crease);
  }
  static void sort_and_thin(std::vector<int>& list)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  static bool contains(const std::vector<int>& list, int x) { return std::binary_search(list.begin(), list.end(), x); }

  bool knows_patches_ = true;
  std::vector<std::vector<int>> creases_of_corner_, patches_of_corner_, patches_of_crease_;
};

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_FEATURE_INCIDENCE_3_H
