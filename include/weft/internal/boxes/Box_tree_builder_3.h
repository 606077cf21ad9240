// SPDX-License-Identifier: GPL-3.0-or-later
//
// Orders boxes for a hierarchy of four-way nodes: ranges are split where the surface area heuristic is smallest, among
// 16 bins along each axis (Wald: "On fast construction of SAH-based bounding volume hierarchies", 2007).

#ifndef WEFT_INTERNAL_BOXES_BOX_TREE_BUILDER_3_H
#define WEFT_INTERNAL_BOXES_BOX_TREE_BUILDER_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace weft::internal {

/// An axis-parallel box, empty when default constructed.
struct Box_3
{
  std::array<double, 3> low{{inf, inf, inf}}, high{{-inf, -inf, -inf}};

  void add(const Box_3& other)
  {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  void add(double x, double y, double z) { add({{{x, y, z}}, {{x, y, z}}}); }
  bool is_empty() const { return low[0] > high[0]; }
  double half_area() const
  {
    if (is_empty()) return 0;
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }

  static constexpr double inf = std::numeric_limits<double>::infinity();

  Box_3() = default;
  Box_3(const std::array<double, 3>& l, const std::array<double, 3>& h) : low(l), high(h) {}
};

inline Box_3 bounding_box(const std::vector<Box_3>& boxes)
{
  Box_3 result;
  for (const Box_3& box : boxes) result.add(box);
  return result;
}

/// Splits ranges of boxes; the caller walks down.
class Box_tree_builder_3
{
public:
  /// Ranges this deep are halved, so no stack of a traversal has to be deeper than this for up to 2^34 boxes.
  static constexpr int maximal_depth = 64;

  struct Range
  {
    std::uint32_t first = 0, last = 0;
    int depth = 0;      // of binary splits
    Box_3 box, middles; // around the boxes, and around their middles
    std::uint32_t size() const { return last - first; }
  };

  explicit Box_tree_builder_3(const std::vector<Box_3>& boxes) : entries_(boxes.size())
  {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      entries_[i].box = boxes[i], entries_[i].item = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k < 3; ++k) entries_[i].middle[k] = boxes[i].low[k] / 2 + boxes[i].high[k] / 2;
    }
  }

  Range root() const { return measured(0, static_cast<std::uint32_t>(entries_.size()), 0); }
  std::uint32_t item(std::uint32_t i) const { return entries_[i].item; }

  /// Splits the range, and the parts of largest surface again, until there are four parts or all have at most four
  /// boxes. Returns the number of parts.
  std::size_t split_in_four(const Range& range, std::array<Range, 4>& parts)
  {
    parts[0] = range;
    std::size_t count = 1;
    while (count < 4) {
      std::size_t widest = count; // none
      for (std::size_t i = 0; i < count; ++i)
        if (parts[i].size() > 4 && (widest == count || parts[i].box.half_area() > parts[widest].box.half_area()))
          widest = i;
      if (widest == count) break;
      split(parts[widest], parts[count++]);
    }
    return count;
  }

private:
  static constexpr int number_of_bins = 16;

  struct Entry
  {
    Box_3 box;
    std::array<double, 3> middle;
    std::uint32_t item;
  };
  struct Split
  {
    static constexpr std::size_t none = 3;
    double cost = std::numeric_limits<double>::infinity();
    std::size_t axis = none;
    std::size_t bin = 0; // the first one of the right side
    double low = 0, bins_per_length = 0;
    bool right(const Entry& entry) const { return bin_of(entry.middle[axis], low, bins_per_length) >= bin; }
  };

  static std::size_t bin_of(double x, double low, double bins_per_length)
  {
    return static_cast<std::size_t>(std::min(number_of_bins - 1, static_cast<int>((x - low) * bins_per_length)));
  }

  Range measured(std::uint32_t first, std::uint32_t last, int depth) const
  {
    Range range{first, last, depth, {}, {}};
    for (std::uint32_t i = first; i < last; ++i) {
      range.box.add(entries_[i].box);
      range.middles.add({entries_[i].middle, entries_[i].middle});
    }
    return range;
  }

  // Shortens `range` to its left side.
  void split(Range& range, Range& right)
  {
    const auto begin = entries_.begin() + range.first, end = entries_.begin() + range.last;
    auto middle = begin;
    if (range.depth < maximal_depth / 2) {
      const Split best = best_split(range);
      if (best.axis != Split::none)
        middle = std::partition(begin, end, [&](const Entry& entry) { return !best.right(entry); });
    }
    if (middle == begin || middle == end) middle = begin + (end - begin) / 2; // equal middles: any order will do
    const auto at = static_cast<std::uint32_t>(middle - entries_.begin());
    right = measured(at, range.last, range.depth + 1);
    range = measured(range.first, at, range.depth + 1);
  }

  struct Bin
  {
    Box_3 box;
    std::uint32_t count = 0;
  };
  using Bins = std::array<Bin, number_of_bins>;

  Split best_split(const Range& range) const
  {
    std::array<Bins, 3> bins;
    std::array<double, 3> bins_per_length{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = range.middles.high[axis] - range.middles.low[axis];
      bins_per_length[axis] = length > 1e-290 ? number_of_bins / length : 0;
    }
    for (std::uint32_t i = range.first; i < range.last; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][bin_of(entries_[i].middle[axis], range.middles.low[axis], bins_per_length[axis])];
        bin.box.add(entries_[i].box), ++bin.count;
      }
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (bins_per_length[axis] > 0) try_axis(bins[axis], axis, range.middles.low[axis], bins_per_length[axis], best);
    return best;
  }

  static void try_axis(const Bins& bins, std::size_t axis, double low, double bins_per_length, Split& best)
  {
    std::array<double, number_of_bins> right_cost{};
    Box_3 box;
    std::uint32_t count = 0;
    for (std::size_t bin = number_of_bins - 1; bin > 0; --bin) {
      box.add(bins[bin].box), count += bins[bin].count;
      right_cost[bin] = cost(box, count);
    }
    box = Box_3(), count = 0;
    for (std::size_t bin = 1; bin < number_of_bins; ++bin) {
      box.add(bins[bin - 1].box), count += bins[bin - 1].count;
      const double sum = cost(box, count) + right_cost[bin];
      if (sum < best.cost) best = {sum, axis, bin, low, bins_per_length};
    }
  }

  // Blocks are tested as a whole.
  static double cost(const Box_3& box, std::uint32_t count) { return box.half_area() * ((count + 3) / 4); }

  std::vector<Entry> entries_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_BOX_TREE_BUILDER_3_H
