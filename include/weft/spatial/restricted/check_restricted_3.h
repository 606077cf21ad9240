// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether what a restricted Delaunay triangulation keeps agrees with its domain (Tournois 2009, sec. 1.1 and 3.2.1.4):
// every label, Voronoi edge and Voronoi facet is put to the oracle again and compared.
//
// Points are rounded, so not everything can be compared exactly.
//  - Which side of the boundary a circumcenter lies on, and how often and on which patches a Voronoi edge meets the
//    boundary, is decided exactly for the rounded circumcenters that are kept, so these have to agree exactly. The
//    circumcenters themselves are compared with exact ones up to a tolerance.
//  - Steiner points and radii are compared up to a tolerance; where two crossings are farthest, either may be kept.
//  - Which Voronoi facets a crease crosses hangs on rounding where it passes through a Voronoi edge or vertex, or only
//    touches the facet. Such a crossing is ambiguous and may be kept or not; all others have to agree.

#ifndef WEFT_SPATIAL_RESTRICTED_CHECK_RESTRICTED_3_H
#define WEFT_SPATIAL_RESTRICTED_CHECK_RESTRICTED_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/spatial/domain/Polyhedral_oracle_3.h>
#include <weft/spatial/mesh/circumcenter_3.h>
#include <weft/spatial/mesh/Validity_3.h>
#include <weft/spatial/restricted/Crease_tracer_3.h>
#include <weft/spatial/restricted/Restricted_delaunay_3.h>

#include <CGAL/enum.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Recomputes a restricted Delaunay triangulation, simplex by simplex.
template <class Restricted>
class Restricted_checker_3
{
public:
  using Kernel = typename Restricted::Kernel;
  using Point = typename Restricted::Point;
  using Triangulation = typename Restricted::Triangulation;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Surface_hit = typename Restricted::Surface_hit;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Crease_hit = Crease_hit_3<Kernel>;

  explicit Restricted_checker_3(const Restricted& mesh) : mesh_(mesh), tr_(mesh.triangulation())
  {
    const auto b = mesh.oracle().bbox();
    for (const double x : {b.xmin(), b.xmax(), b.ymin(), b.ymax(), b.zmin(), b.zmax()})
      rounding_ = (std::max)(rounding_, 1e-14 * std::abs(x));
    rounding_ += 1e-14 * std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
  }

  // ---- cells

  void check_vertices(Validity_3& validity) const
  {
    for (std::size_t i = 0; i < mesh_.vertices().size(); ++i)
      if (mesh_.vertices()[i]->id() != static_cast<int>(i))
        validity.add(Fault_kind_3::restricted, "a vertex has the wrong number", {i});
    if (tr_.number_of_vertices() != mesh_.vertices().size() + 8)
      validity.add(Fault_kind_3::restricted, "there are vertices beside those listed and the box");
  }

  void check_cell(Cell_handle c, Validity_3& validity) const
  {
    const auto fault = [&](const char* what) { validity.add(Fault_kind_3::restricted, what, ids(c)); };
    if (tr_.is_infinite(c)) {
      if (c->subdomain() != 0) fault("a cell outside of the box is taken for inside");
      return;
    }
    if (!c->is_classified()) return fault("a cell isn't classified");
    const Point center = exact_circumcenter_3<Kernel>(c->vertex(0)->point(), c->vertex(1)->point(),
                                                      c->vertex(2)->point(), c->vertex(3)->point());
    const double radius = distance(center, c->vertex(0)->point());
    if (!(distance(center, c->circumcenter()) <= 1e-5 * radius + rounding_)) fault("a circumcenter is wrong");
    if (c->subdomain() != mesh_.oracle().subdomain(c->circumcenter())) fault("a cell has the wrong label");
    for (int i = 0; i < 4; ++i) {
      const Cell_handle n = c->neighbor(i);
      if (n->neighbor(n->index(c)) != c || tr_.is_infinite(n)) continue;
      const Point& across = n->vertex(n->index(c))->point();
      if (tr_.side_of_sphere(c, across, false) == CGAL::ON_BOUNDED_SIDE) fault("a cell isn't Delaunay");
    }
  }

  // ---- facets

  /// Checks a finite facet and counts it if it is restricted.
  void check_facet(Cell_handle c, int i, std::size_t& restricted, Validity_3& validity) const
  {
    const Cell_handle n = c->neighbor(i);
    const auto fault = [&](const char* what) { validity.add(Fault_kind_3::restricted, what, ids(c, i)); };
    if (tr_.is_infinite(c) || tr_.is_infinite(n)) {
      if (mesh_.facet(c, i) || mesh_.facet(n, n->index(c))) fault("a facet of the hull is kept as restricted");
      return;
    }
    std::vector<Surface_hit> hits;
    const int change = mesh_.oracle().intersect(c->circumcenter(), n->circumcenter(), hits);
    const Restricted_facet* f = mesh_.facet(c, i);
    if (f != mesh_.facet(n, n->index(c))) return fault("the cells of a facet remember different records");
    if (change != (c->subdomain() ^ n->subdomain())) fault("the labels of two cells disagree with the boundary");
    if (!f && !hits.empty()) return fault("a restricted facet is missing");
    if (!f) return;
    ++restricted;
    const bool is_there = (f->cell == c && f->index == i) || (f->cell == n && f->index == n->index(c));
    if (!is_there) return fault("a record belongs to another facet");
    if (hits.empty()) return fault("a facet is kept whose Voronoi edge doesn't meet the boundary");
    check_crossings(*f, hits, fault);
  }

  template <class Fault>
  void check_crossings(const Restricted_facet& f, const std::vector<Surface_hit>& hits, const Fault& fault) const
  {
    const Point& a = f.cell->vertex(f.index == 0 ? 1 : 0)->point();
    double farthest = 0;
    bool several = false, is_crossing = false;
    const double tolerance = tolerance_of(std::sqrt(f.squared_radius));
    for (const Surface_hit& hit : hits) {
      farthest = (std::max)(farthest, distance(hit.point, a));
      several = several || hit.patch != hits.front().patch;
      is_crossing = is_crossing || (hit.patch == f.patch && distance(hit.point, f.steiner) <= tolerance);
    }
    if (f.crossings != static_cast<int>(hits.size())) fault("a facet has the wrong number of crossings");
    if (f.several != several) fault("the patches that a Voronoi edge crosses are wrong");
    if (!is_crossing) fault("a Steiner point isn't where the Voronoi edge meets the patch");
    if (!(std::abs(std::sqrt(f.squared_radius) - farthest) <= tolerance)) fault("a Steiner point isn't the farthest");
  }

  // ---- crease edges

  using Edge_hits = std::map<std::pair<int, int>, std::vector<Crease_hit>>;

  /// By edge, smaller number first, where creases cross its Voronoi facet.
  Edge_hits cross_creases() const
  {
    Edge_hits result;
    for (const auto& e : tr_.finite_edges()) {
      const Vertex_handle a = e.first->vertex(e.second), b = e.first->vertex(e.third);
      if (a->id() < 0 || b->id() < 0) continue;
      std::vector<Crease_hit> hits;
      mesh_.oracle().intersect_creases(a->point(), b->point(), voronoi_facet(e), hits);
      if (!hits.empty()) result[std::minmax(a->id(), b->id())] = std::move(hits);
    }
    return result;
  }

  void check_creases(Validity_3& validity) const
  {
    const Edge_hits recomputed = cross_creases();
    for (const Crease_edge& e : mesh_.creases().edges()) {
      const auto found = recomputed.find(std::minmax(e.source->id(), e.target->id()));
      check_edge(e, found == recomputed.end() ? std::vector<Crease_hit>() : found->second, validity);
    }
    for (const auto& [ends, hits] : recomputed) {
      const Vertex_handle a = vertex(ends.first), b = vertex(ends.second);
      if (!mesh_.creases().edge(a, b) && has_clear_crossing(a, b, hits))
        validity.add(Fault_kind_3::restricted, "a crease edge is missing", ids({a, b}));
    }
    check_visits(validity);
  }

  void check_edge(const Crease_edge& e, const std::vector<Crease_hit>& hits, Validity_3& validity) const
  {
    const auto fault = [&](const char* what) {
      validity.add(Fault_kind_3::restricted, what, ids({e.source, e.target}));
    };
    const double radius = std::sqrt(e.squared_radius), tolerance = tolerance_of(radius);
    if (e.source == e.target) return fault("a crease edge has but one end");
    if (!(std::abs(distance(e.steiner, e.source->point()) - radius) <= tolerance) ||
        !(std::abs(distance(e.steiner, e.target->point()) - radius) <= tolerance))
      fault("the Steiner point of a crease edge isn't halfway between its ends");
    const Point on_crease = mesh_.oracle().project_on_crease(e.steiner, e.steiner_crease);
    if (!(distance(on_crease, e.steiner) <= tolerance)) fault("the Steiner point of a crease edge is off its crease");
    if (!is_clear(e.source, e.target, e.steiner)) return;
    Cell_handle cell;
    int i = 0, j = 0;
    if (!tr_.is_edge(e.source, e.target, cell, i, j)) return fault("a crease edge isn't in the triangulation");
    double farthest = 0;
    bool is_crossing = false, all_are_clear = true;
    for (const Crease_hit& hit : hits) {
      farthest = (std::max)(farthest, distance(hit.point, e.source->point()));
      is_crossing = is_crossing || (hit.crease == e.steiner_crease && distance(hit.point, e.steiner) <= tolerance);
      all_are_clear = all_are_clear && is_clear(e.source, e.target, hit.point);
    }
    if (!is_crossing) fault("the Steiner point of a crease edge isn't where its Voronoi facet meets the crease");
    if (all_are_clear && !(std::abs(farthest - radius) <= tolerance))
      fault("the Steiner point of a crease edge isn't the farthest");
    if (all_are_clear && hits.size() > 1 && !e.is_tangled)
      fault("an edge whose Voronoi facet meets creases more than once isn't marked as such");
  }

  /// Following the creases anew from their beginnings visits the same Voronoi cells, but for stretches near the
  /// bisectors that are shorter than rounding.
  void check_visits(Validity_3& validity) const
  {
    auto anew = mesh_.creases();
    anew.trace_all();
    for (std::size_t c = 0; c < anew.number_of_creases(); ++c) {
      const auto kept = long_visits(mesh_.creases(), c), traced = long_visits(anew, c);
      if (kept != traced)
        validity.add(Fault_kind_3::restricted,
                     "crease " + std::to_string(c) + " isn't followed through the cells that it passes");
    }
  }

private:
  static double distance(const Point& p, const Point& q) { return norm(minus(xyz(p), xyz(q))); }

  double tolerance_of(double length) const { return 1e-6 * length + 100 * rounding_; }

  /// The Voronoi facet of an edge without sides of the length of rounding, whose directions are arbitrary.
  template <class Edge>
  std::vector<Point> voronoi_facet(const Edge& e) const
  {
    const Point& a = e.first->vertex(e.second)->point();
    const auto is_near = [&](const Point& p, const Point& q) { return distance(p, q) <= tolerance_of(distance(p, a)); };
    std::vector<Point> polygon;
    auto c = tr_.incident_cells(e);
    const auto first = c;
    do {
      const Point& p = c->circumcenter();
      if (polygon.empty() || !is_near(polygon.back(), p)) polygon.push_back(p);
    } while (++c != first);
    while (polygon.size() > 1 && is_near(polygon.front(), polygon.back())) polygon.pop_back();
    return polygon;
  }

  Vertex_handle vertex(int id) const { return mesh_.vertices()[static_cast<std::size_t>(id)]; }

  std::vector<std::size_t> ids(std::vector<Vertex_handle> vertices) const
  {
    std::vector<std::size_t> result;
    for (const Vertex_handle v : vertices)
      if (!tr_.is_infinite(v) && v->id() >= 0) result.push_back(static_cast<std::size_t>(v->id()));
    std::sort(result.begin(), result.end());
    return result;
  }
  std::vector<std::size_t> ids(Cell_handle c, int except = -1) const
  {
    std::vector<Vertex_handle> vertices;
    for (int i = 0; i < 4; ++i)
      if (i != except) vertices.push_back(c->vertex(i));
    return ids(vertices);
  }

  /// Whether no third vertex is as near to a crossing as the two whose bisector it lies on, up to rounding.
  bool is_clear(Vertex_handle a, Vertex_handle b, const Point& x) const
  {
    const double d = (std::max)(distance(x, a->point()), distance(x, b->point())), tolerance = tolerance_of(d);
    std::vector<Vertex_handle> around;
    tr_.adjacent_vertices(a, std::back_inserter(around));
    tr_.adjacent_vertices(b, std::back_inserter(around));
    return std::none_of(around.begin(), around.end(), [&](Vertex_handle w) {
      return w != a && w != b && !tr_.is_infinite(w) && distance(x, w->point()) <= d + tolerance;
    });
  }

  /// Whether a crease surely passes from one Voronoi cell to the other at one of the crossings.
  bool has_clear_crossing(Vertex_handle a, Vertex_handle b, const std::vector<Crease_hit>& hits) const
  {
    return std::any_of(hits.begin(), hits.end(),
                       [&](const Crease_hit& hit) { return is_clear(a, b, hit.point) && !is_touching(a, b, hit); });
  }

  /// Whether a crease has a vertex near a crossing, where it may turn back.
  bool is_touching(Vertex_handle a, Vertex_handle, const Crease_hit& hit) const
  {
    const double tolerance = tolerance_of(distance(hit.point, a->point()));
    const auto& points = mesh_.creases().points(static_cast<std::size_t>(hit.crease));
    return std::any_of(points.begin(), points.end(),
                       [&](const Point& p) { return distance(p, hit.point) <= tolerance; });
  }

  /// The cells that a crease stays in for more than a touch, in order, each once in a row.
  std::vector<int> long_visits(const Crease_tracer_3<Triangulation>& tracer, std::size_t crease) const
  {
    std::vector<int> result;
    const auto& visits = tracer.visits(crease);
    for (std::size_t k = 0; k < visits.size(); ++k) {
      const double end =
          k + 1 < visits.size() ? visits[k + 1].begin : static_cast<double>(tracer.points(crease).size() - 1);
      const Point from = tracer.point_at(crease, visits[k].begin), to = tracer.point_at(crease, end);
      const double length = distance(from, to);
      const bool turns = std::floor(end) > std::floor(visits[k].begin); // its ends may be near and the way long
      if (!turns && length <= tolerance_of(distance(from, visits[k].vertex->point()))) continue;
      if (result.empty() || result.back() != visits[k].vertex->id()) result.push_back(visits[k].vertex->id());
    }
    return result;
  }

  const Restricted& mesh_;
  const Triangulation& tr_;
  double rounding_ = 0; ///< of a coordinate, in the input's units
};

} // namespace internal

/// Checks everything that a restricted Delaunay triangulation keeps against what the oracle says now: that it is
/// Delaunay, circumcenters and labels of cells, crossings and Steiner points of facets, crease edges, and that nothing
/// is missing. To be called after `update()`. Vertices of faults are numbered as in `mesh.vertices()`.
/// One oracle query a simplex and a search for every crossing among those of its crease; much slower than meshing.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
Validity_3 check_restricted_3(const Restricted& mesh)
{
  Validity_3 validity;
  const internal::Restricted_checker_3<Restricted> checker(mesh);
  checker.check_vertices(validity);
  if (mesh.vertices().empty()) return validity; // nothing is kept of the bare box
  const auto& tr = mesh.triangulation();
  for (const auto c : tr.all_cell_handles()) checker.check_cell(c, validity);
  std::size_t restricted = 0, kept = 0;
  for (const auto& f : tr.finite_facets()) checker.check_facet(f.first, f.second, restricted, validity);
  for (const auto& f : mesh.facets()) kept += f.cell != typename Restricted::Cell_handle();
  if (kept != restricted)
    validity.add(Fault_kind_3::restricted, "there are records of facets that aren't in the triangulation");
  checker.check_creases(validity);
  return validity;
}

} // namespace weft

#endif // WEFT_SPATIAL_RESTRICTED_CHECK_RESTRICTED_3_H
