// SPDX-License-Identifier: GPL-3.0-or-later
//
// The region of each face of a mesh and the mark of each constrained edge, from the tags that `insert_pslg()` returns.
// They hold for the triangulation as it is: before meshing, after it, and for one that anybody refined.

#ifndef WEFT_PLANAR_GRAPH_MESH_MARKS_2_H
#define WEFT_PLANAR_GRAPH_MESH_MARKS_2_H

#include <weft/internal/as_index.h>
#include <weft/planar/graph/Constraint_markers.h>
#include <weft/planar/graph/mark_domain.h>

#include <CGAL/Unique_hash_map.h>

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// Marks of faces and edges. Valid until the triangulation changes.
/// \tparam Cdt a CGAL constrained triangulation.
template <class Cdt>
class Mesh_marks_2
{
public:
  using Face_handle = typename Cdt::Face_handle;
  using Tags = Mesh_tags_2<typename Cdt::Geom_traits>;

  /// Linear time, with a logarithm in the number of input segments for the edges.
  /// \param tags as `insert_pslg()` returned them.
  Mesh_marks_2(const Cdt& cdt, const Tags& tags)
      : tags_(tags),
        components_(internal::face_components(cdt)),
        region_(internal::as_index(components_.count), -1),
        segments_(std::array<int, 3>{-1, -1, -1})
  {
    for (std::size_t i = 0; components_.count > 0 && i < tags.regions.size(); ++i)
      region_[internal::as_index(components_.number[cdt.locate(tags.regions[i].point)])] = static_cast<int>(i);
    if (components_.count > 0) region_[0] = -1;
    for (const auto& [edge, segment] : tags.constraints.constrained_edges(cdt)) {
      const auto [face, i] = edge;
      segments_[face][internal::as_index(i)] = segment;
      const Face_handle other = face->neighbor(i);
      segments_[other][internal::as_index(cdt.mirror_index(face, i))] = segment;
    }
  }

  /// Number of the connected part of the plane that no constraint separates; 0 is the outside.
  int component(Face_handle face) const { return components_.number[face]; }
  int number_of_components() const { return components_.count; }

  /// Index into `tags.regions` of the region whose point lies in the same component, -1 if there is none. Of several
  /// points in one component the last one counts.
  int region_index(Face_handle face) const { return region_[internal::as_index(components_.number[face])]; }

  /// Mark of that region; 0 where none is named, 1 if the input names no regions at all.
  int region(Face_handle face) const
  {
    const int i = region_index(face);
    return i >= 0 ? tags_.regions[internal::as_index(i)].marker : tags_.regions.empty() ? 1 : 0;
  }

  /// Input segment that edge `i` of the face is part of; -1 if it is no constrained edge, or from no known segment.
  int segment(Face_handle face, int i) const { return segments_[face][internal::as_index(i)]; }

  /// Mark of that segment (its number counted from 1 where the input has no marks); 0 if there is none.
  int edge(Face_handle face, int i) const { return tags_.constraints.marker(segment(face, i)); }

private:
  Tags tags_;
  internal::Face_components<Cdt> components_;
  std::vector<int> region_; ///< per component
  CGAL::Unique_hash_map<Face_handle, std::array<int, 3>> segments_;
};

} // namespace weft

#endif // WEFT_PLANAR_GRAPH_MESH_MARKS_2_H
