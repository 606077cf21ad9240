// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a tetrahedral mesh meets criteria (Tournois 2009, sec. 3.2.1.2) and whether its vertices lie where they say:
// on their patch or crease up to rounding, on their feature vertex exactly.

#ifndef WEFT_SPATIAL_CRITERIA_CHECK_CRITERIA_3_H
#define WEFT_SPATIAL_CRITERIA_CHECK_CRITERIA_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/forced_elements_3.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/mesh/quality_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/mesh/Validity_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace weft {
namespace internal {

/// Criteria hold up to this factor: the mesher and the checker round differently.
constexpr double criterion_tolerance = 1 + 1e-9;
/// The same for ratios with circumradii, which lose more digits in flat elements.
constexpr double shape_tolerance = 1 + 1e-5;

/// The edges of all cells, each once.
inline std::vector<std::array<std::size_t, 2>> edges_of(const std::vector<std::array<std::size_t, 4>>& cells)
{
  std::vector<std::array<std::size_t, 2>> edges;
  edges.reserve(6 * cells.size());
  for (const auto& cell : cells)
    for (const auto& edge : Cell_measures_3::edges) edges.push_back(sorted<2>({cell[edge[0]], cell[edge[1]]}));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

template <class Point>
double distance(const Point& p, const Point& q)
{
  const Xyz_3 d = minus(xyz(p), xyz(q));
  return std::hypot(d[0], d[1], d[2]);
}

/// Largest absolute coordinate: what coordinates are rounded relative to.
template <class Points>
double largest_coordinate_3(const Points& points)
{
  double largest = 0;
  for (const auto& p : points)
    for (const double x : xyz(p)) largest = (std::max)(largest, std::abs(x));
  return largest;
}

} // namespace internal

/// Checks that no edge of a cell is longer than the size at its midpoint. O(n log n) time, one evaluation of the field
/// an edge.
template <class K>
Validity_3 check_sizes_3(const Tetrahedral_mesh_3<K>& mesh, const Length_field_3<K>& size)
{
  Validity_3 validity;
  const typename K::Construct_midpoint_3 midpoint{};
  for (const auto& edge : internal::edges_of(mesh.cells)) {
    const auto &p = mesh.points[edge[0]], &q = mesh.points[edge[1]];
    const double ratio = internal::distance(p, q) / size(midpoint(p, q));
    if (!(ratio <= internal::criterion_tolerance)) // so that NaN is a fault
      validity.add(Fault_kind_3::size, "an edge is " + std::to_string(ratio) + " times as long as it may be",
                   {edge[0], edge[1]});
  }
  return validity;
}

namespace internal {

/// Checks shapes of the elements that a predicate doesn't exempt.
/// \param is_exempt `is_exempt(facet)` and `is_exempt(cell)`, arrays of vertices.
template <class K, class Is_exempt>
Validity_3 check_shapes_but(const Tetrahedral_mesh_3<K>& mesh, double facet_shape, double cell_shape,
                            const Is_exempt& is_exempt)
{
  Validity_3 validity;
  const auto judge = [&](double ratio, double bound, const char* what, const auto& element) {
    if (!(ratio <= bound * shape_tolerance) && !is_exempt(element))
      validity.add(Fault_kind_3::shape, what + (" has circumradius / shortest edge " + std::to_string(ratio)),
                   {element.begin(), element.end()});
  };
  if (facet_shape > 0)
    for (const auto& facet : mesh.facets)
      judge(Facet_measures_3(Scaled_simplex_3<3>(mesh.points, facet)).ratio, facet_shape, "a facet", facet);
  if (cell_shape > 0)
    for (const auto& cell : mesh.cells) {
      const Scaled_simplex_3<4> simplex(mesh.points, cell);
      const Cell_measures_3 measures(simplex);
      judge(radius_edge_ratio<K>(mesh.points, cell, simplex, measures), cell_shape, "a cell", cell);
    }
  return validity;
}

/// Whether the shape of an element is forced by small angles of a domain.
template <class K, class Oracle>
class Is_forced_3
{
public:
  Is_forced_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, double facet_shape)
      : mesh_(mesh), oracle_(oracle), incidence_(oracle.incidence()), facet_shape_(facet_shape)
  {}

  bool operator()(const std::array<std::size_t, 3>& facet) const
  {
    return oracle_.has_mirror_images() &&
           is_between_creases(oracle_, incidence_,
                              {{mesh_.locations[facet[0]], mesh_.locations[facet[1]], mesh_.locations[facet[2]]}},
                              2 * std::asin(0.5 / facet_shape_));
  }

  bool operator()(const std::array<std::size_t, 4>& cell) const
  {
    const auto at = [&](std::size_t i) -> const typename K::Point_3& { return mesh_.points[cell[i]]; };
    return forcing_angle(oracle_, incidence_,
                         {{mesh_.locations[cell[0]], mesh_.locations[cell[1]], mesh_.locations[cell[2]],
                           mesh_.locations[cell[3]]}},
                         {{&at(0), &at(1), &at(2), &at(3)}}, circumcenter_3<K>(at(0), at(1), at(2), at(3))) < 180;
  }

private:
  const Tetrahedral_mesh_3<K>& mesh_;
  const Oracle& oracle_;
  Feature_incidence_3 incidence_;
  double facet_shape_;
};

} // namespace internal

/// Checks the ratios of circumradius to shortest edge.
/// \param facet_shape,cell_shape largest ratio of boundary facets and of cells; 0: no bound.
template <class K>
Validity_3 check_shapes_3(const Tetrahedral_mesh_3<K>& mesh, double facet_shape, double cell_shape)
{
  return internal::check_shapes_but(mesh, facet_shape, cell_shape, [](const auto&) { return false; });
}

/// The same but for elements whose shape small angles of a domain force, see `Mesh_report_3::forced_cells`.
template <class K, class Oracle>
Validity_3 check_shapes_3(const Tetrahedral_mesh_3<K>& mesh, double facet_shape, double cell_shape,
                          const Oracle& oracle)
{
  return internal::check_shapes_but(mesh, facet_shape, cell_shape,
                                    internal::Is_forced_3<K, Oracle>(mesh, oracle, facet_shape));
}

/// Checks that the vertices of a facet lie on its patch, on creases or on feature vertices.
template <class K>
Validity_3 check_topology_3(const Tetrahedral_mesh_3<K>& mesh)
{
  Validity_3 validity;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const std::size_t v : mesh.facets[f]) {
      const auto& location = mesh.locations[v];
      if (location.dimension < 2 || (location.dimension == 2 && location.index == mesh.patches[f])) continue;
      const auto& facet = mesh.facets[f];
      validity.add(Fault_kind_3::topology, "a facet has a vertex off its patch", {facet[0], facet[1], facet[2]});
      break;
    }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const std::size_t v : mesh.edges[e]) {
      const auto& location = mesh.locations[v];
      if (location.dimension == 0 || (location.dimension == 1 && location.index == mesh.creases[e])) continue;
      validity.add(Fault_kind_3::topology, "a crease edge has an end off its crease",
                   {mesh.edges[e][0], mesh.edges[e][1]});
      break;
    }
  return validity;
}

namespace internal {

/// Checks size, shapes of the elements that a predicate doesn't exempt and, if asked for, topology.
template <class K, class Is_exempt>
Validity_3 check_criteria_but(const Tetrahedral_mesh_3<K>& mesh, const Criteria_3<K>& criteria,
                              const Is_exempt& is_exempt)
{
  Validity_3 validity = check_sizes_3(mesh, criteria.size);
  validity += check_shapes_but(mesh, criteria.facet_shape, criteria.cell_shape, is_exempt);
  if (criteria.topology) validity += check_topology_3(mesh);
  return validity;
}

} // namespace internal

/// Checks size, shapes and, if asked for, topology. The approximation needs the surface: see `hausdorff_3()`. Whether
/// the boundary is a manifold tells `check_manifold_3()` of validate_3.h.
/// \throws Option_error if the size field returns anything but a positive finite number.
template <class K>
Validity_3 check_criteria_3(const Tetrahedral_mesh_3<K>& mesh, const Criteria_3<K>& criteria)
{
  return internal::check_criteria_but(mesh, criteria, [](const auto&) { return false; });
}

/// The same but for shapes that small angles of the domain force.
/// \tparam Oracle a domain oracle.
template <class K, class Oracle>
Validity_3 check_criteria_3(const Tetrahedral_mesh_3<K>& mesh, const Criteria_3<K>& criteria, const Oracle& oracle)
{
  return internal::check_criteria_but(mesh, criteria,
                                      internal::Is_forced_3<K, Oracle>(mesh, oracle, criteria.facet_shape));
}

/// Checks that every vertex on a patch or crease lies within a tolerance of its projection to it.
/// \tparam Oracle has `project_on_patch(p, patch).point` and `project_on_crease(p, crease)`.
/// \param tolerance in the input's units; 0: 1e-10 of the largest coordinate, what rounding can do to intersections
///   and projections.
template <class K, class Oracle>
Validity_3 check_distances_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, double tolerance = 0)
{
  Validity_3 validity;
  if (tolerance == 0) tolerance = 1e-10 * internal::largest_coordinate_3(mesh.points);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto& location = mesh.locations[v];
    if (location.dimension != 1 && location.dimension != 2) continue;
    const auto& p = mesh.points[v];
    const double off = location.dimension == 1
                           ? internal::distance(p, oracle.project_on_crease(p, location.index))
                           : internal::distance(p, oracle.project_on_patch(p, location.index).point);
    if (off <= tolerance) continue;
    std::ostringstream what; // numbers of any size
    what << "a vertex is off its " << (location.dimension == 1 ? "crease " : "patch ") << location.index << " by "
         << off << ", the tolerance is " << tolerance;
    validity.add(Fault_kind_3::distance, what.str(), {v});
  }
  return validity;
}

/// Checks that every feature vertex of the domain is a vertex of the mesh with exactly its coordinates.
template <class K>
Validity_3 check_features_3(const Tetrahedral_mesh_3<K>& mesh, const Piecewise_smooth_complex_3<K>& complex)
{
  Validity_3 validity;
  std::vector<char> found(complex.features.size(), 0);
  for (const std::size_t v : mesh.corners) {
    const auto i = static_cast<std::size_t>(mesh.locations[v].index);
    if (i < found.size() && mesh.points[v] == complex.points[complex.features[i].vertex])
      found[i] = 1;
    else
      validity.add(Fault_kind_3::distance, "a corner isn't at its feature vertex", {v});
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!found[i])
      validity.add(Fault_kind_3::location, "feature vertex " + std::to_string(i) + " of the domain is missing");
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_CRITERIA_CHECK_CRITERIA_3_H
