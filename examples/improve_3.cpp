// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that improves tetrahedral meshes from anywhere: reads one, raises its smallest dihedral
// angles, writes the mesh, a picture of its angles before and after, and figures. `improve_3 --help` says how to call
// it.

#include "command_line.h"
#include "improve_program.h"

#include <weft/improve_3.h>
#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/IO/write_report_json_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using command_line::Error;
using command_line::Status;

// ---- What is asked for

const std::string usage =
    "usage: improve_3 INPUT [--boundary slide|fixed] [--sharp-angle DEG] [--no-tags] [--deviation PART] [--delaunay]\n"
    "                 [--coarsen] [--min-dihedral DEG] [--output FILE]... [--report FILE.json]\n"
    "                 [--histogram FILE.svg] [--seed N] [--threads N] [--time-limit SECONDS] [--max-vertices N]\n"
    "                 [--quiet]\n";

const std::vector<command_line::Option> known_options = {
    {"--boundary", "slide|fixed",
     "slide: vertices of the boundary move on the surface that it is; fixed: every\nboundary and interface triangle "
     "stays (default slide)"},
    {"--sharp-angle", "DEG",
     "edges of the boundary are sharp from this angle between the normals of their\nfacets on; 0 for none (default "
     "60)"},
    {"--no-tags", "",
     "edges between patches and edges and corners listed in the file aren't sharp by\nthemselves: for tags that mean "
     "nothing, as Netgen's for surfaces from .stl files"},
    {"--deviation", "PART",
     "how far the boundary may get from that of the input where it slides, in parts of\nthe length of edges nearby "
     "(default 0.1)"},
    {"--delaunay", "", "end with a Delaunay mesh; only where the boundary slides. Takes longer for less"},
    {"--coarsen", "", "take away vertices that neither boundary nor sizes need; only where it slides"},
    {"--min-dihedral", "DEG",
     "smallest dihedral angle to work for, 90 to go as far as possible; without it 25,\nif it can be reached"},
    {"--output", "FILE",
     "the mesh; may be given several times. The extension is the format: .mesh (Medit),\n.vtu (VTK), .msh (Gmsh), or "
     "of the boundary alone .off or .stl",
     true},
    {"--report", "FILE.json", "counts, quality before and after, time per stage"},
    {"--histogram", "FILE.svg", "a picture of the distributions of dihedral angles before and after"},
    {"--seed", "N", "start of every random choice"},
    {"--threads", "N", "threads to use; the mesh is the same for any number"},
    {"--time-limit", "SECONDS", "stop early after this time"},
    {"--max-vertices", "N", "stop early at this number of vertices"},
    {"--quiet", "", "no progress and no report; errors are still said"},
    {"--help", "", "print this and exit"},
    {"--version", "", "print the version and exit"}};

std::string help()
{
  return usage +
         "\nRaises the smallest dihedral angles of a tetrahedral mesh of any origin. INPUT is a .mesh (Medit), .msh "
         "(Gmsh 2 or\n4.1, ASCII), .vtu (VTK) or .ele (TetGen, with its .node and .face files) file. Cells may be "
         "slivers, "
         "not Delaunay, or\ninverted.\n\n" +
         command_line::describe(known_options) +
         "\nExit status: 0 if the run ended by itself; 1 for bad usage or bad input, when no file is written; 2 if it "
         "stopped\nearly, by a limit or by Ctrl-C, or an angle that was asked for wasn't reached, or the boundary "
         "isn't "
         "represented as\nasked, when the mesh so far is written.\n";
}

struct Request : improve_program::Files
{
  weft::Improve_options_3 options;
  double min_dihedral = 0; ///< 0: not asked for
};

/// Dihedral angle of regular tetrahedra, in degrees: no mesh has more, since they don't fill space.
constexpr double regular = 70.53;

void read_options(const command_line::Arguments& arguments, Request& request)
{
  auto& options = request.options;
  const bool is_fixed = improve_program::read_boundary_is_fixed(
      arguments, {"--sharp-angle", "--no-tags", "--deviation", "--delaunay", "--coarsen"});
  options.boundary = is_fixed ? weft::Boundary_3::fixed : weft::Boundary_3::slide;
  options.sharp_angle = arguments.number("--sharp-angle", 0, 180).value_or(options.sharp_angle);
  options.tagged_features = !arguments.has("--no-tags");
  options.deviation = arguments.number("--deviation", 1e-6, 1).value_or(options.deviation);
  options.delaunay = arguments.has("--delaunay");
  options.coarsen = arguments.has("--coarsen");
  request.min_dihedral = arguments.number("--min-dihedral", 0, 90).value_or(0);
  if (request.min_dihedral > regular && request.min_dihedral < 90)
    throw Error("--min-dihedral: '" + arguments.value("--min-dihedral") +
                "' is more than regular tetrahedra have; 90 goes as far as possible");
  if (arguments.has("--min-dihedral")) options.min_dihedral_angle = request.min_dihedral;
  options.time_limit = arguments.positive("--time-limit").value_or(options.time_limit);
  options.seed = arguments.integer<unsigned>("--seed", 0, std::numeric_limits<unsigned>::max()).value_or(options.seed);
  options.threads = arguments.integer<int>("--threads", 1, 1024).value_or(options.threads);
  constexpr std::size_t most_vertices = 1000000000;
  options.max_vertices =
      arguments.integer<std::size_t>("--max-vertices", 1, most_vertices).value_or(options.max_vertices);
}

Request read_request(const command_line::Arguments& arguments)
{
  Request request;
  improve_program::read_files(arguments, "improve_3", weft::IO::is_mesh_3_filename, ".mesh, .vtu, .msh, .off or .stl",
                              request);
  read_options(arguments, request);
  return request;
}

// ---- The run

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Improve_report_3& report)
{
  std::string text;
  const auto append = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (report.inverted_after > 0) append(std::to_string(report.inverted_after) + " cells are still inverted");
  if (report.unrepresented > 0)
    append(std::to_string(report.unrepresented) +
           " elements of the boundary don't represent that of the input as asked");
  const double smallest = report.after.smallest_dihedral.degrees;
  if (smallest < request.min_dihedral && request.min_dihedral < regular)
    append("the smallest dihedral angle is " + weft::internal::one_decimal(std::floor(10 * smallest) / 10) +
           " degrees, not " + weft::internal::one_decimal(request.min_dihedral));
  return improve_program::with_stop_reason(report.stop_reason, text);
}

Status run(const Request& request)
{
  return improve_program::run(
      "improve_3", request, [](const std::string& name) { return weft::IO::read_tetrahedral_mesh<K>(name); },
      [&request](const Mesh& input, const weft::Visitor& visitor) {
        weft::Improve_options_3 options = request.options;
        options.visitor = visitor;
        return weft::improve_3(input, options);
      },
      request.options.boundary == weft::Boundary_3::slide ? "; --boundary fixed takes any boundary" : "",
      [](const std::string& name, const Mesh& mesh) { weft::IO::write_mesh_3(name, mesh); },
      [](const std::string& name, const weft::Improve_report_3& report) { weft::IO::write_report_json(name, report); },
      [&request](const weft::Improve_report_3& report) { return what_is_missing(request, report); }, "Dihedral angles");
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program(
      "improve_3", known_options, help,
      [](const command_line::Arguments& arguments) { return run(read_request(arguments)); }, argc, argv);
}
