// SPDX-License-Identifier: GPL-3.0-or-later
//
// Builds the octree of a sizing field: cubes are split until they are small against the sizes in them, and until
// neighbours differ by one level at most. Corners in the middle of an edge or a face of a larger neighbour hang: their
// value is the mean at its ends, so that the field is continuous (as in adaptive finite elements: Bangerth and
// Kayser-Herold, "Data structures and requirements for hp finite element software", 2009).

#ifndef WEFT_SIZING_SIZE_OCTREE_BUILDER_3_H
#define WEFT_SIZING_SIZE_OCTREE_BUILDER_3_H

#include <weft/errors.h>
#include <weft/sizing/Octree_cubes_3.h>
#include <weft/sizing/Size_octree_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace weft::internal {

/// How finely a field is tabulated.
struct Octree_limits_3
{
  double part = 0.7;       ///< edge of the leaves in parts of the sizes there
  double guide_part = 0.7; ///< the same for those of a guide
  int depth = 12;          ///< most levels below the roots
  std::size_t leaves = 0;  ///< most of them, up to the balance between neighbours
};

/// The octree and what is needed to change its values: corners, those that hang, and the leaves' corners.
class Size_octree_builder_3 : private Octree_cubes_3
{
public:
  using Index = std::uint32_t;

  /// A size that is asked for at a point.
  struct Source
  {
    std::array<double, 3> point;
    double size;
  };

  /// A corner in the middle of an edge or a face of a larger leaf.
  struct Hanging
  {
    Index corner;
    Index count;                 ///< of the masters, 2 or 4
    std::array<Index, 4> master; ///< whose mean it is
  };

  /// \param field called with three coordinates, returns the size there; infinite for none.
  /// \param guide sizes that leaves have to be small against, too; may be null.
  template <class Field>
  Size_octree_builder_3(const CGAL::Bbox_3& box, const Field& field, const std::vector<Source>& sources,
                        const Octree_limits_3& limits, const Size_octree_3* guide = nullptr)
      : Octree_cubes_3(box, limits.depth), limits_(limits), guide_(guide)
  {
    split_all(field, sources);
    balance();
    list_corners(field);
    for (const Source& s : sources) {
      const Cube c = cube_at(place(s.point));
      for (std::size_t i = 0; i < 8; ++i) {
        double& value = values[corner_ids_.at(key(corner(c, i)))];
        value = std::min(value, s.size);
      }
    }
    std::unordered_map<std::uint64_t, double>().swap(known_);
  }

  /// The tree with the values as they are now.
  Size_octree_3 tree() const
  {
    Size_octree_3 result = tree_;
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
      Size_octree_3::Leaf leaf;
      for (std::size_t c = 0; c < 8; ++c) leaf[c] = value(corners[i][c]);
      result.leaves.push_back(leaf);
      result.sides.push_back(side(i));
    }
    return result;
  }

  double side(std::size_t leaf) const { return step_ * static_cast<double>(cubes_[leaf].side); }

  /// The value at a corner: of one that hangs, the mean of its masters.
  double value(Index corner) const
  {
    if (hangs[corner] == 0) return values[corner];
    const Hanging& h = hanging[hangs[corner] - 1];
    double sum = 0;
    for (std::size_t i = 0; i < h.count; ++i) sum += value(h.master[i]);
    return sum / h.count;
  }

  /// Lowers the value at a corner to a bound; if it hangs, those of its masters that are above the bound, by as much at
  /// most.
  void lower(Index corner, double bound)
  {
    if (hangs[corner] == 0) {
      values[corner] = std::min(values[corner], bound);
      return;
    }
    const double by = value(corner) - bound;
    const Hanging& h = hanging[hangs[corner] - 1];
    for (std::size_t i = 0; i < h.count && by > 0; ++i) {
      const double of_master = value(h.master[i]);
      if (of_master > bound) lower(h.master[i], std::max(bound, of_master - by));
    }
  }

  std::array<double, 3> point(Index corner) const { return point(places_[corner]); }

  std::vector<double> values;                ///< by corner; of those that hang, as the field has them
  std::vector<std::array<Index, 8>> corners; ///< by leaf
  std::vector<Index> hangs;                  ///< by corner: 0, or one more than its place below
  std::vector<Hanging> hanging;

private:
  using Octree_cubes_3::point;

  template <class Field>
  double value_at(const Field& field, const Place& p)
  {
    const auto [at, is_new] = known_.emplace(key(p), 0.);
    if (is_new) {
      const auto x = point(p);
      at->second = field(x[0], x[1], x[2]);
      if (!(at->second > 0)) throw Option_error("a sizing field must be positive");
    }
    return at->second;
  }

  template <class Field>
  void split_all(const Field& field, const std::vector<Source>& sources)
  {
    struct Pending
    {
      Cube cube;
      std::vector<Index> sources; ///< in it
    };
    std::deque<Pending> queue;
    std::size_t n = 0;
    for (std::uint32_t z = 0; z < tree_.size[2]; ++z)
      for (std::uint32_t y = 0; y < tree_.size[1]; ++y)
        for (std::uint32_t x = 0; x < tree_.size[0]; ++x)
          queue.push_back({{{x * unit_, y * unit_, z * unit_}, unit_, n++}, {}});
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const Place p = place(sources[i].point);
      const std::size_t root =
          (std::size_t(p[2] / unit_) * tree_.size[1] + p[1] / unit_) * tree_.size[0] + p[0] / unit_;
      queue[root].sources.push_back(static_cast<Index>(i));
    }
    for (std::size_t leaves = queue.size(); !queue.empty(); queue.pop_front()) {
      Pending& p = queue.front();
      const Cube c = p.cube;
      double asked = std::numeric_limits<double>::infinity();
      for (const Index i : p.sources) asked = std::min(asked, sources[i].size);
      if (c.side == 1 || leaves + 7 > limits_.leaves || !wants_split(field, c, asked)) continue;
      const std::size_t first = split(c);
      leaves += 7;
      std::array<std::vector<Index>, 8> parts;
      for (const Index i : p.sources) {
        const Place at = place(sources[i].point);
        parts[std::size_t(at[0] >= c.low[0] + c.side / 2) | std::size_t(at[1] >= c.low[1] + c.side / 2) << 1 |
              std::size_t(at[2] >= c.low[2] + c.side / 2) << 2]
            .push_back(i);
      }
      for (std::size_t i = 0; i < 8; ++i) queue.push_back({child(c, first, i), std::move(parts[i])});
    }
  }

  /// \param asked the smallest size of the sources in the cube.
  template <class Field>
  bool wants_split(const Field& field, const Cube& c, double asked)
  {
    const double length = step_ * c.side;
    if (length > limits_.part * asked) return true;
    const auto x = point(c.low);
    if (guide_ && length > limits_.guide_part * (*guide_)(x[0] + length / 2, x[1] + length / 2, x[2] + length / 2))
      return true;
    for (std::size_t i = 0; i < 8; ++i)
      if (length > limits_.part * value_at(field, corner(c, i))) return true;
    const std::uint32_t half = c.side / 2;
    return length > limits_.part * value_at(field, {c.low[0] + half, c.low[1] + half, c.low[2] + half});
  }

  template <class Field>
  void list_corners(const Field& field)
  {
    for_each_leaf([&](const Cube& c) { cubes_.push_back(c); });
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
      const Cube& c = cubes_[i];
      tree_.nodes[c.node] = ~static_cast<std::int32_t>(i);
      corners.emplace_back();
      for (std::size_t k = 0; k < 8; ++k) {
        const Place p = corner(c, k);
        const auto [at, is_new] = corner_ids_.emplace(key(p), static_cast<Index>(places_.size()));
        if (is_new) places_.push_back(p), values.push_back(value_at(field, p));
        corners[i][k] = at->second;
      }
    }
    hangs.assign(places_.size(), 0);
    for (std::size_t v = 0; v < places_.size(); ++v) find_masters(static_cast<Index>(v), places_[v]);
  }

  /// A corner hangs if one of the leaves around it has it elsewhere than at a corner.
  void find_masters(Index v, const Place& p)
  {
    for (std::size_t i = 0; i < 8; ++i) {
      Place q = p;
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if (i >> k & 1) {
          inside = inside && q[k] > 0;
          --q[k];
        } else {
          inside = inside && q[k] < tree_.size[k] * unit_;
        }
      }
      if (!inside) continue;
      const Cube c = cube_at(q);
      Hanging h{v, 1, {}};
      std::array<Place, 4> ends{c.low, c.low, c.low, c.low};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t at = p[k] - c.low[k];
        const bool is_between = at != 0 && at != c.side;
        for (std::size_t m = 0; m < 4; ++m)
          if (is_between ? (h.count == 1 ? m & 1 : m >> 1) != 0 : at != 0) ends[m][k] += c.side;
        if (is_between) h.count *= 2;
      }
      if (h.count == 1) continue;
      for (std::size_t m = 0; m < h.count; ++m) h.master[m] = corner_ids_.at(key(ends[m]));
      hanging.push_back(h);
      hangs[v] = static_cast<Index>(hanging.size());
      return;
    }
  }

  Octree_limits_3 limits_;
  const Size_octree_3* guide_;
  std::vector<Cube> cubes_;   ///< of the leaves
  std::vector<Place> places_; ///< of the corners
  std::unordered_map<std::uint64_t, double> known_;
  std::unordered_map<std::uint64_t, Index> corner_ids_;
};

} // namespace weft::internal

#endif // WEFT_SIZING_SIZE_OCTREE_BUILDER_3_H
