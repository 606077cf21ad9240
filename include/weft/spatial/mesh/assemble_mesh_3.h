// SPDX-License-Identifier: GPL-3.0-or-later
//
// From tetrahedra of any origin to a mesh whose elements fit together: cells oriented alike, the boundary derived from
// the cells, tags made patches, creases and subdomains. What can't be a mesh is refused with the offending elements;
// what doesn't matter is left out and noted. Cells that are turned over by their geometry stay so: untangling them is
// for `improve_3()`.

#ifndef WEFT_SPATIAL_MESH_ASSEMBLE_MESH_3_H
#define WEFT_SPATIAL_MESH_ASSEMBLE_MESH_3_H

#include <weft/errors.h>
#include <weft/internal/run/Mesh_assembler.h>
#include <weft/spatial/mesh/cell_facets_3.h>
#include <weft/spatial/mesh/Element_soup_3.h>
#include <weft/spatial/mesh/Tetrahedral_mesh_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Builds the mesh; `assemble_mesh_3()` runs it.
template <class K>
class Mesh_assembler_3 : private Mesh_assembler<Element_soup_3<K>, Imported_mesh_3<K>>
{
  using Base = Mesh_assembler<Element_soup_3<K>, Imported_mesh_3<K>>;
  using Base::none;
  using Base::note_dropped;
  using Base::number_of;
  using Base::numbers_of;
  using Base::result_;
  using Base::soup_;

public:
  using Point = typename K::Point_3;

  explicit Mesh_assembler_3(Element_soup_3<K> soup) : Base(std::move(soup)) {}

  Imported_mesh_3<K> run()
  {
    check_indices();
    check_points();
    check_cells();
    drop_isolated_points();
    result_.notes.insert(result_.notes.begin(), soup_.notes.begin(), soup_.notes.end());
    mesh().points = std::move(soup_.points);
    mesh().cells = std::move(soup_.cells);
    mesh().subdomains = numbered(soup_.cell_tags, mesh().cells.size(), 1, "subdomains");
    all_facets_ = cell_facets(mesh().cells);
    orient_cells();
    take_facets();
    take_edges();
    take_corners();
    locate_points();
    return std::move(result_);
  }

private:
  Tetrahedral_mesh_3<K>& mesh() { return result_.mesh; }

  // ---- checks

  void check_indices() const
  {
    if (soup_.cells.empty()) throw Domain_error("there are no tetrahedra", {}, {});
    Base::check_indices(soup_.cells, soup_.cell_tags, "cell");
    Base::check_indices(soup_.facets, soup_.facet_tags, "facet");
    Base::check_indices(soup_.edges, soup_.edge_tags, "edge");
    this->check_corner_indices();
  }

  /// Coordinates are finite, and no two vertices of cells at one place.
  void check_points()
  {
    is_used_.assign(soup_.points.size(), false);
    for (const auto& cell : soup_.cells)
      for (const std::size_t v : cell) is_used_[v] = true;
    std::vector<std::size_t> order;
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      const Point& p = soup_.points[v];
      if (!CGAL::is_finite(p.x()) || !CGAL::is_finite(p.y()) || !CGAL::is_finite(p.z()))
        throw Domain_error("vertex " + number_of(v) + " has coordinates that aren't finite", {v}, {});
      if (is_used_[v]) order.push_back(v);
    }
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      const auto order_of_points = CGAL::compare_lexicographically(soup_.points[a], soup_.points[b]);
      return order_of_points == CGAL::EQUAL ? a < b : order_of_points == CGAL::SMALLER;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (soup_.points[order[i - 1]] == soup_.points[order[i]])
        throw Domain_error("vertices " + number_of(order[i - 1]) + " and " + number_of(order[i]) +
                               " are at the same place",
                           {order[i - 1], order[i]}, {});
  }

  void check_cells() const
  {
    this->check_repetitions(soup_.cells, "cell", [this](std::size_t c) {
      if (orientation(soup_.points, soup_.cells[c]) == CGAL::COPLANAR)
        this->refuse("cell", soup_.cells, c, "has no volume");
    });
  }

  static CGAL::Orientation orientation(const std::vector<Point>& points, const std::array<std::size_t, 4>& c)
  {
    return CGAL::orientation(points[c[0]], points[c[1]], points[c[2]], points[c[3]]);
  }

  // ---- points

  void drop_isolated_points()
  {
    const std::vector<std::size_t> place = this->number_points(soup_.cells, "cell");
    const auto& origin = result_.point_origin;
    if (origin.size() == place.size()) return;
    const auto keep = [&](auto& values) {
      if (values.empty()) return;
      for (std::size_t v = 0; v < origin.size(); ++v) values[v] = values[origin[v]];
      values.resize(origin.size());
    };
    keep(soup_.points);
    keep(soup_.point_tags);
    keep(soup_.locations);
    renumber(soup_.cells, soup_.cell_tags, place, "cell");
    renumber(soup_.facets, soup_.facet_tags, place, "triangle");
    renumber(soup_.edges, soup_.edge_tags, place, "edge");
    std::size_t n = 0;
    for (const std::size_t v : soup_.corners)
      if (place[v] != none) soup_.corners[n++] = place[v];
    soup_.corners.resize(n);
  }

  template <std::size_t N>
  void renumber(std::vector<std::array<std::size_t, N>>& elements, std::vector<int>& tags,
                const std::vector<std::size_t>& place, const char* name)
  {
    std::size_t n = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      auto element = elements[e];
      for (std::size_t& v : element) v = place[v];
      if (std::find(element.begin(), element.end(), none) != element.end()) continue;
      elements[n] = element;
      if (!tags.empty()) tags[n] = tags[e];
      ++n;
    }
    note_dropped(elements.size() - n, name, "of no cell");
    elements.resize(n);
    if (!tags.empty()) tags.resize(n);
  }

  // ---- tags

  /// Tags as numbers from `first`: less by what they are too large where all are positive, as weft writes them, else
  /// in increasing order.
  std::vector<int> numbered(const std::vector<int>& tags, std::size_t n, int first, const char* name)
  {
    if (tags.empty()) return std::vector<int>(n, first);
    if (*std::min_element(tags.begin(), tags.end()) >= 1) {
      std::vector<int> result = tags;
      for (int& tag : result) tag += first - 1;
      return result;
    }
    std::map<int, int> number;
    for (const int tag : tags) number.emplace(tag, 0);
    int next = first;
    for (auto& [tag, value] : number) value = next++;
    if (number.size() > 1)
      result_.notes.push_back(std::to_string(number.size()) + " tags of " + name +
                              ", not all of them positive, numbered anew in increasing order");
    std::vector<int> result;
    for (const int tag : tags) result.push_back(number[tag]);
    return result;
  }

  // ---- cells

  /// Turns cells so that neighbours go around their common facet in opposite senses and the volume of every part that
  /// hangs together is positive. What is negative then is turned over in space, not just in the list.
  void orient_cells()
  {
    auto& cells = mesh().cells;
    const auto& points = mesh().points;
    typename Base::Neighbours neighbours(cells.size());
    for_each_facet(all_facets_, [&](auto first, auto last) {
      if (last - first > 2) refuse_crowded_facet(*first, static_cast<std::size_t>(last - first));
      if (last - first < 2) return;
      const auto second = first + 1;
      const bool agree = !same_sense(outward_vertices(mesh().cells[first->cell], first->opposite),
                                     outward_vertices(mesh().cells[second->cell], second->opposite));
      neighbours[first->cell].emplace_back(second->cell, agree);
      neighbours[second->cell].emplace_back(first->cell, agree);
    });
    const auto volume = [&](std::size_t c) {
      const auto& v = cells[c];
      return CGAL::to_double(CGAL::volume(points[v[0]], points[v[1]], points[v[2]], points[v[3]]));
    };
    this->orient(neighbours, "cell", volume, [&](std::size_t c) { std::swap(cells[c][2], cells[c][3]); });
    all_facets_ = cell_facets(mesh().cells); // corners have changed places
    for (const auto& cell : mesh().cells) result_.inverted_cells += orientation(mesh().points, cell) == CGAL::NEGATIVE;
  }

  [[noreturn]] void refuse_crowded_facet(const Cell_facet_3& facet, std::size_t cells) const
  {
    std::array<std::size_t, 3> vertices = facet.vertices;
    for (std::size_t& v : vertices) v = result_.point_origin[v];
    throw Domain_error("the facet with the vertices " + numbers_of(vertices) + " has " + std::to_string(cells) +
                           " cells",
                       {vertices.begin(), vertices.end()}, {facet.cell});
  }

  // ---- facets

  /// The facets of the boundary and between subdomains: those listed, then those that aren't.
  void take_facets()
  {
    const std::vector<int> tags = numbered(soup_.facet_tags, soup_.facets.size(), 0, "facets");
    std::map<std::array<std::size_t, 3>, std::size_t> listed;
    std::size_t repeated = 0;
    for (std::size_t f = 0; f < soup_.facets.size(); ++f)
      repeated += !listed.emplace(sorted(soup_.facets[f]), f).second;
    std::vector<std::array<std::size_t, 3>> seen_from_outside(soup_.facets.size(), {none, none, none}), others;
    std::size_t inside = 0, found = 0;
    for_each_facet(all_facets_, [&](auto first, auto last) {
      const auto at = listed.find(first->vertices);
      if (last - first == 2 && mesh().subdomains[first->cell] == mesh().subdomains[(first + 1)->cell]) {
        if (at != listed.end()) ++inside, ++found;
        return;
      }
      // Between two subdomains the one with the smaller number has the facet.
      const auto owner = last - first == 2 && mesh().subdomains[(first + 1)->cell] < mesh().subdomains[first->cell]
                             ? first + 1
                             : first;
      const auto vertices = outward_vertices(mesh().cells[owner->cell], owner->opposite);
      if (at == listed.end()) {
        others.push_back(vertices);
      } else {
        seen_from_outside[at->second] = vertices;
        ++found;
      }
    });
    for (std::size_t f = 0; f < soup_.facets.size(); ++f) {
      if (seen_from_outside[f][0] == none) continue;
      mesh().facets.push_back(starting_like(seen_from_outside[f], soup_.facets[f][0]));
      mesh().patches.push_back(tags[f]);
    }
    const int unlisted = tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1;
    for (const auto& facet : others) {
      mesh().facets.push_back(facet);
      mesh().patches.push_back(unlisted);
    }
    note_dropped(repeated, "triangle", "listed again");
    note_dropped(inside, "triangle", "inside a subdomain");
    note_dropped(listed.size() - found, "triangle", "that no cell has");
  }

  static std::array<std::size_t, 3> starting_like(std::array<std::size_t, 3> facet, std::size_t first)
  {
    std::rotate(facet.begin(), std::find(facet.begin(), facet.end(), first), facet.end());
    return facet;
  }

  // ---- edges and corners

  /// The listed edges that are sides of facets.
  void take_edges()
  {
    std::vector<std::array<std::size_t, 2>> sides;
    for (const auto& f : mesh().facets)
      for (std::size_t i = 0; i < 3; ++i) sides.push_back(sorted<2>({f[i], f[(i + 1) % 3]}));
    std::sort(sides.begin(), sides.end());
    const std::vector<int> tags = numbered(soup_.edge_tags, soup_.edges.size(), 0, "edges");
    std::map<std::array<std::size_t, 2>, std::size_t> seen;
    std::size_t dropped = 0;
    for (std::size_t e = 0; e < soup_.edges.size(); ++e) {
      const auto key = sorted(soup_.edges[e]);
      if (!std::binary_search(sides.begin(), sides.end(), key) || !seen.emplace(key, e).second) {
        ++dropped;
        continue;
      }
      mesh().edges.push_back(soup_.edges[e]);
      mesh().creases.push_back(tags[e]);
    }
    note_dropped(dropped, "edge", "off the boundary or listed again");
  }

  /// Corners that are on the boundary, once each.
  void take_corners()
  {
    std::vector<char> may_be(mesh().points.size(), false);
    for (const auto& facet : mesh().facets)
      for (const std::size_t v : facet) may_be[v] = true;
    Base::take_corners(std::move(may_be), "off the boundary or listed again");
  }

  /// A corner, else on a crease, else on a patch, else inside; of several parts the one that the file names, or the
  /// least.
  void locate_points()
  {
    auto& locations = mesh().locations;
    locations.assign(mesh().points.size(), {4, 0});
    const auto take = [&](std::size_t v, int dimension, int index, int tag_of_index_0) {
      Vertex_location_3& at = locations[v];
      const bool is_named = !soup_.point_tags.empty() && soup_.point_tags[v] == index + tag_of_index_0;
      if (dimension < at.dimension || (dimension == at.dimension && (is_named || index < at.index)))
        if (!(dimension == at.dimension && named_[v])) at = {dimension, index}, named_[v] = is_named;
    };
    named_.assign(mesh().points.size(), false);
    for (std::size_t c = 0; c < mesh().cells.size(); ++c)
      for (const std::size_t v : mesh().cells[c]) take(v, 3, mesh().subdomains[c], 0);
    for (std::size_t f = 0; f < mesh().facets.size(); ++f)
      for (const std::size_t v : mesh().facets[f]) take(v, 2, mesh().patches[f], 1);
    for (std::size_t e = 0; e < mesh().edges.size(); ++e)
      for (const std::size_t v : mesh().edges[e]) take(v, 1, mesh().creases[e], 1);
    for (std::size_t i = 0; i < mesh().corners.size(); ++i) locations[mesh().corners[i]] = {0, static_cast<int>(i)};
    // A file that has locations knows better, as far as they don't contradict the elements.
    for (std::size_t v = 0; v < soup_.locations.size(); ++v)
      if (soup_.locations[v].dimension == locations[v].dimension && locations[v].dimension > 0)
        locations[v] = soup_.locations[v];
  }

  std::vector<bool> is_used_, named_; ///< by point: of a cell; located where its tag says
  std::vector<Cell_facet_3> all_facets_;
};

} // namespace internal

/// Makes a mesh of tetrahedra of any origin.
///
/// Cells are oriented alike. The facets are those of the boundary and between subdomains, with the tags of the listed
/// ones; edges and corners are taken if they are on those facets. Positive tags t become the subdomain t, patch t - 1
/// and crease t - 1; others are numbered in increasing order. Left out, with a note: points of no cell, and facets,
/// edges and corners that aren't where they should be.
/// \throws Domain_error if there are no cells, for cells that have no volume, a vertex twice or are there twice, facets
///   of three or more cells, cells that can't be oriented alike, indices out of range, coordinates that aren't finite,
///   and two vertices at one place; with the offending vertices and cells.
/// O(n log n) time.
template <class K>
Imported_mesh_3<K> assemble_mesh_3(Element_soup_3<K> soup)
{
  return internal::Mesh_assembler_3<K>(std::move(soup)).run();
}

/// The same for points and cells in arrays, and a tag of each cell, which may be left out.
template <class Point, class K = typename CGAL::Kernel_traits<Point>::Kernel>
Imported_mesh_3<K> assemble_mesh_3(const std::vector<Point>& points,
                                   const std::vector<std::array<std::size_t, 4>>& cells,
                                   const std::vector<int>& tags = {})
{
  Element_soup_3<K> soup;
  soup.points = points;
  soup.cells = cells;
  soup.cell_tags = tags;
  return assemble_mesh_3(std::move(soup));
}

} // namespace weft

#endif // WEFT_SPATIAL_MESH_ASSEMBLE_MESH_3_H
