// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices a mesh with edges up to a given length has at least. Triangles can't be larger than equilateral
// ones, there are fewer than two a vertex, and constraints have to be cut into pieces. So a run whose budget can't
// suffice ends before it begins.

#ifndef WEFT_PLANAR_REFINE_LEAST_VERTICES_2_H
#define WEFT_PLANAR_REFINE_LEAST_VERTICES_2_H

#include <weft/internal/cold.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>

namespace weft::internal {

/// Lower bound of the number of vertices of a Working_mesh_2 when its longest edge has this length; linear time.
template <class Mesh>
WEFT_COLD double least_vertices(const Mesh& mesh, double longest)
{
  double triangles = 0, on_constraints = 0;
  for (const auto f : mesh.faces())
    triangles += CGAL::to_double(mesh.triangulation().triangle(f).area()) / longest / longest / std::sqrt(0.1875);
  for (const auto& chain : mesh.chains()) {
    const double dx = CGAL::to_double(chain.target->point().x()) - CGAL::to_double(chain.source->point().x()),
                 dy = CGAL::to_double(chain.target->point().y()) - CGAL::to_double(chain.source->point().y());
    on_constraints += (std::max)(0., std::sqrt(dx * dx + dy * dy) / longest - 1);
  }
  // Sums are rounded.
  return (1 - 1e-6) * (std::max)(triangles / 2, static_cast<double>(mesh.vertices().size()) + on_constraints);
}

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_LEAST_VERTICES_2_H
