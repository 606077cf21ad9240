// SPDX-License-Identifier: GPL-3.0-or-later
//
// The domain oracle of an implicit function: the domain is where the function is negative (Tournois 2009, sec.
// 4.2.1.3). Its values, not only their signs, lead to the boundary: a bracketing root finder along segments, Newton
// steps along gradients for projection.

#ifndef WEFT_SPATIAL_DOMAIN_IMPLICIT_ORACLE_3_H
#define WEFT_SPATIAL_DOMAIN_IMPLICIT_ORACLE_3_H

#include <weft/errors.h>
#include <weft/spatial/domain/Domain_by_labels_3.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <sstream>
#include <utility>

namespace weft {

/// The domain where a function is negative.
/// \tparam K a CGAL kernel whose coordinates are doubles.
/// \tparam Function callable, point -> double; if several threads are used, it is called by all of them.
template <class K, class Function>
class Implicit_oracle_3 : public Domain_by_labels_3<Implicit_oracle_3<K, Function>, K>
{
  using Base = Domain_by_labels_3<Implicit_oracle_3<K, Function>, K>;
  using Base::between;
  using Base::diagonal;
  using Base::distance;

public:
  using Point = typename K::Point_3;
  static constexpr bool is_thread_safe = true;

  /// \param bbox contains the domain; what is beyond is cut off.
  /// \param seed_grid number of parts of the box's longest side on which the boundary is looked for; a component
  ///        smaller than a part may be missed.
  /// \throws Domain_error if the function isn't negative anywhere on that grid, or isn't a number somewhere.
  Implicit_oracle_3(Function function, const CGAL::Bbox_3& bbox, int seed_grid = 40, Crease_network_3<K> creases = {})
      : Base(bbox, std::move(creases)), function_(std::move(function))
  {
    Base::find_seeds(seed_grid);
    if (!Base::is_expected(0))
      throw Domain_error("no point of the boundary was found: the domain is empty or too small", {}, {});
  }

  /// \throws Domain_error if the value isn't a number.
  double value(const Point& p) const
  {
    const double value = function_(p);
    if (!std::isnan(value)) return value;
    std::ostringstream where;
    where << "the implicit function isn't a number at (" << p.x() << ", " << p.y() << ", " << p.z() << ")";
    throw Domain_error(where.str(), {}, {});
  }

  int label(const Point& p) const { return value(p) < 0 ? 1 : 0; }
  int patch(int, int, const Point&, const Point&) const { return 0; }
  int number_of_patches() const { return 1; }

  /// Where the sign changes, by the Illinois method (Dowell and Jarratt 1971); by halves where that is slow because the
  /// function jumps, and where the segment leaves the bounding box.
  Surface_hit_3<K> crossing(const Point& p, const Point& q, int at_p, int at_q) const
  {
    if (!Base::is_in_box(p) || !Base::is_in_box(q)) return Base::crossing(p, q, at_p, at_q);
    double s = 0, t = 1, at_s = value(p), at_t = value(q), x = 0;
    const double least = Base::precision * diagonal() / distance(p, q);
    int kept = 0; // the end that stayed in the last step
    for (int k = 0; k < most_steps && t - s > least; ++k) {
      const double last = x;
      x = s + (t - s) * (at_s / (at_s - at_t));
      if (k >= most_secants || !(x > s && x < t)) x = 0.5 * (s + t);
      const double at_x = value(between(p, q, x));
      if (at_x == 0 || (k > 0 && std::abs(x - last) < least)) break;
      if ((at_x < 0) == (at_p == 1)) {
        s = x, at_s = at_x;
        if (kept == 2) at_t *= 0.5;
        kept = 2;
      } else {
        t = x, at_t = at_x;
        if (kept == 1) at_s *= 0.5;
        kept = 1;
      }
    }
    return {between(p, q, x), 0};
  }

private:
  static constexpr int most_secants = 20, most_steps = 70;

  Function function_;
};

} // namespace weft

#endif // WEFT_SPATIAL_DOMAIN_IMPLICIT_ORACLE_3_H
