// SPDX-License-Identifier: GPL-3.0-or-later
//
// What becomes of planar meshes of other programs: meshes that Gmsh (four algorithms) and CGAL (uniform and graded
// sizes) make of the inputs of the planar benchmark, then weft with a boundary that slides and with a fixed one, and of
// CGAL's meshes CGAL's own Lloyd iteration. Prints a table. `run_improve_2` builds and runs it.

#include "../common/user_time.h"
#include "../planar/planar_gmsh.h"
#include "../planar/planar_inputs.h"
#include "../planar/planar_peers.h"

#include <weft/improve_2.h>
#include <weft/IO/read_triangle_mesh.h>
#include <weft/planar/mesh/from_triangulation_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using Mesh = weft::Triangle_mesh_2<benchmark::Kernel>;

std::size_t triangles_below(const Mesh& mesh, double degrees)
{
  std::size_t n = 0;
  for (const auto& t : mesh.triangles) {
    std::array<benchmark::Xy, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {mesh.points[t[i]].x(), mesh.points[t[i]].y()};
    n += std::min({benchmark::angle(p[0], p[1], p[2]), benchmark::angle(p[1], p[2], p[0]),
                   benchmark::angle(p[2], p[0], p[1])}) < degrees;
  }
  return n;
}

void print_row(const std::string& name, const std::string& method, const Mesh& mesh, double seconds)
{
  const weft::Quality_2 q = weft::measure_quality_2(mesh);
  std::printf("| %s | %s | %zu | %.1f | %.1f | %.1f | %zu | %.3f |\n", name.c_str(), method.c_str(), q.vertices,
              q.smallest_angle.degrees, q.largest_angle.degrees, q.mean_smallest_angle, triangles_below(mesh, 30),
              seconds);
  std::fflush(stdout);
}

/// \param bound smallest angle of the input.
void improve(const std::string& name, const Mesh& mesh, double bound)
{
  print_row(name, "as it is", mesh, 0);
  for (const bool slides : {true, false}) {
    weft::Improve_options_2 options;
    options.boundary = slides ? weft::Boundary_2::slide : weft::Boundary_2::fixed;
    const double start = benchmark::user_seconds();
    const auto result = weft::improve_2(mesh, options);
    std::string method = slides ? "weft, slide" : "weft, fixed";
    if (bound < 35) method += " (input: " + std::to_string(static_cast<int>(bound)) + "°)";
    print_row(name, method, result.mesh, benchmark::user_seconds() - start);
    for (const std::string& note : result.report.notes)
      std::printf("| %s | (%s) | | | | | | |\n", name.c_str(), note.c_str());
  }
}

void run_cgal(const benchmark::Domain& domain, double triangles, bool graded)
{
  auto cdt = domain.cgal;
  if (graded)
    benchmark::refine_with_cgal(cdt, benchmark::linear_size(domain, 0.3, triangles));
  else
    benchmark::refine_with_cgal(cdt, domain.size_for(triangles));
  const std::string name = domain.name + ", CGAL" + (graded ? ", graded" : "");
  improve(name, weft::triangle_mesh_2(cdt), domain.smallest_angle);
  const double start = benchmark::user_seconds();
  benchmark::lloyd_with_cgal(cdt, 50);
  const double seconds = benchmark::user_seconds() - start;
  print_row(name, "CGAL: lloyd", weft::triangle_mesh_2(cdt), seconds);
}

void run_gmsh(const benchmark::Domain& domain, double triangles, const std::string& algorithm,
              const std::string& folder)
{
  const auto loops = benchmark::Loops::of(domain.pslg);
  if (!loops) return;
  const std::string geo = folder + "/gmsh.geo", mesh = folder + "/gmsh.msh";
  benchmark::write_geo(domain.pslg, *loops, domain.size_for(triangles), geo);
  std::filesystem::remove(mesh);
  const std::string command = "timeout 300 gmsh -2 -algo " + algorithm + " -nt 1 -format msh22 -o '" + mesh + "' '" +
                              geo + "' > '" + folder + "/gmsh.log' 2>&1";
  const std::string name = domain.name + ", Gmsh " + algorithm;
  if (std::system(command.c_str()) != 0 || !std::filesystem::exists(mesh)) {
    std::printf("| %s | (makes no mesh) | | | | | | |\n", name.c_str());
    return;
  }
  improve(name, weft::IO::read_triangle_mesh<benchmark::Kernel>(mesh).mesh, domain.smallest_angle);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3) {
    std::fprintf(stderr, "usage: improve_planar FOLDER TRIANGLES [FILE.poly]...\n");
    return 1;
  }
  auto inputs = benchmark::planar_inputs();
  const double triangles = std::atof(argv[2]);
  const bool has_gmsh = std::system("gmsh --version > /dev/null 2>&1") == 0;
  std::printf("| mesh | | vertices | smallest angle | largest | mean smallest | triangles below 30° | user s |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  int status = 0;
  for (int i = 3; i < argc; ++i) inputs.push_back(benchmark::read_planar_input(argv[i]));
  for (const auto& input : inputs) {
    const benchmark::Domain domain(input);
    const auto attempt = [&](const auto& function) {
      try {
        function();
      } catch (const std::exception& error) {
        std::fprintf(stderr, "improve_planar: %s: %s\n", input.name.c_str(), error.what());
        status = 1;
      }
    };
    for (const bool graded : {false, true}) attempt([&] { run_cgal(domain, triangles, graded); });
    if (has_gmsh)
      for (const char* algorithm : {"meshadapt", "del2d", "front2d", "pack"})
        attempt([&] { run_gmsh(domain, triangles, algorithm, argv[1]); });
  }
  return status;
}
