// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads triangle meshes as Shewchuk's Triangle writes them ("Triangle: Engineering a 2D Quality Mesh Generator and
// Delaunay Triangulator", 1996): points in a .node file, triangles in the .ele file beside it, and the edges that have
// to stay in a .poly file, or else in an .edge file, where there is one.

#ifndef WEFT_IO_READ_TRIANGLE_H
#define WEFT_IO_READ_TRIANGLE_H

#include <weft/IO/internal/Line_reader.h>
#include <weft/IO/internal/read_planar_elements.h>
#include <weft/IO/read_poly.h>
#include <weft/IO/read_tetgen.h>
#include <weft/planar/mesh/Element_soup_2.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace weft {
namespace internal {

/// Those with the marker 0 lie inside.
template <class K>
void read_triangle_edges(const std::string& filename, Element_soup_2<K>& soup)
{
  Line_reader in(filename);
  in.require_line("the number of edges");
  const std::size_t n = in.count("the number of edges", 6);
  const long long markers = in.at_end_of_line() ? 0 : in.bounded_count("the number of markers");
  for (std::size_t i = 0; i < n; ++i) {
    in.require_line("edge " + std::to_string(i + 1) + " of " + std::to_string(n));
    in.integer("the number of the edge");
    const auto ends = read_vertices<2>(in, soup.first_number, soup.points.size());
    const int tag = markers > 0 ? in.marker("the marker") : 0;
    if (tag == 0) continue;
    soup.edges.push_back(ends);
    soup.edge_tags.push_back(tag);
  }
}

} // namespace internal

namespace IO {

/// Reads Triangle's files. The first attribute of triangles is their tag; edges are the segments of the .poly file
/// with their markers, or else those of the .edge file that have a marker other than 0.
/// \param filename of the .ele or the .node file.
/// \throws File_error with the line if a file is missing, cut, malformed, has triangles of second order, or if the
///   elements don't make a mesh; see `assemble_mesh_2()`.
template <class K>
Imported_mesh_2<K> read_triangle(const std::string& filename)
{
  const std::string base = filename.substr(0, filename.rfind('.'));
  Element_soup_2<K> soup;
  {
    Pslg_2<K> nodes = read_node<K>(base + ".node");
    soup.points = std::move(nodes.points);
    soup.first_number = nodes.first_number;
  }
  weft::internal::read_ele_file<3>(base + ".ele", "triangle", soup.first_number, soup.points.size(), soup.triangles,
                                   soup.triangle_tags, soup.triangle_lines);
  if (weft::internal::is_readable(base + ".poly")) {
    Pslg_2<K> graph = read_poly<K>(base + ".poly");
    if (graph.points != soup.points) throw File_error(base + ".poly", 0, "the points aren't those of the .node file");
    soup.edges = std::move(graph.segments);
    soup.edge_tags = std::move(graph.segment_markers);
  } else if (weft::internal::is_readable(base + ".edge")) {
    weft::internal::read_triangle_edges(base + ".edge", soup);
  }
  return weft::internal::assemble_from_file(base + ".ele", std::move(soup));
}

} // namespace IO
} // namespace weft

#endif // WEFT_IO_READ_TRIANGLE_H
