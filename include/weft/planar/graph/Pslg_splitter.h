// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks a planar straight line graph and, where that is wanted, splits its segments until they meet at their ends
// only. Crossings are computed exactly and rounded once; since rounding may make new contacts, they are looked for
// again until there are none. With a tolerance, what is nearly in contact counts as in contact: close points are one,
// and a segment is split at, and so bent to, the points within the tolerance of it.

#ifndef WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H
#define WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/graph/pslg_near_contacts.h>
#include <weft/planar/graph/segment_contacts.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft::internal {

/// Turns a graph into segments that meet at their ends only.
template <class K>
class Pslg_splitter
{
public:
  using Point = typename K::Point_2;

  /// Checks the graph, merges what is equal and drops segments of length zero; contacts between segments are left.
  /// \param tolerance in parts of the extent; 0: exact.
  Pslg_splitter(const Pslg_2<K>& pslg, double tolerance) : first_number_(pslg.first_number)
  {
    take_points(pslg);
    take_segments(pslg);
    if (tolerance > 0) changes_.tolerance = tolerance_length(tolerance);
  }

  /// The tolerance as a length.
  double tolerance() const { return changes_.tolerance; }

  /// Makes one of points that are no farther apart than the tolerance, and splits segments at points within it.
  /// \returns whether there were any. Without a tolerance there are none.
  bool join_what_is_close()
  {
    if (!(tolerance() > 0)) return false;
    bool any = !spaced_ && join_close_points();
    // Each split makes shorter pieces between points that exist, so this ends; the bound is on the time it takes.
    for (int round = 0; round < most_rounds; ++round) {
      const auto contacts = points_near_segments<K>(points, segments, tolerance());
      const bool none_is_near = std::none_of(contacts.begin(), contacts.end(), [this](const Index_pair& contact) {
        return !Segment_predicates<K>(points, segments).in_interior(contact[0], contact[1]);
      });
      if (none_is_near) break;
      any = true;
      note_splits(contacts);
      split({{}, {}, contacts});
    }
    return any;
  }

  /// Removes all contacts between segments, or refuses them. Overlaps are refused only without a tolerance.
  void split_until_clean(Crossings crossings)
  {
    // Two or three rounds are the rule: rounded crossings seldom touch anything. The bound is there to end for sure.
    for (int round = 0; round < most_rounds; ++round) {
      join_what_is_close();
      Segment_contacts contacts = segment_contacts<K>(points, segments);
      if (tolerance() > 0) contacts.overlaps.clear();
      if (crossings == Crossings::refuse) refuse(contacts);
      split(contacts);
      // Splitting at points that are exactly on a segment creates no new contacts.
      if (contacts.crossings.empty()) return;
    }
    refuse(segment_contacts<K>(points, segments));
  }

  std::vector<Point> points;              ///< distinct
  std::vector<std::size_t> point_of;      ///< index into `points` per input point
  std::vector<Index_pair> segments;       ///< pieces, distinct
  std::vector<std::size_t> input_segment; ///< input segment per piece

  /// What was joined, in numbers and in words.
  Pslg_changes changes() const
  {
    Pslg_changes result = changes_;
    const auto add = [&](const std::string& first, std::size_t count) {
      if (count > 0)
        result.notes.push_back(first + (count > 1 ? " (and " + counted(count - 1, "other", "others") + ")" : ""));
    };
    const auto& [tolerance, merged, split, dropped, overlapping, notes] = changes_;
    if (!merged.empty())
      add("point " + numbered(merged[0][0]) + ", is joined to point " + number(merged[0][1]) + " close to it",
          merged.size());
    if (!dropped.empty()) add("segment " + numbered(dropped[0]) + ", has length zero and is left out", dropped.size());
    if (!split.empty())
      add("segment " + numbered(split[0][0]) + ", is split at point " + number(split[0][1]) + " close to it",
          split.size());
    if (!overlapping.empty())
      add("segments " + number(overlapping[0][0]) + " and " + numbered(overlapping[0][1]) +
              ", have a common part, which is one constraint",
          overlapping.size());
    return result;
  }

private:
  static constexpr int most_rounds = 50;

  /// Coordinates are rounded to units in the last place, whatever the extent: two of them for a point, two for what it
  /// should meet.
  double tolerance_length(double relative) const
  {
    CGAL::Bbox_2 box;
    for (const Index_pair& s : segments) box += points[s[0]].bbox() + points[s[1]].bbox();
    const double extent = (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    const double largest =
        (std::max)({std::abs(box.xmin()), std::abs(box.xmax()), std::abs(box.ymin()), std::abs(box.ymax())});
    return (std::max)(relative * extent, 4 * std::numeric_limits<double>::epsilon() * largest);
  }

  /// Points are taken in order, and each stays unless one near it has stayed: so no chain of points shrinks to one.
  /// \returns whether any two were close.
  bool join_close_points()
  {
    spaced_.emplace(tolerance());
    std::vector<std::size_t> kept_as(points.size());
    std::vector<Point> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      kept_as[i] = spaced_->add(points[i], kept.size());
      if (kept_as[i] == kept.size()) kept.push_back(points[i]);
    }
    if (kept.size() == points.size()) return false;
    for (std::size_t i = 0; i < point_of.size(); ++i) {
      const Point before = points[point_of[i]];
      point_of[i] = kept_as[point_of[i]];
      if (kept[point_of[i]] != before) changes_.merged_points.push_back({i, 0});
    }
    points.swap(kept);
    index_.clear();
    for (std::size_t i = 0; i < points.size(); ++i) index_.emplace(points[i], i);
    const std::vector<std::size_t> first = first_input_point();
    for (auto& [from, to] : changes_.merged_points) to = first[point_of[from]];

    std::size_t kept_segments = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const Index_pair ends = {kept_as[segments[s][0]], kept_as[segments[s][1]]};
      if (ends[0] == ends[1]) {
        changes_.dropped_segments.push_back(input_segment[s]);
        continue;
      }
      segments[kept_segments] = ends;
      input_segment[kept_segments++] = input_segment[s];
    }
    segments.resize(kept_segments);
    input_segment.resize(kept_segments);
    std::sort(changes_.dropped_segments.begin(), changes_.dropped_segments.end());
    note_overlaps();
    merge_equal_segments();
    return true;
  }

  static constexpr std::size_t no_point = static_cast<std::size_t>(-1);

  /// The first input point at each point, or `no_point` for a crossing.
  std::vector<std::size_t> first_input_point() const
  {
    std::vector<std::size_t> first(points.size(), no_point);
    for (std::size_t i = point_of.size(); i-- > 0;) first[point_of[i]] = i;
    return first;
  }

  void note_splits(const std::vector<Index_pair>& contacts)
  {
    const std::vector<std::size_t> first = first_input_point();
    const Segment_predicates<K> predicates(points, segments);
    for (const auto& [s, p] : contacts)
      if (first[p] != no_point && !predicates.in_interior(s, p))
        changes_.split_segments.push_back({input_segment[s], first[p]});
  }

  void take_points(const Pslg_2<K>& pslg)
  {
    if (pslg.points.empty()) throw Domain_error("the input has no points", {}, {});
    for (std::size_t i = 0; i < pslg.points.size(); ++i) {
      require_finite(pslg.points[i], "point " + numbered(i) + ",", {i});
      point_of.push_back(add_point(pslg.points[i]));
    }
    for (std::size_t i = 0; i < pslg.holes.size(); ++i)
      require_finite(pslg.holes[i], "the point of hole " + numbered(i) + ",", {});
    for (std::size_t i = 0; i < pslg.regions.size(); ++i)
      require_finite(pslg.regions[i].point, "the point of region " + numbered(i) + ",", {});
  }

  std::string number(std::size_t i) const { return std::to_string(i + first_number_); }

  /// "5, counted from 1".
  std::string numbered(std::size_t i) const { return number(i) + ", counted from " + std::to_string(first_number_); }

  static void require_finite(const Point& p, const std::string& name, std::vector<std::size_t> vertices)
  {
    if (!std::isfinite(CGAL::to_double(p.x())) || !std::isfinite(CGAL::to_double(p.y())))
      throw Domain_error(name + " has a coordinate that is not finite", std::move(vertices), {});
  }

  /// Exactly equal points are one; so are close ones once a graph is being split with a tolerance.
  std::size_t add_point(const Point& p)
  {
    const auto found = index_.find(p);
    if (found != index_.end()) return found->second;
    const std::size_t i = spaced_ ? spaced_->add(p, points.size()) : points.size();
    if (i < points.size()) return i;
    index_.emplace(p, i);
    points.push_back(p);
    return i;
  }

  void take_segments(const Pslg_2<K>& pslg)
  {
    if (pslg.segments.empty()) throw Domain_error("the input has no segments, so it encloses no region", {}, {});
    for (std::size_t s = 0; s < pslg.segments.size(); ++s) {
      for (const std::size_t end : pslg.segments[s])
        if (end >= point_of.size())
          throw Domain_error("segment " + numbered(s) + ", refers to point " + std::to_string(end + first_number_) +
                                 ", which doesn't exist",
                             {}, {s});
      const Index_pair ends = {point_of[pslg.segments[s][0]], point_of[pslg.segments[s][1]]};
      if (ends[0] == ends[1]) {
        changes_.dropped_segments.push_back(s);
        continue;
      }
      segments.push_back(ends);
      input_segment.push_back(s);
    }
    if (segments.empty())
      throw Domain_error("all segments have length zero, so they enclose no region",
                         {pslg.segments[0][0], pslg.segments[0][1]}, {});
    merge_equal_segments();
  }

  /// Of equal segments the one with the lowest input number stays; the order of the others is kept.
  void merge_equal_segments()
  {
    std::map<Index_pair, std::size_t> owner;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto place = owner.emplace(sorted(segments[s]), input_segment[s]).first;
      place->second = std::min(place->second, input_segment[s]);
    }
    std::size_t kept = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto place = owner.find(sorted(segments[s]));
      if (place == owner.end()) continue;
      segments[kept] = segments[s];
      input_segment[kept++] = place->second;
      owner.erase(place);
    }
    segments.resize(kept);
    input_segment.resize(kept);
  }

  static Index_pair sorted(const Index_pair& s) { return {std::min(s[0], s[1]), std::max(s[0], s[1])}; }

  void refuse(const Segment_contacts& contacts) const
  {
    refuse(contacts.overlaps, "overlap");
    refuse(contacts.crossings, "cross");
  }

  void refuse(const std::vector<Index_pair>& pairs, const std::string& verb) const
  {
    if (pairs.empty()) return;
    const std::size_t s = input_segment[pairs[0][0]], t = input_segment[pairs[0][1]];
    std::string more;
    if (pairs.size() > 1) more = " (and " + counted(pairs.size() - 1, "other pair", "other pairs") + ")";
    throw Domain_error("segments " + std::to_string(s + first_number_) + " and " + numbered(t) + ", " + verb + more, {},
                       {s, t});
  }

  /// Splits every segment at the points that lie on it and at its rounded crossings.
  void split(const Segment_contacts& contacts)
  {
    std::vector<std::vector<std::size_t>> on_segment(segments.size());
    for (const auto& [s, p] : contacts.touching) on_segment[s].push_back(p);
    for (const auto& [s, t] : contacts.crossings) {
      const std::size_t p = add_point(crossing(segments[s], segments[t]));
      on_segment[s].push_back(p);
      on_segment[t].push_back(p);
    }
    std::vector<Index_pair> pieces;
    std::vector<std::size_t> piece_of;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      auto& chain = on_segment[s];
      sort_along(segments[s], chain);
      chain.push_back(segments[s][1]);
      std::size_t from = segments[s][0];
      for (const std::size_t to : chain) {
        if (from == to) continue; // the rounded crossing is an end, or another crossing
        pieces.push_back({from, to});
        piece_of.push_back(input_segment[s]);
        from = to;
      }
    }
    segments.swap(pieces);
    input_segment.swap(piece_of);
    note_overlaps();
    merge_equal_segments();
  }

  /// Pieces that are equal after a split are the common part of two segments.
  void note_overlaps()
  {
    std::map<Index_pair, std::size_t> owner;
    std::set<Index_pair> pairs(changes_.overlapping_segments.begin(), changes_.overlapping_segments.end());
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto [place, is_new] = owner.emplace(sorted(segments[s]), input_segment[s]);
      if (!is_new && place->second != input_segment[s]) pairs.insert(sorted({place->second, input_segment[s]}));
    }
    changes_.overlapping_segments.assign(pairs.begin(), pairs.end());
  }

  /// By distance from the first end; points at equal distance by index.
  void sort_along(const Index_pair& segment, std::vector<std::size_t>& chain) const
  {
    const Point& origin = points[segment[0]];
    const typename K::Compare_distance_2 compare{};
    std::sort(chain.begin(), chain.end(), [&](std::size_t p, std::size_t q) {
      const auto order = compare(origin, points[p], points[q]);
      return order == CGAL::EQUAL ? p < q : order == CGAL::SMALLER;
    });
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
  }

  /// The common point of two crossing segments: computed exactly, then each coordinate rounded.
  Point crossing(const Index_pair& s, const Index_pair& t) const
  {
    using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
    const CGAL::Cartesian_converter<K, Exact> exact;
    const auto a = exact(points[s[0]]), b = exact(points[s[1]]), c = exact(points[t[0]]), d = exact(points[t[1]]);
    const auto across = [](const Exact::Vector_2& u, const Exact::Vector_2& v) {
      return CGAL::Exact_rational(u.x() * v.y() - u.y() * v.x());
    };
    const Exact::Point_2 p = a + (across(c - a, d - c) / across(b - a, d - c)) * (b - a);
    return Point(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
  }

  std::map<Point, std::size_t> index_;
  std::size_t first_number_;
  std::optional<Spaced_points_2<K>> spaced_; ///< once close points have been joined
  Pslg_changes changes_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H
