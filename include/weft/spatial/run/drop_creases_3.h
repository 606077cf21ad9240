// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases that were found by angle and that no mesh of the asked size and shape can follow: which ones those are, and
// the domain without them, whose patches go on across. Scanned surfaces have folds that look sharp here and there.

#ifndef WEFT_SPATIAL_RUN_DROP_CREASES_3_H
#define WEFT_SPATIAL_RUN_DROP_CREASES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/visit_bad_elements_3.h>
#include <weft/spatial/surface/derive_features_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Which creases of a domain have a bad edge, or a vertex that bad elements have, too; by crease.
/// \param mesh a Restricted_delaunay_3 of the domain that `complex` describes.
template <class Restricted, class K>
std::vector<char> creases_beside_bad_elements(const Restricted& mesh, const Criteria_3<K>& criteria,
                                              const Piecewise_smooth_complex_3<K>& complex)
{
  std::vector<char> is_bad(complex.creases.size(), false), is_bad_corner(complex.features.size(), false);
  const auto blame = [&](const Vertex_location_3& at) {
    if (at.dimension == 1) is_bad[static_cast<std::size_t>(at.index)] = true;
    if (at.dimension == 0) is_bad_corner[static_cast<std::size_t>(at.index)] = true;
  };
  visit_bad_elements(
      mesh, criteria, [&](const auto& e, auto...) { is_bad[static_cast<std::size_t>(e.crease)] = true; },
      [&](const auto& f, auto...) {
        for (int i = 1; i < 4; ++i) blame(f.cell->vertex((f.index + i) % 4)->location());
      },
      [&](auto c, auto...) {
        for (int i = 0; i < 4; ++i) blame(c->vertex(i)->location());
      },
      [&](auto v) { blame(v->location()); });
  for (std::size_t c = 0; c < is_bad.size(); ++c) {
    const auto& v = complex.creases[c].vertices;
    for (std::size_t i = 0; i < complex.features.size(); ++i)
      if (is_bad_corner[i] && (complex.features[i].vertex == v.front() || complex.features[i].vertex == v.back()))
        is_bad[c] = true;
  }
  return is_bad;
}

/// Length of the longest of some creases that were found by angle, in the input's units.
template <class K>
double longest_found_crease(const Piecewise_smooth_complex_3<K>& complex, const std::vector<char>& which)
{
  double longest = 0;
  for (std::size_t c = 0; c < complex.creases.size(); ++c) {
    double length = 0;
    if (which[c] && !complex.creases[c].given)
      for_each_crease_edge(complex.creases[c], [&](std::size_t a, std::size_t b) {
        length += norm(minus(xyz(complex.points[b]), xyz(complex.points[a])));
      });
    longest = (std::max)(longest, length);
  }
  return longest;
}

/// A domain without some of its creases; given ones stay. Corners where two creases are left become cusps, those where
/// none is left are dropped; tips and cusps stay.
/// \param is_dropped by crease.
/// \returns how many were dropped.
template <class K>
std::size_t drop_creases(const std::vector<char>& is_dropped, Piecewise_smooth_complex_3<K>& complex)
{
  Sharp_edges_3 edges;
  std::size_t dropped = 0;
  for (std::size_t c = 0; c < complex.creases.size(); ++c) {
    const auto& crease = complex.creases[c];
    if (is_dropped[c] && !crease.given && ++dropped) continue;
    for_each_crease_edge(crease, [&](std::size_t a, std::size_t b) {
      edges.all.push_back({(std::min)(a, b), (std::max)(a, b)});
      if (crease.given) edges.given.push_back(edges.all.back());
    });
  }
  if (dropped == 0) return 0;
  std::sort(edges.all.begin(), edges.all.end());
  std::sort(edges.given.begin(), edges.given.end());
  std::vector<bool> stays(complex.points.size(), false);
  std::vector<bool> is_tip(complex.points.size(), false);
  for (const auto& feature : complex.features)
    (feature.kind == Feature_kind::tip ? is_tip : stays)[feature.vertex] = true;
  const Sharp_graph_3 graph(complex.points.size(), edges.all);
  for (std::size_t v = 0; v < stays.size(); ++v) stays[v] = is_tip[v] || (stays[v] && graph.degree(v) > 0);

  const auto old_patches = std::move(complex.patches);
  const auto old_sides = std::move(complex.sides);
  derive_features(edges, sorted_sides(complex.triangles), stays, 180, complex);
  complex.sides.assign(old_sides.empty() ? 0 : static_cast<std::size_t>(complex.number_of_patches), {});
  for (std::size_t t = 0; t < old_patches.size() && !old_sides.empty(); ++t)
    complex.sides[static_cast<std::size_t>(complex.patches[t])] = old_sides[static_cast<std::size_t>(old_patches[t])];
  return dropped;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_DROP_CREASES_3_H
