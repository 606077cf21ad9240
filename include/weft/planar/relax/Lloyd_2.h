// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lloyd's iteration on the bounded Voronoi diagram of a mesh, in the plane for free vertices and along constraints for
// those that lie on one (Tournois 2009, sec. 2.2.2). One pass over the triangles yields all centroids: a triangle
// gives each of its vertices the kite between the vertex, two edge midpoints and the circumcenter, with sign, and the
// kites of a blind triangle are clipped at the constraint that blinds it.
//
// Plain centroids leave a few long edges at the defects of the tessellation, and these few decide how many vertices
// the mesh needs. So the density is multiplied by (sizing ratio of the triangle)^feedback, which draws vertices to
// where edges are too long. On a uniform square with 10k triangles batch refinement needs 1.79 times the ideal number
// of triangles with exponent 0, 1.62 with 2, 1.55 with 3 and 1.60 with 4; from 5 on the iteration oscillates.

#ifndef WEFT_PLANAR_RELAX_LLOYD_2_H
#define WEFT_PLANAR_RELAX_LLOYD_2_H

#include <weft/internal/as_index.h>
#include <weft/internal/parallel_for.h>
#include <weft/planar/relax/quadrature_2.h>
#include <weft/planar/triangulation/Mesh_triangulation_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::internal {

/// Smoother: where each vertex of a Working_mesh_2 wants to be.
template <class Mesh>
class Lloyd_2
{
public:
  using Triangulation = typename Mesh::Triangulation;
  using Point = typename Mesh::Point;
  using Vertex_handle = typename Mesh::Vertex_handle;
  using Face_handle = typename Mesh::Face_handle;

  /// A vertex' wish.
  struct Target
  {
    Point point;
    double move_ratio; ///< length of the move over twice the distance to the farthest corner of the cell
  };

  /// \param feedback exponent of the sizing ratio in the density.
  /// \param quadrature quadrature triangles a cell; up to 12 the density is constant on each triangle of the mesh.
  Lloyd_2(const Mesh& mesh, double feedback, int quadrature, int threads)
      : mesh_(mesh), feedback_(feedback), parts_(mesh.is_uniform() ? 1 : (quadrature + 11) / 12), threads_(threads)
  {}

  /// Computes the cells' moments from the given faces, which must include all faces of the domain around the vertices
  /// whose `target()` is asked for. Linear; the sum runs in the order of `faces` for any number of threads.
  void compute(const std::vector<Face_handle>& faces)
  {
    tag_blind(faces);
    if (!faces.empty()) unit_ = mesh_.target(faces.front()->vertex(0));
    cells_.resize(mesh_.vertices().size());
    if (faces.size() > mesh_.vertices().size())
      cells_.assign(mesh_.vertices().size(), Cell());
    else
      for (const Face_handle f : faces)
        for (int i = 0; i < 3; ++i) cells_[as_index(f->vertex(i)->id())] = Cell();
    if (threads_ <= 1) {
      for (const Face_handle f : faces) add(f, kites(f));
    } else {
      std::vector<std::array<Cell, 3>> parts(faces.size());
      parallel_for(faces.size(), threads_, [&](std::size_t i) { parts[i] = kites(faces[i]); });
      for (std::size_t i = 0; i < faces.size(); ++i) add(faces[i], parts[i]);
    }
    for (const Blind& b : blind_) b.face->set_id(-1);
    blind_.clear();
  }

  /// Where the vertex wants to be: the centroid of its cell, in the plane or along its constraint.
  Target target(Vertex_handle v) const
  {
    const Cell& cell = cells_[as_index(v->id())];
    const double diameter = 2 * std::sqrt(cell.squared_radius);
    Point p = v->point();
    if (v->constraint() >= 0) {
      p = target_on_constraint(v);
    } else if (v->constraint() == free_vertex && cell.moments.mass > 0) {
      // Above an exponent of about 3 the full step overshoots.
      const double step = feedback_ > 3 ? 3 / feedback_ : 1;
      const Xy o = xy(v);
      p = Point(o[0] + step * (cell.moments.x / cell.moments.mass), o[1] + step * (cell.moments.y / cell.moments.mass));
    }
    const double move = std::sqrt(CGAL::to_double(CGAL::squared_distance(p, v->point())));
    return {p, diameter > 0 ? move / diameter : 0};
  }

private:
  using Xy = std::array<double, 2>;

  struct Cell
  {
    Moments_2 moments; // positions relative to the vertex, which keeps digits
    double squared_radius = 0;
  };
  struct Blind
  {
    Face_handle face;
    Xy source, target; // the wall, with the face's side to its left
  };

  static Xy xy(Vertex_handle v) { return {CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y())}; }

  void add(Face_handle f, const std::array<Cell, 3>& kites)
  {
    for (int i = 0; i < 3; ++i) {
      Cell& cell = cells_[as_index(f->vertex(i)->id())];
      cell.moments += kites[as_index(i)].moments;
      cell.squared_radius = (std::max)(cell.squared_radius, kites[as_index(i)].squared_radius);
    }
  }

  /// What the face gives to the cells of its vertices.
  std::array<Cell, 3> kites(Face_handle f) const
  {
    const std::array<Xy, 3> p{xy(f->vertex(0)), xy(f->vertex(1)), xy(f->vertex(2))};
    const Xy center = circumcenter(p);
    const double longest =
        (std::max)({squared_distance(p[0], p[1]), squared_distance(p[1], p[2]), squared_distance(p[2], p[0])});
    std::array<double, 3> s{unit_, unit_, unit_};
    if (!mesh_.is_uniform()) s = {mesh_.target(f->vertex(0)), mesh_.target(f->vertex(1)), mesh_.target(f->vertex(2))};
    const double mean = (s[0] + s[1] + s[2]) / 3;
    const double weight = feedback(longest / (mean * mean)) * graded_density(mean / unit_);
    const Blind* blind = f->id() >= 0 ? &blind_[as_index(f->id())] : nullptr;
    std::array<Cell, 3> result;
    for (unsigned i = 0; i < 3; ++i) {
      const Xy &o = p[i], &q = p[(i + 1) % 3], &r = p[(i + 2) % 3];
      const Xy right{0.5 * (q[0] - o[0]), 0.5 * (q[1] - o[1])}, left{0.5 * (r[0] - o[0]), 0.5 * (r[1] - o[1])};
      const Xy c{center[0] - o[0], center[1] - o[1]};
      const auto density = [&](double x, double y) {
        return weight * relative_density(p, s, mean, o[0] + x, o[1] + y);
      };
      Cell& cell = result[i];
      if (blind) {
        add_clipped(right, c, o, *blind, density, cell);
        add_clipped(c, left, o, *blind, density, cell);
      } else {
        cell.squared_radius = c[0] * c[0] + c[1] * c[1];
        add_triangle(right, c, weight, density, cell);
        add_triangle(c, left, weight, density, cell);
      }
    }
    return result;
  }

  /// With feedback the density needs to follow sizes less than the asymptotic size^-4 of `planar_density()`, which
  /// drains the coarse side of steep gradients, so that refinement has to fill it again.
  double graded_density(double size) const { return feedback_ == 0 ? planar_density(size) : 1 / (size * size * size); }

  double feedback(double squared_ratio) const
  {
    if (feedback_ == 3) return squared_ratio * std::sqrt(squared_ratio);
    return feedback_ == 0 ? 1 : std::pow(squared_ratio, 0.5 * feedback_);
  }

  /// Density of the size interpolated linearly over the face, relative to that of the mean size.
  double relative_density(const std::array<Xy, 3>& p, const std::array<double, 3>& s, double mean, double x,
                          double y) const
  {
    const Xy q{x, y};
    const double area = cross(p[0], p[1], p[2]);
    double size = (cross(q, p[1], p[2]) * s[0] + cross(p[0], q, p[2]) * s[1] + cross(p[0], p[1], q) * s[2]) / area;
    // Kites of obtuse triangles reach outside of the face, where the interpolation must not run wild.
    size = (std::min)((std::max)(size, (std::min)({s[0], s[1], s[2]})), (std::max)({s[0], s[1], s[2]}));
    return graded_density(size / mean);
  }

  /// Adds the triangle between the vertex, at the origin, and a and b.
  template <class Density>
  void add_triangle(const Xy& a, const Xy& b, double weight, const Density& density, Cell& cell) const
  {
    if (parts_ > 1) {
      cell.moments += integrate_triangle(Xy{0, 0}, a, b, parts_, density);
    } else {
      const double m = 0.5 * weight * (a[0] * b[1] - a[1] * b[0]);
      cell.moments.add(m, (a[0] + b[0]) / 3, (a[1] + b[1]) / 3);
    }
  }

  /// The same, of what lies before the wall; positions are relative to o.
  template <class Density>
  void add_clipped(const Xy& a, const Xy& b, const Xy& o, const Blind& wall, const Density& density, Cell& cell) const
  {
    const std::array<Xy, 3> corner{Xy{0, 0}, a, b};
    std::array<double, 3> side;
    for (std::size_t k = 0; k < 3; ++k)
      side[k] = cross(wall.source, wall.target, Xy{o[0] + corner[k][0], o[1] + corner[k][1]});
    std::array<Xy, 4> kept;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (side[k] >= 0) kept[n++] = corner[k];
      if ((side[k] > 0 && side[next] < 0) || (side[k] < 0 && side[next] > 0)) {
        const double t = side[k] / (side[k] - side[next]);
        kept[n++] = {corner[k][0] + t * (corner[next][0] - corner[k][0]),
                     corner[k][1] + t * (corner[next][1] - corner[k][1])};
      }
    }
    for (std::size_t k = 0; k < n; ++k)
      cell.squared_radius = (std::max)(cell.squared_radius, kept[k][0] * kept[k][0] + kept[k][1] * kept[k][1]);
    for (std::size_t k = 1; k + 1 < n; ++k)
      cell.moments += integrate_triangle(kept[0], kept[k], kept[k + 1], parts_, density);
  }

  static Xy circumcenter(const std::array<Xy, 3>& p)
  {
    const double bx = p[1][0] - p[0][0], by = p[1][1] - p[0][1], cx = p[2][0] - p[0][0], cy = p[2][1] - p[0][1];
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 0.5 / (bx * cy - by * cx);
    return {p[0][0] + (cy * b2 - by * c2) * d, p[0][1] + (bx * c2 - cx * b2) * d};
  }

  /// Alg. 3 in plain arithmetic, which is enough here: a wrong tag on a near tie moves a centroid by rounding error.
  /// Leaves the number of its tag as id on each blind face, -1 on the others.
  void tag_blind(const std::vector<Face_handle>& faces)
  {
    for (const Face_handle f : faces) f->set_id(-1);
    for (const Face_handle f : faces)
      for (int i = 0; i < 3; ++i) {
        if (!f->is_constrained(i) || f->id() >= 0) continue;
        const Xy o = xy(f->vertex(i)), a = xy(f->vertex(Triangulation::ccw(i))),
                 b = xy(f->vertex(Triangulation::cw(i)));
        if ((a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]) < 0) tag_behind(f, a, b);
      }
  }

  /// Tags the tree of faces that the wall from a to b blinds, starting with f, which lies to its left.
  void tag_behind(Face_handle f, const Xy& a, const Xy& b)
  {
    std::vector<Face_handle> stack(1, f);
    while (!stack.empty()) {
      const Face_handle face = stack.back();
      stack.pop_back();
      if (face->id() >= 0) continue;
      face->set_id(static_cast<int>(blind_.size()));
      blind_.push_back({face, a, b});
      for (int i = 0; i < 3; ++i) {
        const Face_handle next = face->neighbor(i);
        if (face->is_constrained(i) || next->id() >= 0 || !next->is_in_domain()) continue;
        const Xy c = circumcenter({xy(next->vertex(0)), xy(next->vertex(1)), xy(next->vertex(2))});
        if (cross(a, b, c) < 0) stack.push_back(next);
      }
    }
  }

  Point target_on_constraint(Vertex_handle v) const
  {
    const auto neighbor = mesh_.neighbors_on_constraint(v);
    if (neighbor[0] == Vertex_handle()) return v->point();
    return along_chain(v, neighbor[0], neighbor[1]);
  }

  /// Centroid of the cell of v on its constraint, between the midpoints of its two edges.
  Point along_chain(Vertex_handle v, Vertex_handle before, Vertex_handle after) const
  {
    const auto& chain = mesh_.chains()[as_index(v->constraint())];
    const Xy s = xy(chain.source), t = xy(chain.target), o = xy(v), a = xy(before), b = xy(after);
    Moments_2 moments;
    for (const auto& [end, neighbor] : {std::pair(a, before), std::pair(b, after)}) {
      const double h = mesh_.target(v), k = mesh_.target(neighbor), length = std::sqrt(squared_distance(o, end));
      const auto density = [&](double x, double y) {
        const double f = length > 0 ? std::sqrt(squared_distance(o, Xy{x, y})) / length : 0;
        return linear_density((h + f * (k - h)) / h);
      };
      moments += integrate_segment(o, middle(o, end), 4 * parts_, density);
    }
    if (!(moments.mass > 0)) return v->point();
    // Snapped to the line through the chain's ends, up to rounding.
    const double dx = t[0] - s[0], dy = t[1] - s[1];
    const double f =
        ((moments.x / moments.mass - s[0]) * dx + (moments.y / moments.mass - s[1]) * dy) / (dx * dx + dy * dy);
    return Point(s[0] + f * dx, s[1] + f * dy);
  }

  const Mesh& mesh_;
  double feedback_;
  int parts_, threads_;
  double unit_ = 1;         // a typical size: densities relative to it stay in range
  std::vector<Cell> cells_; // by vertex id
  std::vector<Blind> blind_;
};

} // namespace weft::internal

#endif // WEFT_PLANAR_RELAX_LLOYD_2_H
