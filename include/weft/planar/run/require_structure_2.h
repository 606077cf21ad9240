// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether arrays are those of a planar mesh.

#ifndef WEFT_PLANAR_RUN_REQUIRE_STRUCTURE_2_H
#define WEFT_PLANAR_RUN_REQUIRE_STRUCTURE_2_H

#include <weft/errors.h>
#include <weft/planar/mesh/assemble_mesh_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <type_traits>
#include <utility>

namespace weft::internal {

template <class Mesh>
struct Is_triangle_mesh_2 : std::false_type
{};
template <class K>
struct Is_triangle_mesh_2<Triangle_mesh_2<K>> : std::true_type
{};

/// \throws Domain_error if the arrays aren't those of a mesh.
template <class K>
void require_structure(const Triangle_mesh_2<K>& mesh)
{
  Element_soup_2<K> soup;
  soup.points = mesh.points;
  soup.triangles = mesh.triangles;
  soup.triangle_tags = mesh.regions;
  soup.edges = mesh.edges;
  soup.edge_tags = mesh.edge_tags;
  soup.corners = mesh.corners;
  const Triangle_mesh_2<K> again = assemble_mesh_2(std::move(soup)).mesh;
  if (again.points.size() != mesh.points.size() || again.triangles != mesh.triangles || again.regions != mesh.regions ||
      again.edges.size() != mesh.edges.size() || again.edge_tags != mesh.edge_tags)
    throw Domain_error("the arrays aren't those of a mesh; assemble_mesh_2() makes one of points and triangles", {},
                       {});
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_REQUIRE_STRUCTURE_2_H
