// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tetrahedral mesh in the regular triangulation of its points with weights (Tournois 2009, sec. 4.2.3): which cells
// are in the domain when weights have changed, whether its boundary is still there, and which points stand in the way
// if not.

#ifndef WEFT_SPATIAL_SOLVE_REGULAR_MESH_3_H
#define WEFT_SPATIAL_SOLVE_REGULAR_MESH_3_H

#include <weft/internal/as_index.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace weft::internal {

/// Walls are the facets between cells of different subdomains and around the domain. Where they are kept, they bound
/// the subdomains, whatever happens to the cells.
template <class K>
class Regular_mesh_3
{
public:
  using Vertex_base =
      CGAL::Triangulation_vertex_base_with_info_3<std::size_t, K, CGAL::Regular_triangulation_vertex_base_3<K>>;
  using Cell_base = CGAL::Triangulation_cell_base_with_info_3<int, K, CGAL::Regular_triangulation_cell_base_3<K>>;
  using Triangulation = CGAL::Regular_triangulation_3<K, CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>>;
  using Point = typename K::Point_3;
  using Weighted_point = typename K::Weighted_point_3;
  using Cell_handle = typename Triangulation::Cell_handle;
  using Vertex_handle = typename Triangulation::Vertex_handle;

  explicit Regular_mesh_3(const Tetrahedral_mesh_3<K>& mesh) : is_on_wall_(mesh.points.size(), false)
  {
    find_walls(mesh);
  }

  /// Builds the regular triangulation; `info()` of vertices are the numbers of points, that of cells is 0.
  void triangulate(const std::vector<Point>& points, const std::vector<double>& weights)
  {
    std::vector<std::pair<Weighted_point, std::size_t>> weighted;
    weighted.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) weighted.emplace_back(Weighted_point(points[i], weights[i]), i);
    triangulation_.clear();
    triangulation_.insert(weighted.begin(), weighted.end());
    vertices_.assign(points.size(), Vertex_handle());
    for (const Vertex_handle v : triangulation_.finite_vertex_handles()) vertices_[v->info()] = v;
    for (const Cell_handle c : triangulation_.all_cell_handles()) c->info() = 0; // what is infinite stays that
  }

  const Triangulation& triangulation() const { return triangulation_; }
  Vertex_handle vertex(std::size_t point) const { return vertices_[point]; } ///< null where it is hidden
  bool is_on_wall(std::size_t point) const { return is_on_wall_[point]; }

  std::size_t hidden() const ///< number of points without a vertex
  {
    return static_cast<std::size_t>(std::count(vertices_.begin(), vertices_.end(), Vertex_handle()));
  }

  /// Labels all cells by the walls around them.
  /// \returns whether all walls are facets of the triangulation; else labels mean nothing.
  bool label_by_walls()
  {
    std::vector<Cell_handle> front;
    std::size_t found = 0;
    bool is_consistent = true;
    for (auto& w : walls_) w.is_there = false;
    for (const Cell_handle c : triangulation_.all_cell_handles()) c->info() = 0;
    for (const Cell_handle c : triangulation_.finite_cell_handles())
      for (int i = 0; i < 4; ++i) {
        const auto [wall, side] = wall_of(c, i);
        if (!wall) continue;
        if (!wall->is_there) ++found;
        wall->is_there = true;
        const int label = wall->labels[side] + 1; // 0: not seen yet
        if (c->info() == 0) front.push_back(c);
        is_consistent = is_consistent && (c->info() == 0 || c->info() == label);
        c->info() = label;
      }
    if (found < walls_.size() || !is_consistent) return false;
    while (!front.empty()) {
      const Cell_handle c = front.back();
      front.pop_back();
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        if (triangulation_.is_infinite(n) || n->info() == c->info() || wall_of(c, i).first) continue;
        if (n->info() != 0) return false;
        n->info() = c->info();
        front.push_back(n);
      }
    }
    for (const Cell_handle c : triangulation_.finite_cell_handles()) c->info() = (std::max)(c->info() - 1, 0);
    return true;
  }

  /// Remembers a center for each wall: a point whose nearest ones in power distance are those of the wall.
  /// \pre labelled by walls.
  void find_centers()
  {
    for (auto& w : walls_) w.has_center = false;
    for (const Cell_handle c : triangulation_.finite_cell_handles())
      for (int i = 0; i < 4; ++i) {
        const auto [wall, side] = wall_of(c, i);
        if (!wall || (wall->has_center && wall->labels[side] == 0)) continue;
        const Point inner = center(c), p = c->vertex((i + 1) & 3)->point().point();
        const auto toward = [&](int k) { return c->vertex((i + k) & 3)->point().point() - p; };
        auto out = CGAL::cross_product(toward(2), toward(3));
        if (out * toward(0) > 0) out = -out;
        out = out / std::sqrt(CGAL::to_double(out.squared_length()));
        double way = far * std::sqrt(CGAL::to_double(CGAL::squared_distance(inner, p)));
        if (!triangulation_.is_infinite(c->neighbor(i))) // flat cells outside have their centers anywhere
          way = (std::min)(way, CGAL::to_double(out * (center(c->neighbor(i)) - inner)) / 2);
        wall->center = inner + way * out;
        wall->has_center = true;
      }
  }

  /// Calls `visit(point)` for the points of walls that `label_by_walls()` hasn't found, and for what is nearer to their
  /// centers: one of these points has moved since the centers were found.
  template <class Visit>
  void visit_lost_walls(const Visit& visit) const
  {
    for (const Wall& w : walls_) {
      if (w.is_there) continue;
      for (const std::size_t p : w.points) visit(p);
      visit(triangulation_.nearest_power_vertex(w.center, vertices_[w.points[0]]->cell())->info());
    }
  }

  /// The weighted circumcenter of a cell, rounded; computed exactly first where the cell is flat.
  static Point center(Cell_handle c)
  {
    const auto at = [&](int i) { return c->vertex(i)->point(); };
    const auto &a = at(0), &b = at(1), &d = at(2), &e = at(3);
    const auto u = b.point() - a.point(), v = d.point() - a.point(), w = e.point() - a.point();
    const auto vw = CGAL::cross_product(v, w), wu = CGAL::cross_product(w, u), uv = CGAL::cross_product(u, v);
    const double det = CGAL::to_double(u * vw), scale = std::sqrt(CGAL::to_double((u * u) * (v * v) * (w * w)));
    if (!(std::abs(det) > flat * scale)) {
      using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
      const auto exact = [](const Weighted_point& p) {
        return Exact::Weighted_point_3(Exact::Point_3(p.x(), p.y(), p.z()), p.weight());
      };
      const auto result = CGAL::weighted_circumcenter(exact(a), exact(b), exact(d), exact(e));
      return {CGAL::to_double(result.x()), CGAL::to_double(result.y()), CGAL::to_double(result.z())};
    }
    const auto length = [&](const auto& vector, const Weighted_point& p) {
      return vector * vector - p.weight() + a.weight();
    };
    return a.point() + (length(u, b) * vw + length(v, d) * wu + length(w, e) * uv) / (2 * det);
  }

private:
  static constexpr double far = 1;     ///< of a center beyond the convex hull, in circumradii
  static constexpr double flat = 1e-9; ///< a determinant over the lengths of its vectors

  struct Wall
  {
    std::array<std::size_t, 3> points; ///< ascending
    std::array<int, 2> labels;         ///< behind it and before it, see `side()`
    Point center{};
    bool is_there = false, has_center = false;
  };

  /// Facet opposite to corner i of a positively oriented cell: its points ascending, and whether they are
  /// counterclockwise seen from the corner.
  template <class Cell>
  static std::pair<std::array<std::size_t, 3>, std::size_t> facet_of(const Cell& points, std::size_t i)
  {
    std::array<std::size_t, 3> f{points[(i + 1) & 3], points[(i + 2) & 3], points[(i + 3) & 3]};
    std::size_t parity = i & 1;
    const auto order = [&](std::size_t a, std::size_t b) {
      if (f[b] < f[a]) std::swap(f[a], f[b]), parity ^= 1;
    };
    order(0, 1), order(1, 2), order(0, 1);
    return {f, parity};
  }

  void find_walls(const Tetrahedral_mesh_3<K>& mesh)
  {
    struct Side
    {
      std::array<std::size_t, 3> points;
      std::size_t parity;
      int label;
    };
    std::vector<Side> sides;
    sides.reserve(4 * mesh.cells.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [points, parity] = facet_of(mesh.cells[c], i);
        sides.push_back({points, parity, mesh.subdomains.empty() ? 1 : mesh.subdomains[c]});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::pair(a.points, a.parity) < std::pair(b.points, b.parity);
    });
    for (std::size_t k = 0; k < sides.size(); ++k) {
      Wall w{sides[k].points, {0, 0}, Point(0, 0, 0), false, false};
      w.labels[sides[k].parity] = sides[k].label;
      if (k + 1 < sides.size() && sides[k + 1].points == w.points) {
        ++k;
        w.labels[sides[k].parity] = sides[k].label;
      }
      if (w.labels[0] == w.labels[1]) continue;
      for (const std::size_t p : w.points) is_on_wall_[p] = true;
      walls_.push_back(w);
    }
  }

  /// The wall at a facet of a cell and the side on which the cell is; null where there is none.
  std::pair<Wall*, std::size_t> wall_of(Cell_handle c, int i)
  {
    for (int k = 1; k < 4; ++k)
      if (!is_on_wall_[c->vertex((i + k) & 3)->info()]) return {nullptr, 0};
    const std::array<std::size_t, 4> points{c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(),
                                            c->vertex(3)->info()};
    const auto [f, parity] = facet_of(points, as_index(i));
    const auto found = std::lower_bound(walls_.begin(), walls_.end(), f,
                                        [](const Wall& w, const auto& key) { return w.points < key; });
    if (found == walls_.end() || found->points != f) return {nullptr, 0};
    return {&*found, parity};
  }

  Triangulation triangulation_;
  std::vector<Vertex_handle> vertices_; ///< by point
  std::vector<char> is_on_wall_;
  std::vector<Wall> walls_; ///< by points
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SOLVE_REGULAR_MESH_3_H
