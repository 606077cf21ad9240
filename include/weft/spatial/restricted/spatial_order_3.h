// SPDX-License-Identifier: GPL-3.0-or-later
//
// Orders in which points near each other mostly follow each other, and copies of triangulations that lie in memory so:
// what visits vertex after vertex, or cell after cell, then waits for memory less.

#ifndef WEFT_SPATIAL_RESTRICTED_SPATIAL_ORDER_3_H
#define WEFT_SPATIAL_RESTRICTED_SPATIAL_ORDER_3_H

#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace weft::internal {

template <class Kernel>
using Indexed_points_3 =
    CGAL::Spatial_sort_traits_adapter_3<Kernel,
                                        typename CGAL::Pointer_property_map<typename Kernel::Point_3>::const_type>;

template <class Kernel>
Indexed_points_3<Kernel> indexed(const std::vector<typename Kernel::Point_3>& points)
{
  // CGAL::make_property_map() takes the address of the first one, which needn't exist.
  return Indexed_points_3<Kernel>(
      typename CGAL::Pointer_property_map<typename Kernel::Point_3>::const_type(points.data()));
}

inline std::vector<std::size_t> first_numbers(std::size_t n)
{
  std::vector<std::size_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), std::size_t(0));
  return numbers;
}

/// Indices of points along a Hilbert curve. O(n log n).
template <class Kernel>
std::vector<std::size_t> order_along_curve_3(const std::vector<typename Kernel::Point_3>& points)
{
  std::vector<std::size_t> order = first_numbers(points.size());
  CGAL::hilbert_sort(order.begin(), order.end(), indexed<Kernel>(points));
  return order;
}

/// The same in rounds of growing size, for incremental insertion (Amenta, Choi, Rote, "Incremental constructions con
/// BRIO", 2003). O(n log n).
template <class Kernel>
std::vector<std::size_t> insertion_order_3(const std::vector<typename Kernel::Point_3>& points)
{
  std::vector<std::size_t> order = first_numbers(points.size());
  CGAL::spatial_sort(order.begin(), order.end(), indexed<Kernel>(points));
  return order;
}

/// A copy of a triangulation, and where its parts are.
template <class Triangulation>
struct Ordered_copy_3
{
  std::unique_ptr<Triangulation> triangulation;
  std::vector<typename Triangulation::Vertex_handle> vertices; ///< by their ids
  std::vector<typename Triangulation::Cell_handle> cells; ///< by the ids that `copy_in_order()` gives the originals
};

/// Copies a triangulation so that its vertices are created in an order, and its cells in the order of the first of
/// their vertices, those with none first. Linear.
/// \param tr its cells get new ids.
/// \param vertices those with an id, by it; all others have a negative one.
/// \param order a permutation of those ids.
template <class Triangulation>
Ordered_copy_3<Triangulation> copy_in_order(const Triangulation& tr,
                                            const std::vector<typename Triangulation::Vertex_handle>& vertices,
                                            const std::vector<std::size_t>& order)
{
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;
  const std::size_t n = vertices.size();
  std::vector<std::size_t> rank(n), first(n + 2, 0);
  for (std::size_t k = 0; k < n; ++k) rank[order[k]] = k + 1;
  const auto key = [&](Cell_handle c) {
    std::size_t least = n + 1;
    for (int i = 0; i < 4; ++i)
      if (c->vertex(i)->id() >= 0) least = (std::min)(least, rank[static_cast<std::size_t>(c->vertex(i)->id())]);
    return least > n ? 0 : least;
  };
  for (const Cell_handle c : tr.all_cell_handles()) ++first[key(c) + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<Cell_handle> cells(first.back());
  for (const Cell_handle c : tr.all_cell_handles()) {
    const std::size_t at = first[key(c)]++;
    c->set_id(static_cast<int>(at));
    cells[at] = c;
  }

  Ordered_copy_3<Triangulation> copy{std::make_unique<Triangulation>(), std::vector<Vertex_handle>(n), {}};
  auto& tds = copy.triangulation->tds();
  tds.clear();
  tds.set_dimension(3);
  std::vector<std::pair<Vertex_handle, Vertex_handle>> others; // those without ids, and their copies
  for (const Vertex_handle v : tr.all_vertex_handles())
    if (v->id() < 0) others.emplace_back(v, tds.create_vertex(*v));
  for (const std::size_t i : order) copy.vertices[i] = tds.create_vertex(*vertices[i]);
  const auto copy_of = [&](Vertex_handle v) {
    if (v->id() >= 0) return copy.vertices[static_cast<std::size_t>(v->id())];
    const auto is_v = [v](const auto& pair) { return pair.first == v; };
    return std::find_if(others.begin(), others.end(), is_v)->second;
  };
  copy.cells.reserve(cells.size());
  for (const Cell_handle c : cells) copy.cells.push_back(tds.create_cell(*c));
  for (const Cell_handle c : cells) {
    const Cell_handle d = copy.cells[static_cast<std::size_t>(c->id())];
    for (int i = 0; i < 4; ++i) {
      d->set_vertex(i, copy_of(c->vertex(i)));
      d->set_neighbor(i, copy.cells[static_cast<std::size_t>(c->neighbor(i)->id())]);
      d->vertex(i)->set_cell(d);
    }
  }
  copy.triangulation->set_infinite_vertex(copy_of(tr.infinite_vertex()));
  return copy;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_SPATIAL_ORDER_3_H
