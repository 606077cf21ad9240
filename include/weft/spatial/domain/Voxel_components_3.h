// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of the labels of an image: voxels that share faces and a label hang together. Runs of voxels
// along x are united in one pass (Rosenfeld and Pfaltz 1966), so memory goes with the runs, not with the voxels.

#ifndef WEFT_SPATIAL_DOMAIN_VOXEL_COMPONENTS_3_H
#define WEFT_SPATIAL_DOMAIN_VOXEL_COMPONENTS_3_H

#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/domain/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft {

/// A connected component of a label.
struct Voxel_component_3
{
  int label = 0;
  std::size_t voxels = 0;
  double volume = 0;                           ///< of the voxels, in the input's units
  Voxel_image_3::Voxel first{{0, 0, 0}};       ///< its first voxel
  std::array<double, 3> center{{0, 0, 0}};     ///< of that voxel, in the input's units
  Voxel_image_3::Voxel low{{0, 0, 0}}, high{}; ///< its extent in voxels, both included
};

/// The components of all labels, 0 included, in the order of their first voxels, x running fastest.
class Voxel_components_3
{
public:
  using Voxel = Voxel_image_3::Voxel;

  /// O(voxels).
  explicit Voxel_components_3(const Voxel_image_3& image) : size_(image.size())
  {
    collect_runs(image);
    unite_runs();
    const double volume = image.voxel_volume();
    for (Voxel_component_3& c : components_) {
      c.volume = static_cast<double>(c.voxels) * volume;
      for (std::size_t k = 0; k < 3; ++k) c.center[k] = image.coordinate(k, static_cast<double>(c.first[k]));
    }
  }

  const std::vector<Voxel_component_3>& components() const { return components_; }

  /// Number of the component that a voxel belongs to. O(log(runs in its row)).
  std::size_t component(const Voxel& v) const
  {
    const std::size_t row = static_cast<std::size_t>(v[2]) * size_[1] + static_cast<std::size_t>(v[1]);
    const auto first = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[row]),
               last = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[row + 1]);
    return (std::upper_bound(first, last, v[0], [](std::ptrdiff_t x, const Run& run) { return x < run.begin; }) - 1)
        ->component;
  }

  /// Into how many connected parts each component cuts the space around it: 1 plus its cavities. The boundary of a
  /// component whose voxels don't meet at edges or corners alone has as many components.
  std::vector<long> number_of_surroundings() const
  {
    const std::size_t outside = components_.size();
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for_each_contact([&](std::size_t r, std::size_t s) {
      const std::size_t a = runs_[r].component, b = s == none ? outside : runs_[s].component;
      if (a != b) pairs.emplace_back(a, b), pairs.emplace_back(b, a);
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return parts_without(pairs, outside);
  }

private:
  struct Run
  {
    std::ptrdiff_t begin; ///< first x
    int label;
    std::size_t component;
  };

  static constexpr std::size_t none = std::size_t(-1);

  void collect_runs(const Voxel_image_3& image)
  {
    Voxel v;
    for (v[2] = 0; v[2] < count(2); ++v[2])
      for (v[1] = 0; v[1] < count(1); ++v[1]) {
        rows_.push_back(runs_.size());
        for (v[0] = 0; v[0] < count(0); ++v[0]) {
          const int label = image.label(v);
          if (v[0] == 0 || label != runs_.back().label) runs_.push_back({v[0], label, 0});
        }
      }
    rows_.push_back(runs_.size());
  }

  void unite_runs()
  {
    internal::Disjoint_parts sets(runs_.size());
    for_each_contact([&](std::size_t r, std::size_t s) {
      if (s != none && runs_[r].label == runs_[s].label) sets.unite(r, s);
    });
    std::vector<std::size_t> number(runs_.size(), none);
    std::size_t row = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      while (rows_[row + 1] <= r) ++row;
      const std::size_t root = sets.find(r);
      const Voxel first{
          {runs_[r].begin, static_cast<std::ptrdiff_t>(row % size_[1]), static_cast<std::ptrdiff_t>(row / size_[1])}};
      if (number[root] == none) {
        number[root] = components_.size();
        components_.emplace_back();
        components_.back().label = runs_[r].label;
        components_.back().first = components_.back().low = components_.back().high = first;
      }
      runs_[r].component = number[root];
      Voxel_component_3& c = components_[number[root]];
      const std::ptrdiff_t end = end_of(r, row);
      c.voxels += static_cast<std::size_t>(end - runs_[r].begin);
      for (std::size_t k = 0; k < 3; ++k) {
        c.low[k] = (std::min)(c.low[k], first[k]);
        c.high[k] = (std::max)(c.high[k], k == 0 ? end - 1 : first[k]);
      }
    }
  }

  std::ptrdiff_t count(std::size_t axis) const { return static_cast<std::ptrdiff_t>(size_[axis]); }
  std::ptrdiff_t end_of(std::size_t run, std::size_t row) const
  {
    return run + 1 < rows_[row + 1] ? runs_[run + 1].begin : count(0);
  }

  /// Calls `visit(run, run)` for runs with a common face, and `visit(run, none)` for those at the border.
  template <class Visit>
  void for_each_contact(const Visit& visit) const
  {
    for (std::size_t row = 0; row + 1 < rows_.size(); ++row) {
      const std::size_t y = row % size_[1], z = row / size_[1];
      const bool at_border = y == 0 || y + 1 == size_[1] || z == 0 || z + 1 == size_[2];
      for (std::size_t r = rows_[row]; r < rows_[row + 1]; ++r) {
        if (r + 1 < rows_[row + 1]) visit(r, r + 1);
        if (at_border || r == rows_[row] || r + 1 == rows_[row + 1]) visit(r, none);
      }
      if (y > 0) visit_overlaps(row, row - 1, visit);
      if (z > 0) visit_overlaps(row, row - size_[1], visit);
    }
  }

  template <class Visit>
  void visit_overlaps(std::size_t row, std::size_t other, const Visit& visit) const
  {
    std::size_t r = rows_[row], s = rows_[other];
    while (r < rows_[row + 1] && s < rows_[other + 1]) {
      visit(r, s);
      const std::ptrdiff_t end_r = end_of(r, row), end_s = end_of(s, other);
      r += end_r <= end_s;
      s += end_s <= end_r;
    }
  }

  /// The connected parts that a connected graph falls into without each of its nodes (Hopcroft and Tarjan 1973).
  /// \param pairs the edges in both directions, sorted.
  /// \param root a node.
  std::vector<long> parts_without(const std::vector<std::pair<std::size_t, std::size_t>>& pairs, std::size_t root) const
  {
    const std::size_t n = components_.size() + 1;
    std::vector<std::size_t> first(n + 1, 0), order(n, none), low(n, 0), parent(n, none);
    for (const auto& pair : pairs) ++first[pair.first + 1];
    for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    std::vector<long> parts(n, 1);
    std::vector<std::size_t> stack{root};
    std::size_t visited = 0;
    order[root] = low[root] = visited++;
    while (!stack.empty()) {
      const std::size_t v = stack.back();
      if (next[v] < first[v + 1]) {
        const std::size_t w = pairs[next[v]++].second;
        if (order[w] == none) {
          order[w] = low[w] = visited++;
          parent[w] = v;
          stack.push_back(w);
        } else if (w != parent[v]) {
          low[v] = (std::min)(low[v], order[w]);
        }
      } else {
        stack.pop_back();
        if (v == root) break;
        const std::size_t u = parent[v];
        low[u] = (std::min)(low[u], low[v]);
        if (low[v] >= order[u]) ++parts[u];
      }
    }
    parts.pop_back(); // the outside isn't asked for
    return parts;
  }

  std::array<std::size_t, 3> size_;
  std::vector<Run> runs_;
  std::vector<std::size_t> rows_; ///< first run of each row
  std::vector<Voxel_component_3> components_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_VOXEL_COMPONENTS_3_H
