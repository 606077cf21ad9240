// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings a point back to where a vertex may lie: onto its own patch or crease (Tournois 2009, sec. 3.2.1.5).

#ifndef WEFT_SPATIAL_DOMAIN_PROJECT_ON_LOCATION_3_H
#define WEFT_SPATIAL_DOMAIN_PROJECT_ON_LOCATION_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <optional>

namespace weft::internal {

/// The nearest point of the patch or crease that a location names; inside and at feature vertices the point itself.
/// Nothing if the oracle, which may know its boundary by probing alone, finds no point of the patch.
/// \tparam Oracle a domain oracle, see Polyhedral_oracle_3.h.
template <class Oracle>
std::optional<typename Oracle::Kernel::Point_3>
project_on_location(const Oracle& oracle, const typename Oracle::Kernel::Point_3& p, const Vertex_location_3& location)
{
  if (location.dimension == 1) return oracle.project_on_crease(p, location.index);
  if (location.dimension != 2) return p;
  const auto hit = oracle.project_on_patch(p, location.index);
  if (hit.patch != location.index) return std::nullopt;
  return hit.point;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_PROJECT_ON_LOCATION_3_H
