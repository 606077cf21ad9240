// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sharp edges of a surface by angle, the feature vertices that follow from them, and the creases they chain up to
// (Tournois 2009, sec. 3.2.1.1).

#ifndef WEFT_SPATIAL_SURFACE_CREASE_CHAINS_3_H
#define WEFT_SPATIAL_SURFACE_CREASE_CHAINS_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/surface/Piecewise_smooth_complex_3.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Angle between two directions in degrees; precise for small and large angles.
inline double angle_between(const Xyz_3& a, const Xyz_3& b)
{
  constexpr double degrees = 57.295779513082320877;
  return std::atan2(norm(cross_product(a, b)), dot_product(a, b)) * degrees;
}

/// Direction from one point to another, scaled to 1 in its largest coordinate so that no product leaves the range.
template <class Point>
Xyz_3 direction(const Point& from, const Point& to)
{
  Xyz_3 d = minus(xyz(to), xyz(from));
  const double largest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  if (largest > 0)
    for (double& x : d) x /= largest;
  return d;
}

/// Normal of a triangle in exact arithmetic, scaled to 1 in its largest coordinate before it is rounded.
template <class Point>
Xyz_3 exact_facet_normal(const Point& a, const Point& b, const Point& c)
{
  using Number = CGAL::Exact_rational;
  const auto exact = [](const Point& p) {
    return std::array<Number, 3>{Number(CGAL::to_double(p.x())), Number(CGAL::to_double(p.y())),
                                 Number(CGAL::to_double(p.z()))};
  };
  const auto p = exact(a), q = exact(b), r = exact(c);
  std::array<Number, 3> n;
  Number largest(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
    largest = (std::max)(largest, Number(CGAL::abs(n[i])));
  }
  if (largest == 0) return {{0, 0, 0}}; // collinear once the coordinates are rounded to doubles
  return {{CGAL::to_double(Number(n[0] / largest)), CGAL::to_double(Number(n[1] / largest)),
           CGAL::to_double(Number(n[2] / largest))}};
}

/// Unit normal of a triangle. Needles lose digits: beyond an aspect of 1e6 exact arithmetic takes over.
template <class Point>
Xyz_3 unit_facet_normal(const Point& a, const Point& b, const Point& c)
{
  const Xyz_3 u = direction(a, b), v = direction(a, c);
  Xyz_3 n = cross_product(u, v);
  if (!(norm(n) > 1e-6 * norm(u) * norm(v))) n = exact_facet_normal(a, b, c); // also where a coordinate overflowed
  const double size = norm(n);
  if (!(size > 0)) return n;
  return {{n[0] / size, n[1] / size, n[2] / size}};
}

/// Angles that round just below a bound count as reaching it, so that a cube has sharp edges at 90 degrees.
constexpr double angle_tolerance = 1e-9;

/// The graph of sharp edges: the other ends of the sharp edges at every vertex, ascending.
class Sharp_graph_3
{
public:
  /// \param edges without duplicates.
  Sharp_graph_3(std::size_t number_of_points, const std::vector<std::array<std::size_t, 2>>& edges)
      : begin_(number_of_points + 1, 0), ends_(2 * edges.size())
  {
    for (const auto& [a, b] : edges) {
      ++begin_[a + 1];
      ++begin_[b + 1];
    }
    for (std::size_t v = 0; v < number_of_points; ++v) begin_[v + 1] += begin_[v];
    std::vector<std::size_t> position(begin_.begin(), begin_.end() - 1);
    for (const auto& [a, b] : edges) {
      ends_[position[a]++] = b;
      ends_[position[b]++] = a;
    }
    for (std::size_t v = 0; v < number_of_points; ++v)
      std::sort(ends_.begin() + offset(v), ends_.begin() + offset(v + 1));
  }

  std::size_t number_of_vertices() const { return begin_.size() - 1; }
  std::size_t degree(std::size_t v) const { return begin_[v + 1] - begin_[v]; }
  std::size_t end(std::size_t v, std::size_t i) const { return ends_[begin_[v] + i]; }
  /// The end of the other edge at a vertex with two.
  std::size_t other_end(std::size_t v, std::size_t known) const { return end(v, 0) == known ? end(v, 1) : end(v, 0); }

private:
  std::ptrdiff_t offset(std::size_t v) const { return static_cast<std::ptrdiff_t>(begin_[v]); }

  std::vector<std::size_t> begin_, ends_;
};

/// Feature vertices, ascending. A vertex with two sharp edges is a cusp if it is given or if the crease turns there by
/// more than `cusp_angle` degrees (0 or 180: never).
/// \param given whether a vertex is given as tip or cusp.
template <class K>
std::vector<typename Piecewise_smooth_complex_3<K>::Feature>
feature_vertices(const Sharp_graph_3& graph, const std::vector<typename K::Point_3>& points,
                 const std::vector<bool>& given, double cusp_angle)
{
  std::vector<typename Piecewise_smooth_complex_3<K>::Feature> features;
  const bool by_angle = cusp_angle > 0 && cusp_angle < 180;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const std::size_t degree = graph.degree(v);
    if (degree > 2) features.push_back({v, Feature_kind::corner});
    if (degree == 1) features.push_back({v, Feature_kind::dart});
    if (degree == 0 && given[v]) features.push_back({v, Feature_kind::tip});
    if (degree != 2) continue;
    const auto turn = [&] {
      return angle_between(direction(points[graph.end(v, 0)], points[v]),
                           direction(points[v], points[graph.end(v, 1)]));
    };
    if (given[v] || (by_angle && turn() > cusp_angle + angle_tolerance)) features.push_back({v, Feature_kind::cusp});
  }
  return features;
}

/// The vertices from `v` along its sharp edge to `w` and on, up to a feature vertex or back to `v`, both included.
inline std::vector<std::size_t> follow_crease(const Sharp_graph_3& graph, const std::vector<bool>& is_feature,
                                              std::size_t v, std::size_t w)
{
  std::vector<std::size_t> chain = {v, w};
  while (!is_feature[chain.back()] && chain.back() != v)
    chain.push_back(graph.other_end(chain.back(), chain[chain.size() - 2]));
  return chain;
}

/// Chains the sharp edges. Every crease starts at its end with the smaller index and runs, if it comes back, first to
/// the smaller neighbour; cycles start at their smallest vertex. Creases are ordered by their first two vertices.
template <class K>
std::vector<typename Piecewise_smooth_complex_3<K>::Crease>
chain_creases(const Sharp_graph_3& graph, const std::vector<typename Piecewise_smooth_complex_3<K>::Feature>& features)
{
  using Crease = typename Piecewise_smooth_complex_3<K>::Crease;
  std::vector<bool> is_feature(graph.number_of_vertices(), false), seen(graph.number_of_vertices(), false);
  for (const auto& feature : features) is_feature[feature.vertex] = true;
  std::vector<Crease> creases;
  for (const auto& feature : features)
    for (std::size_t i = 0; i < graph.degree(feature.vertex); ++i) {
      auto chain = follow_crease(graph, is_feature, feature.vertex, graph.end(feature.vertex, i));
      for (const std::size_t v : chain) seen[v] = true;
      // Each is followed from both ends and kept from the smaller.
      if (std::make_pair(chain.front(), chain[1]) < std::make_pair(chain.back(), chain[chain.size() - 2]))
        creases.push_back({std::move(chain), false, false});
    }
  for (std::size_t v = 0; v < graph.number_of_vertices(); ++v) {
    if (seen[v] || graph.degree(v) == 0) continue;
    auto chain = follow_crease(graph, is_feature, v, graph.end(v, 0));
    chain.pop_back();
    for (const std::size_t w : chain) seen[w] = true;
    creases.push_back({std::move(chain), true, false});
  }
  std::sort(creases.begin(), creases.end(), [](const Crease& a, const Crease& b) {
    return std::make_pair(a.vertices[0], a.vertices[1]) < std::make_pair(b.vertices[0], b.vertices[1]);
  });
  return creases;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_CREASE_CHAINS_3_H
