// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes of one spatial model of the gallery by weft and by CGAL, and their figures.

#ifndef WEFT_BENCHMARK_GALLERY_GALLERY_MESHES_H
#define WEFT_BENCHMARK_GALLERY_GALLERY_MESHES_H

#include "../common/user_time.h"
#include "../spatial/spatial_inputs.h"
#include "../spatial/spatial_peers.h"
#include "gallery_program.h"

#include <weft/IO/write_medit_3.h>
#include <weft/make_mesh_3.h>
#include <weft/spatial/cgal/from_c3t3.h>
#include <weft/spatial/mesh/hausdorff_3.h>
#include <weft/spatial/mesh/quality_3.h>

#include <CGAL/exude_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <string>
#include <vector>

namespace benchmark {

using Mesh = weft::Tetrahedral_mesh_3<Spatial_kernel>;
using Point_3 = Spatial_kernel::Point_3;
using Criteria = weft::Criteria_3<Spatial_kernel>;

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

inline Bounds bounds_of(const Gallery_arguments& a, double longest)
{
  return {a.number("size") * longest, a.number("approximation") * longest, 2};
}

inline Criteria criteria_of(const Bounds& bounds)
{
  Criteria criteria;
  criteria.size = bounds.size;
  criteria.approximation = bounds.approximation;
  criteria.facet_shape = criteria.cell_shape = bounds.shape;
  return criteria;
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_GALLERY_GALLERY_MESHES_H
