// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the inputs of the report to a folder, as files that every mesher reads, and lists them as JSON: planar ones as
// .poly and, where loops describe them, Gmsh's .geo; surfaces, scaled to a longest side of 1, as .off and .stl.
//
//   report_inputs planar FOLDER [FILE.poly...]
//   report_inputs spatial FOLDER [--sharp-angle DEG] [FILE...]
//
// Edges of the files after a --sharp-angle are creases from that angle on; 60 unless given, 0 for none.

#include "../common/program.h"
#include "../common/table.h"
#include "../planar/planar_gmsh.h"
#include "../planar/planar_peers.h"
#include "../spatial/spatial_inputs.h"
#include "report_shapes.h"

#include <weft/IO/write_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

/// A name for files: its extension off, blanks turned into underscores.
std::string stem(std::string name)
{
  name = name.substr(0, name.find_last_of('.'));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string poly(const Pslg& pslg)
{
  std::ostringstream out;
  out << std::setprecision(17) << pslg.points.size() << " 2 0 0\n";
  for (std::size_t i = 0; i < pslg.points.size(); ++i)
    out << i << " " << pslg.points[i].x() << " " << pslg.points[i].y() << "\n";
  out << pslg.segments.size() << " 0\n";
  for (std::size_t i = 0; i < pslg.segments.size(); ++i)
    out << i << " " << pslg.segments[i][0] << " " << pslg.segments[i][1] << "\n";
  out << pslg.holes.size() << "\n";
  for (std::size_t i = 0; i < pslg.holes.size(); ++i)
    out << i << " " << pslg.holes[i].x() << " " << pslg.holes[i].y() << "\n";
  return out.str();
}

std::string write_planar(const Planar_input& input, const std::string& folder)
{
  const Domain domain(input);
  const std::string name = stem(input.name);
  write_text(folder + "/" + name + ".poly", poly(input.pslg));
  const auto loops = input.pslg.holes.empty() ? Loops::of(input.pslg) : std::nullopt;
  if (loops) write_geo(input.pslg, *loops, 0, folder + "/" + name + ".geo");
  return Json_object()
      .add("name", name)
      .add("size_for_one", domain.size_for(1))
      .add("smallest_angle", domain.smallest_angle)
      .add("vertices", static_cast<double>(domain.given.vertices))
      .add_raw("has_geo", loops ? "true" : "false")
      .str();
}

/// Not the binary STL that the library writes: Netgen takes that for text.
std::string ascii_stl(const Complex& complex)
{
  std::ostringstream out;
  out << std::setprecision(17) << "solid surface\n";
  for (const auto& t : complex.triangles) {
    const auto n = CGAL::normal(complex.points[t[0]], complex.points[t[1]], complex.points[t[2]]);
    const double length = std::sqrt(n.squared_length());
    out << "facet normal " << n.x() / length << " " << n.y() / length << " " << n.z() / length << "\nouter loop\n";
    for (const std::size_t v : t) out << "vertex " << complex.points[v] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid surface";
  return out.str();
}

std::string write_spatial(const Spatial_input& input, const std::string& folder)
{
  weft::Tetrahedral_mesh_3<Spatial_kernel> surface; // without cells
  surface.points = input.complex.points;
  surface.facets = input.complex.triangles;
  surface.patches.assign(surface.facets.size(), 0);
  surface.locations.resize(surface.points.size());
  weft::IO::write_mesh_3(folder + "/" + stem(input.name) + ".off", surface);
  write_text(folder + "/" + stem(input.name) + ".stl", ascii_stl(input.complex));
  return Json_object()
      .add("name", stem(input.name))
      .add("sharp_angle", input.sharp_angle)
      .add("triangles", static_cast<double>(surface.facets.size()))
      .add_raw("creased", input.is_creased() ? "true" : "false")
      .str();
}

std::vector<std::string> write_all_planar(Argument_reader& arguments, const std::string& folder)
{
  std::vector<Planar_input> inputs = planar_inputs();
  inputs.push_back({"mushroom", mushroom()});
  while (arguments.next()) {
    inputs.push_back(read_planar_input(arguments.operand()));
    inputs.back().name = "file " + inputs.back().name; // ours may be called the same
  }
  std::vector<std::string> rows;
  for (const Planar_input& input : inputs) rows.push_back(write_planar(input, folder));
  return rows;
}

std::vector<std::string> write_all_spatial(Argument_reader& arguments, const std::string& folder)
{
  std::vector<Spatial_input> inputs{make_input("ball", unit_sphere(5), 0), make_input("cylinder", cylinder(96), 60),
                                    make_input("nested spheres", nested_spheres(5), 0)};
  for (const int degrees : {70, 52, 47, 5})
    inputs.push_back(make_input("wedge " + std::to_string(degrees), wedge(degrees), 40));
  double sharp_angle = 60;
  std::vector<std::string> rows;
  while (arguments.next()) {
    if (arguments.is("--sharp-angle"))
      sharp_angle = arguments.number();
    else
      try {
        inputs.push_back(read_input(arguments.operand(), sharp_angle));
      } catch (const weft::Error& error) {
        rows.push_back(Json_object().add("name", stem(arguments.argument())).add("refused", error.what()).str());
      }
  }
  for (const Spatial_input& input : inputs) rows.push_back(write_spatial(input, folder));
  return rows;
}

void run(Argument_reader arguments)
{
  const auto next = [&] {
    if (!arguments.next()) throw weft::Option_error("needs planar or spatial, and a folder");
    return arguments.operand();
  };
  const std::string kind = next(), folder = next();
  if (kind != "planar" && kind != "spatial") throw weft::Option_error("no inputs are called " + kind);
  std::cout << json_array(kind == "planar" ? write_all_planar(arguments, folder) : write_all_spatial(arguments, folder))
            << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("report_inputs", [&] { run({argc, argv}); });
}
