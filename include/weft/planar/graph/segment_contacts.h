// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the segments of a planar straight line graph touch other than at their ends. Candidates come from CGAL's
// intersection of boxes (Zomorodian and Edelsbrunner, "Fast software for box intersections", 2002), so the cost is
// O(n log² n + pairs of overlapping boxes); exact predicates decide about each of them.

#ifndef WEFT_PLANAR_GRAPH_SEGMENT_CONTACTS_H
#define WEFT_PLANAR_GRAPH_SEGMENT_CONTACTS_H

#include <CGAL/box_intersection_d.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace weft::internal {

using Index_pair = std::array<std::size_t, 2>;

/// Contacts between segments, each list sorted.
struct Segment_contacts
{
  std::vector<Index_pair> crossings; ///< pairs of segments whose interiors share exactly one point
  std::vector<Index_pair> overlaps;  ///< pairs of segments that share more than a point
  std::vector<Index_pair> touching;  ///< (segment, point): the point lies in the interior of the segment
};

/// The predicates for points and segments given as indices.
template <class K>
class Segment_predicates
{
public:
  Segment_predicates(const std::vector<typename K::Point_2>& points, const std::vector<Index_pair>& segments)
      : points_(points), segments_(segments)
  {}

  bool in_interior(std::size_t s, std::size_t p) const
  {
    const auto [a, b] = segments_[s];
    return p != a && p != b && side(s, p) == CGAL::COLLINEAR &&
           typename K::Collinear_are_strictly_ordered_along_line_2()(points_[a], points_[p], points_[b]);
  }

  bool cross(std::size_t s, std::size_t t) const
  {
    return side(s, segments_[t][0]) * side(s, segments_[t][1]) < 0 &&
           side(t, segments_[s][0]) * side(t, segments_[s][1]) < 0;
  }

  bool overlap(std::size_t s, std::size_t t) const
  {
    const auto [a, b] = segments_[t];
    if (side(s, a) != CGAL::COLLINEAR || side(s, b) != CGAL::COLLINEAR) return false;
    return in_interior(s, a) || in_interior(s, b) || in_interior(t, segments_[s][0]) || in_interior(t, segments_[s][1]);
  }

private:
  CGAL::Orientation side(std::size_t s, std::size_t p) const
  {
    return typename K::Orientation_2()(points_[segments_[s][0]], points_[segments_[s][1]], points_[p]);
  }

  const std::vector<typename K::Point_2>& points_;
  const std::vector<Index_pair>& segments_;
};

/// Finds all contacts. Points must be distinct, segments distinct and of positive length.
template <class K>
Segment_contacts segment_contacts(const std::vector<typename K::Point_2>& points,
                                  const std::vector<Index_pair>& segments)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  std::vector<Box> point_boxes, segment_boxes;
  for (std::size_t i = 0; i < points.size(); ++i) point_boxes.emplace_back(points[i].bbox(), i);
  for (std::size_t i = 0; i < segments.size(); ++i)
    segment_boxes.emplace_back(points[segments[i][0]].bbox() + points[segments[i][1]].bbox(), i);

  const Segment_predicates<K> predicates(points, segments);
  Segment_contacts contacts;
  CGAL::box_self_intersection_d(segment_boxes.begin(), segment_boxes.end(), [&](const Box& a, const Box& b) {
    const std::size_t s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
    if (predicates.cross(s, t))
      contacts.crossings.push_back({s, t});
    else if (predicates.overlap(s, t))
      contacts.overlaps.push_back({s, t});
  });
  CGAL::box_intersection_d(segment_boxes.begin(), segment_boxes.end(), point_boxes.begin(), point_boxes.end(),
                           [&](const Box& a, const Box& b) {
                             if (predicates.in_interior(a.info(), b.info()))
                               contacts.touching.push_back({a.info(), b.info()});
                           });
  // The boxes come in no particular order.
  for (auto* list : {&contacts.crossings, &contacts.overlaps, &contacts.touching})
    std::sort(list->begin(), list->end());
  return contacts;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_GRAPH_SEGMENT_CONTACTS_H
