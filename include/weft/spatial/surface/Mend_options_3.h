// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far mending of surfaces may go.

#ifndef WEFT_SPATIAL_SURFACE_MEND_OPTIONS_3_H
#define WEFT_SPATIAL_SURFACE_MEND_OPTIONS_3_H

#include <weft/errors.h>

#include <functional>
#include <string>

namespace weft {

/// Options of `mended_complex_3()`.
struct Mend_options_3
{
  /// Points of facets that don't fit together are welded within this distance, in parts of the bounding box' diagonal,
  /// and edges are split at points that are as near to them; 0: only equal points and points on edges.
  double tolerance = 1e-6;

  /// Facets that bound nothing, such as fins, are left out up to this part of the surface's area; above it the surface
  /// is refused.
  double most_left_out = 0.3;

  /// Holes of a part of the surface are capped if caps are at most this part of its area; 0: none.
  double most_capped = 0.3;

  /// Asked again and again whether to go on, from the thread that mends, with what is being done; none: always. If it
  /// says no, mending ends with a Stopped_error.
  std::function<bool(const char*)> go_on;

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    if (!(tolerance >= 0 && tolerance <= 0.01)) throw Option_error("tolerance must be between 0 and 0.01");
    if (!(most_left_out >= 0 && most_left_out < 1)) throw Option_error("most_left_out must be from 0 to below 1");
    if (!(most_capped >= 0 && most_capped < 1)) throw Option_error("most_capped must be from 0 to below 1");
  }
};

namespace internal {

/// \throws Stopped_error if the caller doesn't want to go on.
inline void ask_to_go_on(const Mend_options_3& options, const char* doing)
{
  if (options.go_on && !options.go_on(doing)) throw Stopped_error(std::string("stopped while ") + doing);
}

} // namespace internal
} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_MEND_OPTIONS_3_H
