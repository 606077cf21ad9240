// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is a surface a closed, oriented 2-manifold of sound facets (Tournois 2009, sec. 3.2.1.1)? Every function below checks
// one condition, relies on those before it, and refuses the surface with the elements that break it. The checks run
// from cause to effect: a duplicated facet is called that, not an edge with three facets.

#ifndef WEFT_SPATIAL_SURFACE_CHECK_SURFACE_TOPOLOGY_3_H
#define WEFT_SPATIAL_SURFACE_CHECK_SURFACE_TOPOLOGY_3_H

#include <weft/spatial/surface/surface_complaints_3.h>
#include <weft/spatial/surface/surface_topology_3.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace weft::internal {

/// What the checks found out on their way.
struct Surface_topology_3
{
  std::vector<Surface_side_3> sides; ///< sorted; two for every edge
  Surface_neighbours_3 neighbours;
  std::vector<int> shells; ///< of each triangle
  int number_of_shells = 0;
};

template <class K>
void check_indices(const Triangle_surface_3<K>& surface)
{
  if (surface.triangles.empty()) throw Domain_error("the surface has no facets", {}, {});
  std::vector<std::size_t> bad;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::size_t v : surface.triangles[t])
      if (v >= surface.points.size()) bad.push_back(t);
  if (bad.empty()) return;
  const auto facets = origins_of(surface, bad);
  const char* refer = facets.size() == 1 ? "facet refers" : "facets refer";
  refuse(surface, counted(facets.size(), refer, refer) + " to points that don't exist: " + first_few(facets), {}, bad);
}

/// Points whose coordinates aren't finite, used by a facet or not.
/// \param facets triangles or polygons, with the positions that the caller knows.
template <class Point, class Facets>
void check_coordinates(const std::vector<Point>& points, const Facets& facets)
{
  std::vector<std::size_t> bad, users;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Point& p = points[v];
    if (!CGAL::is_finite(p.x()) || !CGAL::is_finite(p.y()) || !CGAL::is_finite(p.z())) bad.push_back(v);
  }
  if (bad.empty()) return;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const std::size_t v : facets[f])
      if (std::binary_search(bad.begin(), bad.end(), v)) users.push_back(f);
  sort_unique(users);
  const std::string what = counted(bad.size(), "point has", "points have");
  throw Domain_error(what + " coordinates that aren't finite: " + first_few(bad), bad, users);
}

/// Facets with a repeated vertex or three collinear vertices.
template <class K>
void check_degenerate_facets(const Triangle_surface_3<K>& surface)
{
  std::vector<std::size_t> bad;
  const auto collinear = K().collinear_3_object();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    if (a == b || b == c || c == a || collinear(surface.points[a], surface.points[b], surface.points[c]))
      bad.push_back(t);
  }
  if (!bad.empty()) refuse_facets(surface, "is degenerate", "are degenerate", bad);
}

/// Facets on the same three vertices, whatever their orientation; all of them are named.
template <class K>
void check_duplicate_facets(const Triangle_surface_3<K>& surface)
{
  std::vector<std::pair<std::array<std::size_t, 3>, std::size_t>> sorted(surface.triangles.size());
  for (std::size_t t = 0; t < sorted.size(); ++t) {
    sorted[t] = {surface.triangles[t], t};
    std::sort(sorted[t].first.begin(), sorted[t].first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> bad;
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
    if (sorted[i].first == sorted[i + 1].first) {
      bad.push_back(sorted[i].second);
      bad.push_back(sorted[i + 1].second);
    }
  if (bad.empty()) return;
  sort_unique(bad);
  refuse_facets(surface, "lies twice on its three vertices", "lie on the same three vertices as another", bad);
}

/// Number of points that have the coordinates of an earlier point.
template <class K>
std::size_t count_coincident(std::vector<typename K::Point_3> points)
{
  std::sort(points.begin(), points.end(), K().less_xyz_3_object());
  return static_cast<std::size_t>(points.end() - std::unique(points.begin(), points.end()));
}

/// Edges with more than two facets, then edges with one.
template <class K>
void check_edges(const Triangle_surface_3<K>& surface, const std::vector<Surface_side_3>& sides)
{
  const auto collect = [&](const auto& is_bad) {
    std::vector<std::array<std::size_t, 2>> edges;
    std::vector<std::size_t> vertices, triangles;
    for_each_edge(sides, [&](auto first, auto last) {
      if (!is_bad(last - first)) return;
      edges.push_back({first->low, first->high});
      vertices.insert(vertices.end(), {first->low, first->high});
      for (; first != last; ++first) triangles.push_back(first->triangle);
    });
    return std::make_tuple(edges, vertices, triangles);
  };
  const auto [crowded, crowded_ends, crowded_facets] = collect([](auto n) { return n > 2; });
  if (!crowded.empty())
    refuse(surface, counted(crowded.size(), "edge has", "edges have") + " more than two facets: " + first_few(crowded),
           crowded_ends, crowded_facets);
  const auto [open, open_ends, open_facets] = collect([](auto n) { return n == 1; });
  if (open.empty()) return;
  std::string what = "the surface isn't closed, " + counted(open.size(), "edge has", "edges have") +
                     " only one facet: " + first_few(open);
  const std::size_t coincident = count_coincident<K>(surface.points);
  if (coincident > 0)
    what += " (" + counted(coincident, "point repeats", "points repeat") + " the coordinates of another)";
  refuse(surface, what, open_ends, open_facets);
}

/// Shells whose facets aren't all oriented alike; the facets of the smaller party are named as the flipped ones.
template <class K>
void check_orientation(const Triangle_surface_3<K>& surface, const Surface_topology_3& topology)
{
  const std::size_t n = surface.triangles.size();
  std::vector<int> party(n, -1); // 0: oriented like the first facet of its shell
  std::vector<std::size_t> flipped, one_sided, shell;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (party[seed] >= 0) continue;
    bool orientable = true;
    shell.assign(1, seed);
    party[seed] = 0;
    for (std::size_t i = 0; i < shell.size(); ++i)
      for (const Surface_neighbour_3& next : topology.neighbours[shell[i]]) {
        const int expected = next.consistent ? party[shell[i]] : 1 - party[shell[i]];
        if (party[next.triangle] < 0) {
          party[next.triangle] = expected;
          shell.push_back(next.triangle);
        } else if (party[next.triangle] != expected)
          orientable = false;
      }
    const auto in_party_1 = [&](std::size_t t) { return party[t] == 1; };
    const auto size_1 = std::count_if(shell.begin(), shell.end(), in_party_1);
    // A draw goes to the party of the first facet.
    const int minority = 2 * static_cast<std::size_t>(size_1) > shell.size() ? 0 : 1;
    for (const std::size_t t : shell)
      if (!orientable)
        one_sided.push_back(t);
      else if (party[t] == minority)
        flipped.push_back(t);
  }
  if (!one_sided.empty())
    refuse(surface,
           "the surface is one-sided at facet " + std::to_string(surface.origin(one_sided.front())) +
               ": no orientation fits all facets",
           corners_of(surface, one_sided), one_sided);
  if (!flipped.empty())
    refuse_facets(surface, "is oriented against its neighbours", "are oriented against their neighbours", flipped);
}

/// Vertices whose facets form more than one fan.
/// \pre The facets are oriented alike.
template <class K>
void check_vertices(const Triangle_surface_3<K>& surface, const Surface_neighbours_3& neighbours)
{
  const auto& triangles = surface.triangles;
  std::vector<std::size_t> valence(surface.points.size(), 0), first(surface.points.size(), 0);
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (const std::size_t v : triangles[t]) {
      ++valence[v];
      first[v] = t;
    }
  std::vector<std::size_t> bad, facets;
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (valence[v] == 0) continue;
    std::size_t fan = 0, t = first[v];
    do {
      const auto at = std::find(triangles[t].begin(), triangles[t].end(), v) - triangles[t].begin();
      t = neighbours[t][static_cast<std::size_t>(at)].triangle;
      ++fan;
    } while (t != first[v]);
    if (fan < valence[v]) bad.push_back(v);
  }
  if (bad.empty()) return;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::size_t v : triangles[t])
      if (std::binary_search(bad.begin(), bad.end(), v)) facets.push_back(t);
  const std::string what = bad.size() == 1
                               ? "parts of the surface touch in a vertex: "
                               : "parts of the surface touch in " + std::to_string(bad.size()) + " vertices: ";
  refuse(surface, what + first_few(bad), bad, facets);
}

/// All the checks above.
/// \throws Domain_error.
template <class K>
Surface_topology_3 check_surface_topology(const Triangle_surface_3<K>& surface)
{
  check_indices(surface);
  if (surface.origins.empty()) check_coordinates(surface.points, surface.triangles); // else done on the polygons
  check_degenerate_facets(surface);
  check_duplicate_facets(surface);
  Surface_topology_3 topology;
  topology.sides = sorted_sides(surface.triangles);
  check_edges(surface, topology.sides);
  topology.neighbours = surface_neighbours(surface.triangles.size(), topology.sides);
  check_orientation(surface, topology);
  check_vertices(surface, topology.neighbours);
  std::tie(topology.shells, topology.number_of_shells) =
      surface_components(topology.neighbours, [](std::size_t, std::size_t) { return true; });
  return topology;
}

} // namespace weft::internal

#endif // WEFT_SPATIAL_SURFACE_CHECK_SURFACE_TOPOLOGY_3_H
