// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps from surfaces to a mesh, each compiled on its own.

#ifndef WEFT_EXAMPLES_PROGRAMS_MESH_3_SURFACE_H
#define WEFT_EXAMPLES_PROGRAMS_MESH_3_SURFACE_H

#include "result.h"

#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>
#include <weft/spatial/surface/Polygon_soup_3.h>

#include <memory>
#include <string>
#include <vector>

namespace mesh_3_program {

/// `weft::mesh_surface_3()`.
std::shared_ptr<const Result> mesh_surface(const weft::Piecewise_smooth_complex_3<K>& surface, const Bounds& bounds,
                                           const weft::Mesh_options_3& options);

} // namespace mesh_3_program

#endif // WEFT_EXAMPLES_PROGRAMS_MESH_3_SURFACE_H
