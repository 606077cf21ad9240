// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface.h"

#include <weft/mesh_surface_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

namespace mesh_3_program {

std::shared_ptr<const Result> mesh_surface(const weft::Piecewise_smooth_complex_3<K>& surface, const Bounds& bounds,
                                           const weft::Mesh_options_3& options)
{
  const auto result = weft::mesh_surface_3(surface, criteria(bounds), options);
  return make_result(weft::tetrahedral_mesh(result.restricted), result.report);
}

} // namespace mesh_3_program
