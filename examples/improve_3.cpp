// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that improves tetrahedral meshes from anywhere: reads one, raises its smallest dihedral
// angles, writes the mesh, a picture of its angles before and after, and figures. `improve_3 --help` says how to call
// it.

#include "command_line.h"
#include "improve_program.h"
#include "program_options.h"
#include "programs/spatial/files.h"

#include <weft/improve_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <string>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using command_line::Status;

// ---- What is asked for

const std::string before_options =
    "usage: improve_3 INPUT [--boundary slide|fixed] [--sharp-angle DEG] [--no-tags] [--deviation PART] [--delaunay]\n"
    "                 [--coarsen] [--min-dihedral DEG] [--output FILE]... [--report FILE.json]\n"
    "                 [--histogram FILE.svg] [--seed N] [--threads N] [--time-limit SECONDS] [--max-vertices N]\n"
    "                 [--quiet]\n\n"
    "Raises the smallest dihedral angles of a tetrahedral mesh of any origin. INPUT is a .mesh (Medit), .msh (Gmsh 2 "
    "or\n4.1, ASCII), .vtu (VTK) or .ele (TetGen, with its .node and .face files) file. Cells may be slivers, not "
    "Delaunay, or\ninverted.\n";

const std::string after_options =
    "Exit status: 0 if the run ended by itself; 1 for bad usage or bad input, when no file is written; 2 if it "
    "stopped\nearly, by a limit or by Ctrl-C, or an angle that was asked for wasn't reached, or the boundary isn't "
    "represented as\nasked, when the mesh so far is written.\n";

struct Request : command_line::Files
{
  weft::Improve_options_3 options;
  std::string boundary;
  double min_dihedral = 0; ///< 0: not asked for
  bool no_tags = false;
};

void add_options(command_line::Options& options, Request& request)
{
  auto& run = request.options;
  options.operands(request.inputs);
  options.text("--boundary", "slide|fixed", request.boundary,
               "slide: vertices of the boundary move on the surface that it is; fixed: every\nboundary and interface "
               "triangle stays (default slide)");
  options.number("--sharp-angle", "DEG", 0, 180, run.sharp_angle,
                 "edges of the boundary are sharp from this angle between the normals of their\nfacets on; 0 for none "
                 "(default 60)");
  options.flag("--no-tags", request.no_tags,
               "edges between patches and edges and corners listed in the file aren't sharp by\nthemselves: for tags "
               "that mean nothing, as Netgen's for surfaces from .stl files");
  options.number("--deviation", "PART", 1e-6, 1, run.deviation,
                 "how far the boundary may get from that of the input where it slides, in parts of\nthe length of "
                 "edges nearby (default 0.1)");
  options.flag("--delaunay", run.delaunay,
               "end with a Delaunay mesh; only where the boundary slides. Takes longer for less");
  options.flag("--coarsen", run.coarsen,
               "take away vertices that neither boundary nor sizes need; only where it slides");
  options.number("--min-dihedral", "DEG", 0, 90, request.min_dihedral,
                 "smallest dihedral angle to work for, 90 to go as far as possible; without it 25,\nif it can be "
                 "reached");
  add_outputs(options, request, command_line::spatial_formats);
  add_report(options, request, "counts, quality before and after, time per stage");
  add_histogram(options, request, "a picture of the distributions of dihedral angles before and after");
  add_seed_threads_and_time(options, run);
  add_max_vertices(options, run);
  add_quiet(options, request);
}

/// What options mean together.
void check(const command_line::Options& options, Request& request)
{
  check_single_input(request);
  check_files("improve_3", request, spatial_files::is_mesh_filename, command_line::spatial_endings);
  const bool is_fixed = improve_program::is_boundary_fixed(
      options, request.boundary, {"--sharp-angle", "--no-tags", "--deviation", "--delaunay", "--coarsen"});
  request.options.boundary = is_fixed ? weft::Boundary_3::fixed : weft::Boundary_3::slide;
  request.options.tagged_features = !request.no_tags;
  command_line::check_min_dihedral(options, request.min_dihedral);
  if (options.has("--min-dihedral")) request.options.min_dihedral_angle = request.min_dihedral;
}

// ---- The run

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Improve_report_3& report)
{
  using command_line::append_to_list;
  std::string text;
  if (report.inverted_after > 0)
    append_to_list(text, std::to_string(report.inverted_after) + " cells are still inverted");
  if (report.unrepresented > 0)
    append_to_list(text, std::to_string(report.unrepresented) +
                             " elements of the boundary don't represent that of the input as asked");
  append_to_list(text, command_line::missing_dihedral(request.min_dihedral, report.after.smallest_dihedral.degrees));
  return improve_program::with_stop_reason(report.stop_reason, text);
}

Status run(const Request& request)
{
  return improve_program::run(
      "improve_3", request, spatial_files::read_mesh,
      [&request](const Mesh& input, const weft::Visitor& visitor) {
        weft::Improve_options_3 options = request.options;
        options.visitor = visitor;
        return weft::improve_3(input, options);
      },
      request.options.boundary == weft::Boundary_3::slide ? "; --boundary fixed takes any boundary" : "",
      [](const std::string& name, const Mesh& mesh) { spatial_files::write_mesh(name, mesh); },
      [](const std::string& name, const weft::Improve_report_3& report) { spatial_files::write_report(name, report); },
      [&request](const weft::Improve_report_3& report) { return what_is_missing(request, report); }, "Dihedral angles");
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program("improve_3", before_options, after_options, add_options, check, run, argc, argv);
}
