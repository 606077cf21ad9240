// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flat bounding volume hierarchy over boxes: nodes of four children whose boxes are floats, one array per side of the
// box, so that one operation tests four boxes; leaves are blocks of up to four boxes. The boxes are kept in a frame of
// their own, coordinates in [-1, 1], and grown by more than what rounding can do to a query in that frame: a traversal
// meets every box that it has to, and a few others. The shape is that of the hierarchies of ray tracers (Wald, Benthin,
// Boulos: "Getting rid of packets", 2008); the split is by the surface area heuristic.

#ifndef WEFT_INTERNAL_BOXES_BOX_HIERARCHY_3_H
#define WEFT_INTERNAL_BOXES_BOX_HIERARCHY_3_H

#include <weft/internal/boxes/Box_tree_builder_3.h>
#include <weft/internal/boxes/Float_4.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace weft::internal {

/// A similarity that maps a box into [-1, 1]^3. Its factor is a power of two, so only the subtraction rounds.
struct Frame_3
{
  std::array<double, 3> center{{0, 0, 0}};
  double scale = 1;

  Frame_3() = default;
  explicit Frame_3(const Box_3& box)
  {
    double half = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      center[k] = box.low[k] / 2 + box.high[k] / 2;
      half = std::max({half, box.high[k] - center[k], center[k] - box.low[k]});
    }
    if (half > 0) scale = std::ldexp(1., -std::min(1000, std::max(-1000, std::ilogb(half) + 1)));
  }
  std::array<double, 3> operator()(double x, double y, double z) const
  {
    return {{(x - center[0]) * scale, (y - center[1]) * scale, (z - center[2]) * scale}};
  }
};

/// By how much boxes are grown in the frame. With u = 2^-24: a query's origin and a side of a box are each wrong by u
/// or less, a parameter along a segment by 4u of itself, which moves the point by 4u times a diagonal of up to 3.5.
constexpr float box_slack = 1.f / (1 << 19);

/// Part of a segment in the frame of a hierarchy.
struct Framed_segment_3
{
  std::array<float, 3> origin{{0, 0, 0}}, direction{{0, 0, 0}};
  bool empty = true; ///< the segment stays outside the hierarchy's box
};

/// See the top of the file.
class Box_hierarchy_3
{
public:
  static constexpr std::uint32_t nothing = 0xffffffff;

  Box_hierarchy_3() = default;

  /// O(n log n).
  explicit Box_hierarchy_3(const std::vector<Box_3>& boxes) : frame_(bounding_box(boxes))
  {
    if (boxes.empty()) return;
    Box_tree_builder_3 builder(boxes);
    nodes_.reserve(boxes.size() / 6 + 4);
    flatten(builder, builder.root());
  }

  bool empty() const { return nodes_.empty(); }
  const Frame_3& frame() const { return frame_; }

  /// Blocks of four: `items()[4 b + i]` is the constructor's index of box i in block b, or `nothing`.
  const std::vector<std::uint32_t>& items() const { return items_; }
  std::size_t number_of_blocks() const { return items_.size() / 4; }

  /// The part of the segment pq, given in input coordinates, that lies in the hierarchy's box.
  Framed_segment_3 clip(const std::array<double, 3>& p, const std::array<double, 3>& q) const
  {
    constexpr double wall = 1 + 2. * box_slack;
    Framed_segment_3 result; // the one that is returned everywhere: a copy would have to wait for its floats
    double first = 0, last = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(p[k]) <= wall && std::abs(q[k]) <= wall) continue;
      const double d = q[k] - p[k];
      if (d == 0) return result;
      const double in = ((d > 0 ? -wall : wall) - p[k]) / d, out = ((d > 0 ? wall : -wall) - p[k]) / d;
      first = std::max(first, in), last = std::min(last, out);
    }
    if (!(first <= last)) return result;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = q[k] - p[k];
      result.origin[k] = static_cast<float>(p[k] + first * d);
      result.direction[k] = static_cast<float>((last - first) * d);
    }
    result.empty = false;
    return result;
  }

  /// Calls `visit(block)` for all blocks that the segment meets until one call returns true, and returns whether one
  /// did.
  template <class Visit>
  bool visit_segment(const Framed_segment_3& segment, Visit&& visit) const
  {
    if (segment.empty) return false;
    std::array<float, 3> inverse;
    std::array<std::size_t, 3> near, far; // the sides that the segment enters and leaves through
    for (std::size_t k = 0; k < 3; ++k) {
      // No infinities: a product with zero would be NaN. What this changes is far below the slack.
      const float d = std::abs(segment.direction[k]) < 1e-30f ? 1e-30f : segment.direction[k];
      inverse[k] = 1 / d;
      near[k] = d > 0 ? k : k + 3, far[k] = d > 0 ? k + 3 : k;
    }
    const Float_4 ox = segment.origin[0], oy = segment.origin[1], oz = segment.origin[2];
    const Float_4 ix = inverse[0], iy = inverse[1], iz = inverse[2];
    return visit_where(
        [&](const Node& node) {
          const Float_4 first = max(max((node.side(near[0]) - ox) * ix, (node.side(near[1]) - oy) * iy),
                                    max((node.side(near[2]) - oz) * iz, Float_4(0.f)));
          const Float_4 last = min(min((node.side(far[0]) - ox) * ix, (node.side(far[1]) - oy) * iy),
                                   min((node.side(far[2]) - oz) * iz, Float_4(1.f)));
          return (first <= last).bits();
        },
        std::forward<Visit>(visit));
  }

  /// The same for the ray from p, in the frame, along axis k, upwards or downwards.
  template <class Visit>
  bool visit_ray(const std::array<float, 3>& p, std::size_t k, bool upwards, Visit&& visit) const
  {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Float_4 x = p[k], y = p[i], z = p[j];
    return visit_where(
        [&](const Node& node) {
          const Mask_4 across =
              (node.side(i) <= y) & (y <= node.side(i + 3)) & (node.side(j) <= z) & (z <= node.side(j + 3));
          return (across & (upwards ? x <= node.side(k + 3) : node.side(k) <= x)).bits();
        },
        std::forward<Visit>(visit));
  }

  /// The same for blocks whose boxes may meet a box, in the frame, and the slab of points x with
  /// |normal * x - offset| <= width.
  template <class Visit>
  bool visit_slab(const std::array<float, 3>& low, const std::array<float, 3>& high, const std::array<float, 3>& normal,
                  float offset, float width, Visit&& visit) const
  {
    return visit_where(
        [&](const Node& node) {
          Mask_4 meets = Float_4(0.f) <= Float_4(0.f);
          Float_4 smallest = -offset - width, largest = width - offset;
          for (std::size_t k = 0; k < 3; ++k) {
            const Float_4 a = node.side(k), b = node.side(k + 3);
            meets = meets & (a <= Float_4(high[k])) & (Float_4(low[k]) <= b);
            smallest = smallest + Float_4(normal[k]) * (normal[k] < 0 ? b : a);
            largest = largest + Float_4(normal[k]) * (normal[k] < 0 ? a : b);
          }
          return (meets & (smallest <= Float_4(0.f)) & (Float_4(0.f) <= largest)).bits();
        },
        std::forward<Visit>(visit));
  }

  /// Calls `limit = visit(block, limit)` for the blocks whose boxes have a squared distance below `limit` to p, nearer
  /// boxes first. Coordinates and distances are those of the frame.
  template <class Visit>
  void visit_nearest(const std::array<float, 3>& p, float limit, Visit&& visit) const
  {
    if (nodes_.empty()) return;
    const Float_4 x = p[0], y = p[1], z = p[2];
    std::array<std::uint64_t, stack_size> stack; // squared distance and child in one number that orders like it
    std::size_t pending = 1;
    stack[0] = 0;
    while (pending > 0) {
      const std::uint64_t entry = stack[--pending];
      const auto at = static_cast<std::uint32_t>(entry);
      if (!(distance_of(entry) < limit)) continue;
      if (at & leaf_bit) {
        limit = visit(at & ~leaf_bit, limit);
        continue;
      }
      const Node& node = nodes_[at];
      const Float_4 squared = node.squared_distance(x, y, z);
      const unsigned bits = (squared < Float_4(limit)).bits();
      alignas(16) float distance[4];
      squared.store(distance);
      std::array<std::uint64_t, 4> entries;
      for (unsigned lane = 0; lane < 4; ++lane) // 0 for those too far: they come last
        entries[lane] = (0 - std::uint64_t(bits >> lane & 1)) & entry_of(distance[lane], node.child[lane]);
      sort_descending(entries);
      for (unsigned i = 0; i < 4; ++i) stack[pending + i] = entries[i];
      pending += (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1) + (bits >> 3);
    }
  }

private:
  static constexpr std::uint32_t leaf_bit = 0x80000000;
  static constexpr std::size_t stack_size = 3 * Box_tree_builder_3::maximal_depth + 4;

  struct alignas(64) Node
  {
    float sides[6][4];      // low x, y, z, high x, y, z of the children
    std::uint32_t child[4]; // a node, or a block with `leaf_bit`; a missing child has an empty box

    Float_4 side(std::size_t k) const { return Float_4::load(sides[k]); }
    Float_4 squared_distance(Float_4 x, Float_4 y, Float_4 z) const
    {
      const Float_4 zero = 0.f;
      const Float_4 dx = max(max(side(0) - x, x - side(3)), zero);
      const Float_4 dy = max(max(side(1) - y, y - side(4)), zero);
      const Float_4 dz = max(max(side(2) - z, z - side(5)), zero);
      return dx * dx + dy * dy + dz * dz;
    }
  };

  static std::uint64_t entry_of(float distance, std::uint32_t child)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &distance, sizeof bits); // of floats that aren't negative, these order like the floats
    return std::uint64_t(bits) << 32 | child;
  }
  static float distance_of(std::uint64_t entry)
  {
    const auto bits = static_cast<std::uint32_t>(entry >> 32);
    float distance;
    std::memcpy(&distance, &bits, sizeof distance);
    return distance;
  }

  // A network: no branches.
  static void sort_descending(std::array<std::uint64_t, 4>& x)
  {
    const auto order = [&x](std::size_t i, std::size_t j) {
      const std::uint64_t change = (x[i] ^ x[j]) & (0 - std::uint64_t(x[i] < x[j]));
      x[i] ^= change, x[j] ^= change;
    };
    order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  }

  // Breadth first: the next node is known before the test of this one has ended, so the processor works on several at
  // once. No branches on single children, which nobody could predict.
  template <class Test, class Visit>
  bool visit_where(const Test& test, Visit&& visit, std::uint32_t root = 0) const
  {
    if (nodes_.empty()) return false;
    std::array<std::uint32_t, 256> queue;
    std::size_t head = 0, tail = 1;
    queue[0] = root;
    while (head < tail) {
      const std::uint32_t at = queue[head++];
      if (at & leaf_bit) {
        if (visit(at & ~leaf_bit)) return true;
        continue;
      }
      if (tail + 4 > queue.size()) {
        if (tail - head > queue.size() / 2) { // a wide front
          if (visit_where(test, visit, at)) return true;
          continue;
        }
        std::copy(queue.begin() + head, queue.begin() + tail, queue.begin());
        tail -= head, head = 0;
      }
      const Node& node = nodes_[at];
      const unsigned bits = test(node);
      for (unsigned lane = 0; lane < 4; ++lane) {
        queue[tail] = node.child[lane];
        tail += bits >> lane & 1;
      }
    }
    return false;
  }

  // Parents before children.
  std::uint32_t flatten(Box_tree_builder_3& builder, const Box_tree_builder_3::Range& range)
  {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<Box_tree_builder_3::Range, 4> children;
    const std::size_t count = builder.split_in_four(range, children);
    for (std::size_t i = 0; i < 4; ++i) {
      set_box(nodes_[index], i, i < count ? children[i].box : Box_3());
      nodes_[index].child[i] = leaf_bit;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t child =
          children[i].size() <= 4 ? add_block(builder, children[i]) : flatten(builder, children[i]);
      nodes_[index].child[i] = child;
    }
    return index;
  }

  std::uint32_t add_block(const Box_tree_builder_3& builder, const Box_tree_builder_3::Range& range)
  {
    const auto block = static_cast<std::uint32_t>(items_.size() / 4);
    for (std::uint32_t i = range.first; i < range.first + 4; ++i)
      items_.push_back(i < range.last ? builder.item(i) : nothing);
    return block | leaf_bit;
  }

  void set_box(Node& node, std::size_t lane, const Box_3& box) const
  {
    constexpr float far = 1e30f; // an empty box is met by nothing
    const bool is_empty = box.low[0] > box.high[0];
    const auto low = frame_(box.low[0], box.low[1], box.low[2]), high = frame_(box.high[0], box.high[1], box.high[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      node.sides[k][lane] = is_empty ? far : static_cast<float>(low[k]) - box_slack;
      node.sides[k + 3][lane] = is_empty ? -far : static_cast<float>(high[k]) + box_slack;
    }
  }

  Frame_3 frame_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_BOX_HIERARCHY_3_H
