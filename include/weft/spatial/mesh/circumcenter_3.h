// SPDX-License-Identifier: GPL-3.0-or-later
//
// Circumcenters of cells, rounded. Where doubles lose them (cells so flat that the determinant drowns in rounding) they
// are computed exactly and rounded then.

#ifndef WEFT_SPATIAL_MESH_CIRCUMCENTER_3_H
#define WEFT_SPATIAL_MESH_CIRCUMCENTER_3_H

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace weft::internal {

/// The circumcenter of a cell by rational arithmetic, each coordinate rounded once.
template <class K>
typename K::Point_3 exact_circumcenter_3(const typename K::Point_3& a, const typename K::Point_3& b,
                                         const typename K::Point_3& c, const typename K::Point_3& d)
{
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto exact = [](const typename K::Point_3& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
  const Exact::Point_3 center = CGAL::circumcenter(exact(a), exact(b), exact(c), exact(d));
  return {CGAL::to_double(center.x()), CGAL::to_double(center.y()), CGAL::to_double(center.z())};
}

/// The circumcenter of a cell that isn't flat. Rounded; its distances to the vertices agree to about 1e-6 of them, else
/// the exact one is taken.
template <class K>
typename K::Point_3 circumcenter_3(const typename K::Point_3& a, const typename K::Point_3& b,
                                   const typename K::Point_3& c, const typename K::Point_3& d)
{
  const double bx = b.x() - a.x(), by = b.y() - a.y(), bz = b.z() - a.z(), b2 = bx * bx + by * by + bz * bz;
  const double cx = c.x() - a.x(), cy = c.y() - a.y(), cz = c.z() - a.z(), c2 = cx * cx + cy * cy + cz * cz;
  const double dx = d.x() - a.x(), dy = d.y() - a.y(), dz = d.z() - a.z(), d2 = dx * dx + dy * dy + dz * dz;
  const double cdx = cy * dz - cz * dy, cdy = cz * dx - cx * dz, cdz = cx * dy - cy * dx;
  const double det = bx * cdx + by * cdy + bz * cdz;
  // The determinant's relative error is about 1e-15 times the product of lengths over it.
  const double scale = std::sqrt(b2 * c2 * d2);
  if (!(std::abs(det) > 1e-9 * scale)) return exact_circumcenter_3<K>(a, b, c, d);
  const double dbx = dy * bz - dz * by, dby = dz * bx - dx * bz, dbz = dx * by - dy * bx;
  const double bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
  const double f = 0.5 / det;
  return {a.x() + f * (b2 * cdx + c2 * dbx + d2 * bcx), a.y() + f * (b2 * cdy + c2 * dby + d2 * bcy),
          a.z() + f * (b2 * cdz + c2 * dbz + d2 * bcz)};
}

/// The circumcenter of a cell of a triangulation, the same to the last bit whatever the order of its vertices: a cell
/// that goes and comes back has the one it had.
template <class K, class Cell_handle>
typename K::Point_3 circumcenter_of_cell_3(Cell_handle c)
{
  std::array<const typename K::Point_3*, 4> p{};
  for (int i = 0; i < 4; ++i) p[static_cast<std::size_t>(i)] = &c->vertex(i)->point();
  const auto order = [&p](std::size_t i, std::size_t j) {
    if (*p[j] < *p[i]) std::swap(p[i], p[j]);
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return circumcenter_3<K>(*p[0], *p[1], *p[2], *p[3]);
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_MESH_CIRCUMCENTER_3_H
