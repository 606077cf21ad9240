// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refuses a surface: collects the vertices and facets that are to blame and throws them with one line of text that
// says what is wrong, how many there are, and names the first few.

#ifndef WEFT_SPATIAL_SURFACE_SURFACE_COMPLAINTS_3_H
#define WEFT_SPATIAL_SURFACE_SURFACE_COMPLAINTS_3_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

inline std::string element_name(std::size_t i)
{
  return std::to_string(i);
}
inline std::string element_name(const std::array<std::size_t, 2>& pair)
{
  return std::to_string(pair[0]) + '-' + std::to_string(pair[1]);
}

/// The first five elements, separated by commas.
template <class Elements>
std::string first_few(const Elements& elements)
{
  std::string text;
  for (std::size_t i = 0; i < elements.size() && i < 5; ++i) text += (i ? ", " : "") + element_name(elements[i]);
  return elements.size() > 5 ? text + ", ..." : text;
}

inline void sort_unique(std::vector<std::size_t>& indices)
{
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// The caller's facets that the triangles come from, in order.
template <class K>
std::vector<std::size_t> origins_of(const Triangle_surface_3<K>& surface, std::vector<std::size_t> triangles)
{
  for (std::size_t& t : triangles) t = surface.origin(t);
  sort_unique(triangles);
  return triangles;
}

/// The corners of triangles.
template <class K>
std::vector<std::size_t> corners_of(const Triangle_surface_3<K>& surface, const std::vector<std::size_t>& triangles)
{
  std::vector<std::size_t> corners;
  for (const std::size_t t : triangles)
    corners.insert(corners.end(), surface.triangles[t].begin(), surface.triangles[t].end());
  return corners;
}

/// Throws a Domain_error with the given vertices and the facets that the triangles come from.
template <class K>
[[noreturn]] void refuse(const Triangle_surface_3<K>& surface, const std::string& what,
                         std::vector<std::size_t> vertices, const std::vector<std::size_t>& triangles)
{
  sort_unique(vertices);
  throw Domain_error(what, std::move(vertices), origins_of(surface, triangles));
}

/// Refuses facets: "2 facets <are so>: 3, 7".
template <class K>
[[noreturn]] void refuse_facets(const Triangle_surface_3<K>& surface, const std::string& singular,
                                const std::string& plural, const std::vector<std::size_t>& triangles)
{
  const std::vector<std::size_t> facets = origins_of(surface, triangles);
  refuse(surface, counted(facets.size(), "facet " + singular, "facets " + plural) + ": " + first_few(facets),
         corners_of(surface, triangles), triangles);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_SURFACE_COMPLAINTS_3_H
