// SPDX-License-Identifier: GPL-3.0-or-later
//
// What weft is measured against in space: CGAL's make_mesh_3 without its optimisers, with the same bounds in its terms.

#ifndef WEFT_BENCHMARK_SPATIAL_SPATIAL_PEERS_H
#define WEFT_BENCHMARK_SPATIAL_SPATIAL_PEERS_H

#include "spatial_inputs.h"

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/make_mesh_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/version.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace benchmark {

/// Bounds for both meshers, in parts of the domain's longest side.
struct Bounds
{
  double size = 0;          ///< longest edge
  double approximation = 0; ///< distance to the surface; 0: none
  double shape = 2;         ///< largest circumradius / shortest edge of facets and cells
  bool circumradii = false; ///< whether weft, too, is given bounds of circumradii instead of edges

  double facet_radius() const { return size / std::sqrt(3.); }
  double cell_radius() const { return size * std::sqrt(6.) / 4; }
};

using Cgal_polyhedron = CGAL::Mesh_polyhedron_3<Spatial_kernel>::type;
/// Without detected features it makes the mesh that Polyhedral_mesh_domain_3 makes, in the same time.
using Cgal_domain = CGAL::Polyhedral_mesh_domain_with_features_3<Spatial_kernel>;
using Cgal_triangulation = CGAL::Mesh_triangulation_3<Cgal_domain>::type;
using Cgal_complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Cgal_triangulation, Cgal_domain::Corner_index, Cgal_domain::Curve_index>;

inline Cgal_polyhedron polyhedron(const Complex& complex)
{
  std::vector<std::array<std::size_t, 3>> triangles = complex.triangles;
  Cgal_polyhedron result;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(complex.points, triangles, result);
  return result;
}

/// CGAL's bounds are those of circumradii: 1 / sqrt(3) of the edge of a regular triangle, sqrt(6) / 4 of that of a
/// regular tetrahedron. A triangle's circumradius / shortest edge is 1 / (2 sin(smallest angle)).
template <class Triangulation = Cgal_triangulation>
auto cgal_criteria(const Bounds& bounds, double edge_size)
{
  namespace with = CGAL::parameters;
  const double angle = std::asin(1 / (2 * bounds.shape)) * 180 / std::acos(-1.);
  return CGAL::Mesh_criteria_3<Triangulation>(
      with::edge_size = edge_size,
#if CGAL_VERSION_NR >= 1060000000
      with::edge_distance = bounds.approximation, // 5.x has no such bound
#endif
      with::facet_angle = angle, with::facet_size = bounds.facet_radius(), with::facet_distance = bounds.approximation,
      with::cell_radius_edge_ratio = bounds.shape, with::cell_size = bounds.cell_radius());
}

inline Cgal_complex mesh_with_cgal(const Cgal_domain& domain, const Bounds& bounds, double edge_size)
{
  return CGAL::make_mesh_3<Cgal_complex>(domain, cgal_criteria(bounds, edge_size), CGAL::parameters::no_perturb(),
                                         CGAL::parameters::no_exude());
}

/// The cells and facets of CGAL's complex. Locations of vertices are left at their defaults.
inline weft::Tetrahedral_mesh_3<Spatial_kernel> arrays(const Cgal_complex& complex)
{
  weft::Tetrahedral_mesh_3<Spatial_kernel> mesh;
  std::map<Cgal_complex::Vertex_handle, std::size_t> numbers;
  const auto number = [&](Cgal_complex::Vertex_handle v) {
    const auto [found, is_new] = numbers.insert({v, mesh.points.size()});
    if (is_new) mesh.points.push_back(v->point().point());
    return found->second;
  };
  for (auto c = complex.cells_in_complex_begin(); c != complex.cells_in_complex_end(); ++c) {
    mesh.cells.push_back({number(c->vertex(0)), number(c->vertex(1)), number(c->vertex(2)), number(c->vertex(3))});
    mesh.subdomains.push_back(1);
  }
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f) {
    std::array<std::size_t, 3> facet;
    const bool outside = !complex.is_in_complex(f->first);
    for (int i = 0; i < 3; ++i)
      facet[outside ? i : 2 - i] = number(f->first->vertex(Cgal_triangulation::vertex_triple_index(f->second, i)));
    mesh.facets.push_back(facet);
    mesh.patches.push_back(0);
  }
  mesh.locations.resize(mesh.points.size());
  return mesh;
}

/// Facets of CGAL's complex that don't separate the domain from the outside.
inline std::size_t dangling_facets(const Cgal_complex& complex)
{
  std::size_t count = 0;
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f)
    count += complex.is_in_complex(f->first) == complex.is_in_complex(f->first->neighbor(f->second));
  return count;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_SPATIAL_SPATIAL_PEERS_H
