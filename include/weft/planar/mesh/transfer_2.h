// SPDX-License-Identifier: GPL-3.0-or-later
//
// Carries values at vertices from one planar mesh to another of about the same domain: interpolated, or such that the
// integral is kept. For that the triangles of both meshes are intersected, as in Farrell, Piggott, Pain, Gorman and
// Wilson, "Conservative interpolation between unstructured meshes via supermesh construction" (2009), and the mass
// matrix of the projection is lumped, so that no value leaves the range of the old ones.

#ifndef WEFT_PLANAR_MESH_TRANSFER_2_H
#define WEFT_PLANAR_MESH_TRANSFER_2_H

#include <weft/errors.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>
#include <weft/planar/mesh/Triangle_tree_2.h>
#include <weft/Transfer.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft {

namespace internal {

/// The part of a convex polygon to the left of the line from a to b.
inline std::vector<Xy_2> left_part(const std::vector<Xy_2>& polygon, const Xy_2& a, const Xy_2& b)
{
  std::vector<Xy_2> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Xy_2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = doubled_area(a, b, p), hq = doubled_area(a, b, q);
    if (hp >= 0) part.push_back(p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
      const double s = hp / (hp - hq);
      part.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
  }
  return part;
}

/// Integrals over the overlap of new triangles and old ones, by new vertices.
struct Overlaps_2
{
  std::vector<double> sum, covered; ///< of the old function and of 1, times each hat

  /// \param v vertices of the new triangle t.
  /// \param values of the old function at the corners of the old triangle s.
  void add(const Corners_2& t, const std::array<std::size_t, 3>& v, const Corners_2& s,
           const std::array<double, 3>& values)
  {
    if (!(doubled_area(s[0], s[1], s[2]) > 0)) return;
    std::vector<Xy_2> part(t.begin(), t.end());
    for (std::size_t i = 0; i < 3 && part.size() > 2; ++i) part = left_part(part, s[i], s[(i + 1) % 3]);
    for (std::size_t k = 2; k < part.size(); ++k) {
      const Corners_2 piece{part[0], part[k - 1], part[k]};
      const double area = std::abs(doubled_area(piece[0], piece[1], piece[2])) / 2;
      std::array<std::array<double, 3>, 3> hat;
      std::array<double, 3> u{};
      for (std::size_t j = 0; j < 3; ++j) {
        hat[j] = barycentric_2(t, piece[j]);
        const auto w = barycentric_2(s, piece[j]);
        for (std::size_t i = 0; i < 3; ++i) u[j] += w[i] * values[i];
      }
      for (std::size_t i = 0; i < 3; ++i) {
        double sum_of_hat = 0, both = 0;
        for (std::size_t j = 0; j < 3; ++j) sum_of_hat += hat[j][i], both += hat[j][i] * u[j];
        covered[v[i]] += area / 3 * sum_of_hat;
        sum[v[i]] += area / 12 * (sum_of_hat * (u[0] + u[1] + u[2]) + both);
      }
    }
  }
};

} // namespace internal

/// Carries a function that is linear on the triangles of a mesh over to the vertices of another one.
/// \param values at the vertices of `from`.
/// \param how with Transfer::conserving, the integral of the result over `to` is that of the function over `from` but
///   for rounding, where both cover the same domain; of a part that only `to` covers, the values are those at the
///   nearest points of `from`.
/// \returns a value for each vertex of `to`, none outside of the range of the old ones but for rounding.
/// \throws Option_error unless there is a value for each vertex; Domain_error if a mesh has no triangles. O(n log n).
template <class K>
std::vector<double> transfer_2(const Triangle_mesh_2<K>& from, const std::vector<double>& values,
                               const Triangle_mesh_2<K>& to, Transfer how = Transfer::interpolated)
{
  if (values.size() != from.points.size()) throw Option_error("transfer_2: one value per vertex is needed");
  if (from.triangles.empty() || to.triangles.empty()) throw Domain_error("transfer_2: a mesh has no triangles", {}, {});
  const internal::Triangle_tree_2 tree(from);
  std::vector<double> result;
  result.reserve(to.points.size());
  for (const auto& p : to.points) {
    const auto [t, weights] = tree.nearest(internal::xy(p));
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * values[from.triangles[t][i]];
    result.push_back(sum);
  }
  if (how == Transfer::interpolated) return result;
  const std::size_t n = to.points.size();
  internal::Overlaps_2 overlaps{std::vector<double>(n, 0), std::vector<double>(n, 0)};
  std::vector<double> mass(n, 0);
  for (const auto& v : to.triangles) {
    const internal::Corners_2 t{internal::xy(to.points[v[0]]), internal::xy(to.points[v[1]]),
                                internal::xy(to.points[v[2]])};
    const double area = internal::doubled_area(t[0], t[1], t[2]) / 2;
    if (!(area > 0)) continue;
    for (const std::size_t w : v) mass[w] += area / 3;
    for (const std::size_t old : tree.near(t)) {
      const auto& o = from.triangles[old];
      overlaps.add(t, v, tree.triangle(old), {values[o[0]], values[o[1]], values[o[2]]});
    }
  }
  for (std::size_t w = 0; w < n; ++w) {
    double &sum = overlaps.sum[w], &covered = overlaps.covered[w];
    // What rounding leaves uncovered is no part of its own.
    if (const double left = mass[w] - covered; left > 1e-9 * mass[w]) sum += left * result[w], covered += left;
    if (covered > 0) result[w] = sum / covered;
  }
  return result;
}

} // namespace weft

#endif // WEFT_PLANAR_MESH_TRANSFER_2_H
