// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures tetrahedral meshes of any mesher against the surface that they were made of, and prints a JSON array with an
// object a mesh: dihedral angles, shapes, edges, the distance between boundary and surface, and what checks find.
// Shares no code with the mesher.
//
//   measure_mesh_3 [--samples N] SURFACE MESH...
//
// Meshes are .mesh, .msh, .vtu or .ele files; lengths are in units of the surface.

#include "../common/program.h"
#include "../common/table.h"

#include <weft/IO/read_surface.h>
#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<std::array<std::size_t, 3>>;

/// Polygons as fans.
Triangles triangles_of(const weft::Polygon_soup_3<K>& surface)
{
  Triangles result;
  for (const auto& polygon : surface.polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i) result.push_back({polygon[0], polygon[i - 1], polygon[i]});
  return result;
}

double enclosed_volume(const weft::Polygon_soup_3<K>& surface, const Triangles& triangles)
{
  double six = 0;
  for (const auto& t : triangles)
    six += CGAL::determinant(surface.points[t[0]] - CGAL::ORIGIN, surface.points[t[1]] - CGAL::ORIGIN,
                             surface.points[t[2]] - CGAL::ORIGIN);
  return std::abs(six) / 6;
}

std::string yes(bool b)
{
  return b ? "true" : "false";
}

std::string measured(const std::string& filename, const weft::Polygon_soup_3<K>& surface, std::size_t samples)
{
  const auto mesh = weft::IO::read_tetrahedral_mesh<K>(filename).mesh;
  if (mesh.cells.empty()) throw weft::File_error(filename, 0, "has no cells");
  const Triangles triangles = triangles_of(surface);
  const weft::Quality_3 q = weft::measure_quality_3(mesh);
  const bool oriented = weft::check_orientation_3(mesh).ok();
  Json_object result;
  result.add("vertices", static_cast<double>(q.vertices)).add("cells", static_cast<double>(q.cells));
  result.add("smallest_dihedral", q.smallest_dihedral.degrees).add("largest_dihedral", q.largest_dihedral.degrees);
  result.add("mean_smallest_dihedral", q.mean_smallest_dihedral);
  for (const std::size_t degrees : {5, 10, 15, 20})
    result.add("cells_below_" + std::to_string(degrees), static_cast<double>(q.cells_below(degrees)));
  result.add("cell_shape", q.largest_radius_edge_ratio).add("facet_shape", q.largest_facet_ratio);
  result.add("shortest_edge", q.shortest_edge).add("longest_edge", q.longest_edge);
  result.add("volume", q.volume).add("volume_enclosed", enclosed_volume(surface, triangles));
  result.add_raw("oriented", yes(oriented)).add_raw("manifold", yes(weft::check_manifold_3(mesh).ok()));
  result.add_raw("delaunay", yes(oriented && weft::check_delaunay_3(mesh).ok()));
  if (samples == 0) return result.str();
  const weft::Hausdorff_3 distance = weft::hausdorff_3(mesh, surface.points, triangles, samples);
  return result.add("hausdorff", distance.two_sided())
      .add("mesh_to_surface", distance.mesh_to_surface)
      .add("surface_to_mesh", distance.surface_to_mesh)
      .str();
}

void run(Argument_reader arguments)
{
  std::size_t samples = 100000;
  std::vector<std::string> files;
  while (arguments.next()) {
    if (arguments.is("--samples"))
      samples = static_cast<std::size_t>(arguments.number());
    else
      files.push_back(arguments.operand());
  }
  if (files.size() < 2) throw weft::Option_error("needs a surface and meshes");
  const auto surface = weft::IO::read_surface<K>(files[0]);
  std::vector<std::string> rows;
  for (std::size_t i = 1; i < files.size(); ++i) rows.push_back(measured(files[i], surface, samples));
  std::cout << json_array(rows) << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("measure_mesh_3", [&] { run({argc, argv}); });
}
