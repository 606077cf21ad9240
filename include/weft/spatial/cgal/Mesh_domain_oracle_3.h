// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain oracle of any model of CGAL's MeshDomain_3 or MeshDomainWithFeatures_3 (Tournois 2009, sec. 4.2.1.3):
// implicit functions, labelled images, polyhedral domains and complexes, and those of users. Such a domain says in
// which subdomain a point lies and where a segment meets its surface; Domain_by_labels_3 derives the rest. Domains that
// show their triangles aren't asked: weft's hierarchy over these triangles gives the same answers, exactly, and the
// nearest point besides. Indices of subdomains, patches, curves and corners get numbers here, and come back when a C3t3
// is made.

#ifndef WEFT_SPATIAL_CGAL_MESH_DOMAIN_ORACLE_3_H
#define WEFT_SPATIAL_CGAL_MESH_DOMAIN_ORACLE_3_H

#include <weft/errors.h>
#include <weft/spatial/cgal/discretise_curve_3.h>
#include <weft/spatial/cgal/domain_triangles_3.h>
#include <weft/spatial/domain/Domain_by_labels_3.h>
#include <weft/spatial/domain/Patched_surface_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Whether a CGAL mesh domain has corners and curves.
template <class Domain, class = void>
struct Has_curves_3 : std::false_type
{};
template <class Domain>
struct Has_curves_3<Domain, std::void_t<typename Domain::Has_features>>
    : std::is_same<typename Domain::Has_features, CGAL::Tag_true>
{};

/// Numbers for indices, from `first` on in the order in which they are met.
template <class Index>
class Index_numbers
{
public:
  explicit Index_numbers(int first) : first_(first) {}

  int number(const Index& index)
  {
    const auto [at, is_new] = numbers_.try_emplace(index, static_cast<int>(indices_.size()) + first_);
    if (is_new) indices_.push_back(index);
    return at->second;
  }
  const Index& index(int number) const { return indices_[static_cast<std::size_t>(number - first_)]; }
  int size() const { return static_cast<int>(indices_.size()); }

private:
  int first_;
  std::map<Index, int> numbers_;
  std::vector<Index> indices_;
};

/// A number for an absent curve or corner type.
template <class Domain, bool has_curves = Has_curves_3<Domain>::value>
struct Curve_indices_3
{
  using Corner = int;
  using Curve = int;
};
template <class Domain>
struct Curve_indices_3<Domain, true>
{
  using Corner = typename Domain::Corner_index;
  using Curve = typename Domain::Curve_index;
};

} // namespace internal

/// A CGAL mesh domain as a domain oracle.
/// \tparam Domain models MeshDomain_3 or MeshDomainWithFeatures_3, with points of a kernel whose coordinates are
///         doubles. It is called by one thread.
template <class Domain>
class Mesh_domain_oracle_3 : public Domain_by_labels_3<Mesh_domain_oracle_3<Domain>, typename Domain::R>
{
  using Base = Domain_by_labels_3<Mesh_domain_oracle_3<Domain>, typename Domain::R>;
  using Names = internal::Curve_indices_3<Domain>;

public:
  using Kernel = typename Domain::R;
  using Point = typename Kernel::Point_3;
  static constexpr bool is_thread_safe = false;

  /// \param domain has to live as long as this object.
  /// \param seed_grid number of parts of the bounding box's longest side on which the boundary is looked for, besides
  ///        the initial points that the domain itself gives.
  /// \throws Domain_error if no point of the boundary is found, and if a polyhedral domain has surfaces with the same
  ///         subdomain on both sides: a mesh's facets lie between subdomains.
  explicit Mesh_domain_oracle_3(const Domain& domain, int seed_grid = 30)
      : Base(enlarged(domain.bbox())), domain_(&domain)
  {
    take_features();
    if (take_triangles()) return;
    Base::find_seeds(coarse_grid);
    is_precise_ = intersections_are_precise();
    Base::find_seeds(seed_grid);
    if (patches_.size() == 0) Base::find_seeds(fine_grid);
    // Not before: CGAL's own domains look for initial points until they have found them, in empty ones for ever.
    if (patches_.size() > 0) Base::add_seeds(initial_points());
    if (patches_.size() == 0)
      throw Domain_error("no point of the boundary was found: the domain is empty or too small", {}, {});
  }

  explicit Mesh_domain_oracle_3(const Domain&& temporary, int seed_grid = 30) = delete;

  int label(const Point& p) const { return has_triangles_ ? surface_.subdomain(p) : label_by_domain(p); }

  /// Where the domain says, if that is where labels change; else by bisection.
  Surface_hit_3<Kernel> crossing(const Point& p, const Point& q, int at_p, int at_q) const
  {
    if (has_triangles_) {
      thread_local std::vector<Surface_hit_3<Kernel>> hits;
      hits.clear();
      surface_.intersect(p, q, hits);
      if (!hits.empty()) return hits.front();
    } else if (is_precise_ && Base::is_in_box(p) && Base::is_in_box(q)) {
      Surface_hit_3<Kernel> hit{p, -1};
      if (intersection(p, q, hit)) return hit;
    }
    return Base::crossing(p, q, at_p, at_q);
  }

  Surface_hit_3<Kernel> closest(const Point& p) const
  {
    return has_triangles_ ? surface_.nearest(p) : Base::closest(p);
  }
  Surface_hit_3<Kernel> project_on_patch(const Point& p, int patch) const
  {
    return has_triangles_ ? surface_.nearest_on_patch(p, patch) : Base::project_on_patch(p, patch);
  }
  bool is_within(const Point& p, double squared_distance) const
  {
    return has_triangles_ ? surface_.is_within(p, squared_distance) : Base::is_within(p, squared_distance);
  }
  bool is_clear(const Point& p, double radius) const
  {
    return has_triangles_ ? surface_.clearance(p) >= radius : Base::is_clear(p, radius);
  }

  // Where segments are exact and points dear to locate, as in polyhedral domains, labels aren't asked for.
  int side(const Point& p) const { return is_precise_ ? 0 : Base::side(p); }
  bool meets(const Point& p, int at_p, const Point& q) const
  {
    if (!is_precise_) return Base::meets(p, at_p, q);
    Surface_hit_3<Kernel> hit{p, -1};
    return intersection(p, q, hit);
  }
  bool first_hit(const Point& p, int at_p, const Point& q, Surface_hit_3<Kernel>& hit) const
  {
    if (!is_precise_) return Base::first_hit(p, at_p, q, hit);
    return intersection(p, q, hit);
  }

  /// The patch that the domain sees between two points; where it sees none, the one seen last between such subdomains.
  int patch(int from, int to, const Point& a, const Point& b) const
  {
    const auto key = std::minmax(from, to);
    Surface_hit_3<Kernel> hit{a, -1};
    if (intersection(a, b, hit)) return last_patch_[key] = hit.patch;
    const auto last = last_patch_.find(key);
    if (last != last_patch_.end()) return last->second;
    return patches_.number(typename Domain::Surface_patch_index());
  }

  /// As many as were met so far.
  int number_of_patches() const { return patches_.size(); }

  // ---- what the domain calls things

  const Domain& domain() const { return *domain_; }
  typename Domain::Subdomain_index subdomain_index(int label) const { return subdomains_.index(label); }
  typename Domain::Surface_patch_index surface_patch_index(int patch) const { return patches_.index(patch); }
  const typename Names::Curve& curve_index(int crease) const { return curves_[static_cast<std::size_t>(crease)]; }
  const typename Names::Corner& corner_index(int corner) const { return corners_[static_cast<std::size_t>(corner)]; }

  /// The index of a vertex at a location.
  typename Domain::Index index(const Vertex_location_3& at) const
  {
    if constexpr (internal::Has_curves_3<Domain>::value) {
      if (at.dimension == 0) return domain_->index_from_corner_index(corner_index(at.index));
      if (at.dimension == 1) return domain_->index_from_curve_index(curve_index(at.index));
    }
    return at.dimension == 2 ? domain_->index_from_surface_patch_index(surface_patch_index(at.index))
                             : domain_->index_from_subdomain_index(subdomain_index(at.index));
  }

private:
  using Segment = typename Kernel::Segment_3;

  /// Domains that fill their box touch it.
  static CGAL::Bbox_3 enlarged(const CGAL::Bbox_3& b)
  {
    const double by = 1e-3 * (std::max)({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
    return CGAL::Bbox_3(b.xmin() - by, b.ymin() - by, b.zmin() - by, b.xmax() + by, b.ymax() + by, b.zmax() + by);
  }

  void take_features()
  {
    if constexpr (internal::Has_curves_3<Domain>::value) {
      std::vector<std::pair<typename Domain::Corner_index, Point>> corners;
      domain_->get_corners(std::back_inserter(corners));
      std::vector<Point> points;
      for (const auto& [index, point] : corners) {
        corners_.push_back(index);
        points.push_back(point);
      }
      using End = std::pair<Point, typename Domain::Index>;
      std::vector<std::tuple<typename Domain::Curve_index, End, End>> curves;
      domain_->get_curves(std::back_inserter(curves));
      std::vector<Crease_polyline_3<Kernel>> creases;
      for (const auto& [index, source, target] : curves) {
        curves_.push_back(index);
        creases.push_back(internal::discretise_curve_3<Kernel>(*domain_, index, source.first, target.first));
        if (std::find(points.begin(), points.end(), source.first) != points.end() && creases.back().closed) {
          creases.back().closed = false; // a loop at a corner
          creases.back().points.push_back(source.first);
        }
      }
      Base::set_creases(Crease_network_3<Kernel>(std::move(points), std::move(creases)));
    }
  }

  int label_by_domain(const Point& p) const
  {
    const auto subdomain = domain_->is_in_domain_object()(p);
    return subdomain ? subdomains_.number(*subdomain) : 0;
  }

  /// Takes the domain's triangles, if it shows them and means by them what they say. Whether it does.
  bool take_triangles()
  {
    if constexpr (internal::Has_triangles_3<Domain>::value) {
      const auto triangles = internal::domain_triangles_3(
          *domain_, [&](const auto& patch) { return patches_.number(patch); },
          [&](const auto& subdomain) { return subdomains_.number(subdomain); });
      const auto n = static_cast<std::size_t>(patches_.size());
      surface_ = internal::Patched_surface_3<Kernel>(triangles, n);
      has_triangles_ = !triangles.empty() && agrees_with_domain(triangles);
      if (!has_triangles_) return false;
      if (const std::size_t all = domain_->aabb_tree().size(); all > triangles.size())
        throw Domain_error(std::to_string(all - triangles.size()) + " of the domain's " + std::to_string(all) +
                               " triangles have the same subdomain on both sides: a mesh has no facets there",
                           {}, {});
      Base::set_seeds(internal::triangle_seeds_3<Kernel>(triangles, n));
    }
    return has_triangles_;
  }

  /// Whether the domain gives the same labels beside some of its triangles as those do, and meets them: a class derived
  /// from one of CGAL's may mean something else by its triangles, and an open surface has no sides.
  bool agrees_with_domain(const std::vector<internal::Surface_triangle_3<Kernel>>& triangles) const
  {
    constexpr std::size_t samples = 300;
    const std::size_t step = (triangles.size() + samples - 1) / samples;
    const double squared_precision = 1e-18 * Base::diagonal() * Base::diagonal();
    for (std::size_t t = 0; t < triangles.size(); t += step) {
      const auto& [a, b, c] = triangles[t].points;
      const internal::Xyz_3 normal = internal::cross_product(internal::minus(internal::xyz(b), internal::xyz(a)),
                                                             internal::minus(internal::xyz(c), internal::xyz(a)));
      const double area = internal::norm(normal), length = 0.007 * std::sqrt(area);
      if (!(area > 0)) continue;
      const Point center((a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3, (a.z() + b.z() + c.z()) / 3);
      const std::array<Point, 2> sides{Base::moved(center, normal, length / area),
                                       Base::moved(center, normal, -length / area)};
      for (const Point& p : sides)
        if (surface_.subdomain(p) != label_by_domain(p) && !surface_.is_within(p, squared_precision)) return false;
      Surface_hit_3<Kernel> hit{center, -1};
      if (!intersection(sides[0], sides[1], hit)) return false;
      if (!surface_.is_within(hit.point, squared_precision)) return false;
    }
    return true;
  }

  std::vector<Surface_hit_3<Kernel>> initial_points() const
  {
    std::vector<std::pair<Point, typename Domain::Index>> points;
    domain_->construct_initial_points_object()(std::back_inserter(points), number_of_initial_points);
    std::vector<Surface_hit_3<Kernel>> hits;
    for (const auto& [point, index] : points)
      hits.push_back({point, patches_.number(domain_->surface_patch_index(index))});
    return hits;
  }

  /// Whether labels change at the points that the domain gives for segments that end behind points of its boundary.
  bool intersections_are_precise() const
  {
    const CGAL::Bbox_3 b = Base::bbox();
    const Point outside(b.xmin(), b.ymin(), b.zmin());
    bool known = false;
    for (int patch = 0; patch < patches_.size(); ++patch)
      for (const auto& seed : Base::patch_seeds(patch, 20)) {
        const Point beyond = Base::between(outside, seed.point, 1.01);
        Surface_hit_3<Kernel> hit{beyond, -1};
        if (!intersection(outside, beyond, hit)) continue;
        const double step = 1e-7 * Base::diagonal() / Base::distance(outside, beyond);
        const auto at = [&](double shift) {
          return Point(hit.point.x() + shift * (beyond.x() - outside.x()),
                       hit.point.y() + shift * (beyond.y() - outside.y()),
                       hit.point.z() + shift * (beyond.z() - outside.z()));
        };
        if (Base::subdomain(at(-step)) == Base::subdomain(at(step))) return false;
        known = true;
      }
    return known;
  }

  /// Where the domain says that a segment meets its surface; whether it says so.
  bool intersection(const Point& p, const Point& q, Surface_hit_3<Kernel>& hit) const
  {
    if (p == q) return false; // CGAL's domains want none of those
    const auto [point, index, dimension] = domain_->construct_intersection_object()(Segment(p, q));
    if (dimension == 0) return false;
    hit = {point, patches_.number(domain_->surface_patch_index(index))};
    return true;
  }

  static constexpr int coarse_grid = 8, fine_grid = 100;
  static constexpr int number_of_initial_points = 20; ///< what CGAL asks for

  const Domain* domain_;
  bool is_precise_ = false;
  internal::Patched_surface_3<Kernel> surface_; ///< of the domain's own triangles
  bool has_triangles_ = false;
  mutable internal::Index_numbers<typename Domain::Subdomain_index> subdomains_{1};
  mutable internal::Index_numbers<typename Domain::Surface_patch_index> patches_{0};
  mutable std::map<std::pair<int, int>, int> last_patch_; ///< by subdomains
  std::vector<typename Names::Curve> curves_;
  std::vector<typename Names::Corner> corners_;
};

} // namespace weft

#endif // WEFT_SPATIAL_CGAL_MESH_DOMAIN_ORACLE_3_H
