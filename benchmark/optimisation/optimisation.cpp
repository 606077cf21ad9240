// SPDX-License-Identifier: GPL-3.0-or-later
//
// What weft's optimisation in space reaches and what it costs, beside the thesis' figures (Tournois 2009, sec. 3.2.2,
// table 3.1, fig. 3.6) and CGAL's optimisers in the same run, one thread each. Prints Markdown.
//
//   optimisation [--quick] [--only NAME] [--tables LETTERS] [--farthest SECONDS] [--time-limit SECONDS]
//                [--json FILE] MODELS_DIR
//
// Tables: a whole runs, b smoothers, c a sweep, d directions of perturbation, e as far as perturbation goes; all unless
// said otherwise. --farthest: user time of a run as far as it goes, 60 unless given; 20 with --quick, which also
// leaves out all but three models of tables b to d. The time limit is that of one process, 900 unless given.

#include "../common/program.h"
#include "../common/table.h"
#include "optimisation_figures.h"
#include "optimisation_models.h"
#include "optimisation_run.h"

#include <weft/errors.h>

#include <CGAL/version.h>

#include <cstddef>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

struct Arguments
{
  bool quick = false;
  double farthest = 0; ///< seconds; 0: not said
  unsigned time_limit = 900;
  std::string only, tables = "abcde", json, folder;

  double seconds() const { return farthest > 0 ? farthest : quick ? 20 : 60; }
};

Arguments parse(Argument_reader reader)
{
  Arguments a;
  while (reader.next()) {
    if (reader.is("--quick"))
      a.quick = true;
    else if (reader.is("--only"))
      a.only = reader.value();
    else if (reader.is("--tables"))
      a.tables = reader.value();
    else if (reader.is("--farthest"))
      a.farthest = reader.positive();
    else if (reader.is("--time-limit"))
      a.time_limit = static_cast<unsigned>(reader.positive());
    else if (reader.is("--json"))
      a.json = reader.value();
    else
      a.folder = reader.operand();
  }
  if (a.folder.empty()) throw weft::Option_error("needs the folder of the models");
  return a;
}

std::string count(double n)
{
  return text(n, 0);
}

std::string angles(const Spatial_measures& m)
{
  return m.failed() ? m.failure : text(m.smallest_dihedral, 1) + "–" + text(m.largest_dihedral, 1);
}

std::string yes(bool b)
{
  return b ? "yes" : "**no**";
}

std::string percent(double share)
{
  return share < 0 ? "" : text(100 * share, 0);
}

// ---- a

void print_whole(const Whole_run& r)
{
  if (r.failed()) {
    std::cout << markdown_row({r.input, r.refined.failure, r.whole.failure, r.cgal_refined.failure}) << std::flush;
    return;
  }
  const double unit = r.bounds.approximation > 0 ? r.bounds.approximation : r.bounds.size;
  const bool far = !r.farthest.failed(), chain = !r.cgal_chain.failed();
  std::cout << markdown_row({r.input, count(r.cgal_refined.vertices), count(r.refined.vertices),
                             count(r.whole.vertices), text(r.whole.vertices / r.cgal_refined.vertices, 3),
                             angles(r.refined), angles(r.whole), angles(r.farthest), angles(r.cgal_chain),
                             text(r.refined.hausdorff / unit, 3), text(r.whole.hausdorff / r.refined.hausdorff, 3),
                             far ? text(r.farthest.hausdorff / r.refined.hausdorff, 3) : "",
                             chain ? text(r.cgal_chain.hausdorff / r.cgal_refined.hausdorff, 3) : "",
                             yes(r.whole.criteria_hold) + (far ? " / " + yes(r.farthest.criteria_hold) : ""),
                             yes(r.whole.checked) + (far ? " / " + yes(r.farthest.checked) : ""),
                             seconds_text(r.whole.seconds),
                             chain ? seconds_text(r.cgal_chain.seconds) : r.cgal_chain.failure,
                             chain ? text(r.whole.seconds / r.cgal_chain.seconds, 3) : ""})
            << std::flush;
}

std::vector<std::string> whole_head()
{
  return {"input",
          "vertices CGAL refined",
          "weft refined",
          "weft at the end",
          "against CGAL",
          "dihedral angles refined",
          "default",
          "farthest",
          "CGAL's chain",
          "H/ε refined",
          "H default / refined",
          "farthest / refined",
          "CGAL's chain / refined",
          "criteria hold",
          "checker",
          "user s default",
          "CGAL's chain",
          "ratio"};
}

// ---- b

std::vector<std::string> smoother_head()
{
  return {"input", "criteria", "refined", "NODT 20", "NODT 100", "ODT 20", "ODT 100", "Lloyd 20", "Lloyd 100"};
}

void print_smoothers(const Smoother_run& r)
{
  for (int free = 0; free < 2; ++free) {
    std::vector<std::string> cells{r.input, free ? "free" : "kept", count(r.nodt[free].before)};
    for (const Sweep_counts* m : {&r.nodt[free], &r.odt[free], &r.lloyd[free]}) {
      cells.push_back(m->failure[0] ? m->failure : count(m->after_20));
      cells.push_back(count(m->after_100));
    }
    std::cout << markdown_row(cells) << std::flush;
  }
}

// ---- c

std::vector<std::string> sweep_head()
{
  return {"input",
          "vertices",
          "sweep",
          "ms",
          "Delaunay ms",
          "ratio",
          "sizing %",
          "positions %",
          "moving %",
          "flips %",
          "anew %",
          "labels %",
          "in place",
          "stayed",
          "anew",
          "flips",
          "regions",
          "sorting before, ratio",
          "CGAL's ODT, ratio"};
}

void print_sweeps(const std::string& input, const Sweep_costs& r)
{
  if (r.failure[0]) {
    std::cout << markdown_row({input, r.failure}) << std::flush;
    return;
  }
  for (const Sweep_cost* m : {&r.first, &r.late})
    std::cout << markdown_row({input, count(r.vertices), m == &r.first ? "1st" : "31st to 35th",
                               text(1e3 * m->seconds, 1), text(1e3 * m->delaunay, 1), text(m->ratio(), 2),
                               percent(m->sizing), percent(m->positions), percent(m->moving), percent(m->flips),
                               percent(m->rebuilding), percent(m->labels), count(m->in_place), count(m->stayed),
                               count(m->rebuilt), count(m->flipped), count(m->regions),
                               m == &r.first ? text(r.ordering, 2) : "", m == &r.first ? text(r.cgal, 1) : ""})
              << std::flush;
}

// ---- d

std::vector<std::string> perturb_head()
{
  return {"input", "before",   "to",      "combined", "random",     "s combined", "s random", "random / combined",
          "±",     "by ∇R² %", "by ∇V %", "random %", "insertions", "removals"};
}

void print_perturbation(const Perturb_run& r)
{
  const Perturb_cost &c = r.combined, &o = r.random;
  if (c.failure[0] || o.failure[0]) {
    std::cout << markdown_row({r.input, c.failure, o.failure}) << std::flush;
    return;
  }
  const double moves = std::max(1., c.by_radius + c.by_volume + c.by_chance);
  std::cout << markdown_row({r.input, text(c.before, 1), text(r.target, 0), text(c.after, 1), text(o.after, 1),
                             seconds_text(c.seconds), seconds_text(o.seconds), text(r.ratio(), 2),
                             text(r.standard_error(), 2), percent(c.by_radius / moves), percent(c.by_volume / moves),
                             percent(c.by_chance / moves), count(c.insertions), count(c.removals)})
            << std::flush;
}

// ---- e

std::vector<std::string> best_head()
{
  return {"mesh",         "refined",       "combined",   "random",         "CGAL's exudation",
          "thesis: mesh", "thesis: input", "thesis: us", "thesis: random", "thesis: exudation"};
}

/// The rows of table 3.1 that a model stands beside.
std::vector<Best_row> best_rows(const Spatial_domain& domain, const Bounds& bounds, double seconds)
{
  const std::string& name = domain.input().name;
  const bool dinosaur = name == "dino";
  if (!dinosaur && name != "elephant") return {};
  std::vector<Best_row> rows{{name, "refined", 0.65, 25, 24.2, 1.68, {}},
                             {name, "refined, Lloyd", 0.24, 26.15, 23.5, 4.47, {}},
                             {name, "refined, ODT", 2.26, 28.55, 22, 4.55, {}}};
  if (!dinosaur) {
    rows = {{name, "refined", 0.16, 15.51, 15.64, 1.11, {}},
            {name, "refined, Lloyd", 0.11, 16.02, 15.63, 3.84, {}},
            {name, "refined, ODT", 0.84, 19.8, 18.85, 4.47, {}}};
  }
  const Preparation preparations[] = {Preparation::none, Preparation::lloyd, Preparation::odt};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].measured = best_angles(domain, bounds, preparations[i], seconds);
    const Best_angles& m = rows[i].measured;
    const std::string thesis = dinosaur ? "Dinosaur" : "Bimba";
    if (m.failure[0]) {
      std::cout << markdown_row({name + ", " + rows[i].preparation, m.failure}) << std::flush;
      continue;
    }
    std::cout << markdown_row({name + ", " + rows[i].preparation, text(m.before, 2), text(m.combined, 2),
                               text(m.random, 2), text(m.exuded, 2), thesis, text(rows[i].thesis_input, 2),
                               text(rows[i].thesis_combined, 2), text(rows[i].thesis_random, 2),
                               text(rows[i].thesis_exuded, 2)})
              << std::flush;
  }
  return rows;
}

// ---- JSON

std::string json(const Smoother_run& r)
{
  Json_object o;
  o.add("input", r.input).add("refined", r.nodt[1].before);
  const auto counts = [](const Sweep_counts(&m)[2]) {
    Json_object c; // without criteria, as in the thesis, and with
    c.add("free_20", m[1].after_20).add("free_100", m[1].after_100);
    return c.add("kept_20", m[0].after_20).add("kept_100", m[0].after_100).str();
  };
  return o.add_raw("nodt", counts(r.nodt)).add_raw("odt", counts(r.odt)).add_raw("lloyd", counts(r.lloyd)).str();
}

std::string json(const Bound_times& times)
{
  Json_object o;
  for (std::size_t i = 0; i < Bound_times::bounds.size(); ++i)
    if (times.seconds[i] >= 0) o.add(text(Bound_times::bounds[i], 0), times.seconds[i]);
  return o.str();
}

std::string json(const Best_row& r)
{
  const Best_angles& m = r.measured;
  Json_object o;
  o.add("input", r.input).add("preparation", r.preparation);
  if (m.failure[0]) return o.add("failed", m.failure).str();
  o.add("before", m.before).add("combined", m.combined).add("random", m.random).add("exuded", m.exuded);
  o.add("thesis_before", r.thesis_input).add("thesis_combined", r.thesis_combined);
  o.add("thesis_random", r.thesis_random).add("thesis_exuded", r.thesis_exuded);
  return o.add_raw("combined_seconds", json(m.combined_times)).add_raw("random_seconds", json(m.random_times)).str();
}

// ---- The whole

class Tables
{
public:
  explicit Tables(const Arguments& a) : a_(a)
  {
    for (const Model& model : optimisation_models()) {
      if (!a.only.empty() && a.only != model.name) continue;
      try {
        inputs_.push_back({model, read_model(a.folder, model)});
      } catch (const weft::Error& error) {
        std::cout << model.name << " is left out: " << error.what() << "\n\n";
      }
    }
  }

  void run()
  {
    std::cout << "# weft's optimisation in space, CGAL " << CGAL_VERSION_STR
              << "\n\nUser seconds. Default: without options, to 20°. Farthest: to 90°, ended after "
              << text(a_.seconds(), 0) << " user seconds. CGAL's chain: refinement, ODT, perturbation to 12°. H is the "
              << "two-sided Hausdorff distance, ε the bound of approximation, on the sphere the longest edge.\n";
    std::vector<Whole_run> whole;
    table('a', "Whole runs", whole_head(), true, [&](const Model& model, const Spatial_domain& domain) {
      whole.push_back(whole_run(domain, model.family, model.bounds(), a_.seconds()));
      print_whole(whole.back());
    });
    figures('a', whole_figures(whole));
    std::vector<Smoother_run> smoothers;
    table('b', "Cells below 10° after so many sweeps, before perturbation", smoother_head(), false,
          [&](const Model& model, const Spatial_domain& domain) {
            smoothers.push_back(smoother_run(domain, model.bounds()));
            smoothers_.push_back(json(smoothers.back()));
            print_smoothers(smoothers.back());
          });
    figures('b', smoother_figures(smoothers));
    std::vector<std::pair<std::string, Sweep_costs>> sweeps;
    table('c', "One NODT sweep against a Delaunay triangulation from scratch", sweep_head(), false,
          [&](const Model& model, const Spatial_domain& domain) {
            sweeps.emplace_back(model.name, sweep_costs(domain, model.bounds()));
            print_sweeps(model.name, sweeps.back().second);
          });
    figures('c', sweep_figures(sweeps));
    std::vector<Perturb_run> perturbed;
    table('d', "Combined perturbation against random alone", perturb_head(), false,
          [&](const Model& model, const Spatial_domain& domain) {
            for (const Perturb_run& run : perturb_runs(domain, model.bounds(), a_.seconds())) {
              perturbed.push_back(run);
              print_perturbation(run);
            }
          });
    figures('d', perturb_figures(perturbed));
    std::vector<Best_row> best;
    table('e', "As far as perturbation goes (table 3.1)", best_head(), true,
          [&](const Model& model, const Spatial_domain& domain) {
            for (const Best_row& row : best_rows(domain, model.bounds(), a_.seconds())) {
              best.push_back(row);
              best_.push_back(json(row));
            }
          });
    figures('e', best_figures(best));
    write_json();
  }

private:
  bool is_wanted(char letter) const { return a_.tables.find(letter) != std::string::npos; }

  /// Calls `row(model, domain)` for every input.
  template <class Row>
  void table(char letter, const std::string& title, const std::vector<std::string>& head, bool always_all,
             const Row& row) const
  {
    if (!is_wanted(letter)) return;
    std::cout << "\n## " << title << "\n\n" << markdown_head(head) << std::flush;
    for (const auto& [model, input] : inputs_)
      if (always_all || !a_.quick || model.is_quick) row(model, Spatial_domain(input, a_.time_limit));
  }

  void figures(char letter, const std::vector<Thesis_figure>& figures)
  {
    if (!is_wanted(letter)) return;
    std::cout << "\n" << markdown_head(Thesis_figure::head());
    for (const Thesis_figure& f : figures) {
      if (f.figure.values.empty()) continue;
      std::cout << markdown_row(f.cells());
      json_.push_back(f.figure.json());
    }
    std::cout << std::flush;
  }

  void write_json() const
  {
    if (a_.json.empty()) return;
    write_text(a_.json, Json_object()
                            .add("cgal_version", CGAL_VERSION_STR)
                            .add_raw("figures", json_array(json_))
                            .add_raw("smoothers", json_array(smoothers_))
                            .add_raw("best_angles", json_array(best_))
                            .str());
  }

  const Arguments& a_;
  std::vector<std::pair<Model, Spatial_input>> inputs_;
  std::vector<std::string> json_, smoothers_, best_;
};

} // namespace

int main(int argc, char** argv)
{
  return run_program("optimisation", [&] {
    const Arguments arguments = parse({argc, argv});
    Tables(arguments).run();
  });
}
