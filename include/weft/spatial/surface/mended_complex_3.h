// SPDX-License-Identifier: GPL-3.0-or-later
//
// The piecewise smooth complex of surfaces as people have them: cut along seams, turned this way and that, with facets
// that are degenerate, there twice or bound nothing, with walls inside and parts that touch along edges.
// Surfaces without such faults give what `piecewise_smooth_complex()` makes of them.

#ifndef WEFT_SPATIAL_SURFACE_MENDED_COMPLEX_3_H
#define WEFT_SPATIAL_SURFACE_MENDED_COMPLEX_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/has_all_parts_3.h>
#include <weft/spatial/surface/interface_complex_3.h>
#include <weft/spatial/surface/Mend_options_3.h>
#include <weft/spatial/surface/mend_surface_3.h>
#include <weft/spatial/surface/merge_surfaces_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/resolve_intersections_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// The options for a mended surface; given edges and vertices that are gone are dropped and noted.
template <class K>
Feature_options options_for_mended(const Feature_options& options, const Mended_surface_3<K>& mended,
                                   std::vector<std::string>& notes)
{
  Feature_options result = options;
  result.sharp_edges.clear();
  result.tips_and_cusps.clear();
  const auto sides = sorted_sides(mended.surface.triangles);
  std::vector<std::size_t> used;
  for (const Surface_side_3& s : sides) used.insert(used.end(), {s.low, s.high});
  sort_unique(used);
  for (const auto& [a, b] : options.sharp_edges) {
    if (a >= mended.place.size() || b >= mended.place.size()) continue;
    const std::pair<std::size_t, std::size_t> edge = std::minmax(mended.place[a], mended.place[b]);
    const auto side = std::lower_bound(sides.begin(), sides.end(), edge, [](const Surface_side_3& s, const auto& key) {
      return std::make_pair(s.low, s.high) < key;
    });
    if (side != sides.end() && side->low == edge.first && side->high == edge.second)
      result.sharp_edges.push_back({edge.first, edge.second});
  }
  for (const std::size_t v : options.tips_and_cusps)
    if (v < mended.place.size() && std::binary_search(used.begin(), used.end(), mended.place[v]))
      result.tips_and_cusps.push_back(mended.place[v]);
  note_lost_features(options, result, notes);
  return result;
}

template <class K>
Piecewise_smooth_complex_3<K> complex_of_mended(Mended_surface_3<K> mended, const Feature_options& options)
{
  std::vector<std::string> notes = mended.record.lines();
  Feature_options relocated = options_for_mended(options, mended, notes);
  relocated.sharp_edges.insert(relocated.sharp_edges.end(), mended.curves.begin(), mended.curves.end());
  Piecewise_smooth_complex_3<K> complex;
  if (mended.is_manifold) {
    complex = derive_complex(std::move(mended.surface), relocated);
  } else {
    check_self_intersections(mended.surface, sorted_sides(mended.surface.triangles));
    relocated.tips_and_cusps.insert(relocated.tips_and_cusps.end(), mended.pinches.begin(), mended.pinches.end());
    int subdomains = 1;
    for (const auto& [behind, before] : mended.sides) subdomains = (std::max)({subdomains, behind, before});
    if (subdomains > 1)
      notes.push_back("the facets bound " + std::to_string(subdomains) + " subdomains, some of which touch");
    complex = interface_complex_3(std::move(mended.surface), mended.sides, relocated);
  }
  complex.changes.insert(complex.changes.begin(), notes.begin(), notes.end());
  complex.left_out = std::move(mended.left_out);
  complex.mending = mended.record;
  return complex;
}

/// The options without what is given by number.
inline Feature_options by_angle_only(Feature_options options)
{
  options.sharp_edges.clear();
  options.tips_and_cusps.clear();
  return options;
}

/// A surface whose facets are cut where they meet.
template <class K>
struct Resolved_surface_3
{
  Surface_parts_3<K> given; ///< before, without what bounds nothing
  Polygon_soup_3<K> soup;
  Mending_record_3 record; ///< of what was done before
};

/// A way to cut facets where they meet.
struct Resolving_3
{
  double snapping; ///< tolerance for facets that nearly lie in one plane, in parts of the diagonal
  bool by_pieces;  ///< see `Surface_mender_3::cleaned()`
};

/// The ways to try, one after the other: no facets nearly lie in one plane, or but for rounding, or by all that is
/// allowed.
inline std::vector<Resolving_3> ways_to_resolve(const Mend_options_3& mending)
{
  constexpr double rounding = 1e-12;
  std::vector<Resolving_3> ways = {{0, false}, {rounding, false}};
  if (mending.tolerance > rounding) ways.push_back({mending.tolerance, false});
  for (std::size_t i = ways.size(); i-- > 0;) ways.push_back({ways[i].snapping, true});
  return ways;
}

/// Cuts facets where they meet, within each surface and between them.
/// \param how see `ways_to_resolve()`.
/// \throws Domain_error.
template <class K>
std::vector<Resolved_surface_3<K>> resolve(const std::vector<Polygon_soup_3<K>>& soups, const Mend_options_3& mending,
                                           bool with_caps, const Resolving_3& how)
{
  std::vector<Resolved_surface_3<K>> result;
  Triangle_surface_3<K> all;
  for (std::size_t s = 0; s < soups.size(); ++s) {
    std::vector<bool> bounds_nothing;
    Surface_mender_3<K> mender(soups[s], mending, with_caps);
    const Triangle_surface_3<K> surface = mender.cleaned(bounds_nothing, how.by_pieces);
    result.emplace_back();
    result.back().record = mender.record();
    result.back().given.surface.points = surface.points;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (!bounds_nothing[t]) {
        result.back().given.surface.triangles.push_back(surface.triangles[t]);
        result.back().given.part.push_back(all.triangles.size() + t); // so far, the number in `all`
      }
    for (const auto& [a, b, c] : surface.triangles)
      all.triangles.push_back({a + all.points.size(), b + all.points.size(), c + all.points.size()});
    all.points.insert(all.points.end(), surface.points.begin(), surface.points.end());
    all.origins.resize(all.triangles.size(), s);
  }
  CGAL::Bbox_3 box;
  for (const auto& p : all.points) box += p.bbox();
  Disjoint_parts parts(all.triangles.size()), groups(all.triangles.size());
  for_each_edge(sorted_sides(all.triangles), [&](auto first, auto last) {
    for (auto other = first + 1; other != last; ++other) parts.unite(first->triangle, other->triangle);
  });
  const std::vector<std::size_t> surface_of = all.origins;
  Intersection_resolver_3<K> resolver(all, mending,
                                      how.snapping * std::hypot(box.x_span(), box.y_span(), box.z_span()));
  const std::size_t cut = resolver.resolve();
  if (cut == 0) throw Domain_error("no facets intersect", {}, {});
  for (const auto& [a, b] : resolver.pairs())
    if (surface_of[a] == surface_of[b]) groups.unite(parts.find(a), parts.find(b));
  for (auto& surface : result) {
    for (std::size_t& t : surface.given.part) {
      t = parts.find(t);
      surface.given.group.push_back(groups.find(t));
    }
    surface.soup.points = all.points;
    surface.record.cut = cut;
    surface.record.snapped = resolver.snapped();
  }
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const auto& [a, b, c] = all.triangles[t];
    result[all.origins[t]].soup.polygons.push_back({a, b, c});
  }
  return result;
}

/// The complex of a surface of which `resolve()` has made another.
template <class K>
Piecewise_smooth_complex_3<K> complex_of_resolved(const Resolved_surface_3<K>& resolved, const Feature_options& options,
                                                  const Mend_options_3& mending)
{
  std::string what;
  for (const bool everywhere : {false, true}) try {
      auto mended = Surface_mender_3<K>(resolved.soup, mending).mend(everywhere, true);
      if (!has_all_parts(resolved.given, mended.surface, mended.sides))
        throw Domain_error("parts would get lost where facets meet", {}, {});
      mended.record.equal_points = 0; // copies in the pieces
      mended.record.duplicate = 0;
      mended.record.add_earlier(resolved.record);
      return complex_of_mended(std::move(mended), options);
    } catch (const Domain_error& error) {
      if (what.empty()) what = error.what();
      if (mending.tolerance == 0) break;
    }
  throw Domain_error(what, {}, {});
}

/// After `piecewise_smooth_complex()` has failed: tries one way after the other, those first that change least.
/// \throws Domain_error with the elements of that failure, which are the caller's.
template <class K>
Piecewise_smooth_complex_3<K> mend_complex(const Polygon_soup_3<K>& soup, const Feature_options& options,
                                           const Mend_options_3& mending, const Domain_error& failure)
{
  std::string remains;
  for (const bool with_caps : {false, true}) {
    if (with_caps && mending.most_capped == 0) break;
    for (const bool everywhere : {false, true}) {
      if (everywhere && mending.tolerance == 0) continue;
      try {
        return complex_of_mended(Surface_mender_3<K>(soup, mending, with_caps).mend(everywhere), options);
      } catch (const Domain_error& error) {
        if (!everywhere) remains = error.what(); // with caps, if there are any: that comes nearer to a domain
      }
    }
    for (const Resolving_3& how : ways_to_resolve(mending)) try {
        const auto resolved = resolve(std::vector<Polygon_soup_3<K>>{soup}, mending, with_caps, how);
        return complex_of_resolved(resolved[0], by_angle_only(options), mending);
      } catch (const Domain_error&) {
      }
  }
  if (remains == failure.what()) throw failure;
  throw Domain_error(std::string(failure.what()) + "; mended as far as can be: " + remains, failure.vertices(),
                     failure.elements());
}

/// Several surfaces, cut where they meet, after merging them has failed.
/// \throws Domain_error: that failure.
template <class K>
Piecewise_smooth_complex_3<K> resolve_and_merge(const std::vector<Polygon_soup_3<K>>& surfaces,
                                                const Feature_options& options, const Mend_options_3& mending,
                                                const Domain_error& failure)
{
  options.check();
  mending.check();
  for (const Resolving_3& how : ways_to_resolve(mending)) try {
      auto resolved = resolve(surfaces, mending, mending.most_capped > 0, how);
      const std::size_t cut = resolved[0].record.cut, snapped = resolved[0].record.snapped;
      for (auto& surface : resolved) surface.record.cut = surface.record.snapped = 0;
      auto complex = merge_surfaces(resolved, options, [&](const Resolved_surface_3<K>& surface) {
        return complex_of_resolved(surface, by_angle_only(options), mending);
      });
      Mending_record_3 common;
      common.cut = cut;
      common.snapped = snapped;
      const auto lines = common.lines();
      complex.changes.insert(complex.changes.begin(), lines.begin(), lines.end());
      complex.mending.add(common);
      return complex;
    } catch (const Domain_error&) {
    }
  throw failure;
}

} // namespace internal

/// The piecewise smooth complex of a surface that needn't be one. If `piecewise_smooth_complex()` accepts it, the same;
/// otherwise it is mended, and `changes` says in a line for each what was done:
///
/// - equal points are welded, then points at edges that don't have two facets and are within the tolerance of each
///   other; if that doesn't suffice, all points within the tolerance;
/// - facets that are degenerate or there twice are dropped; edges with one facet are split at points on them;
/// - facets are turned so that they bound what lies inside, whatever their orientation;
/// - holes of cup-shaped parts are capped, if caps are at most `most_capped` of the part's area;
/// - facets with the outside, or the same region, on both sides are left out: fins and sheets;
/// - facets that intersect or overlap are cut where they meet. Parts that overlap are united, and the curves in which
///   they cross are sharp edges from 5 degrees on;
/// - where facets divide the inside, or parts touch in facets, edges or vertices, each region becomes a subdomain,
///   numbered from 1 by its first facet.
///
/// No point moves farther than the tolerance, and every facet is found on the mended surface or in `changes`.
/// \throws Domain_error if the facets don't bound anything, have holes that are too large, or still meet when they have
///         been cut; with the vertices and facets of the soup that keep it from being a closed surface as it is.
/// \throws Option_error if an option is out of range.
/// Takes O(n log n) for n facets, unless very many of its points lie side by side.
template <class K>
Piecewise_smooth_complex_3<K> mended_complex_3(const Polygon_soup_3<K>& soup, const Feature_options& options = {},
                                               const Mend_options_3& mending = {})
{
  options.check();
  mending.check();
  try {
    return piecewise_smooth_complex(soup, options);
  } catch (const Domain_error& failure) {
    return internal::mend_complex(soup, options, mending, failure);
  }
}

/// The same for several surfaces, each of which is mended by itself. They are merged as by
/// `piecewise_smooth_complex()`; where one has several subdomains, the numbers of those after it are higher
/// accordingly.
template <class K>
Piecewise_smooth_complex_3<K> mended_complex_3(const std::vector<Polygon_soup_3<K>>& surfaces,
                                               const Feature_options& options = {}, const Mend_options_3& mending = {})
{
  const auto complex_of = [&](const Polygon_soup_3<K>& surface) { return mended_complex_3(surface, options, mending); };
  if (surfaces.size() < 2) return internal::merge_surfaces(surfaces, options, complex_of);
  try {
    return internal::merge_surfaces(surfaces, options, complex_of);
  } catch (const Domain_error& failure) {
    return internal::resolve_and_merge(surfaces, options, mending, failure);
  }
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_MENDED_COMPLEX_3_H
