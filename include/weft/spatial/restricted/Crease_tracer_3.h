// SPDX-License-Identifier: GPL-3.0-or-later
//
// The crease edges of the restricted Delaunay triangulation: edges whose Voronoi facet meets a crease (Tournois 2009,
// sec. 3.2.1.4). Instead of asking an oracle for every Voronoi facet, the creases are followed through the Voronoi
// cells: along a straight line the squared distance to a vertex less the squared parameter is linear, so the next
// cell is entered where the first of the neighbours' lines gets below. A change of the triangulation spoils only the
// stretches inside the Voronoi cells it changed, and only these are followed again.
//
// Crossing points are rounded; on one straight piece the cells come in the order of their vertices' coordinates along
// it, so following never turns back and always ends.

#ifndef WEFT_SPATIAL_RESTRICTED_CREASE_TRACER_3_H
#define WEFT_SPATIAL_RESTRICTED_CREASE_TRACER_3_H

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace weft::internal {

/// A restricted Delaunay edge.
template <class Triangulation>
struct Crease_edge_3
{
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Point = typename Triangulation::Point;

  Vertex_handle source, target; ///< in the order of the crease
  int crease = -1;              ///< the first that its Voronoi facet meets
  Point steiner;                ///< the farthest of the points where its Voronoi facet meets creases
  int steiner_crease = -1;      ///< on which that lies
  double position = 0;          ///< and where, in straight pieces
  double squared_radius = 0;    ///< squared distance from there to the end points
  bool is_tangled = false;      ///< whether creases meet it, or the cell of one of its ends, more than once
};

/// Follows creases through Voronoi cells. Vertices have to have running ids.
template <class Triangulation>
class Crease_tracer_3
{
public:
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Point = typename Triangulation::Point;
  using Crease_edge = Crease_edge_3<Triangulation>;

  /// A stretch of a crease inside one Voronoi cell; it ends where the next begins. Positions count straight pieces.
  struct Visit
  {
    double begin;
    Vertex_handle vertex;

    bool operator==(const Visit& other) const { return begin == other.begin && vertex == other.vertex; }
    bool operator!=(const Visit& other) const { return !(*this == other); }
  };

  explicit Crease_tracer_3(const Triangulation& tr) : tr_(&tr) {}

  /// After the triangulation has moved in memory.
  void set_triangulation(const Triangulation& tr) { tr_ = &tr; }

  /// \param points of the polyline; that of a cycle repeats the first at its end.
  void add_crease(std::vector<Point> points) { creases_.push_back({std::move(points), {}}); }

  std::size_t number_of_creases() const { return creases_.size(); }
  const std::vector<Point>& points(std::size_t crease) const { return creases_[crease].points; }
  const std::vector<Visit>& visits(std::size_t crease) const { return creases_[crease].visits; }
  const std::vector<Crease_edge>& edges() const { return edges_; }

  /// How many of the edges are first met by a crease.
  std::size_t number_of_edges(std::size_t crease) const { return edges_of_crease_[crease]; }

  /// The restricted edge between two vertices, or null.
  const Crease_edge* edge(Vertex_handle a, Vertex_handle b) const
  {
    const int e = find(a, b);
    return e == none ? nullptr : &edges_[static_cast<std::size_t>(e)];
  }

  /// Follows again what a batch has changed: the stretches in the cells of vertices that `touched` is true of.
  template <class Touched>
  void update(const Touched& touched)
  {
    loaded_ = Vertex_handle();
    bool changed = numbers_are_stale_;
    for (Crease& crease : creases_) changed |= update(crease, touched);
    if (changed) collect_edges();
  }

  /// To be called before a vertex is removed; the stretches in its cell are followed again at the next `update()`,
  /// which has to take all its neighbours as touched.
  void forget(Vertex_handle v)
  {
    for (Crease& crease : creases_)
      for (Visit& visit : crease.visits)
        if (visit.vertex == v) visit.vertex = Vertex_handle();
  }

  /// To be called when a vertex has got another number: the next `update()` looks all edges up anew.
  void renumber() { numbers_are_stale_ = true; }

  /// Follows everything anew.
  void trace_all()
  {
    loaded_ = Vertex_handle();
    for (Crease& crease : creases_) trace(crease);
    collect_edges();
  }

  /// The point of a crease at a position.
  Point point_at(std::size_t crease, double position) const
  {
    const auto& points = creases_[crease].points;
    const std::size_t piece = (std::min)(static_cast<std::size_t>(position), points.size() - 2);
    const double t = position - static_cast<double>(piece);
    if (t <= 0) return points[piece];
    if (t >= 1) return points[piece + 1];
    return points[piece] + t * (points[piece + 1] - points[piece]);
  }

private:
  struct Crease
  {
    std::vector<Point> points;
    std::vector<Visit> visits;

    double end() const { return static_cast<double>(points.size() - 1); }
    bool is_cycle() const { return points.front() == points.back(); }
  };

  static constexpr int none = -1;

  /// Where the list of edges is whose end with the smaller id is that of one of two vertices; corners of the box have
  /// the id -1.
  static std::size_t list_of(Vertex_handle a, Vertex_handle b)
  {
    return static_cast<std::size_t>((std::min)(a->id(), b->id()) + 1);
  }

  int find(Vertex_handle a, Vertex_handle b) const
  {
    const std::size_t list = list_of(a, b);
    int e = list < first_.size() ? first_[list] : none;
    const auto joins = [&](const Crease_edge& x) {
      return (x.source == a && x.target == b) || (x.source == b && x.target == a);
    };
    while (e != none && !joins(edges_[static_cast<std::size_t>(e)])) e = links_[static_cast<std::size_t>(e)].next;
    return e;
  }

  void trace(Crease& crease) const
  {
    crease.visits.assign(1, {0, tr_->nearest_vertex(crease.points.front())});
    follow(crease, crease.end(), Vertex_handle(), crease.visits);
  }

  template <class Touched>
  bool update(Crease& crease, const Touched& touched)
  {
    // The first stretch of a run of touched ones begins where it did: its vertex is no neighbour of one that is gone.
    const auto is_touched = [&](const Visit& v) { return v.vertex == Vertex_handle() || touched(v.vertex); };
    std::vector<Visit>& renewed = renewed_;
    renewed.clear();
    if (crease.visits.empty() || is_touched(crease.visits.front())) {
      crease.visits.swap(renewed);
      trace(crease);
      return renewed != crease.visits;
    }
    if (std::none_of(crease.visits.begin(), crease.visits.end(), is_touched)) return false;
    for (std::size_t i = 0; i < crease.visits.size();) {
      renewed.push_back(crease.visits[i]);
      if (!is_touched(crease.visits[i++])) continue;
      while (i < crease.visits.size() && is_touched(crease.visits[i])) ++i;
      const bool last = i == crease.visits.size();
      follow(crease, last ? crease.end() : crease.visits[i].begin, last ? Vertex_handle() : crease.visits[i].vertex,
             renewed);
    }
    const bool changed = renewed != crease.visits;
    crease.visits.swap(renewed);
    return changed;
  }

  /// Goes on from the last of `visits` to position `end`, or until the cell of `until` is entered.
  void follow(const Crease& crease, double end, Vertex_handle until, std::vector<Visit>& visits) const
  {
    double position = visits.back().begin;
    std::size_t piece = (std::min)(static_cast<std::size_t>(position), crease.points.size() - 2);
    while (position < end) {
      const double piece_end = (std::min)(end, static_cast<double>(piece + 1));
      const auto [next, vertex] = exit(crease, piece, position - static_cast<double>(piece), visits.back().vertex);
      if (vertex == Vertex_handle() || static_cast<double>(piece) + next >= piece_end) {
        position = piece_end;
        ++piece;
        continue;
      }
      if (vertex == until) return;
      position = static_cast<double>(piece) + next;
      visits.push_back({position, vertex});
    }
  }

  /// Where a straight piece leaves the Voronoi cell of `v` after `t`, and into whose cell; a null vertex if it doesn't.
  std::pair<double, Vertex_handle> exit(const Crease& crease, std::size_t piece, double t, Vertex_handle v) const
  {
    const Point &a = crease.points[piece], &b = crease.points[piece + 1], &p = v->point();
    const double dx = b.x() - a.x(), dy = b.y() - a.y(), dz = b.z() - a.z();
    std::pair<double, Vertex_handle> best{2, Vertex_handle()};
    load_neighbours(v);
    for (const auto w : neighbours_) {
      if (tr_->is_infinite(w)) continue;
      const Point& q = w->point();
      const double ux = q.x() - p.x(), uy = q.y() - p.y(), uz = q.z() - p.z();
      const double speed = ux * dx + uy * dy + uz * dz;
      if (speed <= 0) continue; // it recedes
      const double mx = 0.5 * (p.x() + q.x()) - a.x(), my = 0.5 * (p.y() + q.y()) - a.y(),
                   mz = 0.5 * (p.z() + q.z()) - a.z();
      const double s = (std::max)(t, (ux * mx + uy * my + uz * mz) / speed);
      // Where several are entered at once, the one that is approached fastest holds what follows; then the elder.
      if (s < best.first || (s == best.first && precedes(speed, w, best_speed_, best.second))) {
        best = {s, w};
        best_speed_ = speed;
      }
    }
    return best;
  }

  /// Dense creases have many straight pieces in one Voronoi cell.
  void load_neighbours(Vertex_handle v) const
  {
    if (v == loaded_) return;
    loaded_ = v;
    neighbours_.clear();
    tr_->adjacent_vertices(v, std::back_inserter(neighbours_));
  }

  static bool precedes(double speed, Vertex_handle v, double other_speed, Vertex_handle other)
  {
    if (other == Vertex_handle() || speed != other_speed) return other == Vertex_handle() || speed > other_speed;
    return v->id() < other->id();
  }

  void collect_edges()
  {
    for (const Link& link : links_) first_[link.list] = none; // vertices may be gone, and ids others
    edges_.clear();
    links_.clear();
    numbers_are_stale_ = false;
    edges_of_crease_.assign(creases_.size(), 0);
    for (std::size_t c = 0; c < creases_.size(); ++c) {
      const auto& visits = creases_[c].visits;
      const std::size_t first = edges_.size(), begin = first_visit(creases_[c]);
      for (std::size_t k = begin + 1; k < visits.size(); ++k)
        add_crossing(visits[k - 1].vertex, visits[k].vertex, static_cast<int>(c), visits[k].begin);
      // A cycle that begins on the border of two Voronoi cells ends in the one and began in the other.
      if (!visits.empty() && creases_[c].is_cycle() && visits.back().vertex != visits[begin].vertex)
        add_crossing(visits.back().vertex, visits[begin].vertex, static_cast<int>(c), creases_[c].end());
      mark_tangled(visits, begin, first);
    }
  }

  /// Where a cycle begins on a border, the first stretch may be but a point.
  static std::size_t first_visit(const Crease& crease)
  {
    const auto& visits = crease.visits;
    std::size_t k = 0;
    while (crease.is_cycle() && k + 1 < visits.size() && visits[k + 1].begin == visits[k].begin) ++k;
    return k;
  }

  /// A crease passes through the cell of each of its vertices once (topological 1-disk), but for where it closes.
  void mark_tangled(const std::vector<Visit>& visits, std::size_t begin, std::size_t first_edge)
  {
    const bool closes = visits.size() > begin + 1 && visits[begin].vertex == visits.back().vertex;
    const auto count = [this](Vertex_handle v) -> int& {
      const auto k = static_cast<std::size_t>(v->id() + 1); // corners of the box have -1
      if (k >= counts_.size()) counts_.resize(2 * k, 0);
      return counts_[k];
    };
    for (std::size_t k = closes ? begin + 1 : begin; k < visits.size(); ++k) ++count(visits[k].vertex);
    for (std::size_t e = first_edge; e < edges_.size(); ++e)
      edges_[e].is_tangled |= count(edges_[e].source) > 1 || count(edges_[e].target) > 1;
    for (const Visit& visit : visits) count(visit.vertex) = 0;
  }

  void add_crossing(Vertex_handle a, Vertex_handle b, int crease, double position)
  {
    int found = find(a, b);
    const bool is_new = found == none;
    const Point x = point_at(static_cast<std::size_t>(crease), position);
    if (is_new) {
      found = static_cast<int>(edges_.size());
      const std::size_t list = list_of(a, b);
      if (list >= first_.size()) first_.resize(2 * list + 1, none);
      links_.push_back({list, std::exchange(first_[list], found)});
      edges_.push_back({a, b, crease, x, crease, position, 0, false});
      ++edges_of_crease_[static_cast<std::size_t>(crease)];
    }
    Crease_edge& e = edges_[static_cast<std::size_t>(found)];
    const double r = CGAL::to_double(CGAL::squared_distance(x, a->point()));
    if (r > e.squared_radius) {
      e.squared_radius = r;
      e.steiner = x;
      e.steiner_crease = crease;
      e.position = position;
    }
    e.is_tangled |= !is_new;
  }

  /// Where an edge stands in a list, see `list_of()`: after every local change the lists are made anew, for which a
  /// hash table is too slow.
  struct Link
  {
    std::size_t list;
    int next;
  };

  const Triangulation* tr_;
  std::vector<Crease> creases_;
  std::vector<Crease_edge> edges_;
  std::vector<Link> links_; ///< by edge
  std::vector<int> first_;  ///< by list, an edge, or none
  std::vector<std::size_t> edges_of_crease_;
  std::vector<int> counts_;    ///< visits by vertex, zero but while a crease is looked at
  std::vector<Visit> renewed_; ///< scratch
  mutable std::vector<Vertex_handle> neighbours_;
  mutable Vertex_handle loaded_; ///< whose neighbours those are
  mutable double best_speed_ = 0;
  bool numbers_are_stale_ = false; ///< whether ids of vertices have changed since the lists were made
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_CREASE_TRACER_3_H
