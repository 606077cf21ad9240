// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cell of a tetrahedral mesh a point lies in, by a box hierarchy; outside, the nearest point of the boundary.

#ifndef WEFT_SPATIAL_MESH_CELL_LOCATOR_3_H
#define WEFT_SPATIAL_MESH_CELL_LOCATOR_3_H

#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

/// Where a point lies: the corners of a cell and their weights, which add up to 1; outside, those of a facet.
struct Place_in_cells_3
{
  std::size_t cell;                    ///< that one, or the one behind the facet
  std::array<std::size_t, 4> vertices; ///< of the cell
  std::array<double, 4> weights;       ///< none below 0
  bool outside;

  double value(const std::vector<double>& at_vertices) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * at_vertices[vertices[i]];
    return sum;
  }
};

/// Locates points. Nothing is written while reading.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Cell_locator_3
{
public:
  using Point = typename K::Point_3;

  Cell_locator_3() = default;

  /// O(n log n).
  /// \param cells without such that are inverted.
  Cell_locator_3(const std::vector<Point>& points, const std::vector<std::array<std::size_t, 4>>& cells) : cells_(cells)
  {
    points_.reserve(points.size());
    for (const Point& p : points) points_.push_back(xyz(p));
    std::vector<Box_3> boxes(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (const std::size_t v : cells[c]) boxes[c].add(points_[v][0], points_[v][1], points_[v][2]);
    boxes_ = Box_hierarchy_3(boxes);
    std::vector<Surface_triangle_3<K>> triangles;
    for_each_facet(cells, [&](auto first, auto last) {
      if (last - first != 1) return;
      const auto v = outward_vertices(cells[first->cell], first->opposite);
      Surface_triangle_3<K> t;
      for (std::size_t i = 0; i < 3; ++i) {
        t.vertices[i] = static_cast<std::uint32_t>(v[i]);
        t.points[i] = points[v[i]];
      }
      t.index = static_cast<std::uint32_t>(triangles.size());
      t.patch = 0;
      triangles.push_back(t);
      behind_.push_back({first->cell, first->opposite});
    });
    boundary_ = Triangle_hierarchy_3<K>(triangles);
  }

  /// O(log n) where cells aren't long and thin. Of several cells, the one in which the point lies deepest.
  Place_in_cells_3 locate(const Point& p) const
  {
    const Xyz_3 x = xyz(p);
    const std::array<double, 3> framed = boxes_.frame()(x[0], x[1], x[2]);
    Place_in_cells_3 best{0, {}, {}, true};
    double deepest = -rounding;
    std::size_t cell = none;
    const std::array<float, 3> from{
        {static_cast<float>(framed[0]), static_cast<float>(framed[1]), static_cast<float>(framed[2])}};
    boxes_.visit_nearest(from, 1e-12f, [&](std::uint32_t block, float limit) {
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t c = boxes_.items()[4 * block + i];
        if (c == Box_hierarchy_3::nothing) continue;
        const auto w = weights(cells_[c], x);
        const double depth = *std::min_element(w.begin(), w.end());
        if (!(depth > deepest || (depth == deepest && c < cell))) continue;
        deepest = depth;
        cell = c;
        best = {c, cells_[c], w, false};
      }
      return deepest > 1e-9 ? 0.f : limit; // no other cell has it inside
    });
    if (best.outside) return at_boundary(p);
    return clamped(best);
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  static constexpr double rounding = 1e-12;

  static Place_in_cells_3 clamped(Place_in_cells_3 place)
  {
    double sum = 0;
    for (double& w : place.weights) sum += w = (std::max)(w, 0.);
    for (double& w : place.weights) w /= sum;
    return place;
  }

  static double volume(const Xyz_3& a, const Xyz_3& b, const Xyz_3& c, const Xyz_3& d)
  {
    return dot_product(minus(b, a), cross_product(minus(c, a), minus(d, a)));
  }

  std::array<double, 4> weights(const std::array<std::size_t, 4>& cell, const Xyz_3& x) const
  {
    const Xyz_3 &a = points_[cell[0]], &b = points_[cell[1]], &c = points_[cell[2]], &d = points_[cell[3]];
    const double all = volume(a, b, c, d);
    if (all == 0) return {{-1, -1, -1, -1}};
    return {{volume(x, b, c, d) / all, volume(a, x, c, d) / all, volume(a, b, x, d) / all, volume(a, b, c, x) / all}};
  }

  Place_in_cells_3 at_boundary(const Point& p) const
  {
    const auto nearest = boundary_.nearest(p);
    const auto& [cell, opposite] = behind_[nearest.triangle];
    Place_in_cells_3 place{cell, cells_[cell], weights(cells_[cell], xyz(nearest.point)), true};
    for (double& w : place.weights)
      if (!(std::abs(w) <= 2)) w = 0.25; // of a cell without a volume
    place.weights[static_cast<std::size_t>(opposite)] = 0;
    return clamped(place);
  }

  struct Behind
  {
    std::size_t cell;
    int opposite;
  };

  std::vector<Xyz_3> points_;
  std::vector<std::array<std::size_t, 4>> cells_;
  Box_hierarchy_3 boxes_;
  std::vector<Behind> behind_; ///< by facet of the boundary
  Triangle_hierarchy_3<K> boundary_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_CELL_LOCATOR_3_H
