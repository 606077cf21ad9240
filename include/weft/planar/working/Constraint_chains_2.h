// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constraints of a triangulation before it is refined, each a chain of edges afterwards.

#ifndef WEFT_PLANAR_WORKING_CONSTRAINT_CHAINS_2_H
#define WEFT_PLANAR_WORKING_CONSTRAINT_CHAINS_2_H

#include <CGAL/enum.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Cdt constrained Delaunay triangulation.
template <class Cdt>
class Constraint_chains_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;

  /// A constraint between two input vertices.
  struct Chain
  {
    Vertex_handle source, target;
  };

  /// The next chain gets the next index.
  void add(Vertex_handle a, Vertex_handle b)
  {
    chain_of_ends_[ends(a, b)] = static_cast<int>(chains_.size());
    chains_.push_back({a, b});
  }

  const std::vector<Chain>& all() const { return chains_; }

  /// Index of the chain between two input vertices; there must be one.
  int between(Vertex_handle a, Vertex_handle b) const { return chain_of_ends_.at(ends(a, b)); }

  /// Whether p comes between a and b in the direction of a chain; exact.
  bool is_between(const Point& p, const Point& a, const Point& b, int chain) const
  {
    const Point &source = chains_[static_cast<std::size_t>(chain)].source->point(),
                &target = chains_[static_cast<std::size_t>(chain)].target->point();
    const typename Cdt::Geom_traits::Angle_2 angle;
    const CGAL::Angle before = angle(a, p, source, target);
    return before != CGAL::RIGHT && before == angle(p, b, source, target);
  }

private:
  using Ends = std::pair<Vertex_handle, Vertex_handle>;

  static Ends ends(Vertex_handle a, Vertex_handle b) { return a < b ? Ends(a, b) : Ends(b, a); }

  std::vector<Chain> chains_;
  std::map<Ends, int> chain_of_ends_; // only looked up, never iterated: addresses decide nothing
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_CONSTRAINT_CHAINS_2_H
