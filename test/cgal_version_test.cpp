// SPDX-License-Identifier: GPL-3.0-or-later

#include <catch2/catch.hpp>

#include <weft/internal/cgal_version.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = K::Point_2;
using Segment = K::Segment_2;
using weft::internal::intersection_as;

TEST_CASE("the intersection of two segments is read as what it is, with every CGAL release")
{
  const Segment base(Point(0, 0), Point(4, 0));

  SECTION("crossing segments meet in a point")
  {
    const auto result = CGAL::intersection(base, Segment(Point(1, -1), Point(1, 1)));
    REQUIRE(intersection_as<Point>(result));
    CHECK(*intersection_as<Point>(result) == Point(1, 0));
    CHECK_FALSE(intersection_as<Segment>(result));
  }
  SECTION("overlapping segments meet in a segment")
  {
    const auto result = CGAL::intersection(base, Segment(Point(2, 0), Point(9, 0)));
    REQUIRE(intersection_as<Segment>(result));
    CHECK(intersection_as<Segment>(result)->squared_length() == 4);
    CHECK_FALSE(intersection_as<Point>(result));
  }
  SECTION("disjoint segments meet in neither")
  {
    const auto result = CGAL::intersection(base, Segment(Point(0, 1), Point(4, 1)));
    CHECK_FALSE(intersection_as<Point>(result));
    CHECK_FALSE(intersection_as<Segment>(result));
  }
}
