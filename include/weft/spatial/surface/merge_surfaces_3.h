// SPDX-License-Identifier: GPL-3.0-or-later
//
// Several closed surfaces as the boundaries of several subdomains (Tournois 2009, sec. 4.2.1.2): beside each other,
// nested, or with facets in common, which become interfaces. Where subdomains meet along edges, those are creases.

#ifndef WEFT_SPATIAL_SURFACE_MERGE_SURFACES_3_H
#define WEFT_SPATIAL_SURFACE_MERGE_SURFACES_3_H

#include <weft/internal/boxes/Triangle_hierarchy_3.h>
#include <weft/spatial/surface/interface_complex_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>
#include <weft/spatial/surface/surface_groups_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// The largest number that a subdomain has.
template <class K>
int number_of_subdomains(const Piecewise_smooth_complex_3<K>& complex)
{
  int count = 1;
  for (const auto& [a, b] : complex.sides) count = (std::max)({count, a, b});
  return count;
}

/// Gives subdomains that nothing else names the name of their surface.
template <class K>
void name_by_surface(Piecewise_smooth_complex_3<K>& complex, const std::string& name)
{
  if (name.empty() || !complex.names.empty()) return;
  complex.names.assign(static_cast<std::size_t>(number_of_subdomains(complex)), name);
  make_names_differ(complex.names);
}

/// Puts surfaces together that each qualify by themselves.
template <class K>
class Surface_merger_3
{
  using Point = typename K::Point_3;
  using Complex = Piecewise_smooth_complex_3<K>;

public:
  explicit Surface_merger_3(const std::vector<Complex>& surfaces) : surfaces_(surfaces)
  {
    for (const Complex& surface : surfaces) {
      std::vector<Surface_triangle_3<K>> triangles;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        Surface_triangle_3<K> triangle;
        for (std::size_t i = 0; i < 3; ++i) {
          triangle.vertices[i] = static_cast<std::uint32_t>(surface.triangles[t][i]);
          triangle.points[i] = surface.points[surface.triangles[t][i]];
        }
        const auto [behind, before] = sides_in(surface, t);
        triangle.change = behind ^ before;
        triangle.index = static_cast<std::uint32_t>(t);
        triangle.patch = 0;
        triangles.push_back(triangle);
      }
      trees_.emplace_back(triangles);
    }
    int before = 0;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      add(static_cast<int>(i));
      first_subdomain_.push_back(before + 1);
      before += number_of_subdomains(surfaces_[i]);
    }
  }

  /// \param order of two surfaces the one that is later here has what lies in both.
  Complex complex(const Feature_options& options, std::vector<std::size_t> order)
  {
    order_ = std::move(order);
    check_crossings();
    Triangle_surface_3<K> surface;
    std::vector<std::pair<int, int>> sides;
    for (const Facet& facet : facets_) {
      auto [behind, before] = sides_of(facet);
      if (behind == before) continue; // within a later surface
      auto corners = facet.corners;
      if (behind == 0) {
        std::swap(corners[1], corners[2]);
        std::swap(behind, before);
      }
      surface.triangles.push_back(corners);
      sides.emplace_back(behind, before);
    }
    surface.points = points_;
    Feature_options by_angle = options;
    by_angle.sharp_edges.clear();
    by_angle.tips_and_cusps.clear();
    return interface_complex_3(std::move(surface), sides, by_angle);
  }

private:
  /// A surface that has a triangle, and its own subdomains behind and before the triangle as that is turned here.
  struct Owner
  {
    int surface, behind, before;
  };
  struct Facet
  {
    std::array<std::size_t, 3> corners;
    std::vector<Owner> owners;
  };

  static std::pair<int, int> sides_in(const Complex& surface, std::size_t triangle)
  {
    if (surface.sides.empty()) return {1, 0};
    return surface.sides[static_cast<std::size_t>(surface.patches[triangle])];
  }

  void add(int s)
  {
    const Complex& surface = surfaces_[static_cast<std::size_t>(s)];
    std::vector<std::size_t> number;
    for (const Point& p : surface.points) {
      const auto [at, is_new] = number_of_point_.try_emplace(p, points_.size());
      if (is_new) points_.push_back(p);
      number.push_back(at->second);
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      const std::array<std::size_t, 3> corners{{number[a], number[b], number[c]}};
      auto key = corners;
      std::sort(key.begin(), key.end());
      const auto [at, is_new] = facet_of_corners_.try_emplace(key, facets_.size());
      if (is_new) facets_.push_back({corners, {}});
      Facet& facet = facets_[at->second];
      const auto next = std::find(facet.corners.begin(), facet.corners.end(), corners[0]) - facet.corners.begin() + 1;
      auto [behind, before] = sides_in(surface, t);
      if (facet.corners[static_cast<std::size_t>(next % 3)] != corners[1]) std::swap(behind, before);
      facet.owners.push_back({s, behind, before});
    }
  }

  /// \throws Domain_error where an edge of one surface passes through a triangle of another.
  void check_crossings() const
  {
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      for (const auto& triangle : surfaces_[s].triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          if (triangle[i] > triangle[(i + 1) % 3]) continue;
          const Point &p = surfaces_[s].points[triangle[i]], &q = surfaces_[s].points[triangle[(i + 1) % 3]];
          for (std::size_t other = 0; other < surfaces_.size(); ++other)
            if (other != s && trees_[other].visit_segment(p, q, [](const auto& pair) { return !pair.is_degenerate(); }))
              throw Domain_error(
                  "surfaces " + std::to_string(s) + " and " + std::to_string(other) + " cross each other", {}, {});
        }
  }

  /// The subdomains behind and before a triangle: on each side, that of the last surface that contains it, from 1.
  std::pair<int, int> sides_of(const Facet& facet) const
  {
    const Point &a = points_[facet.corners[0]], &b = points_[facet.corners[1]], &c = points_[facet.corners[2]];
    const Point center((a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3, (a.z() + b.z() + c.z()) / 3);
    int behind = 0, before = 0;
    for (const std::size_t s : order_) {
      const auto owner = std::find_if(facet.owners.begin(), facet.owners.end(),
                                      [s](const auto& o) { return o.surface == static_cast<int>(s); });
      const auto number = [&](int subdomain) { return first_subdomain_[s] + subdomain - 1; };
      if (owner != facet.owners.end()) {
        if (owner->behind != 0) behind = number(owner->behind);
        if (owner->before != 0) before = number(owner->before);
      } else if (trees_[s].is_within(center, squared_rounding(center))) {
        throw Domain_error("facets of surface " + std::to_string(s) + " and of surface " +
                               std::to_string(facet.owners.front().surface) + " overlap without being the same",
                           {}, {});
      } else if (const int subdomain = trees_[s].subdomain(center)) {
        behind = before = number(subdomain);
      }
    }
    return {behind, before};
  }

  static double squared_rounding(const Point& p)
  {
    const double r = 1e-13 * (std::abs(p.x()) + std::abs(p.y()) + std::abs(p.z()));
    return r * r;
  }

  const std::vector<Complex>& surfaces_;
  std::vector<Triangle_hierarchy_3<K>> trees_;
  std::vector<int> first_subdomain_; ///< of each surface
  std::vector<std::size_t> order_;
  std::map<Point, std::size_t> number_of_point_;
  std::vector<Point> points_;
  std::map<std::array<std::size_t, 3>, std::size_t> facet_of_corners_;
  std::vector<Facet> facets_;
};

/// The complex of several surfaces, of which `complex_of(surface)` makes those of each.
/// \param order see `Surface_merger_3::complex()`; empty: that of the surfaces.
template <class Surface, class Complex_of>
auto merge_surfaces(const std::vector<Surface>& surfaces, const Feature_options& options, const Complex_of& complex_of,
                    std::vector<std::size_t> order = {})
{
  using Complex = decltype(complex_of(surfaces.front()));
  using K = typename Complex::Kernel;
  if (surfaces.empty()) throw Domain_error("there are no surfaces", {}, {});
  if (surfaces.size() == 1) return complex_of(surfaces.front());
  std::vector<Complex> complexes;
  std::vector<std::string> changes, names;
  bool is_named = false;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::string name = "surface " + std::to_string(s) + ": ";
    try {
      complexes.push_back(complex_of(surfaces[s]));
    } catch (const Domain_error& error) {
      throw Domain_error(name + error.what(), error.vertices(), error.elements());
    }
    const Complex& complex = complexes.back();
    for (const std::string& change : complex.changes) changes.push_back(name + change);
    is_named = is_named || !complex.names.empty();
    std::vector<std::string> of_surface = complex.names;
    of_surface.resize(static_cast<std::size_t>(number_of_subdomains(complex)));
    names.insert(names.end(), of_surface.begin(), of_surface.end());
  }
  while (order.size() < complexes.size()) order.push_back(order.size());
  auto complex = Surface_merger_3<K>(complexes).complex(options, std::move(order));
  complex.changes = std::move(changes);
  if (is_named) {
    make_names_differ(names);
    complex.names = std::move(names);
  }
  for (const Complex& part : complexes) {
    complex.left_out.insert(complex.left_out.end(), part.left_out.begin(), part.left_out.end());
    complex.mending.add(part.mending);
  }
  return complex;
}

} // namespace internal

/// The piecewise smooth complex of several closed surfaces. Number i bounds subdomain i + 1; where one lies in another,
/// the later of the two has the common part, so that containers come first. Facets with the same three vertices, by
/// their coordinates, are interfaces. With one surface, its complex.
/// \param options sharp edges and tips can't be given here: they'd be numbered by surface.
/// \throws Domain_error if a surface doesn't qualify by itself, as for one surface, or two of them cross each other or
///         overlap in facets that aren't the same; messages count surfaces from 0.
/// O(n log n) for n facets, times the number of surfaces.
template <class K>
Piecewise_smooth_complex_3<K> piecewise_smooth_complex(const std::vector<Polygon_soup_3<K>>& surfaces,
                                                       const Feature_options& options = {})
{
  return internal::merge_surfaces(surfaces, options, [&](const Polygon_soup_3<K>& surface) {
    auto complex = piecewise_smooth_complex(surface, options);
    internal::name_by_surface(complex, surface.name);
    return complex;
  });
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_MERGE_SURFACES_3_H
