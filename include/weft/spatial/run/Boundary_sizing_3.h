// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizes that a triangle surface has: at any point the mean length of the edges at the nearest triangle's corners.

#ifndef WEFT_SPATIAL_RUN_BOUNDARY_SIZING_3_H
#define WEFT_SPATIAL_RUN_BOUNDARY_SIZING_3_H

#include <weft/internal/boxes/Triangle_hierarchy_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft::internal {

/// A field of lengths; copies share the surface.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Boundary_sizing_3
{
public:
  using Point = typename K::Point_3;

  /// O(n log n).
  Boundary_sizing_3(const std::vector<Point>& points, const std::vector<std::array<std::size_t, 3>>& triangles)
      : data_(std::make_shared<Data>())
  {
    std::vector<double> sum(points.size(), 0);
    std::vector<std::size_t> count(points.size(), 0);
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const double length = std::sqrt(CGAL::to_double(CGAL::squared_distance(points[t[i]], points[t[(i + 1) % 3]])));
        data_->shortest = (std::min)(data_->shortest, length);
        data_->longest = (std::max)(data_->longest, length);
        for (const std::size_t v : {t[i], t[(i + 1) % 3]}) sum[v] += length, ++count[v];
      }
    std::vector<Surface_triangle_3<K>> all(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      double size = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = triangles[t][i];
        all[t].vertices[i] = static_cast<std::uint32_t>(v);
        all[t].points[i] = points[v];
        size += sum[v] / static_cast<double>(count[v]) / 3;
      }
      all[t].index = static_cast<std::uint32_t>(t);
      all[t].patch = 0;
      data_->sizes.push_back(size);
    }
    data_->surface = Triangle_hierarchy_3<K>(all);
  }

  double operator()(const Point& p) const { return data_->sizes[nearest_triangle(p)]; }

  std::size_t nearest_triangle(const Point& p) const { return data_->surface.nearest(p).triangle; }

  double shortest_edge() const { return data_->shortest; }
  double longest_edge() const { return data_->longest; }

private:
  struct Data
  {
    Triangle_hierarchy_3<K> surface;
    std::vector<double> sizes; ///< of the triangles
    double shortest = HUGE_VAL, longest = 0;
  };
  std::shared_ptr<Data> data_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_BOUNDARY_SIZING_3_H
