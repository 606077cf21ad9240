// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improves a mesh that CGAL's own mesher made: its vertices move to better places, and none is inserted. Prints the
// quality before and after.

#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <cstdlib>
#include <iostream>
#include <weft/make_mesh_2.h>
#include <weft/planar/mesh/quality_2.h>

using Cdt = weft::Mesh_triangulation_2<>;

int main()
{
  Cdt cdt;
  const Cdt::Point corners[] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int i = 0; i < 6; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 6]);

  const double size = 0.1;
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(0.125, size));
  mesher.refine_mesh();
  std::cout << "before: " << weft::measure_quality_2(cdt);

  const auto report = weft::relax_2(cdt, weft::Uniform_sizing<>(size));
  std::cout << "after: " << weft::measure_quality_2(cdt);
  std::cout << report.oversized << " triangles are larger than asked for, which relaxing alone can't rule out\n";
  return EXIT_SUCCESS;
}
