// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ODT energy in both dimensions (Chen 2004; Tournois 2009, sec. 3.2.1.5): the volume between the paraboloid
// |x|^2 and its piecewise linear interpolation over the mesh. Over a simplex T that is |T| times the sum of the squared
// lengths of its edges over (d + 1) (d + 2). In the metric of sizes at the vertices, volumes and lengths are those that
// Smoothing_context_3 measures; sizes belong to vertices and move with them.

#ifndef WEFT_ENERGY_ODT_TERMS_H
#define WEFT_ENERGY_ODT_TERMS_H

#include <weft/energy/coordinates.h>
#include <weft/energy/Simplices.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Measure of a simplex, and its gradient by each vertex, which doesn't depend on that vertex.
template <std::size_t d>
struct Simplex_measure
{
  double value;
  std::array<Coordinates<d>, d + 1> gradient;
};

inline Simplex_measure<2> measure_simplex(const std::array<Coordinates<2>, 3>& p)
{
  Simplex_measure<2> m;
  m.value = cross(difference(p[1], p[0]), difference(p[2], p[0])) / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
    m.gradient[i] = {(a[1] - b[1]) / 2, (b[0] - a[0]) / 2};
  }
  return m;
}

inline Simplex_measure<3> measure_simplex(const std::array<Coordinates<3>, 4>& p)
{
  const auto u = difference(p[1], p[0]), v = difference(p[2], p[0]), w = difference(p[3], p[0]);
  Simplex_measure<3> m;
  m.gradient = {Coordinates<3>{0, 0, 0}, cross(v, w), cross(w, u), cross(u, v)};
  m.value = dot(u, m.gradient[1]) / 6;
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      m.gradient[i][k] /= 6;
      m.gradient[0][k] -= m.gradient[i][k];
    }
  return m;
}

/// Factors of measures and of squared lengths in the metric of the sizes, one for each pair of vertices.
template <std::size_t d>
struct Metric_factors
{
  double measure = 1;
  std::array<std::array<double, d + 1>, d + 1> squared_length; ///< that of a vertex with itself isn't set
};

template <std::size_t d>
Metric_factors<d> metric_factors(const Simplices<d>& mesh, const typename Simplices<d>::Simplex& s)
{
  Metric_factors<d> result;
  if (mesh.sizes.empty()) {
    for (auto& row : result.squared_length) row.fill(1);
    return result;
  }
  // Exact for size^-power of the second degree: weights of the vertices and the centroid.
  const auto power = [](double x, std::size_t n) { return n == 1 ? x : n == 2 ? x * x : x * x * x; };
  double at_vertices = 0, mean = 0;
  for (const auto v : s) {
    at_vertices += power(1 / mesh.sizes[v], d);
    mean += mesh.sizes[v] / (d + 1);
  }
  result.measure = at_vertices / ((d + 1.0) * (d + 2)) + power(1 / mean, d) * (d + 1.0) / (d + 2);
  for (std::size_t i = 0; i <= d; ++i)
    for (std::size_t j = i + 1; j <= d; ++j) {
      const double a = mesh.sizes[s[i]], b = mesh.sizes[s[j]], scale = (1 / a + 1 / b) / 6 + 4.0 / 3 / (a + b);
      result.squared_length[i][j] = result.squared_length[j][i] = scale * scale;
    }
  return result;
}

/// Area or volume of a mesh.
/// \param in_metric whether in that of the sizes.
template <std::size_t d>
Energy_terms<d> volume_terms(const Simplices<d>& mesh, bool in_metric)
{
  Energy_terms<d> result;
  result.gradient.assign(mesh.points.size(), Coordinates<d>{});
  for (const auto& s : mesh.simplices) {
    std::array<Coordinates<d>, d + 1> p;
    for (std::size_t i = 0; i <= d; ++i) p[i] = mesh.points[s[i]];
    const auto measure = measure_simplex(p);
    const double factor = in_metric ? metric_factors(mesh, s).measure : 1;
    result.value += factor * measure.value;
    for (std::size_t i = 0; i <= d; ++i) add_to(result.gradient[s[i]], factor, measure.gradient[i]);
  }
  return result;
}

/// Divides an energy by the volume V of the mesh, and where sizes vary further by a power of its mean volume in their
/// metric: E V^p / M^(1 + p) with p = degree / d. That is the same for a mesh with a few flat cells more or less on a
/// curved boundary, for one that shrinks, and for one whose vertices of large sizes crowd out the others.
/// \param degree power of lengths in what is integrated over the domain.
/// \returns the factor of the energy.
template <std::size_t d>
double normalise(const Simplices<d>& mesh, Energy_terms<d>& terms, double degree = 2)
{
  const double power = degree / d;
  const auto volume = volume_terms(mesh, false), mass = mesh.sizes.empty() ? volume : volume_terms(mesh, true);
  const double factor = std::pow(volume.value, power) / std::pow(mass.value, 1 + power);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    add_to(terms.gradient[i], terms.value * power / volume.value, volume.gradient[i]);
    add_to(terms.gradient[i], -terms.value * (1 + power) / mass.value, mass.gradient[i]);
    for (double& x : terms.gradient[i]) x *= factor;
    terms.diagonal[i] *= factor;
  }
  for (auto& w : terms.weights) w.value *= factor;
  terms.value *= factor;
  return factor;
}

/// What the ODT energy of a simplex and its derivatives are made of.
template <std::size_t d>
struct Odt_simplex
{
  Odt_simplex(const Simplices<d>& mesh, const typename Simplices<d>::Simplex& s) : metric(metric_factors(mesh, s))
  {
    for (std::size_t i = 0; i <= d; ++i) points[i] = mesh.points[s[i]];
    measure = measure_simplex(points);
    scale = metric.measure / ((d + 1.0) * (d + 2));
    double stiffness = 0;
    for (std::size_t i = 0; i <= d; ++i)
      for (std::size_t j = i + 1; j <= d; ++j) {
        const auto edge = difference(points[i], points[j]);
        const double factor = metric.squared_length[i][j];
        sum += factor * dot(edge, edge);
        stiffness += factor;
        add_to(slope[i], 2 * factor, edge);
        add_to(slope[j], -2 * factor, edge);
      }
    curvature = 2 * (d + 2.0) * scale * stiffness / (d * (d + 1.0) / 2);
  }

  Metric_factors<d> metric;
  std::array<Coordinates<d>, d + 1> points, slope{}; ///< slope: gradients of the sum
  Simplex_measure<d> measure;
  double sum = 0;   ///< of the squared lengths of the edges
  double scale;     ///< the energy is that times the measure times the sum
  double curvature; ///< what of the second derivative by one vertex is left around a whole star, over the measure
};

/// The ODT energy and its gradient, that of boundary vertices included: the domain of the mesh changes with them.
/// Linear.
template <std::size_t d>
Energy_terms<d> odt_terms(const Simplices<d>& mesh, bool with_weights = false)
{
  Energy_terms<d> result;
  result.gradient.assign(mesh.points.size(), Coordinates<d>{});
  result.diagonal.assign(mesh.points.size(), 0);
  if (with_weights) result.weights.reserve(mesh.simplices.size() * d * (d + 1) / 2);
  for (const auto& s : mesh.simplices) {
    const Odt_simplex<d> t(mesh, s);
    const double mass = t.scale * t.measure.value, curvature = t.curvature * t.measure.value;
    result.value += mass * t.sum;
    for (std::size_t i = 0; i <= d; ++i) {
      add_to(result.gradient[s[i]], mass, t.slope[i]);
      add_to(result.gradient[s[i]], t.scale * t.sum, t.measure.gradient[i]);
      result.diagonal[s[i]] += curvature; // that sums up to 2 |star| / (d + 1)
      for (std::size_t j = i + 1; with_weights && j <= d; ++j) result.weights.push_back({s[i], s[j], curvature / d});
    }
  }
  return result;
}

} // namespace weft::internal

#endif // WEFT_ENERGY_ODT_TERMS_H
