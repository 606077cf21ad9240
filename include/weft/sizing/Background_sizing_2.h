// SPDX-License-Identifier: GPL-3.0-or-later
//
// A piecewise linear sizing field on a background triangulation, with gradient limiting.
//
// The field owns a compact copy of the triangulation, so the original may change or vanish. Points are located by a
// visibility walk (Devillers, Pion and Teillaud, "Walking in a triangulation", 2002) that starts from a face remembered
// per cell of a grid: nothing is written while reading, so that many threads may read, and the value at a point doesn't
// depend on what was asked before.

#ifndef WEFT_SIZING_BACKGROUND_SIZING_2_H
#define WEFT_SIZING_BACKGROUND_SIZING_2_H

#include <weft/sizing/Background_triangulation_2.h>
#include <weft/sizing/limit_gradient_2.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// Sizing field that is linear on each triangle of a triangulation; outside of it, the value at the closest point of
/// the convex hull.
/// \tparam K a CGAL kernel with exact predicates, the triangulation's geometric traits or one that fits its points.
template <class K>
class Background_sizing_2
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_2;

  /// \param triangulation any CGAL triangulation of dimension 2; it is copied.
  /// \param size callable: vertex handle -> edge length at the vertex, in the input's units.
  /// \throws Domain_error without triangles; Option_error for a size that isn't positive and finite.
  template <class Triangulation, class Size_of_vertex>
  Background_sizing_2(const Triangulation& triangulation, const Size_of_vertex& size) : mesh_(triangulation, size)
  {
    if (mesh_.faces.size() >= 8) make_grid();
  }

  /// Target edge length at `x`. The walk visits a few faces where the grid's cells are about as large as the faces.
  FT operator()(const Point& x) const
  {
    const Place place = locate(x, start(x));
    return FT(place.outside ? value_at_hull(place.face, x) : value_in_face(place.face, x));
  }

  /// Lowers sizes until the length of the gradient is at most k on each triangle (up to rounding where one is nearly
  /// flat), so that the field is k-Lipschitz. No size falls below the smallest one. About O(n log n).
  ///
  /// Around one small size the field is at vertices the cone of slope k less 0 to 10 % on regular grids, less 0 to 26 %
  /// (on average 3 to 5 %) on grids with random offsets, where flat faces cost.
  ///
  /// \param k growth of the size per unit of distance, >= 0.
  /// \throws Option_error when k is NaN, infinite or negative.
  void limit_gradient(double k) { internal::limit_gradient_2(mesh_, k); }

  /// Length of the steepest gradient of all triangles.
  double max_gradient() const { return mesh_.max_gradient(); }

  /// Points and sizes at the vertices, in the order of the triangulation's finite vertices.
  const std::vector<Point>& points() const { return mesh_.points; }
  const std::vector<double>& sizes() const { return mesh_.sizes; }

private:
  using Triangles = internal::Background_triangulation_2<K>;
  using Index = typename Triangles::Index;
  using Face = typename Triangles::Face;
  using Vector = typename Triangles::Vector;
  static constexpr Index none = Triangles::none;

  struct Place
  {
    Index face;
    bool outside; // then `face` has an edge on the hull that sees the point
  };

  // About one cell per face; each remembers the face at its centre.
  void make_grid()
  {
    double xmin = mesh_.at(0).x, xmax = xmin, ymin = mesh_.at(0).y, ymax = ymin;
    for (Index v = 1; v < mesh_.points.size(); ++v) {
      xmin = std::min(xmin, mesh_.at(v).x), xmax = std::max(xmax, mesh_.at(v).x);
      ymin = std::min(ymin, mesh_.at(v).y), ymax = std::max(ymax, mesh_.at(v).y);
    }
    const double cells = static_cast<double>(mesh_.faces.size()),
                 aspect = std::sqrt(cells * ((xmax - xmin) / (ymax - ymin)));
    columns_ = static_cast<Index>(std::clamp(aspect, 1., cells));
    rows_ = static_cast<Index>(std::clamp(cells / columns_, 1., cells));
    left_ = xmin, bottom_ = ymin;
    per_x_ = columns_ / (xmax - xmin), per_y_ = rows_ / (ymax - ymin);
    grid_.resize(std::size_t(columns_) * rows_);
    Index face = 0;
    for (Index row = 0; row < rows_; ++row) { // there and back, so that walks are short
      for (Index i = 0; i < columns_; ++i) {
        const Index column = row % 2 == 0 ? i : columns_ - 1 - i;
        face = locate(Point(left_ + (column + 0.5) / per_x_, bottom_ + (row + 0.5) / per_y_), face).face;
        grid_[std::size_t(row) * columns_ + column] = face;
      }
    }
  }

  Index start(const Point& x) const
  {
    if (grid_.empty()) return 0;
    const double column = std::clamp((CGAL::to_double(x.x()) - left_) * per_x_, 0., columns_ - 1.);
    const double row = std::clamp((CGAL::to_double(x.y()) - bottom_) * per_y_, 0., rows_ - 1.);
    return grid_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
  }

  // Crosses edges that separate the face from x. The edge to try first is drawn at random, since a walk that always
  // prefers the same may go round for ever where the triangulation isn't Delaunay; the draw starts the same each time.
  Place locate(const Point& x, Index face) const
  {
    const auto orientation = K().orientation_2_object();
    Index from = none;
    std::uint32_t random = 2463534242u;
    for (;;) {
      random ^= random << 13, random ^= random >> 17, random ^= random << 5;
      const std::size_t first = random % 3;
      std::size_t i = first;
      bool crossed = false;
      do {
        const Index next = mesh_.faces[face].neighbor[i];
        if ((next == none || next != from) &&
            orientation(mesh_.point(face, (i + 1) % 3), mesh_.point(face, (i + 2) % 3), x) == CGAL::RIGHT_TURN) {
          if (next == none) return {face, true};
          from = face, face = next, crossed = true;
          break;
        }
        i = (i + 1) % 3;
      } while (i != first);
      if (!crossed) return {face, false};
    }
  }

  double value_in_face(Index f, const Point& x) const
  {
    const Face& face = mesh_.faces[f];
    const Vector p = mesh_.at(face.vertex[0]), q = mesh_.at(face.vertex[1]), r = mesh_.at(face.vertex[2]);
    const Vector s{CGAL::to_double(x.x()), CGAL::to_double(x.y())};
    const auto area = [](const Vector& a, const Vector& b, const Vector& c) { // 0 where rounding makes it negative
      return std::max(0., (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    };
    const double wp = area(q, r, s), wq = area(r, p, s), wr = area(p, q, s), sum = wp + wq + wr;
    const double hp = mesh_.sizes[face.vertex[0]], hq = mesh_.sizes[face.vertex[1]], hr = mesh_.sizes[face.vertex[2]];
    return sum > 0 ? (wp * hp + wq * hq + wr * hr) / sum : std::min({hp, hq, hr});
  }

  // From a hull edge that sees x along the hull to the closest point: on the part that x sees the distance has one
  // minimum.
  double value_at_hull(Index f, const Point& x) const
  {
    std::size_t i = 0;
    const auto orientation = K().orientation_2_object();
    while (mesh_.faces[f].neighbor[i] != none ||
           orientation(mesh_.point(f, (i + 1) % 3), mesh_.point(f, (i + 2) % 3), x) != CGAL::RIGHT_TURN)
      ++i;
    const Vector s{CGAL::to_double(x.x()), CGAL::to_double(x.y())};
    for (int before = 0;;) { // direction of the last step: turning back means the closest point is the vertex between
      const Index source = mesh_.faces[f].vertex[(i + 1) % 3], target = mesh_.faces[f].vertex[(i + 2) % 3];
      const Vector p = mesh_.at(source), q = mesh_.at(target), e{q.x - p.x, q.y - p.y};
      const double t = ((s.x - p.x) * e.x + (s.y - p.y) * e.y) / (e.x * e.x + e.y * e.y);
      const int step = t < 0 ? -1 : t > 1 ? 1 : 0;
      if (step == 0) return mesh_.sizes[source] + t * (mesh_.sizes[target] - mesh_.sizes[source]);
      if (step == -before) return mesh_.sizes[step < 0 ? source : target];
      turn(f, i, step > 0 ? target : source);
      before = step;
    }
  }

  // The other hull edge at vertex v of hull edge (f, i).
  void turn(Index& f, std::size_t& i, Index v) const
  {
    // Faces around v: leave through the edge at v that isn't the one we came by, until there is nothing behind it.
    const auto index_of = [&](Index g, Index w) -> std::size_t {
      return mesh_.faces[g].vertex[0] == w ? 0 : mesh_.faces[g].vertex[1] == w ? 1 : 2;
    };
    std::size_t j = 3 - i - index_of(f, v); // the third index: opposite edge contains v, too
    while (mesh_.faces[f].neighbor[j] != none) {
      const Index next = mesh_.faces[f].neighbor[j], pivot = mesh_.faces[f].vertex[3 - j - index_of(f, v)];
      f = next;
      j = index_of(f, pivot); // the edge at v opposite to where we came through
    }
    i = j;
  }

  Triangles mesh_;
  Index columns_ = 0, rows_ = 0;
  double left_ = 0, bottom_ = 0, per_x_ = 0, per_y_ = 0;
  std::vector<Index> grid_; // face to start from
};

} // namespace weft

#endif // WEFT_SIZING_BACKGROUND_SIZING_2_H
