// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of adaptation: a new size holds, what fits stays, nothing grows in the long run, and solutions travel.

#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/adapt_3.h>
#include <weft/sizing/Lipschitz_sizing_3.h>
#include <weft/spatial/mesh/transfer_3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <catch2/catch.hpp>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace {

using meshing::K;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using Oracle = weft::Polyhedral_oracle_3<K>;
using Point = K::Point_3;
using Field = weft::Lipschitz_sizing_3<K>;

struct Edges
{
  std::size_t all = 0, too_long = 0, short_ones = 0;
};

template <class Size>
Edges edges(const Mesh& mesh, const Size& size)
{
  std::set<std::pair<std::size_t, std::size_t>> ends;
  for (const auto& c : mesh.cells)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) ends.insert(std::minmax(c[i], c[j]));
  Edges result;
  for (const auto& [a, b] : ends) {
    const double length = std::sqrt(CGAL::squared_distance(mesh.points[a], mesh.points[b])),
                 asked = size(CGAL::midpoint(mesh.points[a], mesh.points[b]));
    ++result.all;
    result.too_long += length > asked * (1 + 1e-9);
    result.short_ones += length < 0.4 * asked;
  }
  return result;
}

std::size_t vertices_in_common(const Mesh& a, const Mesh& b)
{
  const std::set<Point> points(a.points.begin(), a.points.end());
  return static_cast<std::size_t>(
      std::count_if(b.points.begin(), b.points.end(), [&](const Point& p) { return points.count(p) > 0; }));
}

double integral(const Mesh& mesh, const std::vector<double>& values)
{
  double sum = 0;
  for (const auto& c : mesh.cells)
    sum += CGAL::volume(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]) / 4 *
           (values[c[0]] + values[c[1]] + values[c[2]] + values[c[3]]);
  return sum;
}

/// A block of 4 x 4 x 4, meshed with one size.
struct Block
{
  Oracle oracle = meshing::oracle_of(surfaces::box(4, 4, 4));
  weft::Criteria_3<K> criteria;
  Mesh mesh;

  Block()
  {
    criteria.size = 0.6;
    mesh = weft::tetrahedral_mesh(weft::make_mesh_3(oracle, criteria).restricted);
  }
};

const Block& block()
{
  static const Block the_block;
  return the_block;
}

} // namespace

TEST_CASE("a size that changes nothing leaves every vertex")
{
  weft::Criteria_3<K> criteria = block().criteria;
  criteria.size = [](const Point&) { return 0.6; };
  const auto result = weft::adapt_3(block().mesh, block().oracle, criteria);
  const Mesh mesh = weft::tetrahedral_mesh(result.restricted);
  CHECK(mesh.points.size() == block().mesh.points.size());
  CHECK(vertices_in_common(mesh, block().mesh) == mesh.points.size());
  CHECK(result.report.ok());
}

TEST_CASE("a mesh adapts to a finer field and back")
{
  weft::Criteria_3<K> criteria = block().criteria;
  const Field fine([](const Point& p) { return p.x() < 0.4 ? 0.25 : 0.6; }, block().oracle.bbox(), 0.5);
  criteria.size = fine;
  const auto there = weft::adapt_3(block().mesh, block().oracle, criteria);
  const Mesh mesh = weft::tetrahedral_mesh(there.restricted);
  CHECK(there.report.ok());
  CHECK(there.report.domain.has_surface());
  CHECK(weft::validate_3(mesh).ok());
  CHECK(weft::check_restricted_3(there.restricted).ok());
  CHECK(weft::measure_quality_3(mesh).smallest_dihedral.degrees >= 20);
  const Edges now = edges(mesh, fine);
  CHECK(now.too_long == 0);
  CHECK(static_cast<double>(now.short_ones) <= 0.02 * static_cast<double>(now.all));
  // Far from what has changed everything stays.
  std::size_t far = 0;
  for (const Point& p : block().mesh.points) far += p.x() > 3;
  std::set<Point> points(mesh.points.begin(), mesh.points.end());
  std::size_t kept = 0;
  for (const Point& p : block().mesh.points) kept += p.x() > 3 && points.count(p) > 0;
  CHECK(kept == far);

  const auto back = weft::adapt_3(mesh, block().oracle, block().criteria);
  const Mesh coarse = weft::tetrahedral_mesh(back.restricted);
  CHECK(back.report.ok());
  CHECK(weft::validate_3(coarse).ok());
  CHECK(back.report.coarsened > 0);
  CHECK(static_cast<double>(coarse.points.size()) <= 1.15 * static_cast<double>(block().mesh.points.size()));
  const auto even = edges(coarse, [](const Point&) { return 0.6; });
  CHECK(even.too_long == 0);
  CHECK(static_cast<double>(even.short_ones) <= 0.02 * static_cast<double>(even.all));
}

TEST_CASE("without an oracle the boundary of a mesh is the domain, and parts keep their numbers")
{
  Mesh mesh = block().mesh;
  for (int& patch : mesh.patches) patch += 10;
  for (int& subdomain : mesh.subdomains) subdomain = 7;
  weft::Criteria_3<K> criteria;
  const Field fine([](const Point& p) { return p.z() > 3.5 ? 0.3 : 0.7; }, block().oracle.bbox(), 0.5);
  criteria.size = fine;
  const auto result = weft::adapt_3(mesh, criteria);
  CHECK(weft::validate_3(result.mesh).ok());
  CHECK(edges(result.mesh, fine).too_long == 0);
  CHECK(std::set<int>(result.mesh.subdomains.begin(), result.mesh.subdomains.end()) == std::set<int>{7});
  CHECK(std::set<int>(result.mesh.patches.begin(), result.mesh.patches.end()) ==
        std::set<int>(mesh.patches.begin(), mesh.patches.end()));
  CHECK(integral(result.mesh, std::vector<double>(result.mesh.points.size(), 1)) == Approx(64));
}

TEST_CASE("a mesh of another domain is refused")
{
  const Oracle other = meshing::oracle_of(surfaces::box(3, 4, 4));
  CHECK_THROWS_AS(weft::adapt_3(block().mesh, other, block().criteria), weft::Domain_error);
  weft::Criteria_3<K> criteria;
  CHECK_THROWS_AS(weft::adapt_3(block().mesh, block().oracle, criteria), weft::Option_error);
}

TEST_CASE("solutions travel: linear functions exactly, and integrals if they have to")
{
  weft::Criteria_3<K> criteria = block().criteria;
  criteria.size = 0.8;
  const Mesh to = weft::tetrahedral_mesh(weft::adapt_3(block().mesh, block().oracle, criteria).restricted);
  std::vector<double> linear, peak;
  for (const Point& p : block().mesh.points) {
    linear.push_back(1 + p.x() - 2 * p.y() + 3 * p.z());
    peak.push_back(std::exp(-CGAL::to_double(CGAL::squared_distance(p, Point(1, 1, 1)))));
  }
  const auto carried = weft::transfer_3(block().mesh, linear, to);
  for (std::size_t v = 0; v < to.points.size(); ++v)
    REQUIRE(carried[v] == Approx(1 + to.points[v].x() - 2 * to.points[v].y() + 3 * to.points[v].z()).margin(1e-9));
  const auto kept = weft::transfer_3(block().mesh, peak, to, weft::Transfer::conserving);
  CHECK(integral(to, kept) == Approx(integral(block().mesh, peak)).epsilon(1e-9));
  CHECK(*std::max_element(kept.begin(), kept.end()) <= *std::max_element(peak.begin(), peak.end()));
  CHECK(*std::min_element(kept.begin(), kept.end()) >= *std::min_element(peak.begin(), peak.end()));
  const std::vector<double> ones(block().mesh.points.size(), 1);
  for (const double one : weft::transfer_3(block().mesh, ones, to, weft::Transfer::conserving))
    REQUIRE(one == Approx(1).epsilon(1e-9));
  CHECK_THROWS_AS(weft::transfer_3(block().mesh, {1., 2.}, to), weft::Option_error);
}
