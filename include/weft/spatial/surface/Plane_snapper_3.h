// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets that lie in one plane but for rounding are put into one, exactly: faces of parts that touch, after a turn or
// in single precision, cross each other in no sensible way. A vertex goes to the planes of its facets, up to three of
// them, so that neighbouring facets stay triangles; it moves by about the tolerance.

#ifndef WEFT_SPATIAL_SURFACE_PLANE_SNAPPER_3_H
#define WEFT_SPATIAL_SURFACE_PLANE_SNAPPER_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/cgal_version.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/box_intersection_d.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace weft::internal {

/// See the top of the file.
/// \tparam K a kernel of doubles.
template <class K>
class Plane_snapper_3
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();

public:
  /// \param tolerance how far a facet may be from the plane of another to be put into it.
  Plane_snapper_3(const Triangle_surface_3<K>& surface, double tolerance) : surface_(surface), tolerance_(tolerance)
  {
    for (const auto& p : surface.points) xyz_.push_back(xyz(p));
    const std::size_t n = surface.triangles.size();
    for (std::size_t t = 0; t < n; ++t) {
      const Xyz_3 normal = cross_product(minus(corner(t, 1), corner(t, 0)), minus(corner(t, 2), corner(t, 0)));
      const double length = norm(normal);
      area_.push_back(length);
      for (std::size_t k = 0; k < 3 && length > 0; ++k) normal_.resize(t + 1), normal_[t][k] = normal[k] / length;
      normal_.resize(t + 1);
    }
    is_active_.resize(n, false);
    plane_.resize(n, none);
    find_pairs();
    find_planes();
    place_vertices();
  }

  /// Pairs of facets that are near each other, one of which has a plane or a vertex in one.
  const std::vector<std::array<std::size_t, 2>>& pairs() const { return pairs_; }
  /// Vertices with their exact places.
  const std::map<std::size_t, Exact::Point_3>& places() const { return places_; }

private:
  const Xyz_3& corner(std::size_t t, std::size_t i) const { return xyz_[surface_.triangles[t][i % 3]]; }

  double height(const Xyz_3& p, std::size_t t) const { return dot_product(minus(p, corner(t, 0)), normal_[t]); }
  bool is_in_plane_of(std::size_t s, std::size_t t) const
  {
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs(height(corner(s, i), t)) <= tolerance_)) return false;
    return area_[t] > 0;
  }

  /// How far two facets in one plane overlap at least, in the direction in which they do least; negative if they don't.
  double overlap(std::size_t s, std::size_t t) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t of : {s, t})
      for (std::size_t i = 0; i < 3; ++i) {
        const Xyz_3 edge = minus(corner(of, i + 1), corner(of, i)), across = cross_product(edge, normal_[t]);
        const double length = norm(across);
        if (!(length > 0)) continue;
        double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
        for (std::size_t k = 0; k < 2; ++k)
          for (std::size_t j = 0; j < 3; ++j) {
            const double x = dot_product(minus(corner(k == 0 ? s : t, j), corner(of, i)), across) / length;
            low[k] = (std::min)(low[k], x);
            high[k] = (std::max)(high[k], x);
          }
        least = (std::min)({least, high[0] - low[1], high[1] - low[0]});
      }
    return least;
  }

  bool is_on(const Xyz_3& p, std::size_t t) const
  {
    if (!(area_[t] > 0) || std::abs(height(p, t)) > tolerance_) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Xyz_3 edge = minus(corner(t, i + 1), corner(t, i));
      if (dot_product(cross_product(normal_[t], edge), minus(p, corner(t, i))) < -tolerance_ * norm(edge)) return false;
    }
    return true;
  }

  void find_pairs()
  {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      std::array<double, 3> low, high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = (std::min)({corner(t, 0)[k], corner(t, 1)[k], corner(t, 2)[k]}) - tolerance_;
        high[k] = (std::max)({corner(t, 0)[k], corner(t, 1)[k], corner(t, 2)[k]}) + tolerance_;
      }
      boxes.emplace_back(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), t);
    }
    std::vector<std::array<std::size_t, 2>> near;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      near.push_back({(std::min)(a.info(), b.info()), (std::max)(a.info(), b.info())});
    });
    std::sort(near.begin(), near.end());
    for (const auto& [a, b] : near) compare(a, b);
    std::vector<bool> touches_plane(xyz_.size(), false);
    for (const auto& [v, t] : on_facets_) touches_plane[v] = is_active_[t] = true;
    for (std::size_t t = 0; t < is_active_.size(); ++t)
      if (is_active_[t])
        for (const std::size_t v : surface_.triangles[t]) touches_plane[v] = true;
    const auto counts = [&](std::size_t t) {
      const auto& triangle = surface_.triangles[t];
      return std::any_of(triangle.begin(), triangle.end(), [&](std::size_t v) { return touches_plane[v]; });
    };
    for (const auto& pair : near)
      if (counts(pair[0]) || counts(pair[1])) pairs_.push_back(pair);
  }

  void compare(std::size_t a, std::size_t b)
  {
    const auto& other = surface_.triangles[b];
    const auto common = std::count_if(surface_.triangles[a].begin(), surface_.triangles[a].end(), [&](std::size_t v) {
      return std::find(other.begin(), other.end(), v) != other.end();
    });
    const std::size_t s = area_[a] >= area_[b] ? b : a, t = s == a ? b : a; // t has the larger one's plane
    if (is_in_plane_of(s, t)) {
      const double depth = overlap(s, t);
      if (common == 2 || depth >= -tolerance_) level_.push_back({a, b});
      // Neighbours touch anyway.
      if (depth > (common == 0 ? -tolerance_ : 10 * tolerance_)) is_active_[a] = is_active_[b] = true;
      return;
    }
    if (common > 0) return;
    for (const std::size_t v : surface_.triangles[a])
      if (is_on(xyz_[v], b)) on_facets_.emplace_back(v, b);
    for (const std::size_t v : surface_.triangles[b])
      if (is_on(xyz_[v], a)) on_facets_.emplace_back(v, a);
  }

  /// Collects facets that are to be in one plane: that of the largest of them, so that nothing drifts.
  void find_planes()
  {
    std::map<std::size_t, std::vector<std::size_t>> beside;
    for (const auto& [a, b] : level_)
      if (is_active_[a] && is_active_[b]) beside[a].push_back(b), beside[b].push_back(a);
    std::vector<std::size_t> order(is_active_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return area_[a] > area_[b]; });
    for (const std::size_t seed : order) {
      if (!is_active_[seed] || plane_[seed] != none || !(area_[seed] > 0)) continue;
      plane_[seed] = seed;
      std::vector<std::size_t> pending = {seed};
      while (!pending.empty()) {
        const std::size_t t = pending.back();
        pending.pop_back();
        for (const std::size_t next : beside[t]) {
          if (plane_[next] != none || !is_in_plane_of(next, seed)) continue;
          plane_[next] = seed;
          pending.push_back(next);
        }
      }
    }
  }

  Exact::Point_3 exact(std::size_t v) const
  {
    const auto& p = surface_.points[v];
    return {p.x(), p.y(), p.z()};
  }
  const Exact::Plane_3& exact_plane(std::size_t t)
  {
    const auto found = planes_.find(t);
    if (found != planes_.end()) return found->second;
    const auto& [a, b, c] = surface_.triangles[t];
    return planes_.emplace(t, Exact::Plane_3(exact(a), exact(b), exact(c))).first->second;
  }

  void place_vertices()
  {
    std::map<std::size_t, std::vector<std::size_t>> planes; // of each vertex
    for (std::size_t t = 0; t < plane_.size(); ++t)
      if (plane_[t] != none)
        for (const std::size_t v : surface_.triangles[t]) planes[v].push_back(plane_[t]);
    for (const auto& [v, t] : on_facets_)
      if (plane_[t] != none) planes[v].push_back(plane_[t]);
    for (auto& [v, of] : planes) {
      std::sort(of.begin(), of.end());
      of.erase(std::unique(of.begin(), of.end()), of.end());
      std::stable_sort(of.begin(), of.end(), [&](std::size_t a, std::size_t b) { return area_[a] > area_[b]; });
      place(v, of);
    }
  }

  /// Puts a vertex into the largest of the planes, up to three that are far from parallel.
  void place(std::size_t v, const std::vector<std::size_t>& planes)
  {
    constexpr double flat = 1e-2;
    const std::size_t first = planes[0];
    std::size_t second = none, third = none;
    Xyz_3 along{{0, 0, 0}};
    for (const std::size_t t : planes) {
      if (second == none) {
        along = cross_product(normal_[first], normal_[t]);
        if (norm(along) > flat) second = t;
      } else if (third == none && std::abs(dot_product(along, normal_[t])) > flat * norm(along)) {
        third = t;
      }
    }
    Exact::Point_3 p = exact_plane(first).projection(exact(v));
    if (second != none) {
      const auto common = CGAL::intersection(exact_plane(first), exact_plane(second));
      const auto* line = intersection_as<Exact::Line_3>(common);
      if (line) p = line->projection(exact(v));
      if (line && third != none) {
        const auto end = CGAL::intersection(*line, exact_plane(third));
        if (const auto* corner = intersection_as<Exact::Point_3>(end)) p = *corner;
      }
    }
    if (norm(minus(xyz(p), xyz_[v])) <= 100 / flat * tolerance_) places_.emplace(v, p);
  }

  const Triangle_surface_3<K>& surface_;
  double tolerance_;
  std::vector<Xyz_3> xyz_, normal_;
  std::vector<double> area_; ///< twice the areas
  std::vector<bool> is_active_;
  std::vector<std::size_t> plane_; ///< of each facet: the facet whose plane it goes to
  std::vector<std::array<std::size_t, 2>> pairs_, level_;
  std::vector<std::pair<std::size_t, std::size_t>> on_facets_; ///< vertices, and facets that they lie on
  std::map<std::size_t, Exact::Plane_3> planes_;
  std::map<std::size_t, Exact::Point_3> places_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_PLANE_SNAPPER_3_H
