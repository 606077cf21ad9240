// SPDX-License-Identifier: GPL-3.0-or-later

#include "sizes.h"
#include "surface.h"

#include <weft/mesh_surface_3.h>
#include <weft/spatial/restricted/extract_mesh_3.h>

#include <cstddef>
#include <utility>

namespace mesh_3_program {

std::shared_ptr<const Result> mesh_surface(const weft::Piecewise_smooth_complex_3<K>& surface, const Bounds& bounds,
                                           const weft::Mesh_options_3& options)
{
  Parts parts;
  for (int p = 0; p < surface.number_of_patches; ++p) {
    parts.sides.push_back(surface.sides.empty() ? std::make_pair(1, 0) : surface.sides[static_cast<std::size_t>(p)]);
    for (const int side : {parts.sides.back().first, parts.sides.back().second})
      if (side != 0) parts.subdomains[side] = side;
  }
  const weft::Mesh_names_3 names{by_subdomain(bounds.name_of, parts), {}};
  weft::Criteria_3<K> criteria = mesh_3_program::criteria(bounds, parts);
  if (bounds.vary()) criteria = with_sizes(weft::Polyhedral_oracle_3<K>(surface), criteria, bounds);
  const auto result = weft::mesh_surface_3(surface, criteria, options);
  weft::Tetrahedral_mesh_3<K> mesh = weft::tetrahedral_mesh(result.restricted);
  auto second = raised(mesh, result.restricted.oracle(), bounds.order);
  return make_result(std::move(mesh), result.report, names, std::move(second));
}

} // namespace mesh_3_program
