// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's spatial mesher as a program of its own: refinement, and any chain of its optimisers after it. Prints user
// seconds and smallest dihedral angle after each stage as JSON.
//
//   cgal_mesh_3 --size L [--approximation E] [--shape R] [--sharp-angle DEG] [--edge-size L] [--chain STAGE,...]
//               [--sliver-bound DEG] [--time-limit SECONDS] [--output FILE.mesh] SURFACE
//
// Stages are odt, lloyd, perturb and exude. The surface is meshed as it is, not scaled; spatial_peers.h has the bounds
// in CGAL's terms. The time limit is that of one stage, which CGAL keeps by ending it early, between its steps.

#include "../common/program.h"
#include "../common/table.h"
#include "../common/user_time.h"
#include "../spatial/spatial_peers.h"
#include "optimisation_peers.h"

#include <weft/IO/write_mesh_3.h>

#include <CGAL/lloyd_optimize_mesh_3.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

struct Request
{
  Bounds bounds;
  double sharp_angle = 0, edge_size = 0, sliver_bound = 12, time_limit = 0;
  std::vector<std::string> chain;
  std::string output, file;
};

Request parse(Argument_reader arguments)
{
  Request r;
  while (arguments.next()) {
    if (arguments.is("--size"))
      r.bounds.size = arguments.positive();
    else if (arguments.is("--approximation"))
      r.bounds.approximation = arguments.number();
    else if (arguments.is("--shape"))
      r.bounds.shape = arguments.positive();
    else if (arguments.is("--sharp-angle"))
      r.sharp_angle = arguments.number();
    else if (arguments.is("--edge-size"))
      r.edge_size = arguments.positive();
    else if (arguments.is("--sliver-bound"))
      r.sliver_bound = arguments.number();
    else if (arguments.is("--time-limit"))
      r.time_limit = arguments.number();
    else if (arguments.is("--output"))
      r.output = arguments.value();
    else if (arguments.is("--chain")) {
      std::stringstream list(arguments.value());
      for (std::string stage; std::getline(list, stage, ',');) r.chain.push_back(stage);
    } else
      r.file = arguments.operand();
  }
  if (r.file.empty() || !(r.bounds.size > 0)) throw weft::Option_error("needs a surface file and --size");
  if (r.edge_size == 0) r.edge_size = r.bounds.size;
  return r;
}

void optimise(const std::string& stage, const Request& r, Cgal_complex& complex, const Cgal_domain& domain)
{
  namespace with = CGAL::parameters;
  if (stage == "odt")
    CGAL::odt_optimize_mesh_3(complex, domain, with::time_limit = r.time_limit);
  else if (stage == "lloyd")
    CGAL::lloyd_optimize_mesh_3(complex, domain, with::time_limit = r.time_limit);
  else if (stage == "perturb")
    perturb_with_cgal(complex, domain, r.sliver_bound, r.time_limit);
  else if (stage == "exude")
    CGAL::exude_mesh_3(complex, with::time_limit = r.time_limit);
  else
    throw weft::Option_error("unknown stage " + stage);
}

void run(const Request& r)
{
  const Complex input =
      weft::mended_complex_3(weft::IO::read_surface<Spatial_kernel>(r.file), weft::Feature_options(r.sharp_angle));
  Cgal_polyhedron surface = polyhedron(input);
  Cgal_domain domain(surface);
  if (!input.creases.empty()) domain.detect_features(r.sharp_angle);

  std::vector<std::string> stages;
  double start = user_seconds();
  const auto end_stage = [&](const std::string& name, const Cgal_complex& complex) {
    stages.push_back(Json_object()
                         .add("name", name)
                         .add("seconds", user_seconds() - start)
                         .add("smallest_dihedral", smallest_dihedral(complex))
                         .str());
    start = user_seconds();
  };
  Cgal_complex complex = mesh_with_cgal(domain, r.bounds, r.edge_size);
  end_stage("refine", complex);
  for (const std::string& stage : r.chain) {
    optimise(stage, r, complex, domain);
    end_stage(stage, complex);
  }
  const auto mesh = arrays(complex);
  if (!r.output.empty()) weft::IO::write_mesh_3(r.output, mesh);
  std::cout << Json_object()
                   .add("vertices", static_cast<double>(mesh.points.size()))
                   .add("cells", static_cast<double>(mesh.cells.size()))
                   .add_raw("stages", json_array(stages))
                   .str()
            << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("cgal_mesh_3", [&] { run(parse({argc, argv})); });
}
