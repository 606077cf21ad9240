// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves many vertices of a constrained Delaunay triangulation at once. A relaxation seldom changes connectivity, so all
// vertices are put to their new places first; those that turned a face over are put back, edges that ceased to be
// Delaunay are flipped, and the vertices that were put back then walk to their places one by one, flipping as they
// go. The idea is the filtering of relocations of Tournois 2009, sec. 3.3.2, with flips instead of reinsertion: handles
// stay valid. Exact predicates decide every orientation and flip, so the triangulation is valid and constrained
// Delaunay afterwards whatever the targets were.
//
// The triangulation needs `id()` on vertices (distinct, from 0) and on faces (scratch), as the bases of
// planar/triangulation/Mesh_triangulation_2.h have them; ids of vertices that aren't moved may be -1.

#ifndef WEFT_PLANAR_TRIANGULATION_RELOCATOR_2_H
#define WEFT_PLANAR_TRIANGULATION_RELOCATOR_2_H

#include <weft/internal/as_index.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::internal {

/// What became of a set of moves.
struct Relocation_counts
{
  std::size_t moved = 0;      ///< vertices that reached their targets
  std::size_t one_by_one = 0; ///< of them, those that had to walk there alone
  std::size_t put_back = 0;   ///< vertices that stayed short of their targets
  std::size_t flips = 0;

  Relocation_counts& operator+=(const Relocation_counts& o)
  {
    moved += o.moved;
    one_by_one += o.one_by_one;
    put_back += o.put_back;
    flips += o.flips;
    return *this;
  }
};

/// \tparam Cdt a CGAL constrained Delaunay triangulation.
template <class Cdt>
class Relocator_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;

  /// \param may_stand says whether a vertex that has been moved may stay where it is as far as its neighbors allow,
  /// beyond the orientation of its faces, which is always asked for; nothing more if empty. It must hold everywhere
  /// at the start.
  explicit Relocator_2(Cdt& cdt, std::function<bool(Vertex_handle)> may_stand = {})
      : cdt_(cdt), may_stand_(std::move(may_stand))
  {}

  /// Moves `vertices[i]` to `targets[i]`. Vertices on constraints must have targets on them. Vertices on the convex
  /// hull stay where they are. Linear in the number of faces around the vertices, plus the flips.
  /// \pre the vertices are distinct; the triangulation is constrained Delaunay.
  Relocation_counts move(const std::vector<Vertex_handle>& vertices, const std::vector<Point>& targets)
  {
    Relocation_counts counts;
    list_vertices(vertices);
    list_faces(vertices);
    old_.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      old_[i] = vertices[i]->point();
      if (state_[as_index(vertices[i]->id())] >= 0) vertices[i]->set_point(targets[i]);
    }
    put_back_misplaced(vertices);
    counts.flips += restore_delaunay();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      int& state = state_[as_index(vertices[i]->id())];
      if (state >= 0)
        ++counts.moved;
      else if (state == deferred && walk(vertices[i], targets[i], counts.flips))
        ++counts.moved, ++counts.one_by_one;
      else
        ++counts.put_back;
      state = still;
    }
    return counts;
  }

  /// Moves one vertex if all its faces keep their orientation, then flips. Returns whether it moved.
  bool move_within_star(Vertex_handle v, const Point& target, std::size_t& flips)
  {
    const Point old = v->point();
    v->set_point(target);
    if (!is_star_valid(v) || !may_stand(v)) {
      v->set_point(old);
      return false;
    }
    flips += restore_delaunay_around(v);
    return true;
  }

  /// Whether all faces around the vertex are finite and positively oriented.
  bool is_star_valid(Vertex_handle v) const
  {
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do {
      if (cdt_.is_infinite(face) || !is_positive(face)) return false;
    } while (++face != done);
    return true;
  }

  /// Flips until every edge near the vertex is constrained Delaunay. Returns the number of flips.
  std::size_t restore_delaunay_around(Vertex_handle v)
  {
    stack_.clear();
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do
      for (int i = 0; i < 3; ++i) stack_.emplace_back(face, i);
    while (++face != done);
    return flip_stacked();
  }

  /// The same for every edge of some faces.
  std::size_t restore_delaunay_of(const std::vector<Face_handle>& faces)
  {
    stack_.clear();
    for (const Face_handle f : faces)
      for (int i = 0; i < 3; ++i) stack_.emplace_back(f, i);
    return flip_stacked();
  }

private:
  static constexpr int still = -1, deferred = -2, at_hull = -3;

  bool is_positive(Face_handle f) const
  {
    return cdt_.geom_traits().orientation_2_object()(f->vertex(0)->point(), f->vertex(1)->point(),
                                                     f->vertex(2)->point()) == CGAL::LEFT_TURN;
  }

  /// Notes each vertex' position in the list, or that it is on the convex hull and must not move.
  void list_vertices(const std::vector<Vertex_handle>& vertices)
  {
    int largest = -1;
    for (const Vertex_handle v : vertices) largest = (std::max)(largest, v->id());
    if (static_cast<int>(state_.size()) <= largest) state_.resize(as_index(largest + 1), still);
    for (std::size_t i = 0; i < vertices.size(); ++i) state_[as_index(vertices[i]->id())] = static_cast<int>(i);
    if (are_many(vertices)) { // looking around each of them takes a quarter of a sweep over all vertices
      auto v = cdt_.incident_vertices(cdt_.infinite_vertex());
      const auto done = v;
      do
        if (has_moved(v)) state_[as_index(v->id())] = at_hull;
      while (++v != done);
      return;
    }
    for (const Vertex_handle v : vertices)
      if (is_at_hull(v)) state_[as_index(v->id())] = at_hull;
  }

  bool are_many(const std::vector<Vertex_handle>& vertices) const
  {
    return 4 * vertices.size() > cdt_.number_of_vertices();
  }

  bool is_at_hull(Vertex_handle v) const
  {
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do
      if (cdt_.is_infinite(face)) return true;
    while (++face != done);
    return false;
  }

  /// Lists the finite faces around the vertices, each with its position as id; the neighbors of these have id -1.
  void list_faces(const std::vector<Vertex_handle>& vertices)
  {
    faces_.clear();
    const auto append = [this](Face_handle f) {
      if (f->id() >= 0 || cdt_.is_infinite(f)) return;
      f->set_id(static_cast<int>(faces_.size()));
      faces_.push_back(f);
    };
    if (are_many(vertices)) { // in storage order, which is kinder to the cache
      for (const Face_handle f : cdt_.all_face_handles()) {
        f->set_id(-1);
        if (has_moved(f->vertex(0)) || has_moved(f->vertex(1)) || has_moved(f->vertex(2))) append(f);
      }
      return;
    }
    for_faces_around(vertices, [](Face_handle f) {
      f->set_id(-1);
      for (int i = 0; i < 3; ++i) f->neighbor(i)->set_id(-1);
    });
    for_faces_around(vertices, append);
  }

  template <class Function>
  void for_faces_around(const std::vector<Vertex_handle>& vertices, const Function& function) const
  {
    for (const Vertex_handle v : vertices) {
      auto face = cdt_.incident_faces(v);
      const auto done = face;
      do function(face);
      while (++face != done);
    }
  }

  bool has_moved(Vertex_handle v) const
  {
    return v->id() >= 0 && v->id() < static_cast<int>(state_.size()) && state_[as_index(v->id())] >= 0;
  }

  bool may_stand(Vertex_handle v) const { return !may_stand_ || may_stand_(v); }

  /// Puts moved vertices back until no face is inverted and all may stand where they are. Ends: all put back is valid.
  void put_back_misplaced(const std::vector<Vertex_handle>& vertices)
  {
    std::vector<Face_handle> suspects;
    for (const Face_handle f : faces_)
      if (!is_positive(f)) suspects.push_back(f);
    for (bool again = true; again;) {
      put_back_inverted(suspects);
      again = false;
      if (!may_stand_) return;
      for (const Vertex_handle v : vertices)
        if (has_moved(v) && !may_stand_(v)) {
          put_back(v, suspects);
          again = true;
        }
    }
  }

  void put_back_inverted(std::vector<Face_handle>& suspects)
  {
    while (!suspects.empty()) {
      const Face_handle f = suspects.back();
      suspects.pop_back();
      if (is_positive(f)) continue;
      for (int i = 0; i < 3; ++i)
        if (has_moved(f->vertex(i))) put_back(f->vertex(i), suspects);
    }
  }

  void put_back(Vertex_handle v, std::vector<Face_handle>& suspects)
  {
    v->set_point(old_[as_index(state_[as_index(v->id())])]);
    state_[as_index(v->id())] = deferred;
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do suspects.push_back(face);
    while (++face != done);
  }

  std::size_t restore_delaunay()
  {
    stack_.clear();
    for (const Face_handle f : faces_)
      for (int i = 0; i < 3; ++i)
        // An edge between two listed faces is tested from the later one only.
        if (f->neighbor(i)->id() < f->id() && !is_surely_delaunay(f, i) && cdt_.is_flipable(f, i, false))
          stack_.emplace_back(f, i);
    return flip_stacked();
  }

  /// Certain that an edge between two finite faces is locally Delaunay, since both angles opposite to it are acute;
  /// that decides most edges of a good mesh for less than the exact test costs.
  bool is_surely_delaunay(Face_handle f, int i) const
  {
    if constexpr (std::is_same_v<typename Cdt::Geom_traits::FT, double>) {
      const Face_handle n = f->neighbor(i);
      const Vertex_handle opposite = n->vertex(n->index(f));
      if (cdt_.is_infinite(opposite)) return false;
      const Point &a = f->vertex(Cdt::ccw(i))->point(), &b = f->vertex(Cdt::cw(i))->point();
      return is_acute(f->vertex(i)->point(), a, b) && is_acute(opposite->point(), a, b);
    } else {
      return false;
    }
  }

  /// Whether the angle at p is acute, beyond what rounding could have done to the scalar product.
  static bool is_acute(const Point& p, const Point& a, const Point& b)
  {
    const double x = (a.x() - p.x()) * (b.x() - p.x()), y = (a.y() - p.y()) * (b.y() - p.y());
    return x + y > 1e-14 * (std::abs(x) + std::abs(y));
  }

  std::size_t flip_stacked()
  {
    std::size_t flips = 0;
    while (!stack_.empty()) {
      auto [f, i] = stack_.back();
      stack_.pop_back();
      if (cdt_.is_infinite(f) || is_surely_delaunay(f, i) || !cdt_.is_flipable(f, i, false)) continue;
      const Face_handle n = f->neighbor(i);
      cdt_.flip(f, i);
      ++flips;
      for (int k = 0; k < 3; ++k) {
        stack_.emplace_back(f, k);
        stack_.emplace_back(n, k);
      }
    }
    return flips;
  }

  /// Carries a vertex towards its target in steps within its star, flipping between them.
  bool walk(Vertex_handle v, const Point& target, std::size_t& flips)
  {
    constexpr int most_steps = 8;
    double step = 1;
    for (int k = 0; k < most_steps; ++k) {
      const Point& p = v->point();
      const Point next =
          step == 1 ? target : Point(p.x() + step * (target.x() - p.x()), p.y() + step * (target.y() - p.y()));
      if (move_within_star(v, next, flips)) {
        if (step == 1) return true;
        step = 1;
      } else {
        step *= 0.5;
      }
    }
    return false;
  }

  Cdt& cdt_;
  std::function<bool(Vertex_handle)> may_stand_;
  std::vector<Face_handle> faces_;
  std::vector<Point> old_;
  std::vector<int> state_; // by vertex id: position in the list of moves, or one of the constants
  std::vector<std::pair<Face_handle, int>> stack_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_TRIANGULATION_RELOCATOR_2_H
