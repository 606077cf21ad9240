// SPDX-License-Identifier: GPL-3.0-or-later
//
// A constrained Delaunay triangulation while it is being meshed. It keeps what refinement and relaxation share: the
// numbered vertices, the constraints as chains between input vertices, the domain flags of faces across insertions,
// target sizes at vertices, and a frame of four far vertices, so that no vertex that moves lies on the convex hull
// and no rounded Steiner point can dent it. The frame is taken away again by `finish()` or the destructor.
//
// The triangulation needs the bases of Mesh_triangulation_2.h. All its vertices at construction are input vertices.

#ifndef WEFT_PLANAR_WORKING_WORKING_MESH_2_H
#define WEFT_PLANAR_WORKING_WORKING_MESH_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/cold.h>
#include <weft/planar/graph/chains_of_mesh_2.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/triangulation/Relocator_2.h>
#include <weft/planar/working/checked_box_2.h>
#include <weft/planar/working/Constraint_chains_2.h>
#include <weft/planar/working/Frame_2.h>
#include <weft/planar/working/Frozen_vertices_2.h>
#include <weft/planar/working/Vertex_remover_2.h>
#include <weft/planar/working/Vertex_targets_2.h>
#include <weft/sizing/Uniform_sizing.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Cdt constrained Delaunay triangulation with weft's bases.
/// \tparam Sizing callable, point -> target edge length in the input's units.
template <class Cdt, class Sizing>
class Working_mesh_2
{
public:
  using Triangulation = Cdt;
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;
  static constexpr bool uniform = is_uniform_sizing_v<Sizing>;

  /// A constraint between two input vertices. Steiner vertices on it carry its index in `constraint()`.
  using Chain = typename Constraint_chains_2<Cdt>::Chain;

  /// Where constrained vertices of the given triangulation stand.
  enum class Given
  {
    input,     ///< every vertex is an input vertex: nothing given moves
    relaxable, ///< vertices without constraints are free
    meshed     ///< so are, along them, those on constraints that a mesher has inserted; what is `fixed_vertex` stays
  };

  /// Marks the domain by nesting parity if no face is in it yet.
  /// \throws Domain_error if there is no domain or its coordinates are out of range.
  WEFT_COLD Working_mesh_2(Cdt& cdt, const Sizing& sizing, Given given = Given::input)
      : cdt_(cdt),
        frame_(cdt),
        relocator_(cdt, [this](Vertex_handle v) { return is_in_order(v); }),
        remover_(cdt, relocator_),
        targets_(sizing)
  {
    bbox_ = checked_box_2(cdt);
    const bool marked = std::any_of(cdt.finite_faces_begin(), cdt.finite_faces_end(),
                                    [](const auto& face) { return face.is_in_domain(); });
    if (!marked) mark_domain_by_parity(cdt);
    std::vector<std::vector<Vertex_handle>> chains;
    if (given == Given::meshed) chains = chains_of_mesh(cdt);
    for (const Vertex_handle v : cdt.finite_vertex_handles()) {
      const bool may_move = given == Given::relaxable || (given == Given::meshed && v->constraint() != fixed_vertex);
      v->set_constraint(may_move && !cdt.are_there_incident_constraints(v) ? free_vertex : fixed_vertex);
    }
    for (const auto& chain : chains) {
      for (std::size_t i = 1; i + 1 < chain.size(); ++i)
        chain[i]->set_constraint(static_cast<int>(chains_.all().size()));
      chains_.add(chain.front(), chain.back());
    }
    for (auto e = cdt.constrained_edges_begin(); given != Given::meshed && e != cdt.constrained_edges_end(); ++e)
      chains_.add(e->first->vertex(cdt.ccw(e->second)), e->first->vertex(cdt.cw(e->second)));
    input_vertices_ = count_given(given);
    frame_.add(bbox_);
    renumber();
  }

  Working_mesh_2(const Working_mesh_2&) = delete;
  Working_mesh_2& operator=(const Working_mesh_2&) = delete;

  /// Takes the frame away. Afterwards only the triangulation itself may be used.
  void finish() { frame_.remove(); }

  Cdt& triangulation() { return cdt_; }
  const Cdt& triangulation() const { return cdt_; }
  const CGAL::Bbox_2& bbox() const { return bbox_; }
  std::size_t input_vertices() const { return input_vertices_; }
  const std::vector<Chain>& chains() const { return chains_.all(); }

  /// Finite vertices without the frame; `vertices()[v->id()] == v`.
  const std::vector<Vertex_handle>& vertices() const { return vertices_; }
  /// Faces in the domain. Flips keep the list right, since they keep faces; insertions and removals don't.
  const std::vector<Face_handle>& faces() const { return faces_; }

  /// Numbers vertices and lists faces anew, in the order of the triangulation; to be called after insertions.
  void renumber()
  {
    const std::vector<Vertex_handle> old_vertices = std::move(vertices_);
    std::vector<int> old_ids;
    vertices_.clear();
    faces_.clear();
    for (const Vertex_handle v : cdt_.finite_vertex_handles()) {
      if (is_frame(v)) continue;
      const int old = v->id();
      const bool is_old = 0 <= old && old < static_cast<int>(old_vertices.size()) && old_vertices[as_index(old)] == v;
      v->set_id(static_cast<int>(vertices_.size()));
      vertices_.push_back(v);
      old_ids.push_back(is_old ? old : -1);
    }
    targets_.renumber(vertices_, old_ids);
    frozen_.renumber(old_ids);
    frame_.number_from(static_cast<int>(vertices_.size()));
    for (const Face_handle f : cdt_.finite_face_handles())
      if (f->is_in_domain()) faces_.push_back(f);
    targets_.expect_questions(2 * faces_.size());
  }

  /// Numbers a vertex that was inserted since the last `renumber()`, at a place of its own or that of a removed one.
  void adopt(Vertex_handle v, int id)
  {
    const auto n = static_cast<std::size_t>(id);
    if (n == vertices_.size()) {
      frame_.number_from(id + 1);
      vertices_.emplace_back();
    }
    v->set_id(id);
    vertices_[n] = v;
    frozen_.thaw(n);
    targets_.set(n, v->point());
  }

  bool is_frame(Vertex_handle v) const { return frame_.contains(v); }

  /// What improves meshes leaves frozen vertices alone, and faces with no others.
  Frozen_vertices_2& frozen() { return frozen_; }
  bool is_frozen(Vertex_handle v) const { return frozen_.contains(v->id()); }
  bool is_frozen(Face_handle f) const
  {
    return is_frozen(f->vertex(0)) && is_frozen(f->vertex(1)) && is_frozen(f->vertex(2));
  }

  /// Largest edge length that the sizing field admits at a point.
  /// \throws Option_error if the sizing field returns anything but a positive finite number.
  double size(const Point& p) const { return targets_.size(p); }

  /// The same in the middle of a face.
  double size(Face_handle f) const
  {
    double x = 0, y = 0;
    for (int i = 0; i < 3; ++i) {
      x += CGAL::to_double(f->vertex(i)->point().x());
      y += CGAL::to_double(f->vertex(i)->point().y());
    }
    return size(Point(x / 3, y / 3));
  }

  /// Edge length to aim at: the sizing field, or less near details of the input, see `set_grading()`.
  double target(const Point& p) const { return targets_.target(p); }

  /// Target remembered for a vertex.
  double target(Vertex_handle v) const { return targets_.target(v->id()); }

  /// To be called after a vertex has moved.
  void update_target(Vertex_handle v) { targets_.update(v->id(), v->point()); }

  /// Whether targets are the same everywhere.
  bool is_uniform() const { return targets_.is_uniform(); }

  using Grading = typename Vertex_targets_2<Cdt, Sizing>::Grading;
  /// Makes targets smaller than the sizing field where `grading` is.
  void set_grading(Grading grading) { targets_.set_grading(std::move(grading), vertices_); }

  /// Longest edge of a face over the size at its centroid.
  double ratio(Face_handle f) const
  {
    const double longest = (std::max)({squared_length(f, 0), squared_length(f, 1), squared_length(f, 2)});
    return std::sqrt(longest) / size(f);
  }

  /// Length of edge i of a face over the size at its midpoint.
  double edge_ratio(Face_handle f, int i) const
  {
    const Point &a = f->vertex(Cdt::ccw(i))->point(), &b = f->vertex(Cdt::cw(i))->point();
    return std::sqrt(squared_length(f, i)) / size(CGAL::midpoint(a, b));
  }

  double squared_length(Face_handle f, int i) const
  {
    return CGAL::to_double(CGAL::squared_distance(f->vertex(Cdt::ccw(i))->point(), f->vertex(Cdt::cw(i))->point()));
  }

  /// Index of the chain that a constrained edge belongs to.
  int chain_of(Face_handle f, int i) const
  {
    const Vertex_handle a = f->vertex(Cdt::ccw(i)), b = f->vertex(Cdt::cw(i));
    if (a->constraint() >= 0) return a->constraint();
    if (b->constraint() >= 0) return b->constraint();
    return chains_.between(a, b);
  }

  /// Inserts a point in the interior of a constrained edge, which it splits whatever rounding did to it.
  /// \returns null if the point isn't between the ends or a face beside the edge would not keep its orientation, and
  /// after `lock_constraints()`.
  Vertex_handle insert_on_constraint(const Point& p, Face_handle f, int i)
  {
    if (constraints_are_locked_) return Vertex_handle();
    const Face_handle n = f->neighbor(i);
    const Vertex_handle a = f->vertex(Cdt::ccw(i)), b = f->vertex(Cdt::cw(i));
    if (!splits(p, f, i) || !splits(p, n, n->index(f))) return Vertex_handle();
    const int chain = chain_of(f, i);
    if (!chains_.is_between(p, a->point(), b->point(), chain)) return Vertex_handle();
    const bool left = f->is_in_domain(), right = n->is_in_domain();
    const Vertex_handle v = cdt_.insert(p, Cdt::EDGE, f, i);
    v->set_constraint(chain);
    // New faces surround v: from b counterclockwise to a they lie where f was, from a to b where its neighbor was.
    auto face = cdt_.incident_faces(v);
    while (face->vertex(Cdt::ccw(face->index(v))) != b) ++face;
    const auto start = face;
    bool side = left;
    do {
      if (face->vertex(Cdt::ccw(face->index(v))) == a) side = right;
      face->set_in_domain(side);
    } while (++face != start);
    // Where rounding bends the constraint, edges that end at v may not be Delaunay; CGAL looks at those opposite only.
    relocator_.restore_delaunay_around(v);
    return v;
  }

  /// From now on nothing is inserted on constraints.
  void lock_constraints() { constraints_are_locked_ = true; }

  /// Inserts a free vertex.
  /// \returns null, and does nothing, if the point lies on a vertex or constraint or outside of the domain.
  Vertex_handle insert_inside(const Point& p, Face_handle hint)
  {
    typename Cdt::Locate_type type;
    int i;
    const Face_handle f = cdt_.locate(p, type, i, hint);
    if (type != Cdt::FACE && type != Cdt::EDGE) return Vertex_handle();
    if (!f->is_in_domain() || (type == Cdt::EDGE && f->is_constrained(i))) return Vertex_handle();
    const Vertex_handle v = cdt_.insert(p, type, f, i);
    v->set_constraint(free_vertex);
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do face->set_in_domain(true);
    while (++face != done);
    return v;
  }

  /// Removes a free vertex; `faces()` is out of date afterwards.
  /// \returns whether that was possible; it always is, short of collinear neighbors.
  bool remove(Vertex_handle v)
  {
    const int id = v->id();
    return forget_if(remover_.remove(v), id);
  }

  /// Ends of the edges of a Steiner vertex along its constraint; null handles if it hasn't two.
  std::array<Vertex_handle, 2> neighbors_on_constraint(Vertex_handle v) const
  {
    std::array<Vertex_handle, 2> result;
    int n = 0;
    auto edge = cdt_.incident_edges(v);
    const auto done = edge;
    do {
      if (!cdt_.is_constrained(*edge)) continue;
      const Vertex_handle a = edge->first->vertex(Cdt::ccw(edge->second));
      if (n < 2) result[as_index(n)] = a == v ? edge->first->vertex(Cdt::cw(edge->second)) : a;
      ++n;
    } while (++edge != done);
    return n == 2 ? result : std::array<Vertex_handle, 2>();
  }

  /// Removes a Steiner vertex from its constraint and joins its two edges; `faces()` is out of date afterwards.
  /// \returns whether that was possible: the joined edge must keep to its side of all vertices around.
  bool remove_from_constraint(Vertex_handle v)
  {
    const auto [a, b] = neighbors_on_constraint(v);
    const int id = v->id();
    return a != Vertex_handle() && forget_if(remover_.remove_from_edge(v, a, b), id);
  }

  Relocator_2<Cdt>& relocator() { return relocator_; }

private:
  /// Leaves the number of a removed vertex to the next one; returns `removed`.
  bool forget_if(bool removed, int id)
  {
    if (removed && id >= 0) vertices_[as_index(id)] = Vertex_handle();
    return removed;
  }

  /// Whether a vertex on a constraint lies between its neighbors there. Faces that keep their orientation don't ensure
  /// that where edges are a few units in the last place long and rounding bends the constraint.
  bool is_in_order(Vertex_handle v) const
  {
    if (v->constraint() < 0) return true;
    const auto [a, b] = neighbors_on_constraint(v);
    return a == Vertex_handle() || chains_.is_between(v->point(), a->point(), b->point(), v->constraint());
  }

  std::size_t count_given(Given given) const
  {
    if (given != Given::meshed) return cdt_.number_of_vertices();
    const auto all = cdt_.finite_vertex_handles();
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](Vertex_handle v) { return v->constraint() == fixed_vertex; }));
  }

  /// Whether the two faces that p makes of f by splitting edge i are positively oriented.
  bool splits(const Point& p, Face_handle f, int i) const
  {
    if (cdt_.is_infinite(f)) return true;
    const Point &apex = f->vertex(i)->point(), &a = f->vertex(Cdt::ccw(i))->point(),
                &b = f->vertex(Cdt::cw(i))->point();
    const auto orientation = cdt_.geom_traits().orientation_2_object();
    return orientation(apex, a, p) == CGAL::LEFT_TURN && orientation(apex, p, b) == CGAL::LEFT_TURN;
  }

  Cdt& cdt_;
  Frame_2<Cdt> frame_;
  Relocator_2<Cdt> relocator_;
  Vertex_remover_2<Cdt> remover_;
  Vertex_targets_2<Cdt, Sizing> targets_;
  Frozen_vertices_2 frozen_;
  CGAL::Bbox_2 bbox_;
  std::size_t input_vertices_ = 0;
  bool constraints_are_locked_ = false;
  std::vector<Vertex_handle> vertices_;
  std::vector<Face_handle> faces_;
  Constraint_chains_2<Cdt> chains_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_WORKING_MESH_2_H
