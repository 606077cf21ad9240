// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each deviation from Alg. 5 to 7 of Tournois 2009 buys: vertices, smallest dihedral angles before and after
// perturbation, elements that violate a criterion and user seconds of the printed way, with one part at a time switched
// to what weft does, and of `make_mesh_3()`.
//
//   as_published_3 [--size S] [--approximation A] [--angle DEGREES] [--way N]... [--time-limit T] FILE...
//
// Size and approximation in parts of the longest side, 0.1 and 0.003 unless given; edges of more than 60 degrees are
// sharp.

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "../spatial/spatial_inputs.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/optimise/perturb_as_published_3.h>
#include <weft/spatial/optimise/perturb_slivers_3.h>
#include <weft/spatial/refine/Vertex_set_3.h>
#include <weft/spatial/run/mesh_as_published_3.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace benchmark;

namespace {

using Options = weft::As_published_options_3;
using Way = std::pair<std::string, Options>;

template <class Change>
Way way(const char* name, const Change& change)
{
  Way result{name, {}};
  change(result.second);
  return result;
}

/// The printed way first.
std::vector<Way> ways()
{
  return {
      way("as printed", [](Options&) {}),
      way("refine to the end, then smooth", [](Options& o) { o.interleave = false; }),
      way("refine alone", [](Options& o) { o.interleave = false, o.final_sweeps = 0; }),
      way("target falls in 4 steps", [](Options& o) { o.target_steps = 4; }),
      way("Steiner points chosen", [](Options& o) { o.plain_points = false; }),
      way("cells after facets", [](Options& o) { o.mixed_batches = false; }),
      way("creases in equal parts", [](Options& o) { o.plain_creases = false; }),
      way("folds attract", [](Options& o) { o.follow_folds = true; }),
      way("ridges seen", [](Options& o) { o.see_ridges = true; }),
      way("mirrored vertices", [](Options& o) { o.mirror = true; }),
      way("lattice", [](Options& o) { o.lattice = true; }),
      way("not graded", [](Options& o) { o.grade = false; }),
      way("5 sweeps a batch", [](Options& o) { o.sweeps = 5; }),
      way("without locking", [](Options& o) { o.lock = false; }),
      way("smoothing keeps criteria", [](Options& o) { o.keep_criteria = true; }),
      way("surface smoothed by itself", [](Options& o) { o.smooth_surface = true; }),
      way("coarsened", [](Options& o) { o.coarsen = true; }),
      way("refine, smooth, coarsen", [](Options& o) { o.interleave = false, o.coarsen = true; }),
  };
}

using Perturb_options = weft::Published_perturb_options_3;

/// Ways to perturb what the printed way refines and optimises; the last one is weft's.
std::vector<std::pair<std::string, Perturb_options>> perturbations()
{
  std::vector<std::pair<std::string, Perturb_options>> all(8);
  all[0].first = "gradients summed as they are";
  all[0].second.averages = false;
  all[1].first = "compatible or not";
  all[1].second.only_compatible = false;
  all[2].first = "single steps";
  all[2].second.repeats_steps = false;
  all[3].first = "the elder vertex first";
  all[3].second.in_order = false;
  all[4].first = "rising bounds";
  all[4].second.rising_bounds = true;
  all[5].first = "large angles, too";
  all[5].second.large_angles = true;
  all[6].first = "criteria kept";
  all[6].second.keep_criteria = true;
  all[7].first = "weft's";
  for (auto& one : all) one.first = "perturbation: " + one.first;
  return all;
}

template <class Restricted, class Criteria>
weft::Perturb_report_3 perturb(Restricted& mesh, const Criteria& criteria, Perturb_options options, double angle)
{
  options.target = angle;
  return weft::perturb_as_published_3(mesh, criteria, options);
}

/// What is summed up over all inputs.
struct Outcome
{
  std::string input, way;
  std::size_t vertices;
  double before, after, seconds;
};

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n == 0 ? 0 : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// A row for each way: vertices against the printed way input by input, angles, total time.
void print_summary(const std::vector<Outcome>& outcomes)
{
  std::cout << "\n"
            << markdown_head({"way", "inputs", "vertices, mean", "least, most", "angle before, median",
                              "angle after, median", "least", "user s, sum"});
  std::vector<std::string> done;
  for (const Outcome& first : outcomes) {
    if (std::find(done.begin(), done.end(), first.way) != done.end()) continue;
    done.push_back(first.way);
    std::vector<double> ratios, before, after;
    double seconds = 0;
    for (const Outcome& o : outcomes) {
      if (o.way != first.way) continue;
      for (const Outcome& printed : outcomes)
        if (printed.input == o.input && printed.way == outcomes.front().way)
          ratios.push_back(static_cast<double>(o.vertices) / static_cast<double>(printed.vertices));
      before.push_back(o.before);
      after.push_back(o.after);
      seconds += o.seconds;
    }
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    const double sum = std::accumulate(ratios.begin(), ratios.end(), 0.);
    std::cout << markdown_row({first.way, std::to_string(ratios.size()),
                               text(sum / static_cast<double>(ratios.size()), 2),
                               text(*least, 2) + ", " + text(*most, 2), text(median(before), 1), text(median(after), 1),
                               text(*std::min_element(after.begin(), after.end()), 1), seconds_text(seconds)});
  }
}

std::string moves(const weft::Perturb_report_3& report)
{
  return std::to_string(report.by_radius) + ", " + std::to_string(report.by_volume) + ", " +
         std::to_string(report.by_chance);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("as_published_3", [&] {
    using K = Spatial_kernel;
    double size = 0.1, approximation = 0.003, angle = 20, time_limit = 0;
    std::vector<std::size_t> chosen;
    std::vector<std::string> files;
    for (Argument_reader a(argc, argv); a.next();) {
      if (a.is("--size"))
        size = a.positive();
      else if (a.is("--approximation"))
        approximation = a.positive();
      else if (a.is("--angle"))
        angle = a.number();
      else if (a.is("--time-limit"))
        time_limit = a.positive();
      else if (a.is("--way"))
        chosen.push_back(static_cast<std::size_t>(a.number()));
      else
        files.push_back(a.operand());
    }
    const std::vector<Way> all = ways();
    const auto of_perturbation = perturbations();
    const std::size_t weft_way = all.size() + of_perturbation.size();
    if (chosen.empty())
      for (std::size_t k = 0; k <= weft_way; ++k) chosen.push_back(k);
    std::cout << markdown_head({"input", "way", "vertices", "angle before", "angle after", "bad as refined", "bad",
                                "batches", "by radius, volume, chance", "user s", "of them perturbing", "ended"});
    std::vector<Outcome> outcomes;
    for (const std::string& file : files) {
      const Spatial_input input = read_input(file, 60);
      const weft::Polyhedral_oracle_3<K> oracle(input.complex);
      weft::Criteria_3<K> criteria;
      criteria.size = size;
      criteria.approximation = approximation;
      std::optional<weft::internal::Vertex_set_3<K>> optimised; // as printed, before perturbation
      const auto print = [&](const std::string& name, const std::vector<std::string>& cells) {
        std::vector<std::string> row{input.name, name};
        row.insert(row.end(), cells.begin(), cells.end());
        std::cout << markdown_row(row) << std::flush;
      };
      for (const std::size_t k : chosen) {
        const Stopwatch watch;
        if (k < all.size()) {
          Options options = all[k].second;
          options.min_dihedral_angle = 0;
          if (time_limit > 0) options.time_limit = time_limit;
          auto result = weft::mesh_as_published_3(oracle, criteria, options);
          const weft::Mesh_report_3& report = result.report;
          if (k == 0) optimised = weft::internal::vertices_of(result.restricted);
          const Stopwatch perturbing;
          const auto perturbed = perturb(result.restricted, criteria, Perturb_options(), angle);
          outcomes.push_back(
              {input.name, all[k].first, report.vertices, perturbed.before, perturbed.after, watch.seconds()});
          print(all[k].first, {std::to_string(report.vertices), text(perturbed.before, 2), text(perturbed.after, 2),
                               std::to_string(result.bad_as_refined), std::to_string(report.bad()),
                               std::to_string(report.batches), moves(perturbed), seconds_text(watch.seconds()),
                               seconds_text(perturbing.seconds()), weft::name(report.stop_reason)});
        } else if (k < weft_way && optimised) {
          weft::Restricted_delaunay_3<weft::Polyhedral_oracle_3<K>> mesh(oracle);
          mesh.insert(optimised->points, optimised->locations);
          const auto& [name, options] = of_perturbation[k - all.size()];
          const Stopwatch perturbing;
          weft::Perturb_report_3 perturbed;
          if (k + 1 < weft_way) {
            perturbed = perturb(mesh, criteria, options, angle);
          } else {
            weft::Perturb_options_3 of_weft;
            of_weft.target = angle;
            perturbed = weft::perturb_slivers_3(mesh, criteria, of_weft);
          }
          const std::size_t vertices = weft::tetrahedral_mesh(mesh).points.size();
          outcomes.push_back({input.name, name, vertices, perturbed.before, perturbed.after, perturbing.seconds()});
          print(name, {std::to_string(vertices), text(perturbed.before, 2), text(perturbed.after, 2), "", "", "",
                       moves(perturbed), "", seconds_text(perturbing.seconds()), ""});
        } else if (k == weft_way) {
          weft::Mesh_options_3 options;
          options.min_dihedral_angle = angle;
          if (time_limit > 0) options.time_limit = time_limit;
          const auto report = weft::make_mesh_3(oracle, criteria, options).report;
          outcomes.push_back({input.name, "make_mesh_3()", report.vertices, report.smoothed_smallest_dihedral,
                              report.smallest_dihedral, watch.seconds()});
          print("make_mesh_3()",
                {std::to_string(report.vertices), text(report.smoothed_smallest_dihedral, 2),
                 text(report.smallest_dihedral, 2), "", std::to_string(report.bad()), std::to_string(report.batches),
                 "", seconds_text(watch.seconds()), "", weft::name(report.stop_reason)});
        }
      }
    }
    if (!outcomes.empty()) print_summary(outcomes);
  });
}
