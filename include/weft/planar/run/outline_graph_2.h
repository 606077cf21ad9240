// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the outline of a mesh to a planar straight line graph. Vertices of straight parts are set aside: they slide.
// Curved parts whose vertices are badly spaced get others, on the smooth curve through the old ones (cubic Hermite
// pieces with the tangents of circles through three vertices), as long as they stay close to what was there.

#ifndef WEFT_PLANAR_RUN_OUTLINE_GRAPH_2_H
#define WEFT_PLANAR_RUN_OUTLINE_GRAPH_2_H

#include <weft/planar/mesh/Scaled_triangle_2.h>
#include <weft/planar/run/outline_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// A polyline as a smooth curve.
template <class K>
class Smooth_curve_2
{
public:
  using Point = typename K::Point_2;

  /// \param points at least three; the first is the last where the curve is closed.
  /// \param is_smooth_at_ends whether a closed one has no corner there.
  Smooth_curve_2(const std::vector<Point>& points, bool is_smooth_at_ends)
  {
    for (const Point& p : points) points_.push_back(xy(p));
    const std::size_t n = points_.size() - 1;
    tangents_.resize(n + 1);
    for (std::size_t i = 1; i < n; ++i) tangents_[i] = tangent(points_[i - 1], points_[i], points_[i + 1]);
    if (is_smooth_at_ends) {
      tangents_[0] = tangents_[n] = tangent(points_[n - 1], points_[0], points_[1]);
    } else { // as on a circle: mirrored at the edge's bisector
      tangents_[0] = mirrored(tangents_[1], points_[0], points_[1]);
      tangents_[n] = mirrored(tangents_[n - 1], points_[n - 1], points_[n]);
    }
  }

  std::size_t edges() const { return points_.size() - 1; }
  double length(std::size_t i) const
  {
    return edge_length(points_[i + 1][0] - points_[i][0], points_[i + 1][1] - points_[i][1]);
  }
  const Xy_2& vertex(std::size_t i) const { return points_[i]; }
  Point middle(std::size_t i) const { return edge_middle<Point>(points_[i], points_[i + 1]); }

  /// The point at a part t of the way along edge i.
  Point at(std::size_t i, double t) const
  {
    const double l = length(i), a = (1 + 2 * t) * (1 - t) * (1 - t), b = t * (1 - t) * (1 - t) * l,
                 c = t * t * (3 - 2 * t), d = t * t * (t - 1) * l;
    const auto x = [&](std::size_t k) {
      return a * points_[i][k] + b * tangents_[i][k] + c * points_[i + 1][k] + d * tangents_[i + 1][k];
    };
    return Point(x(0), x(1));
  }

private:
  /// Unit tangent at q of the circle through three points.
  static Xy_2 tangent(const Xy_2& p, const Xy_2& q, const Xy_2& r)
  {
    const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - q[0], vy = r[1] - q[1];
    const double u2 = ux * ux + uy * uy, v2 = vx * vx + vy * vy;
    const double x = ux / u2 + vx / v2, y = uy / u2 + vy / v2, l = edge_length(x, y);
    return {x / l, y / l};
  }

  static Xy_2 mirrored(const Xy_2& t, const Xy_2& p, const Xy_2& q)
  {
    const double x = q[0] - p[0], y = q[1] - p[1], f = 2 * (t[0] * x + t[1] * y) / (x * x + y * y);
    return {f * x - t[0], f * y - t[1]};
  }

  std::vector<Xy_2> points_, tangents_;
};

/// Distance of q from the segment between a and b.
inline double distance_from_segment(const Xy_2& q, const Xy_2& a, const Xy_2& b)
{
  const double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
  const double t = l2 > 0 ? std::clamp(((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / l2, 0., 1.) : 0;
  return edge_length(q[0] - a[0] - t * dx, q[1] - a[1] - t * dy);
}

/// Other vertices for a curve, its ends included; none where it is fine as it is or no others are close enough to it.
/// \param size callable, point -> length of edges to aim at.
template <class K, class Size>
std::vector<typename K::Point_2> respaced(const Smooth_curve_2<K>& curve, const Size& size, double deviation)
{
  // Neighbouring edges of a mesh that Gmsh or Triangle make by rule have lengths within this.
  constexpr double well_spaced = 1.35;
  const std::size_t n = curve.edges();
  std::vector<double> metric(1, 0);
  double shortest = HUGE_VAL, longest = 0, steepest = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double m = curve.length(i) / size(curve.middle(i));
    shortest = (std::min)(shortest, m);
    longest = (std::max)(longest, m);
    if (i > 0)
      steepest = (std::max)({steepest, curve.length(i) / curve.length(i - 1), curve.length(i - 1) / curve.length(i)});
    metric.push_back(metric.back() + m);
  }
  if (steepest < well_spaced && longest < 1.5 && shortest > 0.6) return {};
  const bool closed = curve.vertex(0) == curve.vertex(n);
  const auto wanted = static_cast<std::size_t>((std::max)(closed ? 3.0 : 1.0, std::round(metric.back())));
  for (std::size_t pieces = wanted; pieces <= (std::max)(2 * wanted, n); pieces += 1 + pieces / 4) {
    std::vector<typename K::Point_2> points;
    std::vector<double> at; // along the old edges
    points.emplace_back(curve.vertex(0)[0], curve.vertex(0)[1]);
    at.push_back(0);
    std::size_t i = 0;
    for (std::size_t k = 1; k < pieces; ++k) {
      const double m = metric.back() * static_cast<double>(k) / static_cast<double>(pieces);
      while (i + 1 < n && metric[i + 1] < m) ++i;
      const double t = (m - metric[i]) / (metric[i + 1] - metric[i]);
      points.push_back(curve.at(i, t));
      at.push_back(static_cast<double>(i) + t);
    }
    points.emplace_back(curve.vertex(n)[0], curve.vertex(n)[1]);
    at.push_back(static_cast<double>(n));
    bool close = true;
    for (std::size_t k = 1; k + 1 < points.size() && close; ++k) { // new vertices from the old edges
      const auto e = (std::min)(static_cast<std::size_t>(at[k]), n - 1);
      close = distance_from_segment(xy(points[k]), curve.vertex(e), curve.vertex(e + 1)) <= deviation * curve.length(e);
    }
    std::size_t k = 0;
    for (std::size_t v = 1; v < n && close; ++v) { // old vertices from the new edges
      while (at[k + 1] < static_cast<double>(v)) ++k;
      close = distance_from_segment(curve.vertex(v), xy(points[k]), xy(points[k + 1])) <=
              deviation * (std::min)(curve.length(v - 1), curve.length(v));
    }
    if (close) return points;
  }
  return {};
}

/// Builds the graph; `outline_graph_2()` runs it.
template <class K, class Size>
class Outline_graph_builder_2
{
public:
  using Point = typename K::Point_2;

  Outline_graph_builder_2(const Triangle_mesh_2<K>& mesh, Outline_2 outline, const Size& size, double deviation)
      : mesh_(mesh), size_(size), deviation_(deviation), number_(mesh.points.size(), none)
  {
    graph_.outline = std::move(outline);
  }

  Outline_graph_2<K> run(const std::vector<char>& stays)
  {
    for (std::size_t c = 0; c < graph_.outline.chains.size(); ++c) add_chain(c);
    for (std::size_t v = 0; v < stays.size(); ++v)
      if (stays[v]) point_of(v);
    return std::move(graph_);
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr double straight = 1e-5; // as far as files in single precision keep it

  std::size_t point_of(std::size_t v)
  {
    if (number_[v] == none) {
      number_[v] = graph_.pslg.points.size();
      graph_.pslg.points.push_back(mesh_.points[v]);
      graph_.origin.push_back(v);
    }
    return number_[v];
  }

  void add_segment(std::size_t source, std::size_t target, std::size_t chain, std::vector<Point> between = {})
  {
    graph_.pslg.segments.push_back({source, target});
    graph_.segments.push_back({source, target, chain, std::move(between)});
  }

  void add_chain(std::size_t c)
  {
    const std::vector<std::size_t> vertices = graph_.outline.chains[c].vertices;
    std::vector<Point> points;
    for (const std::size_t v : vertices) points.push_back(mesh_.points[v]);
    const std::vector<std::size_t> ends = straight_parts(points, straight);
    for (std::size_t i = 0; i + 1 < ends.size();) {
      std::size_t j = i;
      while (j + 1 < ends.size() && ends[j + 1] == ends[j] + 1) ++j;
      if (j >= i + 2 && deviation_ > 0) {
        add_curve(c, vertices, points, ends[i], ends[j]);
        i = j;
      } else {
        const std::size_t first = ends[i], last = ends[i + 1];
        add_segment(point_of(vertices[first]), point_of(vertices[last]), c,
                    {points.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                     points.begin() + static_cast<std::ptrdiff_t>(last)});
        ++i;
      }
    }
  }

  void add_curve(std::size_t c, const std::vector<std::size_t>& vertices, const std::vector<Point>& points,
                 std::size_t first, std::size_t last)
  {
    const bool is_loop = vertices[first] == vertices[last];
    const Smooth_curve_2<K> curve(std::vector<Point>(points.begin() + static_cast<std::ptrdiff_t>(first),
                                                     points.begin() + static_cast<std::ptrdiff_t>(last) + 1),
                                  is_loop && turns_little(points));
    const std::vector<Point> others = respaced<K>(curve, size_, deviation_);
    std::size_t before = point_of(vertices[first]);
    if (others.empty()) {
      for (std::size_t k = first + 1; k <= last; ++k) {
        const std::size_t next = point_of(vertices[k]);
        add_segment(before, next, c);
        before = next;
      }
      return;
    }
    ++graph_.respaced;
    for (std::size_t k = 1; k + 1 < others.size(); ++k) {
      graph_.pslg.points.push_back(others[k]);
      graph_.origin.push_back(none);
      add_segment(before, graph_.pslg.points.size() - 1, c);
      before = graph_.pslg.points.size() - 1;
    }
    add_segment(before, point_of(vertices[last]), c);
  }

  /// Whether a loop goes on in about the same direction where it begins.
  static bool turns_little(const std::vector<Point>& points)
  {
    const auto u = points.back() - points[points.size() - 2], v = points[1] - points[0];
    return CGAL::to_double(u * v) > 0.7 * std::sqrt(CGAL::to_double(u * u) * CGAL::to_double(v * v));
  }

  const Triangle_mesh_2<K>& mesh_;
  const Size& size_;
  double deviation_;
  Outline_graph_2<K> graph_;
  std::vector<std::size_t> number_; ///< of the points of the mesh, in the graph
};

/// Makes the graph of an outline. Linear time, and one evaluation of the sizes for each edge of a curve.
/// \param stays by vertex, those that are points of the graph even where they aren't on the outline.
/// \param size callable, point -> length of edges to aim at on curves.
/// \param deviation how far a curve may get from what it was, in parts of its edges there; 0: nothing is respaced.
template <class K, class Size>
Outline_graph_2<K> outline_graph_2(const Triangle_mesh_2<K>& mesh, Outline_2 outline, const std::vector<char>& stays,
                                   const Size& size, double deviation)
{
  return Outline_graph_builder_2<K, Size>(mesh, std::move(outline), size, deviation).run(stays);
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_OUTLINE_GRAPH_2_H
