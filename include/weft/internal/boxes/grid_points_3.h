// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of a triangle in space that are no farther apart than asked, as few as a grid along its longest side takes.

#ifndef WEFT_INTERNAL_BOXES_GRID_POINTS_3_H
#define WEFT_INTERNAL_BOXES_GRID_POINTS_3_H

#include <weft/internal/boxes/coordinates_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft::internal {

/// The k-th number of the low-discrepancy sequence of van der Corput, in [0, 1).
inline double radical_inverse(std::size_t k, std::size_t base)
{
  double value = 0, digit = 1;
  for (; k > 0; k /= base) value += static_cast<double>(k % base) * (digit /= static_cast<double>(base));
  return value;
}

/// Calls `add(point)` for each. Rows of points stand across the longest side, as many in a row as it is wide: a needle
/// takes few. At least one, at most about a million.
template <class Add>
void for_each_grid_point(const std::array<Xyz_3, 3>& corners, double spacing, const Add& add)
{
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = norm(minus(corners[(i + 1) % 3], corners[i]));
    if (side > length) length = side, longest = i;
  }
  if (!(length > 0)) return;
  const Xyz_3 &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
  const Xyz_3 ab = minus(b, a), ac = minus(c, a);
  const double foot = std::clamp(dot_product(ab, ac) / (length * length), 0., 1.); // of the apex on the longest side
  const auto at = [](const Xyz_3& p, const Xyz_3& q, double t) {
    return Xyz_3{{p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])}};
  };
  constexpr double most = 1000;
  const double rows = std::clamp(std::ceil(length / spacing), 1., most);
  for (double i = 0.5; i < rows; ++i) {
    const double t = i / rows;
    const Xyz_3 low = at(a, b, t), high = t < foot ? at(a, c, t / foot) : at(b, c, (1 - t) / (1 - foot));
    const double columns = std::clamp(std::ceil(norm(minus(high, low)) / spacing), 1., most);
    for (double j = 0.5; j < columns; ++j) add(at(low, high, j / columns));
  }
}

} // namespace weft::internal

#endif // WEFT_INTERNAL_BOXES_GRID_POINTS_3_H
