// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's MeshCriteria_3 as criteria of weft. They are predicates on facets and cells of a CGAL triangulation, and may
// be of the user's own; so each facet and cell is shown to them in a triangulation of a single tetrahedron.

#ifndef WEFT_SPATIAL_CGAL_CGAL_CRITERIA_3_H
#define WEFT_SPATIAL_CGAL_CGAL_CRITERIA_3_H

#include <weft/spatial/criteria/Criteria_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace weft::internal {

/// Shows one facet or cell after the other to CGAL's criteria.
/// \tparam C3t3 a CGAL::Mesh_complex_3_in_triangulation_3.
/// \tparam Oracle a Mesh_domain_oracle_3, which knows the indices.
template <class C3t3, class Criteria, class Oracle>
class Criteria_probe_3
{
public:
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  using Triangulation = typename C3t3::Triangulation;

  Criteria_probe_3(const Criteria& criteria, const Oracle& oracle, const Length_field_3<Kernel>& crease_size)
      : criteria_(criteria), oracle_(oracle), crease_size_(crease_size)
  {
    using Weighted_point = typename Triangulation::Weighted_point;
    vertices_[0] = triangulation_.insert(Weighted_point(Point(0, 0, 0)));
    vertices_[1] = triangulation_.insert(Weighted_point(Point(1, 0, 0)));
    vertices_[2] = triangulation_.insert(Weighted_point(Point(0, 1, 0)));
    vertices_[3] = triangulation_.insert(Weighted_point(Point(0, 0, 1)));
    cell_ = *triangulation_.finite_cell_handles().begin();
    for (int i = 0; i < 4; ++i) vertices_[static_cast<std::size_t>(i)] = cell_->vertex(i);
  }

  double operator()(const Facet_view_3<Kernel>& facet)
  {
    if (is_between_features(facet.points, facet.locations)) return 0;
    for (std::size_t i = 0; i < 3; ++i) {
      set_point(i + 1, *facet.points[i]);
      vertices_[i + 1]->set_dimension(facet.locations[i].dimension);
      vertices_[i + 1]->set_index(oracle_.index(facet.locations[i]));
    }
    // Orientation of the cell doesn't matter to a facet, but a flat cell might.
    const auto normal = CGAL::cross_product(*facet.points[1] - *facet.points[0], *facet.points[2] - *facet.points[0]);
    const double size = std::sqrt(std::sqrt(CGAL::to_double(normal.squared_length())));
    set_point(0, size > 0 ? *facet.points[0] + normal / size : *facet.points[0]);
    const auto patch = oracle_.surface_patch_index(facet.patch);
    cell_->set_facet_surface_center(0, *facet.center);
    cell_->set_facet_surface_center_index(0, oracle_.index({2, facet.patch}));
    cell_->set_surface_patch_index(0, patch);
    return ratio(criteria_.facet_criteria_object()(triangulation_, typename Triangulation::Facet(cell_, 0)));
  }

  double operator()(const Cell_view_3<Kernel>& cell)
  {
    if (is_between_features(cell.points, cell.locations)) return 0;
    for (std::size_t i = 0; i < 4; ++i) set_point(i, *cell.points[i]);
    cell_->set_subdomain_index(oracle_.subdomain_index(cell.subdomain));
    return ratio(criteria_.cell_criteria_object()(triangulation_, cell_));
  }

  /// Circumradius of the largest regular tetrahedron around a point that is good, up to 1e-6; at most `largest`.
  double largest_radius(const Point& center, int subdomain, double largest)
  {
    const Vertex_location_3 inside{3, subdomain};
    const auto is_good = [&](double radius) {
      const double d = radius / std::sqrt(3.);
      const Point a(center.x() + d, center.y() + d, center.z() + d), b(center.x() + d, center.y() - d, center.z() - d),
          c(center.x() - d, center.y() + d, center.z() - d), e(center.x() - d, center.y() - d, center.z() + d);
      return !(
          (*this)(Cell_view_3<Kernel>{{{&a, &c, &b, &e}}, {{inside, inside, inside, inside}}, &center, subdomain}) > 1);
    };
    double low = 0;
    for (double high = largest; high - low > 1e-6 * high;) {
      const double middle = low == 0 && !is_good(1e-3 * high) ? 1e-3 * high : 0.5 * (low + high);
      (is_good(middle) ? low : high) = middle;
      if (high < 1e-9 * largest) break;
    }
    return low;
  }

private:
  template <std::size_t n>
  bool is_between_features(const std::array<const Point*, n>& points,
                           const std::array<Vertex_location_3, n>& locations) const
  {
    if (!crease_size_) return false;
    const auto on_feature = [](const Vertex_location_3& at) { return at.dimension < 2; };
    if (std::count_if(locations.begin(), locations.end(), on_feature) < 3) return false;
    const double size = crease_size_(*points[0]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (CGAL::to_double(CGAL::squared_distance(*points[i], *points[j])) > size * size) return false;
    return true;
  }

  void set_point(std::size_t i, const Point& p)
  {
    vertices_[i]->set_point(typename Triangulation::Weighted_point(p));
    cell_->invalidate_weighted_circumcenter_cache();
  }

  /// CGAL gives the quality of bad elements, the smaller the worse; sizes as squared ratios.
  template <class Is_bad>
  static double ratio(const Is_bad& is_bad)
  {
    if (!is_bad) return 0;
    const double quality = CGAL::to_double(is_bad->second);
    return quality > 0 && quality < 1 ? (std::min)(1e6, (std::max)(just_bad, 1 / std::sqrt(quality))) : just_bad;
  }

  static constexpr double just_bad = 1.0001;

  const Criteria& criteria_;
  const Oracle& oracle_;
  Length_field_3<Kernel> crease_size_;
  Triangulation triangulation_;
  typename Triangulation::Cell_handle cell_;
  std::array<typename Triangulation::Vertex_handle, 4> vertices_;
};

/// The circumradius up to which cells are good, if that is the same in the whole domain; else 0. Looks at the points of
/// a grid.
template <class Probe, class Oracle>
double constant_cell_radius(Probe& probe, const Oracle& oracle, double largest)
{
  constexpr int parts = 8;
  const auto b = oracle.bbox();
  double radius = 0;
  for (int i = 1; i < parts; ++i)
    for (int j = 1; j < parts; ++j)
      for (int k = 1; k < parts; ++k) {
        const auto at = [](double low, double high, int n) { return low + (high - low) * n / parts; };
        const typename Oracle::Point p(at(b.xmin(), b.xmax(), i), at(b.ymin(), b.ymax(), j), at(b.zmin(), b.zmax(), k));
        const int subdomain = oracle.subdomain(p);
        if (subdomain == 0) continue;
        const double here = probe.largest_radius(p, subdomain, largest);
        if (radius > 0 && std::abs(here - radius) > 1e-4 * radius) return 0;
        radius = here;
      }
  return radius < 0.9 * largest ? radius : 0;
}

/// CGAL's criteria as weft's.
/// \tparam C3t3 the CGAL::Mesh_complex_3_in_triangulation_3 that they are for.
/// \param criteria models MeshCriteria_3 or MeshCriteriaWithFeatures_3; has to live as long as the result.
/// \param oracle a Mesh_domain_oracle_3; has to live as long as the result.
template <class C3t3, class Criteria, class Oracle>
Criteria_3<typename Oracle::Kernel> cgal_criteria_3(const Criteria& criteria, const Oracle& oracle)
{
  using Kernel = typename Oracle::Kernel;
  using Point = typename Kernel::Point_3;
  const auto b = oracle.bbox();
  Criteria_3<Kernel> result;
  result.size = 2 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
  result.facet_shape = result.cell_shape = 0;
  if (oracle.number_of_creases() > 0) {
    const double longest = result.size.constant();
    const auto* edges = &criteria.edge_criteria_object();
    const auto* known = &oracle;
    result.crease_size = [edges, known, longest](const Point& p) {
      const double size = CGAL::to_double(edges->sizing_field(p, 1, known->index({1, 0})));
      return size > 0 ? (std::min)(size, longest) : longest;
    };
  }
  const auto probe = std::make_shared<Criteria_probe_3<C3t3, Criteria, Oracle>>(criteria, oracle, result.crease_size);
  result.facet_demand = [probe](const Facet_view_3<Kernel>& facet) { return (*probe)(facet); };
  // With edges of 1.8 circumradii, nearly as long as can be, a body-centred lattice has the radius just allowed.
  const double radius = constant_cell_radius(*probe, oracle, result.size.constant());
  if (radius > 0) result.size = 1.8 * radius;
  result.cell_demand = [probe](const Cell_view_3<Kernel>& cell) { return (*probe)(cell); };
  return result;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_CGAL_CGAL_CRITERIA_3_H
