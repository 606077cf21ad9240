// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh as a file or a caller's arrays have it, before anything is known about how its elements fit
// together: what the readers return and `assemble_mesh_3()` takes.

#ifndef WEFT_SPATIAL_MESH_ELEMENT_SOUP_3_H
#define WEFT_SPATIAL_MESH_ELEMENT_SOUP_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// Points and elements that refer to them by position, each with a tag of the caller's. Lists of tags may be empty:
/// then all elements of that kind are alike.
/// \tparam K a CGAL kernel.
template <class K>
struct Element_soup_3
{
  using Kernel = K;
  using Point = typename K::Point_3;

  std::vector<Point> points;
  std::vector<int> point_tags; ///< of what a point lies on; a hint where several parts meet

  std::vector<std::array<std::size_t, 4>> cells; ///< in either orientation
  std::vector<int> cell_tags;                    ///< equal within a subdomain
  std::vector<std::array<std::size_t, 3>> facets;
  std::vector<int> facet_tags; ///< equal within a patch
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<int> edge_tags; ///< equal along a crease
  std::vector<std::size_t> corners;

  std::vector<std::size_t> cell_lines;      ///< of the file, from 1; may be empty
  std::size_t first_number = 0;             ///< that the file gives its first point, for messages
  std::vector<Vertex_location_3> locations; ///< of the points, where the file has them; may be empty
  std::vector<std::string> notes;           ///< what was left out, for people, one line each
};

/// A mesh that came from elsewhere.
template <class K>
struct Imported_mesh_3
{
  Tetrahedral_mesh_3<K> mesh;
  std::vector<std::string> notes;        ///< what was left out or renamed, for people, one line each
  std::vector<std::size_t> point_origin; ///< of every point of the mesh, its position in the input
  std::size_t inverted_cells = 0;        ///< cells turned over against their neighbours
};

} // namespace weft

#endif // WEFT_SPATIAL_MESH_ELEMENT_SOUP_3_H
