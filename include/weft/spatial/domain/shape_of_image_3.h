// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shape of the subdomains of an image, as interpolated: volumes and areas by samples between voxel centers;
// components and Euler characteristics by the voxels' vertices, edges, faces and cubes, where that is the same
// (Latecki, Eckhardt and Rosenfeld, "Well-composed sets", 1995).

#ifndef WEFT_SPATIAL_DOMAIN_SHAPE_OF_IMAGE_3_H
#define WEFT_SPATIAL_DOMAIN_SHAPE_OF_IMAGE_3_H

#include <weft/spatial/domain/Domain_shape_3.h>
#include <weft/spatial/domain/Voxel_components_3.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Volumes and areas in the cells between eight voxel centers, which at the border reach half a spacing beyond them.
class Cell_shapes_3
{
public:
  explicit Cell_shapes_3(const Voxel_image_3& image) : image_(image) {}

  /// Adds a cell's share.
  /// \param cell its last voxel.
  /// \param labels of its voxels, x running fastest.
  void add(const Voxel_image_3::Voxel& cell, const std::array<int, 8>& labels, Domain_shape_3& shape)
  {
    std::array<double, 3> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto last = static_cast<double>(image_.size()[k]) - 1;
      low[k] = image_.coordinate(k, (std::max)(-0.5, static_cast<double>(cell[k]) - 1));
      high[k] = image_.coordinate(k, (std::min)(last + 0.5, static_cast<double>(cell[k])));
      // Beyond the outermost centers nothing changes.
      if (cell[k] == 0) high[k] = image_.coordinate(k, 0);
      if (cell[k] == static_cast<std::ptrdiff_t>(image_.size()[k])) low[k] = image_.coordinate(k, last);
    }
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    if (std::all_of(labels.begin(), labels.end(), [&](int label) { return label == labels[0]; })) {
      if (labels[0] != 0) shape[labels[0]].volume += x * y * z;
      return;
    }
    const auto share_it = [&](const Shares& shares) {
      for (std::size_t i = 0; i < 8; ++i) {
        if (shares[i][0] == 0 || labels[i] == 0) continue;
        shape[labels[i]].volume += shares[i][0] * x * y * z;
        shape[labels[i]].area += std::hypot(shares[i][1] * y * z, shares[i][2] * x * z, shares[i][3] * x * y);
      }
    };
    if (!image_.follows_labels()) return share_it(sampled(labels, low, high, 4));
    std::array<std::size_t, 8> pattern; // for each corner the first one with its label
    for (std::size_t i = 0; i < 8; ++i)
      pattern[i] = static_cast<std::size_t>(std::find(labels.begin(), labels.end(), labels[i]) - labels.begin());
    auto known = shares_.find(pattern);
    if (known == shares_.end()) known = shares_.emplace(pattern, sampled(labels, low, high, 24)).first;
    share_it(known->second);
  }

private:
  /// By corner, for the label of which it is the first: the part of the cell, and the parts of its sides that the
  /// boundary covers, seen along x, y and z.
  using Shares = std::array<std::array<double, 4>, 8>;

  Shares sampled(const std::array<int, 8>& labels, const std::array<double, 3>& low, const std::array<double, 3>& high,
                 std::size_t n) const
  {
    std::vector<std::size_t> classes(n * n * n);
    Shares shares{};
    const auto at = [&](std::size_t k, std::size_t i) {
      return low[k] + (static_cast<double>(i) + 0.5) / static_cast<double>(n) * (high[k] - low[k]);
    };
    // What changes between the samples of this cell and the next isn't counted; of labels nothing changes there.
    const double unseen = image_.follows_labels() ? 1 : static_cast<double>(n) / static_cast<double>(n - 1);
    const double part = 1 / static_cast<double>(n * n * n), side = unseen / static_cast<double>(n * n);
    for (std::size_t z = 0, i = 0; z < n; ++z)
      for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x, ++i) {
          const int label = image_.label_at({{at(0, x), at(1, y), at(2, z)}});
          classes[i] =
              (std::min)(static_cast<std::size_t>(7),
                         static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin()));
          shares[classes[i]][0] += part;
          const auto compare = [&](bool has_one, std::size_t before, std::size_t axis) {
            if (!has_one || classes[before] == classes[i]) return;
            shares[classes[i]][axis] += side;
            shares[classes[before]][axis] += side;
          };
          compare(x > 0, i - 1, 1);
          compare(y > 0, i - n, 2);
          compare(z > 0, i - n * n, 3);
        }
    return shares;
  }

  const Voxel_image_3& image_;
  std::map<std::array<std::size_t, 8>, Shares> shares_;
};

/// Counts of the cubical complexes of labels, and where it isn't certain that they tell the topology.
class Label_topology_3
{
public:
  /// \param labels of the voxels around a lattice point, x running fastest; -1 beyond the image.
  void add(const std::array<int, 8>& labels)
  {
    for (std::size_t i = 0; i < 8; ++i) {
      const int label = labels[i];
      if (label <= 0 || std::find(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(i), label) !=
                            labels.begin() + static_cast<std::ptrdiff_t>(i))
        continue;
      unsigned mask = 0;
      for (std::size_t j = 0; j < 8; ++j) mask |= unsigned(labels[j] == label) << j;
      // The vertex, the edges and faces that start here towards higher coordinates, and the voxel between them.
      constexpr unsigned edges[] = {0xaa, 0xcc, 0xf0}, faces[] = {0x88, 0xa0, 0xc0};
      long& euler = euler_[label];
      ++euler;
      for (const unsigned edge : edges) euler -= (mask & edge) != 0;
      for (const unsigned face : faces) euler += (mask & face) != 0;
      euler -= (mask & 0x80) != 0;
      if (is_critical(mask)) critical_[label] = true;
    }
  }

  /// Euler characteristic of the boundary of a label.
  long euler(int label) const
  {
    const auto found = euler_.find(label);
    return found == euler_.end() ? 0 : 2 * found->second;
  }
  /// Whether voxels of a label, or the others, meet at an edge or a corner alone somewhere.
  bool is_critical(int label) const { return critical_.count(label) != 0; }

private:
  static bool is_critical(unsigned mask)
  {
    constexpr unsigned diagonals[] = {0x81, 0x42, 0x24, 0x18};
    for (const unsigned d : diagonals)
      if (mask == d || mask == (0xff ^ d)) return true;
    constexpr unsigned sides[] = {0x0f, 0xf0, 0x33, 0xcc, 0x55, 0xaa};
    // Both diagonals of each side.
    constexpr unsigned first[] = {0x09, 0x90, 0x21, 0x84, 0x41, 0x82}, second[] = {0x06, 0x60, 0x12, 0x48, 0x14, 0x28};
    for (std::size_t k = 0; k < 6; ++k)
      if ((mask & sides[k]) == first[k] || (mask & sides[k]) == second[k]) return true;
    return false;
  }

  std::map<int, long> euler_;
  std::map<int, bool> critical_;
};

} // namespace internal

/// The shape of an image's subdomains as interpolated and cut off at the image's border. Volumes are exact to some
/// thousandths of what lies in cells of several labels; areas are estimates from below. Components and Euler
/// characteristics are known where no voxels of a label, and no others, meet at an edge or a corner alone; elsewhere
/// components are -1. O(voxels).
inline Domain_shape_3 shape_of_image(const Voxel_image_3& image, const Voxel_components_3& components)
{
  using Voxel = Voxel_image_3::Voxel;
  Domain_shape_3 shape;
  internal::Cell_shapes_3 cells(image);
  internal::Label_topology_3 topology;
  std::array<std::ptrdiff_t, 3> n;
  for (std::size_t k = 0; k < 3; ++k) n[k] = static_cast<std::ptrdiff_t>(image.size()[k]);
  Voxel at;
  for (at[2] = 0; at[2] <= n[2]; ++at[2])
    for (at[1] = 0; at[1] <= n[1]; ++at[1])
      for (at[0] = 0; at[0] <= n[0]; ++at[0]) {
        std::array<int, 8> around, nearest;
        bool all_same = true;
        for (std::size_t i = 0; i < 8; ++i) {
          Voxel v, inside;
          for (std::size_t k = 0; k < 3; ++k) {
            v[k] = at[k] - 1 + static_cast<std::ptrdiff_t>(i >> k & 1);
            inside[k] = (std::max)(std::ptrdiff_t(0), (std::min)(v[k], n[k] - 1));
          }
          nearest[i] = image.label(inside);
          around[i] = v == inside ? nearest[i] : -1;
          all_same = all_same && around[i] == around[0];
        }
        cells.add(at, nearest, shape);
        if (!all_same) topology.add(around);
      }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double area = image.voxel_volume() / image.spacing()[axis];
    for (const std::ptrdiff_t layer : {std::ptrdiff_t(0), n[axis] - 1}) {
      const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
      at[axis] = layer;
      for (at[u] = 0; at[u] < n[u]; ++at[u])
        for (at[w] = 0; at[w] < n[w]; ++at[w])
          if (const int label = image.label(at)) shape[label].area += area;
    }
  }
  const std::vector<long> surroundings = components.number_of_surroundings();
  for (std::size_t c = 0; c < surroundings.size(); ++c) {
    const int label = components.components()[c].label;
    if (label != 0) shape[label].components += surroundings[c];
  }
  for (auto& [label, own] : shape) {
    own.euler = topology.euler(label);
    if (topology.is_critical(label)) own.components = -1, own.euler = 0;
  }
  return shape;
}

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_SHAPE_OF_IMAGE_3_H
