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

#include "../common/user_time.h"
#include "../optimisation/optimisation_peers.h"
#include "../spatial/spatial_inputs.h"
#include "../spatial/spatial_peers.h"
#include "gallery_program.h"

#include <weft/errors.h>
#include <weft/IO/read_label_image.h>
#include <weft/IO/write_medit_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/cgal/from_c3t3.h>
#include <weft/spatial/domain/Label_image_3.h>
#include <weft/spatial/domain/Labelled_oracle_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>

#include <CGAL/Labeled_mesh_domain_3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace benchmark;

namespace {

using Mesh = weft::Tetrahedral_mesh_3<Spatial_kernel>;
using Point_3 = Spatial_kernel::Point_3;
using Criteria = weft::Criteria_3<Spatial_kernel>;

// ---- Domains given by labels

struct Labels
{
  std::function<int(const Point_3&)> labelling;
  CGAL::Bbox_3 box;
  int number;     ///< including 0, the outside
  int seed_grid;  ///< see weft::Labelled_oracle_3
  double longest; ///< side of the domain
  double detail;  ///< size of the smallest details that count
};

Labels three_materials()
{
  const auto label = [](const Point_3& p) {
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

// ---- Figures

/// What is known of a run besides its mesh.
struct Gallery_run
{
  std::string mesher;
  double seconds;
  bool criteria_hold = true; ///< of weft, by its report
};

class Gallery
{
public:
  Gallery(const Gallery_arguments& arguments, const Bounds& bounds) : arguments_(arguments), bounds_(bounds) {}

  /// For distances to the surface; not called for labels.
  void set_surface(const Complex& complex) { surface_ = &complex; }

  void add(const Gallery_run& run, const Mesh& mesh)
  {
    const weft::Quality_3 quality = weft::measure_quality_3(mesh);
    Json_object row;
    row.add("mesher", run.mesher)
        .add("vertices", static_cast<double>(quality.vertices))
        .add("elements", static_cast<double>(quality.cells))
        .add("smallest_angle", quality.smallest_dihedral.degrees)
        .add("largest_angle", quality.largest_dihedral.degrees)
        .add("mean_smallest_angle", quality.mean_smallest_dihedral)
        .add("longest_edge_over_size", quality.longest_edge / bounds_.size)
        .add("seconds", run.seconds)
        .add_raw("criteria_hold", run.criteria_hold ? "true" : "false")
        .add_raw("angles", counts_json(quality.dihedrals))
        .add_raw("smallest_angles", counts_json(quality.smallest_dihedrals));
    if (surface_) {
      const double distance = weft::hausdorff_3(mesh, surface_->points, surface_->triangles).two_sided();
      row.add(bounds_.approximation > 0 ? "distance_over_approximation" : "distance_over_size",
              distance / (bounds_.approximation > 0 ? bounds_.approximation : bounds_.size));
    }
    rows_.push_back(row.str());
  }

  void write(const std::string& mesher, const Mesh& mesh) const
  {
    weft::IO::write_medit(arguments_.text("output") + "_" + mesher + ".mesh", mesh);
  }

  void write_figures(int subdomains) const
  {
    write_gallery_json(arguments_.text("output"),
                       Json_object()
                           .add("cgal_version", CGAL_VERSION_STR)
                           .add("size", arguments_.number("size"))
                           .add("approximation", arguments_.number("approximation"))
                           .add("sharp_angle", arguments_.number("sharp-angle"))
                           .add("push_seconds", arguments_.number("push"))
                           .add("subdomains", subdomains),
                       rows_);
  }

private:
  const Gallery_arguments& arguments_;
  Bounds bounds_;
  const Complex* surface_ = nullptr;
  std::vector<std::string> rows_;
};

// ---- Meshers

template <class Oracle>
void add_weft(const Oracle& oracle, const Criteria& criteria, weft::Mesh_options_3 options, const std::string& mesher,
              Gallery& gallery, bool write)
{
  const Stopwatch watch;
  const auto result = weft::make_mesh_3(oracle, criteria, options);
  const Gallery_run run{mesher, watch.seconds(), result.report.bad() == 0};
  const Mesh mesh = weft::tetrahedral_mesh(result.restricted);
  gallery.add(run, mesh);
  if (write) gallery.write("weft", mesh);
}

template <class Oracle>
void add_weft(const Oracle& oracle, const Criteria& criteria, double detail, const Gallery_arguments& a,
              Gallery& gallery)
{
  weft::Mesh_options_3 options;
  options.size_floor = 0.3 * detail;
  options.time_limit = a.number("time-limit");
  add_weft(oracle, criteria, options, "weft", gallery, true);
  if (a.number("push") == 0) return;
  options.min_dihedral_angle = 90;
  options.time_limit = a.number("push");
  add_weft(oracle, criteria, options, "weft, pushed", gallery, false);
}

/// make_mesh_3() of CGAL with its defaults, step by step: refinement, perturbation, exudation.
template <class C3t3, class Domain, class Cgal_criteria>
void add_cgal(const Domain& domain, const Cgal_criteria& criteria, const Gallery_arguments& a, Gallery& gallery)
{
  namespace with = CGAL::parameters;
  Stopwatch watch;
  C3t3 complex = CGAL::make_mesh_3<C3t3>(domain, criteria, with::no_perturb(), with::no_exude());
  watch.pause([&] { gallery.add({"CGAL, refined", watch.seconds()}, weft::from_c3t3(complex).mesh); });
  CGAL::perturb_mesh_3(complex, domain, with::time_limit = a.number("time-limit"));
  CGAL::exude_mesh_3(complex, with::time_limit = a.number("time-limit"));
  const double seconds = watch.seconds();
  const Mesh mesh = weft::from_c3t3(complex).mesh;
  gallery.add({"CGAL", seconds}, mesh);
  gallery.write("cgal", mesh);
}

// ---- The two kinds of domains

Bounds bounds_of(const Gallery_arguments& a, double longest)
{
  return {a.number("size") * longest, a.number("approximation") * longest, 2};
}

Criteria criteria_of(const Bounds& bounds)
{
  Criteria criteria;
  criteria.size = bounds.size;
  criteria.approximation = bounds.approximation;
  criteria.facet_shape = criteria.cell_shape = bounds.shape;
  return criteria;
}

void mesh_labels(const Gallery_arguments& a, const Labels& labels)
{
  using Domain = CGAL::Labeled_mesh_domain_3<Spatial_kernel>;
  using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
  using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
  const Bounds bounds = bounds_of(a, labels.longest);
  Gallery gallery(a, bounds);
  const weft::Labelled_oracle_3<Spatial_kernel, std::function<int(const Point_3&)>> oracle(
      labels.labelling, labels.box, labels.number, labels.seed_grid);
  add_weft(oracle, criteria_of(bounds), labels.detail, a, gallery);
  const Domain domain(labels.labelling, labels.box);
  add_cgal<C3t3>(domain, cgal_criteria<Triangulation>(bounds, bounds.size), a, gallery);
  gallery.write_figures(labels.number - 1);
}

void mesh_surface(const Gallery_arguments& a, const Spatial_input& input)
{
  const Bounds bounds = bounds_of(a, 1);
  Gallery gallery(a, bounds);
  gallery.set_surface(input.complex);
  Criteria criteria = criteria_of(bounds);
  criteria.topology = input.is_creased();
  add_weft(weft::Polyhedral_oracle_3<Spatial_kernel>(input.complex), criteria, 0, a, gallery);
  const Cgal_polyhedron surface = polyhedron(input.complex);
  Cgal_domain domain(surface);
  if (input.is_creased()) domain.detect_features(input.sharp_angle);
  add_cgal<Cgal_complex>(domain, cgal_criteria(bounds, bounds.size), a, gallery);
  gallery.write_figures(1);
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
