// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's own mesh domains and criteria: implicit and image. Those of surfaces are in cgal_complexes_test.cpp.

#include "fixtures/labeled_cgal_domain.h"

#include <CGAL/Image_3.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <utility>

namespace {

namespace parameters = CGAL::parameters;
using namespace cgal_domains;

double sphere(const Point& p)
{
  return CGAL::squared_distance(p, Point(0, 0, 0)) - 1;
}

} // namespace

TEST_CASE("CGAL's implicit domain is meshed to CGAL's criteria")
{
  const Labeled_domain domain = Labeled_domain::create_implicit_mesh_domain(sphere, K::Sphere_3(Point(0, 0, 0), 2.));
  const Labeled_criteria criteria(parameters::facet_angle = 30, parameters::facet_size = 0.25,
                                  parameters::facet_distance = 0.02, parameters::cell_radius_edge_ratio = 2,
                                  parameters::cell_size = 0.25);
  weft::Mesh_report_3 report;
  const auto c3t3 = weft::make_mesh_3<Labeled_c3t3>(domain, criteria, weft::Mesh_options_3(), &report);
  CHECK(report.ok());
  CHECK(report.smallest_dihedral >= 20);
  CHECK(count_bad(c3t3, criteria) == 0);
  CHECK(c3t3.is_valid());
  CHECK(c3t3.triangulation().is_valid());
  CHECK(c3t3.number_of_cells_in_complex() == report.cells);
  CHECK(volumes(c3t3)[1] == Approx(4 * std::acos(-1.) / 3).epsilon(0.03));
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f)
    CHECK(std::abs(sphere(f->first->get_facet_surface_center(f->second))) < 1e-3);
}

TEST_CASE("sizing fields and criteria of any kind are asked where elements are")
{
  const Labeled_domain domain = Labeled_domain::create_implicit_mesh_domain(sphere, K::Sphere_3(Point(0, 0, 0), 2.));
  struct Field
  {
    using FT = K::FT;
    using Point_3 = Point;
    using Index = Labeled_domain::Index;
    FT operator()(const Point_3& p, int, const Index&) const { return 0.08 + 0.3 * std::abs(p.x()); }
  };
  const Labeled_criteria criteria(parameters::facet_angle = 25, parameters::facet_size = Field(),
                                  parameters::facet_distance = 0.05, parameters::cell_radius_edge_ratio = 2.5,
                                  parameters::cell_size = Field());
  const auto c3t3 = weft::make_mesh_3<Labeled_c3t3>(domain, criteria, weft::Mesh_options_3::refinement());
  CHECK(count_bad(c3t3, criteria) == 0);
  CHECK(c3t3.number_of_cells_in_complex() > 1000);
}

TEST_CASE("CGAL's image domain is meshed with its labels")
{
  constexpr std::size_t n = 24;
  _image* raw = _createImage(n, n, n, 1, 0.1, 0.1, 0.1, 1, WK_FIXED, SGN_UNSIGNED);
  auto* voxels = static_cast<unsigned char*>(raw->data);
  for (std::size_t z = 0; z < n; ++z)
    for (std::size_t y = 0; y < n; ++y)
      for (std::size_t x = 0; x < n; ++x) {
        const double r = std::hypot(x - 11.5, y - 11.5, z - 11.5);
        voxels[(z * n + y) * n + x] = r > 9 ? 0 : x < 12 ? 4 : 7;
      }
  const CGAL::Image_3 image(raw);
  const Labeled_domain domain = Labeled_domain::create_labeled_image_mesh_domain(image);
  const Labeled_criteria criteria(parameters::facet_angle = 30, parameters::facet_size = 0.4,
                                  parameters::facet_distance = 0.08, parameters::cell_radius_edge_ratio = 3,
                                  parameters::cell_size = 0.4);
  weft::Mesh_report_3 report;
  const auto c3t3 = weft::make_mesh_3<Labeled_c3t3>(domain, criteria, weft::Mesh_options_3(), &report);
  CHECK(report.ok());
  CHECK(count_bad(c3t3, criteria) == 0);
  auto volume = volumes(c3t3);
  REQUIRE(volume.size() == 2);
  CHECK(volume[4] == Approx(volume[7]).epsilon(0.1));
  std::set<std::pair<int, int>> patches;
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) {
    const auto index = c3t3.surface_patch_index(*f);
    patches.emplace(index.first, index.second);
  }
  CHECK(patches == std::set<std::pair<int, int>>{{0, 4}, {0, 7}, {4, 7}});
}

TEST_CASE("an empty CGAL domain is refused")
{
  const Labeled_domain domain =
      Labeled_domain::create_implicit_mesh_domain([](const Point&) { return 1.; }, K::Sphere_3(Point(0, 0, 0), 2.));
  const Labeled_criteria criteria(parameters::cell_size = 0.25);
  CHECK_THROWS_AS(weft::make_mesh_3<Labeled_c3t3>(domain, criteria), weft::Domain_error);
}
