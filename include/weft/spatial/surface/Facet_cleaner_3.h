// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets of a surface that nearly fit together are made to fit: points are welded, facets that are degenerate or there
// twice are dropped, edges are split at points on them. Points don't move by more than a tolerance.

#ifndef WEFT_SPATIAL_SURFACE_FACET_CLEANER_3_H
#define WEFT_SPATIAL_SURFACE_FACET_CLEANER_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/Box_tree_builder_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/boxes/Point_tree_3.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/Mending_record_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/triangulate_polygons_3.h>
#include <weft/spatial/surface/weld_points_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace weft::internal {

/// Facets of a surface as triangles, while they are mended.
/// \tparam K a CGAL kernel with exact predicates.
template <class K>
class Facet_cleaner_3
{
protected:
  using Corners = std::array<std::size_t, 3>;
  struct Facet
  {
    Corners corners;
    std::size_t origin; ///< the caller's facet
    int net = 1;        ///< how often it is there as it is turned, less how often the other way
  };

  /// \throws Domain_error if facets refer to points that don't exist or aren't finite.
  Facet_cleaner_3(const Polygon_soup_3<K>& soup, const Mend_options_3& options) : options_(options)
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
  void clean(bool everywhere)
  {
    ask_to_go_on(options_, "welding points");
    drop_degenerate(everywhere ? tolerance_ : 0);
    drop_duplicates();
    weld(everywhere);
    // A point that a split needs may come up by another one: a facet that is dropped leaves an edge to split.
    for (int round = 0; round < 10 && split_edges(); ++round) {
      drop_degenerate(0);
      drop_duplicates();
    }
  }

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

  const Mend_options_3& options_;
  std::vector<typename K::Point_3> points_;
  std::vector<Xyz_3> xyz_;
  std::vector<std::size_t> place_; ///< which point each of the caller's is now
  std::vector<Facet> facets_;
  Mending_record_3 record_;
  double tolerance_ = 0;
  double check_area_ = 0; ///< of what should be left
  double perimeters_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_FACET_CLEANER_3_H
