// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sizing field on a regular grid of the plane or of space, as an image has it: linear along each axis between the
// values at its nodes.

#ifndef WEFT_SIZING_GRID_SIZING_H
#define WEFT_SIZING_GRID_SIZING_H

#include <weft/errors.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace weft {

/// Sizing field between the nodes of a grid; outside of it, the value at the nearest point of the grid. Copies share
/// the values. Safe to read from many threads.
/// \tparam d the dimension, 2 or 3.
template <int d>
class Grid_sizing
{
public:
  /// \param size number of nodes along each axis.
  /// \param spacing of the nodes, in the input's units.
  /// \param origin the first node.
  /// \param values edge lengths at the nodes, x running fastest, in the input's units.
  /// \throws Option_error for a size that isn't positive and finite, a spacing that isn't, or if there isn't a value
  /// for
  ///   each node.
  Grid_sizing(const std::array<std::size_t, d>& size, const std::array<double, d>& spacing,
              const std::array<double, d>& origin, std::vector<double> values)
      : size_(size), spacing_(spacing), origin_(origin)
  {
    std::size_t n = 1;
    for (std::size_t k = 0; k < d; ++k) {
      n *= size[k];
      if (!(spacing[k] > 0) || !std::isfinite(spacing[k]))
        throw Option_error("Grid_sizing: the spacing must be positive");
    }
    if (n == 0 || n != values.size()) throw Option_error("Grid_sizing: one size per node is needed");
    for (const double value : values)
      if (!(value > 0) || !std::isfinite(value)) throw Option_error("Grid_sizing: sizes must be positive and finite");
    values_ = std::make_shared<const std::vector<double>>(std::move(values));
  }

  /// Target edge length at `x`. O(1).
  template <class Point>
  double operator()(const Point& x) const
  {
    std::array<double, d> t;
    std::array<std::size_t, d> step;
    std::size_t first = 0, stride = 1;
    for (std::size_t k = 0; k < d; ++k) {
      const double last = static_cast<double>(size_[k]) - 1;
      const double at = std::clamp((CGAL::to_double(x[static_cast<int>(k)]) - origin_[k]) / spacing_[k], 0., last);
      const double whole = std::max(0., std::min(std::floor(at), last - 1));
      t[k] = at - whole;
      first += static_cast<std::size_t>(whole) * stride;
      step[k] = size_[k] > 1 ? stride : 0;
      stride *= size_[k];
    }
    double sum = 0;
    for (std::size_t i = 0; i < std::size_t(1) << d; ++i) {
      double weight = 1;
      std::size_t at = first;
      for (std::size_t k = 0; k < d; ++k) {
        const bool upper = i >> k & 1;
        weight *= upper ? t[k] : 1 - t[k];
        if (upper) at += step[k];
      }
      sum += weight * (*values_)[at];
    }
    return sum;
  }

private:
  std::array<std::size_t, d> size_;
  std::array<double, d> spacing_, origin_;
  std::shared_ptr<const std::vector<double>> values_;
};

using Grid_sizing_2 = Grid_sizing<2>; ///< in the plane
using Grid_sizing_3 = Grid_sizing<3>; ///< in space

} // namespace weft

#endif // WEFT_SIZING_GRID_SIZING_H
