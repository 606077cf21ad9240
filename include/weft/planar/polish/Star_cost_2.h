// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the triangles around a vertex would cost if it lay elsewhere. The star is loaded once, since many places are
// tried.

#ifndef WEFT_PLANAR_POLISH_STAR_COST_2_H
#define WEFT_PLANAR_POLISH_STAR_COST_2_H

#include <weft/planar/polish/triangle_cost_2.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Mesh a Working_mesh_2.
template <class Mesh>
class Star_cost_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  explicit Star_cost_2(const Mesh& mesh) : mesh_(mesh) {}

  /// Takes the faces and constrained edges around a vertex.
  /// \returns whether a face is in the domain.
  bool load(Vertex_handle v)
  {
    faces_.clear();
    edges_.clear();
    auto face = mesh_.triangulation().incident_faces(v);
    const auto done = face;
    do {
      const int i = face->index(v);
      if (face->is_constrained(Triangulation::cw(i))) {
        const Point& q = face->vertex(Triangulation::ccw(i))->point();
        const double size = mesh_.size(CGAL::midpoint(v->point(), q));
        edges_.push_back({CGAL::to_double(q.x()), CGAL::to_double(q.y()), size * size});
      }
      if (face->is_in_domain()) faces_.push_back(loaded(face, i));
    } while (++face != done);
    return !faces_.empty();
  }

  /// Cost with the vertex at (x, y). Puts the most expensive face first: it is what rules out most other places.
  double rank(double x, double y)
  {
    double highest = -1;
    for (Face& s : faces_)
      if (const double c = cost(x, y, s); c > highest) {
        highest = c;
        std::swap(s, faces_.front());
      }
    return at(x, y, std::numeric_limits<double>::infinity());
  }

  /// Cost with the vertex at (x, y); gives up where that isn't below `stop`.
  double at(double x, double y, double stop) const
  {
    double sum = 0;
    for (const Face& s : faces_) {
      sum += cost(x, y, s);
      if (sum >= stop) return sum;
    }
    for (const Edge& e : edges_) sum += oversize_2(((x - e.x) * (x - e.x) + (y - e.y) * (y - e.y)) / e.squared_size);
    return sum;
  }

private:
  /// A face around the vertex that moves. Sizes are those before the search: moves are short against the distance in
  /// which sizes change.
  struct Face
  {
    double ax, ay, bx, by;     // the other corners, counterclockwise after the vertex
    double squared_base;       // length of the edge between them
    double squared_size;       // at the centroid
    std::array<bool, 3> given; // see `given_angles_2()`
  };

  /// A constrained edge at the vertex, with the size in its middle.
  struct Edge
  {
    double x, y, squared_size;
  };

  Face loaded(Face_handle f, int i) const
  {
    const Point &a = f->vertex(Triangulation::ccw(i))->point(), &b = f->vertex(Triangulation::cw(i))->point();
    const double ax = CGAL::to_double(a.x()), ay = CGAL::to_double(a.y()), bx = CGAL::to_double(b.x()),
                 by = CGAL::to_double(b.y());
    const double size = mesh_.size(f);
    return {ax, ay, bx, by, (bx - ax) * (bx - ax) + (by - ay) * (by - ay), size * size, given_angles_2(f, i)};
  }

  /// Cost of a face with its vertex at (x, y).
  static double cost(double x, double y, const Face& s)
  {
    const double ax = s.ax - x, ay = s.ay - y, bx = s.bx - x, by = s.by - y;
    return triangle_cost_2(2 * (ax * by - ay * bx), {s.squared_base, bx * bx + by * by, ax * ax + ay * ay}, s.given,
                           s.squared_size);
  }

  const Mesh& mesh_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_POLISH_STAR_COST_2_H
