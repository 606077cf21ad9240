// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh that somebody else made, as the restricted Delaunay triangulation that coarsen_3(), smooth_3(),
// perturb_slivers_3() and optimise_3() work on.

#ifndef WEFT_SPATIAL_RUN_DELAUNAY_MESH_3_H
#define WEFT_SPATIAL_RUN_DELAUNAY_MESH_3_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/assemble_mesh_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>
#include <weft/spatial/run/Boundary_sizing_3.h>
#include <weft/spatial/run/improve_sliding_3.h>
#include <weft/spatial/run/Initial_vertices_3.h>
#include <weft/spatial/run/Mesh_boundary_3.h>
#include <weft/spatial/run/Spatial_mesher_3.h>

#include <cstddef>
#include <optional>
#include <utility>

namespace weft {

/// A Delaunay mesh of the domain that a mesh bounds, with the vertices of that mesh. Where those don't make a Delaunay
/// mesh of the domain, refinement adds some, and leaves out interior ones that are in the way.
///
///     weft::Delaunay_mesh_3<K> delaunay(mesh);
///     weft::smooth_3(delaunay.restricted(), delaunay.criteria());
///     const auto smoothed = delaunay.mesh();
/// \tparam K a CGAL kernel with exact predicates, whose coordinates are doubles.
template <class K>
class Delaunay_mesh_3
{
public:
  using Oracle = Polyhedral_oracle_3<K>;
  using Restricted = Restricted_delaunay_3<Oracle>;

  /// \param options which edges are sharp, how far the boundary may get from that of the mesh, which vertices stay, and
  ///        the budget; what improves meshes doesn't count.
  /// \throws Option_error for options out of range; Domain_error if the boundary of a subdomain isn't a closed surface
  ///         without self-intersections.
  explicit Delaunay_mesh_3(Tetrahedral_mesh_3<K> mesh, const Improve_options_3& options = Improve_options_3())
      : given_((options.check(), std::move(mesh))),
        boundary_(given_, internal::features_of_mesh(given_, options)),
        sizing_(boundary_.complex().points, boundary_.complex().triangles),
        oracle_(boundary_.complex()),
        criteria_(internal::criteria_of_mesh(given_, sizing_, options))
  {
    internal::Initial_vertices_3<K> initial{
        given_.points, boundary_.locations(), options.fixed_vertices, false, 0, 0, 1};
    initial.spacings = internal::mean_edges_of_vertices(given_);
    Mesh_options_3 meshing = Mesh_options_3::refinement();
    meshing.lattice = false;
    meshing.size_floor = 0.1 * sizing_.shortest_edge();
    meshing.max_vertices = options.max_vertices;
    meshing.time_limit = options.time_limit;
    meshing.seed = options.seed;
    meshing.threads = options.threads;
    meshing.visitor = options.visitor;
    internal::Spatial_mesher_3<Oracle> mesher(oracle_, criteria_, meshing, initial);
    mesher.meet_criteria();
    report_ = mesher.report();
    restricted_.emplace(mesher.take_mesh());
  }

  /// The same of points, cells and labels, which `assemble_mesh_3()` makes a mesh: all that is needed of a mesh in
  /// arrays of one's own.
  /// \throws as above, and as `assemble_mesh_3()` does.
  explicit Delaunay_mesh_3(Element_soup_3<K> soup, const Improve_options_3& options = Improve_options_3())
      : Delaunay_mesh_3(assemble_mesh_3(std::move(soup)).mesh, options)
  {}

  Delaunay_mesh_3(const Delaunay_mesh_3&) = delete; // its parts know each other
  Delaunay_mesh_3& operator=(const Delaunay_mesh_3&) = delete;

  /// What optimisers take.
  Restricted& restricted() { return *restricted_; }
  const Restricted& restricted() const { return *restricted_; }

  /// What the mesh was held to, in the units of its points: loose sizes, shapes that leave out the worst alone, and a
  /// boundary as near to that of the given mesh as `deviation` asks for.
  const Criteria_3<K>& criteria() const { return criteria_; }

  /// Of the conversion: `bad()` elements are what couldn't be made to represent the boundary.
  const Mesh_report_3& report() const { return report_; }

  /// The mesh as it is now, with the tags of the given one.
  Tetrahedral_mesh_3<K> mesh() const
  {
    Tetrahedral_mesh_3<K> result = tetrahedral_mesh(*restricted_);
    boundary_.restore_names(sizing_, result);
    return result;
  }

private:
  Tetrahedral_mesh_3<K> given_;
  internal::Mesh_boundary_3<K> boundary_;
  internal::Boundary_sizing_3<K> sizing_;
  Oracle oracle_;
  Criteria_3<K> criteria_;
  Mesh_report_3 report_;
  std::optional<Restricted> restricted_;
};

} // namespace weft

#endif // WEFT_SPATIAL_RUN_DELAUNAY_MESH_3_H
