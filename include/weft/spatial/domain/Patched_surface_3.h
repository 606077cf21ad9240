// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles that bound subdomains and make up patches, ready for the queries of domain oracles: which side, where a
// segment meets them, the nearest point.

#ifndef WEFT_SPATIAL_DOMAIN_PATCHED_SURFACE_3_H
#define WEFT_SPATIAL_DOMAIN_PATCHED_SURFACE_3_H

#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace weft::internal {

/// One hierarchy of all triangles, and one of each patch if there are several. All queries may be asked by several
/// threads at once.
template <class K>
class Patched_surface_3
{
public:
  using Point = typename K::Point_3;
  using Triangle = Surface_triangle_3<K>;

  Patched_surface_3() = default;

  /// O(n log n).
  /// \param number_of_patches more than each triangle's.
  Patched_surface_3(const std::vector<Triangle>& triangles, std::size_t number_of_patches) : all_(triangles)
  {
    if (number_of_patches < 2) return;
    std::vector<std::vector<Triangle>> of_patch(number_of_patches);
    for (const Triangle& t : triangles) of_patch[static_cast<std::size_t>(t.patch)].push_back(t);
    for (const auto& patch : of_patch) patches_.emplace_back(patch);
  }

  CGAL::Bbox_3 bbox() const
  {
    const Box_3& box = all_.box();
    return CGAL::Bbox_3(box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]);
  }

  /// Exact; 0 outside and on the surface.
  int subdomain(const Point& p) const { return all_.subdomain(p); }

  /// See Polyhedral_oracle_3::intersect().
  int intersect(const Point& p, const Point& q, std::vector<Surface_hit_3<K>>& hits) const
  {
    const auto first = hits.size();
    int change = 0;
    std::vector<Contact> contacts; // allocates only where something is degenerate
    all_.visit_segment(p, q, [&](const auto& pair) {
      if (pair.crosses()) change ^= pair.change();
      if (pair.is_degenerate())
        pair.contacts([&](const Contact& contact) { contacts.push_back(contact); });
      else
        hits.push_back({pair.point(), pair.patch(), pair.triangle()});
      return false;
    });
    if (!contacts.empty() && add_contacts(p, q, contacts, hits)) change = subdomain(p) ^ subdomain(q);
    if (hits.size() - first > 1) sort_along(p, q, hits, first);
    return change;
  }

  /// Whether the closed segment pq and the surface have a point in common.
  bool meets(const Point& p, const Point& q) const
  {
    return all_.visit_segment(p, q, [&](const auto& pair) {
      bool touches = !pair.is_degenerate();
      if (!touches) pair.contacts([&](const Contact&) { touches = true; });
      return touches;
    });
  }

  Surface_hit_3<K> nearest(const Point& p) const { return hit(all_.nearest(p)); }
  Surface_hit_3<K> nearest_on_patch(const Point& p, int patch) const
  {
    return hit(patches_.empty() ? all_.nearest(p) : patches_[static_cast<std::size_t>(patch)].nearest(p));
  }

  bool is_within(const Point& p, double squared_distance) const { return all_.is_within(p, squared_distance); }

  /// See Triangle_hierarchy_3::clearance().
  double clearance(const Point& p) const { return all_.clearance(p); }

private:
  using Contact = Contact_3<Point>;

  static Surface_hit_3<K> hit(const typename Triangle_hierarchy_3<K>::Nearest& nearest)
  {
    return {nearest.point, nearest.patch, static_cast<int>(nearest.triangle)};
  }

  // Appends each touched vertex, edge or triangle once; returns whether an end of the segment is touched.
  static bool add_contacts(const Point& p, const Point& q, std::vector<Contact>& contacts,
                           std::vector<Surface_hit_3<K>>& hits)
  {
    const auto key = [](const Contact& c) { return std::make_tuple(c.first, c.second, static_cast<int>(c.end)); };
    std::sort(contacts.begin(), contacts.end(), [&](const Contact& x, const Contact& y) {
      return std::make_pair(key(x), x.triangle) < std::make_pair(key(y), y.triangle);
    });
    bool at_end = false;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& c = contacts[i];
      at_end = at_end || c.point == p || c.point == q;
      if (i == 0 || key(c) != key(contacts[i - 1])) hits.push_back({c.point, c.patch, static_cast<int>(c.triangle)});
    }
    return at_end;
  }

  static void sort_along(const Point& p, const Point& q, std::vector<Surface_hit_3<K>>& hits, std::size_t first)
  {
    const Xyz_3 d = difference(q, p);
    const auto along = [&](const Point& x) {
      return d[0] * (x.x() - p.x()) + d[1] * (x.y() - p.y()) + d[2] * (x.z() - p.z());
    };
    std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
              [&](const Surface_hit_3<K>& x, const Surface_hit_3<K>& y) {
                const double at_x = along(x.point), at_y = along(y.point);
                return std::tie(at_x, x.point, x.patch) < std::tie(at_y, y.point, y.patch);
              });
  }

  Triangle_hierarchy_3<K> all_;
  std::vector<Triangle_hierarchy_3<K>> patches_; // empty if there is but one
};

/// That of a complex, with its triangles' numbers. O(n log n).
template <class K>
Patched_surface_3<K> patched_surface_of(const Piecewise_smooth_complex_3<K>& complex)
{
  std::vector<Surface_triangle_3<K>> all;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    Surface_triangle_3<K> triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.vertices[i] = static_cast<std::uint32_t>(complex.triangles[t][i]);
      triangle.points[i] = complex.points[triangle.vertices[i]];
    }
    triangle.index = static_cast<std::uint32_t>(t);
    triangle.patch = complex.patches[t];
    if (!complex.sides.empty()) {
      const auto& [behind, before] = complex.sides[static_cast<std::size_t>(triangle.patch)];
      triangle.change = behind ^ before;
    }
    all.push_back(triangle);
  }
  return Patched_surface_3<K>(all, static_cast<std::size_t>(complex.number_of_patches));
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_DOMAIN_PATCHED_SURFACE_3_H
