// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices of the boundary want twins, so that parts of it which are near to each other have facets of their
// own: beside acute edges, at feature vertices where creases meet at small angles, and across narrow gaps. See
// Mirror_twins_3.h.

#ifndef WEFT_SPATIAL_DOMAIN_MIRROR_IMAGES_3_H
#define WEFT_SPATIAL_DOMAIN_MIRROR_IMAGES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Segment_hierarchy_3.h>
#include <weft/spatial/domain/Acute_edges_3.h>
#include <weft/spatial/domain/Crease_network_3.h>
#include <weft/spatial/domain/Crease_shells_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/domain/Patched_surface_3.h>
#include <weft/spatial/domain/sheet_pairs_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace weft::internal {

/// \tparam K a CGAL kernel.
template <class K>
class Mirror_images_3
{
public:
  using Point = typename K::Point_3;

  Mirror_images_3() = default;

  /// O(n log n) for n triangles. Of gaps it knows nothing yet.
  /// \param pairs those of the acute edges.
  /// \param acute_angle that they meet at less than, in degrees.
  Mirror_images_3(const Piecewise_smooth_complex_3<K>& complex, const std::vector<Sheet_pair_3>& pairs,
                  double acute_angle)
      : has_acute_edges_(!pairs.empty())
  {
    std::vector<char> is_at_acute_edge(complex.points.size(), false);
    for (const Sheet_pair_3& pair : pairs) is_at_acute_edge[pair.source] = is_at_acute_edge[pair.target] = true;
    for (const Point& p : complex.points)
      largest_coordinate_ = (std::max)({largest_coordinate_, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    shells_ = Crease_shells_3<K>(complex, [&](std::size_t vertex) {
      return radians_per_degree * (is_at_acute_edge[vertex] ? acute_angle : shell_angle);
    });
    std::vector<Crease_segment_3<K>> corners;
    for (const auto& feature : complex.features) {
      const Point& p = complex.points[feature.vertex];
      corners.push_back({p, p, static_cast<int>(corners.size())});
    }
    corners_ = Segment_hierarchy_3<K>(corners);
    has_corners_ = !corners.empty();
  }

  /// Vertices of patches may have images across gaps, too.
  void add_gaps() { has_gaps_ = true; }

  bool empty() const { return !has_acute_edges_ && shells_.empty() && !has_gaps_; }

  /// Calls `visit(image, where it lies)` as Polyhedral_oracle_3::visit_mirror_images() says.
  /// \param facing_point called with a point, its patch and a distance: the point across a gap that is nearer, if any.
  template <class Facing_point, class Visit>
  void visit(const Patched_surface_3<K>& surface, const Crease_network_3<K>& creases,
             const Acute_edges_3<K>& acute_edges, const Point& p, const Vertex_location_3& at, double spacing,
             const Facing_point& facing_point, const Visit& visit) const
  {
    const auto take = [&](const Point& image, const Vertex_location_3& location) {
      visit(off_symmetry(image, p), location);
    };
    if (at.dimension == 1) {
      const auto points_of = [&creases](int crease) -> const std::vector<Point>& {
        return creases.crease_points(crease);
      };
      shells_.visit_images(p, at.index, spacing, points_of, [&](const Point& image, int crease) {
        take(image, {1, crease});
      });
    }
    const auto take_near = [&](const Point& image) {
      const double near = 0.0625 * CGAL::squared_distance(p, image);
      int corner = -1, crease = -1;
      if (has_corners_ && CGAL::squared_distance(corners_.nearest(image, corner), image) < near) return;
      const Point on_crease = creases.project(image, crease);
      if (crease >= 0 && CGAL::squared_distance(on_crease, image) < near) {
        take(on_crease, {1, crease});
        return;
      }
      const Surface_hit_3<K> hit = surface.nearest(image);
      if (CGAL::squared_distance(hit.point, image) < near) take(hit.point, {2, hit.patch});
    };
    acute_edges.visit_images(p, at.dimension == 2 ? at.index : -1, spacing, take_near);
    if (has_gaps_ && at.dimension == 2)
      if (const auto facing = facing_point(p, at.index, spacing)) take_near(*facing);
  }

  /// Calls `visit(crease, angle in radians)` for the creases that meet a crease at a small angle.
  template <class Visit>
  void visit_creases_at_small_angles(int crease, const Visit& visit) const
  {
    shells_.visit_neighbours(crease, visit);
  }

private:
  static constexpr double shell_angle = 29; ///< degrees; from there on refinement ends by itself between two creases

  /// Two triangles that are mirror images of each other have their six vertices on a sphere, and with rounding alone to
  /// decide, the Delaunay triangulation has flat cells among them, of two vertices and their images. A distance from
  /// the sphere that is much larger than rounding, and toward the original, so that it leaves those four in a plane,
  /// leaves none: the ball of four points that are off a common circle, but hardly off a plane, is huge. That is what
  /// weights would do.
  /// \returns the image moved by a random part of 1e-11 of the largest coordinate either way.
  Point off_symmetry(const Point& image, const Point& original) const
  {
    std::uint64_t hash = 0; // of the image, in units of a power of two: scaling by another changes nothing
    for (const double x : {image.x(), image.y(), image.z()}) {
      const double scaled = std::scalbn(x, -std::ilogb(largest_coordinate_));
      std::uint64_t bits = 0;
      std::memcpy(&bits, &scaled, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 29;
      hash *= 0xbf58476d1ce4e5b9;
      hash ^= hash >> 32;
    }
    const double shift = 1e-11 * largest_coordinate_ * (2 * static_cast<double>(hash >> 11) * 0x1p-53 - 1);
    const Xyz_3 to = unit_vector(minus(xyz(original), xyz(image)));
    return Point(image.x() + shift * to[0], image.y() + shift * to[1], image.z() + shift * to[2]);
  }

  bool has_acute_edges_ = false, has_corners_ = false;
  bool has_gaps_ = false; ///< narrow ones outside, between parts of the boundary that face each other
  Crease_shells_3<K> shells_;
  Segment_hierarchy_3<K> corners_; ///< feature vertices as segments
  double largest_coordinate_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_MIRROR_IMAGES_3_H
