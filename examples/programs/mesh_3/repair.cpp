// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface.h"

#include <weft/spatial/surface/repair_surface_3.h>

namespace mesh_3_program {

std::vector<std::string> repair(weft::Polygon_soup_3<K>& soup)
{
  return weft::repair_surface<K>(soup);
}

} // namespace mesh_3_program
