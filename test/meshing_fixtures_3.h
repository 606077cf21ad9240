// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shared by the tests that make spatial meshes: domains, criteria, and checks of everything that holds for a mesh that
// meets its criteria, or for any mesh at all.

#ifndef WEFT_TEST_MESHING_FIXTURES_3_H
#define WEFT_TEST_MESHING_FIXTURES_3_H

#include "surface_fixtures.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/criteria/check_criteria_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/validate_3.h>
#include <weft/spatial/restricted/check_restricted_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace meshing {

using surfaces::K;
using surfaces::Point;
using surfaces::Surface;
using Oracle = weft::Polyhedral_oracle_3<K>;
using Criteria = weft::Criteria_3<K>;
using Mesher = weft::internal::Spatial_mesher_3<Oracle>;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using Options = weft::Mesh_options_3;

/// No optimisation.
inline Options refinement()
{
  return Options::refinement();
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// \param angle from which on edges are sharp, in degrees.
inline Oracle oracle_of(const Surface& surface, double angle = 60)
{
  return Oracle(weft::piecewise_smooth_complex(surface.points, surface.triangles, weft::Feature_options{angle}));
}

inline Criteria criteria_of(double size, double approximation, bool topology = true)
{
  Criteria criteria;
  criteria.size = size;
  criteria.approximation = approximation;
  criteria.topology = topology;
  return criteria;
}

/// V - E + F of the boundary.
inline long euler_characteristic(const std::vector<std::array<std::size_t, 3>>& facets)
{
  std::set<std::size_t> vertices;
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (const auto& f : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      vertices.insert(f[i]);
      edges.insert(std::minmax(f[i], f[(i + 1) % 3]));
    }
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + static_cast<long>(facets.size());
}

inline std::size_t number_of_shells(const Mesh& mesh)
{
  std::vector<std::array<std::size_t, 2>> edges;
  for (const auto& f : mesh.facets) edges.insert(edges.end(), {{f[0], f[1]}, {f[1], f[2]}});
  return weft::internal::number_of_components(edges);
}

inline double volume_of_cells(const Mesh& mesh)
{
  double sum = 0;
  for (const auto& c : mesh.cells)
    sum += CGAL::volume(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]);
  return sum;
}

inline double area(const Mesh& mesh)
{
  double sum = 0;
  for (const auto& f : mesh.facets)
    sum += std::sqrt(CGAL::squared_area(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]));
  return sum;
}

/// Whether two meshes are the same to the last bit.
inline bool same(const Mesh& a, const Mesh& b)
{
  return a.points == b.points && a.locations == b.locations && a.cells == b.cells && a.facets == b.facets &&
         a.patches == b.patches && a.edges == b.edges && a.creases == b.creases;
}

/// Whatever happened: the triangulation is sound, what is kept of it is right, and the report tells what is there.
template <class Restricted>
void check_consistent(const Restricted& restricted, const weft::Mesh_report_3& report)
{
  const auto agreement = weft::check_restricted_3(restricted);
  INFO(agreement);
  CHECK(agreement.ok());
  const Mesh mesh = weft::tetrahedral_mesh(restricted);
  CHECK(report.vertices == mesh.points.size());
  CHECK(report.cells == mesh.cells.size());
  CHECK(report.facets == mesh.facets.size());
  CHECK(report.crease_edges == mesh.edges.size());
  CHECK(report.vertices ==
        report.corner_vertices + report.crease_vertices + report.patch_vertices + report.interior_vertices);
  CHECK(weft::check_structure_3(mesh).ok());
  CHECK(weft::check_orientation_3(mesh).ok());
  CHECK(weft::check_boundary_3(mesh).ok());
  if (!mesh.cells.empty()) CHECK(report.manifold == weft::check_manifold_3(mesh).ok());
  CHECK(report.ok() == (report.stop_reason == weft::Stop_reason::criteria_met));
}

/// The mesh meets its criteria and is a mesh of the whole domain.
inline void check_complete(const Mesh& mesh, const Oracle& oracle, const Criteria& criteria, double approximation)
{
  const auto& complex = oracle.complex();
  weft::Validity_3 validity = weft::validate_3(mesh);
  validity += weft::check_criteria_3(mesh, criteria);
  validity += weft::check_distances_3(mesh, oracle);
  validity += weft::check_features_3(mesh, complex);
  INFO(validity);
  CHECK(validity.ok());
  const std::set<int> patches(mesh.patches.begin(), mesh.patches.end()),
      creases(mesh.creases.begin(), mesh.creases.end());
  CHECK(patches.size() == static_cast<std::size_t>(complex.number_of_patches));
  CHECK(creases.size() == complex.creases.size());
  CHECK(number_of_shells(mesh) == static_cast<std::size_t>(complex.number_of_shells));
  CHECK(euler_characteristic(mesh.facets) == euler_characteristic(complex.triangles));
  const double volume = surfaces::volume(complex.points, complex.triangles);
  CHECK(std::abs(volume_of_cells(mesh) - volume) <= 2 * approximation * area(mesh) + 1e-9 * volume);
  const auto distance = weft::hausdorff_3(mesh, complex.points, complex.triangles, 5000);
  CHECK(distance.two_sided() <= 3 * approximation);
}

} // namespace meshing

#endif // WEFT_TEST_MESHING_FIXTURES_3_H
