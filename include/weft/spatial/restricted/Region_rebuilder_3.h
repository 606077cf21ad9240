// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a spatial triangulation Delaunay where flips are stuck: a few cells around the place are replaced by the
// Delaunay triangulation of their vertices, as soon as that has all facets of the hole that they leave; until then the
// hole grows by the cells behind the facets that it lacks. A valid triangulation gives way to a valid one, so nothing
// depends on how the cells were chosen; where the hole has to end is for the facets around it to say, which are looked
// at again as after a flip.

#ifndef WEFT_SPATIAL_RESTRICTED_REGION_REBUILDER_3_H
#define WEFT_SPATIAL_RESTRICTED_REGION_REBUILDER_3_H

#include <CGAL/enum.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace weft::internal {

/// \tparam Triangulation a CGAL Delaunay_triangulation_3 whose vertices have `id()`, and they and cells `time_stamp()`.
template <class Triangulation>
class Region_rebuilder_3
{
public:
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  explicit Region_rebuilder_3(Triangulation& tr) : tr_(tr) {}

  /// Rebuilds the region around a facet. Takes O(n^2) for a region of n vertices; nothing is done where it would have
  /// to be larger than some hundred cells.
  ///
  /// \param changing is called with every cell before it goes.
  ///
  /// \returns the new cells; none if it wasn't possible.
  template <class Changing>
  std::vector<Cell_handle> rebuild(Cell_handle c, int i, const Changing& changing)
  {
    region_.clear();
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (a != i && b != i) add_around(c, a, b);
    while (region_.size() <= most_cells && is_inside_hull()) {
      if (fill()) return replace(changing);
      if (!grow()) break;
    }
    return {};
  }

private:
  using Key = std::array<Vertex_handle, 3>; ///< the vertices of a facet, sorted

  struct By_age
  {
    template <class Handle>
    bool operator()(Handle a, Handle b) const
    {
      return a->time_stamp() < b->time_stamp();
    }
    bool operator()(const Key& a, const Key& b) const
    {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), *this);
    }
  };

  /// A cell beside the region and the facet that it shares with it.
  struct Outer
  {
    Cell_handle cell;
    int index;
  };

  static constexpr std::size_t most_cells = 400;

  static Key key(Vertex_handle a, Vertex_handle b, Vertex_handle c)
  {
    Key k{a, b, c};
    std::sort(k.begin(), k.end(), By_age());
    return k;
  }
  static Key key(Cell_handle c, int i)
  {
    return key(c->vertex((i + 1) & 3), c->vertex((i + 2) & 3), c->vertex((i + 3) & 3));
  }

  void add_around(Cell_handle c, int a, int b)
  {
    auto around = tr_.incident_cells(c, a, b);
    const auto begin = around;
    do region_.insert(around);
    while (++around != begin);
  }

  bool is_inside_hull() const
  {
    return std::none_of(region_.begin(), region_.end(), [this](Cell_handle c) { return tr_.is_infinite(c); });
  }

  /// The Delaunay triangulation of the region's vertices, and those of its cells that fill the region. Whether they do;
  /// if not, what facets are lacking.
  bool fill()
  {
    std::set<Vertex_handle, By_age> vertices;
    outer_.clear();
    for (const Cell_handle c : region_)
      for (int i = 0; i < 4; ++i) {
        vertices.insert(c->vertex(i));
        const Cell_handle n = c->neighbor(i);
        if (region_.count(n) == 0) outer_[key(c, i)] = {n, n->index(c)};
      }
    vertices_.assign(vertices.begin(), vertices.end());
    small_.clear();
    in_small_.clear();
    Vertex_handle last;
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      last = small_.insert(vertices_[k]->point(), last == Vertex_handle() ? Cell_handle() : last->cell());
      last->set_id(static_cast<int>(k));
      in_small_[vertices_[k]] = last;
    }
    lacking_.clear();
    filling_.clear();
    if (small_.number_of_vertices() != vertices_.size() || small_.dimension() < 3) return false;
    for (const auto& [facet, outer] : outer_) {
      const Cell_handle start = inner_cell(facet, outer);
      if (start == Cell_handle())
        lacking_.push_back(outer.cell);
      else
        filling_.insert(start);
    }
    return lacking_.empty() && flood();
  }

  /// The cell of the small triangulation that has a facet of the region's hull and lies on the region's side; null if
  /// there is none.
  Cell_handle inner_cell(const Key& facet, const Outer& outer) const
  {
    Cell_handle c;
    int i, j, k;
    if (!small_.is_facet(in_small_.at(facet[0]), in_small_.at(facet[1]), in_small_.at(facet[2]), c, i, j, k))
      return Cell_handle();
    const auto side = [&](const auto& p) {
      return CGAL::orientation(facet[0]->point(), facet[1]->point(), facet[2]->point(), p);
    };
    const CGAL::Orientation wanted = -side(outer.cell->vertex(outer.index)->point());
    const int apex = 6 - i - j - k;
    for (const Cell_handle d : {c, c->neighbor(apex)}) {
      const int own = d == c ? apex : d->index(c);
      if (!small_.is_infinite(d) && side(d->vertex(own)->point()) == wanted) return d;
    }
    return Cell_handle();
  }

  /// From the cells at the hull of the region inwards; false if that leads out of the small triangulation.
  bool flood()
  {
    std::vector<Cell_handle> front(filling_.begin(), filling_.end());
    while (!front.empty()) {
      const Cell_handle c = front.back();
      front.pop_back();
      for (int i = 0; i < 4; ++i) {
        if (outer_.count(key_in_mesh(c, i)) > 0) continue;
        const Cell_handle n = c->neighbor(i);
        if (small_.is_infinite(n)) return false;
        if (filling_.insert(n).second) front.push_back(n);
      }
    }
    return true;
  }

  Vertex_handle in_mesh(Vertex_handle small) const { return vertices_[static_cast<std::size_t>(small->id())]; }
  Key key_in_mesh(Cell_handle c, int i) const
  {
    return key(in_mesh(c->vertex((i + 1) & 3)), in_mesh(c->vertex((i + 2) & 3)), in_mesh(c->vertex((i + 3) & 3)));
  }

  bool grow()
  {
    const std::size_t before = region_.size();
    if (lacking_.empty()) // all facets are there, but not in a way that something lies between them
      for (const auto& [facet, outer] : outer_) lacking_.push_back(outer.cell);
    region_.insert(lacking_.begin(), lacking_.end());
    return region_.size() > before;
  }

  template <class Changing>
  std::vector<Cell_handle> replace(const Changing& changing)
  {
    std::vector<Cell_handle> made;
    std::map<Cell_handle, Cell_handle, By_age> copies;
    for (const Cell_handle c : region_) changing(c);
    for (const Cell_handle s : filling_) {
      made.push_back(tr_.tds().create_cell(in_mesh(s->vertex(0)), in_mesh(s->vertex(1)), in_mesh(s->vertex(2)),
                                           in_mesh(s->vertex(3))));
      copies[s] = made.back();
    }
    for (const auto& [s, c] : copies)
      for (int i = 0; i < 4; ++i) {
        const auto found = outer_.find(key(c, i));
        if (found != outer_.end())
          tr_.tds().set_adjacency(c, i, found->second.cell, found->second.index);
        else
          c->set_neighbor(i, copies.at(s->neighbor(i)));
        c->vertex(i)->set_cell(c);
      }
    tr_.tds().delete_cells(region_.begin(), region_.end());
    return made;
  }

  Triangulation& tr_;
  Triangulation small_;                            ///< of the region's vertices, by the numbers in `vertices_`
  std::set<Cell_handle, By_age> region_, filling_; ///< of the triangulation; of the small one
  std::map<Key, Outer, By_age> outer_;             ///< by the facets of the region's hull
  std::map<Vertex_handle, Vertex_handle, By_age> in_small_;
  std::vector<Vertex_handle> vertices_;
  std::vector<Cell_handle> lacking_; ///< outside of facets of the hull that the small triangulation doesn't have
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_RESTRICTED_REGION_REBUILDER_3_H
