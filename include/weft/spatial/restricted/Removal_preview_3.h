// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a restricted Delaunay triangulation would be like without a vertex, found without changing it: the cells in its
// place, their labels and the facets of them that are restricted. Most trials to take a vertex away fail.

#ifndef WEFT_SPATIAL_RESTRICTED_REMOVAL_PREVIEW_3_H
#define WEFT_SPATIAL_RESTRICTED_REMOVAL_PREVIEW_3_H

#include <weft/spatial/restricted/Cell_classifier_3.h>
#include <weft/spatial/restricted/Handle_marks.h>
#include <weft/spatial/restricted/star_aside_3.h>
#include <weft/spatial/restricted/Star_filling_3.h>

#include <iterator>
#include <vector>

namespace weft::internal {

/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Removal_preview_3
{
public:
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Cell_handle = typename Restricted::Cell_handle;
  using Facet = typename Restricted::Restricted_facet;

  /// \param mesh has to live as long as this object.
  explicit Removal_preview_3(const Restricted& mesh) : mesh_(&mesh), classifier_(mesh.oracle(), 1) {}

  /// Finds the cells; false where the vertex has too many neighbours for that.
  /// \pre the mesh is classified.
  bool look_without(Vertex_handle v)
  {
    star_.clear();
    mesh_->triangulation().incident_cells(v, std::back_inserter(star_));
    return filling_.find(mesh_->triangulation(), v, star_);
  }
  /// The same while other threads look at the mesh, too.
  bool look_without_marks(Vertex_handle v)
  {
    list_star_aside(v, star_, marks_);
    return filling_.find(mesh_->triangulation(), v, star_);
  }

  /// The neighbours of the vertex.
  const std::vector<Vertex_handle>& neighbours() const { return filling_.neighbours(); }

  /// Labels the cells and finds their restricted facets.
  void classify() { classifier_.classify(filling_.cells()); }

  /// The cells; not in the mesh, though they know their neighbours in it.
  const std::vector<Cell_handle>& cells() const { return filling_.cells(); }
  /// Their restricted facets, those to the neighbours included.
  const std::vector<Facet>& facets() const { return classifier_.facets(); }

  /// Questions to the oracle so far.
  const Oracle_counts_3& counts() const { return classifier_.counts(); }

private:
  const Restricted* mesh_;
  Star_filling_3<typename Restricted::Triangulation> filling_;
  Cell_classifier_3<typename Restricted::Triangulation, typename Restricted::Oracle> classifier_;
  std::vector<Cell_handle> star_;
  Handle_marks marks_; ///< of its cells
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_REMOVAL_PREVIEW_3_H
