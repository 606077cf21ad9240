// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program for spatial meshes: reads closed surfaces or a labelled image, fills them with tetrahedra,
// writes the mesh, a picture of its dihedral angles and figures. `mesh_3 --help` says how to call it. The parts that
// need CGAL are in programs/mesh_3.

#include "interruption.h"
#include "meshing_progress.h"
#include "output_files.h"
#include "program_options.h"
#include "programs/mesh_3/domain.h"

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/internal/Timer.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/surface/Mending_record_3.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

using command_line::complete;
using command_line::Error;
using command_line::Length;
using command_line::Status;
using command_line::stopped_early;
using mesh_3_program::Domain;
using mesh_3_program::Result;

// ---- What is asked for

const std::string before_options =
    "usage: mesh_3 INPUT... [--size [LABEL:]S|auto]... [--size-field FILE] [--gradation K]\n"
    "              [--approximation [LABEL:]E]... [--facet-shape R] [--cell-shape R] [--sharp-angle DEG]\n"
    "              [--topology] [--manifold] [--min-dihedral DEG] [--effort E] [--no-optimise] [--no-perturb]\n"
    "              [--strict] [--weld PART] [--cap SHARE] [--iso VALUE] [--inside above|below] [--labels]\n"
    "              [--name LABEL:NAME]... [--order 1|2]\n"
    "              [--output FILE]... [--report FILE.json] [--histogram FILE.svg] [--seed N] [--threads N]\n"
    "              [--time-limit SECONDS] [--max-vertices N] [--quiet]\n\n"
    "Fills the domain that a closed surface bounds with tetrahedra. INPUT is an .off, .obj, .stl or .ply file, or .3mf "
    "where\nlib3mf is installed. Several surfaces bound a subdomain each, numbered from 1; what lies in several of "
    "them "
    "belongs to\nthe last. Solids of a file, objects, materials and colours of facets that bound regions are "
    "subdomains "
    "with names.\nOr INPUT is an image, .inr, .inr.gz or .hdr: of labels, of which each but 0 is a subdomain, or with "
    "--iso of grey\nvalues. Lengths are in the input's units, or with a trailing % in parts of its bounding box "
    "diagonal.\n\n"
    "A surface with seams, facets turned over, there twice, degenerate or crossing, fins, holes or walls inside is "
    "mended; "
    "notes say\nwhat was done. Walls and edges where parts touch divide it into subdomains.\n";

const std::string after_options =
    "Exit status: 0 if the mesh meets all criteria; 1 for bad usage or bad input, when no file is written; 2 if the "
    "run\nstopped early, by a limit or by Ctrl-C, or couldn't meet a criterion, when the valid mesh so far is "
    "written.\n";

struct Request : command_line::Files
{
  Length size{5, true}, approximation{0.1, true};
  std::vector<std::string> size_texts, approximation_texts, name_texts; ///< as given
  std::string size_field;
  std::map<int, Length> size_of, approximation_of; ///< instead, by label
  mesh_3_program::Bounds bounds;                   ///< without lengths, which need the input
  mesh_3_program::Image_options image;
  double iso = 0;
  weft::Feature_options features;
  weft::Mesh_options_3 options;
  double min_dihedral = 0, effort = 0;
  mesh_3_program::Mending mending;
  bool approximation_is_given = false, no_optimise = false, no_perturb = false;
};

void add_options(command_line::Options& options, Request& request)
{
  constexpr double most = std::numeric_limits<double>::max();
  auto& bounds = request.bounds;
  options.operands(request.inputs);
  options.texts("--size", "[LABEL:]S|auto", request.size_texts,
                "longest edge (default 5%); after a label, in subdomains with that label only, as in\n2:0.1. Labels "
                "are an image's values, or the numbers of surfaces. auto: as fine as the\ndomain's features want, two "
                "edges across its thicknesses and gaps, at most S");
  options.text("--size-field", "FILE", request.size_field,
               "sizes in space, at most S: at the vertices of a .vtu, .msh, or .mesh with its .sol,\nor an image of "
               "them; graded");
  options.positive("--gradation", "K", request.bounds.gradation,
                   "growth of sizes per unit of distance (any; 0.5 where they come from features or a\nfile)");
  options.texts("--approximation", "[LABEL:]E", request.approximation_texts,
                "distance of facets and crease edges to the surface, 0 for any (default 0.1%; in images at least\n0.6 "
                "voxels); after a label, at the boundary of that subdomain only");
  options.number("--facet-shape", "R", 0, most, bounds.facet_shape,
                 "largest circumradius / shortest edge of a boundary facet, from 1; 0 for any\n(default 2)");
  options.number("--cell-shape", "R", 0, most, bounds.cell_shape, "the same for cells (default 2)");
  options.number("--sharp-angle", "DEG", 0, 180, request.features.sharp_angle,
                 "edges of the input are sharp from this angle between the normals of their facets\non; 0 for none. "
                 "Without it 60, but for creases that end nowhere and are short, and\nthose that keep the criteria "
                 "from holding");
  options.flag("--topology", bounds.topology,
               "boundary facets keep to one patch between creases, crease edges to one crease");
  options.flag("--manifold", bounds.manifold, "the boundary of the mesh must be a 2-manifold");
  options.number("--min-dihedral", "DEG", 0, 90, request.min_dihedral,
                 "smallest dihedral angle to perturb slivers for, 90 to go as far as possible; without\nit 20, if it "
                 "can be reached");
  options.number("--effort", "E", 0, 1, request.effort,
                 "work on quality after refinement, instead of the three options around this one: 0\nnone, 0.5 as "
                 "without them, 1 as far as possible, which takes minutes");
  options.flag("--no-optimise", request.no_optimise, "neither coarsening nor smoothing after refinement");
  options.flag("--no-perturb", request.no_perturb, "no perturbation of slivers");
  options.flag("--strict", request.mending.strict,
               "refuse an input that isn't a closed surface, instead of mending it");
  options.number("--weld", "PART", 0, 0.01, request.mending.options.tolerance,
                 "where facets don't fit together, points are welded within this part of the bounding\nbox diagonal "
                 "(default 1e-6)");
  options.number("--cap", "SHARE", 0, 0.9, request.mending.options.most_capped,
                 "holes are capped, if caps are at most this part of the area (default 0.3); 0 for none");
  options.number("--iso", "VALUE", -most, most, request.iso,
                 "take an image for grey values or signed distances: the value on the boundary of the\ndomain, "
                 "interpolated between voxels");
  options.text("--inside", "above|below", request.image.inside,
               "which values belong to the domain, with --iso. Without it those that are rarer at the\nimage's border");
  options.flag("--labels", request.image.takes_labels, "take an image for labels, even if it looks like grey values");
  options.texts("--name", "LABEL:NAME", request.name_texts,
                "name of a subdomain in .msh, .vtu and .inp files; may be given several times");
  options.integer(
      "--order", "N", 1, 2, request.bounds.order,
      "order of the elements (default 1): with 2, edges have nodes in the middle, which lie on\nthe boundary "
      "where edges do; for .vtu, .msh and .inp");
  add_outputs(options, request, command_line::spatial_formats);
  add_report(options, request, "counts, quality, what holds and what doesn't, time per stage");
  add_histogram(options, request, "a picture of the distribution of dihedral angles");
  request.options.threads = command_line::all_cores();
  add_seed_threads_and_time(options, request.options);
  add_max_vertices(options, request.options);
  add_quiet(options, request);
}

/// A bound on shapes is at least 1, or 0 for none.
void check_shape(const command_line::Options& options, const std::string& option, double bound)
{
  if (bound > 0 && bound < 1) throw Error(option + ": '" + options.value(option) + "' is neither 0 nor at least 1");
}

/// Reads what options say of labels.
void check_labels(Request& request)
{
  auto& sizes = request.size_texts;
  const auto automatic = std::remove(sizes.begin(), sizes.end(), "auto");
  request.bounds.by_features = automatic != sizes.end();
  if (sizes.end() - automatic > 1) throw Error("--size is given twice");
  sizes.erase(automatic, sizes.end());
  command_line::read_lengths("--size", "label", sizes, false, request.size, request.size_of);
  if (!request.size_field.empty() && sizes.size() == request.size_of.size()) request.size = {100, true};
  command_line::read_lengths("--approximation", "label", request.approximation_texts, true, request.approximation,
                             request.approximation_of);
  request.approximation_is_given = request.approximation_texts.size() > request.approximation_of.size();
  command_line::read_by_label(
      "--name", "label", request.name_texts,
      [](const std::string& text) {
        if (text.empty()) throw Error("--name: a name is missing");
        return text;
      },
      [](const std::string& text) { throw Error("--name: '" + text + "' isn't LABEL:NAME"); }, request.bounds.name_of);
}

void check_image_options(const Request& request)
{
  const mesh_3_program::Image_options& image = request.image;
  const bool is_image = mesh_3_program::is_image_filename(request.inputs.front());
  if (image.iso && !is_image) throw Error("--iso goes with images only");
  if (image.takes_labels && !is_image) throw Error("--labels goes with images only");
  if (image.iso && image.takes_labels) throw Error("--iso and --labels exclude each other");
  if (image.inside.empty()) return;
  if (!image.iso) throw Error("--inside goes with --iso only");
  if (image.inside != "above" && image.inside != "below")
    throw Error("--inside: '" + image.inside + "' is neither above nor below");
}

/// What options mean together.
void check(const command_line::Options& options, Request& request)
{
  const int order = request.bounds.order;
  check_files(
      "mesh_3", request, [order](const std::string& name) { return mesh_3_program::is_mesh_filename(name, order); },
      order == 2 ? ".vtu, .msh or .inp" : command_line::spatial_endings);
  if (request.inputs.size() > 1 &&
      std::any_of(request.inputs.begin(), request.inputs.end(), mesh_3_program::is_image_filename))
    throw Error("an image must be the only input file");
  check_shape(options, "--facet-shape", request.bounds.facet_shape);
  check_shape(options, "--cell-shape", request.bounds.cell_shape);
  command_line::check_min_dihedral(options, request.min_dihedral);
  if (options.has("--effort") && (options.has("--min-dihedral") || request.no_optimise || request.no_perturb))
    throw Error("--effort excludes --min-dihedral, --no-optimise and --no-perturb");
  if (request.mending.strict && (options.has("--weld") || options.has("--cap")))
    throw Error("--strict excludes --weld and --cap");
  check_labels(request);
  if (options.has("--iso")) request.image.iso = request.iso;
  check_image_options(request);
  auto& run = request.options;
  if (request.no_optimise) {
    run.coarsen = false;
    run.smoothing_sweeps = 0;
  }
  if (options.has("--min-dihedral")) run.min_dihedral_angle = request.min_dihedral;
  if (request.no_perturb) run.min_dihedral_angle = 0;
  if (options.has("--effort")) run.effort = request.effort;
  run.give_up_creases = !options.has("--sharp-angle");
  if (options.has("--sharp-angle")) request.features.least_open_crease = 0;
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
std::string what_is_missing(const Request& request, const weft::Mesh_report_3& report, double smallest_dihedral,
                            std::size_t left_out)
{
  using command_line::append_to_list;
  std::string text;
  append_unsatisfied(text, report.bad_edges, "crease edge", "crease edges");
  append_unsatisfied(text, report.bad_facets, "facet", "facets");
  append_unsatisfied(text, report.bad_cells, "cell", "cells");
  if (report.bad_vertices > 0)
    append_to_list(text, std::to_string(report.bad_vertices) + " vertices without a topological disk");
  if (report.bare_patches > 0) append_to_list(text, std::to_string(report.bare_patches) + " patches without a facet");
  if (request.bounds.manifold && !report.manifold) append_to_list(text, "the boundary isn't a manifold");
  if (!report.domain.has_surface())
    append_to_list(text, std::to_string(report.domain.missed()) + " points of the boundary are missed");
  if (!report.given.ok())
    append_to_list(text, weft::Mending_record_3::percent(report.given.missed_share()) +
                             " of the input's area is far from the mesh");
  for (const weft::Subdomain_comparison_3& s : report.domain.subdomains) {
    const std::string of_subdomain =
        report.domain.subdomains.size() > 1 ? " of subdomain " + std::to_string(s.subdomain) : "";
    if (!s.has_volume()) append_to_list(text, "the volume" + of_subdomain + " is wrong");
    if (!s.has_topology()) append_to_list(text, "parts or handles" + of_subdomain + " are missing or too many");
  }
  if (left_out > 0)
    append_to_list(text, weft::internal::counted(left_out, "component", "components") + " of labels left out");
  append_to_list(text, command_line::missing_dihedral(request.min_dihedral, smallest_dihedral));
  if (report.stop_reason != weft::Stop_reason::criteria_met)
    return std::string("stopped early, ") + name(report.stop_reason) + (text.empty() ? "" : ": ") + text;
  return text.empty() ? text : "not all criteria hold: " + text;
}

void write_files(const Request& request, const Result& result, command_line::Output_files& files)
{
  for (const std::string& filename : request.outputs)
    files.add(filename, [&](const std::string& name) { mesh_3_program::write_mesh(name, result); });
  if (!request.report.empty())
    files.add(request.report, [&](const std::string& name) { mesh_3_program::write_report(name, result); });
  if (!request.histogram.empty())
    files.add(request.histogram, [&](const std::string& name) {
      const std::string title = "Dihedral angles: " + std::filesystem::path(request.inputs.front()).filename().string();
      mesh_3_program::write_histogram(name, result, title);
    });
  files.commit();
}

// ---- The run

/// The domain that the input bounds.
/// \param go_on see `weft::Mend_options_3`.
std::unique_ptr<Domain> read_domain(const Request& request, const std::function<bool(const char*)>& go_on)
{
  mesh_3_program::Mending mending = request.mending;
  mending.options.go_on = go_on;
  const bool is_image = mesh_3_program::is_image_filename(request.inputs.front());
  try {
    return is_image ? mesh_3_program::read_image(request.inputs.front(), request.image)
                    : mesh_3_program::read_surfaces(request.inputs, request.features, mending);
  } catch (const weft::Domain_error& error) {
    const std::string what = error.what();
    const char* advice = "";
    if (!is_image && request.mending.strict)
      advice = "; without --strict it would be mended if that can be";
    else if (what.find("caps of its holes would be") != std::string::npos)
      advice = ", or allow more with --cap";
    throw Error(request.input() + ": " + what + advice);
  }
}

/// The bounds with lengths in the units of the domain.
mesh_3_program::Bounds bounds(const Request& request, const Domain& domain)
{
  mesh_3_program::Bounds bounds = request.bounds;
  if (!request.size_field.empty()) bounds.size_field = mesh_3_program::read_size_field(request.size_field);
  const double extent = domain.extent();
  bounds.size = request.size.in(extent);
  bounds.approximation = request.approximation.in(extent);
  for (const auto& [label, size] : request.size_of) bounds.size_of[label] = size.in(extent);
  for (const auto& [label, length] : request.approximation_of) bounds.approximation_of[label] = length.in(extent);
  if (!request.approximation_is_given) bounds.approximation = std::max(bounds.approximation, 0.6 * domain.detail());
  return bounds;
}

/// Meshes, writes all files and tells how it went.
Status run(const Request& request)
{
  const command_line::Interruption interruption;
  Meshing_progress progress(!request.quiet, 0.1);
  const weft::internal::Timer timer;
  weft::Mesh_options_3 options = request.options;
  std::unique_ptr<Domain> domain;
  try {
    domain = read_domain(request, [&](const char* doing) {
      progress.bar().show(0, doing);
      return !command_line::Interruption::wished() && timer.seconds() < options.time_limit;
    });
  } catch (const weft::Stopped_error& error) {
    throw Error(
        request.input() + ": no mesh yet, " + error.what() + ", " +
        name(command_line::Interruption::wished() ? weft::Stop_reason::cancelled : weft::Stop_reason::time_limit) +
        "; nothing is written");
  }
  progress.bar().clear();
  for (const std::string& change : domain->changes())
    if (!request.quiet) command_line::complain("mesh_3", request.input() + ": " + change);
  command_line::Output_files files;
  announce(request, files);
  options.time_limit = std::max(0.0, options.time_limit - timer.seconds());

  options.visitor = std::ref(progress);
  const mesh_3_program::Bounds asked = bounds(request, *domain);
  options.size_floor = asked.size_field || asked.by_features ? 0 : domain->least_edge();
  for (const auto& [label, size] : asked.size_of) options.size_floor = std::min(options.size_floor, 0.3 * size);
  options.size_floor = std::min(options.size_floor, 0.3 * asked.size);
  const auto result = domain->mesh(asked, options);
  progress.bar().clear();

  const weft::Mesh_report_3& report = mesh_3_program::report(*result);
  if (is_empty(*result))
    throw Error(request.input() + ": no mesh yet, " + name(report.stop_reason) + "; nothing is written");
  const std::vector<std::string> left_out = mesh_3_program::left_out(*result);
  const std::string missing = what_is_missing(request, report, smallest_dihedral(*result), left_out.size());
  write_files(request, *result, files);
  if (!request.quiet) {
    std::cout << report;
    if (const std::string line = second_order(*result); !line.empty()) std::cout << line << "\n";
    for (const std::string& line : left_out) std::cout << line << "\n";
    if (request.outputs.empty()) std::cout << "no mesh is written: --output FILE names one\n";
    std::cout << std::flush;
  }
  if (!missing.empty()) command_line::complain("mesh_3", missing);
  return missing.empty() ? complete : stopped_early;
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program("mesh_3", before_options, after_options, add_options, check, run, argc, argv);
}
