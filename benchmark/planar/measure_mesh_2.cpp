// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures planar meshes of any mesher, in Medit's format, against the input and the size that they were asked for.
// Prints a JSON array with an object a mesh. Shares no code with the mesher but for reading the input and, with --lfs,
// the sizing field.
//
//   measure_mesh_2 (--size S | --lfs K) INPUT.poly MESH.mesh...

#include "../common/program.h"
#include "../common/table.h"
#include "planar_gmsh.h"
#include "planar_peers.h"

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

template <class Size>
std::string measured(const Domain& domain, const std::string& filename, const Size& size)
{
  const Flat_mesh mesh = read_medit(filename);
  if (mesh.triangles.empty()) throw weft::File_error(filename, 0, "has no triangles");
  const Measures m = measure(mesh, size);
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); };
  return Json_object()
      .add("vertices", static_cast<double>(m.vertices))
      .add("steiner", static_cast<double>(m.vertices) - static_cast<double>(domain.given.vertices))
      .add("triangles", static_cast<double>(m.triangles))
      .add("relative_count", m.relative_count())
      .add("smallest_angle", m.smallest_angle)
      .add("largest_angle", m.largest_angle)
      .add("longest_ratio", m.largest_ratio)
      .add("longest_edge_ratio", m.largest_edge_ratio)
      .add("oversize", static_cast<double>(m.oversize + m.oversize_edges))
      .add("inverted", static_cast<double>(m.inverted))
      .add("non_delaunay", static_cast<double>(m.non_delaunay))
      .add("smallest_input_angle", domain.smallest_angle)
      .add("input_vertices", static_cast<double>(domain.given.vertices))
      .add_raw("same_area", near(m.area, domain.given.area) ? "true" : "false")
      .add_raw("same_constraints", near(m.constraint_length, domain.given.constraint_length) ? "true" : "false")
      .str();
}

void run(Argument_reader arguments)
{
  double size = 0, lfs = 0;
  std::vector<std::string> files;
  while (arguments.next()) {
    if (arguments.is("--size"))
      size = arguments.positive();
    else if (arguments.is("--lfs"))
      lfs = arguments.positive();
    else
      files.push_back(arguments.operand());
  }
  if (files.size() < 2 || (size > 0) == (lfs > 0))
    throw weft::Option_error("needs an input, meshes, and either --size or --lfs");
  const Domain domain(read_planar_input(files[0]));
  std::vector<std::string> rows;
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (lfs > 0)
      rows.push_back(measured(domain, files[i], Graded_size(domain.pslg, lfs)));
    else
      rows.push_back(measured(domain, files[i], [size](double, double) { return size; }));
  }
  std::cout << json_array(rows) << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("measure_mesh_2", [&] { run({argc, argv}); });
}
