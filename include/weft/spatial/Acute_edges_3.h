// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where two parts of a surface meet at an acute angle. Beside such an edge they are nearer to each other than any
// triangle between them is large, so Delaunay refinement finds bad facets and cells at every scale (Tournois 2009,
// sec. 4.2.1.1): there it has to give up at some size, and to say so.

#ifndef WEFT_SPATIAL_ACUTE_EDGES_3_H
#define WEFT_SPATIAL_ACUTE_EDGES_3_H

#include <weft/internal/Box_hierarchy_3.h>
#include <weft/internal/coordinates_3.h>
#include <weft/internal/nearest_point_3.h>
#include <weft/spatial/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace weft {

/// The edges of a surface with an acute dihedral angle inside or outside of the domain, creases or not.
/// \tparam K a CGAL kernel.
template <class K>
class Acute_edges_3
{
public:
  using Point = typename K::Point_3;

  Acute_edges_3() = default;

  /// O(n log n) for n triangles.
  /// \param largest_angle dihedral angles below it are acute, in degrees.
  Acute_edges_3(const Piecewise_smooth_complex_3<K>& complex, double largest_angle)
  {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> triangle_of_side;
    std::vector<internal::Box_3> boxes;
    for (std::size_t t = 0; t < complex.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const std::size_t a = complex.triangles[t][i], b = complex.triangles[t][(i + 1) % 3];
        const auto other = triangle_of_side.find({b, a});
        if (other == triangle_of_side.end()) {
          triangle_of_side[{a, b}] = t;
          continue;
        }
        const double angle = smaller_dihedral(complex, t, other->second);
        if (!(angle < largest_angle * degree)) continue;
        edges_.push_back({complex.points[a], complex.points[b], reach_at(angle)});
        largest_reach_ = (std::max)(largest_reach_, edges_.back().reach);
        boxes.emplace_back();
        for (const std::size_t v : {a, b})
          boxes.back().add(complex.points[v].x(), complex.points[v].y(), complex.points[v].z());
      }
    boxes_ = internal::Box_hierarchy_3(boxes);
  }

  bool empty() const { return edges_.empty(); }

  /// Whether a ball lies so near to an acute edge that it meets both sides of it, or nearly so: a simplex whose
  /// circumscribed ball that is mixes them up.
  bool is_near(const Point& center, double radius) const
  {
    if (edges_.empty()) return false;
    const auto framed = boxes_.frame()(center.x(), center.y(), center.z());
    const std::array<float, 3> from{
        {static_cast<float>(framed[0]), static_cast<float>(framed[1]), static_cast<float>(framed[2])}};
    const double error = (1 + (std::max)({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])})) * 1e-6;
    const double reach = radius * largest_reach_ * boxes_.frame().scale * (1 + 1e-6) + error;
    if (!(reach * reach < std::numeric_limits<float>::max())) return true;
    bool found = false;
    boxes_.visit_nearest(from, static_cast<float>(reach * reach * (1 + 1e-6)), [&](std::uint32_t block, float limit) {
      for (std::uint32_t i = 4 * block; i < 4 * block + 4 && !found; ++i) {
        const std::uint32_t item = boxes_.items()[i];
        if (item == internal::Box_hierarchy_3::nothing) break;
        const Edge& edge = edges_[item];
        const Point x = internal::nearest_point_on_segment(center, edge.source, edge.target);
        found = internal::norm(internal::minus(internal::xyz(x), internal::xyz(center))) <= radius * edge.reach;
      }
      return found ? -1.f : limit;
    });
    return found;
  }

private:
  struct Edge
  {
    Point source, target;
    double reach;
  };

  static constexpr double degree = 3.14159265358979323846 / 180;

  /// At a distance of d the sides are about d times the angle apart; a ball of half of that can't mix them up.
  static double reach_at(double angle) { return 1 + 2 / (std::max)(angle, 0.01); }

  static double smaller_dihedral(const Piecewise_smooth_complex_3<K>& complex, std::size_t t, std::size_t u)
  {
    const auto m = normal(complex, t), n = normal(complex, u);
    const double sine = internal::norm(internal::cross_product(m, n)), cosine = internal::dot_product(m, n);
    return std::atan2(sine, -cosine);
  }

  static internal::Xyz_3 normal(const Piecewise_smooth_complex_3<K>& complex, std::size_t t)
  {
    const auto& v = complex.triangles[t];
    const auto origin = internal::xyz(complex.points[v[0]]);
    const auto n = internal::cross_product(internal::minus(internal::xyz(complex.points[v[1]]), origin),
                                           internal::minus(internal::xyz(complex.points[v[2]]), origin));
    const double length = internal::norm(n); // squared again below: tiny surfaces would underflow
    return length > 0 ? internal::Xyz_3{{n[0] / length, n[1] / length, n[2] / length}} : n;
  }

  std::vector<Edge> edges_;
  double largest_reach_ = 0;
  internal::Box_hierarchy_3 boxes_;
};

} // namespace weft

#endif // WEFT_SPATIAL_ACUTE_EDGES_3_H
