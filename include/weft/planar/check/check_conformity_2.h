// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the constrained edges of a mesh are the segments of the graph that it was made from. What is rounded, namely
// vertices on segments, may lie a few units in the last place off; all else is exact.

#ifndef WEFT_PLANAR_CHECK_CHECK_CONFORMITY_2_H
#define WEFT_PLANAR_CHECK_CHECK_CONFORMITY_2_H

#include <weft/planar/check/Validity_2.h>
#include <weft/planar/graph/Pslg_2.h>
#include <weft/planar/mesh/Scaled_triangle_2.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace weft {

namespace internal {

/// How many units in the last place of the largest coordinate a vertex may lie off its segment, for being rounded.
constexpr double most_ulps_off_segment = 8;

inline double ulps_of(double coordinate, double ulps)
{
  return ulps * std::numeric_limits<double>::epsilon() * coordinate;
}

template <class Point>
double largest_coordinate(const Point& p)
{
  return (std::max)(std::abs(CGAL::to_double(p.x())), std::abs(CGAL::to_double(p.y())));
}

/// Constrained edges as chains between input points and forks, and the segments matched with them.
template <class Cdt, class K>
class Conformity_checker_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;

  Conformity_checker_2(const Cdt& cdt, const Pslg_2<K>& pslg) : cdt_(cdt), pslg_(pslg) {}

  Validity_2 check()
  {
    number_vertices();
    find_input_points();
    link_constrained_edges();
    find_chains();
    for (std::size_t s = 0; s < pslg_.segments.size(); ++s) match(s);
    for (const Chain& chain : chains_)
      if (!chain.used) refuse(chain.vertices, "constrained edges aren't part of any input segment");
    return validity_;
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Chain
  {
    std::vector<std::size_t> vertices;
    bool used = false;
  };
  struct Chain_end // a chain as seen from one of its ends
  {
    std::size_t other_end, chain;
    bool reversed;
    bool operator<(const Chain_end& o) const
    {
      return std::tie(other_end, chain, reversed) < std::tie(o.other_end, o.chain, o.reversed);
    }
  };

  /// Vertices are numbered by coordinates, so they can be found by them.
  void number_vertices()
  {
    for (const Vertex_handle v : cdt_.finite_vertex_handles()) vertices_.push_back(v);
    std::sort(vertices_.begin(), vertices_.end(), [this](Vertex_handle v, Vertex_handle w) {
      return compare_xy(cdt_, v->point(), w->point()) == CGAL::SMALLER;
    });
    number_.clear(none);
    for (std::size_t i = 0; i < vertices_.size(); ++i) number_[vertices_[i]] = i;
    neighbors_.resize(vertices_.size());
    is_junction_.resize(vertices_.size(), 0);
    ends_at_.resize(vertices_.size());
  }

  void find_input_points()
  {
    for (std::size_t i = 0; i < pslg_.points.size(); ++i) {
      const Point& p = pslg_.points[i];
      const auto place =
          std::lower_bound(vertices_.begin(), vertices_.end(), p, [this](Vertex_handle v, const Point& q) {
            return compare_xy(cdt_, v->point(), q) == CGAL::SMALLER;
          });
      const bool found = place != vertices_.end() && compare_xy(cdt_, (*place)->point(), p) == CGAL::EQUAL;
      vertex_of_.push_back(found ? static_cast<std::size_t>(place - vertices_.begin()) : none);
      if (found)
        is_junction_[vertex_of_.back()] = 1;
      else
        validity_.add(Fault_kind::conformity, "input point " + std::to_string(i) + " isn't a vertex", {xy(p)});
    }
  }

  void link_constrained_edges()
  {
    for (auto edge = cdt_.constrained_edges_begin(); edge != cdt_.constrained_edges_end(); ++edge) {
      const std::size_t a = number_[edge->first->vertex(Cdt::ccw(edge->second))],
                        b = number_[edge->first->vertex(Cdt::cw(edge->second))];
      neighbors_[a].push_back(b);
      neighbors_[b].push_back(a);
    }
    for (std::size_t v = 0; v < neighbors_.size(); ++v)
      if (neighbors_[v].size() != 2) is_junction_[v] = 1;
  }

  void find_chains()
  {
    std::vector<char> reached(vertices_.size(), 0);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (is_junction_[v])
        for (const std::size_t w : neighbors_[v]) add_chain(v, w, reached);
    // What is left are closed loops without an input point. Their smallest vertex stands for a junction.
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (is_junction_[v] || reached[v]) continue;
      is_junction_[v] = 1;
      for (const std::size_t w : neighbors_[v]) add_chain(v, w, reached);
    }
    for (auto& list : ends_at_) std::sort(list.begin(), list.end());
  }

  /// Adds the chain that starts with the edge from v to w, unless it is the other end's turn to do so.
  void add_chain(std::size_t v, std::size_t w, std::vector<char>& reached)
  {
    std::vector<std::size_t> chain = {v, w};
    while (!is_junction_[chain.back()]) {
      const std::size_t here = chain.back(), before = chain[chain.size() - 2];
      reached[here] = 1;
      chain.push_back(neighbors_[here][neighbors_[here][0] == before ? 1 : 0]);
    }
    const std::size_t last = chain.back(), before_last = chain[chain.size() - 2];
    if (std::pair(last, before_last) < std::pair(v, w)) return;
    ends_at_[v].push_back({last, chains_.size(), false});
    ends_at_[last].push_back({v, chains_.size(), true});
    chains_.push_back({std::move(chain)});
  }

  /// Follows an input segment from chain to chain. More than one is needed only where it passes through other input
  /// points or was split.
  void match(std::size_t s)
  {
    const std::string name = "input segment " + std::to_string(s);
    for (const std::size_t end : pslg_.segments[s])
      if (end >= vertex_of_.size()) {
        validity_.add(Fault_kind::conformity, name + " refers to a point that doesn't exist");
        return;
      }
    const std::size_t source = vertex_of_[pslg_.segments[s][0]], target = vertex_of_[pslg_.segments[s][1]];
    if (source == none || target == none) return; // has been said
    const Segment segment(*this, source, target);
    for (std::size_t here = source; here != target;) {
      const Chain_end* next = next_chain(segment, here);
      if (next == nullptr) {
        explain(segment, here, name);
        return;
      }
      chains_[next->chain].used = true;
      here = next->other_end;
    }
  }

  /// A segment between two vertices with all that is needed to see whether others lie on it.
  struct Segment
  {
    Segment(const Conformity_checker_2& checker, std::size_t source_, std::size_t target_)
        : source(source_),
          target(target_),
          a(checker.point(source_)),
          b(checker.point(target_)),
          origin(xy(a)),
          allowed(ulps_of((std::max)(largest_coordinate(a), largest_coordinate(b)), most_ulps_off_segment))
    {
      const Xy_2 end = xy(b);
      const double length = edge_length(end[0] - origin[0], end[1] - origin[1]);
      direction = {(end[0] - origin[0]) / length, (end[1] - origin[1]) / length};
    }

    bool is_near(const Point& p) const
    {
      const Xy_2 q = xy(p);
      return std::abs(direction[0] * (q[1] - origin[1]) - direction[1] * (q[0] - origin[0])) <= allowed;
    }
    /// Whether q comes after p in the direction of the segment; exact.
    bool in_order(const Point& p, const Point& q) const { return typename K::Angle_2()(p, q, a, b) == CGAL::ACUTE; }

    std::size_t source, target;
    const Point &a, &b;
    Xy_2 origin, direction;
    double allowed;
  };

  const Point& point(std::size_t v) const { return vertices_[v]->point(); }

  /// First vertex of a chain, entered from `here`, that lies off the segment, out of order or beyond its end, or
  /// `none`.
  std::size_t first_off(const Segment& segment, const Chain_end& end) const
  {
    const auto& chain = chains_[end.chain].vertices;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const std::size_t before = chain[end.reversed ? chain.size() - k : k - 1],
                        here = chain[end.reversed ? chain.size() - 1 - k : k];
      if (!segment.is_near(point(here)) || !segment.in_order(point(before), point(here)) ||
          (here != segment.target && !segment.in_order(point(here), segment.b)))
        return here;
    }
    return none;
  }

  /// A chain from `here` that runs along the segment: one to its end if there is one, else one to a vertex exactly on
  /// it, else any.
  const Chain_end* next_chain(const Segment& segment, std::size_t here) const
  {
    const auto& list = ends_at_[here];
    const auto is_before = [](const Chain_end& end, std::size_t v) { return end.other_end < v; };
    auto end = std::lower_bound(list.begin(), list.end(), segment.target, is_before);
    for (; end != list.end() && end->other_end == segment.target; ++end)
      if (first_off(segment, *end) == none) return &*end;
    const Chain_end* best = nullptr;
    for (const Chain_end& candidate : list) {
      if (first_off(segment, candidate) != none) continue;
      if (cdt_.geom_traits().orientation_2_object()(segment.a, segment.b, point(candidate.other_end)) ==
          CGAL::COLLINEAR)
        return &candidate;
      if (best == nullptr) best = &candidate;
    }
    return best;
  }

  /// Says why a segment can't be followed beyond a vertex.
  void explain(const Segment& segment, std::size_t here, const std::string& name)
  {
    for (const Chain_end& end : ends_at_[here]) {
      if (end.other_end != segment.target || chains_[end.chain].used) continue;
      chains_[end.chain].used = true;
      validity_.add(Fault_kind::conformity, name + " has a vertex off its line or out of order",
                    {xy(point(first_off(segment, end)))});
      return;
    }
    validity_.add(Fault_kind::conformity, name + " isn't covered by constrained edges: it breaks off",
                  {xy(point(here))});
  }

  void refuse(const std::vector<std::size_t>& chain, const std::string& what)
  {
    validity_.add(Fault_kind::conformity, what, {xy(point(chain.front())), xy(point(chain[1]))});
  }

  const Cdt& cdt_;
  const Pslg_2<K>& pslg_;
  Validity_2 validity_;
  std::vector<Vertex_handle> vertices_;
  CGAL::Unique_hash_map<Vertex_handle, std::size_t> number_;
  std::vector<std::size_t> vertex_of_; // per input point
  std::vector<std::vector<std::size_t>> neighbors_;
  std::vector<char> is_junction_;
  std::vector<Chain> chains_;
  std::vector<std::vector<Chain_end>> ends_at_;
};

} // namespace internal

/// Checks that every input point is a vertex with exactly its coordinates, that every input segment is a chain of
/// constrained edges from end to end, and that there are no other constrained edges. Vertices within a chain must lie
/// within 8 units in the last place of the segment's largest coordinate from its line, for they are rounded, and in
/// order along it, which is exact. Segments may pass through input points, and crossing ones may have been split.
/// O(n log n) time, and per segment that passes through other points the number of constraints there more. The
/// structure must be sound.
template <class Cdt, class K>
Validity_2 check_conformity_2(const Cdt& cdt, const Pslg_2<K>& pslg)
{
  return internal::Conformity_checker_2<Cdt, K>(cdt, pslg).check();
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_CHECK_CONFORMITY_2_H
