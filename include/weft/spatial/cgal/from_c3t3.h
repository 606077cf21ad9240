// SPDX-License-Identifier: GPL-3.0-or-later
//
// From CGAL's Mesh_complex_3_in_triangulation_3 to weft's meshes: the inverse of to_c3t3.h. Indices of patches, creases
// and corners of any type are numbered in the order in which they are met, unless they are integers.

#ifndef WEFT_SPATIAL_CGAL_FROM_C3T3_H
#define WEFT_SPATIAL_CGAL_FROM_C3T3_H

#include <weft/spatial/mesh/assemble_mesh_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// One of CGAL's indices as a tag: an integer as it is, anything else by its number.
template <class Index>
class Index_tags
{
public:
  int operator()(const Index& index)
  {
    if constexpr (std::is_integral_v<Index>)
      return static_cast<int>(index);
    else
      return number_.emplace(index, static_cast<int>(number_.size()) + 1).first->second;
  }

private:
  std::map<Index, int> number_;
};

/// Edges and corners of complexes that have features.
template <class C3t3, class Number, class Soup>
void add_features(const C3t3& c3t3, const Number& number, Soup& soup)
{
  Index_tags<typename C3t3::Curve_index> crease;
  for (auto edge = c3t3.edges_in_complex_begin(); edge != c3t3.edges_in_complex_end(); ++edge) {
    const auto v = edge->first->vertex(edge->second), w = edge->first->vertex(edge->third);
    soup.edges.push_back({number(v), number(w)});
    soup.edge_tags.push_back(crease(c3t3.curve_index(v, w)));
  }
  std::map<std::size_t, int> corners;
  Index_tags<typename C3t3::Corner_index> corner;
  for (auto v = c3t3.vertices_in_complex_begin(); v != c3t3.vertices_in_complex_end(); ++v)
    corners.emplace(number(v), corner(c3t3.corner_index(v)));
  std::vector<std::pair<int, std::size_t>> by_index;
  for (const auto& [v, index] : corners) by_index.emplace_back(index, v);
  std::sort(by_index.begin(), by_index.end());
  for (const auto& index_and_vertex : by_index) soup.corners.push_back(index_and_vertex.second);
}

} // namespace internal

/// The mesh of a C3t3: its cells, the facets, edges and corners in the complex with their indices. Integer indices are
/// tags as in `assemble_mesh_3()`; so what `to_c3t3()` makes comes back as it was, up to the order of its elements.
/// Vertices are in the order in which the triangulation lists them.
/// \throws Domain_error as `assemble_mesh_3()` does.
template <class C3t3>
auto from_c3t3(const C3t3& c3t3)
{
  using Triangulation = typename C3t3::Triangulation;
  using Vertex_handle = typename C3t3::Vertex_handle;
  using K = typename CGAL::Kernel_traits<typename Triangulation::Bare_point>::Kernel;
  const Triangulation& triangulation = c3t3.triangulation();
  Element_soup_3<K> soup;
  CGAL::Unique_hash_map<Vertex_handle, std::size_t> numbers;
  CGAL::Unique_hash_map<Vertex_handle, bool> is_used(false);
  for (auto cell = c3t3.cells_in_complex_begin(); cell != c3t3.cells_in_complex_end(); ++cell)
    for (int i = 0; i < 4; ++i) is_used[cell->vertex(i)] = true;
  for (const Vertex_handle v : triangulation.finite_vertex_handles()) {
    if (!is_used[v]) continue;
    numbers[v] = soup.points.size();
    const auto& p = triangulation.point(v);
    soup.points.emplace_back(p.x(), p.y(), p.z());
  }
  const auto number = [&numbers](Vertex_handle v) { return numbers[v]; };
  internal::Index_tags<typename C3t3::Subdomain_index> subdomain;
  for (auto cell = c3t3.cells_in_complex_begin(); cell != c3t3.cells_in_complex_end(); ++cell) {
    soup.cells.push_back(
        {number(cell->vertex(0)), number(cell->vertex(1)), number(cell->vertex(2)), number(cell->vertex(3))});
    soup.cell_tags.push_back(subdomain(c3t3.subdomain_index(cell)));
  }
  internal::Index_tags<typename C3t3::Surface_patch_index> patch;
  for (auto facet = c3t3.facets_in_complex_begin(); facet != c3t3.facets_in_complex_end(); ++facet) {
    std::array<std::size_t, 3> vertices{};
    for (int k = 0; k < 3; ++k)
      vertices[static_cast<std::size_t>(k)] = number(facet->first->vertex((facet->second + 1 + k) & 3));
    soup.facets.push_back(vertices);
    soup.facet_tags.push_back(patch(c3t3.surface_patch_index(*facet)));
  }
  internal::add_features(c3t3, number, soup);
  return assemble_mesh_3(std::move(soup));
}

} // namespace weft

#endif // WEFT_SPATIAL_CGAL_FROM_C3T3_H
