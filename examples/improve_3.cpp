// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that improves tetrahedral meshes from anywhere: reads one, raises its smallest dihedral
// angles, writes the mesh, a picture of its angles before and after, and figures. `improve_3 --help` says how to call
// it.

#include "command_line.h"
#include "meshing_progress.h"

#include <weft/IO/read_tetrahedral_mesh.h>
#include <weft/IO/report_json_3.h>
#include <weft/IO/svg_histogram.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/optimise_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using command_line::complete;
using command_line::Error;
using command_line::Status;
using command_line::stopped_early;

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

struct Request
{
  std::string input;
  weft::Improve_options_3 options;
  double min_dihedral = 0; ///< 0: not asked for
  std::vector<std::string> outputs;
  std::string histogram, report;
  bool quiet = false;
};

/// Dihedral angle of regular tetrahedra, in degrees: no mesh has more, since they don't fill space.
constexpr double regular = 70.53;

void read_filenames(const command_line::Arguments& arguments, Request& request)
{
  if (arguments.operands().empty()) throw Error("no input file; improve_3 --help shows the usage");
  if (arguments.operands().size() > 1) throw Error("more than one input file: '" + arguments.operands()[1] + "'");
  request.input = arguments.operands().front();
  request.outputs = arguments.values("--output");
  for (const std::string& filename : request.outputs)
    if (!weft::IO::is_mesh_3_filename(filename))
      throw Error("--output: '" + filename + "' should end in .mesh, .vtu, .msh, .off or .stl");
  request.histogram = arguments.filename("--histogram", ".svg");
  request.report = arguments.filename("--report", ".json");
}

void read_options(const command_line::Arguments& arguments, Request& request)
{
  auto& options = request.options;
  const std::string boundary = arguments.value("--boundary");
  if (!boundary.empty() && boundary != "slide" && boundary != "fixed")
    throw Error("--boundary: '" + boundary + "' is neither slide nor fixed");
  options.boundary = boundary == "fixed" ? weft::Boundary_3::fixed : weft::Boundary_3::slide;
  if (boundary == "fixed")
    for (const char* option : {"--sharp-angle", "--no-tags", "--deviation", "--delaunay", "--coarsen"})
      if (arguments.has(option)) throw Error(std::string(option) + " is for boundaries that slide");
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
  read_filenames(arguments, request);
  read_options(arguments, request);
  request.quiet = arguments.has("--quiet");
  return request;
}

// ---- Input and output

/// The mesh of the input; says what was left out of it.
Mesh read_mesh(const Request& request)
{
  auto input = weft::IO::read_tetrahedral_mesh<K>(request.input);
  for (const std::string& note : input.notes)
    if (!request.quiet) command_line::complain("improve_3", request.input + ": " + note);
  return std::move(input.mesh);
}

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
  const auto reason = report.stop_reason;
  if (reason != weft::Stop_reason::criteria_met && reason != weft::Stop_reason::exhausted)
    return std::string("stopped early, ") + name(reason) + (text.empty() ? "" : ": ") + text;
  return text;
}

void write_files(const Request& request, const Mesh& mesh, const weft::Improve_report_3& report,
                 command_line::Output_files& files)
{
  for (const std::string& filename : request.outputs)
    files.add(filename, [&](const std::string& name) { weft::IO::write_mesh_3(name, mesh); });
  if (!request.report.empty())
    files.add(request.report, [&](const std::string& name) { weft::IO::write_report_json(name, report); });
  if (!request.histogram.empty())
    files.add(request.histogram, [&](const std::string& name) {
      const std::string title = "Dihedral angles: " + std::filesystem::path(request.input).filename().string();
      weft::IO::write_angle_histogram_svg(name, report.after.histogram<weft::Angle_histogram>("after"),
                                          report.before.histogram<weft::Angle_histogram>("before"), title);
    });
  files.commit();
}

// ---- The run

/// Improves, writes all files and tells how it went.
Status run(const Request& request)
{
  command_line::Output_files files;
  const Mesh input = read_mesh(request);
  for (const std::string& filename : request.outputs) files.announce(filename);
  for (const std::string& filename : {request.histogram, request.report})
    if (!filename.empty()) files.announce(filename);

  const command_line::Interruption interruption;
  Meshing_progress progress(!request.quiet, 0.1);
  weft::Improve_options_3 options = request.options;
  options.visitor = std::ref(progress);
  const auto [mesh, report] = [&] {
    try {
      return weft::optimise_3(input, options);
    } catch (const weft::Domain_error& error) {
      throw Error(request.input + ": " + error.what() +
                  (options.boundary == weft::Boundary_3::slide ? "; --boundary fixed takes any boundary" : ""));
    }
  }();
  progress.bar().clear();

  for (const std::string& note : report.notes)
    if (!request.quiet) command_line::complain("improve_3", request.input + ": " + note);
  write_files(request, mesh, report, files);
  if (!request.quiet) std::cout << report << std::flush;
  const std::string missing = what_is_missing(request, report);
  if (!missing.empty()) command_line::complain("improve_3", missing);
  return missing.empty() ? complete : stopped_early;
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program(
      "improve_3", known_options, help,
      [](const command_line::Arguments& arguments) { return run(read_request(arguments)); }, argc, argv);
}
