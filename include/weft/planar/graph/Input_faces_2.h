// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds for each face of a mesh the face of the input in which it lies, for data that users keep in faces: meshers make
// new faces and flip old ones, so such data doesn't stay by itself. Meshers only ever split constraints, so a part of
// the plane that constraints bound stays one; rounded points on constraints don't mix up its sides.

#ifndef WEFT_PLANAR_GRAPH_INPUT_FACES_2_H
#define WEFT_PLANAR_GRAPH_INPUT_FACES_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/graph/chains_of_mesh_2.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>

#include <CGAL/Kernel/global_functions_2.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_2.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

template <class Vertex, class = void>
struct Knows_constraints : std::false_type
{};
template <class Vertex>
struct Knows_constraints<Vertex, std::void_t<decltype(std::declval<const Vertex&>().constraint())>> : std::true_type
{};

} // namespace internal

/// The faces of a triangulation as they are when this is made. `make_mesh_2()` and `relax_2()` use it by themselves for
/// faces with CGAL's `info()` (Triangulation_face_base_with_info_2); for other data:
///
///     const Input_faces_2<Cdt> input(cdt);
///     make_mesh_2(cdt, sizing);
///     input.for_each(cdt, [](auto input_face, auto face) { face->data = input_face->data; });
///
/// \tparam Cdt a CGAL constrained triangulation; it is copied with the data in its faces.
template <class Cdt>
class Input_faces_2
{
public:
  using Face_handle = typename Cdt::Face_handle;

  /// O(n log n).
  /// \param meshed whether the triangulation is a mesh whose Steiner vertices on constraints, those that have
  ///   `constraint()` from 0 on, may move and go, as `adapt_2()` has it; otherwise every vertex has to stay.
  explicit Input_faces_2(const Cdt& cdt, bool meshed = false)
      : input_(cdt), components_(internal::face_components(input_))
  {
    if (meshed)
      list_chains();
    else
      list_edges();
  }

  /// Calls `function(input_face, face)` for each finite face of a mesh of the input. The input's face holds the
  /// centroid of the mesh's, or is, where rounding puts that across a constraint, the nearest on the same side. Time is
  /// that of locating each centroid from the one before.
  /// \param mesh the triangulation after meshing: it has the input's points, and its constraints as chains of edges.
  template <class Function>
  void for_each(const Cdt& mesh, const Function& function) const
  {
    if (input_.dimension() < 2 || mesh.dimension() < 2) return;
    const auto components = internal::face_components(mesh);
    const std::vector<int> input_component = match(mesh, components);
    Face_handle hint;
    for (const auto face : mesh.finite_face_handles()) {
      const int wanted = input_component[internal::as_index(components.number[face])];
      const auto centroid = CGAL::centroid(mesh.triangle(face));
      Face_handle found = input_.locate(centroid, hint);
      hint = found;
      if (input_.is_infinite(found) || components_.number[found] != wanted) found = nearest(centroid, wanted);
      if (found != Face_handle()) function(found, face);
    }
  }

private:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;

  struct Sides
  {
    Point from, to;
    std::array<int, 2> component; ///< to the left, to the right
  };

  void list_edges()
  {
    for (auto edge = input_.constrained_edges_begin(); edge != input_.constrained_edges_end(); ++edge) {
      const auto [face, i] = *edge;
      list(face, i, face->vertex(Cdt::ccw(i)), face->vertex(Cdt::cw(i)));
    }
  }

  void list_chains()
  {
    if constexpr (internal::Knows_constraints<typename Cdt::Vertex>::value)
      for (const auto& chain : internal::chains_of_mesh(input_)) {
        Face_handle face;
        int i;
        if (!input_.is_edge(chain[0], chain[1], face, i)) continue;
        const bool forward = face->vertex(Cdt::ccw(i)) == chain[0];
        list(face, i, forward ? chain.front() : chain.back(), forward ? chain.back() : chain.front());
      }
  }

  /// \param a,b ends of what edge i of the face is a part of, with the face to the left of a to b.
  void list(Face_handle face, int i, Vertex_handle a, Vertex_handle b)
  {
    edges_.add(a->point(), b->point(), static_cast<int>(sides_.size()));
    sides_.push_back({a->point(), b->point(), {components_.number[face], components_.number[face->neighbor(i)]}});
  }

  /// Component of the input for each of the mesh: the longest of the constrained edges around it tells.
  std::vector<int> match(const Cdt& mesh, const internal::Face_components<Cdt>& components) const
  {
    std::vector<int> result(internal::as_index(components.count), 0);
    std::vector<double> longest(result.size(), 0);
    for (const auto& [edge, number] : edges_.constrained_edges(mesh)) {
      if (number < 0) continue;
      const Sides& sides = sides_[internal::as_index(number)];
      const auto face = edge.first;
      // The face lies to the left of its edge in this direction.
      const auto along = face->vertex(Cdt::cw(edge.second))->point() - face->vertex(Cdt::ccw(edge.second))->point();
      const double length = CGAL::to_double(along.squared_length());
      const bool same = CGAL::is_positive(along * (sides.to - sides.from));
      for (const bool left : {true, false}) {
        const auto at = internal::as_index(components.number[left ? face : face->neighbor(edge.second)]);
        if (length <= longest[at]) continue;
        longest[at] = length;
        result[at] = sides.component[left == same ? 0 : 1];
      }
    }
    return result;
  }

  Face_handle nearest(const Point& p, int component) const
  {
    Face_handle best;
    typename Cdt::Geom_traits::FT least(0);
    for (const auto face : input_.finite_face_handles()) {
      if (components_.number[face] != component) continue;
      const auto distance = CGAL::squared_distance(p, input_.triangle(face));
      if (best != Face_handle() && !(distance < least)) continue;
      best = face;
      least = distance;
    }
    return best;
  }

  Cdt input_;
  internal::Face_components<Cdt> components_;
  Constraint_markers<typename Cdt::Geom_traits> edges_; ///< the number of an edge is its index in `sides_`
  std::vector<Sides> sides_;
};

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_INPUT_FACES_2_H
