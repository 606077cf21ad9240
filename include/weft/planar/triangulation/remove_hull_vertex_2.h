// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes a vertex of the convex hull from a constrained Delaunay triangulation. Ears are cut off its star by flips in
// the order of the vertex's power to their circles (Devillers, "On deletion in Delaunay triangulations", 1999), which
// takes O(n log n) for n neighbors where filling the hole anew takes O(n²). What is left of the star lies outside of
// the new hull: the vertex goes to infinity. Powers are rounded, which can only misorder the ears; exact predicates
// decide what is an ear, and flips mend the rest.

#ifndef WEFT_PLANAR_TRIANGULATION_REMOVE_HULL_VERTEX_2_H
#define WEFT_PLANAR_TRIANGULATION_REMOVE_HULL_VERTEX_2_H

#include <weft/internal/cold.h>
#include <weft/planar/triangulation/Relocator_2.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

namespace weft::internal {

/// Cuts the star of a vertex of the convex hull down until it can go to infinity.
template <class Cdt>
class Hull_vertex_remover_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;

  Hull_vertex_remover_2(Cdt& cdt, Vertex_handle v) : cdt_(cdt), v_(v) { list_link(); }

  /// Removes the vertex.
  void run()
  {
    for (std::size_t i = 1; i + 1 < link_.size(); ++i) queue_ear(i);
    while (!ears_.empty()) {
      const Ear ear = ears_.top();
      ears_.pop();
      if (link_[ear.tip].before == ear.before && link_[ear.tip].after == ear.after) cut(ear);
    }
    move_to_infinity();
    Relocator_2<Cdt>(cdt_).restore_delaunay_of(cut_);
  }

private:
  /// A neighbor of the vertex, counterclockwise from hull to hull; the face is that with the next one.
  struct Link_vertex
  {
    Vertex_handle vertex;
    Face_handle face;
    std::size_t before, after;
  };

  /// A corner of the link that may be cut off.
  struct Ear
  {
    double height; // how far the vertex must rise on its lifting to leave the ear's circle
    std::size_t before, tip, after;
    bool operator<(const Ear& o) const { return height != o.height ? height > o.height : tip > o.tip; } // lowest on top
  };

  WEFT_COLD void list_link()
  {
    auto face = cdt_.incident_faces(v_);
    while (!cdt_.is_infinite(face)) ++face;
    while (cdt_.is_infinite(face)) ++face;
    for (std::size_t i = 0;; ++face, ++i) {
      const Face_handle f = face;
      link_.push_back({f->vertex(Cdt::ccw(f->index(v_))), f, i - 1, i + 1});
      if (cdt_.is_infinite(f)) return;
    }
  }

  WEFT_COLD void queue_ear(std::size_t i)
  {
    const Link_vertex& tip = link_[i];
    const Point &p = link_[tip.before].vertex->point(), &e = tip.vertex->point(), &q = link_[tip.after].vertex->point();
    if (cdt_.geom_traits().orientation_2_object()(p, e, q) != CGAL::LEFT_TURN) return;
    ears_.push({height(p, e, q), tip.before, i, tip.after});
  }

  /// Minus the vertex's power to the circle through three points in counterclockwise order.
  double height(const Point& p, const Point& e, const Point& q) const
  {
    const auto dx = [&e](const Point& a) { return CGAL::to_double(a.x()) - CGAL::to_double(e.x()); };
    const auto dy = [&e](const Point& a) { return CGAL::to_double(a.y()) - CGAL::to_double(e.y()); };
    const double ux = dx(q), uy = dy(q), wx = dx(p), wy = dy(p), zx = dx(v_->point()), zy = dy(v_->point());
    const double uu = ux * ux + uy * uy, ww = wx * wx + wy * wy, area = ux * wy - uy * wx;
    if (!(area > 0)) return std::numeric_limits<double>::infinity();
    return (zx * (wy * uu - uy * ww) + zy * (ux * ww - wx * uu)) / area - zx * zx - zy * zy;
  }

  void cut(const Ear& ear)
  {
    Face_handle f = link_[ear.before].face, n = link_[ear.tip].face;
    cdt_.flip(f, f->index(n));
    link_[ear.before].face = f->has_vertex(v_) ? f : n;
    cut_.push_back(f->has_vertex(v_) ? n : f);
    link_[ear.before].after = ear.after;
    link_[ear.after].before = ear.before;
    link_[ear.tip].before = link_[ear.tip].after = ear.tip; // no ear any more
    if (ear.before > 0) queue_ear(ear.before);
    if (ear.after + 1 < link_.size()) queue_ear(ear.after);
  }

  /// Joins the vertex with the one at infinity; the two faces that hold both vanish.
  WEFT_COLD void move_to_infinity()
  {
    const Vertex_handle infinity = cdt_.infinite_vertex();
    std::vector<Face_handle> outside, finite;
    auto face = cdt_.incident_faces(v_);
    const auto done = face;
    do (cdt_.is_infinite(face) ? outside : finite).push_back(face);
    while (++face != done);
    for (const Face_handle f : finite) f->set_vertex(f->index(v_), infinity);
    infinity->set_face(finite.front());
    for (const Face_handle f : outside) {
      const int i = f->index(infinity), k = f->index(v_), corner = 3 - i - k;
      const Face_handle inner = f->neighbor(i), outer = f->neighbor(k);
      const int inner_index = inner->index(f), outer_index = outer->index(f);
      inner->set_neighbor(inner_index, outer);
      outer->set_neighbor(outer_index, inner);
      f->vertex(corner)->set_face(inner);
      cdt_.tds().delete_face(f);
    }
    cdt_.tds().delete_vertex(v_);
  }

  Cdt& cdt_;
  Vertex_handle v_;
  std::vector<Link_vertex> link_;
  std::priority_queue<Ear> ears_;
  std::vector<Face_handle> cut_; // off the star
};

/// Removes a vertex of the convex hull. O(n log n) for n neighbors, short of cocircular ones by the thousand.
/// \pre no constraint ends at the vertex, which is an extreme point; the others span the plane.
template <class Cdt>
void remove_hull_vertex(Cdt& cdt, typename Cdt::Vertex_handle v)
{
  Hull_vertex_remover_2<Cdt>(cdt, v).run();
}

} // namespace weft::internal

#endif // WEFT_PLANAR_TRIANGULATION_REMOVE_HULL_VERTEX_2_H
