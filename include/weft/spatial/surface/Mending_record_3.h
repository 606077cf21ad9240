// SPDX-License-Identifier: GPL-3.0-or-later
//
// What was done to a surface so that it bounds a domain: counts, and a line for each thing.

#ifndef WEFT_SPATIAL_SURFACE_MENDING_RECORD_3_H
#define WEFT_SPATIAL_SURFACE_MENDING_RECORD_3_H

#include <weft/internal/counted.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace weft {

/// What was done to a surface. Facets are counted as triangles.
struct Mending_record_3
{
  std::size_t equal_points = 0; ///< points welded to one with the same coordinates
  std::size_t near_points = 0;  ///< points welded to one within the tolerance
  double farthest_weld = 0;     ///< how far such a point was from it, in the input's units
  std::size_t degenerate = 0;   ///< facets dropped that have no area
  std::size_t duplicate = 0;    ///< facets dropped on the vertices of another
  std::size_t split = 0;        ///< facets split at points on their edges
  std::size_t snapped = 0;      ///< points moved onto planes of facets that they nearly lay in
  std::size_t cut = 0;          ///< pairs of facets cut where they meet
  std::size_t holes = 0;        ///< closed by caps
  double area_of_caps = 0;
  std::size_t turned = 0;        ///< facets turned over
  std::size_t left_out = 0;      ///< facets that bound nothing
  std::size_t within_void = 0;   ///< facets left out with the outside on both sides
  std::size_t within_domain = 0; ///< facets left out in other parts
  double area = 0;               ///< of all facets, with the caps
  double area_left_out = 0;      ///< of those that bound nothing

  /// Adds what was done to the same surface before, but for what only the last state tells.
  void add_earlier(const Mending_record_3& earlier)
  {
    equal_points += earlier.equal_points;
    near_points += earlier.near_points;
    farthest_weld = (std::max)(farthest_weld, earlier.farthest_weld);
    degenerate += earlier.degenerate;
    duplicate += earlier.duplicate;
    split += earlier.split;
    snapped += earlier.snapped;
    cut += earlier.cut;
    holes += earlier.holes;
    area_of_caps += earlier.area_of_caps;
  }

  /// Adds what was done to another surface.
  void add(const Mending_record_3& other)
  {
    add_earlier(other);
    turned += other.turned;
    left_out += other.left_out;
    within_void += other.within_void;
    within_domain += other.within_domain;
    area += other.area;
    area_left_out += other.area_left_out;
  }

  /// One line for each thing, for people.
  std::vector<std::string> lines() const
  {
    std::vector<std::string> lines;
    const auto note = [&](std::size_t n, const char* one, const char* many, const std::string& more = "") {
      if (n > 0) lines.push_back(internal::counted(n, one, many) + more);
    };
    note(equal_points, "point was welded to an equal one", "points were welded to equal ones");
    note(near_points, "point was welded to a near one", "points were welded to near ones",
         ", at most " + brief(farthest_weld) + " away");
    note(degenerate, "degenerate facet was dropped", "degenerate facets were dropped");
    note(duplicate, "facet that is there twice was dropped", "facets that are there twice were dropped");
    note(split, "facet was split at points on its edges", "facets were split at points on their edges");
    note(snapped, "point was moved onto planes that it nearly lay in",
         "points were moved onto planes that they nearly "
         "lay in");
    note(cut, "pair of facets that intersect or touch was cut", "pairs of facets that intersect or touch were cut");
    note(holes, "hole was capped", "holes were capped",
         std::string(", ") + (holes == 1 ? "its cap is " : "their caps are ") + percent(area_of_caps / area) +
             " of the area");
    note(turned, "facet was turned over", "facets were turned over");
    note(left_out, "facet was left out, a fin or sheet that bounds nothing",
         "facets were left out, fins or sheets that bound nothing",
         ", " + percent(area_left_out / area) + " of the area");
    note(within_void, "facet with the outside on both sides was left out",
         "facets with the outside on both sides were left out");
    note(within_domain, "facet within another part was left out", "facets within other parts were left out");
    return lines;
  }

  /// \cond
  static std::string brief(double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", x);
    return text;
  }
  static std::string percent(double share) { return (share < 0.995 ? brief(100 * share) : "100") + " %"; }
  /// \endcond
};

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_MENDING_RECORD_3_H
