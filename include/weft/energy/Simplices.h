// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as energies see it: points and simplices, of arrays as of triangulations that are being worked on.

#ifndef WEFT_ENERGY_SIMPLICES_H
#define WEFT_ENERGY_SIMPLICES_H

#include <weft/energy/coordinates.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::internal {

/// Points and positively oriented simplices.
template <std::size_t d>
struct Simplices
{
  using Number = std::uint32_t;
  static constexpr Number none = static_cast<Number>(-1);
  using Simplex = std::array<Number, d + 1>;

  std::vector<Coordinates<d>> points;
  std::vector<Simplex> simplices;
  std::vector<Simplex> neighbors; ///< opposite to each vertex; `none` on the boundary and across constraints
  std::vector<double> sizes;      ///< of the points, whose metric counts; empty: lengths are taken as they are

  /// Finds the neighbours of all simplices. O(n log n).
  void connect()
  {
    struct Side
    {
      std::array<Number, d> vertices;
      Number simplex, index;
    };
    std::vector<Side> sides;
    sides.reserve(simplices.size() * (d + 1));
    for (std::size_t s = 0; s < simplices.size(); ++s)
      for (std::size_t i = 0; i <= d; ++i) {
        Side side{{}, static_cast<Number>(s), static_cast<Number>(i)};
        for (std::size_t k = 0, n = 0; k <= d; ++k)
          if (k != i) side.vertices[n++] = simplices[s][k];
        std::sort(side.vertices.begin(), side.vertices.end());
        sides.push_back(side);
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::pair(a.vertices, a.simplex) < std::pair(b.vertices, b.simplex);
    });
    Simplex alone;
    alone.fill(none);
    neighbors.assign(simplices.size(), alone);
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Side &a = sides[k - 1], &b = sides[k];
      if (a.vertices != b.vertices) continue;
      neighbors[a.simplex][a.index] = b.simplex;
      neighbors[b.simplex][b.index] = a.simplex;
    }
  }
};

/// An energy with what minimising it needs.
template <std::size_t d>
struct Energy_terms
{
  /// Of an edge in the graph Laplacian; an edge may be listed several times, the weights count together.
  struct Weight
  {
    typename Simplices<d>::Number from, to;
    double value;
  };

  double value = 0;
  std::vector<Coordinates<d>> gradient; ///< by point
  std::vector<double> diagonal;         ///< by point: gradient over this is the step of the fixed-point iteration
  std::vector<Weight> weights;          ///< only if asked for; those at a point add up to about its diagonal
};

} // namespace weft::internal

#endif // WEFT_ENERGY_SIMPLICES_H
