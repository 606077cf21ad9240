// SPDX-License-Identifier: GPL-3.0-or-later
//
// What becomes of tetrahedral meshes of other programs: weft with a boundary that slides and a fixed one, CGAL's
// perturbation and exudation, and files that other optimisers have made of them. Prints rows of a table.

#include "../common/user_time.h"
#include "../optimisation/optimisation_peers.h"

#include <weft/improve_3.h>
#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/spatial/cgal/from_c3t3.h>
#include <weft/spatial/cgal/to_c3t3.h>
#include <weft/spatial/mesh/validate_3.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

using K = benchmark::Spatial_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;

void print_row(const std::string& model, const std::string& method, const Mesh& mesh, double seconds)
{
  const weft::Quality_3 q = weft::measure_quality_3(mesh);
  std::printf("| %s | %s | %zu | %.1f | %.1f | %zu | %.2f |\n", model.c_str(), method.c_str(), q.vertices,
              q.smallest_dihedral.degrees, q.largest_dihedral.degrees, q.cells_below(15), seconds);
  std::fflush(stdout);
}

/// The boundary of a mesh.
benchmark::Cgal_domain::Polyhedron surface_of(const Mesh& mesh)
{
  std::vector<K::Point_3> points;
  std::vector<std::size_t> number(mesh.points.size(), mesh.points.size());
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& facet : mesh.facets) {
    triangles.emplace_back();
    for (const std::size_t v : facet) {
      if (number[v] == mesh.points.size()) number[v] = points.size(), points.push_back(mesh.points[v]);
      triangles.back().push_back(number[v]);
    }
  }
  benchmark::Cgal_domain::Polyhedron surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  return surface;
}

/// Perturbation and exudation of the Delaunay mesh with the same vertices, which is what CGAL's optimisers take.
void run_cgal(const std::string& model, const Mesh& mesh, double limit)
{
  weft::Improve_options_3 options;
  options.smoothing_sweeps = 0;
  options.min_dihedral_angle = 0;
  options.delaunay = true;
  const Mesh delaunay = weft::improve_3(mesh, options).mesh;
  if (!weft::check_delaunay_3(delaunay).ok()) {
    std::printf("| %s | CGAL: no Delaunay mesh of this boundary | | | | | |\n", model.c_str());
    return;
  }
  auto surface = surface_of(mesh);
  benchmark::Cgal_domain domain(surface);
  domain.detect_features(60);
  auto complex = weft::to_c3t3<benchmark::Cgal_complex>(delaunay);
  const double start = benchmark::user_seconds();
  CGAL::perturb_mesh_3(complex, domain, CGAL::parameters::time_limit = limit);
  CGAL::exude_mesh_3(complex, CGAL::parameters::time_limit = limit);
  const double seconds = benchmark::user_seconds() - start;
  print_row(model, "CGAL: perturb, exude", weft::from_c3t3(complex).mesh, seconds);
}

void run_weft(const std::string& model, const std::string& method, const Mesh& mesh,
              const weft::Improve_options_3& options)
{
  const double start = benchmark::user_seconds();
  const auto result = weft::improve_3(mesh, options);
  print_row(model, method, result.mesh, benchmark::user_seconds() - start);
  if (options.boundary == weft::Boundary_3::fixed)
    std::printf("| %s | what the worst boundary facet allows | | %.1f | | | |\n", model.c_str(),
                result.report.boundary_bound);
  for (const std::string& note : result.report.notes)
    std::printf("| %s | (%s) | | | | | |\n", model.c_str(), note.c_str());
}

/// \param rest further files with their methods: "METHOD=SECONDS=FILE".
void run(const std::string& model, const std::string& filename, double limit, const std::vector<std::string>& rest)
{
  const Mesh mesh = weft::IO::read_tetrahedral_mesh<K>(filename).mesh;
  print_row(model, "as it is", mesh, 0);
  weft::Improve_options_3 options;
  options.min_dihedral_angle = 28;
  options.time_limit = limit;
  options.tagged_features = false; // of surfaces that triangles gave, tags say nothing
  run_weft(model, "weft, slide", mesh, options);
  options.boundary = weft::Boundary_3::fixed;
  run_weft(model, "weft, fixed", mesh, options);
  for (const std::string& other : rest) {
    const std::size_t first = other.find('='), second = other.find('=', first + 1);
    print_row(model, other.substr(0, first), weft::IO::read_tetrahedral_mesh<K>(other.substr(second + 1)).mesh,
              std::atof(other.substr(first + 1, second - first - 1).c_str()));
  }
  run_cgal(model, mesh, limit);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 4) {
    std::fprintf(stderr,
                 "usage: improve NAME MESH SECONDS [METHOD=SECONDS=FILE]...\n       improve --convert MESH FILE\n");
    return 1;
  }
  try {
    if (std::string(argv[1]) == "--convert") {
      weft::IO::write_mesh_3(argv[3], weft::IO::read_tetrahedral_mesh<K>(argv[2]).mesh);
      return 0;
    }
    run(argv[1], argv[2], std::atof(argv[3]), std::vector<std::string>(argv + 4, argv + argc));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "improve: %s\n", error.what());
    return 1;
  }
}
