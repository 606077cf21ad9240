// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program for spatial meshes: reads closed surfaces or a labelled image, fills them with tetrahedra,
// writes the mesh, a picture of its dihedral angles and figures. `mesh_3 --help` says how to call it.

#include "command_line.h"
#include "meshing_progress.h"

#include <weft/IO/read_label_image.h>
#include <weft/IO/read_surface.h>
#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/IO/write_mesh_3.h>
#include <weft/IO/write_report_json_3.h>
#include <weft/make_mesh_3.h>
#include <weft/mesh_surface_3.h>
#include <weft/spatial/domain/Label_image_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/surface/merge_surfaces_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/repair_surface_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
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
using Complex = weft::Piecewise_smooth_complex_3<K>;
using Mesh = weft::Tetrahedral_mesh_3<K>;
using command_line::complete;
using command_line::Error;
using command_line::Status;
using command_line::stopped_early;

// ---- What is asked for

const std::string usage =
    "usage: mesh_3 INPUT... [--size S] [--approximation E] [--facet-shape R] [--cell-shape R] [--sharp-angle DEG]\n"
    "              [--topology] [--manifold] [--min-dihedral DEG] [--no-optimise] [--no-perturb] [--repair]\n"
    "              [--output FILE]... [--report FILE.json] [--histogram FILE.svg] [--seed N] [--threads N]\n"
    "              [--time-limit SECONDS] [--max-vertices N] [--quiet]\n";

const std::vector<command_line::Option> known_options = {
    {"--size", "S", "longest edge (default 5%)"},
    {"--approximation", "E",
     "distance of facets and crease edges to the surface, 0 for any (default 0.1%; in images at least\n0.6 voxels)"},
    {"--facet-shape", "R", "largest circumradius / shortest edge of a boundary facet, from 1; 0 for any\n(default 2)"},
    {"--cell-shape", "R", "the same for cells (default 2)"},
    {"--sharp-angle", "DEG",
     "edges of the input are sharp from this angle between the normals of their facets\non; 0 for none. Without it 60, "
     "but for creases that end nowhere and are short, and\nthose that keep the criteria from holding"},
    {"--topology", "", "boundary facets keep to one patch between creases, crease edges to one crease"},
    {"--manifold", "", "the boundary of the mesh must be a 2-manifold"},
    {"--min-dihedral", "DEG",
     "smallest dihedral angle to perturb slivers for, 90 to go as far as possible; without\nit 20, if it can be "
     "reached"},
    {"--no-optimise", "", "neither coarsening nor smoothing after refinement"},
    {"--no-perturb", "", "no perturbation of slivers"},
    {"--repair", "", "try to repair an input that isn't a closed surface, instead of refusing it"},
    {"--output", "FILE",
     "the mesh; may be given several times. The extension is the format: .mesh (Medit),\n.vtu (VTK), .msh (Gmsh), or "
     "of "
     "the boundary alone .off or .stl",
     true},
    {"--report", "FILE.json", "counts, quality, what holds and what doesn't, time per stage"},
    {"--histogram", "FILE.svg", "a picture of the distribution of dihedral angles"},
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
         "\nFills the domain that a closed surface bounds with tetrahedra. INPUT is an .off, .obj, .stl or .ply file. "
         "Several\nsurfaces bound a subdomain each, numbered from 1; what lies in several of them belongs to the last. "
         "Or "
         "INPUT is a\nlabelled image, .inr, .inr.gz or .hdr: each value but 0 is a subdomain. Lengths are in the "
         "input's "
         "units, or with a\ntrailing % in parts of its bounding box diagonal.\n\n" +
         command_line::describe(known_options) +
         "\nExit status: 0 if the mesh meets all criteria; 1 for bad usage or bad input, when no file is written; 2 if "
         "the run\nstopped early, by a limit or by Ctrl-C, or couldn't meet a criterion, when the valid mesh so far is "
         "written.\n";
}

struct Request
{
  std::vector<std::string> inputs;
  command_line::Length size{5, true}, approximation{0.1, true};
  weft::Criteria_3<K> criteria; ///< without lengths, which need the input
  weft::Feature_options features;
  weft::Mesh_options_3 options;
  double min_dihedral = 0;
  std::vector<std::string> outputs;
  std::string histogram, report;
  bool repair = false, quiet = false, approximation_is_given = false, must_be_manifold = false;

  /// For messages.
  std::string name() const { return inputs.size() == 1 ? inputs.front() : inputs.front() + " and others"; }
};

/// Dihedral angle of regular tetrahedra, in degrees: no mesh has more, since they don't fill space.
constexpr double regular = 70.53;

/// A bound on shapes: at least 1, or 0 for none.
double shape(const command_line::Arguments& arguments, const std::string& option, double otherwise)
{
  const double bound = arguments.number(option, 0, std::numeric_limits<double>::max()).value_or(otherwise);
  if (bound > 0 && bound < 1) throw Error(option + ": '" + arguments.value(option) + "' is neither 0 nor at least 1");
  return bound;
}

void read_criteria(const command_line::Arguments& arguments, Request& request)
{
  request.size = arguments.length("--size").value_or(request.size);
  request.approximation_is_given = arguments.has("--approximation");
  request.approximation = arguments.length("--approximation", true).value_or(request.approximation);
  auto& criteria = request.criteria;
  criteria.facet_shape = shape(arguments, "--facet-shape", criteria.facet_shape);
  criteria.cell_shape = shape(arguments, "--cell-shape", criteria.cell_shape);
  criteria.topology = arguments.has("--topology");
  request.min_dihedral = arguments.number("--min-dihedral", 0, 90).value_or(0);
  if (request.min_dihedral > regular && request.min_dihedral < 90)
    throw Error("--min-dihedral: '" + arguments.value("--min-dihedral") +
                "' is more than regular tetrahedra have; 90 goes as far as possible");
  if (arguments.has("--no-optimise")) {
    request.options.coarsen = false;
    request.options.smoothing_sweeps = 0;
  }
  if (arguments.has("--min-dihedral")) request.options.min_dihedral_angle = request.min_dihedral;
  if (arguments.has("--no-perturb")) request.options.min_dihedral_angle = 0;
  request.features.sharp_angle = arguments.number("--sharp-angle", 0, 180).value_or(request.features.sharp_angle);
  request.options.give_up_creases = !arguments.has("--sharp-angle");
  if (arguments.has("--sharp-angle")) request.features.least_open_crease = 0;
  request.repair = arguments.has("--repair");
  request.must_be_manifold = arguments.has("--manifold");
}

void read_options(const command_line::Arguments& arguments, Request& request)
{
  auto& options = request.options;
  options.time_limit = arguments.positive("--time-limit").value_or(options.time_limit);
  options.seed = arguments.integer<unsigned>("--seed", 0, std::numeric_limits<unsigned>::max()).value_or(options.seed);
  options.threads = arguments.integer<int>("--threads", 1, 1024).value_or(options.threads);
  constexpr std::size_t most_vertices = 1000000000;
  options.max_vertices =
      arguments.integer<std::size_t>("--max-vertices", 1, most_vertices).value_or(options.max_vertices);
}

void read_filenames(const command_line::Arguments& arguments, Request& request)
{
  if (arguments.operands().empty()) throw Error("no input file; mesh_3 --help shows the usage");
  request.inputs = arguments.operands();
  const auto is_image = [](const std::string& name) { return weft::IO::is_label_image_filename(name); };
  if (request.inputs.size() > 1 && std::any_of(request.inputs.begin(), request.inputs.end(), is_image))
    throw Error("an image must be the only input file");
  request.outputs = arguments.values("--output");
  for (const std::string& filename : request.outputs)
    if (!weft::IO::is_mesh_3_filename(filename))
      throw Error("--output: '" + filename + "' should end in .mesh, .vtu, .msh, .off or .stl");
  request.histogram = arguments.filename("--histogram", ".svg");
  request.report = arguments.filename("--report", ".json");
}

Request read_request(const command_line::Arguments& arguments)
{
  Request request;
  read_filenames(arguments, request);
  read_criteria(arguments, request);
  read_options(arguments, request);
  request.quiet = arguments.has("--quiet");
  return request;
}

// ---- Input

/// The domain that the input surfaces bound; says what was changed in them.
Complex read_domain(const Request& request)
{
  std::vector<weft::Polygon_soup_3<K>> surfaces;
  for (const std::string& name : request.inputs) surfaces.push_back(weft::IO::read_surface<K>(name));
  try {
    using Repair = weft::Polygon_soup_3<K>::Repair;
    auto complex = weft::piecewise_smooth_complex(surfaces, request.features,
                                                  request.repair ? Repair(weft::repair_surface<K>) : Repair());
    for (const std::string& change : complex.changes)
      if (!request.quiet) command_line::complain("mesh_3", request.name() + ": " + change);
    return complex;
  } catch (const weft::Domain_error& error) {
    throw Error(request.name() + ": " + error.what() + (request.repair ? "" : "; --repair tries to set it right"));
  }
}

double diagonal(const CGAL::Bbox_3& box)
{
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

// ---- Output

/// "3 bad facets (size, shape)", or nothing.
void append_unsatisfied(std::string& text, const weft::Unsatisfied_3& bad, const char* one, const char* many)
{
  if (bad.elements == 0) return;
  const unsigned reasons = (bad.size ? weft::bad_size : 0u) | (bad.approximation ? weft::bad_approximation : 0u) |
                           (bad.shape ? weft::bad_shape : 0u) | (bad.topology ? weft::bad_topology : 0u) |
                           (bad.disk ? weft::bad_disk : 0u) | (bad.demand ? weft::bad_demand : 0u);
  text += (text.empty() ? "" : ", ") + std::to_string(bad.elements) + " bad " + (bad.elements == 1 ? one : many) +
          " (" + weft::describe_reasons(reasons) +
          (bad.at_acute_edge ? "; " + std::to_string(bad.at_acute_edge) + " at acute edges of the input)" : ")");
}

/// What keeps the mesh from what was asked for, as one line; empty if nothing does.
std::string what_is_missing(const Request& request, const weft::Mesh_report_3& report, double smallest_dihedral)
{
  std::string text;
  append_unsatisfied(text, report.bad_edges, "crease edge", "crease edges");
  append_unsatisfied(text, report.bad_facets, "facet", "facets");
  append_unsatisfied(text, report.bad_cells, "cell", "cells");
  const auto append = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (report.bad_vertices > 0) append(std::to_string(report.bad_vertices) + " vertices without a topological disk");
  if (report.bare_patches > 0) append(std::to_string(report.bare_patches) + " patches without a facet");
  if (request.must_be_manifold && !report.manifold) append("the boundary isn't a manifold");
  if (smallest_dihedral < request.min_dihedral && request.min_dihedral < regular)
    append("the smallest dihedral angle is " + weft::internal::one_decimal(std::floor(10 * smallest_dihedral) / 10) +
           " degrees, not " + weft::internal::one_decimal(request.min_dihedral));
  if (report.stop_reason != weft::Stop_reason::criteria_met)
    return std::string("stopped early, ") + name(report.stop_reason) + (text.empty() ? "" : ": ") + text;
  return text.empty() ? text : "not all criteria hold: " + text;
}

void write_files(const Request& request, const Mesh& mesh, const weft::Mesh_report_3& report,
                 const weft::Quality_3& quality, command_line::Output_files& files)
{
  for (const std::string& filename : request.outputs)
    files.add(filename, [&](const std::string& name) { weft::IO::write_mesh_3(name, mesh); });
  if (!request.report.empty())
    files.add(request.report, [&](const std::string& name) { weft::IO::write_report_json(name, report, quality); });
  if (!request.histogram.empty())
    files.add(request.histogram, [&](const std::string& name) {
      const std::string title = "Dihedral angles: " + std::filesystem::path(request.inputs.front()).filename().string();
      weft::IO::write_angle_histogram_svg(name, quality.histogram<weft::Angle_histogram>("weft"), title);
    });
  files.commit();
}

// ---- The run

template <class Oracle>
auto make_mesh(const Oracle& oracle, const weft::Criteria_3<K>& criteria, const weft::Mesh_options_3& options)
{
  return weft::make_mesh_3(oracle, criteria, options);
}
auto make_mesh(const Complex& surface, const weft::Criteria_3<K>& criteria, const weft::Mesh_options_3& options)
{
  return weft::mesh_surface_3(surface, criteria, options);
}

/// Meshes, writes all files and tells how it went.
/// \param domain an oracle or the complex of a surface. \param box around it.
/// \param detail size of the smallest details of the input that count, in its units; 0 if all do.
template <class Domain>
Status mesh(const Request& request, const Domain& domain, const CGAL::Bbox_3& box, double detail)
{
  command_line::Output_files files;
  for (const std::string& filename : request.outputs) files.announce(filename);
  for (const std::string& filename : {request.histogram, request.report})
    if (!filename.empty()) files.announce(filename);

  const command_line::Interruption interruption;
  Meshing_progress progress(!request.quiet, 0.1);
  weft::Mesh_options_3 options = request.options;
  options.visitor = std::ref(progress);
  weft::Criteria_3<K> criteria = request.criteria;
  const double extent = diagonal(box);
  criteria.size = request.size.in(extent);
  const double approximation = request.approximation.in(extent);
  criteria.approximation = request.approximation_is_given ? approximation : std::max(approximation, 0.6 * detail);
  options.size_floor = 0.3 * detail;
  const auto result = make_mesh(domain, criteria, options);
  progress.bar().clear();

  const Mesh tetrahedra = weft::tetrahedral_mesh(result.restricted);
  if (tetrahedra.cells.empty())
    throw Error(request.name() + ": no mesh yet, " + name(result.report.stop_reason) + "; nothing is written");
  const weft::Quality_3 quality = weft::measure_quality_3(tetrahedra);
  const std::string missing = what_is_missing(request, result.report, quality.smallest_dihedral.degrees);
  write_files(request, tetrahedra, result.report, quality, files);
  if (!request.quiet) std::cout << result.report << std::flush;
  if (!missing.empty()) command_line::complain("mesh_3", missing);
  return missing.empty() ? complete : stopped_early;
}

Status run(const Request& request)
{
  if (!weft::IO::is_label_image_filename(request.inputs.front())) {
    const Complex complex = read_domain(request);
    CGAL::Bbox_3 box;
    for (const auto& p : complex.points) box += p.bbox();
    return mesh(request, complex, box, 0);
  }
  const weft::Label_image_3 image = weft::IO::read_label_image(request.inputs.front());
  const auto& voxel = image.spacing();
  const auto oracle = weft::image_oracle_3<K>(image);
  return mesh(request, oracle, oracle.bbox(), *std::max_element(voxel.begin(), voxel.end()));
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program(
      "mesh_3", known_options, help,
      [](const command_line::Arguments& arguments) { return run(read_request(arguments)); }, argc, argv);
}
