// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the input has details finer than the sizing field, elements must shrink towards them or their angles suffer.
// The details are read off the constrained Delaunay triangulation of the sampled constraints: constrained edges shorter
// than their target size, and triangles whose height over a constrained edge says how wide a channel is there. Only
// what sees each other through the domain counts. They are the sources of a Lipschitz field.

#ifndef WEFT_PLANAR_REFINE_GRADE_INPUT_2_H
#define WEFT_PLANAR_REFINE_GRADE_INPUT_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/graph/chains_of_mesh_2.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/refine/sample_constraints_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/triangulation/remove_hull_vertex_2.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/Unique_hash_map.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Points with sizes, sources of a Lipschitz_sizing_2.
template <class Point>
struct Size_sources_2
{
  std::vector<Point> points;
  std::vector<double> sizes;

  void add(const Point& p, double size)
  {
    points.push_back(p);
    sizes.push_back(size);
  }
};

/// Finds details of the input finer than the sizing field in a Working_mesh_2 whose constraints have been sampled.
/// \param edge_factor,width_factor size to aim at, over the length of a short edge and over the width of a channel.
/// Linear in the number of faces.
template <class Mesh>
WEFT_COLD Size_sources_2<typename Mesh::Point> find_input_details_2(const Mesh& mesh, double edge_factor,
                                                                    double width_factor)
{
  using Triangulation = typename Mesh::Triangulation;
  Size_sources_2<typename Mesh::Point> sources;
  const auto share_end = [&](const auto& chain, auto v) {
    if (v == chain.source || v == chain.target) return true;
    if (v->constraint() < 0) return false;
    const auto& other = mesh.chains()[as_index(v->constraint())];
    return other.source == chain.source || other.source == chain.target || other.target == chain.source ||
           other.target == chain.target;
  };
  for (const auto f : mesh.faces())
    for (int i = 0; i < 3; ++i) {
      if (!f->is_constrained(i)) continue;
      const auto a = f->vertex(Triangulation::ccw(i)), b = f->vertex(Triangulation::cw(i)), apex = f->vertex(i);
      const double length = std::sqrt(mesh.squared_length(f, i));
      const typename Mesh::Point middle = CGAL::midpoint(a->point(), b->point());
      const bool whole = a->constraint() < 0 && b->constraint() < 0; // an input edge that sampling left in one piece
      if (whole && edge_factor * length < mesh.target(middle)) {
        sources.add(a->point(), edge_factor * length);
        sources.add(b->point(), edge_factor * length);
      }
      if (apex->constraint() == free_vertex) continue; // no part of the input
      const double width = 2 * CGAL::to_double(mesh.triangulation().triangle(f).area()) / length;
      const double dx = CGAL::to_double(b->point().x() - a->point().x()),
                   dy = CGAL::to_double(b->point().y() - a->point().y());
      const double foot = (CGAL::to_double(apex->point().x() - a->point().x()) * dx +
                           CGAL::to_double(apex->point().y() - a->point().y()) * dy) /
                          (length * length);
      if (foot < 0 || foot > 1 || width_factor * width >= mesh.target(apex->point())) continue;
      if (share_end(mesh.chains()[as_index(mesh.chain_of(f, i))], apex)) continue;
      sources.add(apex->point(), width_factor * width);
    }
  return sources;
}

/// Makes the targets of a mesh smaller near details of the input finer than the sizing field.
/// \param sampled the mesh itself or a copy of it whose constraints have been sampled.
template <class Mesh>
WEFT_COLD void set_grading_2(Mesh& mesh, const Mesh& sampled)
{
  // Sizes at details, over edge lengths and channel widths there, and their growth with distance. The growth is the one
  // that takes the fewest Steiner points on most inputs.
  constexpr double detail_edge = 1.2, detail_width = 1.2, detail_growth = 0.85;
  const auto details = find_input_details_2(sampled, detail_edge, detail_width);
  if (details.points.empty()) return;
  mesh.set_grading(typename Mesh::Grading(details.points, details.sizes, detail_growth));
}

/// Does so for a Working_mesh_2 whose constraints are bare. They are sampled in a copy.
/// \param go_on callable, called now and then with the number of vertices; false stops.
/// \returns whether it was done; constraints that need more than `max_vertices` are left alone.
template <class Mesh, class Sizing, class Go_on>
WEFT_COLD bool grade_input_2(Mesh& mesh, const Sizing& sizing, std::size_t max_vertices, const Go_on& go_on)
{
  typename Mesh::Triangulation copy(mesh.triangulation());
  std::vector<typename Mesh::Vertex_handle> frame; // where the sizing field need not be defined
  for (const auto v : copy.finite_vertex_handles())
    if (v->id() >= static_cast<int>(mesh.vertices().size())) frame.push_back(v);
  for (const auto v : frame) remove_hull_vertex(copy, v);
  Mesh scratch(copy, sizing);
  if (!sample_constraints_2(scratch, 1, max_vertices, go_on)) return false;
  scratch.renumber();
  set_grading_2(mesh, scratch);
  return true;
}

/// A triangulation of the input of a mesh made with `Given::meshed`: its input vertices, and its chains as single
/// edges. \returns whether there is one; chains that aren't straight may cross.
template <class Mesh>
WEFT_COLD bool bare_input_2(const Mesh& mesh, typename Mesh::Triangulation& bare)
{
  using Triangulation = typename Mesh::Triangulation;
  using Vertex_handle = typename Mesh::Vertex_handle;
  const Triangulation& cdt = mesh.triangulation();
  const auto chains = chains_of_mesh(cdt);
  CGAL::Unique_hash_map<Vertex_handle, Vertex_handle> copy;
  typename Mesh::Face_handle hint, f;
  for (const Vertex_handle v : mesh.vertices()) {
    if (v->constraint() != fixed_vertex) continue;
    copy[v] = bare.insert(v->point(), hint);
    hint = copy[v]->face();
  }
  try {
    for (const auto& chain : chains) bare.insert_constraint(copy[chain.front()], copy[chain.back()]);
  } catch (const typename Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  const auto components = face_components(bare);
  std::vector<char> in_domain(as_index(components.count), false);
  // The face to the left of an edge, or null.
  const auto left = [&](const Triangulation& of, Vertex_handle a, Vertex_handle b) {
    int i;
    if (!of.is_edge(a, b, f, i)) return typename Mesh::Face_handle();
    return f->vertex(Triangulation::ccw(i)) == a ? f : f->neighbor(i);
  };
  for (const auto& chain : chains) {
    const Vertex_handle a = chain[0], b = chain[1], from = copy[chain.front()], to = copy[chain.back()];
    if (left(bare, from, to) == typename Mesh::Face_handle()) return false;
    in_domain[as_index(components.number[left(bare, from, to)])] = left(cdt, a, b)->is_in_domain();
    in_domain[as_index(components.number[left(bare, to, from)])] = left(cdt, b, a)->is_in_domain();
  }
  bool any = false;
  for (const auto face : bare.finite_face_handles()) {
    face->set_in_domain(in_domain[as_index(components.number[face])]);
    any = any || face->is_in_domain();
  }
  return any;
}

/// Does so for a mesh made with `Given::meshed`.
template <class Mesh, class Sizing, class Go_on>
WEFT_COLD bool grade_meshed_2(Mesh& mesh, const Sizing& sizing, std::size_t max_vertices, const Go_on& go_on)
{
  typename Mesh::Triangulation bare(mesh.triangulation().geom_traits());
  if (!bare_input_2(mesh, bare)) return true;
  Mesh scratch(bare, sizing);
  if (!sample_constraints_2(scratch, 1, max_vertices, go_on)) return false;
  scratch.renumber();
  set_grading_2(mesh, scratch);
  return true;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_GRADE_INPUT_2_H
