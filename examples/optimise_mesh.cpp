// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points, cells and labels of one's own, optimised with a smoother of one's choice: a unit cube of two materials, cut
// into a grid of 6 tetrahedra a box, as nobody would want it. Prints angles before and after and writes cube.vtu.

#include <weft/IO/write_mesh_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/optimise/optimise_3.h>
#include <weft/spatial/run/Delaunay_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <iostream>

int main()
{
  using K = CGAL::Exact_predicates_inexact_constructions_kernel;
  constexpr std::size_t n = 6, m = n + 1;
  weft::Element_soup_3<K> soup;
  for (std::size_t i = 0; i < m * m * m; ++i) { // thinner and thinner in z
    const auto x = double(i % m), y = double(i / m % m), z = double(i / m / m);
    soup.points.emplace_back(x / n, y / n, std::pow(z / n, 2.2));
  }
  const std::size_t steps[] = {1, m, m * m};
  for (std::size_t i = 0; i < n * n * n; ++i) {
    const std::size_t first = i % n + i / n % n * m + i / n / n * m * m;
    for (int a = 0; a < 3; ++a)
      for (const int b : {(a + 1) % 3, (a + 2) % 3}) { // along one edge, then another, then the last
        const std::size_t second = first + steps[a], third = second + steps[b];
        soup.cells.push_back({first, second, third, first + steps[0] + steps[1] + steps[2]});
        soup.cell_tags.push_back(2 * (i % n) < n ? 1 : 2);
      }
  }
  weft::Delaunay_mesh_3<K> delaunay(soup);
  weft::Optimise_options_3 options;
  options.coarsen = false;
  options.perturbation.target = 25; // degrees
  const auto report = weft::optimise_3(delaunay.restricted(), delaunay.criteria(), options, weft::Lloyd_3());
  const auto mesh = delaunay.mesh();
  std::cout << weft::measure_quality_3(weft::assemble_mesh_3(soup).mesh).smallest_dihedral.degrees
            << " degrees before, " << report.perturbation.before << " after smoothing, " << report.perturbation.after
            << " after perturbation, " << mesh.points.size() << " vertices\n";
  weft::IO::write_mesh_3("cube.vtu", mesh);
}
