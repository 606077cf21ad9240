// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where two parts of a surface meet at an acute angle. Beside such an edge they are nearer to each other than any
// triangle between them is large, so Delaunay refinement finds bad facets and cells at every scale (Tournois 2009,
// sec. 4.2.1.1): there it has to give up at some size, and to say so.

#ifndef WEFT_SPATIAL_DOMAIN_ACUTE_EDGES_3_H
#define WEFT_SPATIAL_DOMAIN_ACUTE_EDGES_3_H

#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/spatial/domain/sheet_pairs_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace weft::internal {

/// Below this dihedral angle in degrees twins keep sides apart, see Mirror_twins_3.h; at larger ones refinement ends
/// without, and three such edges at a narrow tip would fill it with images of images.
inline constexpr double largest_angle_with_twins = 40;

/// The edges of a surface with an acute dihedral angle inside or outside of the domain, creases or not.
/// \tparam K a CGAL kernel.
template <class K>
class Acute_edges_3
{
public:
  using Point = typename K::Point_3;

  Acute_edges_3() = default;

  /// O(n log n) for n pairs.
  /// \param pairs those that meet at acute angles.
  Acute_edges_3(const Piecewise_smooth_complex_3<K>& complex, const std::vector<Sheet_pair_3>& pairs)
  {
    std::vector<Box_3> boxes;
    for (const Sheet_pair_3& pair : pairs) {
      const Point &a = complex.points[pair.source], &b = complex.points[pair.target];
      const auto &one = pair.away[0], &two = pair.away[1];
      edges_.push_back({a,
                        b,
                        unit(minus(one, two)),
                        unit({{one[0] + two[0], one[1] + two[1], one[2] + two[2]}}),
                        pair.angle,
                        reach_at(pair.angle),
                        pair.angle < largest_angle_with_twins * radians_per_degree,
                        {{complex.patches[pair.triangles[0]], complex.patches[pair.triangles[1]]}}});
      Edge& edge = edges_.back();
      for (std::size_t i = edges_.size() - 1; i-- > 0 && edges_[i].source == a && edges_[i].target == b;)
        edges_[i].is_mirrored = edge.is_mirrored = edges_[i].is_mirrored || edge.is_mirrored;
      largest_reach_ = (std::max)(largest_reach_, edges_.back().reach);
      boxes.emplace_back();
      for (const Point* p : {&a, &b}) boxes.back().add(p->x(), p->y(), p->z());
    }
    boxes_ = Box_hierarchy_3(boxes);
  }

  /// Whether a ball lies so near to an acute edge that it meets both sides of it, or nearly so: a simplex whose
  /// circumscribed ball that is mixes them up.
  bool is_near(const Point& center, double radius) const
  {
    bool found = false;
    visit_near(center, radius, [&](const Edge&, const Point&, double) { return found = true; });
    return found;
  }

  /// The smallest angle of such edges, in degrees; 180 if there is none.
  double angle_near(const Point& center, double radius) const
  {
    double smallest = 180;
    visit_near(center, radius, [&](const Edge& edge, const Point&, double) {
      smallest = (std::min)(smallest, edge.angle / radians_per_degree);
      return false;
    });
    return smallest;
  }

  /// The mirror image of `p` in the plane that bisects the acute edge nearest to `center`, if the ball mixes up the
  /// sides of that edge, with its center on the one and `p` on the other. Returns whether that is so.
  bool mirror(const Point& p, const Point& center, double radius, Point& image) const
  {
    double nearest = HUGE_VAL, height = 0;
    Xyz_3 normal{};
    visit_near(center, radius, [&](const Edge& edge, const Point& foot, double distance) {
      if (!(distance < nearest)) return false; // of equally near ones the first
      nearest = distance;
      normal = edge.normal;
      const Xyz_3 from = difference(center, foot), to = difference(p, foot);
      height = dot_product(to, normal);
      if (!(dot_product(from, normal) * height < 0 && dot_product(from, edge.inward) > 0 &&
            dot_product(to, edge.inward) > 0))
        height = 0;
      return false;
    });
    if (height == 0) return false;
    image = mirrored(p, height, normal);
    return true;
  }

  /// Calls `visit(image)` for the mirror images of a point of the surface in the planes that bisect acute
  /// edges of whose sheets one holds it, as far as they are nearer to it than `spacing`. Of the edges of two patches
  /// the nearest one counts. Edges from `largest_angle_with_twins` on don't, unless sheets between others meet
  /// there at less.
  /// \param patch that the point lies on; -1: on a crease or a feature vertex.
  template <class Visit>
  void visit_images(const Point& p, int patch, double spacing, const Visit& visit) const
  {
    struct Image
    {
      double distance; ///< of the edge
      std::size_t edge;
      Point point;
    };
    std::vector<Image> images;
    visit_near(p, spacing, [&](const Edge& edge, const Point& foot, double distance) {
      const Xyz_3 to = difference(p, foot);
      const double height = dot_product(to, edge.normal), depth = dot_product(to, edge.inward);
      const double half = 0.5 * edge.angle, angle = std::atan2(std::abs(height), depth);
      const bool is_on_sheet = angle > 0.5 * half && angle < 1.5 * half;
      if (edge.is_mirrored && is_on_sheet && 2 * std::abs(height) < spacing && std::abs(height) > 1e-9 * spacing &&
          (patch < 0 || patch == edge.patches[0] || patch == edge.patches[1]))
        images.push_back({distance, static_cast<std::size_t>(&edge - edges_.data()), mirrored(p, height, edge.normal)});
      return false;
    });
    std::sort(images.begin(), images.end(), [](const Image& a, const Image& b) {
      return std::tie(a.distance, a.edge) < std::tie(b.distance, b.edge);
    });
    for (std::size_t i = 0; i < images.size(); ++i) {
      const auto& patches = edges_[images[i].edge].patches;
      const bool is_first = std::none_of(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(i),
                                         [&](const Image& j) { return edges_[j.edge].patches == patches; });
      if (is_first) visit(images[i].point);
    }
  }

  /// Moves `p`, the center of a ball, to the nearest point of an acute edge if that is near: within 0.27 radii of one
  /// of 60 degrees, the more the acuter, up to 0.8. Returns whether it is. Of the reaches tried this leaves the fewest
  /// bad elements beside knife edges.
  bool attract(Point& p, double radius) const
  {
    const Point center = p;
    double nearest = HUGE_VAL;
    visit_near(center, radius, [&](const Edge& edge, const Point& foot, double distance) {
      if (!(distance < nearest && distance < (std::min)(0.8, 0.14 * (edge.reach - 1)) * radius)) return false;
      nearest = distance; // of equally near ones the first
      p = foot;
      return false;
    });
    return nearest < HUGE_VAL;
  }

private:
  struct Edge
  {
    Point source, target;
    Xyz_3 normal; ///< of the plane that bisects its angle
    Xyz_3 inward; ///< in that plane, away from the edge, between its sides
    double angle; ///< radians
    double reach;
    bool is_mirrored; ///< whether vertices beside it get twins
    std::array<int, 2> patches;
  };

  /// The mirror image of a point that lies so high above a plane.
  static Point mirrored(const Point& p, double height, const Xyz_3& normal)
  {
    return Point(p.x() - 2 * height * normal[0], p.y() - 2 * height * normal[1], p.z() - 2 * height * normal[2]);
  }

  /// Calls `visit(edge, its nearest point, distance)` for the edges that a ball mixes up the sides of, until it returns
  /// true.
  template <class Visit>
  void visit_near(const Point& center, double radius, const Visit& visit) const
  {
    if (edges_.empty()) return;
    const auto framed = boxes_.frame()(center.x(), center.y(), center.z());
    const std::array<float, 3> from{
        {static_cast<float>(framed[0]), static_cast<float>(framed[1]), static_cast<float>(framed[2])}};
    const double error = (1 + (std::max)({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])})) * 1e-6;
    const double reach = radius * largest_reach_ * boxes_.frame().scale * (1 + 1e-6) + error;
    const double largest = std::numeric_limits<float>::max();
    const auto limit = static_cast<float>((std::min)(largest, reach * reach * (1 + 1e-6)));
    boxes_.visit_nearest(from, limit, [&](std::uint32_t block, float bound) {
      for (std::uint32_t i = 4 * block; i < 4 * block + 4; ++i) {
        const std::uint32_t item = boxes_.items()[i];
        if (item == Box_hierarchy_3::nothing) break;
        const Edge& edge = edges_[item];
        const Point x = nearest_point_on_segment(center, edge.source, edge.target);
        const double distance = norm(difference(x, center));
        if (distance <= radius * edge.reach && visit(edge, x, distance)) return -1.f;
      }
      return bound;
    });
  }

  /// At a distance of d the sides are about d times the angle apart; a ball of half of that can't mix them up.
  static double reach_at(double angle) { return 1 + 2 / (std::max)(angle, 1e-4); }

  static Xyz_3 unit(const Xyz_3& a)
  {
    const double length = norm(a);
    return length > 0 ? Xyz_3{{a[0] / length, a[1] / length, a[2] / length}} : a;
  }

  std::vector<Edge> edges_;
  double largest_reach_ = 0;
  Box_hierarchy_3 boxes_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_ACUTE_EDGES_3_H
