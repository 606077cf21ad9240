// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bounded Voronoi diagram of a constrained Delaunay triangulation (Tournois 2009, sec. 2.2.2, Alg. 3 and 4; the
// diagram is Seidel's, 1988): the cell of a vertex holds the points of the domain that are nearer to it than to any
// other vertex they see. A *wall* blocks sight: a constrained edge, or an edge between a face of the domain and one
// outside. Works on every CGAL constrained Delaunay triangulation over a CGAL kernel; nothing is stored in its faces.
//
// A face is *blind* when a wall lies between it and its circumcenter; its tag is the first wall that the line of
// sight from the face to the circumcenter meets. Which point of the face the line starts from doesn't matter:
// (1) The hull of a face and its circumcenter c lies, but for the face's corners, inside the open circumdisk. A vertex
//     in there that the face sees would contradict the constrained Delaunay property. So nothing that could make the
//     first wall change lies between two lines of sight.
// (2) If c lies beyond edge g of face f, then f is obtuse opposite g, and all lines of sight leave through g. If g is
//     a wall, it is the tag. Otherwise let f' be the neighbour across g. Its circumcenter lies on the bisector of g
//     at c or farther out, so every wall between f and c also lies between f' and its circumcenter; and by (1),
//     applied to the disk of f', it is the first for both. Hence the tag of f is the tag of f' if P(f, tag of f')
//     holds, and there is none otherwise.
// (3) g is the longest edge of f, so the edges grow along f, f', ...: the faces form trees rooted at walls, which are
//     followed from their roots. Each face is reached from one side only, and no order of the walls matters.
//
// The corners of the cell of v, between two walls at v, come from the sequence of its faces and their tags: a seen
// circumcenter is a corner, and where the tag changes the bisector of the shared edge crosses the old and the new
// tag (by (1) on the segments themselves, never beside them). A wall at v acts as a blind face whose tag it is itself.
// All decisions are exact; only the coordinates of the corners are rounded.

#ifndef WEFT_PLANAR_TRIANGULATION_BOUNDED_VORONOI_DIAGRAM_2_H
#define WEFT_PLANAR_TRIANGULATION_BOUNDED_VORONOI_DIAGRAM_2_H

#include <algorithm>
#include <boost/iterator/filter_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <CGAL/Handle_hash_function.h>
#include <CGAL/iterator.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>
#include <cstddef>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>
#include <weft/planar/triangulation/blind_triangle_2.h>

namespace weft {

/// The domain by default: the faces with `is_in_domain()`, or all finite faces if their type has no such member.
struct Marked_faces_2
{
  template <class Face_handle>
  bool operator()(Face_handle face) const
  {
    return test(*face, 0);
  }

private:
  template <class Face>
  static auto test(const Face& face, int) -> decltype(bool(face.is_in_domain()))
  {
    return face.is_in_domain();
  }
  template <class Face>
  static bool test(const Face&, long)
  {
    return true;
  }
};

/// Bounded Voronoi diagram of a constrained Delaunay triangulation.
///
/// The diagram refers to the triangulation; after any change to that, call `update()`. Const members may be called from
/// several threads at once. Cells are computed when asked for, in time linear in the degree of the vertex.
///
/// A cell consists of one polygon per *wedge*, the sectors into which the walls at a vertex cut its surroundings.
/// Polygons are counterclockwise and star-shaped around the vertex. A *free* vertex, one without walls, has one convex
/// polygon around it. On walls the vertex itself is the first corner of each polygon; at the end of a dangling wall
/// the only polygon wraps around and touches itself along the wall. Where four or more vertices are cocircular a
/// polygon has repeated corners.
///
/// \tparam Cdt a CGAL constrained Delaunay triangulation (also in a Constrained_triangulation_plus_2) over a CGAL
///   kernel.
/// \tparam Domain callable, face handle -> bool; asked about finite faces only.
template <class Cdt, class Domain = Marked_faces_2>
class Bounded_voronoi_diagram_2
{
public:
  using Vertex_handle = typename Cdt::Vertex_handle;
  using Face_handle = typename Cdt::Face_handle;
  using Edge = typename Cdt::Edge;
  using Point = typename Cdt::Point;
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  using FT = typename Kernel::FT;
  using Polygon = std::vector<Point>;

  /// A vertex and the polygons of its cell.
  struct Cell
  {
    Vertex_handle site;
    std::vector<Polygon> polygons;
  };

  /// Tags the faces.
  /// \pre `cdt` is constrained Delaunay with respect to its constrained edges.
  explicit Bounded_voronoi_diagram_2(const Cdt& cdt, Domain domain = Domain()) : cdt_(&cdt), domain_(std::move(domain))
  {
    update();
  }

  const Cdt& triangulation() const { return *cdt_; }

  /// Tags the faces anew after the triangulation or the domain has changed (Alg. 3). Linear.
  void update()
  {
    blinding_edge_.clear();
    if (cdt_->dimension() < 2) return;
    for (auto f = cdt_->finite_faces_begin(); f != cdt_->finite_faces_end(); ++f)
      if (is_in_domain(f))
        for (int i = 0; i < 3; ++i)
          if (is_wall({f, i}) && is_obtuse_opposite(f, i)) tag_faces_behind({f, i});
  }

  /// Whether the face belongs to the domain; infinite faces never do.
  bool is_in_domain(Face_handle face) const { return !cdt_->is_infinite(face) && domain_(face); }

  /// Whether the edge of a face of the domain blocks sight.
  bool is_wall(const Edge& edge) const
  {
    return edge.first->is_constrained(edge.second) || !is_in_domain(edge.first->neighbor(edge.second));
  }

  /// Whether a wall hides the circumcenter of this face of the domain.
  bool is_blind(Face_handle face) const { return blinding_edge(face) != Edge(); }

  /// The first wall between the face and its circumcenter, seen from its near side (the face of the edge lies on
  /// the same side as `face`); a default constructed edge, with a null face handle, when there is none.
  Edge blinding_edge(Face_handle face) const
  {
    if (blinding_edge_.empty()) return Edge();
    const auto found = blinding_edge_.find(face);
    return found == blinding_edge_.end() ? Edge() : found->second;
  }

  /// Whether the vertex belongs to the domain, i.e. has a cell.
  bool has_cell(Vertex_handle vertex) const
  {
    bool found = false;
    for_each_face(vertex, [&](Face_handle f) { found = found || is_in_domain(f); });
    return found;
  }

  /// Whether the vertex lies in the domain and has no walls: its cell is one convex polygon with the vertex inside.
  bool is_free(Vertex_handle vertex) const
  {
    bool free = cdt_->dimension() == 2;
    for_each_face(vertex, [&](Face_handle f) {
      free = free && is_in_domain(f) && !f->is_constrained(cdt_->cw(f->index(vertex)));
    });
    return free;
  }

  /// The polygons of the vertex' cell, counterclockwise by wedge; none for a vertex outside of the domain.
  std::vector<Polygon> cell(Vertex_handle vertex) const
  {
    std::vector<Polygon> polygons;
    if (is_free(vertex)) {
      polygons.emplace_back();
      free_cell(vertex, polygons.back());
    } else {
      for_each_face(vertex, [&](Face_handle f) {
        if (is_in_domain(f) && is_wall(first_edge(f, vertex))) polygons.push_back(wedge_cell(f, vertex));
      });
    }
    return polygons;
  }

  /// The cell of a free vertex (Alg. 4), written to `polygon`, whose memory is reused.
  /// \pre `is_free(vertex)`
  void free_cell(Vertex_handle vertex, Polygon& polygon) const
  {
    polygon.clear();
    const Face_handle start = vertex->face();
    Edge tag = blinding_edge(start);
    Face_handle f = start;
    do {
      const Edge shared = last_edge(f, vertex);
      f = shared.first->neighbor(shared.second);
      tag = add_corners(vertex, shared, tag, blinding_edge(f), polygon);
      if (tag == Edge()) polygon.push_back(circumcenter(f));
    } while (f != start);
  }

  /// The cells of all vertices of the domain, each computed when the iterator is dereferenced, in the order in which
  /// the triangulation stores its vertices (the order of insertion as long as none was removed).
  auto cells() const
  {
    const auto handles = cdt_->finite_vertex_handles();
    const Has_cell has_cell{this};
    const Make_cell make_cell{this};
    return CGAL::make_range(
        boost::make_transform_iterator(boost::make_filter_iterator(has_cell, handles.begin(), handles.end()),
                                       make_cell),
        boost::make_transform_iterator(boost::make_filter_iterator(has_cell, handles.end(), handles.end()), make_cell));
  }

  /// Area of the vertex' cell in squared units of the input; 0 outside of the domain.
  FT area(Vertex_handle vertex) const { return measure(vertex).first; }

  /// Centroid of the vertex' cell; the vertex itself if the cell has no area. It can lie outside of a cell that isn't
  /// convex.
  Point centroid(Vertex_handle vertex) const { return measure(vertex).second; }

  /// The vertex whose cell contains the point: the nearest that it sees; among equally near ones the lexicographically
  /// smallest. A point on a wall sees both sides. A null handle outside of the domain.
  /// \param hint face from which the search for the point starts.
  Vertex_handle locate(const Point& point, Face_handle hint = Face_handle()) const
  {
    if (cdt_->dimension() < 2) return Vertex_handle();
    typename Cdt::Locate_type type;
    int i;
    const Face_handle f = cdt_->locate(point, type, i, hint);
    if (type == Cdt::OUTSIDE_CONVEX_HULL || type == Cdt::OUTSIDE_AFFINE_HULL) return Vertex_handle();
    if (type == Cdt::VERTEX) return has_cell(f->vertex(i)) ? f->vertex(i) : Vertex_handle();

    Vertex_handle nearest;
    if (is_in_domain(f)) find_nearest(point, f, nearest);
    if (type == Cdt::EDGE) {
      const Face_handle other = f->neighbor(i);
      if (is_in_domain(other) && is_wall({other, cdt_->mirror_index(f, i)})) find_nearest(point, other, nearest);
    }
    return nearest;
  }

private:
  struct Has_cell
  {
    const Bounded_voronoi_diagram_2* diagram;
    bool operator()(Vertex_handle v) const { return diagram->has_cell(v); }
  };
  struct Make_cell
  {
    const Bounded_voronoi_diagram_2* diagram;
    Cell operator()(Vertex_handle v) const { return {v, diagram->cell(v)}; }
  };

  /// Follows the tree of the faces that `wall` blinds, from the face at the wall.
  void tag_faces_behind(const Edge& wall)
  {
    std::vector<Face_handle> stack{wall.first};
    while (!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      blinding_edge_.emplace(f, wall);
      for (int i = 0; i < 3; ++i) {
        if (is_wall({f, i})) continue;
        const Face_handle next = f->neighbor(i);
        if (is_obtuse_opposite(next, cdt_->mirror_index(f, i)) && is_blinded_by(next, wall)) stack.push_back(next);
      }
    }
  }

  /// Whether the circumcenter lies strictly beyond edge i of the face.
  bool is_obtuse_opposite(Face_handle f, int i) const
  {
    return cdt_->geom_traits().angle_2_object()(f->vertex(cdt_->cw(i))->point(), f->vertex(i)->point(),
                                                f->vertex(cdt_->ccw(i))->point()) == CGAL::OBTUSE;
  }

  /// Predicate P, for a face on the near side of the wall.
  bool is_blinded_by(Face_handle f, const Edge& wall) const
  {
    return internal::Side_of_circumcenter_2<Kernel>().of_counterclockwise(f->vertex(0)->point(), f->vertex(1)->point(),
                                                                          f->vertex(2)->point(), source(wall),
                                                                          target(wall)) == CGAL::ON_NEGATIVE_SIDE;
  }

  /// Ends of an edge; its face lies to the left.
  const Point& source(const Edge& e) const { return e.first->vertex(cdt_->ccw(e.second))->point(); }
  const Point& target(const Edge& e) const { return e.first->vertex(cdt_->cw(e.second))->point(); }

  /// The edges of the face at the vertex, in counterclockwise order.
  Edge first_edge(Face_handle f, Vertex_handle v) const { return {f, cdt_->cw(f->index(v))}; }
  Edge last_edge(Face_handle f, Vertex_handle v) const { return {f, cdt_->ccw(f->index(v))}; }

  template <class Function>
  void for_each_face(Vertex_handle v, const Function& function) const
  {
    if (cdt_->dimension() < 2) return;
    auto f = cdt_->incident_faces(v);
    const auto end = f;
    do function(f);
    while (++f != end);
  }

  Point circumcenter(Face_handle f) const
  {
    return internal::accurate_circumcenter<Kernel>(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
  }

  /// Adds the corners where the bisector of an edge of the vertex crosses the walls that blind the faces to its
  /// right and left, and returns the latter.
  Edge add_corners(Vertex_handle v, const Edge& shared, const Edge& tag, const Edge& next_tag, Polygon& polygon) const
  {
    if (tag == next_tag) return tag;
    const Point& p = v->point();
    const Point& q = p == source(shared) ? target(shared) : source(shared);
    for (const Edge& wall : {tag, next_tag})
      if (wall != Edge()) polygon.push_back(internal::bisector_on_segment<Kernel>(p, q, source(wall), target(wall)));
    return next_tag;
  }

  /// The cell of the vertex in the wedge which starts at the first edge of face f, a wall.
  Polygon wedge_cell(Face_handle f, Vertex_handle v) const
  {
    Polygon polygon{v->point()};
    Edge shared = first_edge(f, v), tag = shared;
    while (true) {
      tag = add_corners(v, shared, tag, blinding_edge(f), polygon);
      if (tag == Edge()) polygon.push_back(circumcenter(f));
      shared = last_edge(f, v);
      if (is_wall(shared)) break;
      f = f->neighbor(shared.second);
    }
    add_corners(v, shared, tag, shared, polygon);
    return polygon;
  }

  /// Area and centroid of a cell, from triangles around the vertex.
  std::pair<FT, Point> measure(Vertex_handle v) const
  {
    const Point& o = v->point();
    const std::vector<Polygon> polygons = cell(v);
    FT size(0); // all lengths are divided by it, so that their cubes neither overflow nor underflow
    for (const Polygon& polygon : polygons)
      for (const Point& p : polygon)
        size = (std::max)({size, FT(CGAL::abs(p.x() - o.x())), FT(CGAL::abs(p.y() - o.y()))});
    if (!(size > FT(0))) return {FT(0), o};

    FT twice_area(0), x(0), y(0);
    for (const Polygon& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const FT ax = (a.x() - o.x()) / size, ay = (a.y() - o.y()) / size;
        const FT bx = (b.x() - o.x()) / size, by = (b.y() - o.y()) / size;
        const FT weight = ax * by - ay * bx;
        twice_area += weight;
        x += weight * (ax + bx);
        y += weight * (ay + by);
      }
    }
    if (!(twice_area > FT(0))) return {FT(0), o};
    const FT shift = size / (FT(3) * twice_area);
    return {size * twice_area / FT(2) * size, Point(o.x() + x * shift, o.y() + y * shift)};
  }

  /// Replaces `nearest` by the nearest of the vertices that the point sees from face f.
  /// The nearest is joined to the point if that is inserted: it lies on the point's conflict zone, all of whose
  /// vertices the point sees. The zone's faces form a tree.
  void find_nearest(const Point& point, Face_handle f, Vertex_handle& nearest) const
  {
    const auto& traits = cdt_->geom_traits();
    std::vector<std::pair<Face_handle, Face_handle>> stack{{f, Face_handle()}}; // face, where it was reached from
    while (!stack.empty()) {
      const auto [face, from] = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (is_nearer(point, face->vertex(i), nearest)) nearest = face->vertex(i);
        const Face_handle next = face->neighbor(i);
        if (next == from || is_wall({face, i})) continue;
        if (traits.side_of_oriented_circle_2_object()(next->vertex(0)->point(), next->vertex(1)->point(),
                                                      next->vertex(2)->point(), point) == CGAL::ON_POSITIVE_SIDE)
          stack.emplace_back(next, face);
      }
    }
  }

  bool is_nearer(const Point& point, Vertex_handle v, Vertex_handle than) const
  {
    if (than == Vertex_handle()) return true;
    const auto& traits = cdt_->geom_traits();
    const auto order = traits.compare_distance_2_object()(point, v->point(), than->point());
    if (order != CGAL::EQUAL) return order == CGAL::SMALLER;
    return traits.compare_xy_2_object()(v->point(), than->point()) == CGAL::SMALLER; // ties by coordinates
  }

  const Cdt* cdt_;
  Domain domain_;
  std::unordered_map<Face_handle, Edge, CGAL::Handle_hash_function> blinding_edge_; // of blind faces; only looked up
};

} // namespace weft

#endif // WEFT_PLANAR_TRIANGULATION_BOUNDED_VORONOI_DIAGRAM_2_H
