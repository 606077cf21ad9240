// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that improves planar triangle meshes from anywhere: reads one, raises its smallest angles,
// writes the mesh, a picture of its angles before and after, and figures. `improve_2 --help` says how to call it.

#include "command_line.h"
#include "improve_program.h"
#include "program_options.h"

#include <weft/improve_2.h>
#include <weft/IO/read_triangle_mesh.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/IO/write_report_json_2.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <string>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Triangle_mesh_2<K>;
using command_line::Status;

// ---- What is asked for

const std::string before_options =
    "usage: improve_2 INPUT [--boundary slide|fixed] [--corner-angle DEG] [--deviation PART] [--min-angle DEG]\n"
    "                 [--output FILE]... [--report FILE.json] [--histogram FILE.svg] [--seed N] [--threads N]\n"
    "                 [--time-limit SECONDS] [--quiet]\n\n"
    "Raises the smallest angles of a planar triangle mesh of any origin. INPUT is a .msh (Gmsh 2 or 4.1, ASCII), "
    ".mesh\n(Medit), .vtu (VTK), .off or .ele (Triangle, with its .node and its .poly or .edge files) file. Triangles "
    "may be\nslivers, not Delaunay, or inverted. Tags are kept; edges between tags and those of the file stay edges.\n";

const std::string after_options =
    "Exit status: 0 if the run ended by itself; 1 for bad usage or bad input, when no file is written; 2 if it "
    "stopped\nearly, by a limit or by Ctrl-C, or an angle that was asked for wasn't reached, when the mesh so far is "
    "written.\n";

struct Request : command_line::Files
{
  weft::Improve_options_2 options;
  std::string boundary;
  double min_angle = 0; ///< 0: not asked for
};

void add_options(command_line::Options& options, Request& request)
{
  auto& run = request.options;
  options.operands(request.inputs);
  options.text("--boundary", "slide|fixed", request.boundary,
               "slide: vertices on the boundary, between regions and on other edges of the file\nslide along them, "
               "come and go; fixed: every such edge stays (default slide)");
  options.number("--corner-angle", "DEG", 0, 90, run.corner_angle,
                 "the boundary has a corner, which stays, where it turns by this angle or more (default\n20); 0: "
                 "curves stay exactly as they are, only vertices of straight parts slide");
  options.number("--deviation", "PART", 0, 1, run.deviation,
                 "how far a curve may get from that of the input where its vertices are respaced, in\nparts of the "
                 "length of edges nearby (default 0.1)");
  options.number("--min-angle", "DEG", 0, 60, request.min_angle,
                 "smallest angle to work for, 60 to go as far as possible; without it 35, if it can be\nreached");
  add_outputs(options, request,
              ".vtu (VTK),\n.mesh (Medit), .msh (Gmsh), .off, or .svg, a picture coloured by quality");
  add_report(options, request, "counts, quality before and after, time per stage");
  add_histogram(options, request, "a picture of the distributions of angles before and after");
  add_seed_threads_and_time(options, run);
  add_quiet(options, request);
}

/// What options mean together.
void check(const command_line::Options& options, Request& request)
{
  check_single_input(request);
  check_files("improve_2", request, weft::IO::is_mesh_filename, ".vtu, .mesh, .msh, .off or .svg");
  const bool is_fixed =
      improve_program::is_boundary_fixed(options, request.boundary, {"--corner-angle", "--deviation"});
  request.options.boundary = is_fixed ? weft::Boundary_2::fixed : weft::Boundary_2::slide;
  if (options.has("--min-angle")) request.options.min_angle = request.min_angle;
}

// ---- The run

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Improve_report_2& report)
{
  std::string text;
  using command_line::append_to_list;
  if (report.inverted_after > 0)
    append_to_list(text, std::to_string(report.inverted_after) + " triangles are still inverted");
  if (report.below_min_angle > 0 && request.min_angle > 0 && request.min_angle < 60)
    append_to_list(text, command_line::too_small("angle", report.after.smallest_angle.degrees, request.min_angle));
  return improve_program::with_stop_reason(report.stop_reason, text);
}

Status run(const Request& request)
{
  return improve_program::run(
      "improve_2", request, [](const std::string& name) { return weft::IO::read_triangle_mesh<K>(name); },
      [&request](const Mesh& input, const weft::Visitor& visitor) {
        weft::Improve_options_2 options = request.options;
        options.visitor = visitor;
        return weft::improve_2(input, options);
      },
      "", [](const std::string& name, const Mesh& mesh) { weft::IO::write_mesh_2(name, mesh); },
      [](const std::string& name, const weft::Improve_report_2& report) { weft::IO::write_report_json(name, report); },
      [&request](const weft::Improve_report_2& report) { return what_is_missing(request, report); }, "Angles");
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program("improve_2", before_options, after_options, add_options, check, run, argc, argv);
}
