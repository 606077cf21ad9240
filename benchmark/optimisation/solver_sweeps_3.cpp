// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solvers against each other in space: sweeps and user time until the ODT energy of a refined mesh is near one that all
// reach, and what slivers are left.
//
//   solver_sweeps_3 [--size S] [--uniform] [--keep] [--fixed-boundary] [--sweeps N] [--solver NAME]... [FILE]
//
// Without a file: the unit ball. Criteria: size S in parts of the longest side, 0.1 unless given; for files a
// thousandth of it as approximation, and the thesis' shapes. --uniform: no metric. --keep: criteria are kept.

#include "../common/program.h"
#include "../common/solver_table.h"
#include "../common/user_time.h"
#include "../spatial/spatial_inputs.h"

#include <weft/make_mesh_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/solve/minimise_energy_3.h>

#include <string>
#include <vector>

using namespace benchmark;

int main(int argc, char** argv)
{
  return run_program("solver_sweeps_3", [&] {
    using K = Spatial_kernel;
    weft::Solver_options options;
    options.max_sweeps = 100;
    options.tolerance = 1e-7;
    weft::Smooth_options_3 smoothing;
    smoothing.keep_criteria = false;
    weft::Criteria_3<K> criteria;
    criteria.facet_shape = criteria.cell_shape = 2;
    double size = 0.1;
    std::string file;
    std::vector<std::string> names;
    for (Argument_reader a(argc, argv); a.next();) {
      if (a.is("--size"))
        size = a.positive();
      else if (a.is("--uniform"))
        smoothing.uniform = true;
      else if (a.is("--keep"))
        smoothing.keep_criteria = true;
      else if (a.is("--fixed-boundary"))
        options.move_boundary = false;
      else if (a.is("--sweeps"))
        options.max_sweeps = static_cast<int>(a.positive());
      else if (a.is("--solver"))
        names.push_back(a.value());
      else
        file = a.operand();
    }
    if (names.empty()) names = {"fixed point", "L-BFGS"};
    const Spatial_input input = file.empty() ? make_input("ball", unit_sphere(5), 0) : read_input(file, 60);
    criteria.size = size;
    criteria.approximation = file.empty() ? 0.1 * size : 0.001;
    const weft::Polyhedral_oracle_3<K> oracle(input.complex);
    auto refining = weft::Mesh_options_3::refinement();
    refining.lattice = false;
    std::vector<Solver_row> rows;
    for (const std::string& name : names) {
      auto mesh = weft::make_mesh_3(oracle, criteria, refining).restricted;
      const auto before = weft::measure_quality_3(weft::tetrahedral_mesh(mesh));
      options.solver = solver_of_name(name);
      const Stopwatch watch;
      Solver_row row{name, mesh.vertices().size(), weft::minimise_energy_3(mesh, criteria, options, smoothing),
                     watch.seconds(), ""};
      const auto after = weft::measure_quality_3(weft::tetrahedral_mesh(mesh));
      row.remark = std::to_string(after.cells) + " cells, below 10 degrees " + std::to_string(before.cells_below(10)) +
                   " to " + std::to_string(after.cells_below(10)) + ", smallest " +
                   text(before.smallest_dihedral.degrees, 2) + " to " + text(after.smallest_dihedral.degrees, 2);
      rows.push_back(row);
    }
    print_solvers(rows);
  });
}
