// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex and cell bases of spatial meshes, and the Delaunay triangulation that is built from them.
//
// Every spatial component of weft works on a CGAL::Delaunay_triangulation_3 whose bases offer
//  - vertex: `location()`, on which feature vertex, crease, patch or in which subdomain it lies; `id()`, scratch
//  number;
//  - cell:   `subdomain()` of its circumcenter (0: outside); `circumcenter()`, cached; `facet_record(i)`, the number of
//            the restricted facet opposite to vertex i, or -1; `id()`, `bad_index()`, `batch()`, scratch numbers.

#ifndef WEFT_SPATIAL_RESTRICTED_MESH_TRIANGULATION_3_H
#define WEFT_SPATIAL_RESTRICTED_MESH_TRIANGULATION_3_H

#include <weft/internal/as_index.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/tags.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_3.h>

#include <array>
#include <cstddef>

namespace weft {

/// Vertex base of weft's spatial meshes.
template <class K, class Vb = CGAL::Triangulation_vertex_base_3<K>>
class Mesh_vertex_base_3 : public Vb
{
public:
  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Mesh_vertex_base_3<K, typename Vb::template Rebind_TDS<Tds>::Other>;
  };

  using Vb::Vb;
  Mesh_vertex_base_3() : Vb() {} // not defaulted: value initialisation would zero CGAL's uninitialised time stamps

  /// The part of the piecewise smooth complex that the vertex lies on; dimension -1 for the corners of the box.
  const Vertex_location_3& location() const { return location_; }
  void set_location(const Vertex_location_3& location) { location_ = location; }

  /// Running number; valid only while the component that set it runs.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

  /// Record of the first of the restricted facets at the vertex, which know the next one; -1 if there is none.
  int first_facet() const { return first_facet_; }
  void set_first_facet(int record) { first_facet_ = record; }

  // With these CGAL orders handles by age instead of by address, in removals for instance, which makes runs repeatable.
  using Has_timestamp = CGAL::Tag_true;
  std::size_t time_stamp() const { return time_stamp_; }
  void set_time_stamp(const std::size_t& stamp) { time_stamp_ = stamp; }

private:
  std::size_t time_stamp_; // set by CGAL's container alone, which keeps it while the place is free
  Vertex_location_3 location_{-1, 0};
  int id_ = -1;
  int first_facet_ = -1;
};

/// Cell base of weft's spatial meshes.
template <class K, class Cb = CGAL::Delaunay_triangulation_cell_base_3<K>>
class Mesh_cell_base_3 : public Cb
{
public:
  using Point_3 = typename K::Point_3;

  template <class Tds>
  struct Rebind_TDS
  {
    using Other = Mesh_cell_base_3<K, typename Cb::template Rebind_TDS<Tds>::Other>;
  };

  using Cb::Cb;
  Mesh_cell_base_3() : Cb() {} // not defaulted, as above

  /// Whether what follows is set.
  bool is_classified() const { return is_classified_; }
  void set_classified(bool b) { is_classified_ = b; }

  /// Subdomain that contains the circumcenter; 0 outside.
  int subdomain() const { return subdomain_; }
  void set_subdomain(int s) { subdomain_ = s; }

  /// The circumcenter, rounded to doubles; set when the cell is classified.
  const Point_3& circumcenter() const { return circumcenter_; }
  void set_circumcenter(const Point_3& c) { circumcenter_ = c; }

  /// Number of the restricted facet opposite to vertex i; -1 if that facet isn't restricted.
  int facet_record(int i) const { return facet_records_[internal::as_index(i)]; }
  void set_facet_record(int i, int record) { facet_records_[internal::as_index(i)] = record; }

  /// Running number; valid only while the component that set it runs.
  int id() const { return id_; }
  void set_id(int i) { id_ = i; }

  /// Place in the list of bad cells; -1 for a cell that isn't bad.
  int bad_index() const { return bad_index_; }
  void set_bad_index(int i) { bad_index_ = i; }

  /// Number of the last batch that claimed the cell or a neighbour of it.
  int batch() const { return batch_; }
  void set_batch(int b) { batch_ = b; }

  // With these CGAL orders handles by age instead of by address, in removals for instance, which makes runs repeatable.
  using Has_timestamp = CGAL::Tag_true;
  std::size_t time_stamp() const { return time_stamp_; }
  void set_time_stamp(const std::size_t& stamp) { time_stamp_ = stamp; }

private:
  std::size_t time_stamp_; // as above
  Point_3 circumcenter_;
  std::array<int, 4> facet_records_{{-1, -1, -1, -1}};
  int subdomain_ = 0;
  int id_ = -1;
  int bad_index_ = -1;
  int batch_ = -1;
  bool is_classified_ = false;
};

/// The Delaunay triangulation that weft's spatial components work on.
/// \tparam K a CGAL kernel with exact predicates.
template <class K = CGAL::Exact_predicates_inexact_constructions_kernel>
using Mesh_triangulation_3 =
    CGAL::Delaunay_triangulation_3<K, CGAL::Triangulation_data_structure_3<Mesh_vertex_base_3<K>, Mesh_cell_base_3<K>>>;

} // namespace weft

#endif // WEFT_SPATIAL_RESTRICTED_MESH_TRIANGULATION_3_H
