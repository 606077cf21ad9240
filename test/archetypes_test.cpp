// SPDX-License-Identifier: GPL-3.0-or-later
//
// The manual's concepts ask for everything that is called: meshers compile and run with archetypes that have nothing
// but what their pages in doc/concepts say, and make the same meshes with them as with the models behind them. In the
// plane: archetypes_2_test.cpp.

#include "concepts/DomainOracle_3.h"
#include "concepts/SizingField.h"
#include "concepts/Smoother_3.h"
#include "fixtures/meshing_fixtures_3.h"
#include "fixtures/surface_fixtures.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/optimise/smooth_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <catch2/catch.hpp>

#include <cstddef>

namespace {

using meshing::K;
using Model = meshing::Oracle;
using Oracle = concepts::DomainOracle_3<Model>;
using Point_3 = K::Point_3;

template <class Mesh>
std::vector<typename Mesh::Point> points_of(const Mesh& mesh)
{
  return weft::tetrahedral_mesh(mesh).points;
}

} // namespace

TEST_CASE("make_mesh_3 and smooth_3 need no more than the concepts of oracles, lengths, demands and smoothers say")
{
  const Model model = meshing::oracle_of(surfaces::box(1, 1, 1));
  const Oracle oracle(model);

  const auto sizes = [](const Point_3& p) { return 0.25 + 0.2 * p.x(); };
  const auto demand = [](const weft::Cell_view_3<K>& cell) {
    return CGAL::squared_distance(*cell.points[0], *cell.circumcenter) > 0.04 ? 2. : 0.5;
  };
  weft::Criteria_3<K> criteria;
  criteria.size = concepts::SizingField<Point_3, decltype(sizes)>(sizes);
  criteria.approximation = 0.05;
  criteria.cell_demand = concepts::ElementDemand_3<weft::Cell_view_3<K>, decltype(demand)>(demand);
  const auto facet_demand = [](const weft::Facet_view_3<K>& facet) {
    return CGAL::squared_distance(*facet.points[0], *facet.center) > 0.02 ? 2. : 0.5;
  };
  criteria.facet_demand = concepts::ElementDemand_3<weft::Facet_view_3<K>, decltype(facet_demand)>(facet_demand);

  auto result = weft::make_mesh_3(oracle, criteria);
  CHECK(result.report.ok());
  auto expected = weft::make_mesh_3(model, criteria);
  CHECK(points_of(result.restricted) == points_of(expected.restricted));

  const weft::Natural_odt_3 odt;
  weft::smooth_3(result.restricted, criteria, weft::Smooth_options_3(), concepts::Smoother_3<weft::Natural_odt_3>(odt));
  weft::smooth_3(expected.restricted, criteria, weft::Smooth_options_3(), odt);
  CHECK(points_of(result.restricted) == points_of(expected.restricted));
}

TEST_CASE("make_mesh_3 needs no more than the concept says of oracles that are asked for labels first")
{
  const Model model = meshing::oracle_of(surfaces::box(1, 1, 1));
  const concepts::DomainOracle_3<Model, true> oracle(model);
  weft::Criteria_3<K> criteria;
  criteria.size = 0.3;
  const auto result = weft::make_mesh_3(oracle, criteria);
  CHECK(result.report.ok());
  const auto mesh = weft::tetrahedral_mesh(result.restricted);
  CHECK(mesh.cells.size() > 100);
  CHECK(weft::validate_3(mesh).ok());
}
