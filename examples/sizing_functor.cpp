// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sizing field of your own is any function of a point that returns the largest edge length there, in the input's
// units. This one asks for small triangles along a ring in a square.

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/mesh/quality_2.h>

using Cdt = weft::Mesh_triangulation_2<>;

int main()
{
  Cdt cdt;
  const Cdt::Point corners[] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  for (int i = 0; i < 4; ++i) cdt.insert_constraint(corners[i], corners[(i + 1) % 4]);

  const auto sizing = [](const Cdt::Point& p) {
    const double distance = std::abs(std::hypot(p.x(), p.y()) - 1.4); // from the ring
    return 0.03 + 0.25 * distance;
  };
  std::cout << weft::make_mesh_2(cdt, sizing) << weft::measure_quality_2(cdt);
  std::cout << weft::measure_sizing_2(cdt, sizing).relative_count() << " triangles for each ideal one\n";
  weft::IO::write_mesh_2("sizing_functor.svg", cdt);
  return EXIT_SUCCESS;
}
