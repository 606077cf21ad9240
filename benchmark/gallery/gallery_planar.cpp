// SPDX-License-Identifier: GPL-3.0-or-later
//
// One planar model of the gallery (doc/gallery.md): its meshes by weft and by CGAL with the same sizes, and their
// figures.
//
//   gallery_planar INPUT --output PREFIX [--triangles N] [--field uniform|linear|lfs] [--growth G] [--time-limit
//   SECONDS]
//
// INPUT is the name of an input in planar_inputs.h or a file. Sizes are such that a mesh of 1.5 times the ideal number
// of triangles has N of them, 3000 unless given. --field: the size is the same everywhere; grows by G per unit of
// distance from a point, 0.2 unless given; or follows the local feature size. Writes PREFIX_weft.mesh, PREFIX_cgal.mesh
// and PREFIX.json.

#include "../planar/planar_inputs.h"
#include "../planar/planar_peers.h"
#include "../planar/planar_run.h"
#include "gallery_program.h"

#include <weft/errors.h>
#include <weft/IO/write_mesh_2.h>
#include <weft/make_mesh_2.h>
#include <weft/planar/mesh/quality_2.h>

#include <CGAL/version.h>

#include <string>
#include <vector>

using namespace benchmark;

namespace {

Planar_input find_input(const std::string& name)
{
  for (Planar_input& input : planar_inputs())
    if (input.name == name) return input;
  return read_planar_input(name);
}

/// \param seconds median user time.
template <class Cdt>
std::string row(const std::string& mesher, const Cdt& cdt, double ideal_triangles, double seconds)
{
  const weft::Quality_2 quality = weft::measure_quality_2(cdt);
  return Json_object()
      .add("mesher", mesher)
      .add("vertices", static_cast<double>(quality.vertices))
      .add("elements", static_cast<double>(quality.triangles))
      .add("elements_over_ideal", static_cast<double>(quality.triangles) / ideal_triangles)
      .add("smallest_angle", quality.smallest_angle.degrees)
      .add("largest_angle", quality.largest_angle.degrees)
      .add("mean_smallest_angle", quality.mean_smallest_angle)
      .add("seconds", seconds)
      .add_raw("angles", counts_json(quality.angles))
      .str();
}

template <class Sizing>
void mesh(const Gallery_arguments& a, const Domain& domain, const Sizing& sizing)
{
  const double limit = a.number("time-limit");
  const Run run = run_on(domain, a.text("field"), a.number("triangles"), sizing, limit);
  if (run.weft.triangles == 0) throw weft::Domain_error(domain.name + ": " + run.stop, {}, {});

  Weft_cdt ours(domain.weft);
  weft::Mesh_options_2 options;
  options.time_limit = limit;
  weft::make_mesh_2(ours, sizing, options);
  weft::IO::write_mesh_2(a.text("output") + "_weft.mesh", ours);

  Cgal_cdt theirs(domain.cgal);
  refine_with_cgal(theirs, cgal_size(sizing));
  weft::IO::write_mesh_2(a.text("output") + "_cgal.mesh", theirs);

  const double ideal = run.weft.ideal_triangles;
  Json_object asked;
  asked.add("cgal_version", CGAL_VERSION_STR)
      .add("field", a.text("field"))
      .add("smallest_input_angle", run.input_angle);
  if (a.text("field") == "uniform") asked.add("size", run.size);
  asked.add_raw("met", run.stop.empty() ? "true" : "false").add("stopped", run.stop);
  write_gallery_json(a.text("output"), asked,
                     {row("weft", ours, ideal, run.weft_seconds), row("CGAL", theirs, ideal, run.cgal_seconds)});
}

void run(const Gallery_arguments& a)
{
  const Domain domain(find_input(a.input()));
  const std::string& field = a.text("field");
  const double n = a.number("triangles") / ideal_share;
  if (field == "uniform")
    mesh(a, domain, weft::Uniform_sizing<>(domain.size_for(n)));
  else if (field == "linear")
    mesh(a, domain, linear_size(domain, a.number("growth"), n));
  else if (field == "lfs")
    mesh(a, domain, lfs_size(domain, n));
  else
    throw weft::Option_error("--field must be uniform, linear or lfs, not " + field);
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("gallery_planar", [=] {
    run({argc,
         argv,
         {{"output", ""}, {"triangles", "3000"}, {"field", "uniform"}, {"growth", "0.2"}, {"time-limit", "60"}}});
  });
}
