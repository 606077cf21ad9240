// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least that a mesh takes: a square with a square hole and a wall, meshed with edges of at most 0.1. Prints the
// report and writes the mesh and a picture of it.

#include <cstdlib>
#include <iostream>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>

using Cdt = weft::Mesh_triangulation_2<>;

void insert_square(Cdt& cdt, double lower, double upper)
{
  const Cdt::Point corners[] = {{lower, lower}, {upper, lower}, {upper, upper}, {lower, upper}};
  for (int i = 0; i < 4; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 4]);
}

int main()
{
  Cdt cdt;
  insert_square(cdt, 0, 4);
  insert_square(cdt, 1, 2); // inside of one outline is the domain, inside of two a hole
  cdt.insert_constraint(Cdt::Point(3, 1), Cdt::Point(3, 3));

  std::cout << weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.1));
  weft::IO::write_mesh_2("minimal_mesh.vtu", cdt);
  weft::IO::write_mesh_2("minimal_mesh.svg", cdt);
  return EXIT_SUCCESS;
}
