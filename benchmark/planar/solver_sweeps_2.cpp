// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solvers against each other in the plane: sweeps and user time until the CVT or ODT energy of a mesh that was refined,
// not relaxed, is near one that all reach.
//
//   solver_sweeps_2 [--odt] [--graded] [--sweeps N] [--triangles N] [--solver NAME]...

#include "../common/program.h"
#include "../common/solver_table.h"
#include "../common/user_time.h"

#include <weft/make_mesh_2.h>
#include <weft/planar/mesh/quality_2.h>
#include <weft/planar/solve/minimise_energy_2.h>

#include <cmath>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = weft::Mesh_triangulation_2<K>;

/// A square with a slot.
Cdt domain()
{
  const std::vector<K::Point_2> points{{0, 0}, {1, 0}, {1, .45}, {.5, .45}, {.5, .55}, {1, .55}, {1, 1}, {0, 1}};
  Cdt cdt;
  for (std::size_t i = 0; i < points.size(); ++i) cdt.insert_constraint(points[i], points[(i + 1) % points.size()]);
  return cdt;
}

template <class Sizing>
Solver_row run(const std::string& name, const Sizing& sizing, const weft::Solver_options& options)
{
  Cdt cdt = domain();
  weft::Mesh_options_2 refining;
  refining.seeding = weft::Seeding::none;
  refining.max_sweeps = 0;
  refining.polish = refining.grade_input = false;
  weft::make_mesh_2(cdt, sizing, refining);
  const Stopwatch watch;
  Solver_row row{name, cdt.number_of_vertices(), weft::minimise_energy_2(cdt, sizing, options), watch.seconds(), ""};
  const auto quality = weft::measure_quality_2(cdt);
  row.remark = "angles " + text(quality.smallest_angle.degrees, 1) + " to " + text(quality.largest_angle.degrees, 1);
  return row;
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("solver_sweeps_2", [&] {
    weft::Solver_options options;
    options.energy = weft::Energy::cvt;
    options.max_sweeps = 2000;
    options.tolerance = 1e-7;
    double triangles = 10000;
    bool graded = false;
    std::vector<std::string> names;
    for (Argument_reader a(argc, argv); a.next();) {
      if (a.is("--odt"))
        options.energy = weft::Energy::odt;
      else if (a.is("--graded"))
        graded = true;
      else if (a.is("--sweeps"))
        options.max_sweeps = static_cast<int>(a.positive());
      else if (a.is("--triangles"))
        triangles = a.positive();
      else if (a.is("--solver"))
        names.push_back(a.value());
      else
        a.operand();
    }
    if (names.empty()) names = {"fixed point", "L-BFGS", "Newton"};
    const double size = std::sqrt(4 / std::sqrt(3.) / triangles * 1.15); // plain refinement takes so many more
    std::vector<Solver_row> rows;
    for (const std::string& name : names) {
      options.solver = solver_of_name(name);
      if (graded)
        rows.push_back(run(
            name, [&](const K::Point_2& p) { return size * (0.5 + 2 * std::hypot(p.x() - 0.3, p.y() - 0.3)); },
            options));
      else
        rows.push_back(run(name, weft::Uniform_sizing<>(size), options));
    }
    print_solvers(rows);
  });
}
