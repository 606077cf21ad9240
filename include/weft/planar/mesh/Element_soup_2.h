// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar triangle mesh as a file or a caller's arrays have it, before anything is known about how its triangles fit
// together: what the readers return and `assemble_mesh_2()` takes.

#ifndef WEFT_PLANAR_MESH_ELEMENT_SOUP_2_H
#define WEFT_PLANAR_MESH_ELEMENT_SOUP_2_H

#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// Points and elements that refer to them by position, each with a tag of the caller's. Lists of tags may be empty:
/// then all elements of that kind are alike.
/// \tparam K a CGAL kernel.
template <class K>
struct Element_soup_2
{
  using Kernel = K;
  using Point = typename K::Point_2;

  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles; ///< in either orientation
  std::vector<int> triangle_tags;                    ///< equal within a region
  std::vector<std::array<std::size_t, 2>> edges;     ///< that have to stay
  std::vector<int> edge_tags;
  std::vector<std::size_t> corners; ///< vertices that have to stay

  std::vector<std::size_t> triangle_lines; ///< of the file, from 1; may be empty
  std::size_t first_number = 0;            ///< that the file gives its first point, for messages
  std::vector<std::string> notes;          ///< what was left out, for people, one line each
};

/// A mesh that came from elsewhere.
template <class K>
struct Imported_mesh_2
{
  Triangle_mesh_2<K> mesh;
  std::vector<std::string> notes;        ///< what was left out, for people, one line each
  std::vector<std::size_t> point_origin; ///< of every point of the mesh, its position in the input
  std::size_t inverted_triangles = 0;    ///< turned over against their neighbours, or without area
};

} // namespace weft

#endif // WEFT_PLANAR_MESH_ELEMENT_SOUP_2_H
