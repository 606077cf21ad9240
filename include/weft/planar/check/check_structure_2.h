// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether faces, neighbours and vertices of a planar triangulation fit together: with its infinite vertex it has to be
// a triangulation of the sphere. No link is trusted before it has been followed.

#ifndef WEFT_PLANAR_CHECK_CHECK_STRUCTURE_2_H
#define WEFT_PLANAR_CHECK_CHECK_STRUCTURE_2_H

#include <weft/planar/check/Validity_2.h>

#include <CGAL/Unique_hash_map.h>

#include <cstddef>
#include <vector>

namespace weft {

namespace internal {

/// Checks the data structure alone: that it is a triangulated sphere. Doesn't trust any link before it has been seen to
/// lead to a face or vertex of the triangulation.
template <class Cdt>
class Structure_checker_2
{
public:
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;

  explicit Structure_checker_2(const Cdt& cdt) : cdt_(cdt) {}

  Validity_2 check()
  {
    if (cdt_.dimension() != 2) {
      validity_.add(Fault_kind::structure, "the triangulation isn't two-dimensional");
      return validity_;
    }
    for (const Vertex_handle v : cdt_.all_vertex_handles()) {
      faces_at_[v] = 0;
      ++number_of_vertices_;
    }
    for (const Face_handle f : cdt_.all_face_handles()) {
      is_face_[f] = true;
      ++number_of_faces_;
    }
    for (const Face_handle f : cdt_.all_face_handles()) check_vertices(f);
    if (!validity_.ok()) return validity_;
    for (const Face_handle f : cdt_.all_face_handles()) check_neighbors(f);
    if (!validity_.ok()) return validity_;
    for (const Vertex_handle v : cdt_.all_vertex_handles()) check_star(v);
    if (validity_.ok()) check_sphere();
    return validity_;
  }

private:
  // The maps take null for a key of theirs.
  bool is_vertex(Vertex_handle v) const { return v != Vertex_handle() && faces_at_.is_defined(v); }
  bool is_face(Face_handle f) const { return f != Face_handle() && is_face_.is_defined(f); }

  void check_vertices(Face_handle f)
  {
    bool known = true;
    for (int i = 0; i < 3; ++i) known = known && is_vertex(f->vertex(i));
    if (!known) {
      validity_.add(Fault_kind::structure, "a face has a vertex that isn't one of the triangulation");
      return;
    }
    if (f->vertex(0) == f->vertex(1) || f->vertex(1) == f->vertex(2) || f->vertex(2) == f->vertex(0))
      validity_.add(Fault_kind::structure, "a face has the same vertex twice", corners(cdt_, f));
    for (int i = 0; i < 3; ++i) ++faces_at_[f->vertex(i)];
  }

  void check_neighbors(Face_handle f)
  {
    for (int i = 0; i < 3; ++i) {
      const Face_handle n = f->neighbor(i);
      if (!is_face(n)) {
        validity_.add(Fault_kind::structure, "an edge has no face on its other side", ends(cdt_, f, i));
        continue;
      }
      int j = 0;
      while (j < 3 && (n->neighbor(j) != f || n->vertex(Cdt::ccw(j)) != f->vertex(Cdt::cw(i)) ||
                       n->vertex(Cdt::cw(j)) != f->vertex(Cdt::ccw(i))))
        ++j;
      if (j == 3)
        validity_.add(Fault_kind::structure, "two neighboring faces don't share their edge", ends(cdt_, f, i));
      else if (f->is_constrained(i) != n->is_constrained(j))
        validity_.add(Fault_kind::structure, "an edge is constrained on one side only", ends(cdt_, f, i));
    }
  }

  /// All faces at a vertex must form one cycle around it. Neighbors are known to agree, so turning comes back.
  void check_star(Vertex_handle v)
  {
    const Face_handle start = v->face();
    int turned = 0;
    if (is_face(start) && start->has_vertex(v)) {
      Face_handle f = start;
      do {
        f = f->neighbor(Cdt::ccw(f->index(v)));
        ++turned;
      } while (f != start);
    }
    if (turned == faces_at_[v]) return;
    std::vector<Xy_2> point;
    if (!cdt_.is_infinite(v)) point.push_back(xy(v->point()));
    validity_.add(Fault_kind::structure, turned == 0 ? "a vertex doesn't know its face" : "a vertex has several stars",
                  point);
  }

  /// Connected, without boundary and with Euler's number 2.
  void check_sphere()
  {
    std::size_t reached = 0;
    if (number_of_faces_ + 4 != 2 * number_of_vertices_)
      validity_.add(Fault_kind::structure, "the numbers of vertices and faces aren't those of a planar triangulation");
    std::vector<Face_handle> stack(1, cdt_.infinite_face());
    is_face_[stack[0]] = false; // from here on: not reached yet
    while (!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      ++reached;
      for (int i = 0; i < 3; ++i) {
        if (!is_face_[f->neighbor(i)]) continue;
        is_face_[f->neighbor(i)] = false;
        stack.push_back(f->neighbor(i));
      }
    }
    if (reached != number_of_faces_)
      validity_.add(Fault_kind::structure, "the triangulation falls into several pieces");
  }

  const Cdt& cdt_;
  Validity_2 validity_;
  std::size_t number_of_vertices_ = 0, number_of_faces_ = 0; // with the one at infinity and those around it
  CGAL::Unique_hash_map<Vertex_handle, int> faces_at_{0};
  CGAL::Unique_hash_map<Face_handle, bool> is_face_{false};
};

} // namespace internal

/// Checks that the triangulation is one of the sphere, with every vertex, face and neighbor knowing each other. Exact,
/// linear time.
template <class Cdt>
Validity_2 check_structure_2(const Cdt& cdt)
{
  return internal::Structure_checker_2<Cdt>(cdt).check();
}

} // namespace weft

#endif // WEFT_PLANAR_CHECK_CHECK_STRUCTURE_2_H
