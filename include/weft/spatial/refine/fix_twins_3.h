// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps optimisation from parting twins, see Mirror_twins_3.h: where two sheets are much nearer to each other than
// vertices on them are, moving one of a pair makes flat cells that nothing mends.

#ifndef WEFT_SPATIAL_REFINE_FIX_TWINS_3_H
#define WEFT_SPATIAL_REFINE_FIX_TWINS_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace weft::internal {

/// Makes vertices stay that have a twin nearer than half the distance to any other vertex. O(n log n).
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
void fix_twins(Restricted& mesh)
{
  using Point = typename Restricted::Point;
  using Vertex_handle = typename Restricted::Vertex_handle;
  if (!mesh.oracle().has_mirror_images()) return;
  const auto distance = [](const Point& p, const Point& q) {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q)));
  };
  constexpr double same = 1e-6; // part of the distance of twins
  constexpr double near = 0.5;
  std::vector<Vertex_handle> neighbours, twins;
  for (const Vertex_handle v : mesh.vertices()) {
    if (v->location().dimension > 2) continue;
    neighbours.clear();
    mesh.triangulation().finite_adjacent_vertices(v, std::back_inserter(neighbours));
    double mean = 0;
    std::size_t n = 0;
    for (const Vertex_handle w : neighbours) {
      if (w->location().dimension < 0) continue; // of the box
      mean += distance(v->point(), w->point());
      ++n;
    }
    if (n == 0) continue;
    mean /= static_cast<double>(n);
    twins.clear();
    mesh.oracle().visit_mirror_images(v->point(), v->location(), mean,
                                      [&](const Point& image, const Vertex_location_3&) {
                                        const double apart = distance(v->point(), image);
                                        for (const Vertex_handle w : neighbours)
                                          if (distance(w->point(), image) < same * apart) twins.push_back(w);
                                      });
    if (twins.empty()) continue;
    double spacing = mean;
    for (const Vertex_handle w : neighbours)
      if (std::find(twins.begin(), twins.end(), w) == twins.end())
        spacing = (std::min)(spacing, distance(v->point(), w->point()));
    for (const Vertex_handle w : twins) {
      if (distance(v->point(), w->point()) >= near * spacing) continue;
      mesh.fix(v);
      mesh.fix(w);
    }
  }
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_FIX_TWINS_3_H
