// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inputs of the spatial benchmark: surfaces made here, and surface files; all scaled to a longest side of 1.

#ifndef WEFT_BENCHMARK_SPATIAL_SPATIAL_INPUTS_H
#define WEFT_BENCHMARK_SPATIAL_SPATIAL_INPUTS_H

#include <weft/IO/read_surface.h>
#include <weft/spatial/surface/mended_complex_3.h>
#include <weft/spatial/surface/piecewise_smooth_complex.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

using Spatial_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Soup = weft::Polygon_soup_3<Spatial_kernel>;
using Complex = weft::Piecewise_smooth_complex_3<Spatial_kernel>;

/// A domain, as both meshers get it.
struct Spatial_input
{
  std::string name;
  double sharp_angle; ///< degrees between normals from which on edges are creases; 0: no creases
  Complex complex;    ///< closed, scaled

  bool is_creased() const { return !complex.creases.empty(); }
};

/// A sphere of radius 1 around the origin, of 20 * 4^levels triangles.
inline Soup unit_sphere(int levels)
{
  const double t = (1 + std::sqrt(5.)) / 2;
  std::vector<std::array<double, 3>> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                               {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                               {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<std::array<std::size_t, 3>> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  const auto on_sphere = [](const std::array<double, 3>& p) {
    const double length = std::hypot(p[0], p[1], p[2]);
    return std::array<double, 3>{p[0] / length, p[1] / length, p[2] / length};
  };
  for (auto& p : points) p = on_sphere(p);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [found, is_new] = middles.insert({std::minmax(a, b), points.size()});
      if (is_new) {
        const auto p = points[a], q = points[b];
        points.push_back(on_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
      }
      return found->second;
    };
    std::vector<std::array<std::size_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::size_t x = middle(a, b), y = middle(b, c), z = middle(c, a);
      finer.insert(finer.end(), {{a, x, z}, {b, y, x}, {c, z, y}, {x, y, z}});
    }
    triangles = std::move(finer);
  }
  Soup soup;
  for (const auto& p : points) soup.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& v : triangles) soup.polygons.push_back({v[0], v[1], v[2]});
  return soup;
}

/// A ball with a concentric cavity of half its radius.
inline Soup nested_spheres(int levels)
{
  Soup soup = unit_sphere(levels);
  const Soup inner = unit_sphere(levels);
  const std::size_t first = soup.points.size();
  for (const auto& p : inner.points) soup.points.emplace_back(p.x() / 2, p.y() / 2, p.z() / 2);
  for (const auto& t : inner.polygons) soup.polygons.push_back({first + t[0], first + t[2], first + t[1]});
  return soup;
}

/// An upright prism over a regular polygon, half as wide as high.
inline Soup cylinder(std::size_t sides)
{
  Soup soup;
  std::vector<std::size_t> bottom, top;
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.) * static_cast<double>(i) / static_cast<double>(sides);
    for (const double z : {0., 1.}) soup.points.emplace_back(std::cos(angle) / 4, std::sin(angle) / 4, z);
    top.push_back(2 * i + 1);
    bottom.push_back(2 * (sides - 1 - i));
    const std::size_t next = (i + 1) % sides;
    soup.polygons.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
  }
  soup.polygons.push_back(bottom);
  soup.polygons.push_back(top);
  return soup;
}

/// Scales a surface to a longest side of 1 and makes a domain of it. One that isn't a closed surface is mended if
/// that is possible.
/// \throws weft::Domain_error if it isn't.
inline Spatial_input make_input(const std::string& name, Soup soup, double sharp_angle)
{
  CGAL::Bbox_3 box;
  for (const auto& p : soup.points) box += p.bbox();
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  for (auto& p : soup.points)
    p = {(p.x() - box.xmin()) / longest, (p.y() - box.ymin()) / longest, (p.z() - box.zmin()) / longest};
  return {name, sharp_angle, weft::mended_complex_3(soup, weft::Feature_options(sharp_angle))};
}

inline Spatial_input read_input(const std::string& file, double sharp_angle)
{
  const std::string name = file.substr(file.find_last_of('/') + 1);
  return make_input(name.substr(0, name.find_last_of('.')), weft::IO::read_surface<Spatial_kernel>(file), sharp_angle);
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_SPATIAL_SPATIAL_INPUTS_H
