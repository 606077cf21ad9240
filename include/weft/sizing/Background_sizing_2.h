// SPDX-License-Identifier: GPL-3.0-or-later
//
// A piecewise linear sizing field on a background triangulation, with gradient limiting.
//
// The field owns a compact copy of the triangulation, so the original may change or vanish. Points are located by a
// visibility walk (Devillers, Pion and Teillaud, "Walking in a triangulation", 2002) that starts from a face remembered
// per cell of a grid: nothing is written while reading, so that many threads may read, and the value at a point doesn't
// depend on what was asked before.
//
// Gradient limiting lowers sizes until the gradient on every triangle is at most k. Along edges that is a shortest path
// problem; on a triangle it is the local update of fast marching methods (Kimmel and Sethian, "Computing geodesic paths
// on manifolds", 1998; as limiter: Persson, "Mesh size functions for implicit geometries and PDE-based gradient
// limiting", 2006), applied in order of increasing size.

#ifndef WEFT_SIZING_BACKGROUND_SIZING_2_H
#define WEFT_SIZING_BACKGROUND_SIZING_2_H

#include <weft/errors.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace weft {

/// Sizing field that is linear on each triangle of a triangulation; outside of it, the value at the closest point of
/// the convex hull. \tparam K a CGAL kernel with exact predicates, the triangulation's geometric traits or one that
/// fits its points.
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
  Background_sizing_2(const Triangulation& triangulation, const Size_of_vertex& size)
  {
    if (triangulation.dimension() < 2) throw Domain_error("the background triangulation has no triangle", {}, {});
    copy(triangulation, size);
    if (faces_.size() >= 8) make_grid();
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
  void limit_gradient(double k);

  /// Length of the steepest gradient of all triangles.
  double max_gradient() const
  {
    double steepest = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) steepest = std::max(steepest, gradient(f));
    return steepest;
  }

  /// Points and sizes at the vertices, in the order of the triangulation's finite vertices.
  const std::vector<Point>& points() const { return points_; }
  const std::vector<double>& sizes() const { return sizes_; }

private:
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
  struct Place
  {
    Index face;
    bool outside; // then `face` has an edge on the hull that sees the point
  };

  template <class Triangulation, class Size_of_vertex>
  void copy(const Triangulation& triangulation, const Size_of_vertex& size)
  {
    CGAL::Unique_hash_map<typename Triangulation::Vertex_handle, Index> vertex_index;
    CGAL::Unique_hash_map<typename Triangulation::Face_handle, Index> face_index(none);
    for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
      vertex_index[v] = static_cast<Index>(points_.size());
      points_.push_back(v->point());
      sizes_.push_back(static_cast<double>(size(typename Triangulation::Vertex_handle(v))));
      if (!(sizes_.back() > 0) || !std::isfinite(sizes_.back()))
        throw Option_error("Background_sizing_2: sizes must be positive and finite");
    }
    Index faces = 0;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
      face_index[f] = faces++;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
      Face face;
      for (int i = 0; i < 3; ++i) {
        face.vertex[i] = vertex_index[f->vertex(i)];
        face.neighbor[i] = triangulation.is_infinite(f->neighbor(i)) ? none : face_index[f->neighbor(i)];
      }
      faces_.push_back(face);
    }
  }

  const Point& point(Index f, int i) const { return points_[faces_[f].vertex[i]]; }
  Vector at(Index v) const { return {CGAL::to_double(points_[v].x()), CGAL::to_double(points_[v].y())}; }

  // About one cell per face; each remembers the face at its centre.
  void make_grid()
  {
    double xmin = at(0).x, xmax = xmin, ymin = at(0).y, ymax = ymin;
    for (Index v = 1; v < points_.size(); ++v) {
      xmin = std::min(xmin, at(v).x), xmax = std::max(xmax, at(v).x);
      ymin = std::min(ymin, at(v).y), ymax = std::max(ymax, at(v).y);
    }
    const double cells = static_cast<double>(faces_.size()),
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
      const int first = static_cast<int>(random % 3);
      int i = first;
      bool crossed = false;
      do {
        const Index next = faces_[face].neighbor[i];
        if ((next == none || next != from) &&
            orientation(point(face, (i + 1) % 3), point(face, (i + 2) % 3), x) == CGAL::RIGHT_TURN) {
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
    const Face& face = faces_[f];
    const Vector p = at(face.vertex[0]), q = at(face.vertex[1]), r = at(face.vertex[2]);
    const Vector s{CGAL::to_double(x.x()), CGAL::to_double(x.y())};
    const auto area = [](const Vector& a, const Vector& b, const Vector& c) { // 0 where rounding makes it negative
      return std::max(0., (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    };
    const double wp = area(q, r, s), wq = area(r, p, s), wr = area(p, q, s), sum = wp + wq + wr;
    const double hp = sizes_[face.vertex[0]], hq = sizes_[face.vertex[1]], hr = sizes_[face.vertex[2]];
    return sum > 0 ? (wp * hp + wq * hq + wr * hr) / sum : std::min({hp, hq, hr});
  }

  // From a hull edge that sees x along the hull to the closest point: on the part that x sees the distance has one
  // minimum.
  double value_at_hull(Index f, const Point& x) const
  {
    int i = 0;
    const auto orientation = K().orientation_2_object();
    while (faces_[f].neighbor[i] != none ||
           orientation(point(f, (i + 1) % 3), point(f, (i + 2) % 3), x) != CGAL::RIGHT_TURN)
      ++i;
    const Vector s{CGAL::to_double(x.x()), CGAL::to_double(x.y())};
    for (int before = 0;;) { // direction of the last step: turning back means the closest point is the vertex between
      const Index source = faces_[f].vertex[(i + 1) % 3], target = faces_[f].vertex[(i + 2) % 3];
      const Vector p = at(source), q = at(target), e{q.x - p.x, q.y - p.y};
      const double t = ((s.x - p.x) * e.x + (s.y - p.y) * e.y) / (e.x * e.x + e.y * e.y);
      const int step = t < 0 ? -1 : t > 1 ? 1 : 0;
      if (step == 0) return sizes_[source] + t * (sizes_[target] - sizes_[source]);
      if (step == -before) return sizes_[step < 0 ? source : target];
      turn(f, i, step > 0 ? target : source);
      before = step;
    }
  }

  // The other hull edge at vertex v of hull edge (f, i).
  void turn(Index& f, int& i, Index v) const
  {
    // Faces around v: leave through the edge at v that isn't the one we came by, until there is nothing behind it.
    const auto index_of = [&](Index g, Index w) {
      return faces_[g].vertex[0] == w ? 0 : faces_[g].vertex[1] == w ? 1 : 2;
    };
    int j = 3 - i - index_of(f, v); // the third index: opposite edge contains v, too
    while (faces_[f].neighbor[j] != none) {
      const Index next = faces_[f].neighbor[j], pivot = faces_[f].vertex[3 - j - index_of(f, v)];
      f = next;
      j = index_of(f, pivot); // the edge at v opposite to where we came through
    }
    i = j;
  }

  struct Shape; // of a face, for the limiter: see below
  Shape shape(std::size_t f) const;
  Vector slope(std::size_t f, const Shape& s) const;
  double rounding(std::size_t f, const Shape& s) const;
  double gradient(std::size_t f) const;
  double size_from_edge(std::size_t f, int i, const Shape& s, double k) const;
  double size_upwind(std::size_t f, int i, double k) const;
  void march(double k, const std::vector<std::vector<Index>>& around);
  template <class Lowered>
  void limit_edges(std::size_t f, double k, const Lowered& lowered);
  template <class Lowered>
  bool limit_face(std::size_t f, double k, const Lowered& lowered);

  std::vector<Point> points_;
  std::vector<double> sizes_;
  std::vector<Face> faces_;
  Index columns_ = 0, rows_ = 0;
  double left_ = 0, bottom_ = 0, per_x_ = 0, per_y_ = 0;
  std::vector<Index> grid_; // face to start from
};

/// Gradients of the three hat functions of a face. One with parallel sides to rounding has none.
template <class K>
struct Background_sizing_2<K>::Shape
{
  std::array<Vector, 3> hat;
};

template <class K>
auto Background_sizing_2<K>::shape(std::size_t f) const -> Shape
{
  const auto& v = faces_[f].vertex;
  const std::array<Vector, 3> p{at(v[0]), at(v[1]), at(v[2])};
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  Shape result{};
  for (int i = 0; area > 0 && i < 3; ++i) {
    const Vector &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
    result.hat[i] = {(a.y - b.y) / area, (b.x - a.x) / area};
  }
  return result;
}

template <class K>
auto Background_sizing_2<K>::slope(std::size_t f, const Shape& s) const -> Vector
{
  const double base = sizes_[faces_[f].vertex[0]]; // differences first: less cancels
  Vector g{0, 0};
  for (int i = 1; i < 3; ++i) {
    const double h = sizes_[faces_[f].vertex[i]] - base;
    g.x += h * s.hat[i].x, g.y += h * s.hat[i].y;
  }
  return g;
}

// What the last bits of the sizes can make of a gradient.
template <class K>
double Background_sizing_2<K>::rounding(std::size_t f, const Shape& s) const
{
  double size = 0, steepest = 0;
  for (int i = 0; i < 3; ++i) {
    size = std::max(size, sizes_[faces_[f].vertex[i]]);
    steepest = std::max(steepest, std::hypot(s.hat[i].x, s.hat[i].y));
  }
  return 4 * std::numeric_limits<double>::epsilon() * size * steepest;
}

template <class K>
double Background_sizing_2<K>::gradient(std::size_t f) const
{
  const Vector g = slope(f, shape(f));
  return std::hypot(g.x, g.y);
}

template <class K>
template <class Lowered>
void Background_sizing_2<K>::limit_edges(std::size_t f, double k, const Lowered& lowered)
{
  for (int i = 0; i < 3; ++i) {
    Index low = faces_[f].vertex[i], high = faces_[f].vertex[(i + 1) % 3];
    if (sizes_[low] > sizes_[high]) std::swap(low, high);
    const double limit = sizes_[low] + k * std::hypot(at(low).x - at(high).x, at(low).y - at(high).y);
    if (sizes_[high] > limit) sizes_[high] = limit, lowered(high);
  }
}

// Largest size at vertex i of a face for which its gradient is at most k, the other two being given.
template <class K>
double Background_sizing_2<K>::size_from_edge(std::size_t f, int i, const Shape& s, double k) const
{
  const Vector g = slope(f, s), hat = s.hat[i];
  const double per_height = std::hypot(hat.x, hat.y);
  if (per_height == 0) return std::numeric_limits<double>::infinity();
  const double along = (g.x * hat.y - g.y * hat.x) / per_height; // part along the opposite edge: stays
  const double normal = (g.x * hat.x + g.y * hat.y) / per_height;
  return sizes_[faces_[f].vertex[i]] - (normal - std::sqrt(std::max(0., k * k - along * along))) / per_height;
}

// The same where the steepest descent from vertex i leaves through the opposite edge, so that the sizes there are what
// causes it; infinity elsewhere.
template <class K>
double Background_sizing_2<K>::size_upwind(std::size_t f, int i, double k) const
{
  const Shape s = shape(f);
  const double size = size_from_edge(f, i, s, k), change = size - sizes_[faces_[f].vertex[i]];
  Vector g = slope(f, s);
  g.x += change * s.hat[i].x, g.y += change * s.hat[i].y;
  const auto rises_to = [&](int j) { return g.x * s.hat[j].x + g.y * s.hat[j].y > 0; };
  return rises_to((i + 1) % 3) || rises_to((i + 2) % 3) ? std::numeric_limits<double>::infinity() : size;
}

// Fast marching: vertices become final in order of size, and bound their neighbours along edges and, two at a time,
// across faces. The result is near the largest field of gradient k, but not strictly within k on coarse or obtuse
// faces.
template <class K>
void Background_sizing_2<K>::march(double k, const std::vector<std::vector<Index>>& around)
{
  using Entry = std::pair<double, Index>; // ties by index
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  for (Index v = 0; v < points_.size(); ++v) queue.emplace(sizes_[v], v);
  std::vector<char> final(points_.size(), 0);
  while (!queue.empty()) {
    const auto [size, v] = queue.top();
    queue.pop();
    if (final[v]) continue;
    final[v] = 1;
    for (const Index f : around[v])
      for (int i = 0; i < 3; ++i) {
        const Index w = faces_[f].vertex[i],
                    third = faces_[f].vertex[0] ^ faces_[f].vertex[1] ^ faces_[f].vertex[2] ^ v ^ w;
        if (final[w]) continue;
        double limit = size + k * std::hypot(at(v).x - at(w).x, at(v).y - at(w).y);
        if (final[third]) limit = std::min(limit, size_upwind(f, i, k));
        if (limit < sizes_[w]) sizes_[w] = limit, queue.emplace(limit, w);
      }
  }
}

// Flattens a face that is too steep: lowers the vertices that this flattens, each by as much as it helps, which changes
// the sizes least. There is such a vertex, as the hat functions' gradients sum to 0. The lowest size of the face stays.
template <class K>
template <class Lowered>
bool Background_sizing_2<K>::limit_face(std::size_t f, double k, const Lowered& lowered)
{
  const Shape s = shape(f);
  const auto& v = faces_[f].vertex;
  const Vector g = slope(f, s);
  // A relative 1e-6 is left to limit_gradient(): the last steps on flat faces are many and small.
  if (std::hypot(g.x, g.y) <= k * (1 + 1e-6) + rounding(f, s)) return false;
  std::array<double, 3> share;
  Vector change{0, 0};
  for (int i = 0; i < 3; ++i) {
    share[i] = std::max(0., g.x * s.hat[i].x + g.y * s.hat[i].y);
    change.x += share[i] * s.hat[i].x, change.y += share[i] * s.hat[i].y;
  }
  // Smallest t with |g - t change| = k, or the flattest t where there is none.
  const double cc = change.x * change.x + change.y * change.y, gc = g.x * change.x + g.y * change.y;
  const double excess = g.x * g.x + g.y * g.y - k * k;
  const double root = std::sqrt(std::max(0., gc * gc - cc * excess));
  const double t = excess / (gc + root) < gc / cc ? excess / (gc + root) : gc / cc;
  const double lowest = std::min({sizes_[v[0]], sizes_[v[1]], sizes_[v[2]]});
  for (int i = 0; i < 3; ++i) {
    const double size = std::max(lowest, sizes_[v[i]] - t * share[i]);
    if (size < sizes_[v[i]]) sizes_[v[i]] = size, lowered(v[i]);
  }
  return true;
}

template <class K>
void Background_sizing_2<K>::limit_gradient(double k)
{
  if (!(k >= 0) || !std::isfinite(k)) throw Option_error("the gradient of a sizing field must be finite and >= 0");
  std::vector<std::vector<Index>> around(points_.size());
  for (Index f = 0; f < faces_.size(); ++f)
    for (const Index v : faces_[f].vertex) around[v].push_back(f);
  march(k, around);

  using Entry = std::pair<double, Index>; // the smaller sizes first, as in Dijkstra's algorithm; ties by index
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<char> waiting(faces_.size(), 0);
  const auto push = [&](Index f) {
    if (waiting[f]) return;
    waiting[f] = 1;
    const auto& v = faces_[f].vertex;
    queue.emplace(std::min({sizes_[v[0]], sizes_[v[1]], sizes_[v[2]]}), f);
  };
  const auto lowered = [&](Index v) {
    for (const Index f : around[v]) push(f);
  };
  for (Index f = 0; f < faces_.size(); ++f) push(f);
  // Sizes only fall and are bounded, but obtuse faces may need many ever smaller steps: the budget ends that.
  for (std::size_t budget = 200 * faces_.size() + 10000; !queue.empty() && budget > 0; --budget) {
    const Index f = queue.top().second;
    queue.pop();
    waiting[f] = 0;
    limit_edges(f, k, lowered);
    limit_face(f, k, lowered);
  }
  // What is left, a relative 1e-6 unless the budget ended it: pull all sizes towards the smallest, which scales all
  // gradients.
  // The margins are for the rounding of the sizes; on a face so flat that it still matters, rounding has the last word.
  const double lowest = *std::min_element(sizes_.begin(), sizes_.end());
  for (const double margin : {1e-15, 1e-12, 1e-9}) {
    if (max_gradient() <= k) return;
    double steepest = k;
    for (std::size_t f = 0; f < faces_.size(); ++f) steepest = std::max(steepest, gradient(f) - rounding(f, shape(f)));
    const double factor = steepest > 0 ? k / steepest * (1 - margin) : 0;
    for (double& h : sizes_) h = lowest + factor * (h - lowest);
  }
}

} // namespace weft

#endif // WEFT_SIZING_BACKGROUND_SIZING_2_H
