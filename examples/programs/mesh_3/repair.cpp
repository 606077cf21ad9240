// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface.h"

#include <weft/spatial/surface/repair_surface_3.h>

#include <CGAL/Surface_mesh.h>

// In remove_intersections.cpp: both together take more than a compiler process should.
extern template bool weft::internal::remove_intersections(CGAL::Surface_mesh<mesh_3_program::K::Point_3>&);

namespace mesh_3_program {

std::vector<std::string> repair(weft::Polygon_soup_3<K>& soup)
{
  return weft::repair_surface<K>(soup);
}

} // namespace mesh_3_program
