// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's planar meshers as a program of their own: refine_Delaunay_mesh_2 with the bound 0.125 (20.7 degrees), and
// lloyd_optimize_mesh_2 after it. Prints user seconds of either as JSON.
//
//   cgal_mesh_2 (--size S | --lfs K) [--lloyd SWEEPS] [--output FILE.mesh] FILE.poly
//
// --lfs: sizes from the local feature size of the input, growing by K per unit of distance, as mesh_2 has them.

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "planar_peers.h"

#include <weft/IO/write_medit_2.h>

#include <iostream>
#include <string>

using namespace benchmark;

namespace {

void run(Argument_reader arguments)
{
  double size = 0, lfs = 0, sweeps = 0;
  std::string output, file;
  while (arguments.next()) {
    if (arguments.is("--size"))
      size = arguments.positive();
    else if (arguments.is("--lfs"))
      lfs = arguments.positive();
    else if (arguments.is("--lloyd"))
      sweeps = arguments.number();
    else if (arguments.is("--output"))
      output = arguments.value();
    else
      file = arguments.operand();
  }
  if (file.empty() || (size > 0) == (lfs > 0)) throw weft::Option_error("needs a file, and either --size or --lfs");

  const Pslg pslg = read_planar_input(file).pslg;
  Cgal_cdt cdt;
  weft::insert_pslg(cdt, pslg);
  weft::mark_domain(cdt, pslg);
  const double start = user_seconds();
  if (lfs > 0)
    refine_with_cgal(cdt, Graded_size(pslg, lfs));
  else
    refine_with_cgal(cdt, size);
  const double refined = user_seconds();
  if (sweeps > 0) lloyd_with_cgal(cdt, static_cast<int>(sweeps));
  const double end = user_seconds();
  if (!output.empty()) weft::IO::write_medit(output, cdt);
  std::cout << Json_object()
                   .add("vertices", static_cast<double>(cdt.number_of_vertices()))
                   .add("refine_seconds", refined - start)
                   .add("lloyd_seconds", end - refined)
                   .str()
            << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("cgal_mesh_2", [&] { run({argc, argv}); });
}
