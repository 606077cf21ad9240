// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which Steiner point mends a bad cell or facet of a restricted Delaunay triangulation best. Delaunay refinement takes
// the circumcenter, or the point of the surface farthest from the vertices (Tournois 2009, sec. 3.2.1.4), because that
// guarantees an end, not because it is good: where an edge is just too long, it often leaves the edge where it is, or
// the surface Delaunay ball that it enters has to be split first. Here a few points near by are tried by their conflict
// zones, and the one that removes the most bad elements net of those that it makes is taken. It keeps a distance from
// all vertices that still bounds their number.

#ifndef WEFT_SPATIAL_REFINE_STEINER_CHOOSER_3_H
#define WEFT_SPATIAL_REFINE_STEINER_CHOOSER_3_H

#include <weft/spatial/criteria/Badness_measure_3.h>
#include <weft/spatial/refine/Facet_gain_3.h>
#include <weft/spatial/refine/Steiner_proposals_3.h>
#include <weft/spatial/restricted/Conflict_zone_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Chooses among candidates for Steiner points, and knows which elements a point encroaches upon.
/// \tparam Restricted a Restricted_delaunay_3.
template <class Restricted>
class Steiner_chooser_3
{
public:
  using Point = typename Restricted::Point;
  using Cell_handle = typename Restricted::Cell_handle;
  using Vertex_handle = typename Restricted::Vertex_handle;
  using Zone = typename Restricted::Zone;
  using Restricted_facet = typename Restricted::Restricted_facet;
  using Crease_edge = typename Restricted::Crease_edge;
  using Measure = Badness_measure_3<Restricted>;

  /// \param squared_floor smallest squared distance from a vertex.
  Steiner_chooser_3(const Restricted& mesh, const Measure& measure, double squared_floor)
      : mesh_(mesh), measure_(measure), squared_floor_(squared_floor), gain_of_facets_(mesh, measure)
  {}

  /// To be told of every new facet; cells have their `bad_index()`.
  void set_bad_facet(std::size_t record, bool is_bad) { gain_of_facets_.set_bad_facet(record, is_bad); }

  /// The best Steiner point for a bad cell that encroaches upon nothing.
  /// \param batch zones that touch its claims are off limits.
  /// \returns `found` with the zone of that point; `claimed` if a candidate's zone is off limits; `no_conflict` if
  /// there is no such point.
  Zone_result choose(Cell_handle c, int batch, Zone& zone) const { return choose_by(c, between_claims(batch), zone); }

  /// The same; several threads may ask.
  /// \param find see Steiner_proposals_3.h.
  template <class Find>
  Zone_result choose_by(Cell_handle c, const Find& find, Zone& zone) const
  {
    const std::vector<Point>& points = collect(c);
    const double radius = squared(c->circumcenter(), c->vertex(0)->point());
    Best best;
    for (const Point& p : points)
      if (!consider(p, c, find, radius, zone, best)) return Zone_result::claimed;
    if (best.gain == none) return Zone_result::no_conflict;
    const Point first = best.point;
    for (const Point& p : points)
      if (!consider(CGAL::midpoint(first, p), c, find, radius, zone, best)) return Zone_result::claimed;
    const Zone_result result = find(best.point, c, zone);
    if (result != Zone_result::found || best.point == c->circumcenter()) return result;
    return mesh_.oracle().subdomain(best.point) == c->subdomain() ? result : Zone_result::no_conflict;
  }

  /// The best Steiner point for a facet whose size, shape or distance from the surface is bad.
  /// \returns as above, but that the facet's own Steiner point is always possible.
  Zone_result choose(const Restricted_facet& f, int batch, Zone& zone) const
  {
    return choose_by(f, between_claims(batch), zone);
  }

  template <class Find>
  Zone_result choose_by(const Restricted_facet& f, const Find& look, Zone& zone) const
  {
    Best best{f.steiner, none};
    for (const Point& p : collect(f)) {
      if (p != f.steiner && squared(p, f.steiner) >= 0.96 * f.squared_radius) continue; // the facet might survive
      const Zone_result result = find_by(p, f, look, zone);
      if (result == Zone_result::claimed) return result; // next time, rather than less well
      if (result != Zone_result::found) continue;
      const double nearest = nearest_in(zone);
      if (p != f.steiner && nearest < (std::max)(squared_floor_, least_distance * least_distance * f.squared_radius))
        continue;
      best.take(p, gain_of_facets_(zone, tie(nearest, f.squared_radius), best.gain));
    }
    return find_by(best.point, f, look, zone);
  }

  /// Looks for the zone of a point near a facet from both of its cells.
  Zone_result find(const Point& p, const Restricted_facet& f, int batch, Zone& zone) const
  {
    return find_by(p, f, between_claims(batch), zone);
  }

  template <class Find>
  static Zone_result find_by(const Point& p, const Restricted_facet& f, const Find& find, Zone& zone)
  {
    const Zone_result result = find(p, f.cell, zone);
    return result == Zone_result::no_conflict ? find(p, f.cell->neighbor(f.index), zone) : result;
  }

  /// Squared distance from the point of a zone to the nearest vertex.
  double nearest_in(const Zone& zone) const
  {
    double nearest = HUGE_VAL;
    for (const Cell_handle c : zone.cells)
      for (int i = 0; i < 4; ++i) nearest = (std::min)(nearest, squared(c->vertex(i)->point(), zone.point));
    return nearest;
  }

  /// The facet whose surface Delaunay ball the point of a zone enters deepest, or null; such a ball lies in the
  /// circumballs of the facet's cells, so one of them is in conflict.
  const Restricted_facet* encroached_facet(const Zone& zone) const
  {
    const Restricted_facet* found = nullptr;
    double deepest = 0;
    for (const Cell_handle c : zone.cells)
      for (int i = 0; i < 4; ++i)
        if (const Restricted_facet* f = mesh_.facet(c, i)) {
          const double depth = 1 - squared(zone.point, f->steiner) / f->squared_radius;
          if (depth > deepest) {
            deepest = depth;
            found = f;
          }
        }
    return found;
  }

  /// The same for crease edges: one of the cells around the edge is in conflict.
  const Crease_edge* encroached_edge(const Zone& zone) const
  {
    if (mesh_.creases().number_of_creases() == 0) return nullptr;
    const Crease_edge* found = nullptr;
    double deepest = 0;
    for (const Cell_handle c : zone.cells)
      for (int i = 0; i < 3; ++i) {
        if (!may_end_crease_edge(c->vertex(i))) continue;
        for (int j = i + 1; j < 4; ++j) {
          if (!may_end_crease_edge(c->vertex(j))) continue;
          const Crease_edge* e = mesh_.creases().edge(c->vertex(i), c->vertex(j));
          if (!e) continue;
          const double depth = 1 - squared(zone.point, e->steiner) / e->squared_radius;
          if (depth > deepest) {
            deepest = depth;
            found = e;
          }
        }
      }
    return found;
  }

private:
  Zones_between_claims_3<Restricted> between_claims(int batch) const { return {mesh_.triangulation(), batch}; }

  static bool may_end_crease_edge(Vertex_handle v) { return v->location().dimension >= 0; }

  static constexpr double none = -HUGE_VAL;

  struct Best
  {
    Point point;
    double gain = none;

    void take(const Point& p, double g)
    {
      if (!(g > gain)) return;
      point = p;
      gain = g;
    }
  };

  // ---- candidates

  /// For a cell: the mean circumcenter around each edge that is too long, whose insertion is likely to remove that
  /// edge, and the mean of these; the circumcenters of the cell and its neighbours, and the points halfway.
  const std::vector<Point>& collect(Cell_handle c) const
  {
    std::vector<Point>& points = scratch();
    points.clear();
    const double size = measure_.size(c->circumcenter());
    std::array<double, 3> sum{};
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (squared(c->vertex(i)->point(), c->vertex(j)->point()) <= size * size) continue;
        const Point p = mean_circumcenter(c, i, j);
        points.push_back(p);
        for (int k = 0; k < 3; ++k) sum[static_cast<std::size_t>(k)] += CGAL::to_double(p[k]);
      }
    if (points.size() > 1) {
      const auto n = static_cast<double>(points.size());
      points.emplace_back(sum[0] / n, sum[1] / n, sum[2] / n);
    }
    points.push_back(c->circumcenter());
    for (int i = 0; i < 4; ++i) {
      const Cell_handle n = c->neighbor(i);
      if (!is_beside(n, c)) continue;
      points.push_back(n->circumcenter());
      points.push_back(CGAL::midpoint(c->circumcenter(), n->circumcenter()));
    }
    return points;
  }

  /// For a facet: its own Steiner point, those of its neighbours on the patch, and the points of the patch halfway.
  /// Where finding a point of the patch takes many questions, not the latter.
  const std::vector<Point>& collect(const Restricted_facet& f) const
  {
    std::vector<Point>& points = scratch();
    points.assign(1, f.steiner);
    for (int i = 1; i <= 3; ++i) {
      auto circulator = mesh_.triangulation().incident_facets(f.cell, (f.index + i) % 4, (f.index + i % 3 + 1) % 4);
      const auto first = circulator;
      do {
        const Restricted_facet* g = mesh_.facet(circulator->first, circulator->second);
        if (!g || g == &f || g->patch != f.patch) continue;
        points.push_back(g->steiner);
        if constexpr (!Restricted::Oracle::labels_first) {
          const auto hit = mesh_.oracle().project_on_patch(CGAL::midpoint(f.steiner, g->steiner), f.patch);
          if (hit.patch == f.patch) points.push_back(hit.point);
        }
      } while (++circulator != first);
    }
    return points;
  }

  static std::vector<Point>& scratch()
  {
    thread_local std::vector<Point> points;
    return points;
  }

  static bool is_beside(Cell_handle n, Cell_handle c)
  {
    return !Restricted::is_at_box(n) && n->subdomain() == c->subdomain();
  }

  /// The mean of the circumcenters of the cells around an edge, those in the subdomain of one of them.
  Point mean_circumcenter(Cell_handle c, int i, int j) const
  {
    double x = 0, y = 0, z = 0, n = 0;
    auto circulator = mesh_.triangulation().incident_cells(c, i, j);
    const auto first = circulator;
    do {
      const Cell_handle d = circulator;
      if (!is_beside(d, c)) continue;
      x += CGAL::to_double(d->circumcenter().x());
      y += CGAL::to_double(d->circumcenter().y());
      z += CGAL::to_double(d->circumcenter().z());
      ++n;
    } while (++circulator != first);
    return Point(x / n, y / n, z / n);
  }

  // ---- trying them

  /// Tries a candidate for a cell, moved out of the surface Delaunay balls that it enters: splitting their facets
  /// instead takes more vertices, since nothing was wrong with those. Returns false if it is off limits.
  template <class Find>
  bool consider(Point p, Cell_handle c, const Find& find, double squared_radius, Zone& zone, Best& best) const
  {
    for (int step = 0;; ++step) {
      const Zone_result result = find(p, c, zone);
      if (result == Zone_result::claimed) return false;
      if (result != Zone_result::found) return true;
      const Restricted_facet* f = encroached_facet(zone);
      if (!f) break;
      const double apart = squared(p, f->steiner);
      if (step == 3 || apart == 0) return true;
      p = f->steiner + (1.02 * std::sqrt(f->squared_radius / apart)) * (p - f->steiner);
    }
    const double nearest = nearest_in(zone), least = least_distance_of_cell();
    if (nearest < (std::max)(squared_floor_, least * least * squared_radius) || encroached_edge(zone)) return true;
    best.take(p, gain_of_cells(zone, tie(nearest, squared_radius), best.gain));
    return true;
  }

  /// Part of the circumradius that a Steiner point keeps from all vertices: of a cell of bad shape, that is at least
  /// its shortest edge.
  double least_distance_of_cell() const
  {
    const double shape = measure_.criteria().cell_shape;
    return shape > 0 ? (std::max)(least_distance, 1 / shape) : least_distance;
  }

  /// Prefers the more distant one of equally good points.
  static double tie(double squared_distance, double squared_radius)
  {
    return 0.5 * (std::min)(1.0, std::sqrt(squared_distance / squared_radius));
  }

  /// Bad cells in a zone less those that would fill it, plus what decides between equals; anything up to `least` if it
  /// is less than that.
  double gain_of_cells(const Zone& zone, double gain, double least) const
  {
    for (const Cell_handle c : zone.cells) gain += c->bad_index() >= 0;
    for (const auto& [c, k] : zone.hull) {
      if (gain <= least) return gain;
      gain -= measure_.is_bad_cell(zone.point, c->vertex((k + 1) % 4)->point(), c->vertex((k + 2) % 4)->point(),
                                   c->vertex((k + 3) % 4)->point());
    }
    return gain;
  }

  static double squared(const Point& p, const Point& q) { return CGAL::to_double(CGAL::squared_distance(p, q)); }

  /// Part of the circumradius that a Steiner point keeps from all vertices. 0.4 to 0.7 make no difference.
  static constexpr double least_distance = 0.6;

  const Restricted& mesh_;
  const Measure& measure_;
  double squared_floor_;
  Facet_gain_3<Restricted> gain_of_facets_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_REFINE_STEINER_CHOOSER_3_H
