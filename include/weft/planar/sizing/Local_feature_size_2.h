// SPDX-License-Identifier: GPL-3.0-or-later
//
// The local feature size of a planar straight line graph along its own features, and its description by few sources.
//
// lfs(s) is the radius of the smallest disk centred at s that meets two features which are not incident (Ruppert, "A
// Delaunay refinement algorithm for quality 2-dimensional mesh generation", 1995). Features are the points and the
// closed segments; two are incident when they share a point of the graph. So at a point of segment ab count
//  - the distance to each feature that touches neither a nor b, and
//  - for one feature at a and one at b that aren't incident, the larger of the two distances: at least half of ab's
//    length, or what a sharp corner at a leaves.
// At a vertex this is the distance to the nearest feature that doesn't contain it. lfs is 1-Lipschitz and positive.
//
// Distances are Euclidean, and across holes and the outside, too: two features on both sides of a thin slit count as
// near although no element can join them. That may ask for more elements than needed and never for too few; it needs no
// notion of inside, so that the field is the same whichever way the domain is marked. Where a slit is only a gap in the
// data, `min_size` bounds what it costs.

#ifndef WEFT_PLANAR_SIZING_LOCAL_FEATURE_SIZE_2_H
#define WEFT_PLANAR_SIZING_LOCAL_FEATURE_SIZE_2_H

#include <weft/errors.h>
#include <weft/internal/boxes/Box_tree_2.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/sizing/Lipschitz_sizing_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Local feature size of a PSLG. Equal points are one feature, so are equal segments; a segment of length 0 is a point.
/// \tparam K a CGAL kernel; distances are computed with doubles, whether features meet is asked of the kernel.
template <class K>
class Local_feature_size_2
{
public:
  using Point = typename K::Point_2;
  using Source = typename Lipschitz_sizing_2<K>::Source;

  /// O(n log n).
  /// \throws Domain_error when a segment names a point that isn't there or a coordinate isn't finite.
  explicit Local_feature_size_2(const Pslg_2<K>& pslg) : points_(pslg.points)
  {
    read(pslg);
    std::vector<internal::Tree_item_2> items;
    items.reserve(features_.size());
    for (const Feature& f : features_) items.push_back({f.ax, f.ay, f.bx, f.by, 0});
    tree_ = internal::Box_tree_2(items);
  }

  /// Segments and isolated points with sizes h that are linear on each, such that on all features
  /// h <= lfs <= h + tolerance * max(h, min_size). Parts where lfs is max_size or more are left out.
  /// On the inputs tried 1 to 10 sources per segment for a tolerance of 1 %, each for a few queries of O(log n) where
  /// no point has very many segments: 3 ms for a map of 303 segments, 1 s for 100,000 random ones, with the field's
  /// tree.
  ///
  /// \param tolerance relative error, in (0, 1].
  /// \throws Domain_error when `min_size` is 0 and features meet without sharing a point: lfs is 0 there; or come so
  /// near to each other that lfs rounds to 0.
  std::vector<Source> sources(double tolerance, double min_size, double max_size) const
  {
    std::vector<Source> result;
    const Limits limits{tolerance, min_size * scale_, max_size * scale_};
    for (std::size_t i = 0; i < features_.size(); ++i)
      if (features_[i].length > 0)
        describe_segment(i, limits, result);
      else if (stars_[features_[i].a].empty())
        describe_point(i, limits, result);
    if (min_size == 0)
      for (const Source& source : result) refuse_vanishing(source);
    return result;
  }

private:
  using Index = std::uint32_t;

  // A segment, or a point when a == b, in scaled coordinates; `origin`: index in the caller's arrays.
  struct Feature
  {
    double ax, ay, bx, by, length;
    Index a, b;
    std::size_t origin;
    bool touches(Index v) const { return a == v || b == v; }
  };
  struct Limits
  {
    double tolerance, min_size, max_size;
  };
  // Distance from a point that runs along a segment, and its derivative there (a subgradient: the distance is convex).
  struct Distance
  {
    double value, slope;
  };
  // Two features, one at each end of the segment at hand; a single feature when both are the same.
  using Pair = std::array<Index, 2>;
  // lfs at a parameter along the segment at hand, and which features it comes from.
  struct Sample
  {
    double t, value;
    Pair from;
  };
  // The segment at hand.
  struct Track
  {
    const Feature& self;
    double dx, dy;
    std::vector<Pair> pairs; // features at both ends that aren't incident to each other
    double x(double t) const { return self.ax + t * dx; }
    double y(double t) const { return self.ay + t * dy; }
  };

  void read(const Pslg_2<K>& pslg)
  {
    double largest = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const double c : {CGAL::to_double(points_[i].x()), CGAL::to_double(points_[i].y())}) {
        if (!std::isfinite(c))
          throw Domain_error("point " + std::to_string(i) + " has a coordinate that isn't finite", {i}, {});
        largest = std::max(largest, std::abs(c));
      }
    scale_ = internal::unit_scale(largest);

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

  Distance distance(const Track& track, const Pair& pair, double t) const
  {
    const double x = track.x(t), y = track.y(t);
    const Distance d = distance(features_[pair[0]], x, y, track.dx, track.dy);
    if (pair[0] == pair[1]) return d;
    const Distance e = distance(features_[pair[1]], x, y, track.dx, track.dy);
    return d.value >= e.value ? d : e;
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

  // Points precede segments among the features, in the order of the points that they come from.
  Index vertex_feature(Index v) const
  {
    const auto at = std::partition_point(features_.begin(), features_.end(),
                                         [&](const Feature& f) { return f.length == 0 && f.a < v; });
    return static_cast<Index>(at - features_.begin());
  }

  Track track(std::size_t i) const
  {
    const Feature& self = features_[i];
    Track result{self, (self.bx - self.ax) / self.length, (self.by - self.ay) / self.length, {}};
    const std::vector<Index> at_a = near_star(self, self.a), at_b = near_star(self, self.b);
    for (const Index f : at_a)
      for (const Index g : at_b)
        if (!incident(features_[f], features_[g])) result.pairs.push_back({f, g});
    return result;
  }

  // Smallest distance from (x, y), below `best`, to a feature that touches neither a nor b.
  double nearest(double x, double y, Index a, Index b, double best, Pair& from) const
  {
    const double start = best;
    const double least = tree_.minimise(
        best * best, [&](const internal::Box_2& box) { return box.squared_distance(x, y); },
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

  Sample sample(const Track& track, double t) const
  {
    Sample result{t, std::numeric_limits<double>::infinity(), {}};
    for (const Pair& pair : track.pairs) {
      const double d = distance(track, pair, t).value;
      if (d < result.value) result.value = d, result.from = pair;
    }
    result.value = nearest(track.x(t), track.y(t), track.self.a, track.self.b, result.value, result.from);
    return result;
  }

  // How far the chord from p to q lies above the distance to `pair`, at most, and where: between tangents at both ends.
  struct Excess
  {
    double height, t;
  };
  Excess excess(const Track& track, const Pair& pair, const Sample& p, const Sample& q) const
  {
    const double length = q.t - p.t, chord = (q.value - p.value) / length;
    const Distance at_p = distance(track, pair, p.t), at_q = distance(track, pair, q.t);
    const double falls = at_p.slope - chord, rises = at_q.slope - chord;
    if (falls >= 0 || rises <= 0) return {0, p.t}; // lowest at an end, where it isn't below lfs
    const double up_p = at_p.value - p.value, up_q = at_q.value - q.value;
    const double t = std::clamp((up_p - up_q + rises * length) / (rises - falls), 0., length);
    return {std::max(0., -(up_p + falls * t)), p.t + t};
  }

  // Largest excess over all features that come near enough to the part [p, q] of the segment.
  Excess excess(const Track& track, const Sample& p, const Sample& q, double reach) const
  {
    Excess worst{0, p.t};
    const auto count = [&](const Pair& pair) {
      const Excess e = excess(track, pair, p, q);
      if (e.height > worst.height) worst = e;
    };
    for (const Pair& pair : track.pairs) count(pair);
    const double x = track.x((p.t + q.t) / 2), y = track.y((p.t + q.t) / 2), half = (q.t - p.t) / 2;
    tree_.minimise(
        reach, [&](const internal::Box_2& box) { return gap(box, x, y, track.dx, track.dy, half); },
        [&](Index item, double so_far) {
          const Index i = tree_.order()[item];
          if (!incident(features_[i], track.self)) count({i, i});
          return so_far;
        });
    return worst;
  }

  // Lower bound of the distance from a box to the segment of half length `half` around (x, y) along (dx, dy).
  static double gap(const internal::Box_2& box, double x, double y, double dx, double dy, double half)
  {
    const double cx = box.x - x, cy = box.y - y;
    const double cosine = std::abs(dx * box.dx + dy * box.dy), sine = std::abs(dx * box.dy - dy * box.dx);
    const double along = std::abs(cx * dx + cy * dy) - box.along * cosine - box.across * sine - half;
    const double across = std::abs(cx * dy - cy * dx) - box.along * sine - box.across * cosine;
    const double box_along = std::abs(cx * box.dx + cy * box.dy) - box.along - half * cosine;
    const double box_across = std::abs(cx * box.dy - cy * box.dx) - box.across - half * sine;
    return std::max(std::max(along, across), std::max(box_along, box_across));
  }

  // Splits the segment until lfs is nearly linear on each part.
  void describe_segment(std::size_t i, const Limits& limits, std::vector<Source>& result) const
  {
    const Track along = track(i);
    std::vector<Sample> ends{sample(along, along.self.length), sample(along, 0)}; // the part at hand is the last two
    while (ends.size() > 1) {
      const Sample p = ends.back(), q = ends[ends.size() - 2];
      const double length = q.t - p.t;
      for (const Sample& s : {p, q}) refuse_contact(along, s, limits);
      const double split =
          (p.value + q.value - length) / 2 >= limits.max_size ? 0 : divide(along, p, q, limits, result);
      if (split > p.t && split < q.t)
        ends.insert(ends.end() - 1, sample(along, split));
      else
        ends.pop_back();
    }
  }

  // Adds the part [p, q] as a source, or returns where to split it.
  double divide(const Track& track, const Sample& p, const Sample& q, const Limits& limits,
                std::vector<Source>& result) const
  {
    const double length = q.t - p.t;
    const auto clamped = [&](double t) { return std::clamp(t, p.t + 0.1 * length, q.t - 0.1 * length); };
    if (length < 1e-15) { // as fine as coordinates get: lfs is 1-Lipschitz
      const double low = (p.value + q.value - length) / 2;
      add(track, p, q, p.value - low, q.value - low, result);
      return 0;
    }
    // The nearest feature of one end lies below its chord: lfs exceeds the chord from p to q by no more than `over`.
    const double p_at_q = distance(track, p.from, q.t).value - q.value;
    const double q_at_p = distance(track, q.from, p.t).value - p.value;
    const double over = std::max(0., std::min(p_at_q, q_at_p)), least = std::min(p.value, q.value);
    if (over > limits.tolerance * std::max(least, limits.min_size))
      return clamped(p.t + length * q_at_p / (p_at_q + q_at_p)); // where the two chords cross
    const Excess under = excess(track, p, q, std::max(p.value, q.value) + over);
    if (over + under.height > limits.tolerance * std::max(least - under.height, limits.min_size))
      return clamped(under.t);
    add(track, p, q, under.height, under.height, result);
    return 0;
  }

  void add(const Track& track, const Sample& p, const Sample& q, double p_less, double q_less,
           std::vector<Source>& result) const
  {
    result.push_back({Point(track.x(p.t) / scale_, track.y(p.t) / scale_),
                      Point(track.x(q.t) / scale_, track.y(q.t) / scale_), (p.value - p_less) / scale_,
                      (q.value - q_less) / scale_});
  }

  void describe_point(std::size_t i, const Limits& limits, std::vector<Source>& result) const
  {
    const Feature& f = features_[i];
    Pair from{};
    const double value = nearest(f.ax, f.ay, f.a, f.a, std::numeric_limits<double>::infinity(), from);
    if (!std::isfinite(value)) return;
    if (value < contact && limits.min_size == 0) refuse_contact(f, features_[from[0]]);
    if (value < limits.max_size) result.push_back({points_[f.a], points_[f.a], value / scale_, value / scale_});
  }

  void refuse_contact(const Track& track, const Sample& s, const Limits& limits) const
  {
    if (limits.min_size == 0 && s.value < contact && s.from[0] == s.from[1])
      refuse_contact(track.self, features_[s.from[0]]);
  }

  static void refuse_vanishing(const Source& source)
  {
    if (source.source_size > 0 && source.target_size > 0) return;
    const Point& at = source.source_size > 0 ? source.target : source.source;
    throw Domain_error("the local feature size rounds to 0 near (" + std::to_string(CGAL::to_double(at.x())) + ", " +
                           std::to_string(CGAL::to_double(at.y())) + "): a smallest size is needed",
                       {}, {});
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

  // Below this distance, in units of the input's extent, features may be in contact: then the kernel decides.
  static constexpr double contact = 1e-12;

  std::vector<Point> points_;
  double scale_ = 1;
  std::vector<Feature> features_;         // points first
  std::vector<std::vector<Index>> stars_; // segments at each point
  internal::Box_tree_2 tree_;
};

} // namespace weft

#endif // WEFT_PLANAR_SIZING_LOCAL_FEATURE_SIZE_2_H
