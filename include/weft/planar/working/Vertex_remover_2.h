// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes vertices from a constrained Delaunay triangulation by flips, so that the faces that are left keep their
// domain flags. Flips cut ears off the star of the vertex until three faces are left, which become one.

#ifndef WEFT_PLANAR_WORKING_VERTEX_REMOVER_2_H
#define WEFT_PLANAR_WORKING_VERTEX_REMOVER_2_H

#include <weft/planar/triangulation/Relocator_2.h>

#include <CGAL/enum.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// Keeps the triangulation constrained Delaunay.
/// \tparam Cdt constrained Delaunay triangulation with weft's bases.
template <class Cdt>
class Vertex_remover_2
{
public:
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;

  Vertex_remover_2(Cdt& cdt, Relocator_2<Cdt>& relocator) : cdt_(cdt), relocator_(relocator) {}

  /// Removes a vertex without constraints that isn't on the convex hull.
  /// \returns whether that was possible; it always is, short of rounding.
  bool remove(Vertex_handle v)
  {
    std::vector<Face_handle> hole;
    if (!flip_down(v, 3, hole) && !flip_flat(v, hole)) return restore_star(v);
    hole.push_back(v->face());
    merge_star(v, hole.back());
    relocator_.restore_delaunay_of(hole);
    return true;
  }

  /// Removes a vertex with two constrained edges, to a and b, and makes one edge of them.
  /// \returns whether that was possible: the joined edge must keep to its side of all vertices around.
  bool remove_from_edge(Vertex_handle v, Vertex_handle a, Vertex_handle b)
  {
    const std::vector<Vertex_handle> link = link_of(v);
    std::vector<Face_handle> ears;
    if (!flip_down(v, 4, ears)) return restore_star(v);
    Face_handle left, right; // of the edge from v to b
    int i;
    cdt_.is_edge(v, b, left, i);
    if (left->vertex(Cdt::ccw(left->index(v))) != b) left = left->neighbor(i);
    right = left->neighbor(Cdt::cw(left->index(v)));
    const Vertex_handle l = left->vertex(Cdt::cw(left->index(v))), r = right->vertex(Cdt::ccw(right->index(v)));
    const auto orientation = cdt_.geom_traits().orientation_2_object();
    if (orientation(a->point(), b->point(), l->point()) != CGAL::LEFT_TURN ||
        orientation(b->point(), a->point(), r->point()) != CGAL::LEFT_TURN)
      return restore_star(v);
    const bool right_inside = right->is_in_domain();
    // Flipping the edge to l leaves v in a flat triangle with a and b, and with three neighbors.
    cdt_.tds().flip(left, left->index(b));
    merge_star(v, right);
    right->set_in_domain(right_inside);
    cdt_.is_edge(a, b, right, i);
    const Face_handle other = right->neighbor(i);
    right->set_constraint(i, true);
    other->set_constraint(cdt_.mirror_index(right, i), true);
    for (int k = 0; k < 3; ++k)
      if (k != cdt_.mirror_index(right, i)) copy_constraint(other, k);
    for (int k = 0; k < 3; ++k)
      if (k != i) copy_constraint(right, k);
    restore_delaunay_around(link);
    return true;
  }

private:
  std::vector<Vertex_handle> link_of(Vertex_handle v) const
  {
    std::vector<Vertex_handle> link;
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do link.push_back(face->vertex(Cdt::ccw(face->index(v))));
    while (++face != done);
    return link;
  }

  /// Flips unconstrained edges of v until it has no more than `degree` left. Each flip cuts an ear off the star, which
  /// stays star-shaped around v. Appends the ears.
  bool flip_down(Vertex_handle v, std::size_t degree, std::vector<Face_handle>& ears)
  {
    const auto orientation = cdt_.geom_traits().orientation_2_object();
    while (cdt_.degree(v) > degree) {
      auto face = cdt_.incident_faces(v);
      const auto done = face;
      bool flipped = false;
      do {
        const int i = face->index(v), left = Cdt::ccw(i); // the edge from v to the face's last vertex
        Face_handle f = face;
        const Face_handle next = f->neighbor(left);
        if (f->is_constrained(left)) continue;
        const auto &p = f->vertex(Cdt::ccw(i))->point(), &ear = f->vertex(Cdt::cw(i))->point(),
                   &q = next->vertex(Cdt::cw(next->index(v)))->point();
        flipped = orientation(p, ear, q) == CGAL::LEFT_TURN && orientation(p, q, v->point()) == CGAL::LEFT_TURN;
        if (!flipped) continue;
        cdt_.flip(f, left);
        ears.push_back(f->has_vertex(v) ? next : f);
      } while (!flipped && ++face != done);
      if (!flipped) return false;
    }
    return true;
  }

  /// Flips an edge of a vertex that lies between two of its four neighbors on a straight line, as one inserted in the
  /// middle of an edge does: that leaves it in a flat triangle with the two, and with three neighbors. Appends the ear.
  bool flip_flat(Vertex_handle v, std::vector<Face_handle>& ears)
  {
    const auto orientation = cdt_.geom_traits().orientation_2_object();
    if (cdt_.degree(v) != 4) return false;
    auto face = cdt_.incident_faces(v);
    const auto done = face;
    do {
      const int i = face->index(v), left = Cdt::ccw(i);
      const Face_handle f = face, next = f->neighbor(left);
      const Vertex_handle p = f->vertex(Cdt::ccw(i)), ear = f->vertex(Cdt::cw(i)),
                          q = next->vertex(Cdt::cw(next->index(v)));
      if (f->is_constrained(left) || orientation(p->point(), q->point(), v->point()) != CGAL::COLLINEAR ||
          orientation(p->point(), ear->point(), q->point()) != CGAL::LEFT_TURN)
        continue;
      cdt_.tds().flip(f, left);
      const Face_handle cut = f->has_vertex(v) ? next : f;
      for (int k = 0; k < 3; ++k)
        if (cut->vertex(k) == ear)
          cut->set_constraint(k, false);
        else
          copy_constraint(cut, k);
      ears.push_back(cut);
      return true;
    } while (++face != done);
    return false;
  }

  /// Makes one face of the three around v. The face's constraints are those of its neighbors.
  void merge_star(Vertex_handle v, Face_handle f)
  {
    cdt_.tds().remove_degree_3(v, f);
    for (int i = 0; i < 3; ++i) copy_constraint(f, i);
  }

  void copy_constraint(Face_handle f, int i)
  {
    f->set_constraint(i, f->neighbor(i)->is_constrained(cdt_.mirror_index(f, i)));
  }

  bool restore_star(Vertex_handle v)
  {
    relocator_.restore_delaunay_around(v);
    return false;
  }

  void restore_delaunay_around(const std::vector<Vertex_handle>& vertices)
  {
    for (const Vertex_handle w : vertices) relocator_.restore_delaunay_around(w);
  }

  Cdt& cdt_;
  Relocator_2<Cdt>& relocator_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_VERTEX_REMOVER_2_H
