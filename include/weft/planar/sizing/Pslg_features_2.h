// SPDX-License-Identifier: GPL-3.0-or-later
//
// The features of a planar straight line graph, its points and closed segments, and the distances to them that the
// local feature size is made of: `Local_feature_size_2` says how.

#ifndef WEFT_PLANAR_SIZING_PSLG_FEATURES_2_H
#define WEFT_PLANAR_SIZING_PSLG_FEATURES_2_H

#include <weft/errors.h>
#include <weft/internal/boxes/Box_tree_2.h>
#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Points first, then segments; equal ones are one feature. Coordinates are scaled by a power of two to about 1.
/// \tparam K a CGAL kernel; distances are computed with doubles, whether features meet is asked of the kernel.
template <class K>
class Pslg_features_2
{
public:
  using Point = typename K::Point_2;
  using Index = std::uint32_t;

  // A segment, or a point when a == b, in scaled coordinates; `origin`: index in the caller's arrays.
  struct Feature
  {
    double ax, ay, bx, by, length;
    Index a, b;
    std::size_t origin;
    bool touches(Index v) const { return a == v || b == v; }
  };
  // Distance from a point that runs along a segment, and its derivative there (a subgradient: the distance is convex).
  struct Distance
  {
    double value, slope;
  };
  // Two features, one at each end of the segment at hand; a single feature when both are the same.
  using Pair = std::array<Index, 2>;

  /// \throws Domain_error when a segment names a point that isn't there or a coordinate isn't finite.
  explicit Pslg_features_2(const Pslg_2<K>& pslg) : points_(pslg.points)
  {
    read(pslg);
    std::vector<Tree_item_2> items;
    items.reserve(features_.size());
    for (const Feature& f : features_) items.push_back({f.ax, f.ay, f.bx, f.by, 0});
    tree_ = Box_tree_2(items);
  }

  std::size_t size() const { return features_.size(); }
  const Feature& operator[](std::size_t i) const { return features_[i]; }
  /// Segments at a point of the graph; of equal points the first has them all.
  const std::vector<Index>& star(Index v) const { return stars_[v]; }
  /// As it was given.
  const Point& point(Index v) const { return points_[v]; }
  double scale() const { return scale_; }
  const Box_tree_2& tree() const { return tree_; }

  static bool incident(const Feature& f, const Feature& g) { return f.touches(g.a) || f.touches(g.b); }

  static Distance distance(const Feature& f, double x, double y, double dx, double dy)
  {
    double px = x - f.ax, py = y - f.ay;
    if (f.length > 0) {
      const double ux = f.bx - f.ax, uy = f.by - f.ay, t = (px * ux + py * uy) / (f.length * f.length);
      if (t >= 1)
        px = x - f.bx, py = y - f.by;
      else if (t > 0) { // to the line: by the cross product, which loses less than the foot would
        const double nx = uy / f.length, ny = -ux / f.length, height = px * nx + py * ny;
        return {std::abs(height), height == 0 ? 0 : (height > 0 ? 1 : -1) * (nx * dx + ny * dy)};
      }
    }
    const double length = std::sqrt(px * px + py * py);
    return {length, length > 0 ? (px * dx + py * dy) / length : 0};
  }

  // Features at the end v of the segment that can be nearer than v itself is: those at an acute angle. And v.
  std::vector<Index> near_star(const Feature& self, Index v) const
  {
    std::vector<Index> result{vertex_feature(v)};
    const double sign = v == self.a ? 1 : -1, dx = sign * (self.bx - self.ax), dy = sign * (self.by - self.ay);
    for (const Index i : stars_[v]) {
      const Feature& f = features_[i];
      const double turn = v == f.a ? 1 : -1;
      if (&f != &self && turn * ((f.bx - f.ax) * dx + (f.by - f.ay) * dy) > 0) result.push_back(i);
    }
    return result;
  }

  // Smallest distance from (x, y), below `best`, to a feature that touches neither a nor b.
  double nearest(double x, double y, Index a, Index b, double best, Pair& from) const
  {
    const double start = best;
    const double least = tree_.minimise(
        best * best, [&](const Box_2& box) { return box.squared_distance(x, y); },
        [&](Index item, double so_far) {
          const Index i = tree_.order()[item];
          const Feature& f = features_[i];
          if (f.touches(a) || f.touches(b)) return so_far;
          const double d = distance(f, x, y, 0, 0).value;
          if (d >= best) return so_far;
          best = d, from = {i, i};
          return d * d;
        });
    return least < start * start ? best : start;
  }

  // Features of a planar straight line graph meet in shared points only.
  void refuse_contact(const Feature& f, const Feature& g) const
  {
    const auto meet = K().do_intersect_2_object();
    const typename K::Segment_2 at_f(points_[f.a], points_[f.b]), at_g(points_[g.a], points_[g.b]);
    if (!meet(at_f, at_g)) return;
    const auto name = [](const Feature& e) {
      return (e.length > 0 ? "segment " : "point ") + std::to_string(e.origin);
    };
    std::vector<std::size_t> vertices, segments;
    for (const Feature* e : {&f, &g}) (e->length > 0 ? segments : vertices).push_back(e->origin);
    throw Domain_error(name(f) + " and " + name(g) + " meet outside of a common point: the local feature size is 0",
                       vertices, segments);
  }

private:
  void read(const Pslg_2<K>& pslg)
  {
    double largest = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const double c : {CGAL::to_double(points_[i].x()), CGAL::to_double(points_[i].y())}) {
        if (!std::isfinite(c))
          throw Domain_error("point " + std::to_string(i) + " has a coordinate that isn't finite", {i}, {});
        largest = std::max(largest, std::abs(c));
      }
    scale_ = unit_scale(largest);

    std::vector<Index> vertex(points_.size()); // the first of the points that are equal
    std::map<std::pair<double, double>, Index> first;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto at =
          std::make_pair(scale_ * CGAL::to_double(points_[i].x()), scale_ * CGAL::to_double(points_[i].y()));
      const auto [it, is_new] = first.emplace(at, static_cast<Index>(i));
      vertex[i] = it->second;
      if (is_new) features_.push_back({at.first, at.second, at.first, at.second, 0, it->second, it->second, i});
    }
    stars_.resize(points_.size());
    std::set<std::pair<Index, Index>> seen;
    for (std::size_t i = 0; i < pslg.segments.size(); ++i) {
      const auto& s = pslg.segments[i];
      if (std::max(s[0], s[1]) >= points_.size())
        throw Domain_error("segment " + std::to_string(i) + " names a point that isn't there", {}, {i});
      const Index a = vertex[s[0]], b = vertex[s[1]];
      if (a != b && seen.insert(std::minmax(a, b)).second) add_segment(a, b, i);
    }
  }

  void add_segment(Index a, Index b, std::size_t origin)
  {
    const double ax = scale_ * CGAL::to_double(points_[a].x()), ay = scale_ * CGAL::to_double(points_[a].y());
    const double bx = scale_ * CGAL::to_double(points_[b].x()), by = scale_ * CGAL::to_double(points_[b].y());
    stars_[a].push_back(static_cast<Index>(features_.size()));
    stars_[b].push_back(static_cast<Index>(features_.size()));
    features_.push_back({ax, ay, bx, by, std::sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay)), a, b, origin});
  }

  // Points precede segments among the features, in the order of the points that they come from.
  Index vertex_feature(Index v) const
  {
    const auto at = std::partition_point(features_.begin(), features_.end(),
                                         [&](const Feature& f) { return f.length == 0 && f.a < v; });
    return static_cast<Index>(at - features_.begin());
  }

  std::vector<Point> points_;
  double scale_ = 1;
  std::vector<Feature> features_;         // points first
  std::vector<std::vector<Index>> stars_; // segments at each point
  Box_tree_2 tree_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_SIZING_PSLG_FEATURES_2_H
