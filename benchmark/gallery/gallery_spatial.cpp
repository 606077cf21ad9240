// SPDX-License-Identifier: GPL-3.0-or-later
//
// One spatial model of the gallery (doc/gallery.md): its meshes by weft and by CGAL with the same bounds, and their
// figures.
//
//   gallery_spatial INPUT --output PREFIX [--size L] [--approximation E] [--sharp-angle DEG] [--push SECONDS]
//                   [--time-limit SECONDS]
//
// INPUT is sphere, nested spheres, cylinder, three materials, or a file of a surface or of a labelled image (.inr).
// Lengths are in parts of the longest side: surfaces are scaled to 1, L and E of the others are scaled instead.
// Writes PREFIX_weft.mesh, PREFIX_cgal.mesh and PREFIX.json. --push: besides weft's default run, one that goes on
// perturbing slivers for so long. The time limit is that of CGAL's perturbation and of weft, 120 unless given.

#include "gallery_domains.h"
#include "gallery_program.h"

#include <weft/IO/read_label_image.h>
#include <weft/spatial/domain/Label_image_3.h>

#include <algorithm>
#include <string>

using namespace benchmark;

namespace {

Labels three_materials()
{
  const auto label = [](const Spatial_kernel::Point_3& p) {
    if (p.x() * p.x() + p.y() * p.y() + p.z() * p.z() > 1) return 0;
    return p.x() < 0.2 ? 1 : p.y() < 0 ? 2 : 3;
  };
  return {label, {-1.1, -1.1, -1.1, 1.1, 1.1, 1.1}, 4, 40, 2, 0};
}

Labels image(const std::string& filename)
{
  const weft::Label_image_3 image = weft::IO::read_label_image(filename);
  const CGAL::Bbox_3 box = image.bbox();
  const double voxel = *std::max_element(image.spacing().begin(), image.spacing().end());
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  return {image, box, image.number_of_labels(), 160, longest, voxel};
}

void run(const Gallery_arguments& a)
{
  const std::string& name = a.input();
  const double sharp_angle = a.number("sharp-angle");
  if (name == "three materials")
    mesh_labels(a, three_materials());
  else if (weft::IO::is_label_image_filename(name))
    mesh_labels(a, image(name));
  else if (name == "sphere")
    mesh_surface(a, make_input(name, unit_sphere(5), sharp_angle));
  else if (name == "nested spheres")
    mesh_surface(a, make_input(name, nested_spheres(5), sharp_angle));
  else if (name == "cylinder")
    mesh_surface(a, make_input(name, cylinder(96), sharp_angle));
  else
    mesh_surface(a, read_input(name, sharp_angle));
}

} // namespace

int main(int argc, char** argv)
{
  return run_program("gallery_spatial", [=] {
    run({argc,
         argv,
         {{"output", ""},
          {"size", "0.1"},
          {"approximation", "0.001"},
          {"sharp-angle", "0"},
          {"push", "0"},
          {"time-limit", "120"}}});
  });
}
