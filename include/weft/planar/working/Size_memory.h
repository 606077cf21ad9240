// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last values of a sizing field, by the exact place where it was asked. Meshing asks again and again in the middle
// of triangles that haven't changed. Nothing is interpolated, so no value depends on the memory.

#ifndef WEFT_PLANAR_WORKING_SIZE_MEMORY_H
#define WEFT_PLANAR_WORKING_SIZE_MEMORY_H

#include <weft/planar/working/Failure_memory.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace weft::internal {

/// A table of limited size: a new place may push out an old one. One thread at a time.
class Size_memory
{
public:
  /// Makes room for about so many places; forgets all if there was less.
  void reserve(std::size_t places)
  {
    constexpr std::size_t most_slots = std::size_t(1) << 22;
    std::size_t slots = 1024;
    while (slots < 2 * places && slots < most_slots) slots *= 2;
    if (slots > slots_.size()) slots_.assign(slots, Slot());
  }

  /// The size at (x, y): remembered, or computed by `size()` and remembered.
  template <class Size>
  double get(double x, double y, const Size& size)
  {
    if (slots_.empty()) return size();
    Slot& slot = slots_[key_of_point(x, y) & (slots_.size() - 1)];
    if (!(slot.x == x && slot.y == y)) slot = {x, y, size()};
    return slot.size;
  }

private:
  static constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  struct Slot
  {
    double x = nowhere, y = nowhere, size = 0;
  };
  std::vector<Slot> slots_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_WORKING_SIZE_MEMORY_H
