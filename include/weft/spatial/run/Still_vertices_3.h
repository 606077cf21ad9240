// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps still what adaptation leaves alone: vertices that neither have changed nor are near to one that has.

#ifndef WEFT_SPATIAL_RUN_STILL_VERTICES_3_H
#define WEFT_SPATIAL_RUN_STILL_VERTICES_3_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Fixes vertices as long as it lives, of a mesh in which no others are fixed for good.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Still_vertices_3
{
public:
  using Vertex_handle = typename Restricted::Vertex_handle;

  /// \param since version of the mesh: vertices at cells that are newer have changed.
  /// \param changed by number, others that have.
  Still_vertices_3(Restricted& mesh, int since, const std::vector<char>& changed) : mesh_(mesh)
  {
    constexpr int rings = 1; // around vertices of new cells
    const std::size_t n = mesh.vertices().size();
    std::vector<char> moves(n, false);
    for (std::size_t v = 0; v < n; ++v)
      moves[v] = (v < changed.size() && changed[v]) || mesh.changed_at(mesh.vertices()[v]) >= since;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<char> wider = moves;
      for (const auto c : mesh.triangulation().finite_cell_handles()) {
        bool is_near = false;
        for (int i = 0; i < 4; ++i) is_near = is_near || (id(c->vertex(i)) < n && moves[id(c->vertex(i))]);
        for (int i = 0; is_near && i < 4; ++i)
          if (id(c->vertex(i)) < n) wider[id(c->vertex(i))] = true;
      }
      moves.swap(wider);
    }
    for (std::size_t v = 0; v < n; ++v) {
      const Vertex_handle vertex = mesh.vertices()[v];
      if (!moves[v] && !mesh.is_fixed(vertex)) mesh.fix(vertex);
    }
  }

  Still_vertices_3(const Still_vertices_3&) = delete;
  Still_vertices_3& operator=(const Still_vertices_3&) = delete;

  ~Still_vertices_3()
  {
    for (const Vertex_handle v : mesh_.vertices()) mesh_.release(v); // handles change when the mesh is sorted in memory
  }

private:
  static std::size_t id(Vertex_handle v) { return static_cast<std::size_t>(v->id()); } ///< vast for the box

  Restricted& mesh_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_STILL_VERTICES_3_H
