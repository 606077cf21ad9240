// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program for planar meshes: reads a planar straight line graph, meshes what it encloses, writes the
// mesh, pictures and figures. `mesh_2 --help` says how to call it. The parts that need CGAL are in programs/mesh_2.

#include "interruption.h"
#include "meshing_progress.h"
#include "output_files.h"
#include "program_options.h"
#include "programs/mesh_2/domain.h"

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/IO/write_angle_histogram_svg.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using command_line::complete;
using command_line::Error;
using command_line::Status;
using command_line::stopped_early;
using mesh_2_program::Domain;

// ---- What is asked for

const std::string before_options =
    "usage: mesh_2 INPUT [--size [MARK:]S]... [--lfs K] [--min-size S] [--min-angle DEG] [--output FILE]...\n"
    "              [--size-field FILE] [--gradation K]\n"
    "              [--voronoi FILE.svg] [--histogram FILE.svg] [--report FILE.json] [--seed N] [--threads N]\n"
    "              [--time-limit SECONDS] [--max-vertices N] [--tolerance T] [--split-crossings] [--quiet]\n\n"
    "Meshes the domain that a planar straight line graph encloses with large, well-shaped triangles. INPUT is a .poly "
    "or\n.node file of Triangle, an .edg file of CGAL, or an .obj file with lines. If a .poly has holes they bound "
    "the\ndomain; else a region belongs to it when an odd number of outlines surrounds it, or when the file names it. "
    "Lengths are\nin the input's units, or with a trailing % in parts of its bounding box diagonal.\n";

const std::string after_options =
    "Exit status: 0 if the mesh meets all criteria; 1 for bad usage or bad input, when no file is written; 2 if the "
    "run\nstopped early, by a limit or by Ctrl-C, when the valid mesh so far is written.\n";

struct Request : command_line::Files
{
  mesh_2_program::Sizes sizes;
  std::vector<std::string> size_texts; ///< as given
  std::string size_text;               ///< "size 0.1" or "lfs 0.5", for titles
  std::string voronoi;
  mesh_2_program::Input_options input_options;
  command_line::Length tolerance;
  weft::Mesh_options_2 options;
};

void add_options(command_line::Options& options, Request& request)
{
  auto& sizes = request.sizes;
  options.operands(request.inputs);
  options.texts("--size", "[MARK:]S", request.size_texts,
                "largest edge length (default 5% without --lfs); after a mark, in regions with that mark\nonly, as in "
                "2:0.1. A region's bound on areas in a .poly file counts, too");
  options.text("--size-field", "FILE", sizes.field,
               "sizes in the plane, at most S if --size gives one: at the vertices of a .vtu, .msh, or .mesh with its "
               ".sol;\ngraded");
  options.positive("--gradation", "K", sizes.gradation,
                   "growth of the file's sizes per unit of distance (default 0.5)");
  options.positive("--lfs", "K", sizes.lfs,
                   "edge lengths from the local feature size of the input, growing by at most K\nper unit of distance");
  options.length("--min-size", "S", false, sizes.min_size, "smallest edge length that --lfs asks for");
  options.positive("--min-angle", "DEG", request.options.min_angle,
                   "smallest angle to refine for, up to 40 degrees, where the input allows it");
  add_outputs(options, request,
              ".vtu (VTK),\n.mesh (Medit), .msh (Gmsh), .off, or .svg, a picture coloured by quality");
  options.filename("--voronoi", ".svg", request.voronoi, "a picture of the bounded Voronoi diagram of the mesh");
  add_histogram(options, request,
                "the angles of the mesh beside those of a mesh of the same sizes by CGAL's\nDelaunay refinement, which "
                "is made for that");
  add_report(options, request, "counts, quality, what holds and what doesn't, time per stage");
  add_seed_threads_and_time(options, request.options);
  add_max_vertices(options, request.options);
  options.length(
      "--tolerance", "T", true, request.tolerance,
      "distance up to which points, or a point and a segment, count as touching (default 3e-10\nof the longer "
      "side of the bounding box); 0: exact");
  options.flag("--split-crossings", request.input_options.split_crossings,
               "split segments that cross, instead of refusing them");
  add_quiet(options, request);
}

void read_sizes(Request& request)
{
  command_line::read_lengths("--size", "mark", request.size_texts, false, request.sizes.size,
                             request.sizes.size_of_mark);
  for (const std::string& text : request.size_texts)
    request.size_text += (request.size_text.empty() ? "size " : " ") + text;
}

/// What options mean together.
void check(const command_line::Options& options, Request& request)
{
  check_single_input(request);
  check_files("mesh_2", request, mesh_2_program::is_mesh_filename, ".vtu, .mesh, .msh, .off or .svg");
  read_sizes(request);
  const mesh_2_program::Sizes& sizes = request.sizes;
  if (!request.size_texts.empty() && sizes.lfs > 0) throw Error("--size and --lfs exclude each other");
  if (sizes.min_size.value > 0 && sizes.lfs == 0) throw Error("--min-size goes with --lfs only");
  if (!sizes.field.empty() && sizes.lfs > 0) throw Error("--size-field and --lfs exclude each other");
  if (!sizes.field.empty() && !sizes.size_of_mark.empty())
    throw Error("--size-field goes with a --size without a mark only");
  if (sizes.field.empty() && options.has("--gradation")) throw Error("--gradation goes with --size-field only");
  request.sizes.is_bounded = !request.size_texts.empty();
  if (!sizes.field.empty())
    request.size_text += (request.size_text.empty() ? "sizes of " : ", sizes of ") +
                         std::filesystem::path(sizes.field).filename().string();
  if (sizes.lfs > 0) request.size_text = "lfs " + options.value("--lfs");
  if (request.size_text.empty()) request.size_text = "size 5% of the diagonal, by default";
  if (options.has("--tolerance")) request.input_options.tolerance = request.tolerance;
  if (request.options.min_angle > 40) throw Error("--min-angle: more than 40 degrees can't be promised");
  request.options.check();
}

// ---- Input

std::unique_ptr<Domain> read_domain(const Request& request)
{
  try {
    auto domain = mesh_2_program::read_domain(request.inputs.front(), request.input_options);
    for (const std::string& warning : domain->warnings())
      command_line::complain("mesh_2", "warning: " + request.input() + ": " + warning);
    return domain;
  } catch (const weft::Domain_error& error) {
    // Contacts between segments are the only fault that names two of them.
    const bool may_be_split = !request.input_options.split_crossings && error.elements().size() == 2;
    throw Error(request.input() + ": " + error.what() + (may_be_split ? "; --split-crossings splits them" : ""));
  }
}

// ---- Output

/// Angles of the domain meshed by CGAL; none if that was interrupted or took longer than the time limit.
weft::Angle_histogram reference_angles(const Request& request, const Domain& domain, std::size_t likely_vertices,
                                       command_line::Progress_bar& bar)
{
  const auto start = std::chrono::steady_clock::now();
  return domain.reference_angles([&](std::size_t vertices) {
    bar.show(static_cast<double>(vertices) / static_cast<double>(likely_vertices),
             "CGAL's mesh for comparison, " + std::to_string(vertices) + " vertices");
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return !command_line::Interruption::wished() && elapsed.count() < request.options.time_limit;
  });
}

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const weft::Mesh_report_2& report, double min_angle)
{
  if (report.ok()) return {};
  std::string text = report.stop_reason == weft::Stop_reason::criteria_met
                         ? std::string("not all criteria hold")
                         : std::string("stopped early, ") + name(report.stop_reason);
  using weft::internal::counted;
  if (report.oversized > 0) text += ": " + counted(report.oversized, "element is", "elements are") + " too large";
  if (report.below_min_angle > 0)
    text += (report.oversized > 0 ? ", " : ": ") + counted(report.below_min_angle, "triangle has", "triangles have") +
            " an angle below " + weft::internal::one_decimal(min_angle) + " degrees";
  if (report.oversized == 0 && report.below_min_angle == 0) text += ": sizes hold, but shapes could be better";
  return text;
}

// ---- The run

/// Meshes, writes all files and tells how it went.
Status mesh(const Request& request, Domain& domain, command_line::Output_files& files)
{
  Meshing_progress progress(!request.quiet, 0.5);
  weft::Mesh_options_2 options = request.options;
  options.visitor = std::ref(progress);
  const weft::Mesh_report_2 report = domain.mesh(request.sizes, options, !request.histogram.empty());
  std::string missing = what_is_missing(report, options.min_angle);
  progress.bar().clear();

  const std::string title =
      std::filesystem::path(request.inputs.front()).filename().string() + ", " + request.size_text;
  for (const std::string& filename : request.outputs)
    files.add(filename, [&](const std::string& name) { domain.write_mesh(name); });
  if (!request.voronoi.empty())
    files.add(request.voronoi, [&](const std::string& name) { domain.draw_voronoi(name, title); });
  if (!request.report.empty())
    files.add(request.report, [&](const std::string& name) { domain.write_report(name, report); });
  if (!request.histogram.empty()) {
    weft::Angle_histogram reference;
    if (missing.empty()) {
      reference = reference_angles(request, domain, report.vertices * 3 / 2, progress.bar());
      if (reference.total() == 0) missing = "stopped early: the mesh is complete, the histogram lacks CGAL's";
    }
    files.add(request.histogram, [&](const std::string& name) {
      if (reference.total() > 0)
        weft::IO::write_angle_histogram_svg(name, domain.angles(), reference, "Angles: " + title);
      else
        weft::IO::write_angle_histogram_svg(name, domain.angles(), "Angles: " + title);
    });
  }
  files.commit();
  progress.bar().clear();
  if (!request.quiet) {
    std::cout << request.size_text << "\n" << report;
    if (request.outputs.empty()) std::cout << "no mesh is written: --output FILE names one\n";
    std::cout << std::flush;
  }
  if (!missing.empty()) command_line::complain("mesh_2", missing);
  return missing.empty() ? complete : stopped_early;
}

Status run(const Request& request)
{
  const std::unique_ptr<Domain> domain = read_domain(request);
  command_line::Output_files files;
  announce(request, files);
  if (!request.voronoi.empty()) files.announce(request.voronoi);
  const command_line::Interruption interruption;
  try {
    return mesh(request, *domain, files);
  } catch (const weft::Domain_error& error) {
    throw Error(request.input() + ": " + error.what());
  }
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program("mesh_2", before_options, after_options, add_options, check, run, argc, argv);
}
