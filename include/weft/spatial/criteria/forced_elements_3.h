// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements whose shape the input forces: no refinement betters a cell that fills a wedge between two sheets of the
// boundary, or a facet between two creases that meet at a small angle (Tournois 2009, sec. 4.2.1.1). Shape criteria
// don't apply to them; they are counted apart.

#ifndef WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H
#define WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Whether all vertices of a facet lie on two creases that meet at less than an angle.
/// \param largest_angle in radians.
template <class Oracle>
bool is_between_creases(const Oracle& oracle, const Feature_incidence_3& incidence,
                        const std::array<Vertex_location_3, 3>& locations, double largest_angle)
{
  for (const Vertex_location_3& at : locations)
    if (at.dimension > 1 || at.dimension < 0) return false;
  const auto lies_on = [&](const Vertex_location_3& at, int crease) {
    return at.dimension == 1 ? at.index == crease : incidence.corner_is_on_crease(at.index, crease);
  };
  const auto is_between = [&](int crease) {
    bool found = false;
    oracle.visit_creases_at_small_angles(crease, [&](int other, double angle) {
      if (found || !(angle < largest_angle)) return;
      found = true;
      for (const Vertex_location_3& at : locations) found = found && (lies_on(at, crease) || lies_on(at, other));
    });
    return found;
  };
  const Vertex_location_3& first = locations[0];
  if (first.dimension == 1) return is_between(first.index);
  for (const int crease : incidence.creases_of_corner(first.index))
    if (is_between(crease)) return true;
  return false;
}

/// Whether the boundary forces the shape of a facet that would be too slender.
/// \param largest_ratio of circumradius to shortest edge.
template <class Restricted>
bool is_forced(const Restricted& mesh, const typename Restricted::Restricted_facet& f, double largest_ratio)
{
  if (!mesh.oracle().has_mirror_images()) return false;
  const auto at = [&f](int i) { return f.cell->vertex((f.index + i) % 4)->location(); };
  return is_between_creases(mesh.oracle(), mesh.incidence(), {{at(1), at(2), at(3)}},
                            2 * std::asin(0.5 / largest_ratio));
}

/// The angle in degrees of the acute edge whose wedge a cell would fill: all its vertices lie on the boundary, and its
/// circumscribed ball mixes up the sides of the edge. 180 if there is no such edge.
template <class Oracle, class Point>
double forcing_angle(const Oracle& oracle, const std::array<Vertex_location_3, 4>& locations, const Point& circumcenter,
                     const Point& vertex)
{
  if (!oracle.has_mirror_images()) return 180;
  for (const Vertex_location_3& at : locations)
    if (at.dimension > 2) return 180;
  return oracle.acute_angle_at(circumcenter, std::sqrt(CGAL::to_double(CGAL::squared_distance(circumcenter, vertex))));
}

/// Whether a cell fills the wedge at an acute edge.
template <class Restricted>
bool is_forced(const Restricted& mesh, typename Restricted::Cell_handle c)
{
  if (!mesh.oracle().has_mirror_images()) return false;
  for (int i = 0; i < 4; ++i)
    if (c->vertex(i)->location().dimension > 2) return false;
  const double squared_radius = CGAL::to_double(CGAL::squared_distance(c->circumcenter(), c->vertex(0)->point()));
  return mesh.oracle().is_at_acute_edge(c->circumcenter(), std::sqrt(squared_radius));
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H
