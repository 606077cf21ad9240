// SPDX-License-Identifier: GPL-3.0-or-later
//
// How bad the simplices of a restricted Delaunay triangulation are, by every criterion (Tournois 2009, sec. 3.2.1.4,
// "Bad Elements").

#ifndef WEFT_SPATIAL_CRITERIA_BADNESS_MEASURE_3_H
#define WEFT_SPATIAL_CRITERIA_BADNESS_MEASURE_3_H

#include <weft/spatial/criteria/Approximation_multiples.h>
#include <weft/spatial/criteria/Criteria_3.h>
#include <weft/spatial/criteria/forced_elements_3.h>
#include <weft/spatial/restricted/Mesh_triangulation_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace weft::internal {

/// Measures simplices against criteria loosened by a factor, which takes part in sizes, distances and shapes.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Badness_measure_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;

  /// \param sees_ridges whether facets are measured at the ridges and tips that they miss, too.
  Badness_measure_3(const Restricted& mesh, const Criteria_3<Kernel>& criteria, double factor, bool sees_ridges = true)
      : mesh_(&mesh), criteria_(&criteria), factor_(factor), sees_ridges_(sees_ridges)
  {}

  double factor() const { return factor_; }
  bool sees_ridges() const { return sees_ridges_; }
  const Criteria_3<Kernel>& criteria() const { return *criteria_; }

  /// A cell of the domain: size and shape, and what its subdomain or the user asks for.
  Badness_3 cell(Cell_handle c) const
  {
    const auto p = points(c);
    Badness_3 badness = labelled_cell(p, c, true);
    if ((badness.reasons & bad_shape) != 0 && is_forced(*mesh_, c)) badness = labelled_cell(p, c, false);
    if (criteria_->cell_demand && factor_ <= 1)
      badness.add(criteria_->cell_demand({p,
                                          {{c->vertex(0)->location(), c->vertex(1)->location(),
                                            c->vertex(2)->location(), c->vertex(3)->location()}},
                                          &c->circumcenter(),
                                          c->subdomain()}),
                  bad_demand);
    return badness;
  }

  /// Whether a cell violates a bound on its shape that doesn't apply to it, since the input forces its shape.
  bool has_forced_shape(Cell_handle c) const
  {
    return (labelled_cell(points(c), c, true).reasons & bad_shape) != 0 && is_forced(*mesh_, c);
  }

  /// The same for a restricted facet.
  bool has_forced_shape(const typename Restricted::Restricted_facet& f) const
  {
    const Point &a = vertex(f, 1)->point(), &b = vertex(f, 2)->point(), &c = vertex(f, 3)->point();
    const double shortest = (std::min)({squared(a, b), squared(b, c), squared(c, a)});
    return has_forced_shape(f, std::sqrt(facet_squared_radius(a, b, c) / shortest));
  }

  /// A cell that has its circumcenter, but no label yet: size and shape as asked for everywhere.
  Badness_3 unlabelled_cell(Cell_handle c) const
  {
    const auto p = points(c);
    const Badness_3 badness = cell(p, c->circumcenter());
    return (badness.reasons & bad_shape) != 0 && is_forced(*mesh_, c) ? cell(p, c->circumcenter(), false) : badness;
  }

  /// A cell that isn't there yet: size and shape as asked for everywhere.
  Badness_3 cell(const std::array<const Point*, 4>& p, const Point& circumcenter, bool with_shape = true) const
  {
    Badness_3 badness;
    double shortest = -1;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) add_edge(*p[i], *p[j], badness, shortest);
    if (with_shape && criteria_->cell_shape > 0) {
      const double r = squared(circumcenter, *p[0]);
      badness.add(std::sqrt(r / shortest) / (factor_ * criteria_->cell_shape), bad_shape);
    }
    return badness;
  }

  /// Whether a cell that isn't there yet would be bad by that, up to rounding; without square roots.
  bool is_bad_cell(const Point& p, const Point& q, const Point& r, const Point& s) const
  {
    const double a[] = {squared(p, q), squared(p, r), squared(p, s), squared(q, r), squared(q, s), squared(r, s)};
    if (is_too_long(p, q, a[0]) || is_too_long(p, r, a[1]) || is_too_long(p, s, a[2]) || is_too_long(q, r, a[3]) ||
        is_too_long(q, s, a[4]) || is_too_long(r, s, a[5]))
      return true;
    const double ratio = factor_ * criteria_->cell_shape;
    if (ratio == 0) return false;
    const auto u = q - p, v = r - p, w = s - p, vw = CGAL::cross_product(v, w);
    const double det = CGAL::to_double(u * vw);
    const auto center = a[0] * vw + a[1] * CGAL::cross_product(w, u) + a[2] * CGAL::cross_product(u, v);
    return CGAL::to_double(center.squared_length()) >
           4 * det * det * ratio * ratio * *std::min_element(std::begin(a), std::end(a));
  }

  /// The same for a facet, by size and shape.
  bool is_bad_facet(const Point& p, const Point& q, const Point& r) const
  {
    const double pq = squared(p, q), qr = squared(q, r), rp = squared(r, p);
    if (is_too_long(p, q, pq) || is_too_long(q, r, qr) || is_too_long(r, p, rp)) return true;
    const double ratio = factor_ * criteria_->facet_shape;
    return ratio > 0 && facet_squared_radius(p, q, r) > ratio * ratio * (std::min)({pq, qr, rp});
  }

  /// A restricted facet: size, approximation, shape, and topology where it is asked for. A facet that doesn't separate
  /// the domain from the outside lacks a disk.
  Badness_3 facet(const typename Restricted::Restricted_facet& f) const
  {
    Badness_3 badness;
    const Vertex_handle v[] = {vertex(f, 1), vertex(f, 2), vertex(f, 3)};
    double shortest = -1;
    for (int i = 0; i < 3; ++i) add_edge(v[i]->point(), v[(i + 1) % 3]->point(), badness, shortest);
    const double radius = facet_squared_radius(v[0]->point(), v[1]->point(), v[2]->point());
    const auto own = criteria_->patches.find(f.patch);
    const bool has_own = own != criteria_->patches.end();
    const double ratio = std::sqrt(radius / shortest);
    const bool with_shape = !has_forced_shape(f, ratio);
    if (with_shape && criteria_->facet_shape > 0) badness.add(ratio / (factor_ * criteria_->facet_shape), bad_shape);
    if (const double bound = approximation(f.steiner, f.patch); bound > 0) {
      badness.add(approximation_error(f) / bound, bad_approximation);
      if (sees_ridges_ && !badness.is_bad()) badness.add(worst_missed_point(f).ratio, bad_approximation);
    }
    if (has_own) {
      if (own->second.size)
        for (int i = 0; i < 3; ++i) add_edge(v[i]->point(), v[(i + 1) % 3]->point(), own->second.size, badness);
      if (with_shape && own->second.facet_shape > 0)
        badness.add(ratio / (factor_ * own->second.facet_shape), bad_shape);
    }
    if (criteria_->facet_demand && factor_ <= 1)
      badness.add(criteria_->facet_demand({{{&v[0]->point(), &v[1]->point(), &v[2]->point()}},
                                           {{v[0]->location(), v[1]->location(), v[2]->location()}},
                                           &f.steiner,
                                           f.patch}),
                  bad_demand);
    const bool is_astray = std::any_of(v, v + 3, [](Vertex_handle w) { return w->location().dimension > 2; });
    if (is_astray || (criteria_->topology && !on_one_patch(v, f.patch))) badness.add(just_bad, bad_topology);
    if (!mesh_->is_boundary(f)) badness.add(just_bad, bad_disk);
    return badness;
  }

  /// A crease edge: size, approximation, both ends on its crease, and that crease nowhere else near them.
  Badness_3 crease_edge(const typename Restricted::Crease_edge& e) const
  {
    Badness_3 badness;
    double shortest = -1;
    const Point &a = e.source->point(), &b = e.target->point();
    add_edge(a, b, badness, shortest);
    if (criteria_->crease_size) add_edge(a, b, criteria_->crease_size, badness);
    if (const double bound = approximation_on_crease(e.steiner, e.crease); bound > 0)
      badness.add(std::sqrt(squared(CGAL::midpoint(a, b), e.steiner)) / bound, bad_approximation);
    if (!is_on_crease(e.source, e.crease) || !is_on_crease(e.target, e.crease)) badness.add(just_bad, bad_topology);
    if (e.is_tangled) badness.add(just_bad, bad_disk);
    return badness;
  }

  /// Distance from the circumcenter of a facet to its Steiner point, which lies on the axis of the facet: its height
  /// above the facet. The root of the difference of two squared radii would lose half of the digits.
  static double approximation_error(const typename Restricted::Restricted_facet& f)
  {
    const Point &a = vertex(f, 1)->point(), &b = vertex(f, 2)->point(), &c = vertex(f, 3)->point();
    const auto normal = CGAL::cross_product(b - a, c - a);
    const double length = std::sqrt(CGAL::to_double(normal.squared_length()));
    if (!(length > 0)) return std::sqrt(f.squared_radius); // without an area it has no axis
    return std::abs(CGAL::to_double((f.steiner - a) * normal)) / length;
  }

  /// A point of the surface that a facet misses.
  struct Missed_point
  {
    Point point;
    double ratio = 0;      ///< of its distance from the facet to the bound for it
    bool is_vertex = true; ///< whether a vertex there would help
  };

  /// Of the salient points of the surface in the surface Delaunay ball of a facet that project into the facet, the
  /// one that is missed worst: tips, and points of folds. What the Steiner point alone doesn't see, beside the axis of
  /// the facet.
  Missed_point worst_missed_point(const typename Restricted::Restricted_facet& f) const
  {
    Missed_point worst{f.steiner};
    const double bound = approximation(f.steiner, f.patch);
    if (bound == 0) return worst;
    const Point &a = vertex(f, 1)->point(), &b = vertex(f, 2)->point(), &c = vertex(f, 3)->point();
    const Prism prism(a, b, c);
    const auto take = [&](const Point& p, double tolerance, bool is_vertex) {
      if (p == a || p == b || p == c || squared(p, f.steiner) >= f.squared_radius) return;
      const double ratio = prism.height(p) / (tolerance * bound);
      if (ratio > worst.ratio) worst = {p, ratio, is_vertex};
    };
    mesh_->oracle().visit_salient_points(f.steiner, f.squared_radius, f.patch, [&](const Point& p, bool attracts) {
      if (attracts && prism.contains(p)) take(p, Approximation_multiples::tip, true);
    });
    const double least = (std::min)(Approximation_multiples::ridge, Approximation_multiples::sharp_edge) * bound;
    mesh_->oracle().visit_ridges(
        f.steiner, f.squared_radius, f.patch, [&](const Point& p, const Point& q, bool attracts) {
          if (prism.height(p) < least && prism.height(q) < least) return; // it is less in between
          double low = 0, high = 1;
          if (!prism.clip(p, q, low, high)) return;
          for (const double t : {low, high})
            take(p + t * (q - p), attracts ? Approximation_multiples::ridge : Approximation_multiples::sharp_edge,
                 attracts);
        });
    return worst;
  }

  /// Longest edge wanted at a place, loosened like everything else.
  double size(const Point& p) const
  {
    return factor_ * (criteria_->size.is_constant() ? criteria_->size.constant() : criteria_->size(p));
  }

  /// Distance from the surface wanted at a place, loosened likewise; 0: any.
  double approximation(const Point& p) const
  {
    return criteria_->approximation ? factor_ * criteria_->approximation(p) : 0;
  }
  /// On a patch, which may have a bound of its own.
  double approximation(const Point& p, int patch) const
  {
    if (criteria_->patches.empty()) return approximation(p);
    return factor_ * least_bound(criteria_->approximation, criteria_->own_approximation(patch), p);
  }
  /// On a crease: the least of the patches that meet there.
  double approximation_on_crease(const Point& p, int crease) const
  {
    double bound = criteria_->approximation ? criteria_->approximation(p) : 0;
    if (!criteria_->patches.empty())
      bound = criteria_->least_own_approximation(mesh_->incidence().patches_of_crease(crease), p, bound);
    return factor_ * bound;
  }

  /// Vertex i in 1..3 of a restricted facet.
  static Vertex_handle vertex(const typename Restricted::Restricted_facet& f, int i)
  {
    return f.cell->vertex((f.index + i) % 4);
  }

  /// Whether a vertex lies on a crease or is the feature vertex at an end of it.
  bool is_on_crease(Vertex_handle v, int crease) const
  {
    const Vertex_location_3& at = v->location();
    return (at.dimension == 1 && at.index == crease) ||
           (at.dimension == 0 && mesh_->incidence().corner_is_on_crease(at.index, crease));
  }

  /// A ratio for what is bad or not without a measure.
  static constexpr double just_bad = 1.0001;

private:
  static std::array<const Point*, 4> points(Cell_handle c)
  {
    return {{&c->vertex(0)->point(), &c->vertex(1)->point(), &c->vertex(2)->point(), &c->vertex(3)->point()}};
  }

  /// \param ratio of its circumradius to its shortest edge.
  bool has_forced_shape(const typename Restricted::Restricted_facet& f, double ratio) const
  {
    const auto own = criteria_->patches.find(f.patch);
    const double bound = tighter(criteria_->facet_shape, own == criteria_->patches.end() ? 0 : own->second.facet_shape);
    return bound > 0 && ratio > factor_ * bound && is_forced(*mesh_, f, bound);
  }

  /// By what its subdomain asks for, too.
  Badness_3 labelled_cell(const std::array<const Point*, 4>& p, Cell_handle c, bool with_shape) const
  {
    Badness_3 badness = cell(p, c->circumcenter(), with_shape);
    const auto own = criteria_->subdomains.find(c->subdomain());
    if (own != criteria_->subdomains.end()) add_own_criteria(p, c->circumcenter(), own->second, badness, with_shape);
    return badness;
  }

  static double squared(const Point& p, const Point& q) { return CGAL::to_double(CGAL::squared_distance(p, q)); }

  bool is_too_long(const Point& p, const Point& q, double squared_length) const
  {
    const double bound =
        factor_ * (criteria_->size.is_constant() ? criteria_->size.constant() : criteria_->size(CGAL::midpoint(p, q)));
    return squared_length > bound * bound;
  }

  void add_edge(const Point& p, const Point& q, Badness_3& badness, double& shortest) const
  {
    const double length = squared(p, q);
    if (shortest < 0 || length < shortest) shortest = length;
    add_edge(p, q, criteria_->size, badness);
  }

  void add_edge(const Point& p, const Point& q, const Length_field_3<Kernel>& field, Badness_3& badness) const
  {
    const double size = field.is_constant() ? field.constant() : field(CGAL::midpoint(p, q));
    badness.add(std::sqrt(squared(p, q)) / (factor_ * size), bad_size);
  }

  void add_own_criteria(const std::array<const Point*, 4>& p, const Point& circumcenter,
                        const Subdomain_criteria_3<Kernel>& own, Badness_3& badness, bool with_shape) const
  {
    double shortest = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        shortest = (std::min)(shortest, squared(*p[i], *p[j]));
        if (own.size) add_edge(*p[i], *p[j], own.size, badness);
      }
    if (with_shape && own.cell_shape > 0)
      badness.add(std::sqrt(squared(circumcenter, *p[0]) / shortest) / (factor_ * own.cell_shape), bad_shape);
  }

  /// The points that project into a triangle.
  class Prism
  {
  public:
    Prism(const Point& a, const Point& b, const Point& c) : corners_{{a, b, c}}
    {
      normal_ = CGAL::cross_product(b - a, c - a);
      const double length = std::sqrt(CGAL::to_double(normal_.squared_length()));
      if (length > 0) normal_ = normal_ / length;
      for (std::size_t i = 0; i < 3; ++i)
        inward_[i] = CGAL::cross_product(normal_, corners_[(i + 1) % 3] - corners_[i]);
    }

    double height(const Point& p) const { return std::abs(CGAL::to_double((p - corners_[0]) * normal_)); }

    bool contains(const Point& p) const
    {
      for (std::size_t i = 0; i < 3; ++i)
        if ((p - corners_[i]) * inward_[i] < 0) return false;
      return true;
    }

    /// Shortens the stretch of the segment pq between `low` and `high` to what projects into the triangle; returns
    /// whether something is left.
    bool clip(const Point& p, const Point& q, double& low, double& high) const
    {
      for (std::size_t i = 0; i < 3; ++i) {
        const double s = CGAL::to_double((p - corners_[i]) * inward_[i]),
                     t = CGAL::to_double((q - corners_[i]) * inward_[i]);
        if (s < 0 && t < 0) return false;
        if (s < 0) low = (std::max)(low, s / (s - t));
        if (t < 0) high = (std::min)(high, s / (s - t));
      }
      return low <= high;
    }

  private:
    using Vector = typename Kernel::Vector_3;
    std::array<Point, 3> corners_;
    Vector normal_;
    std::array<Vector, 3> inward_;
  };

  static double facet_squared_radius(const Point& a, const Point& b, const Point& c)
  {
    const double ab = squared(a, b), bc = squared(b, c), ca = squared(c, a);
    const auto cross = CGAL::cross_product(b - a, c - a);
    const double area = CGAL::to_double(cross.squared_length()); // four times the squared area
    return area > 0 ? ab * bc * ca / (4 * area) : HUGE_VAL;
  }

  bool on_one_patch(const Vertex_handle (&v)[3], int patch) const
  {
    for (const Vertex_handle w : v)
      if (!mesh_->incidence().is_on_patch(w->location(), patch)) return false;
    return true;
  }

  const Restricted* mesh_;
  const Criteria_3<Kernel>* criteria_;
  double factor_;
  bool sees_ridges_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_CRITERIA_BADNESS_MEASURE_3_H
