// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interior vertices on a body-centred cubic lattice, for domains that are thick against a constant size. The Delaunay
// tetrahedra of that lattice are all the same: dihedral angles of 60 and 90 degrees, edges of lengths a and a
// sqrt(3)/2. No mesh with edges up to a and fewer vertices is known that refinement could find: circumcenters inserted
// one after the other leave about twice as many.

#ifndef WEFT_SPATIAL_REFINE_INTERIOR_LATTICE_3_H
#define WEFT_SPATIAL_REFINE_INTERIOR_LATTICE_3_H

#include <weft/internal/parallel_for.h>
#include <weft/spatial/restricted/spatial_order_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace weft::internal {

/// The points of a body-centred cubic lattice that lie inside the domain, in an order in which to insert them
/// (Amenta, Choi, Rote, "Incremental constructions con BRIO", 2003).
/// \param spacing edge length of the cubes, in the input's units.
/// \param clearance smallest distance from the boundary, in the input's units.
/// \param most points; those of the lowest rows.
/// \param threads to ask the oracle.
template <class Oracle>
std::vector<typename Oracle::Kernel::Point_3> interior_lattice(const Oracle& oracle, double spacing, double clearance,
                                                               std::size_t most, int threads)
{
  using Point = typename Oracle::Kernel::Point_3;
  const CGAL::Bbox_3 b = oracle.bbox();
  std::vector<Point> points;
  const auto steps = [spacing](double low, double high) { return static_cast<int>(std::ceil((high - low) / spacing)); };
  const int nx = steps(b.xmin(), b.xmax()), ny = steps(b.ymin(), b.ymax()), nz = steps(b.zmin(), b.zmax());
  // Centred in the box, so that symmetric domains get symmetric lattices.
  const double x0 = 0.5 * (b.xmin() + b.xmax() - nx * spacing), y0 = 0.5 * (b.ymin() + b.ymax() - ny * spacing),
               z0 = 0.5 * (b.zmin() + b.zmax() - nz * spacing);
  std::vector<std::vector<Point>> rows(static_cast<std::size_t>(ny) + 1);
  for (int k = 0; k <= 2 * nz && points.size() < most; ++k) {
    const double shift = k % 2 == 0 ? 0 : 0.5;
    parallel_for(
        rows.size(), threads,
        [&](std::size_t j) {
          rows[j].clear();
          for (int i = 0; i <= nx; ++i) {
            const Point p(x0 + (i + shift) * spacing, y0 + (static_cast<int>(j) + shift) * spacing,
                          z0 + 0.5 * k * spacing);
            if (oracle.is_clear(p, clearance) && oracle.subdomain(p) != 0) rows[j].push_back(p);
          }
        },
        1);
    for (const std::vector<Point>& row : rows)
      for (const Point& p : row)
        if (points.size() < most) points.push_back(p);
  }
  // Row by row, each point would see half of the surface.
  std::vector<Point> in_order;
  in_order.reserve(points.size());
  for (const std::size_t i : insertion_order_3<typename Oracle::Kernel>(points)) in_order.push_back(points[i]);
  return in_order;
}

/// Calls `visit(number, facet)` for the points that lie in the surface Delaunay ball of a restricted facet. Linear in
/// the points and in the balls, expected. \param spacing of the grid in which points are looked up. \param least_radius
/// of the balls.
template <class Restricted, class Point, class Visit>
void visit_encroaching(const Restricted& mesh, double spacing, double least_radius, const std::vector<Point>& points,
                       const Visit& visit)
{
  using Key = std::array<long, 3>;
  const auto key_of = [spacing](double x, double y, double z) {
    return Key{{std::lround(std::floor(x / spacing)), std::lround(std::floor(y / spacing)),
                std::lround(std::floor(z / spacing))}};
  };
  std::map<Key, std::vector<std::size_t>> buckets;
  for (std::size_t i = 0; i < points.size(); ++i)
    buckets[key_of(points[i].x(), points[i].y(), points[i].z())].push_back(i);
  for (const auto& f : mesh.facets()) {
    if (f.cell == typename Restricted::Cell_handle() || f.squared_radius < least_radius * least_radius) continue;
    const double r = std::sqrt(f.squared_radius);
    const Key low = key_of(f.steiner.x() - r, f.steiner.y() - r, f.steiner.z() - r),
              high = key_of(f.steiner.x() + r, f.steiner.y() + r, f.steiner.z() + r);
    for (long x = low[0]; x <= high[0]; ++x)
      for (long y = low[1]; y <= high[1]; ++y)
        for (long z = low[2]; z <= high[2]; ++z) {
          const auto bucket = buckets.find({{x, y, z}});
          if (bucket == buckets.end()) continue;
          for (const std::size_t i : bucket->second)
            if (CGAL::to_double(CGAL::squared_distance(points[i], f.steiner)) < f.squared_radius) visit(i, f);
        }
  }
}

/// Drops the points that encroach: inserted, they could end up on the boundary of the mesh.
/// \param spacing,clearance as above: no point comes closer to the boundary, on which the centers of balls lie.
template <class Restricted, class Point>
void drop_encroaching(const Restricted& mesh, double spacing, double clearance, std::vector<Point>& points)
{
  std::vector<char> encroaches(points.size(), false);
  visit_encroaching(mesh, spacing, clearance, points, [&](std::size_t i, const auto&) { encroaches[i] = true; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!encroaches[i]) points[kept++] = points[i];
  points.resize(kept);
}

/// Inserts the lattice for a constant size.
/// \param most_vertices of the mesh.
template <class Restricted>
void insert_lattice(Restricted& mesh, double size, std::size_t most_vertices)
{
  // The nearer the lattice comes to the boundary, the fewer vertices fill the gap.
  constexpr double part = 0.98, clearance = 0.3;
  const double spacing = part * size;
  const std::size_t room = most_vertices - (std::min)(most_vertices, mesh.vertices().size());
  auto points = interior_lattice(mesh.oracle(), spacing, clearance * spacing, room, mesh.threads());
  drop_encroaching(mesh, spacing, clearance * spacing, points);
  std::vector<int> subdomains;
  for (const auto& p : points) subdomains.push_back(mesh.oracle().subdomain(p));
  mesh.insert(points, subdomains);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_INTERIOR_LATTICE_3_H
