// SPDX-License-Identifier: GPL-3.0-or-later
//
// A smoother of one's own: every vertex inside wants to be in the middle of its neighbours (Laplacian smoothing). What
// mustn't break is the driver's business, `weft::smooth_3()`: it shortens moves and takes them back.

#ifndef WEFT_EXAMPLES_CUSTOM_SMOOTHER_H
#define WEFT_EXAMPLES_CUSTOM_SMOOTHER_H

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

struct Laplacian_smoother
{
  static constexpr bool moves_boundary = false; // vertices on patches and creases stay
  static constexpr bool minimises_odt = false;  // sweeps needn't lower the energy of optimal Delaunay triangulations

  /// \param star the cells around v. A vertex knows its place, `location()`, and its number, `id()`; a cell its
  ///        `subdomain()`, 0 outside.
  /// \returns nothing where the vertex should stay.
  template <class Context>
  std::optional<typename Context::Point> operator()(const Context&, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    std::set<int> seen; // each neighbour belongs to several cells
    double x = 0, y = 0, z = 0;
    for (const auto cell : star)
      for (int i = 0; i < 4; ++i) {
        const auto neighbour = cell->vertex(i);
        if (neighbour == v || !seen.insert(neighbour->id()).second) continue;
        x += neighbour->point().x();
        y += neighbour->point().y();
        z += neighbour->point().z();
      }
    if (seen.empty()) return std::nullopt;
    const double n = static_cast<double>(seen.size());
    return typename Context::Point(x / n, y / n, z / n);
  }
};

#endif // WEFT_EXAMPLES_CUSTOM_SMOOTHER_H
