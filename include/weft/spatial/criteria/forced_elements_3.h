// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements whose shape the input forces: no refinement betters a cell that fills a wedge between two sheets of the
// boundary, or a facet between two creases that meet at a small angle (Tournois 2009, sec. 4.2.1.1). Shape criteria
// don't apply to them; they are counted apart.

#ifndef WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H
#define WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H

#include <weft/internal/Answers.h>
#include <weft/spatial/mesh/dihedral_angles_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
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

/// Below this angle in degrees creases force cells; from there on refinement ends with good shapes.
inline constexpr double largest_forcing_crease_angle = 30;

/// The smallest angle in degrees at which a crease that one vertex lies on meets one that another lies on; 180 if it
/// isn't below a largest one, or if one crease holds both.
template <class Oracle>
double angle_between_creases(const Oracle& oracle, const Feature_incidence_3& incidence, const Vertex_location_3& a,
                             const Vertex_location_3& b, double largest)
{
  double smallest = 180;
  if (a.dimension < 0 || a.dimension > 1 || b.dimension < 0 || b.dimension > 1) return smallest;
  bool share = false;
  const auto look = [&](int crease, const Vertex_location_3& other) {
    const auto holds = [&](int c) {
      return other.dimension == 1 ? other.index == c : incidence.corner_is_on_crease(other.index, c);
    };
    share = share || holds(crease);
    oracle.visit_creases_at_small_angles(crease, [&](int c, double angle) {
      if (holds(c) && angle * 180 < largest * CGAL_PI) smallest = (std::min)(smallest, angle * 180 / CGAL_PI);
    });
  };
  if (a.dimension == 1)
    look(a.index, b);
  else
    for (const int crease : incidence.creases_of_corner(a.index)) look(crease, b);
  return share ? 180 : smallest;
}

template <class Oracle>
using Creases_force_cells_of = decltype(std::declval<const Oracle&>().creases_force_cells());

/// Whether creases excuse cells: they do unless a domain says otherwise, whose creases may be given up.
template <class Oracle>
bool creases_force_cells(const Oracle& oracle)
{
  if constexpr (answers_v<bool, Creases_force_cells_of, Oracle>)
    return oracle.creases_force_cells();
  else
    return static_cast<void>(oracle), true;
}

/// The small angle of the input in degrees that forces the shape of a cell; 180 if there is none. Either its shortest
/// edge joins two creases that meet at the angle: near where they meet no cell with that edge is better (Miller, Pav
/// and Walkington, "When and why Delaunay refinement algorithms work", 2005, for edges in the plane). Or it would fill
/// the wedge at an acute edge: all its vertices lie on the boundary, and its circumscribed ball mixes up the sides of
/// the edge.
/// \param points of the cell.
template <class Oracle, class Point>
double forcing_angle(const Oracle& oracle, const Feature_incidence_3& incidence,
                     const std::array<Vertex_location_3, 4>& locations, const std::array<const Point*, 4>& points,
                     const Point& circumcenter, double largest_crease_angle = largest_forcing_crease_angle)
{
  if (!oracle.has_mirror_images()) return 180;
  std::array<std::size_t, 2> ends{{0, 1}};
  double shortest = HUGE_VAL;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double d = CGAL::to_double(CGAL::squared_distance(*points[i], *points[j]));
      if (!(d < shortest)) continue;
      shortest = d;
      ends = {{i, j}};
    }
  const double angle = creases_force_cells(oracle) ? angle_between_creases(oracle, incidence, locations[ends[0]],
                                                                           locations[ends[1]], largest_crease_angle)
                                                   : 180;
  for (const Vertex_location_3& at : locations)
    if (at.dimension > 2) return angle;
  const double radius = std::sqrt(CGAL::to_double(CGAL::squared_distance(circumcenter, *points[0])));
  return (std::min)(angle, static_cast<double>(oracle.acute_angle_at(circumcenter, radius)));
}

/// The same of a cell that has its circumcenter.
template <class Restricted>
double forcing_angle(const Restricted& mesh, typename Restricted::Cell_handle c,
                     double largest_crease_angle = largest_forcing_crease_angle)
{
  const auto at = [c](int i) { return c->vertex(i)->location(); };
  const auto point = [c](int i) { return &c->vertex(i)->point(); };
  return forcing_angle(mesh.oracle(), mesh.incidence(), {{at(0), at(1), at(2), at(3)}},
                       {{point(0), point(1), point(2), point(3)}}, c->circumcenter(), largest_crease_angle);
}

/// Whether a cell is next to flat. However small an angle of the input is, it forces no such cell.
inline bool is_flat(const Dihedral_cosines_3& angles)
{
  constexpr double cosine = -0.99985; // of 179 degrees
  return angles.largest < cosine;
}

/// Whether small angles of the input force the shape of a cell.
template <class Restricted>
bool is_forced(const Restricted& mesh, typename Restricted::Cell_handle c)
{
  return forcing_angle(mesh, c) < 180;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_FORCED_ELEMENTS_3_H
