// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a planar triangulation covers its hull once and is constrained Delaunay; exact.

#ifndef WEFT_PLANAR_CHECK_CHECK_DELAUNAY_2_H
#define WEFT_PLANAR_CHECK_CHECK_DELAUNAY_2_H

#include <weft/planar/check/Validity_2.h>

#include <CGAL/enum.h>

#include <cstddef>

namespace weft {

namespace internal {

/// The hull must turn left or go straight on at every vertex. Locally, one that winds around twice does so, too; but it
/// has two lexicographically smallest vertices.
template <class Cdt>
void check_hull(const Cdt& cdt, Validity_2& validity)
{
  std::size_t local_minima = 0;
  auto face = cdt.incident_faces(cdt.infinite_vertex());
  const auto done = face;
  do {
    // Counterclockwise along the hull: before, here, after.
    const int i = face->index(cdt.infinite_vertex());
    const auto next = face->neighbor(Cdt::cw(i));
    const auto &before = face->vertex(Cdt::cw(i))->point(), &here = face->vertex(Cdt::ccw(i))->point(),
               &after = next->vertex(Cdt::ccw(next->index(cdt.infinite_vertex())))->point();
    const auto turn = cdt.geom_traits().orientation_2_object()(before, here, after);
    const auto from = compare_xy(cdt, before, here), to = compare_xy(cdt, here, after);
    if (turn == CGAL::RIGHT_TURN || (turn == CGAL::COLLINEAR && from != to))
      validity.add(Fault_kind::orientation, "the convex hull isn't convex", {xy(here)});
    local_minima += from == CGAL::LARGER && to == CGAL::SMALLER;
  } while (++face != done);
  if (local_minima != 1)
    validity.add(Fault_kind::orientation, "the convex hull doesn't wind around the triangulation once");
}

} // namespace internal

/// Checks that all finite faces are counterclockwise, and that the hull is convex and winds around them once; so no two
/// faces overlap. Exact, linear time. The structure must be sound.
template <class Cdt>
Validity_2 check_orientation_2(const Cdt& cdt)
{
  Validity_2 validity;
  const auto orientation = cdt.geom_traits().orientation_2_object();
  for (const auto face : cdt.finite_face_handles())
    if (orientation(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point()) != CGAL::LEFT_TURN)
      validity.add(Fault_kind::orientation, "a face is turned over or flat", internal::corners(cdt, face));
  internal::check_hull(cdt, validity);
  return validity;
}

/// Checks that no unconstrained edge has the corner across it inside of the circle through a face beside it. Exact,
/// linear time. Structure and orientation must be sound.
template <class Cdt>
Validity_2 check_delaunay_2(const Cdt& cdt)
{
  Validity_2 validity;
  const auto side = cdt.geom_traits().side_of_oriented_circle_2_object();
  for (auto edge = cdt.finite_edges_begin(); edge != cdt.finite_edges_end(); ++edge) {
    const auto face = edge->first, neighbor = face->neighbor(edge->second);
    if (face->is_constrained(edge->second) || cdt.is_infinite(face) || cdt.is_infinite(neighbor)) continue;
    const auto& across = neighbor->vertex(neighbor->index(face))->point();
    if (side(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(), across) ==
        CGAL::ON_POSITIVE_SIDE)
      validity.add(Fault_kind::delaunay, "an edge isn't locally Delaunay", internal::ends(cdt, face, edge->second));
  }
  return validity;
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_CHECK_DELAUNAY_2_H
