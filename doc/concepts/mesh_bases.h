// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concepts of vertex, face and cell bases, as classes with just the members that they add to CGAL's. Part of the
// manual, not of the library; archetypes_test makes a mesh with the planar ones.

#ifndef WEFT_DOC_MESH_BASES_H
#define WEFT_DOC_MESH_BASES_H

#include <weft/planar/triangulation/Mesh_triangulation_2.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <array>
#include <cstddef>

namespace concepts {

/// Vertices of planar meshes: a model of CGAL's DelaunayMeshVertexBase_2 with these members in addition.
///
/// Models: weft::Mesh_vertex_base_2.
/// \ingroup concept_classes
class MeshVertexBase_2
{
public:
  /// A number that components use while they run.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

  /// The input segment that the vertex slides on, or a value of weft::Vertex_constraint.
  int constraint() const { return constraint_; }
  void set_constraint(int c) { constraint_ = c; }

private:
  int id_ = -1;
  int constraint_ = weft::free_vertex;
};

/// Faces of planar meshes: a model of CGAL's DelaunayMeshFaceBase_2, which has `is_in_domain()`, with these members in
/// addition.
///
/// Models: weft::Mesh_face_base_2.
/// \ingroup concept_classes
class MeshFaceBase_2
{
public:
  /// A number that components use while they run.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

private:
  int id_ = -1;
};

/// Vertices of spatial meshes: a model of CGAL's TriangulationVertexBase_3 with these members in addition. It should
/// carry time stamps, so that runs don't depend on addresses.
///
/// Models: weft::Mesh_vertex_base_3.
/// \ingroup concept_classes
class MeshVertexBase_3
{
public:
  /// The corner, crease, patch or subdomain that the vertex lies on; dimension -1 if it is no part of the mesh.
  const weft::Vertex_location_3& location() const { return location_; }
  void set_location(const weft::Vertex_location_3& location) { location_ = location; }

  /// A number that components use while they run.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

private:
  weft::Vertex_location_3 location_{-1, 0};
  int id_ = -1;
};

/// Cells of spatial meshes: a model of CGAL's DelaunayTriangulationCellBase_3 with these members in addition, and time
/// stamps as above.
///
/// Models: weft::Mesh_cell_base_3.
/// \tparam Point of the kernel of the mesh.
/// \ingroup concept_classes
template <class Point>
class MeshCellBase_3
{
public:
  /// Whether subdomain and circumcenter are set.
  bool is_classified() const { return is_classified_; }
  void set_classified(bool b) { is_classified_ = b; }

  /// The subdomain that the circumcenter lies in; 0 outside.
  int subdomain() const { return subdomain_; }
  void set_subdomain(int s) { subdomain_ = s; }

  /// The circumcenter, rounded to doubles.
  const Point& circumcenter() const { return circumcenter_; }
  void set_circumcenter(const Point& c) { circumcenter_ = c; }

  /// The number of the restricted facet opposite to vertex i; -1 if there is none.
  int facet_record(int i) const { return facet_records_[static_cast<std::size_t>(i)]; }
  void set_facet_record(int i, int record) { facet_records_[static_cast<std::size_t>(i)] = record; }

  /// A number that components use while they run.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

  /// The place in the list of bad cells; -1 for a cell that isn't bad.
  int bad_index() const { return bad_index_; }
  void set_bad_index(int i) { bad_index_ = i; }

  /// The last batch that claimed the cell or a neighbour.
  int batch() const { return batch_; }
  void set_batch(int b) { batch_ = b; }

private:
  Point circumcenter_;
  std::array<int, 4> facet_records_{{-1, -1, -1, -1}};
  int subdomain_ = 0, id_ = -1, bad_index_ = -1, batch_ = -1;
  bool is_classified_ = false;
};

} // namespace concepts

#endif // WEFT_DOC_MESH_BASES_H
