// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least that a planar mesh takes: an L, meshed with edges of at most 0.1. Prints the report and writes mesh.vtu.

#include <iostream>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>

int main()
{
  weft::Mesh_triangulation_2<> cdt; // a CGAL constrained Delaunay triangulation
  const decltype(cdt)::Point corners[] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int i = 0; i < 6; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 6]);
  std::cout << weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.1)); // no edge longer than 0.1
  weft::IO::write_mesh_2("mesh.vtu", cdt);
}
