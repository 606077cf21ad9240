// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where two sheets of a surface meet at a small angle: neighbours around an edge, of which there are two in the
// boundary of one domain, and any number where several subdomains meet.

#ifndef WEFT_SPATIAL_DOMAIN_SHEET_PAIRS_3_H
#define WEFT_SPATIAL_DOMAIN_SHEET_PAIRS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Two triangles at an edge with none between them.
struct Sheet_pair_3
{
  std::size_t source, target;           ///< ends of the edge
  std::array<std::size_t, 2> triangles; ///< in the order of their indices
  std::array<Xyz_3, 2> away;            ///< unit vectors in the triangles away from the edge
  double angle;                         ///< between them, radians
};

/// A vector of length 1, or 0.
inline Xyz_3 unit_vector(const Xyz_3& a)
{
  const double length = norm(a);
  return length > 0 ? Xyz_3{{a[0] / length, a[1] / length, a[2] / length}} : a;
}

/// The pairs of triangles that are neighbours around an edge and meet there at less than an angle in radians, inside or
/// outside, in the order of the edges. O(n log n) for n triangles.
template <class K>
std::vector<Sheet_pair_3> sheet_pairs_3(const Piecewise_smooth_complex_3<K>& complex, double largest_angle)
{
  const auto position = [&](std::size_t v) { return xyz(complex.points[v]); };
  const auto away_from = [&](std::size_t t, const Surface_side_3& side, const Xyz_3& along) {
    const std::size_t apex = complex.triangles[t][(side.side + 2) % 3];
    Xyz_3 away = minus(position(apex), position(side.low));
    const double shift = dot_product(away, along);
    for (std::size_t i = 0; i < 3; ++i) away[i] -= shift * along[i];
    return unit_vector(away);
  };
  std::vector<Sheet_pair_3> pairs;
  struct Sheet
  {
    double turn; ///< from the first sheet
    std::size_t triangle;
    Xyz_3 away;
  };
  std::vector<Sheet> sheets;
  for_each_edge(sorted_sides(complex.triangles), [&](auto first, auto last) {
    const Xyz_3 along = unit_vector(minus(position(first->high), position(first->low)));
    sheets.clear();
    for (auto side = first; side != last; ++side) {
      const Xyz_3 away = away_from(side->triangle, *side, along);
      const Xyz_3& zero = sheets.empty() ? away : sheets.front().away;
      double turn = std::atan2(dot_product(along, cross_product(zero, away)), dot_product(zero, away));
      if (turn < 0) turn += 2 * CGAL_PI;
      sheets.push_back({sheets.empty() ? 0 : turn, side->triangle, away});
    }
    std::stable_sort(sheets.begin(), sheets.end(), [](const Sheet& a, const Sheet& b) { return a.turn < b.turn; });
    for (std::size_t i = 0; i < sheets.size() && sheets.size() > 1; ++i) {
      Sheet a = sheets[i], b = sheets[(i + 1) % sheets.size()];
      double angle = b.turn - a.turn;
      if (i + 1 == sheets.size()) angle += 2 * CGAL_PI;
      if (!(angle < largest_angle)) continue;
      if (a.triangle > b.triangle) std::swap(a, b);
      pairs.push_back({first->low, first->high, {{a.triangle, b.triangle}}, {{a.away, b.away}}, angle});
    }
  });
  return pairs;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_SHEET_PAIRS_3_H
