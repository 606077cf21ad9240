// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wraps a surface with CGAL's alpha wrap (Portaneri et al., "Alpha wrapping with an offset", 2022), or copies it as
// triangles for programs that read few formats.
//
//   wrap_surface SURFACE FILE.off|FILE.stl [--alpha PART] [--offset PART] [--copy]
//
// Parts are those of the bounding box' diagonal. --copy: no wrap, equal points are one.

#include "../common/program.h"

#include <weft/IO/read_surface.h>

#include <CGAL/alpha_wrap_3.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Soup = weft::Polygon_soup_3<K>;

/// Fans in place of polygons.
void cut_to_triangles(Soup& soup)
{
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& polygon : soup.polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  soup.polygons = std::move(triangles);
}

Soup wrapped(const Soup& soup, double alpha, double offset)
{
  CGAL::Surface_mesh<K::Point_3> wrap;
  CGAL::alpha_wrap_3(soup.points, soup.polygons, alpha, offset, wrap);
  Soup result;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(wrap, result.points, result.polygons);
  return result;
}

void run(benchmark::Argument_reader arguments)
{
  std::vector<std::string> files;
  double alpha = 0.01, offset = 0.001;
  bool is_copied = false;
  while (arguments.next()) {
    if (arguments.is("--alpha"))
      alpha = arguments.positive();
    else if (arguments.is("--offset"))
      offset = arguments.positive();
    else if (arguments.is("--copy"))
      is_copied = true;
    else
      files.push_back(arguments.operand());
  }
  if (files.size() != 2)
    throw weft::Option_error("usage: wrap_surface SURFACE FILE.off|FILE.stl [--alpha PART] [--offset PART] [--copy]");
  Soup soup = weft::IO::read_surface<K>(files[0]);
  cut_to_triangles(soup);
  if (is_copied) {
    CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup(soup.points, soup.polygons);
  } else {
    CGAL::Bbox_3 box;
    for (const auto& p : soup.points) box += p.bbox();
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    soup = wrapped(soup, alpha * diagonal, offset * diagonal);
  }
  if (!CGAL::IO::write_polygon_soup(files[1], soup.points, soup.polygons, CGAL::parameters::stream_precision(17)))
    throw weft::File_error(files[1], 0, "can't be written");
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("wrap_surface", [&] { run({argc, argv}); });
}
