// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the boundary of a domain out of facets that nearly are one: welds points, drops facets that are degenerate or
// there twice, splits edges at points on them, finds the regions that the facets bound, and leaves out what bounds
// nothing. Facets aren't moved by more than a tolerance, and none is added.

#ifndef WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H
#define WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Point_tree_3.h>
#include <weft/internal/counted.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/Surface_regions_3.h>
#include <weft/spatial/surface/triangulate_polygons_3.h>
#include <weft/spatial/surface/weld_points_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// What was done to a surface. Facets are counted as triangles.
struct Mending_record_3
{
  std::size_t equal_points = 0, near_points = 0, degenerate = 0, duplicate = 0, split = 0, turned = 0, left_out = 0,
              within_void = 0, within_domain = 0, cut = 0;
  double farthest_weld = 0, area = 0, area_left_out = 0;

  /// One line for each thing, for people.
  std::vector<std::string> lines() const
  {
    std::vector<std::string> lines;
    const auto note = [&](std::size_t n, const char* one, const char* many, const std::string& more = "") {
      if (n > 0) lines.push_back(counted(n, one, many) + more);
    };
    note(equal_points, "point was welded to an equal one", "points were welded to equal ones");
    note(near_points, "point was welded to a near one", "points were welded to near ones",
         ", at most " + brief(farthest_weld) + " away");
    note(degenerate, "degenerate facet was dropped", "degenerate facets were dropped");
    note(duplicate, "facet that is there twice was dropped", "facets that are there twice were dropped");
    note(split, "facet was split at points on its edges", "facets were split at points on their edges");
    note(cut, "pair of facets that intersect was cut", "pairs of facets that intersect were cut");
    note(turned, "facet was turned over", "facets were turned over");
    note(left_out, "facet was left out, a fin or sheet that bounds nothing",
         "facets were left out, fins or sheets that bound nothing",
         ", " + percent(area_left_out / area) + " of the area");
    note(within_void, "facet with the outside on both sides was left out",
         "facets with the outside on both sides were left out");
    note(within_domain, "facet within another part was left out", "facets within other parts were left out");
    return lines;
  }

  static std::string brief(double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", x);
    return text;
  }
  static std::string percent(double share) { return brief(100 * share) + " %"; }
};

/// What has come out of a surface.
template <class K>
struct Mended_surface_3
{
  Triangle_surface_3<K> surface;
  std::vector<std::pair<int, int>> sides;         ///< the subdomains behind and before each triangle
  std::vector<std::size_t> place;                 ///< which point each of the caller's is now
  std::vector<std::array<std::size_t, 2>> curves; ///< edges where parts that were united cross, unless flat
  std::vector<std::size_t> pinches;               ///< vertices that are in several fans of triangles
  bool is_manifold = false; ///< two triangles meet in each edge, and the outside is before all of them
  Mending_record_3 record;
};

/// See the top of the file. \tparam K a CGAL kernel with exact predicates.
template <class K>
class Surface_mender_3
{
  using Corners = std::array<std::size_t, 3>;

public:
  /// \throws Domain_error if facets refer to points that don't exist or aren't finite.
  Surface_mender_3(const Polygon_soup_3<K>& soup, const Mend_options_3& options) : options_(options)
  {
    check_soup(soup);
    points_ = soup.points;
    Box_3 box;
    for (const auto& p : points_) {
      xyz_.push_back(xyz(p));
      box.add(xyz_.back()[0], xyz_.back()[1], xyz_.back()[2]);
    }
    if (!points_.empty())
      tolerance_ =
          options.tolerance * norm({{box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]}});
    place_ = weld_equal_points(xyz_);
    for (std::size_t v = 0; v < place_.size(); ++v) record_.equal_points += place_[v] != v;
    cut(soup);
    check_area_ = area();
    for (const Facet& f : facets_) perimeters_ += perimeter(f.corners);
  }

  /// \param everywhere whether to weld all points that are near to each other and to drop all facets that are flatter
  ///        than the tolerance, not only at edges that don't have two facets.
  /// \throws Domain_error if nothing, or more than is allowed, would have to be left out.
  /// \param is_union see `Surface_regions_3::sides()`.
  Mended_surface_3<K> mend(bool everywhere, bool is_union = false)
  {
    clean(everywhere);
    return find_domain(is_union);
  }

  /// Mends what doesn't depend on what the facets bound, and turns each connected part outwards.
  Triangle_surface_3<K> cleaned(std::vector<bool>& bounds_nothing)
  {
    clean(false);
    Triangle_surface_3<K> surface{points_, triangles(), {}};
    std::vector<int> net;
    for (const Facet& f : facets_) {
      surface.origins.push_back(f.origin);
      net.push_back((std::max)(-1, (std::min)(1, f.net)));
    }
    Surface_regions_3<K> regions(surface, net);
    const std::vector<bool> is_inwards = regions.looking_inwards();
    for (std::size_t t = 0; t < is_inwards.size(); ++t) bounds_nothing.push_back(regions.bounds_nothing(t));
    for (std::size_t t = 0; t < is_inwards.size(); ++t)
      if (is_inwards[t]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    return surface;
  }

private:
  void clean(bool everywhere)
  {
    drop_degenerate(everywhere ? tolerance_ : 0);
    drop_duplicates();
    weld(everywhere);
    // A point that a split needs may come up by another one: a facet that is dropped leaves an edge to split.
    for (int round = 0; round < 10 && split_edges(); ++round) {
      drop_degenerate(0);
      drop_duplicates();
    }
  }

  struct Facet
  {
    Corners corners;
    std::size_t origin;
    int net = 1; ///< how often it is there as it is turned, less how often the other way
  };

  static void check_soup(const Polygon_soup_3<K>& soup)
  {
    std::vector<std::size_t> stray;
    for (std::size_t f = 0; f < soup.polygons.size(); ++f)
      for (const std::size_t v : soup.polygons[f])
        if (v >= soup.points.size() && (stray.empty() || stray.back() != f)) stray.push_back(f);
    if (!stray.empty()) throw Domain_error("facets refer to points that don't exist", {}, stray);
    check_coordinates(soup.points, soup.polygons);
  }

  /// Polygons become triangles; corners that follow an equal one are dropped.
  void cut(const Polygon_soup_3<K>& soup)
  {
    for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
      std::vector<std::size_t> polygon;
      for (const std::size_t v : soup.polygons[f])
        if (polygon.empty() || polygon.back() != place_[v]) polygon.push_back(place_[v]);
      while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
      if (polygon.size() < 3)
        ++record_.degenerate;
      else if (polygon.size() == 3)
        facets_.push_back({{{polygon[0], polygon[1], polygon[2]}}, f});
      else
        for (const auto& [i, j, k] : cut_polygon<K>(points_, polygon))
          facets_.push_back({{{polygon[i], polygon[j], polygon[k]}}, f});
    }
  }

  double perimeter(const Corners& c) const
  {
    return norm(minus(xyz_[c[0]], xyz_[c[1]])) + norm(minus(xyz_[c[1]], xyz_[c[2]])) +
           norm(minus(xyz_[c[2]], xyz_[c[0]]));
  }
  double area(const Corners& c) const
  {
    return norm(cross_product(minus(xyz_[c[1]], xyz_[c[0]]), minus(xyz_[c[2]], xyz_[c[0]]))) / 2;
  }
  double area() const
  {
    double sum = 0;
    for (const Facet& f : facets_) sum += area(f.corners);
    return sum;
  }

  /// Drops the facets in question; returns how many.
  std::size_t drop(const std::vector<bool>& is_dropped)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < facets_.size(); ++i)
      if (!is_dropped[i]) facets_[kept++] = facets_[i];
    const std::size_t dropped = facets_.size() - kept;
    facets_.erase(facets_.begin() + static_cast<std::ptrdiff_t>(kept), facets_.end());
    return dropped;
  }

  /// Facets with a repeated or three collinear vertices, or with a height of up to a bound.
  void drop_degenerate(double height)
  {
    const auto collinear = K().collinear_3_object();
    std::vector<bool> is_degenerate(facets_.size(), false);
    for (std::size_t t = 0; t < facets_.size(); ++t) {
      const auto& [a, b, c] = facets_[t].corners;
      is_degenerate[t] = a == b || b == c || c == a || collinear(points_[a], points_[b], points_[c]);
      if (is_degenerate[t] || !(height > 0)) continue;
      const double longest =
          (std::max)({norm(minus(xyz_[a], xyz_[b])), norm(minus(xyz_[b], xyz_[c])), norm(minus(xyz_[c], xyz_[a]))});
      is_degenerate[t] = 2 * area(facets_[t].corners) <= height * longest;
      if (is_degenerate[t]) check_area_ -= area(facets_[t].corners);
    }
    record_.degenerate += drop(is_degenerate);
  }

  /// Of facets on the same three vertices the first stays.
  void drop_duplicates()
  {
    std::vector<std::pair<Corners, std::size_t>> sorted(facets_.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      sorted[i] = {facets_[i].corners, i};
      std::sort(sorted[i].first.begin(), sorted[i].first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> is_repeated(facets_.size(), false);
    for (std::size_t i = 1, first = 0; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[first].first) {
        first = i;
        continue;
      }
      Facet &kept = facets_[sorted[first].second], &other = facets_[sorted[i].second];
      kept.net += is_turned_like(kept.corners, other.corners) ? other.net : -other.net;
      is_repeated[sorted[i].second] = true;
      check_area_ -= area(other.corners);
    }
    record_.duplicate += drop(is_repeated);
  }

  /// Whether facets on the same three vertices have them in the same order.
  static bool is_turned_like(const Corners& a, const Corners& b)
  {
    const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(at + 1) % 3] == a[1];
  }

  std::vector<Corners> triangles() const
  {
    std::vector<Corners> triangles;
    for (const Facet& f : facets_) triangles.push_back(f.corners);
    return triangles;
  }

  /// Welds points at edges that don't have two facets, or all.
  void weld(bool everywhere)
  {
    std::vector<bool> is_candidate(points_.size(), false);
    if (everywhere)
      for (const Facet& f : facets_)
        for (const std::size_t v : f.corners) is_candidate[v] = true;
    else
      for_each_edge(sorted_sides(triangles()), [&](auto first, auto last) {
        if (last - first != 2) is_candidate[first->low] = is_candidate[first->high] = true;
      });
    std::vector<std::size_t> candidates;
    for (std::size_t v = 0; v < is_candidate.size(); ++v)
      if (is_candidate[v]) candidates.push_back(v);
    std::vector<std::size_t> place(points_.size());
    std::iota(place.begin(), place.end(), std::size_t(0));
    record_.near_points = weld_near_points(xyz_, candidates, tolerance_, place);
    if (record_.near_points == 0) return;
    for (std::size_t v = 0; v < place.size(); ++v)
      record_.farthest_weld = (std::max)(record_.farthest_weld, norm(minus(xyz_[v], xyz_[place[v]])));
    for (std::size_t& v : place_) v = place[v];
    for (Facet& f : facets_)
      for (std::size_t& v : f.corners) v = place[v];
    drop_degenerate(everywhere ? tolerance_ : 0);
    drop_duplicates();
  }

  /// Splits edges that have one facet only at the points that are on them within the tolerance. Whether there were any.
  bool split_edges()
  {
    std::vector<Surface_side_3> open;
    for_each_edge(sorted_sides(triangles()), [&](auto first, auto last) {
      if (last - first == 1) open.push_back(*first);
    });
    if (open.empty()) return false;
    const auto on_edges = points_on(open);
    std::map<std::size_t, std::array<std::vector<std::size_t>, 3>> splits; // of facets, on their sides
    for (std::size_t i = 0; i < open.size(); ++i)
      if (!on_edges[i].empty()) {
        auto& on_side = splits[open[i].triangle][open[i].side];
        on_side = on_edges[i];
        if (!open[i].forward) std::reverse(on_side.begin(), on_side.end());
      }
    if (splits.empty()) return false;
    std::size_t points = 0;
    for (const auto& on_edge : on_edges) points += on_edge.size();
    if (points > 1000 + 10 * facets_.size()) throw Domain_error("too many points lie on edges of other facets", {}, {});
    std::vector<Facet> pieces;
    std::vector<bool> is_split(facets_.size(), false);
    for (const auto& [facet, on_sides] : splits) {
      check_area_ -= area(facets_[facet].corners);
      split(facets_[facet], on_sides, pieces);
      is_split[facet] = true;
    }
    record_.split += drop(is_split);
    for (const Facet& f : pieces) check_area_ += area(f.corners);
    facets_.insert(facets_.end(), pieces.begin(), pieces.end());
    return true;
  }

  /// Cuts a facet into fans from its corners.
  void split(const Facet& facet, const std::array<std::vector<std::size_t>, 3>& on_sides,
             std::vector<Facet>& pieces) const
  {
    std::size_t i = 0;
    while (i < 3 && on_sides[i].empty()) ++i;
    if (i == 3) {
      pieces.push_back(facet);
      return;
    }
    const std::size_t a = facet.corners[i], b = facet.corners[(i + 1) % 3], c = facet.corners[(i + 2) % 3];
    std::vector<std::size_t> chain = on_sides[i];
    chain.insert(chain.begin(), a);
    chain.push_back(b);
    for (std::size_t j = 0; j + 1 < chain.size(); ++j) {
      Facet piece = facet;
      piece.corners = {{chain[j], chain[j + 1], c}};
      std::array<std::vector<std::size_t>, 3> rest;
      if (j + 2 == chain.size()) rest[1] = on_sides[(i + 1) % 3];
      if (j == 0) rest[2] = on_sides[(i + 2) % 3];
      split(piece, rest, pieces);
    }
  }

  /// The points on each edge within the tolerance, from its lower vertex on.
  std::vector<std::vector<std::size_t>> points_on(const std::vector<Surface_side_3>& edges) const
  {
    std::vector<bool> is_used(points_.size(), false);
    std::vector<std::size_t> used;
    double largest = 0;
    for (const Facet& f : facets_)
      for (const std::size_t v : f.corners) {
        if (!is_used[v]) used.push_back(v);
        is_used[v] = true;
        largest = (std::max)(largest, norm(xyz_[v]));
      }
    const Point_tree_3 tree(xyz_, std::move(used));
    const double tolerance = (std::max)(tolerance_, 1e-15 * largest); // rounding of points on edges
    std::vector<std::vector<std::size_t>> result;
    for (const Surface_side_3& edge : edges) {
      const Xyz_3 &p = xyz_[edge.low], &q = xyz_[edge.high], d = minus(q, p);
      const auto& corners = facets_[edge.triangle].corners;
      const double length = norm(d);
      std::vector<std::pair<double, std::size_t>> on_edge;
      tree.visit_near_segment(p, q, 1.01 * tolerance, [&](std::size_t v) {
        const Xyz_3 e = minus(xyz_[v], p);
        const double along = dot_product(e, d) / length;
        if (along > tolerance && along < length - tolerance && norm(cross_product(e, d)) <= tolerance * length &&
            std::find(corners.begin(), corners.end(), v) == corners.end())
          on_edge.emplace_back(along, v);
      });
      std::sort(on_edge.begin(), on_edge.end());
      result.emplace_back();
      for (const auto& [along, v] : on_edge) result.back().push_back(v);
    }
    return result;
  }

  // ---- The domain

  Mended_surface_3<K> find_domain(bool is_union)
  {
    Triangle_surface_3<K> all{points_, triangles(), {}};
    std::vector<int> net;
    for (const Facet& f : facets_) net.push_back((std::max)(-1, (std::min)(1, f.net)));
    Surface_regions_3<K> regions(all, net);
    std::vector<std::size_t> left_out;
    record_.area = area();
    for (std::size_t t = 0; t < facets_.size(); ++t)
      if (regions.bounds_nothing(t)) {
        left_out.push_back(t);
        record_.area_left_out += area(facets_[t].corners);
      }
    check_left_out(all, left_out);
    record_.left_out = left_out.size();
    const auto sides = regions.sides(is_union);
    Mended_surface_3<K> result;
    double kept = record_.area_left_out, outside = 0;
    for (std::size_t t = 0; t < facets_.size(); ++t) {
      auto [behind, before] = sides[t];
      if (behind == before) {
        if (behind == 0 && regions.bounds_nothing(t)) continue;
        ++(behind == 0 ? record_.within_void : record_.within_domain);
        kept += area(facets_[t].corners);
        if (behind == 0) outside += area(facets_[t].corners);
        continue;
      }
      Corners corners = facets_[t].corners;
      if (behind == 0 || (before != 0 && behind > before)) {
        std::swap(corners[1], corners[2]);
        std::swap(behind, before);
        record_.turned += before == 0;
      }
      kept += area(corners);
      result.surface.triangles.push_back(corners);
      result.surface.origins.push_back(facets_[t].origin);
      result.sides.emplace_back(behind, before);
    }
    if (result.surface.triangles.empty()) throw Domain_error("no facet bounds a domain", {}, {});
    // Where parts overlap, folds are outside; whole parts aren't.
    if (is_union && outside > 1e-3 * record_.area)
      throw Domain_error("parts would get lost where facets nearly meet", {}, {});
    // Each point of the surface moves by the tolerance at most.
    if (!(std::abs(kept - check_area_) <= tolerance_ * perimeters_ + 1e-9 * check_area_))
      throw Domain_error("facets would get lost", {}, {});
    if (is_union) result.curves = crossing_curves(all, regions, result.surface);
    result.surface.points = std::move(points_);
    result.place = std::move(place_);
    describe(result);
    result.record = record_;
    return result;
  }

  /// Edges that had more than two facets and have two that aren't level.
  std::vector<std::array<std::size_t, 2>> crossing_curves(const Triangle_surface_3<K>& all,
                                                          Surface_regions_3<K>& regions,
                                                          const Triangle_surface_3<K>& result) const
  {
    constexpr double flat = 5; // degrees
    std::vector<std::array<std::size_t, 2>> crowded, curves;
    for_each_edge(sorted_sides(all.triangles), [&](auto first, auto last) {
      const auto n = std::count_if(first, last, [&](const auto& s) { return !regions.bounds_nothing(s.triangle); });
      if (n > 2) crowded.push_back({first->low, first->high});
    });
    const auto normal = [&](std::size_t t) {
      const auto& [a, b, c] = result.triangles[t];
      return unit_facet_normal(points_[a], points_[b], points_[c]);
    };
    for_each_edge(sorted_sides(result.triangles), [&](auto first, auto last) {
      const std::array<std::size_t, 2> edge = {first->low, first->high};
      if (last - first == 2 && std::binary_search(crowded.begin(), crowded.end(), edge) &&
          angle_between(normal(first->triangle), normal((first + 1)->triangle)) > flat)
        curves.push_back(edge);
    });
    return curves;
  }

  /// \throws Domain_error if facets that bound nothing are too many or look like a body with a hole.
  void check_left_out(const Triangle_surface_3<K>& all, const std::vector<std::size_t>& left_out) const
  {
    if (left_out.empty()) return;
    std::vector<std::size_t> facets;
    for (const std::size_t t : left_out) facets.push_back(facets_[t].origin);
    sort_unique(facets);
    if (has_hole(all, left_out)) throw Domain_error("a part of the surface has a hole", {}, std::move(facets));
    if (record_.area_left_out <= options_.most_left_out * record_.area) return;
    throw Domain_error(left_out.size() == facets_.size()
                           ? "a sheet: give it a thickness"
                           : "sheets that bound nothing are " +
                                 Mending_record_3::percent(record_.area_left_out / record_.area) +
                                 " of the area: give them a thickness, or leave them out",
                       {}, std::move(facets));
  }

  /// Whether a connected part of what bounds nothing is cup-shaped: caps on its border would have less than 0.3 of its
  /// area. Fins and sheets have much border.
  bool has_hole(const Triangle_surface_3<K>& all, const std::vector<std::size_t>& left_out) const
  {
    std::vector<Corners> triangles;
    for (const std::size_t t : left_out) triangles.push_back(all.triangles[t]);
    const auto sides = sorted_sides(triangles);
    Disjoint_parts parts(triangles.size()), loops(points_.size());
    std::vector<Surface_side_3> border;
    for_each_edge(sides, [&](auto first, auto last) {
      for (auto other = first + 1; other != last; ++other) parts.unite(first->triangle, other->triangle);
      if ((last - first) % 2 == 0) return;
      border.push_back(*first);
      loops.unite(first->low, first->high);
    });
    std::map<std::size_t, std::pair<Xyz_3, double>> centers; // of the borders' loops
    for (const Surface_side_3& s : border) {
      auto& [sum, n] = centers.try_emplace(loops.find(s.low), Xyz_3{{0, 0, 0}}, 0).first->second;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += xyz_[s.low][k] / 2 + xyz_[s.high][k] / 2;
      ++n;
    }
    std::map<std::size_t, double> caps, areas;
    for (std::size_t i = 0; i < triangles.size(); ++i) areas[parts.find(i)] += area(triangles[i]);
    for (const Surface_side_3& s : border) {
      const auto& [sum, n] = centers.at(loops.find(s.low));
      const Xyz_3 center{{sum[0] / n, sum[1] / n, sum[2] / n}};
      caps[parts.find(s.triangle)] += norm(cross_product(minus(xyz_[s.low], center), minus(xyz_[s.high], center))) / 2;
    }
    return std::any_of(areas.begin(), areas.end(),
                       [&](const auto& part) { return caps[part.first] < 0.3 * part.second; });
  }

  /// Finds out whether the surface is manifold, and where not.
  static void describe(Mended_surface_3<K>& result)
  {
    const auto& triangles = result.surface.triangles;
    Disjoint_parts fans(3 * triangles.size()); // of corners
    result.is_manifold = true;
    const auto corner = [&](const Surface_side_3& s, std::size_t v) {
      return 3 * s.triangle + (triangles[s.triangle][s.side] == v ? s.side : (s.side + 1) % 3);
    };
    for_each_edge(sorted_sides(triangles), [&](auto first, auto last) {
      if (last - first != 2 || first->forward == (first + 1)->forward) result.is_manifold = false;
      for (auto other = first + 1; other != last; ++other)
        for (const std::size_t v : {first->low, first->high}) fans.unite(corner(*first, v), corner(*other, v));
    });
    std::vector<std::size_t> fan(result.surface.points.size(), 3 * triangles.size());
    for (std::size_t c = 0; c < 3 * triangles.size(); ++c) {
      const std::size_t v = triangles[c / 3][c % 3], f = fans.find(c);
      if (fan[v] == 3 * triangles.size())
        fan[v] = f;
      else if (fan[v] != f)
        result.pinches.push_back(v);
    }
    sort_unique(result.pinches);
    for (const auto& [behind, before] : result.sides)
      if (before != 0) result.is_manifold = false;
    if (!result.pinches.empty()) result.is_manifold = false;
  }

  const Mend_options_3& options_;
  std::vector<typename K::Point_3> points_;
  std::vector<Xyz_3> xyz_;
  std::vector<std::size_t> place_;
  std::vector<Facet> facets_;
  Mending_record_3 record_;
  double tolerance_ = 0;
  double check_area_ = 0; ///< of what should be left
  double perimeters_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H
