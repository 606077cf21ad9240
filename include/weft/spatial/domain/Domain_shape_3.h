// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of the subdomains of a spatial domain beforehand, to be compared with a mesh: volume, area, and the
// components and Euler characteristic of their boundaries.

#ifndef WEFT_SPATIAL_DOMAIN_DOMAIN_SHAPE_3_H
#define WEFT_SPATIAL_DOMAIN_DOMAIN_SHAPE_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/subdomain_boundaries_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace weft {

/// A subdomain by the numbers. Lengths are in the input's units.
struct Subdomain_shape_3
{
  double volume = 0;
  double area = 0;     ///< of its boundary
  long components = 0; ///< connected components of its boundary; -1 if that isn't known
  long euler = 0;      ///< V - E + F of its boundary: twice the components less the handles, where it is a 2-manifold
};

/// The subdomains of a domain or a mesh, by their numbers.
using Domain_shape_3 = std::map<int, Subdomain_shape_3>;

namespace internal {

/// The shape of one subdomain out of the triangles of its boundary, which look outwards. O(n log n).
/// \param origin a point near the triangles, so that volumes don't suffer from cancellation.
template <class Point>
Subdomain_shape_3 shape_of_boundary(const std::vector<Point>& points, const Xyz_3& origin,
                                    const std::vector<std::array<std::size_t, 3>>& facets)
{
  Subdomain_shape_3 shape;
  for (const auto& f : facets) {
    const Xyz_3 a = minus(xyz(points[f[0]]), origin), b = minus(xyz(points[f[1]]), origin),
                c = minus(xyz(points[f[2]]), origin);
    shape.volume += dot_product(a, cross_product(b, c)) / 6;
    shape.area += norm(cross_product(minus(b, a), minus(c, a))) / 2;
  }
  const std::array<long, 2> topology = topology_of_facets(facets);
  shape.euler = topology[0], shape.components = topology[1];
  return shape;
}

/// Of all subdomains, out of facets that are given once for each subdomain beside them, looking out of it.
template <class Point>
Domain_shape_3 shape_of_boundaries(const std::vector<Point>& points, const std::vector<Boundary_facet_3>& boundaries)
{
  std::map<int, std::vector<std::array<std::size_t, 3>>> facets;
  for (const Boundary_facet_3& facet : boundaries) facets[facet.subdomain].push_back(facet.vertices);
  Domain_shape_3 shapes;
  for (const auto& [subdomain, own] : facets)
    shapes[subdomain] = shape_of_boundary(points, xyz(points[own.front().front()]), own);
  return shapes;
}

} // namespace internal

/// The shape that a mesh has. O(n log n).
template <class K>
Domain_shape_3 shape_of_mesh(const Tetrahedral_mesh_3<K>& mesh)
{
  return internal::shape_of_boundaries(mesh.points, internal::subdomain_boundaries(mesh));
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_DOMAIN_SHAPE_3_H
