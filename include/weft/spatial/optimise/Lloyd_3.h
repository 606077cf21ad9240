// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lloyd's iteration as a smoother.

#ifndef WEFT_SPATIAL_OPTIMISE_LLOYD_3_H
#define WEFT_SPATIAL_OPTIMISE_LLOYD_3_H

#include <weft/spatial/optimise/smoothing_pull_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace weft {

/// Lloyd's iteration (Du, Faber, Gunzburger 1999) with density size^-(d + 2): interior vertices move to the centroids
/// of their Voronoi cells, those on patches and creases to the centroids of their restricted Voronoi cells, whose
/// corners are the surface Delaunay ball centers of the facets or crease edges around.
struct Lloyd_3
{
  static constexpr bool moves_boundary = true, minimises_odt = false;

  template <class Context>
  std::optional<typename Context::Point> operator()(const Context& context, typename Context::Vertex_handle v,
                                                    const std::vector<typename Context::Cell_handle>& star) const
  {
    switch (v->location().dimension) {
    case 1:
      return on_crease(context, v);
    case 2:
      return on_patch(context, v, star);
    default:
      return inside(context, v, star);
    }
  }

private:
  template <class Context>
  static std::optional<typename Context::Point> on_crease(const Context& context, typename Context::Vertex_handle v)
  {
    const auto& ends = context.crease_ends(v);
    if (ends.size() != 2) return std::nullopt;
    return CGAL::midpoint(ends[0].crossing, ends[1].crossing);
  }

  /// Triangles between the vertex and the centers of two facets that share an edge with it.
  template <class Context>
  static std::optional<typename Context::Point> on_patch(const Context& context, typename Context::Vertex_handle v,
                                                         const std::vector<typename Context::Cell_handle>& star)
  {
    using Vertex_handle = typename Context::Vertex_handle;
    const auto& p = v->point();
    std::vector<std::pair<Vertex_handle, typename Context::Point>> half_edges;
    for (const auto c : star)
      for (int i = 0; i < 4; ++i) {
        const auto* f = context.mesh().facet(c, i);
        if (c->vertex(i) == v || !f || f->cell != c) continue;
        for (int k = 0; k < 4; ++k)
          if (k != i && c->vertex(k) != v) half_edges.emplace_back(c->vertex(k), f->steiner);
      }
    internal::Pull_3<typename Context::Vector> pull;
    for (std::size_t i = 0; i < half_edges.size(); ++i)
      for (std::size_t j = i + 1; j < half_edges.size(); ++j) {
        if (half_edges[i].first != half_edges[j].first) continue;
        const auto a = half_edges[i].second - p, b = half_edges[j].second - p;
        const double area = std::sqrt(CGAL::to_double(CGAL::cross_product(a, b).squared_length())) / 2;
        pull.add(area * context.template mean_power<2>({v, half_edges[i].first}, 4), (a + b) / 3);
      }
    return pull.position(p);
  }

  /// Tetrahedra between the vertex and a triangulation of each Voronoi facet from its first corner.
  template <class Context>
  static std::optional<typename Context::Point> inside(const Context& context, typename Context::Vertex_handle v,
                                                       const std::vector<typename Context::Cell_handle>& star)
  {
    const auto& p = v->point();
    internal::Pull_3<typename Context::Vector> pull;
    for (const auto c : star) // each edge at v once: from the eldest cell around it
      for (int k = 0; k < 4; ++k) {
        if (c->vertex(k) == v) continue;
        auto around = context.mesh().triangulation().incident_cells(c, c->index(v), k);
        const auto begin = around;
        bool first = true;
        while (++around != begin) first = first && c->time_stamp() < around->time_stamp();
        if (!first) continue;
        if (c->vertex(k)->id() < 0) return std::nullopt; // the cell reaches the box
        const double density = context.template mean_power<2>({v, c->vertex(k)}, 5);
        const auto a = c->circumcenter() - p;
        auto last = ++around;
        while (++around != begin) {
          const auto b = last->circumcenter() - p, d = around->circumcenter() - p;
          const double volume = std::abs(CGAL::to_double(CGAL::cross_product(a, b) * d)) / 6;
          pull.add(volume * density, (a + b + d) / 4);
          last = around;
        }
      }
    return pull.position(p);
  }
};

} // namespace weft

#endif // WEFT_SPATIAL_OPTIMISE_LLOYD_3_H
