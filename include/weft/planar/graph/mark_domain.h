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
#include <weft/internal/cold.h>
#include <weft/internal/counted.h>
#include <weft/planar/graph/Pslg_2.h>

#include <CGAL/Kernel/global_functions_2.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_2.h>
#include <CGAL/Unique_hash_map.h>

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
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
WEFT_COLD void flood_component(typename Cdt::Face_handle start, Face_components<Cdt>& components)
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
WEFT_COLD Face_components<Cdt> face_components(const Cdt& cdt)
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
WEFT_COLD std::vector<int> nesting_levels(const Cdt& cdt, const Face_components<Cdt>& components)
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

/// Whether a point lies on a constraint, to a billionth of the edge's length: then it says nothing about a region.
/// \param face where the point was located.
template <class Cdt>
bool is_on_constraint(const Cdt& cdt, const typename Cdt::Point& p, typename Cdt::Face_handle face)
{
  constexpr double nearness = 1e-9;
  if (cdt.is_infinite(face)) { // beyond the hull, or on it
    const int i = face->index(cdt.infinite_vertex());
    if (!face->is_constrained(i)) return false;
    const auto edge = cdt.segment(face, i);
    return CGAL::to_double(CGAL::squared_distance(p, edge)) <=
           nearness * nearness * CGAL::to_double(edge.squared_length());
  }
  for (int i = 0; i < 3; ++i) {
    if (!face->is_constrained(i)) continue;
    const auto edge = cdt.segment(face, i);
    if (CGAL::to_double(CGAL::squared_distance(p, edge)) <=
        nearness * nearness * CGAL::to_double(edge.squared_length()))
      return true;
  }
  return false;
}

/// Puts the chosen regions into the domain and everything else out of it.
template <class Cdt>
WEFT_COLD void set_domain(Cdt& cdt, const Face_components<Cdt>& components, const std::vector<char>& in_domain)
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

/// What `mark_domain()` found about the points of holes and regions. Numbers are indices into the arrays of the input.
struct Domain_marks
{
  std::vector<std::size_t> holes_on_constraints;   ///< not used: they name no hole
  std::vector<std::size_t> holes_outside;          ///< outside of everything
  std::vector<std::size_t> regions_on_constraints; ///< not used: they name no region
  std::vector<std::size_t> regions_outside;        ///< outside of everything
  std::vector<std::size_t> regions_in_holes;       ///< the hole wins
  std::vector<std::size_t> regions_overruled;      ///< a later region has its point in the same part of the domain
  std::size_t unnamed_parts = 0;                   ///< parts of the domain that no region names, if the input names any
  std::vector<std::string> warnings;               ///< the same in words, one sentence each; empty if there was nothing
};

namespace internal {

/// Finds out what a graph's points of holes and regions name.
template <class Cdt, class K>
class Domain_marker
{
public:
  Domain_marker(const Cdt& cdt, const Pslg_2<K>& pslg)
      : cdt_(cdt),
        pslg_(pslg),
        components_(face_components(cdt)),
        in_domain_(as_index(components_.count), !pslg.holes.empty()),
        is_hole_(as_index(components_.count), 0)
  {
    if (components_.count == 0) return;
    if (pslg.holes.empty()) {
      const std::vector<int> level = nesting_levels(cdt, components_);
      for (std::size_t i = 0; i < level.size(); ++i) in_domain_[i] = level[i] % 2 == 1;
    }
    for (std::size_t i = 0; i < pslg.holes.size(); ++i) take_hole(i);
    std::map<std::size_t, std::size_t> region_of;
    for (std::size_t i = 0; i < pslg.regions.size(); ++i) take_region(i, region_of);
    in_domain_[0] = false;
    for (std::size_t c = 0; c < in_domain_.size() && !pslg.regions.empty(); ++c)
      if (in_domain_[c] && region_of.count(c) == 0) ++marks_.unnamed_parts;
    if (marks_.unnamed_parts > 0)
      marks_.warnings.push_back(counted(marks_.unnamed_parts, "part of the domain has", "parts of the domain have") +
                                " no region" + somewhere(region_of));
  }

  const Face_components<Cdt>& components() const { return components_; }
  const std::vector<char>& in_domain() const { return in_domain_; }
  const Domain_marks& marks() const { return marks_; }

private:
  void take_hole(std::size_t i)
  {
    const auto face = cdt_.locate(pslg_.holes[i]);
    const auto component = as_index(components_.number[face]);
    if (is_on_constraint(cdt_, pslg_.holes[i], face)) {
      marks_.holes_on_constraints.push_back(i);
      return warn("the point of hole", i, "lies on a segment, so it names no hole");
    }
    is_hole_[component] = true;
    in_domain_[component] = false;
    if (component != 0) return;
    marks_.holes_outside.push_back(i);
    warn("the point of hole", i, "lies outside of everything");
  }

  void take_region(std::size_t i, std::map<std::size_t, std::size_t>& region_of)
  {
    const auto face = cdt_.locate(pslg_.regions[i].point);
    const auto component = as_index(components_.number[face]);
    if (is_on_constraint(cdt_, pslg_.regions[i].point, face)) {
      marks_.regions_on_constraints.push_back(i);
      return warn("the point of region", i, "lies on a segment, so it names no region");
    }
    if (component == 0) {
      marks_.regions_outside.push_back(i);
      return warn("the point of region", i, "lies outside of everything");
    }
    if (is_hole_[component]) {
      marks_.regions_in_holes.push_back(i);
      return warn("the point of region", i, "lies in a hole, which stays one");
    }
    in_domain_[component] = true;
    const auto [place, is_first] = region_of.emplace(component, i);
    if (is_first) return;
    marks_.regions_overruled.push_back(place->second);
    warn("the point of region", place->second,
         "lies in the same part of the domain as that of region " + std::to_string(i + pslg_.first_number) +
             ", which counts");
    place->second = i;
  }

  void warn(const std::string& what, std::size_t i, const std::string& how)
  {
    marks_.warnings.push_back(what + " " + std::to_string(i + pslg_.first_number) + ", counted from " +
                              std::to_string(pslg_.first_number) + ", " + how);
  }

  /// Where an unnamed part is.
  std::string somewhere(const std::map<std::size_t, std::size_t>& region_of) const
  {
    for (const auto face : cdt_.finite_face_handles()) {
      const auto c = as_index(components_.number[face]);
      if (!in_domain_[c] || region_of.count(c) > 0) continue;
      std::ostringstream text;
      const auto p = CGAL::centroid(cdt_.triangle(face));
      text << ", as near (" << CGAL::to_double(p.x()) << ", " << CGAL::to_double(p.y()) << ")";
      return text.str();
    }
    return {};
  }

  const Cdt& cdt_;
  const Pslg_2<K>& pslg_;
  Face_components<Cdt> components_;
  std::vector<char> in_domain_, is_hole_;
  Domain_marks marks_;
};

} // namespace internal

/// Marks the domain that a graph describes: by its holes if it has any, else by nesting parity. The parts in which
/// points of regions lie belong to it in any case, but for holes and the outside.
/// \returns what is odd about the points of holes and regions.
/// \throws Domain_error if no region is inside.
template <class Cdt, class K>
Domain_marks mark_domain(Cdt& cdt, const Pslg_2<K>& pslg)
{
  const internal::Domain_marker<Cdt, K> marker(cdt, pslg);
  internal::set_domain(cdt, marker.components(), marker.in_domain());
  return marker.marks();
}

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_MARK_DOMAIN_H
