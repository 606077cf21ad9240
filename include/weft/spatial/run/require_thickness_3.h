// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refuses domains that are too thin before any work is done: cells with good angles are no longer than the domain is
// thick, so that a thin one takes more vertices than there may be, or cells below the size floor.

#ifndef WEFT_SPATIAL_RUN_REQUIRE_THICKNESS_3_H
#define WEFT_SPATIAL_RUN_REQUIRE_THICKNESS_3_H

#include <weft/errors.h>
#include <weft/internal/Answers.h>
#include <weft/spatial/criteria/Criteria_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

template <class Oracle, class = void>
struct Has_spread_points_3 : std::false_type
{};
template <class Oracle>
struct Has_spread_points_3<
    Oracle, std::void_t<decltype(std::declval<const Oracle&>().visit_spread_points(std::size_t(1), Ignore()))>>
    : std::true_type
{};

/// O(size of the domain), and some hundred queries. Of oracles without `visit_spread_points()` nothing is known.
/// \param most_vertices that the mesh may have.
/// \throws Domain_error if a fifth of the boundary is nearer to another part of it than the size floor, or if the mesh
///   would take more vertices than it may have; says how thin the domain is, where, and what to do.
template <class Oracle>
void require_thickness(const Oracle& oracle, const Criteria_3<typename Oracle::Kernel>& criteria, double size_floor,
                       std::size_t most_vertices)
{
  if constexpr (Has_spread_points_3<Oracle>::value) {
    using Point = typename Oracle::Point;
    constexpr std::size_t samples = 400;
    constexpr double per_square = 0.55; // vertices per area in squares of the thickness: measured on rods and plates
    constexpr double much = 0.2;        // of the boundary; the thinnest parts are rims and tips, graded towards them
    const CGAL::Bbox_3 b = oracle.bbox();
    const double extent = (std::max)({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
    const double reach = criteria.size.is_constant() ? (std::min)(criteria.size.constant(), extent) : extent;
    std::vector<std::pair<double, Point>> thickness;
    double area_of_each = 0;
    oracle.visit_spread_points(samples, [&](const Point& p, const std::array<double, 3>& normal, double area) {
      thickness.emplace_back(oracle.thickness(p, normal, reach), p);
      area_of_each = area;
    });
    if (thickness.empty()) return;
    std::sort(thickness.begin(), thickness.end());
    const auto first = static_cast<std::size_t>(much * static_cast<double>(thickness.size()));
    const auto& [thinnest, where] = thickness[first];
    double vertices = 0;
    for (std::size_t i = first; i < thickness.size(); ++i)
      if (thickness[i].first < reach) vertices += per_square * area_of_each / (thickness[i].first * thickness[i].first);
    const bool is_flat = thinnest < size_floor;
    if (!is_flat && vertices <= static_cast<double>(most_vertices)) return;
    std::ostringstream text;
    text << (is_flat ? "flat" : "too thin") << ": thickness " << thinnest << " at (" << where.x() << ", " << where.y()
         << ", " << where.z() << "), " << thinnest / extent << " of its length";
    if (is_flat)
      text << ", below the size floor " << size_floor << "; give a smaller floor, or mesh it as a surface in the plane";
    else
      text << ": would take about " << vertices << " vertices, more than the " << most_vertices
           << " allowed; allow more, or make it thicker";
    throw Domain_error(text.str(), {}, {});
  } else {
    static_cast<void>(oracle), static_cast<void>(criteria), static_cast<void>(size_floor);
    static_cast<void>(most_vertices);
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_REQUIRE_THICKNESS_3_H
