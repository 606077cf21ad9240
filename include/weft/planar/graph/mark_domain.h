// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a constrained triangulation belong to the domain. A region is a connected component of faces that no
// constraint separates. A dangling constraint or an open polyline has the same region on both sides and so changes
// nothing. By parity, a region is in the domain when the least number of constraints crossed on the way in from
// outside is odd; by seeds, regions are named by points, with the meaning that CGAL's Delaunay_mesher_2 gives them.
//
// Faces need `set_in_domain(bool)`; `label_components()` also needs `set_id(int)`.

#ifndef WEFT_PLANAR_GRAPH_MARK_DOMAIN_H
#define WEFT_PLANAR_GRAPH_MARK_DOMAIN_H

#include <weft/errors.h>
#include <weft/internal/as_index.h>
#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/Unique_hash_map.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Number of the region of every face. Region 0 is the outside, with the infinite faces.
template <class Cdt>
struct Face_components
{
  CGAL::Unique_hash_map<typename Cdt::Face_handle, int> number{-1};
  int count = 0;
};

/// Floods the region of `start` with the next number.
template <class Cdt>
void flood_component(typename Cdt::Face_handle start, Face_components<Cdt>& components)
{
  const int number = components.count++;
  std::vector<typename Cdt::Face_handle> stack(1, start);
  components.number[start] = number;
  while (!stack.empty()) {
    const typename Cdt::Face_handle face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      const typename Cdt::Face_handle neighbor = face->neighbor(i);
      if (face->is_constrained(i) || components.number[neighbor] != -1) continue;
      components.number[neighbor] = number;
      stack.push_back(neighbor);
    }
  }
}

/// Regions are numbered in the order in which the triangulation enumerates its faces.
template <class Cdt>
Face_components<Cdt> face_components(const Cdt& cdt)
{
  Face_components<Cdt> components;
  if (cdt.dimension() < 2) return components;
  flood_component<Cdt>(cdt.infinite_face(), components);
  for (const auto face : cdt.finite_face_handles())
    if (components.number[face] == -1) flood_component<Cdt>(face, components);
  return components;
}

/// Least number of constraints between the outside and each region: breadth first over neighbouring regions.
template <class Cdt>
std::vector<int> nesting_levels(const Cdt& cdt, const Face_components<Cdt>& components)
{
  std::vector<std::vector<int>> neighbors(as_index(components.count));
  for (auto edge = cdt.constrained_edges_begin(); edge != cdt.constrained_edges_end(); ++edge) {
    const int a = components.number[edge->first], b = components.number[edge->first->neighbor(edge->second)];
    if (a == b) continue;
    neighbors[as_index(a)].push_back(b);
    neighbors[as_index(b)].push_back(a);
  }
  std::vector<int> level(as_index(components.count), -1), queue(1, 0);
  level[0] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int neighbor : neighbors[as_index(queue[next])]) {
      if (level[as_index(neighbor)] != -1) continue;
      level[as_index(neighbor)] = level[as_index(queue[next])] + 1;
      queue.push_back(neighbor);
    }
  return level;
}

/// Puts the chosen regions into the domain and everything else out of it.
template <class Cdt>
void set_domain(Cdt& cdt, const Face_components<Cdt>& components, const std::vector<char>& in_domain)
{
  bool empty = true;
  for (const auto face : cdt.all_face_handles()) {
    const bool inside = components.count > 0 && in_domain[as_index(components.number[face])];
    face->set_in_domain(inside);
    empty = empty && !inside;
  }
  if (empty) throw Domain_error("the domain is empty: no region of the plane lies in it", {}, {});
}

} // namespace internal

/// Numbers the regions: every face, infinite ones included, gets as `id()` the number of its region. The outside is 0,
/// the others follow in the order of the finite faces. Linear time.
/// \returns the number of regions, the outside included.
template <class Cdt>
int label_components(Cdt& cdt)
{
  const auto components = internal::face_components(cdt);
  for (const auto face : cdt.all_face_handles()) face->set_id(components.number[face]);
  return components.count;
}

/// Marks the domain by nesting parity: a region is inside when an odd number of constraints, counted along the path
/// that crosses the fewest, lies between it and the outside. Linear time.
/// \throws Domain_error if no region is inside.
template <class Cdt>
void mark_domain_by_parity(Cdt& cdt)
{
  const auto components = internal::face_components(cdt);
  std::vector<char> in_domain(internal::as_index(components.count), 0);
  if (components.count > 0) {
    const std::vector<int> level = internal::nesting_levels(cdt, components);
    for (int i = 0; i < components.count; ++i) in_domain[internal::as_index(i)] = level[internal::as_index(i)] % 2 == 1;
  }
  internal::set_domain(cdt, components, in_domain);
}

/// Marks the domain by points in regions, as CGAL's Delaunay_mesher_2 does: the regions with seeds are the domain, or
/// everything but them and the outside is. Without seeds, everything but the outside is.
/// \param seeds_are_in_domain whether seeds name the domain (true) or its holes (false).
/// \throws Domain_error if no region is inside.
template <class Cdt, class SeedIterator>
void mark_domain_by_seeds(Cdt& cdt, SeedIterator seeds_begin, SeedIterator seeds_end, bool seeds_are_in_domain = false)
{
  const bool mark = seeds_begin != seeds_end && seeds_are_in_domain;
  const auto components = internal::face_components(cdt);
  std::vector<char> in_domain(internal::as_index(components.count), !mark);
  if (components.count > 0) {
    for (SeedIterator seed = seeds_begin; seed != seeds_end; ++seed)
      in_domain[internal::as_index(components.number[cdt.locate(*seed)])] = mark;
    in_domain[0] = false;
  }
  internal::set_domain(cdt, components, in_domain);
}

/// Marks the domain that a graph describes: by its holes if it has any, else by nesting parity.
/// \throws Domain_error if no region is inside.
template <class Cdt, class K>
void mark_domain(Cdt& cdt, const Pslg_2<K>& pslg)
{
  if (pslg.holes.empty())
    mark_domain_by_parity(cdt);
  else
    mark_domain_by_seeds(cdt, pslg.holes.begin(), pslg.holes.end());
}

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_MARK_DOMAIN_H
