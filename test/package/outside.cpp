// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a project that uses weft might begin with: a constrained Delaunay triangulation of a square with a diagonal.

#include <weft/errors.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/version.h>

#include <cstdlib>
#include <iostream>

int main()
{
  using Triangulation = weft::Mesh_triangulation_2<>;
  using Point = Triangulation::Point;

  Triangulation triangulation;
  const auto a = triangulation.insert(Point(0, 0)), b = triangulation.insert(Point(1, 0)),
             c = triangulation.insert(Point(1, 1)), d = triangulation.insert(Point(0, 1));
  triangulation.insert_constraint(a, c);

  const bool square = triangulation.is_edge(a, c) && !triangulation.is_edge(b, d) && triangulation.is_valid() &&
                      triangulation.number_of_faces() == 2;
  std::cout << "weft " << WEFT_VERSION << (square ? ": two triangles\n" : ": not the expected triangulation\n");
  return square ? EXIT_SUCCESS : EXIT_FAILURE;
}
