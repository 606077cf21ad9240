// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smallest and the largest of several sizing fields, in any dimension.

#ifndef WEFT_SIZING_COMBINED_SIZING_H
#define WEFT_SIZING_COMBINED_SIZING_H

#include <CGAL/number_utils.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace weft {

/// Sizing field that is the smallest or the largest of others at every point; of k-Lipschitz ones it is k-Lipschitz. As
/// safe to read from many threads as they are.
/// \tparam least whether it is the smallest.
template <bool least, class... Fields>
class Combined_sizing
{
public:
  explicit Combined_sizing(Fields... fields) : fields_(std::move(fields)...) {}

  /// Target edge length at `x`.
  template <class Point>
  double operator()(const Point& x) const
  {
    return std::apply(
        [&](const auto&... field) {
          return least ? (std::min)({CGAL::to_double(field(x))...}) : (std::max)({CGAL::to_double(field(x))...});
        },
        fields_);
  }

private:
  std::tuple<Fields...> fields_;
};

/// The smallest of some fields, copies of which it keeps.
template <class... Fields>
Combined_sizing<true, Fields...> least_sizing(Fields... fields)
{
  return Combined_sizing<true, Fields...>(std::move(fields)...);
}

/// The largest of some fields, copies of which it keeps.
template <class... Fields>
Combined_sizing<false, Fields...> greatest_sizing(Fields... fields)
{
  return Combined_sizing<false, Fields...>(std::move(fields)...);
}

} // namespace weft

#endif // WEFT_SIZING_COMBINED_SIZING_H
