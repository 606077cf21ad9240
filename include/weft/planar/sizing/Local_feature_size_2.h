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
#include <weft/planar/sizing/Pslg_features_2.h>
#include <weft/sizing/Lipschitz_sizing_2.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
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
  explicit Local_feature_size_2(const Pslg_2<K>& pslg) : features_(pslg) {}

  /// Segments and isolated points with sizes h that are linear on each, such that on all features h <= lfs <= h +
  /// tolerance * max(h, min_size). Parts where lfs is max_size or more are left out. Each source costs a few queries of
  /// O(log n) where no point has very many segments.
  ///
  /// \param tolerance relative error, in (0, 1].
  /// \throws Domain_error when `min_size` is 0 and features meet without sharing a point: lfs is 0 there; or come so
  /// near to each other that lfs rounds to 0.
  std::vector<Source> sources(double tolerance, double min_size, double max_size) const
  {
    std::vector<Source> result;
    const Limits limits{tolerance, min_size * features_.scale(), max_size * features_.scale()};
    for (std::size_t i = 0; i < features_.size(); ++i)
      if (features_[i].length > 0)
        describe_segment(i, limits, result);
      else if (features_.star(features_[i].a).empty())
        describe_point(i, limits, result);
    if (min_size == 0)
      for (const Source& source : result) refuse_vanishing(source);
    return result;
  }

private:
  using Features = internal::Pslg_features_2<K>;
  using Index = typename Features::Index;
  using Pair = typename Features::Pair;
  using Feature = typename Features::Feature;
  using Distance = typename Features::Distance;

  struct Limits
  {
    double tolerance, min_size, max_size;
  };
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

  Distance distance(const Track& track, const Pair& pair, double t) const
  {
    const double x = track.x(t), y = track.y(t);
    const Distance d = Features::distance(features_[pair[0]], x, y, track.dx, track.dy);
    if (pair[0] == pair[1]) return d;
    const Distance e = Features::distance(features_[pair[1]], x, y, track.dx, track.dy);
    return d.value >= e.value ? d : e;
  }

  Track track(std::size_t i) const
  {
    const Feature& self = features_[i];
    Track result{self, (self.bx - self.ax) / self.length, (self.by - self.ay) / self.length, {}};
    const std::vector<Index> at_a = features_.near_star(self, self.a), at_b = features_.near_star(self, self.b);
    for (const Index f : at_a)
      for (const Index g : at_b)
        if (!Features::incident(features_[f], features_[g])) result.pairs.push_back({f, g});
    return result;
  }

  Sample sample(const Track& track, double t) const
  {
    Sample result{t, std::numeric_limits<double>::infinity(), {}};
    for (const Pair& pair : track.pairs) {
      const double d = distance(track, pair, t).value;
      if (d < result.value) result.value = d, result.from = pair;
    }
    result.value = features_.nearest(track.x(t), track.y(t), track.self.a, track.self.b, result.value, result.from);
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
    features_.tree().minimise(
        reach, [&](const internal::Box_2& box) { return gap(box, x, y, track.dx, track.dy, half); },
        [&](Index item, double so_far) {
          const Index i = features_.tree().order()[item];
          if (!Features::incident(features_[i], track.self)) count({i, i});
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
    result.push_back({Point(track.x(p.t) / features_.scale(), track.y(p.t) / features_.scale()),
                      Point(track.x(q.t) / features_.scale(), track.y(q.t) / features_.scale()),
                      (p.value - p_less) / features_.scale(), (q.value - q_less) / features_.scale()});
  }

  void describe_point(std::size_t i, const Limits& limits, std::vector<Source>& result) const
  {
    const Feature& f = features_[i];
    Pair from{};
    const double value = features_.nearest(f.ax, f.ay, f.a, f.a, std::numeric_limits<double>::infinity(), from);
    if (!std::isfinite(value)) return;
    if (value < contact && limits.min_size == 0) features_.refuse_contact(f, features_[from[0]]);
    if (value < limits.max_size)
      result.push_back(
          {features_.point(f.a), features_.point(f.a), value / features_.scale(), value / features_.scale()});
  }

  void refuse_contact(const Track& track, const Sample& s, const Limits& limits) const
  {
    if (limits.min_size == 0 && s.value < contact && s.from[0] == s.from[1])
      features_.refuse_contact(track.self, features_[s.from[0]]);
  }

  static void refuse_vanishing(const Source& source)
  {
    if (source.source_size > 0 && source.target_size > 0) return;
    const Point& at = source.source_size > 0 ? source.target : source.source;
    throw Domain_error("the local feature size rounds to 0 near (" + std::to_string(CGAL::to_double(at.x())) + ", " +
                           std::to_string(CGAL::to_double(at.y())) + "): a smallest size is needed",
                       {}, {});
  }

  // Below this distance, in units of the input's extent, features may be in contact: then the kernel decides.
  static constexpr double contact = 1e-12;

  Features features_;
};

} // namespace weft

#endif // WEFT_PLANAR_SIZING_LOCAL_FEATURE_SIZE_2_H
