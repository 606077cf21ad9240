// SPDX-License-Identifier: GPL-3.0-or-later
//
// A piecewise linear sizing field on a tetrahedral mesh, be it one of weft's, one that was read from a file, or a
// triangulation of CGAL's: sizes at the vertices.

#ifndef WEFT_SPATIAL_SIZING_BACKGROUND_SIZING_3_H
#define WEFT_SPATIAL_SIZING_BACKGROUND_SIZING_3_H

#include <weft/errors.h>
#include <weft/spatial/mesh/Cell_locator_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace weft {

/// Sizing field that is linear on each cell of a mesh; outside of it, the value at the nearest point of its boundary.
/// It owns a copy of the mesh, which copies of the field share. Safe to read from many threads. A mesher asks some
/// thousand times a vertex: `Lipschitz_sizing_3` makes a faster table of it, and grades it, too.
/// \tparam K a CGAL kernel whose coordinates are doubles.
template <class K>
class Background_sizing_3
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_3;

  /// \param sizes at the points, in the input's units.
  /// \throws Option_error for a size that isn't positive and finite, or if there isn't one for each point;
  ///   Domain_error without cells.
  Background_sizing_3(const std::vector<Point>& points, const std::vector<std::array<std::size_t, 4>>& cells,
                      std::vector<double> sizes)
  {
    if (cells.empty()) throw Domain_error("the background mesh has no cell", {}, {});
    if (sizes.size() != points.size()) throw Option_error("Background_sizing_3: one size per point is needed");
    for (const double size : sizes)
      if (!(size > 0) || !std::isfinite(size))
        throw Option_error("Background_sizing_3: sizes must be positive and finite");
    data_ = std::make_shared<const Data>(Data{internal::Cell_locator_3<K>(points, cells), std::move(sizes)});
  }

  /// The same of a mesh.
  Background_sizing_3(const Tetrahedral_mesh_3<K>& mesh, std::vector<double> sizes)
      : Background_sizing_3(mesh.points, mesh.cells, std::move(sizes))
  {}

  /// The same of a CGAL triangulation of dimension 3.
  /// \param size callable: vertex handle -> size.
  template <class Triangulation, class Size_of_vertex, class Vertex_handle = typename Triangulation::Vertex_handle>
  Background_sizing_3(const Triangulation& triangulation, const Size_of_vertex& size)
      : Background_sizing_3(Arrays(triangulation, size))
  {}

  /// Target edge length at `x`. O(log n).
  FT operator()(const Point& x) const { return FT(data_->cells.locate(x).value(data_->sizes)); }

private:
  struct Data
  {
    internal::Cell_locator_3<K> cells;
    std::vector<double> sizes;
  };

  struct Arrays
  {
    template <class Triangulation, class Size_of_vertex>
    Arrays(const Triangulation& triangulation, const Size_of_vertex& size)
    {
      if (triangulation.dimension() < 3) return;
      CGAL::Unique_hash_map<typename Triangulation::Vertex_handle, std::size_t> index;
      for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
        index[v] = points.size();
        points.push_back(Point(v->point().x(), v->point().y(), v->point().z()));
        sizes.push_back(static_cast<double>(size(typename Triangulation::Vertex_handle(v))));
      }
      for (auto c = triangulation.finite_cells_begin(); c != triangulation.finite_cells_end(); ++c)
        cells.push_back({index[c->vertex(0)], index[c->vertex(1)], index[c->vertex(2)], index[c->vertex(3)]});
    }
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 4>> cells;
    std::vector<double> sizes;
  };
  explicit Background_sizing_3(Arrays arrays)
      : Background_sizing_3(arrays.points, arrays.cells, std::move(arrays.sizes))
  {}

  std::shared_ptr<const Data> data_;
};

} // namespace weft

#endif // WEFT_SPATIAL_SIZING_BACKGROUND_SIZING_3_H
