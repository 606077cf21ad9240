// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles in a bounding volume hierarchy, and the queries of a domain oracle on them. Floats rule out, exact
// predicates decide, doubles construct.

#ifndef WEFT_INTERNAL_BOXES_TRIANGLE_HIERARCHY_3_H
#define WEFT_INTERNAL_BOXES_TRIANGLE_HIERARCHY_3_H

#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/nearest_point_3.h>
#include <weft/internal/boxes/perturbed_crossing_3.h>
#include <weft/internal/boxes/Triangle_block_4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace weft::internal {

template <class K>
class Triangle_hierarchy_3
{
public:
  using Point = typename K::Point_3;
  using Triangle = Surface_triangle_3<K>;
  using Contact = Contact_3<Point>;

  struct Nearest
  {
    Point point;
    double squared_distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = Contact::inside;
    int patch = -1;
  };

  Triangle_hierarchy_3() = default;

  explicit Triangle_hierarchy_3(const std::vector<Triangle>& triangles)
  {
    std::vector<Box_3> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const Point& p : triangles[i].points) boxes[i].add(p.x(), p.y(), p.z());
    box_ = bounding_box(boxes);
    boxes_ = Box_hierarchy_3(boxes);
    blocks_.resize(boxes_.number_of_blocks());
    triangles_.resize(boxes_.items().size());
    for (std::size_t i = 0; i < boxes_.items().size(); ++i) {
      const std::uint32_t item = boxes_.items()[i];
      if (item == Box_hierarchy_3::nothing) continue;
      triangles_[i] = triangles[item];
      const auto& p = triangles[item].points;
      blocks_[i / 4].set(i % 4, framed(p[0]), framed(p[1]), framed(p[2]));
    }
  }

  const Box_3& box() const { return box_; }

  /// Calls `visit(pair)` for the triangles that the segment pq may touch, until one call returns true.
  template <class Visit>
  bool visit_segment(const Point& p, const Point& q, const Visit& visit) const
  {
    return visit_near_segment(p, q, [&](const Triangle& triangle) {
      const Segment_and_triangle_3<K> pair(p, q, triangle);
      return !pair.misses() && visit(pair);
    });
  }

  /// Calls `visit(triangle)` for the triangles that floats don't rule out, until one call returns true.
  template <class Visit>
  bool visit_near_segment(const Point& p, const Point& q, const Visit& visit) const
  {
    const Framed_segment_3 part = boxes_.clip(framed(p), framed(q));
    return boxes_.visit_segment(part, [&](std::uint32_t block) {
      for (unsigned bits = blocks_[block].segment_candidates(part.origin, part.direction), lane = 0; bits;
           bits >>= 1, ++lane)
        if ((bits & 1) && visit(triangles_[4 * block + lane])) return true;
      return false;
    });
  }

  /// The subdomain that a point lies in, 0 outside and on the surface, if the surface is closed. On the way to the
  /// outside every crossing changes the subdomain; the changes cancel out by exclusive or, in whatever order they come.
  int subdomain(const Point& p) const
  {
    const Xyz_3 x = xyz(p);
    if (boxes_.empty() || !is_in_box(x)) return 0;
    std::size_t axis = 0;
    bool upwards = false;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      if (x[k] - box_.low[k] < shortest) shortest = x[k] - box_.low[k], axis = k, upwards = false;
      if (box_.high[k] - x[k] < shortest) shortest = box_.high[k] - x[k], axis = k, upwards = true;
    }
    const std::array<float, 3> from = rounded(framed(p));
    int label = 0;
    const bool on_surface = boxes_.visit_ray(from, axis, upwards, [&](std::uint32_t block) {
      for (unsigned bits = blocks_[block].line_candidates(from, axis), lane = 0; bits; bits >>= 1, ++lane) {
        if (!(bits & 1)) continue;
        const Triangle& triangle = triangles_[4 * block + lane];
        const Ray_event event = ray_event(p, axis, upwards, triangle);
        if (event == Ray_event::starts_on_triangle) return true;
        if (event == Ray_event::crossing) label ^= triangle.change;
      }
      return false;
    });
    return on_surface ? 0 : label;
  }

  /// Nearest point of the surface; equally near ones: that of the triangle with the smallest index.
  Nearest nearest(const Point& p) const
  {
    Nearest best;
    std::array<Candidate_triangle, 64> candidates;
    std::size_t count = 0;
    const float limit = visit_candidates(p, [&](const Float_4& lower, std::uint32_t block, float limit_so_far) {
      alignas(16) float bounds[4];
      lower.store(bounds);
      for (std::uint32_t lane = 0; lane < 4; ++lane) {
        candidates[count] = {bounds[lane], 4 * block + lane};
        count += bounds[lane] < limit_so_far; // not of a missing triangle: NaN
      }
      if (count + 4 <= candidates.size()) return;
      for (std::size_t i = 0; i < count; ++i)
        if (candidates[i].bound < limit_so_far) improve(p, triangles_[candidates[i].triangle], best);
      count = 0;
    });
    for (std::size_t i = 0; i < count; ++i)
      if (candidates[i].bound < limit) improve(p, triangles_[candidates[i].triangle], best);
    return best;
  }

  /// Whether the surface comes as near to p as that: mostly known from the first triangles that are looked at.
  bool is_within(const Point& p, double squared_distance) const
  {
    if (boxes_.empty()) return false;
    const std::array<float, 3> from = rounded(framed(p));
    const double distance = std::sqrt(squared_distance) * boxes_.frame().scale, error = 2 * distance_error(from);
    const double least = std::max(0., distance * (1 - 1e-6) - error), most = distance * (1 + 1e-6) + error;
    const auto surely = static_cast<float>(least * least * (1 - 1e-6));
    const Float_4 infinity = std::numeric_limits<float>::infinity();
    const auto reaches = [&](std::uint32_t block) {
      return smallest(min(blocks_[block].squared_distances(from).upper, infinity)) < surely;
    };
    thread_local std::uint32_t last = 0; // questions come in groups about points near each other
    if (last < blocks_.size() && reaches(last)) return true;
    bool found = false;
    boxes_.visit_nearest(from, static_cast<float>(most * most * (1 + 1e-6)), [&](std::uint32_t block, float limit) {
      if (found || !reaches(block)) return found ? 0.f : limit;
      last = block;
      found = true;
      return 0.f;
    });
    return found || nearest(p).squared_distance <= squared_distance;
  }

  /// Calls `visit(triangle)` for the triangles that are as near to p as that, in no order, until one call returns true;
  /// whether one did.
  template <class Visit>
  bool visit_within(const Point& p, double squared_distance, const Visit& visit) const
  {
    if (boxes_.empty()) return false;
    const std::array<float, 3> from = rounded(framed(p));
    const double most =
        std::sqrt(squared_distance) * boxes_.frame().scale * (1 + 1e-6) + 2 * double(distance_error(from));
    bool found = false;
    boxes_.visit_nearest(from, static_cast<float>(most * most * (1 + 1e-6)), [&](std::uint32_t block, float limit) {
      alignas(16) float lower[4];
      blocks_[block].squared_distances(from).lower.store(lower);
      for (std::uint32_t lane = 0; lane < 4 && !found; ++lane) {
        if (!(lower[lane] < limit)) continue; // or it is missing: NaN
        const Triangle& t = triangles_[4 * block + lane];
        const Xyz_3 d = difference(nearest_point_on_triangle(p, t.points[0], t.points[1], t.points[2]), p);
        found = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= squared_distance && visit(t);
      }
      return found ? 0.f : limit;
    });
    return found;
  }

  /// A lower bound of the distance to the surface that is at most some 1e-6 diagonals of the box too small.
  double clearance(const Point& p) const
  {
    if (boxes_.empty()) return std::numeric_limits<double>::infinity();
    Float_4 least = std::numeric_limits<float>::infinity();
    visit_candidates(p, [&](const Float_4& lower, std::uint32_t, float) { least = min(lower, least); });
    const double distance =
        std::sqrt(static_cast<double>(smallest(least))) * (1 - 1e-6) - distance_error(rounded(framed(p)));
    return std::max(0., distance / boxes_.frame().scale);
  }

private:
  std::array<double, 3> framed(const Point& p) const { return boxes_.frame()(p.x(), p.y(), p.z()); }

  static std::array<float, 3> rounded(const std::array<double, 3>& p)
  {
    return {{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}};
  }

  bool is_in_box(const Xyz_3& x) const
  {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(box_.low[k] <= x[k] && x[k] <= box_.high[k])) return false;
    return true;
  }

  // More than what floats can be wrong by in a distance from p, 2^-24 being half a unit in the last place of 1.
  static float distance_error(const std::array<float, 3>& p)
  {
    return (1 + std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])})) * (32.f / (1 << 24));
  }

  struct Candidate_triangle
  {
    float bound; // lower bound of the squared distance, by floats
    std::uint32_t triangle;
  };

  // Calls `visit(lower, block, limit)` for all blocks that can hold a nearest triangle: those with a lower bound of the
  // squared distance below the limit, which falls. Returns the last limit. Floats only.
  template <class Visit>
  float visit_candidates(const Point& p, const Visit& visit) const
  {
    const std::array<float, 3> from = rounded(framed(p));
    const float error = 2 * distance_error(from); // of the bound above that becomes the limit, and of those below it
    float least = std::numeric_limits<float>::infinity(), last = least;
    boxes_.visit_nearest(from, least, [&](std::uint32_t block, float limit) {
      const auto bounds = blocks_[block].squared_distances(from);
      const float upper = smallest(min(bounds.upper, Float_4(least)));
      if (upper < least) {
        least = upper;
        const float distance = std::sqrt(upper) * (1 + 1e-6f) + error;
        limit = std::min(limit, distance * distance * (1 + 1e-6f));
      }
      visit(bounds.lower, block, limit);
      return last = limit;
    });
    return last;
  }

  static void improve(const Point& p, const Triangle& t, Nearest& best)
  {
    const Point x = nearest_point_on_triangle(p, t.points[0], t.points[1], t.points[2]);
    const Xyz_3 d = difference(x, p);
    const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared > best.squared_distance || (squared == best.squared_distance && t.index > best.triangle)) return;
    best = {x, squared, t.index, t.patch};
  }

  Box_hierarchy_3 boxes_;
  Box_3 box_;
  std::vector<Triangle_block_4> blocks_;
  std::vector<Triangle> triangles_; // four for each block; those that are missing are never asked for
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_TRIANGLE_HIERARCHY_3_H
