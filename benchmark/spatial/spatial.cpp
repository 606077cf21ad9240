// SPDX-License-Identifier: GPL-3.0-or-later
//
// weft's make_mesh_3 against CGAL's (without its optimisers, the same bounds): vertices, distance to the surface,
// validity, time, memory and questions to the oracle, in one run, one thread each. Prints Markdown.
//
//   spatial [--quick] [--circumradii] [--only NAME] [--no-own] [--no-growth] [--most-vertices N] [--time-limit SECONDS]
//           [--json FILE] [--sharp-angle DEG] [FILE ...]
//
// Surfaces are scaled to a longest side of 1 and meshed with edges up to 0.1, approximation 0.001 and 0.0005, shapes 2.
// Edges of the files after a --sharp-angle are creases from that angle on; 60 unless given, 0 for no creases. Own
// inputs, left out by --no-own: a cylinder like that, a sphere and nested spheres with edges up to 0.05 and 0.03 and no
// approximation. --quick leaves out 0.0005 and 0.03. --circumradii: weft, too, is given CGAL's bounds of circumradii
// instead of edges. Growth: a sphere of 10,000 vertices up to --most-vertices, 500,000 unless given. The time limit is
// that of one mesh, 600 unless given.

#include "../common/program.h"
#include "../common/table.h"
#include "spatial_figures.h"
#include "spatial_inputs.h"
#include "spatial_run.h"

#include <weft/errors.h>

#include <CGAL/version.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

struct Arguments
{
  bool quick = false, own = true, growth = true, circumradii = false;
  double most_vertices = 500000;
  unsigned time_limit = 600;
  std::string only, json;
  std::vector<std::pair<std::string, double>> files; ///< with their sharp angles
};

Arguments parse(Argument_reader reader)
{
  Arguments a;
  double sharp_angle = 60;
  while (reader.next()) {
    if (reader.is("--quick"))
      a.quick = true;
    else if (reader.is("--circumradii"))
      a.circumradii = true;
    else if (reader.is("--no-own"))
      a.own = false;
    else if (reader.is("--no-growth"))
      a.growth = false;
    else if (reader.is("--only"))
      a.only = reader.value();
    else if (reader.is("--most-vertices"))
      a.most_vertices = reader.positive();
    else if (reader.is("--time-limit"))
      a.time_limit = static_cast<unsigned>(reader.positive());
    else if (reader.is("--json"))
      a.json = reader.value();
    else if (reader.is("--sharp-angle"))
      sharp_angle = reader.number();
    else
      a.files.emplace_back(reader.operand(), sharp_angle);
  }
  return a;
}

// ---- Tables

std::string count(double n)
{
  return text(n, 0);
}

std::string hausdorff(const Spatial_run& r, const Spatial_measures& m)
{
  return r.bounds.approximation > 0 ? text(m.hausdorff / r.bounds.approximation, 2)
                                    : text(m.hausdorff / r.bounds.size, 3) + " l";
}

std::vector<std::string> main_head()
{
  return {"input",         "l",    "ε",     "vertices CGAL", "weft", "ratio",         "cells CGAL", "weft",
          "user s CGAL",   "weft", "ratio", "H/ε CGAL",      "weft", "criteria hold", "checker",    "manifold CGAL",
          "manifold weft", "note"};
}

std::vector<std::string> lowered_row(const Spatial_run& r)
{
  const Spatial_measures& c = r.lowered;
  return {"〃 CGAL with edge size " + text(r.lowered_edge_size, 4),
          text(r.bounds.size, 2),
          text(r.bounds.approximation, 4),
          count(c.vertices),
          count(r.weft.vertices),
          text(r.weft.vertices / c.vertices, 3),
          count(c.cells),
          count(r.weft.cells),
          seconds_text(c.seconds),
          seconds_text(r.weft.seconds),
          text(r.weft.seconds / c.seconds, 2),
          hausdorff(r, c),
          hausdorff(r, r.weft),
          "",
          "",
          c.manifold ? "yes" : "**no**",
          "",
          c.hausdorff <= 3 * r.bounds.approximation ? "" : "CGAL doesn't get within 3 ε"};
}

std::vector<std::string> main_row(const Spatial_run& r)
{
  const auto yes = [](bool b) { return std::string(b ? "yes" : "**no**"); };
  const std::string l = text(r.bounds.size, 2), e = r.bounds.approximation > 0 ? text(r.bounds.approximation, 4) : "–";
  if (r.failed()) return {r.input, l, e, std::string("weft: ") + r.weft.failure + "; CGAL: " + r.cgal.failure};
  return {r.input,
          l,
          e,
          count(r.cgal.vertices),
          count(r.weft.vertices),
          text(r.weft.vertices / r.cgal.vertices, 3),
          count(r.cgal.cells),
          count(r.weft.cells),
          seconds_text(r.cgal.seconds),
          seconds_text(r.weft.seconds),
          text(r.weft.seconds / r.cgal.seconds, 2),
          hausdorff(r, r.cgal),
          hausdorff(r, r.weft),
          yes(r.weft.criteria_hold),
          yes(r.weft.checked),
          yes(r.cgal.manifold),
          yes(r.weft.manifold),
          ""};
}

void print_violations(const std::vector<Spatial_run>& runs)
{
  std::cout << "\n## What CGAL's and weft's meshes keep of the bounds\n\nAll bounds are 1 in these units, 2 for the "
               "shapes. H is taken over all points of both surfaces; the criterion of either mesher looks at one point "
               "a facet, so that H/ε may exceed 1. Facets off the boundary: listed in CGAL's complex, but with the "
               "domain on both sides or on none.\n\n"
            << markdown_head({"input", "ε", "longest edge / l CGAL", "weft", "circumradius / shortest edge, cells CGAL",
                              "weft", "facets CGAL", "weft", "H/ε CGAL", "weft", "dihedral angles CGAL", "weft",
                              "facets off the boundary CGAL"});
  const auto angles = [](const Spatial_measures& m) {
    return text(m.smallest_dihedral, 1) + "–" + text(m.largest_dihedral, 1);
  };
  for (const Spatial_run& r : runs)
    if (!r.failed())
      std::cout << markdown_row({r.input + (r.bounds.approximation > 0 ? "" : ", l " + text(r.bounds.size, 2)),
                                 r.bounds.approximation > 0 ? text(r.bounds.approximation, 4) : "–",
                                 text(r.cgal.longest_edge / r.bounds.size, 3),
                                 text(r.weft.longest_edge / r.bounds.size, 3), text(r.cgal.cell_shape, 2),
                                 text(r.weft.cell_shape, 2), text(r.cgal.facet_shape, 2), text(r.weft.facet_shape, 2),
                                 hausdorff(r, r.cgal), hausdorff(r, r.weft), angles(r.cgal), angles(r.weft),
                                 count(r.cgal.dangling)});
}

void print_costs(const std::vector<Spatial_run>& runs)
{
  std::cout << "\n## Questions to the oracle and memory\n\nPer vertex of weft's mesh; asked: Voronoi edges against the "
               "surface and points located; skipped: Voronoi edges that needn't be asked about; candidates: Steiner "
               "points whose conflict zone was looked for. Bytes: peak memory beyond that before, per vertex.\n\n"
            << markdown_head({"input", "ε or l", "edges asked", "skipped", "asked of all", "points located",
                              "candidates", "bytes CGAL", "weft"});
  for (const Spatial_run& r : runs) {
    if (r.failed()) continue;
    const Spatial_measures& w = r.weft;
    std::cout << markdown_row(
        {r.input, r.bounds.approximation > 0 ? text(r.bounds.approximation, 4) : text(r.bounds.size, 2),
         text(w.segments / w.vertices, 1), text(w.skipped / w.vertices, 1),
         text(w.segments / (w.segments + w.skipped), 3), text(w.locations / w.vertices, 1),
         text(w.candidates / w.vertices, 2), count(r.cgal.bytes_per_vertex()), count(w.bytes_per_vertex())});
  }
}

Growth run_growth(const Arguments& a)
{
  Growth growth;
  std::cout << "\n## Growth on the sphere\n\n"
            << markdown_head({"l", "vertices CGAL", "weft", "user s CGAL", "weft", "µs a vertex CGAL", "weft",
                              "bytes a vertex CGAL", "weft"});
  const Spatial_input input = make_input("sphere", unit_sphere(5), 0);
  const Spatial_domain domain(input, a.time_limit);
  const int steps = 5;
  for (int i = 0; i < steps; ++i) {
    const double n = 10000 * std::pow(a.most_vertices / 10000, i / (steps - 1.));
    Bounds bounds;
    bounds.size = 0.05 * std::cbrt(14500 / n); // 14500 vertices at 0.05
    const Spatial_run r = domain.compare(bounds, false);
    growth.push_back(r);
    if (r.failed()) {
      std::cout << markdown_row({text(bounds.size, 4), r.cgal.failure, r.weft.failure});
      continue;
    }
    std::cout << markdown_row({text(bounds.size, 4), count(r.cgal.vertices), count(r.weft.vertices),
                               seconds_text(r.cgal.seconds), seconds_text(r.weft.seconds),
                               text(1e6 * r.cgal.seconds / r.cgal.vertices, 1),
                               text(1e6 * r.weft.seconds / r.weft.vertices, 1), count(r.cgal.bytes_per_vertex()),
                               count(r.weft.bytes_per_vertex())})
              << std::flush;
  }
  std::cout << "\nTime grows as vertices to the power " << text(exponent(growth, &Spatial_run::weft), 3) << " (CGAL "
            << text(exponent(growth, &Spatial_run::cgal), 3) << ").\n";
  return growth;
}

// ---- JSON

std::string json(const Spatial_measures& m)
{
  Json_object o;
  if (m.failed()) return o.add("failed", m.failure).str();
  o.add("vertices", m.vertices).add("cells", m.cells).add("user_seconds", m.seconds);
  o.add("bytes_per_vertex", m.bytes_per_vertex());
  if (m.hausdorff >= 0) {
    o.add("hausdorff", m.hausdorff).add("longest_edge", m.longest_edge);
    o.add("cell_shape", m.cell_shape).add("facet_shape", m.facet_shape);
    o.add("smallest_dihedral", m.smallest_dihedral).add("largest_dihedral", m.largest_dihedral);
    o.add_raw("manifold", m.manifold ? "true" : "false").add("facets_off_the_boundary", m.dangling);
  }
  if (m.segments < 0) return o.str();
  o.add_raw("criteria_hold", m.criteria_hold ? "true" : "false");
  if (m.hausdorff >= 0) o.add_raw("checked", m.checked ? "true" : "false");
  o.add("segment_queries", m.segments).add("skipped_queries", m.skipped);
  return o.add("location_queries", m.locations).add("candidates", m.candidates).str();
}

std::string json(const Spatial_run& r)
{
  Json_object o;
  o.add("input", r.input).add_raw("creased", r.creased ? "true" : "false");
  o.add("size", r.bounds.size).add("approximation", r.bounds.approximation);
  o.add_raw("cgal", json(r.cgal)).add_raw("weft", json(r.weft));
  if (r.lowered_edge_size > 0) o.add("lowered_edge_size", r.lowered_edge_size).add_raw("cgal_lowered", json(r.lowered));
  return o.str();
}

std::vector<std::string> json_rows(const std::vector<Spatial_run>& runs)
{
  std::vector<std::string> rows;
  for (const Spatial_run& r : runs) rows.push_back(json(r));
  return rows;
}

// ---- The whole

void run_input(const Spatial_input& input, bool uniform, const Arguments& a, std::vector<Spatial_run>& runs)
{
  if (!a.only.empty() && a.only != input.name) return;
  std::vector<Bounds> all = uniform ? std::vector<Bounds>{{0.05, 0, 2}, {0.03, 0, 2}}
                                    : std::vector<Bounds>{{0.1, 0.001, 2}, {0.1, 0.0005, 2}};
  if (a.quick) all.resize(1);
  const Spatial_domain domain(input, a.time_limit);
  for (Bounds bounds : all) {
    bounds.circumradii = a.circumradii;
    const Spatial_run r = domain.compare(bounds, true);
    std::cout << markdown_row(main_row(r)) << std::flush;
    if (r.lowered_edge_size > 0) std::cout << markdown_row(lowered_row(r)) << std::flush;
    runs.push_back(r);
  }
}

std::vector<Spatial_run> run_all(const Arguments& a)
{
  std::vector<Spatial_run> runs;
  for (const auto& [file, angle] : a.files) {
    try {
      run_input(read_input(file, angle), false, a, runs);
    } catch (const weft::Error& error) {
      std::cout << markdown_row({file.substr(file.find_last_of('/') + 1), "", "", error.what()});
    }
  }
  if (!a.own) return runs;
  run_input(make_input("cylinder", cylinder(96), 60), false, a, runs);
  run_input(make_input("sphere", unit_sphere(5), 0), true, a, runs);
  run_input(make_input("nested spheres", nested_spheres(5), 0), true, a, runs);
  return runs;
}

void run(const Arguments& a)
{
  std::cout << "# weft against CGAL " << CGAL_VERSION_STR
            << " in space\n\nl bounds edges, ε the distance to the surface, in parts of the longest side; H is the "
               "two-sided Hausdorff distance. User seconds, medians where runs are short.\n\n"
            << markdown_head(main_head());
  const std::vector<Spatial_run> runs = run_all(a);
  print_violations(runs);
  print_costs(runs);
  const Growth growth = a.growth ? run_growth(a) : Growth();

  std::cout << "\n## Asked and measured\n\n" << markdown_head(Figure::head());
  std::vector<std::string> figure_rows;
  for (const Figure& f : spatial_figures(runs, growth)) {
    std::cout << markdown_row(f.cells());
    figure_rows.push_back(f.json());
  }
  if (a.json.empty()) return;
  write_text(a.json, Json_object()
                         .add("cgal_version", CGAL_VERSION_STR)
                         .add_raw("runs", json_array(json_rows(runs)))
                         .add_raw("growth", json_array(json_rows(growth)))
                         .add_raw("figures", json_array(figure_rows))
                         .str());
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("spatial", [&] { run(parse({argc, argv})); });
}
