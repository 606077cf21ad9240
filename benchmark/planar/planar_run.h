// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes one domain by weft and by CGAL and measures both. The two take turns, so that a busy machine slows both.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_RUN_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_RUN_H

#include "../common/table.h"
#include "planar_measure.h"
#include "planar_peers.h"

#include <weft/make_mesh_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

constexpr double ideal_share = 1.5; // triangles of a good mesh over ideal triangles

struct Run
{
  std::string input, field; // field is empty when uniform
  double triangles, size;   // size: of a uniform field
  double input_angle;
  bool finer; // see Domain::is_finer_than()
  std::size_t input_vertices;
  Measures cgal, weft;
  double cgal_seconds = 0, weft_seconds = 0;
  bool conforming = false;
  std::vector<std::pair<std::string, double>> stages; // weft's own wall times
  std::string stop;                                   // why weft stopped, when criteria weren't met; or what it threw

  std::size_t cgal_steiner() const { return cgal.vertices - input_vertices; }
  std::size_t weft_steiner() const { return weft.vertices - input_vertices; }
  double more_points() const // percent
  {
    return 100 * (static_cast<double>(weft_steiner()) / static_cast<double>(cgal_steiner()) - 1);
  }
  double time_ratio() const { return weft_seconds / cgal_seconds; }
  std::string label() const { return input + (field.empty() ? "" : ", " + field) + ", " + size_label(triangles); }

  static std::string size_label(double n)
  {
    if (n >= 1e6) return text(n / 1e6, n == 1e6 * std::floor(n / 1e6) ? 0 : 1) + "M";
    return n >= 1000 ? text(n / 1000, n == 1000 * std::floor(n / 1000) ? 0 : 1) + "k" : text(n, 0);
  }
};

inline double size_at(const weft::Uniform_sizing<>& s, double, double)
{
  return s.size();
}
inline double size_at(const Graded_size& s, double x, double y)
{
  return s(x, y);
}
inline double cgal_size(const weft::Uniform_sizing<>& s)
{
  return s.size();
}
inline const Graded_size& cgal_size(const Graded_size& s)
{
  return s;
}

/// Lets both mesh the domain in turns and takes median times: of three runs, more of very short ones, one of long ones.
template <class Sizing>
void compare(const Domain& domain, const Sizing& sizing, double time_limit, Run& run)
{
  const auto measured = [&](const auto& cdt) {
    return measure(flat_mesh(cdt), [&](double x, double y) { return size_at(sizing, x, y); });
  };
  std::vector<double> cgal_times, weft_times;
  for (std::size_t repeats = 1, i = 0; i < repeats; ++i) {
    {
      Cgal_cdt cdt(domain.cgal);
      const double start = user_seconds();
      refine_with_cgal(cdt, cgal_size(sizing));
      cgal_times.push_back(user_seconds() - start);
      if (i == 0) run.cgal = measured(cdt);
    }
    Weft_cdt cdt(domain.weft);
    weft::Mesh_options_2 options;
    options.time_limit = time_limit;
    const double start = user_seconds();
    const auto report = weft::make_mesh_2(cdt, sizing, options);
    weft_times.push_back(user_seconds() - start);
    if (i > 0) continue;
    run.weft = measured(cdt);
    run.stages = report.stage_seconds;
    if (report.stop_reason != weft::Stop_reason::criteria_met) run.stop = weft::name(report.stop_reason);
    const double longest = std::max(cgal_times[0], weft_times[0]);
    repeats = longest < 0.1 ? 9 : longest < 5 ? 3 : 1;
  }
  run.cgal_seconds = median(cgal_times);
  run.weft_seconds = median(weft_times);
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
  run.conforming = near(run.weft.area, domain.given.area) &&
                   near(run.weft.constraint_length, domain.given.constraint_length) && run.weft.inverted == 0;
}

template <class Sizing>
Run run_on(const Domain& domain, const std::string& field, double triangles, const Sizing& sizing, double time_limit)
{
  Run run;
  run.input = domain.name;
  run.field = field;
  run.triangles = triangles;
  run.size = domain.size_for(triangles / ideal_share);
  run.input_angle = domain.smallest_angle;
  run.finer = domain.is_finer_than([&](double x, double y) { return size_at(sizing, x, y); });
  run.input_vertices = domain.given.vertices;
  try {
    compare(domain, sizing, time_limit, run);
  } catch (const std::exception& error) {
    run.stop = std::string("threw: ") + error.what();
  }
  return run;
}

inline std::vector<std::string> run_head()
{
  return {
      "input", "triangles asked", "Steiner CGAL", "weft",         "change",       "T/m_Δ CGAL", "weft",  "angles CGAL",
      "weft",  "longest/size",    "too long",     "not Delaunay", "seconds CGAL", "weft",       "ratio", "note"};
}

inline std::string angles(const Measures& m)
{
  return text(m.smallest_angle, 1) + "–" + text(m.largest_angle, 1);
}

inline std::vector<std::string> cells(const Run& r)
{
  const std::string name = r.input + (r.field.empty() ? "" : ", " + r.field);
  if (r.weft.triangles == 0) return {name, Run::size_label(r.triangles), r.stop};
  std::string note = r.stop;
  if (r.finer) note += (note.empty() ? "" : "; ") + std::string("finer than the size");
  if (!r.conforming) note += (note.empty() ? "" : "; ") + std::string("**doesn't conform**");
  return {name,
          Run::size_label(r.triangles),
          std::to_string(r.cgal_steiner()),
          std::to_string(r.weft_steiner()),
          text(r.more_points(), 1) + " %",
          text(r.cgal.relative_count(), 3),
          text(r.weft.relative_count(), 3),
          angles(r.cgal),
          angles(r.weft),
          text(std::max(r.weft.largest_ratio, r.weft.largest_edge_ratio), 4),
          std::to_string(r.weft.oversize + r.weft.oversize_edges),
          std::to_string(r.weft.non_delaunay),
          seconds_text(r.cgal_seconds),
          seconds_text(r.weft_seconds),
          text(r.time_ratio(), 1),
          note};
}

inline std::string json(const Measures& m, std::size_t steiner, double seconds)
{
  return Json_object()
      .add("vertices", static_cast<double>(m.vertices))
      .add("steiner", static_cast<double>(steiner))
      .add("triangles", static_cast<double>(m.triangles))
      .add("triangles_over_ideal", m.relative_count())
      .add("smallest_angle", m.smallest_angle)
      .add("largest_angle", m.largest_angle)
      .add("largest_ratio", m.largest_ratio)
      .add("largest_constrained_edge_ratio", m.largest_edge_ratio)
      .add("oversize_triangles", static_cast<double>(m.oversize))
      .add("oversize_constrained_edges", static_cast<double>(m.oversize_edges))
      .add("non_delaunay_edges", static_cast<double>(m.non_delaunay))
      .add("inverted", static_cast<double>(m.inverted))
      .add("user_seconds", seconds)
      .str();
}

inline std::string json(const Run& r)
{
  Json_object o;
  o.add("input", r.input).add("field", r.field.empty() ? "uniform" : r.field).add("triangles_asked", r.triangles);
  if (r.field.empty()) o.add("size", r.size);
  o.add("smallest_input_angle", r.input_angle).add_raw("finer_than_size", r.finer ? "true" : "false");
  if (r.weft.triangles == 0) return o.add("failed", r.stop).str();
  o.add_raw("cgal", json(r.cgal, r.cgal_steiner(), r.cgal_seconds));
  o.add_raw("weft", json(r.weft, r.weft_steiner(), r.weft_seconds));
  Json_object stages;
  for (const auto& stage : r.stages) stages.add(stage.first, stage.second);
  o.add_raw("weft_stage_seconds", stages.str());
  o.add_raw("conforming", r.conforming ? "true" : "false");
  return o.add("stopped_early", r.stop).str();
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_RUN_H
