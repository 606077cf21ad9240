// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes a file with sizes that follow the local feature size: small where parts of the input are near each other,
// growing by 0.3 per unit of distance elsewhere. Usage: graded_by_lfs [FILE.poly [K]]

#include <cstdlib>
#include <iostream>
#include <string>
#include <weft/IO/read_pslg.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

int main(int argc, char** argv)
{
  const std::string filename = argc > 1 ? argv[1] : "data/plate.poly";
  const double k = argc > 2 ? std::atof(argv[2]) : 0.3;
  try {
    const auto pslg = weft::IO::read_pslg<K>(filename);
    weft::Mesh_triangulation_2<K> cdt;
    const auto inserted = weft::insert_pslg(cdt, pslg); // refuses crossing segments and names them
    weft::mark_domain(cdt, pslg);                       // holes and regions of the file, else nesting parity
    const auto report = weft::make_mesh_2(cdt, weft::Lfs_sizing_2<K>(inserted.graph, k));
    weft::IO::write_mesh_2("graded_by_lfs.vtu", cdt, inserted.tags);
    weft::IO::write_mesh_2("graded_by_lfs.svg", cdt);
    std::cout << report;
  } catch (const weft::Error& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
