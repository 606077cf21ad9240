// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program that adapts tetrahedral meshes to other sizes: reads a mesh and a field of sizes, refines,
// takes vertices away, and writes the mesh. `adapt_3 --help` says how to call it.

#include "interruption.h"
#include "meshing_progress.h"
#include "output_files.h"
#include "program_options.h"
#include "programs/spatial/files.h"

#include <weft/adapt_3.h>
#include <weft/sizing/Lipschitz_sizing_3.h>

#include <CGAL/bounding_box.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <string>

namespace {

using command_line::Error;
using command_line::Length;
using command_line::Status;
using K = CGAL::Exact_predicates_inexact_constructions_kernel;

const std::string before_options =
    "usage: adapt_3 MESH [--size S] [--size-field FILE] [--gradation K] [--approximation E] [--sharp-angle DEG]\n"
    "               [--min-dihedral DEG] [--output FILE]... [--report FILE.json] [--seed N] [--threads N]\n"
    "               [--time-limit SECONDS] [--max-vertices N] [--quiet]\n\n"
    "Adapts a mesh to other sizes: what fits stays as it is. MESH is a .mesh, .msh, .vtu, or .ele file. Its boundary "
    "is\n"
    "the domain. Lengths are in the mesh's units, or with a trailing % in parts of its bounding box diagonal.\n";

const std::string after_options =
    "Exit status: 0 if the mesh meets all criteria; 1 for bad usage or bad input, when no file is written; 2 if the "
    "run\nstopped early, or couldn't meet a criterion, when the valid mesh so far is written.\n";

struct Request : command_line::Files
{
  Length size, approximation;
  std::string size_field;
  double gradation = 0.5, sharp_angle = 60, min_dihedral = 0;
  weft::Mesh_options_3 options;
};

void add_options(command_line::Options& options, Request& request)
{
  options.operands(request.inputs);
  options.length("--size", "S", false, request.size, "longest edge");
  options.text(
      "--size-field", "FILE", request.size_field,
      "sizes in space, at most S: at the vertices of a .vtu, .msh, or .mesh with its .sol,\nor an image of them");
  options.positive("--gradation", "K", request.gradation, "growth of sizes per unit of distance (default 0.5)");
  options.length("--approximation", "E", false, request.approximation,
                 "distance of facets to the boundary of the mesh (default a tenth of its edges nearby)");
  options.number("--sharp-angle", "DEG", 0, 180, request.sharp_angle,
                 "edges of the boundary are sharp from this angle between normals on (default 60)");
  options.number("--min-dihedral", "DEG", 0, 90, request.min_dihedral,
                 "smallest dihedral angle to perturb slivers for; without it 20, if it can be reached");
  add_outputs(options, request, command_line::spatial_formats);
  add_report(options, request, "counts, quality, what holds and what doesn't, time per stage");
  request.options.threads = command_line::all_cores();
  add_seed_threads_and_time(options, request.options);
  add_max_vertices(options, request.options);
  add_quiet(options, request);
}

void check(const command_line::Options& options, Request& request)
{
  check_single_input(request);
  check_files("adapt_3", request, spatial_files::is_mesh_filename, command_line::spatial_endings);
  if (request.size.value == 0 && request.size_field.empty()) throw Error("no sizes: --size or --size-field gives them");
  command_line::check_min_dihedral(options, request.min_dihedral);
  if (options.has("--min-dihedral")) request.options.min_dihedral_angle = request.min_dihedral;
}

/// The graded sizes that are asked for.
weft::Criteria_3<K> criteria(const Request& request, const CGAL::Bbox_3& box)
{
  const double extent = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  weft::Criteria_3<K> result;
  result.approximation = request.approximation.in(extent);
  if (request.size_field.empty()) {
    result.size = request.size.in(extent);
    return result;
  }
  weft::Gradation_options_3 options;
  if (request.size.value > 0) options.max_size = request.size.in(extent);
  result.size =
      weft::Lipschitz_sizing_3<K>(spatial_files::read_sizes(request.size_field), box, request.gradation, options);
  return result;
}

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Mesh_report_3& report, double smallest_dihedral)
{
  std::string text;
  if (report.bad() > 0) command_line::append_to_list(text, std::to_string(report.bad()) + " elements are bad");
  command_line::append_to_list(text, command_line::missing_dihedral(request.min_dihedral, smallest_dihedral));
  if (report.stop_reason != weft::Stop_reason::criteria_met)
    return std::string("stopped early, ") + name(report.stop_reason) + (text.empty() ? "" : ": ") + text;
  return text.empty() ? text : "not all criteria hold: " + text;
}

Status run(const Request& request)
{
  const std::string& filename = request.inputs.front();
  const auto input = spatial_files::read_mesh(filename);
  command_line::Output_files files;
  announce(request, files);
  const command_line::Interruption interruption;
  Meshing_progress progress(!request.quiet, 0.1);
  weft::Mesh_options_3 options = request.options;
  options.visitor = std::ref(progress);
  const auto box = CGAL::bounding_box(input.mesh.points.begin(), input.mesh.points.end()).bbox();
  const auto result = weft::adapt_3(input.mesh, criteria(request, box), options, request.sharp_angle);
  progress.bar().clear();
  if (!request.quiet) {
    for (const auto* notes : {&input.notes, &result.notes})
      for (const std::string& note : *notes) command_line::complain("adapt_3", filename + ": " + note);
  }
  const weft::Quality_3 quality = spatial_files::measure_quality(result.mesh);
  for (const std::string& wanted : request.outputs)
    files.add(wanted, [&](const std::string& name) { spatial_files::write_mesh(name, result.mesh); });
  if (!request.report.empty())
    files.add(request.report,
              [&](const std::string& name) { spatial_files::write_report(name, result.report, quality); });
  files.commit();
  if (!request.quiet) std::cout << result.report << std::flush;
  const std::string missing = what_is_missing(request, result.report, quality.smallest_dihedral.degrees);
  if (!missing.empty()) command_line::complain("adapt_3", missing);
  return missing.empty() ? command_line::complete : command_line::stopped_early;
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program("adapt_3", before_options, after_options, add_options, check, run, argc, argv);
}
