// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stand-ins for models of Tournois 2009 that aren't to be had: a mushroom with input angles of 2.7 degrees (fig. 4.1),
// and solids whose facets meet at small dihedral angles (fig. 4.2).

#ifndef WEFT_BENCHMARK_REPORT_REPORT_SHAPES_H
#define WEFT_BENCHMARK_REPORT_REPORT_SHAPES_H

#include "../planar/planar_inputs.h"
#include "../spatial/spatial_inputs.h"

#include <cmath>
#include <vector>

namespace benchmark {

/// A half disk as cap whose brim ends in two tips of 2.7 degrees, on a stem.
inline Pslg mushroom()
{
  constexpr double radius = 0.5, tip = 2.7 * pi / 180, stem = 0.12, foot = -0.55;
  constexpr int steps = 32;
  // The lower side of a tip rises by the tip's angle less than the upper one, which meets the cap at its flank.
  const double reach = radius + 0.25, flank = 0.22;
  const double upper = std::atan2(flank, reach - std::sqrt(radius * radius - flank * flank));
  const double lower = (reach - stem) * std::tan(upper - tip);
  std::vector<Point> outline{Point(-stem, foot), Point(stem, foot), Point(stem, lower), Point(reach, 0)};
  const double first = std::asin(flank / radius);
  for (int i = 0; i <= steps; ++i) {
    const double angle = first + (pi - 2 * first) * i / steps;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  outline.emplace_back(-reach, 0);
  outline.emplace_back(-stem, lower);
  return loops({outline});
}

/// An upright prism over a kite, of which two facets meet at so many degrees.
inline Soup wedge(double degrees)
{
  const double half = degrees / 2 * pi / 180, wide = 0.3;
  const std::vector<std::array<double, 2>> kite{
      {0, 0}, {wide / std::tan(half), -wide}, {wide / std::tan(half) + 0.2, 0}, {wide / std::tan(half), wide}};
  Soup soup;
  for (const double z : {0., 0.8})
    for (const auto& p : kite) soup.points.emplace_back(p[0], p[1], z);
  soup.polygons = {{3, 2, 1, 0}, {4, 5, 6, 7}};
  for (std::size_t i = 0; i < 4; ++i) soup.polygons.push_back({i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4});
  return soup;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_REPORT_REPORT_SHAPES_H
