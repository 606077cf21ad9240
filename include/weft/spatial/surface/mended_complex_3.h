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
#include <weft/spatial/surface/surface_groups_3.h>
#include <weft/spatial/surface/Surface_resolver_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
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

/// \param soup the surface that was mended, whose groups name subdomains.
template <class K>
Piecewise_smooth_complex_3<K> complex_of_mended(Mended_surface_3<K> mended, const Feature_options& options,
                                                const Polygon_soup_3<K>& soup)
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
    const auto names = names_of_subdomains(mended.surface.points, mended.surface.triangles, mended.sides,
                                           mended.surface.origins, soup);
    complex = interface_complex_3(std::move(mended.surface), mended.sides, relocated);
    complex.names = names;
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
      return complex_of_mended(std::move(mended), options, resolved.soup);
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
        return complex_of_mended(Surface_mender_3<K>(soup, mending, with_caps).mend(everywhere), options, soup);
      } catch (const Domain_error& error) {
        if (!everywhere) remains = error.what(); // with caps, if there are any: that comes nearer to a domain
      }
    }
    try {
      Surface_resolver_3<K> resolver({soup}, mending, with_caps);
      while (resolver.next()) {
        try {
          return complex_of_resolved(resolver.resolved()[0], by_angle_only(options), mending);
        } catch (const Domain_error&) {
        }
        // Holes may lie within other parts; if they don't, only caps help.
        if (!with_caps && mending.most_capped > 0 && resolver.is_open()) break;
      }
    } catch (const Domain_error&) {
    }
  }
  if (remains == failure.what()) throw failure;
  throw Domain_error(std::string(failure.what()) + "; mended as far as can be: " + remains, failure.vertices(),
                     failure.elements());
}

/// Several surfaces, cut where they meet, after merging them has failed.
/// \throws Domain_error: that failure.
/// \param order see `merge_surfaces()`.
template <class K>
Piecewise_smooth_complex_3<K> resolve_and_merge(const std::vector<Polygon_soup_3<K>>& surfaces,
                                                const Feature_options& options, const Mend_options_3& mending,
                                                const Domain_error& failure, const std::vector<std::size_t>& order)
{
  Surface_resolver_3<K> resolver(surfaces, mending, mending.most_capped > 0);
  while (resolver.next()) try {
      auto resolved = resolver.resolved();
      const std::size_t cut = resolved[0].record.cut, snapped = resolved[0].record.snapped;
      for (auto& surface : resolved) surface.record.cut = surface.record.snapped = 0;
      auto complex = merge_surfaces(
          resolved, options,
          [&](const Resolved_surface_3<K>& surface) {
            auto of_surface = complex_of_resolved(surface, by_angle_only(options), mending);
            name_by_surface(of_surface, surface.soup.name);
            return of_surface;
          },
          order);
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

/// A surface whose groups don't divide it.
template <class K>
Piecewise_smooth_complex_3<K> complex_of_one(const Polygon_soup_3<K>& soup, const Feature_options& options,
                                             const Mend_options_3& mending)
{
  auto complex = [&] {
    try {
      return piecewise_smooth_complex(soup, options);
    } catch (const Domain_error& failure) {
      return mend_complex(soup, options, mending, failure);
    }
  }();
  name_by_surface(complex, soup.name);
  return complex;
}

/// A surface whose groups bound solids.
/// \throws Domain_error if they don't.
template <class K>
Piecewise_smooth_complex_3<K> complex_of_solids(const Surface_solids_3<K>& solids, const Feature_options& options,
                                                const Mend_options_3& mending)
{
  std::vector<std::size_t> order(solids.surfaces.size()); // those that others lie in first
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return solids.volumes[a] > solids.volumes[b]; });
  const auto complex_of = [&](const Polygon_soup_3<K>& surface) { return complex_of_one(surface, options, mending); };
  try {
    return merge_surfaces(solids.surfaces, options, complex_of, order);
  } catch (const Domain_error& failure) {
    if (!solids.surfaces[0].groups_are_solids) throw;
    return resolve_and_merge(solids.surfaces, options, mending, failure, order);
  }
}

/// A surface whose groups may divide it.
template <class K>
Piecewise_smooth_complex_3<K> complex_of_soup(const Polygon_soup_3<K>& soup, const Feature_options& options,
                                              const Mend_options_3& mending)
{
  // Edges and vertices that are given by number belong to the whole.
  if (options.sharp_edges.empty() && options.tips_and_cusps.empty())
    if (const auto solids = solids_of_groups(soup); !solids.surfaces.empty()) try {
        return complex_of_solids(solids, options, mending);
      } catch (const Domain_error&) {
      }
  return complex_of_one(soup, options, mending);
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
///   numbered from 1 by its first facet;
/// - groups of facets that bound something by themselves are subdomains in their order, with their names; of two that
///   lie in each other the smaller has what both contain. Solids may also overlap; other groups that do are united. A
///   group that has nearly all facets between a region and the outside names that region. Groups that are parts of one
///   boundary, such as the inlet and the wall of a pipe, change nothing.
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
  return internal::complex_of_soup(soup, options, mending);
}

/// The same for several surfaces, each of which is mended by itself. They are merged as by
/// `piecewise_smooth_complex()`; where one has several subdomains, the numbers of those after it are higher
/// accordingly.
template <class K>
Piecewise_smooth_complex_3<K> mended_complex_3(const std::vector<Polygon_soup_3<K>>& surfaces,
                                               const Feature_options& options = {}, const Mend_options_3& mending = {})
{
  options.check();
  mending.check();
  const auto complex_of = [&](const Polygon_soup_3<K>& surface) {
    return internal::complex_of_soup(surface, options, mending);
  };
  if (surfaces.size() < 2) return internal::merge_surfaces(surfaces, options, complex_of);
  try {
    return internal::merge_surfaces(surfaces, options, complex_of);
  } catch (const Domain_error& failure) {
    return internal::resolve_and_merge(surfaces, options, mending, failure, {});
  }
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_MENDED_COMPLEX_3_H
