// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the boundary of a domain out of facets that nearly are one: cleans them, caps holes where that is asked for,
// finds the regions that the facets bound, and leaves out what bounds nothing.

#ifndef WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H
#define WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/closed_pieces_3.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/Facet_cleaner_3.h>
#include <weft/spatial/surface/Hole_capper_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/Mending_record_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/Surface_regions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// What has come out of a surface.
template <class K>
struct Mended_surface_3
{
  Triangle_surface_3<K> surface;
  std::vector<std::pair<int, int>> sides;         ///< the subdomains behind and before each triangle
  std::vector<std::size_t> place;                 ///< which point each of the caller's is now
  std::vector<std::array<std::size_t, 2>> curves; ///< edges where parts that were united cross, unless flat
  std::vector<std::array<typename K::Point_3, 3>> left_out;
  std::vector<std::size_t> pinches; ///< vertices that are in several fans of triangles
  bool is_manifold = false;         ///< two triangles meet in each edge, and the outside is before all of them
  Mending_record_3 record;
};

/// Which triangles have to be turned over so that all look outwards, and which bound nothing.
struct Outward_turns_3
{
  std::vector<bool> is_turned, bounds_nothing;
  bool operator==(const Outward_turns_3& other) const
  {
    return is_turned == other.is_turned && bounds_nothing == other.bounds_nothing;
  }
};

/// See the top of the file. \tparam K a CGAL kernel with exact predicates.
template <class K>
class Surface_mender_3 : private Facet_cleaner_3<K>
{
  using Base = Facet_cleaner_3<K>;
  using Base::area;
  using Base::check_area_;
  using Base::facets_;
  using Base::options_;
  using Base::points_;
  using Base::record_;
  using typename Base::Corners;
  using typename Base::Facet;

public:
  /// \param with_caps whether holes are capped.
  /// \throws Domain_error if facets refer to points that don't exist or aren't finite.
  Surface_mender_3(const Polygon_soup_3<K>& soup, const Mend_options_3& options, bool with_caps = false)
      : Base(soup, options), with_caps_(with_caps)
  {}

  /// \param everywhere see `Facet_cleaner_3::clean()`.
  /// \param is_union see `Surface_regions_3::sides()`.
  /// \throws Domain_error if nothing, or more than is allowed, would have to be left out.
  Mended_surface_3<K> mend(bool everywhere, bool is_union = false)
  {
    Base::clean(everywhere);
    if (with_caps_) cap_holes();
    return find_domain(is_union);
  }

  /// Mends what doesn't depend on what the facets bound.
  Triangle_surface_3<K> cleaned()
  {
    Base::clean(false);
    if (with_caps_) cap_holes();
    return triangle_surface();
  }

  /// How to turn each connected part of what `cleaned()` returned outwards: taken as a whole, and with closed pieces as
  /// parts of their own, although they share edges.
  std::array<Outward_turns_3, 2> outward_turns(const Triangle_surface_3<K>& surface) const
  {
    const std::vector<int> net = nets();
    Surface_regions_3<K> regions(surface, net);
    Outward_turns_3 whole{regions.looking_inwards(), {}};
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      whole.bounds_nothing.push_back(regions.bounds_nothing(t));
    Outward_turns_3 by_pieces = whole;
    const std::vector<Piece_side> outer = sides_of_closed_pieces(surface);
    for (std::size_t t = 0; t < outer.size(); ++t) {
      if (outer[t] == Piece_side::unknown) continue;
      by_pieces.is_turned[t] = outer[t] == Piece_side::behind;
      by_pieces.bounds_nothing[t] = false; // where facets cross, regions mean little
    }
    return {std::move(whole), std::move(by_pieces)};
  }

  const Mending_record_3& record() const { return record_; }

private:
  Triangle_surface_3<K> triangle_surface() const
  {
    Triangle_surface_3<K> surface{points_, Base::triangles(), {}};
    for (const Facet& f : facets_) surface.origins.push_back(f.origin);
    return surface;
  }

  std::vector<int> nets() const
  {
    std::vector<int> net;
    for (const Facet& f : facets_) net.push_back((std::max)(-1, (std::min)(1, f.net)));
    return net;
  }

  /// The facets with the same region on both sides.
  std::vector<std::size_t> bounding_nothing(Surface_regions_3<K>& regions) const
  {
    std::vector<std::size_t> result;
    for (std::size_t t = 0; t < facets_.size(); ++t)
      if (regions.bounds_nothing(t)) result.push_back(t);
    return result;
  }

  void cap_holes()
  {
    const Triangle_surface_3<K> all = triangle_surface();
    const std::vector<int> net = nets();
    Surface_regions_3<K> regions(all, net);
    Hole_capper_3<K> capper(all, bounding_nothing(regions), true);
    capper.cap(options_.most_capped, [this] { ask_to_go_on(options_, "capping holes"); });
    for (const Open_part_3& part : capper.parts())
      for (const Hole_3& hole : part.holes) {
        if (hole.triangles.empty()) continue;
        ++record_.holes;
        record_.area_of_caps += hole.area;
        for (const Corners& corners : hole.triangles) {
          facets_.push_back({corners, facets_[hole.beside].origin});
          check_area_ += area(corners);
        }
      }
    Base::drop_degenerate(0);
    Base::drop_duplicates();
  }

  // ---- The domain

  Mended_surface_3<K> find_domain(bool is_union)
  {
    ask_to_go_on(options_, "looking for regions");
    const Triangle_surface_3<K> all = triangle_surface();
    const std::vector<int> net = nets();
    Surface_regions_3<K> regions(all, net);
    const std::vector<std::size_t> left_out = bounding_nothing(regions);
    record_.area = area();
    for (const std::size_t t : left_out) record_.area_left_out += area(facets_[t].corners);
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
    if (!(std::abs(kept - check_area_) <= Base::tolerance_ * Base::perimeters_ + 1e-9 * check_area_))
      throw Domain_error("facets would get lost", {}, {});
    if (is_union) result.curves = crossing_curves(all, regions, result.surface);
    for (const std::size_t t : left_out) {
      const auto& [a, b, c] = facets_[t].corners;
      result.left_out.push_back({points_[a], points_[b], points_[c]});
    }
    result.surface.points = std::move(points_);
    result.place = std::move(Base::place_);
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

  /// \throws Domain_error if facets that bound nothing are too many or are a body with a hole.
  void check_left_out(const Triangle_surface_3<K>& all, const std::vector<std::size_t>& left_out) const
  {
    if (left_out.empty()) return;
    std::vector<std::size_t> facets;
    for (const std::size_t t : left_out) facets.push_back(facets_[t].origin);
    sort_unique(facets);
    const auto refuse_them = [&](const std::string& what) { throw Domain_error(what, {}, std::move(facets)); };
    const auto percent = [](double share) { return Mending_record_3::percent(share); };
    const auto refuse_open = [&](double share) {
      refuse_them("an open surface: caps of its holes would be " + percent(share) +
                  " of the area: close it, or give it a thickness");
    };
    const Hole_capper_3<K> capper(all, left_out, false);
    double caps = 0;
    for (const Open_part_3& part : capper.parts()) {
      caps += part.area_of_caps();
      if (part.holes.empty()) refuse_them("a closed part of the surface bounds nothing");
      const double share = part.share_of_caps();
      if (options_.most_capped == 0 ? share <= least_of_open : share <= options_.most_capped)
        refuse_them("a part of the surface has a hole" + std::string(with_caps_ ? " that no cap fits" : ""));
      if (share <= least_of_open) refuse_open(share);
    }
    if (record_.area_left_out <= options_.most_left_out * record_.area) return;
    if (left_out.size() < facets_.size())
      refuse_them("sheets that bound nothing are " + percent(record_.area_left_out / record_.area) +
                  " of the area: give them a thickness, or leave them out");
    const double share = caps / (caps + record_.area);
    if (share <= least_of_sheets) refuse_open(share);
    refuse_them("a sheet: give it a thickness");
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

  static constexpr double least_of_open = 0.3;    ///< share of caps, from which on a small part may be left out
  static constexpr double least_of_sheets = 0.42; ///< that of half a box is less, that of a sheet about 0.5
  bool with_caps_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_MEND_SURFACE_3_H
