// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh of the domain out of a restricted Delaunay triangulation, in arrays.

#ifndef WEFT_SPATIAL_RESTRICTED_EXTRACT_MESH_3_H
#define WEFT_SPATIAL_RESTRICTED_EXTRACT_MESH_3_H

#include <weft/internal/as_index.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// The cells inside, the facets between inside and outside, the crease edges and feature vertices among them. Points
/// keep the order of their insertion; those that no cell inside uses are left out. Linear.
template <class Oracle>
Tetrahedral_mesh_3<typename Oracle::Kernel> tetrahedral_mesh(const Restricted_delaunay_3<Oracle>& restricted)
{
  using Restricted = Restricted_delaunay_3<Oracle>;
  Tetrahedral_mesh_3<typename Oracle::Kernel> mesh;
  constexpr std::size_t unused = std::size_t(-1), used = std::size_t(-2);
  std::vector<std::size_t> number(restricted.vertices().size(), unused);
  const auto number_of = [&](typename Restricted::Vertex_handle v) -> std::size_t& {
    return number[static_cast<std::size_t>(v->id())];
  };
  const auto& tr = restricted.triangulation();
  std::size_t cells = 0;
  for (const auto c : tr.finite_cell_handles()) {
    if (c->subdomain() == 0) continue;
    ++cells;
    for (int i = 0; i < 4; ++i) number_of(c->vertex(i)) = used;
  }
  const auto points = static_cast<std::size_t>(std::count(number.begin(), number.end(), used));
  mesh.points.reserve(points);
  mesh.locations.reserve(points);
  mesh.cells.reserve(cells);
  mesh.subdomains.reserve(cells);
  for (const auto v : restricted.vertices()) {
    if (v == typename Restricted::Vertex_handle() || number_of(v) == unused) continue; // null: while coarsening
    number_of(v) = mesh.points.size();
    mesh.points.push_back(v->point());
    mesh.locations.push_back(v->location());
    if (v->location().dimension == 0) mesh.corners.push_back(number_of(v));
  }
  for (const auto c : tr.finite_cell_handles()) {
    if (c->subdomain() == 0) continue;
    mesh.cells.push_back(
        {number_of(c->vertex(0)), number_of(c->vertex(1)), number_of(c->vertex(2)), number_of(c->vertex(3))});
    mesh.subdomains.push_back(c->subdomain());
    for (int i = 0; i < 4; ++i) {
      // Between two subdomains the one with the smaller number has the facet.
      const int beyond = c->neighbor(i)->subdomain();
      if (beyond == c->subdomain() || (beyond != 0 && beyond < c->subdomain())) continue;
      std::array<std::size_t, 3> facet;
      // The triple is counterclockwise seen from inside the cell.
      for (int k = 0; k < 3; ++k) facet[internal::as_index(2 - k)] = number_of(c->vertex(tr.vertex_triple_index(i, k)));
      mesh.facets.push_back(facet);
      const auto* f = restricted.facet(c, i);
      mesh.patches.push_back(f ? f->patch : 0);
    }
  }
  for (const auto& e : restricted.creases().edges()) {
    if (number_of(e.source) == unused || number_of(e.target) == unused) continue;
    mesh.edges.push_back({number_of(e.source), number_of(e.target)});
    mesh.creases.push_back(e.crease);
  }
  return mesh;
}

} // namespace weft

#endif // WEFT_SPATIAL_RESTRICTED_EXTRACT_MESH_3_H
