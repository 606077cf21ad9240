// SPDX-License-Identifier: GPL-3.0-or-later
//
// A criterion of one's own: cells are so small that linear interpolation follows a function up to a tolerance. Small
// enough cells always satisfy it, as it has to be.

#ifndef WEFT_EXAMPLES_CUSTOM_CRITERION_H
#define WEFT_EXAMPLES_CUSTOM_CRITERION_H

#include <weft/spatial/criteria/Criteria_3.h>

#include <CGAL/Kernel/global_functions.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

/// For `Criteria_3::cell_demand`; for boundary facets there are `facet_demand` and `Facet_view_3`.
template <class K>
class Interpolation_demand
{
public:
  using Point = typename K::Point_3;

  Interpolation_demand(std::function<double(const Point&)> function, double tolerance)
      : function_(std::move(function)), tolerance_(tolerance)
  {}

  /// The error at the middle of a cell, in tolerances: cells beyond 1 are refined, the worst first.
  double operator()(const weft::Cell_view_3<K>& cell) const
  {
    // The view points to the mesh's own points; `locations` says on what they lie, `subdomain` where the cell is.
    const std::array<const Point*, 4>& p = cell.points;
    const Point middle = CGAL::centroid(*p[0], *p[1], *p[2], *p[3]);
    double interpolated = 0;
    for (const Point* corner : p) interpolated += function_(*corner) / 4;
    return std::abs(function_(middle) - interpolated) / tolerance_;
  }

private:
  std::function<double(const Point&)> function_;
  double tolerance_;
};

#endif // WEFT_EXAMPLES_CUSTOM_CRITERION_H
