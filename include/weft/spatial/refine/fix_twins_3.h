// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps optimisation from parting twins, see Mirror_twins_3.h: where two sheets are nearer to each other than vertices
// on them are, moving one of a pair makes flat cells that hardly anything mends.

#ifndef WEFT_SPATIAL_REFINE_FIX_TWINS_3_H
#define WEFT_SPATIAL_REFINE_FIX_TWINS_3_H

#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace weft::internal {

/// Makes vertices stay that have a twin, nearer than any other vertex, across an edge of a very acute angle. O(n log
/// n).
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
  constexpr double same = 1e-6;        // part of the distance of twins
  constexpr double largest_angle = 30; // degrees; at larger ones optimisation makes good cells of any
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
      const double apart = distance(v->point(), w->point());
      if (apart >= spacing) continue;
      const auto middle = CGAL::midpoint(v->point(), w->point());
      if (mesh.oracle().acute_angle_at(middle, 0.5 * apart) > largest_angle) continue;
      mesh.fix_with_twin(v);
      mesh.fix_with_twin(w);
    }
  }
}

/// Whether some vertices stay because of their twins.
template <class Restricted>
bool has_fixed_twins(const Restricted& mesh)
{
  return std::any_of(mesh.vertices().begin(), mesh.vertices().end(),
                     [&mesh](auto v) { return mesh.is_fixed_with_twin(v); });
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_FIX_TWINS_3_H
