// SPDX-License-Identifier: GPL-3.0-or-later
//
// From weft's meshes to CGAL's Mesh_complex_3_in_triangulation_3, with subdomains, patches, creases and feature
// vertices, so that CGAL's mesh optimisers, writers and whatever else takes a C3t3 work on them.
//
// CGAL keeps its complex in a regular triangulation of the whole convex hull; without weights that is the Delaunay
// triangulation. CGAL breaks ties between cospherical points by the lexicographic order of their coordinates alone, in
// Delaunay and regular triangulations alike (Devillers and Teillaud, "Perturbations for Delaunay and weighted Delaunay
// 3D triangulations", 2011): every cell of weft's triangulation is a cell of the regular triangulation of its vertices,
// and stays one when vertices without a cell in the domain, such as the corners of weft's box, are left out. So the
// points alone suffice where a mesh comes from such a triangulation. Where ties were broken in another way, by flips
// for instance, the triangulation has to be given: its cells are then copied one by one.

#ifndef WEFT_SPATIAL_CGAL_TO_C3T3_H
#define WEFT_SPATIAL_CGAL_TO_C3T3_H

#include <weft/errors.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Mesh_triangulation_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {

/// The types of indices that CGAL wants to know of a mesh domain, where no domain is at hand.
template <class K>
struct C3t3_indices
{
  using R = K;
  using Subdomain_index = int;
  using Surface_patch_index = int;
  using Curve_index = int;
  using Corner_index = int;
  using Index = int;
};

/// A C3t3 whose indices are integers; other C3t3 types are named by their users.
template <class K>
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<typename CGAL::Mesh_triangulation_3<C3t3_indices<K>, K>::type>;

namespace internal {

template <class Wanted, class K>
using C3t3_or_default = std::conditional_t<std::is_void_v<Wanted>, C3t3<K>, Wanted>;

/// A number as one of CGAL's indices: an integer, or the pair of subdomains that labelled domains name patches by.
template <class Index>
Index index_from(int i)
{
  if constexpr (std::is_constructible_v<Index, int>)
    return Index(i);
  else
    return Index(0, i);
}

/// What a C3t3 calls things where no domain is at hand: the same numbers, but from 1 since 0 means "none".
template <class C3t3>
struct Numbered_indices_3
{
  typename C3t3::Corner_index corner_index(int i) const { return index_from<typename C3t3::Corner_index>(i + 1); }
  typename C3t3::Curve_index curve_index(int i) const { return index_from<typename C3t3::Curve_index>(i + 1); }
  typename C3t3::Surface_patch_index surface_patch_index(int i) const
  {
    return index_from<typename C3t3::Surface_patch_index>(i + 1);
  }
  typename C3t3::Subdomain_index subdomain_index(int i) const { return index_from<typename C3t3::Subdomain_index>(i); }
  typename C3t3::Index index(const Vertex_location_3& at) const
  {
    using Index = typename C3t3::Index;
    switch (at.dimension) {
    case 0:
      return Index(corner_index(at.index));
    case 1:
      return Index(curve_index(at.index));
    case 2:
      return Index(surface_patch_index(at.index));
    default:
      return Index(subdomain_index(at.index));
    }
  }
};

[[noreturn]] inline void refuse_cell(std::size_t cell, const char* what)
{
  throw Domain_error("cell " + std::to_string(cell) + " of the mesh " + what, {}, {cell});
}

/// Adds all elements of the mesh to the complex.
/// \param vertex the vertices of the triangulation, in the mesh's order.
/// \param indices what they are called.
template <class C3t3, class K, class Indices>
void add_elements(C3t3& c3t3, const Tetrahedral_mesh_3<K>& mesh,
                  const std::vector<typename C3t3::Vertex_handle>& vertex, const Indices& indices)
{
  const auto& triangulation = c3t3.triangulation();
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& v = mesh.cells[c];
    typename C3t3::Cell_handle cell;
    if (!triangulation.is_cell(vertex[v[0]], vertex[v[1]], vertex[v[2]], vertex[v[3]], cell))
      refuse_cell(c, "isn't one of the Delaunay triangulation");
    c3t3.add_to_complex(cell, indices.subdomain_index(mesh.subdomains[c]));
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& v = mesh.facets[f];
    typename C3t3::Cell_handle cell;
    int i = 0, j = 0, k = 0;
    if (!triangulation.is_facet(vertex[v[0]], vertex[v[1]], vertex[v[2]], cell, i, j, k))
      throw Domain_error("facet " + std::to_string(f) + " of the mesh isn't one of the triangulation", {}, {f});
    c3t3.add_to_complex(cell, 6 - i - j - k, indices.surface_patch_index(mesh.patches[f]));
  }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    c3t3.add_to_complex(vertex[mesh.edges[e][0]], vertex[mesh.edges[e][1]], indices.curve_index(mesh.creases[e]));
  // Last, for CGAL sets dimensions of its own while elements are added.
  for (std::size_t v = 0; v < vertex.size(); ++v) {
    const Vertex_location_3& at = mesh.locations[v];
    if (at.dimension == 0) c3t3.add_to_complex(vertex[v], indices.corner_index(at.index));
    c3t3.set_index(vertex[v], indices.index(at));
    c3t3.set_dimension(vertex[v], at.dimension);
  }
}

/// A vertex or cell of CGAL's that a container will number; copies would keep the number of their original.
template <class Element>
Element without_time_stamp()
{
  Element element;
  element.set_time_stamp(static_cast<std::size_t>(-1));
  return element;
}

/// What copies a triangulation data structure into one with other vertices and cells.
template <class Source, class Target>
struct Vertex_copier_3
{
  Target operator()(const Source&) const { return without_time_stamp<Target>(); }
  void operator()(const Source& from, Target& to) const { to.set_point(typename Target::Point(from.point())); }
};
template <class Source, class Target>
struct Cell_copier_3
{
  Target operator()(const Source&) const { return without_time_stamp<Target>(); }
  void operator()(const Source&, Target&) const {}
};

} // namespace internal

/// Makes a C3t3 of a mesh by triangulating its points; see the top of the file. Indices of patches, creases and feature
/// vertices are weft's + 1, subdomains are the same. O(n log n) time.
/// \tparam Wanted the type of C3t3; its indices must be constructible from int, or be pairs of ints. void: C3t3<K>.
/// \throws Domain_error if a cell isn't one of the Delaunay triangulation of the mesh's points.
template <class Wanted = void, class K>
internal::C3t3_or_default<Wanted, K> to_c3t3(const Tetrahedral_mesh_3<K>& mesh)
{
  const internal::Numbered_indices_3<internal::C3t3_or_default<Wanted, K>> indices;
  using C3t3 = internal::C3t3_or_default<Wanted, K>;
  using Vertex_handle = typename C3t3::Vertex_handle;
  C3t3 c3t3;
  auto& triangulation = c3t3.triangulation();
  std::vector<std::pair<typename K::Point_3, std::size_t>> sites;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) sites.emplace_back(mesh.points[v], v);
  using First = CGAL::First_of_pair_property_map<std::pair<typename K::Point_3, std::size_t>>;
  CGAL::spatial_sort(sites.begin(), sites.end(), CGAL::Spatial_sort_traits_adapter_3<K, First>());
  std::vector<Vertex_handle> vertex(mesh.points.size());
  typename C3t3::Cell_handle hint;
  for (const auto& [p, v] : sites) {
    vertex[v] = triangulation.insert(typename C3t3::Triangulation::Weighted_point(p), hint);
    hint = vertex[v]->cell();
  }
  internal::add_elements(c3t3, mesh, vertex, indices);
  return c3t3;
}

/// Makes a C3t3 of a mesh by copying the Delaunay triangulation that holds its cells, whatever way ties were broken
/// there. Vertices that aren't of the mesh are left out, the corners of weft's box among them. O(n log n)
/// time.
/// \param indices what corners, creases, patches and subdomains are called in the C3t3, see Mesh_domain_oracle_3.
/// \throws Domain_error if a vertex or cell of the mesh isn't one of the triangulation.
template <class Wanted = void, class K,
          class Indices = internal::Numbered_indices_3<internal::C3t3_or_default<Wanted, K>>>
internal::C3t3_or_default<Wanted, K> to_c3t3(const Mesh_triangulation_3<K>& source, const Tetrahedral_mesh_3<K>& mesh,
                                             const Indices& indices = Indices())
{
  using C3t3 = internal::C3t3_or_default<Wanted, K>;
  using Target = typename C3t3::Triangulation;
  using Vertex_handle = typename C3t3::Vertex_handle;
  C3t3 c3t3;
  Target& target = c3t3.triangulation();
  using Source_tds = typename Mesh_triangulation_3<K>::Triangulation_data_structure;
  using Target_tds = typename Target::Triangulation_data_structure;
  target.set_infinite_vertex(
      target.tds().copy_tds(source.tds(), source.infinite_vertex(),
                            internal::Vertex_copier_3<typename Source_tds::Vertex, typename Target_tds::Vertex>(),
                            internal::Cell_copier_3<typename Source_tds::Cell, typename Target_tds::Cell>()));
  // Vertices are recognised by their coordinates: no two are at the same place.
  std::map<typename K::Point_3, std::size_t> number;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) number.emplace(mesh.points[v], v);
  std::vector<Vertex_handle> vertex(mesh.points.size()), others;
  for (const Vertex_handle v : target.finite_vertex_handles()) {
    const auto found = number.find(typename K::Point_3(v->point().point()));
    if (found == number.end())
      others.push_back(v);
    else
      vertex[found->second] = v;
  }
  for (std::size_t v = 0; v < vertex.size(); ++v)
    if (vertex[v] == Vertex_handle())
      throw Domain_error("vertex " + std::to_string(v) + " of the mesh isn't one of the triangulation", {v}, {});
  // Before anything is added: facets are marked on both sides, and cells beside the boundary go with such a vertex.
  for (const Vertex_handle v : others) target.remove(v);
  internal::add_elements(c3t3, mesh, vertex, indices);
  return c3t3;
}

/// Makes a C3t3 of what `make_mesh_3()` returns, as above, with the centers of the surface Delaunay balls of its
/// boundary facets, which CGAL's criteria and optimisers look at.
template <class Wanted = void, class Oracle,
          class Indices = internal::Numbered_indices_3<internal::C3t3_or_default<Wanted, typename Oracle::Kernel>>>
internal::C3t3_or_default<Wanted, typename Oracle::Kernel> to_c3t3(const Restricted_delaunay_3<Oracle>& restricted,
                                                                   const Indices& indices = Indices())
{
  using Point = typename Oracle::Kernel::Point_3;
  auto c3t3 = to_c3t3<Wanted>(restricted.triangulation(), tetrahedral_mesh(restricted), indices);
  using C3t3 = decltype(c3t3);
  std::map<Point, typename C3t3::Vertex_handle> vertex_at;
  for (const auto v : c3t3.triangulation().finite_vertex_handles()) vertex_at[Point(v->point().point())] = v;
  for (const auto& f : restricted.facets()) {
    if (f.cell == typename Restricted_delaunay_3<Oracle>::Cell_handle() || !restricted.is_boundary(f)) continue;
    typename C3t3::Cell_handle cell;
    int i, j, k;
    const auto vertex = [&](int n) { return vertex_at.at(f.cell->vertex((f.index + n) & 3)->point()); };
    c3t3.triangulation().is_facet(vertex(1), vertex(2), vertex(3), cell, i, j, k);
    const auto neighbour = cell->neighbor(6 - i - j - k);
    for (const auto& [c, n] : {std::pair(cell, 6 - i - j - k), std::pair(neighbour, neighbour->index(cell))}) {
      c->set_facet_surface_center(n, f.steiner);
      c->set_facet_surface_center_index(n, indices.index({2, f.patch}));
    }
  }
  return c3t3;
}

} // namespace weft

#endif // WEFT_SPATIAL_CGAL_TO_C3T3_H
