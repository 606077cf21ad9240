// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sizing field in space that grows by at most k per unit of distance, below any field and below sizes at points:
//   mu(x) <= inf_s [k d(s, x) + h(s)],
// Alliez, Cohen-Steiner, Yvinec and Desbrun, "Variational tetrahedral meshing" (2005); Tournois 2009, sec. 2.4. It is
// tabulated on an octree, so that a field that is dear is asked a limited number of times, and reading costs little.

#ifndef WEFT_SIZING_LIPSCHITZ_SIZING_3_H
#define WEFT_SIZING_LIPSCHITZ_SIZING_3_H

#include <weft/errors.h>
#include <weft/sizing/limit_gradient_3.h>
#include <weft/sizing/Size_octree_3.h>
#include <weft/sizing/Size_octree_builder_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace weft {

/// How a sizing field in space is graded and tabulated.
struct Gradation_options_3
{
  double min_size = 0;                                       ///< of the field, in the input's units
  double max_size = std::numeric_limits<double>::infinity(); ///< likewise
  /// Edge of the table's cubes in parts of the sizes there. What is smaller isn't seen, and up to 0.42 k times the edge
  /// the field lies below the infimum, most where that has a tip.
  double resolution = 0.7;
  std::size_t max_leaves = 1000000; ///< most cubes, but for those that neighbours need

  /// \throws Option_error naming the first option out of range.
  void check() const
  {
    if (!(min_size >= 0) || !std::isfinite(min_size)) throw Option_error("the smallest size must be finite and >= 0");
    if (!(max_size > 0)) throw Option_error("the largest size must be positive");
    if (min_size > max_size) throw Option_error("the smallest size is above the largest size");
    if (!(resolution > 0 && resolution <= 4)) throw Option_error("the resolution must lie in (0, 4]");
  }
};

/// Sizing field in space of which the ratio of the difference of sizes to the distance is nowhere above k. Copies share
/// the table. Safe to read from many threads; what it is made of is called from one.
/// \tparam K a CGAL kernel whose numbers convert to double.
template <class K>
class Lipschitz_sizing_3
{
public:
  using FT = typename K::FT;
  using Point = typename K::Point_3;

  /// A size that is asked for at a point.
  struct Source
  {
    Point point;
    double size; ///< in the input's units
  };

  /// The gradation of any field.
  /// \param field callable, point -> size in the input's units; infinite for any.
  /// \param box where it is tabulated; elsewhere the size is that at the nearest point of the box.
  /// \param k growth of the size per unit of distance, >= 0. With 0 the field is the smallest size everywhere.
  /// \throws Option_error for a NaN or a negative number, min_size > max_size, a field that isn't positive, an empty
  /// box,
  ///   or if nothing bounds the size.
  template <class Field>
  Lipschitz_sizing_3(const Field& field, const CGAL::Bbox_3& box, double k,
                     const Gradation_options_3& options = Gradation_options_3())
      : Lipschitz_sizing_3(field, {}, box, k, options)
  {}

  /// The field of sizes at points alone; parameters as above.
  Lipschitz_sizing_3(const std::vector<Source>& sources, const CGAL::Bbox_3& box, double k,
                     const Gradation_options_3& options = Gradation_options_3())
      : Lipschitz_sizing_3([](const Point&) { return std::numeric_limits<double>::infinity(); }, sources, box, k,
                           options)
  {}

  /// Both at once; parameters as above. O(n log n) in sources and cubes.
  template <class Field>
  Lipschitz_sizing_3(const Field& field, const std::vector<Source>& sources, const CGAL::Bbox_3& box, double k,
                     const Gradation_options_3& options = Gradation_options_3())
      : k_(k)
  {
    options.check();
    if (!(k >= 0) || !std::isfinite(k)) throw Option_error("the growth k of a sizing field must be finite and >= 0");
    const auto clamped = [&](double size) { return (std::min)((std::max)(size, options.min_size), options.max_size); };
    std::vector<internal::Size_octree_builder_3::Source> points;
    for (const Source& s : sources) {
      if (!(s.size > 0)) throw Option_error("sizes at points must be positive");
      points.push_back({{CGAL::to_double(s.point.x()), CGAL::to_double(s.point.y()), CGAL::to_double(s.point.z())},
                        clamped(s.size)});
    }
    internal::Octree_limits_3 limits;
    limits.part = options.resolution;
    limits.leaves = options.max_leaves;
    const auto field_at = [&](double x, double y, double z) { return clamped(CGAL::to_double(field(Point(x, y, z)))); };
    tree_ = std::make_shared<const internal::Size_octree_3>(table(field_at, points, box, limits, nullptr));
    if (!points.empty()) { // around those it is coarse still; what matters is by how much sizes change across a cube
      const auto guide = tree_;
      limits.guide_part = limits.part * (std::max)(1., 0.3 / (std::max)(k, 1e-3));
      tree_ = std::make_shared<const internal::Size_octree_3>(table(field_at, points, box, limits, guide.get()));
    }
    smallest_ = std::numeric_limits<double>::infinity();
    for (const auto& leaf : tree_->leaves)
      smallest_ = (std::min)(smallest_, *std::min_element(leaf.begin(), leaf.end()));
  }

  /// Target edge length at `x`.
  FT operator()(const Point& x) const
  {
    return FT((*tree_)(CGAL::to_double(x.x()), CGAL::to_double(x.y()), CGAL::to_double(x.z())));
  }

  double k() const { return k_; }
  /// The smallest size anywhere. By it a mesher knows how near vertices may come.
  double smallest() const { return smallest_; }
  /// Length of the steepest gradient: at most k.
  double max_gradient() const { return tree_->max_gradient(); }
  std::size_t number_of_leaves() const { return tree_->leaves.size(); }

private:
  template <class Field>
  internal::Size_octree_3 table(const Field& field, const std::vector<internal::Size_octree_builder_3::Source>& points,
                                const CGAL::Bbox_3& box, const internal::Octree_limits_3& limits,
                                const internal::Size_octree_3* guide) const
  {
    internal::Size_octree_builder_3 builder(box, field, points, limits, guide);
    internal::Gradient_limiter_3(builder, k_).run();
    if (!std::isfinite(*std::max_element(builder.values.begin(), builder.values.end())))
      throw Option_error("nothing bounds the sizes");
    return builder.tree();
  }

  double k_, smallest_ = 0;
  std::shared_ptr<const internal::Size_octree_3> tree_;
};

} // namespace weft

#endif // WEFT_SIZING_LIPSCHITZ_SIZING_3_H
