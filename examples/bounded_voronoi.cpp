// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bounded Voronoi diagram of a constrained Delaunay triangulation made by CGAL alone: prints the area of every
// cell, the number of blind triangles, and whose cell a point lies in. A wall in the middle of a square hides one
// half of it from the other.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <cstdlib>
#include <iostream>
#include <weft/planar/triangulation/Bounded_voronoi_diagram_2.h>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<K>;

int main()
{
  Cdt cdt;
  const Cdt::Point corners[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  for (int i = 0; i < 4; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 4]);
  cdt.insert_constraint(Cdt::Point(2, 0.5), Cdt::Point(2, 3.5)); // the wall
  cdt.insert(Cdt::Point(1.75, 2));
  cdt.insert(Cdt::Point(3, 1));

  const weft::Bounded_voronoi_diagram_2<Cdt> diagram(cdt);
  K::FT sum = 0;
  for (const auto& cell : diagram.cells()) {
    std::cout << "site " << cell.site->point() << "  area " << diagram.area(cell.site)
              << (diagram.is_free(cell.site) ? "\n" : "  on a constraint\n");
    sum += diagram.area(cell.site);
  }

  int blind = 0;
  for (Cdt::Face_handle f : cdt.finite_face_handles()) blind += diagram.is_blind(f);
  std::cout << "sum " << sum << ", " << blind << " blind triangles of " << cdt.number_of_faces() << '\n'
            << "(2.1, 2) lies in the cell of " << diagram.locate(Cdt::Point(2.1, 2))->point() << '\n';
  return EXIT_SUCCESS;
}
