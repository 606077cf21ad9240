// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex and face bases of planar meshes, and the triangulation type that is built from them.
//
// Every planar component of weft works on a CGAL::Constrained_Delaunay_triangulation_2 whose face base models
// CGAL's DelaunayMeshFaceBase_2 (`is_in_domain()`, `set_in_domain(bool)`) and, where the component's first
// paragraph says so, carries what the two bases below add:
//  - vertex: `id()`, scratch space for a running number;
//            `constraint()`, which input segment the vertex slides on, see Vertex_constraint;
//  - face:   `id()`, scratch space for a running number.
// A triangulation with these bases can be handed to CGAL's own mesher and back.

#ifndef WEFT_PLANAR_TRIANGULATION_MESH_TRIANGULATION_2_H
#define WEFT_PLANAR_TRIANGULATION_MESH_TRIANGULATION_2_H

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>

namespace weft {

/// Values of `Mesh_vertex_base_2::constraint()` below zero; values from 0 on are indices of input segments.
enum Vertex_constraint : int
{
  free_vertex = -1, ///< may move anywhere in the plane
  fixed_vertex = -2 ///< an input vertex: never moves
};

/// Vertex base of weft's planar meshes: a CGAL Delaunay mesh vertex base that knows what it may slide on.
template <class K, class Vb = CGAL::Delaunay_mesh_vertex_base_2<K>>
class Mesh_vertex_base_2 : public Vb
{
public:
  using Face_handle = typename Vb::Face_handle;
  using Point = typename Vb::Point;

  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Mesh_vertex_base_2<K, typename Vb::template Rebind_TDS<Tds>::Other>;
  };

  using Vb::Vb;
  // Not defaulted: value initialisation would then zero CGAL's uninitialised time stamps, by which handles compare.
  Mesh_vertex_base_2() : Vb() {}

  /// Running number; valid only while the component that set it runs.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

  /// Input segment that the vertex was inserted on, or a value of `Vertex_constraint`.
  int constraint() const { return constraint_; }
  void set_constraint(int c) { constraint_ = c; }

private:
  int id_ = -1;
  int constraint_ = free_vertex;
};

/// Face base of weft's planar meshes: a CGAL Delaunay mesh face base with a running number.
template <class K, class Fb = CGAL::Delaunay_mesh_face_base_2<K>>
class Mesh_face_base_2 : public Fb
{
public:
  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Mesh_face_base_2<K, typename Fb::template Rebind_TDS<Tds>::Other>;
  };

  using Fb::Fb;
  Mesh_face_base_2() : Fb() {} // not defaulted, as above

  /// Running number; valid only while the component that set it runs.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

private:
  int id_ = -1;
};

/// The triangulation that weft's readers fill and `make_mesh_2()` refines.
/// \tparam K a CGAL kernel with exact predicates.
template <class K = CGAL::Exact_predicates_inexact_constructions_kernel>
using Mesh_triangulation_2 = CGAL::Constrained_Delaunay_triangulation_2<
    K, CGAL::Triangulation_data_structure_2<Mesh_vertex_base_2<K>, Mesh_face_base_2<K>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

} // namespace weft

#endif // WEFT_PLANAR_TRIANGULATION_MESH_TRIANGULATION_2_H
