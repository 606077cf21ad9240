// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts the facets of surfaces where they meet, in one way after the other, from those that change least: facets that
// nearly lie in one plane are put into one or not, and closed pieces are turned outwards as parts of their own or not.
// What the ways have in common is done once, and a way that would do the same as an earlier one is left out.

#ifndef WEFT_SPATIAL_SURFACE_SURFACE_RESOLVER_3_H
#define WEFT_SPATIAL_SURFACE_SURFACE_RESOLVER_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/has_all_parts_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/mend_surface_3.h>
#include <weft/spatial/surface/Mending_record_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/resolve_intersections_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// A surface whose facets are cut where they meet.
template <class K>
struct Resolved_surface_3
{
  Surface_parts_3<K> given; ///< before, without what bounds nothing
  Polygon_soup_3<K> soup;
  Mending_record_3 record; ///< of what was done before
};

/// See the top of the file. \tparam K a kernel of doubles with exact predicates.
template <class K>
class Surface_resolver_3
{
public:
  /// Cleans the surfaces, and finds what meets within them and between them.
  /// \param mending has to stay.
  /// \throws Domain_error.
  Surface_resolver_3(const std::vector<Polygon_soup_3<K>>& soups, const Mend_options_3& mending, bool with_caps)
      : soups_(soups), mending_(mending)
  {
    for (std::size_t s = 0; s < soups.size(); ++s) {
      Surface_mender_3<K> mender(soups[s], mending, with_caps);
      Triangle_surface_3<K> surface = mender.cleaned();
      turns_.push_back(mender.outward_turns(surface));
      records_.push_back(mender.record());
      first_.push_back(all_.triangles.size());
      for (const auto& [a, b, c] : surface.triangles)
        all_.triangles.push_back({a + all_.points.size(), b + all_.points.size(), c + all_.points.size()});
      all_.points.insert(all_.points.end(), surface.points.begin(), surface.points.end());
      surface_of_.resize(all_.triangles.size(), s);
      surfaces_.push_back(std::move(surface));
    }
    for (std::size_t t = 0; t < all_.triangles.size(); ++t) all_.origins.push_back(t);
    CGAL::Bbox_3 box;
    for (const auto& p : all_.points) box += p.bbox();
    diagonal_ = std::hypot(box.x_span(), box.y_span(), box.z_span());
    const auto sides = sorted_sides(all_.triangles);
    parts_ = Disjoint_parts(all_.triangles.size());
    for_each_edge(sides, [&](auto first, auto last) {
      is_open_ = is_open_ || (last - first) % 2 == 1;
      for (auto other = first + 1; other != last; ++other) parts_.unite(first->triangle, other->triangle);
    });
    pairs_ = intersecting_triangles(all_, sides);
    bool are_alike = true;
    for (const auto& of_surface : turns_) are_alike = are_alike && of_surface[0] == of_surface[1];
    constexpr double rounding = 1e-12;
    std::vector<double> tolerances = {0, rounding};
    if (mending.tolerance > rounding) tolerances.push_back(mending.tolerance);
    cuts_.resize(tolerances.size());
    for (std::size_t i = 0; i < tolerances.size(); ++i) {
      cuts_[i].tolerance = tolerances[i];
      ways_.push_back({i, false});
    }
    for (std::size_t i = are_alike ? 0 : ways_.size(); i-- > 0;) ways_.push_back({i, true});
  }

  /// Whether the surfaces have holes, or caps of them don't close them.
  bool is_open() const { return is_open_; }

  /// Goes to the next way that differs from those before; false if there is none.
  bool next()
  {
    while (at_ < ways_.size()) {
      way_ = ways_[at_++];
      Cut& cut = cuts_[way_.cut];
      if (!cut.is_made) make(cut);
      if (cut.is_of_use) return true;
    }
    return false;
  }

  /// The surfaces as this way cuts them.
  std::vector<Resolved_surface_3<K>> resolved()
  {
    const Cut& cut = cuts_[way_.cut];
    Disjoint_parts groups(all_.triangles.size());
    for (const auto& [a, b] : cut.meeting)
      if (surface_of_[a] == surface_of_[b]) groups.unite(parts_.find(a), parts_.find(b));
    std::vector<Resolved_surface_3<K>> result(surfaces_.size());
    for (std::size_t s = 0; s < result.size(); ++s) {
      result[s].record = records_[s];
      result[s].record.cut = cut.meeting.size();
      result[s].record.snapped = cut.snapped;
      result[s].soup.points = cut.surface.points;
      result[s].soup.name = soups_[s].name;
      result[s].soup.group_names = soups_[s].group_names;
      auto& given = result[s].given;
      given.surface.points = surfaces_[s].points;
      for (std::size_t t = 0; t < surfaces_[s].triangles.size(); ++t) {
        if (turns_[s][way_.by_pieces].bounds_nothing[t]) continue;
        given.surface.triangles.push_back(surfaces_[s].triangles[t]);
        given.part.push_back(parts_.find(first_[s] + t));
        given.group.push_back(groups.find(given.part.back()));
      }
    }
    for (std::size_t i = 0; i < cut.surface.triangles.size(); ++i) {
      const std::size_t t = cut.surface.origin(i), s = surface_of_[t];
      auto [a, b, c] = cut.surface.triangles[i];
      if (turns_[s][way_.by_pieces].is_turned[t - first_[s]]) std::swap(b, c);
      result[s].soup.polygons.push_back({a, b, c});
      if (!soups_[s].groups.empty())
        result[s].soup.groups.push_back(soups_[s].groups[surfaces_[s].origin(t - first_[s])]);
    }
    return result;
  }

private:
  struct Way
  {
    std::size_t cut = 0;
    bool by_pieces = false;
  };
  struct Cut
  {
    double tolerance = 0; ///< for facets that nearly lie in one plane, in parts of the diagonal
    bool is_made = false, is_of_use = false;
    Triangle_surface_3<K> surface; ///< pieces, which have the triangles before as their origins
    std::vector<std::array<std::size_t, 2>> meeting;
    std::size_t snapped = 0;
  };

  void make(Cut& cut)
  {
    cut.is_made = true;
    cut.surface = all_;
    try {
      Intersection_resolver_3<K> resolver(cut.surface, pairs_, mending_, cut.tolerance * diagonal_);
      if (cut.tolerance > 0 && !resolver.has_planes()) return;
      cut.is_of_use = resolver.resolve() > 0;
      cut.meeting = resolver.pairs();
      cut.snapped = resolver.snapped();
    } catch (const Domain_error&) {
    }
  }

  const std::vector<Polygon_soup_3<K>> soups_;
  const Mend_options_3& mending_;
  std::vector<Triangle_surface_3<K>> surfaces_; ///< cleaned
  std::vector<std::array<Outward_turns_3, 2>> turns_;
  std::vector<Mending_record_3> records_;
  Triangle_surface_3<K> all_;
  std::vector<std::size_t> first_, surface_of_; ///< of each surface its first triangle in `all_`, and back
  Disjoint_parts parts_{0};                     ///< what hangs together across edges
  std::vector<std::array<std::size_t, 2>> pairs_;
  double diagonal_ = 0;
  bool is_open_ = false;
  std::vector<Cut> cuts_;
  std::vector<Way> ways_;
  Way way_;
  std::size_t at_ = 0;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_SURFACE_RESOLVER_3_H
