// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a CGAL constrained triangulation to a mesh in arrays, which `improve_2()` takes, and back.

#ifndef WEFT_PLANAR_MESH_FROM_TRIANGULATION_2_H
#define WEFT_PLANAR_MESH_FROM_TRIANGULATION_2_H

#include <weft/errors.h>
#include <weft/planar/mesh/assemble_mesh_2.h>
#include <weft/planar/mesh/Triangle_mesh_2.h>

#include <CGAL/Unique_hash_map.h>

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace weft {

/// The faces of a triangulation for which `region_of(face)` isn't 0, with that as their tag; constrained edges beside
/// them are edges of the mesh. Linear time, but for a sort.
/// \param cdt any CGAL constrained triangulation.
/// \param region_of callable, face handle -> int.
/// \throws Domain_error if there is no such face.
template <class Cdt, class Region_of_face>
Triangle_mesh_2<typename Cdt::Geom_traits> triangle_mesh_2(const Cdt& cdt, const Region_of_face& region_of)
{
  Element_soup_2<typename Cdt::Geom_traits> soup;
  CGAL::Unique_hash_map<typename Cdt::Vertex_handle, std::size_t> number;
  for (auto v = cdt.finite_vertices_begin(); v != cdt.finite_vertices_end(); ++v) {
    number[v] = soup.points.size();
    soup.points.push_back(v->point());
  }
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    const int region = region_of(typename Cdt::Face_handle(f));
    if (region == 0) continue;
    soup.triangles.push_back({number[f->vertex(0)], number[f->vertex(1)], number[f->vertex(2)]});
    soup.triangle_tags.push_back(region);
  }
  const auto is_inside = [&](typename Cdt::Face_handle f) { return !cdt.is_infinite(f) && region_of(f) != 0; };
  for (auto e = cdt.finite_edges_begin(); e != cdt.finite_edges_end(); ++e) {
    if (!cdt.is_constrained(*e)) continue;
    const auto [f, i] = *e;
    if (is_inside(f) || is_inside(f->neighbor(i)))
      soup.edges.push_back({number[f->vertex(Cdt::ccw(i))], number[f->vertex(Cdt::cw(i))]});
  }
  return assemble_mesh_2(std::move(soup)).mesh;
}

/// The same for the faces with `is_in_domain()`, which CGAL's Delaunay_mesher_2 and `make_mesh_2()` set; their tag
/// is 1.
template <class Cdt>
Triangle_mesh_2<typename Cdt::Geom_traits> triangle_mesh_2(const Cdt& cdt)
{
  return triangle_mesh_2(cdt, [](typename Cdt::Face_handle f) { return f->is_in_domain() ? 1 : 0; });
}

/// Fills an empty constrained Delaunay triangulation with the points and edges of a mesh that is constrained Delaunay,
/// as those of `improve_2()` are. O(n log n) time.
/// \param set_region callable, face handle and tag of its region; called for the faces of the mesh.
/// \throws Option_error if the triangulation isn't empty.
template <class Cdt, class Set_region>
void fill_triangulation_2(Cdt& cdt, const Triangle_mesh_2<typename Cdt::Geom_traits>& mesh,
                          const Set_region& set_region)
{
  if (cdt.number_of_vertices() > 0) throw Option_error("fill_triangulation_2() needs an empty triangulation");
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (const auto& e : mesh.edges) edges.emplace_back(e[0], e[1]);
  cdt.insert_constraints(mesh.points.begin(), mesh.points.end(), edges.begin(), edges.end());
  // The face at the middle of a triangle: of four cocircular vertices the triangulation may have chosen the other edge.
  typename Cdt::Face_handle hint;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    hint = cdt.locate(CGAL::centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]), hint);
    set_region(hint, mesh.regions[t]);
  }
}

} // namespace weft

#endif // WEFT_PLANAR_MESH_FROM_TRIANGULATION_2_H
