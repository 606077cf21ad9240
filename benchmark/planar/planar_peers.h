// SPDX-License-Identifier: GPL-3.0-or-later
//
// What weft is measured against: CGAL's Delaunay refinement with the same sizes, and CGAL's Lloyd iteration after it.
// Also the domain of an input, as both meshers get it, and the sizing fields.

#ifndef WEFT_BENCHMARK_PLANAR_PLANAR_PEERS_H
#define WEFT_BENCHMARK_PLANAR_PLANAR_PEERS_H

#include "planar_inputs.h"
#include "planar_measure.h"

#include <weft/planar/graph/insert_pslg.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/sizing/Lfs_sizing_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

using Weft_cdt = weft::Mesh_triangulation_2<Kernel>;
/// CGAL gets its own bases, which are smaller than weft's.
using Cgal_cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                 CGAL::Delaunay_mesh_face_base_2<Kernel>>>;

/// Angle bound of CGAL's criteria: 20.7 degrees, the largest for which its refinement is known to end.
constexpr double cgal_bound = 0.125;

/// A sizing field that isn't uniform: linear in the distance from a point, or following the local feature size.
class Graded_size
{
public:
  /// factor * (smallest + growth * distance from center)
  Graded_size(Xy center, double smallest, double growth) : center_(center), smallest_(smallest), growth_(growth) {}
  /// factor * the Lipschitz field from the local feature size, which grows by so much per unit of distance
  explicit Graded_size(const Pslg& pslg, double growth = 1)
      : growth_(growth), lfs_(std::make_shared<const weft::Lfs_sizing_2<Kernel>>(pslg, growth))
  {}

  double operator()(const Point& p) const
  {
    return factor * (lfs_ ? (*lfs_)(p) : smallest_ + growth_ * length(center_, {p.x(), p.y()}));
  }
  double operator()(double x, double y) const { return (*this)(Point(x, y)); }

  /// How much the size grows per unit of distance.
  double growth() const { return factor * growth_; }

  double factor = 1;

private:
  Xy center_{0, 0};
  double smallest_ = 0, growth_;
  std::shared_ptr<const weft::Lfs_sizing_2<Kernel>> lfs_;
};

/// An input as both meshers get it.
struct Domain
{
  explicit Domain(const Planar_input& input) : name(input.name), pslg(input.pslg)
  {
    weft::insert_pslg(cgal, pslg);
    weft::mark_domain(cgal, pslg);
    weft::insert_pslg(weft, pslg);
    weft::mark_domain(weft, pslg);
    given = measure(flat_mesh(cgal), [](double, double) { return 1.; });
    smallest_angle = smallest_input_angle(cgal);
  }

  /// Size at which n equilateral triangles of that side would fill the domain.
  double size_for(double n) const { return std::sqrt(given.area / (n * std::sqrt(3.) / 4)); }

  /// Whether most segments of the input are shorter than half the size at their middle.
  template <class Size>
  bool is_finer_than(const Size& size) const
  {
    std::size_t shorter = 0;
    for (const auto& s : pslg.segments) {
      const Xy a{pslg.points[s[0]].x(), pslg.points[s[0]].y()}, b{pslg.points[s[1]].x(), pslg.points[s[1]].y()};
      const Xy half = middle(a, b);
      shorter += length(a, b) < 0.5 * size(half[0], half[1]);
    }
    return 2 * shorter > pslg.segments.size();
  }

  /// Equilateral triangles of the asked sizes that would fill the domain.
  double ideal_triangles(const Graded_size& size) const
  {
    double sum = 0;
    for (const auto f : cgal.finite_face_handles()) {
      if (!f->is_in_domain()) continue;
      std::array<Xy, 3> p;
      for (int i = 0; i < 3; ++i) p[i] = {f->vertex(i)->point().x(), f->vertex(i)->point().y()};
      sum += ideal_triangles(size, p, coarse(size, p), 0);
    }
    return sum;
  }

  std::string name;
  Pslg pslg;
  Cgal_cdt cgal;
  Weft_cdt weft;
  Measures given;        ///< of the input's own triangulation
  double smallest_angle; ///< between constraints, inside

private:
  static double coarse(const Graded_size& size, const std::array<Xy, 3>& p)
  {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const Xy m = middle(p[i], p[(i + 1) % 3]);
      const double s = size(m[0], m[1]);
      sum += 1 / (s * s);
    }
    return std::abs(signed_area(p[0], p[1], p[2])) * sum / 3 / (std::sqrt(3.) / 4);
  }

  /// Adaptive: halves edges until the rule changes by less than a thousandth.
  static double ideal_triangles(const Graded_size& size, const std::array<Xy, 3>& p, double estimate, int depth)
  {
    const Xy a = middle(p[1], p[2]), b = middle(p[2], p[0]), c = middle(p[0], p[1]);
    const std::array<std::array<Xy, 3>, 4> children{{{p[0], c, b}, {p[1], a, c}, {p[2], b, a}, {a, b, c}}};
    std::array<double, 4> estimates;
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += estimates[i] = coarse(size, children[i]);
    if (depth >= 3 && (depth >= 14 || std::abs(sum - estimate) < 1e-3 * sum)) return sum;
    double refined = 0;
    for (int i = 0; i < 4; ++i) refined += ideal_triangles(size, children[i], estimates[i], depth + 1);
    return refined;
  }
};

/// The linear field of the given growth that asks for n ideal triangles. Where even a size of a thousandth of the
/// domain at the center wouldn't ask for as many, the whole field is scaled down.
inline Graded_size linear_size(const Domain& domain, double growth, double n)
{
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const Point& p : domain.pslg.points) {
    x0 = std::min(x0, p.x()), x1 = std::max(x1, p.x());
    y0 = std::min(y0, p.y()), y1 = std::max(y1, p.y());
  }
  const double extent = std::max(x1 - x0, y1 - y0);
  const Xy center{x0 + 0.4 * (x1 - x0), y0 + 0.45 * (y1 - y0)};
  double low = 1e-3 * extent, high = extent;
  Graded_size finest(center, low, growth);
  const double most = domain.ideal_triangles(finest);
  if (most < n) {
    finest.factor = std::sqrt(most / n);
    return finest;
  }
  for (int i = 0; i < 30; ++i) {
    const double trial = std::sqrt(low * high);
    (domain.ideal_triangles(Graded_size(center, trial, growth)) > n ? low : high) = trial;
  }
  return Graded_size(center, low, growth);
}

/// The local feature size times the factor, at most 1, that makes it ask for n ideal triangles.
inline Graded_size lfs_size(const Domain& domain, double n)
{
  Graded_size size(domain.pslg);
  size.factor = std::min(1., std::sqrt(domain.ideal_triangles(size) / n));
  return size;
}

/// Criteria for CGAL's mesher with a sizing field: a face is bad if its longest edge exceeds the size at its centroid,
/// or by the same angle bound as with CGAL's size criteria. Too large faces come first.
template <class Cdt>
class Field_criteria
{
public:
  struct Quality
  {
    double squared_ratio = 0, squared_sine = 1;
    bool operator<(const Quality& other) const
    {
      if (squared_ratio > 1 || other.squared_ratio > 1) return squared_ratio > other.squared_ratio;
      return squared_sine < other.squared_sine;
    }
  };

  class Is_bad
  {
  public:
    explicit Is_bad(const Graded_size& size) : size_(&size) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality& q) const
    {
      if (q.squared_ratio > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return q.squared_sine < cgal_bound ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

    CGAL::Mesh_2::Face_badness operator()(typename Cdt::Face_handle f, Quality& q) const
    {
      const Point &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
      std::array<double, 3> l{CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)};
      std::sort(l.begin(), l.end());
      const double size = (*size_)((a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3);
      const double twice_area = 2 * CGAL::area(a, b, c);
      q.squared_ratio = l[2] / (size * size);
      q.squared_sine = twice_area * twice_area / (l[2] * l[1]); // of the smallest angle
      return (*this)(q);
    }

  private:
    const Graded_size* size_;
  };

  explicit Field_criteria(const Graded_size& size) : size_(&size) {}
  Is_bad is_bad_object() const { return Is_bad(*size_); }

private:
  const Graded_size* size_;
};

template <class Cdt, class Criteria>
void refine_with_criteria(Cdt& cdt, const Criteria& criteria)
{
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, criteria);
  mesher.init(true); // the domain has been marked
  mesher.refine_mesh();
}

/// CGAL's refine_Delaunay_mesh_2() in a triangulation whose domain has been marked.
template <class Cdt>
void refine_with_cgal(Cdt& cdt, double size)
{
  refine_with_criteria(cdt, CGAL::Delaunay_mesh_size_criteria_2<Cdt>(cgal_bound, size));
}
template <class Cdt>
void refine_with_cgal(Cdt& cdt, const Graded_size& size)
{
  refine_with_criteria(cdt, Field_criteria<Cdt>(size));
}

/// A point in each bounded region that isn't in the domain.
template <class Cdt>
std::list<Point> hole_seeds(const Cdt& cdt)
{
  std::list<Point> seeds;
  const auto regions = weft::internal::face_components(cdt);
  std::vector<double> largest(regions.count, -1);
  std::vector<Point> seed(regions.count);
  for (const auto f : cdt.finite_face_handles()) {
    const int region = regions.number[f];
    const double area = cdt.triangle(f).area();
    if (region == 0 || f->is_in_domain() || area <= largest[region]) continue;
    largest[region] = area;
    seed[region] = CGAL::centroid(cdt.triangle(f));
  }
  for (int i = 0; i < regions.count; ++i)
    if (largest[i] > 0) seeds.push_back(seed[i]);
  return seeds;
}

/// CGAL's lloyd_optimize_mesh_2() with its defaults and a number of iterations. Named parameters go by other names in
/// CGAL 5.5 than in 6.0; the function behind them doesn't.
template <class Cdt>
void lloyd_with_cgal(Cdt& cdt, int iterations)
{
  const std::list<Point> seeds = hole_seeds(cdt);
  CGAL::lloyd_optimize_mesh_2_impl(cdt, iterations, 0.001, 0.001, 0, seeds.begin(), seeds.end(), false);
}

} // namespace benchmark

#endif // WEFT_BENCHMARK_PLANAR_PLANAR_PEERS_H
