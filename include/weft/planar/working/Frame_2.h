// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four far vertices around a triangulation, so that none that moves lies on the convex hull and no rounded Steiner
// point can dent it.
//
// Not meant for users.

#ifndef WEFT_PLANAR_WORKING_FRAME_2_H
#define WEFT_PLANAR_WORKING_FRAME_2_H

#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/planar/triangulation/remove_hull_vertex_2.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft::internal {

/// The frame is there from `add()` on until it is removed or destroyed.
/// \tparam Cdt constrained Delaunay triangulation with weft's bases.
template <class Cdt>
class Frame_2
{
public:
  using Point = typename Cdt::Point;
  using Vertex_handle = typename Cdt::Vertex_handle;

  explicit Frame_2(Cdt& cdt) : cdt_(cdt) {}
  Frame_2(const Frame_2&) = delete;
  Frame_2& operator=(const Frame_2&) = delete;
  ~Frame_2() { remove(); }

  /// \param box of the triangulation.
  void add(const CGAL::Bbox_2& box)
  {
    const double d = 2 * (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    const double x0 = box.xmin() - d, x1 = box.xmax() + d, y0 = box.ymin() - d, y1 = box.ymax() + d;
    const std::array<Point, 4> corners{Point(x0, y0), Point(x1, y0), Point(x1, y1), Point(x0, y1)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      vertices_[i] = cdt_.insert(corners[i]);
      vertices_[i]->set_constraint(fixed_vertex);
    }
    // Faces that insertion made lie outside of the old hull, so outside of the domain.
    for (const Vertex_handle v : vertices_) {
      auto face = cdt_.incident_faces(v);
      const auto done = face;
      do face->set_in_domain(false);
      while (++face != done);
    }
  }

  void remove()
  {
    for (const Vertex_handle v : vertices_)
      if (v != Vertex_handle()) remove_hull_vertex(cdt_, v);
    vertices_.fill(Vertex_handle());
  }

  /// Gives its vertices consecutive numbers.
  void number_from(int id)
  {
    for (const Vertex_handle v : vertices_) v->set_id(id++);
  }

  bool contains(Vertex_handle v) const
  {
    return v == vertices_[0] || v == vertices_[1] || v == vertices_[2] || v == vertices_[3];
  }

private:
  Cdt& cdt_;
  std::array<Vertex_handle, 4> vertices_; // null while there is no frame
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_FRAME_2_H
