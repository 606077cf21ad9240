// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parts of the planar algorithm are for: meshes one input with each of them taken away, prints what becomes of
// the mesh, and writes the meshes. The manual's pictures of options are made by it.
//
//   options_2 [FILE.poly [SIZE [FOLDER]]]    writes default.mesh, seeding_none.mesh and so on

#include <weft/IO/read_pslg.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/graph/insert_pslg.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<std::pair<std::string, weft::Mesh_options_2>> variants()
{
  std::vector<std::pair<std::string, weft::Mesh_options_2>> all;
  const auto add = [&](const std::string& name) -> weft::Mesh_options_2& {
    all.emplace_back(name, weft::Mesh_options_2());
    return all.back().second;
  };
  add("default");
  add("seeding_none").seeding = weft::Seeding::none; // from the bare constraints
  add("no_polish").polish = false;
  add("no_grading").grade_input = false;
  add("no_feedback").size_feedback = 0; // Lloyd's iteration proper
  add("no_sweeps").max_sweeps = 0;      // refinement without relaxation
  return all;
}

int main(int argc, char** argv)
{
  const std::string filename = argc > 1 ? argv[1] : "data/plate.poly";
  const double size = argc > 2 ? std::atof(argv[2]) : 6;
  const std::filesystem::path folder = argc > 3 ? argv[3] : ".";
  try {
    const auto pslg = weft::IO::read_pslg<K>(filename);
    for (const auto& [name, options] : variants()) {
      weft::Mesh_triangulation_2<K> cdt;
      weft::insert_pslg(cdt, pslg);
      weft::mark_domain(cdt, pslg);
      std::cout << name << ": " << weft::make_mesh_2(cdt, weft::Uniform_sizing<>(size), options);
      weft::IO::write_mesh_2((folder / (name + ".mesh")).string(), cdt);
    }
  } catch (const weft::Error& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
