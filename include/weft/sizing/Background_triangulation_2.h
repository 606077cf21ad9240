// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangulation with a size at each vertex, linear between, copied into arrays.

#ifndef WEFT_SIZING_BACKGROUND_TRIANGULATION_2_H
#define WEFT_SIZING_BACKGROUND_TRIANGULATION_2_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>

#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

/// Piecewise linear sizes; `Background_sizing_2` evaluates them anywhere.
/// \tparam K as of Background_sizing_2.
template <class K>
struct Background_triangulation_2
{
  using Point = typename K::Point_2;
  using Index = std::uint32_t;
  static constexpr Index none = ~Index(0);

  struct Face
  {
    std::array<Index, 3> vertex;   // counterclockwise
    std::array<Index, 3> neighbor; // opposite to the vertex; none beyond the hull
  };
  struct Vector
  {
    double x, y;
  };

  /// \param size callable: vertex handle -> size.
  /// \throws Domain_error without triangles; Option_error for a size that isn't positive and finite.
  template <class Triangulation, class Size_of_vertex>
  Background_triangulation_2(const Triangulation& triangulation, const Size_of_vertex& size)
  {
    if (triangulation.dimension() < 2) throw Domain_error("the background triangulation has no triangle", {}, {});
    CGAL::Unique_hash_map<typename Triangulation::Vertex_handle, Index> vertex_index;
    CGAL::Unique_hash_map<typename Triangulation::Face_handle, Index> face_index(none);
    for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
      vertex_index[v] = static_cast<Index>(points.size());
      points.push_back(v->point());
      sizes.push_back(static_cast<double>(size(typename Triangulation::Vertex_handle(v))));
      if (!(sizes.back() > 0) || !std::isfinite(sizes.back()))
        throw Option_error("Background_sizing_2: sizes must be positive and finite");
    }
    Index number = 0;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
      face_index[f] = number++;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
      Face face;
      for (int i = 0; i < 3; ++i) {
        face.vertex[as_index(i)] = vertex_index[f->vertex(i)];
        face.neighbor[as_index(i)] = triangulation.is_infinite(f->neighbor(i)) ? none : face_index[f->neighbor(i)];
      }
      faces.push_back(face);
    }
  }

  const Point& point(Index f, std::size_t i) const { return points[faces[f].vertex[i]]; }
  Vector at(Index v) const { return {CGAL::to_double(points[v].x()), CGAL::to_double(points[v].y())}; }

  /// Gradients of the three hat functions of a face. One with parallel sides to rounding has none.
  struct Shape
  {
    std::array<Vector, 3> hat;
  };

  Shape shape(std::size_t f) const
  {
    const auto& v = faces[f].vertex;
    const std::array<Vector, 3> p{at(v[0]), at(v[1]), at(v[2])};
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    Shape result{};
    for (std::size_t i = 0; area > 0 && i < 3; ++i) {
      const Vector &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
      result.hat[i] = {(a.y - b.y) / area, (b.x - a.x) / area};
    }
    return result;
  }

  Vector slope(std::size_t f, const Shape& s) const
  {
    const double base = sizes[faces[f].vertex[0]]; // differences first: less cancels
    Vector g{0, 0};
    for (std::size_t i = 1; i < 3; ++i) {
      const double h = sizes[faces[f].vertex[i]] - base;
      g.x += h * s.hat[i].x, g.y += h * s.hat[i].y;
    }
    return g;
  }

  // What the last bits of the sizes can make of a gradient.
  double rounding(std::size_t f, const Shape& s) const
  {
    double size = 0, steepest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      size = std::max(size, sizes[faces[f].vertex[i]]);
      steepest = std::max(steepest, std::hypot(s.hat[i].x, s.hat[i].y));
    }
    return 4 * std::numeric_limits<double>::epsilon() * size * steepest;
  }

  double gradient(std::size_t f) const
  {
    const Vector g = slope(f, shape(f));
    return std::hypot(g.x, g.y);
  }

  /// Length of the steepest gradient of all triangles.
  double max_gradient() const
  {
    double steepest = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) steepest = std::max(steepest, gradient(f));
    return steepest;
  }

  std::vector<Point> points; ///< in the order of the triangulation's finite vertices
  std::vector<double> sizes; ///< at the points
  std::vector<Face> faces;
};

} // namespace weft::internal

#endif // WEFT_SIZING_BACKGROUND_TRIANGULATION_2_H
