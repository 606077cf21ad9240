// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `piecewise_smooth_complex()` takes for a sharp edge and for a feature vertex (Tournois 2009, sec. 3.2.1.1).

#ifndef WEFT_SPATIAL_SURFACE_FEATURE_OPTIONS_H
#define WEFT_SPATIAL_SURFACE_FEATURE_OPTIONS_H

#include <weft/errors.h>

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// Options of `piecewise_smooth_complex()`. Indices are positions in the caller's own array of points.
struct Feature_options
{
  /// Edges are sharp from this angle in degrees on; a number stands for options.
  Feature_options(double angle = 60) : sharp_angle(angle) {} // NOLINT: implicit

  /// An edge is sharp from this angle between the normals of its two facets on, in degrees; 0 or 180: only the edges
  /// given below are sharp. Between 0 and 180 small angles find many sharp edges, large ones few.
  double sharp_angle = 60;

  /// A vertex with two sharp edges is a cusp if the crease turns there by more than this angle, in degrees; 0 or 180:
  /// only the cusps given below. The default leaves the rims of hexagons and finer polygons smooth, and keeps the
  /// corners of squares and triangles.
  double cusp_angle = 60;

  /// Creases found by angle that end without meeting another one aren't creases if they are shorter than this, in parts
  /// of the bounding box' diagonal; 0: all are. In scanned surfaces they are noise; those of machine parts are much
  /// longer.
  double least_open_crease = 0.02;

  /// Edges that are sharp whatever their angle: pairs of points.
  std::vector<std::array<std::size_t, 2>> sharp_edges;

  /// Vertices that stay though at most two sharp edges meet there: the tip of a cone, a cusp of a crease.
  std::vector<std::size_t> tips_and_cusps;

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    if (!(sharp_angle >= 0 && sharp_angle <= 180)) throw Option_error("sharp_angle must be between 0 and 180 degrees");
    if (!(least_open_crease >= 0)) throw Option_error("least_open_crease must not be negative");
    if (!(cusp_angle >= 0 && cusp_angle <= 180)) throw Option_error("cusp_angle must be between 0 and 180 degrees");
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_FEATURE_OPTIONS_H
