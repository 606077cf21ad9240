// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many sweeps solvers take to come near an energy that all of them reach in the end.

#ifndef WEFT_BENCHMARK_COMMON_SOLVER_TABLE_H
#define WEFT_BENCHMARK_COMMON_SOLVER_TABLE_H

#include "table.h"

#include <weft/solve/Solver_options.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace benchmark {

struct Solver_row
{
  std::string name;
  std::size_t vertices;
  weft::Solver_report report;
  double user_seconds;
  std::string remark;
};

inline weft::Solver solver_of_name(const std::string& name)
{
  return name == "fixed point" ? weft::Solver::fixed_point
         : name == "L-BFGS"    ? weft::Solver::quasi_newton
                               : weft::Solver::newton;
}

/// Sweeps, and user seconds with those undone, until the energy is within parts of the largest that any ends with:
/// minima that solvers find differ by about a thousandth in small meshes.
inline void print_solvers(const std::vector<Solver_row>& rows)
{
  double common = 0;
  for (const Solver_row& row : rows) common = (std::max)(common, row.report.energies.back());
  std::cout << markdown_head({"solver", "vertices", "energy", "sweeps", "undone", "to 1e-2", "to 1e-3", "to 1e-4",
                              "user s", "ms a sweep", "s to 1e-3", "remark"});
  for (const Solver_row& row : rows) {
    const auto& energies = row.report.energies;
    const double seconds = row.user_seconds / static_cast<double>(row.report.sweeps);
    std::vector<std::string> cells{row.name, std::to_string(row.vertices), text(energies.back() / common, 5),
                                   std::to_string(row.report.sweeps), std::to_string(row.report.undone_sweeps)};
    const double undone = static_cast<double>(row.report.sweeps) / static_cast<double>(energies.size() - 1);
    std::size_t to_thousandth = 0;
    for (const double part : {1e-2, 1e-3, 1e-4}) {
      std::size_t k = 0;
      while (k < energies.size() && energies[k] > (1 + part) * common) ++k;
      if (part == 1e-3) to_thousandth = k;
      cells.push_back(k < energies.size() ? std::to_string(k) : "never");
    }
    cells.insert(
        cells.end(),
        {seconds_text(row.user_seconds), text(1000 * seconds, 1),
         to_thousandth < energies.size() ? seconds_text(seconds * undone * static_cast<double>(to_thousandth)) : "-",
         row.remark});
    std::cout << markdown_row(cells);
  }
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_COMMON_SOLVER_TABLE_H
