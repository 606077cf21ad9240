// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the boundary facets and crease edges of a mesh are from points of its domain, patch by patch and crease by
// crease.

#ifndef WEFT_SPATIAL_DOMAIN_BOUNDARY_DISTANCE_3_H
#define WEFT_SPATIAL_DOMAIN_BOUNDARY_DISTANCE_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Segment_hierarchy_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

template <class K>
class Boundary_distance_3
{
public:
  using Point = typename K::Point_3;

  Boundary_distance_3(std::size_t patches, std::size_t creases)
      : triangles_(patches), segments_(creases), facets_(patches), edges_(creases)
  {}

  /// Counterclockwise seen from outside; between two subdomains, from outside the one with the smaller number.
  void add_facet(const Point& a, const Point& b, const Point& c, int patch)
  {
    Surface_triangle_3<K> t;
    t.points = {{a, b, c}};
    t.vertices = {{0, 1, 2}}; // nobody asks for contacts
    auto& own = triangles_[static_cast<std::size_t>(patch)];
    t.index = static_cast<std::uint32_t>(own.size());
    t.patch = patch;
    own.push_back(t);
  }
  void add_edge(const Point& a, const Point& b, int crease)
  {
    segments_[static_cast<std::size_t>(crease)].push_back({a, b, crease});
  }

  /// To be called when all are there. O(n log n).
  void build()
  {
    for (std::size_t p = 0; p < triangles_.size(); ++p)
      if (!triangles_[p].empty()) facets_[p] = Triangle_hierarchy_3<K>(triangles_[p]);
    for (std::size_t c = 0; c < segments_.size(); ++c)
      if (!segments_[c].empty()) edges_[c] = Segment_hierarchy_3<K>(segments_[c]);
  }

  bool has_facets(int patch) const { return !triangles_[static_cast<std::size_t>(patch)].empty(); }

  /// Whether a facet of the patch comes that near to a point.
  bool has_facet_within(const Point& p, int patch, double distance) const
  {
    return has_facets(patch) && facets_[static_cast<std::size_t>(patch)].is_within(p, distance * distance);
  }

  /// Whether a facet of the patch comes that near to a point and looks the same way as a normal, if that isn't zero:
  /// the other side of a thin part doesn't count.
  bool has_facet_within(const Point& p, int patch, double distance, const std::array<double, 3>& normal) const
  {
    if (!has_facets(patch)) return false;
    return facets_[static_cast<std::size_t>(patch)].visit_within(p, distance * distance, [&](const auto& t) {
      const Xyz_3 a = xyz(t.points[0]), n = cross_product(minus(xyz(t.points[1]), a), minus(xyz(t.points[2]), a));
      return normal == std::array<double, 3>() || dot_product(n, Xyz_3{normal}) > 0;
    });
  }

  double distance_to_facets(const Point& p, int patch) const
  {
    const auto i = static_cast<std::size_t>(patch);
    return triangles_[i].empty() ? std::numeric_limits<double>::infinity()
                                 : std::sqrt(facets_[i].nearest(p).squared_distance);
  }

  double distance_to_edges(const Point& p, int crease) const
  {
    const auto i = static_cast<std::size_t>(crease);
    return segments_[i].empty() ? std::numeric_limits<double>::infinity()
                                : norm(minus(xyz(edges_[i].nearest(p)), xyz(p)));
  }

private:
  std::vector<std::vector<Surface_triangle_3<K>>> triangles_; ///< by patch
  std::vector<std::vector<Crease_segment_3<K>>> segments_;    ///< by crease
  std::vector<Triangle_hierarchy_3<K>> facets_;
  std::vector<Segment_hierarchy_3<K>> edges_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_BOUNDARY_DISTANCE_3_H
