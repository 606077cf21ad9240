// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted means of the places to which a vertex is drawn.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTHING_PULL_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTHING_PULL_3_H

#include <cmath>
#include <optional>
#include <vector>

namespace weft::internal {

/// Sum of weighted vectors from a vertex to where it is drawn.
template <class Vector>
struct Pull_3
{
  Vector sum{0, 0, 0};
  double weight = 0;

  void add(double w, const Vector& to)
  {
    sum = sum + w * to;
    weight += w;
  }

  template <class Point>
  std::optional<Point> position(const Point& from) const
  {
    if (!(weight > 0) || !std::isfinite(weight)) return std::nullopt;
    return from + sum / weight;
  }
};

/// The circumcenters of the domain's cells around a vertex, weighted with volumes: the optimal position of ODT, less
/// its boundary terms.
template <class Context>
auto pull_of_circumcenters(const Context& context, typename Context::Vertex_handle v,
                           const std::vector<typename Context::Cell_handle>& star)
{
  Pull_3<typename Context::Vector> pull;
  for (const auto c : star) {
    if (c->subdomain() == 0) continue;
    pull.add(context.mass(c), c->circumcenter() - v->point());
  }
  return pull;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTHING_PULL_3_H
