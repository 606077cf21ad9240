// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watches a run and stops it: a visitor prints what is going on whenever the stage changes, and ends the run after half
// a second. However a run ends, the mesh is valid, and the report says what holds.

#include <cstdlib>
#include <iostream>
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
  insert_square(cdt, 0, 1);
  insert_square(cdt, 0.25, 0.5); // inside of one outline is the domain, inside of two a hole
  cdt.insert_constraint(Cdt::Point(0.75, 0.25), Cdt::Point(0.75, 0.75)); // a wall

  bool first = true;
  weft::Stage stage{};
  weft::Mesh_options_2 options;
  options.visitor = [&](const weft::Progress& progress) {
    if (first || progress.stage != stage)
      std::cout << progress.seconds << " s: " << name(progress.stage) << ", " << progress.vertices << " vertices\n";
    first = false;
    stage = progress.stage;
    return progress.seconds < 0.5; // false: no further
  };
  const auto report = weft::make_mesh_2(cdt, weft::Uniform_sizing<>(0.002), options);
  std::cout << report << (report.ok() ? "complete\n" : "a valid mesh, but not yet what was asked for\n")
            << (cdt.is_valid() ? "" : "broken\n");
  return EXIT_SUCCESS;
}
