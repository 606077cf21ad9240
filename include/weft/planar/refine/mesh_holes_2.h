// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of a mesh that have been emptied, and the vertices around them from which a lattice may go on.

#ifndef WEFT_PLANAR_REFINE_MESH_HOLES_2_H
#define WEFT_PLANAR_REFINE_MESH_HOLES_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <vector>

namespace weft::internal {

inline constexpr int no_hole = -1; ///< `id()` of faces that are in no hole

/// Numbers holes, parts that hang together of the domain's faces for which `is_open(face)`, in `id()` of faces.
/// \returns their number. Linear time.
template <class Mesh, class Is_open>
int label_holes_2(Mesh& mesh, const Is_open& is_open)
{
  using Face_handle = typename Mesh::Face_handle;
  for (const Face_handle f : mesh.triangulation().all_face_handles()) f->set_id(no_hole);
  std::vector<Face_handle> queue;
  int holes = 0;
  const auto add = [&](Face_handle f) {
    if (f->id() != no_hole || !f->is_in_domain() || !is_open(f)) return false;
    f->set_id(holes);
    queue.push_back(f);
    return true;
  };
  for (const Face_handle first : mesh.faces()) {
    if (!add(first)) continue;
    while (!queue.empty()) {
      const Face_handle f = queue.back();
      queue.pop_back();
      for (int i = 0; i < 3; ++i)
        if (!f->is_constrained(i)) add(f->neighbor(i));
    }
    ++holes;
  }
  return holes;
}

/// A place from which the lattice around a hole can go on into it.
template <class Mesh>
struct Rim_2
{
  typename Mesh::Point point;
  typename Mesh::Face_handle face; ///< in the hole
  double direction;                ///< of an edge at the point, in radians
};

/// Free vertices between numbered holes and the mesh around them, once each. Linear time.
template <class Mesh>
std::vector<Rim_2<Mesh>> rims_of_holes_2(const Mesh& mesh)
{
  using Triangulation = typename Mesh::Triangulation;
  std::vector<Rim_2<Mesh>> rims;
  std::vector<char> is_listed(mesh.vertices().size(), false);
  for (const auto f : mesh.faces()) {
    if (f->id() == no_hole) continue;
    for (int i = 0; i < 3; ++i) {
      const auto v = f->vertex(i);
      char& listed = is_listed[as_index(v->id())];
      if (v->constraint() != free_vertex || listed) continue;
      auto face = mesh.triangulation().incident_faces(v);
      const auto done = face;
      do {
        if (face->id() != no_hole) continue;
        const auto along = face->vertex(Triangulation::ccw(face->index(v)))->point() - v->point();
        rims.push_back({v->point(), f, std::atan2(CGAL::to_double(along.y()), CGAL::to_double(along.x()))});
        listed = true;
      } while (!listed && ++face != done);
    }
  }
  return rims;
}

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_MESH_HOLES_2_H
