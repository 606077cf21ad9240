// SPDX-License-Identifier: GPL-3.0-or-later
//
// First vertices inside of a domain: a triangular lattice in the metric of the sizing field, grown like a crystal.
// From a first point at a long constraint of each room (a part of the domain that no constraint divides) points
// breed neighbors in six directions, one target size away, wherever there is space. Where sizes are uniform this is one
// perfect lattice, and only the layer along the constraints is left to relaxation; where they vary, rows end in
// dislocations, as they must. Holes in a mesh are filled in the same way from their rims. It follows the frontal point
// placement of Rebay (J. Comput. Phys. 106, 1993), inside out.
//
// Why: refinement by circumcenters leaves a glass, whose longest edges are 1.3 times the mean and so cost 1.7 times the
// vertices.

#ifndef WEFT_PLANAR_REFINE_CRYSTAL_SEEDER_2_H
#define WEFT_PLANAR_REFINE_CRYSTAL_SEEDER_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/boxes/Point_quadtree_2.h>
#include <weft/internal/cold.h>
#include <weft/planar/graph/mark_domain.h>
#include <weft/planar/refine/mesh_holes_2.h>
#include <weft/planar/triangulation/blind_triangle_2.h>

#include <CGAL/number_utils.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace weft::internal {

/// Grows lattices through the rooms of a Working_mesh_2 whose constraints have been sampled.
template <class Mesh>
class Crystal_seeder_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// \param spacing lattice spacing in parts of the target edge length.
  Crystal_seeder_2(Mesh& mesh, double spacing) : mesh_(mesh), spacing_(spacing), tree_(make_tree(mesh.bbox()))
  {
    for (const Vertex_handle v : mesh.vertices())
      if (!mesh.is_frozen(v)) occupy(v->point()); // holes are far from those that are
  }

  /// Grows and inserts the points.
  /// \param go_on callable, called now and then with the number of vertices; false stops.
  /// \returns whether growth came to its natural end.
  template <class Go_on>
  bool run(std::size_t max_vertices, const Go_on& go_on)
  {
    directions_.assign(as_index(label_components(mesh_.triangulation())), 0);
    start_at_best_constraints();
    return fill(max_vertices, go_on);
  }

  /// The same in holes of a mesh: parts that hang together of the domain's faces for which `is_open(face)`. Lattices
  /// go on from the vertices around them.
  template <class Is_open, class Go_on>
  bool run_in_holes(const Is_open& is_open, std::size_t max_vertices, const Go_on& go_on)
  {
    directions_.assign(as_index(label_holes_2(mesh_, is_open)), 0);
    start_at_rims();
    start_at_best_constraints();
    return fill(max_vertices, go_on);
  }

private:
  template <class Go_on>
  bool fill(std::size_t max_vertices, const Go_on& go_on)
  {
    // An empty lattice is as good as half of one.
    if (!grow(max_vertices, go_on) || !fill_voids(max_vertices, go_on)) return false;
    // Sorting can't be interrupted, so it goes by parts.
    constexpr std::size_t most_sorted = 1000000;
    for (std::size_t first = 0; first < points_.size(); first += most_sorted)
      if (!insert(first, (std::min)(first + most_sorted, points_.size()), go_on)) return false;
    return true;
  }

  // A lattice point keeps this distance from others, and that from constraints, in parts of the spacing. Between 0.6
  // and 0.8 the first makes no difference to speak of; the second matters only where boundary vertices are far apart.
  static constexpr double clearance = 0.7, wall_clearance = 0.5;

  struct Germ
  {
    Point point;
    Face_handle face;
    double direction;
  };

  static Point_quadtree_2 make_tree(const CGAL::Bbox_2& box)
  {
    const double side = (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    return {box.xmin() - 0.01 * side, box.ymin() - 0.01 * side, 1.02 * side};
  }

  /// Inserts some of the points.
  template <class Go_on>
  bool insert(std::size_t first, std::size_t last, const Go_on& go_on)
  {
    const Triangulation& cdt = mesh_.triangulation();
    const auto begin = points_.begin();
    CGAL::spatial_sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
                       cdt.geom_traits());
    Face_handle hint;
    for (std::size_t i = first; i < last; ++i) {
      if ((i + 1) % 4096 == 0 && !go_on(cdt.number_of_vertices())) return false;
      if (const Vertex_handle v = mesh_.insert_inside(points_[i], hint); v != Vertex_handle()) hint = v->face();
    }
    return true;
  }

  double spacing(const Point& p) const { return spacing_ * mesh_.target(p); }

  void occupy(const Point& p) { tree_.insert(CGAL::to_double(p.x()), CGAL::to_double(p.y()), spacing(p)); }

  /// Takes the place at p if there is space, and queues p for breeding.
  bool settle(const Point& p, Face_handle hint, int room, double direction)
  {
    if (!is_in_box(p)) return false;
    const double h = spacing(p);
    if (tree_.any_within(CGAL::to_double(p.x()), CGAL::to_double(p.y()), clearance * h)) return false;
    const Triangulation& cdt = mesh_.triangulation();
    const Face_handle f = cdt.locate(p, hint);
    if (cdt.is_infinite(f) || f->id() != room || is_near_wall(p, f, wall_clearance * h)) return false;
    occupy(p);
    points_.push_back(p);
    front_.push_back({p, f, direction});
    return true;
  }

  bool is_near_wall(const Point& p, Face_handle f, double distance) const
  {
    const auto near_edge_of = [&](Face_handle g) {
      for (int i = 0; i < 3; ++i)
        if (g->is_constrained(i) &&
            CGAL::to_double(CGAL::squared_distance(p, mesh_.triangulation().segment(g, i))) < distance * distance)
          return true;
      return false;
    };
    return near_edge_of(f) || near_edge_of(f->neighbor(0)) || near_edge_of(f->neighbor(1)) ||
           near_edge_of(f->neighbor(2));
  }

  /// Vertices between a hole and the mesh around it breed in the direction of an edge of that mesh.
  void start_at_rims()
  {
    has_germ_.assign(directions_.size(), false);
    for (const auto& rim : rims_of_holes_2(mesh_)) {
      const auto hole = as_index(rim.face->id());
      if (!has_germ_[hole]) directions_[hole] = rim.direction;
      has_germ_[hole] = true;
      front_.push_back({rim.point, rim.face, rim.direction});
    }
  }

  /// A constrained edge where the lattice of a room may begin.
  struct Start
  {
    Face_handle face;
    int edge = 0;
    std::complex<double> direction; // (unit vector)^6: the same for all directions that the lattice has
    double alignment = 0; // length of the room's boundary that the lattice would follow, less what it would not
    double length = -1, eccentricity = 0, offset = 0; // squares: of the whole constraint; distance of its middle from
                                                      // the room's, and from the edge's
  };

  /// The first point of a room stands above the middle edge of one of its constraints, so that the lattice starts flush
  /// with it. Of the constraints whose direction suits the whole boundary of the room the longest is taken. The longest
  /// one alone would be the back of a comb, with more vertices along its teeth.
  WEFT_COLD void start_at_best_constraints()
  {
    const std::size_t rooms = directions_.size();
    has_germ_.resize(rooms, false);
    std::vector<std::complex<double>> order(rooms); // sum of the directions, weighted by length
    std::vector<double> boundary(rooms, 0), most(rooms, 0);
    std::vector<std::array<double, 2>> middle(rooms, {0, 0});
    std::vector<Start> starts;
    for (const Face_handle f : mesh_.faces())
      for (int i = 0; i < 3; ++i) {
        if (!f->is_constrained(i) || f->id() == no_hole || has_germ_[as_index(f->id())]) continue;
        starts.push_back(start_at(f, i));
        const double length = std::sqrt(mesh_.squared_length(f, i));
        const Point m = middle_of(f, i);
        order[as_index(f->id())] += length * starts.back().direction;
        boundary[as_index(f->id())] += length;
        middle[as_index(f->id())][0] += length * CGAL::to_double(m.x());
        middle[as_index(f->id())][1] += length * CGAL::to_double(m.y());
      }
    for (Start& s : starts) {
      const int room = s.face->id();
      s.alignment = (order[as_index(room)] * std::conj(s.direction)).real();
      most[as_index(room)] = (std::max)(most[as_index(room)], s.alignment);
      const auto& chain = mesh_.chains()[as_index(mesh_.chain_of(s.face, s.edge))];
      const Point center(middle[as_index(room)][0] / boundary[as_index(room)],
                         middle[as_index(room)][1] / boundary[as_index(room)]);
      s.eccentricity =
          CGAL::to_double(CGAL::squared_distance(center, CGAL::midpoint(chain.source->point(), chain.target->point())));
    }
    std::vector<Start> best(rooms);
    for (const Start& s : starts) {
      const int room = s.face->id();
      if (s.alignment >= most[as_index(room)] - 0.05 * boundary[as_index(room)] && is_better(s, best[as_index(room)]))
        best[as_index(room)] = s;
    }
    for (const Start& s : best)
      if (s.length >= 0) start(s);
  }

  /// What is equal up to rounding must not decide, or the mesh would depend on how the input is turned.
  static bool is_better(const Start& s, const Start& t)
  {
    constexpr double tie = 1e-9;
    if (std::abs(s.length - t.length) > tie * s.length) return s.length > t.length;
    if (std::abs(s.eccentricity - t.eccentricity) > tie * s.length) return s.eccentricity > t.eccentricity;
    return s.offset < t.offset - tie * s.length;
  }

  Start start_at(Face_handle f, int i) const
  {
    const auto& chain = mesh_.chains()[as_index(mesh_.chain_of(f, i))];
    const Point &a = chain.source->point(), &b = chain.target->point();
    const std::complex<double> along(CGAL::to_double(b.x() - a.x()), CGAL::to_double(b.y() - a.y())),
        unit = along / std::abs(along);
    Start s;
    s.face = f;
    s.edge = i;
    s.direction = unit * unit * unit * unit * unit * unit;
    s.length = std::norm(along);
    s.offset = CGAL::to_double(CGAL::squared_distance(CGAL::midpoint(a, b), middle_of(f, i)));
    return s;
  }

  Point middle_of(Face_handle f, int i) const
  {
    return CGAL::midpoint(f->vertex(Triangulation::ccw(i))->point(), f->vertex(Triangulation::cw(i))->point());
  }

  void start(const Start& s)
  {
    const Point &a = s.face->vertex(Triangulation::ccw(s.edge))->point(),
                &b = s.face->vertex(Triangulation::cw(s.edge))->point();
    const double dx = CGAL::to_double(b.x() - a.x()), dy = CGAL::to_double(b.y() - a.y());
    const double direction = std::atan2(dy, dx);
    directions_[as_index(s.face->id())] = direction;
    const Point middle = middle_of(s.face, s.edge);
    const double height = std::sqrt(0.75) * spacing(middle) / std::sqrt(dx * dx + dy * dy);
    settle(Point(middle.x() - height * dy, middle.y() + height * dx), s.face, s.face->id(), direction);
  }

  template <class Go_on>
  bool grow(std::size_t max_vertices, const Go_on& go_on)
  {
    const double sixty = std::acos(0.5);
    while (!front_.empty()) {
      const Germ germ = front_.front();
      front_.pop_front();
      const std::size_t n = mesh_.vertices().size() + points_.size();
      if (n >= max_vertices || (++germs_ % 1024 == 0 && !go_on(n))) return false;
      const double h = spacing(germ.point), x = CGAL::to_double(germ.point.x()), y = CGAL::to_double(germ.point.y());
      for (int k = 0; k < 6; ++k) {
        const double c = std::cos(germ.direction + k * sixty), s = std::sin(germ.direction + k * sixty);
        // The size halfway is the edge's own.
        const Point halfway(x + 0.5 * h * c, y + 0.5 * h * s);
        if (!is_in_box(halfway)) continue;
        const double length = mesh_.is_uniform() ? h : spacing(halfway);
        settle(Point(x + length * c, y + length * s), germ.face, germ.face->id(), germ.direction);
      }
    }
    return true;
  }

  /// Starts anew in places that growth could not reach, largest empty circle first.
  template <class Go_on>
  bool fill_voids(std::size_t max_vertices, const Go_on& go_on)
  {
    std::vector<std::pair<double, std::size_t>> voids;
    for (std::size_t i = 0; i < mesh_.faces().size(); ++i) {
      const Face_handle f = mesh_.faces()[i];
      if (f->id() == no_hole) continue;
      const double r = CGAL::to_double(CGAL::squared_distance(center(f), f->vertex(0)->point()));
      voids.emplace_back(-r, i); // ties go to the earlier face
    }
    std::sort(voids.begin(), voids.end());
    std::size_t tried = 0;
    for (const auto& [r, i] : voids) {
      if (++tried % 1024 == 0 && !go_on(mesh_.vertices().size() + points_.size())) return false;
      const Face_handle f = mesh_.faces()[i];
      const Point c = center(f);
      if (!is_in_box(c) || !settle(c, f, f->id(), directions_[as_index(f->id())])) continue;
      if (!grow(max_vertices, go_on)) return false;
    }
    return true;
  }

  Point center(Face_handle f) const
  {
    return accurate_circumcenter<typename Triangulation::Geom_traits>(f->vertex(0)->point(), f->vertex(1)->point(),
                                                                      f->vertex(2)->point());
  }

  bool is_in_box(const Point& p) const
  {
    const CGAL::Bbox_2& b = mesh_.bbox();
    return p.x() >= b.xmin() && p.x() <= b.xmax() && p.y() >= b.ymin() && p.y() <= b.ymax();
  }

  Mesh& mesh_;
  double spacing_;
  Point_quadtree_2 tree_;
  std::vector<double> directions_; // by room
  std::vector<char> has_germ_;     // by room: a rim
  std::vector<Point> points_;
  std::deque<Germ> front_;
  std::size_t germs_ = 0; // that have bred
};

} // namespace weft::internal

#endif // WEFT_PLANAR_REFINE_CRYSTAL_SEEDER_2_H
