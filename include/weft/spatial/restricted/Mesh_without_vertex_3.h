// SPDX-License-Identifier: GPL-3.0-or-later
//
// A restricted Delaunay triangulation as it would be without one of its vertices, looked at without changing it: points
// have the conflict zones that they would have there. Several threads may look at one mesh, each without another
// vertex.

#ifndef WEFT_SPATIAL_RESTRICTED_MESH_WITHOUT_VERTEX_3_H
#define WEFT_SPATIAL_RESTRICTED_MESH_WITHOUT_VERTEX_3_H

#include <weft/spatial/restricted/Conflict_zone_3.h>
#include <weft/spatial/restricted/Handle_marks.h>
#include <weft/spatial/restricted/star_aside_3.h>
#include <weft/spatial/restricted/Star_filling_3.h>

#include <CGAL/enum.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Mesh_without_vertex_3
{
public:
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;
  using Zone = typename Restricted::Zone;

  /// \param mesh has to live as long as this object.
  explicit Mesh_without_vertex_3(const Restricted& mesh) : mesh_(&mesh) {}

  /// Looks at the cells around a vertex. What this object tells from then on holds until the mesh changes.
  /// \param keep_seen whether to keep in mind what is looked at.
  void look_at(Vertex_handle v, bool keep_seen)
  {
    vertex_ = v;
    list_star_aside(v, star_, in_star_);
    keeps_seen_ = keep_seen;
    seen_.clear();
    is_seen_.clear();
    if (!keep_seen) return;
    for (const Cell_handle c : star_)
      for (int i = 0; i < 4; ++i) see(c->vertex(i));
  }

  /// Leaves the vertex out in thought; false where it has too many neighbours for that.
  bool leave_out() { return filling_.find(mesh_->triangulation(), vertex_, star_); }

  /// Ids of vertices, if they are kept in mind: while nothing changes around them, nothing that was looked at does.
  const std::vector<int>& seen() const { return seen_; }

  /// The cells around the vertex.
  const std::vector<Cell_handle>& star() const { return star_; }
  /// The cells in their place. They aren't in the mesh, though they know their neighbours there.
  const std::vector<Cell_handle>& filling() const { return filling_.cells(); }

  /// Finds the conflict zone of a point.
  /// \returns false if it has none: another vertex is there, or it lies outside the hull.
  bool find_zone(const Point& p, Zone& zone)
  {
    Cell_handle start = mesh_->triangulation().locate(p, star_.front());
    if (start->has_vertex(vertex_)) {
      for (int i = 0; i < 4; ++i) { // symbolic perturbation knows no equal points
        const Vertex_handle v = start->vertex(i);
        if (v != vertex_ && !mesh_->triangulation().is_infinite(v) && v->point() == p) return false;
      }
      std::size_t k = 0;
      while (k < filling().size() &&
             mesh_->triangulation().side_of_sphere(filling()[k], p, true) != CGAL::ON_BOUNDED_SIDE)
        ++k;
      if (k == filling().size()) return false;
      start = filling()[k];
    }
    const Zone_result result = find_conflict_zone_aside(mesh_->triangulation(), p, start, no_batch, zone, marks_,
                                                        [this](Cell_handle c, int i) { return step(c, i); });
    if (keeps_seen_) {
      see(start);
      for (const Cell_handle c : zone.cells) see(c);
      for (const auto& facet : zone.hull) see(facet.first);
    }
    return result == Zone_result::found;
  }

  /// Whether a cell belongs to the zone found last.
  bool is_in_zone(Cell_handle c) const { return marks_.get(c) == 1; }

private:
  void see(Vertex_handle v)
  {
    if (v->id() >= 0 && is_seen_.add(v, 1)) seen_.push_back(v->id());
  }

  /// One vertex of a cell is enough: a cell that goes changes the stars of all its vertices.
  void see(Cell_handle c)
  {
    for (int i = 0; i < 4; ++i)
      if (is_seen_.get(c->vertex(i)) == 1) return;
    for (int i = 0; i < 4; ++i) see(c->vertex(i));
  }

  /// The cell behind a facet, and the number of the facet there. Cells around the star don't know those that fill it.
  std::pair<Cell_handle, int> step(Cell_handle c, int i) const
  {
    const Cell_handle n = c->neighbor(i);
    if (n->has_vertex(vertex_)) {
      const auto& f = filling_.hull()[static_cast<std::size_t>(in_star_.get(n))];
      return {f.inner, f.inner_index};
    }
    int j = 0;
    for (; j < 3; ++j) {
      const Cell_handle m = n->neighbor(j);
      if (m == c) break;
      if (!m->has_vertex(vertex_)) continue;
      const auto& f = filling_.hull()[static_cast<std::size_t>(in_star_.get(m))];
      if (f.inner == c && f.inner_index == i) break;
    }
    return {n, j};
  }

  const Restricted* mesh_;
  Vertex_handle vertex_;
  std::vector<Cell_handle> star_;
  Star_filling_3<typename Restricted::Triangulation> filling_;
  Handle_marks in_star_; ///< places of its cells
  Handle_marks marks_;   ///< of the zone found last
  bool keeps_seen_ = false;
  Handle_marks is_seen_;
  std::vector<int> seen_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_MESH_WITHOUT_VERTEX_3_H
