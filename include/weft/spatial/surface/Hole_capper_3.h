// SPDX-License-Identifier: GPL-3.0-or-later
//
// Caps for the holes of cup-shaped parts of a surface. Border edges are those with an odd number of triangles; they are
// chained to loops, which CGAL's Polygon_mesh_processing triangulates (Liepa, "Filling holes in meshes", 2003).

#ifndef WEFT_SPATIAL_SURFACE_HOLE_CAPPER_3_H
#define WEFT_SPATIAL_SURFACE_HOLE_CAPPER_3_H

#include <weft/internal/boxes/coordinates_3.h>
#include <weft/internal/Disjoint_parts.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace weft::internal {

/// A hole of a surface.
struct Hole_3
{
  std::vector<std::size_t> loop;                     ///< the vertices around it, as its cap has them in order
  std::size_t beside = 0;                            ///< a triangle at its border
  std::vector<std::array<std::size_t, 3>> triangles; ///< the cap; empty if there is none
  double area = 0;                                   ///< of the cap, or about that
};

/// Triangles that hang together across edges, and the holes in them.
struct Open_part_3
{
  std::vector<std::size_t> triangles;
  std::vector<Hole_3> holes;
  double area = 0;

  double area_of_caps() const
  {
    double sum = 0;
    for (const Hole_3& hole : holes) sum += hole.area;
    return sum;
  }
  /// Of the part with its caps, the share that caps are.
  double share_of_caps() const { return area_of_caps() / (area + area_of_caps()); }
};

/// Finds holes and closes them.
/// \tparam K a CGAL kernel.
template <class K>
class Hole_capper_3
{
  using Corners = std::array<std::size_t, 3>;
  static constexpr std::size_t longest_for_all = 300; ///< up to which all triangulations are tried: in cubic time

public:
  /// \param which positions of the triangles that count, in ascending order.
  /// \param without_fins whether sheets that hang on others are left out first.
  Hole_capper_3(const Triangle_surface_3<K>& surface, std::vector<std::size_t> which, bool without_fins)
      : points_(surface.points)
  {
    if (without_fins) leave_out_fins(surface, which);
    std::vector<Corners> triangles;
    for (const std::size_t t : which) triangles.push_back(surface.triangles[t]);
    Disjoint_parts parts(triangles.size());
    std::vector<Surface_side_3> border;
    for_each_edge(sorted_sides(triangles), [&](auto first, auto last) {
      for (auto other = first + 1; other != last; ++other) parts.unite(first->triangle, other->triangle);
      if ((last - first) % 2 == 1) border.push_back(*(last - 1));
    });
    std::map<std::size_t, std::size_t> number;
    std::vector<std::vector<Surface_side_3>> borders;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [at, is_new] = number.try_emplace(parts.find(t), parts_.size());
      if (is_new) parts_.emplace_back();
      parts_[at->second].triangles.push_back(which[t]);
      parts_[at->second].area += area(triangles[t]);
    }
    borders.resize(parts_.size());
    for (Surface_side_3 s : border) {
      const std::size_t part = number.at(parts.find(s.triangle));
      s.triangle = which[s.triangle];
      borders[part].push_back(s);
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      collect_loops(borders[p], parts_[p].holes);
      for (Hole_3& hole : parts_[p].holes) hole.area = area_of_fan(hole.loop);
    }
  }

  const std::vector<Open_part_3>& parts() const { return parts_; }

  /// Closes the holes of parts of which at most this share would be caps.
  /// \param ask called before each.
  template <class Ask>
  void cap(double most, const Ask& ask)
  {
    for (Open_part_3& part : parts_) {
      if (!(part.share_of_caps() <= 1.5 * most)) continue; // a rough figure so far
      for (Hole_3& hole : part.holes) {
        ask();
        triangulate(hole);
      }
      if (part.share_of_caps() <= most) continue;
      for (Hole_3& hole : part.holes) hole.triangles.clear();
    }
  }

private:
  /// Takes sheets out that hang on edges of others by a part of their border: around them caps would be sheets, too.
  void leave_out_fins(const Triangle_surface_3<K>& surface, std::vector<std::size_t>& which) const
  {
    std::vector<Corners> triangles;
    for (const std::size_t t : which) triangles.push_back(surface.triangles[t]);
    const auto sides = sorted_sides(triangles);
    Disjoint_parts pieces(triangles.size());
    bool are_crowded = false;
    for_each_edge(sides, [&](auto first, auto last) {
      if (last - first == 2) pieces.unite(first->triangle, (first + 1)->triangle);
      are_crowded = are_crowded || last - first > 2;
    });
    if (!are_crowded) return;
    struct Piece
    {
      double area = 0;
      bool is_free = false, is_held = false;
      Xyz_3 origin{{0, 0, 0}}, normal{{0, 0, 0}};
    };
    std::map<std::size_t, Piece> of;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [at, is_new] = of.try_emplace(pieces.find(t));
      if (is_new) at->second.origin = xyz(points_[triangles[t][0]]);
      at->second.area += area(triangles[t]);
    }
    for_each_edge(sides, [&](auto first, auto last) {
      if (last - first == 2) return;
      for (auto s = first; s != last; ++s) {
        Piece& piece = of.at(pieces.find(s->triangle));
        const bool is_alone = std::count_if(first, last, [&](const auto& other) {
                                return pieces.find(other.triangle) == pieces.find(s->triangle);
                              }) == 1;
        if (!is_alone) continue;
        (last - first == 1 ? piece.is_free : piece.is_held) = true;
        // The area that the border goes around, as a vector.
        const Xyz_3 cross =
            cross_product(minus(xyz(points_[s->low]), piece.origin), minus(xyz(points_[s->high]), piece.origin));
        for (std::size_t k = 0; k < 3; ++k) piece.normal[k] += (s->forward ? cross[k] : -cross[k]) / 2;
      }
    });
    constexpr double flat = 0.7; // of a sheet's area that its border goes around
    std::vector<std::size_t> kept;
    for (std::size_t t = 0; t < which.size(); ++t) {
      const Piece& piece = of.at(pieces.find(t));
      if (!(piece.is_free && piece.is_held && norm(piece.normal) > flat * piece.area)) kept.push_back(which[t]);
    }
    which = std::move(kept);
  }

  double area(const Corners& t) const
  {
    const Xyz_3 a = xyz(points_[t[0]]);
    return norm(cross_product(minus(xyz(points_[t[1]]), a), minus(xyz(points_[t[2]]), a))) / 2;
  }

  double area_of_fan(const std::vector<std::size_t>& loop) const
  {
    Xyz_3 center{{0, 0, 0}};
    for (const std::size_t v : loop)
      for (std::size_t k = 0; k < 3; ++k) center[k] += xyz(points_[v])[k] / static_cast<double>(loop.size());
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += norm(cross_product(minus(xyz(points_[loop[i]]), center),
                                minus(xyz(points_[loop[(i + 1) % loop.size()]]), center))) /
             2;
    return sum;
  }

  /// Chains edges to loops that visit no vertex twice, against the direction that their triangles have.
  static void collect_loops(const std::vector<Surface_side_3>& border, std::vector<Hole_3>& holes)
  {
    std::map<std::size_t, std::vector<std::size_t>> at; // edges by vertex
    for (std::size_t e = 0; e < border.size(); ++e) {
      at[border[e].low].push_back(e);
      at[border[e].high].push_back(e);
    }
    std::vector<bool> is_used(border.size(), false);
    const auto start = [&](std::size_t e) { return border[e].forward ? border[e].high : border[e].low; };
    for (std::size_t seed = 0; seed < border.size(); ++seed) {
      if (is_used[seed]) continue;
      std::vector<std::size_t> path = {start(seed)}, edges;
      std::map<std::size_t, std::size_t> place = {{path[0], 0}};
      for (;;) {
        const std::size_t v = path.back();
        std::size_t next = border.size();
        for (const std::size_t e : at[v])
          if (!is_used[e] && (next == border.size() || (start(e) == v && start(next) != v))) next = e;
        if (next == border.size()) break; // all around it are used: the path is back at its start
        is_used[next] = true;
        edges.push_back(next);
        const std::size_t w = border[next].low == v ? border[next].high : border[next].low;
        const auto seen = place.find(w);
        if (seen == place.end()) {
          place.emplace(w, path.size());
          path.push_back(w);
          continue;
        }
        const auto from = static_cast<std::ptrdiff_t>(seen->second);
        Hole_3 hole;
        hole.loop.assign(path.begin() + from, path.end());
        hole.beside = border[edges[seen->second]].triangle;
        orient(hole, border, edges, seen->second);
        holes.push_back(std::move(hole));
        for (auto u = path.begin() + from + 1; u != path.end(); ++u) place.erase(*u);
        path.resize(seen->second + 1);
        edges.resize(seen->second);
      }
    }
  }

  /// Turns a loop around if most of its edges run the other way.
  static void orient(Hole_3& hole, const std::vector<Surface_side_3>& border, const std::vector<std::size_t>& edges,
                     std::size_t from)
  {
    std::size_t along = 0;
    for (std::size_t i = 0; i < hole.loop.size(); ++i) {
      const Surface_side_3& side = border[edges[from + i]];
      along += (side.forward ? side.high : side.low) == hole.loop[i];
    }
    if (2 * along < hole.loop.size()) std::reverse(hole.loop.begin() + 1, hole.loop.end());
  }

  void triangulate(Hole_3& hole) const
  {
    namespace params = CGAL::parameters;
    std::vector<typename K::Point_3> rim;
    for (const std::size_t v : hole.loop) rim.push_back(points_[v]);
    std::vector<CGAL::Triple<int, int, int>> cap;
    if (rim.size() == 3)
      cap.emplace_back(0, 1, 2);
    else if (rim.size() > 3)
      CGAL::Polygon_mesh_processing::triangulate_hole_polyline(rim, std::back_inserter(cap));
    if (cap.empty() && rim.size() > 3 && rim.size() <= longest_for_all)
      CGAL::Polygon_mesh_processing::triangulate_hole_polyline(rim, std::back_inserter(cap),
                                                               params::use_delaunay_triangulation(false));
    if (cap.empty()) return;
    hole.area = 0;
    for (const auto& triple : cap) {
      std::array<int, 3> t = {triple.first, triple.second, triple.third};
      std::sort(t.begin(), t.end()); // in the order of the loop
      hole.triangles.push_back({hole.loop[static_cast<std::size_t>(t[0])], hole.loop[static_cast<std::size_t>(t[1])],
                                hole.loop[static_cast<std::size_t>(t[2])]});
      hole.area += area(hole.triangles.back());
    }
  }

  const std::vector<typename K::Point_3>& points_;
  std::vector<Open_part_3> parts_;
};

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_HOLE_CAPPER_3_H
