// SPDX-License-Identifier: GPL-3.0-or-later
//
// The feature vertices and creases of a domain as points and polylines, ready for what a domain oracle is asked about
// them: projection to a crease, and where creases cross a Voronoi facet (Tournois 2009, sec. 3.3.1).

#ifndef WEFT_SPATIAL_DOMAIN_CREASE_NETWORK_3_H
#define WEFT_SPATIAL_DOMAIN_CREASE_NETWORK_3_H

#include <weft/internal/boxes/Segment_hierarchy_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace weft {

/// A crease as a polyline.
template <class K>
struct Crease_polyline_3
{
  std::vector<typename K::Point_3> points; ///< in order; a closed one doesn't repeat the first
  bool closed = false;                     ///< a cycle without a feature vertex
};

/// Feature vertices and creases. All queries may be asked by several threads at once.
/// \tparam K a CGAL kernel with exact predicates whose coordinates are doubles.
template <class K>
class Crease_network_3
{
public:
  using Point = typename K::Point_3;

  Crease_network_3() = default;

  /// O(n log n) for n points.
  Crease_network_3(std::vector<Point> corners, std::vector<Crease_polyline_3<K>> creases)
      : corners_(std::move(corners)), creases_(std::move(creases))
  {
    std::vector<internal::Crease_segment_3<K>> all;
    for (std::size_t c = 0; c < creases_.size(); ++c) {
      const auto& points = creases_[c].points;
      std::vector<internal::Crease_segment_3<K>> chain;
      for (std::size_t i = 0; i + 1 < points.size() + creases_[c].closed; ++i)
        chain.push_back({points[i], points[(i + 1) % points.size()], static_cast<int>(c)});
      chains_.emplace_back(chain);
      all.insert(all.end(), chain.begin(), chain.end());
    }
    segments_ = internal::Segment_hierarchy_3<K>(all);
  }

  std::size_t number_of_corners() const { return corners_.size(); }
  const Point& corner(std::size_t i) const { return corners_[i]; }

  std::size_t number_of_creases() const { return creases_.size(); }
  const std::vector<Point>& crease_points(int i) const { return creases_[static_cast<std::size_t>(i)].points; }
  bool crease_is_closed(int i) const { return creases_[static_cast<std::size_t>(i)].closed; }

  /// Nearest point of a crease.
  Point project_on_crease(const Point& p, int crease) const
  {
    return chains_[static_cast<std::size_t>(crease)].nearest(p);
  }

  /// Nearest point of all creases, and its crease, which is left as it is if there are none.
  Point project(const Point& p, int& crease) const { return segments_.nearest(p, crease); }

  /// Appends the points where creases cross a convex polygon in the plane that bisects a and b, such as the Voronoi
  /// facet of the Delaunay edge ab. Exact predicates decide which crease edges cross the plane, and a crease vertex on
  /// the plane is one crossing or none; whether the point is in the polygon, whose vertices are rounded, isn't exact.
  /// \param polygon its vertices in order, in either direction.
  void intersect_creases(const Point& a, const Point& b, const std::vector<Point>& polygon,
                         std::vector<Crease_hit_3<K>>& hits) const
  {
    const auto first = static_cast<std::ptrdiff_t>(hits.size());
    segments_.cross_polygon(a, b, polygon, [&](const Point& x, const internal::Crease_segment_3<K>& segment) {
      hits.push_back({x, segment.crease});
    });
    std::sort(hits.begin() + first, hits.end(), [](const Crease_hit_3<K>& x, const Crease_hit_3<K>& y) {
      return std::tie(x.crease, x.point) < std::tie(y.crease, y.point);
    });
  }

private:
  std::vector<Point> corners_;
  std::vector<Crease_polyline_3<K>> creases_;
  internal::Segment_hierarchy_3<K> segments_;
  std::vector<internal::Segment_hierarchy_3<K>> chains_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_CREASE_NETWORK_3_H
