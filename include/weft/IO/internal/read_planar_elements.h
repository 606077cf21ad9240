// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the readers of planar triangle meshes share: formats made for space are read as such and flattened, and the last
// step from elements to a mesh, whose complaints get the line of the element to blame.

#ifndef WEFT_IO_INTERNAL_READ_PLANAR_ELEMENTS_H
#define WEFT_IO_INTERNAL_READ_PLANAR_ELEMENTS_H

#include <weft/errors.h>
#include <weft/planar/mesh/assemble_mesh_2.h>
#include <weft/planar/mesh/Element_soup_2.h>
#include <weft/spatial/mesh/Element_soup_3.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// The points without their z, which must be the same for all that are finite.
template <class K>
std::vector<typename K::Point_2> flattened(const std::string& filename, std::size_t first_number,
                                           const std::vector<typename K::Point_3>& points)
{
  std::vector<typename K::Point_2> result;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (points[v].z() != points[0].z() && CGAL::is_finite(points[v].z()) && CGAL::is_finite(points[0].z()))
      throw File_error(filename, 0,
                       "the mesh isn't planar: vertices " + std::to_string(first_number) + " and " +
                           std::to_string(v + first_number) + " differ in z");
    result.emplace_back(points[v].x(), points[v].y());
  }
  return result;
}

/// The triangles, edges and corners of a mesh in space that has no cells.
template <class K>
Element_soup_2<K> flattened(const std::string& filename, Element_soup_3<K> soup)
{
  if (!soup.cells.empty())
    throw File_error(filename, soup.cell_lines.empty() ? 0 : soup.cell_lines[0],
                     "there are tetrahedra: the mesh isn't planar");
  Element_soup_2<K> result;
  result.points = flattened<K>(filename, soup.first_number, soup.points);
  result.triangles = std::move(soup.facets);
  result.triangle_tags = std::move(soup.facet_tags);
  result.edges = std::move(soup.edges);
  result.edge_tags = std::move(soup.edge_tags);
  result.corners = std::move(soup.corners);
  result.first_number = soup.first_number;
  result.notes = std::move(soup.notes);
  return result;
}

/// `assemble_mesh_2()` for what came from a file.
template <class K>
Imported_mesh_2<K> assemble_from_file(const std::string& filename, Element_soup_2<K> soup)
{
  const auto lines = soup.triangle_lines;
  try {
    return assemble_mesh_2(std::move(soup));
  } catch (const Domain_error& error) {
    const auto& elements = error.elements();
    throw File_error(filename, !elements.empty() && elements[0] < lines.size() ? lines[elements[0]] : 0, error.what());
  }
}

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_READ_PLANAR_ELEMENTS_H
