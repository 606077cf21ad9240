// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks a planar straight line graph and, where that is wanted, splits its segments until they meet at their ends
// only. Crossings are computed exactly and rounded once; since rounding may make new contacts, they are looked for
// again until there are none.

#ifndef WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H
#define WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H

#include <weft/errors.h>
#include <weft/internal/counted.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/graph/segment_contacts.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
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

  /// Checks the graph and merges what is equal; contacts between segments are left.
  explicit Pslg_splitter(const Pslg_2<K>& pslg) : first_number_(pslg.first_number)
  {
    take_points(pslg);
    take_segments(pslg);
  }

  /// Removes all contacts between segments, or refuses them.
  void split_until_clean(Crossings crossings)
  {
    // Two or three rounds are the rule: rounded crossings seldom touch anything. The bound is there to end for sure.
    constexpr int most_rounds = 50;
    for (int round = 0; round < most_rounds; ++round) {
      const Segment_contacts contacts = segment_contacts<K>(points, segments);
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

private:
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

  /// "5, counted from 1".
  std::string numbered(std::size_t i) const
  {
    return std::to_string(i + first_number_) + ", counted from " + std::to_string(first_number_);
  }

  static void require_finite(const Point& p, const std::string& name, std::vector<std::size_t> vertices)
  {
    if (!std::isfinite(CGAL::to_double(p.x())) || !std::isfinite(CGAL::to_double(p.y())))
      throw Domain_error(name + " has a coordinate that is not finite", std::move(vertices), {});
  }

  /// Exactly equal points are one.
  std::size_t add_point(const Point& p)
  {
    const auto [place, is_new] = index_.emplace(p, points.size());
    if (is_new) points.push_back(p);
    return place->second;
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
      if (ends[0] == ends[1])
        throw Domain_error("segment " + numbered(s) + ", has length zero", {pslg.segments[s][0], pslg.segments[s][1]},
                           {s});
      segments.push_back(ends);
      input_segment.push_back(s);
    }
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
    merge_equal_segments();
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
};

} // namespace weft::internal

#endif // WEFT_PLANAR_GRAPH_PSLG_SPLITTER_H
