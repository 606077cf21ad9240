// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a planar mesher on a triangulation that knows more than the mesher does, and tells it afterwards what the mesher
// did: the polylines of a CGAL::Constrained_triangulation_plus_2 get the Steiner points, `info()` of faces comes from
// the input. That happens on every way out.

#ifndef WEFT_PLANAR_RUN_KEEP_LAYERS_2_H
#define WEFT_PLANAR_RUN_KEEP_LAYERS_2_H

#include <weft/planar/graph/Input_faces_2.h>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
template <class Tr>
class Constrained_triangulation_plus_2;
} // namespace CGAL

namespace weft::internal {

template <class Face, class = void>
struct Has_info : std::false_type
{};
template <class Face>
struct Has_info<Face, std::void_t<decltype(std::declval<Face&>().info() = std::declval<const Face&>().info())>>
    : std::true_type
{};

/// Gives the faces of a mesh the `info()` of the input's faces in which they lie, where they have any.
/// \param meshed as Input_faces_2 has it.
template <class Cdt, class Run>
auto keep_face_info_2(Cdt& cdt, const Run& run, bool meshed = false)
{
  if constexpr (!Has_info<typename Cdt::Face>::value) {
    return run(cdt);
  } else {
    const Input_faces_2<Cdt> input(cdt, meshed);
    const auto copy = [](auto from, auto to) { to->info() = from->info(); };
    try {
      auto result = run(cdt);
      input.for_each(cdt, copy);
      return result;
    } catch (...) {
      input.for_each(cdt, copy);
      throw;
    }
  }
}

/// Vertices from an input vertex along a constraint to the next one. The edge from `a` to `next` is constrained.
template <class Tr>
std::vector<typename Tr::Vertex_handle> chain_between_input_2(const Tr& cdt, typename Tr::Vertex_handle a,
                                                              typename Tr::Vertex_handle next)
{
  std::vector<typename Tr::Vertex_handle> chain{a, next};
  while (chain.back()->constraint() >= 0) {
    auto edge = cdt.incident_edges(chain.back());
    const auto done = edge;
    const auto here = chain.back(), before = chain[chain.size() - 2];
    do {
      if (cdt.is_infinite(*edge) || !cdt.is_constrained(*edge)) continue;
      const auto v = edge->first->vertex(Tr::ccw(edge->second));
      const auto other = v == here ? edge->first->vertex(Tr::cw(edge->second)) : v;
      if (other != before) chain.push_back(other);
    } while (chain.back() == here && ++edge != done);
    if (chain.back() == here) break;
  }
  return chain;
}

/// Splits the polylines at the Steiner points of their constraints. Those that are split already stay.
template <class Tr>
void split_polylines_2(CGAL::Constrained_triangulation_plus_2<Tr>& cdt)
{
  using Vertex_handle = typename Tr::Vertex_handle;
  for (const Vertex_handle a : cdt.finite_vertex_handles()) {
    if (a->constraint() >= 0 || !cdt.are_there_incident_constraints(a)) continue;
    auto edge = cdt.incident_edges(a);
    const auto done = edge;
    do {
      if (cdt.is_infinite(*edge) || !cdt.is_constrained(*edge)) continue;
      const Vertex_handle v = edge->first->vertex(Tr::ccw(edge->second));
      const auto chain = chain_between_input_2<Tr>(cdt, a, v == a ? edge->first->vertex(Tr::cw(edge->second)) : v);
      const Vertex_handle b = chain.back();
      for (std::size_t i = 1; i + 1 < chain.size() && b->constraint() < 0; ++i)
        if (cdt.is_subconstraint(chain[i - 1], b)) cdt.split_constraint(chain[i - 1], b, chain[i]);
    } while (++edge != done);
  }
}

template <class Cdt, class Run>
auto keep_layers_2(Cdt& cdt, const Run& run)
{
  return keep_face_info_2(cdt, run);
}

/// The mesher works on the triangulation below the polylines.
template <class Tr, class Run>
auto keep_layers_2(CGAL::Constrained_triangulation_plus_2<Tr>& cdt, const Run& run)
{
  try {
    auto result = keep_face_info_2(static_cast<Tr&>(cdt), run);
    split_polylines_2(cdt);
    return result;
  } catch (...) {
    split_polylines_2(cdt);
    throw;
  }
}

} // namespace weft::internal

#endif // WEFT_PLANAR_RUN_KEEP_LAYERS_2_H
