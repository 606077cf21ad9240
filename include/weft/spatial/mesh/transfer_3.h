// SPDX-License-Identifier: GPL-3.0-or-later
//
// Carries values at vertices from one tetrahedral mesh to another of about the same domain: interpolated, or such that
// the integral is kept. For that the cells of both meshes are intersected, as in Farrell, Piggott, Pain, Gorman and
// Wilson, "Conservative interpolation between unstructured meshes via supermesh construction" (2009), and the mass
// matrix of the projection is lumped, so that no value leaves the range of the old ones.

#ifndef WEFT_SPATIAL_MESH_TRANSFER_3_H
#define WEFT_SPATIAL_MESH_TRANSFER_3_H

#include <weft/errors.h>
#include <weft/internal/boxes/Box_hierarchy_3.h>
#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/mesh/Cell_locator_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>
#include <weft/Transfer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

namespace internal {

inline double signed_volume(const std::array<Xyz_3, 4>& t)
{
  return dot_product(minus(t[1], t[0]), cross_product(minus(t[2], t[0]), minus(t[3], t[0]))) / 6;
}

/// Appends the part of a tetrahedron where a linear function, given at its corners, is positive, cut into tetrahedra.
inline void clip_tetrahedron(const std::array<Xyz_3, 4>& t, const std::array<double, 4>& height,
                             std::vector<std::array<Xyz_3, 4>>& parts)
{
  std::array<std::size_t, 4> in{}, out{};
  std::size_t n = 0, m = 0;
  for (std::size_t i = 0; i < 4; ++i) (height[i] > 0 ? in[n++] : out[m++]) = i;
  const auto cut = [&](std::size_t a, std::size_t b) {
    const double s = height[a] / (height[a] - height[b]);
    Xyz_3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = t[a][k] + s * (t[b][k] - t[a][k]);
    return p;
  };
  const auto add_prism = [&](const std::array<Xyz_3, 3>& a, const std::array<Xyz_3, 3>& b) {
    parts.push_back({a[0], a[1], a[2], b[2]});
    parts.push_back({a[0], a[1], b[1], b[2]});
    parts.push_back({a[0], b[0], b[1], b[2]});
  };
  if (n == 4) {
    parts.push_back(t);
  } else if (n == 1) {
    parts.push_back({t[in[0]], cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2])});
  } else if (n == 3) {
    add_prism({t[in[0]], t[in[1]], t[in[2]]}, {cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0])});
  } else if (n == 2) {
    add_prism({t[in[0]], cut(in[0], out[0]), cut(in[0], out[1])}, {t[in[1]], cut(in[1], out[0]), cut(in[1], out[1])});
  }
}

/// Barycentric coordinates on a tetrahedron, extended to space.
class Barycentric_3
{
public:
  explicit Barycentric_3(const std::array<Xyz_3, 4>& t) : origin_(t[0])
  {
    const Xyz_3 a = minus(t[1], t[0]), b = minus(t[2], t[0]), c = minus(t[3], t[0]);
    const double volume = dot_product(a, cross_product(b, c));
    gradients_ = {cross_product(b, c), cross_product(c, a), cross_product(a, b)};
    for (Xyz_3& g : gradients_)
      for (double& x : g) x /= volume;
  }

  double operator()(std::size_t i, const Xyz_3& p) const
  {
    const Xyz_3 d = minus(p, origin_);
    if (i > 0) return dot_product(gradients_[i - 1], d);
    return 1 - dot_product(gradients_[0], d) - dot_product(gradients_[1], d) - dot_product(gradients_[2], d);
  }

private:
  Xyz_3 origin_;
  std::array<Xyz_3, 3> gradients_;
};

/// Carries values over so that their integral stays.
template <class K>
class Conserving_transfer_3
{
public:
  Conserving_transfer_3(const Tetrahedral_mesh_3<K>& from, const std::vector<double>& values)
      : from_(from), values_(values)
  {
    std::vector<Box_3> boxes(from.cells.size());
    for (std::size_t c = 0; c < boxes.size(); ++c)
      for (const Xyz_3& p : corners(from, c)) boxes[c].add(p[0], p[1], p[2]);
    boxes_ = Box_hierarchy_3(boxes);
  }

  /// \param otherwise values for what no cell of the old mesh covers.
  std::vector<double> operator()(const Tetrahedral_mesh_3<K>& to, const std::vector<double>& otherwise) const
  {
    std::vector<double> sum(to.points.size(), 0), covered(to.points.size(), 0), mass(to.points.size(), 0);
    for (std::size_t c = 0; c < to.cells.size(); ++c) {
      const auto t = corners(to, c);
      const double volume = signed_volume(t);
      if (!(volume > 0)) continue;
      const auto& v = to.cells[c];
      for (const std::size_t w : v) mass[w] += volume / 4;
      const Barycentric_3 hat(t);
      visit_near(t, [&](std::size_t old) { add_overlap(t, hat, v, old, sum, covered); });
    }
    for (std::size_t w = 0; w < sum.size(); ++w) {
      const double left = mass[w] - covered[w];
      // What rounding leaves uncovered is no part of its own.
      if (left > 1e-9 * mass[w]) sum[w] += left * otherwise[w], covered[w] += left;
      sum[w] = covered[w] > 0 ? sum[w] / covered[w] : otherwise[w];
    }
    return sum;
  }

private:
  static std::array<Xyz_3, 4> corners(const Tetrahedral_mesh_3<K>& mesh, std::size_t c)
  {
    const auto& v = mesh.cells[c];
    return {xyz(mesh.points[v[0]]), xyz(mesh.points[v[1]]), xyz(mesh.points[v[2]]), xyz(mesh.points[v[3]])};
  }

  template <class Visit>
  void visit_near(const std::array<Xyz_3, 4>& t, const Visit& visit) const
  {
    std::array<float, 3> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax({t[0][k], t[1][k], t[2][k], t[3][k]});
      const double center = boxes_.frame().center[k], scale = boxes_.frame().scale;
      low[k] = static_cast<float>((least - center) * scale), high[k] = static_cast<float>((most - center) * scale);
    }
    std::vector<std::uint32_t> near;
    boxes_.visit_slab(low, high, {{0, 0, 0}}, 0, 1, [&](std::uint32_t block) {
      for (std::size_t i = 0; i < 4; ++i)
        if (boxes_.items()[4 * block + i] != Box_hierarchy_3::nothing) near.push_back(boxes_.items()[4 * block + i]);
      return false;
    });
    std::sort(near.begin(), near.end()); // sums don't depend on the hierarchy
    for (const std::uint32_t c : near) visit(c);
  }

  /// Adds the integrals over the overlap of a new cell and an old one: of the old function and of 1, times each hat.
  void add_overlap(const std::array<Xyz_3, 4>& t, const Barycentric_3& hat, const std::array<std::size_t, 4>& v,
                   std::size_t old, std::vector<double>& sum, std::vector<double>& covered) const
  {
    const auto s = corners(from_, old);
    if (!(signed_volume(s) > 0)) return;
    const Barycentric_3 side(s);
    std::vector<std::array<Xyz_3, 4>> parts{t}, rest;
    for (std::size_t i = 0; i < 4 && !parts.empty(); ++i, parts.swap(rest)) {
      rest.clear();
      for (const auto& part : parts)
        clip_tetrahedron(part, {side(i, part[0]), side(i, part[1]), side(i, part[2]), side(i, part[3])}, rest);
    }
    for (const auto& part : parts) {
      const double volume = std::abs(signed_volume(part));
      std::array<double, 4> u{};
      double sum_of_u = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) u[j] += side(i, part[j]) * values_[from_.cells[old][i]];
        sum_of_u += u[j];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        double sum_of_hat = 0, both = 0;
        for (std::size_t j = 0; j < 4; ++j) {
          const double h = hat(i, part[j]);
          sum_of_hat += h, both += h * u[j];
        }
        covered[v[i]] += volume / 4 * sum_of_hat;
        sum[v[i]] += volume / 20 * (sum_of_hat * sum_of_u + both);
      }
    }
  }

  const Tetrahedral_mesh_3<K>& from_;
  const std::vector<double>& values_;
  Box_hierarchy_3 boxes_;
};

} // namespace internal

/// Carries a function that is linear on the cells of a mesh over to the vertices of another one.
/// \param values at the vertices of `from`.
/// \param how with Transfer::conserving, the integral of the result over `to` is that of the function over `from` but
///   for rounding, where both cover the same domain; of a part that only `to` covers, the values are those at the
///   nearest points of `from`.
/// \returns a value for each vertex of `to`, none outside of the range of the old ones.
/// \throws Option_error unless there is a value for each vertex; Domain_error if a mesh has no cells. O(n log n).
template <class K>
std::vector<double> transfer_3(const Tetrahedral_mesh_3<K>& from, const std::vector<double>& values,
                               const Tetrahedral_mesh_3<K>& to, Transfer how = Transfer::interpolated)
{
  if (values.size() != from.points.size()) throw Option_error("transfer_3: one value per vertex is needed");
  if (from.cells.empty() || to.cells.empty()) throw Domain_error("transfer_3: a mesh has no cells", {}, {});
  const internal::Cell_locator_3<K> cells(from.points, from.cells);
  std::vector<double> result;
  result.reserve(to.points.size());
  for (const auto& p : to.points) result.push_back(cells.locate(p).value(values));
  return how == Transfer::interpolated ? result : internal::Conserving_transfer_3<K>(from, values)(to, result);
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_TRANSFER_3_H
