// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain oracle of a triangle surface, closed or the boundary of several subdomains (Tournois 2009, sec. 3.3.1):
// all that meshing asks about a domain. On which side of the boundary a point lies, where a segment meets the boundary,
// where a Voronoi facet meets the creases, and the nearest point on the boundary, a patch or a crease. Which side and
// which triangle are decided by exact predicates, rays and segments that graze an edge or a vertex included; the points
// are rounded to doubles and lie on the boundary up to that rounding.
//
// The hierarchies of boxes are weft's own because queries are most of the time of a mesher, and CGAL's AABB tree takes
// several times as long (benchmark/oracle_throughput). Floats and SSE2 rule out nearly everything; few triangles of a
// query reach doubles or an exact predicate.

#ifndef WEFT_SPATIAL_DOMAIN_POLYHEDRAL_ORACLE_3_H
#define WEFT_SPATIAL_DOMAIN_POLYHEDRAL_ORACLE_3_H

#include <weft/errors.h>
#include <weft/spatial/domain/Acute_edges_3.h>
#include <weft/spatial/domain/Crease_network_3.h>
#include <weft/spatial/domain/Domain_shape_3.h>
#include <weft/spatial/domain/facing_points_3.h>
#include <weft/spatial/domain/Mirror_images_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/domain/Patched_surface_3.h>
#include <weft/spatial/domain/Salient_features_3.h>
#include <weft/spatial/domain/sheet_pairs_3.h>
#include <weft/spatial/domain/surface_samples_3.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// The domain that a piecewise smooth complex bounds, ready for queries. All queries may be asked by several threads at
/// once.
/// \tparam K a CGAL kernel with exact predicates whose coordinates are doubles, such as
///           CGAL::Exact_predicates_inexact_constructions_kernel.
template <class K>
class Polyhedral_oracle_3
{
  static_assert(std::is_same<typename K::FT, double>::value,
                "weft: spatial meshes need a kernel with exact predicates and coordinates of type double, such as "
                "CGAL::Exact_predicates_inexact_constructions_kernel");

public:
  using Kernel = K;
  using Point = typename K::Point_3;

  /// Whether several threads may ask at once.
  static constexpr bool is_thread_safe = true;
  /// Whether locating points is cheaper than finding out from segments where the boundary lies between them.
  static constexpr bool labels_first = false;

  /// O(n log n) for n triangles.
  /// \pre The triangles form closed oriented surfaces without self-intersections; `piecewise_smooth_complex()` checks.
  /// \throws Domain_error with 2^30 or more points or triangles.
  /// \param creases_force_cells whether creases that meet at small angles excuse the shapes of cells between them.
  explicit Polyhedral_oracle_3(Piecewise_smooth_complex_3<K> complex, bool creases_force_cells = true)
      : complex_(std::move(complex)), creases_force_cells_(creases_force_cells)
  {
    constexpr std::size_t limit = std::size_t(1) << 30;
    if (complex_.triangles.size() >= limit || complex_.points.size() >= limit)
      throw Domain_error("a surface of 2^30 or more points or triangles", {}, {});
    surface_ = internal::patched_surface_of(complex_);
    build_creases();
    const auto pairs = internal::sheet_pairs_3(complex_, acute_angle * internal::radians_per_degree);
    acute_edges_ = internal::Acute_edges_3<K>(complex_, pairs);
    mirror_images_ = internal::Mirror_images_3<K>(complex_, pairs, acute_angle);
    find_gaps();
    salient_ = internal::Salient_features_3<K>(complex_, {fold_angle, ridge_angle, sharp_angle, 180 - acute_angle});
  }

  /// From a surface, by `piecewise_smooth_complex(surface, options)`.
  /// \throws what that function throws.
  template <class Surface, class Options>
  Polyhedral_oracle_3(const Surface& surface, const Options& options)
      : Polyhedral_oracle_3(Piecewise_smooth_complex_3<K>(piecewise_smooth_complex(surface, options)))
  {}

  const Piecewise_smooth_complex_3<K>& complex() const { return complex_; }

  /// Which creases and patches meet. Linear in the size of the complex, but for a factor log(number of sharp edges).
  Feature_incidence_3 incidence() const { return Feature_incidence_3(complex_); }

  /// Unit normal of a triangle that a query has hit, pointing out of a subdomain; zero if that doesn't lie beside it,
  /// or the triangle has no area.
  std::array<double, 3> normal(int triangle, int subdomain) const
  {
    return internal::triangle_normal(complex_, triangle, subdomain);
  }

  /// Bounding box of the boundary.
  CGAL::Bbox_3 bbox() const { return surface_.bbox(); }

  /// The subdomain, 1 where there is but one; 0 outside and exactly on the boundary. Exact.
  int subdomain(const Point& p) const { return surface_.subdomain(p); }

  /// Finds what the closed segment pq has in common with the boundary: appends each crossing and each touching of a
  /// triangle, an edge or a vertex once, in order from p to q, ties by coordinates. Where the segment runs within a
  /// triangle the ends of the piece are reported. On an edge or a vertex, the patch is that of the incident triangle
  /// with the smallest index.
  /// \returns the exclusive or of the subdomains of p and q, 0 if they are the same: `subdomain(p) ^ subdomain(q)`,
  /// always.
  int intersect(const Point& p, const Point& q, std::vector<Surface_hit_3<K>>& hits) const
  {
    return surface_.intersect(p, q, hits);
  }

  /// Whether the closed segment pq and the boundary have a point in common.
  bool meets(const Point& p, const Point& q) const { return surface_.meets(p, q); }

  /// Nearest point of the boundary.
  Surface_hit_3<K> closest(const Point& p) const { return surface_.nearest(p); }

  /// Whether the boundary comes as near to p as that.
  bool is_within(const Point& p, double squared_distance) const { return surface_.is_within(p, squared_distance); }

  /// Nearest point of a patch.
  Surface_hit_3<K> project_on_patch(const Point& p, int patch) const { return surface_.nearest_on_patch(p, patch); }

  /// Nearest point of a crease.
  Point project_on_crease(const Point& p, int crease) const { return creases_.project_on_crease(p, crease); }

  /// Radius of a ball around p that the boundary doesn't enter: the distance to the boundary less a few 1e-6 of the
  /// bounding box's longest side, and 0 where nothing is left.
  double clearance(const Point& p) const { return surface_.clearance(p); }
  /// Whether the boundary keeps that distance from p.
  bool is_clear(const Point& p, double radius) const { return clearance(p) >= radius; }

  /// Where creases cross a Voronoi facet, see Crease_network_3.
  void intersect_creases(const Point& a, const Point& b, const std::vector<Point>& polygon,
                         std::vector<Crease_hit_3<K>>& hits) const
  {
    creases_.intersect_creases(a, b, polygon, hits);
  }

  /// Moves a point of a patch to where the surface bends most within reach: the nearest vertex at the end of a fold,
  /// else the nearest point of a fold. Returns whether there was one. See Salient_features_3.h.
  bool attract(Point& p, double vertex_reach, double fold_reach, int patch) const
  {
    return salient_.attract(p, vertex_reach, fold_reach, patch);
  }

  /// Calls `visit(point, whether vertices there are welcome)` for each vertex at the end of a fold in a ball around a
  /// point of a patch.
  template <class Visit>
  void visit_salient_points(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    salient_.visit_vertices(center, squared_radius, patch, visit);
  }

  /// Calls `visit(source, target, whether vertices on it are welcome)` for each ridge that meets a ball around a point
  /// of a patch.
  template <class Visit>
  void visit_ridges(const Point& center, double squared_radius, int patch, const Visit& visit) const
  {
    salient_.visit_ridges(center, squared_radius, patch, visit);
  }

  /// Whether a ball mixes up the two sides of an edge of the surface whose dihedral angle is acute, inside or outside.
  /// See Acute_edges_3.h.
  bool is_at_acute_edge(const Point& center, double radius) const { return acute_edges_.is_near(center, radius); }

  /// The smallest angle of the acute edges that a ball mixes up the sides of, in degrees; 180 if there is none.
  double acute_angle_at(const Point& center, double radius) const { return acute_edges_.angle_near(center, radius); }

  /// The mirror image of a point of the boundary on the other side of the acute edge nearest to the center of a ball,
  /// if the ball mixes up the sides of that edge and its center lies on the other side. Returns whether that is so and
  /// the boundary is there, up to a quarter of the distance between the sides.
  bool mirror_at_acute_edge(const Point& p, const Point& center, double radius, Surface_hit_3<K>& image) const
  {
    Point mirrored;
    if (!acute_edges_.mirror(p, center, radius, mirrored)) return false;
    image = closest(mirrored);
    return CGAL::squared_distance(image.point, mirrored) < 0.0625 * CGAL::squared_distance(p, mirrored);
  }

  /// Moves the center of a ball to the nearest point of an acute edge, marked or not, if that is near. Returns whether
  /// it is.
  bool attract_to_acute_edge(Point& p, double radius) const { return acute_edges_.attract(p, radius); }

  /// Whether parts of the boundary meet at small angles, or face each other across a narrow gap.
  bool has_mirror_images() const { return !mirror_images_.empty(); }

  /// Calls `visit(image, where it lies)` for the places where a vertex of the boundary wants a twin: its mirror images
  /// in the planes that bisect acute edges, the points that face it across a gap, and the points of creases that are as
  /// far from a feature vertex as the vertex, where creases meet at a small angle. Only those nearer to the vertex than
  /// `spacing`, its distance to the nearest other vertex. An image within a quarter of the distance to the vertex from
  /// a crease lies on the crease; one as near to a feature vertex isn't needed, and one as far from the boundary
  /// doesn't exist. Images are off the boundary by up to 1e-11 of its largest coordinate, at random.
  template <class Visit>
  void visit_mirror_images(const Point& p, const Vertex_location_3& at, double spacing, const Visit& visit) const
  {
    mirror_images_.visit(
        surface_, creases_, acute_edges_, p, at, spacing,
        [this](const Point& of, int patch, double reach) {
          return internal::facing_point(complex_, surface_, of, project_on_patch(of, patch).triangle,
                                        (std::min)(reach, internal::widest_gap(bbox())));
        },
        visit);
  }

  /// Whether creases that meet at small angles excuse the shapes of cells between them.
  bool creases_force_cells() const { return creases_force_cells_; }

  /// Calls `visit(crease, angle in radians)` for the creases that meet a crease at a small angle.
  template <class Visit>
  void visit_creases_at_small_angles(int crease, const Visit& visit) const
  {
    mirror_images_.visit_creases_at_small_angles(crease, visit);
  }

  /// Vertices that every mesh has to keep.
  std::size_t number_of_corners() const { return creases_.number_of_corners(); }
  const Point& corner(std::size_t i) const { return creases_.corner(i); }

  std::size_t number_of_creases() const { return creases_.number_of_creases(); }
  /// The vertices of a crease in order; a closed one doesn't repeat the first.
  std::vector<Point> crease_points(int i) const { return creases_.crease_points(i); }
  bool crease_is_closed(int i) const { return creases_.crease_is_closed(i); }

  int number_of_patches() const { return complex_.number_of_patches; }
  /// Whether a mesh that lacks a patch lacks something.
  bool is_expected(int) const { return true; }

  /// n well-spread points of a patch, off creases and feature vertices: the same ones each time. Fewer only where
  /// doubles have fewer points. O(n triangles).
  std::vector<Surface_hit_3<K>> patch_seeds(int patch, std::size_t n) const
  {
    return internal::spread_seeds(complex_, n, [&](std::size_t t) { return complex_.patches[t] == patch; });
  }

  /// The same for a connected component of the boundary.
  std::vector<Surface_hit_3<K>> shell_seeds(int shell, std::size_t n) const
  {
    return internal::spread_seeds(complex_, n, [&](std::size_t t) { return complex_.shells[t] == shell; });
  }

  /// Volumes, areas, components and Euler characteristics of the subdomains. O(n log n).
  Domain_shape_3 shape() const
  {
    std::vector<internal::Boundary_facet_3> boundaries;
    for (std::size_t t = 0; t < complex_.triangles.size(); ++t) {
      const auto& v = complex_.triangles[t];
      const auto [behind, before] = sides(t);
      if (behind != 0) boundaries.push_back({behind, v});
      if (before != 0) boundaries.push_back({before, {v[0], v[2], v[1]}});
    }
    return internal::shape_of_boundaries(complex_.points, boundaries);
  }

  /// Calls `visit(point, patch, unit normal)` for points of the boundary no farther apart than about that: the corners
  /// of triangles and points between them, up to a million a triangle; of triangles that are small beside the spacing
  /// one in each cube of that grid that looks the same way. Normals point out of the domain, and between two subdomains
  /// out of the one with the smaller number. O(n + samples).
  template <class Visit>
  void visit_samples(double spacing, const Visit& visit) const
  {
    internal::visit_boundary_grid(complex_, spacing, visit);
  }

  /// Calls `visit(point, unit normal, area)` for n points of the boundary, each of which stands for the same area.
  /// O(triangles).
  template <class Visit>
  void visit_spread_points(std::size_t n, const Visit& visit) const
  {
    internal::visit_equal_areas(complex_, n, visit);
  }

  /// Distance from a point of the boundary to where the boundary is met again along a normal, on either side; at most
  /// `reach`, which it is for a zero normal.
  double thickness(const Point& p, const std::array<double, 3>& normal, double reach) const
  {
    return internal::thickness_along(surface_, p, internal::Xyz_3{normal}, reach);
  }

private:
  // Degrees. Flatter folds attract to fewer vertices. Measuring ridges alone instead of all folds saves time on dense
  // models, and vertices.
  static constexpr double fold_angle = 5, ridge_angle = 30, sharp_angle = 75;

  static constexpr double acute_angle = 60; // degrees; from there on refinement ends by itself

  std::pair<int, int> sides(std::size_t t) const { return internal::sides_of_triangle(complex_, t); }

  void build_creases()
  {
    std::vector<Point> corners;
    for (const auto& feature : complex_.features) corners.push_back(complex_.points[feature.vertex]);
    std::vector<Crease_polyline_3<K>> creases;
    for (const auto& crease : complex_.creases) {
      creases.push_back({{}, crease.closed});
      for (const std::size_t v : crease.vertices) creases.back().points.push_back(complex_.points[v]);
    }
    creases_ = Crease_network_3<K>(std::move(corners), std::move(creases));
  }

  /// Narrow gaps that are big enough for a sample count.
  void find_gaps()
  {
    constexpr std::size_t samples = 1000;
    const double widest = internal::widest_gap(bbox());
    bool has_gaps = false;
    visit_spread_points(samples, [&](const Point& p, const auto&, double) {
      has_gaps = has_gaps || internal::facing_point(complex_, surface_, p, closest(p).triangle, widest).has_value();
    });
    if (has_gaps) mirror_images_.add_gaps();
  }

  Piecewise_smooth_complex_3<K> complex_;
  internal::Patched_surface_3<K> surface_;
  Crease_network_3<K> creases_;
  internal::Salient_features_3<K> salient_;
  internal::Acute_edges_3<K> acute_edges_;
  internal::Mirror_images_3<K> mirror_images_;
  bool creases_force_cells_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_POLYHEDRAL_ORACLE_3_H
