// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domain oracles that know a domain by the subdomain of every point: implicit functions, labelled images, CGAL's mesh
// domains (Tournois 2009, sec. 3.3.1 and 4.2.1.3). What an oracle is asked beyond that is worked out here by looking
// at labels along segments: where the boundary is crossed, its nearest point, and points to start from. Patches are the
// interfaces between two subdomains, the outside being one of them.
//
// A segment meets the boundary where its ends have different labels, once: what is thinner than the Voronoi edges of a
// mesh escapes that mesh, as in every mesher that sees a domain through labels.

#ifndef WEFT_SPATIAL_DOMAIN_DOMAIN_BY_LABELS_3_H
#define WEFT_SPATIAL_DOMAIN_DOMAIN_BY_LABELS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/Crease_network_3.h>
#include <weft/spatial/domain/interface_seeds_3.h>
#include <weft/spatial/domain/No_folds_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft {

/// Base of such oracles.
/// \tparam Derived has `label(point)`, 0 for the outside, called only within the bounding box, and
///         `patch(from, to, a, b)`, the number of the patch between the points a and b, which are very near to each
///         other and have the labels `from` and `to`. It calls `find_seeds()` when it is ready.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class Derived, class K>
class Domain_by_labels_3 : public No_folds_3<K>
{
public:
  using Kernel = K;
  using Point = typename K::Point_3;

  /// Locating a point is what everything else consists of.
  static constexpr bool labels_first = true;

  /// \param bbox what is outside of it lies outside of the domain.
  explicit Domain_by_labels_3(const CGAL::Bbox_3& bbox, Crease_network_3<K> creases = {})
      : bbox_(bbox),
        diagonal_(std::hypot(bbox.xmax() - bbox.xmin(), bbox.ymax() - bbox.ymin(), bbox.zmax() - bbox.zmin())),
        creases_(std::move(creases))
  {}

  const CGAL::Bbox_3& bbox() const { return bbox_; }

  /// The subdomain that a point lies in; 0 outside.
  int subdomain(const Point& p) const { return is_in_box(p) ? derived().label(p) : 0; }

  /// Appends one change of label between p and q, the same in either direction; none if their labels are the same.
  /// Returns their exclusive or.
  /// \param at_p,at_q the labels of the ends.
  int intersect(const Point& p, const Point& q, int at_p, int at_q, std::vector<Surface_hit_3<K>>& hits) const
  {
    if (at_p == at_q) return 0;
    hits.push_back(p < q ? derived().crossing(p, q, at_p, at_q) : derived().crossing(q, p, at_q, at_p));
    return at_p ^ at_q;
  }
  int intersect(const Point& p, const Point& q, std::vector<Surface_hit_3<K>>& hits) const
  {
    return intersect(p, q, subdomain(p), subdomain(q), hits);
  }

  /// The first change of label from p to q by bisection.
  /// \pre The labels of the ends differ.
  Surface_hit_3<K> crossing(Point p, Point q, int at_p, int at_q) const
  {
    for (int k = 0; k < most_bisections && distance(p, q) > precision * diagonal_; ++k) {
      const Point middle = between(p, q, 0.5);
      const int label = subdomain(middle);
      if (label == at_p) {
        p = middle;
      } else {
        q = middle;
        at_q = label;
      }
    }
    return {between(p, q, 0.5), derived().patch(at_p, at_q, p, q)};
  }

  /// A point of the boundary that is about the nearest; its patch is -1 if none was found. See `project()`.
  Surface_hit_3<K> closest(const Point& p) const { return project(p, any_patch); }

  /// The same for a patch.
  Surface_hit_3<K> project_on_patch(const Point& p, int patch) const { return project(p, patch); }

  /// Whether the boundary comes as near to p as that; if only just, that may escape.
  bool is_within(const Point& p, double squared_distance) const
  {
    const auto label = derived().side(p);
    const double radius = std::sqrt(squared_distance);
    for (const auto& d : directions)
      if (derived().meets(p, label, moved(p, d, radius))) return true;
    const Surface_hit_3<K> hit = closest(p);
    return hit.patch >= 0 && distance(p, hit.point) <= radius;
  }

  /// Whether the boundary keeps that distance from p, as far as labels around tell.
  bool is_clear(const Point& p, double radius) const
  {
    const int label = subdomain(p);
    for (const double r : {radius, 0.5 * radius})
      for (const auto& d : directions)
        if (subdomain(moved(p, d, r)) != label) return false;
    return true;
  }

  // ---- what a derived class may know better

  /// What `meets()` and `first_hit()` have to know of a point.
  int side(const Point& p) const { return subdomain(p); }
  /// Whether the segment pq meets the boundary.
  bool meets(const Point&, int at_p, const Point& q) const { return subdomain(q) != at_p; }
  /// A point where the segment pq meets the boundary, about the first; whether there is one.
  bool first_hit(const Point& p, int at_p, const Point& q, Surface_hit_3<K>& hit) const
  {
    const int at_q = subdomain(q);
    if (at_p == at_q) return false;
    hit = derived().crossing(p, q, at_p, at_q);
    return true;
  }

  Point project_on_crease(const Point& p, int crease) const { return creases_.project_on_crease(p, crease); }
  void intersect_creases(const Point& a, const Point& b, const std::vector<Point>& polygon,
                         std::vector<Crease_hit_3<K>>& hits) const
  {
    creases_.intersect_creases(a, b, polygon, hits);
  }

  std::size_t number_of_corners() const { return creases_.number_of_corners(); }
  const Point& corner(std::size_t i) const { return creases_.corner(i); }
  std::size_t number_of_creases() const { return creases_.number_of_creases(); }
  std::vector<Point> crease_points(int i) const { return creases_.crease_points(i); }
  bool crease_is_closed(int i) const { return creases_.crease_is_closed(i); }

  /// Which creases end in which corners; patches at a crease aren't known.
  Feature_incidence_3 incidence() const
  {
    const auto corner_at = [this](const Point& p) {
      for (std::size_t i = 0; i < number_of_corners(); ++i)
        if (corner(i) == p) return static_cast<int>(i);
      return -1;
    };
    std::vector<std::pair<int, int>> ends;
    for (std::size_t c = 0; c < number_of_creases(); ++c) {
      const auto& points = creases_.crease_points(static_cast<int>(c));
      ends.emplace_back(-1, -1);
      if (!crease_is_closed(static_cast<int>(c))) ends.back() = {corner_at(points.front()), corner_at(points.back())};
    }
    return Feature_incidence_3(number_of_corners(), ends);
  }

  /// Whether points of a patch were found.
  bool is_expected(int patch) const
  {
    const auto p = static_cast<std::size_t>(patch);
    return p < seeds_.size() && !seeds_[p].empty();
  }

  /// n well-spread points on each connected part of a patch, as far as those were found; the same ones each time.
  std::vector<Surface_hit_3<K>> patch_seeds(int patch, std::size_t n) const
  {
    if (!is_expected(patch)) return {};
    return internal::spread_over_parts<K>(seeds_[static_cast<std::size_t>(patch)], patch, n);
  }

protected:
  /// Looks for the boundary along the edges of a grid.
  /// \param parts of the longest side of the bounding box. O(parts^3) labels.
  void find_seeds(int parts) { seeds_ = internal::interface_seeds_3<K>(derived(), parts); }

  /// Takes points of the boundary, by patch and connected part, that are known otherwise.
  void set_seeds(std::vector<std::vector<std::vector<Point>>> seeds) { seeds_ = std::move(seeds); }
  const std::vector<std::vector<std::vector<Point>>>& seeds() const { return seeds_; }
  /// Adds some, each a part of its own.
  void add_seeds(const std::vector<Surface_hit_3<K>>& more)
  {
    for (const auto& hit : more) {
      const auto p = static_cast<std::size_t>(hit.patch);
      if (hit.patch < 0) continue;
      if (p >= seeds_.size()) seeds_.resize(p + 1);
      seeds_[p].push_back({hit.point}); // a part of its own
    }
  }

  bool is_in_box(const Point& p) const
  {
    return bbox_.xmin() <= p.x() && p.x() <= bbox_.xmax() && bbox_.ymin() <= p.y() && p.y() <= bbox_.ymax() &&
           bbox_.zmin() <= p.z() && p.z() <= bbox_.zmax();
  }

  static double distance(const Point& p, const Point& q)
  {
    return internal::norm(internal::minus(internal::xyz(p), internal::xyz(q)));
  }
  static Point between(const Point& p, const Point& q, double t)
  {
    return Point(p.x() + t * (q.x() - p.x()), p.y() + t * (q.y() - p.y()), p.z() + t * (q.z() - p.z()));
  }
  static Point moved(const Point& p, const internal::Xyz_3& direction, double length)
  {
    return Point(p.x() + length * direction[0], p.y() + length * direction[1], p.z() + length * direction[2]);
  }

  double diagonal() const { return diagonal_; }

  void set_creases(Crease_network_3<K> creases) { creases_ = std::move(creases); }

  /// Of a crossing, in diagonals of the bounding box.
  static constexpr double precision = 1e-10;
  static constexpr int most_bisections = 80;

private:
  static constexpr int any_patch = -1;

  const Derived& derived() const { return static_cast<const Derived&>(*this); }

  /// Looks around p at growing distances for a change of label, and goes from the nearest one found along the normal of
  /// the boundary there, as often as that leads nearer.
  Surface_hit_3<K> project(const Point& p, int patch) const
  {
    const int side = derived().side(p);
    Surface_hit_3<K> best{p, -1};
    for (double radius = first_radius * diagonal_; best.patch < 0 && radius < 2 * diagonal_; radius *= 3)
      for (const auto& d : directions) look_along(p, side, d, radius, patch, best);
    if (best.patch < 0) return best;
    for (int k = 0; k < most_turns; ++k) {
      const double from = distance(p, best.point);
      if (!(from > 10 * precision * diagonal_)) break;
      internal::Xyz_3 normal;
      if (!normal_at(p, best, normal)) break;
      look_along(p, side, normal, 1.0001 * from, patch, best);
      if (!(distance(p, best.point) < (1 - least_gain) * from)) break;
    }
    return best;
  }

  /// Takes a point of the boundary within `radius` from p in a direction if it is of the patch and nearer than the
  /// best.
  void look_along(const Point& p, int side, const internal::Xyz_3& direction, double radius, int patch,
                  Surface_hit_3<K>& best) const
  {
    if (best.patch >= 0) radius = (std::min)(radius, distance(p, best.point));
    const Point end = moved(p, direction, radius);
    Point from = p;
    Surface_hit_3<K> hit{p, -1};
    for (int k = 0; k < most_layers && derived().first_hit(from, side, end, hit); ++k) {
      if (patch == any_patch || hit.patch == patch) {
        if (best.patch < 0 || distance(p, hit.point) < distance(p, best.point)) best = hit;
        return;
      }
      from = moved(hit.point, direction, 4 * precision * diagonal_); // p lies in a third subdomain
      if (!(distance(p, from) < radius)) return;
      side = derived().side(from);
    }
  }

  /// Direction of the boundary's normal, from p to it, out of three points where lines parallel to that from p to a
  /// point of the boundary cross it. Whether they do.
  bool normal_at(const Point& p, const Surface_hit_3<K>& hit, internal::Xyz_3& normal) const
  {
    using internal::Xyz_3;
    const double length = distance(p, hit.point);
    Xyz_3 along = internal::minus(internal::xyz(hit.point), internal::xyz(p));
    for (double& x : along) x /= length;
    const std::size_t least = static_cast<std::size_t>(
        std::min_element(along.begin(), along.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        along.begin());
    Xyz_3 axis{};
    axis[least] = 1;
    Xyz_3 u = internal::cross_product(along, axis);
    const double size = internal::norm(u);
    for (double& x : u) x /= size;
    const Xyz_3 v = internal::cross_product(along, u);
    std::array<double, 2> slope;
    const double step = 0.2 * length;
    for (int k = 0; k < 2; ++k) {
      const Point foot = moved(p, k == 0 ? u : v, step);
      Surface_hit_3<K> beside{p, -1};
      if (!derived().first_hit(foot, derived().side(foot), moved(foot, along, 2 * length), beside)) return false;
      slope[static_cast<std::size_t>(k)] = (distance(foot, beside.point) - length) / step;
    }
    for (std::size_t k = 0; k < 3; ++k) normal[k] = along[k] - slope[0] * u[k] - slope[1] * v[k];
    const double n = internal::norm(normal);
    for (double& x : normal) x /= n;
    return true;
  }

  /// Axes and diagonals: no direction is farther than 36 degrees from one.
  static constexpr double d3 = 0.57735026918962576451;
  static constexpr internal::Xyz_3 directions[14] = {
      {{{1, 0, 0}}},     {{{-1, 0, 0}}},     {{{0, 1, 0}}},      {{{0, -1, 0}}},     {{{0, 0, 1}}},
      {{{0, 0, -1}}},    {{{d3, d3, d3}}},   {{{d3, d3, -d3}}},  {{{d3, -d3, d3}}},  {{{d3, -d3, -d3}}},
      {{{-d3, d3, d3}}}, {{{-d3, d3, -d3}}}, {{{-d3, -d3, d3}}}, {{{-d3, -d3, -d3}}}};
  static constexpr double first_radius = 1e-3; ///< of the search, in diagonals
  static constexpr double least_gain = 1e-3;
  static constexpr int most_turns = 5, most_layers = 4;

  CGAL::Bbox_3 bbox_;
  double diagonal_;
  Crease_network_3<K> creases_;
  std::vector<std::vector<std::vector<Point>>> seeds_; ///< by patch and connected part
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_DOMAIN_BY_LABELS_3_H
