// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a domain of a surface as mesh_3 does, without meshing it, and prints a JSON object: how long that took, what
// was done and what it is. Status: 0 for a domain, 1 with a message if it is refused.
//
//   make_domain SURFACE [--time-limit S] [--trace]
//
// --trace: says on the way what is being done, and when that began.

#include "../common/program.h"

#include <weft/internal/Timer.h>
#include <weft/IO/read_surface.h>
#include <weft/spatial/surface/mended_complex_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <string>

namespace {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

void print(const weft::Piecewise_smooth_complex_3<K>& complex, std::size_t facets, double seconds)
{
  int subdomains = 1;
  for (const auto& [behind, before] : complex.sides) subdomains = (std::max)({subdomains, behind, before});
  std::cout << "{\"facets\": " << facets << ", \"seconds\": " << seconds
            << ", \"triangles\": " << complex.triangles.size() << ", \"subdomains\": " << subdomains
            << ", \"shells\": " << complex.number_of_shells << ", \"changes\": [";
  for (std::size_t i = 0; i < complex.changes.size(); ++i)
    std::cout << (i > 0 ? ", \"" : "\"") << complex.changes[i] << '"';
  std::cout << "]}\n";
}

void run(benchmark::Argument_reader arguments)
{
  std::string filename, last;
  bool is_traced = false;
  double time_limit = std::numeric_limits<double>::infinity();
  while (arguments.next()) {
    if (arguments.is("--time-limit"))
      time_limit = arguments.positive();
    else if (arguments.is("--trace"))
      is_traced = true;
    else
      filename = arguments.operand();
  }
  if (filename.empty()) throw weft::Option_error("usage: make_domain SURFACE [--time-limit S] [--trace]");
  const weft::internal::Timer timer;
  const auto soup = weft::IO::read_surface<K>(filename);
  weft::Mend_options_3 mending;
  mending.go_on = [&](const char* doing) {
    if (is_traced && doing != last) std::cerr << timer.seconds() << " s: " << doing << "\n";
    last = doing;
    return timer.seconds() < time_limit;
  };
  const auto complex = weft::mended_complex_3(soup, weft::Feature_options(), mending);
  print(complex, soup.polygons.size(), timer.seconds());
}

} // namespace

int main(int argc, char** argv)
{
  return benchmark::run_program("make_domain", [&] { run({argc, argv}); });
}
