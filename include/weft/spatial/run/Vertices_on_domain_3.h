// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of a mesh on the parts of a domain that is given.

#ifndef WEFT_SPATIAL_RUN_VERTICES_ON_DOMAIN_3_H
#define WEFT_SPATIAL_RUN_VERTICES_ON_DOMAIN_3_H

#include <weft/spatial/local/Improve_options_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/spatial/run/Boundary_sizing_3.h>
#include <weft/spatial/run/Initial_vertices_3.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace weft::internal {

/// The vertices of a mesh on the parts of a domain.
template <class K, class Oracle>
class Vertices_on_domain_3
{
public:
  using Point = typename K::Point_3;

  Vertices_on_domain_3(const Tetrahedral_mesh_3<K>& mesh, const Oracle& oracle, const Boundary_sizing_3<K>& sizing,
                       const Improve_options_3& options)
      : oracle_(oracle)
  {
    std::vector<char> is_on_boundary(mesh.points.size(), false), is_fixed(mesh.points.size(), false);
    for (const auto& facet : mesh.facets)
      for (const std::size_t v : facet) is_on_boundary[v] = true;
    for (const std::size_t v : options.fixed_vertices) is_fixed[v] = true;
    for (std::size_t i = 0; i < oracle.number_of_corners(); ++i) add(oracle.corner(i), {0, static_cast<int>(i)});
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Point& p = mesh.points[v];
      if (is_fixed[v] && taken_.count(p) == 0) initial_.fixed.push_back(initial_.points.size());
      if (is_on_boundary[v]) {
        add_on_surface(p, near * sizing(p), is_fixed[v]);
        continue;
      }
      const int subdomain = oracle.subdomain(p);
      if (is_fixed[v] || subdomain != 0) add(p, {3, (std::max)(subdomain, 1)});
    }
  }

  const Initial_vertices_3<K>& initial() const { return initial_; }

private:
  static constexpr double near = 1e-3; ///< in parts of the length of edges nearby: on a crease or feature vertex

  void add(const Point& p, const Vertex_location_3& at)
  {
    if (!taken_.insert(p).second) return;
    initial_.points.push_back(p);
    initial_.locations.push_back(at);
  }

  void add_on_surface(const Point& p, double tolerance, bool stays)
  {
    const auto is_near = [&](const Point& q) { return CGAL::squared_distance(p, q) <= tolerance * tolerance; };
    for (std::size_t i = 0; i < oracle_.number_of_corners(); ++i)
      if (is_near(oracle_.corner(i))) return;
    for (std::size_t c = 0; c < oracle_.number_of_creases(); ++c) {
      const Point q = oracle_.project_on_crease(p, static_cast<int>(c));
      if (is_near(q)) return add(stays ? p : q, {1, static_cast<int>(c)});
    }
    const auto hit = oracle_.closest(p);
    add(stays ? p : hit.point, {2, hit.patch});
  }

  const Oracle& oracle_;
  Initial_vertices_3<K> initial_;
  std::set<Point> taken_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RUN_VERTICES_ON_DOMAIN_3_H
