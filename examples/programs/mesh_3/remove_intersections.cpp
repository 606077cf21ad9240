// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface.h"

#include <weft/spatial/surface/repair_surface_3.h>

#include <CGAL/Surface_mesh.h>

template bool weft::internal::remove_intersections(CGAL::Surface_mesh<mesh_3_program::K::Point_3>&);
