// SPDX-License-Identifier: GPL-3.0-or-later
//
// weft against CGAL's refine_Delaunay_mesh_2 (angle bound 0.125, the same sizes): points, shapes, sizes and time, on
// each input at several sizes, uniform and graded, in one run. The two take turns, so that a busy machine slows both.
// Prints Markdown: a row per input and size, and a table of what is asked of weft beside what was measured.
//
//   planar [--triangles N,N,...] [--large] [--only NAME] [--no-graded] [--no-sweep] [--time-limit SECONDS]
//          [--gmsh PROGRAM --folder DIR] [--json FILE] [FILE.poly ...]
//
// Sizes are given by the number of triangles that a good mesh has: N / 1.5 equilateral triangles of the size's side
// would fill the domain. --large adds a million on the square. The time limit is that of one mesh of weft's, 120 unless
// given, so that a table is printed whatever happens. --gmsh adds Gmsh, whose files go to the folder.

#include "../common/program.h"
#include "../common/table.h"
#include "planar_figures.h"
#include "planar_gmsh.h"
#include "planar_inputs.h"
#include "planar_measure.h"
#include "planar_peers.h"
#include "planar_run.h"
#include "planar_sweep.h"

#include <weft/errors.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/version.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

struct Arguments
{
  std::vector<double> triangles{1000, 10000, 100000};
  bool large = false, graded = true, sweep = true;
  double time_limit = 120;
  std::string only, json, gmsh, folder = ".";
  std::vector<std::string> files;
};

std::vector<double> positive_numbers(const std::string& list)
{
  std::vector<double> numbers;
  std::stringstream in(list);
  for (std::string n; std::getline(in, n, ',');) numbers.push_back(Argument_reader::checked("--triangles", n, true));
  return numbers;
}

Arguments parse(Argument_reader reader)
{
  Arguments a;
  while (reader.next()) {
    if (reader.is("--large"))
      a.large = true;
    else if (reader.is("--no-graded"))
      a.graded = false;
    else if (reader.is("--no-sweep"))
      a.sweep = false;
    else if (reader.is("--only"))
      a.only = reader.value();
    else if (reader.is("--time-limit"))
      a.time_limit = reader.positive();
    else if (reader.is("--json"))
      a.json = reader.value();
    else if (reader.is("--gmsh"))
      a.gmsh = reader.value();
    else if (reader.is("--folder"))
      a.folder = reader.value();
    else if (reader.is("--triangles"))
      a.triangles = positive_numbers(reader.value());
    else
      a.files.push_back(reader.operand());
  }
  return a;
}

// ---- Gmsh

std::string gmsh_table(const std::vector<Domain>& domains, const std::vector<Run>& runs, const Arguments& a,
                       std::vector<std::string>& json_rows)
{
  std::string table = "\n## Against Gmsh\n\nFrontal Delaunay, its size lowered until no edge is longer than asked (at "
                      "most six runs; the time is that of the last, as Gmsh reports it).\n\n" +
                      markdown_head({"input", "triangles asked", "Steiner Gmsh", "weft", "change", "T/m_Δ Gmsh", "weft",
                                     "angles Gmsh", "weft", "longest/size Gmsh", "seconds Gmsh", "weft", "note"});
  for (const Run& r : runs) {
    if (!r.field.empty() || r.triangles != 10000 || r.weft.triangles == 0) continue;
    for (const Domain& d : domains) {
      if (d.name != r.input) continue;
      const auto g = run_gmsh(a.gmsh, d.pslg, r.size, a.folder);
      if (!g) {
        table += markdown_row({r.input, Run::size_label(r.triangles), "not run: Gmsh failed, or segments branch"});
        continue;
      }
      const Measures& m = g->measures;
      const double steiner = static_cast<double>(m.vertices) - static_cast<double>(r.input_vertices);
      const bool same_domain = std::abs(m.area - d.given.area) < 1e-6 * d.given.area;
      table += markdown_row({r.input, Run::size_label(r.triangles), text(steiner, 0), std::to_string(r.weft_steiner()),
                             text(100 * (static_cast<double>(r.weft_steiner()) / steiner - 1), 1) + " %",
                             text(m.relative_count(), 3), text(r.weft.relative_count(), 3), angles(m), angles(r.weft),
                             text(m.largest_ratio, 3), seconds_text(g->seconds), seconds_text(r.weft_seconds),
                             same_domain ? "" : "Gmsh meshed another domain"});
      json_rows.push_back(Json_object()
                              .add("input", r.input)
                              .add("triangles_asked", r.triangles)
                              .add_raw("gmsh", json(m, static_cast<std::size_t>(steiner), g->seconds))
                              .str());
    }
  }
  return table;
}

// ---- The whole

std::vector<Domain> load(const Arguments& a)
{
  std::vector<Planar_input> inputs = planar_inputs();
  for (const std::string& file : a.files) inputs.push_back(read_planar_input(file));
  std::vector<Domain> domains;
  for (const Planar_input& input : inputs)
    if (a.only.empty() || input.name == a.only) domains.emplace_back(input);
  if (domains.empty()) throw weft::Option_error("no input is called " + a.only);
  return domains;
}

void report(const Run& run, std::vector<Run>& runs)
{
  std::cout << markdown_row(cells(run)) << std::flush;
  runs.push_back(run);
}

void run_uniform(const std::vector<Domain>& domains, const Arguments& a, std::vector<Run>& runs)
{
  std::cout << "## Uniform sizes\n\n" << markdown_head(run_head());
  const auto run = [&](const Domain& domain, double n) {
    report(run_on(domain, "", n, weft::Uniform_sizing<>(domain.size_for(n / ideal_share)), a.time_limit), runs);
  };
  for (const Domain& domain : domains)
    for (const double n : a.triangles) run(domain, n);
  if (a.large) run(Domain({"square", square()}), 1e6);
}

void run_graded(const std::vector<Domain>& domains, const Arguments& a, std::vector<Run>& runs)
{
  std::cout << "\n## Graded sizes\n\nLinear: h + g |x − c|; lfs: the local feature size times a factor. g is what the "
               "size grows by per unit of distance.\n\n"
            << markdown_head(run_head());
  for (const Domain& domain : domains) {
    if (domain.name != "square" && domain.name != "smooth curve" && domain.name != "coastline") continue;
    for (const double n : a.triangles) {
      for (const double growth : {0.1, 0.3}) {
        const Graded_size size = linear_size(domain, growth, n / ideal_share);
        report(
            run_on(domain, "linear " + text(growth, 1) + " (g " + text(size.growth(), 3) + ")", n, size, a.time_limit),
            runs);
      }
      const Graded_size size = lfs_size(domain, n / ideal_share);
      report(run_on(domain, "lfs (g " + text(size.growth(), 3) + ")", n, size, a.time_limit), runs);
    }
  }
}

void print(const Sweep& s)
{
  std::cout << "\n## One relaxation sweep\n\nOver all " << s.vertices
            << " vertices of a mesh that CGAL refined, and again when 39 sweeps have gone before; the Delaunay "
               "triangulation is CGAL's, of the same points in random order.\n\n"
            << markdown_head({"", "seconds", "of it new positions", "against Delaunay"})
            << markdown_row({"Delaunay from scratch", seconds_text(s.delaunay), "", "1"})
            << markdown_row({"first sweep", seconds_text(s.first), seconds_text(s.first_positions),
                             text(s.first / s.delaunay, 2)})
            << markdown_row(
                   {"40th sweep", seconds_text(s.late), seconds_text(s.late_positions), text(s.late / s.delaunay, 2)})
            << std::flush;
}

void run(const Arguments& a)
{
  const std::vector<Domain> domains = load(a);
  std::vector<Run> runs;
  std::cout
      << "# weft against CGAL " << CGAL_VERSION_STR
      << "\n\nTimes are user CPU seconds, medians where runs are short; `triangles asked` is what a mesh of 1.5 "
         "m_Δ has, m_Δ being the number of equilateral triangles of the asked size that would fill the domain.\n\n";
  run_uniform(domains, a, runs);
  if (a.graded) run_graded(domains, a, runs);
  Sweep sweep;
  if (a.sweep) {
    sweep = measure_sweep(100000);
    print(sweep);
  }
  std::vector<std::string> gmsh_rows;
  if (!a.gmsh.empty()) std::cout << gmsh_table(domains, runs, a, gmsh_rows);

  const std::vector<Figure> all = figures(runs, sweep);
  std::cout << "\n## Asked and measured\n\n" << markdown_head(Figure::head());
  std::vector<std::string> run_rows, figure_rows;
  for (const Figure& f : all) {
    std::cout << markdown_row(f.cells());
    figure_rows.push_back(f.json());
  }
  bool failed = false;
  for (const Run& r : runs) {
    run_rows.push_back(json(r));
    if (r.stop.empty()) continue;
    std::cout << (failed ? "" : "\nRuns that stopped early count in the rows on sizes and times only:\n\n") << "- "
              << r.label() << ": " << r.stop << "\n";
    failed = true;
  }
  if (a.json.empty()) return;
  Json_object document;
  document.add("cgal_version", CGAL_VERSION_STR).add_raw("runs", json_array(run_rows));
  if (sweep.vertices > 0)
    document.add_raw("sweep", Json_object()
                                  .add("vertices", static_cast<double>(sweep.vertices))
                                  .add("delaunay_seconds", sweep.delaunay)
                                  .add("first_sweep_seconds", sweep.first)
                                  .add("first_sweep_position_seconds", sweep.first_positions)
                                  .add("late_sweep_seconds", sweep.late)
                                  .add("late_sweep_position_seconds", sweep.late_positions)
                                  .str());
  write_text(a.json, document.add_raw("gmsh", json_array(gmsh_rows)).add_raw("figures", json_array(figure_rows)).str());
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("planar", [&] { run(parse({argc, argv})); });
}
