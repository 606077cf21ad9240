// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concepts of functions: sizing fields, demands and visitors, as classes with just the members they require. Part
// of the manual, not of the library; archetypes_test makes meshes with them.

#ifndef WEFT_DOC_SIZING_FIELD_H
#define WEFT_DOC_SIZING_FIELD_H

#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/visitor.h>

#include <utility>

namespace concepts {

/// How long edges may be, by place. Functions and lambdas are models.
///
/// In the plane it is taken by reference, called for the centroids of triangles, the middles of constrained edges and
/// points of Voronoi cells, and by several threads if `Mesh_options_2::threads` says so. In space it is copied into
/// weft::Length_field_3, is called for middles of edges, and stands for any length that may depend on the place, such
/// as Criteria_3::approximation.
///
/// Models: weft::Uniform_sizing; in the plane weft::Lfs_sizing_2, weft::Lipschitz_sizing_2, weft::Background_sizing_2,
/// weft::Cached_sizing_2 and weft::Grid_sizing; in space weft::Lipschitz_sizing_3, weft::Feature_sizing_3,
/// weft::Background_sizing_3 and weft::Grid_sizing. In space one thread asks, in the plane all of them do.
/// \tparam Point of the kernel of the mesh.
/// \tparam Model what this archetype passes everything on to; no part of the concept.
/// \ingroup concept_classes
template <class Point, class Model>
class SizingField
{
public:
  explicit SizingField(Model model) : model_(std::move(model)) {}
  SizingField(const SizingField&) = default; ///< in space alone
  SizingField& operator=(const SizingField&) = delete;

  /// The longest edge at a point, in the input's units: a positive finite number, the same each time. For anything else
  /// meshers throw weft::Option_error.
  double operator()(const Point& p) const { return model_(p); }

private:
  Model model_;
};

/// A demand on boundary facets, for Criteria_3::facet_demand, or on cells, for Criteria_3::cell_demand. Copied; called
/// by one thread, often for the same element. examples/custom_criterion.h is one.
///
/// A view has pointers to points, of the kernel of the mesh, and what is known of them. weft::Cell_view_3 has the four
/// `points` of a cell, as a std::array of pointers, the weft::Vertex_location_3 of each in `locations` (`dimension` 0
/// on a corner, 1 on a crease, 2 on a patch, 3 inside, and `index`, the number of that corner, crease, patch or
/// subdomain), a pointer to its `circumcenter`, and its `subdomain`. weft::Facet_view_3 has three points and locations,
/// a pointer to the `center` of its surface Delaunay ball, and its `patch`. Pointers hold during the call alone.
/// \tparam View weft::Facet_view_3 or weft::Cell_view_3.
/// \tparam Model what this archetype passes everything on to; no part of the concept.
/// \ingroup concept_classes
template <class View, class Model>
class ElementDemand_3
{
public:
  explicit ElementDemand_3(Model model) : model_(std::move(model)) {}
  ElementDemand_3(const ElementDemand_3&) = default;
  ElementDemand_3& operator=(const ElementDemand_3&) = delete;

  /// How bad an element is: above 1 if it has to be refined, the worst first. Small enough elements must have at most
  /// 1, otherwise the run ends at the size floor. The points of `element` are pointers that are valid during the call.
  double operator()(const View& element) const { return model_(element); }

private:
  Model model_;
};

/// A function that is called during a run, for the `visitor` of all options. Copied; called between steps by the thread
/// that called the mesher. `std::ref(visitor)` keeps its state where it is.
/// \tparam Model what this archetype passes everything on to; no part of the concept.
/// \ingroup concept_classes
template <class Model>
class MeshVisitor
{
public:
  explicit MeshVisitor(Model model) : model_(std::move(model)) {}
  MeshVisitor(const MeshVisitor&) = default;
  MeshVisitor& operator=(const MeshVisitor&) = delete;

  /// Whether to go on. After `false` the run ends, with a valid mesh, as Stop_reason::cancelled.
  bool operator()(const weft::Progress& progress) { return model_(progress); }

private:
  Model model_;
};

} // namespace concepts

#endif // WEFT_DOC_SIZING_FIELD_H
