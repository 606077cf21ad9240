// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line program for planar meshes: reads a planar straight line graph, meshes what it encloses, writes the
// mesh, pictures and figures. `mesh_2 --help` says how to call it.

#include "cgal_refinement.h"
#include "command_line.h"
#include "meshing_progress.h"

#include <weft/IO/read_pslg.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/IO/write_report_json_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>
#include <weft/planar/sizing/Region_sizing_2.h>
#include <weft/planar/triangulation/Bounded_voronoi_diagram_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;
using Pslg = weft::Pslg_2<K>;
using Tags = weft::Mesh_tags_2<K>;
using command_line::complete;
using command_line::Error;
using command_line::Status;
using command_line::stopped_early;

// ---- What is asked for

const std::string usage =
    "usage: mesh_2 INPUT [--size [MARK:]S]... [--lfs K] [--min-size S] [--min-angle DEG] [--output FILE]...\n"
    "              [--voronoi FILE.svg] [--histogram FILE.svg] [--report FILE.json] [--seed N] [--threads N]\n"
    "              [--time-limit SECONDS] [--max-vertices N] [--tolerance T] [--split-crossings] [--quiet]\n";

const std::vector<command_line::Option> known_options = {
    {"--size", "[MARK:]S",
     "largest edge length (default 5% without --lfs); after a mark, in regions with that mark\nonly, as in 2:0.1. A "
     "region's bound on areas in a .poly file counts, too",
     true},
    {"--lfs", "K", "edge lengths from the local feature size of the input, growing by at most K\nper unit of distance"},
    {"--min-size", "S", "smallest edge length that --lfs asks for"},
    {"--min-angle", "DEG", "smallest angle to refine for, up to 40 degrees, where the input allows it"},
    {"--output", "FILE",
     "the mesh; may be given several times. The extension is the format: .vtu (VTK),\n.mesh (Medit), "
     ".msh (Gmsh), .off, or .svg, a picture coloured by quality",
     true},
    {"--voronoi", "FILE.svg", "a picture of the bounded Voronoi diagram of the mesh"},
    {"--histogram", "FILE.svg",
     "the angles of the mesh beside those of a mesh of the same sizes by CGAL's\nDelaunay "
     "refinement, which is made for that"},
    {"--report", "FILE.json", "counts, quality, what holds and what doesn't, time per stage"},
    {"--seed", "N", "start of every random choice"},
    {"--threads", "N", "threads to use; the mesh is the same for any number"},
    {"--time-limit", "SECONDS", "stop early after this time"},
    {"--max-vertices", "N", "stop early at this number of vertices"},
    {"--tolerance", "T",
     "distance up to which points, or a point and a segment, count as touching (default 3e-10 of the\nlonger side of "
     "the bounding box); 0: exact"},
    {"--split-crossings", "", "split segments that cross, instead of refusing them"},
    {"--quiet", "", "no progress and no report; errors are still said"},
    {"--help", "", "print this and exit"},
    {"--version", "", "print the version and exit"}};

std::string help()
{
  return usage +
         "\nMeshes the domain that a planar straight line graph encloses with large, well-shaped triangles. INPUT is a "
         ".poly or\n.node file of Triangle, an .edg file of CGAL, or an .obj file with lines. If a .poly has holes "
         "they bound the\ndomain; else a region belongs to it when an odd number of outlines surrounds it, or when the file "
         "names it. Lengths are\nin the input's units, or with a trailing % in parts of its bounding box diagonal.\n\n" +
         command_line::describe(known_options) +
         "\nExit status: 0 if the mesh meets all criteria; 1 for bad usage or bad input, when no file is written; 2 if "
         "the run\nstopped early, by a limit or by Ctrl-C, when the valid mesh so far is written.\n";
}

struct Request
{
  std::string input;
  std::string size_text; ///< "size 0.1" or "lfs 0.5", for titles
  command_line::Length size{5, true};
  std::map<int, command_line::Length> size_of_mark;
  double lfs = 0; ///< 0: by size
  command_line::Length min_size{0, false};
  std::optional<command_line::Length> tolerance;
  std::vector<std::string> outputs;
  std::string voronoi, histogram, report;
  bool split_crossings = false, quiet = false;
  weft::Mesh_options_2 options;
};

void read_sizes(const command_line::Arguments& arguments, Request& request)
{
  std::string sizes;
  bool has_general_size = false;
  for (const std::string& text : arguments.values("--size")) {
    const std::size_t colon = text.find(':');
    sizes += " " + text;
    if (colon == std::string::npos) {
      if (std::exchange(has_general_size, true)) throw Error("--size is given twice");
      request.size = command_line::Arguments::read_length("--size", text);
    } else {
      const int mark = command_line::Arguments::read_integer("--size", text.substr(0, colon));
      const auto size = command_line::Arguments::read_length("--size", text.substr(colon + 1));
      if (!request.size_of_mark.emplace(mark, size).second)
        throw Error("--size is given twice for the mark " + std::to_string(mark));
    }
  }
  request.lfs = arguments.positive("--lfs").value_or(0);
  request.min_size = arguments.length("--min-size").value_or(request.min_size);
  request.tolerance = arguments.length("--tolerance", true);
  if (!sizes.empty() && request.lfs > 0) throw Error("--size and --lfs exclude each other");
  if (request.min_size.value > 0 && request.lfs == 0) throw Error("--min-size goes with --lfs only");
  request.size_text = request.lfs > 0 ? "lfs " + arguments.value("--lfs")
                      : sizes.empty() ? std::string("size 5% of the diagonal, by default")
                                      : "size" + sizes;
}

void read_options(const command_line::Arguments& arguments, Request& request)
{
  auto& options = request.options;
  options.min_angle = arguments.positive("--min-angle").value_or(0);
  if (options.min_angle > 40) throw Error("--min-angle: more than 40 degrees can't be promised");
  options.time_limit = arguments.positive("--time-limit").value_or(std::numeric_limits<double>::infinity());
  options.seed = arguments.integer<unsigned>("--seed", 0, std::numeric_limits<unsigned>::max()).value_or(0);
  options.threads = arguments.integer<int>("--threads", 1, 1024).value_or(1);
  constexpr std::size_t most_vertices = 1000000000;
  options.max_vertices =
      arguments.integer<std::size_t>("--max-vertices", 1, most_vertices).value_or(options.max_vertices);
  options.check();
}

void read_filenames(const command_line::Arguments& arguments, Request& request)
{
  if (arguments.operands().empty()) throw Error("no input file; mesh_2 --help shows the usage");
  if (arguments.operands().size() > 1) throw Error("more than one input file: '" + arguments.operands()[1] + "'");
  request.input = arguments.operands().front();
  request.outputs = arguments.values("--output");
  for (const std::string& filename : request.outputs)
    if (!weft::IO::is_mesh_filename(filename))
      throw Error("--output: '" + filename + "' should end in .vtu, .mesh, .msh, .off or .svg");
  request.voronoi = arguments.filename("--voronoi", ".svg");
  request.histogram = arguments.filename("--histogram", ".svg");
  request.report = arguments.filename("--report", ".json");
}

Request read_request(const command_line::Arguments& arguments)
{
  Request request;
  read_filenames(arguments, request);
  read_sizes(arguments, request);
  read_options(arguments, request);
  request.split_crossings = arguments.has("--split-crossings");
  request.quiet = arguments.has("--quiet");
  return request;
}

// ---- Input

/// A domain that is ready to be meshed.
struct Domain
{
  Cdt cdt;
  Tags tags;
  std::vector<std::string> notes;
  double diagonal = 0;
};

/// Reads the input, fills the triangulation and marks the domain.
Domain read_domain(const Request& request)
{
  const Pslg pslg = weft::IO::read_pslg<K>(request.input);
  Domain domain;
  CGAL::Bbox_2 box;
  for (const K::Point_2& p : pslg.points) box += p.bbox();
  const double width = box.xmax() - box.xmin(), height = box.ymax() - box.ymin();
  domain.diagonal = std::hypot(width, height);
  try {
    weft::Pslg_options options;
    if (request.split_crossings) options.crossings = weft::Crossings::split;
    if (request.tolerance) options.tolerance = request.tolerance->in(domain.diagonal) / std::max(width, height);
    auto inserted = weft::insert_pslg(domain.cdt, pslg, options);
    domain.tags = std::move(inserted.tags);
    domain.notes = std::move(inserted.changes.notes);
    for (const std::string& warning : weft::mark_domain(domain.cdt, pslg).warnings) {
      command_line::complain("mesh_2", "warning: " + request.input + ": " + warning);
      domain.notes.push_back(warning);
    }
    return domain;
  } catch (const weft::Domain_error& error) {
    // Contacts between segments are the only fault that names two of them.
    const bool may_be_split = !request.split_crossings && error.elements().size() == 2;
    throw Error(request.input + ": " + error.what() + (may_be_split ? "; --split-crossings splits them" : ""));
  }
}

/// The graph as the triangulation has it: segments meet at their ends only, as the local feature size wants it.
Pslg graph_of(const Cdt& cdt)
{
  Pslg graph;
  std::map<K::Point_2, std::size_t> number;
  for (const auto vertex : cdt.finite_vertex_handles()) {
    number.emplace(vertex->point(), graph.points.size());
    graph.points.push_back(vertex->point());
  }
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    graph.segments.push_back({number.at(edge->first->vertex(Cdt::ccw(edge->second))->point()),
                              number.at(edge->first->vertex(Cdt::cw(edge->second))->point())});
  return graph;
}

// ---- Output

/// A polygon without repeated corners, as there are where vertices are cocircular.
std::vector<K::Point_2> without_repetitions(std::vector<K::Point_2> polygon)
{
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  return polygon;
}

void draw_voronoi(const std::string& filename, const Cdt& cdt, const std::string& title)
{
  const weft::Bounded_voronoi_diagram_2<Cdt> diagram(cdt);
  std::vector<std::vector<K::Point_2>> cells;
  std::vector<K::Point_2> sites;
  for (const auto& cell : diagram.cells()) {
    sites.push_back(cell.site->point());
    for (const auto& polygon : cell.polygons) cells.push_back(without_repetitions(polygon));
  }
  std::vector<std::array<K::Point_2, 2>> walls;
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge)
    if (edge->first->is_in_domain() || edge->first->neighbor(edge->second)->is_in_domain())
      walls.push_back(
          {edge->first->vertex(Cdt::ccw(edge->second))->point(), edge->first->vertex(Cdt::cw(edge->second))->point()});
  weft::IO::write_voronoi_svg(filename, cells, sites, walls, title);
}

/// Angles of the domain meshed by CGAL; none if that was interrupted or took longer than the time limit.
template <class Sizing>
weft::Angle_histogram reference_angles(const Request& request, Cdt input, const Sizing& sizing,
                                       std::size_t likely_vertices, command_line::Progress_bar& bar)
{
  const auto start = std::chrono::steady_clock::now();
  const bool done = refine_by_cgal(input, sizing, [&](std::size_t vertices) {
    bar.show(static_cast<double>(vertices) / static_cast<double>(likely_vertices),
             "CGAL's mesh for comparison, " + std::to_string(vertices) + " vertices");
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return !command_line::Interruption::wished() && elapsed.count() < request.options.time_limit;
  });
  const std::string name = "CGAL's Delaunay refinement";
  return done ? weft::measure_quality_2(input).histogram<weft::Angle_histogram>(name) : weft::Angle_histogram(name);
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
template <class Sizing>
Status mesh(const Request& request, Domain& domain, const Sizing& sizing, command_line::Output_files& files)
{
  Cdt& cdt = domain.cdt;
  const Tags& tags = domain.tags;
  const Cdt input = request.histogram.empty() ? Cdt() : cdt;
  Meshing_progress progress(!request.quiet, 0.5);
  weft::Mesh_options_2 options = request.options;
  options.visitor = std::ref(progress);
  weft::Mesh_report_2 report = weft::make_mesh_2(cdt, sizing, options);
  report.notes = domain.notes;
  std::string missing = what_is_missing(report, options.min_angle);
  progress.bar().clear();

  const weft::Quality_2 quality = weft::measure_quality_2(cdt);
  const std::string title = std::filesystem::path(request.input).filename().string() + ", " + request.size_text;
  for (const std::string& filename : request.outputs)
    files.add(filename, [&](const std::string& name) { weft::IO::write_mesh_2(name, cdt, tags); });
  if (!request.voronoi.empty())
    files.add(request.voronoi, [&](const std::string& name) { draw_voronoi(name, cdt, title); });
  if (!request.report.empty())
    files.add(request.report, [&](const std::string& name) {
      weft::IO::write_report_json(name, report, quality, weft::measure_sizing_2(cdt, sizing));
    });
  if (!request.histogram.empty()) {
    const auto angles = quality.histogram<weft::Angle_histogram>("weft");
    weft::Angle_histogram reference;
    if (missing.empty()) {
      reference = reference_angles(request, input, sizing, report.vertices * 3 / 2, progress.bar());
      if (reference.total() == 0) missing = "stopped early: the mesh is complete, the histogram lacks CGAL's";
    }
    files.add(request.histogram, [&](const std::string& name) {
      if (reference.total() > 0)
        weft::IO::write_angle_histogram_svg(name, angles, reference, "Angles: " + title);
      else
        weft::IO::write_angle_histogram_svg(name, angles, "Angles: " + title);
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
  command_line::Output_files files;
  Domain domain = read_domain(request);
  for (const std::string& filename : request.outputs) files.announce(filename);
  for (const std::string& filename : {request.voronoi, request.histogram, request.report})
    if (!filename.empty()) files.announce(filename);
  const command_line::Interruption interruption;
  const double size = request.size.in(domain.diagonal);
  const bool has_areas = std::any_of(domain.tags.regions.begin(), domain.tags.regions.end(),
                                     [](const auto& region) { return region.max_area > 0; });
  try {
    if (request.lfs > 0)
      return mesh(request, domain,
                  weft::Lfs_sizing_2<K>(graph_of(domain.cdt), request.lfs, request.min_size.in(domain.diagonal)), files);
    if (request.size_of_mark.empty() && !has_areas) return mesh(request, domain, weft::Uniform_sizing<>(size), files);
    std::map<int, double> size_of_mark;
    for (const auto& [mark, length] : request.size_of_mark) size_of_mark[mark] = length.in(domain.diagonal);
    return mesh(request, domain, weft::Region_sizing_2<Cdt>(domain.cdt, domain.tags, size, size_of_mark), files);
  } catch (const weft::Domain_error& error) {
    throw Error(request.input + ": " + error.what());
  }
}

} // namespace

int main(int argc, char** argv)
{
  return command_line::run_program(
      "mesh_2", known_options, help,
      [](const command_line::Arguments& arguments) { return run(read_request(arguments)); }, argc, argv);
}
