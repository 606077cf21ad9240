// SPDX-License-Identifier: GPL-3.0-or-later
//
// A domain oracle of one's own that knows its boundary exactly: the unit ball. It has no creases and corners, and one
// patch. doc/concepts/DomainOracle_3.h says what each function has to answer.

#ifndef WEFT_EXAMPLES_CUSTOM_ORACLE_H
#define WEFT_EXAMPLES_CUSTOM_ORACLE_H

#include <weft/spatial/domain/No_folds_3.h>
#include <weft/spatial/domain/oracle_hits_3.h>
#include <weft/spatial/surface/Feature_incidence_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

template <class K>
class Unit_ball : public weft::No_folds_3<K>
{
public:
  using Kernel = K;
  using Point = typename K::Point_3;
  using Hit = weft::Surface_hit_3<K>; // a point of the boundary, and its patch

  static constexpr bool is_thread_safe = true;
  static constexpr bool labels_first = false;

  CGAL::Bbox_3 bbox() const { return CGAL::Bbox_3(-1, -1, -1, 1, 1, 1); }
  int subdomain(const Point& p) const { return radius(p) < 1 ? 1 : 0; }

  int intersect(const Point& p, const Point& q, std::vector<Hit>& hits) const
  {
    // |p + t (q - p)|² = 1, a quadratic equation with the roots (-b ± root) / a
    const auto from = p - Point(0, 0, 0), d = q - p;
    const double a = d * d, b = from * d, discriminant = b * b - a * (from * from - 1);
    const double root = std::sqrt((std::max)(0., discriminant));
    const int change = subdomain(p) ^ subdomain(q);
    if (change != 0) // once, and by no rounding never
      hits.push_back({p + std::clamp((subdomain(p) == 1 ? root - b : -root - b) / a, 0., 1.) * d, 0});
    else if (discriminant > 0 && -b > root && root - b < a) // in and out again
      hits.insert(hits.end(), {{p + (-root - b) / a * d, 0}, {p + (root - b) / a * d, 0}});
    return change;
  }
  Hit closest(const Point& p) const
  {
    const double r = radius(p);
    return r > 0 ? Hit{Point(p.x() / r, p.y() / r, p.z() / r), 0} : Hit{Point(1, 0, 0), 0};
  }
  bool is_within(const Point& p, double squared_distance) const
  {
    return std::abs(radius(p) - 1) <= std::sqrt(squared_distance);
  }
  bool is_clear(const Point& p, double distance) const { return std::abs(radius(p) - 1) > distance; }

  int number_of_patches() const { return 1; }
  bool is_expected(int) const { return true; }
  Hit project_on_patch(const Point& p, int) const { return closest(p); }
  std::vector<Hit> patch_seeds(int, std::size_t n) const // on a spiral
  {
    std::vector<Hit> seeds;
    for (std::size_t i = 0; i < n; ++i) {
      const double k = static_cast<double>(i), z = (2 * k + 1) / static_cast<double>(n) - 1;
      const double s = std::sqrt(1 - z * z), turn = 2.39996322972865332 * k;
      seeds.push_back({Point(s * std::cos(turn), s * std::sin(turn), z), 0});
    }
    return seeds;
  }

  std::size_t number_of_corners() const { return 0; }
  Point corner(std::size_t) const { return Point(); }
  std::size_t number_of_creases() const { return 0; }
  std::vector<Point> crease_points(int) const { return {}; }
  bool crease_is_closed(int) const { return false; }
  Point project_on_crease(const Point& p, int) const { return p; }
  weft::Feature_incidence_3 incidence() const { return {}; }

private:
  static double radius(const Point& p) { return std::sqrt(CGAL::squared_distance(p, Point(0, 0, 0))); }
};

#endif // WEFT_EXAMPLES_CUSTOM_ORACLE_H
