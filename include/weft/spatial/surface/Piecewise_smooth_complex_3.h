// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary of a spatial domain as a piecewise smooth complex (Tournois 2009, sec. 3.2.1.1), given by a piecewise
// linear approximation: a closed oriented triangle surface, its sharp edges chained to creases, its patches between
// them, and the feature vertices that every mesh must keep. Plain arrays; `piecewise_smooth_complex()` derives them
// from a surface and checks what has to hold.

#ifndef WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_3_H
#define WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_3_H

#include <weft/spatial/surface/Mending_record_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// Why a vertex of a piecewise smooth complex has to be a vertex of every mesh.
enum class Feature_kind
{
  corner, ///< three or more sharp edges meet
  dart,   ///< a crease ends
  cusp,   ///< two sharp edges meet at a sharp angle, or given by the user
  tip     ///< no sharp edge, given by the user
};

/// A piecewise smooth complex. Indices are positions in the arrays below.
/// \tparam K a CGAL kernel.
template <class K>
struct Piecewise_smooth_complex_3
{
  using Kernel = K;
  using Point = typename K::Point_3;

  /// A chain of sharp edges. It starts at its end with the smaller index; a cycle at its smallest vertex, from there to
  /// the smaller neighbour.
  struct Crease
  {
    /// In order; a cycle doesn't repeat its first vertex. A crease that comes back to its only feature vertex isn't a
    /// cycle: it has that vertex at both ends.
    std::vector<std::size_t> vertices;
    bool closed = false; ///< a cycle without a feature vertex; else both ends are feature vertices
    bool given = false;  ///< some of its edges were given, or subdomains meet there; not found by angle alone
  };

  /// A vertex that stays.
  struct Feature
  {
    std::size_t vertex;
    Feature_kind kind;
  };

  std::vector<Point> points;                         ///< each a corner of a triangle
  std::vector<std::array<std::size_t, 3>> triangles; ///< counterclockwise seen from the outside of the domain
  std::vector<int> patches;      ///< of each triangle, from 0 by first triangle: maximal parts without creases
  std::vector<int> shells;       ///< of each triangle, from 0 by first triangle: connected components of the surface
  std::vector<Crease> creases;   ///< in the order of their first two vertices
  std::vector<Feature> features; ///< in the order of their vertices
  /// Of each patch, the subdomains behind it and before it, where there are several; empty: 1 behind, 0 before.
  std::vector<std::pair<int, int>> sides;
  std::vector<std::string> names;             ///< of the subdomains from 1 on, where something names them; may be empty
  std::vector<std::array<Point, 3>> left_out; ///< triangles of fins and sheets, which bound nothing
  int number_of_patches = 0;
  int number_of_shells = 0;
  std::vector<std::string> changes; ///< what was changed in the input, for people, one line each: shells turned over,
                                    ///< what was mended; empty if nothing
  Mending_record_3 mending;         ///< the same in numbers, but for shells
};

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_PIECEWISE_SMOOTH_COMPLEX_3_H
