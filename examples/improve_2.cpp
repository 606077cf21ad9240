// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that improves planar triangle meshes from anywhere: reads one, raises its smallest angles,
// writes the mesh, a picture of its angles before and after, and figures. `improve_2 --help` says how to call it.

#include "command_line.h"
#include "improve_program.h"

#include <weft/improve_2.h>
#include <weft/IO/read_triangle_mesh.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/IO/write_report_json_2.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Triangle_mesh_2<K>;
using command_line::Error;
using command_line::Status;

// ---- What is asked for

const std::string usage =
    "usage: improve_2 INPUT [--boundary slide|fixed] [--corner-angle DEG] [--deviation PART] [--min-angle DEG]\n"
    "                 [--output FILE]... [--report FILE.json] [--histogram FILE.svg] [--seed N] [--threads N]\n"
    "                 [--time-limit SECONDS] [--quiet]\n";

const std::vector<command_line::Option> known_options = {
    {"--boundary", "slide|fixed",
     "slide: vertices on the boundary, between regions and on other edges of the file\nslide along them, come and go; "
     "fixed: every such edge stays (default slide)"},
    {"--corner-angle", "DEG",
     "the boundary has a corner, which stays, where it turns by this angle or more (default\n20); 0: curves stay "
     "exactly "
     "as they are, only vertices of straight parts slide"},
    {"--deviation", "PART",
     "how far a curve may get from that of the input where its vertices are respaced, in\nparts of the length of edges "
     "nearby (default 0.1)"},
    {"--min-angle", "DEG",
     "smallest angle to work for, 60 to go as far as possible; without it 35, if it can be\nreached"},
    {"--output", "FILE",
     "the mesh; may be given several times. The extension is the format: .vtu (VTK),\n.mesh (Medit), .msh (Gmsh), "
     ".off, or .svg, a picture coloured by quality",
     true},
    {"--report", "FILE.json", "counts, quality before and after, time per stage"},
    {"--histogram", "FILE.svg", "a picture of the distributions of angles before and after"},
    {"--seed", "N", "start of every random choice"},
    {"--threads", "N", "threads to use; the mesh is the same for any number"},
    {"--time-limit", "SECONDS", "stop early after this time"},
    {"--quiet", "", "no progress and no report; errors are still said"},
    {"--help", "", "print this and exit"},
    {"--version", "", "print the version and exit"}};

std::string help()
{
  return usage +
         "\nRaises the smallest angles of a planar triangle mesh of any origin. INPUT is a .msh (Gmsh 2 or 4.1, "
         "ASCII), "
         ".mesh\n(Medit), .vtu (VTK), .off or .ele (Triangle, with its .node and its .poly or .edge files) file. "
         "Triangles may be\nslivers, not Delaunay, or inverted. Tags are kept; edges between tags and those of the "
         "file "
         "stay edges.\n\n" +
         command_line::describe(known_options) +
         "\nExit status: 0 if the run ended by itself; 1 for bad usage or bad input, when no file is written; 2 if it "
         "stopped\nearly, by a limit or by Ctrl-C, or an angle that was asked for wasn't reached, when the mesh so far "
         "is written.\n";
}

struct Request : improve_program::Files
{
  weft::Improve_options_2 options;
  double min_angle = 0; ///< 0: not asked for
};

void read_options(const command_line::Arguments& arguments, Request& request)
{
  auto& options = request.options;
  const bool is_fixed = improve_program::read_boundary_is_fixed(arguments, {"--corner-angle", "--deviation"});
  options.boundary = is_fixed ? weft::Boundary_2::fixed : weft::Boundary_2::slide;
  options.corner_angle = arguments.number("--corner-angle", 0, 90).value_or(options.corner_angle);
  options.deviation = arguments.number("--deviation", 0, 1).value_or(options.deviation);
  request.min_angle = arguments.number("--min-angle", 0, 60).value_or(0);
  if (arguments.has("--min-angle")) options.min_angle = request.min_angle;
  options.time_limit = arguments.positive("--time-limit").value_or(options.time_limit);
  options.seed = arguments.integer<unsigned>("--seed", 0, std::numeric_limits<unsigned>::max()).value_or(options.seed);
  options.threads = arguments.integer<int>("--threads", 1, 1024).value_or(options.threads);
}

Request read_request(const command_line::Arguments& arguments)
{
  Request request;
  improve_program::read_files(arguments, "improve_2", weft::IO::is_mesh_filename, ".vtu, .mesh, .msh, .off or .svg",
                              request);
  read_options(arguments, request);
  return request;
}

// ---- The run

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Improve_report_2& report)
{
  std::string text;
  const auto append = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (report.inverted_after > 0) append(std::to_string(report.inverted_after) + " triangles are still inverted");
  if (report.below_min_angle > 0 && request.min_angle > 0 && request.min_angle < 60)
    append("the smallest angle is " +
           weft::internal::one_decimal(std::floor(10 * report.after.smallest_angle.degrees) / 10) + " degrees, not " +
           weft::internal::one_decimal(request.min_angle));
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
  return command_line::run_program(
      "improve_2", known_options, help,
      [](const command_line::Arguments& arguments) { return run(read_request(arguments)); }, argc, argv);
}
