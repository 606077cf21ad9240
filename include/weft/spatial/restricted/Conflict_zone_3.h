// SPDX-License-Identifier: GPL-3.0-or-later
//
// The conflict zone of a point in a spatial Delaunay triangulation: the cells whose circumsphere contains it, found
// before anything is inserted, so that a batch of Steiner points can be chosen whose zones don't touch (independent
// sets, Tournois 2009, sec. 3.2.1.4) and then be inserted without looking for anything again.

#ifndef WEFT_SPATIAL_RESTRICTED_CONFLICT_ZONE_3_H
#define WEFT_SPATIAL_RESTRICTED_CONFLICT_ZONE_3_H

#include <weft/spatial/restricted/Handle_marks.h>

#include <CGAL/enum.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// The cells in conflict with a point, and the facets around them.
template <class Triangulation>
struct Conflict_zone_3
{
  using Cell_handle = typename Triangulation::Cell_handle;
  using Facet = typename Triangulation::Facet;

  typename Triangulation::Point point;
  std::vector<Cell_handle> cells;
  std::vector<Facet> hull; ///< facets of the zone's boundary, seen from the cells outside of it

  void clear()
  {
    cells.clear();
    hull.clear();
  }
};

/// What became of looking for a conflict zone.
enum class Zone_result
{
  found,
  claimed,     ///< the zone touches one that the batch holds already
  no_conflict, ///< the start isn't in conflict: the point is a vertex already, or was rounded out of its zone
  infinite     ///< the point lies outside the hull
};

constexpr int no_batch = -2; ///< that no cell has: those without one have -1

/// Finds the conflict zone of `point`, given a cell in conflict with it.
///
/// Gives up at the first cell whose `batch()` is `batch`. Zones are independent, which is to say that inserting one
/// point leaves the other zone as it was, if no cell of one is in the other or adjacent to it: so the zone of a chosen
/// point claims its cells and their neighbours (`claim()`), and here only the cells in conflict are looked at.
/// Exact predicates decide, cospherical points by symbolic perturbation. Linear in the size of the zone.
template <class Triangulation>
Zone_result find_conflict_zone(const Triangulation& tr, const typename Triangulation::Point& point,
                               typename Triangulation::Cell_handle start, int batch,
                               Conflict_zone_3<Triangulation>& zone)
{
  zone.clear();
  zone.point = point;
  if (start->batch() == batch) return Zone_result::claimed;
  for (int i = 0; i < 4; ++i) // symbolic perturbation knows no equal points
    if (!tr.is_infinite(start->vertex(i)) && start->vertex(i)->point() == point) return Zone_result::no_conflict;
  if (tr.side_of_sphere(start, point, true) != CGAL::ON_BOUNDED_SIDE) return Zone_result::no_conflict;
  start->tds_data().mark_in_conflict();
  zone.cells.push_back(start);
  Zone_result result = Zone_result::found;
  for (std::size_t k = 0; k < zone.cells.size() && result == Zone_result::found; ++k) {
    const auto c = zone.cells[k];
    for (int i = 0; i < 4; ++i) {
      const auto n = c->neighbor(i);
      if (n->tds_data().is_in_conflict()) continue;
      if (n->tds_data().is_clear()) {
        if (tr.side_of_sphere(n, point, true) == CGAL::ON_BOUNDED_SIDE) {
          zone.cells.push_back(n);
          n->tds_data().mark_in_conflict();
          if (n->batch() == batch) result = Zone_result::claimed;
          if (tr.is_infinite(n)) result = Zone_result::infinite;
          if (result != Zone_result::found) break;
          continue;
        }
        n->tds_data().mark_on_boundary();
      }
      zone.hull.emplace_back(n, n->index(c));
    }
  }
  for (const auto c : zone.cells) c->tds_data().clear();
  for (const auto& f : zone.hull) f.first->tds_data().clear();
  return result;
}

/// The same for a point by itself, whatever batches claim.
/// \param near a cell to look for the point from.
template <class Triangulation>
Zone_result find_conflict_zone(const Triangulation& tr, const typename Triangulation::Point& point,
                               typename Triangulation::Cell_handle near, Conflict_zone_3<Triangulation>& zone)
{
  return find_conflict_zone(tr, point, tr.locate(point, near), no_batch, zone);
}

/// The same while other threads look at the triangulation, too: marks are kept beside it. The cells come in the same
/// order.
/// \param marks get 1 for each cell of the zone and 0 for those around it.
/// \param step `step(cell, i)` returns the cell behind a facet, and the number of the facet in that cell.
template <class Triangulation, class Step>
Zone_result find_conflict_zone_aside(const Triangulation& tr, const typename Triangulation::Point& point,
                                     typename Triangulation::Cell_handle start, int batch,
                                     Conflict_zone_3<Triangulation>& zone, Handle_marks& marks, const Step& step)
{
  zone.clear();
  zone.point = point;
  if (start->batch() == batch) return Zone_result::claimed;
  marks.clear();
  for (int i = 0; i < 4; ++i) // symbolic perturbation knows no equal points
    if (!tr.is_infinite(start->vertex(i)) && start->vertex(i)->point() == point) return Zone_result::no_conflict;
  if (tr.side_of_sphere(start, point, true) != CGAL::ON_BOUNDED_SIDE) return Zone_result::no_conflict;
  marks.add(start, 1);
  zone.cells.push_back(start);
  for (std::size_t k = 0; k < zone.cells.size(); ++k) {
    const auto c = zone.cells[k];
    for (int i = 0; i < 4; ++i) {
      const auto [n, index] = step(c, i);
      const int mark = marks.get(n);
      if (mark == 1) continue;
      if (mark == Handle_marks::none) {
        if (tr.side_of_sphere(n, point, true) == CGAL::ON_BOUNDED_SIDE) {
          zone.cells.push_back(n);
          marks.add(n, 1);
          if (n->batch() == batch) return Zone_result::claimed;
          if (tr.is_infinite(n)) return Zone_result::infinite;
          continue;
        }
        marks.add(n, 0);
      }
      zone.hull.emplace_back(n, index);
    }
  }
  return Zone_result::found;
}

/// The same in the triangulation as it is.
template <class Triangulation>
Zone_result find_conflict_zone_aside(const Triangulation& tr, const typename Triangulation::Point& point,
                                     typename Triangulation::Cell_handle start, int batch,
                                     Conflict_zone_3<Triangulation>& zone, Handle_marks& marks)
{
  return find_conflict_zone_aside(tr, point, start, batch, zone, marks, [](auto c, int i) {
    const auto n = c->neighbor(i);
    return std::make_pair(n, n->index(c));
  });
}

/// Claims a zone and the cells next to it for a batch.
template <class Triangulation>
void claim(const Conflict_zone_3<Triangulation>& zone, int batch)
{
  for (const auto c : zone.cells) c->set_batch(batch);
  for (const auto& f : zone.hull) f.first->set_batch(batch);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_CONFLICT_ZONE_3_H
