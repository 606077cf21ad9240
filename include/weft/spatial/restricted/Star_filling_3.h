// SPDX-License-Identifier: GPL-3.0-or-later
//
// What fills the place of a vertex of a spatial Delaunay triangulation that is taken away: the cells between its
// neighbours, found from facet to facet like paper around a gift, without changing the triangulation. The sphere
// through a facet and the vertex of its next cell is the first that meets a neighbour while spheres through the facet
// grow inwards. Doubles tell which one that is, with a bound on what rounding does to them; where they can't, exact
// predicates and the symbolic perturbation of the triangulation decide. So it is the only filling that is Delaunay.
//
// The new cells lie in memory of this object, and know their neighbours, old and new ones; the old ones don't know
// them. What looks from a cell outwards, such as Cell_classifier_3, can look at them as if they were there already.

#ifndef WEFT_SPATIAL_RESTRICTED_STAR_FILLING_3_H
#define WEFT_SPATIAL_RESTRICTED_STAR_FILLING_3_H

#include <weft/internal/boxes/nearest_point_3.h>

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

namespace weft::internal {

/// \tparam Triangulation a CGAL Delaunay_triangulation_3 whose vertices have `id()`, and whose cells have it, too.
template <class Triangulation>
class Star_filling_3
{
public:
  using Point = typename Triangulation::Point;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  /// Finds the cells; false where the vertex has so many neighbours that other ways to remove it are faster. Quadratic
  /// in the number of neighbours.
  /// \param star the cells around a vertex, none of which is infinite.
  bool find(const Triangulation& tr, Vertex_handle v, const std::vector<Cell_handle>& star)
  {
    cells_.clear();
    hull_.clear();
    sides_.clear();
    keys_.clear();
    points_.clear();
    neighbours_.clear();
    box_.clear();
    table_.assign(least_table, -1);
    for (const Cell_handle c : star) {
      const int i = c->index(v);
      const Cell_handle outer = c->neighbor(i);
      const auto t = triple(i);
      const Numbers corners{number(c->vertex(t[0])), number(c->vertex(t[1])), number(c->vertex(t[2]))};
      if (neighbours_.size() > most_neighbours) return false;
      hull_.push_back({Cell_handle(), 0, outer, outer->index(c)});
      add_side({corners, Cell_handle(), static_cast<int>(hull_.size()) - 1, false});
    }
    for (std::size_t k = 0; k < sides_.size(); ++k)
      if (!sides_[k].is_closed) add_cell(tr, k);
    return true;
  }

  /// The cells found, numbered by `id()`. They are valid until the next call of `find()`.
  const std::vector<Cell_handle>& cells() const { return cells_; }

  /// The neighbours of the vertex.
  const std::vector<Vertex_handle>& neighbours() const { return neighbours_; }

  /// The facet between one of these cells and one around the star, seen from both.
  struct Hull_facet
  {
    Cell_handle inner;
    int inner_index;
    Cell_handle outer;
    int outer_index;
  };
  /// In the order of the star's cells, each of which had one of them.
  const std::vector<Hull_facet>& hull() const { return hull_; }

  /// Puts the cells in the place of the vertex.
  /// \param star as in `find()`.
  /// \param made gets the cells in the triangulation, in the order of `cells()`.
  void replace(Triangulation& tr, Vertex_handle v, const std::vector<Cell_handle>& star, std::vector<Cell_handle>& made)
  {
    auto& tds = tr.tds();
    made.clear();
    for (const Cell_handle c : cells_)
      made.push_back(tds.create_cell(c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)));
    for (std::size_t k = 0; k < cells_.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        made[k]->vertex(i)->set_cell(made[k]);
        if (!is_outer_[k][static_cast<std::size_t>(i)])
          made[k]->set_neighbor(i, made[static_cast<std::size_t>(cells_[k]->neighbor(i)->id())]);
      }
    for (const Hull_facet& f : hull_) {
      const Cell_handle inner = made[static_cast<std::size_t>(f.inner->id())];
      inner->set_neighbor(f.inner_index, f.outer);
      f.outer->set_neighbor(f.outer_index, inner);
    }
    tds.delete_cells(star.begin(), star.end());
    tds.delete_vertex(v);
  }

private:
  using Numbers = std::array<int, 3>;
  using Cell = typename Triangulation::Triangulation_data_structure::Cell;
  using Cell_range = typename Triangulation::Triangulation_data_structure::Cell_range;

  /// A facet with one cell so far.
  struct Side
  {
    Numbers corners;  ///< in positive orientation seen with what is missing
    Cell_handle cell; ///< new; null for an old one
    int index;        ///< of the facet in the cell; of the facet in `hull_` for an old one
    bool is_closed;
  };

  /// The corners of the facet opposite to corner i of a cell, in positive orientation with corner i as the fourth.
  static const Numbers& triple(int i)
  {
    static constexpr std::array<Numbers, 4> triples{{{{1, 3, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{0, 1, 2}}}};
    return triples[static_cast<std::size_t>(i)];
  }

  /// The number of a vertex among the neighbours.
  int number(Vertex_handle v)
  {
    int* known = nullptr;
    if (v->id() >= 0) {
      const auto id = static_cast<std::size_t>(v->id());
      if (id >= by_id_.size()) by_id_.resize(2 * id + 1, -1);
      known = &by_id_[id];
      const auto k = static_cast<std::size_t>(*known);
      if (*known >= 0 && k < neighbours_.size() && neighbours_[k] == v) return *known;
    } else { // corners of the box
      for (const auto& [corner, n] : box_)
        if (corner == v) return n;
    }
    const int next = static_cast<int>(neighbours_.size());
    if (known)
      *known = next;
    else
      box_.emplace_back(v, next);
    neighbours_.push_back(v);
    points_.push_back(xyz(v->point()));
    return next;
  }

  static std::uint64_t key(const Numbers& corners)
  {
    auto [a, b, c] = corners;
    if (b < a) std::swap(a, b);
    if (c < b) std::swap(b, c);
    if (b < a) std::swap(a, b);
    return static_cast<std::uint64_t>(a) | static_cast<std::uint64_t>(b) << 20 | static_cast<std::uint64_t>(c) << 40;
  }

  /// Where a facet is, or would be, in the table.
  std::size_t place(std::uint64_t facet) const
  {
    std::size_t at = (facet * 0x9e3779b97f4a7c15u) >> 32 & (table_.size() - 1);
    while (table_[at] >= 0 && keys_[static_cast<std::size_t>(table_[at])] != facet) at = (at + 1) & (table_.size() - 1);
    return at;
  }

  void add_side(const Side& side)
  {
    if (2 * (sides_.size() + 1) > table_.size()) {
      table_.assign(2 * table_.size(), -1);
      for (std::size_t k = 0; k < sides_.size(); ++k) table_[place(keys_[k])] = static_cast<int>(k);
    }
    keys_.push_back(key(side.corners));
    table_[place(keys_.back())] = static_cast<int>(sides_.size());
    sides_.push_back(side);
  }

  /// A new cell at a facet, joined to those that it meets.
  void add_cell(const Triangulation& tr, std::size_t side)
  {
    const Numbers base = sides_[side].corners;
    const std::array<int, 4> corners{base[0], base[1], base[2], apex(tr, base)};
    if (cells_.size() == memory_.size()) memory_.emplace_back();
    const Cell_handle c = Cell_range::s_iterator_to(memory_[cells_.size()]);
    c->set_id(static_cast<int>(cells_.size()));
    c->set_classified(false);
    for (int i = 0; i < 4; ++i) {
      c->set_vertex(i, neighbours_[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])]);
      c->set_facet_record(i, -1);
    }
    if (is_outer_.size() <= cells_.size()) is_outer_.emplace_back();
    cells_.push_back(c);
    join(c, 3, sides_[side]);
    for (int i = 0; i < 3; ++i) {
      const auto t = triple(i);
      const auto at = [&](std::size_t k) { return corners[static_cast<std::size_t>(t[k])]; };
      const Numbers facet{at(0), at(1), at(2)};
      const int known = table_[place(key(facet))];
      if (known >= 0)
        join(c, i, sides_[static_cast<std::size_t>(known)]);
      else
        add_side({{facet[1], facet[0], facet[2]}, c, i, false});
    }
  }

  void join(Cell_handle c, int i, Side& side)
  {
    side.is_closed = true;
    const bool is_outer = side.cell == Cell_handle();
    is_outer_[static_cast<std::size_t>(c->id())][static_cast<std::size_t>(i)] = is_outer;
    if (is_outer) {
      Hull_facet& f = hull_[static_cast<std::size_t>(side.index)];
      f.inner = c;
      f.inner_index = i;
      c->set_neighbor(i, f.outer);
    } else {
      is_outer_[static_cast<std::size_t>(side.cell->id())][static_cast<std::size_t>(side.index)] = false;
      c->set_neighbor(i, side.cell);
      side.cell->set_neighbor(side.index, c);
    }
  }

  /// The neighbour that makes a Delaunay cell with a facet.
  ///
  /// The centers of spheres through the facet abc lie on its axis. That of the sphere through d is above the
  /// circumcenter o of the facet by t = (|d|^2 - 2 o d) / (2 n d) normals n, with a as the origin.
  int apex(const Triangulation& tr, const Numbers& base)
  {
    const auto at = [this](int k) -> const Xyz_3& { return points_[static_cast<std::size_t>(k)]; };
    const Xyz_3& a = at(base[0]);
    const Xyz_3 u = minus(at(base[1]), a), w = minus(at(base[2]), a), n = cross_product(u, w);
    const Xyz_3 wn = cross_product(w, n), nu = cross_product(n, u);
    const double u2 = dot_product(u, u), w2 = dot_product(w, w), n2 = dot_product(n, n);
    const Xyz_3 m{{u2 * wn[0] + w2 * nu[0], u2 * wn[1] + w2 * nu[1], u2 * wn[2] + w2 * nu[2]}};
    const double area = std::sqrt(u2 * w2), sides = std::sqrt(u2) + std::sqrt(w2);
    const bool is_tiny = !(n2 > 1e-160); // sixth powers of lengths would lose digits
    double least = std::numeric_limits<double>::infinity();
    int best = -1;
    candidates_.clear();
    for (int k = 0; k < static_cast<int>(points_.size()); ++k) {
      if (k == base[0] || k == base[1] || k == base[2]) continue;
      const Xyz_3 x = minus(points_[static_cast<std::size_t>(k)], a);
      const double x2 = dot_product(x, x), length = std::sqrt(x2), height = dot_product(n, x);
      const double height_error = 16 * unit * area * length;
      if (!is_tiny && height < -height_error) continue;
      if (is_tiny || !(height > height_error)) {
        candidates_.push_back({k, -std::numeric_limits<double>::infinity(), false});
        continue;
      }
      const double numerator = n2 * x2 - dot_product(m, x);
      const double numerator_error = 64 * unit * area * area * length * (length + sides);
      const double t = numerator / height;
      const double error =
          (numerator_error + std::abs(t) * height_error) / height * (1 + 1e-3) + 4 * unit * std::abs(t);
      if (t - error > least) continue;
      if (t + error < least) least = t + error, best = k;
      candidates_.push_back({k, t - error, true});
    }
    bool is_clear = best >= 0;
    for (const Candidate& c : candidates_) is_clear = is_clear && (c.number == best || c.lowest > least);
    return is_clear ? best : exact_apex(tr, base, least);
  }

  /// The same among the candidates that doubles can't tell apart.
  int exact_apex(const Triangulation& tr, const Numbers& base, double least)
  {
    const auto vertex = [this](int k) { return neighbours_[static_cast<std::size_t>(k)]; };
    const Cell_handle probe = Cell_range::s_iterator_to(probe_);
    for (int i = 0; i < 3; ++i) probe->set_vertex(i, vertex(base[static_cast<std::size_t>(i)]));
    int best = -1;
    for (const Candidate& c : candidates_) {
      if (c.lowest > least) continue;
      const Vertex_handle v = vertex(c.number);
      if (!c.is_above && CGAL::orientation(probe->vertex(0)->point(), probe->vertex(1)->point(),
                                           probe->vertex(2)->point(), v->point()) != CGAL::POSITIVE)
        continue;
      if (best >= 0 && tr.side_of_sphere(probe, v->point(), true) != CGAL::ON_BOUNDED_SIDE) continue;
      best = c.number;
      probe->set_vertex(3, v);
    }
    return best;
  }

  struct Candidate
  {
    int number;
    double lowest; ///< a lower bound of its t
    bool is_above; ///< whether it certainly lies on the inner side
  };

  static constexpr double unit = std::numeric_limits<double>::epsilon();
  static constexpr std::size_t most_neighbours = 150, least_table = 256;

  std::deque<Cell> memory_; ///< of the cells
  Cell probe_;
  std::vector<Cell_handle> cells_;
  std::vector<std::array<bool, 4>> is_outer_; ///< of each cell, whether its neighbours are old ones
  std::vector<Hull_facet> hull_;
  std::vector<Side> sides_;
  std::vector<std::uint64_t> keys_; ///< of the sides
  std::vector<int> table_;          ///< sides by key
  std::vector<Vertex_handle> neighbours_;
  std::vector<Xyz_3> points_;
  std::vector<int> by_id_;                         ///< numbers of neighbours, valid where they name the vertex
  std::vector<std::pair<Vertex_handle, int>> box_; ///< the same of those without an id
  std::vector<Candidate> candidates_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_STAR_FILLING_3_H
