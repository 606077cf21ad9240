// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tries to make a closed, manifold, oriented surface without self-intersections out of a polygon soup, by what CGAL's
// Polygon_mesh_processing offers, and says what it changed. Nothing is promised: check the result.

#ifndef WEFT_SPATIAL_SURFACE_REPAIR_SURFACE_3_H
#define WEFT_SPATIAL_SURFACE_REPAIR_SURFACE_3_H

#include <weft/spatial/surface/Polygon_soup_3.h>
#include <weft/spatial/surface/surface_complaints_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace internal {

/// Holes with more border edges than this stay open: filling them takes cubic time and is guesswork.
constexpr std::size_t longest_hole_to_fill = 100;

/// Where more facets intersect, they stay as they are: CGAL's removal can't be interrupted, and mends surfaces with few
/// of them only.
constexpr std::size_t most_facets_to_mend = 1000;

using Repair_log = std::vector<std::string>;

inline void log_count(Repair_log& log, std::size_t n, const char* singular, const char* plural)
{
  if (n > 0) log.push_back(counted(n, singular, plural));
}

/// Takes out polygons with corners that don't exist or aren't finite; their points go as unused ones later.
template <class K>
void remove_impossible_polygons(Polygon_soup_3<K>& soup, Repair_log& log)
{
  const auto is_possible = [&](std::size_t v) {
    if (v >= soup.points.size()) return false;
    const auto& p = soup.points[v];
    return CGAL::is_finite(p.x()) && CGAL::is_finite(p.y()) && CGAL::is_finite(p.z());
  };
  const auto is_impossible = [&](const std::vector<std::size_t>& polygon) {
    return !std::all_of(polygon.begin(), polygon.end(), is_possible);
  };
  const std::size_t before = soup.polygons.size();
  soup.polygons.erase(std::remove_if(soup.polygons.begin(), soup.polygons.end(), is_impossible), soup.polygons.end());
  log_count(log, before - soup.polygons.size(), "facet with impossible corners removed",
            "facets with impossible corners removed");
  CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(soup.points, soup.polygons);
}

/// Whether a cycle is another one backwards. Doubled points have new indices: then it counts as unchanged.
inline bool is_reversed(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b)
{
  const auto at = std::find(a.begin(), a.end(), b[0]);
  if (at == a.end() || b.size() < 2) return false;
  const auto before = at == a.begin() ? a.end() - 1 : at - 1;
  return *before == b[1];
}

/// Takes out polygons with less than three different corners.
template <class K>
void remove_tiny_polygons(Polygon_soup_3<K>& soup, Repair_log& log)
{
  const auto is_tiny = [](std::vector<std::size_t> corners) {
    sort_unique(corners);
    return corners.size() < 3;
  };
  const std::size_t before = soup.polygons.size();
  soup.polygons.erase(std::remove_if(soup.polygons.begin(), soup.polygons.end(), is_tiny), soup.polygons.end());
  log_count(log, before - soup.polygons.size(), "degenerate facet removed", "degenerate facets removed");
}

/// Equal points become one, useless and repeated polygons go, the rest is oriented alike as far as that is possible.
template <class K>
void repair_soup(Polygon_soup_3<K>& soup, Repair_log& log)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  log_count(log, PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.polygons), "coincident point merged",
            "coincident points merged");
  remove_tiny_polygons(soup, log);
  const std::size_t before = soup.polygons.size();
  PMP::repair_polygon_soup(soup.points, soup.polygons);
  if (soup.polygons.size() < before)
    log_count(log, before - soup.polygons.size(), "duplicate facet removed", "duplicate facets removed");

  const auto oriented_before = soup.polygons;
  const std::size_t points_before = soup.points.size();
  PMP::orient_polygon_soup(soup.points, soup.polygons);
  log_count(log, soup.points.size() - points_before, "point doubled where the surface isn't manifold",
            "points doubled where the surface isn't manifold");
  std::size_t turned = 0;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto &now = soup.polygons[f], &then = oriented_before[f];
    turned += now.size() == then.size() && !then.empty() && is_reversed(now, then);
  }
  log_count(log, turned, "facet turned over", "facets turned over");
}

/// Fills a hole, given by the border halfedges around it, with triangles between its vertices. False if that fails.
template <class Mesh>
bool fill_hole(Mesh& mesh, const std::vector<typename Mesh::Halfedge_index>& border)
{
  std::vector<typename Mesh::Point> rim, beyond; // the rim, and what lies across it, for smooth fillings
  for (const auto h : border) {
    rim.push_back(mesh.point(source(h, mesh)));
    beyond.push_back(mesh.point(target(next(opposite(h, mesh), mesh), mesh)));
  }
  std::vector<CGAL::Triple<int, int, int>> patch;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(rim, beyond, std::back_inserter(patch));
  const auto corner = [&](int i) { return source(border[static_cast<std::size_t>(i)], mesh); };
  std::vector<std::array<typename Mesh::Vertex_index, 3>> facets;
  for (const auto& triple : patch) {
    std::array<int, 3> t = {triple.first, triple.second, triple.third};
    std::sort(t.begin(), t.end()); // in the order of the border: the orientation of the facet that was missing
    facets.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
  }
  bool complete = !facets.empty();
  for (const auto& [a, b, c] : facets) complete &= mesh.add_face(a, b, c) != Mesh::null_face();
  return complete;
}

/// Closes holes of at most `longest_hole_to_fill` edges; returns how many.
template <class Mesh>
std::size_t fill_holes(Mesh& mesh)
{
  std::vector<typename Mesh::Halfedge_index> holes, border;
  CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(holes));
  std::size_t filled = 0;
  for (const auto first : holes) {
    border.assign(1, first);
    for (auto h = next(first, mesh); h != first; h = next(h, mesh)) border.push_back(h);
    if (border.size() <= longest_hole_to_fill) filled += fill_hole(mesh, border);
  }
  return filled;
}

/// Number of facets that intersect or touch others outside of common edges and vertices.
template <class Mesh>
std::size_t count_intersecting(const Mesh& mesh)
{
  using Face = typename Mesh::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  std::set<Face> facets;
  for (const auto& [f, g] : pairs) facets.insert({f, g});
  return facets.size();
}

/// Returns whether all could be removed. A function of its own, since it is most of what there is to compile here: a
/// program may declare it as an extern template and instantiate it in another translation unit.
template <class Mesh>
bool remove_intersections(Mesh& mesh)
{
  return CGAL::Polygon_mesh_processing::experimental::remove_self_intersections(mesh);
}

/// What is done on a mesh rather than on a soup: facets cut, borders sewn up, holes closed, intersections removed.
template <class Mesh>
void repair_mesh(Mesh& mesh, Repair_log& log)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  PMP::triangulate_faces(mesh);
  log_count(log, PMP::stitch_borders(mesh), "pair of border edges sewn together",
            "pairs of border edges sewn together");
  const std::size_t facets = mesh.number_of_faces();
  PMP::remove_degenerate_faces(mesh);
  if (mesh.number_of_faces() < facets)
    log_count(log, facets - mesh.number_of_faces(), "degenerate facet collapsed", "degenerate facets collapsed");
  log_count(log, fill_holes(mesh), "hole filled", "holes filled");
  // Removing intersections smooths, which must not meet degenerate facets.
  const auto is_degenerate = [&mesh](auto f) { return PMP::is_degenerate_triangle_face(f, mesh); };
  if (!CGAL::is_closed(mesh) || std::any_of(faces(mesh).begin(), faces(mesh).end(), is_degenerate)) return;
  const std::size_t intersecting = count_intersecting(mesh);
  if (intersecting > most_facets_to_mend)
    log.push_back("self-intersections left, since " + std::to_string(intersecting) + " facets have them");
  if (intersecting == 0 || intersecting > most_facets_to_mend) return;
  log.push_back(remove_intersections(mesh) ? "self-intersections removed" : "self-intersections removed in part");
}

} // namespace internal

/// Repairs a surface in place: points merged, useless and repeated facets removed, orientations made alike, borders
/// sewn, holes of at most 100 edges filled, self-intersections removed where CGAL manages, unless more than 1000 facets
/// have them. Facets end up as triangles, renumbered like the points; points that stay keep their coordinates. \tparam
/// K a CGAL kernel with exact predicates. \returns what was changed, for people, one line each.
template <class K>
std::vector<std::string> repair_surface(Polygon_soup_3<K>& soup)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Mesh = CGAL::Surface_mesh<typename K::Point_3>;
  internal::Repair_log log;
  internal::remove_impossible_polygons(soup, log);
  internal::repair_soup(soup, log);
  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) return log; // CGAL can't take it as a mesh
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  internal::repair_mesh(mesh, log);
  mesh.collect_garbage();
  soup.points.clear();
  soup.polygons.clear();
  for (const auto v : vertices(mesh)) soup.points.push_back(mesh.point(v));
  for (const auto f : faces(mesh)) {
    soup.polygons.emplace_back();
    for (const auto v : vertices_around_face(halfedge(f, mesh), mesh))
      soup.polygons.back().push_back(static_cast<std::size_t>(v));
  }
  return log;
}

} // namespace weft

#endif // WEFT_SPATIAL_SURFACE_REPAIR_SURFACE_3_H
