// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts triangles along the curves in which they meet, so that afterwards they have only vertices and edges in common.
// Intersections are exact; points are rounded at the end, which may bring triangles to touch again: check the result.

#ifndef WEFT_SPATIAL_SURFACE_RESOLVE_INTERSECTIONS_3_H
#define WEFT_SPATIAL_SURFACE_RESOLVE_INTERSECTIONS_3_H

#include <weft/errors.h>
#include <weft/internal/cgal_version.h>
#include <weft/spatial/surface/check_surface_volume_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/Plane_snapper_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace weft::internal {

/// See the top of the file.
/// \tparam K a kernel of doubles with exact predicates.
template <class K>
class Intersection_resolver_3
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  using Exact_point = Exact::Point_3;
  using Exact_triangle = Exact::Triangle_3;
  static constexpr std::size_t most_pairs = 300000;

public:
  /// \pre No triangle is degenerate, and no two have the same vertices. Pieces have the origins of their triangles; of
  /// pieces on the same vertices each stays.
  /// \param pairs those of `intersecting_triangles()`.
  /// \param options is asked whether to go on, and has to stay.
  /// \param tolerance within it triangles are put into one plane before; 0: they aren't.
  Intersection_resolver_3(Triangle_surface_3<K>& surface, std::vector<std::array<std::size_t, 2>> pairs,
                          const Mend_options_3& options, double tolerance)
      : surface_(surface), pairs_(std::move(pairs)), options_(options), tolerance_(tolerance)
  {
    if (tolerance_ > 0) snap();
  }

  /// Whether points were put onto planes; without that a tolerance changes nothing.
  bool has_planes() const { return has_planes_; }

  /// How many points were moved onto planes.
  std::size_t snapped() const { return snapped_; }

  /// Those that meet, as triangles were numbered before.
  const std::vector<std::array<std::size_t, 2>>& pairs() const { return meeting_; }

  /// Returns how many pairs of triangles were cut.
  /// \throws Domain_error if there are far too many.
  std::size_t resolve()
  {
    for (auto& pair : pairs_) std::sort(pair.begin(), pair.end());
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    if (pairs_.size() > most_pairs) throw Domain_error("too many facets intersect", {}, {});
    for (const auto& [s, t] : pairs_) {
      ask_to_go_on(options_, "intersecting facets");
      meet(s, t);
    }
    Triangle_surface_3<K> result;
    result.points = surface_.points;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const auto found = cuts_.find(t);
      if (found == cuts_.end())
        result.triangles.push_back(surface_.triangles[t]);
      else {
        ask_to_go_on(options_, "cutting facets");
        cut(t, found->second, result);
      }
      result.origins.resize(result.triangles.size(), surface_.origin(t));
    }
    surface_ = std::move(result);
    return meeting_.size();
  }

private:
  /// Moves points onto planes; adds pairs that this may have brought together.
  void snap()
  {
    const Plane_snapper_3<K> snapper(surface_, tolerance_);
    has_planes_ = !snapper.places().empty();
    pairs_.insert(pairs_.end(), snapper.pairs().begin(), snapper.pairs().end());
    std::map<std::size_t, std::size_t> alias;
    for (const auto& [v, p] : snapper.places()) {
      exact_vertices_[v] = p;
      const typename K::Point_3 rounded = this->rounded(p);
      snapped_ += rounded != surface_.points[v];
      surface_.points[v] = rounded;
      const auto [at, is_new] = numbers_.try_emplace(p, v);
      if (!is_new) alias[v] = at->second;
    }
    for (auto& triangle : surface_.triangles)
      for (std::size_t& v : triangle)
        if (const auto found = alias.find(v); found != alias.end()) v = found->second;
  }

  static typename K::Point_3 rounded(const Exact_point& p)
  {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  /// Segments and single points that a triangle has in common with others.
  using Cuts = std::vector<std::pair<Exact_point, Exact_point>>;

  static Exact_point exact(const typename K::Point_3& p) { return Exact_point(p.x(), p.y(), p.z()); }

  const Exact_point& exact_vertex(std::size_t v)
  {
    const auto [at, is_new] = exact_vertices_.try_emplace(v);
    if (is_new) at->second = exact(surface_.points[v]);
    return at->second;
  }
  Exact_triangle exact_triangle(std::size_t t)
  {
    const auto& [a, b, c] = surface_.triangles[t];
    return Exact_triangle(exact_vertex(a), exact_vertex(b), exact_vertex(c));
  }

  /// Whether what isn't common of one of two triangles lies on one side of the other's plane: then they have their
  /// common vertices in common only.
  bool is_beside(std::size_t s, std::size_t t)
  {
    const auto& [a, b, c] = surface_.triangles[t];
    int above = 0, below = 0;
    for (const std::size_t v : surface_.triangles[s]) {
      if (v == a || v == b || v == c) continue;
      const auto side = CGAL::orientation(exact_vertex(a), exact_vertex(b), exact_vertex(c), exact_vertex(v));
      if (side == CGAL::COPLANAR) return false;
      ++(side == CGAL::POSITIVE ? above : below);
    }
    return (above == 0) != (below == 0);
  }

  void meet(std::size_t s, std::size_t t)
  {
    if (is_beside(s, t) || is_beside(t, s)) return;
    const Exact_triangle one = exact_triangle(s), other = exact_triangle(t);
    if (tolerance_ > 0 && (one.is_degenerate() || other.is_degenerate())) return;
    const auto common = CGAL::intersection(one, other);
    if (!common) return;
    const std::size_t cuts_before = number_of_cuts_;
    const auto is_corner = [&](const Exact_triangle& of, const Exact_point& p) {
      return p == of.vertex(0) || p == of.vertex(1) || p == of.vertex(2);
    };
    const auto add = [&](const Exact_point& p, const Exact_point& q) {
      if (!is_corner(one, p) || !is_corner(one, q)) cuts_[s].emplace_back(p, q), ++number_of_cuts_;
      if (!is_corner(other, p) || !is_corner(other, q)) cuts_[t].emplace_back(p, q), ++number_of_cuts_;
    };
    if (const auto* p = intersection_as<Exact_point>(common)) {
      add(*p, *p);
    } else if (const auto* segment = intersection_as<Exact::Segment_3>(common)) {
      add(segment->source(), segment->target());
    } else if (const auto* triangle = intersection_as<Exact_triangle>(common)) {
      for (int i = 0; i < 3; ++i) add(triangle->vertex(i), triangle->vertex(i + 1));
      overlapping_.insert({s, t});
    } else if (const auto* polygon = intersection_as<std::vector<Exact_point>>(common)) {
      for (std::size_t i = 0; i < polygon->size(); ++i) add((*polygon)[i], (*polygon)[(i + 1) % polygon->size()]);
      overlapping_.insert({s, t});
    }
    if (number_of_cuts_ > cuts_before) meeting_.push_back({s, t});
  }

  using Traits = CGAL::Projection_traits_3<Exact>;
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Traits>;
  using Structure =
      CGAL::Triangulation_data_structure_2<Vertex_base, CGAL::Constrained_triangulation_face_base_2<Traits>>;
  using Triangulation = CGAL::Constrained_triangulation_plus_2<
      CGAL::Constrained_Delaunay_triangulation_2<Traits, Structure, CGAL::Exact_intersections_tag>>;
  using Face = typename Triangulation::Face_handle;

  /// The constrained Delaunay triangulation of a triangle with its cuts.
  void cut(std::size_t t, const Cuts& cuts, Triangle_surface_3<K>& result)
  {
    const auto corners = surface_.triangles[t];
    const Exact_triangle triangle = exact_triangle(t);
    Triangulation triangulation{Traits(triangle.supporting_plane().orthogonal_vector())};
    for (int i = 0; i < 3; ++i) triangulation.insert(triangle.vertex(i));
    for (const auto& [p, q] : cuts)
      if (p == q)
        triangulation.insert(p);
      else
        triangulation.insert_constraint(p, q);
    for (const auto v : triangulation.finite_vertex_handles()) v->info() = number(v->point(), corners, result);
    std::set<Face> done;
    if (overlapping_.count(t) > 0)
      for (const auto face : triangulation.finite_face_handles())
        if (done.count(face) == 0) add_fan(triangulation, face, done, result);
    for (const auto face : triangulation.finite_face_handles())
      if (done.count(face) == 0)
        result.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }

  /// Triangles that overlap in a plane have to be cut alike. Where more than three points lie on a circle there are
  /// several Delaunay triangulations: adds the fan from the lowest of them, in place of a face and those beside it.
  void add_fan(const Triangulation& triangulation, Face seed, std::set<Face>& done, Triangle_surface_3<K>& result) const
  {
    const auto is_on_circle = [&](Face face, int i) {
      const Face next = face->neighbor(i);
      return !triangulation.is_constrained({face, i}) && !triangulation.is_infinite(next) &&
             triangulation.side_of_oriented_circle(face, next->vertex(next->index(face))->point(), false) ==
                 CGAL::ON_ORIENTED_BOUNDARY;
    };
    std::vector<Face> pending = {seed};
    std::set<Face> fan = {seed};
    std::map<std::size_t, std::size_t> next_of; // around the fan
    auto lowest = seed->vertex(0);
    while (!pending.empty()) {
      const Face face = pending.back();
      pending.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (Exact::Less_xyz_3()(face->vertex(i)->point(), lowest->point())) lowest = face->vertex(i);
        if (!is_on_circle(face, i))
          next_of[face->vertex((i + 1) % 3)->info()] = face->vertex((i + 2) % 3)->info();
        else if (fan.insert(face->neighbor(i)).second)
          pending.push_back(face->neighbor(i));
      }
    }
    if (fan.size() == 1) return;
    done.insert(fan.begin(), fan.end());
    const std::size_t first = lowest->info();
    for (std::size_t v = next_of.at(first), next = next_of.at(v); next != first; v = next, next = next_of.at(v))
      result.triangles.push_back({first, v, next});
  }

  /// The number of a point in the result; the same for equal points, whichever triangles they were found on.
  std::size_t number(const Exact_point& p, const std::array<std::size_t, 3>& corners, Triangle_surface_3<K>& result)
  {
    for (const std::size_t v : corners)
      if (exact_vertex(v) == p) return v;
    const auto [at, is_new] = numbers_.try_emplace(p, result.points.size());
    if (is_new) result.points.push_back(rounded(p));
    return at->second;
  }

  Triangle_surface_3<K>& surface_;
  std::vector<std::array<std::size_t, 2>> pairs_;
  const Mend_options_3& options_;
  double tolerance_;
  bool has_planes_ = false;
  std::size_t snapped_ = 0, number_of_cuts_ = 0;
  std::vector<std::array<std::size_t, 2>> meeting_;
  std::map<std::size_t, Exact_point> exact_vertices_;
  std::map<std::size_t, Cuts> cuts_;
  std::set<std::size_t> overlapping_; ///< triangles that have more than points and segments in common with others
  std::map<Exact_point, std::size_t, Exact::Less_xyz_3> numbers_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_RESOLVE_INTERSECTIONS_3_H
