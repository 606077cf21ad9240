// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes of the elements of a spatial mesh of first or second order, for writers, which are compiled once for both.

#ifndef WEFT_IO_INTERNAL_MESH_NODES_3_H
#define WEFT_IO_INTERNAL_MESH_NODES_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/Quadratic_mesh_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <cstddef>
#include <vector>

namespace weft::internal {

/// A mesh that has to live as long as this object. Nodes of second order follow the corners of an element: of a cell
/// those between 01, 12, 02, 03, 13, 23, of a facet those between 01, 12, 20.
template <class K>
class Mesh_nodes_3
{
public:
  explicit Mesh_nodes_3(const Tetrahedral_mesh_3<K>& mesh) : mesh_(mesh), quadratic_(nullptr) {}
  explicit Mesh_nodes_3(const Quadratic_mesh_3<K>& mesh) : mesh_(mesh.vertices), quadratic_(&mesh) {}

  /// The mesh of first order, with all tags.
  const Tetrahedral_mesh_3<K>& mesh() const { return mesh_; }
  bool is_quadratic() const { return quadratic_ != nullptr; }

  std::size_t number_of_nodes() const { return quadratic_ ? quadratic_->number_of_nodes() : mesh_.points.size(); }
  Xyz_3 node(std::size_t i) const { return xyz(quadratic_ ? quadratic_->node(i) : mesh_.points[i]); }
  const Vertex_location_3& location(std::size_t i) const
  {
    return i < mesh_.points.size() ? mesh_.locations[i] : quadratic_->middle_locations[i - mesh_.points.size()];
  }

  const std::vector<std::size_t>& cell(std::size_t c)
  {
    nodes_.assign(mesh_.cells[c].begin(), mesh_.cells[c].end());
    if (quadratic_) nodes_.insert(nodes_.end(), quadratic_->cell_middles[c].begin(), quadratic_->cell_middles[c].end());
    return nodes_;
  }
  const std::vector<std::size_t>& facet(std::size_t f)
  {
    nodes_.assign(mesh_.facets[f].begin(), mesh_.facets[f].end());
    if (quadratic_)
      nodes_.insert(nodes_.end(), quadratic_->facet_middles[f].begin(), quadratic_->facet_middles[f].end());
    return nodes_;
  }
  const std::vector<std::size_t>& edge(std::size_t e)
  {
    nodes_.assign(mesh_.edges[e].begin(), mesh_.edges[e].end());
    if (quadratic_) nodes_.push_back(quadratic_->edge_middles[e]);
    return nodes_;
  }

private:
  const Tetrahedral_mesh_3<K>& mesh_;
  const Quadratic_mesh_3<K>* quadratic_;
  std::vector<std::size_t> nodes_; ///< of the element asked for last
};

} // namespace weft::internal

#endif // WEFT_IO_INTERNAL_MESH_NODES_3_H
